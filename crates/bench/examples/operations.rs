//! Operations that each kernel takes, counted by a number that counts. One line each: vehicle,
//! kernel, operations.
#![allow(clippy::print_stdout, reason = "an example talks to its caller")]

use wrasse_bench::{KERNELS, Places, Subject, subject};
use wrasse_dynamics::{Generalized, State};
use wrasse_spatial::{Counted, Pose, Real, SpatialVelocity};

fn count<const J: usize>(name: &str) -> Result<(), String> {
    let one: Subject<f64, J> = subject(name)?;
    let c = Counted::from_f64;
    let states = one.states.iter().take(1).map(|(s, nudot)| {
        let state = State {
            X_NB: Pose::from_f64(&s.X_NB),
            V_NB_B: SpatialVelocity::from_array(s.V_NB_B.to_array().map(c)),
            q: s.q.map(c),
            v: s.v.map(c),
        };
        let base = SpatialVelocity::from_array(nudot.base.to_array().map(c));
        (state, Generalized { base, joints: nudot.joints.map(c) })
    });
    let counted = Subject { robot: one.robot.cast(), states: states.collect() };
    for (kernel, quantity) in KERNELS {
        let mut places = Places::new();
        let (operations, ()) = Counted::operations(|| places.call_any(quantity, &counted, 0));
        // Each joint must be turned, moved and asked for its part, and so must the base.
        let joints = counted.robot.joint_count();
        assert!(operations > 50 * (joints + 1), "{kernel} does too little: {operations}");
        println!("{name} {kernel} {operations}");
    }
    Ok(())
}

fn main() -> Result<(), String> {
    count::<8>("one_arm")?;
    count::<16>("two_arms")
}
