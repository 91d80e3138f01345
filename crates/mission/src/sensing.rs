//! From the truth through the sensors to what the flight computer is given.

use crate::applied_wrench::felt;
use crate::case_world::CaseWorld;
use crate::limits_passed::Passed;
use crate::mission::Case;
use wrasse_dynamics::kinematics;
use wrasse_flight::{AttitudeEstimate, BaseReading, JointReading, Sensed};
use wrasse_hardware::Sensors;
use wrasse_vehicle::JOINTS;
use wrasse_world::SensorSuite;

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
    pub(crate) fn read(&mut self, case: &Case, world: &CaseWorld) -> Sensed<f64, JOINTS> {
        let (state, period) = (world.state(), case.period());
        let mut perfect = Sensed::perfect(&state, world.actuator_readings());
        if case.measures_wrench {
            let k = kinematics(world.robot(), &state);
            let tool = &case.setup.assignment.tool;
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

/// What the attitude estimator refused, and how often it started again.
#[derive(Debug, Default)]
pub(crate) struct Refusals {
    refused: Count,
    restarts: Count,
}

/// How often something happened, and when first (s).
#[derive(Debug, Default)]
struct Count {
    all: u32,
    first: f64,
}

impl Count {
    /// Whether there are more than before.
    fn rises(&mut self, all: u32, time: f64) -> bool {
        if self.all == 0 {
            self.first = time;
        }
        let more = all > self.all;
        self.all = all;
        more
    }
}

impl Refusals {
    /// Note what the estimator says at a time (s); what is new, in words.
    pub(crate) fn note(
        &mut self,
        estimate: &AttitudeEstimate<f64>,
        time: f64,
    ) -> Vec<(Passed, String)> {
        let AttitudeEstimate { refused, restarts, .. } = *estimate;
        let mut new = vec![];
        if self.refused.rises(refused, time) {
            let text = format!(
                "the attitude estimator refuses a reading of the star tracker ({refused} since the start): \
                 it does not fit what was estimated, or is no number"
            );
            new.push((Passed::ReadingRefused, text));
        }
        if self.restarts.rises(restarts, time) {
            let text = format!(
                "the attitude estimator starts again from the star tracker ({restarts} since the \
                 start): reading after reading did not fit what it estimated"
            );
            new.push((Passed::EstimatorRestarted, text));
        }
        new
    }

    /// One sentence for each that happened.
    pub(crate) fn summary(&self) -> Vec<String> {
        let each = [
            (&self.refused, "readings of the star tracker that the attitude estimator refused"),
            (&self.restarts, "new starts of the attitude estimator from the star tracker"),
        ];
        let happened = each.into_iter().filter(|(count, _)| count.all > 0);
        happened
            .map(|(count, what)| {
                format!("{} in all, the first at {:.2} s: {what}", count.all, count.first)
            })
            .collect()
    }
}
