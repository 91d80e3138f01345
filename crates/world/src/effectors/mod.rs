//! What is bolted to a system, or pushes it from outside: one file each. An effector brings its
//! variables, what it does to the bodies, how fast its variables change, and its account.

mod applied_wrench;
mod cmgs;
mod flexible_joints;
mod passive_joints;
mod slosh;
mod slosh_pendulum;
mod tank;
mod thrusters;
mod wheels;

pub use applied_wrench::{AppliedWrench, Course, Instant};
pub(crate) use cmgs::Cmgs;
pub use flexible_joints::{FlexibleJoint, FlexibleJoints};
pub use passive_joints::{JointSpring, PassiveJoints};
pub use slosh::SloshingTank;
pub use slosh_pendulum::SloshPendulum;
pub use tank::TankWithPropellant;
pub(crate) use thrusters::Thrusters;
pub(crate) use wheels::Wheels;

use crate::command::Saturation;
use crate::failure::Failure;
use crate::setup::Drive;
use crate::source::{Booking, Source};
use std::fmt::Debug;
use wrasse_dynamics::{BodyId, Kinematics, MassProperties, PerBody, State};
use wrasse_hardware::{ActuatorCommand, ActuatorReadings, CMGS, WHEELS};
use wrasse_spatial::{SpatialForce, Vec3};

/// Something that acts on a system.
pub trait Effector<const J: usize>: Debug + Send + Sync {
    /// Under which its impulses and its work are booked.
    fn source(&self) -> Source;
    /// Names of its variables, one for each number.
    fn variables(&self) -> Vec<String> {
        vec![]
    }
    /// Whether it still acts where the attitude of the base is held: what comes from outside does, what
    /// would turn the base does not.
    fn acts_on_held_base(&self) -> bool {
        false
    }
    /// Whether it asks where the links are.
    fn sees_links(&self) -> bool {
        false
    }
    /// What it does at an instant, and the rates of its variables.
    fn act(&self, at: &Stage<'_, J>, own: &[f64], load: &mut Load<'_, J>, rates: &mut [f64]);
    /// Angular momentum that it stores beside the bodies, base axes (N·m·s), one part at a time.
    fn stored_momentum_B(&self, _own: &[f64], _each: &mut dyn FnMut(Vec3<f64>)) {}
    /// Mass properties that the base has more with it, in base axes.
    fn mass_properties(&self) -> Option<MassProperties<f64>> {
        None
    }
    /// Times between two others (all s into the period, which began at `period_start`) at which what it
    /// does is not smooth.
    fn breakpoints(&self, _period_start: f64, _between: (f64, f64), _each: &mut dyn FnMut(f64)) {}
    /// Take the commands of a control period; what a limit cuts is noted.
    fn command(&mut self, _told: &PeriodCommand<'_>, _own: &[f64], _cut: &mut Vec<Saturation>) {}
    /// What it says of itself.
    fn read(&self, _own: &[f64], _w_NB_B: Vec3<f64>, _readings: &mut ActuatorReadings<f64>) {}
    /// Torques of its motors (N·m) while the base accelerates by `wdot_NB_B` (rad/s²).
    fn motor_torques(
        &self,
        _own: &[f64],
        _motion: (Vec3<f64>, Vec3<f64>),
        _motors: &mut MotorTorques,
    ) {
    }
    /// Let a unit fail, if it has it; the angular impulse that this gives the base (N·m·s, base axes).
    fn fail(&mut self, _failure: Failure, _own: &mut [f64]) -> Option<Vec3<f64>> {
        None
    }
    /// Propellant (kg) that it asks for from `from` to `to` (s into the period), where nothing breaks.
    fn propellant(&self, _from: f64, _to: f64) -> f64 {
        0.0
    }
    /// The propellant that it holds, if it is a tank.
    fn tank(&mut self) -> Option<&mut TankWithPropellant> {
        None
    }
    /// Itself, if it is a tank in which the propellant swings.
    fn slosh(&self) -> Option<&SloshingTank> {
        None
    }
    /// The same, to be changed.
    fn slosh_mut(&mut self) -> Option<&mut SloshingTank> {
        None
    }
}

/// Torques of the motors of wheels and gimbals (N·m).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MotorTorques {
    /// Of the wheels, now.
    pub wheel: [f64; WHEELS],
    /// Of the gimbals now, with what they bear of the turning base.
    pub gimbal: [f64; CMGS],
    /// That each gimbal would have needed to do as it was commanded as the period began, whatever it can
    /// give.
    pub gimbal_needed: [f64; CMGS],
}

/// What an effector is told for a control period.
#[derive(Debug, Clone, Copy)]
pub struct PeriodCommand<'a> {
    /// What the flight computer says.
    pub actuators: &'a ActuatorCommand<f64>,
    /// Turning rate of the base, base axes (rad/s).
    pub w_NB_B: Vec3<f64>,
    /// How long ago the last period began (s).
    pub gone: f64,
    /// Length of the coming period (s).
    pub period: f64,
    /// Whether there is propellant.
    pub is_fed: bool,
}

/// A system at an instant.
#[derive(Debug, Clone, Copy)]
pub struct Stage<'a, const J: usize> {
    /// How it stands and moves.
    pub state: &'a State<f64, J>,
    /// What drives its joints.
    pub drives: &'a [Drive; J],
    /// Where its links are, where an effector asks for that.
    pub k: Option<&'a Kinematics<'a, f64, J>>,
    /// Start of the control period (s).
    pub period_start: f64,
    /// Time into it (s).
    pub t: f64,
    /// A time into it in the same smooth stretch (s): at a breakpoint it tells before from after.
    pub within: f64,
}

/// What acts on a system at an instant; each effector adds its part.
#[derive(Debug)]
pub struct Load<'a, const J: usize> {
    /// On the base at Bo, base axes, from outside (N·m, N).
    pub on_base: SpatialForce<f64>,
    /// Torque on the base of what turns against it, base axes (N·m): no momentum comes or goes.
    pub internal_B: Vec3<f64>,
    /// On joints, beside what drives them (N·m or N).
    pub(crate) on_joints: &'a mut [f64; J],
    /// On all bodies, at their origins in their axes.
    pub(crate) on_bodies: &'a mut Option<Box<PerBody<SpatialForce<f64>, J>>>,
    /// About the origin of N, inertial axes, of what is on bodies.
    pub(crate) total_N: SpatialForce<f64>,
    /// (W)
    pub(crate) power: f64,
}

impl<'a, const J: usize> Load<'a, J> {
    /// No load yet.
    pub(crate) fn nothing(
        on_joints: &'a mut [f64; J],
        on_bodies: &'a mut Option<Box<PerBody<SpatialForce<f64>, J>>>,
    ) -> Self {
        let (none, internal_B) = (SpatialForce::zero(), Vec3::zero());
        Self { on_base: none, internal_B, on_joints, on_bodies, total_N: none, power: 0.0 }
    }
    /// A torque (N·m) or force (N) on a joint that moves at a rate (rad/s or m/s), beside what drives it.
    /// A joint that follows set-points does so all the same.
    pub fn drive(&mut self, joint: usize, rate: f64, effort: f64) {
        self.on_joints[joint] += effort;
        self.power += effort * rate;
    }
    /// What it gives the bodies of a system: wrench about the origin of N and power.
    pub(crate) fn given(&self, state: &State<f64, J>) -> Booking {
        let (X_NB, V_NB_B) = (&state.X_NB, &state.V_NB_B);
        let force = X_NB.rotation * self.on_base.force;
        let torque = X_NB.rotation * self.on_base.torque + X_NB.translation.cross(force);
        let of_base = V_NB_B.power(&self.on_base) + self.internal_B.dot(V_NB_B.angular);
        let all = self.total_N + SpatialForce::new(torque, force);
        Booking::of_wrench(&all, self.power + of_base)
    }
    /// A wrench from outside on a body at its origin, in its axes (N·m, N).
    pub fn push(&mut self, k: &Kinematics<'_, f64, J>, body: BodyId, F_B: &SpatialForce<f64>) {
        let (X, V) = (k.X_NB(body), k.V_NB_B(body));
        let on =
            self.on_bodies.get_or_insert_with(|| Box::new(PerBody::filled(SpatialForce::zero())));
        on[body] += *F_B;
        let (torque, force) = (X.rotation * F_B.torque, X.rotation * F_B.force);
        self.total_N += SpatialForce::new(torque + X.translation.cross(force), force);
        self.power += V.power(F_B);
    }
}
