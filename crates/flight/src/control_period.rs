//! One control period: a bounded piece of code that takes the same way whatever the numbers are.
//!
//! What decides (phases, planning, estimators, allocation) stands outside; it gives the reference, which
//! is turned into set-points and torques here.

use crate::believed_base_response::{
    base_twist_response, believed_base_response_in, joint_momentum_B, momentum_for,
};
use crate::interface::Axes;
use crate::law::{ArmLaw, Measurement};
use crate::period_command::{ControlOutput, control_law};
use crate::resolved_motion::{
    Assignment, Belief, JointUse, Resolved, ResolvedMotion, WantedMotion, resolved_motion_in,
};
use crate::setup::Setup;
use crate::trajectory::{JointSetPoint, ToolMotion};
use wrasse_dynamics::{Configuration, InverseDynamics, Robot, State, configure};
use wrasse_hardware::SetPoint;
use wrasse_spatial::{
    Mat3, Pose, Quat, Real, SpatialForce, SpatialInertia, SpatialMomentum, SpatialVelocity, Vec3,
};

/// Reference of the arm at the end of a period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ArmReference<T, const J: usize> {
    /// The tool is on a motion.
    Tool {
        /// Where it should be and how it should move.
        reference: ToolMotion<T>,
        /// The axes of the motion.
        axes: Axes,
        /// Drift towards the preferred posture (1/s).
        gain: T,
        /// How fast that changes (1/s²).
        gain_rate: T,
    },
    /// The joints are on a way.
    Joints(JointSetPoint<T, J>),
    /// The joints move on at these rates and accelerations.
    Rates {
        /// Rates (rad/s or m/s).
        qdot: [T; J],
        /// Accelerations (rad/s² or m/s²).
        qddot: [T; J],
    },
    /// The joints stand still where they were sent last.
    Still,
    /// Nothing is driven.
    Coast,
}

/// What the control periods hand on, one to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeriodMemory<T, const J: usize> {
    /// Where the law believes the vehicle to be.
    pub belief: Belief<T, J>,
    /// How it believes it to move.
    pub motion: ResolvedMotion<T, J>,
    /// The same a period before.
    pub(crate) began: ResolvedMotion<T, J>,
    /// Where the tool should be.
    pub reference: ToolMotion<T>,
    /// The axes that the reference is in.
    pub axes: Axes,
    /// Mean commanded joint acceleration over the last period (rad/s² or m/s²).
    pub acceleration: [T; J],
    /// Set-points at the start of the coming period.
    pub(crate) now: [SetPoint<T>; J],
    /// Angular momentum of the joints' motion then, on a base that does not turn (N·m·s, base axes).
    pub(crate) joint_momentum_B: Vec3<T>,
    /// Measured twist of the base less the one that the law believed in (rad/s, m/s).
    pub(crate) innovation: SpatialVelocity<T>,
    /// Whether the sensors were read once.
    pub(crate) started: bool,
    pub(crate) coasting: bool,
    /// What the joint positions give in the middle of the coming period, as the sensed motion goes on.
    pub(crate) middle: Configuration<T, J>,
    /// What they give at its end.
    end: Configuration<T, J>,
    /// A place for the forces of a motion.
    forces: InverseDynamics<T, J>,
}

impl<T: Real, const J: usize> Default for PeriodMemory<T, J> {
    fn default() -> Self {
        Self::new()
    }
}

/// One control period: from measurements and the reference to the commands of the actuators.
///
/// Neither branch nor iteration depends on a number: what it takes depends only on the robot's tree
/// and on the laws that are chosen. `sensed` is the state as measured or estimated; of the setup the
/// navigation and the allocation are not read. A wrench at the tool, if it is measured, is at the tool's
/// origin in its axes (N·m, N).
pub fn control_period<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    setup: &Setup<T, J>,
    memory: &mut PeriodMemory<T, J>,
    sensed: &State<T, J>,
    reference: &ArmReference<T, J>,
    tool_wrench_E: Option<&SpatialForce<T>>,
) -> ControlOutput<T, J> {
    memory.measurement_update(robot, setup, sensed);
    memory.control_update(robot, setup, sensed, reference, tool_wrench_E)
}

impl<T: Real, const J: usize> PeriodMemory<T, J> {
    /// Nothing is known yet: the first period takes all from what is sensed.
    pub fn new() -> Self {
        let (still, none) = ([T::zero(); J], SpatialVelocity::zero());
        let rate = Resolved { qdot: still, V_NB_B: none };
        let rest = ResolvedMotion { rate, qddot: still, A_NB_B: none };
        Self {
            belief: Belief {
                X_NB: Pose::identity(),
                q: [T::zero(); J],
                h_Scm_N: SpatialMomentum::zero(),
            },
            motion: rest,
            began: rest,
            reference: at_rest(Pose::identity()),
            axes: Axes::Inertial,
            acceleration: [T::zero(); J],
            now: [SetPoint::default(); J],
            joint_momentum_B: Vec3::zero(),
            innovation: SpatialVelocity::zero(),
            started: false,
            coasting: false,
            middle: Configuration::new(),
            end: Configuration::new(),
            forces: InverseDynamics::new(),
        }
    }

    /// Measurement update: takes over the measurements that the laws may use.
    pub(crate) fn measurement_update(
        &mut self,
        robot: &Robot<T, J>,
        setup: &Setup<T, J>,
        sensed: &State<T, J>,
    ) {
        // Torques are constant over the period, so its middle counts for them; and momentum stays, so
        // it may be taken there too. Nothing goes on before the first period.
        let half = T::from_f64(0.5) * setup.tuning.period;
        let (middle, turn_B) = if self.started {
            let middle = self.half_a_period_on(robot, sensed, half);
            let mean_B = (sensed.V_NB_B.angular + middle.V_NB_B.angular) * T::from_f64(0.5);
            (middle, mean_B * half)
        } else {
            (*sensed, Vec3::zero())
        };
        configure(robot, &middle.q, &mut self.middle);
        let measured = setup.measurement == Measurement::Base;
        if measured || !self.started {
            self.belief.X_NB = sensed.X_NB;
            let h_Scm_B = momentum_for(setup.assignment.law, &self.middle.base, &middle);
            self.belief.h_Scm_N = turned_on(&sensed.X_NB.rotation, turn_B, &h_Scm_B);
        }
        if !self.started || self.coasting {
            self.start_from(robot, setup, sensed);
        }
        if measured {
            self.innovation = sensed.V_NB_B - self.motion.rate.V_NB_B;
            self.motion.rate.V_NB_B = sensed.V_NB_B;
        }
    }

    /// What is sensed, moved on by half a period (s) with the accelerations that the law believes in, and
    /// that go on as they did over the last period: momentum is the same there to the third order. The
    /// base stays where it is.
    #[inline(always)]
    fn half_a_period_on(&self, robot: &Robot<T, J>, sensed: &State<T, J>, half: T) -> State<T, J> {
        let mut middle = *sensed;
        let quarter = T::from_f64(0.25);
        for j in robot.joints() {
            let qddot = self.motion.qddot[j];
            let gain = (qddot + (qddot - self.began.qddot[j]) * quarter) * half;
            middle.q[j] += (sensed.v[j] + gain * T::from_f64(0.5)) * half;
            middle.v[j] += gain;
        }
        let A = self.motion.A_NB_B;
        middle.V_NB_B += (A + (A - self.began.A_NB_B) * quarter) * half;
        middle
    }

    /// Begin where the joints are, with the base moving as the law says: at the start, and as long
    /// as nothing drives them.
    #[inline(always)]
    fn start_from(&mut self, robot: &Robot<T, J>, setup: &Setup<T, J>, sensed: &State<T, J>) {
        self.started = true;
        self.belief.q = sensed.q;
        for j in robot.joints() {
            self.now[j] = SetPoint { position: sensed.q[j], rate: sensed.v[j], ..self.now[j] };
        }
        let still = [T::zero(); J];
        let (end, X_BE) = self.base_response(robot, setup, &sensed.v, &still);
        self.joint_momentum_B = end.joint_momentum_B();
        self.reference = at_rest(self.belief.X_NB * X_BE);
    }

    /// The robot has become another one: take what is known of it anew.
    pub(crate) fn robot_changed(&mut self, robot: &Robot<T, J>, law: ArmLaw) {
        let believed = self.believed_state();
        let configuration = Configuration::at(robot, &believed.q);
        let M = &configuration.base;
        let h_Scm_B = momentum_for(law, M, &believed);
        self.belief.h_Scm_N = turned_on(&believed.X_NB.rotation, Vec3::zero(), &h_Scm_B);
        self.joint_momentum_B = joint_momentum_B(&M.M_bb, &M.momentum_of_rates(&believed.v));
    }

    /// Control update, after the [measurement update](Self::measurement_update): follows the reference.
    pub(crate) fn control_update(
        &mut self,
        robot: &Robot<T, J>,
        setup: &Setup<T, J>,
        sensed: &State<T, J>,
        reference: &ArmReference<T, J>,
        tool_wrench_E: Option<&SpatialForce<T>>,
    ) -> ControlOutput<T, J> {
        let period = setup.tuning.period;
        let (from, began) = (self.belief, self.motion);
        self.began = began;
        let quat_NB = Quat::from_matrix(&from.X_NB.rotation);
        self.motion.go_on(robot, &quat_NB, period, &mut self.belief);
        let (end, rate_share) = self.follow(robot, setup, reference, (&from, &began));
        self.correct_base(&quat_NB, (&from, &began), period);
        let (law, h_B) = (setup.assignment.law, self.belief.h_Scm_B());
        self.motion.rate.V_NB_B = base_twist_response(law, &end.M_B, &end.h_rates_B, &h_B);
        let now = self.now;
        for j in robot.joints() {
            self.now[j] = SetPoint {
                position: self.belief.q[j],
                rate: self.motion.rate.qdot[j],
                acceleration: self.motion.qddot[j],
            };
            self.acceleration[j] = (self.now[j].rate - now[j].rate) / period;
        }
        let joint_momentum_B = end.joint_momentum_B();
        let reaction_B = (joint_momentum_B - self.joint_momentum_B) * (T::one() / period);
        self.joint_momentum_B = joint_momentum_B;
        self.coasting = matches!(reference, ArmReference::Coast);
        if self.coasting {
            return ControlOutput::nothing(self.now, end.M_B);
        }
        let inertia = (end.M_B, reaction_B);
        let at = (sensed, &self.middle, &mut self.forces);
        let output = control_law(robot, setup, at, (&now, &self.now), inertia, tool_wrench_E);
        ControlOutput { rate_share, ..output }
    }

    /// The vehicle as the law believes it to be, and to move.
    pub fn believed_state(&self) -> State<T, J> {
        let Resolved { qdot, V_NB_B } = self.motion.rate;
        State { X_NB: self.belief.X_NB, V_NB_B, q: self.belief.q, v: qdot }
    }

    /// The vehicle as the law believes it to be a period (s) on, from its motion now alone.
    pub(crate) fn predicted(&self, robot: &Robot<T, J>, period: T) -> Belief<T, J> {
        let quat_NB = Quat::from_matrix(&self.belief.X_NB.rotation);
        let mut ahead = self.belief;
        self.motion.go_on(robot, &quat_NB, period, &mut ahead);
        ahead
    }
}

impl<T: Real, const J: usize> ResolvedMotion<T, J> {
    /// Move a belief on by a period (s), with the base turned by `quat_NB`.
    #[inline(always)]
    fn go_on(&self, robot: &Robot<T, J>, quat_NB: &Quat<T>, period: T, belief: &mut Belief<T, J>) {
        let half = T::from_f64(0.5) * period;
        for j in robot.joints() {
            let mean = self.rate.qdot[j] + self.qddot[j] * half;
            belief.q[j] += mean * period;
        }
        let mean = self.rate.V_NB_B + self.A_NB_B * half;
        belief.X_NB = moved_on(&belief.X_NB, quat_NB, &mean, period);
    }
}

impl<T: Real, const J: usize> PeriodMemory<T, J> {
    /// The joints' motion at the end of the period: the posture it ends in, and the share of the rates
    /// that the rate limits leave (–).
    #[inline(always)]
    fn follow(
        &mut self,
        robot: &Robot<T, J>,
        setup: &Setup<T, J>,
        reference: &ArmReference<T, J>,
        began: (&Belief<T, J>, &ResolvedMotion<T, J>),
    ) -> (PeriodEnd<T>, T) {
        let still = [T::zero(); J];
        let end = match reference {
            ArmReference::Tool { reference, axes, gain, gain_rate } => {
                (self.reference, self.axes) = (*reference, *axes);
                let joints = JointUse { gain: *gain, gain_rate: *gain_rate, ..setup.joints };
                let found = self.follow_tool(robot, setup, &joints);
                self.correct_joints(robot, began, setup.tuning.period);
                return found;
            }
            ArmReference::Joints(at) => {
                self.belief.q = at.q;
                self.base_response_and_rest(robot, setup, &at.v, &at.vdot)
            }
            ArmReference::Rates { qdot, qddot } => {
                self.base_response_and_rest(robot, setup, qdot, qddot)
            }
            ArmReference::Still => {
                self.belief.q = self.now.map(|s| s.position);
                self.base_response(robot, setup, &still, &still).0
            }
            ArmReference::Coast => {
                let rates = self.motion.rate.qdot;
                self.base_response(robot, setup, &rates, &still).0
            }
        };
        (end, T::one())
    }

    /// Joint motion that keeps the tool on its reference; the share of its rates that the rate limits
    /// leave (–).
    #[inline(always)]
    fn follow_tool(
        &mut self,
        robot: &Robot<T, J>,
        setup: &Setup<T, J>,
        joints: &JointUse<T, J>,
    ) -> (PeriodEnd<T>, T) {
        configure(robot, &self.belief.q, &mut self.end);
        let X_BE = self.end.posture.pose(robot, &setup.assignment.tool);
        let at = (&self.reference, self.axes);
        let wanted = self.wanted_motion(&self.belief.X_NB, setup, at, &X_BE);
        let to = Assignment { axes: self.axes, ..setup.assignment };
        let found = resolved_motion_in(robot, &to, &self.end, &self.belief, &wanted, joints);
        self.motion = found.0;
        (PeriodEnd::new(&self.end, &self.motion.rate.qdot), found.1)
    }

    /// Motion that takes a tool at `X_BE` back to a reference in these axes, with the base at `X_NB`.
    #[inline(always)]
    pub(crate) fn wanted_motion(
        &self,
        X_NB: &Pose<T>,
        setup: &Setup<T, J>,
        (reference, axes): (&ToolMotion<T>, Axes),
        X_BE: &Pose<T>,
    ) -> WantedMotion<T> {
        let X = match axes {
            Axes::Inertial => *X_NB * *X_BE,
            Axes::Base => *X_BE,
        };
        let R_error = reference.X_NE.rotation * X.rotation.transpose();
        let error = SpatialVelocity::new(
            Quat::from_matrix(&R_error).log(),
            reference.X_NE.translation - X.translation,
        );
        let back = setup.tuning.tool_gain;
        let innovation = self.innovation_at_tool(X_NB, axes, &X);
        WantedMotion {
            V_NE: reference.V_NE_N + error * back,
            // The error decays at the tool gain, but for the innovation of the base.
            Vdot_NE: reference.Vdot_NE_N - (error * back + innovation) * back,
        }
    }

    /// Twist of the tool, at `X`, that the law did not expect.
    #[inline(always)]
    fn innovation_at_tool(&self, X_NB: &Pose<T>, axes: Axes, X_NE: &Pose<T>) -> SpatialVelocity<T> {
        match axes {
            Axes::Base => SpatialVelocity::zero(),
            Axes::Inertial => SpatialVelocity::new(
                X_NB.rotation * self.innovation.angular,
                X_NB.rotation * self.innovation.linear,
            )
            .shifted_by(X_NE.translation - X_NB.translation),
        }
    }

    /// The joints once their motion at the end is known too: `Δ = h (v₀ + v₁)/2 + h² (a₀ - a₁)/12`, of
    /// fourth order, where it is what joins the set-points without a wiggle.
    #[inline(always)]
    fn correct_joints(
        &mut self,
        robot: &Robot<T, J>,
        (from, began): (&Belief<T, J>, &ResolvedMotion<T, J>),
        period: T,
    ) {
        let (half, twelfth) = (T::from_f64(0.5), T::from_f64(1.0 / 12.0) * period);
        let ended = &self.motion;
        for j in robot.joints() {
            let mean = (began.rate.qdot[j] + ended.rate.qdot[j]) * half
                + (began.qddot[j] - ended.qddot[j]) * twelfth;
            self.belief.q[j] = from.q[j] + mean * period;
        }
    }

    /// The same for the base: of second order where it turns about a changing axis.
    #[inline(always)]
    fn correct_base(
        &mut self,
        quat_NB: &Quat<T>,
        (from, began): (&Belief<T, J>, &ResolvedMotion<T, J>),
        period: T,
    ) {
        let (half, twelfth) = (T::from_f64(0.5), T::from_f64(1.0 / 12.0) * period);
        let ended = &self.motion;
        let mean = (began.rate.V_NB_B + ended.rate.V_NB_B) * half
            + (began.A_NB_B - ended.A_NB_B) * twelfth;
        self.belief.X_NB = moved_on(&from.X_NB, quat_NB, &mean, period);
    }

    /// The base answers joint motion that is given; and the pose of the tool in the base.
    #[inline(always)]
    fn base_response(
        &mut self,
        robot: &Robot<T, J>,
        setup: &Setup<T, J>,
        qdot: &[T; J],
        qddot: &[T; J],
    ) -> (PeriodEnd<T>, Pose<T>) {
        let law = setup.assignment.law;
        configure(robot, &self.belief.q, &mut self.end);
        let (at, belief) = ((&self.end, &mut self.forces), &self.belief);
        self.motion = believed_base_response_in(robot, law, at, belief, qdot, qddot);
        let X_BE = self.end.posture.pose(robot, &setup.assignment.tool);
        (PeriodEnd::new(&self.end, qdot), X_BE)
    }

    /// The same, and the tool's reference stays where that brings it.
    #[inline(always)]
    fn base_response_and_rest(
        &mut self,
        robot: &Robot<T, J>,
        setup: &Setup<T, J>,
        qdot: &[T; J],
        qddot: &[T; J],
    ) -> PeriodEnd<T> {
        let (end, X_BE) = self.base_response(robot, setup, qdot, qddot);
        self.axes = Axes::Inertial;
        self.reference = at_rest(self.belief.X_NB * X_BE);
        end
    }
}

/// What the vehicle is like at the end of a period.
struct PeriodEnd<T> {
    /// Inertia of the whole system with joints locked, about the base's origin in base axes.
    M_B: SpatialInertia<T>,
    /// Momentum of the joint rates alone, about the same (N·m·s, N·s).
    h_rates_B: SpatialMomentum<T>,
}

impl<T: Real> PeriodEnd<T> {
    #[inline(always)]
    fn new<const J: usize>(at: &Configuration<T, J>, qdot: &[T; J]) -> Self {
        Self { M_B: at.base.M_bb, h_rates_B: at.base.momentum_of_rates(qdot) }
    }
    /// Angular momentum of the joints' motion on a base that does not turn (N·m·s, base axes).
    #[inline(always)]
    fn joint_momentum_B(&self) -> Vec3<T> {
        joint_momentum_B(&self.M_B, &self.h_rates_B)
    }
}

/// A tool that stays where it is.
pub(crate) fn at_rest<T: Real>(X_NE: Pose<T>) -> ToolMotion<T> {
    let zero = SpatialVelocity::zero();
    ToolMotion { X_NE, V_NE_N: zero, Vdot_NE_N: zero }
}

/// Momentum in inertial axes, from base axes that turn (rad) before they are those of `h_B`. To the
/// second order: of a turn of 5e-3 rad in half a period, 2e-8 is left.
#[inline(always)]
fn turned_on<T: Real>(
    R_NB: &Mat3<T>,
    turn_B: Vec3<T>,
    h_B: &SpatialMomentum<T>,
) -> SpatialMomentum<T> {
    let half = T::from_f64(0.5);
    let on = |h: Vec3<T>| {
        let side = turn_B.cross(h);
        *R_NB * (h + side + turn_B.cross(side) * half)
    };
    SpatialMomentum::new(on(h_B.torque), on(h_B.force))
}

/// A pose after a period of motion with a mean twist.
#[inline(always)]
fn moved_on<T: Real>(
    X_NB: &Pose<T>,
    quat_NB: &Quat<T>,
    mean: &SpatialVelocity<T>,
    period: T,
) -> Pose<T> {
    // The translation is in axes that turn: half the turn is felt on average.
    let half = Quat::exp(mean.angular * (period * T::from_f64(0.5)));
    let R_half: Mat3<T> = half.to_matrix();
    let way: Vec3<T> = X_NB.rotation * (R_half * mean.linear) * period;
    Pose::from_quat((*quat_NB * half * half).normalized(), X_NB.translation + way)
}
