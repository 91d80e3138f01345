//! The ledger: momentum and energy, summed over the bodies one by one, against what was booked by
//! those who act. It reads poses and twists, never the momentum that the integrator carries; what a
//! twist is worth is for the energy to say, for twists follow from that momentum.

use crate::free_body::FreeBody;
use crate::propellant::Carried;
use crate::world::World;
use wrasse_dynamics::{Kinematics, PerBody, Robot, State, kinematics, kinetic_energy};
use wrasse_spatial::{Pose, Real, SpatialInertia, SpatialVelocity, Vec3};

/// Momentum and energy at one instant, from poses and twists alone.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Account<T = f64> {
    /// Linear momentum of everything (N·s).
    pub linear: Vec3<T>,
    /// Angular momentum of everything about the common centre of mass (N·m·s).
    pub angular: Vec3<T>,
    /// Kinetic energy of everything (J), but for the spin of wheels and rotors: what their motors
    /// spend on that is not on the bodies.
    pub energy: T,
    /// Sum of the bodies' absolute linear momenta (N·s): the scale of the linear rest.
    pub linear_scale: T,
    /// Sum of the bodies' absolute angular momenta about the centre of mass (N·m·s).
    pub angular_scale: T,
    /// Of the angular momentum: what the wheels have beside the base, inertial axes (N·m·s).
    pub in_wheels: Vec3<T>,
    /// Of the angular momentum: what the CMGs have beside the base, inertial axes (N·m·s).
    pub in_cmgs: Vec3<T>,
    /// Common centre of mass (m).
    pub centre_of_mass: Vec3<T>,
}

/// The books of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Ledger {
    /// At the start.
    pub start: Account,
    /// Now.
    pub now: Account,
    /// Angular impulse that the attitude actuator gave the bodies (N·m·s).
    pub angular_from_actuator: Vec3<f64>,
    /// Angular impulse from outside about the common centre of mass (N·m·s).
    pub angular_from_outside: Vec3<f64>,
    /// Impulse from outside (N·s).
    pub linear_from_outside: Vec3<f64>,
    /// Angular impulse of the thrusters about the common centre of mass (N·m·s).
    pub angular_from_thrusters: Vec3<f64>,
    /// Impulse of the thrusters (N·s).
    pub linear_from_thrusters: Vec3<f64>,
    /// What the propellant took with it as it left the tank.
    pub propellant: Carried,
    /// Work on the bodies: of the joint drives, of whatever turns and pushes the base, from outside
    /// (J).
    pub work: Vec3<f64>,
    /// Energy change at grasps and releases (J).
    pub energy_at_grasps: f64,
    /// Largest unexplained rests so far: angular (N·m·s), linear (N·s), energy (J).
    pub worst: [f64; 3],
    /// Largest scales so far: angular (N·m·s), linear (N·s), energy (J).
    pub scale: [f64; 3],
}

/// One body in the books: mass (kg), centre of mass (m), linear momentum (N·s), angular momentum about
/// its centre of mass (N·m·s), inertial axes.
#[derive(Debug, Clone, Copy, Default)]
struct Part<T> {
    mass: T,
    p_cm: Vec3<T>,
    linear: Vec3<T>,
    angular: Vec3<T>,
}

impl<T: Real> Part<T> {
    /// A body of the vehicle; nothing where it weighs nothing.
    #[inline(always)]
    fn of(M: &SpatialInertia<T>, X_NB: &Pose<T>, V_NB_B: &SpatialVelocity<T>) -> Self {
        let h_B = *M * *V_NB_B;
        let p_BBcm_B = M.centre_of_mass();
        let weighs = T::zero().lt(M.mass);
        let if_it_weighs =
            |v: Vec3<T>| Vec3::from_array(v.to_array().map(|x| T::select(weighs, x, T::zero())));
        Self {
            mass: M.mass,
            p_cm: if_it_weighs(X_NB.point(p_BBcm_B)),
            linear: if_it_weighs(X_NB.rotation * h_B.force),
            angular: if_it_weighs(X_NB.rotation * h_B.about(p_BBcm_B).torque),
        }
    }
}

/// A free body in the books: from its twist, like every other body.
fn part(body: &FreeBody) -> Part<f64> {
    let (M, R_NT) = (body.matter.M_F_F, body.pose().rotation);
    let h_T = M * body.twist();
    let about_cm = h_T.about(M.centre_of_mass()).torque;
    Part { mass: M.mass, p_cm: body.p_NTcm_N, linear: R_NT * h_T.force, angular: R_NT * about_cm }
}

/// The bodies of a vehicle, one by one.
#[inline(always)]
fn own<T: Real, const J: usize>(k: &Kinematics<'_, T, J>) -> PerBody<Part<T>, J> {
    let (X_NB, V_NB_B) = (k.poses(), k.twists());
    let mut own = PerBody::filled(Part::default());
    for body in k.robot.bodies() {
        own[body] = Part::of(k.robot.inertia(body), &X_NB[body], &V_NB_B[body]);
    }
    own
}

/// Bodies of a vehicle and those beside it, added up.
#[inline(always)]
fn together<T: Real, const J: usize, I: Iterator<Item = Part<T>>>(
    robot: &Robot<T, J>,
    own: &PerBody<Part<T>, J>,
    beside: impl Fn() -> I,
    energy: T,
) -> Account<T> {
    // Once for the common centre of mass, once about it: nothing needs to be kept.
    let parts = || robot.bodies().map(|body| own[body]).chain(beside());
    let mass = parts().fold(T::zero(), |sum, p| sum + p.mass);
    let moment = parts().fold(Vec3::zero(), |s, p| s + p.p_cm * p.mass);
    let centre_of_mass = moment * (T::one() / mass);
    let mut account = Account { energy, centre_of_mass, ..Account::default() };
    for Part { p_cm, linear, angular, .. } in parts() {
        let angular = angular + (p_cm - centre_of_mass).cross(linear);
        account.linear += linear;
        account.angular += angular;
        account.linear_scale += linear.norm();
        account.angular_scale += angular.norm();
    }
    account
}

impl<const J: usize> World<J> {
    /// Momentum and energy of everything, body by body.
    pub fn account(&self) -> Account {
        let state = self.state();
        let k = kinematics(&self.robot, &state);
        let energies = self.free.iter().map(FreeBody::kinetic_energy);
        let energy = energies.fold(kinetic_energy(&k), |sum, energy| sum + energy);
        let mut account = together(&self.robot, &own(&k), || self.free.iter().map(part), energy);
        self.add_wheels_and_cmgs(&state, &mut account);
        account
    }
    /// Each wheel from its speed and the base's, each CMG from its gimbal.
    fn add_wheels_and_cmgs(&self, state: &State<f64, J>, account: &mut Account) {
        let (w_NB_B, R_NB, s) = (state.V_NB_B.angular, state.X_NB.rotation, &self.system);
        let speed = self.wheels.speeds(&s.wheel_momentum, w_NB_B);
        for h_B in self.wheels.apart_B(self.wheels.momenta(&speed, w_NB_B)) {
            account.in_wheels += R_NB * h_B;
            account.angular_scale += h_B.norm();
        }
        for h_B in self.cmgs.apart_B(s.gimbal_angle, s.gimbal_rate) {
            account.in_cmgs += R_NB * h_B;
            account.angular_scale += h_B.norm();
        }
        account.angular += account.in_wheels + account.in_cmgs;
    }
    /// Open the books.
    pub fn open_ledger(&self) -> Ledger {
        Ledger::opened(self.account())
    }
    /// Bring the books up to now.
    pub fn update_ledger(&self, ledger: &mut Ledger) {
        ledger.propellant = self.carried;
        ledger.energy_at_grasps = self.energy_at_grasps;
        ledger.angular_from_outside = self.booked.from_outside;
        ledger.linear_from_outside = self.booked.outside_impulse;
        ledger.angular_from_thrusters = self.booked.from_thrusters;
        ledger.linear_from_thrusters = self.booked.thruster_impulse;
        ledger.book(self.account(), self.booked.from_actuator, self.booked.work);
    }
}

impl Ledger {
    /// Books that begin with this.
    pub(crate) fn opened(start: Account) -> Self {
        Self {
            start,
            now: start,
            scale: [start.angular_scale, start.linear_scale, start.energy],
            ..Self::default()
        }
    }
    /// Bring the books up to now: with the actuator's angular impulse (N·m·s) and the work (J).
    pub(crate) fn book(&mut self, now: Account, from_actuator: Vec3<f64>, work: Vec3<f64>) {
        (self.now, self.angular_from_actuator, self.work) = (now, from_actuator, work);
        let rests = self.rests();
        let scales = [
            self.now.angular_scale.max(self.angular_from_actuator.norm()),
            self.now.linear_scale,
            self.now.energy.max(self.work.norm()),
        ];
        for i in 0..3 {
            self.worst[i] = self.worst[i].max(rests[i]);
            self.scale[i] = self.scale[i].max(scales[i]);
        }
    }
    /// What nobody booked: angular (N·m·s), linear (N·s), energy (J).
    pub fn rests(&self) -> [f64; 3] {
        let angular = self.now.angular
            - self.start.angular
            - self.angular_from_actuator
            - self.angular_from_outside
            - self.angular_from_thrusters
            + self.propellant.angular;
        let linear = self.now.linear
            - self.start.linear
            - self.linear_from_outside
            - self.linear_from_thrusters
            + self.propellant.linear;
        let [joints, actuator, outside] = self.work.to_array();
        let energy = self.now.energy
            - self.start.energy
            - (joints + actuator + outside)
            - self.energy_at_grasps
            + self.propellant.energy;
        [angular.norm(), linear.norm(), energy.abs()]
    }
}

#[cfg(test)]
mod tests {
    use crate::{BaseAttitude, Drive, Equipment, FreeBody, Ledger, Stepper, World, WorldSetup};
    use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, MassProperties, Robot, State};
    use wrasse_hardware::ActuatorCommand;
    use wrasse_spatial::{Pose, SpatialVelocity, Sym3, Vec3, vec3};

    /// A base with one arm, moving; flown for a second under a joint torque and an actuator torque.
    fn flown(spoil: impl Fn(&mut World<1>)) -> Ledger {
        let base = MassProperties::from_central(50.0, Vec3::zero(), Sym3::diagonal(4.0, 5.0, 6.0));
        let arm =
            MassProperties::from_central(5.0, vec3(0.4, 0.0, 0.1), Sym3::diagonal(0.1, 0.3, 0.3));
        let mount = Pose { translation: vec3(0.5, 0.2, 0.0), ..Pose::identity() };
        let joint = Joint::new(BodyId::Base, JointKind::Revolute, mount, vec3(0.1, 0.3, 1.0));
        let robot: Robot<f64, 1> = Robot::new(base, &[(joint, arm)]).unwrap();
        let mut world = World::new(&WorldSetup {
            robot: &robot,
            limits: &[],
            actuator: None,
            equipment: Equipment::default(),
            base: BaseAttitude::Controlled,
            stepper: Stepper::Fixed { step: 0.01 },
            start: State {
                v: [0.2],
                V_NB_B: SpatialVelocity::from_array([0.02, -0.01, 0.03, 0.1, 0.0, -0.1]),
                ..State::default()
            },
            held: &[],
        });
        let mut ledger = world.open_ledger();
        for _ in 0..100 {
            world.command(
                &[Drive::Effort(0.3)],
                vec3(0.1, -0.2, 0.1),
                &ActuatorCommand::default(),
                0.01,
            );
            world.advance(0.01).unwrap();
        }
        spoil(&mut world);
        world.update_ledger(&mut ledger);
        ledger
    }

    /// Rests: angular (N·m·s), linear (N·s), energy (J).
    fn rests(spoil: impl Fn(&mut World<1>)) -> [f64; 3] {
        flown(spoil).rests()
    }

    /// Within what the honest run leaves of energy, 2.6e-12 J, beside 1e-6.
    #[track_caller]
    fn near(found: f64, expected: f64) {
        assert!((found / expected - 1.0).abs() < 1e-5, "rest {found:e}, expected {expected:e}");
    }

    /// Measured: 3.0e-16 N·m·s, 2.8e-16 N·s, and the quadrature of the work, 2.6e-12 J.
    #[test]
    fn an_honest_run_leaves_no_rest() {
        let [angular, linear, energy] = rests(|_| ());
        assert!(angular < 1e-14 && linear < 1e-14, "{angular:e} {linear:e}");
        assert!(energy < 1e-11, "{energy:e}");
    }

    /// The ledger sums the bodies: momentum that appears in them without a booking is its rest, as
    /// large as it is.
    #[test]
    fn momentum_that_nobody_booked_is_a_rest() {
        let angular = rests(|world| world.system.angular.y += 1e-6);
        near(angular[0], 1e-6);
        let linear = rests(|world| world.system.linear.x -= 1e-6);
        near(linear[1], 1e-6);
        assert!(angular[1] < 1e-12 && linear[0] < 1e-12, "{angular:?} {linear:?}");
    }

    /// And the other way round: a booking without a change of the bodies.
    #[test]
    fn a_booking_without_a_cause_is_a_rest() {
        near(rests(|world| world.booked.from_actuator.z += 1e-6)[0], 1e-6);
        near(rests(|world| world.booked.from_outside.z -= 1e-6)[0], 1e-6);
        near(rests(|world| world.booked.outside_impulse.y += 1e-6)[1], 1e-6);
        near(rests(|world| world.booked.from_thrusters.x += 1e-6)[0], 1e-6);
        near(rests(|world| world.booked.thruster_impulse.z -= 1e-6)[1], 1e-6);
        near(rests(|world| world.carried.angular.x += 1e-6)[0], 1e-6);
        near(rests(|world| world.carried.linear.x += 1e-6)[1], 1e-6);
        near(rests(|world| world.carried.energy += 1e-6)[2], 1e-6);
        near(rests(|world| world.booked.work.x += 1e-6)[2], 1e-6);
        near(rests(|world| world.energy_at_grasps -= 1e-6)[2], 1e-6);
    }

    /// The base's twist is found from the momentum, so what goes wrong inside the vehicle changes no
    /// momentum: the base gives way. The energy tells. A joint rate jumps:
    #[test]
    fn a_joint_rate_that_jumps_is_a_rest_of_energy_alone() {
        let [angular, linear, energy] = rests(|world| world.system.v[0] += 1e-3);
        assert!(energy > 1e-5, "energy rest {energy:e}");
        assert!(angular < 1e-12 && linear < 1e-12, "{angular:e} {linear:e}");
    }

    /// Matter grows on the arm:
    #[test]
    fn matter_that_nobody_brought_is_a_rest_of_energy_alone() {
        let [angular, linear, energy] = rests(|world| {
            let more = MassProperties::from_central(0.01, vec3(0.8, 0.0, 0.0), Sym3::zero());
            let arm = Frame { body: BodyId::Link(0), X_BF: Pose::identity() };
            world.robot = world.robot.with_payload(&arm, &more);
        });
        assert!(energy > 1e-5, "energy rest {energy:e}");
        assert!(angular < 1e-12 && linear < 1e-12, "{angular:e} {linear:e}");
    }

    /// What was once unexplained stays in the books, though it be gone again.
    #[test]
    fn the_worst_rest_is_kept() {
        let mut ledger = flown(|world| world.system.angular.x += 1e-3);
        let worst = ledger.worst[0];
        near(worst, 1e-3);
        ledger.now.angular.x -= 1e-3;
        assert!(ledger.rests()[0] < 1e-12);
        assert_eq!(ledger.worst[0], worst);
    }

    /// Two bodies in one place that fly and spin against each other: no momentum, twice the scale.
    #[test]
    fn the_scale_is_the_sum_of_what_each_body_has() {
        let matter =
            MassProperties::from_central(10.0, Vec3::zero(), Sym3::diagonal(4.0, 4.0, 4.0));
        let robot: Robot<f64, 1> = Robot::new(matter, &[]).unwrap();
        let (V, o) =
            (SpatialVelocity::from_array([0.5, 0.0, 0.0, 0.0, 0.25, 0.0]), Pose::identity());
        let mut world = World::new(&WorldSetup {
            robot: &robot,
            limits: &[],
            actuator: None,
            equipment: Equipment::default(),
            base: BaseAttitude::Free,
            stepper: Stepper::Fixed { step: 0.01 },
            start: State { V_NB_B: V, ..State::default() },
            held: &[],
        });
        world.add_free_body(FreeBody::new(matter, &o, &-V));
        let account = world.account();
        assert_eq!((account.angular, account.linear), (Vec3::zero(), Vec3::zero()));
        assert_eq!((account.angular_scale, account.linear_scale), (4.0, 5.0));
        assert_eq!(account.energy, 2.0 * (0.5 * 4.0 * 0.25 + 0.5 * 10.0 * 0.0625));
    }
}
