//! Whatever sets, wants and readings there are: no command beyond limits, none that is NaN.

use super::bench::{
    Bench, PERIOD, actuators, cmgs, demand, desaturation, setup, thrusters, wheels,
};
use proptest::num::f64::{ANY, INFINITE, NEGATIVE, NORMAL, POSITIVE, QUIET_NAN, SUBNORMAL, ZERO};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use wrasse_flight::allocation::{
    AllocationSetup, Allocator, CmgLaw, CmgSharing, Damping, Demand, Desaturation, Modulation,
    Waves, WheelLaw, WheelSharing,
};
use wrasse_hardware::{ActuatorReadings, Actuators, THRUSTERS};
use wrasse_spatial::{Scalar, SpatialForce, Vec3};

fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(20_040_906),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// Any number at all, most often a decent one.
fn number(size: f64) -> impl Strategy<Value = f64> {
    let odd = POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO | INFINITE | QUIET_NAN;
    prop_oneof![12 => -size..size, 1 => odd, 1 => ANY]
}

fn three(size: f64) -> impl Strategy<Value = [f64; 3]> {
    [number(size), number(size), number(size)]
}

/// Torque, force, rate of the base, speeds and angles of a period.
type Period = ([f64; 3], [f64; 3], [f64; 3], [f64; 8], [f64; 8]);

fn any_period() -> impl Strategy<Value = Period> {
    let eight = |size: f64| {
        prop::collection::vec(number(size), 8).prop_map(|v| std::array::from_fn(|i| v[i]))
    };
    (three(30.0), three(100.0), three(0.1), eight(900.0), eight(4.0))
}

fn decent_period() -> impl Strategy<Value = Period> {
    let three = |size: f64| prop::array::uniform3(-size..size);
    let eight = |size: f64| prop::array::uniform8(-size..size);
    (three(30.0), three(100.0), three(0.1), eight(900.0), eight(4.0))
}

/// The first so many wheels, CMGs and thrusters.
fn some_actuators() -> impl Strategy<Value = Actuators<f64>> {
    (0..=4_usize, 0..=4_usize, 0..=24_usize)
        .prop_map(|(w, g, t)| actuators(&wheels(0.2)[..w], &cmgs()[..g], &thrusters(22.0)[..t]))
}

fn some_setup<T: Scalar>(
    all: &Actuators<f64>,
    robust: bool,
    holds_position: bool,
) -> AllocationSetup<T> {
    let c = T::from_f64;
    let damping = Damping { k0: c(0.01), fading: c(10.0) };
    let waves = Waves { height: c(0.01), frequency: c(1.6), phases: [c(0.0), c(1.6), c(3.1)] };
    let plain = setup(all);
    let m = plain.modulation;
    let empty = desaturation();
    AllocationSetup {
        actuators: all.cast(),
        wheels: WheelLaw {
            sharing: if robust { WheelSharing::MinimumPeak } else { WheelSharing::PseudoInverse },
            null_gain: c(0.05),
        },
        cmgs: CmgLaw {
            sharing: if robust {
                CmgSharing::GeneralizedSingularityRobust(damping, waves)
            } else {
                CmgSharing::PseudoInverse
            },
            null_gain: c(0.2),
        },
        modulation: Modulation {
            gain: c(m.gain),
            lag: c(m.lag),
            on_level: c(m.on_level),
            off_level: c(m.off_level),
        },
        holds_position,
        desaturation: robust.then(|| Desaturation {
            target_B: Vec3::zero(),
            gain: c(empty.gain),
            start: c(empty.start),
            stop: c(empty.stop),
            active: false,
        }),
    }
}

/// A few periods in a row. Whether all commands are within limits, and whether all that is reported
/// is finite.
fn flown_by<T: Scalar>(setup: &AllocationSetup<T>, periods: &[Period]) -> (bool, bool) {
    let three = |of: [f64; 3]| Vec3::from_array(of.map(T::from_f64));
    let (mut allocator, all, mut within, mut finite) =
        (Allocator::new(setup), &setup.actuators, true, true);
    for (torque, force, w_NB_B, speeds, angles) in periods {
        let demand = Demand {
            wanted: SpatialForce::new(three(*torque), three(*force)),
            w_NB_B: three(*w_NB_B),
            p_BScm_B: three([0.1, -0.2, 0.05]),
            period: T::from_f64(PERIOD),
        };
        let readings = ActuatorReadings {
            wheel_speed: speeds.map(T::from_f64),
            gimbal_angle: angles.map(T::from_f64),
            ..ActuatorReadings::default()
        };
        let told = allocator.allocate(&demand, &readings);
        for (k, &torque) in told.command.wheel_torque.iter().enumerate() {
            let limit = all.wheels.get(k).map_or(T::zero(), |w| w.torque_limit);
            within &= torque.abs() <= limit;
        }
        for (k, &rate) in told.command.gimbal_rate.iter().enumerate() {
            let limit = all.cmgs.get(k).map_or(T::zero(), |g| g.rate_limit);
            within &= rate.abs() <= limit;
        }
        for (k, &on) in told.command.thruster_on.iter().enumerate() {
            let limit = if k < all.thrusters.len() { demand.period } else { T::zero() };
            within &= T::zero() <= on && on <= limit;
        }
        let report = told.report;
        let numbers = [report.missing.torque, report.missing.force, report.stored_B];
        finite &= report.singularity.is_finite();
        finite &= numbers.iter().all(|v| v.to_array().iter().all(|x| x.is_finite()));
    }
    (within, finite)
}

proptest! {
    #![proptest_config(cases(512))]

    #[test]
    fn no_command_is_beyond_its_limit_or_no_number(
        all in some_actuators(),
        robust: bool,
        holds: bool,
        periods in prop::collection::vec(any_period(), 1..6)
    ) {
        prop_assert!(flown_by(&some_setup::<f64>(&all, robust, holds), &periods).0);
        prop_assert!(flown_by(&some_setup::<f32>(&all, robust, holds), &periods).0, "f32");
    }

    #[test]
    fn what_is_reported_is_finite_if_what_came_in_was(
        all in some_actuators(),
        robust: bool,
        holds: bool,
        periods in prop::collection::vec(decent_period(), 1..6)
    ) {
        prop_assert!(flown_by(&some_setup::<f64>(&all, robust, holds), &periods).1);
        prop_assert!(flown_by(&some_setup::<f32>(&all, robust, holds), &periods).1, "f32");
    }
}

/// After bad periods come good ones: the same commands as without the bad, once what they left has
/// died out. Measured 3e-32 N·m missing.
#[test]
fn nothing_that_came_in_spoils_the_steering_for_ever() {
    let all = actuators(&wheels(0.2), &cmgs(), &thrusters(2.0));
    let good = demand([0.3, -0.2, 0.4], [0.5, 0.2, -0.3]);
    for bad in [f64::NAN, f64::INFINITY, -f64::MAX] {
        let mut bench = Bench::new(&setup(&all));
        let mut spoilt = good;
        spoilt.wanted.torque.y = bad;
        spoilt.w_NB_B.x = bad;
        bench.step(&spoilt);
        for _ in 0..500 {
            bench.step(&good);
        }
        let report = bench.last.report;
        let missing = report.missing.torque.norm();
        assert!(missing < 1e-12, "{report:?} after {bad}");
    }
}

proptest! {
    #![proptest_config(cases(64))]

    /// From period to period: wants that change each time, pulses that go on into the next. Measured: the
    /// shortest are of 0.03 s to round-off, what the thrusters can do.
    #[test]
    fn no_pulse_is_shorter_than_its_thruster_can_be_open(
        wants in prop::collection::vec(
            (prop::array::uniform3(-20.0..20.0), prop::array::uniform3(-20.0..20.0)), 200)
    ) {
        let mut bench = Bench::new(&setup(&actuators(&[], &cmgs(), &thrusters(22.0))));
        let (mut open_for, mut shortest) = ([0.0_f64; THRUSTERS], f64::INFINITY);
        for (torque, force) in wants {
            bench.step(&demand(torque, force));
            for (so_far, on) in open_for.iter_mut().zip(bench.last.command.thruster_on) {
                *so_far += on;
                if on < PERIOD {
                    shortest = if *so_far > 0.0 { shortest.min(*so_far) } else { shortest };
                    *so_far = 0.0;
                }
            }
        }
        prop_assert!(shortest >= 0.03 - 1e-12, "{shortest} s");
        prop_assert!(shortest < 1.0, "some pulse ended");
    }
}
