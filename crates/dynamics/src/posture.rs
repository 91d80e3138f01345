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
    /// Positions of the joints (rad or m), and sines and cosines of θ (–).
    q: [T; J],
    sin: [T; J],
    cos: [T; J],
}

kernel! {
    /// Place the links at joint positions `q` (rad or m).
    ///
    /// # Source
    /// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 4.
    pub fn place<L, T, J>(robot: &Robot<T, J>, q: &[T; J], posture: &mut Posture<T, J>) {
        turn_joints::<L, J>(robot, q, posture);
        place_links::<L, J>(robot, posture);
    }
}

/// How far each joint is turned.
#[inline(always)]
pub(crate) fn turn_joints<L: Layout, const J: usize>(
    robot: &Robot<L::One, J>,
    q: &[L::One; J],
    posture: &mut Posture<L::One, J>,
) {
    let links = &robot.links;
    for i in groups::<L, J>(robot.joint_count()) {
        let (s, c) = (links.theta_zero.at(i) + q.at(i) * links.turns.at(i)).sin_cos();
        posture.sin.put(i, s);
        posture.cos.put(i, c);
    }
    posture.q = *q;
}

/// The same from a posture close by: its sines turned by the small angles in between.
///
/// Sine and cosine of those by their series, without a branch: to the last digit up to 0.1 rad, to 3e-6
/// at 1 rad.
#[inline(always)]
pub(crate) fn turn_joints_on<L: Layout, const J: usize>(
    robot: &Robot<L::One, J>,
    q: &[L::One; J],
    near: &Posture<L::One, J>,
    posture: &mut Posture<L::One, J>,
) {
    let c = L::Some::from_f64;
    let one = c(1.0);
    for i in groups::<L, J>(robot.joint_count()) {
        let d = (q.at(i) - near.q.at(i)) * robot.links.turns.at(i);
        let z = d * d;
        let sine = d * (one - z * c(1.0 / 6.0) * (one - z * c(0.05) * (one - z * c(1.0 / 42.0))));
        let fourth = one - z * c(1.0 / 30.0) * (one - z * c(1.0 / 56.0));
        let cosine = one - z * c(0.5) * (one - z * c(1.0 / 12.0) * fourth);
        let (s, k) = (near.sin.at(i), near.cos.at(i));
        posture.sin.put(i, s * cosine + k * sine);
        posture.cos.put(i, k * cosine - s * sine);
    }
    posture.q = *q;
}

/// Place the links, with the joints turned.
#[inline(always)]
pub(crate) fn place_links<L: Layout, const J: usize>(
    robot: &Robot<L::One, J>,
    posture: &mut Posture<L::One, J>,
) {
    let (links, n) = (&robot.links, robot.joint_count());
    let Posture { R_BL, p_PL_B, p_BL_B, q, sin, cos } = posture;
    for i in groups::<L, J>(n) {
        // The way from the parent, in the link's own axes.
        let (s, c, o) = (sin.at(i), cos.at(i), links.origin.at(i));
        let mut p_PL_L = vec3(o.x * c + o.y * s, o.y * c - o.x * s, o.z);
        if links.slide {
            p_PL_L.z += q.at(i) * links.slides.at(i);
        }
        p_PL_B.put(i, p_PL_L);
    }
    robot.base_to_tips(Mat3::identity(), R_BL, |j, R_BP| {
        links.axes[within::<J>(j)].R_AL(&R_BP, &Turn { sin: sin.at(j), cos: cos.at(j) })
    });
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
        Self { R_BL, p_PL_B: p, p_BL_B: p, q: none, sin: none, cos: none }
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

#[cfg(test)]
mod tests {
    extern crate std;
    use crate::{BodyId, Configuration, Joint, JointKind, MassProperties, Robot, configure_near};
    use core::array;
    use wrasse_spatial::{Pose, Sym3, Vec3, vec3};

    fn robot() -> Robot<f64, 4> {
        let body = MassProperties::from_central(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
        let joint = |j: usize| {
            let parent = j.checked_sub(1).map_or(BodyId::Base, BodyId::Link);
            let kind = if j == 2 { JointKind::Prismatic } else { JointKind::Revolute };
            let X = Pose::new(Pose::identity().rotation, vec3(0.3, 0.0, 0.1));
            (Joint::new(parent, kind, X, vec3(1.0, 0.2, j as f64)), body)
        };
        Robot::new(body, &array::from_fn::<_, 4, _>(joint)).expect("four joints")
    }

    /// Largest difference of a configuration found beside another one, from the same found alone.
    fn off(angle: f64) -> f64 {
        let (robot, q) = (robot(), [0.3, -1.2, 0.4, 2.5]);
        let near = Configuration::at(&robot, &q);
        let q = q.map(|q| q + angle);
        let (mut beside, alone) = (Configuration::new(), Configuration::at(&robot, &q));
        configure_near(&robot, &q, &near, &mut beside);
        let columns = |c: &Configuration<f64, 4>| c.base.S.columns().map(|S| S.to_array());
        let both =
            columns(&beside).into_iter().flatten().zip(columns(&alone).into_iter().flatten());
        both.fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs()))
    }

    /// The series end where the angle's ninth power is lost. Measured 4e-16, 4e-15, 6e-6.
    #[test]
    fn a_configuration_close_by_is_found_by_turning_its_joints_on() {
        for (angle, bound) in [(0.01, 5e-15), (0.1, 5e-14), (1.0, 5e-5)] {
            assert!(off(angle) < bound, "{angle} rad: {:e}", off(angle));
            assert!(off(-angle) < bound, "-{angle} rad: {:e}", off(-angle));
        }
        assert!(off(1.0) > 1e-8, "the series are not those that the page says");
    }
}
