//! Axes of the links in which each joint is simple.

use crate::Joint;
use wrasse_spatial::{Mat3, Real, Scalar, Turn, Vec3, vec3};

/// How the axes L of a link lie on those of its parent P.
///
/// They are those of its body B, turned so that the joint's axis is z, and that x is at a right angle to
/// the axis of the first joint it carries. Then `R_PL = R_z(γ) R_x(α) R_z(θ)`, where only θ changes, and
/// γ is zero but on the base and where the tree forks: the angles of modified Denavit–Hartenberg axes.
///
/// # Source
/// [`KhalilKleinfinger1986`](wrasse_spatial::references::KhalilKleinfinger1986), the axes; the origin
/// stays that of the body, for the common normal of two axes that are all but parallel is far away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct JointAxes<T> {
    /// γ, if it is not zero.
    pub(crate) gamma: Option<Turn<T>>,
    /// α.
    pub(crate) alpha: Alpha<T>,
    /// `R_LB`.
    pub(crate) R_LB: Mat3<T>,
}

/// The constant turn from a joint's axis to the next: of most arms half or quarter turns, which only
/// change signs and places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Alpha<T> {
    /// Cosine of no turn or a half one.
    Along(T),
    /// Sine of a quarter turn.
    Across(T),
    /// Any other.
    Oblique(Turn<T>),
}

impl<T: Scalar> Alpha<T> {
    /// Of a turn: what is within rounding of a quarter is one.
    fn new(turn: Turn<T>) -> Self {
        let rounding = T::epsilon() * T::from_f64(8.0);
        let sign = |x: T| if x < T::zero() { -T::one() } else { T::one() };
        if turn.sin.abs() <= rounding {
            Self::Along(sign(turn.cos))
        } else if turn.cos.abs() <= rounding {
            Self::Across(sign(turn.sin))
        } else {
            Self::Oblique(turn)
        }
    }
}

impl<T: Scalar> JointAxes<T> {
    /// Axes of the link that a joint carries, and θ at zero travel (rad). Its parent has the axes
    /// `R_PBp` of the parent's body, and the link first carries a joint along `next_B`.
    pub(crate) fn new(joint: &Joint<T>, R_PBp: &Mat3<T>, next_B: Option<Vec3<T>>) -> (Self, T) {
        let R_LB = link_axes(joint.axis_B, next_B);
        let R = *R_PBp * joint.X_PB_zero.rotation * R_LB.transpose();
        let (gamma, alpha, theta_zero) = three_turns(&R);
        (Self { gamma, alpha: Alpha::new(alpha), R_LB }, theta_zero)
    }
}

impl<T: Real> JointAxes<T> {
    /// `R_AL` from `R_AP` at θ: a row of `R_AL` is the row of `R_AP` in the link's axes.
    #[inline(always)]
    pub(crate) fn R_AL(&self, R_AP: &Mat3<T>, theta: &Turn<T>) -> Mat3<T> {
        let [mut x, mut y, mut z] = R_AP.rows;
        if let Some(gamma) = &self.gamma {
            let back = gamma.back();
            (x, y, z) = (x.about_z(&back), y.about_z(&back), z.about_z(&back));
        }
        // The kind of α is asked once, not for each row.
        match &self.alpha {
            Alpha::Along(c) => (x, y, z) = (x.along(*c), y.along(*c), z.along(*c)),
            Alpha::Across(s) => (x, y, z) = (x.across(*s), y.across(*s), z.across(*s)),
            Alpha::Oblique(turn) => {
                let back = turn.back();
                (x, y, z) = (x.about_x(&back), y.about_x(&back), z.about_x(&back));
            }
        }
        let back = theta.back();
        Mat3::from_rows(x.about_z(&back), y.about_z(&back), z.about_z(&back))
    }
    /// A vector in P axes, in the axes that θ turns.
    #[inline(always)]
    pub(crate) fn before_theta(&self, v_P: Vec3<T>) -> Vec3<T> {
        let forked = match &self.gamma {
            Some(gamma) => v_P.about_z(&gamma.back()),
            None => v_P,
        };
        match &self.alpha {
            Alpha::Along(cos) => forked.along(*cos),
            Alpha::Across(sin) => forked.across(*sin),
            Alpha::Oblique(turn) => forked.about_x(&turn.back()),
        }
    }
}

/// Turns about x that only change signs and places.
trait Quarters<T> {
    /// Turned back by no turn or a half one.
    fn along(self, cos: T) -> Self;
    /// Turned back by a quarter.
    fn across(self, sin: T) -> Self;
}

impl<T: Real> Quarters<T> for Vec3<T> {
    #[inline(always)]
    fn along(self, cos: T) -> Self {
        vec3(self.x, self.y * cos, self.z * cos)
    }
    #[inline(always)]
    fn across(self, sin: T) -> Self {
        vec3(self.x, self.z * sin, -(self.y * sin))
    }
}

impl JointAxes<f64> {
    /// The same over another number.
    pub(crate) fn cast<T: Real>(&self) -> JointAxes<T> {
        JointAxes {
            gamma: self.gamma.map(|gamma| Turn::from_f64(&gamma)),
            alpha: match self.alpha {
                Alpha::Along(cos) => Alpha::Along(T::from_f64(cos)),
                Alpha::Across(sin) => Alpha::Across(T::from_f64(sin)),
                Alpha::Oblique(turn) => Alpha::Oblique(Turn::from_f64(&turn)),
            },
            R_LB: Mat3::from_f64(self.R_LB),
        }
    }
}

/// `R_LB`: z along the joint's axis, x at a right angle to the next one too.
fn link_axes<T: Scalar>(axis_B: Vec3<T>, next_B: Option<Vec3<T>>) -> Mat3<T> {
    let z = axis_B;
    let across = next_B.map(|next| z.cross(next)).filter(|x| x.norm() > T::from_f64(1e-6));
    let x = across.unwrap_or_else(|| {
        // Any direction will do: what is left across z of the axis of B that is least along it.
        let (a, b, c) = (z.x.abs(), z.y.abs(), z.z.abs());
        let (one, zero) = (T::one(), T::zero());
        if a <= b && a <= c {
            vec3(one, zero, zero)
        } else if b <= c {
            vec3(zero, one, zero)
        } else {
            vec3(zero, zero, one)
        }
    });
    // Twice, for the first time leaves rounding of what was nearly along z.
    let x = right_angle(right_angle(x, z), z);
    Mat3::from_rows(x, z.cross(x), z)
}

/// The direction of what is left of x across z.
fn right_angle<T: Scalar>(x: Vec3<T>, z: Vec3<T>) -> Vec3<T> {
    let left = x - z * z.dot(x);
    left * (T::one() / left.norm())
}

/// γ, α and θ of `R = R_z(γ) R_x(α) R_z(θ)`; γ only where it is more than rounding.
fn three_turns<T: Scalar>(R: &Mat3<T>) -> (Option<Turn<T>>, Turn<T>, T) {
    let z = R.column(2);
    let across = (z.x * z.x + z.y * z.y).sqrt();
    let rounding = T::epsilon() * T::from_f64(8.0);
    let fork = (z.x.abs() > rounding).then(|| Turn { sin: z.x / across, cos: -z.y / across });
    let forked = fork.unwrap_or_else(Turn::none).back();
    let upright = Mat3::from_columns(
        R.column(0).about_z(&forked),
        R.column(1).about_z(&forked),
        z.about_z(&forked),
    );
    let twist = Turn { sin: -upright.column(2).y, cos: z.z };
    let x = upright.column(0).about_x(&twist.back());
    (fork, twist, x.y.atan2(x.x))
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::{BodyId, JointKind, MassProperties, Robot, State, kinematics};
    use std::{vec, vec::Vec};
    use wrasse_spatial::{Pose, Quat, Sym3};

    /// Joints one after the other, but for the last, which sits on the first link too.
    fn robot(kind: JointKind, axes: &[Vec3<f64>]) -> Robot<f64, 6> {
        let matter =
            MassProperties::from_central(2.0, vec3(0.1, 0.2, 0.3), Sym3::diagonal(1.0, 2.0, 2.5));
        let joints = axes.iter().enumerate().map(|(j, axis)| {
            let parent = match j {
                0 => BodyId::Base,
                _ if j + 1 == axes.len() => BodyId::Link(0),
                _ => BodyId::Link(j - 1),
            };
            let turn = Quat::exp(vec3(0.3, -0.7, 0.2) * (j % 2) as f64);
            let joint =
                Joint::new(parent, kind, Pose::from_quat(turn, vec3(0.4, -0.1, 0.7)), *axis);
            (joint, matter)
        });
        Robot::new(matter, &joints.collect::<Vec<_>>()).unwrap()
    }

    /// Axes across, along, against and all but along each other, in whatever axes a body has.
    fn axes() -> Vec<Vec<Vec3<f64>>> {
        let (x, y, z) = (vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
        vec![
            vec![z, z, z, z, z],
            vec![x, y, z, -x, y],
            vec![x, -x, x, -x, x],
            vec![z, vec3(1e-12, 0.0, 1.0), vec3(1e-7, 0.0, 1.0), vec3(0.0, 1e-5, -1.0), z],
            vec![vec3(0.3, 0.4, -0.5), vec3(-0.2, 0.9, 0.1), y, vec3(0.6, 0.6, 0.6), x],
        ]
    }

    /// Three turns against Rodrigues' formula. Levers of 3 m, a few roundings each. Measured 3.3e-15.
    #[test]
    fn bodies_are_where_their_joints_put_them() {
        for (axes, kind) in axes().into_iter().flat_map(|axes| {
            [JointKind::Revolute, JointKind::Prismatic].map(|kind| (axes.clone(), kind))
        }) {
            let robot = robot(kind, &axes);
            let q = [0.7, -2.9, 1.6, 0.1, 4.0, 0.0];
            let state = State { q, ..State::default() };
            let (k, mut X_NB) = (kinematics(&robot, &state), [Pose::identity(); 6]);
            for j in robot.joints() {
                let joint = robot.joint(j);
                let X_NP = match joint.parent {
                    BodyId::Base => Pose::identity(),
                    BodyId::Link(p) => X_NB[p],
                };
                X_NB[j] = X_NP * joint.X_PB(q[j]);
                for found in [k.X_NB(BodyId::Link(j)), k.poses().links[j]] {
                    let turned = (found.rotation - X_NB[j].rotation).rows.map(Vec3::norm);
                    let off = (found.translation - X_NB[j].translation).norm()
                        + turned[0]
                        + turned[1]
                        + turned[2];
                    assert!(off < 1e-14, "joint {j} of {axes:?}: {off:e}");
                }
            }
        }
    }

    /// What makes it worth while: one turn less for each link but the first of an arm and of a fork.
    #[test]
    fn only_the_base_and_a_fork_need_a_third_turn() {
        let robot = robot(JointKind::Revolute, &axes()[4]);
        let forked: Vec<bool> =
            robot.joints().map(|j| robot.links.axes[j].gamma.is_some()).collect();
        assert_eq!(forked, [true, false, false, false, true]);
    }
}
