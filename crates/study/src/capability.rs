//! What a set of actuators can hold and give.

use crate::bounds::Bounds;
use crate::envelope::{Piece, Solid, steering_reach, thruster_torque};
use wrasse_hardware::{CMGS, ControlMomentGyro, Thruster};
use wrasse_spatial::Vec3;
use wrasse_vehicle::Equipment;

/// What a set of actuators can hold and give, in base axes.
#[derive(Debug, Clone)]
pub struct Capability {
    /// Whether it gives any torque and holds any momentum: the reference.
    pub ideal: bool,
    /// Momentum of wheels and CMGs on top of what they hold at the start (N·m·s).
    pub momentum: Solid,
    /// Momentum of the wheels alone, on top of what they hold at the start (N·m·s).
    pub wheel_momentum: Solid,
    /// Torque of wheels and CMGs with the gimbals at their best (N·m).
    pub torque: Solid,
    /// Torque of the wheels alone (N·m).
    pub wheel_torque: Solid,
    /// The CMGs, and their gimbal angles at the start (rad).
    pub cmgs: Vec<ControlMomentGyro<f64>>,
    /// Gimbal angles at the start (rad).
    pub gimbal_angle: [f64; CMGS],
    /// The thrusters.
    pub thrusters: Vec<Thruster<f64>>,
    /// Centre of mass that thrusters turn the vehicle about, in the base's frame (m).
    pub p_BScm_B: Vec3<f64>,
    /// Propellant at the start (kg); none if the file has no tank.
    pub propellant: Option<f64>,
}

impl Capability {
    /// Anything at all, at once and without end.
    pub fn ideal() -> Self {
        Self { ideal: true, ..Self::of(&Equipment::default(), Vec3::zero()) }
    }
    /// Of the actuators on a base; `p_BScm_B` (m) is the centre of mass of the whole vehicle.
    pub fn of(equipment: &Equipment, p_BScm_B: Vec3<f64>) -> Self {
        let actuators = &equipment.actuators;
        let wheels = actuators.wheels.iter().zip(equipment.wheel_speed);
        // A wheel that turns already has less left one way and more the other.
        let momentum_of_wheels = wheels.flat_map(|(wheel, speed)| {
            let ends = [wheel.speed_limit - speed, -wheel.speed_limit - speed];
            ends.map(|end| Piece::OneSided { end: wheel.axis_B * (wheel.inertia * end) })
        });
        let torque_of_wheels =
            actuators.wheels.iter().map(|w| Piece::Segment { half: w.axis_B * w.torque_limit });
        let rotors = |size: fn(&ControlMomentGyro<f64>) -> f64| {
            let disc = move |g: &ControlMomentGyro<f64>| Piece::Disc {
                axis: g.gimbal_axis_B,
                radius: size(g),
            };
            Solid { pieces: actuators.cmgs.iter().map(disc).collect() }
        };
        let wheel_torque = Solid { pieces: torque_of_wheels.collect() };
        let wheel_momentum = Solid { pieces: momentum_of_wheels.collect() };
        let held = Solid { pieces: held_by(&actuators.cmgs, &equipment.gimbal_angle) };
        Self {
            ideal: false,
            momentum: wheel_momentum.with(&rotors(|cmg| cmg.momentum)).with(&held),
            wheel_momentum,
            torque: wheel_torque.with(&rotors(ControlMomentGyro::torque_limit)),
            wheel_torque,
            cmgs: actuators.cmgs.to_vec(),
            gimbal_angle: equipment.gimbal_angle,
            thrusters: actuators.thrusters.to_vec(),
            p_BScm_B,
            propellant: actuators.tank.map(|tank| tank.propellant),
        }
    }
    /// Whether there is no end to the momentum that can be taken: that of thrusters leaves the vehicle.
    /// Wheels and CMGs beside them still have an end for what couples do not take.
    pub fn is_unbounded(&self) -> bool {
        self.ideal || (!self.thrusters.is_empty() && self.momentum.is_empty())
    }
    /// Whether thrusters stand beside wheels or CMGs.
    pub fn is_hybrid(&self) -> bool {
        !self.thrusters.is_empty() && !self.momentum.is_empty()
    }
    /// Largest torque along the unit vector `d` with the gimbals at the start, and with the gimbals at
    /// their best (N·m). Thrusters give couples if they can.
    pub fn torque_along(&self, d: Vec3<f64>) -> Bounds<f64> {
        let plain = self.torque_at(&self.gimbal_angle, d);
        if self.ideal {
            return Bounds { plain, best: f64::INFINITY };
        }
        Bounds { plain, best: self.torque.radius(d) + self.couple(d) }
    }
    /// Largest torque along the unit vector `d` at gimbal angles (N·m).
    pub fn torque_at(&self, angles: &[f64; CMGS], d: Vec3<f64>) -> f64 {
        if self.ideal {
            return f64::INFINITY;
        }
        let turning = self.cmgs.iter().zip(angles).map(|(cmg, &angle)| Piece::Segment {
            half: cmg.torque_axis(angle) * cmg.torque_limit(),
        });
        let cmgs = Solid { pieces: turning.collect() };
        self.wheel_torque.with(&cmgs).radius(d) + self.couple(d)
    }
    /// Most momentum along the unit vector `d` (N·m·s): with plain steering from the start, and up to
    /// the surface.
    pub fn momentum_along(&self, d: Vec3<f64>) -> Bounds<f64> {
        if self.is_unbounded() {
            return Bounds::equal(f64::INFINITY);
        }
        let best = self.momentum.radius(d);
        if self.cmgs.is_empty() {
            return Bounds::equal(best);
        }
        let plain = steering_reach(&self.cmgs, &self.gimbal_angle, d).momentum;
        Bounds { plain: (plain + self.wheel_momentum.radius(d)).min(best), best }
    }
    /// Largest torque of the thrusters: a couple, or with the force that comes of it if the set can make
    /// no couple (N·m).
    pub(crate) fn couple(&self, d: Vec3<f64>) -> f64 {
        if self.thrusters.is_empty() {
            return 0.0;
        }
        let torque = thruster_torque(&self.thrusters, self.p_BScm_B, d);
        if torque.couple > 0.0 { torque.couple } else { torque.with_force }
    }
}

/// What CMGs hold already: what is left is counted from there. Nothing where it is round-off.
fn held_by(cmgs: &[ControlMomentGyro<f64>], angles: &[f64; CMGS]) -> Vec<Piece> {
    let all: f64 = cmgs.iter().map(|cmg| cmg.momentum).sum();
    let each = cmgs.iter().zip(angles).map(|(cmg, &a)| cmg.spin_axis(a) * cmg.momentum);
    let held = each.fold(Vec3::zero(), |sum, h| sum + h);
    if held.norm() > 1e-9 * all { vec![Piece::Shift { by: -held }] } else { vec![] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::envelope::pyramid::pyramid;
    use wrasse_hardware::{List, ReactionWheel};
    use wrasse_spatial::vec3;

    const X: Vec3<f64> = vec3(1.0, 0.0, 0.0);

    #[test]
    fn a_wheel_that_turns_already_has_less_left_one_way() {
        let mut equipment = Equipment::default();
        equipment.actuators.wheels = List::new(&[ReactionWheel {
            axis_B: X,
            inertia: 0.1,
            torque_limit: 0.2,
            speed_limit: 500.0,
            ..Default::default()
        }]);
        equipment.wheel_speed[0] = 200.0;
        let capability = Capability::of(&equipment, Vec3::zero());
        let [on, back] = [X, -X].map(|d| capability.momentum_along(d).best);
        assert!((on - 30.0).abs() < 1e-12 && (back - 70.0).abs() < 1e-12, "{on} {back}");
        assert_eq!(capability.torque_along(X), Bounds::equal(0.2));
    }

    /// From zero angles the pyramid gives 2 cos β of torque and of momentum along x, at best 2 + 2 cos β.
    #[test]
    fn cmgs_reach_less_with_plain_steering_than_at_most() {
        let mut equipment = Equipment::default();
        let cmgs = pyramid(0.6, 50.0).map(|cmg| ControlMomentGyro { rate_limit: 0.8, ..cmg });
        equipment.actuators.cmgs = List::new(&cmgs);
        let capability = Capability::of(&equipment, Vec3::zero());
        let (torque, momentum) = (capability.torque_along(X), capability.momentum_along(X));
        // Measured 0.
        assert!(
            (torque.plain - 48.0).abs() < 1e-12 && (torque.best - 128.0).abs() < 1e-9,
            "{torque:?}"
        );
        // It ends some milliradians before the surface. Measured 2e-3.
        assert!(
            (momentum.plain - 60.0).abs() < 5e-3 && (momentum.best - 160.0).abs() < 1e-9,
            "{momentum:?}"
        );
    }

    /// Two of the four gimbals turned against each other tilt two rotors the same way.
    #[test]
    fn cmgs_that_hold_momentum_at_the_start_have_less_left_one_way() {
        let mut equipment = Equipment::default();
        equipment.actuators.cmgs = List::new(&pyramid(0.6, 50.0));
        let at_rest = Capability::of(&equipment, Vec3::zero()).momentum_along(X).best;
        equipment.gimbal_angle[..4].copy_from_slice(&[0.5, 0.0, -0.5, 0.0]);
        let held = equipment.actuators.cmgs.iter().zip(equipment.gimbal_angle);
        let held = held.fold(Vec3::zero(), |sum, (g, a)| sum + g.spin_axis(a) * g.momentum);
        let capability = Capability::of(&equipment, Vec3::zero());
        let d = held * (1.0 / held.norm());
        let [on, back] = [d, -d].map(|d| capability.momentum_along(d).best);
        assert!(held.norm() > 10.0 && at_rest > 100.0, "{held:?}");
        // The surface is as far forth as back. Measured 0.
        assert!((back - on - 2.0 * held.norm()).abs() < 1e-6, "{on} {back} {held:?}");
    }

    #[test]
    fn wheels_beside_cmgs_add_what_they_hold_to_plain_steering() {
        let mut equipment = Equipment::default();
        equipment.actuators.cmgs = List::new(&pyramid(0.6, 50.0));
        let alone = Capability::of(&equipment, Vec3::zero()).momentum_along(X).plain;
        equipment.actuators.wheels = List::new(&[ReactionWheel {
            axis_B: X,
            inertia: 0.1,
            torque_limit: 0.2,
            speed_limit: 500.0,
            ..Default::default()
        }]);
        let both = Capability::of(&equipment, Vec3::zero()).momentum_along(X).plain;
        assert!((both - alone - 50.0).abs() < 1e-9, "{alone} {both}");
    }

    #[test]
    fn the_reference_is_never_at_its_end() {
        let capability = Capability::ideal();
        assert_eq!(capability.torque_along(X).plain, f64::INFINITY);
        assert_eq!(capability.momentum_along(X).best, f64::INFINITY);
    }
}
