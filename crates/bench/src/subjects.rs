//! The vehicles that are timed, in states that the clock cannot guess.

use std::path::Path;
use wrasse_dynamics::{BodyId, Generalized, GeneralizedVelocity, MassProperties, Robot, State};
use wrasse_spatial::{Instructions, Lanes, Pose, Quat, Real, SpatialVelocity, vec3};
use wrasse_world::Noise;

/// States of each subject, taken in turn.
pub const STATES: usize = 64;

/// A state and accelerations (or forces of the same numbers).
pub type Moment<T, const J: usize> = (State<T, J>, GeneralizedVelocity<T, J>);

/// A robot with room for exactly its joints, and states with accelerations.
#[derive(Debug)]
pub struct Subject<T, const J: usize> {
    /// The robot.
    pub robot: Robot<T, J>,
    /// States with accelerations.
    pub states: Vec<Moment<T, J>>,
}

/// A vehicle of `validation/golden` by its name, and random states of it.
///
/// # Errors
/// If the file cannot be read, or has not `J` joints.
pub fn subject<const J: usize>(name: &str) -> Result<Subject<f64, J>, String> {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/golden");
    let path = golden.join(format!("{name}.urdf")).display().to_string();
    let vehicle = wrasse_vehicle::find_vehicle(&path, None)
        .map_err(|_| format!("{path} cannot be read as a vehicle"))?;
    let matter = |body| MassProperties {
        M_F_F: *vehicle.robot.inertia(body),
        I_parts_F: *vehicle.robot.inertia_of_parts(body),
    };
    let joints = vehicle.robot.joints();
    let links: Vec<_> =
        joints.map(|j| (*vehicle.robot.joint(j), matter(BodyId::Link(j)))).collect();
    let robot = Robot::new(matter(BodyId::Base), &links).map_err(|why| why.to_string())?;
    let mut noise = Noise::new(7, 0);
    let states = (0..STATES).map(|_| state(&mut || 2.0 * noise.uniform() - 1.0)).collect();
    Ok(Subject { robot, states })
}

fn state<const J: usize>(u: &mut impl FnMut() -> f64) -> Moment<f64, J> {
    let mut six = || [u(), u(), u(), u(), u(), u()];
    let (turn, twist, acceleration) = (six(), six(), six());
    let quat_NB = Quat::exp(vec3(turn[0], turn[1], turn[2]));
    let state = State {
        X_NB: Pose::from_quat(quat_NB, vec3(turn[3], turn[4], turn[5])),
        V_NB_B: SpatialVelocity::from_array(twist),
        q: std::array::from_fn(|_| u()),
        v: std::array::from_fn(|_| u()),
    };
    let base = SpatialVelocity::from_array(acceleration);
    (state, Generalized { base, joints: std::array::from_fn(|_| u()) })
}

/// The same with eight consecutive states side by side.
pub fn widened<I: Instructions, const J: usize>(one: &Subject<f64, J>) -> Subject<Lanes<8, I>, J> {
    let states = (0..STATES).map(|first| {
        let many = |pick: &dyn Fn(&Moment<f64, J>) -> f64| {
            Lanes::<8, I>::from_fn(|lane| pick(&one.states[(first + lane) % STATES]))
        };
        let twist = std::array::from_fn(|i| many(&|s| s.0.V_NB_B.to_array()[i]));
        let acceleration = std::array::from_fn(|i| many(&|s| s.1.base.to_array()[i]));
        let mut state = State::<Lanes<8, I>, J> {
            V_NB_B: SpatialVelocity::from_array(twist),
            q: std::array::from_fn(|j| many(&|s| s.0.q[j])),
            v: std::array::from_fn(|j| many(&|s| s.0.v[j])),
            ..State::default()
        };
        state.X_NB.translation = vec3(Real::one(), Real::zero(), Real::one());
        let base = SpatialVelocity::from_array(acceleration);
        (state, Generalized { base, joints: std::array::from_fn(|j| many(&|s| s.1.joints[j])) })
    });
    Subject { robot: one.robot.cast(), states: states.collect() }
}
