//! Several tools on their motions at once, on one base that all arms push.
//!
//! Each arm moves the base under the others, so their rates are found together: the rows of all tasks
//! stand in one matrix. Joints on a way of their own are given, and what they do to the tools is made up
//! for. One law at a time: the base answers all arms alike.

use crate::damped_inverse::DampedInverse;
use crate::interface::Axes;
use crate::law::Task;
use crate::resolved_motion::{
    Assignment, Belief, JointUse, LawJacobian, WantedMotion, in_base_axes, masked, row_rates,
};
use crate::step::ARMS;
use wrasse_dynamics::{BaseResponse, Configuration, Robot, base_response, base_response_rate};
use wrasse_spatial::{Scalar, SpatialVelocity};

/// Rows of all tasks.
const ROWS: usize = 6 * ARMS;

/// A tool, and the motion that is wanted of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ToolTask<T> {
    pub(crate) to: Assignment<T>,
    pub(crate) wanted: WantedMotion<T>,
}

/// How a joint comes to its rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum JointRole<T> {
    /// It serves the tools, and drifts to the posture with this gain (1/s), which changes (1/s²).
    Free { gain: T, gain_rate: T },
    /// It has this rate (rad/s or m/s) and acceleration.
    Given { rate: T, acceleration: T },
}

/// Motion of all joints.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointMotion<T, const J: usize> {
    /// Rates (rad/s or m/s).
    pub(crate) qdot: [T; J],
    /// Accelerations (rad/s² or m/s²).
    pub(crate) qddot: [T; J],
    /// Share of the free joints' rates that the rate limits leave (–).
    pub(crate) share: T,
}

/// Rates and accelerations that bring all tools on; `None` without any tool.
///
/// As [`resolved_motion`](crate::resolved_motion), with the rows of all tasks in place of those of one.
/// Rows without a task stand first and do not count.
///
/// # Source
/// [`YoshidaKurazumeUmetani1991`](wrasse_spatial::references::YoshidaKurazumeUmetani1991).
pub(crate) fn motion_of_several_arms<T: Scalar, const J: usize>(
    robot: &Robot<T, J>,
    configuration: &Configuration<T, J>,
    belief: &Belief<T, J>,
    tasks: &[Option<ToolTask<T>>; ARMS],
    roles: &[JointRole<T>; J],
    joints: &JointUse<T, J>,
) -> Option<JointMotion<T, J>> {
    let first = tasks.iter().flatten().next()?.to;
    let (mode, h_Scm_B) = (first.law.base(), belief.h_Scm_B());
    let response = base_response(mode, &configuration.base, &h_Scm_B);
    let stack = Stack::new(robot, configuration, belief, tasks, &response);
    let solved = Solved::new(robot, belief, &stack, roles, joints, first.damped_below);
    let V_NB_B = response.to_rates(robot, &solved.qdot) + response.drift;
    let w_NB_B = V_NB_B.angular;
    let V = configuration.twists(robot, &solved.qdot);
    let moving = (&V, &solved.qdot);
    let changing =
        base_response_rate(mode, robot, configuration, &response, moving, &h_Scm_B, w_NB_B);
    let rates = stack.rates(robot, configuration, belief, (&response, &changing), &V, &V_NB_B);
    let qddot = solved.accelerations(robot, belief, &stack, &rates, roles, joints);
    Some(JointMotion { qdot: solved.qdot, qddot, share: solved.share })
}

/// Rows of all tasks, one below the other, in base axes.
struct Stack<'a, T, const J: usize> {
    tasks: &'a [Option<ToolTask<T>>; ARMS],
    /// The first row that counts.
    first: usize,
    columns: [[T; ROWS]; J],
    /// What is wanted of the joints.
    wanted: [T; ROWS],
}

/// Time derivatives of a stack.
struct StackRates<T, const J: usize> {
    columns: [[T; ROWS]; J],
    wanted: [T; ROWS],
}

impl<'a, T: Scalar, const J: usize> Stack<'a, T, J> {
    fn new(
        robot: &Robot<T, J>,
        configuration: &Configuration<T, J>,
        belief: &Belief<T, J>,
        tasks: &'a [Option<ToolTask<T>>; ARMS],
        response: &BaseResponse<T, J>,
    ) -> Self {
        let rows: usize = tasks.iter().flatten().map(|task| rows_of(task.to.task)).sum();
        let (first, none) = (ROWS - rows, [T::zero(); ROWS]);
        let mut stack = Self { tasks, first, columns: [none; J], wanted: none };
        let mut at = first;
        for ToolTask { to, wanted } in tasks.iter().flatten() {
            let law = LawJacobian::new(robot, to, configuration, response);
            let V_NE_B = masked(&in_base_axes(to, belief, &wanted.V_NE), to.task).to_array();
            let drift = law.rows(to.task, &law.drift);
            for (k, r) in (6 - rows_of(to.task)..6).enumerate() {
                stack.wanted[at + k] = V_NE_B[r] - drift[r];
            }
            for j in robot.joints() {
                put(&mut stack.columns[j], at, to.task, &law.rows(to.task, &law.columns[j]));
            }
            at += rows_of(to.task);
        }
        stack
    }

    /// How the rows change, and what is wanted of them.
    fn rates(
        &self,
        robot: &Robot<T, J>,
        configuration: &Configuration<T, J>,
        belief: &Belief<T, J>,
        (response, changing): (&BaseResponse<T, J>, &BaseResponse<T, J>),
        V: &SpatialVelocity<[T; J]>,
        V_NB_B: &SpatialVelocity<T>,
    ) -> StackRates<T, J> {
        let none = [T::zero(); ROWS];
        let mut found = StackRates { columns: [none; J], wanted: none };
        let mut at = self.first;
        for ToolTask { to, wanted } in self.tasks.iter().flatten() {
            let law = LawJacobian::new(robot, to, configuration, response);
            let rates = row_rates(robot, to, configuration, &law, changing, V);
            let mut Vdot = in_base_axes(to, belief, &wanted.Vdot_NE);
            if to.axes == Axes::Inertial {
                // Seen from a base that turns.
                let (V_NE, w) = (in_base_axes(to, belief, &wanted.V_NE), V_NB_B.angular);
                Vdot += SpatialVelocity::new(V_NE.angular.cross(w), V_NE.linear.cross(w));
            }
            let Vdot = masked(&Vdot, to.task).to_array();
            for (k, r) in (6 - rows_of(to.task)..6).enumerate() {
                found.wanted[at + k] = Vdot[r] - rates.drift[r];
            }
            for j in robot.joints() {
                put(&mut found.columns[j], at, to.task, &rates.columns[j]);
            }
            at += rows_of(to.task);
        }
        found
    }
}

/// Joint rates, and what their derivatives need of the way they were found.
struct Solved<T, const J: usize> {
    qdot: [T; J],
    inverse: DampedInverse<T, ROWS>,
    /// Columns of the free joints; zero for the others.
    rows: [[T; ROWS]; J],
    y: [T; ROWS],
    /// Rates before those of the free joints were slowed down, and the share that is left.
    unlimited: [T; J],
    share: T,
}

impl<T: Scalar, const J: usize> Solved<T, J> {
    fn new(
        robot: &Robot<T, J>,
        belief: &Belief<T, J>,
        stack: &Stack<'_, T, J>,
        roles: &[JointRole<T>; J],
        joints: &JointUse<T, J>,
        damped_below: T,
    ) -> Self {
        let (mut wanted, none) = (stack.wanted, [T::zero(); ROWS]);
        let (mut rows, mut unlimited) = ([none; J], [T::zero(); J]);
        for j in robot.joints() {
            unlimited[j] = match roles[j] {
                JointRole::Free { gain, .. } => (joints.posture[j] - belief.q[j]) * gain,
                JointRole::Given { rate, .. } => rate,
            };
            (0..ROWS).for_each(|r| wanted[r] -= stack.columns[j][r] * unlimited[j]);
            if is_free(&roles[j]) {
                rows[j] = stack.columns[j];
            }
        }
        let mut orthogonal = rows;
        let columns = orthogonal.get_mut(robot.joints()).unwrap_or_default();
        let inverse = DampedInverse::new(columns, stack.first, damped_below);
        let y = inverse.solve(&wanted);
        let (mut share, mut qdot) = (T::one(), unlimited);
        for j in robot.joints().filter(|&j| is_free(&roles[j])) {
            unlimited[j] += dot(&rows[j], &y);
            share = share.min(joints.rate_limit[j] / joints.rate_limit[j].max(unlimited[j].abs()));
        }
        for j in robot.joints().filter(|&j| is_free(&roles[j])) {
            qdot[j] = unlimited[j] * share;
        }
        Self { qdot, inverse, rows, y, unlimited, share }
    }

    /// The exact derivatives of the rates.
    fn accelerations(
        &self,
        robot: &Robot<T, J>,
        belief: &Belief<T, J>,
        stack: &Stack<'_, T, J>,
        rates: &StackRates<T, J>,
        roles: &[JointRole<T>; J],
        joints: &JointUse<T, J>,
    ) -> [T; J] {
        let changing = robot.joints().map(|j| (&self.rows[j], &rates.columns[j]));
        let damping_rate = self.inverse.damping_rate(changing);
        let (mut rest, mut qddot) = (rates.wanted, [T::zero(); J]);
        (0..ROWS).for_each(|r| rest[r] -= damping_rate * self.y[r]);
        for j in robot.joints() {
            qddot[j] = match roles[j] {
                JointRole::Free { gain, gain_rate } => {
                    (joints.posture[j] - belief.q[j]) * gain_rate - self.qdot[j] * gain
                        + dot(&rates.columns[j], &self.y)
                }
                JointRole::Given { acceleration, .. } => acceleration,
            };
            for r in 0..ROWS {
                rest[r] -= rates.columns[j][r] * self.unlimited[j] + stack.columns[j][r] * qddot[j];
            }
        }
        let ydot = self.inverse.solve(&rest);
        let mut free = qddot;
        for j in robot.joints().filter(|&j| is_free(&roles[j])) {
            free[j] += dot(&self.rows[j], &ydot);
        }
        let share_rate = self.share_rate(robot, roles, &free, joints);
        for j in robot.joints().filter(|&j| is_free(&roles[j])) {
            qddot[j] = free[j] * self.share + self.unlimited[j] * share_rate;
        }
        qddot
    }

    /// Derivative of the share of their rates that the free joints are slowed down to.
    fn share_rate(
        &self,
        robot: &Robot<T, J>,
        roles: &[JointRole<T>; J],
        free: &[T; J],
        joints: &JointUse<T, J>,
    ) -> T {
        let (mut share, mut rate) = (T::one(), T::zero());
        for j in robot.joints().filter(|&j| is_free(&roles[j])) {
            let (limit, speed) = (joints.rate_limit[j], self.unlimited[j].abs());
            if limit < speed && limit / speed < share {
                share = limit / speed;
                let gain = if self.unlimited[j] < T::zero() { -free[j] } else { free[j] };
                rate = -share * gain / speed;
            }
        }
        rate
    }
}

fn is_free<T>(role: &JointRole<T>) -> bool {
    matches!(role, JointRole::Free { .. })
}

/// Rows that count of a task: all six, or the last three.
fn rows_of(task: Task) -> usize {
    match task {
        Task::Pose => 6,
        Task::Position => 3,
    }
}

/// Puts the rows of a task that count into a column, from `at` on.
fn put<T: Scalar>(column: &mut [T; ROWS], at: usize, task: Task, rows: &[T; 6]) {
    let rows = &rows[6 - rows_of(task)..];
    column.iter_mut().skip(at).zip(rows).for_each(|(to, from)| *to = *from);
}

fn dot<T: Scalar>(a: &[T; ROWS], b: &[T; ROWS]) -> T {
    (0..ROWS).fold(T::zero(), |sum, r| sum + a[r] * b[r])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::believed_base_response::believed_base_response;
    use crate::law::ArmLaw;
    use wrasse_dynamics::{BodyId, Frame};
    use wrasse_spatial::{Pose, Quat, SpatialMomentum, vec3};
    use wrasse_testing::arms::two_arms;

    const J: usize = 9;

    /// Two tools in motion: one in the axes of the base, that of the short arm in inertial axes, where it
    /// needs the joints of the other arm too.
    struct Bench {
        robot: Robot<f64, J>,
        belief: Belief<f64, J>,
        tasks: [Option<ToolTask<f64>>; ARMS],
        joints: JointUse<f64, J>,
    }

    impl Bench {
        fn new(damped_below: f64, limit: f64) -> Self {
            let (robot, tool) = two_arms();
            let short = Frame { body: BodyId::Link(1), X_BF: Pose::identity() };
            let to = |tool, axes, task| Assignment {
                tool,
                axes,
                task,
                law: ArmLaw::FreeFloating,
                damped_below,
            };
            let V = |x: f64| SpatialVelocity::new(vec3(0.02, x, -0.03), vec3(x, 0.05, -0.04));
            let wanted = |x: f64| WantedMotion { V_NE: V(x), Vdot_NE: V(-3.0 * x) };
            let tasks = [
                Some(ToolTask { to: to(tool, Axes::Base, Task::Position), wanted: wanted(0.06) }),
                None,
                Some(ToolTask {
                    to: to(short, Axes::Inertial, Task::Position),
                    wanted: wanted(-0.07),
                }),
            ];
            let q = core::array::from_fn(|j| 0.4 - 0.17 * (j * j % 7) as f64);
            let turned = Quat::exp(vec3(0.3, -0.5, 0.2));
            let belief = Belief {
                X_NB: Pose::from_quat(turned, vec3(0.4, 0.1, -0.3)),
                q,
                h_Scm_N: SpatialMomentum::new(vec3(2.0, -3.0, 1.0), vec3(5.0, 1.0, -2.0)),
            };
            let posture = [0.3; J];
            let joints = JointUse { gain: 0.0, gain_rate: 0.0, posture, rate_limit: [limit; J] };
            Self { robot, belief, tasks, joints }
        }

        /// Roles at a time (s): one joint on a way of its own, the others drift.
        fn roles(t: f64) -> [JointRole<f64>; J] {
            let mut roles = [JointRole::Free { gain: 0.2 + 0.1 * t, gain_rate: 0.1 }; J];
            roles[2] = JointRole::Given { rate: 0.03 + 0.05 * t, acceleration: 0.05 };
            roles
        }

        /// Motion at a time (s), with the vehicle moved on from here by `qdot` and `V`.
        fn at(&self, t: f64, qdot: &[f64; J], V: &SpatialVelocity<f64>) -> JointMotion<f64, J> {
            let mut belief = self.belief;
            (0..J).for_each(|j| belief.q[j] += qdot[j] * t);
            let turned = Quat::from_matrix(&belief.X_NB.rotation) * Quat::exp(V.angular * t);
            belief.X_NB = Pose::from_quat(turned, belief.X_NB.translation);
            let mut tasks = self.tasks;
            for ToolTask { wanted, .. } in tasks.iter_mut().flatten() {
                wanted.V_NE += wanted.Vdot_NE * t;
            }
            let configuration = Configuration::at(&self.robot, &belief.q);
            let (roles, joints) = (Self::roles(t), &self.joints);
            motion_of_several_arms(&self.robot, &configuration, &belief, &tasks, &roles, joints)
                .expect("there are tools")
        }

        /// Largest difference of the accelerations from central differences of the rates, relative to the
        /// largest acceleration; and the share that the limits leave.
        fn defect(&self) -> (f64, f64) {
            let still = SpatialVelocity::zero();
            let now = self.at(0.0, &[0.0; J], &still);
            let (robot, law) = (&self.robot, ArmLaw::FreeFloating);
            let moves = believed_base_response(robot, law, &self.belief, &now.qdot, &now.qddot);
            let V = moves.rate.V_NB_B;
            let h = 1e-5;
            let (behind, ahead) = (self.at(-h, &now.qdot, &V), self.at(h, &now.qdot, &V));
            let off = |j: usize| (ahead.qdot[j] - behind.qdot[j]) / (2.0 * h) - now.qddot[j];
            let largest =
                |of: &dyn Fn(usize) -> f64| wrasse_testing::largest((0..J).map(|j| of(j).abs()));
            let share = now.share;
            (largest(&off) / largest(&|j| now.qddot[j]), share)
        }
    }
    /// The drift, the damping and the rate limits in turn. Differences over 1e-5 s: measured at most 6.3e-8,
    /// from the third derivative and rounding.
    #[test]
    fn accelerations_are_the_derivatives_of_the_rates_also_damped_and_at_a_limit() {
        for (damped_below, limit) in [(1e-6, 10.0), (0.9, 10.0), (1e-6, 0.05), (0.9, 0.03)] {
            let (defect, share) = Bench::new(damped_below, limit).defect();
            assert!(defect < 1e-6, "damped below {damped_below}, limit {limit}: {defect:e}");
            assert_eq!(share < 1.0, limit < 1.0, "{share}");
        }
    }

    #[test]
    fn without_a_tool_there_is_no_motion() {
        let bench = Bench::new(1e-6, 10.0);
        let configuration = Configuration::at(&bench.robot, &bench.belief.q);
        let (roles, joints) = (Bench::roles(0.0), &bench.joints);
        let none = [None; ARMS];
        let found = motion_of_several_arms(
            &bench.robot,
            &configuration,
            &bench.belief,
            &none,
            &roles,
            joints,
        );
        assert!(found.is_none());
    }
}
