//! One system: a robot on a base that nothing holds, what drives it and what is bolted to it. A rigid
//! body is a system without joints.

use crate::effectors::{Cmgs, Effector, SloshingTank, TankWithPropellant, Thrusters, Wheels};
use crate::integrate::add_compensated;
use crate::setup::{BaseAttitude, Drive, SystemSetup};
use crate::variables::{Variables, put_vector, vector};
use std::fmt;
use wrasse_dynamics::{
    BaseRows, BodyId, Configuration, Frame, JointDrive, MassProperties, Robot, State, configure,
    kinematics, momentum,
};
use wrasse_hardware::{AttitudeActuator, Follower, JointLimits, follow, follow_rates};
use wrasse_spatial::{Pose, Quat, SpatialForce, SpatialVelocity, Vec3, turned_by};

/// What is held in a grip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Held {
    /// The frame that holds it.
    pub frame: Frame<f64>,
    /// Its mass properties, seen from there.
    pub matter: MassProperties<f64>,
}

/// A system of the scene.
///
/// Its state is attitude, joints, centre of mass and total momentum in inertial axes, the angular one
/// about the origin of N; the base's twist follows from them, less what wheels and CMGs hold. So only
/// what comes from outside can change momentum, at any step size.
pub(crate) struct System<const J: usize> {
    /// With its propellant, by which it may have two joints more, and what it holds. Where it has wheels,
    /// their inertia about their axes is not in its base: they turn by themselves.
    pub(crate) robot: Robot<f64, J>,
    /// Without payloads and propellant.
    pub(crate) dry: Robot<f64, J>,
    /// The robot as if its propellant did not swing, where it does.
    pub(crate) rigid: Option<Box<Robot<f64, J>>>,
    pub(crate) held: Vec<Option<Held>>,
    pub(crate) limits: [JointLimits<f64>; J],
    pub(crate) actuator: Option<AttitudeActuator<f64>>,
    pub(crate) base: BaseAttitude,
    /// (kg)
    pub(crate) mass: f64,
    pub(crate) drives: [Drive; J],
    /// Joints without a drive: each moves as its leader does.
    pub(crate) followers: Vec<Follower<f64>>,
    /// Torque of the ideal attitude actuator (N·m, base axes).
    pub(crate) actuator_torque_B: Vec3<f64>,
    pub(crate) effectors: Vec<Box<dyn Effector<J>>>,
    /// Number of the effector that is a tank in which the propellant swings.
    pub(crate) slosh: Option<usize>,
    /// Propellant that thrusters have asked for and that is still on board (kg).
    pub(crate) burnt: f64,
    pub(crate) variables: Variables,
    pub(crate) quat_NB: Quat<f64>,
    /// The variables, and what rounding took from their last sums, to be given back in the next.
    pub(crate) row: Vec<f64>,
    pub(crate) carry: Vec<f64>,
}

impl<const J: usize> fmt::Debug for System<J> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("System")
            .field("base", &self.base)
            .field("quat_NB", &self.quat_NB)
            .field("row", &self.row)
            .finish_non_exhaustive()
    }
}

impl<const J: usize> System<J> {
    pub(crate) fn new(setup: &SystemSetup<'_, J>) -> Self {
        let equipment = &setup.equipment;
        let (effectors, wheels) = effectors(setup);
        let mut limits = [JointLimits::default(); J];
        limits.iter_mut().zip(setup.limits).for_each(|(to, from)| *to = *from);
        let held = setup.held.iter().map(|&(frame, matter)| Some(Held { frame, matter }));
        let mut system = Self {
            robot: *setup.robot,
            dry: *setup.robot,
            rigid: None,
            held: held.collect(),
            limits,
            actuator: setup.actuator,
            base: setup.base,
            mass: 0.0,
            drives: [Drive::Effort(0.0); J],
            followers: vec![],
            actuator_torque_B: Vec3::zero(),
            slosh: effectors.iter().position(|e| e.slosh().is_some()),
            effectors,
            burnt: 0.0,
            variables: Variables::default(),
            quat_NB: Quat::from_matrix(&setup.start.X_NB.rotation),
            row: vec![],
            carry: vec![],
        };
        system.weigh();
        system.list_variables();
        system.start(&setup.start, wheels.as_ref(), equipment);
        system
    }

    /// Positions, momentum and what is stored at the start.
    fn start(
        &mut self,
        start: &State<f64, J>,
        wheels: Option<&Wheels>,
        equipment: &crate::Equipment,
    ) {
        let n = self.robot.joint_count();
        let (v, h) = (self.variables.clone(), momentum(&kinematics(&self.robot, start)));
        self.row[v.q()].copy_from_slice(&start.q[..n]);
        self.row[v.v()].copy_from_slice(&start.v[..n]);
        let mut at = 0;
        if let Some(wheels) = wheels {
            let momenta = wheels.momenta(&equipment.wheel_speed, start.V_NB_B.angular);
            self.row[v.effector(0)].iter_mut().zip(momenta).for_each(|(x, h)| *x = h);
            at = 1;
        }
        if !equipment.actuators.cmgs.is_empty() {
            let angles = &mut self.row[v.effector(at)];
            let count = equipment.actuators.cmgs.len();
            angles[..count].copy_from_slice(&equipment.gimbal_angle[..count]);
        }
        let stored_N = start.X_NB.rotation * self.stored_momentum_B(&self.row);
        let about_origin = h.angular + h.p_NScm_N.cross(h.linear) + stored_N;
        put_vector(&mut self.row, v.centre_of_mass(), h.p_NScm_N);
        put_vector(&mut self.row, v.linear(), h.linear);
        put_vector(&mut self.row, v.angular(), about_origin);
    }

    /// Add an effector; its variables begin at zero.
    pub(crate) fn add_effector(&mut self, effector: Box<dyn Effector<J>>) {
        self.effectors.push(effector);
        self.list_variables();
    }

    /// The list of variables, and room for them behind those that are there already.
    fn list_variables(&mut self) {
        let names: Vec<_> = self.effectors.iter().map(|e| e.variables()).collect();
        let (all, own) = (self.robot.joint_count(), self.dry.joint_count());
        self.variables = Variables::new(all, own, &names);
        self.row.resize(self.variables.len(), 0.0);
        self.carry.resize(self.variables.len(), 0.0);
    }

    /// An angular impulse of what holds the attitude, inertial axes (N·m·s).
    pub(crate) fn turn_by_actuator(&mut self, impulse_N: Vec3<f64>) {
        for at in [self.variables.angular(), self.variables.given()] {
            let sum = vector(&self.row, at) + impulse_N;
            put_vector(&mut self.row, at, sum);
        }
    }

    /// The robot with its effectors, its propellant and with what is in its grips.
    pub(crate) fn weigh(&mut self) {
        let hung = self.slosh().map_or(self.dry, |slosh| slosh.hung_on(&self.dry));
        self.robot = self.laden(hung, |e| e.mass_properties());
        self.mass = self.robot.mass();
        if self.slosh.is_some() {
            let at_rest = |e: &dyn Effector<J>| match e.slosh() {
                Some(slosh) => Some(slosh.at_rest()),
                None => e.mass_properties(),
            };
            let rigid = self.laden(self.dry, at_rest);
            match &mut self.rigid {
                Some(place) => **place = rigid,
                None => self.rigid = Some(Box::new(rigid)),
            }
        }
    }

    /// A robot with what its effectors weigh and with what is in the grips.
    fn laden(
        &self,
        robot: Robot<f64, J>,
        weight: impl Fn(&dyn Effector<J>) -> Option<MassProperties<f64>>,
    ) -> Robot<f64, J> {
        let base = Frame { body: BodyId::Base, X_BF: Pose::identity() };
        let own = self.effectors.iter().filter_map(|e| weight(e.as_ref()));
        let fitted = own.fold(robot, |robot, more| robot.with_payload(&base, &more));
        let held = self.held.iter().flatten();
        held.fold(fitted, |robot, h| robot.with_payload(&h.frame, &h.matter))
    }

    /// Angular momentum that the effectors store beside the bodies, base axes (N·m·s).
    pub(crate) fn stored_momentum_B(&self, row: &[f64]) -> Vec3<f64> {
        let mut sum = Vec3::zero();
        for (i, effector) in self.effectors.iter().enumerate() {
            effector.stored_momentum_B(&row[self.variables.effector(i)], &mut |h_B| sum += h_B);
        }
        sum
    }

    /// The joints' state that a row means, `t` (s) into the current set-points.
    fn joints_at(&self, row: &[f64], t: f64) -> State<f64, J> {
        let mut state = State::default();
        let (q, v) = (&row[self.variables.q()], &row[self.variables.v()]);
        for j in self.robot.joints() {
            (state.q[j], state.v[j]) = match &self.drives[j] {
                Drive::Follow(motion) => {
                    let set_point = motion.at(t);
                    (set_point.position, set_point.rate)
                }
                Drive::Effort(_) => (q[j], v[j]),
            };
        }
        follow(&self.followers, &mut state.q);
        follow_rates(&self.followers, &mut state.v);
        state
    }

    /// Pose and twist of the base and the joints' state that a row and an attitude mean, `t` (s) into
    /// the current set-points.
    pub(crate) fn expand(
        &self,
        row: &[f64],
        quat_NB: &Quat<f64>,
        t: f64,
        configuration: &mut Configuration<f64, J>,
    ) -> State<f64, J> {
        let mut state = self.joints_at(row, t);
        configure(&self.robot, &state.q, configuration);
        let v = &self.variables;
        let (R_NB, p_N) = (quat_NB.to_matrix(), vector(row, v.centre_of_mass()));
        let linear_N = vector(row, v.linear());
        let angular_N = vector(row, v.angular()) - p_N.cross(linear_N);
        let about_cm =
            SpatialForce::new(R_NB.transpose_mul(angular_N), R_NB.transpose_mul(linear_N));
        let rows = &configuration.base;
        state.V_NB_B = match self.base {
            BaseAttitude::Held => held_twist(rows, &about_cm, &state.v),
            BaseAttitude::Free | BaseAttitude::Controlled => {
                free_twist(rows, &about_cm, self.stored_momentum_B(row), &state.v)
            }
        };
        state.X_NB = Pose::new(R_NB, p_N - R_NB * rows.M_bb.centre_of_mass());
        state
    }

    /// What is given of the joints, `t` (s) into the current set-points; `beside` the drives other efforts
    /// act (N·m or N).
    pub(crate) fn joint_drives(&self, t: f64, beside: &[f64; J]) -> [JointDrive<f64>; J] {
        let mut drives = [JointDrive::Effort(0.0); J];
        for j in self.robot.joints() {
            drives[j] = match &self.drives[j] {
                Drive::Follow(motion) => JointDrive::Acceleration(motion.at(t).acceleration),
                Drive::Effort(tau) => JointDrive::Effort(*tau + beside[j]),
            };
        }
        drives
    }

    /// Add a displacement, giving back what earlier sums lost; `t` (s) is where the set-points are then.
    pub(crate) fn accept(&mut self, d: &[f64], t: f64) {
        self.quat_NB = turned_by(self.quat_NB, vector(d, 0));
        let own = self.row.iter_mut().zip(d).zip(&mut self.carry).skip(3);
        own.for_each(|((x, d), carry)| add_compensated(x, *d, carry));
        self.follow_set_points(t);
    }

    /// Joints that follow set-points are where these are at `t` (s).
    pub(crate) fn follow_set_points(&mut self, t: f64) {
        let (q, v) = (self.variables.q().start, self.variables.v().start);
        for j in self.robot.joints() {
            if let Drive::Follow(motion) = &self.drives[j] {
                let set_point = motion.at(t);
                (self.row[q + j], self.row[v + j]) = (set_point.position, set_point.rate);
                (self.carry[q + j], self.carry[v + j]) = (0.0, 0.0);
            }
        }
        self.follow_leaders();
    }
}

/// Twist of a base that is held against turning and gives way: `h` about the centre of mass, base axes.
fn held_twist<const J: usize>(
    rows: &BaseRows<f64, J>,
    h: &SpatialForce<f64>,
    qdot: &[f64; J],
) -> SpatialVelocity<f64> {
    let push = h.force - rows.momentum_of_rates(qdot).force;
    SpatialVelocity::new(Vec3::zero(), push * (1.0 / rows.M_bb.mass))
}

/// Twist of a free base: `h` about the centre of mass less what is stored beside the bodies, base axes.
fn free_twist<const J: usize>(
    rows: &BaseRows<f64, J>,
    h: &SpatialForce<f64>,
    stored_B: Vec3<f64>,
    qdot: &[f64; J],
) -> SpatialVelocity<f64> {
    let p_BScm_B = rows.M_bb.centre_of_mass();
    let stored = SpatialForce::new(stored_B, Vec3::zero());
    rows.M_bb.velocity_of(&(h.about(-p_BScm_B) - rows.momentum_of_rates(qdot) - stored))
}

/// What is fitted to a system, in the order of its variables; and the wheels, if there are any.
fn effectors<const J: usize>(
    setup: &SystemSetup<'_, J>,
) -> (Vec<Box<dyn Effector<J>>>, Option<Wheels>) {
    let fitted = &setup.equipment.actuators;
    let wheels = (!fitted.wheels.is_empty()).then(|| Wheels::new(&fitted.wheels));
    let mut all: Vec<Box<dyn Effector<J>>> = vec![];
    if let Some(wheels) = &wheels {
        all.push(Box::new(wheels.clone()));
    }
    if !fitted.cmgs.is_empty() {
        all.push(Box::new(Cmgs::new(&fitted.cmgs)));
    }
    if !fitted.thrusters.is_empty() {
        all.push(Box::new(Thrusters::new(&fitted.thrusters, setup.equipment.seed)));
    }
    if let Some(tank) = &fitted.tank {
        let joint = setup.robot.joint_count();
        let slosh = setup.equipment.slosh;
        match slosh.and_then(|slosh| SloshingTank::new(tank, &slosh, joint)) {
            Some(sloshing) => all.push(Box::new(sloshing)),
            None => all.push(Box::new(TankWithPropellant::new(tank))),
        }
    }
    (all, wheels)
}
