//! The bytes of a file to text: UTF-8, or what the file itself says that it is in.

use encoding_rs::Encoding;

/// Bytes of an XML declaration within which the encoding stands.
const DECLARATION: usize = 200;

/// The text of a file's bytes, and how many bytes before the first that is not text, if one is not.
///
/// A byte order mark says UTF-8 or UTF-16; an XML declaration says what it says; all else is UTF-8.
pub(crate) fn decoded(bytes: Vec<u8>) -> Result<String, usize> {
    if let Some((encoding, mark)) = Encoding::for_bom(&bytes) {
        return with(encoding, bytes.get(mark..).unwrap_or_default());
    }
    match declared(&bytes) {
        Some(encoding) if encoding != encoding_rs::UTF_8 => with(encoding, &bytes),
        _ => String::from_utf8(bytes).map_err(|error| error.utf8_error().valid_up_to()),
    }
}

fn with(encoding: &'static Encoding, bytes: &[u8]) -> Result<String, usize> {
    let text = encoding.decode_without_bom_handling_and_without_replacement(bytes);
    let valid = || std::str::from_utf8(bytes).map_or_else(|error| error.valid_up_to(), str::len);
    text.map(std::borrow::Cow::into_owned).ok_or_else(valid)
}

/// What `<?xml … encoding="…"?>` says, if the bytes begin so. XML in letters of two bytes without a byte
/// order mark shows by its first two.
fn declared(bytes: &[u8]) -> Option<&'static Encoding> {
    match bytes.get(..4)? {
        [b'<', 0, second, 0] if *second != 0 => return Some(encoding_rs::UTF_16LE),
        [0, b'<', 0, second] if *second != 0 => return Some(encoding_rs::UTF_16BE),
        _ => {}
    }
    let head = bytes.get(..bytes.len().min(DECLARATION))?;
    let end = head.windows(2).position(|pair| pair == b"?>")?;
    let head = std::str::from_utf8(head.get(..end)?).ok()?;
    let after = head.strip_prefix("<?xml")?.split_once("encoding")?.1;
    let quoted = after.trim_start().strip_prefix('=')?.trim_start();
    let quote = quoted.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    Encoding::for_label(quoted.get(1..)?.split(quote).next()?.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_in_what_it_says_that_it_is_in() {
        let latin = b"<?xml version='1.0' encoding='ISO-8859-1'?><robot name='Ma\xdf'/>".to_vec();
        assert!(decoded(latin).unwrap().contains("Maß"));
        let text = "<?xml version=\"1.0\" encoding=\"UTF-16\"?><robot name=\"Maß\"/>";
        let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        for (mark, bytes) in [
            (vec![0xff, 0xfe], &little),
            (vec![], &little),
            (vec![0xfe, 0xff], &big),
            (vec![], &big),
        ] {
            assert_eq!(decoded([mark, bytes.clone()].concat()).unwrap(), text);
        }
        assert_eq!(decoded(b"\xef\xbb\xbfname = 1".to_vec()).unwrap(), "name = 1");
    }

    #[test]
    fn bytes_that_are_no_text_are_told_where_they_begin() {
        assert_eq!(decoded(b"name = \"Ma\xdf\"".to_vec()), Err(10));
        assert_eq!(decoded(b"\xff\xfea".to_vec()), Err(1), "half a letter of UTF-16");
        let utf8 = b"<?xml version='1.0' encoding='utf-8'?>\xdf".to_vec();
        assert_eq!(decoded(utf8), Err(38));
        // A declaration of something that nobody knows is not believed.
        assert_eq!(decoded(b"<?xml encoding='martian'?>".to_vec()).unwrap().len(), 26);
    }
}
