//! A rigid body that floats by itself: a target before it is grasped, or after it is released.

use wrasse_dynamics::MassProperties;
use wrasse_spatial::{Pose, Quat, SpatialVelocity, Vec3, rotation_vector_rate, turned_by};

/// A free rigid body: attitude, centre of mass and momentum in inertial axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeBody {
    /// Its matter, about its own frame T.
    pub matter: MassProperties<f64>,
    /// Attitude `quat_NT`.
    pub quat_NT: Quat<f64>,
    /// Centre of mass `p_NTcm_N` (m).
    pub p_NTcm_N: Vec3<f64>,
    /// Linear momentum (N·s).
    pub linear: Vec3<f64>,
    /// Angular momentum about its centre of mass, inertial axes (N·m·s).
    pub angular: Vec3<f64>,
}

impl FreeBody {
    /// From its pose `X_NT` and twist `V_NT_T`.
    pub fn new(
        matter: MassProperties<f64>,
        X_NT: &Pose<f64>,
        V_NT_T: &SpatialVelocity<f64>,
    ) -> Self {
        let h_T = matter.M_F_F * *V_NT_T;
        let p_TTcm_T = matter.M_F_F.centre_of_mass();
        Self {
            matter,
            quat_NT: Quat::from_matrix(&X_NT.rotation),
            p_NTcm_N: X_NT.point(p_TTcm_T),
            linear: X_NT.rotation * h_T.force,
            angular: X_NT.rotation * h_T.about(p_TTcm_T).torque,
        }
    }
    /// Pose `X_NT`.
    pub fn pose(&self) -> Pose<f64> {
        let R_NT = self.quat_NT.to_matrix();
        Pose::new(R_NT, self.p_NTcm_N - R_NT * self.matter.M_F_F.centre_of_mass())
    }
    /// Twist `V_NT_T`.
    pub fn twist(&self) -> SpatialVelocity<f64> {
        let (M, R_NT) = (&self.matter.M_F_F, self.quat_NT.to_matrix());
        let w = M.central().solve(R_NT.transpose_mul(self.angular));
        let v_cm = R_NT.transpose_mul(self.linear) * (1.0 / M.mass);
        SpatialVelocity::new(w, v_cm - w.cross(M.centre_of_mass()))
    }
    /// Kinetic energy (J).
    pub fn kinetic_energy(&self) -> f64 {
        let V = self.twist();
        0.5 * V.power(&(self.matter.M_F_F * V))
    }
    /// Advance by `h` (s) where nothing pushes it, as a plan does: momentum stays, the attitude follows
    /// it, by a Runge–Kutta step of order 4.
    pub fn step(&mut self, h: f64) {
        let I = self.matter.M_F_F.central();
        let rate = |u: Vec3<f64>| {
            let R_NT = (self.quat_NT * Quat::exp(u)).to_matrix();
            rotation_vector_rate(u, I.solve(R_NT.transpose_mul(self.angular)))
        };
        let a = rate(Vec3::zero());
        let b = rate(a * (0.5 * h));
        let c = rate(b * (0.5 * h));
        let d = rate(c * h);
        let u = a * (h / 6.0) + b * (h / 3.0) + c * (h / 3.0) + d * (h / 6.0);
        self.quat_NT = turned_by(self.quat_NT, u);
        self.p_NTcm_N += self.linear * (h / self.matter.M_F_F.mass);
    }
}
