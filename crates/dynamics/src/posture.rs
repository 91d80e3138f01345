//! Where the links are relative to the base.

use crate::robot::within;
use crate::{BodyId, Frame, Robot};
use wrasse_spatial::{At, Group, Layout, Mat3, Pose, Real, Rows, Turn, Vec3, groups, kernel, vec3};

/// Poses of the links in the base, in rows: orientations, and positions by components in base axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Posture<T, const J: usize> {
    /// `R_BL`; its third column is the axis of the link's joint.
    pub(crate) R_BL: Mat3<[T; J]>,
    /// From the origin of the parent (m).
    pub(crate) p_PL_B: Vec3<[T; J]>,
    /// From the origin of the base (m).
    pub(crate) p_BL_B: Vec3<[T; J]>,
    /// Sines and cosines of θ (–).
    sin: [T; J],
    cos: [T; J],
}

kernel! {
    /// Place the links at joint positions `q` (rad or m).
    ///
    /// # Source
    /// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 4.
    pub fn place<L, T, J>(robot: &Robot<T, J>, q: &[T; J], posture: &mut Posture<T, J>) {
        place_links::<L, J>(robot, q, posture);
    }
}

/// The same, with links in a layout.
#[inline(always)]
pub(crate) fn place_links<L: Layout, const J: usize>(
    robot: &Robot<L::One, J>,
    q: &[L::One; J],
    posture: &mut Posture<L::One, J>,
) {
    let (links, n) = (&robot.links, robot.joint_count());
    let Posture { R_BL, p_PL_B, p_BL_B, sin, cos } = posture;
    for i in groups::<L, J>(n) {
        // Each joint by itself: how far it is turned, and the way from its parent in its own axes.
        let (q, o) = (q.at(i), links.origin.at(i));
        let (s, c) = (links.theta_zero.at(i) + q * links.turns.at(i)).sin_cos();
        let mut p_PL_L = vec3(o.x * c + o.y * s, o.y * c - o.x * s, o.z);
        if links.slide {
            p_PL_L.z += q * links.slides.at(i);
        }
        sin.put(i, s);
        cos.put(i, c);
        p_PL_B.put(i, p_PL_L);
    }
    // Base to tips, as `base_to_tips` goes; a closure of this size would not be inlined.
    let (base, mut before) = (Mat3::identity(), Mat3::identity());
    for j in robot.joints() {
        let R_BP = robot.of_parent(j, base, before, R_BL);
        let theta = Turn { sin: sin.at(j), cos: cos.at(j) };
        before = links.axes[within::<J>(j)].R_AL(&R_BP, &theta);
        R_BL.put(j, before);
    }
    for i in groups::<L, J>(n) {
        let p = R_BL.at(i) * p_PL_B.at(i);
        p_PL_B.put(i, p);
        p_BL_B.put(i, p);
    }
    robot.sum_to_tips(Vec3::zero(), p_BL_B);
}

impl<T: Real, const J: usize> Posture<T, J> {
    /// Room for one, nothing placed.
    #[inline(always)]
    pub fn new() -> Self {
        let (R_BL, p, none) = (Rows::zero_rows(), Vec3::zero_rows(), [T::zero(); J]);
        Self { R_BL, p_PL_B: p, p_BL_B: p, sin: none, cos: none }
    }
    /// At joint positions `q` (rad or m).
    #[inline(always)]
    pub fn at(robot: &Robot<T, J>, q: &[T; J]) -> Self {
        let mut posture = Self::new();
        place(robot, q, &mut posture);
        posture
    }
    /// Axes of the joints of a group (–, base axes).
    #[inline(always)]
    pub(crate) fn axis<L: Layout<One = T>>(&self, i: Group<L>) -> Vec3<L::Some> {
        let [x, y, z] = &self.R_BL.rows;
        vec3(x.z.at(i), y.z.at(i), z.z.at(i))
    }
    /// Axis of a joint (–, base axes).
    #[inline(always)]
    pub fn axis_of(&self, j: usize) -> Vec3<T> {
        let [x, y, z] = &self.R_BL.rows;
        vec3(x.z.at(j), y.z.at(j), z.z.at(j))
    }
    /// `X_BL` of a link, in the axes that make its joint simple.
    #[inline(always)]
    pub(crate) fn X_BL(&self, j: usize) -> Pose<T> {
        Pose::new(self.R_BL.at(j), self.p_BL_B.at(j))
    }
    /// Pose of a body in the base.
    #[inline(always)]
    pub fn pose_of(&self, robot: &Robot<T, J>, body: BodyId) -> Pose<T> {
        let BodyId::Link(j) = body else { return Pose::identity() };
        Pose::new(self.R_BL.at(j) * robot.R_LB(j), self.p_BL_B.at(j))
    }
    /// Pose `X_BF` of a frame in the base.
    #[inline(always)]
    pub fn pose(&self, robot: &Robot<T, J>, frame: &Frame<T>) -> Pose<T> {
        self.pose_of(robot, frame.body) * frame.X_BF
    }
}

impl<T: Real, const J: usize> Default for Posture<T, J> {
    fn default() -> Self {
        Self::new()
    }
}
