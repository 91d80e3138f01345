//! Exact derivatives of inverse dynamics: how the forces of a motion change with the motion.
//!
//! Everything is about the base's origin Bo in base axes, so nothing is turned or shifted between
//! bodies, and what a joint carries is a plain sum.

use crate::robot::within;
use crate::{
    BodyId, Generalized, GeneralizedForce, GeneralizedVelocity, Kinematics, MassMatrix, Outside,
    PerBody,
};
use core::ops::AddAssign;
use wrasse_spatial::{
    At, Mat3, Pose, Real, SpatialForce, SpatialInertia, SpatialVelocity, Sym3, Vec3, vec3,
};

/// Derivative of a generalized vector with respect to one number of each joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointColumns<B, T, const J: usize> {
    /// The base's six, one column for each joint.
    pub base: [B; J],
    /// The joints': `joints[row][column]`; zero from the number of joints on.
    pub joints: [[T; J]; J],
}

impl<B: Copy, T: Real, const J: usize> JointColumns<B, T, J> {
    /// Every element of the base's part the same, nothing in the joints' part.
    #[inline(always)]
    pub(crate) fn filled(base: B) -> Self {
        Self { base: [base; J], joints: [[T::zero(); J]; J] }
    }
    /// Column of one joint.
    pub fn column(&self, j: usize) -> Generalized<B, T, J> {
        Generalized { base: self.base[j], joints: self.joints.map(|row| row[j]) }
    }
}

/// Derivative of a generalized vector with respect to six numbers of the base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BaseColumns<B, T, const J: usize> {
    /// The base's six, one column for each of six, angular first.
    pub base: [B; 6],
    /// The joints': `joints[row][column]`; zero from the number of joints on.
    pub joints: [[T; 6]; J],
}

impl<B: Copy, T: Real, const J: usize> BaseColumns<B, T, J> {
    /// Column of one of the base's six.
    pub fn column(&self, c: usize) -> Generalized<B, T, J> {
        Generalized { base: self.base[c], joints: self.joints.map(|row| row[c]) }
    }
}

/// Forces of a motion, and their derivatives.
///
/// The derivative with respect to the base's pose is zero: nothing depends on where in free space
/// the robot is, as long as the wrenches from outside are carried along with their bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InverseDynamicsDerivatives<T, const J: usize> {
    /// Wrench on the base at Bo (base axes) and joint forces.
    pub force: GeneralizedForce<T, J>,
    /// By joint positions.
    pub by_position: JointColumns<SpatialForce<T>, T, J>,
    /// By joint rates.
    pub by_rate: JointColumns<SpatialForce<T>, T, J>,
    /// By the base's twist `V_NB_B`.
    pub by_base_velocity: BaseColumns<SpatialForce<T>, T, J>,
    /// By the generalized acceleration.
    pub by_acceleration: MassMatrix<T, J>,
}

/// How one body moves, and its joint; about Bo, base axes.
#[derive(Clone, Copy)]
pub(crate) struct Motion<T> {
    X_0L: Pose<T>,
    V: SpatialVelocity<T>,
    /// Twist of a unit rate of the joint.
    pub(crate) S: SpatialVelocity<T>,
    /// Its rate of change, carried along with the parent.
    Sdot: SpatialVelocity<T>,
}

impl<T: Real> Motion<T> {
    /// Of the base, which has no joint.
    #[inline(always)]
    fn of_base(V: SpatialVelocity<T>) -> Self {
        let none = SpatialVelocity::zero();
        Self { X_0L: Pose::identity(), V, S: none, Sdot: none }
    }
    /// Of a link from that of its parent.
    #[inline(always)]
    fn of_link<const J: usize>(&self, k: &Kinematics<'_, T, J>, j: usize) -> Self {
        let X_0L = k.posture.X_BL(j);
        let at_L = k.robot.subspace_of(j, X_0L.rotation.column(2));
        let S = at_L.shifted_by(-X_0L.translation);
        Self { X_0L, V: self.V + S * k.state.v[j], S, Sdot: self.V.cross(&S) }
    }
}

/// Matter in motion: sums over its points r that move with ṙ, about Bo, in base axes.
#[derive(Clone, Copy)]
pub(crate) struct Matter<T> {
    mass: T,
    /// `Σ m r`.
    first: Vec3<T>,
    /// `Σ m r rᵀ`.
    second: Sym3<T>,
    /// `Σ m ṙ`: linear momentum.
    flow: Vec3<T>,
    /// `Σ m ṙ rᵀ`.
    flow_moment: Mat3<T>,
}

impl<T: Real> AddAssign for Matter<T> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        self.mass += b.mass;
        self.first += b.first;
        self.second += b.second;
        self.flow += b.flow;
        self.flow_moment = self.flow_moment + b.flow_moment;
    }
}

impl<T: Real> Matter<T> {
    #[inline(always)]
    fn nothing() -> Self {
        Self {
            mass: T::zero(),
            first: Vec3::zero(),
            second: Sym3::zero(),
            flow: Vec3::zero(),
            flow_moment: Mat3::zero(),
        }
    }
    /// Of one body.
    #[inline(always)]
    fn of_body(M_B_B: &SpatialInertia<T>, motion: &Motion<T>) -> Self {
        let (R, p) = (motion.X_0L.rotation, motion.X_0L.translation);
        let turned = R * M_B_B.first_moment;
        let first = turned + p * M_B_B.mass;
        let second = R.congruence(second_moment(&M_B_B.rotational)) + mixed(turned, p, first);
        let (w, u) = (motion.V.angular, motion.V.linear);
        Self {
            mass: M_B_B.mass,
            first,
            second,
            flow: u * M_B_B.mass + w.cross(first),
            flow_moment: cross_rows(w, &second.to_mat3()) + u.outer(first),
        }
    }
    /// `[Σ m r × r̈; Σ m r̈]` for one body at this twist and spatial acceleration.
    #[inline(always)]
    fn force(&self, V: &SpatialVelocity<T>, A: &SpatialVelocity<T>) -> SpatialForce<T> {
        // r̈ = a + α × r + w × ṙ.
        let (alpha, a, w) = (A.angular, A.linear, V.angular);
        let rate = cross_rows(alpha, &self.second.to_mat3())
            + a.outer(self.first)
            + cross_rows(w, &self.flow_moment);
        let force = a * self.mass + alpha.cross(self.first) + w.cross(self.flow);
        SpatialForce::new(moment(&rate), force)
    }
    /// `M V`: momentum of this matter at the twist V, moving as one rigid body.
    #[inline(always)]
    pub(crate) fn times(&self, V: &SpatialVelocity<T>) -> SpatialForce<T> {
        let (w, v, h) = (V.angular, V.linear, self.first);
        let S = &self.second;
        let rotational = w * (S.xx + S.yy + S.zz) - *S * w;
        SpatialForce::new(rotational + h.cross(v), v * self.mass - h.cross(w))
    }
    /// `[2 Σ m r × (w × ṙ); 2 Σ m w × ṙ]`: force that keeps the matter's motion while its axes
    /// turn with w.
    #[inline(always)]
    fn coriolis(&self, w: Vec3<T>) -> SpatialForce<T> {
        let [x, y, z] = self.flow_moment.rows;
        let torque = w * (x.x + y.y + z.z) - self.flow_moment * w;
        let force = w.cross(self.flow);
        SpatialForce::new(torque + torque, force + force)
    }
    /// What gives the torque of [`coriolis`](Self::coriolis) of w.
    #[inline(always)]
    fn coriolis_moment(&self) -> Mat3<T> {
        let [x, y, z] = self.flow_moment.rows;
        let trace = x.x + y.y + z.z;
        let once = Sym3::diagonal(trace, trace, trace).to_mat3() - self.flow_moment;
        once + once
    }
    /// The transpose: its product with w is `V · coriolis(w)`.
    #[inline(always)]
    fn coriolis_transposed(&self, V: &SpatialVelocity<T>) -> Vec3<T> {
        let [x, y, z] = self.flow_moment.rows;
        let w = V.angular * (x.x + y.y + z.z) - self.flow_moment.transpose_mul(V.angular)
            + self.flow.cross(V.linear);
        w + w
    }
    /// As a rigid body's inertia.
    #[inline(always)]
    fn inertia(&self) -> SpatialInertia<T> {
        SpatialInertia {
            mass: self.mass,
            first_moment: self.first,
            rotational: rotational(&self.second),
        }
    }
}

/// `Σ m r rᵀ` from `Σ m (|r|² 1 - r rᵀ)`.
#[inline(always)]
fn second_moment<T: Real>(I: &Sym3<T>) -> Sym3<T> {
    let half = (I.xx + I.yy + I.zz) * T::from_f64(0.5);
    let (xx, yy, zz) = (half - I.xx, half - I.yy, half - I.zz);
    Sym3 { xx, yy, zz, xy: -I.xy, xz: -I.xz, yz: -I.yz }
}

/// `Σ m (|r|² 1 - r rᵀ)` from `Σ m r rᵀ`.
#[inline(always)]
fn rotational<T: Real>(S: &Sym3<T>) -> Sym3<T> {
    let (xx, yy, zz) = (S.yy + S.zz, S.xx + S.zz, S.xx + S.yy);
    Sym3 { xx, yy, zz, xy: -S.xy, xz: -S.xz, yz: -S.yz }
}

/// `h pᵀ + p gᵀ`, symmetric because g differs from h by a multiple of p.
#[inline(always)]
fn mixed<T: Real>(h: Vec3<T>, p: Vec3<T>, g: Vec3<T>) -> Sym3<T> {
    Sym3 {
        xx: h.x * p.x + p.x * g.x,
        xy: h.x * p.y + p.x * g.y,
        xz: h.x * p.z + p.x * g.z,
        yy: h.y * p.y + p.y * g.y,
        yz: h.y * p.z + p.y * g.z,
        zz: h.z * p.z + p.z * g.z,
    }
}

/// `[w]× M`.
#[inline(always)]
fn cross_rows<T: Real>(w: Vec3<T>, M: &Mat3<T>) -> Mat3<T> {
    let [x, y, z] = M.rows;
    let cross = [z * w.y - y * w.z, x * w.z - z * w.x, y * w.x - x * w.y];
    Mat3 { rows: cross }
}

/// `Σ r × f` from `Σ f rᵀ`.
#[inline(always)]
fn moment<T: Real>(M: &Mat3<T>) -> Vec3<T> {
    let [x, y, z] = M.rows;
    vec3(z.y - y.z, x.z - z.x, y.x - x.y)
}

/// All bodies, their motion and their matter.
pub(crate) struct Bodies<T, const J: usize> {
    motions: PerBody<Motion<T>, J>,
    /// Each body's own.
    matter: PerBody<Matter<T>, J>,
    /// With all that the body carries.
    carried: PerBody<Matter<T>, J>,
}

/// What an acceleration takes.
pub(crate) struct Forces<T, const J: usize> {
    A: PerBody<SpatialVelocity<T>, J>,
    /// Force on each body with all that it carries, less what pushes from outside.
    F: PerBody<SpatialForce<T>, J>,
}

impl<T: Real, const J: usize> Bodies<T, J> {
    /// Nothing yet: made apart and then filled, so that it need not be moved.
    #[inline(always)]
    pub(crate) fn nothing() -> Self {
        let matter = PerBody::filled(Matter::nothing());
        let still = Motion::of_base(SpatialVelocity::zero());
        Self { motions: PerBody::filled(still), matter, carried: matter }
    }
    /// As they are and move in this state.
    #[inline(always)]
    pub(crate) fn observe(&mut self, k: &Kinematics<'_, T, J>) {
        let base = Motion::of_base(k.state.V_NB_B);
        let matter = Matter::of_body(k.robot.inertia(BodyId::Base), &base);
        (self.motions.base, self.matter.base, self.carried.base) = (base, matter, matter);
        for j in k.robot.joints() {
            let motion = self.motions[k.robot.joint(j).parent].of_link(k, j);
            let matter = Matter::of_body(&k.robot.links.M_L.at(j), &motion);
            self.motions.links[j] = motion;
            (self.matter.links[j], self.carried.links[j]) = (matter, matter);
        }
        for j in k.robot.joints().rev() {
            let behind = self.carried.links[j];
            self.carried[k.robot.joint(j).parent] += behind;
        }
    }
    /// Forces that the accelerations take.
    #[inline(always)]
    pub(crate) fn forces(
        &self,
        k: &Kinematics<'_, T, J>,
        nudot: &GeneralizedVelocity<T, J>,
        outside: &Outside<'_, T, J>,
    ) -> Forces<T, J> {
        let force = |body: BodyId, A: &SpatialVelocity<T>| {
            let motion = &self.motions[body];
            let taken = self.matter[body].force(&motion.V, A);
            match (body, outside.links) {
                (BodyId::Base, _) => taken - outside.base,
                (BodyId::Link(j), Some(links)) => {
                    let F = Outside::on_link(k.robot, &k.posture, j, &links[j]);
                    taken - F.about(-motion.X_0L.translation)
                }
                (BodyId::Link(_), None) => taken,
            }
        };
        let mut found = Forces {
            A: PerBody::filled(nudot.base),
            F: PerBody::filled(force(BodyId::Base, &nudot.base)),
        };
        for j in k.robot.joints() {
            let own = &self.motions.links[j];
            let A_P = found.A[k.robot.joint(j).parent];
            found.A.links[j] = A_P + own.S * nudot.joints[j] + own.Sdot * k.state.v[j];
            found.F.links[j] = force(BodyId::Link(j), &found.A.links[j]);
        }
        for j in k.robot.joints().rev() {
            let behind = found.F.links[j];
            found.F[k.robot.joint(j).parent] += behind;
        }
        found
    }
    /// Add what more accelerations take of the links; no derivative asks for the force on the base.
    #[inline(always)]
    pub(crate) fn accelerate(
        &self,
        k: &Kinematics<'_, T, J>,
        more: &GeneralizedVelocity<T, J>,
        forces: &mut Forces<T, J>,
    ) {
        let (mut A, mut F) = ([more.base; J], [SpatialForce::zero(); J]);
        for j in k.robot.joints() {
            let A_P = *k.robot.joint(j).parent.of(&more.base, &A);
            A[j] = A_P + self.motions.links[j].S * more.joints[j];
            F[j] = self.matter.links[j].times(&A[j]);
            forces.A.links[j] += A[j];
        }
        for j in k.robot.joints().rev() {
            let behind = F[j];
            forces.F.links[j] += behind;
            if let BodyId::Link(p) = k.robot.joint(j).parent {
                F[within::<J>(p)] += behind;
            }
        }
        forces.A.base += more.base;
    }
    /// What the base and the motors feel of the forces.
    #[inline(always)]
    pub(crate) fn project(
        &self,
        k: &Kinematics<'_, T, J>,
        forces: &Forces<T, J>,
    ) -> GeneralizedForce<T, J> {
        let mut felt = Generalized { base: forces.F.base, joints: [T::zero(); J] };
        for j in k.robot.joints() {
            felt.joints[j] = self.motions.links[j].S.power(&forces.F.links[j]);
        }
        felt
    }
    /// The mass matrix, into a place that is zero.
    #[inline(always)]
    pub(crate) fn mass_matrix_into(&self, k: &Kinematics<'_, T, J>, M: &mut MassMatrix<T, J>) {
        M.base.count = k.robot.joint_count();
        M.base.M_bb = self.carried.base.inertia();
        for j in k.robot.joints() {
            let S = self.motions.links[j].S;
            let inertial = self.carried.links[j].times(&S);
            M.base.S.put(j, S);
            M.base.M_bj.put(j, inertial);
            for i in k.robot.path_to_base(BodyId::Link(j)) {
                let M_ij = self.motions.links[i].S.power(&inertial);
                M.M_jj[i][j] = M_ij;
                M.M_jj[j][i] = M_ij;
            }
            M.M_jj[j][j] += k.robot.links.rotor[j];
        }
    }
}

/// Forces of a motion and their derivatives by positions, velocities and accelerations.
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `nudot` | `[ẇ_NB_B; v̇_NB_B; q̈]`, time derivatives of the components | rad/s², m/s² |
/// | `outside` | wrench on each body at its origin, in its axes | N·m, N |
///
/// # Source
/// [`CarpentierMansard2018`](wrasse_spatial::references::CarpentierMansard2018),
/// [`Singh2022`](wrasse_spatial::references::Singh2022).
#[doc(alias = "rnea derivatives")]
#[inline]
pub fn inverse_dynamics_derivatives<'a, T: Real, const J: usize>(
    k: &Kinematics<'_, T, J>,
    nudot: &GeneralizedVelocity<T, J>,
    outside: impl Into<Outside<'a, T, J>>,
) -> InverseDynamicsDerivatives<T, J> {
    let mut found = InverseDynamicsDerivatives::nothing();
    found.fill(k, nudot, &outside.into());
    found
}

impl<T: Real, const J: usize> InverseDynamicsDerivatives<T, J> {
    /// All zero.
    #[inline(always)]
    pub(crate) fn nothing() -> Self {
        let no_force = SpatialForce::zero();
        Self {
            force: Generalized::default(),
            by_position: JointColumns::filled(no_force),
            by_rate: JointColumns::filled(no_force),
            by_base_velocity: BaseColumns { base: [no_force; 6], joints: [[T::zero(); 6]; J] },
            by_acceleration: MassMatrix::new(),
        }
    }
    /// All of it, into a place that is zero.
    fn fill(
        &mut self,
        k: &Kinematics<'_, T, J>,
        nudot: &GeneralizedVelocity<T, J>,
        outside: &Outside<'_, T, J>,
    ) {
        let mut bodies = Bodies::nothing();
        bodies.observe(k);
        bodies.mass_matrix_into(k, &mut self.by_acceleration);
        let forces = bodies.forces(k, nudot, outside);
        self.force = bodies.project(k, &forces);
        let rotor = &k.robot.links.rotor;
        k.robot.joints().for_each(|j| self.force.joints[j] += rotor[j] * nudot.joints[j]);
        self.differentiate(k, &bodies, &forces);
    }
    /// The derivatives by positions and velocities; that by acceleration is there.
    #[inline(always)]
    pub(crate) fn differentiate(
        &mut self,
        k: &Kinematics<'_, T, J>,
        bodies: &Bodies<T, J>,
        forces: &Forces<T, J>,
    ) {
        let mut Sddot = [SpatialVelocity::zero(); J];
        for j in k.robot.joints() {
            let (parent, own) = (k.robot.joint(j).parent, &bodies.motions.links[j]);
            let V_P = &bodies.motions[parent].V;
            Sddot[j] = forces.A[parent].cross(&own.S) + V_P.cross(&own.Sdot);
            self.differentiate_joint(k, bodies, j, &Sddot, &forces.F.links[j]);
        }
        self.differentiate_base(&bodies.motions.base.V, &bodies.carried.base);
    }
    /// Of the wrench on the base, by the base's twist V.
    #[inline(always)]
    fn differentiate_base(&mut self, V: &SpatialVelocity<T>, all: &Matter<T>) {
        let (turns, moves) = (V.angular.skew(), V.linear.skew());
        let (coriolis, push) = (all.coriolis_moment(), (all.flow + all.flow).skew());
        let columns = &mut self.by_base_velocity.base;
        for c in 0..3 {
            // V × S for a unit rate S about an axis; along it, it is the acceleration a.
            let turning = SpatialVelocity::new(turns.column(c), moves.column(c));
            let own = SpatialForce::new(coriolis.column(c), -push.column(c));
            columns[c] = all.times(&turning) + own;
            let a = turns.column(c);
            columns[c + 3] = SpatialForce::new(all.first.cross(a), a * all.mass);
        }
    }
    /// All elements between joint j and the base and joints below it.
    #[inline(always)]
    fn differentiate_joint(
        &mut self,
        k: &Kinematics<'_, T, J>,
        bodies: &Bodies<T, J>,
        j: usize,
        Sddot: &[SpatialVelocity<T>; J],
        force: &SpatialForce<T>,
    ) {
        let (own, matter) = (&bodies.motions.links[j], &bodies.carried.links[j]);
        // Moved by joint j: what it carries, as one body.
        let inertial = self.by_acceleration.M_bj.at(j);
        let twice = inertial + inertial;
        let position =
            matter.times(&Sddot[j]) + matter.coriolis(own.Sdot.angular) + own.S.cross_force(force);
        let rate = matter.times(&(own.Sdot + own.Sdot)) + matter.coriolis(own.S.angular);
        self.by_position.base[j] = position;
        self.by_rate.base[j] = rate;
        // Felt by joint j: what moves all of it.
        let felt = matter.coriolis_transposed(&own.S);
        let turning = SpatialForce::new(felt, Vec3::zero());
        let by_base = turning - bodies.motions.base.V.cross_force(&inertial);
        self.by_base_velocity.joints[j] = by_base.to_array();
        for i in k.robot.path_to_base(BodyId::Link(j)) {
            let below = &bodies.motions.links[i];
            self.by_position.joints[j][i] =
                Sddot[i].power(&inertial) + below.Sdot.angular.dot(felt);
            self.by_rate.joints[j][i] = below.Sdot.power(&twice) + below.S.angular.dot(felt);
            self.by_position.joints[i][j] = below.S.power(&position);
            self.by_rate.joints[i][j] = below.S.power(&rate);
        }
    }
}
