//! All joint positions of a spherical–revolute–spherical arm for a tool pose and an arm angle.

use super::precision::epsilon;
use super::spherical_joint::{Side, about};
use super::spherical_revolute_spherical::{Branch, SphericalRevoluteSpherical};
use wrasse_spatial::{Mat3, Pose, Scalar, Vec3};

/// Direction that the arm angle is counted from, seen along the line from shoulder to wrist.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reference {
    /// The axis of joint 1 in the zero posture.
    FirstAxis,
    /// The axis of joint 2 in the zero posture: taken where the line runs along the first.
    SecondAxis,
}

/// One set of joint positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmSolution<T> {
    /// Joint positions (rad), each within half a turn of those asked to be near.
    pub q: [T; 7],
    /// How shoulder, elbow and wrist are bent.
    pub branch: Branch,
    /// Sines of the bends of shoulder, elbow and wrist (–): zero is singular.
    pub sines: [T; 3],
    /// Fixed-point passes taken (–).
    pub passes: u32,
    /// Position error that is left (m), up to rounding.
    pub residual: T,
}

/// Up to eight solutions for one pose and arm angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solutions<T> {
    list: [Option<ArmSolution<T>>; 8],
    near: [T; 7],
    /// What the arm angle was counted from.
    pub reference: Reference,
}

/// How a closed-form solve ended. Not reaching the pose is an answer, not an error.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
#[allow(clippy::large_enum_variant, reason = "there is no heap to put the solutions on")]
pub enum ClosedForm<T> {
    /// At least one solution.
    Solved(Solutions<T>),
    /// The wrist would have to be farther from the shoulder than the stretched arm.
    OutOfReach {
        /// Distance asked for (m).
        distance: T,
        /// Largest distance (m).
        reach: T,
    },
    /// The wrist would have to be nearer to the shoulder than the folded arm.
    TooClose {
        /// Distance asked for (m).
        distance: T,
        /// Smallest distance (m).
        nearest: T,
    },
    /// The wrist lies in the shoulder, or the folded arm on the elbow's axis: the arm angle has no
    /// meaning, and every direction of the upper arm is a solution.
    Singular {
        /// Distance of the wrist from the shoulder (m).
        distance: T,
    },
    /// The fixed-point passes did not settle: too much mass beside the axes.
    Unsettled {
        /// Passes taken (–).
        passes: u32,
        /// Position error that is left (m).
        residual: T,
    },
    /// The pose or the arm angle is not finite.
    NotFinite,
}

/// Fixed-point passes at most. Each shrinks the error by the mass that lies beside the axes over the
/// total, times its offset over the arm's length: six passes reach rounding with links 5 cm off their
/// axes on a bus of 1500 kg, twelve with links 10 cm off on one of 400 kg.
const PASSES: u32 = 20;
/// Sine of the angle between reference axis and shoulder–wrist line below which the second axis is
/// taken: near the axis the arm would have to turn 1/sine times as fast as the line.
const PARALLEL: f64 = 0.02;

/// What is asked of the arm: everything but the branch.
struct Aim<'a, T> {
    /// Turn of link 7 since the zero posture.
    R_7: Mat3<T>,
    /// From the shoulder to the wrist, if nothing lay beside the axes (m).
    wrist: Vec3<T>,
    arm_angle: T,
    reference: Reference,
    near: &'a [T; 7],
}

impl<T: Scalar> SphericalRevoluteSpherical<T> {
    /// All solutions for the tool pose `X_AE` and the arm angle (rad), each turned to within half a
    /// turn of the joint positions `near` (rad).
    ///
    /// The arm angle turns the elbow about the line from shoulder to wrist, from the side of the
    /// [`Reference`] axis. For a held attitude, `X_AE` is `[R_BN R_NE, R_BN (p_NE - p_NScm)]`.
    ///
    /// # Source
    /// [`KreutzDelgado1992`](wrasse_spatial::references::KreutzDelgado1992): the arm angle; the
    /// angles by projection on the axes, so that any right-angled shoulder and wrist will do.
    pub fn solve(&self, X_AE: &Pose<T>, arm_angle: T, near: &[T; 7]) -> ClosedForm<T> {
        let R_7 = X_AE.rotation * self.chain.R_BE0.transpose();
        let wrist = X_AE.translation - self.to_shoulder - R_7 * self.hand;
        let size = R_7.rows.iter().fold(wrist.norm() + arm_angle, |sum, row| sum + row.norm());
        if !(size + near.iter().fold(T::zero(), |sum, q| sum + *q)).is_finite() {
            return ClosedForm::NotFinite;
        }
        let reference = self.reference_for(wrist);
        let aim = Aim { R_7, wrist, arm_angle, reference, near };
        let mut solutions = Solutions { list: [None; 8], near: *near, reference };
        let mut failure = ClosedForm::NotFinite;
        for (k, slot) in solutions.list.iter_mut().enumerate() {
            let side = |bit: usize| Side::BOTH[(k >> bit) & 1];
            let branch = Branch { elbow: side(2), shoulder: side(1), wrist: side(0) };
            match self.settle(&aim, branch) {
                Ok(solution) => *slot = Some(solution),
                Err(reason) => failure = reason,
            }
        }
        if solutions.iter().next().is_some() { ClosedForm::Solved(solutions) } else { failure }
    }
    /// Arm angle (rad, in (-π, π]) at joint positions (rad), and what it is counted from.
    pub fn arm_angle(&self, q: &[T; 7]) -> (T, Reference) {
        let (opening_sine, _) = (q[3] + self.elbow.opening_at_zero).sin_cos();
        let side = if opening_sine < T::zero() { Side::Negative } else { Side::Positive };
        let (line_3, side_3) = self.elbow_side(q[3], side);
        let R_3 = self.shoulder.rotation([q[0], q[1], q[2]]);
        let (line, toward_elbow) = (R_3 * line_3, R_3 * side_3);
        let reference = self.reference_for(line);
        let zero = self.zero_side(line, reference);
        let sine = line.dot(zero.cross(toward_elbow)) * (T::one() / line.norm());
        (sine.atan2(zero.dot(toward_elbow)), reference)
    }

    /// Fixed-point passes over what lies beside the axes: none if nothing does.
    fn settle(&self, aim: &Aim<'_, T>, branch: Branch) -> Result<ArmSolution<T>, ClosedForm<T>> {
        let fine = T::from_f64(4.0) * epsilon() * (T::one() + self.elbow.stretched());
        let mut beside = Vec3::zero();
        let mut passes = 0;
        loop {
            let (q, sines) = self.bend(aim, aim.wrist - beside, branch)?;
            let now = self.beside_axes(&self.turns(&q));
            let residual = (now - beside).norm();
            if residual <= fine {
                return Ok(ArmSolution { q, branch, sines, passes, residual });
            }
            if passes == PASSES {
                return Err(ClosedForm::Unsettled { passes, residual });
            }
            beside = now;
            passes += 1;
        }
    }
    /// Joint positions (rad) and sines that bring the wrist to `line` from the shoulder (m).
    fn bend(
        &self,
        aim: &Aim<'_, T>,
        line: Vec3<T>,
        branch: Branch,
    ) -> Result<([T; 7], [T; 3]), ClosedForm<T>> {
        let (q4, elbow_sine) = self.elbow_angle(line.norm(), branch.elbow)?;
        let (line_3, side_3) = self.elbow_side(q4, branch.elbow);
        let zero = self.zero_side(line, aim.reference);
        let distance = line.norm();
        let smallest = T::from_f64(64.0) * epsilon() * self.elbow.stretched();
        if !(side_3.norm() > smallest && distance > smallest && zero.norm() > T::zero()) {
            return Err(ClosedForm::Singular { distance });
        }
        let (sine, cosine) = aim.arm_angle.sin_cos();
        let toward_elbow = zero * cosine + unit(line).cross(zero) * sine;
        // Link 3 carries the line and the side of its own axes to those that are asked for.
        let R_3 = triad(line, toward_elbow) * triad(line_3, side_3).transpose();
        let near = aim.near;
        let ([q1, q2, q3], shoulder_sine) = self.shoulder.angles(&R_3, branch.shoulder, near[0]);
        let R_4 = R_3 * about(self.chain.axes[3], q4);
        let R_47 = R_4.transpose() * aim.R_7;
        let ([q5, q6, q7], wrist_sine) = self.wrist.angles(&R_47, branch.wrist, near[4]);
        let q = [q1, q2, q3, q4, q5, q6, q7];
        let q = core::array::from_fn(|i| unwound(q[i], near[i]));
        Ok((q, [shoulder_sine, elbow_sine, wrist_sine]))
    }
    /// Elbow position (rad) for a distance of the wrist (m), and the sine of its opening.
    fn elbow_angle(&self, distance: T, side: Side) -> Result<(T, T), ClosedForm<T>> {
        let (reach, nearest) = (self.elbow.stretched(), self.elbow.folded());
        let slack = T::from_f64(8.0) * epsilon() * reach;
        if distance > reach + slack {
            return Err(ClosedForm::OutOfReach { distance, reach });
        }
        if distance < nearest - slack {
            return Err(ClosedForm::TooClose { distance, nearest });
        }
        // Half-angle form of d² = a² + b² - 2ab cos: keeps its digits where the arm is stretched.
        let (a, b, h, zero) = (self.elbow.upper, self.elbow.fore, self.elbow.along, T::zero());
        let across = ((distance - h) * (distance + h)).max(zero).sqrt();
        // Within rounding of an end it is that end: the root of a rounding would turn joints that
        // are free there.
        let beyond = |gap: T| T::select(gap > slack, gap, zero);
        let open = (beyond(across - (a - b).abs()) * (across + (a - b).abs())).sqrt();
        let close = (beyond(a + b - across) * (a + b + across)).sqrt();
        let opening = T::from_f64(2.0) * open.atan2(close);
        let (sine, _) = opening.sin_cos();
        Ok((side.sign::<T>() * opening - self.elbow.opening_at_zero, sine.abs()))
    }
    /// The line from shoulder to wrist, and the direction across it toward the elbow: both fixed in
    /// link 3, zero posture (m).
    fn elbow_side(&self, q4: T, side: Side) -> (Vec3<T>, Vec3<T>) {
        let axis = self.chain.axes[3];
        let line = self.upper + about(axis, q4) * self.fore;
        (line, axis.cross(line) * side.sign())
    }
    /// Unit direction across the line from which the arm angle counts; zero if it has none (–).
    fn zero_side(&self, line: Vec3<T>, reference: Reference) -> Vec3<T> {
        let axis = self.reference_axis(reference);
        let line = unit(line);
        unit(axis - line * axis.dot(line))
    }
    fn reference_axis(&self, reference: Reference) -> Vec3<T> {
        match reference {
            Reference::FirstAxis => self.chain.axes[0],
            Reference::SecondAxis => self.chain.axes[1],
        }
    }
    fn reference_for(&self, line: Vec3<T>) -> Reference {
        let sine = self.reference_axis(Reference::FirstAxis).cross(unit(line)).norm();
        if sine < T::from_f64(PARALLEL) { Reference::SecondAxis } else { Reference::FirstAxis }
    }
}

impl<T: Scalar> Solutions<T> {
    /// The solutions, in a fixed order of their branches.
    pub fn iter(&self) -> impl Iterator<Item = &ArmSolution<T>> {
        self.list.iter().flatten()
    }
    /// The solution nearest to the joint positions asked to be near, by the sum of squares.
    pub fn nearest(&self) -> Option<ArmSolution<T>> {
        self.nearest_within(&[None; 7])
    }
    /// The same among those that keep the travel of the joints (lower and upper end, rad), whole
    /// turns added where that helps.
    pub fn nearest_within(&self, travel: &[Option<(T, T)>; 7]) -> Option<ArmSolution<T>> {
        let mut best: Option<(T, ArmSolution<T>)> = None;
        for solution in self.iter() {
            let Some(q) = within_travel(&solution.q, travel) else { continue };
            let ways = (0..7).map(|i| q[i] - self.near[i]);
            let distance = ways.fold(T::zero(), |sum, way| sum + way * way);
            if best.is_none_or(|(least, _)| distance < least) {
                best = Some((distance, ArmSolution { q, ..*solution }));
            }
        }
        best.map(|(_, solution)| solution)
    }
}

/// The positions with whole turns added, so that each is within its travel.
fn within_travel<T: Scalar>(q: &[T; 7], travel: &[Option<(T, T)>; 7]) -> Option<[T; 7]> {
    let turn = T::from_f64(core::f64::consts::TAU);
    let mut kept = *q;
    for (q, travel) in kept.iter_mut().zip(travel) {
        let Some((lower, upper)) = *travel else { continue };
        let inside = |x: &T| lower <= *x && *x <= upper;
        *q = [*q, *q - turn, *q + turn].into_iter().find(inside)?;
    }
    Some(kept)
}

/// Unit vector; zero for zero.
fn unit<T: Scalar>(v: Vec3<T>) -> Vec3<T> {
    let length = v.norm();
    if length > T::zero() { v * (T::one() / length) } else { Vec3::zero() }
}

/// Right-handed axes: the first along `x`, the second along `y`, which is across `x`.
fn triad<T: Scalar>(x: Vec3<T>, y: Vec3<T>) -> Mat3<T> {
    let x = unit(x);
    // Once more across: the rounding of y must not make the axes skew.
    let y = unit(y - x * x.dot(y));
    Mat3::from_columns(x, y, x.cross(y))
}

/// The angle with whole turns added, so that it is within half a turn of `near` (rad).
fn unwound<T: Scalar>(angle: T, near: T) -> T {
    let (sine, cosine) = (angle - near).sin_cos();
    near + sine.atan2(cosine)
}
