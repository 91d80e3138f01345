//! What the plant answers to what the loops of the joints ask for, by a second route.

use nalgebra::DMatrix;
use wrasse_dynamics::{BaseMode, JointDrive, PerBody, driven_dynamics, kinematics};
use wrasse_flight::{Feedforward, Tuning, computed_torque, feedforward_torque};
use wrasse_hardware::SetPoint;
use wrasse_mission::read_mission;
use wrasse_rehearsal::{Case, sampled_loops};
use wrasse_spatial::SpatialForce;
use wrasse_testing::largest;
use wrasse_world::BaseAttitude;

/// A client of the servicer's mass in the grip; all joints driven by torque.
fn laden(law: &str, base: &str) -> Case {
    let text = format!(
        "name = \"laden\"\nvehicle = \"atlas-class\"\n[initial]\nposture = \"sideways_300mm\"\n\
         [payload.client]\nmass_kg = 1500.0\ncentre_of_mass_m = [1.25, 0.1, -0.2]\n\
         uniform_box_m = [2.5, 2.0, 1.5]\nheld_by = \"tool\"\n\
         [world]\nbase_attitude = \"{base}\"\njoints = \"torque\"\n\
         [control]\narm_law = \"{law}\"\njoint_bandwidth_rad_s = 0.1\n\
         [[phase]]\nname = \"stay\"\nhold = {{ duration_s = 1.0 }}\n"
    );
    let mission = read_mission("laden.toml", text).expect("it is a mission");
    mission.cases[0].clone()
}

/// Largest eigenvalue of the accelerations that forward dynamics answer to those that the law asks
/// for, one joint after the other.
fn answered(case: &Case) -> f64 {
    let (robot, start) = (case.robot_at_start(), case.start);
    let (k, law) = (kinematics(&robot, &start), case.setup.assignment.law);
    let n = robot.joint_count();
    let at_rest = start.q.map(|position| SetPoint { position, ..SetPoint::default() });
    let tuning = Tuning { joint_bandwidth: 0.0, ..case.setup.tuning };
    let mut answers = DMatrix::zeros(n, n);
    for j in 0..n {
        let mut asked = at_rest;
        asked[j].acceleration = 1.0;
        let accelerations = asked.map(|s| s.acceleration);
        let tau = computed_torque(&robot, law, &tuning, &start, &at_rest, &accelerations);
        let mut outside = PerBody::filled(SpatialForce::zero());
        let mode = match case.base {
            BaseAttitude::Held => BaseMode::AttitudeHeld,
            _ => BaseMode::Free,
        };
        if case.base == BaseAttitude::Controlled {
            outside.base.torque = feedforward_torque(&robot, Feedforward::Exact, &asked);
        }
        let found = driven_dynamics(&k, &tau.map(JointDrive::Effort), mode, &outside);
        (0..n).for_each(|i| answers[(i, j)] = found.nudot.joints[i]);
    }
    let schur = nalgebra::Schur::try_new(answers, 1e-13, 10_000).expect("it converges");
    largest(schur.complex_eigenvalues().iter().map(|e| e.norm()))
}

/// Second route: the law's torques through forward dynamics. Measured: 3e-13 of it.
#[test]
fn the_plant_answers_as_forward_dynamics_do() {
    for (law, base) in [
        ("terrestrial", "free"),
        ("terrestrial", "held"),
        ("terrestrial", "controlled"),
        ("attitude-held", "free"),
        ("free-floating", "held"),
        ("attitude-held", "controlled"),
        ("free-floating", "free"),
    ] {
        let case = laden(law, base);
        let (gain, found) = (sampled_loops(&case)[0].gain, answered(&case));
        assert!((gain / found - 1.0).abs() < 1e-11, "{law} {base}: {gain}, found {found}");
    }
}
