//! The ledger of a flight in the form that is reported.

use crate::outcome::Ledger;
use serde::{Serialize, Serializer};
use wrasse_world::{Account, BaseAttitude, Booking, Source};

/// The ledger in the form that is reported.
pub(crate) fn ledger(books: &wrasse_world::Ledger, base: BaseAttitude) -> Ledger {
    // Momentum is exact where it is the state; where the attitude is held its torque is a quadrature
    // of the same order as the integration, and so is all work.
    let bounds = match base {
        BaseAttitude::Held => [1e-6, 1e-11, 1e-6],
        BaseAttitude::Controlled | BaseAttitude::Free => [1e-11, 1e-11, 1e-6],
    };
    let holds = |i: usize| books.worst[i] <= bounds[i] * books.scale[i] + f64::MIN_POSITIVE;
    Ledger {
        start: books.start,
        end: books.now,
        sources: books.sources,
        propellant: books.propellant,
        residual: books.worst,
        scale: books.scale,
        closes: (0..3).all(holds),
        bounds,
    }
}

/// Momentum and energy at an instant, as `summary.json` has them.
#[derive(Serialize)]
struct Instant {
    angular_nms: [f64; 3],
    linear_ns: [f64; 3],
    energy_j: f64,
    in_wheels_nms: [f64; 3],
    in_cmgs_nms: [f64; 3],
}

impl Instant {
    fn of(account: &Account) -> Self {
        let stored = |source: Source| account.stored[source as usize].to_array();
        Self {
            angular_nms: account.angular.to_array(),
            linear_ns: account.linear.to_array(),
            energy_j: account.energy,
            in_wheels_nms: stored(Source::Wheels),
            in_cmgs_nms: stored(Source::Cmgs),
        }
    }
}

/// What a source gave, as `summary.json` has it.
#[derive(Serialize)]
struct Given {
    source: &'static str,
    angular_nms: [f64; 3],
    linear_ns: [f64; 3],
    work_j: f64,
}

impl Given {
    fn of(source: Source, given: &Booking) -> Self {
        let (angular_nms, linear_ns) = (given.angular.to_array(), given.linear.to_array());
        Self { source: source.name(), angular_nms, linear_ns, work_j: given.work }
    }
}

/// A ledger as `summary.json` has it.
#[derive(Serialize)]
struct LedgerFile {
    start: Instant,
    end: Instant,
    sources: Vec<Given>,
    propellant_kg: f64,
    /// Angular, linear, energy, as are the others.
    residual: [f64; 3],
    scale: [f64; 3],
    bounds: [f64; 3],
    closes: bool,
}

impl Serialize for Ledger {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let given = |source: Source| Given::of(source, &self.sources[source]);
        LedgerFile {
            start: Instant::of(&self.start),
            end: Instant::of(&self.end),
            sources: Source::ALL.map(given).into(),
            propellant_kg: self.propellant,
            residual: self.residual,
            scale: self.scale,
            bounds: self.bounds,
            closes: self.closes,
        }
        .serialize(serializer)
    }
}
