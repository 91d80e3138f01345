//! From the truth through the sensors to what the flight computer is given.

use crate::applied_wrench::felt;
use crate::case::Case;
use crate::case_world::CaseWorld;
use wrasse_dynamics::{Frame, kinematics};
use wrasse_flight::{BaseReading, JointReading, Sensed};
use wrasse_hardware::Sensors;
use wrasse_spatial::Quat;
use wrasse_vehicle::JOINTS;
use wrasse_world::SensorSuite;

/// The sensors of a flight; without any they are perfect.
#[derive(Debug)]
pub(crate) struct Sensing {
    suite: Option<(Sensors<f64>, SensorSuite)>,
    /// Whether the star tracker saw nothing in the last period, for the base turned too fast.
    pub(crate) blinded: bool,
    /// Attitude of the base when they were read last.
    pub(crate) sensed_at: Quat<f64>,
}

impl Sensing {
    pub(crate) fn new(case: &Case) -> Self {
        let suite = case.sensors.map(|sensors| (sensors, SensorSuite::new(sensors, case.seed)));
        Self { suite, blinded: false, sensed_at: Quat::identity() }
    }

    /// What the sensors say now; `tool` has the force-torque sensor.
    pub(crate) fn read(
        &mut self,
        case: &Case,
        world: &CaseWorld,
        tool: &Frame<f64>,
    ) -> Sensed<f64, JOINTS> {
        let (state, period) = (world.rigid_state(), case.period());
        self.sensed_at = world.quat_NB();
        let mut perfect = Sensed::perfect(&state, world.actuator_readings());
        if case.measures_wrench {
            let truth = world.state();
            let k = kinematics(world.robot(), &truth);
            perfect.tool_wrench_E = Some(felt(&case.wrenches, tool, world.time(), &k));
        }
        let Some((sensors, suite)) = &mut self.suite else { return perfect };
        let (quat_NB, w_NB_B) = (world.quat_NB(), state.V_NB_B.angular);
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
