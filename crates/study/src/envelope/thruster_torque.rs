//! What thrusters can do together: the largest torque along a direction, and the least propellant for
//! a wrench.

use wrasse_flight::allocation::BoundedSimplex;
use wrasse_hardware::{STANDARD_GRAVITY, THRUSTERS, Thruster};
use wrasse_spatial::Vec3;

/// Largest torque along a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThrusterTorque {
    /// As a couple: no force is left over (N·m).
    pub couple: f64,
    /// With whatever force comes of it (N·m).
    pub with_force: f64,
}

/// Largest torque about the centre of mass `p_BScm_B` (m) along the unit vector `d`, base axes. Thrusters
/// beyond the first [`THRUSTERS`] are not looked at.
pub fn thruster_torque(
    thrusters: &[Thruster<f64>],
    p_BScm_B: Vec3<f64>,
    d: Vec3<f64>,
) -> ThrusterTorque {
    let largest = |force| DutySearch::of(thrusters, p_BScm_B, d, force, f64::INFINITY).share();
    ThrusterTorque { couple: largest(Some(Vec3::zero())), with_force: largest(None) }
}

/// Least propellant flow (kg/s) that gives a torque about the centre of mass `p_BScm_B` and a force,
/// base axes; with `None` for the force, whatever force comes of it. None if the thrusters cannot.
/// Those beyond the first [`THRUSTERS`] are not looked at.
pub fn least_flow(
    thrusters: &[Thruster<f64>],
    p_BScm_B: Vec3<f64>,
    torque_B: Vec3<f64>,
    force_B: Option<Vec3<f64>>,
) -> Option<f64> {
    if ![torque_B, force_B.unwrap_or_default()].iter().all(|v| v.norm().is_finite()) {
        return None;
    }
    let mut search = DutySearch::of(thrusters, p_BScm_B, torque_B, force_B, 1.0);
    if search.wanted > 0.0 && search.share() <= 1.0 - ROUND_OFF {
        return None;
    }
    search.program.freeze(SHARE);
    let flow = |t: &Thruster<f64>| t.force / (t.specific_impulse * STANDARD_GRAVITY);
    let flows = || thrusters.iter().take(THRUSTERS).map(flow);
    let most = flows().fold(0.0, f64::max);
    let mut cost = [0.0; VARIABLES];
    cost.iter_mut().zip(flows()).for_each(|(cost, flow)| *cost = flow / most);
    let found = search.program.minimise(&cost);
    found.then(|| flows().enumerate().map(|(k, flow)| flow * search.program.value(k)).sum())
}

/// What may be missing of a wrench (–): round-off.
const ROUND_OFF: f64 = 1e-9;

/// The variables: thrusters, share of the wanted wrench, and the start, one for each row.
const SHARE: usize = THRUSTERS;
const VARIABLES: usize = SHARE + 1 + 6;

/// Duties that give a share of a wanted wrench, the largest there is up to a limit.
struct DutySearch {
    program: BoundedSimplex<f64, 6, VARIABLES>,
    /// Largest component of the wrench, over that of a thruster.
    wanted: f64,
}

impl DutySearch {
    /// Without a `force_B`, whatever force comes of it.
    fn of(
        thrusters: &[Thruster<f64>],
        p_BScm_B: Vec3<f64>,
        torque_B: Vec3<f64>,
        force_B: Option<Vec3<f64>>,
        limit: f64,
    ) -> Self {
        let mut rows = [[0.0; VARIABLES]; 6];
        for (k, thruster) in thrusters.iter().take(THRUSTERS).enumerate() {
            let force = thruster.direction_B * thruster.force;
            let torque = (thruster.position_B - p_BScm_B).cross(force);
            let force = if force_B.is_some() { force } else { Vec3::zero() };
            let wrench = [torque, force].map(Vec3::to_array);
            rows.iter_mut().zip(wrench.as_flattened()).for_each(|(row, x)| row[k] = *x);
        }
        let target = [torque_B, force_B.unwrap_or_default()].map(Vec3::to_array);
        rows.iter_mut().zip(target.as_flattened()).for_each(|(row, x)| row[SHARE] = -x);
        // Torque and force are each measured in the largest of one thruster.
        for part in rows.chunks_mut(3) {
            let each = part.iter().flat_map(|row| &row[..SHARE]);
            let most = each.fold(0.0, |most: f64, x| most.max(x.abs()));
            part.as_flattened_mut()
                .iter_mut()
                .for_each(|x| *x /= if most > 0.0 { most } else { 1.0 });
        }
        let wanted = rows.iter().fold(0.0, |most: f64, row| most.max(row[SHARE].abs()));
        let mut upper = [0.0; VARIABLES];
        upper[..SHARE].fill(1.0);
        // No sum of thrusters is larger.
        upper[SHARE] = (limit * wanted).min(2.0 * THRUSTERS as f64);
        for (k, row) in rows.iter_mut().enumerate() {
            row[SHARE] /= if wanted > 0.0 { wanted } else { 1.0 };
            row[SHARE + 1 + k] = 1.0;
        }
        let mut program = BoundedSimplex::new(rows, upper).with_largest_pivots();
        let mut cost = [0.0; VARIABLES];
        cost[SHARE] = -1.0;
        program.minimise(&cost);
        Self { program, wanted }
    }
    /// Share of the wanted wrench that can be had (–).
    fn share(&self) -> f64 {
        self.program.value(SHARE) / self.wanted
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_spatial::vec3;

    /// Twelve thrusters of 22 N in couples on a cube of 2 m: two on each edge midpoint pair.
    fn couples(force: f64) -> Vec<Thruster<f64>> {
        let mut all = vec![];
        for axis in 0..3 {
            let unit = |k: usize| {
                let mut v = [0.0; 3];
                v[k % 3] = 1.0;
                Vec3::from_array(v)
            };
            let (place, push) = (unit(axis + 1), unit(axis + 2));
            for side in [1.0, -1.0] {
                for sign in [1.0, -1.0] {
                    all.push(Thruster {
                        position_B: place * side,
                        direction_B: push * sign,
                        force,
                        specific_impulse: 229.5,
                        ..Default::default()
                    });
                }
            }
        }
        all
    }

    #[test]
    fn a_couple_gives_its_force_times_the_distance_of_its_two() {
        let all = couples(22.0);
        for d in [vec3(1.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0), vec3(0.0, 0.0, 1.0)] {
            let torque = thruster_torque(&all, Vec3::zero(), d);
            // Measured 0.
            assert!((torque.couple - 44.0).abs() < 1e-12, "{torque:?}");
        }
        let diagonal = thruster_torque(&all, Vec3::zero(), vec3(0.6, 0.0, 0.8));
        assert!((diagonal.couple - 44.0 / 0.8).abs() < 1e-12, "{diagonal:?}");
    }

    #[test]
    fn one_thruster_gives_a_torque_but_no_couple() {
        let one = [Thruster {
            position_B: vec3(0.0, 1.0, 0.0),
            direction_B: vec3(0.0, 0.0, 1.0),
            force: 5.0,
            specific_impulse: 200.0,
            ..Default::default()
        }];
        let torque = thruster_torque(&one, Vec3::zero(), vec3(1.0, 0.0, 0.0));
        assert_eq!(torque, ThrusterTorque { couple: 0.0, with_force: 5.0 });
        let other = thruster_torque(&one, Vec3::zero(), vec3(-1.0, 0.0, 0.0));
        assert_eq!(other, ThrusterTorque { couple: 0.0, with_force: 0.0 });
        let nothing = thruster_torque(&[], Vec3::zero(), vec3(1.0, 0.0, 0.0));
        assert_eq!(nothing, ThrusterTorque { couple: 0.0, with_force: 0.0 });
    }

    /// Two thrusters of 22 N at half duty: 22 N through 229.5 s of specific impulse.
    #[test]
    fn the_flow_is_the_force_over_the_exhaust_speed() {
        let all = couples(22.0);
        let flow = least_flow(&all, Vec3::zero(), vec3(22.0, 0.0, 0.0), Some(Vec3::zero()));
        let expected = 22.0 / (229.5 * 9.806_65);
        // Measured 0.
        assert!((flow.unwrap() - expected).abs() < 1e-15, "{flow:?}");
        // A force asks for both of a pair, which make no torque together.
        let pushed = least_flow(&all, Vec3::zero(), Vec3::zero(), Some(vec3(0.0, 0.0, 22.0)));
        assert!((pushed.unwrap() - expected).abs() < 1e-15, "{pushed:?}");
        assert_eq!(least_flow(&all, Vec3::zero(), vec3(50.0, 0.0, 0.0), Some(Vec3::zero())), None);
    }

    /// Away from the middle the same thrusters make the same couple.
    #[test]
    fn a_couple_is_the_same_about_every_point() {
        let all = couples(22.0);
        let off = thruster_torque(&all, vec3(0.3, 0.1, -0.2), vec3(0.0, 0.0, 1.0));
        assert!((off.couple - 44.0).abs() < 1e-12, "{off:?}");
    }

    /// Torque that is a billionth of the force is given too. The expected flow is that of exact rational
    /// arithmetic; without the largest pivots this was off by 4.5e-6 of it.
    #[test]
    fn the_least_flow_does_not_hang_on_tiny_components() {
        let mut all = vec![];
        for corner in 0..8 {
            let side = [1, 2, 4].map(|bit| if corner & bit == 0 { 1.0 } else { -1.0 });
            for axis in 0..3 {
                let mut direction = [0.0; 3];
                direction[axis] = -side[axis];
                all.push(Thruster {
                    position_B: vec3(0.9 * side[0], 0.8 * side[1], 0.8 * side[2]),
                    direction_B: Vec3::from_array(direction),
                    force: 200.0,
                    specific_impulse: 289.0,
                    ..Default::default()
                });
            }
        }
        let (torque, force) = (vec3(-9.3e-9, 4.9e-9, -5.2e-9), vec3(103.6, 144.8, 45.3));
        let flow = least_flow(&all, vec3(0.1, -0.05, 0.02), torque, Some(force)).unwrap();
        // Measured 1.1e-16.
        assert!((flow / 0.103_629_983_305_057_97 - 1.0).abs() < 1e-14, "{flow}");
    }
}
