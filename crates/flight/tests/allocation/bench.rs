//! A bench for steering: a base that is turned as told, with actuators that do what they are told, or
//! nearly. Not the simulated world: a few lines that can be read at once.

use wrasse_flight::allocation::{
    Allocation, AllocationSetup, Allocator, CmgLaw, Demand, Desaturation, Modulation, WheelLaw,
};
use wrasse_hardware::{
    ActuatorCommand, ActuatorReadings, Actuators, CMGS, ControlMomentGyro, List, ReactionWheel,
    Thruster, WHEELS,
};
use wrasse_spatial::{SpatialForce, Vec3, vec3};
use wrasse_testing::largest;

/// Control period (s).
pub(crate) const PERIOD: f64 = 0.02;

/// Four wheels of 60 N·m·s, tilted alike out of the y-z plane.
pub(crate) fn wheels(torque_limit: f64) -> Vec<ReactionWheel<f64>> {
    let third = 3.0_f64.sqrt().recip();
    let tilted = |y: f64, z: f64| ReactionWheel {
        axis_B: vec3(third, third * y, third * z),
        inertia: 0.1,
        torque_limit,
        speed_limit: 600.0,
        ..ReactionWheel::default()
    };
    vec![tilted(1.0, 1.0), tilted(-1.0, 1.0), tilted(-1.0, -1.0), tilted(1.0, -1.0)]
}

/// A pyramid of four CMGs of 15 N·m·s, 0.8 rad/s.
pub(crate) fn cmgs() -> Vec<ControlMomentGyro<f64>> {
    let cmg = |gimbal: [f64; 3], spin: [f64; 3]| ControlMomentGyro {
        gimbal_axis_B: Vec3::from_array(gimbal),
        spin_axis_B: Vec3::from_array(spin),
        momentum: 15.0,
        rate_limit: 0.8,
        ..ControlMomentGyro::default()
    };
    vec![
        cmg([0.8, 0.0, 0.6], [0.0, 1.0, 0.0]),
        cmg([0.0, 0.8, 0.6], [-1.0, 0.0, 0.0]),
        cmg([-0.8, 0.0, 0.6], [0.0, -1.0, 0.0]),
        cmg([0.0, -0.8, 0.6], [1.0, 0.0, 0.0]),
    ]
}

/// Three thrusters at each corner of a box, pushing inwards: any torque, any force.
pub(crate) fn thrusters(force: f64) -> Vec<Thruster<f64>> {
    let mut set = vec![];
    for corner in 0..8_u32 {
        let side = |bit: u32| if corner >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let (x, y, z) = (side(0), side(1), side(2));
        for push in [vec3(-x, 0.0, 0.0), vec3(0.0, -y, 0.0), vec3(0.0, 0.0, -z)] {
            set.push(Thruster {
                position_B: vec3(x, 0.8 * y, 0.7 * z),
                direction_B: push,
                force,
                minimum_on_time: 0.03,
                specific_impulse: 230.0,
                ..Thruster::default()
            });
        }
    }
    set
}

pub(crate) fn actuators(
    wheels: &[ReactionWheel<f64>],
    cmgs: &[ControlMomentGyro<f64>],
    thrusters: &[Thruster<f64>],
) -> Actuators<f64> {
    Actuators {
        wheels: List::new(wheels),
        cmgs: List::new(cmgs),
        thrusters: List::new(thrusters),
        tank: None,
    }
}

/// The plainest laws; thrusters hold the position.
pub(crate) fn setup(actuators: &Actuators<f64>) -> AllocationSetup<f64> {
    AllocationSetup {
        actuators: *actuators,
        wheels: WheelLaw::default(),
        cmgs: CmgLaw::default(),
        modulation: Modulation { gain: 10.0, lag: 1.0, on_level: 0.45, off_level: 0.15 },
        holds_position: true,
        desaturation: None,
    }
}

pub(crate) fn desaturation() -> Desaturation<f64> {
    Desaturation { target_B: Vec3::zero(), gain: 0.1, start: 10.0, stop: 2.0, active: false }
}

/// Torque and force wanted of a base that stands still, its centre of mass beside the origin.
pub(crate) fn demand(torque: [f64; 3], force: [f64; 3]) -> Demand<f64> {
    Demand {
        wanted: SpatialForce::new(Vec3::from_array(torque), Vec3::from_array(force)),
        w_NB_B: Vec3::zero(),
        p_BScm_B: vec3(0.13, -0.21, 0.08),
        period: PERIOD,
    }
}

/// Steering and what it steers.
pub(crate) struct Bench {
    pub(crate) allocator: Allocator<f64>,
    pub(crate) actuators: Actuators<f64>,
    pub(crate) readings: ActuatorReadings<f64>,
    /// What a bearing takes of its motor's torque (N·m).
    pub(crate) friction: [f64; WHEELS],
    /// Bandwidth of the gimbal servos (rad/s); infinite: they answer at once.
    pub(crate) servo: f64,
    /// A gimbal that does not move, whatever it is told.
    pub(crate) stuck: Option<usize>,
    pub(crate) last: Allocation<f64>,
}

impl Bench {
    pub(crate) fn new(setup: &AllocationSetup<f64>) -> Self {
        Self {
            allocator: Allocator::new(setup),
            actuators: setup.actuators,
            readings: ActuatorReadings::default(),
            friction: [0.0; WHEELS],
            servo: f64::INFINITY,
            stuck: None,
            last: Allocation::nothing(),
        }
    }
    /// Momentum inside, base axes (N·m·s).
    pub(crate) fn stored(&self) -> Vec3<f64> {
        self.actuators.wheel_momentum(&self.readings.wheel_speed)
            + self.actuators.cmg_momentum(&self.readings.gimbal_angle)
    }
    /// One period; the mean torque (N·m) and force (N) that the bodies feel of it, about the centre
    /// of mass: what the momentum inside loses, its gyroscopic torque, and the pulses.
    pub(crate) fn step(&mut self, demand: &Demand<f64>) -> SpatialForce<f64> {
        self.last = self.allocator.allocate(demand, &self.readings);
        let before = self.stored();
        self.obey(demand.period);
        let change = (self.stored() - before) * (1.0 / demand.period);
        let inside = -change - demand.w_NB_B.cross(before);
        pulses(&self.actuators, &self.last.command, demand)
            + SpatialForce::new(inside, Vec3::zero())
    }
    fn obey(&mut self, period: f64) {
        let (told, readings) = (&self.last.command, &mut self.readings);
        for (k, wheel) in self.actuators.wheels.iter().enumerate() {
            let torque = told.wheel_torque[k] - self.friction[k];
            readings.wheel_speed[k] += torque / wheel.inertia * period;
        }
        for k in (0..CMGS).filter(|&k| self.stuck != Some(k)) {
            // A lag of first order, solved over the period.
            let left = (-self.servo * period).exp();
            let behind = readings.gimbal_rate[k] - told.gimbal_rate[k];
            let lag = if self.servo.is_finite() { (1.0 - left) / self.servo } else { 0.0 };
            readings.gimbal_angle[k] += told.gimbal_rate[k] * period + behind * lag;
            readings.gimbal_rate[k] = told.gimbal_rate[k] + behind * left;
        }
    }
}

/// Mean torque and force of the pulses over a period, about the centre of mass.
pub(crate) fn pulses(
    actuators: &Actuators<f64>,
    told: &ActuatorCommand<f64>,
    demand: &Demand<f64>,
) -> SpatialForce<f64> {
    let each = actuators.thrusters.iter().zip(told.thruster_on);
    let (mut about_origin, mut force) = (Vec3::zero(), Vec3::zero());
    for (thruster, on) in each {
        let push = thruster.direction_B * (thruster.force * on / demand.period);
        force += push;
        about_origin += thruster.position_B.cross(push);
    }
    // Moved from the base's origin to the centre of mass as a whole.
    SpatialForce::new(about_origin - demand.p_BScm_B.cross(force), force)
}

/// What the CMGs' momentum changes by at these gimbal rates, by differences (N·m).
pub(crate) fn cmg_torque(
    actuators: &Actuators<f64>,
    angles: &[f64; CMGS],
    rates: &[f64; CMGS],
) -> Vec3<f64> {
    let h = 1e-4;
    let at = |t: f64| {
        let moved: [f64; CMGS] = std::array::from_fn(|k| angles[k] + rates[k] * t);
        actuators.cmg_momentum(&moved)
    };
    (at(h) - at(-h)) * (0.5 / h)
}

/// Largest element of a vector of numbers: one that is none would pass for small.
#[track_caller]
pub(crate) fn size(v: Vec3<f64>) -> f64 {
    let each = v.to_array();
    assert!(each.iter().all(|x| x.is_finite()), "{v:?}");
    largest(each.into_iter().map(f64::abs))
}
