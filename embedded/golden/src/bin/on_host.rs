//! The golden control periods on the host: `on_host single|double|difference`.

use wrasse_golden_periods::{Machine, run};

/// Lines go to standard output; nothing is counted.
struct Host;

impl Machine for Host {
    fn put(&mut self, text: &str) {
        print!("{text}");
    }
    fn ticks(&mut self) -> u32 {
        0
    }
    fn mark_stack(&mut self) {}
    fn stack_used(&mut self) -> u32 {
        0
    }
}

fn main() {
    match std::env::args().nth(1).as_deref() {
        Some("single") => run::<f32>(&mut Host),
        Some("double") => run::<f64>(&mut Host),
        _ => eprintln!("usage: on_host single|double"),
    }
}
