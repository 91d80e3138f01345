//! What a task asks of the base, over time.

use wrasse_spatial::Vec3;

/// What the actuators of the base have to give while a task is done, sample by sample. Base axes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Demand {
    /// Times of the samples (s).
    pub time: Vec<f64>,
    /// Torque that they give the base (N·m).
    pub torque_B: Vec<Vec3<f64>>,
    /// Momentum that they have stored since the start (N·m·s): the sum of the torque, turned round.
    pub momentum_B: Vec<Vec3<f64>>,
    /// Force that would hold the base where it is, against what pulls at the tool (N).
    pub force_B: Vec<Vec3<f64>>,
}

/// Most samples that the verdicts look at; the peaks are always among them.
const LOOKED_AT: usize = 200;

impl Demand {
    /// How long the task takes (s).
    pub fn duration(&self) -> f64 {
        match (self.time.first(), self.time.last()) {
            (Some(first), Some(last)) => last - first,
            _ => 0.0,
        }
    }
    /// The largest torque (N·m).
    pub fn peak_torque(&self) -> Vec3<f64> {
        largest(&self.torque_B)
    }
    /// The largest momentum (N·m·s).
    pub fn peak_momentum(&self) -> Vec3<f64> {
        largest(&self.momentum_B)
    }
    /// Largest component about each axis, whenever it is (N·m).
    pub fn torque_by_axis(&self) -> Vec3<f64> {
        self.torque_B.iter().fold(Vec3::zero(), |most, torque| {
            let (a, b) = (most.to_array(), torque.to_array());
            Vec3::from_array(core::array::from_fn(|k| f64::max(a[k], b[k].abs())))
        })
    }
    /// Momentum that is gathered every second at the end (N·m·s/s), if the end is no rest: more than a
    /// twentieth of the peak.
    pub fn sustained(&self) -> Option<Vec3<f64>> {
        let last = -*self.torque_B.last()?;
        (last.norm() > 0.05 * self.peak_torque().norm()).then_some(last)
    }
    /// The samples that the verdicts look at: evenly, and the peaks.
    #[must_use]
    pub fn thinned(&self) -> Self {
        let count = self.time.len();
        let stride = count.div_ceil(LOOKED_AT).max(1);
        let peaks = [&self.torque_B, &self.momentum_B].map(|all| place_of_largest(all));
        let kept: Vec<usize> =
            (0..count).filter(|k| k % stride == 0 || k + 1 == count || peaks.contains(k)).collect();
        let pick = |all: &[Vec3<f64>]| kept.iter().filter_map(|k| all.get(*k).copied()).collect();
        Self {
            time: kept.iter().map(|k| self.time[*k]).collect(),
            torque_B: pick(&self.torque_B),
            momentum_B: pick(&self.momentum_B),
            force_B: pick(&self.force_B),
        }
    }
    /// What is left if as much of the torque as there is along its direction is taken all the while;
    /// `takes`: largest torque along a unit vector (N·m).
    #[must_use]
    pub fn residual(&self, takes: impl Fn(Vec3<f64>) -> f64) -> Self {
        let left = |torque: &Vec3<f64>| {
            let size = torque.norm();
            if size > 0.0 { (1.0 - takes(*torque * (1.0 / size)) / size).max(0.0) } else { 0.0 }
        };
        let left: Vec<f64> = self.torque_B.iter().map(left).collect();
        // Of what is gathered between two samples the same share is left as of the torque.
        let mut held = self.momentum_B.first().copied().unwrap_or_default();
        let spans = self.momentum_B.windows(2).zip(left.windows(2));
        let rest = spans.map(|(h, share)| {
            held += (h[1] - h[0]) * (0.5 * (share[0] + share[1]));
            held
        });
        Self {
            time: self.time.clone(),
            torque_B: self.torque_B.iter().zip(&left).map(|(v, share)| *v * *share).collect(),
            momentum_B: self.momentum_B.iter().take(1).copied().chain(rest).collect(),
            force_B: self.force_B.clone(),
        }
    }
    /// The same motion done more slowly, by a factor: torque falls with its square, momentum with it.
    #[must_use]
    pub fn time_scaled(&self, factor: f64) -> Self {
        Self {
            time: self.time.iter().map(|t| t * factor).collect(),
            torque_B: self.torque_B.iter().map(|v| *v * (1.0 / (factor * factor))).collect(),
            momentum_B: self.momentum_B.iter().map(|v| *v * (1.0 / factor)).collect(),
            force_B: self.force_B.iter().map(|v| *v * (1.0 / (factor * factor))).collect(),
        }
    }
}

fn place_of_largest(all: &[Vec3<f64>]) -> usize {
    let mut best = (0, -1.0);
    for (k, v) in all.iter().enumerate() {
        if v.norm() > best.1 {
            best = (k, v.norm());
        }
    }
    best.0
}

fn largest(all: &[Vec3<f64>]) -> Vec3<f64> {
    all.get(place_of_largest(all)).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_spatial::vec3;

    fn push_and_stop() -> Demand {
        let torque = |t: f64| if t < 500.0 { 2.0 } else { -2.0 };
        let time: Vec<f64> = (0..=1000).map(|k| 0.01 * f64::from(k)).collect();
        Demand {
            torque_B: (0..=1000).map(|k| vec3(0.0, torque(f64::from(k)), 0.0)).collect(),
            momentum_B: time
                .iter()
                .map(|t| vec3(0.0, (5.0 - (t - 5.0).abs()) * -2.0, 0.0))
                .collect(),
            force_B: vec![Vec3::zero(); 1001],
            time,
        }
    }

    #[test]
    fn thinning_keeps_the_ends_and_the_peaks() {
        let (all, few) = (push_and_stop(), push_and_stop().thinned());
        assert!(few.time.len() <= LOOKED_AT + 3 && few.time.len() > LOOKED_AT / 2);
        assert_eq!((few.time[0], few.duration()), (0.0, all.duration()));
        assert_eq!(few.peak_momentum(), vec3(0.0, -10.0, 0.0));
        assert_eq!(few.peak_torque(), all.peak_torque());
        assert_eq!(few.torque_by_axis(), vec3(0.0, 2.0, 0.0));
        assert_eq!(Demand::default().thinned(), Demand::default());
    }

    #[test]
    fn twice_as_slow_asks_for_a_quarter_of_the_torque_and_half_of_the_momentum() {
        let slow = push_and_stop().time_scaled(2.0);
        assert_eq!(slow.duration(), 20.0);
        assert_eq!(slow.peak_torque(), vec3(0.0, 0.5, 0.0));
        assert_eq!(slow.peak_momentum(), vec3(0.0, -5.0, 0.0));
    }

    #[test]
    fn of_what_half_is_taken_half_is_left() {
        let all = push_and_stop();
        assert_eq!(all.residual(|_| 0.0), all);
        let half = all.residual(|_| 1.0);
        assert_eq!(half.peak_torque(), vec3(0.0, 1.0, 0.0));
        // Sums of a thousand roundings. Measured 0.
        assert!((half.peak_momentum() - vec3(0.0, -5.0, 0.0)).norm() < 1e-9);
        assert_eq!(all.residual(|_| 3.0).peak_momentum(), Vec3::zero());
    }

    #[test]
    fn what_ends_under_load_gathers_momentum_on_and_on() {
        assert_eq!(push_and_stop().sustained(), Some(vec3(0.0, 2.0, 0.0)));
        let mut rest = push_and_stop();
        *rest.torque_B.last_mut().unwrap() = Vec3::zero();
        assert_eq!(rest.sustained(), None);
    }
}
