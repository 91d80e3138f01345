//! What thrusters can do together: the largest torque along a direction, and the least propellant for
//! a wrench.

use super::linear_program::LinearProgram;
use wrasse_hardware::{STANDARD_GRAVITY, Thruster};
use wrasse_spatial::{SpatialForce, Vec3};

/// Largest torque along a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThrusterTorque {
    /// As a couple: no force is left over (N·m).
    pub couple: f64,
    /// With whatever force comes of it (N·m).
    pub with_force: f64,
}

/// Largest torque about the centre of mass `p_BScm_B` (m) along the unit vector `d`, base axes.
pub fn thruster_torque(
    thrusters: &[Thruster<f64>],
    p_BScm_B: Vec3<f64>,
    d: Vec3<f64>,
) -> ThrusterTorque {
    let wrenches = wrenches(thrusters, p_BScm_B);
    let largest = |rows: usize| {
        let direction = [d, Vec3::zero()].map(|v| v.map(|x| -x).to_array()).concat();
        let rows = (0..rows).map(|k| {
            let row = wrenches.iter().map(|w| component(w, k));
            row.chain([direction[k]]).collect()
        });
        let n = thrusters.len();
        let mut gain = vec![0.0; n];
        gain.push(1.0);
        let mut most = vec![1.0; n];
        most.push(f64::INFINITY);
        let rows: Vec<Vec<f64>> = rows.collect();
        let program = LinearProgram { wanted: vec![0.0; rows.len()], rows, gain, most };
        program.solve().map_or(0.0, |x| x[n])
    };
    ThrusterTorque { couple: largest(6), with_force: largest(3) }
}

/// Least propellant flow (kg/s) that gives a torque about the centre of mass `p_BScm_B` and a force,
/// base axes; with `None` for the force, whatever force comes of it. None if the thrusters cannot.
pub fn least_flow(
    thrusters: &[Thruster<f64>],
    p_BScm_B: Vec3<f64>,
    torque_B: Vec3<f64>,
    force_B: Option<Vec3<f64>>,
) -> Option<f64> {
    let wrenches = wrenches(thrusters, p_BScm_B);
    let mut wanted = torque_B.to_array().to_vec();
    wanted.extend(force_B.iter().flat_map(|f| f.to_array()));
    let rows =
        (0..wanted.len()).map(|k| wrenches.iter().map(|w| component(w, k)).collect::<Vec<_>>());
    let flow = |t: &Thruster<f64>| t.force / (t.specific_impulse * STANDARD_GRAVITY);
    let program = LinearProgram {
        rows: rows.collect(),
        wanted,
        gain: thrusters.iter().map(|t| -flow(t)).collect(),
        most: vec![1.0; thrusters.len()],
    };
    let duty = program.solve()?;
    Some(thrusters.iter().zip(duty).map(|(t, x)| flow(t) * x).sum())
}

/// Wrench of each thruster when it is open, about the centre of mass.
fn wrenches(thrusters: &[Thruster<f64>], p_BScm_B: Vec3<f64>) -> Vec<SpatialForce<f64>> {
    let wrench = |t: &Thruster<f64>| {
        let force = t.direction_B * t.force;
        SpatialForce { torque: (t.position_B - p_BScm_B).cross(force), force }
    };
    thrusters.iter().map(wrench).collect()
}

/// Torque x, y, z, then force x, y, z.
fn component(wrench: &SpatialForce<f64>, k: usize) -> f64 {
    [wrench.torque, wrench.force][k / 3].to_array()[k % 3]
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
}
