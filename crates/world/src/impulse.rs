//! Momentum that jumps at an instant: a grasp, a jam, propellant that leaves.

use crate::gears::with_gears;
use crate::scene::Scene;
use crate::source::{Booking, Source};
use crate::system::System;
use wrasse_dynamics::{
    BodyId, Configuration, Dynamics, GeneralizedForce, JointDrive, PerBody, Robot, State,
    driven_dynamics, inverse_dynamics, kinematics,
};
use wrasse_spatial::{SpatialForce, SpatialVelocity, Vec3};

/// Rates before and after a jump, and the momenta that it took.
pub(crate) struct Jump<const J: usize> {
    /// Generalized momentum that was there before.
    before: GeneralizedForce<f64, J>,
    /// `[w; v; q̇]` after it, and the impulses that hold what does not give way.
    pub(crate) after: Dynamics<f64, J>,
    /// Kinetic energy after it, less what moved before had (J).
    pub(crate) energy: f64,
}

impl<const J: usize> System<J> {
    /// Rates after a jump: `M⁺ ν⁺ = M ν + Jᵀ h` is forward dynamics at rest, with the generalized momentum
    /// in place of the forces and the rates in place of the accelerations. Joints that are driven by
    /// torque give way; prescribed joints keep their rates and a held base its attitude, whatever impulse
    /// that takes.
    ///
    /// `robot` is what moved before with `state`; `h_B` comes onto `body`, at its origin in its axes.
    pub(crate) fn jump(
        &mut self,
        robot: &Robot<f64, J>,
        state: &State<f64, J>,
        (body, h_B): (BodyId, SpatialForce<f64>),
    ) -> Jump<J> {
        let at_rest = State { V_NB_B: SpatialVelocity::zero(), v: [0.0; J], ..*state };
        let none = PerBody::filled(SpatialForce::zero());
        let before = inverse_dynamics(&kinematics(robot, &at_rest), &state.velocity(), &none).force;
        let mut momenta = none;
        momenta[body] += h_B;
        momenta.base += before.base;
        let drives = core::array::from_fn(|j| {
            if self.drive_is_followed(j) {
                JointDrive::Acceleration(state.v[j])
            } else {
                JointDrive::Effort(before.joints[j])
            }
        });
        let k = kinematics(&self.robot, &at_rest);
        let mut after = driven_dynamics(&k, &drives, self.base.mode(), &momenta);
        if !self.followers.is_empty() {
            with_gears(&self.followers, &drives, &mut |drives| {
                after = driven_dynamics(&k, drives, self.base.mode(), &momenta);
                after.force.joints
            });
        }
        let rates = self.variables.v();
        let n = self.robot.joint_count();
        self.row[rates].copy_from_slice(&after.nudot.joints[..n]);
        let moved = State { V_NB_B: after.nudot.base, v: after.nudot.joints, ..*state };
        let brought = kinematics(&self.robot, &moved).V_NB_B(body).power(&h_B);
        let mut twice = moved.V_NB_B.power(&(before.base + after.force.base)) + brought
            - state.V_NB_B.power(&before.base);
        for j in self.robot.joints() {
            twice += moved.v[j] * after.force.joints[j] - state.v[j] * before.joints[j];
        }
        let energy = 0.5 * twice;
        Jump { before, after, energy }
    }
}

impl<const J: usize> Jump<J> {
    /// Work of the impulses that keep prescribed joints at their rates: an impulse times the mean of the
    /// rates before and after (J).
    fn work_of_drives(&self, before: &State<f64, J>, joints: impl Iterator<Item = usize>) -> f64 {
        let found = &self.after;
        let impulse = |j: usize| found.force.joints[j] - self.before.joints[j];
        let mean = |j: usize| 0.5 * (found.nudot.joints[j] + before.v[j]);
        joints.fold(0.0, |sum, j| sum + impulse(j) * mean(j))
    }
}

impl<const J: usize> Scene<J> {
    /// An angular impulse (N·m·s, base axes) that a unit gives its base at once, from `before`. What the
    /// unit had is the bodies' now: the sum of both stays, and with it the momentum.
    pub(crate) fn jolt(
        &mut self,
        number: usize,
        before: &State<f64, J>,
        (impulse_B, source): (Vec3<f64>, Source),
    ) {
        let Some(system) = &mut self.systems[number] else { return };
        let robot = system.robot;
        let impulse = SpatialForce::new(impulse_B, Vec3::zero());
        let jump = system.jump(&robot, before, (BodyId::Base, impulse));
        let by_drives = jump.work_of_drives(before, robot.joints());
        self.book(Source::JointDrives, &Booking::of_work(by_drives));
        self.book(source, &Booking::of_work(jump.energy - by_drives));
    }

    /// Let the propellant go that thrusters have burnt since the last time. The twists of all bodies
    /// stay: what leaves goes as a body would that is let go, with the tank's velocity. The thrust itself
    /// is a force from outside.
    pub(crate) fn expel_propellant(&mut self) {
        for number in 0..self.systems.len() {
            let Some(system) = &mut self.systems[number] else { continue };
            let wanted = std::mem::take(&mut system.burnt);
            let mut tanks = system.effectors.iter_mut().filter_map(|e| e.tank());
            let Some(tank) = tanks.next() else { continue };
            let (position_B, dm) = (tank.position_B, tank.draw(wanted));
            if dm > 0.0 {
                self.lighten(number, position_B, dm);
            }
        }
    }

    /// Take a point mass (kg) out of the base.
    fn lighten(&mut self, number: usize, position_B: Vec3<f64>, dm: f64) {
        let t = self.clock.into_period;
        let Some(system) = &mut self.systems[number] else { return };
        let mut configuration = Configuration::new();
        let state = system.expand(&system.row, &system.quat_NB, t, &mut configuration);
        let p_N = state.X_NB.point(position_B);
        let v_N = state.X_NB.rotation * state.V_NB_B.shifted_by(position_B).linear;
        let away = v_N * dm;
        let work = if system.slosh.is_some() {
            system.settle_slosh(&state, (p_N, away, dm), t)
        } else {
            system.weigh();
            let p_cm = kinematics(&system.robot, &state).centre_of_mass().1;
            let (_, linear, angular) = system.momentum();
            system.set_momentum(p_cm, linear - away, angular - p_N.cross(away));
            -0.5 * dm * v_N.dot(v_N)
        };
        let lost = SpatialForce::new(-p_N.cross(away), -away);
        self.book(Source::Propellant, &Booking::of_wrench(&lost, work));
        self.propellant += dm;
    }

    /// Propellant that thrusters have asked for in a stretch in which nothing breaks, from `from` to `to`
    /// (s into the period).
    pub(crate) fn burn(&mut self, from: f64, to: f64) {
        for system in self.systems.iter_mut().flatten() {
            system.burnt += system.effectors.iter().map(|e| e.propellant(from, to)).sum::<f64>();
        }
    }
}
