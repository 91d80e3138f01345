//! Joints that follow others through a gear without play: what the gear passes on is found at each
//! stage, so that leader and followers accelerate together.
//!
//! Where the leader follows set-points, its followers do. Where it is driven by a torque, its
//! acceleration `x` is asked for at which leader and followers, all moving with it, take as much as the
//! drive gives: `τ(x) + Σ ratio τ_f(x) = τ`. That is linear in the accelerations of all leaders. What
//! passes through the gears does no work, for the rates follow too.

use crate::scene::{Scene, SystemId};
use crate::system::System;
use wrasse_dynamics::{Cholesky, JointDrive};
use wrasse_hardware::{Follower, follow, follow_rates};

impl<const J: usize> Scene<J> {
    /// Have joints of a system follow others. Joints that do not stand and move as their leaders have it
    /// are brought there, with the momentum of the whole as it is.
    pub fn set_followers(&mut self, id: SystemId, followers: &[Follower<f64>]) {
        let system = self.system_mut(id);
        system.followers = followers.to_vec();
        system.follow_leaders();
    }
}

impl<const J: usize> System<J> {
    /// Followers are where their leaders have them.
    pub(crate) fn follow_leaders(&mut self) {
        let (q, v) = (self.variables.q(), self.variables.v());
        follow(&self.followers, &mut self.row[q.clone()]);
        follow_rates(&self.followers, &mut self.row[v.clone()]);
        for Follower { joint, .. } in &self.followers {
            (self.carry[q.start + joint], self.carry[v.start + joint]) = (0.0, 0.0);
        }
    }
}

/// Drives by which followers accelerate with their leaders. `efforts` gives what each joint takes under
/// given drives (N·m or N); the last it is asked for are those that are returned.
pub(crate) fn with_gears<const J: usize>(
    followers: &[Follower<f64>],
    given: &[JointDrive<f64>; J],
    efforts: &mut dyn FnMut(&[JointDrive<f64>; J]) -> [f64; J],
) {
    let unknown = Leaders::of(followers, given);
    let n = unknown.count;
    let mut x = [0.0; J];
    let at_zero = unknown.taken(followers, &efforts(&unknown.drives(followers, given, &x)));
    if n == 0 {
        return;
    }
    let mut K = [[0.0; J]; J];
    for i in 0..n {
        let mut unit = [0.0; J];
        unit[i] = 1.0;
        let taken = unknown.taken(followers, &efforts(&unknown.drives(followers, given, &unit)));
        for k in 0..n {
            K[k][i] = taken[k] - at_zero[k];
        }
    }
    let K = Cholesky::new(&K, n);
    let mut taken = at_zero;
    // The second time takes away what rounding of the first differences left.
    for _ in 0..2 {
        let lack = core::array::from_fn(|k| unknown.effort[k] - taken[k]);
        let more = K.solve(&lack);
        for k in 0..n {
            x[k] += more[k];
        }
        taken = unknown.taken(followers, &efforts(&unknown.drives(followers, given, &x)));
    }
}

/// Leaders that are driven by an effort.
struct Leaders<const J: usize> {
    count: usize,
    joint: [usize; J],
    /// What their drives give, with what is given on their followers (N·m or N).
    effort: [f64; J],
}

impl<const J: usize> Leaders<J> {
    fn of(followers: &[Follower<f64>], given: &[JointDrive<f64>; J]) -> Self {
        let mut leaders = Self { count: 0, joint: [0; J], effort: [0.0; J] };
        for follower in followers {
            let JointDrive::Effort(effort) = given[follower.leader] else { continue };
            let known = leaders.place(follower.leader);
            let k = known.unwrap_or(leaders.count);
            if known.is_none() {
                (leaders.joint[k], leaders.effort[k]) = (follower.leader, effort);
                leaders.count += 1;
            }
            if let JointDrive::Effort(on_follower) = given[follower.joint] {
                leaders.effort[k] += follower.ratio * on_follower;
            }
        }
        leaders
    }
    fn place(&self, joint: usize) -> Option<usize> {
        self.joint[..self.count].iter().position(|known| *known == joint)
    }
    /// The drives at accelerations of the leaders.
    fn drives(
        &self,
        followers: &[Follower<f64>],
        given: &[JointDrive<f64>; J],
        x: &[f64; J],
    ) -> [JointDrive<f64>; J] {
        let mut drives = *given;
        for (leader, x) in self.joint[..self.count].iter().zip(x) {
            drives[*leader] = JointDrive::Acceleration(*x);
        }
        for follower in followers {
            if let JointDrive::Acceleration(x) = drives[follower.leader] {
                drives[follower.joint] = JointDrive::Acceleration(follower.ratio * x);
            }
        }
        drives
    }
    /// What leaders and their followers take together, seen from the leaders.
    fn taken(&self, followers: &[Follower<f64>], effort: &[f64; J]) -> [f64; J] {
        let mut taken = [0.0; J];
        for k in 0..self.count {
            taken[k] = effort[self.joint[k]];
        }
        for follower in followers {
            if let Some(k) = self.place(follower.leader) {
                taken[k] += follower.ratio * effort[follower.joint];
            }
        }
        taken
    }
}
