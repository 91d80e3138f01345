//! The scene: systems, what couples and what surrounds them, and their motion through time.

use crate::contact::Touching;
use crate::couplings::{Coupled, Coupling, Side};
use crate::effectors::{AppliedWrench, Effector, MotorTorques};
use crate::environment::Environment;
use crate::events::Watched;
use crate::free_body::FreeBody;
use crate::integrate::{DormandPrince, RungeKutta4, Stepper};
use crate::setup::{BaseAttitude, Drive, SystemSetup};
use crate::source::{Booking, Bookings, Source};
use crate::stage::Places;
use crate::system::{Held, System};
use crate::variables::{put_vector, vector};
use std::cell::Cell;
use std::fmt;
use wrasse_dynamics::{Dynamics, Frame, Kinematics, Robot, State, kinematics};
use wrasse_hardware::ActuatorReadings;
use wrasse_spatial::{Pose, Quat, Vec3};

/// A system of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SystemId(pub(crate) usize);

/// What a system holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HeldId(pub(crate) usize);

/// A coupling of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CouplingId(pub(crate) usize);

/// Time, and where in the control period it is.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Clock {
    /// Time (s), and what rounding took from it.
    pub(crate) time: f64,
    pub(crate) carry: f64,
    /// Start of the current period (s), and how much of it has gone (s).
    pub(crate) period_start: f64,
    pub(crate) into_period: f64,
    /// How long the period before lasted (s).
    pub(crate) gone: f64,
    /// An instant in the current stretch, in which nothing breaks (s into the period).
    pub(crate) within: f64,
}

/// Systems, what couples them, what surrounds them, and the way through time. No system is privileged: a servicer, its
/// client and a rigid body that floats by itself are systems alike, and all are integrated together.
pub struct Scene<const J: usize> {
    pub(crate) systems: Vec<Option<System<J>>>,
    pub(crate) couplings: Vec<Option<Coupled>>,
    pub(crate) environment: Environment,
    pub(crate) clock: Clock,
    pub(crate) stepper: Stepper,
    /// Last accepted step of the adaptive stepper (s).
    pub(crate) last_step: f64,
    /// Impulses and work since the start, in a row, and what rounding took from their last sums.
    pub(crate) booked: Vec<f64>,
    pub(crate) booked_carry: Vec<f64>,
    /// Propellant that left (kg).
    pub(crate) propellant: f64,
    pub(crate) watched: Watched<J>,
    pub(crate) touching: Touching,
    pub(crate) runge_kutta: RungeKutta4,
    pub(crate) dormand_prince: DormandPrince,
    /// Places for the right-hand side; they are away while it is worked out.
    pub(crate) places: Cell<Option<Box<Places<J>>>>,
}

impl<const J: usize> fmt::Debug for Scene<J> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Scene")
            .field("time", &self.clock.time)
            .field("systems", &self.systems)
            .field("couplings", &self.couplings)
            .finish_non_exhaustive()
    }
}

impl<const J: usize> Scene<J> {
    /// An empty scene in free space at time zero.
    pub fn new(stepper: Stepper) -> Self {
        Self {
            systems: vec![],
            couplings: vec![],
            environment: Environment::FreeSpace,
            clock: Clock::default(),
            stepper,
            last_step: 0.01,
            booked: vec![0.0; Bookings::NUMBERS],
            booked_carry: vec![0.0; Bookings::NUMBERS],
            propellant: 0.0,
            watched: Watched::default(),
            touching: Touching::default(),
            runge_kutta: RungeKutta4::default(),
            dormand_prince: DormandPrince::default(),
            places: Cell::new(None),
        }
    }
    /// Add a system.
    ///
    /// # Panics
    /// If its propellant swings and the robot has no room for two joints more.
    pub fn add(&mut self, setup: &SystemSetup<'_, J>) -> SystemId {
        self.put(System::new(setup))
    }
    /// Add a rigid body that floats by itself.
    pub fn add_body(&mut self, body: &FreeBody) -> SystemId {
        let robot = Robot::new(body.matter, &[]).unwrap_or_else(|_| unreachable!("no joints"));
        self.add(&SystemSetup {
            robot: &robot,
            limits: &[],
            actuator: None,
            equipment: crate::Equipment::default(),
            base: BaseAttitude::Free,
            start: State { X_NB: body.pose(), V_NB_B: body.twist(), ..State::default() },
            held: &[],
        })
    }
    pub(crate) fn put(&mut self, system: System<J>) -> SystemId {
        self.systems.push(Some(system));
        self.make_room();
        SystemId(self.systems.len() - 1)
    }
    /// Couple frame E of a system to frame F of another, or of the same.
    pub fn couple(
        &mut self,
        E: impl Into<Side>,
        F: impl Into<Side>,
        by: Box<dyn Coupling>,
    ) -> CouplingId {
        let (E, F) = (E.into(), F.into());
        let variables = by.variables();
        let (row, carry) = (vec![0.0; variables], vec![0.0; variables]);
        self.couplings.push(Some(Coupled { E, F, by, row, carry }));
        self.make_room();
        CouplingId(self.couplings.len() - 1)
    }
    /// The side of a coupling that is on a payload in a grip, at a frame of the payload.
    pub fn side_of_held(&self, id: SystemId, held: HeldId, frame: Frame<f64>) -> Side {
        let at = self.system(id).held.get(held.0).and_then(Option::as_ref).map(|held| held.frame);
        let side = Side::from((id, frame));
        at.map_or(side, |at| side.on_held(id, held, &at))
    }
    /// Take a coupling away.
    pub fn uncouple(&mut self, id: CouplingId) {
        if let Some(coupled) = self.couplings.get_mut(id.0) {
            *coupled = None;
        }
        self.make_room();
    }
    /// What surrounds the systems from now on.
    pub fn set_environment(&mut self, environment: Environment) {
        self.environment = environment;
    }
    /// Let an effector act on a system from now on.
    ///
    /// # Panics
    /// If the system is part of another now.
    pub fn add_effector(&mut self, id: SystemId, effector: Box<dyn Effector<J>>) {
        self.system_mut(id).add_effector(effector);
        self.make_room();
    }
    /// A wrench from outside that acts on a system from now on.
    ///
    /// # Panics
    /// If the system is part of another now.
    pub fn apply(&mut self, id: SystemId, wrench: AppliedWrench<J>) {
        self.add_effector(id, Box::new(wrench));
    }
    /// Room for rows of all systems and for the bookings.
    pub(crate) fn make_room(&mut self) {
        let of_systems = self.systems.iter().flatten().map(|s| s.variables.len());
        let of_couplings = self.couplings.iter().flatten().map(|c| c.row.len());
        let length = of_systems.chain(of_couplings).sum::<usize>() + Bookings::NUMBERS;
        match self.stepper {
            Stepper::Fixed { .. } => self.runge_kutta = RungeKutta4::new(length),
            Stepper::Adaptive { .. } => self.dormand_prince = DormandPrince::new(length),
        }
        self.places.set(Some(Box::new(Places::new(self.systems.len(), length))));
        self.touching.any = self.couplings.iter().flatten().any(|c| c.by.contact().is_some());
        self.make_room_for_events();
    }
    /// All systems that are there.
    pub fn systems(&self) -> impl Iterator<Item = SystemId> + '_ {
        self.systems.iter().enumerate().filter(|(_, s)| s.is_some()).map(|(i, _)| SystemId(i))
    }
    /// Whether a system is there: one that was grasped is part of another.
    pub fn contains(&self, id: SystemId) -> bool {
        self.systems.get(id.0).is_some_and(Option::is_some)
    }
    #[track_caller]
    pub(crate) fn system(&self, id: SystemId) -> &System<J> {
        self.systems[id.0].as_ref().unwrap_or_else(|| panic!("system {} is part of another", id.0))
    }
    #[track_caller]
    pub(crate) fn system_mut(&mut self, id: SystemId) -> &mut System<J> {
        self.systems[id.0].as_mut().unwrap_or_else(|| panic!("system {} is part of another", id.0))
    }
    /// Time (s).
    pub fn time(&self) -> f64 {
        self.clock.time
    }
    /// Time (s), within a period too: where an event happens.
    pub fn time_within_period(&self) -> f64 {
        self.clock.period_start + self.clock.into_period
    }
    /// Impulses and work since the start.
    pub fn booked(&self) -> Bookings {
        Bookings::from_row(&self.booked)
    }
    pub(crate) fn book(&mut self, source: Source, given: &Booking) {
        Bookings::book(&mut self.booked, source, given);
    }
}

/// What is seen of a system. All of these panic if the system is part of another now.
impl<const J: usize> Scene<J> {
    /// The robot with its propellant and what it holds. Where it has wheels, their inertia about their
    /// axes is not in its base: they turn by themselves. Propellant that swings has two joints behind
    /// the robot's own.
    pub fn robot(&self, id: SystemId) -> &Robot<f64, J> {
        &self.system(id).robot
    }
    /// Where everything is and how it moves.
    pub fn state(&self, id: SystemId) -> State<f64, J> {
        let system = self.system(id);
        let mut places = self.places.take().unwrap_or_default();
        let configuration = &mut places.of(id.0).configuration;
        let t = self.clock.into_period;
        let state = system.expand(&system.row, &system.quat_NB, t, configuration);
        self.places.set(Some(places));
        state
    }
    /// The robot as if its propellant did not swing: what a flight computer takes it for that knows how
    /// much there is. It is the [`robot`](Self::robot) where none swings.
    pub fn rigid_robot(&self, id: SystemId) -> &Robot<f64, J> {
        let system = self.system(id);
        system.rigid.as_deref().unwrap_or(&system.robot)
    }
    /// The state without the joints by which propellant swings: that of the
    /// [`rigid_robot`](Self::rigid_robot).
    pub fn rigid_state(&self, id: SystemId) -> State<f64, J> {
        let (mut state, own) = (self.state(id), self.system(id).dry.joint_count());
        if self.system(id).slosh.is_some() {
            state.q[own..].fill(0.0);
            state.v[own..].fill(0.0);
        }
        state
    }
    /// Attitude of the base, `quat_NB`.
    pub fn attitude(&self, id: SystemId) -> Quat<f64> {
        self.system(id).quat_NB
    }
    /// Centre of mass, inertial axes (m).
    pub fn centre_of_mass(&self, id: SystemId) -> Vec3<f64> {
        let system = self.system(id);
        vector(&system.row, system.variables.centre_of_mass())
    }
    /// Momentum, inertial axes: linear (N·s), and angular about the origin of N (N·m·s), with what wheels and
    /// CMGs store.
    pub fn momentum(&self, id: SystemId) -> (Vec3<f64>, Vec3<f64>) {
        let (_, linear, angular) = self.system(id).momentum();
        (linear, angular)
    }
    /// All its variables but the attitude, in the order of their list.
    pub fn variables(&self, id: SystemId) -> &[f64] {
        &self.system(id).row
    }
    /// Variables of an effector, by its number.
    pub fn effector_variables(&self, id: SystemId, effector: usize) -> &[f64] {
        let system = self.system(id);
        &system.row[system.variables.effector(effector)]
    }
    /// Set variables of an effector, by its number: where it starts from.
    pub fn set_effector_variables(&mut self, id: SystemId, effector: usize, own: &[f64]) {
        let system = self.system_mut(id);
        let at = system.variables.effector(effector);
        system.carry[at.clone()].fill(0.0);
        system.row[at].copy_from_slice(own);
    }
    /// A rigid body that floats by itself; of a system with joints its base alone.
    pub fn body(&self, id: SystemId) -> FreeBody {
        let (robot, state) = (self.robot(id), self.state(id));
        let base = wrasse_dynamics::BodyId::Base;
        let matter = wrasse_dynamics::MassProperties {
            M_F_F: *robot.inertia(base),
            I_parts_F: *robot.inertia_of_parts(base),
        };
        FreeBody::new(matter, &state.X_NB, &state.V_NB_B)
    }
    /// Accelerations and forces now, with the drives as they are.
    pub fn dynamics(&self, id: SystemId) -> Dynamics<f64, J> {
        self.at_now(id).0
    }
    /// Torque of the attitude actuator on the base now (N·m, base axes), within its limits. What holds
    /// an attitude exactly is the base's entry of [`dynamics`](Self::dynamics).
    pub fn actuator_torque_B(&self, id: SystemId) -> Vec3<f64> {
        self.system(id).actuator_torque_B
    }
    /// What wheels, CMGs and tank say of themselves.
    pub fn actuator_readings(&self, id: SystemId) -> ActuatorReadings<f64> {
        let (system, w_NB_B) = (self.system(id), self.state(id).V_NB_B.angular);
        let mut readings = ActuatorReadings::default();
        for (i, effector) in system.effectors.iter().enumerate() {
            effector.read(&system.row[system.variables.effector(i)], w_NB_B, &mut readings);
        }
        readings
    }
    /// Torques of the motors of wheels and gimbals.
    pub fn motor_torques(&self, id: SystemId) -> MotorTorques {
        let system = self.system(id);
        let motion = (self.state(id).V_NB_B.angular, self.dynamics(id).nudot.base.angular);
        let mut motors = MotorTorques::default();
        for (i, effector) in system.effectors.iter().enumerate() {
            effector.motor_torques(&system.row[system.variables.effector(i)], motion, &mut motors);
        }
        motors
    }
    /// Torque on the base of what turns against it now (N·m, base axes): wheels and CMGs.
    pub fn internal_torque_B(&self, id: SystemId) -> Vec3<f64> {
        self.at_now(id).1
    }
    /// What is in the grips.
    pub fn held(&self, id: SystemId) -> impl Iterator<Item = (HeldId, &Held)> {
        let all = self.system(id).held.iter().enumerate();
        all.filter_map(|(i, held)| held.as_ref().map(|held| (HeldId(i), held)))
    }
    /// Momentum that the attitude actuator stores (N·m·s, base axes), zero at the start.
    pub fn stored_momentum_B(&self, id: SystemId) -> Vec3<f64> {
        self.system(id).actuator_momentum_B()
    }
    /// Pose `X_NF` of a frame now.
    pub fn pose(&self, id: SystemId, frame: &Frame<f64>) -> Pose<f64> {
        self.with_kinematics(id, |k| k.pose(frame))
    }
    /// Something of where the bodies are and how they move now.
    pub fn with_kinematics<R>(
        &self,
        id: SystemId,
        f: impl FnOnce(&Kinematics<'_, f64, J>) -> R,
    ) -> R {
        let state = self.state(id);
        f(&kinematics(self.robot(id), &state))
    }
}

impl<const J: usize> System<J> {
    /// Momentum that the ideal attitude actuator stores (N·m·s, base axes).
    pub(crate) fn actuator_momentum_B(&self) -> Vec3<f64> {
        let given_N = vector(&self.row, self.variables.given());
        -self.quat_NB.to_matrix().transpose_mul(given_N)
    }
    /// Change centre of mass and momentum at once.
    pub(crate) fn set_momentum(&mut self, p_N: Vec3<f64>, linear: Vec3<f64>, angular: Vec3<f64>) {
        let v = &self.variables;
        let (p, l, a) = (v.centre_of_mass(), v.linear(), v.angular());
        put_vector(&mut self.row, p, p_N);
        put_vector(&mut self.row, l, linear);
        put_vector(&mut self.row, a, angular);
    }
    /// Centre of mass, linear momentum, and angular momentum about the origin of N.
    pub(crate) fn momentum(&self) -> (Vec3<f64>, Vec3<f64>, Vec3<f64>) {
        let v = &self.variables;
        let at = |place: usize| vector(&self.row, place);
        (at(v.centre_of_mass()), at(v.linear()), at(v.angular()))
    }
    pub(crate) fn drive_is_followed(&self, j: usize) -> bool {
        matches!(self.drives[j], Drive::Follow(_))
    }
}
