//! A coast of 600 s at 10 ms steps: momentum, centre of mass and energy, read from the bodies.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod atlas_class;

use atlas_class::{J, coasting, cube, tool, unladen};
use wrasse_dynamics::{Frame, MassProperties};
use wrasse_hardware::ActuatorCommand;
use wrasse_spatial::Vec3;
use wrasse_testing::larger;
use wrasse_world::{BaseAttitude, Drive, Equipment, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// Drift over the coast: angular and linear momentum relative to the sum of the bodies' absolute
/// momenta, centre of mass relative to the distance gone, energy relative to itself.
fn drift(stepper: Stepper) -> [f64; 4] {
    let held: [(Frame<f64>, MassProperties<f64>); 1] = [(tool(), cube(500.0))];
    let robot = unladen();
    let mut world: OneSystem<J> = OneSystem::new(&OneSystemSetup {
        robot: &robot,
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        stepper,
        start: coasting(),
        held: &held,
    });
    let mut ledger = world.open_ledger();
    let velocity = ledger.start.linear * (1.0 / world.robot().mass());
    let mut worst_cm = 0.0_f64;
    let mut worst_energy = 0.0_f64;
    let mut worst = [0.0_f64; 2];
    for second in 0..600 {
        for _ in 0..100 {
            world.command(
                &[Drive::Effort(0.0); J],
                Vec3::zero(),
                &ActuatorCommand::default(),
                0.01,
            );
            world.advance(0.01).expect("stays finite");
        }
        world.update_ledger(&mut ledger);
        let gone = velocity * f64::from(second + 1);
        let off = ledger.now.centre_of_mass - ledger.start.centre_of_mass - gone;
        worst_cm = larger(worst_cm, off.norm() / gone.norm());
        worst_energy = larger(worst_energy, (ledger.now.energy / ledger.start.energy - 1.0).abs());
        let [angular, linear, _] = ledger.residuals();
        worst[0] = larger(worst[0], angular / ledger.now.angular_scale);
        worst[1] = larger(worst[1], linear / ledger.now.linear_scale);
    }
    [worst[0], worst[1], worst_cm, worst_energy]
}

#[test]
fn a_coast_at_fixed_step_keeps_momentum_centre_of_mass_and_energy() {
    let [angular, linear, cm, energy] = drift(Stepper::Fixed { step: 0.01 });
    // Measured: 2.7e-15, 2.0e-15, 1.8e-14, 2.1e-9.
    assert!(angular < 1e-13, "angular {angular:.1e}");
    assert!(linear < 1e-13, "linear {linear:.1e}");
    assert!(cm < 1e-12, "centre of mass {cm:.1e}");
    assert!(energy < 1e-8, "energy {energy:.1e}");
}

#[test]
fn a_coast_with_error_control_keeps_energy_to_1e_11() {
    let [angular, linear, cm, energy] = drift(Stepper::Adaptive { tolerance: 1e-13 });
    // Measured: 3.4e-15, 1.9e-15, 1.8e-14, 3.9e-14.
    assert!(angular < 1e-13, "angular {angular:.1e}");
    assert!(linear < 1e-13, "linear {linear:.1e}");
    assert!(cm < 1e-12, "centre of mass {cm:.1e}");
    assert!(energy < 1e-11, "energy {energy:.1e}");
}
