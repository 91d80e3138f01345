//! A vehicle that nothing drives: what its energy and momentum do.

use wrasse_dynamics::{JointKind, State};
use wrasse_spatial::{SpatialVelocity, Vec3};
use wrasse_vehicle::{Finding, FindingKind, Fine, JOINTS, Vehicle};
use wrasse_world::{BaseAttitude, Equipment, Noise, Scene, Stepper, SystemSetup};

/// Step of the integrator (s), classical Runge-Kutta of order 4.
const STEP: f64 = 1e-3;
/// The ledger is brought up to date so often (s), and so many times.
const PERIOD: f64 = 0.1;
const PERIODS: u32 = 100;
/// Largest rates at the start: joints that turn and that slide (rad/s, m/s), base (rad/s, m/s).
const RATES: [f64; 4] = [0.5, 0.1, 0.05, 0.1];
/// Relative drift that is told (–). Where the fastest motion takes many steps the drift is round-off: at
/// most 1.8e-13 in the catalogue (energy of ssrms), 4.4e-12 in public files of arms and walking machines.
/// A motion too fast for the step drifts with its fifth power, soon far above.
const BOUND: f64 = 1e-8;
/// Seed of the coast of a check: any will do, if it is always the same.
pub const COAST_SEED: u64 = 1;

/// How far energy and momentum drifted in a coast.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coast {
    /// Seed of the rates at the start.
    pub seed: u64,
    /// Largest drift of kinetic energy, as a part of it (–).
    pub energy: f64,
    /// Largest drift of linear momentum, as a part of the sum of that of the bodies (–).
    pub linear: f64,
    /// Largest drift of angular momentum about the origin of N, as a part of the sum of that of the
    /// bodies (–).
    pub angular: f64,
    /// When a number was no longer finite (s).
    pub broke_down: Option<f64>,
}

/// Ten seconds of free floating from the middle of the travels, with random rates of joints and base.
/// Units of the base stand still, the ends of a travel stop nothing, and joints that follow others move
/// by themselves.
pub fn coast(vehicle: &Vehicle, seed: u64) -> Coast {
    let mut scene: Scene<JOINTS> = Scene::new(Stepper::Fixed { step: STEP });
    scene.add(&SystemSetup {
        robot: &vehicle.robot,
        limits: &vehicle.limits,
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        start: start(vehicle, seed),
        held: &[],
    });
    let mut ledger = scene.open_ledger();
    let mut broke_down = None;
    for _ in 0..PERIODS {
        scene.begin_period();
        if scene.advance(PERIOD).is_err() {
            broke_down = Some(scene.time());
            break;
        }
        scene.update_ledger(&mut ledger);
    }
    // A vehicle at rest does not drift.
    let part =
        |k: usize| if ledger.scale[k] > 0.0 { ledger.worst[k] / ledger.scale[k] } else { 0.0 };
    Coast { seed, energy: part(2), linear: part(1), angular: part(0), broke_down }
}

fn start(vehicle: &Vehicle, seed: u64) -> State<f64, JOINTS> {
    let mut noise = Noise::new(seed, 0);
    let mut within = |most: f64| most * (2.0 * noise.uniform() - 1.0);
    let [turns, slides, base_turns, base_slides] = RATES;
    let mut vector = |most: f64| Vec3::from_array([most; 3].map(&mut within));
    let V_NB_B = SpatialVelocity::new(vector(base_turns), vector(base_slides));
    let mut state = State { V_NB_B, ..State::default() };
    for j in vehicle.robot.joints() {
        let travel = vehicle.limits.get(j).and_then(|limits| limits.travel);
        state.q[j] = travel.map_or(0.0, |(lower, upper)| 0.5 * (lower + upper));
        state.v[j] = within(match vehicle.robot.joint(j).kind {
            JointKind::Revolute => turns,
            JointKind::Prismatic => slides,
        });
    }
    state
}

impl Coast {
    /// What a deep check says of it.
    pub fn finding(&self, vehicle: &Vehicle) -> (Vec<Finding>, Fine) {
        let Self { seed, energy, linear, angular, broke_down } = *self;
        let kind = FindingKind::CoastDrift;
        let numbers = vec![
            ("energy_drift", energy),
            ("linear_momentum_drift", linear),
            ("angular_momentum_drift", angular),
            ("seed", seed as f64),
        ];
        let drifts = format!(
            "energy drifts by {energy:.1e}, linear momentum by {linear:.1e}, angular momentum by \
             {angular:.1e} in {} s (relative; seed {seed}, step {STEP} s)",
            PERIOD * f64::from(PERIODS)
        );
        let message = match broke_down {
            Some(t) => format!("after {t:.1} s a number is no longer finite; until then {drifts}"),
            None => drifts,
        };
        // A NaN is no small drift.
        let is_small = [energy, linear, angular].iter().all(|drift| *drift <= BOUND);
        let found = (broke_down.is_some() || !is_small).then(|| Finding {
            kind,
            severity: wrasse_vehicle::FindingSeverity::Warning,
            subject: vehicle.name.clone(),
            place: None,
            message: format!("{message}; bound {BOUND:.0e}"),
            numbers: numbers.clone(),
        });
        (found.into_iter().collect(), Fine { kind, message, numbers })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_vehicle::{catalogue, read_vehicle};

    /// Measured 1.8e-13, as it is told beside the bound.
    #[test]
    fn no_vehicle_of_the_catalogue_drifts() {
        for entry in catalogue() {
            let vehicle = entry.read().expect("the catalogue reads");
            let (found, fine) = coast(&vehicle, COAST_SEED).finding(&vehicle);
            assert_eq!(found, [], "{}", entry.name);
            let drifts = fine.numbers.iter().take(3);
            assert!(drifts.clone().all(|(_, drift)| *drift < 1e-12), "{}: {fine:?}", entry.name);
        }
    }

    /// A lump of 50 kg at the end of a turning boom, hinged a hundredth of a millimetre off its centre,
    /// swings at about 200 rad/s: the step is too long for it.
    #[test]
    fn a_motion_too_fast_for_the_step_is_told() {
        let text = r#"<robot name="lump">
          <link name="bus"><inertial><mass value="100"/>
            <inertia ixx="10" iyy="11" izz="12" ixy="0" ixz="0" iyz="0"/></inertial></link>
          <link name="boom"><inertial><origin xyz="1 0 0"/><mass value="50"/>
            <inertia ixx="1" iyy="9" izz="9" ixy="0" ixz="0" iyz="0"/></inertial></link>
          <link name="lump"><inertial><origin xyz="1e-5 0 0"/><mass value="50"/>
            <inertia ixx="2e-9" iyy="2e-9" izz="2e-9" ixy="0" ixz="0" iyz="0"/></inertial></link>
          <joint name="j1" type="continuous"><parent link="bus"/><child link="boom"/>
            <origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
          <joint name="j2" type="revolute"><parent link="boom"/><child link="lump"/>
            <origin xyz="2 0 0"/><axis xyz="0 0 1"/>
            <limit lower="1" upper="2.14" effort="1" velocity="1"/></joint></robot>"#;
        let vehicle = read_vehicle("lump.urdf", text).expect("a vehicle");
        let (found, _) = coast(&vehicle, COAST_SEED).finding(&vehicle);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].kind, FindingKind::CoastDrift);
    }

    #[test]
    fn the_bound_is_told_from_just_above_it_and_a_nan_counts() {
        let vehicle = catalogue()[0].read().expect("the catalogue reads");
        let fine = Coast { seed: 1, energy: BOUND, linear: 0.0, angular: 0.0, broke_down: None };
        assert!(fine.finding(&vehicle).0.is_empty());
        for coast in [
            Coast { energy: 1.01 * BOUND, ..fine },
            Coast { linear: 1.01 * BOUND, ..fine },
            Coast { angular: f64::NAN, ..fine },
            Coast { broke_down: Some(0.1), ..fine },
        ] {
            assert_eq!(coast.finding(&vehicle).0.len(), 1, "{coast:?}");
        }
    }
}
