//! From the truth through the sensors to what the flight computer is given.

use crate::applied_wrench::felt;
use crate::mission::Case;
use wrasse_dynamics::kinematics;
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

    /// What the sensors say now.
    pub(crate) fn read(&mut self, case: &Case, world: &World<JOINTS>) -> Sensed<f64, JOINTS> {
        let (state, period) = (world.state(), case.period());
        let mut perfect = Sensed::perfect(&state, world.actuator_readings());
        if case.feels_wrench {
            let k = kinematics(world.robot(), &state);
            let tool = &case.setup.assignment.tool;
            perfect.tool_wrench_E = Some(felt(&case.wrenches, tool, world.time(), &k));
        }
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
        let joints = if sensors.encoder_step > 0.0 {
            JointReading::Encoders(read.q)
        } else {
            perfect.joints
        };
        Sensed { base, joints, ..perfect }
    }
}
