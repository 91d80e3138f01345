//! Newton's and Euler's laws link by link, each in its own axes about its own origin: the shorter way
//! where only sums at the base are asked for.

use crate::posture::of_body;
use wrasse_dynamics::{BodyId, JointKind, Link, Robot, Seat};
use wrasse_hardware::SetPoint;
use wrasse_spatial::{Mat3, Real, SpatialForce, SpatialInertia, Turn, Vec3, vec3};

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
    fn and(&self, seat: &Seat<'_, T>, link: &Self) -> Self {
        let moment = seat.to_parent(&link.first_moment) + seat.p_PL_P * link.mass;
        Self {
            F: self.F + seat.force_to_parent(&link.F),
            mass: self.mass + link.mass,
            first_moment: self.first_moment + moment,
        }
    }
}

/// How a body turns and how its origin accelerates, in its own axes (rad/s, rad/s², m/s²).
#[derive(Debug, Clone, Copy)]
struct Moving<T> {
    w: Vec3<T>,
    wdot: Vec3<T>,
    /// The classical acceleration.
    a: Vec3<T>,
    /// How that changes from point to point: `[ẇ]× + [w]×[w]×` (1/s²).
    gradient: Mat3<T>,
}

impl<T: Real> Moving<T> {
    #[inline(always)]
    fn new(w: Vec3<T>, wdot: Vec3<T>, a: Vec3<T>) -> Self {
        let (xx, yy, zz) = (w.x * w.x, w.y * w.y, w.z * w.z);
        let (xy, xz, yz) = (w.x * w.y, w.x * w.z, w.y * w.z);
        let gradient = Mat3::from_rows(
            vec3(-(yy + zz), xy - wdot.z, xz + wdot.y),
            vec3(xy + wdot.z, -(xx + zz), yz - wdot.x),
            vec3(xz - wdot.y, yz + wdot.x, -(xx + yy)),
        );
        Self { w, wdot, a, gradient }
    }
    /// The link behind a joint that this body carries.
    #[inline(always)]
    fn of_child(&self, link: &Link<T>, seat: &Seat<'_, T>, motion: &SetPoint<T>) -> Self {
        let (w, wdot) = (seat.to_link(&self.w), seat.to_link(&self.wdot));
        let a = seat.to_link(&(self.a + self.gradient * seat.p_PL_P));
        // What the turning body does to the motion of the joint, which is along z.
        let (rate, gain) = (motion.rate, motion.acceleration);
        let across = vec3(w.y * rate, -(w.x * rate), gain);
        match link.kind {
            JointKind::Revolute => Self::new(vec3(w.x, w.y, w.z + rate), wdot + across, a),
            JointKind::Prismatic => {
                let two = T::from_f64(2.0);
                Self::new(w, wdot, a + vec3(across.x * two, across.y * two, gain))
            }
        }
    }
    /// The force that a body takes to move so, about its origin.
    #[inline(always)]
    fn force(&self, M: &SpatialInertia<T>) -> SpatialForce<T> {
        let (h, I) = (M.first_moment, M.rotational);
        SpatialForce::new(
            I * self.wdot + self.w.cross(I * self.w) + h.cross(self.a),
            self.a * M.mass + self.gradient * h,
        )
    }
}

/// Joints in motion on a base that does not turn: what each carries, and all of it at the base.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Swing<T, const J: usize> {
    turns: [Turn<T>; J],
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
        let rest = Moving::new(Vec3::zero(), Vec3::zero(), Vec3::zero());
        let base = Sum::new(robot.inertia(BodyId::Base), SpatialForce::zero());
        let mut swing = Self { turns: [Turn::none(); J], carried: [base; J], base };
        let mut moving = [rest; J];
        for j in robot.joints() {
            let (link, motion) = (robot.link(j), &joints[j]);
            swing.turns[j] = Turn::by(link.theta(motion.position));
            let seat = link.seat(swing.turns[j], motion.position);
            moving[j] = of_body(link.parent, &rest, &moving).of_child(link, &seat, motion);
            swing.carried[j] = Sum::new(&link.M_L, moving[j].force(&link.M_L));
        }
        for j in robot.joints().rev() {
            let (link, own) = (robot.link(j), swing.carried[j]);
            let seat = link.seat(swing.turns[j], joints[j].position);
            let parent = match link.parent {
                BodyId::Link(p) if p < J => &mut swing.carried[p],
                _ => &mut swing.base,
            };
            *parent = parent.and(&seat, &own);
        }
        swing
    }
    /// What the motors give for it (N·m, N), while the base gives way with the acceleration `a_B`
    /// (m/s², base axes).
    #[inline(always)]
    pub(crate) fn effort(&self, robot: &Robot<T, J>, a_B: Vec3<T>) -> [T; J] {
        let (mut effort, mut a) = ([T::zero(); J], [a_B; J]);
        for j in robot.joints() {
            let (link, own) = (robot.link(j), &self.carried[j]);
            // Where the joint is along its travel does not turn anything.
            let seat = link.seat(self.turns[j], T::zero());
            a[j] = seat.to_link(&of_body(link.parent, &a_B, &a));
            let along = SpatialForce::new(own.first_moment.cross(a[j]), a[j] * own.mass);
            effort[j] = link.project(&(own.F + along));
        }
        effort
    }
}
