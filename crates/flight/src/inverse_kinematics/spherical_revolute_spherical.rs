//! The geometry of a spherical–revolute–spherical arm: shoulder, elbow axis, wrist, tool.

use super::arm_chain::{ArmChain, NotThisKind};
use super::precision::epsilon;
use super::spherical_joint::{Side, SphericalJoint, about};
use wrasse_dynamics::{Frame, Robot};
use wrasse_spatial::{Mat3, Pose, Scalar, Vec3};

/// Which of the eight ways to bend shoulder, elbow and wrist.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Branch {
    /// Joint 4.
    pub elbow: Side,
    /// Joint 2.
    pub shoulder: Side,
    /// Joint 6.
    pub wrist: Side,
}

/// An arm whose first three axes meet in the shoulder and whose last three meet in the wrist.
///
/// All vectors are in anchor axes, in the zero posture. The anchor A is the base frame, or the
/// system's centre of mass with base axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphericalRevoluteSpherical<T> {
    pub(super) chain: ArmChain<T>,
    pub(super) shoulder: SphericalJoint<T>,
    pub(super) wrist: SphericalJoint<T>,
    /// From the anchor to the shoulder (m).
    pub(super) to_shoulder: Vec3<T>,
    /// From the shoulder to a point on the elbow's axis; turns with link 3 (m).
    pub(super) upper: Vec3<T>,
    /// From there to the wrist; turns with link 4 (m).
    pub(super) fore: Vec3<T>,
    /// From the wrist to the tool; turns with link 7 (m).
    pub(super) hand: Vec3<T>,
    /// What lies beside the axes, turning with links 1, 2, 5 and 6 (m).
    pub(super) beside: [Vec3<T>; 4],
    pub(super) elbow: Elbow<T>,
}

/// The triangle of shoulder, elbow axis and wrist.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Elbow<T> {
    /// Distances of shoulder and wrist from the axis (m).
    pub(super) upper: T,
    pub(super) fore: T,
    /// From shoulder to wrist along the axis (m).
    pub(super) along: T,
    /// Angle from shoulder to wrist, seen along the axis, in the zero posture (rad).
    pub(super) opening_at_zero: T,
}

/// Turns of link 1 to link 7 since the zero posture.
pub(super) type Turns<T> = [Mat3<T>; 7];

impl<T: Scalar> SphericalRevoluteSpherical<T> {
    /// For a base that does not move; the anchor is the base frame.
    ///
    /// # Errors
    /// If the arm is not of this kind: with the joints and numbers that show it.
    pub fn fixed_base<const J: usize>(
        robot: &Robot<T, J>,
        tool: &Frame<T>,
    ) -> Result<Self, NotThisKind<T>> {
        Self::from_chain(&ArmChain::fixed_base(robot, tool)?)?.exactly()
    }
    /// For base attitude and system centre of mass held; the anchor is that centre of mass, with
    /// base axes. Joints of other arms stay at `q` (rad or m).
    ///
    /// Exact in one step if the centres of mass of links 1, 2, 5 and 6 lie on the axes that the
    /// closed form can absorb; otherwise fixed-point passes find the rest.
    ///
    /// # Errors
    /// If the arm is not of this kind: with the joints and numbers that show it.
    pub fn attitude_held<const J: usize>(
        robot: &Robot<T, J>,
        tool: &Frame<T>,
        q: &[T; J],
    ) -> Result<Self, NotThisKind<T>> {
        // The arm itself must be of this kind; what its masses add may be beside the axes.
        Self::fixed_base(robot, tool)?;
        Self::from_chain(&ArmChain::attitude_held(robot, tool, q)?)
    }
    /// The robot's numbers of the arm's joints, base to tool.
    pub fn joints(&self) -> [usize; 7] {
        self.chain.joints
    }
    /// The arm's joint positions (rad) out of the robot's.
    pub fn positions<const J: usize>(&self, q: &[T; J]) -> [T; 7] {
        self.chain.joints.map(|j| q[j])
    }
    /// The robot's joint positions with the arm's put in (rad).
    #[must_use]
    pub fn put<const J: usize>(&self, arm: &[T; 7], q: &[T; J]) -> [T; J] {
        let mut all = *q;
        for (i, &j) in self.chain.joints.iter().enumerate() {
            all[j] = arm[i];
        }
        all
    }
    /// Pose `X_AE` of the tool at the arm's joint positions (rad).
    pub fn tool_pose(&self, q: &[T; 7]) -> Pose<T> {
        let turns = self.turns(q);
        let p_AE = self.to_shoulder
            + turns[2] * self.upper
            + turns[3] * self.fore
            + turns[6] * self.hand
            + self.beside_axes(&turns);
        Pose::new(turns[6] * self.chain.R_BE0, p_AE)
    }
    /// Largest distance of the wrist from the shoulder (m).
    pub fn reach(&self) -> T {
        self.elbow.stretched()
    }

    /// The vectors of a chain sorted: what can be moved along an axis goes to the next link that
    /// turns about the same axis, what is left over lies beside the axes.
    fn from_chain(chain: &ArmChain<T>) -> Result<Self, NotThisKind<T>> {
        let [z1, z2, z3, z4, z5, z6, z7] = chain.axes;
        for (a, b) in [(0, 1), (1, 2), (4, 5), (5, 6)] {
            let cosine = chain.axes[a].dot(chain.axes[b]);
            let right_angled = cosine.abs() < tolerance();
            if !right_angled {
                let joints = [chain.joints[a], chain.joints[b]];
                return Err(NotThisKind::NotPerpendicular { joints, cosine });
            }
        }
        let along = |v: Vec3<T>, z: Vec3<T>| z * v.dot(z);
        let [v0, v1, v2, v3, v4, v5, v6, v7] = chain.vectors;
        // z₂ is fixed in links 1 and 2, z₆ in links 5 and 6.
        let (v1, v2) = (v1 - along(v1, z2), v2 + along(v1, z2));
        let (v5, v6) = (v5 - along(v5, z6), v6 + along(v5, z6));
        let beside =
            [v1 - along(v1, z1), v2 - along(v2, z3), v5 - along(v5, z5), v6 - along(v6, z7)];
        let (upper, fore) = (v3 + along(v2, z3), v4 + along(v5, z5));
        Ok(Self {
            chain: *chain,
            shoulder: SphericalJoint::new([z1, z2, z3]),
            wrist: SphericalJoint::new([z5, z6, z7]),
            to_shoulder: v0 + along(v1, z1),
            upper,
            fore,
            hand: v7 + along(v6, z7),
            beside,
            elbow: Elbow::new(z4, upper, fore)?,
        })
    }
    /// The same with nothing beside the axes.
    fn exactly(mut self) -> Result<Self, NotThisKind<T>> {
        let [s1, s2, w1, w2] = self.beside.map(Vec3::norm);
        let scale = T::one() + self.elbow.stretched();
        let j = self.chain.joints;
        for (gap, joints) in [(s1.max(s2), [j[0], j[1], j[2]]), (w1.max(w2), [j[4], j[5], j[6]])] {
            let meet = gap < tolerance::<T>() * scale;
            if !meet {
                return Err(NotThisKind::AxesDoNotMeet { joints, gap });
            }
        }
        self.beside = [Vec3::zero(); 4];
        Ok(self)
    }
    pub(super) fn turns(&self, q: &[T; 7]) -> Turns<T> {
        let mut R = Mat3::identity();
        core::array::from_fn(|i| {
            R = R * about(self.chain.axes[i], q[i]);
            R
        })
    }
    /// What lies beside the axes, at these turns (m).
    pub(super) fn beside_axes(&self, turns: &Turns<T>) -> Vec3<T> {
        let [b1, b2, b5, b6] = self.beside;
        turns[0] * b1 + turns[1] * b2 + turns[4] * b5 + turns[5] * b6
    }
}

/// Largest cosine, and largest gap for an arm of about a metre, that count as none: files give
/// about twelve digits.
fn tolerance<T: Scalar>() -> T {
    T::from_f64(1e-9).max(T::from_f64(64.0) * epsilon())
}

impl<T: Scalar> Elbow<T> {
    fn new(axis: Vec3<T>, upper: Vec3<T>, fore: Vec3<T>) -> Result<Self, NotThisKind<T>> {
        let across = |v: Vec3<T>| v - axis * v.dot(axis);
        let (to_shoulder, to_wrist) = (-across(upper), across(fore));
        let (a, b) = (to_shoulder.norm(), to_wrist.norm());
        let bends = a.min(b) > tolerance();
        if !bends {
            return Err(NotThisKind::NoElbow { upper: a, fore: b });
        }
        let sine = axis.dot(to_shoulder.cross(to_wrist));
        Ok(Self {
            upper: a,
            fore: b,
            along: (upper + fore).dot(axis),
            opening_at_zero: sine.atan2(to_shoulder.dot(to_wrist)),
        })
    }
    /// Distance of the wrist from the shoulder with the elbow stretched (m).
    pub(super) fn stretched(&self) -> T {
        let across = self.upper + self.fore;
        (across * across + self.along * self.along).sqrt()
    }
    /// The same with the elbow folded (m).
    pub(super) fn folded(&self) -> T {
        let across = self.upper - self.fore;
        (across * across + self.along * self.along).sqrt()
    }
}
