//! A wrench from outside on a tool, as a mission describes it.

use wrasse_dynamics::{Frame, Kinematics, PerBody};
use wrasse_flight::Axes;
use wrasse_spatial::{SpatialForce, Vec3};
use wrasse_vehicle::JOINTS;
use wrasse_world::OutsideWrench;

/// A force and a torque at the origin of a frame, for a while.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AppliedWrench {
    pub(crate) on: Frame<f64>,
    /// Torque (N·m) and force (N) at the frame's origin, in `axes`.
    pub(crate) wrench: SpatialForce<f64>,
    pub(crate) axes: Axes,
    /// When it begins (s).
    pub(crate) from: f64,
    /// How long it lasts, rise and fall included (s).
    pub(crate) duration: f64,
    /// Time in which it rises, and falls, as a raised cosine (s).
    pub(crate) ramp: f64,
}

impl AppliedWrench {
    /// Share of it that acts at time `t` (s).
    fn share(&self, t: f64) -> f64 {
        let (begun, left) = (t - self.from, self.from + self.duration - t);
        if begun < 0.0 || left < 0.0 {
            return 0.0;
        }
        let nearest = begun.min(left);
        if nearest >= self.ramp {
            return 1.0;
        }
        0.5 - 0.5 * wrasse_spatial::Real::sin_cos(core::f64::consts::PI * nearest / self.ramp).1
    }

    /// What it is on the body that carries it at `t` (s), about the body's origin in its axes.
    fn on_body(&self, t: f64, k: &Kinematics<'_, f64, JOINTS>) -> SpatialForce<f64> {
        let share = self.share(t);
        let R_NB = k.X_NB[self.on.body].rotation;
        let R_NA = match self.axes {
            Axes::Inertial => wrasse_spatial::Mat3::identity(),
            Axes::Base => k.X_NB.base.rotation,
        };
        let turned = |v: Vec3<f64>| R_NB.transpose_mul(R_NA * (v * share));
        let at_frame = SpatialForce::new(turned(self.wrench.torque), turned(self.wrench.force));
        at_frame.about(-self.on.X_BF.translation)
    }
}

/// What these do to a tool at `t` (s), at its origin in its axes.
pub(crate) fn felt(
    wrenches: &[AppliedWrench],
    tool: &Frame<f64>,
    t: f64,
    k: &Kinematics<'_, f64, JOINTS>,
) -> SpatialForce<f64> {
    let on_tool = wrenches.iter().filter(|wrench| wrench.on.body == tool.body);
    let on_body = on_tool.fold(SpatialForce::zero(), |sum, wrench| sum + wrench.on_body(t, k));
    let at_tool = on_body.about(tool.X_BF.translation);
    let R_BE = &tool.X_BF.rotation;
    SpatialForce::new(R_BE.transpose_mul(at_tool.torque), R_BE.transpose_mul(at_tool.force))
}

/// All of them together, as the world asks for them.
pub(crate) fn together(wrenches: Vec<AppliedWrench>) -> OutsideWrench<JOINTS> {
    Box::new(move |t, k| {
        let mut on_bodies = PerBody::filled(SpatialForce::zero());
        for wrench in &wrenches {
            on_bodies[wrench.on.body] += wrench.on_body(t, k);
        }
        on_bodies
    })
}
