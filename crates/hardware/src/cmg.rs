//! Single-gimbal control moment gyros.

use wrasse_spatial::{Real, Scalar, Vec3};

/// Most control moment gyros of one vehicle.
pub const CMGS: usize = 8;

/// A single-gimbal control moment gyro. Its matter is part of the base's; the rotor keeps its speed
/// against the gimbal, the gimbal motor turns it about the gimbal axis.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ControlMomentGyro<T> {
    /// Unit gimbal axis, base axes (–).
    pub gimbal_axis_B: Vec3<T>,
    /// Unit spin axis at zero gimbal angle, base axes, across the gimbal axis (–).
    pub spin_axis_B: Vec3<T>,
    /// Momentum of the rotor (N·m·s).
    pub momentum: T,
    /// Inertia of gimbal and rotor about the gimbal axis (kg·m²).
    pub gimbal_inertia: T,
    /// Largest gimbal rate (rad/s).
    pub rate_limit: T,
    /// Largest gimbal acceleration (rad/s²).
    pub acceleration_limit: T,
    /// Largest torque of the gimbal motor (N·m).
    pub motor_limit: T,
    /// Bandwidth of the gimbal's rate servo (rad/s).
    pub servo_bandwidth: T,
}

impl<T: Real> ControlMomentGyro<T> {
    /// Unit spin axis at a gimbal angle (rad), base axes: `s cos δ + (g × s) sin δ`.
    pub fn spin_axis(&self, angle: T) -> Vec3<T> {
        let (sin, cos) = angle.sin_cos();
        self.spin_axis_B * cos + self.gimbal_axis_B.cross(self.spin_axis_B) * sin
    }
    /// Direction in which the momentum changes as the gimbal turns, base axes (–): the derivative of
    /// the spin axis by the angle.
    pub fn torque_axis(&self, angle: T) -> Vec3<T> {
        let (sin, cos) = angle.sin_cos();
        self.gimbal_axis_B.cross(self.spin_axis_B) * cos - self.spin_axis_B * sin
    }
    /// Largest torque: the rotor's momentum at the largest gimbal rate (N·m).
    pub fn torque_limit(&self) -> T {
        self.momentum * self.rate_limit
    }
}

impl<T: Scalar> ControlMomentGyro<T> {
    /// Mean rate of the gimbal over a period (s) that it begins at `rate` (rad/s) and in which its servo
    /// shall turn it at `wanted` (rad/s).
    ///
    /// The servo closes the gap by its bandwidth, `e^(-bt)`; where its acceleration does not suffice it
    /// closes it evenly. What the motor bears of the turning base is left out.
    pub fn mean_rate(&self, rate: T, wanted: T, period: T) -> T {
        let gap = wanted - rate;
        let bt = self.servo_bandwidth * period;
        // Mean share of the gap that is closed: 1 - (1 - e^(-bt))/bt.
        let closed = T::one() - (T::one() - Scalar::exp(-bt)) / bt;
        let half = T::from_f64(0.5);
        rate + (gap * closed).clamp_to(self.acceleration_limit * period * half)
    }
}

impl ControlMomentGyro<f64> {
    /// The same CMG over another scalar.
    pub fn cast<T: Real>(&self) -> ControlMomentGyro<T> {
        let c = T::from_f64;
        ControlMomentGyro {
            gimbal_axis_B: self.gimbal_axis_B.map(c),
            spin_axis_B: self.spin_axis_B.map(c),
            momentum: c(self.momentum),
            gimbal_inertia: c(self.gimbal_inertia),
            rate_limit: c(self.rate_limit),
            acceleration_limit: c(self.acceleration_limit),
            motor_limit: c(self.motor_limit),
            servo_bandwidth: c(self.servo_bandwidth),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_spatial::vec3;

    fn cmg() -> ControlMomentGyro<f64> {
        ControlMomentGyro {
            gimbal_axis_B: vec3(0.8, 0.0, 0.6),
            spin_axis_B: vec3(0.0, 1.0, 0.0),
            momentum: 2.0,
            ..Default::default()
        }
    }

    /// CMG 1 of the pyramid with sin β = 0.8: spin axis (-0.6 sin δ, cos δ, 0.8 sin δ).
    #[test]
    fn the_spin_axis_turns_about_the_gimbal_axis() {
        let (s, c) = Real::sin_cos(0.7_f64);
        let off = cmg().spin_axis(0.7) - vec3(-0.6 * s, c, 0.8 * s);
        assert!(off.norm() < 1e-15);
    }

    #[test]
    fn the_torque_axis_is_the_derivative_of_the_spin_axis() {
        let (at, h) = (0.7, 1e-5);
        let slope = (cmg().spin_axis(at + h) - cmg().spin_axis(at - h)) * (0.5 / h);
        // Rounding 1e-16/1e-5 and the cube of the step.
        assert!((slope - cmg().torque_axis(at)).norm() < 1e-10);
    }
}
