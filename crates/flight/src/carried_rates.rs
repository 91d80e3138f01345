//! Joint rates that a phase begins with and that its own path does not have: they fade. A path that
//! begins at rest under joints that move would ask for their whole momentum within one period.

use crate::trajectory::JointSetPoint;
use wrasse_spatial::Scalar;

/// Time in which the rates fade (s).
pub(crate) const FADE: f64 = 1.0;

/// Share of a motion that is left at `s` of its way to rest (–), its integral from the start, and its
/// derivative: `(1 - s)³ (1 + 3 s)`, whose change begins gently.
pub(crate) fn to_rest<T: Scalar>(s: T) -> (T, T, T) {
    let c = T::from_f64;
    let (rest, three) = (T::one() - s, c(3.0) * s);
    let square = rest * rest;
    let fourth = square * square;
    let integral = c(0.4) - fourth + c(0.6) * fourth * rest;
    (square * rest * (T::one() + three), integral, c(-4.0) * three * square)
}

/// Rate up to which a joint counts as standing (rad/s or m/s): to stop it within a period of 10 ms
/// takes 0.01 rad/s², the start of a slow move.
const STANDING: f64 = 1e-4;

/// Rates at the start of a phase, where they began, and how long they take to fade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CarriedRates<T, const J: usize> {
    q: [T; J],
    v: [T; J],
    /// (s)
    fade: T,
}

impl<T: Scalar, const J: usize> CarriedRates<T, J> {
    /// Those of joints at `q` (rad or m) with rates `v` (rad/s or m/s); `None` if all of them stand.
    pub(crate) fn of(q: [T; J], v: [T; J]) -> Option<Self> {
        let moves = v.iter().any(|v| v.to_f64().abs() > STANDING);
        moves.then(|| Self { q, v, fade: T::from_f64(FADE) })
    }

    /// The same, gone by the end of a way of this duration (s).
    pub(crate) fn within(self, duration: T) -> Self {
        Self { fade: self.fade.min(duration), ..self }
    }

    /// The share of the fading that is done at time `t` (s) of the phase (–).
    fn share(&self, t: T) -> T {
        (t / self.fade).min(T::one())
    }

    /// Whether they are gone at time `t` (s) of the phase.
    pub(crate) fn are_gone(&self, t: T) -> bool {
        t > self.fade
    }

    /// Joints that come to rest from them.
    pub(crate) fn to_rest(self, t: T) -> JointSetPoint<T, J> {
        let (rate, way, acceleration) = to_rest(self.share(t));
        let (way, acceleration) = (way * self.fade, acceleration / self.fade);
        JointSetPoint {
            q: core::array::from_fn(|j| self.q[j] + self.v[j] * way),
            v: self.v.map(|v| v * rate),
            vdot: self.v.map(|v| v * acceleration),
        }
    }

    /// Joints on a way that begins at rest, with what the rates add to it: `v T s (1 - s)³ (1 + 3 s)`,
    /// nothing once they are gone.
    pub(crate) fn beside(self, way: &JointSetPoint<T, J>, t: T) -> JointSetPoint<T, J> {
        let (c, s) = (T::from_f64, self.share(t));
        let rest = T::one() - s;
        let square = rest * rest;
        let position = self.fade * s * square * rest * (T::one() + c(3.0) * s);
        let rate = square * (T::one() + s * (c(2.0) - c(15.0) * s));
        let acceleration = c(-12.0) * s * rest * (c(3.0) - c(5.0) * s) / self.fade;
        JointSetPoint {
            q: core::array::from_fn(|j| way.q[j] + self.v[j] * position),
            v: core::array::from_fn(|j| way.v[j] + self.v[j] * rate),
            vdot: core::array::from_fn(|j| way.vdot[j] + self.v[j] * acceleration),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn carried() -> CarriedRates<f64, 1> {
        CarriedRates::of([0.7], [0.2]).expect("it moves")
    }

    /// Rate and acceleration are the derivatives of the position. Central differences over 1e-5 s:
    /// measured 6e-11 and 4e-11, from the third derivative and rounding.
    #[track_caller]
    fn is_smooth(at: impl Fn(f64) -> JointSetPoint<f64, 1>, t: f64) {
        let h = 1e-5;
        let (before, now, after) = (at(t - h), at(t), at(t + h));
        let rate = (after.q[0] - before.q[0]) / (2.0 * h);
        let acceleration = (after.v[0] - before.v[0]) / (2.0 * h);
        assert!((rate - now.v[0]).abs() < 1e-9, "{rate} {now:?}");
        assert!((acceleration - now.vdot[0]).abs() < 1e-9, "{acceleration} {now:?}");
    }

    #[test]
    fn rates_go_on_at_first_and_are_gone_after_their_time() {
        let way = JointSetPoint { q: [1.0], v: [0.1], vdot: [0.0] };
        for t in [0.1, 0.4, 0.8] {
            is_smooth(|t| carried().to_rest(t), t);
            let still = JointSetPoint::at_rest([1.0]);
            is_smooth(|t| carried().beside(&still, t), t);
        }
        let (stop, beside) = (carried().to_rest(0.0), carried().beside(&way, 0.0));
        assert_eq!((stop.q, stop.v, stop.vdot), ([0.7], [0.2], [0.0]));
        assert_eq!((beside.q, beside.vdot), ([1.0], [0.0]));
        assert!((beside.v[0] - 0.3).abs() < 1e-15, "{beside:?}");
        let stopped = carried().to_rest(2.0);
        assert_eq!((stopped.v, stopped.vdot), ([0.0], [0.0]));
        assert!((stopped.q[0] - 0.78).abs() < 1e-15, "two fifths of 0.2 rad/s in 1 s: {stopped:?}");
        assert_eq!(carried().beside(&way, 2.0), way);
        assert!(carried().are_gone(1.01) && !carried().are_gone(1.0));
    }

    #[test]
    fn a_short_way_ends_without_them_and_joints_that_stand_carry_none() {
        let way = JointSetPoint::at_rest([1.0]);
        assert_eq!(carried().within(0.2).beside(&way, 0.2), way);
        assert_eq!(CarriedRates::of([0.7], [1e-5]), None);
    }
}
