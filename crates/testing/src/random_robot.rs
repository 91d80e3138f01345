//! Random trees that could be built: each body is a box with two point masses on it, in general
//! position, so that its inertia is physically possible and nothing is zero by accident.

use std::array;
use wrasse_dynamics::{
    BodyId, Frame, Generalized, GeneralizedVelocity, Joint, JointKind, MassProperties, PerBody,
    Robot, State,
};
use wrasse_spatial::{Pose, Quat, SpatialForce, SpatialVelocity, Sym3, Vec3, vec3};

/// Room for the joints of a random robot.
pub const JOINTS: usize = 12;

/// What a random robot is made from: small, so that a failing case can be printed and repeated.
#[derive(Debug, Clone, Copy)]
pub struct Recipe {
    /// Seed of all its numbers.
    pub seed: u64,
    /// How many joints.
    pub joints: usize,
    /// How many arms begin at the base.
    pub arms: usize,
    /// Chance that a joint slides (–).
    pub sliding: f64,
    /// Chance that a joint does not continue its arm but starts a branch (–).
    pub branching: f64,
}

/// A robot in motion, and what its motion is tested with.
#[derive(Debug)]
pub struct Scene {
    /// The robot.
    pub robot: Robot<f64, JOINTS>,
    /// How it moves.
    pub state: State<f64, JOINTS>,
    /// How that changes.
    pub nudot: GeneralizedVelocity<f64, JOINTS>,
    /// Wrench on each body at its origin, in its axes.
    pub external: PerBody<SpatialForce<f64>, JOINTS>,
    /// A tool on the last body.
    pub frame: Frame<f64>,
    /// Something to hold there.
    pub load: MassProperties<f64>,
    /// A joint vector for whatever a law needs.
    pub xi: [f64; JOINTS],
    /// Which joints follow, where some are driven by force.
    pub follows: [bool; JOINTS],
    /// Another place to be.
    pub X_elsewhere: Pose<f64>,
}

impl Scene {
    /// What a recipe makes.
    #[must_use]
    pub fn new(recipe: &Recipe) -> Self {
        let mut r = Random(recipe.seed);
        let robot = tree(recipe, &mut r);
        let n = recipe.joints;
        let mut joints = |size: f64| array::from_fn(|j| if j < n { r.within(size) } else { 0.0 });
        let (q, v, qddot, xi) = (joints(2.5), joints(1.0), joints(2.0), joints(1.0));
        let state = State { X_NB: r.pose(3.0), V_NB_B: r.twist(0.5), q, v };
        let mut external = PerBody::filled(SpatialForce::zero());
        for body in robot.bodies() {
            external[body] = r.force(5.0);
        }
        Self {
            robot,
            state,
            nudot: Generalized { base: r.twist(1.0), joints: qddot },
            external,
            frame: Frame { body: BodyId::Link(n - 1), X_BF: r.pose(0.4) },
            load: r.matter(30.0, 0.8),
            xi,
            follows: array::from_fn(|_| r.within(1.0) < 0.0),
            X_elsewhere: r.pose(5.0),
        }
    }
}

fn tree(recipe: &Recipe, r: &mut Random) -> Robot<f64, JOINTS> {
    let mass = r.between(20.0, 500.0);
    let base = r.matter(mass, 1.5);
    let mut links = vec![];
    for j in 0..recipe.joints {
        let parent = match j.checked_sub(recipe.arms) {
            None => BodyId::Base,
            Some(_) if r.between(0.0, 1.0) < recipe.branching => BodyId::Link(r.below(j)),
            Some(same_arm) => BodyId::Link(same_arm),
        };
        let slides = r.between(0.0, 1.0) < recipe.sliding;
        let kind = if slides { JointKind::Prismatic } else { JointKind::Revolute };
        let reach = if parent == BodyId::Base { 1.0 } else { 0.5 };
        let joint = Joint::new(parent, kind, r.pose(reach), r.vector(1.0));
        let mass = r.between(0.5, 20.0);
        links.push((joint, r.matter(mass, 0.5)));
    }
    Robot::new(base, &links).expect("parents come first")
}

/// SplitMix64: a few lines, and the same numbers on every machine.
#[derive(Debug)]
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }
    /// A number between two.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
    /// A number of at most this size.
    pub fn within(&mut self, size: f64) -> f64 {
        self.between(-size, size)
    }
    /// A whole number from zero on, below a count.
    pub fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.next() % count as u64).expect("below a count")
    }
    /// A vector whose elements have at most this size.
    pub fn vector(&mut self, size: f64) -> Vec3<f64> {
        vec3(self.within(size), self.within(size), self.within(size))
    }
    /// Any rotation, and a translation whose elements have at most this size (m).
    pub fn pose(&mut self, size: f64) -> Pose<f64> {
        Pose::from_quat(Quat::exp(self.vector(1.8)), self.vector(size))
    }
    /// A twist whose elements have at most this size (rad/s, m/s).
    pub fn twist(&mut self, size: f64) -> SpatialVelocity<f64> {
        SpatialVelocity::new(self.vector(size), self.vector(size))
    }
    /// A wrench whose elements have at most this size (N·m, N).
    pub fn force(&mut self, size: f64) -> SpatialForce<f64> {
        SpatialForce::new(self.vector(size), self.vector(size))
    }
    /// One rigid part of about this mass (kg) and size (m): a box and two point masses.
    pub fn matter(&mut self, mass: f64, size: f64) -> MassProperties<f64> {
        let [a, b, c] = array::from_fn(|_| self.between(0.2 * size, size));
        let twelfth = mass / 12.0;
        let I = Sym3::diagonal(
            twelfth * (b * b + c * c),
            twelfth * (a * a + c * c),
            twelfth * (a * a + b * b),
        );
        let box_at = self.pose(0.5 * size);
        let mut whole = MassProperties::from_central(mass, Vec3::zero(), I).seen_from(&box_at);
        for _ in 0..2 {
            let point = self.vector(size);
            let m = self.between(0.01, 0.2) * mass;
            whole = whole.and(&MassProperties::from_central(m, point, Sym3::zero()));
        }
        let M = whole.M_F_F;
        MassProperties::from_central(M.mass, M.centre_of_mass(), M.central())
    }
}
