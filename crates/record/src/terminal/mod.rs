//! Plain text for the terminal: tables whose columns line up.

use wrasse_document::visible;

pub(crate) mod run;
pub(crate) mod study;
pub(crate) mod sweep;

/// How a column stands.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Side {
    Left,
    Right,
}

/// Rows of cells in columns that line up, two spaces apart.
pub(crate) fn aligned(rows: &[Vec<String>], sides: &[Side]) -> String {
    let rows: Vec<Vec<String>> =
        rows.iter().map(|row| row.iter().map(|cell| printable(cell)).collect()).collect();
    let width =
        |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..sides.len()).map(width).collect();
    let mut text = String::new();
    for row in &rows {
        let mut line = String::new();
        for ((cell, side), &width) in row.iter().zip(sides).zip(&widths) {
            line += &match side {
                Side::Left => format!("{cell:<width$}  "),
                Side::Right => format!("{cell:>width$}  "),
            };
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

/// Without characters that a terminal obeys: a name in a file is not to move the cursor.
pub(crate) fn printable(text: &str) -> String {
    visible(text).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up_whatever_their_cells_are() {
        let rows = [["a", "1"], ["längere·name", "-12.5"], ["x\u{1b}[2J", "3e-7"]];
        let rows: Vec<_> = rows.iter().map(|row| row.map(String::from).to_vec()).collect();
        assert_eq!(
            aligned(&rows, &[Side::Left, Side::Right]),
            "a                 1\n\
             längere·name  -12.5\n\
             x\\u{1b}[2J     3e-7\n"
        );
    }
}
