//! Exact rates: the state carried through the kernels as dual numbers.

use wrasse_dynamics::{GeneralizedVelocity, State};
use wrasse_spatial::{Dual, Mat3, Pose, SpatialForce, SpatialVelocity, Vec3};
use wrasse_testing::random_robot::JOINTS;

/// A state as it moves on: its values now, and their rates.
pub(crate) fn in_time(
    state: &State<f64, JOINTS>,
    nudot: &GeneralizedVelocity<f64, JOINTS>,
) -> State<Dual<f64>, JOINTS> {
    let (R_NB, V) = (state.X_NB.rotation, state.V_NB_B);
    // Ṙ = R [w]×, ṗ = R v.
    let rotation = matrix(&R_NB, &(R_NB * V.angular.skew()));
    let translation = vector(state.X_NB.translation, R_NB * V.linear);
    let joints =
        |x: &[f64; JOINTS], rate: &[f64; JOINTS]| std::array::from_fn(|j| Dual::new(x[j], rate[j]));
    State {
        X_NB: Pose::new(rotation, translation),
        V_NB_B: SpatialVelocity::new(
            vector(V.angular, nudot.base.angular),
            vector(V.linear, nudot.base.linear),
        ),
        q: joints(&state.q, &state.v),
        v: joints(&state.v, &nudot.joints),
    }
}

fn vector(value: Vec3<f64>, rate: Vec3<f64>) -> Vec3<Dual<f64>> {
    Vec3 {
        x: Dual::new(value.x, rate.x),
        y: Dual::new(value.y, rate.y),
        z: Dual::new(value.z, rate.z),
    }
}

fn matrix(value: &Mat3<f64>, rate: &Mat3<f64>) -> Mat3<Dual<f64>> {
    Mat3 { rows: std::array::from_fn(|i| vector(value.rows[i], rate.rows[i])) }
}

/// The rate of something.
pub(crate) trait Rate {
    type Of;
    fn rate(&self) -> Self::Of;
}
impl Rate for Dual<f64> {
    type Of = f64;
    fn rate(&self) -> f64 {
        self.derivative
    }
}
impl Rate for Vec3<Dual<f64>> {
    type Of = Vec3<f64>;
    fn rate(&self) -> Vec3<f64> {
        self.map(|x| x.derivative)
    }
}
impl Rate for Mat3<Dual<f64>> {
    type Of = Mat3<f64>;
    fn rate(&self) -> Mat3<f64> {
        Mat3 { rows: self.rows.map(|r| r.rate()) }
    }
}
impl Rate for SpatialVelocity<Dual<f64>> {
    type Of = SpatialVelocity<f64>;
    fn rate(&self) -> SpatialVelocity<f64> {
        SpatialVelocity::new(self.angular.rate(), self.linear.rate())
    }
}
impl Rate for SpatialForce<Dual<f64>> {
    type Of = SpatialForce<f64>;
    fn rate(&self) -> SpatialForce<f64> {
        SpatialForce::new(self.torque.rate(), self.force.rate())
    }
}
