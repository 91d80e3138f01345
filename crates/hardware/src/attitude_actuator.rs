//! An ideal attitude actuator: what it gives of a torque that is wanted.

use wrasse_spatial::{Scalar, Vec3};

/// An ideal attitude actuator: any torque up to a limit, at once, stored as momentum up to a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AttitudeActuator<T> {
    /// Largest torque about each base axis (N·m).
    pub torque_limit: T,
    /// Largest stored momentum about each base axis (N·m·s).
    pub momentum_limit: T,
}

/// Which limit of an ideal attitude actuator cuts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AttitudeActuatorLimit {
    /// Its torque.
    Torque,
    /// What it can store.
    Momentum,
}

impl<T: Scalar> AttitudeActuator<T> {
    /// The torque that it gives over a period (s) of the one that is wanted (N·m, base axes). It stores
    /// `h_B`, which the turning base carries on by `w_x_h_B`; each limit that cuts is noted with its axis.
    pub fn given(
        &self,
        wanted_B: Vec3<T>,
        (h_B, w_x_h_B): (Vec3<T>, Vec3<T>),
        period: T,
        mut note: impl FnMut(AttitudeActuatorLimit, usize),
    ) -> Vec3<T> {
        // Seen from a base that turns, what is stored turns the other way: ḣ_B = -τ - w × h_B.
        let (stored, carried) = (h_B.to_array(), w_x_h_B.to_array());
        let mut given = wanted_B.to_array();
        for axis in 0..3 {
            let wanted = given[axis];
            let torque = wanted.clamp_to(self.torque_limit);
            if torque != wanted {
                note(AttitudeActuatorLimit::Torque, axis);
            }
            // It may reach ± its limit, not pass it: a full actuator gives back what is carried to it,
            // even if nothing is asked, as far as its torque goes. (To first order in the turn over
            // the period.)
            let lowest = (stored[axis] - self.momentum_limit) / period - carried[axis];
            let highest = (stored[axis] + self.momentum_limit) / period - carried[axis];
            let held = if lowest <= highest { torque.max(lowest).min(highest) } else { torque };
            given[axis] = held.clamp_to(self.torque_limit);
            if given[axis] != torque {
                note(AttitudeActuatorLimit::Momentum, axis);
            }
        }
        Vec3::from_array(given)
    }
}

impl AttitudeActuator<f64> {
    /// The same actuator over another scalar.
    pub fn cast<T: Scalar>(&self) -> AttitudeActuator<T> {
        AttitudeActuator {
            torque_limit: T::from_f64(self.torque_limit),
            momentum_limit: T::from_f64(self.momentum_limit),
        }
    }
}
