//! Control periods of many vehicles side by side: one in each lane of the processor. All are in the same
//! phase at the same time; what decides takes each lane's numbers alone.

use crate::base_control::BaseControlSetup;
use crate::computer::Setup;
use crate::control_period::{Asked, PeriodMemory};
use crate::law::Tuning;
use crate::navigation::NavigationSetup;
use crate::resolved_motion::{Assignment, Belief, JointUse, Resolved, ResolvedMotion};
use crate::trajectory::{JointSetPoint, ToolMotion};
use wrasse_dynamics::{Frame, State};
use wrasse_hardware::JointLimits;
use wrasse_spatial::{
    Instructions, Lanes, Pose, Quat, Real, SideBySide, SpatialForce, SpatialVelocity,
};

impl<const J: usize> Setup<f64, J> {
    /// The same setup over another scalar, without estimators, steering and position hold: those decide.
    pub fn bare<T: Real>(&self) -> Setup<T, J> {
        let c = T::from_f64;
        let Assignment { tool, axes, task, law, damped_below } = self.assignment;
        let tool = Frame { body: tool.body, X_BF: Pose::from_f64(&tool.X_BF) };
        let quat = self.base.quat_ND;
        let quat_ND = Quat::new(c(quat.w), c(quat.x), c(quat.y), c(quat.z));
        let (use_, tuning) = (&self.joints, &self.tuning);
        Setup {
            assignment: Assignment { tool, axes, task, law, damped_below: c(damped_below) },
            joints: JointUse {
                gain: c(use_.gain),
                gain_rate: c(use_.gain_rate),
                posture: use_.posture.map(c),
                rate_limit: use_.rate_limit.map(c),
            },
            base: BaseControlSetup::ideal(self.base.feedforward, quat_ND),
            navigation: NavigationSetup::perfect(),
            measurement: self.measurement,
            tuning: Tuning {
                period: c(tuning.period),
                tool_gain: c(tuning.tool_gain),
                joint_bandwidth: c(tuning.joint_bandwidth),
                joint_damping: c(tuning.joint_damping),
                attitude_bandwidth: c(tuning.attitude_bandwidth),
                attitude_damping: c(tuning.attitude_damping),
            },
            limits: self.limits.map(|l| JointLimits {
                travel: l.travel.map(|(lower, upper)| (c(lower), c(upper))),
                rate: l.rate.map(c),
                effort: l.effort.map(c),
            }),
        }
    }
}

/// States of `N` vehicles, one in each lane.
pub fn states_side_by_side<I: Instructions, const N: usize, const J: usize>(
    from: &[State<f64, J>; N],
) -> State<Lanes<N, I>, J> {
    SideBySide::side_by_side(&|i| from[i])
}

/// What is asked of `N` vehicles, one in each lane; `None` unless all are asked the same kind of thing.
pub fn asked_side_by_side<I: Instructions, const N: usize, const J: usize>(
    from: &[Asked<f64, J>; N],
) -> Option<Asked<Lanes<N, I>, J>> {
    match from.first()? {
        Asked::Tool { axes, .. } => tools(from, *axes),
        Asked::Joints(first) => {
            let mut all = [*first; N];
            for (to, asked) in all.iter_mut().zip(from) {
                let Asked::Joints(at) = asked else { return None };
                *to = *at;
            }
            Some(Asked::Joints(JointSetPoint {
                q: SideBySide::side_by_side(&|i| all[i].q),
                v: SideBySide::side_by_side(&|i| all[i].v),
                vdot: SideBySide::side_by_side(&|i| all[i].vdot),
            }))
        }
        Asked::Rates { qdot, qddot } => {
            let mut all = [(*qdot, *qddot); N];
            for (to, asked) in all.iter_mut().zip(from) {
                let Asked::Rates { qdot, qddot } = asked else { return None };
                *to = (*qdot, *qddot);
            }
            Some(Asked::Rates {
                qdot: SideBySide::side_by_side(&|i| all[i].0),
                qddot: SideBySide::side_by_side(&|i| all[i].1),
            })
        }
        Asked::Still => from.iter().all(|a| *a == Asked::Still).then_some(Asked::Still),
        Asked::Coast => from.iter().all(|a| *a == Asked::Coast).then_some(Asked::Coast),
    }
}

fn tools<I: Instructions, const N: usize, const J: usize>(
    from: &[Asked<f64, J>; N],
    common: crate::Axes,
) -> Option<Asked<Lanes<N, I>, J>> {
    let zero = SpatialVelocity::zero();
    let still = ToolMotion { X_NE: Pose::identity(), V_NE_N: zero, Vdot_NE_N: zero };
    let (mut references, mut gains, mut gain_rates) = ([still; N], [0.0; N], [0.0; N]);
    for (i, asked) in from.iter().enumerate() {
        match asked {
            Asked::Tool { reference, axes, gain, gain_rate } if *axes == common => {
                (references[i], gains[i], gain_rates[i]) = (*reference, *gain, *gain_rate);
            }
            _ => return None,
        }
    }
    Some(Asked::Tool {
        reference: ToolMotion {
            X_NE: SideBySide::side_by_side(&|i| references[i].X_NE),
            V_NE_N: SideBySide::side_by_side(&|i| references[i].V_NE_N),
            Vdot_NE_N: SideBySide::side_by_side(&|i| references[i].Vdot_NE_N),
        },
        axes: common,
        gain: Lanes::new(gains),
        gain_rate: Lanes::new(gain_rates),
    })
}

impl<I: Instructions, const N: usize, const J: usize> PeriodMemory<Lanes<N, I>, J> {
    /// Where the tool of one lane should be.
    pub fn reference_of(&self, i: usize) -> ToolMotion<f64> {
        let ToolMotion { X_NE, V_NE_N, Vdot_NE_N } = &self.reference;
        ToolMotion { X_NE: X_NE.lane(i), V_NE_N: V_NE_N.lane(i), Vdot_NE_N: Vdot_NE_N.lane(i) }
    }

    /// What one lane remembers: for what decides, as where a phase begins.
    pub fn lane(&self, i: usize) -> PeriodMemory<f64, J> {
        let (belief, motion) = (&self.belief, &self.motion);
        let h = &belief.h_Scm_N;
        PeriodMemory {
            belief: Belief {
                X_NB: belief.X_NB.lane(i),
                q: belief.q.lane(i),
                h_Scm_N: SpatialForce::new(h.torque.lane(i), h.force.lane(i)),
            },
            motion: ResolvedMotion {
                rate: Resolved {
                    qdot: motion.rate.qdot.lane(i),
                    V_NB_B: motion.rate.V_NB_B.lane(i),
                },
                qddot: motion.qddot.lane(i),
                A_NB_B: motion.A_NB_B.lane(i),
            },
            reference: self.reference_of(i),
            acceleration: self.acceleration.lane(i),
            now: self.now.lane(i),
            swing_B: self.swing_B.lane(i),
            surprise: self.surprise.lane(i),
            axes: self.axes,
            started: self.started,
            coasting: self.coasting,
        }
    }
}
