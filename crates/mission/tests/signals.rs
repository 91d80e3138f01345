//! The signals of shipped missions.

use std::path::Path;
use wrasse_flight::Command;
use wrasse_mission::{Mission, read_mission};
use wrasse_rehearsal::{Case, Event, Needs, Observer, Simulation, TruePlant, Watch};
use wrasse_vehicle::JOINTS;

fn mission(name: &str) -> Mission {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../missions").join(name);
    let text = std::fs::read_to_string(&path).expect("a mission of the repository");
    read_mission(&path, text).expect("it is sound")
}

/// All signals, and each with what it needs alone.
struct Beside {
    all: Watch,
    alone: Vec<Watch>,
}

impl Beside {
    fn new(case: &Case) -> Self {
        let alone = (0..case.quantities.len()).map(|i| Watch::new(case, Needs::of(case, &[i])));
        Self { all: Watch::new(case, Needs::ALL), alone: alone.collect() }
    }
}

impl<'a> Observer<TruePlant<'a>> for Beside {
    fn flown(
        &mut self,
        flight: &Simulation<'_, TruePlant<'a>>,
        command: &Command<f64, JOINTS>,
        events: &mut Vec<Event>,
    ) {
        self.all.flown(flight, command, events);
        self.alone.iter_mut().for_each(|watch| watch.flown(flight, command, events));
    }
}

/// What a run shows, a sweep sees: a signal that is worked out with what it needs, and nothing else,
/// has the bits that it has with everything.
#[test]
fn a_signal_is_the_same_with_what_it_needs_alone() {
    for name in [
        "atlas-reach.toml",
        "two-arms.toml",
        "base-control/hybrid.toml",
        "base-control/cmgs.toml",
        "base-control/thrusters.toml",
    ] {
        let mission = mission(name);
        let case = &mission.cases[0];
        let mut flight = Simulation::new(case);
        let mut seen = Beside::new(case);
        for _ in 0..40 {
            flight.step(&mut seen).expect("it flies");
        }
        let all = seen.all.values();
        assert!(all.iter().filter(|x| x.is_finite()).count() > 30, "{name}");
        for (i, quantity) in case.quantities.iter().enumerate() {
            let alone = seen.alone[i].values()[i];
            assert_eq!(alone.to_bits(), all[i].to_bits(), "{name}: {}", quantity.name);
        }
    }
}
