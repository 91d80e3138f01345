//! Runs a law on many robots and says how well it held; matrices as the laws need them.

use nalgebra::{DMatrix, DVector};
use proptest::prelude::{Strategy, any};
use proptest::test_runner::{Config, RngSeed, TestCaseError, TestRunner};
use std::cell::Cell;
use std::thread;
use wrasse_dynamics::{Generalized, MassMatrix, Robot};
use wrasse_spatial::SpatialVelocity;
use wrasse_testing::random_robot::{JOINTS, Recipe, Scene};
use wrasse_testing::{Numbers, larger};

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
        worst.set(larger(worst.get(), found));
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
