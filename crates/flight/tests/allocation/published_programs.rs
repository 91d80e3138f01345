//! A linear program that others have solved: the optimum is published.

use std::path::Path;
use wrasse_flight::allocation::BoundedSimplex;
use wrasse_testing::largest;

/// Equations and inequalities of AFIRO.
const ROWS: usize = 27;
/// Its variables, the right side, and for each row what is left of it.
const COLUMNS: usize = 32 + 1 + ROWS;
/// The right side is the variable behind the published ones.
const RIGHT_SIDE: usize = 32;
/// As Netlib's readme has it (MINOS 5.3).
const OPTIMUM: f64 = -4.647_531_428_6e2;
/// The solver counts with numbers of the order of one: variables in units of the largest right side.
const UNIT: f64 = 500.0;

struct Program {
    rows: [[f64; COLUMNS]; ROWS],
    upper: [f64; COLUMNS],
    cost: [f64; COLUMNS],
}

/// A program in free MPS format, whose inequalities are all `<=` and whose variables begin at zero.
fn read(text: &str) -> Program {
    let mut program = Program {
        rows: [[0.0; COLUMNS]; ROWS],
        upper: [f64::INFINITY; COLUMNS],
        cost: [0.0; COLUMNS],
    };
    let (mut section, mut row_names, mut column_names) = ("", vec![], Vec::<&str>::new());
    for line in text.lines().filter(|line| !line.starts_with('*')) {
        let words: Vec<_> = line.split_whitespace().collect();
        match (section, &words[..]) {
            _ if !line.starts_with(' ') => section = words[0],
            ("ROWS", ["N", _]) => {}
            ("ROWS", [kind, name]) => {
                // Nothing may be left of an equation.
                if *kind == "E" {
                    program.upper[COLUMNS - ROWS + row_names.len()] = 0.0;
                }
                row_names.push(*name);
            }
            ("COLUMNS", [column, row, number]) => {
                if column_names.last() != Some(column) {
                    column_names.push(column);
                }
                let (number, j) = (number.parse::<f64>().unwrap(), column_names.len() - 1);
                match row_names.iter().position(|name| name == row) {
                    Some(r) => program.rows[r][j] = number,
                    None => program.cost[j] = number,
                }
            }
            ("RHS", [_, row, number]) => {
                let r = row_names.iter().position(|name| name == row).unwrap();
                program.rows[r][RIGHT_SIDE] = -number.parse::<f64>().unwrap() / UNIT;
            }
            _ => panic!("not understood: {line}"),
        }
    }
    assert_eq!((row_names.len(), column_names.len()), (ROWS, RIGHT_SIDE));
    (0..ROWS).for_each(|r| program.rows[r][COLUMNS - ROWS + r] = 1.0);
    program.upper[RIGHT_SIDE] = 1.0;
    program
}

/// AFIRO of Netlib, with either rule for ties. First the right side is brought to its full size, which
/// makes the solution feasible; then the cost is brought down. Measured 6.4e-12 from the optimum, whose
/// last printed digit is 1e-11 of it; equations are kept to 2e-15 of the largest right side.
#[test]
fn the_optimum_of_afiro_is_the_published_one() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/netlib_afiro.mps");
    let Program { rows, upper, cost } = read(&std::fs::read_to_string(path).unwrap());
    let mut whole = [0.0; COLUMNS];
    whole[RIGHT_SIDE] = -1.0;
    for largest_pivots in [false, true] {
        let plain = BoundedSimplex::new(rows, upper);
        let mut simplex = if largest_pivots { plain.with_largest_pivots() } else { plain };
        assert!(simplex.minimise(&whole));
        simplex.freeze(RIGHT_SIDE);
        assert!(simplex.minimise(&cost));
        assert_eq!(simplex.value(RIGHT_SIDE), 1.0);
        let value = |j: usize| simplex.value(j);
        let found: f64 = UNIT * (0..RIGHT_SIDE).map(|j| cost[j] * value(j)).sum::<f64>();
        assert!((found / OPTIMUM - 1.0).abs() < 1e-10, "{found:.12e}");
        let left = |row: &[f64; COLUMNS]| (0..COLUMNS).map(|j| row[j] * value(j)).sum::<f64>();
        let off = largest(rows.iter().map(|row| left(row).abs()));
        assert!(off < 1e-13, "{off:e}");
        assert!((0..COLUMNS).all(|j| value(j) >= 0.0 && value(j) <= upper[j]));
    }
}
