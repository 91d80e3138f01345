//! Joint positions for a tool pose, for any arm: damped least squares with joint travel kept.

use wrasse_dynamics::{
    Cholesky, Frame, Robot, State, attitude_held_jacobian, base_rows, jacobian, kinematics,
};
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Pose, Quat, Scalar, SpatialVelocity, Vec3};

/// What stands still while the arm moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The base: an arm on a fixed base.
    Base,
    /// The base's attitude and the centre of mass of the whole system.
    AttitudeAndCentreOfMass,
}

/// When to be content and when to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DampedLeastSquares<T> {
    /// Position error that is good enough (m).
    pub position_tolerance: T,
    /// Rotation error that is good enough (rad).
    pub rotation_tolerance: T,
    /// Most iterations (–).
    pub iterations: u32,
}

/// Where a solve ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attempt<T, const J: usize> {
    /// Joint positions of the smallest error found, within the travel (rad or m).
    pub q: [T; J],
    /// Iterations taken (–).
    pub iterations: u32,
    /// Distance of the tool from its target (m).
    pub position_error: T,
    /// Angle between tool and target (rad).
    pub rotation_error: T,
}

/// How a solve ended. Not reaching the pose is an answer, not an error.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum DampedOutcome<T, const J: usize> {
    /// Both errors are within tolerance.
    Converged(Attempt<T, J>),
    /// No step reduces the error any more: the pose is out of reach, or the seed led to a dead end.
    Stalled(Attempt<T, J>),
    /// The same, with a joint at the end of its travel that would have to go on.
    LimitsReached {
        /// Where it ended.
        attempt: Attempt<T, J>,
        /// The robot's number of the first such joint.
        joint: usize,
    },
    /// The iterations are spent, and the error was still falling.
    OutOfIterations(Attempt<T, J>),
    /// Target, seed or state is not finite.
    NotFinite,
}

/// The problem, as it stands still.
struct Problem<'a, T, const J: usize> {
    robot: &'a Robot<T, J>,
    tool: &'a Frame<T>,
    state: &'a State<T, J>,
    X_NE: &'a Pose<T>,
    limits: &'a [JointLimits<T>; J],
    anchor: Anchor,
    /// Where the centre of mass is (m).
    p_NScm: Vec3<T>,
}

/// The damping `λ²` is this part of the squared error, at the start and at least.
const DAMPING: (f64, f64) = (1e-2, 1e-12);
/// After this many steps in a row that gain less than two thousandths each, a solve has stalled.
const SLOW_STEPS: u32 = 12;

/// Joint positions that bring `tool` to `X_NE`, from the positions and the base pose of `state`
/// (its velocities do not matter). Each joint stays within its travel; joints off the way to the
/// tool stay where they are.
///
/// Each step is `q̇ = Jᵀ (J Jᵀ + λ²)⁻¹ e`, so |q̇| ≤ |e|/2λ, with radians and metres counted
/// alike; λ falls while steps succeed and rises when one does not. A step that would leave a
/// joint's travel is taken to its end, and the others are solved again for what is left.
///
/// # Source
/// [`NakamuraHanafusa1986`](wrasse_spatial::references::NakamuraHanafusa1986).
pub fn damped_least_squares<T: Scalar, const J: usize>(
    robot: &Robot<T, J>,
    tool: &Frame<T>,
    state: &State<T, J>,
    X_NE: &Pose<T>,
    limits: &[JointLimits<T>; J],
    anchor: Anchor,
    settings: &DampedLeastSquares<T>,
) -> DampedOutcome<T, J> {
    let (_, p_NScm) = kinematics(robot, state).centre_of_mass();
    let problem = Problem { robot, tool, state, X_NE, limits, anchor, p_NScm };
    let mut q = problem.within_travel(&state.q);
    let (mut error, mut columns) = problem.error_and_jacobian(&q);
    let mut damping = T::from_f64(DAMPING.0);
    let (mut slow, mut iterations) = (0, 0);
    loop {
        let square = squared(&error);
        if !square.is_finite() {
            return DampedOutcome::NotFinite;
        }
        let attempt = Attempt {
            q,
            iterations,
            position_error: error.linear.norm(),
            rotation_error: error.angular.norm(),
        };
        if attempt.position_error <= settings.position_tolerance
            && attempt.rotation_error <= settings.rotation_tolerance
        {
            return DampedOutcome::Converged(attempt);
        }
        if slow >= SLOW_STEPS {
            return problem.stalled(attempt, &columns, &error);
        }
        if iterations >= settings.iterations {
            return DampedOutcome::OutOfIterations(attempt);
        }
        iterations += 1;
        let next = problem.step(&q, &columns, &error, damping * square);
        let (next_error, next_columns) = problem.error_and_jacobian(&next);
        let next_square = squared(&next_error);
        let gains = square - next_square > square * T::from_f64(2e-3);
        slow = if gains { 0 } else { slow + 1 };
        if next_square < square {
            (q, error, columns) = (next, next_error, next_columns);
            damping = (damping * T::from_f64(0.1)).max(T::from_f64(DAMPING.1));
        } else {
            damping = damping.max(T::from_f64(1e-6)) * T::from_f64(10.0);
        }
    }
}

/// `|e|²` with radians and metres counted alike.
fn squared<T: Scalar>(e: &SpatialVelocity<T>) -> T {
    e.angular.dot(e.angular) + e.linear.dot(e.linear)
}

impl<T: Scalar, const J: usize> Problem<'_, T, J> {
    /// The twist that would bring the tool home in one second (N axes; rad, m), and what each joint
    /// contributes to it.
    fn error_and_jacobian(&self, q: &[T; J]) -> (SpatialVelocity<T>, [SpatialVelocity<T>; J]) {
        let state = State { q: *q, X_NB: self.state.X_NB, ..State::default() };
        let k = kinematics(self.robot, &state);
        let X_NE = k.pose(self.tool);
        let turn = self.X_NE.rotation * X_NE.rotation.transpose();
        let J_frame = jacobian(&k, self.tool);
        let away = self.X_NE.translation - X_NE.translation;
        let (way, columns) = match self.anchor {
            Anchor::Base => (away, J_frame.joints.columns()),
            Anchor::AttitudeAndCentreOfMass => {
                let M = base_rows(&k);
                let columns = attitude_held_jacobian(&J_frame, &M, &state.X_NB.rotation);
                // The base recoils by what the centre of mass would have moved.
                let recoil = self.p_NScm - k.centre_of_mass().1;
                (away - recoil, self.on_way(&columns.columns()))
            }
        };
        (SpatialVelocity::new(Quat::from_matrix(&turn).log(), way), columns)
    }
    /// The columns of the joints between base and tool; another arm must not be used as a weight.
    fn on_way(&self, columns: &[SpatialVelocity<T>; J]) -> [SpatialVelocity<T>; J] {
        let mut kept = [SpatialVelocity::zero(); J];
        for j in self.robot.path_to_base(self.tool.body) {
            kept[j] = columns[j];
        }
        kept
    }
    /// Joint positions after one step: those that would leave their travel stop at its end, and the
    /// others are solved again. At most one joint is added in each round, so J + 1 rounds suffice.
    fn step(
        &self,
        q: &[T; J],
        columns: &[SpatialVelocity<T>; J],
        error: &SpatialVelocity<T>,
        damping: T,
    ) -> [T; J] {
        let mut next = *q;
        let mut free = [true; J];
        for _ in 0..=J {
            // What the stopped joints leave to the others.
            let mut left = *error;
            for j in (0..J).filter(|&j| !free[j]) {
                left = left - columns[j] * (next[j] - q[j]);
            }
            let way = damped_solution(columns, &free, &left, damping);
            let mut worst: Option<(T, usize, T)> = None;
            for j in (0..J).filter(|&j| free[j]) {
                next[j] = q[j] + way[j];
                let end = self.end_of_travel(j, next[j]);
                let over = (next[j] - end).abs();
                if over > worst.map_or(T::zero(), |(most, ..)| most) {
                    worst = Some((over, j, end));
                }
            }
            let Some((_, j, end)) = worst else { break };
            free[j] = false;
            next[j] = end;
        }
        next
    }
    /// The position, or the end of the travel that it is beyond (rad or m).
    fn end_of_travel(&self, j: usize, q: T) -> T {
        self.limits[j].travel.map_or(q, |(lower, upper)| q.max(lower).min(upper))
    }
    fn within_travel(&self, q: &[T; J]) -> [T; J] {
        core::array::from_fn(|j| self.end_of_travel(j, q[j]))
    }
    /// Stalled for good, or against the end of a joint's travel.
    fn stalled(
        &self,
        attempt: Attempt<T, J>,
        columns: &[SpatialVelocity<T>; J],
        error: &SpatialVelocity<T>,
    ) -> DampedOutcome<T, J> {
        let blocked = |&j: &usize| {
            let pull = columns[j].angular.dot(error.angular) + columns[j].linear.dot(error.linear);
            self.limits[j].travel.is_some_and(|(lower, upper)| {
                (attempt.q[j] <= lower && pull < T::zero())
                    || (attempt.q[j] >= upper && pull > T::zero())
            })
        };
        match self.robot.joints().find(blocked) {
            Some(joint) => DampedOutcome::LimitsReached { attempt, joint },
            None => DampedOutcome::Stalled(attempt),
        }
    }
}

/// `Jᵀ (J Jᵀ + λ² 1)⁻¹ e` over the free joints; zero for the others.
fn damped_solution<T: Scalar, const J: usize>(
    columns: &[SpatialVelocity<T>; J],
    free: &[bool; J],
    error: &SpatialVelocity<T>,
    damping: T,
) -> [T; J] {
    let mut A = [[T::zero(); 6]; 6];
    for c in (0..J).filter(|&j| free[j]).map(|j| columns[j].to_array()) {
        for (row, a) in A.iter_mut().zip(c) {
            for (element, b) in row.iter_mut().zip(c) {
                *element += a * b;
            }
        }
    }
    for i in 0..6 {
        A[i][i] += damping;
    }
    let factored = Cholesky::new(&A, 6);
    let mut way = [T::zero(); J];
    // A matrix that rounding has made indefinite gives no step; the damping then rises.
    let definite = factored.smallest_pivot() > T::zero();
    if !definite {
        return way;
    }
    let y = factored.solve(&error.to_array());
    for j in (0..J).filter(|&j| free[j]) {
        let column = columns[j].to_array();
        way[j] = (0..6).fold(T::zero(), |sum, i| sum + column[i] * y[i]);
    }
    way
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_spatial::vec3;

    /// The worst case of the bound: one direction whose singular value is λ itself.
    #[test]
    fn a_damped_step_is_at_most_the_error_over_twice_the_damping() {
        let lambda = 0.3_f64;
        for stiffness in [0.0, 1e-9, 0.1, 0.3, 0.9, 5.0] {
            let column = SpatialVelocity::new(vec3(0.0, stiffness, 0.0), Vec3::zero());
            let error = SpatialVelocity::new(vec3(0.0, 2.0, 0.0), vec3(0.0, 0.0, 0.0));
            let [way] = damped_solution(&[column], &[true], &error, lambda * lambda);
            let expected = stiffness * 2.0 / (stiffness * stiffness + lambda * lambda);
            assert!((way - expected).abs() < 4e-15, "{way} {expected}");
            assert!(way <= 2.0 / (2.0 * lambda) * (1.0 + 1e-15), "{way}");
        }
    }

    #[test]
    fn a_joint_that_is_not_free_takes_no_part_in_the_step() {
        let column = |x| SpatialVelocity::new(vec3(x, 0.0, 0.0), Vec3::zero());
        let error = column(1.0);
        let [way, stopped] =
            damped_solution(&[column(1.0), column(2.0)], &[true, false], &error, 1.0_f64);
        assert!((way - 0.5).abs() < 2e-16 && stopped == 0.0, "measured 1.2e-16: {way} {stopped}");
    }
}
