//! The golden control periods on the host: `on_host single|double|difference`.

use wrasse_flight::ArmLaw;
use wrasse_golden_periods::{Machine, STATES, Subject, one_arm, run, two_arms};

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

/// How far `f32` is from `f64`, as a share of the largest number of its kind: the worst state, and the
/// one that 99 of 100 stay below.
fn difference<const J: usize>(
    name: &str,
    single: Option<Subject<f32, J>>,
    double: Option<Subject<f64, J>>,
) {
    let (single, double) = (single.expect("a robot"), double.expect("a robot"));
    let mut apart = Vec::new();
    for number in 0..STATES {
        let (low, high) =
            (single.period(&mut single.start(number)), double.period(&mut double.start(number)));
        let pairs = low.effort.iter().zip(high.effort);
        let effort = pairs.map(|(a, b)| (f64::from(*a) - b).abs()).fold(0.0, f64::max);
        let largest = high.effort.iter().fold(1.0, |m: f64, b| m.max(b.abs()));
        apart.push(effort / largest);
    }
    apart.sort_by(f64::total_cmp);
    let (worst, most) = (apart[apart.len() - 1], apart[apart.len() * 99 / 100]);
    println!("{name} {worst:.1e} {most:.1e}");
}

fn main() {
    use ArmLaw::{AttitudeHeld, FreeFloating};
    match std::env::args().nth(1).as_deref() {
        Some("single") => run::<f32>(&mut Host),
        Some("double") => run::<f64>(&mut Host),
        Some("difference") => {
            difference::<7>("one held", one_arm(AttitudeHeld), one_arm(AttitudeHeld));
            difference::<7>("one floating", one_arm(FreeFloating), one_arm(FreeFloating));
            difference::<14>("two held", two_arms(AttitudeHeld), two_arms(AttitudeHeld));
            difference::<14>("two floating", two_arms(FreeFloating), two_arms(FreeFloating));
        }
        _ => eprintln!("usage: on_host single|double|difference"),
    }
}
