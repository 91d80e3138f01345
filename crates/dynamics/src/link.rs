//! A link in axes that make its joint simple. The algorithms work in these; what is asked and told
//! is in the axes of the body that the user gave.

use crate::{BodyId, Joint, JointKind, Payload};
use wrasse_spatial::{
    Mat3, Pose, Real, Scalar, SpatialForce, SpatialInertia, SpatialVelocity, Turn, Turned, Vec3,
    vec3,
};

/// A link and how it sits on its parent P.
///
/// Its axes L are those of its body B, turned so that the joint's axis is z, and that x is at a right
/// angle to the axis of the first joint it carries. Then `R_PL = R_z(γ) R_x(α) R_z(θ)`, where only θ
/// changes, and γ is zero but on the base and where the tree forks.
///
/// # Source
/// [`KhalilKleinfinger1986`](wrasse_spatial::references::KhalilKleinfinger1986), the axes; the origin
/// stays that of the body, for the common normal of two axes that are all but parallel is far away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link<T> {
    /// The body that it is mounted on.
    pub parent: BodyId,
    /// How its joint moves.
    pub kind: JointKind,
    /// γ, if it is not zero.
    fork: Option<Turn<T>>,
    /// α.
    twist: Turn<T>,
    /// θ at zero travel (rad).
    theta_zero: T,
    /// `p_PL_P` at zero travel (m).
    origin_P: Vec3<T>,
    /// Inertia about its origin, in its axes.
    pub M_L: SpatialInertia<T>,
    /// `R_LB`.
    pub R_LB: Mat3<T>,
}

/// A link on its parent at some travel of its joint.
#[derive(Debug, Clone, Copy)]
pub struct Seat<'a, T> {
    link: &'a Link<T>,
    /// θ.
    turn: Turn<T>,
    /// `p_PL_P` (m).
    pub p_PL_P: Vec3<T>,
}

impl<T: Scalar> Link<T> {
    /// The link that a joint carries, whose parent has the axes `R_PpB` (of the parent's body, in the
    /// parent's link axes), and which first carries a joint along `next_B`.
    pub(crate) fn new(
        joint: &Joint<T>,
        matter: &Payload<T>,
        R_PBp: &Mat3<T>,
        next_B: Option<Vec3<T>>,
    ) -> Self {
        let R_LB = link_axes(joint.axis_B, next_B);
        let R = *R_PBp * joint.X_PB_zero.rotation * R_LB.transpose();
        let (fork, twist, theta_zero) = three_turns(&R);
        let mut link = Self {
            parent: joint.parent,
            kind: joint.kind,
            fork,
            twist,
            theta_zero,
            origin_P: *R_PBp * joint.X_PB_zero.translation,
            M_L: SpatialInertia::zero(),
            R_LB,
        };
        link.weigh(matter);
        link
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

impl Link<f64> {
    /// The same link over another scalar.
    pub(crate) fn cast<T: Real>(&self) -> Link<T> {
        Link {
            parent: self.parent,
            kind: self.kind,
            fork: self.fork.map(|fork| Turn::from_f64(&fork)),
            twist: Turn::from_f64(&self.twist),
            theta_zero: T::from_f64(self.theta_zero),
            origin_P: Vec3::from_f64(self.origin_P),
            M_L: SpatialInertia::from_f64(&self.M_L),
            R_LB: Mat3::from_f64(self.R_LB),
        }
    }
}

impl<T: Real> Link<T> {
    /// Take the matter of its body, which is in the body's axes.
    pub(crate) fn weigh(&mut self, matter: &Payload<T>) {
        self.M_L = matter.M_F_F.in_axes(&self.R_LB);
    }
    /// θ at travel `q` (rad or m).
    #[inline(always)]
    pub fn theta(&self, q: T) -> T {
        match self.kind {
            JointKind::Revolute => self.theta_zero + q,
            JointKind::Prismatic => self.theta_zero,
        }
    }
    /// The link at travel `q` (rad or m), where θ is known.
    #[inline(always)]
    pub fn seat(&self, turn: Turn<T>, q: T) -> Seat<'_, T> {
        let p_PL_P = match self.kind {
            JointKind::Revolute => self.origin_P,
            JointKind::Prismatic => {
                let along = vec3(T::zero(), T::zero(), q).about_x(&self.twist);
                self.origin_P + self.fork.map_or(along, |fork| along.about_z(&fork))
            }
        };
        Seat { link: self, turn, p_PL_P }
    }
    /// The link at travel `q` (rad or m).
    #[inline(always)]
    pub fn at(&self, q: T) -> Seat<'_, T> {
        self.seat(Turn::by(self.theta(q)), q)
    }
    /// `S q̇`: velocity relative to the parent, at the origin.
    #[inline(always)]
    pub fn velocity(&self, qdot: T) -> SpatialVelocity<T> {
        let along = vec3(T::zero(), T::zero(), qdot);
        match self.kind {
            JointKind::Revolute => SpatialVelocity::new(along, Vec3::zero()),
            JointKind::Prismatic => SpatialVelocity::new(Vec3::zero(), along),
        }
    }
    /// `Sᵀ F`: the part of a force that the joint's motor feels (N·m or N).
    #[inline(always)]
    pub fn project(&self, F_L: &SpatialForce<T>) -> T {
        match self.kind {
            JointKind::Revolute => F_L.torque.z,
            JointKind::Prismatic => F_L.force.z,
        }
    }
    /// `M S`: momentum of an inertia that moves with unit joint rate.
    #[inline(always)]
    pub fn momentum(&self, M_L: &SpatialInertia<T>) -> SpatialForce<T> {
        let (h, I, o) = (M_L.first_moment, M_L.rotational, T::zero());
        match self.kind {
            JointKind::Revolute => SpatialForce::new(vec3(I.xz, I.yz, I.zz), vec3(-h.y, h.x, o)),
            JointKind::Prismatic => SpatialForce::new(vec3(h.y, -h.x, o), vec3(o, o, M_L.mass)),
        }
    }
}

impl<T: Real> Seat<'_, T> {
    /// Of something in the link's axes, in the parent's.
    #[inline(always)]
    pub fn to_parent<E: Turned<T>>(&self, of_link: &E) -> E {
        let twisted = of_link.about_z(&self.turn).about_x(&self.link.twist);
        match &self.link.fork {
            Some(fork) => twisted.about_z(fork),
            None => twisted,
        }
    }
    /// Of something in the parent's axes, in the link's.
    #[inline(always)]
    pub fn to_link<E: Turned<T> + Copy>(&self, of_parent: &E) -> E {
        let forked = match &self.link.fork {
            Some(fork) => of_parent.about_z(&fork.back()),
            None => *of_parent,
        };
        forked.about_x(&self.link.twist.back()).about_z(&self.turn.back())
    }
    /// `R_AL` from `R_AP`.
    #[inline(always)]
    pub(crate) fn carried_by(&self, R_AP: &Mat3<T>) -> Mat3<T> {
        // A row of R_AL is the row of R_AP in the link's axes.
        let [x, y, z] = &R_AP.rows;
        Mat3::from_rows(self.to_link(x), self.to_link(y), self.to_link(z))
    }
    /// `X_AL` from `X_AP`.
    #[inline(always)]
    pub fn pose(&self, X_AP: &Pose<T>) -> Pose<T> {
        Pose::new(self.carried_by(&X_AP.rotation), X_AP.point(self.p_PL_P))
    }
    /// `V_NP` taken at the link's origin, in its axes.
    #[inline(always)]
    pub(crate) fn velocity_to_link(&self, V_P: &SpatialVelocity<T>) -> SpatialVelocity<T> {
        let at_L = V_P.shifted_by(self.p_PL_P);
        SpatialVelocity::new(self.to_link(&at_L.angular), self.to_link(&at_L.linear))
    }
    /// A force on the link, about the parent's origin in its axes.
    #[inline(always)]
    pub fn force_to_parent(&self, F_L: &SpatialForce<T>) -> SpatialForce<T> {
        let f = self.to_parent(&F_L.force);
        SpatialForce::new(self.to_parent(&F_L.torque) + self.p_PL_P.cross(f), f)
    }
    /// An inertia at the link, about the parent's origin in its axes.
    #[inline(always)]
    pub fn inertia_to_parent(&self, M_L: &SpatialInertia<T>) -> SpatialInertia<T> {
        self.to_parent(M_L).about(-self.p_PL_P)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::{Robot, State, kinematics};
    use std::{vec, vec::Vec};
    use wrasse_spatial::{Quat, Sym3};

    /// Joints one after the other, but for the last, which sits on the first link too.
    fn robot(kind: JointKind, axes: &[Vec3<f64>]) -> Robot<f64, 6> {
        let matter = Payload::from_central(2.0, vec3(0.1, 0.2, 0.3), Sym3::diagonal(1.0, 2.0, 2.5));
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
        let forked: Vec<bool> = robot.joints().map(|j| robot.link(j).fork.is_some()).collect();
        assert_eq!(forked, [true, false, false, false, true]);
    }
}
