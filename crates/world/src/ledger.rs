//! The ledger: momentum and energy, summed over the bodies one by one, against what was booked by
//! those who act. It reads poses and twists, never the momentum that the integrator carries; what a
//! twist is worth is for the energy to say, for twists follow from that momentum.

use crate::scene::{Scene, SystemId};
use crate::source::{Bookings, Source};
use wrasse_dynamics::{kinematics, kinetic_energy};
use wrasse_spatial::{Pose, SpatialInertia, SpatialVelocity, Vec3};

/// Momentum and energy at one instant, from poses and twists alone.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Account {
    /// Linear momentum of everything (N·s).
    pub linear: Vec3<f64>,
    /// Angular momentum of everything about the origin of N (N·m·s).
    pub angular: Vec3<f64>,
    /// Kinetic energy of everything (J), but for the spin of wheels and rotors: what their motors
    /// spend on that is not on the bodies.
    pub energy: f64,
    /// Sum of the bodies' absolute linear momenta (N·s): the scale of the linear residual.
    pub linear_scale: f64,
    /// Sum of the bodies' absolute angular momenta (N·m·s).
    pub angular_scale: f64,
    /// Of the angular momentum: what wheels and CMGs have beside the base, by source, inertial axes
    /// (N·m·s).
    pub stored: [Vec3<f64>; Source::COUNT],
    /// Common centre of mass (m).
    pub centre_of_mass: Vec3<f64>,
}

/// Momentum and energy of a run, and who changed them.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Ledger {
    /// At the start.
    pub start: Account,
    /// Now.
    pub now: Account,
    /// What each source has given the bodies.
    pub sources: Bookings,
    /// Propellant that left the tank (kg).
    pub propellant: f64,
    /// Largest unexplained residuals so far: angular (N·m·s), linear (N·s), energy (J).
    pub worst: [f64; 3],
    /// Largest scales so far: angular (N·m·s), linear (N·s), energy (J).
    pub scale: [f64; 3],
}

impl Account {
    /// Add a body: its momentum about the origin of N; nothing where it weighs nothing. Its mass times
    /// its place is returned.
    fn add(
        &mut self,
        M: &SpatialInertia<f64>,
        X_NB: &Pose<f64>,
        V_NB_B: &SpatialVelocity<f64>,
    ) -> Vec3<f64> {
        if M.mass <= 0.0 {
            return Vec3::zero();
        }
        let (h_B, p_BBcm_B) = (*M * *V_NB_B, M.centre_of_mass());
        let (p_cm, linear) = (X_NB.point(p_BBcm_B), X_NB.rotation * h_B.force);
        let angular = X_NB.rotation * h_B.about(p_BBcm_B).torque + p_cm.cross(linear);
        self.linear += linear;
        self.angular += angular;
        self.linear_scale += linear.norm();
        self.angular_scale += angular.norm();
        p_cm * M.mass
    }
}

impl<const J: usize> Scene<J> {
    /// Momentum and energy of everything, body by body.
    pub fn account(&self) -> Account {
        let (mut account, mut mass, mut moment) = (Account::default(), 0.0, Vec3::zero());
        for id in self.systems() {
            moment += self.add_to(&mut account, id);
            mass += self.system(id).mass;
        }
        account.centre_of_mass = moment * (1.0 / mass);
        account
    }

    /// The bodies of a system and what its wheels and CMGs store; mass times place, all together.
    fn add_to(&self, account: &mut Account, id: SystemId) -> Vec3<f64> {
        let (system, state) = (self.system(id), self.state(id));
        let k = kinematics(&system.robot, &state);
        let (X_NB, V_NB_B) = (k.poses(), k.twists());
        let bodies = system.robot.bodies();
        let moment = bodies.fold(Vec3::zero(), |sum, body| {
            sum + account.add(system.robot.inertia(body), &X_NB[body], &V_NB_B[body])
        });
        account.energy += kinetic_energy(&k);
        for (i, effector) in system.effectors.iter().enumerate() {
            let own = &system.row[system.variables.effector(i)];
            let number = effector.source() as usize;
            effector.stored_momentum_B(own, &mut |h_B| {
                let h_N = state.X_NB.rotation * h_B;
                account.stored[number] += h_N;
                account.angular += h_N;
                account.angular_scale += h_N.norm();
            });
        }
        moment
    }

    /// A ledger that begins now.
    pub fn open_ledger(&self) -> Ledger {
        let start = self.account();
        Ledger {
            start,
            now: start,
            scale: [start.angular_scale, start.linear_scale, start.energy],
            ..Ledger::default()
        }
    }

    /// Bring a ledger up to now.
    pub fn update_ledger(&self, ledger: &mut Ledger) {
        (ledger.now, ledger.sources) = (self.account(), self.booked());
        ledger.propellant = self.propellant;
        let residuals = ledger.residuals();
        let given = &ledger.sources;
        let works = Source::ALL.map(|source| given[source].work);
        let scales = [
            ledger.now.angular_scale.max(given[Source::AttitudeActuator].angular.norm()),
            ledger.now.linear_scale,
            ledger.now.energy.max(works.iter().fold(0.0, |sum, w| sum + w * w).sqrt()),
        ];
        for i in 0..3 {
            ledger.worst[i] = ledger.worst[i].max(residuals[i]);
            ledger.scale[i] = ledger.scale[i].max(scales[i]);
        }
    }
}

impl Ledger {
    /// What no source explains: angular (N·m·s), linear (N·s), energy (J).
    pub fn residuals(&self) -> [f64; 3] {
        let given = self.sources.total();
        let angular = self.now.angular - self.start.angular - given.angular;
        let linear = self.now.linear - self.start.linear - given.linear;
        let energy = self.now.energy - self.start.energy - given.work;
        [angular.norm(), linear.norm(), energy.abs()]
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        BaseAttitude, Booking, Drive, Equipment, FreeBody, Ledger, Scene, Source, Stepper,
        SystemId, SystemSetup,
    };
    use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, MassProperties, Robot, State};
    use wrasse_hardware::ActuatorCommand;
    use wrasse_spatial::{Pose, SpatialVelocity, Sym3, Vec3, vec3};

    /// A base with one arm, moving; flown for a second under a joint torque and an actuator torque.
    fn flown(spoil: impl Fn(&mut Scene<1>)) -> Ledger {
        let base = MassProperties::from_central(50.0, Vec3::zero(), Sym3::diagonal(4.0, 5.0, 6.0));
        let arm =
            MassProperties::from_central(5.0, vec3(0.4, 0.0, 0.1), Sym3::diagonal(0.1, 0.3, 0.3));
        let mount = Pose { translation: vec3(0.5, 0.2, 0.0), ..Pose::identity() };
        let joint = Joint::new(BodyId::Base, JointKind::Revolute, mount, vec3(0.1, 0.3, 1.0));
        let robot: Robot<f64, 1> = Robot::new(base, &[(joint, arm)]).unwrap();
        let (mut scene, id) = scene(
            &robot,
            BaseAttitude::Controlled,
            State {
                v: [0.2],
                V_NB_B: SpatialVelocity::from_array([0.02, -0.01, 0.03, 0.1, 0.0, -0.1]),
                ..State::default()
            },
        );
        let (mut ledger, mut cut) = (scene.open_ledger(), vec![]);
        let told = ActuatorCommand::default();
        for _ in 0..100 {
            scene.begin_period();
            let drives = (&[Drive::Effort(0.3)][..], vec3(0.1, -0.2, 0.1));
            scene.command(id, drives, &told, 0.01, &mut cut);
            scene.advance(0.01).unwrap();
        }
        spoil(&mut scene);
        scene.update_ledger(&mut ledger);
        ledger
    }

    fn scene(
        robot: &Robot<f64, 1>,
        base: BaseAttitude,
        start: State<f64, 1>,
    ) -> (Scene<1>, SystemId) {
        let mut scene = Scene::new(Stepper::Fixed { step: 0.01 });
        let equipment = Equipment::default();
        let (limits, actuator, held) = (&[][..], None, &[][..]);
        let setup = SystemSetup { robot, limits, actuator, equipment, base, start, held };
        let id = scene.add(&setup);
        (scene, id)
    }

    /// Change the momentum that the only system carries.
    fn change(scene: &mut Scene<1>, angular: Vec3<f64>, linear: Vec3<f64>) {
        let system = scene.systems[0].as_mut().unwrap();
        let (p, l, a) = system.momentum();
        system.set_momentum(p, l + linear, a + angular);
    }

    /// Book what nobody gave.
    fn book(scene: &mut Scene<1>, source: Source, angular: f64, linear: f64, work: f64) {
        let (angular, linear) = (vec3(0.0, 0.0, angular), vec3(0.0, linear, 0.0));
        scene.book(source, &Booking { angular, linear, work });
    }

    /// Rests: angular (N·m·s), linear (N·s), energy (J).
    fn rests(spoil: impl Fn(&mut Scene<1>)) -> [f64; 3] {
        flown(spoil).residuals()
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
        let angular = rests(|scene| change(scene, vec3(0.0, 1e-6, 0.0), Vec3::zero()));
        near(angular[0], 1e-6);
        let linear = rests(|scene| change(scene, Vec3::zero(), vec3(-1e-6, 0.0, 0.0)));
        near(linear[1], 1e-6);
        assert!(angular[1] < 1e-12 && linear[0] < 1e-12, "{angular:?} {linear:?}");
    }

    /// And the other way round: a booking without a change of the bodies.
    #[test]
    fn a_booking_without_a_cause_is_a_rest() {
        for source in Source::ALL {
            near(rests(|scene| book(scene, source, 1e-6, 0.0, 0.0))[0], 1e-6);
            near(rests(|scene| book(scene, source, 0.0, -1e-6, 0.0))[1], 1e-6);
            near(rests(|scene| book(scene, source, 0.0, 0.0, 1e-6))[2], 1e-6);
        }
    }

    /// The base's twist is found from the momentum, so what goes wrong inside the vehicle changes no
    /// momentum: the base gives way. The energy tells. A joint rate jumps:
    #[test]
    fn a_joint_rate_that_jumps_is_a_rest_of_energy_alone() {
        let [angular, linear, energy] = rests(|scene| {
            let system = scene.systems[0].as_mut().unwrap();
            let rate = system.variables.v().start;
            system.row[rate] += 1e-3;
        });
        assert!(energy > 1e-5, "energy rest {energy:e}");
        assert!(angular < 1e-12 && linear < 1e-12, "{angular:e} {linear:e}");
    }

    /// Matter grows on the arm:
    #[test]
    fn matter_that_nobody_brought_is_a_rest_of_energy_alone() {
        let [angular, linear, energy] = rests(|scene| {
            let more = MassProperties::from_central(0.01, vec3(0.8, 0.0, 0.0), Sym3::zero());
            let arm = Frame { body: BodyId::Link(0), X_BF: Pose::identity() };
            let system = scene.systems[0].as_mut().unwrap();
            system.robot = system.robot.with_payload(&arm, &more);
        });
        assert!(energy > 1e-5, "energy rest {energy:e}");
        assert!(angular < 1e-12 && linear < 1e-12, "{angular:e} {linear:e}");
    }

    /// What was once unexplained stays in the books, though it be gone again.
    #[test]
    fn the_worst_rest_is_kept() {
        let mut ledger = flown(|scene| change(scene, vec3(1e-3, 0.0, 0.0), Vec3::zero()));
        let worst = ledger.worst[0];
        near(worst, 1e-3);
        ledger.now.angular.x -= 1e-3;
        assert!(ledger.residuals()[0] < 1e-12);
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
        let start = State { V_NB_B: V, ..State::default() };
        let (mut scene, _) = scene(&robot, BaseAttitude::Free, start);
        scene.add_body(&FreeBody::new(matter, &o, &-V));
        let account = scene.account();
        assert_eq!((account.angular, account.linear), (Vec3::zero(), Vec3::zero()));
        assert_eq!((account.angular_scale, account.linear_scale), (4.0, 5.0));
        assert_eq!(account.energy, 2.0 * (0.5 * 4.0 * 0.25 + 0.5 * 10.0 * 0.0625));
    }
}
