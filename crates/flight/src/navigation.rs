//! From what the sensors say to the state that the laws work on.

use crate::attitude_estimator::{AttitudeEstimate, AttitudeEstimator, EstimatorSetup};
use crate::interface::{BaseReading, JointReading, Sensed};
use crate::joint_estimator::JointEstimator;
use wrasse_dynamics::State;
use wrasse_spatial::{Pose, Quat, Real, Scalar, SpatialVelocity};

/// What the navigation must know of its sensors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NavigationSetup<T> {
    /// Gyro and star tracker; `None`: attitude and rate are known.
    pub attitude: Option<EstimatorSetup<T>>,
    /// Bandwidth of the joint filters behind encoders (rad/s).
    pub joint_bandwidth: T,
    /// Attitude at the start, as far as it is known.
    pub quat_NB: Quat<T>,
}

impl<T: Real> NavigationSetup<T> {
    /// Perfect sensors: nothing to estimate.
    pub fn perfect() -> Self {
        Self { attitude: None, joint_bandwidth: T::zero(), quat_NB: Quat::identity() }
    }
}

/// Estimates of attitude and joint rates, kept from period to period.
#[derive(Debug, Clone)]
pub struct Navigation<T, const J: usize> {
    attitude: Option<AttitudeEstimator<T>>,
    last: Option<AttitudeEstimate<T>>,
    joints: Option<JointEstimator<T, J>>,
    joint_bandwidth: T,
}

impl<T: Scalar, const J: usize> Navigation<T, J> {
    /// A navigation that has seen nothing yet.
    pub fn new(setup: &NavigationSetup<T>) -> Self {
        Self {
            attitude: setup.attitude.as_ref().map(|s| AttitudeEstimator::new(s, setup.quat_NB)),
            last: None,
            joints: None,
            joint_bandwidth: setup.joint_bandwidth,
        }
    }

    /// The state that these readings speak of. `qddot` is the commanded acceleration over the
    /// last `period` (s).
    pub fn estimate(&mut self, sensed: &Sensed<T, J>, qddot: &[T; J], period: T) -> State<T, J> {
        let (X_NB, V_NB_B) = self.base(&sensed.base, period);
        let (q, v) = match &sensed.joints {
            JointReading::Known(q, v) => (*q, *v),
            JointReading::Encoders(read) => {
                let fresh = JointEstimator::new(*read, self.joint_bandwidth);
                match &mut self.joints {
                    Some(filter) => filter.step(read, qddot, period),
                    none => (none.insert(fresh), (*read, [T::zero(); J])).1,
                }
            }
        };
        State { X_NB, V_NB_B, q, v }
    }

    fn base(&mut self, reading: &BaseReading<T>, period: T) -> (Pose<T>, SpatialVelocity<T>) {
        match *reading {
            BaseReading::Known(X_NB, V_NB_B) => (X_NB, V_NB_B),
            BaseReading::Felt { rate_B, tracker, p_NB_N, v_NB_N } => {
                // The first reading comes before the first period has passed.
                let passed = if self.last.is_some() { period } else { T::zero() };
                let felt = self.attitude.as_mut().map(|e| e.step(rate_B, tracker, passed));
                self.last = felt;
                let (quat_NB, w_NB_B) =
                    felt.map_or((Quat::identity(), rate_B), |e| (e.quat_NB, e.w_NB_B));
                let X_NB = Pose::from_quat(quat_NB, p_NB_N);
                (X_NB, SpatialVelocity::new(w_NB_B, X_NB.rotation.transpose_mul(v_NB_N)))
            }
        }
    }

    /// The last estimate of the attitude, if it is estimated.
    pub fn attitude_estimate(&self) -> Option<&AttitudeEstimate<T>> {
        self.last.as_ref()
    }
}
