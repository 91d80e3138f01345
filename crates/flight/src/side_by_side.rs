//! Control periods of many vehicles side by side: one in each lane of the processor. All are in the same
//! phase at the same time; what decides takes each lane's numbers alone.

use crate::base_control::BaseControlSetup;
use crate::computer::Setup;
use crate::control_period::{Asked, PeriodMemory};
use crate::law::Tuning;
use crate::navigation::NavigationSetup;
use crate::resolved_motion::{Assignment, Belief, JointUse, Resolved, ResolvedMotion};
use crate::trajectory::{JointSetPoint, ToolMotion};
use core::array;
use wrasse_dynamics::{Frame, State};
use wrasse_hardware::{JointLimits, SetPoint};
use wrasse_spatial::{
    Lanes, Mat3, Pose, Quat, Real, SideBySide, SpatialForce, SpatialVelocity, Vec3, vec3,
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

/// Numbers of `N` vehicles, one of each in a lane.
trait Gather<const N: usize>: Copy {
    type Lanes;
    fn gather(from: &[Self; N]) -> Self::Lanes;
}

impl<const N: usize> Gather<N> for f64 {
    type Lanes = Lanes<N>;
    #[inline(always)]
    fn gather(from: &[Self; N]) -> Lanes<N> {
        Lanes(*from)
    }
}
impl<const N: usize, const J: usize> Gather<N> for [f64; J] {
    type Lanes = [Lanes<N>; J];
    #[inline(always)]
    fn gather(from: &[Self; N]) -> Self::Lanes {
        array::from_fn(|j| Lanes(array::from_fn(|i| from[i][j])))
    }
}
impl<const N: usize> Gather<N> for Vec3<f64> {
    type Lanes = Vec3<Lanes<N>>;
    #[inline(always)]
    fn gather(from: &[Self; N]) -> Self::Lanes {
        Vec3::from_array(<[f64; 3]>::gather(&from.map(Vec3::to_array)))
    }
}
impl<const N: usize> Gather<N> for SpatialVelocity<f64> {
    type Lanes = SpatialVelocity<Lanes<N>>;
    #[inline(always)]
    fn gather(from: &[Self; N]) -> Self::Lanes {
        SpatialVelocity::from_array(<[f64; 6]>::gather(&from.map(Self::to_array)))
    }
}
impl<const N: usize> Gather<N> for Pose<f64> {
    type Lanes = Pose<Lanes<N>>;
    #[inline(always)]
    fn gather(from: &[Self; N]) -> Self::Lanes {
        let row = |k: usize| Vec3::gather(&from.map(|X| X.rotation.rows[k]));
        let rotation = Mat3::from_rows(row(0), row(1), row(2));
        Pose::new(rotation, Vec3::gather(&from.map(|X| X.translation)))
    }
}

/// States of `N` vehicles, one in each lane.
pub fn states_side_by_side<const N: usize, const J: usize>(
    from: &[State<f64, J>; N],
) -> State<Lanes<N>, J> {
    State {
        X_NB: Pose::gather(&array::from_fn(|i| from[i].X_NB)),
        V_NB_B: SpatialVelocity::gather(&array::from_fn(|i| from[i].V_NB_B)),
        q: <[f64; J]>::gather(&array::from_fn(|i| from[i].q)),
        v: <[f64; J]>::gather(&array::from_fn(|i| from[i].v)),
    }
}

/// What is asked of `N` vehicles, one in each lane; `None` unless all are asked the same kind of thing.
pub fn asked_side_by_side<const N: usize, const J: usize>(
    from: &[Asked<f64, J>; N],
) -> Option<Asked<Lanes<N>, J>> {
    match from.first()? {
        Asked::Tool { axes, .. } => tools(from, *axes),
        Asked::Joints(first) => {
            let mut all = [*first; N];
            for (to, asked) in all.iter_mut().zip(from) {
                let Asked::Joints(at) = asked else { return None };
                *to = *at;
            }
            Some(Asked::Joints(JointSetPoint {
                q: <[f64; J]>::gather(&all.map(|at| at.q)),
                v: <[f64; J]>::gather(&all.map(|at| at.v)),
                vdot: <[f64; J]>::gather(&all.map(|at| at.vdot)),
            }))
        }
        Asked::Rates { qdot, qddot } => {
            let mut all = [(*qdot, *qddot); N];
            for (to, asked) in all.iter_mut().zip(from) {
                let Asked::Rates { qdot, qddot } = asked else { return None };
                *to = (*qdot, *qddot);
            }
            Some(Asked::Rates {
                qdot: <[f64; J]>::gather(&all.map(|(qdot, _)| qdot)),
                qddot: <[f64; J]>::gather(&all.map(|(_, qddot)| qddot)),
            })
        }
        Asked::Still => from.iter().all(|a| *a == Asked::Still).then_some(Asked::Still),
        Asked::Coast => from.iter().all(|a| *a == Asked::Coast).then_some(Asked::Coast),
    }
}

fn tools<const N: usize, const J: usize>(
    from: &[Asked<f64, J>; N],
    common: crate::Axes,
) -> Option<Asked<Lanes<N>, J>> {
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
            X_NE: Pose::gather(&references.map(|r| r.X_NE)),
            V_NE_N: SpatialVelocity::gather(&references.map(|r| r.V_NE_N)),
            Vdot_NE_N: SpatialVelocity::gather(&references.map(|r| r.Vdot_NE_N)),
        },
        axes: common,
        gain: Lanes(gains),
        gain_rate: Lanes(gain_rates),
    })
}

impl<const N: usize, const J: usize> PeriodMemory<Lanes<N>, J> {
    /// Where the tool of one lane should be.
    pub fn reference_of(&self, i: usize) -> ToolMotion<f64> {
        let ToolMotion { X_NE, V_NE_N, Vdot_NE_N } = &self.reference;
        ToolMotion { X_NE: X_NE.lane(i), V_NE_N: V_NE_N.lane(i), Vdot_NE_N: Vdot_NE_N.lane(i) }
    }

    /// What one lane remembers: for what decides, as where a phase begins.
    pub fn lane(&self, i: usize) -> PeriodMemory<f64, J> {
        let one = |x: &Lanes<N>| x.lane(i);
        let vector = |v: &Vec3<Lanes<N>>| vec3(one(&v.x), one(&v.y), one(&v.z));
        let twist = |V: &SpatialVelocity<Lanes<N>>| {
            SpatialVelocity::new(vector(&V.angular), vector(&V.linear))
        };
        let pose = |X: &Pose<Lanes<N>>| {
            let [a, b, c] = &X.rotation.rows;
            Pose::new(Mat3::from_rows(vector(a), vector(b), vector(c)), vector(&X.translation))
        };
        let joints = |q: &[Lanes<N>; J]| array::from_fn(|j| q[j].lane(i));
        let (belief, motion, reference) = (&self.belief, &self.motion, &self.reference);
        let h = &belief.h_Scm_N;
        PeriodMemory {
            belief: Belief {
                X_NB: pose(&belief.X_NB),
                q: joints(&belief.q),
                h_Scm_N: SpatialForce::new(vector(&h.torque), vector(&h.force)),
            },
            motion: ResolvedMotion {
                rate: Resolved {
                    qdot: joints(&motion.rate.qdot),
                    V_NB_B: twist(&motion.rate.V_NB_B),
                },
                qddot: joints(&motion.qddot),
                A_NB_B: twist(&motion.A_NB_B),
            },
            reference: ToolMotion {
                X_NE: pose(&reference.X_NE),
                V_NE_N: twist(&reference.V_NE_N),
                Vdot_NE_N: twist(&reference.Vdot_NE_N),
            },
            acceleration: joints(&self.acceleration),
            now: array::from_fn(|j| {
                let s = &self.now[j];
                SetPoint {
                    position: one(&s.position),
                    rate: one(&s.rate),
                    acceleration: one(&s.acceleration),
                }
            }),
            swing_B: vector(&self.swing_B),
            surprise: twist(&self.surprise),
            axes: self.axes,
            started: self.started,
            coasting: self.coasting,
        }
    }
}
