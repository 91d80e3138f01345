//! The binary `wrasse`.
fn main() {}
