//! Propellant: a point mass in the tank that grows lighter. What leaves goes as a body would that
//! is let go: with the tank's velocity. The thrust itself is a force from outside.

use crate::world::World;
use wrasse_dynamics::{BodyId, Frame, MassProperties, Robot, kinematics};
use wrasse_spatial::{Pose, Sym3, Vec3};

/// What propellant took with it, as it left the tank.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Carried {
    /// Propellant (kg).
    pub mass: f64,
    /// Linear momentum (N·s).
    pub linear: Vec3<f64>,
    /// Angular momentum, each part about the common centre of mass as it left (N·m·s).
    pub angular: Vec3<f64>,
    /// Kinetic energy (J).
    pub energy: f64,
}

/// Propellant in its tank.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InTank {
    /// Where (m).
    pub(crate) position_B: Vec3<f64>,
    /// How much (kg).
    pub(crate) mass: f64,
}

impl InTank {
    /// A robot with this on its base.
    pub(crate) fn added_to<const J: usize>(self, robot: &Robot<f64, J>) -> Robot<f64, J> {
        let base = Frame { body: BodyId::Base, X_BF: Pose::identity() };
        robot.with_payload(
            &base,
            &MassProperties::from_central(self.mass, self.position_B, Sym3::zero()),
        )
    }
}

impl<const J: usize> World<J> {
    /// Let propellant (kg) leave the tank, as much as there is. The twists of all bodies stay.
    pub(crate) fn let_go_of_propellant(&mut self, wanted: f64) {
        let Some(tank) = &mut self.tank else { return };
        // What is not a number takes nothing away.
        let dm = if wanted > 0.0 { wanted.min(tank.mass) } else { 0.0 };
        if dm <= 0.0 {
            return;
        }
        tank.mass = if wanted < tank.mass { tank.mass - dm } else { 0.0 };
        let position_B = tank.position_B;
        let (before_N, _) = self.centre_and_momentum_of_all();
        let state = self.state();
        let R_NB = state.X_NB.rotation;
        let p_N = state.X_NB.point(position_B);
        let v_N = R_NB * state.V_NB_B.shifted_by(position_B).linear;
        let away = v_N * dm;

        self.robot = self.laden();
        self.mass = self.robot.mass();
        let p_cm = kinematics(&self.robot, &state).centre_of_mass().1;
        let s = &mut self.system;
        s.linear -= away;
        s.angular =
            s.angular - (p_N - s.p_NScm_N).cross(away) - (p_cm - s.p_NScm_N).cross(s.linear);
        s.p_NScm_N = p_cm;

        // The books count about the centre of mass of everything, which moves away from what leaves.
        let (after_N, linear) = self.centre_and_momentum_of_all();
        let carried = &mut self.carried;
        carried.mass += dm;
        carried.linear += away;
        carried.angular += (p_N - before_N).cross(away) + (after_N - before_N).cross(linear);
        carried.energy += 0.5 * dm * v_N.dot(v_N);
    }

    /// Common centre of mass of the vehicle and the free bodies (m), and their momentum (N·s).
    fn centre_and_momentum_of_all(&self) -> (Vec3<f64>, Vec3<f64>) {
        let s = &self.system;
        let (mut mass, mut moment, mut linear) = (self.mass, s.p_NScm_N * self.mass, s.linear);
        for body in &self.free {
            mass += body.matter.M_F_F.mass;
            moment += body.p_NTcm_N * body.matter.M_F_F.mass;
            linear += body.linear;
        }
        (moment * (1.0 / mass), linear)
    }
}
