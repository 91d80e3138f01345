//! Preferred gimbal angles: where to start so that a torque in one direction meets no singularity for
//! as long as may be. For planning on the ground: some hundred paths are tried.

use super::cmg_steering::{mean_momentum, torque_axes, used_cmgs};
use super::{cmg_singularity, span::least_norm};
use wrasse_hardware::{CMGS, ControlMomentGyro};
use wrasse_spatial::{Scalar, Vec3};

/// Starts that are tried before the best is improved.
const CANDIDATES: u32 = 256;
/// Steps of a path from no momentum to all that the rotors could have.
const STEPS: i32 = 64;
/// Part of the farthest reach over which a path must stay clear: at the very end all are singular.
const CLEAR: f64 = 0.9;
/// Largest turn of a gimbal in one step (rad): more is needed only at a singularity.
const LARGEST_TURN: f64 = 0.5;
/// First step of the improvement (rad), and how often it is halved.
const FIRST_STEP: f64 = 0.2;
const HALVINGS: i32 = 8;
/// Fractions of √2, √3, √5, √7, √11, √13, √17 and √19 in units of 2⁻³²: their multiples fill a cube of
/// eight dimensions evenly.
const STRIDES: [u32; CMGS] = [
    0x6a09_e667,
    0xbb67_ae85,
    0x3c6e_f372,
    0xa54f_f53a,
    0x510e_527f,
    0x9b05_688c,
    0x1f83_d9ab,
    0x5be0_cd19,
];

/// Gimbal angles (rad) with no momentum in sum, from which the pseudo-inverse carries the momentum
/// farthest along a direction and, over most of that way, stays farthest from singularities.
///
/// `None` if the rotors cannot cancel each other, or the direction has no length.
///
/// # Source
/// [`Vadali1990`](wrasse_spatial::references::Vadali1990) for the idea. The search is this file's own:
/// starts are spread evenly and put to zero momentum, and the best is improved step by step.
pub fn preferred_angles<T: Scalar>(
    cmgs: &[ControlMomentGyro<T>],
    direction_B: Vec3<T>,
) -> Option<[T; CMGS]> {
    let (length, zero) = (direction_B.norm(), [T::zero(); CMGS]);
    if !(length.is_finite() && length > T::zero()) {
        return None;
    }
    let used = used_cmgs(cmgs, [true; CMGS], &zero);
    let along_B = direction_B * (T::one() / length);
    let search = Search { cmgs, used, mean: mean_momentum(cmgs, used), along_B };
    let starts = || (0..CANDIDATES).filter_map(|k| search.without_momentum(&spread(k)));
    let reaches = starts().map(|start| search.path(&start, search.all_momentum()).reached);
    let goal = reaches.fold(T::zero(), T::max) * T::from_f64(CLEAR);
    let mut best: Option<Start<T>> = None;
    for angles in starts() {
        let start = Start { angles, clearance: search.path(&angles, goal).clearance };
        if best.as_ref().is_none_or(|best| start.clearance > best.clearance) {
            best = Some(start);
        }
    }
    Some(search.improved(best?, goal).angles)
}

/// Evenly spread angles (rad), one set for each number.
fn spread<T: Scalar>(number: u32) -> [T; CMGS] {
    let turn = core::f64::consts::TAU / 4_294_967_296.0;
    STRIDES.map(|stride| T::from_f64(turn * f64::from(stride.wrapping_mul(number + 1))))
}

/// Angles to start from, and how far from singularities the path stays.
struct Start<T> {
    angles: [T; CMGS],
    clearance: T,
}

/// How far a path comes (N·m·s), and the least singularity measure on it, zero if it stops short.
struct Path<T> {
    reached: T,
    clearance: T,
}

/// What all paths share.
struct Search<'a, T> {
    cmgs: &'a [ControlMomentGyro<T>],
    used: [bool; CMGS],
    mean: T,
    along_B: Vec3<T>,
}

impl<T: Scalar> Search<'_, T> {
    /// Momentum if all rotors were in line (N·m·s).
    fn all_momentum(&self) -> T {
        let used = self.cmgs.iter().zip(self.used).filter(|(_, used)| *used);
        used.fold(T::zero(), |sum, (cmg, _)| sum + cmg.momentum.abs())
    }
    /// What the momentum of the CMGs in use lacks of a wanted one, over the mean (–).
    fn lacking(&self, angles: &[T; CMGS], wanted: Vec3<T>) -> Vec3<T> {
        let each = self.cmgs.iter().zip(angles).zip(self.used).filter(|(_, used)| *used);
        let momentum = each
            .fold(Vec3::zero(), |h, ((cmg, &angle), _)| h + cmg.spin_axis(angle) * cmg.momentum);
        (wanted - momentum) * (T::one() / self.mean)
    }
    /// Turns (rad) of least norm that bring the momentum towards a wanted one.
    fn turns(&self, angles: &[T; CMGS], wanted: Vec3<T>) -> [T; CMGS] {
        let axes = torque_axes(self.cmgs, self.used, self.mean, angles);
        least_norm(&axes, &self.used, self.lacking(angles, wanted))
    }
    /// The nearest angles with no momentum in sum, if the way there leads to any.
    fn without_momentum(&self, from: &[T; CMGS]) -> Option<[T; CMGS]> {
        let mut angles = *from;
        for _ in 0..30 {
            let turns = self.turns(&angles, Vec3::zero());
            // Far away Newton's step is too long.
            let longest = largest(&turns).max(T::from_f64(LARGEST_TURN));
            let part = T::from_f64(LARGEST_TURN) / longest;
            angles = core::array::from_fn(|k| angles[k] + turns[k] * part);
        }
        let left = self.lacking(&angles, Vec3::zero()).norm();
        let there = |k: usize| if self.used[k] { wrapped(angles[k]) } else { T::zero() };
        let found = left < T::epsilon().sqrt() && self.used != [false; CMGS];
        found.then(|| core::array::from_fn(there))
    }
    /// The path of the pseudo-inverse along the direction as far as a goal (N·m·s).
    fn path(&self, start: &[T; CMGS], goal: T) -> Path<T> {
        let step = self.all_momentum() / T::from_f64(f64::from(STEPS));
        let (mut angles, mut reached) = (*start, T::zero());
        let mut clearance = cmg_singularity(self.cmgs, &self.used, &angles);
        while reached < goal {
            let next = (reached + step).min(goal);
            // Twice: the second turn takes back what the first strays.
            for _ in 0..2 {
                let turns = self.turns(&angles, self.along_B * next);
                if largest(&turns) > T::from_f64(LARGEST_TURN) {
                    return Path { reached, clearance: T::zero() };
                }
                angles = core::array::from_fn(|k| angles[k] + turns[k]);
            }
            let astray = self.lacking(&angles, self.along_B * next).norm();
            if astray * self.mean > step * T::from_f64(0.1) {
                return Path { reached, clearance: T::zero() };
            }
            clearance = clearance.min(cmg_singularity(self.cmgs, &self.used, &angles));
            reached = next;
        }
        Path { reached, clearance }
    }
    /// The best start nearby: each gimbal is moved to either side, all are put to zero momentum again;
    /// when none is better, the step is halved.
    fn improved(&self, mut best: Start<T>, goal: T) -> Start<T> {
        let mut step = T::from_f64(FIRST_STEP);
        for _ in 0..HALVINGS {
            for k in 0..2 * CMGS {
                let mut moved = best.angles;
                moved[k / 2] += if k % 2 == 0 { step } else { -step };
                let Some(angles) = self.without_momentum(&moved) else { continue };
                let clearance = self.path(&angles, goal).clearance;
                if clearance > best.clearance {
                    best = Start { angles, clearance };
                }
            }
            step *= T::from_f64(0.5);
        }
        best
    }
}

/// Largest magnitude.
fn largest<T: Scalar>(of: &[T; CMGS]) -> T {
    of.iter().fold(T::zero(), |most, x| most.max(x.abs()))
}

/// An angle (rad) in (-π, π].
fn wrapped<T: Scalar>(angle: T) -> T {
    let (sin, cos) = angle.sin_cos();
    sin.atan2(cos)
}
