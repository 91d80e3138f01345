//! Joints without a drive of their own.

use wrasse_spatial::Real;

/// A joint that follows another one: `q = ratio × q of the leader + offset`.
///
/// A gear without play: what the follower takes is taken from the leader, `ratio` times.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Follower<T> {
    /// Its number.
    pub joint: usize,
    /// The number of the joint that it follows, which has a drive of its own.
    pub leader: usize,
    /// Travel per travel of the leader (–, rad/m or m/rad), not zero.
    pub ratio: T,
    /// Travel when the leader is at zero (rad or m).
    pub offset: T,
}

impl<T: Real> Follower<T> {
    /// The same over another number.
    pub fn from_f64(of: &Follower<f64>) -> Self {
        let Follower { joint, leader, ratio, offset } = *of;
        Self { joint, leader, ratio: T::from_f64(ratio), offset: T::from_f64(offset) }
    }
}

/// Puts each follower where its leader has it (rad or m).
pub fn follow<T: Real>(followers: &[Follower<T>], q: &mut [T]) {
    for &Follower { joint, leader, ratio, offset } in followers {
        if let Some(&at) = q.get(leader)
            && let Some(place) = q.get_mut(joint)
        {
            *place = ratio * at + offset;
        }
    }
}

/// Gives each follower the rate that its leader gives it (rad/s or m/s).
pub fn follow_rates<T: Real>(followers: &[Follower<T>], v: &mut [T]) {
    for &Follower { joint, leader, ratio, .. } in followers {
        if let Some(&at) = v.get(leader)
            && let Some(place) = v.get_mut(joint)
        {
            *place = ratio * at;
        }
    }
}

/// Maps efforts to the joints that have drives: what is asked of a follower is asked of its leader,
/// `ratio` times (N·m or N).
pub fn through_gears<T: Real>(followers: &[Follower<T>], effort: &mut [T]) {
    for &Follower { joint, leader, ratio, .. } in followers {
        if let Some(place) = effort.get_mut(joint) {
            let asked = *place;
            *place = T::zero();
            if let Some(place) = effort.get_mut(leader) {
                *place += ratio * asked;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Power does not change when efforts go through the gears: `τ · v` is the same before and after, for
    /// rates that follow.
    #[test]
    fn efforts_through_gears_do_the_same_work() {
        let follower = |joint, leader, ratio| Follower { joint, leader, ratio, offset: 0.3 };
        let followers = [follower(2, 0, -2.0), follower(3, 0, 0.5), follower(1, 4, 3.0)];
        let mut q = [0.1, 9.0, 9.0, 9.0, -0.2];
        follow(&followers, &mut q);
        let expected: [f64; 5] = [0.1, -0.3, 0.1, 0.35, -0.2];
        for (found, expected) in q.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-15, "{q:?}");
        }
        let mut v = [1.0, 0.0, 0.0, 0.0, -0.5];
        follow_rates(&followers, &mut v);
        let mut effort = [1.0, 2.0, 3.0, 4.0, 5.0];
        let power = |effort: &[f64; 5]| effort.iter().zip(v).map(|(tau, v)| tau * v).sum::<f64>();
        let before = power(&effort);
        through_gears(&followers, &mut effort);
        assert_eq!(power(&effort), before);
        assert_eq!(effort, [1.0 - 6.0 + 2.0, 0.0, 0.0, 0.0, 5.0 + 6.0]);
    }
}
