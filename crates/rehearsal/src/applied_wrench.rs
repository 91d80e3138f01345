//! A wrench from outside on a tool, as a mission describes it.

use wrasse_dynamics::{BodyId, Frame, Kinematics, PerBody};
use wrasse_flight::Axes;
use wrasse_spatial::{Mat3, Real, SpatialForce, Vec3};
use wrasse_vehicle::JOINTS;
use wrasse_world::{Course, Instant};

/// A force and a torque at the origin of a frame, for a while.
#[derive(Debug, Clone, Copy)]
pub struct AppliedWrench {
    /// The frame at whose origin it acts.
    pub on: Frame<f64>,
    /// Torque (N·m) and force (N) at the frame's origin, in `axes`.
    pub wrench: SpatialForce<f64>,
    /// Axes of force and torque.
    pub axes: Axes,
    /// When it begins (s).
    pub from: f64,
    /// How long it lasts, rise and fall included (s).
    pub duration: f64,
    /// Time in which it rises, and falls, as a raised cosine (s).
    pub ramp: f64,
}

impl AppliedWrench {
    /// Share of it that acts at an instant: which piece of the course it belongs to is told by a time
    /// beside it.
    fn share(&self, at: Instant) -> f64 {
        let begun = |t: f64| t - self.from;
        let left = |t: f64| self.from + self.duration - t;
        if begun(at.within) < 0.0 || left(at.within) < 0.0 {
            return 0.0;
        }
        if begun(at.within).min(left(at.within)) >= self.ramp {
            return 1.0;
        }
        let is_rising = begun(at.within) < left(at.within);
        let nearest = if is_rising { begun(at.time) } else { left(at.time) };
        0.5 - 0.5 * Real::sin_cos(core::f64::consts::PI * nearest / self.ramp).1
    }

    /// Times at which its course changes (s).
    fn bends(&self) -> [f64; 4] {
        let end = self.from + self.duration;
        [self.from, self.from + self.ramp, end - self.ramp, end]
    }

    /// What it is on the body that carries it, about the body's origin in its axes.
    fn on_body(&self, at: Instant, k: &Kinematics<'_, f64, JOINTS>) -> SpatialForce<f64> {
        let share = self.share(at);
        let R_NB = k.X_NB(self.on.body).rotation;
        let R_NA = match self.axes {
            Axes::Inertial => Mat3::identity(),
            Axes::Base => k.X_NB(BodyId::Base).rotation,
        };
        let turned = |v: Vec3<f64>| R_NB.transpose_mul(R_NA * (v * share));
        let at_frame = SpatialForce::new(turned(self.wrench.torque), turned(self.wrench.force));
        at_frame.about(-self.on.X_BF.translation)
    }
}

/// What these do to a tool from `t` (s) on, at its origin in its axes.
pub(crate) fn felt(
    wrenches: &[AppliedWrench],
    tool: &Frame<f64>,
    t: f64,
    k: &Kinematics<'_, f64, JOINTS>,
) -> SpatialForce<f64> {
    // At a jump: what comes after it.
    let at = Instant { time: t, within: t + AFTER };
    let on_tool = wrenches.iter().filter(|wrench| wrench.on.body == tool.body);
    let on_body = on_tool.fold(SpatialForce::zero(), |sum, wrench| sum + wrench.on_body(at, k));
    let at_tool = on_body.about(tool.X_BF.translation);
    let R_BE = &tool.X_BF.rotation;
    SpatialForce::new(R_BE.transpose_mul(at_tool.torque), R_BE.transpose_mul(at_tool.force))
}

/// A moment after an instant (s): longer than the rounding of a sum of periods.
const AFTER: f64 = 1e-9;

/// All of them together, as the world asks for them, and the times at which they bend (s).
pub(crate) fn together(wrenches: Vec<AppliedWrench>) -> (Course<JOINTS>, Vec<f64>) {
    let bends = wrenches.iter().flat_map(AppliedWrench::bends).collect();
    let course = move |at: Instant, k: &Kinematics<'_, f64, JOINTS>| {
        let mut on_bodies = PerBody::filled(SpatialForce::zero());
        for wrench in &wrenches {
            on_bodies[wrench.on.body] += wrench.on_body(at, k);
        }
        on_bodies
    };
    (Box::new(course), bends)
}
