//! Robots of one build and their states, side by side in lanes.

use crate::{Dynamics, Generalized, MassProperties, PerBody, Robot, State};
use wrasse_spatial::{Instructions, Lanes, SideBySide};

impl<I: Instructions, const N: usize, const J: usize> Robot<Lanes<N, I>, J> {
    /// Robots of the same tree and the same joints, whatever they weigh; `None` if they are not.
    pub fn side_by_side(of: &[&Robot<f64, J>; N]) -> Option<Self> {
        let first = *of.first()?;
        let same = |robot: &Robot<f64, J>| {
            robot.count == first.count && robot.joints().all(|j| robot.joints[j] == first.joints[j])
        };
        if !of.iter().copied().all(same) {
            return None;
        }
        let mut robot: Self = first.cast();
        robot.bodies = PerBody {
            base: MassProperties::side_by_side(&|i| of[i].bodies.base),
            links: SideBySide::side_by_side(&|i| of[i].bodies.links),
        };
        robot.weigh();
        Some(robot)
    }
}

impl<I: Instructions, const N: usize> SideBySide<N> for MassProperties<Lanes<N, I>> {
    type Alone = MassProperties<f64>;
    fn side_by_side(of: &impl Fn(usize) -> MassProperties<f64>) -> Self {
        Self {
            M_F_F: SideBySide::side_by_side(&|i| of(i).M_F_F),
            I_parts_F: SideBySide::side_by_side(&|i| of(i).I_parts_F),
        }
    }
    fn lane(&self, i: usize) -> MassProperties<f64> {
        MassProperties { M_F_F: self.M_F_F.lane(i), I_parts_F: self.I_parts_F.lane(i) }
    }
}

impl<I: Instructions, const N: usize, const J: usize> SideBySide<N> for State<Lanes<N, I>, J> {
    type Alone = State<f64, J>;
    #[inline(always)]
    fn side_by_side(of: &impl Fn(usize) -> State<f64, J>) -> Self {
        Self {
            X_NB: SideBySide::side_by_side(&|i| of(i).X_NB),
            V_NB_B: SideBySide::side_by_side(&|i| of(i).V_NB_B),
            q: SideBySide::side_by_side(&|i| of(i).q),
            v: SideBySide::side_by_side(&|i| of(i).v),
        }
    }
    #[inline(always)]
    fn lane(&self, i: usize) -> State<f64, J> {
        State {
            X_NB: self.X_NB.lane(i),
            V_NB_B: self.V_NB_B.lane(i),
            q: self.q.lane(i),
            v: self.v.lane(i),
        }
    }
}

impl<I: Instructions, const N: usize, const J: usize> Dynamics<Lanes<N, I>, J> {
    /// That of one lane.
    #[inline(always)]
    #[must_use]
    pub fn lane(&self, i: usize) -> Dynamics<f64, J> {
        let Self { nudot, force } = self;
        Dynamics {
            nudot: Generalized { base: nudot.base.lane(i), joints: nudot.joints.lane(i) },
            force: Generalized { base: force.base.lane(i), joints: force.joints.lane(i) },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BodyId, Joint, JointKind};
    use wrasse_spatial::{Pose, Sym3, Vec3, vec3};

    fn robot(mass: f64, axis: Vec3<f64>) -> Robot<f64, 2> {
        let matter =
            MassProperties::from_central(mass, Vec3::zero(), Sym3::diagonal(1.0, 2.0, 3.0));
        let joint = Joint::new(BodyId::Base, JointKind::Revolute, Pose::identity(), axis);
        Robot::new(matter, &[(joint, matter)]).unwrap()
    }

    #[test]
    fn robots_that_weigh_differently_go_side_by_side() {
        let z = vec3(0.0, 0.0, 1.0);
        let both = Robot::<Lanes<2>, 2>::side_by_side(&[&robot(3.0, z), &robot(5.0, z)]).unwrap();
        assert_eq!(both.mass().0, [6.0, 10.0]);
    }

    #[test]
    fn robots_that_are_built_differently_do_not() {
        let (y, z) = (vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
        assert!(Robot::<Lanes<2>, 2>::side_by_side(&[&robot(3.0, y), &robot(3.0, z)]).is_none());
    }
}
