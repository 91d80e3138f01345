//! Runs a law on many robots and says how well it held; compares what the laws compare.

use crate::random_robot::{JOINTS, Recipe, Scene};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::{Strategy, any};
use proptest::test_runner::{Config, RngSeed, TestCaseError, TestRunner};
use std::cell::Cell;
use std::thread;
use wrasse_dynamics::{Generalized, MassMatrix, Robot};
use wrasse_spatial::{Mat3, Pose, SpatialForce, SpatialVelocity, Vec3};

/// Trees of 1 to 12 joints on 1 to 3 arms, branching, a quarter of the joints sliding.
pub(crate) fn any_robot() -> impl Strategy<Value = Recipe> {
    (any::<u64>(), 1..=JOINTS, 1..=3_usize).prop_map(|(seed, joints, arms)| Recipe {
        seed,
        joints,
        arms,
        sliding: 0.25,
        branching: 0.3,
    })
}

/// The law's relative error must stay within the bound on 256 random trees. The worst one is
/// printed (`--nocapture`): that is the number measured beside each bound. Bounds of round-off
/// stand ten to a hundred times above it: room for another order of summation, none for a wrong
/// term.
#[track_caller]
pub(crate) fn for_every_robot(bound: f64, error: impl Fn(&Scene) -> f64) {
    for_every(any_robot(), bound, error);
}

/// The same for robots of one kind.
#[track_caller]
pub(crate) fn for_every(
    robots: impl Strategy<Value = Recipe>,
    bound: f64,
    error: impl Fn(&Scene) -> f64,
) {
    let config = Config {
        cases: 256,
        rng_seed: RngSeed::Fixed(1957),
        failure_persistence: None,
        ..Config::default()
    };
    let worst = Cell::new(0.0_f64);
    let outcome = TestRunner::new(config).run(&robots, |recipe| {
        let found = error(&Scene::new(&recipe));
        worst.set(worst.get().max(found));
        // Written so that a NaN fails.
        if found <= bound {
            return Ok(());
        }
        Err(TestCaseError::fail(format!("error {found:e}, at most {bound:e} allowed")))
    });
    println!("{}: worst {:.1e}", thread::current().name().unwrap_or("law"), worst.get());
    if let Err(failure) = outcome {
        panic!("{failure}");
    }
}

/// Something made of numbers.
pub(crate) trait Numbers {
    fn numbers(&self) -> Vec<f64>;
}
impl Numbers for f64 {
    fn numbers(&self) -> Vec<f64> {
        vec![*self]
    }
}
impl Numbers for Vec3<f64> {
    fn numbers(&self) -> Vec<f64> {
        self.to_array().to_vec()
    }
}
impl Numbers for Mat3<f64> {
    fn numbers(&self) -> Vec<f64> {
        self.rows.numbers()
    }
}
impl Numbers for Pose<f64> {
    fn numbers(&self) -> Vec<f64> {
        [self.rotation.numbers(), self.translation.numbers()].concat()
    }
}
impl Numbers for SpatialVelocity<f64> {
    fn numbers(&self) -> Vec<f64> {
        self.to_array().to_vec()
    }
}
impl Numbers for SpatialForce<f64> {
    fn numbers(&self) -> Vec<f64> {
        self.to_array().to_vec()
    }
}
impl<E: Numbers, const N: usize> Numbers for [E; N] {
    fn numbers(&self) -> Vec<f64> {
        self.iter().flat_map(Numbers::numbers).collect()
    }
}
impl<E: Numbers> Numbers for Vec<E> {
    fn numbers(&self) -> Vec<f64> {
        self.iter().flat_map(Numbers::numbers).collect()
    }
}
impl<B: Numbers, const N: usize> Numbers for Generalized<B, f64, N> {
    fn numbers(&self) -> Vec<f64> {
        [self.base.numbers(), self.joints.to_vec()].concat()
    }
}
impl Numbers for DMatrix<f64> {
    fn numbers(&self) -> Vec<f64> {
        self.as_slice().to_vec()
    }
}
impl Numbers for DVector<f64> {
    fn numbers(&self) -> Vec<f64> {
        self.as_slice().to_vec()
    }
}

/// Largest element.
pub(crate) fn size(a: &impl Numbers) -> f64 {
    a.numbers().iter().fold(0.0, |m, x| m.max(x.abs()))
}

/// Largest difference, relative to the largest element of either.
pub(crate) fn gap(a: &impl Numbers, b: &impl Numbers) -> f64 {
    gap_at(a, b, size(a).max(size(b)))
}

/// Largest difference relative to a scale: where both sides are sums of terms that cancel.
pub(crate) fn gap_at(a: &impl Numbers, b: &impl Numbers, scale: f64) -> f64 {
    let (a, b) = (a.numbers(), b.numbers());
    assert_eq!(a.len(), b.len(), "as many numbers on either side");
    let mut worst = 0.0;
    for (x, y) in a.iter().zip(&b) {
        let off = (x - y).abs();
        // Not `max`, which would drop a NaN.
        worst = if off <= worst { worst } else { off };
    }
    if worst == 0.0 { 0.0 } else { worst / scale }
}

/// The whole mass matrix, (6+n)×(6+n).
pub(crate) fn dense(M: &MassMatrix<f64, JOINTS>) -> DMatrix<f64> {
    DMatrix::from_fn(6 + M.count, 6 + M.count, |i, j| M.element(i, j))
}

/// The leading n×n part.
pub(crate) fn dense_joints(H: &[[f64; JOINTS]; JOINTS], n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |i, j| H[i][j])
}

/// A generalized vector, 6+n.
pub(crate) fn dense_vector<B: Numbers>(
    robot: &Robot<f64, JOINTS>,
    x: &Generalized<B, f64, JOINTS>,
) -> DVector<f64> {
    let numbers = x.numbers();
    DVector::from_column_slice(&numbers[..6 + robot.joint_count()])
}

/// A 6×m matrix from its columns, angular rows first.
pub(crate) fn dense_columns(columns: &[SpatialVelocity<f64>]) -> DMatrix<f64> {
    DMatrix::from_fn(6, columns.len(), |i, j| columns[j].to_array()[i])
}
