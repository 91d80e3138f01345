//! The ledger: momentum and energy, summed over the bodies one by one, against what was booked by
//! those who act. It never reads the momentum that the integrator carries.

use crate::world::World;
use wrasse_dynamics::{kinematics, kinetic_energy};
use wrasse_spatial::Vec3;

/// Momentum and energy at one instant, from poses and twists alone.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Account {
    /// Linear momentum of everything (N·s).
    pub linear: Vec3<f64>,
    /// Angular momentum of everything about the common centre of mass (N·m·s).
    pub angular: Vec3<f64>,
    /// Kinetic energy of everything (J).
    pub energy: f64,
    /// Sum of the bodies' absolute linear momenta (N·s): the scale of the linear rest.
    pub linear_scale: f64,
    /// Sum of the bodies' absolute angular momenta about the centre of mass (N·m·s).
    pub angular_scale: f64,
    /// Common centre of mass (m).
    pub centre_of_mass: Vec3<f64>,
}

/// The books of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Ledger {
    /// At the start.
    pub start: Account,
    /// Now.
    pub now: Account,
    /// Angular impulse that the attitude actuator gave the bodies (N·m·s).
    pub angular_from_actuator: Vec3<f64>,
    /// Angular impulse from outside about the common centre of mass (N·m·s).
    pub angular_from_outside: Vec3<f64>,
    /// Impulse from outside (N·s).
    pub linear_from_outside: Vec3<f64>,
    /// Work of the joint drives, of the attitude actuator, from outside (J).
    pub work: Vec3<f64>,
    /// Energy change at grasps and releases (J).
    pub energy_at_grasps: f64,
    /// Largest unexplained rests so far: angular (N·m·s), linear (N·s), energy (J).
    pub worst: [f64; 3],
    /// Largest scales so far: angular (N·m·s), linear (N·s), energy (J).
    pub scale: [f64; 3],
}

impl<const J: usize> World<J> {
    /// Momentum and energy of everything, body by body.
    pub fn account(&self) -> Account {
        let state = self.state();
        let k = kinematics(&self.robot, &state);
        // (mass, centre of mass, linear momentum, angular momentum about it)
        let mut parts = Vec::with_capacity(1 + J + self.free.len());
        for body in self.robot.bodies() {
            let (X_NB, M) = (&k.X_NB[body], self.robot.inertia(body));
            if M.mass == 0.0 {
                continue;
            }
            let h_B = *M * k.V_NB_B[body];
            let p_BBcm_B = M.centre_of_mass();
            parts.push((
                M.mass,
                X_NB.point(p_BBcm_B),
                X_NB.rotation * h_B.force,
                X_NB.rotation * h_B.about(p_BBcm_B).torque,
            ));
        }
        let mut energy = kinetic_energy(&k);
        for body in &self.free {
            parts.push((body.matter.M_F_F.mass, body.p_NTcm_N, body.linear, body.angular));
            energy += body.kinetic_energy();
        }
        let mass: f64 = parts.iter().map(|p| p.0).sum();
        let moment = parts.iter().fold(Vec3::zero(), |s, p| s + p.1 * p.0);
        let mut account =
            Account { centre_of_mass: moment * (1.0 / mass), energy, ..Account::default() };
        for (_, p_cm, linear, own) in parts {
            let angular = own + (p_cm - account.centre_of_mass).cross(linear);
            account.linear += linear;
            account.angular += angular;
            account.linear_scale += linear.norm();
            account.angular_scale += angular.norm();
        }
        account
    }
    /// Open the books.
    pub fn open_ledger(&self) -> Ledger {
        let start = self.account();
        Ledger {
            start,
            now: start,
            scale: [start.angular_scale, start.linear_scale, start.energy],
            ..Ledger::default()
        }
    }
    /// Bring the books up to now.
    pub fn update_ledger(&self, ledger: &mut Ledger) {
        ledger.now = self.account();
        ledger.angular_from_actuator = self.booked.from_actuator;
        ledger.angular_from_outside = self.booked.from_outside;
        ledger.linear_from_outside = self.booked.linear;
        ledger.work = self.booked.work;
        ledger.energy_at_grasps = self.energy_at_grasps;
        let rests = ledger.rests();
        let scales = [
            ledger.now.angular_scale.max(ledger.angular_from_actuator.norm()),
            ledger.now.linear_scale,
            ledger.now.energy.max(ledger.work.norm()),
        ];
        for i in 0..3 {
            ledger.worst[i] = ledger.worst[i].max(rests[i]);
            ledger.scale[i] = ledger.scale[i].max(scales[i]);
        }
    }
}

impl Ledger {
    /// What nobody booked: angular (N·m·s), linear (N·s), energy (J).
    pub fn rests(&self) -> [f64; 3] {
        let angular = self.now.angular
            - self.start.angular
            - self.angular_from_actuator
            - self.angular_from_outside;
        let linear = self.now.linear - self.start.linear - self.linear_from_outside;
        let [joints, actuator, outside] = self.work.to_array();
        let energy = self.now.energy
            - self.start.energy
            - (joints + actuator + outside)
            - self.energy_at_grasps;
        [angular.norm(), linear.norm(), energy.abs()]
    }
}
