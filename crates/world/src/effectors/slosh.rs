//! Liquid that swings in the tank: a pendulum on two joints behind those of the vehicle.
//!
//! Its dynamics are the tree's, so whatever the tree conserves it conserves. Here is what the tree does
//! not know: what damps and restores the pendulum, and what becomes of it as propellant leaves. How heavy
//! and how long it is at a fill level is in `slosh_pendulum.rs`.

use super::{Effector, Load, SloshPendulum, Stage, TankWithPropellant};
use crate::scene::{Scene, SystemId};
use crate::setup::Drive;
use crate::source::Source;
use crate::system::System;
use wrasse_dynamics::{
    BodyId, Configuration, Joint, JointKind, MassProperties, Robot, State, kinematics,
    kinetic_energy,
};
use wrasse_hardware::{ActuatorReadings, SetPointMotion, Slosh, Tank};
use wrasse_spatial::{Mat3, Pose, Quat, Sym3, Vec3, turned_by, vec3};

/// Angle of the second joint beyond which its coordinates begin anew (rad): at a quarter turn the first
/// joint's axis goes through the bob.
const FAR: f64 = 0.5;

/// A tank in which the propellant swings.
#[derive(Debug, Clone)]
pub struct SloshingTank {
    /// What is in it; it leaves at the bottom.
    tank: TankWithPropellant,
    slosh: Slosh,
    /// Centre of the propellant at the start (m).
    centre_B: Vec3<f64>,
    /// `None` once it is too shallow to swing.
    pendulum: Option<SloshPendulum>,
    /// Number of its first joint.
    joint: usize,
    /// Attitude of the frame F in which the rod at zero angles hangs along -z.
    quat_BF: Quat<f64>,
}

/// A joint and what it carries.
type Link = (Joint<f64>, MassProperties<f64>);

impl SloshingTank {
    /// Hanging along its axis, by joints that have numbers from `joint` on; `None` if nothing swings.
    pub(crate) fn new(tank: &Tank<f64>, slosh: &Slosh, joint: usize) -> Option<Self> {
        let pendulum = SloshPendulum::of(slosh, tank.propellant)?;
        let bottom_B = tank.position_B - slosh.axis_B * slosh.centre_height(tank.propellant);
        Some(Self {
            tank: TankWithPropellant { position_B: bottom_B, mass: tank.propellant },
            slosh: *slosh,
            centre_B: tank.position_B,
            pendulum: Some(pendulum),
            joint,
            quat_BF: from_z_to(slosh.axis_B),
        })
    }
    /// Number of its first joint; the other is the next.
    pub(crate) fn first_joint(&self) -> usize {
        self.joint
    }
    /// The whole propellant, as if it did not swing, where it was at the start.
    pub(crate) fn at_rest(&self) -> MassProperties<f64> {
        MassProperties::from_central(self.tank.mass, self.centre_B, Sym3::zero())
    }
    /// Its two joints: about x of F, then about y, with what swings on the second.
    fn links(&self) -> [Link; 2] {
        let (mass, length, height) = match &self.pendulum {
            Some(p) => (p.mass, p.length, p.hinge_height),
            None => (0.0, 0.0, 0.0),
        };
        let hinge_B = self.tank.position_B + self.slosh.axis_B * height;
        let (x, y) = (vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0));
        let joint = |parent, X, axis| Joint::new(parent, JointKind::Revolute, X, axis);
        let bob = MassProperties::from_central(mass, vec3(0.0, 0.0, -length), Sym3::zero());
        let on = BodyId::Link(self.joint);
        [
            (
                joint(BodyId::Base, Pose::from_quat(self.quat_BF, hinge_B), x),
                MassProperties::default(),
            ),
            (joint(on, Pose::identity(), y), bob),
        ]
    }
    /// The robot with its links behind the others.
    ///
    /// # Panics
    /// If the robot has no room for them.
    pub(crate) fn hung_on<const J: usize>(&self, robot: &Robot<f64, J>) -> Robot<f64, J> {
        let of = |body| MassProperties {
            M_F_F: *robot.inertia(body),
            I_parts_F: *robot.inertia_of_parts(body),
        };
        let (own, n) = (self.links(), robot.joint_count());
        assert!(n + own.len() <= J, "{n} joints: no room for the two by which propellant swings");
        let links: [Link; J] = core::array::from_fn(|j| match j {
            j if j < n => (*robot.joint(j), of(BodyId::Link(j))),
            j => own[(j - n).min(1)],
        });
        let hung = Robot::new(of(BodyId::Base), &links[..n + own.len()]);
        hung.unwrap_or_else(|_| unreachable!("there is room, and parents come first"))
    }
    /// Let coordinates begin anew where the rod has swung far: the same rod, moving the same way.
    fn recentre(&mut self, [q1, q2]: [f64; 2], v: [f64; 2]) -> Option<[f64; 2]> {
        if q2.abs() < FAR {
            return None;
        }
        let rod = Rod::of([q1, q2], v);
        let R_FG = rod.R_FG;
        self.quat_BF = turned_by(turned_by(self.quat_BF, vec3(q1, 0.0, 0.0)), vec3(0.0, q2, 0.0));
        let w_G = R_FG.transpose_mul(rod.w);
        Some([w_G.x, w_G.y])
    }
}

/// A rotation that takes z to an axis.
fn from_z_to(axis: Vec3<f64>) -> Quat<f64> {
    let z = vec3(0.0, 0.0, 1.0);
    let across = z.cross(axis);
    let angle = libm::atan2(across.norm(), axis.z);
    let about =
        if across.norm() > 0.0 { across * (1.0 / across.norm()) } else { vec3(1.0, 0.0, 0.0) };
    Quat::exp(about * angle)
}

/// The rod at joint angles (rad) and rates (rad/s), all in F axes.
struct Rod {
    /// Axes of the joints.
    axes: [Vec3<f64>; 2],
    /// Attitude of the second link.
    R_FG: Mat3<f64>,
    /// From the hinge to the bob.
    along: Vec3<f64>,
    /// How it turns against the base.
    w: Vec3<f64>,
}

impl Rod {
    fn of(q: [f64; 2], v: [f64; 2]) -> Self {
        let (s1, c1) = (libm::sin(q[0]), libm::cos(q[0]));
        let (s2, c2) = (libm::sin(q[1]), libm::cos(q[1]));
        let axes = [vec3(1.0, 0.0, 0.0), vec3(0.0, c1, s1)];
        let R_FG = Mat3::from_rows(
            vec3(c2, 0.0, s2),
            vec3(s1 * s2, c1, -s1 * c2),
            vec3(-c1 * s2, s1, c1 * c2),
        );
        let along = -(R_FG * vec3(0.0, 0.0, 1.0));
        Self { axes, R_FG, along, w: axes[0] * v[0] + axes[1] * v[1] }
    }
}

impl<const J: usize> Effector<J> for SloshingTank {
    fn source(&self) -> Source {
        Source::Slosh
    }
    fn acts_on_held_base(&self) -> bool {
        true
    }
    /// On the rod the torque `k u × d - c (w - u (u·w))`: what it does across itself, for a rod does not turn about
    /// its own line. `u` is its direction, `d` that at rest.
    fn act(&self, at: &Stage<'_, J>, _own: &[f64], load: &mut Load<'_, J>, _rates: &mut [f64]) {
        let (Some(pendulum), j) = (&self.pendulum, self.joint) else { return };
        let v = [at.state.v[j], at.state.v[j + 1]];
        let Rod { axes, along, w, .. } = Rod::of([at.state.q[j], at.state.q[j + 1]], v);
        let down_F = -self.quat_BF.to_matrix().transpose_mul(self.slosh.axis_B);
        let across = w - along * along.dot(w);
        let torque = along.cross(down_F) * self.slosh.stiffness - across * pendulum.damping;
        for i in 0..2 {
            load.drive(j + i, v[i], axes[i].dot(torque));
        }
    }
    /// What does not swing.
    fn mass_properties(&self) -> Option<MassProperties<f64>> {
        let (mass, height) = match &self.pendulum {
            Some(p) => (p.rest_mass, p.rest_height),
            None => (self.tank.mass, self.slosh.centre_height(self.tank.mass)),
        };
        let p_B = self.tank.position_B + self.slosh.axis_B * height;
        Some(MassProperties::from_central(mass, p_B, Sym3::zero()))
    }
    fn read(&self, _own: &[f64], _w_NB_B: Vec3<f64>, readings: &mut ActuatorReadings<f64>) {
        readings.propellant = self.tank.mass;
    }
    fn tank(&mut self) -> Option<&mut TankWithPropellant> {
        Some(&mut self.tank)
    }
    fn slosh(&self) -> Option<&SloshingTank> {
        Some(self)
    }
    fn slosh_mut(&mut self) -> Option<&mut SloshingTank> {
        Some(self)
    }
}

impl<const J: usize> System<J> {
    /// The tank in which the propellant swings.
    pub(crate) fn slosh(&self) -> Option<&SloshingTank> {
        self.effectors.get(self.slosh?)?.slosh()
    }
    fn slosh_mut(&mut self) -> Option<&mut SloshingTank> {
        self.effectors.get_mut(self.slosh?)?.slosh_mut()
    }
    /// Where the coordinates of the swing are in the row: angles, rates.
    fn slosh_places(&self, first: usize) -> [usize; 4] {
        let (q, v) = (self.variables.q().start + first, self.variables.v().start + first);
        [q, q + 1, v, v + 1]
    }
    fn recentre_slosh(&mut self) {
        let Some(first) = self.slosh().map(SloshingTank::first_joint) else { return };
        let places = self.slosh_places(first);
        let [q1, q2, v1, v2] = places.map(|at| self.row[at]);
        let Some(slosh) = self.slosh_mut().filter(|s| s.pendulum.is_some()) else { return };
        let Some([w1, w2]) = slosh.recentre([q1, q2], [v1, v2]) else { return };
        for (at, x) in places.into_iter().zip([0.0, 0.0, w1, w2]) {
            (self.row[at], self.carry[at]) = (x, 0.0);
        }
        self.weigh();
    }
    /// Propellant `dm` (kg) has gone from `p_N` with the momentum `away`: the pendulum is that of what is left,
    /// which went to its place within the tank, so that centre of mass and momentum of what is left
    /// continue, and with them the joints. The change of the kinetic energy (J) is returned.
    ///
    /// Once it is too shallow it swings no more: that, too, is between liquid and tank.
    pub(crate) fn settle_slosh(
        &mut self,
        state: &State<f64, J>,
        (p_N, away, dm): (Vec3<f64>, Vec3<f64>, f64),
        t: f64,
    ) -> f64 {
        let before = kinetic_energy(&kinematics(&self.robot, state));
        let (mass, (p_cm, linear, angular)) = (self.mass, self.momentum());
        let Some(slosh) = self.slosh_mut() else { return 0.0 };
        let first = slosh.joint;
        let swung = slosh.pendulum.is_some();
        slosh.pendulum = slosh.pendulum.and(SloshPendulum::of(&slosh.slosh, slosh.tank.mass));
        if swung && slosh.pendulum.is_none() {
            let places = self.slosh_places(first);
            for (at, joint) in places.into_iter().zip([first, first + 1]) {
                self.drives[joint] = Drive::Follow(SetPointMotion::still(self.row[at]));
            }
        }
        self.weigh();
        let left = (p_cm * mass - p_N * dm) * (1.0 / self.mass);
        self.set_momentum(left, linear - away, angular - p_N.cross(away));
        let after = self.expand(&self.row, &self.quat_NB, t, &mut Configuration::new());
        kinetic_energy(&kinematics(&self.robot, &after)) - before
    }
}

impl<const J: usize> Scene<J> {
    /// Angle of the pendulum by which propellant swings from the axis of its tank (rad), up to half a turn;
    /// `None` where nothing swings.
    pub fn slosh_angle(&self, id: SystemId) -> Option<f64> {
        let system = self.system(id);
        let slosh = system.slosh().filter(|slosh| slosh.pendulum.is_some())?;
        let [q1, q2, v1, v2] = system.slosh_places(slosh.joint).map(|at| system.row[at]);
        let along_B = slosh.quat_BF.to_matrix() * Rod::of([q1, q2], [v1, v2]).along;
        let down_B = -slosh.slosh.axis_B;
        Some(libm::atan2(along_B.cross(down_B).norm(), along_B.dot(down_B)))
    }
    /// Before a step: no pendulum is where its coordinates end.
    pub(crate) fn recentre_slosh(&mut self) {
        self.systems.iter_mut().flatten().for_each(System::recentre_slosh);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_hardware::TankShape;

    const TANK: Slosh = Slosh {
        axis_B: Vec3 { x: 0.0, y: 0.0, z: 1.0 },
        shape: TankShape::UprightCylinder { radius: 0.7, height: 2.0 },
        density: 1010.0,
        damping_ratio: 0.01,
        acceleration: 0.3,
        stiffness: 0.0,
    };

    /// Coordinates that begin anew describe the same rod: where it is, and how fast its end moves.
    /// Measured 2e-16.
    #[test]
    fn coordinates_that_begin_anew_are_of_the_same_rod() {
        let tank = Tank { position_B: Vec3::zero(), propellant: 500.0 };
        let mut slosh = SloshingTank::new(&tank, &TANK, 0).unwrap();
        let seen = |slosh: &SloshingTank, q, v| {
            let (rod, R) = (Rod::of(q, v), slosh.quat_BF.to_matrix());
            (R * rod.along, R * rod.w.cross(rod.along))
        };
        let (q, v) = ([-0.4, 1.3], [0.7, -0.9]);
        let before = seen(&slosh, q, v);
        let fresh = slosh.recentre(q, v).unwrap();
        let after = seen(&slosh, [0.0; 2], fresh);
        assert!((before.0 - after.0).norm() < 1e-15 && (before.1 - after.1).norm() < 1e-15);
        assert_eq!(slosh.recentre([3.0, 0.4], v), None, "the first joint may turn as it likes");
    }

    /// A film lies on the bottom, half its depth up; what is left of a pendulum hangs where it was.
    #[test]
    fn a_film_lies_on_the_bottom() {
        let tank = Tank { position_B: vec3(0.1, 0.2, 0.3), propellant: 500.0 };
        let axis = vec3(0.48, 0.6, 0.64);
        let mut film = SloshingTank::new(&tank, &Slosh { axis_B: axis, ..TANK }, 0).unwrap();
        let depth = 500.0 / (1010.0 * std::f64::consts::PI * 0.49);
        let bottom = tank.position_B - axis * (0.5 * depth);
        (film.pendulum, film.tank.mass) = (None, 50.0);
        let matter = Effector::<2>::mass_properties(&film).unwrap().M_F_F;
        assert_eq!(matter.mass, 50.0);
        let off = matter.centre_of_mass() - (bottom + axis * (0.05 * depth));
        assert!(off.norm() < 1e-15, "{off:?}");
    }

    #[test]
    fn the_axis_of_the_tank_is_z_of_the_hinge() {
        for axis in [vec3(0.48, 0.6, 0.64), vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, -1.0)] {
            let z = from_z_to(axis).to_matrix() * vec3(0.0, 0.0, 1.0);
            assert!((z - axis).norm() < 1e-15, "{z:?}");
        }
    }
}
