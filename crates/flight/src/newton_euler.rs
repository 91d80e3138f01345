//! Newton's and Euler's laws link by link, each in its own axes about its own origin: the shorter way
//! where only sums at the base are asked for.

use wrasse_dynamics::{BodyId, Joint, JointKind, Robot};
use wrasse_hardware::SetPoint;
use wrasse_spatial::{Pose, Real, SpatialForce, SpatialInertia, Vec3};

/// What the bodies sum up to, about the base's origin in base axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sum<T> {
    /// Force that the motion takes (N·m, N).
    pub(crate) F: SpatialForce<T>,
    /// Mass (kg).
    pub(crate) mass: T,
    /// First moment (kg·m).
    pub(crate) first_moment: Vec3<T>,
}

impl<T: Real> Sum<T> {
    #[inline(always)]
    fn new(M: &SpatialInertia<T>, F: SpatialForce<T>) -> Self {
        Self { F, mass: M.mass, first_moment: M.first_moment }
    }
    /// With what a link carries, at `X_PL` in this body.
    #[inline(always)]
    fn and(&self, X_PL: &Pose<T>, link: &Self) -> Self {
        let moment = X_PL.rotation * link.first_moment + X_PL.translation * link.mass;
        Self {
            F: self.F + X_PL.force_to_parent(&link.F),
            mass: self.mass + link.mass,
            first_moment: self.first_moment + moment,
        }
    }
}

/// Sum over what each link alone contributes, tip to base.
#[inline(always)]
fn at_base<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    X_PL: &[Pose<T>; J],
    base: Sum<T>,
    links: &mut [Sum<T>; J],
) -> Sum<T> {
    let mut sum = base;
    for j in robot.joints().rev() {
        let own = links[j];
        match robot.joint(j).parent {
            BodyId::Link(p) if p < J => links[p] = links[p].and(&X_PL[j], &own),
            _ => sum = sum.and(&X_PL[j], &own),
        }
    }
    sum
}

/// How a link turns and how its origin accelerates, in its own axes (rad/s, rad/s², m/s²).
#[derive(Debug, Clone, Copy)]
struct Moving<T> {
    w: Vec3<T>,
    wdot: Vec3<T>,
    /// The classical acceleration.
    a: Vec3<T>,
}

impl<T: Real> Moving<T> {
    #[inline(always)]
    fn at_rest() -> Self {
        Self { w: Vec3::zero(), wdot: Vec3::zero(), a: Vec3::zero() }
    }
    /// The link behind a joint that this body carries.
    #[inline(always)]
    fn of_child(&self, joint: &Joint<T>, X_PL: &Pose<T>, motion: &SetPoint<T>) -> Self {
        let (R, p) = (&X_PL.rotation, X_PL.translation);
        let at_origin = self.a + self.wdot.cross(p) + self.w.cross(self.w.cross(p));
        let (w, wdot) = (R.transpose_mul(self.w), R.transpose_mul(self.wdot));
        let a = R.transpose_mul(at_origin);
        let (rate, gain) = (joint.axis_B * motion.rate, joint.axis_B * motion.acceleration);
        match joint.kind {
            JointKind::Revolute => Self { w: w + rate, wdot: wdot + gain + w.cross(rate), a },
            JointKind::Prismatic => {
                Self { w, wdot, a: a + gain + w.cross(rate) * T::from_f64(2.0) }
            }
        }
    }
    /// The force that a body takes to move so, about its origin.
    #[inline(always)]
    fn force(&self, M: &SpatialInertia<T>) -> SpatialForce<T> {
        let (h, I) = (M.first_moment, M.rotational);
        SpatialForce::new(
            I * self.wdot + self.w.cross(I * self.w) + h.cross(self.a),
            self.a * M.mass + self.wdot.cross(h) + self.w.cross(self.w.cross(h)),
        )
    }
}

/// Joints in motion on a base that does not turn: what each carries, and all of it at the base.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Swing<T, const J: usize> {
    X_PL: [Pose<T>; J],
    /// Sum over all that a joint carries, about its link's origin in its axes.
    carried: [Sum<T>; J],
    /// Force that holds the base at rest.
    pub(crate) base: Sum<T>,
}

impl<T: Real, const J: usize> Swing<T, J> {
    /// With these positions, rates and accelerations of the joints.
    ///
    /// # Source
    /// [`Featherstone2008`](wrasse_spatial::references::Featherstone2008) ch. 5.
    #[inline(always)]
    pub(crate) fn new(robot: &Robot<T, J>, joints: &[SetPoint<T>; J]) -> Self {
        let rest = Moving::at_rest();
        let base = Sum::new(robot.inertia(BodyId::Base), SpatialForce::zero());
        let (mut X_PL, mut carried) = ([Pose::identity(); J], [base; J]);
        let mut moving = [rest; J];
        for j in robot.joints() {
            let (joint, M) = (robot.joint(j), robot.inertia(BodyId::Link(j)));
            X_PL[j] = joint.X_PB(joints[j].position);
            moving[j] = of_parent(joint, &rest, &moving).of_child(joint, &X_PL[j], &joints[j]);
            carried[j] = Sum::new(M, moving[j].force(M));
        }
        let base = at_base(robot, &X_PL, base, &mut carried);
        Self { X_PL, carried, base }
    }
    /// What the motors give for it (N·m, N), while the base gives way with the acceleration `a_B`
    /// (m/s², base axes).
    #[inline(always)]
    pub(crate) fn effort(&self, robot: &Robot<T, J>, a_B: Vec3<T>) -> [T; J] {
        let (mut effort, mut a) = ([T::zero(); J], [a_B; J]);
        for j in robot.joints() {
            let (joint, own) = (robot.joint(j), &self.carried[j]);
            a[j] = self.X_PL[j].rotation.transpose_mul(of_parent(joint, &a_B, &a));
            let along = SpatialForce::new(own.first_moment.cross(a[j]), a[j] * own.mass);
            effort[j] = joint.project(&(own.F + along));
        }
        effort
    }
}

/// What belongs to the body that carries a joint.
#[inline(always)]
fn of_parent<T, E: Copy>(joint: &Joint<T>, base: &E, links: &[E]) -> E {
    match joint.parent {
        BodyId::Base => *base,
        BodyId::Link(p) => *links.get(p).unwrap_or(base),
    }
}
