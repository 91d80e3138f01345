//! From the truth through the sensors to what the flight computer is given.

use crate::mission::Case;
use wrasse_flight::{BaseReading, JointReading, Sensed};
use wrasse_hardware::Sensors;
use wrasse_vehicle::JOINTS;
use wrasse_world::{SensorSuite, World};

/// The sensors of a flight; without any they are perfect.
#[derive(Debug)]
pub(crate) struct Sensing {
    suite: Option<(Sensors<f64>, SensorSuite)>,
    /// Whether the star tracker saw nothing in the last period, for the base turned too fast.
    pub(crate) blinded: bool,
}

impl Sensing {
    pub(crate) fn new(case: &Case) -> Self {
        let suite = case.sensors.map(|sensors| (sensors, SensorSuite::new(sensors, case.seed)));
        Self { suite, blinded: false }
    }

    /// What the sensors say now, with the control period (s).
    pub(crate) fn read(&mut self, world: &World<JOINTS>, period: f64) -> Sensed<f64, JOINTS> {
        let state = world.state();
        let actuators = world.actuator_readings();
        let perfect = Sensed::perfect(&state, actuators);
        let Some((sensors, suite)) = &mut self.suite else { return perfect };
        let (quat_NB, w_NB_B) = (world.system().quat_NB, state.V_NB_B.angular);
        let read = suite.read(quat_NB, w_NB_B, &state.q, world.time(), period);
        self.blinded = read.blinded;
        let base = match sensors.attitude {
            None => perfect.base,
            Some(_) => BaseReading::Felt {
                rate_B: read.w_NB_B,
                tracker: read.tracker,
                p_NB_N: state.X_NB.translation,
                v_NB_N: state.X_NB.rotation * state.V_NB_B.linear,
            },
        };
        let joints = match sensors.encoder_step > 0.0 {
            true => JointReading::Encoders(read.q),
            false => perfect.joints,
        };
        Sensed { base, joints, actuators }
    }
}
