//! Several worlds in the lanes of the processor: vehicles of one build, each with its own masses and its
//! own way, moved by nothing but their drives and an ideal attitude actuator.

use crate::command::given_torque;
use crate::flow::Flow;
use crate::free_flight::FreeFlight;
use crate::ledger::{Account, Ledger, account};
use crate::setup::{BaseAttitude, Drive};
use crate::stepper::{Stepper, equal_steps, runge_kutta_4};
use crate::world::{SystemState, World};
use wrasse_dynamics::{Dynamics, Robot, State};
use wrasse_hardware::{AttitudeActuator, JointLimits};
use wrasse_spatial::{Instructions, Lanes, Real, SideBySide, Vec3, Work};

/// Worlds that go through time together, a lane to each, worked with the instructions `I`. Every lane
/// has the bits of its world alone.
#[derive(Debug, Clone)]
pub struct WorldsSideBySide<I: Instructions, const N: usize, const J: usize> {
    robot: Robot<Lanes<N, I>, J>,
    limits: [JointLimits<f64>; J],
    actuator: Option<AttitudeActuator<f64>>,
    base: BaseAttitude,
    /// (s)
    step: f64,
    mass: Lanes<N, I>,
    system: SystemState<J, Lanes<N, I>>,
    carry: Flow<J, Lanes<N, I>>,
    booked: Flow<J, Lanes<N, I>>,
    drives: [Drive<Lanes<N, I>>; J],
    actuator_torque_B: Vec3<Lanes<N, I>>,
    /// Time (s), and what rounding took from it.
    time: f64,
    time_carry: f64,
    period_start: f64,
    into_period: f64,
}

impl<const J: usize> World<J> {
    /// Whether drives and an ideal actuator are all that moves it, in steps of one length.
    fn is_plain(&self) -> bool {
        let equipped = !self.wheels.is_empty() || self.gyros.count() > 0;
        let fed = self.tank.is_some() || !self.thrusters.is_empty();
        let evenly = matches!(self.stepper, Stepper::Fixed { .. });
        evenly && !equipped && !fed && self.free.is_empty() && !self.is_pushed()
    }
    /// Whether another one can go beside it.
    fn goes_with(&self, other: &Self) -> bool {
        let same_drive = |j: usize| {
            matches!(
                (&self.drives[j], &other.drives[j]),
                (Drive::Follow(_), Drive::Follow(_)) | (Drive::Effort(_), Drive::Effort(_))
            )
        };
        let times = |w: &Self| [w.time, w.time_carry, w.period_start, w.into_period];
        self.limits == other.limits
            && self.actuator == other.actuator
            && (self.base, self.stepper) == (other.base, other.stepper)
            && times(self) == times(other)
            && self.robot.joints().all(same_drive)
    }
}

impl<I: Instructions, const N: usize, const J: usize> WorldsSideBySide<I, N, J> {
    /// These worlds as they are; `None` if more than drives and an ideal actuator moves them, or if
    /// they differ in more than masses and states.
    pub fn new(worlds: &[&World<J>; N]) -> Option<Self> {
        let first = worlds.first()?;
        let Stepper::Fixed { step } = first.stepper else { return None };
        if !worlds.iter().all(|world| world.is_plain() && first.goes_with(world)) {
            return None;
        }
        let drives = core::array::from_fn(|j| match first.drives[j] {
            Drive::Effort(_) => Drive::Effort(Lanes::from_fn(|i| match worlds[i].drives[j] {
                Drive::Effort(tau) => tau,
                Drive::Follow(_) => 0.0,
            })),
            Drive::Follow(own) => {
                Drive::Follow(SideBySide::side_by_side(&|i| match worlds[i].drives[j] {
                    Drive::Follow(motion) => motion,
                    Drive::Effort(_) => own,
                }))
            }
        });
        // Through a pointer, so that gathering is built once.
        let flows = |of: fn(&World<J>) -> Flow<J>| -> Flow<J, Lanes<N, I>> {
            SideBySide::side_by_side(&|i| of(worlds[i]))
        };
        Some(Self {
            robot: Robot::side_by_side(&core::array::from_fn(|i| &worlds[i].robot))?,
            limits: first.limits,
            actuator: first.actuator,
            base: first.base,
            step,
            mass: Lanes::from_fn(|i| worlds[i].mass),
            system: SideBySide::side_by_side(&|i| worlds[i].system),
            carry: flows(|world| world.carry),
            booked: flows(|world| world.booked),
            drives,
            actuator_torque_B: SideBySide::side_by_side(&|i| worlds[i].actuator_torque_B),
            time: first.time,
            time_carry: first.time_carry,
            period_start: first.period_start,
            into_period: first.into_period,
        })
    }

    fn vehicle(&self) -> FreeFlight<'_, Lanes<N, I>, J> {
        FreeFlight {
            robot: &self.robot,
            drives: &self.drives,
            base: self.base,
            mass: self.mass,
            actuator_torque_B: self.actuator_torque_B,
        }
    }
    /// Where everything is and how it moves.
    pub fn state(&self) -> State<Lanes<N, I>, J> {
        self.vehicle().expand(&self.system, Vec3::zero(), self.into_period)
    }
    /// Accelerations and forces in the state that it is in.
    pub fn dynamics(&self, state: &State<Lanes<N, I>, J>) -> Dynamics<Lanes<N, I>, J> {
        self.vehicle().bare_dynamics(state, self.into_period)
    }
    /// Bring the books of these lanes up to now, in the state that it is in.
    pub fn update_ledgers(
        &self,
        state: &State<Lanes<N, I>, J>,
        ledgers: &mut [Ledger; N],
        these: &[bool; N],
    ) {
        let now = account(&self.robot, state);
        for (i, ledger) in ledgers.iter_mut().enumerate().filter(|(i, _)| these[*i]) {
            let (impulse, work) = (self.booked.from_actuator.lane(i), self.booked.work.lane(i));
            ledger.book(now.lane(i), impulse, work);
        }
    }

    /// Set what drives the joints and turns the base for the coming period (s), within the limits.
    pub fn command(
        &mut self,
        drives: &[Drive<Lanes<N, I>>; J],
        torque_B: Vec3<Lanes<N, I>>,
        period: f64,
    ) {
        (self.period_start, self.into_period) = (self.time, 0.0);
        self.drives = *drives;
        for (drive, limits) in self.drives.iter_mut().zip(&self.limits) {
            if let (Drive::Effort(tau), Some(limit)) = (drive, limits.effort) {
                *tau = tau.clamp_to(Lanes::from_f64(limit));
            }
        }
        self.actuator_torque_B = match (self.base, self.actuator) {
            (BaseAttitude::Controlled, Some(limits)) => self.within(limits, torque_B, period),
            (BaseAttitude::Controlled, None) => torque_B,
            (BaseAttitude::Held | BaseAttitude::Free, _) => Vec3::zero(),
        };
    }

    /// The torque that the ideal actuator of each lane gives.
    fn within(
        &self,
        limits: AttitudeActuator<f64>,
        wanted_B: Vec3<Lanes<N, I>>,
        period: f64,
    ) -> Vec3<Lanes<N, I>> {
        let w_NB_B = self.state().V_NB_B.angular;
        let given: [Vec3<f64>; N] = core::array::from_fn(|i| {
            let R_NB = self.system.quat_NB.lane(i).to_matrix();
            let h_B = -R_NB.transpose_mul(self.booked.from_actuator.lane(i));
            let h = (h_B, w_NB_B.lane(i).cross(h_B));
            given_torque(&limits, wanted_B.lane(i), h, period, |_| {})
        });
        SideBySide::side_by_side(&|i| given[i])
    }

    /// Advance by the period (s) that the commands were set for. No heap is touched.
    pub fn advance(&mut self, period: f64) {
        let (count, h) = equal_steps(period, self.step);
        let mut done = 0.0;
        while done < count {
            let t0 = self.into_period + done * h;
            done += 1.0;
            // The last step ends where the period does, to the bit.
            let gone = if done < count { done * h } else { period };
            let (mut system, mut carry, mut booked) = (self.system, self.carry, self.booked);
            let sums = (&mut system, &mut carry, &mut booked);
            let t1 = self.into_period + gone;
            Lanes::<N, I>::apart(Step { vehicle: self.vehicle(), h, t0, t1, sums });
            (self.system, self.carry, self.booked) = (system, carry, booked);
        }
        self.into_period += period;
        crate::free_flight::add_with_care(&mut self.time, period, &mut self.time_carry);
    }

    /// Whether all numbers of a lane are finite.
    pub fn is_finite(&self, lane: usize) -> bool {
        let s = &self.system;
        let vectors = [s.quat_NB.vector(), s.p_NScm_N, s.linear, s.angular];
        let numbers = vectors.into_iter().flat_map(Vec3::to_array);
        let joints = self.robot.joints().flat_map(|j| [s.q[j], s.v[j]]);
        numbers.chain(joints).all(|x| x.lane(lane).is_finite())
    }

    /// Put a lane into its world, with all but its drives.
    pub fn lane_into(&self, lane: usize, world: &mut World<J>) {
        world.system = self.system.lane(lane);
        world.booked.from_actuator = self.booked.from_actuator.lane(lane);
        world.booked.work = self.booked.work.lane(lane);
        world.actuator_torque_B = self.actuator_torque_B.lane(lane);
        (world.time, world.time_carry) = (self.time, self.time_carry);
        (world.period_start, world.into_period) = (self.period_start, self.into_period);
    }
}

/// State, what its sums lost, and what is booked.
type Sums<'a, I, const N: usize, const J: usize> = (
    &'a mut SystemState<J, Lanes<N, I>>,
    &'a mut Flow<J, Lanes<N, I>>,
    &'a mut Flow<J, Lanes<N, I>>,
);

/// One step of length `h` from `t0` to `t1` (s into the set-points).
struct Step<'a, I: Instructions, const N: usize, const J: usize> {
    vehicle: FreeFlight<'a, Lanes<N, I>, J>,
    h: f64,
    t0: f64,
    t1: f64,
    sums: Sums<'a, I, N, J>,
}

impl<I: Instructions, const N: usize, const J: usize> Work for Step<'_, I, N, J> {
    type Out = ();
    #[inline(always)]
    fn run(self) {
        let Self { vehicle, h, t0, t1, sums } = self;
        let system = &*sums.0;
        let d = runge_kutta_4(h, |t, d| vehicle.rates(system, d, t0 + t));
        vehicle.move_on(sums, &d, t1);
    }
}

macro_rules! of_parts {
    ($alone:ty, $lanes:ty, [$($capacity:tt)*], $($part:ident),+) => {
        impl<I: Instructions, const N: usize $($capacity)*> SideBySide<N> for $lanes {
            type Alone = $alone;
            fn side_by_side(of: &impl Fn(usize) -> $alone) -> Self {
                Self { $($part: SideBySide::side_by_side(&|i| of(i).$part)),+ }
            }
            fn lane(&self, i: usize) -> $alone {
                Self::Alone { $($part: self.$part.lane(i)),+ }
            }
        }
    };
}
of_parts!(
    SystemState<J>, SystemState<J, Lanes<N, I>>, [, const J: usize],
    quat_NB, q, v, p_NScm_N, linear, angular, wheel_momentum, gimbal_angle, gimbal_rate
);
of_parts!(
    Flow<J>, Flow<J, Lanes<N, I>>, [, const J: usize],
    turn, q, v, p_NScm_N, linear, angular, wheel_momentum, gimbal_angle, gimbal_rate, from_actuator,
    from_outside, outside_impulse, from_thrusters, thruster_impulse, work
);
of_parts!(
    Account,
    Account<Lanes<N, I>>,
    [],
    linear,
    angular,
    energy,
    linear_scale,
    angular_scale,
    in_wheels,
    in_gyros,
    centre_of_mass
);
