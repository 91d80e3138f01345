//! One task against one set of actuators: torque, momentum, time to saturation, pace, fuel.

use crate::capability::{Capability, Reach};
use crate::demand::Demand;
use crate::envelope::{SteeringPath, first_outside, least_flow, steering_path, steering_reach};
use serde::Serialize;
use wrasse_spatial::Vec3;

/// Whether a set suffices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Answer {
    /// It does.
    Yes,
    /// Not ruled out, but needs steering that starts from good gimbal angles, or avoids or escapes
    /// singularities.
    WithSteering,
    /// It does not, whatever steers it.
    No,
}

/// A figure with plain steering, and with the best there is. The two differ for CMGs only.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Both<T> {
    /// With steering by the pseudo-inverse from the angles at the start.
    pub plain: T,
    /// With the best steering: what no law can better.
    pub best: T,
}

/// How a task stands to a set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judgement {
    /// Whether the torque can be given.
    pub torque: Answer,
    /// Whether the momentum can be held while the task lasts.
    pub momentum: Answer,
    /// Whether the tank holds the propellant; yes if none is said to be needed, or no tank is given.
    pub propellant: Answer,
    /// Largest torque that is asked for, over what the set can give then (–).
    pub torque_load: Both<f64>,
    /// Torque that the set can give along the peak of the demand (N·m).
    pub torque_there: Reach,
    /// Momentum that the set can hold along the peak of the demand (N·m·s).
    pub momentum_there: Reach,
    /// When the set can hold no more (s), on and on for a task that ends under load.
    pub saturates: Both<Option<f64>>,
    /// Factor by which the task must be slower for the set to suffice; none for a task that is not the
    /// vehicle's own motion, or where no pace helps.
    pub slower: Both<Option<f64>>,
    /// Propellant of the thrusters for the torque alone (kg).
    pub fuel: Option<f64>,
    /// Propellant of the thrusters for the torque and for the force that keeps the base in place (kg).
    pub fuel_in_place: Option<f64>,
}

/// Largest time-scaling factor that is tried (–).
const SLOWEST: f64 = 1e4;
/// Longest time to saturation that is looked for (s).
const LONGEST: f64 = 1e12;
/// Halvings of the interval that holds the pace, and the time to saturation.
const HALVINGS: usize = 40;

/// How a demand stands to a set. `own_motion`: it comes from the vehicle's own motion, which can be done
/// more slowly.
pub fn judge(demand: &Demand, able: &Capability, own_motion: bool) -> Judgement {
    let demand = demand.thinned();
    let best = best_torque_load(&demand, able);
    // A motion of the vehicle's own ends at rest; a push from outside may go on.
    let shared = Shared::of(&demand, own_motion, able);
    let lasting = lasting(&shared.stored, own_motion);
    let leaves = leaves_at_best(&shared.stored, lasting, able);
    let plain = Plain::follow(&demand, &shared.stored, lasting, able);
    let fuel = fuel(&shared.pushed, able, false);
    let torque_load = Both { plain: plain.torque_load.unwrap_or(best), best };
    let stops = if able.cmgs.is_empty() || able.is_unbounded() { leaves } else { plain.stops };
    let answer = |plain: bool, best: bool| match (plain, best) {
        (true, true) => Answer::Yes,
        (false, true) => Answer::WithSteering,
        (_, false) => Answer::No,
    };
    let ended = demand.time.last().copied().unwrap_or_default();
    let holds = |at: Option<f64>| at.is_none_or(|at| at > ended);
    let slower = if own_motion {
        let best = slower_at_best(best, &demand, able);
        Both { plain: slower_plain(&demand, able, best), best }
    } else {
        Both { plain: None, best: None }
    };
    Judgement {
        torque: answer(torque_load.plain <= 1.0, best <= 1.0),
        momentum: answer(holds(stops), holds(leaves)),
        propellant: propellant(fuel, able),
        torque_load,
        torque_there: along(demand.peak_torque(), |d| able.torque_along(d)),
        momentum_there: along(demand.peak_momentum(), |d| able.momentum_along(d)),
        saturates: Both { plain: stops, best: leaves },
        slower,
        fuel,
        fuel_in_place: self::fuel(&shared.pushed, able, true),
    }
}

/// A demand shared between thrusters and what stores momentum.
struct Shared {
    /// What wheels and CMGs have to store.
    stored: Demand,
    /// What thrusters have to give.
    pushed: Demand,
}

impl Shared {
    /// Beside wheels and CMGs that hold all of the momentum, thrusters give what torque is missing. Else
    /// they take all that they can, and the others the rest.
    fn of(demand: &Demand, own_motion: bool, able: &Capability) -> Self {
        if !able.is_hybrid() {
            return Self { stored: demand.clone(), pushed: demand.clone() };
        }
        let fits = leaves_at_best(demand, lasting(demand, own_motion), able).is_none();
        if fits {
            let pushed = demand.less(|d| able.torque.radius(d));
            return Self { stored: demand.clone(), pushed };
        }
        let stored = demand.less(|d| able.couple(d));
        let torques = demand.torque_B.iter().zip(&stored.torque_B);
        let pushed = Demand { torque_B: torques.map(|(a, b)| *a - *b).collect(), ..demand.clone() };
        Self { stored, pushed }
    }
}

/// Momentum gathered every second after a push that goes on (N·m·s/s).
fn lasting(demand: &Demand, own_motion: bool) -> Option<Vec3<f64>> {
    if own_motion { None } else { demand.sustained() }
}

/// Whether the tank holds what is needed.
fn propellant(fuel: Option<f64>, able: &Capability) -> Answer {
    let over = fuel.zip(able.propellant).is_some_and(|(fuel, tank)| fuel > tank);
    if over { Answer::No } else { Answer::Yes }
}

/// A reach along a vector; endless along none.
fn along(v: Vec3<f64>, reach: impl Fn(Vec3<f64>) -> Reach) -> Reach {
    let size = v.norm();
    if size > 0.0 {
        reach(v * (1.0 / size))
    } else {
        Reach { plain: f64::INFINITY, most: f64::INFINITY }
    }
}

/// Size over reach: nothing asks nothing, and what cannot be had is infinitely too much.
fn load(v: Vec3<f64>, reach: impl Fn(Vec3<f64>) -> f64) -> f64 {
    let size = v.norm();
    if size > 0.0 { size / reach(v * (1.0 / size)) } else { 0.0 }
}

fn best_torque_load(demand: &Demand, able: &Capability) -> f64 {
    let loads = demand.torque_B.iter().map(|t| load(*t, |d| able.torque_along(d).most));
    loads.fold(0.0, f64::max)
}

/// When the demand leaves the momentum envelope (s); `lasting`: momentum gathered every second after
/// its end (N·m·s/s).
fn leaves_at_best(demand: &Demand, lasting: Option<Vec3<f64>>, able: &Capability) -> Option<f64> {
    if able.is_unbounded() {
        return None;
    }
    let outside = first_outside(&demand.time, &demand.momentum_B, |h| able.momentum.load(h));
    outside.or_else(|| {
        let (rate, held) = (lasting?, *demand.momentum_B.last()?);
        let over = |after: f64| able.momentum.load(held + rate * after) > 1.0;
        let mut far = 1.0;
        while !over(far) {
            far *= 2.0;
            // NaN never saturates.
            if far > LONGEST {
                return None;
            }
        }
        Some(demand.time.last()? + boundary(0.0, far, over))
    })
}

/// Where `over` begins between `low`, where it is false, and `high`, where it is true.
fn boundary(mut low: f64, mut high: f64, over: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if over(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// What comes of plain steering along a demand.
struct Plain {
    /// Largest torque over what the gimbals can give where they are then (–); none without CMGs.
    torque_load: Option<f64>,
    /// When the steering gets no further (s).
    stops: Option<f64>,
}

impl Plain {
    /// `stored`: what wheels and CMGs hold of the demand.
    fn follow(
        demand: &Demand,
        stored: &Demand,
        lasting: Option<Vec3<f64>>,
        able: &Capability,
    ) -> Self {
        if able.cmgs.is_empty() {
            return Self { torque_load: None, stops: None };
        }
        let path = steering_path(&able.cmgs, &able.gimbal_angle, &beyond_wheels(stored, able));
        let asked = path.angles.iter().zip(&demand.torque_B);
        let loads = asked.map(|(angles, torque)| load(*torque, |d| able.torque_at(angles, d)));
        let torque_load = Some(loads.fold(0.0, f64::max));
        Self { torque_load, stops: stops(demand, lasting, able, &path) }
    }
}

/// Momentum that is left to the CMGs: wheels take what they can of the torque, until they are full.
fn beyond_wheels(stored: &Demand, able: &Capability) -> Vec<Vec3<f64>> {
    if able.wheel_momentum.is_empty() {
        return stored.momentum_B.clone();
    }
    let rest = stored.less(|d| able.wheel_torque.radius(d));
    let both = stored.momentum_B.iter().zip(&rest.momentum_B);
    both.map(|(all, rest)| {
        let wheels = *all - *rest;
        *all - wheels * (1.0 / able.wheel_momentum.load(wheels).max(1.0))
    })
    .collect()
}

/// When steering along a path gets no further (s), on and on for a task that ends under load.
fn stops(
    demand: &Demand,
    lasting: Option<Vec3<f64>>,
    able: &Capability,
    path: &SteeringPath,
) -> Option<f64> {
    let count = path.angles.len();
    if let Some(share) = path.stopped {
        let to = demand.time[count];
        let from = count.checked_sub(1).map_or(to, |k| demand.time[k]);
        return Some(from + share * (to - from));
    }
    let rate = lasting?;
    let angles = path.angles.last()?;
    let left = steering_reach(&able.cmgs, angles, rate * (1.0 / rate.norm())).momentum;
    Some(demand.time.last()? + left / rate.norm())
}

/// By how much slower the best steering can do the task.
fn slower_at_best(torque_load: f64, demand: &Demand, able: &Capability) -> Option<f64> {
    let momentum_load = if able.is_unbounded() || able.is_hybrid() {
        0.0
    } else {
        demand.momentum_B.iter().map(|h| able.momentum.load(*h)).fold(0.0, f64::max)
    };
    let factor = torque_load.sqrt().max(momentum_load).max(1.0);
    if !able.is_hybrid() {
        return (factor <= SLOWEST).then_some(factor);
    }
    // The slower, the more of it the couples take.
    let fails = |factor: f64| {
        let slow = demand.slower(factor);
        leaves_at_best(&Shared::of(&slow, true, able).stored, None, able).is_some()
    };
    pace(factor, fails)
}

/// The least factor from `least` on that does not fail, by halving.
fn pace(least: f64, fails: impl Fn(f64) -> bool) -> Option<f64> {
    if !fails(least) {
        return (least <= SLOWEST).then_some(least);
    }
    let mut far = 2.0 * least;
    while fails(far) {
        far *= 2.0;
        // NaN never passes.
        if far.is_nan() || far > SLOWEST {
            return None;
        }
    }
    Some(boundary(0.5 * far, far, |factor| !fails(factor)))
}

/// By how much slower plain steering can do the task, by halving: no faster than the best.
fn slower_plain(demand: &Demand, able: &Capability, best: Option<f64>) -> Option<f64> {
    let best = best?;
    if able.cmgs.is_empty() {
        return Some(best);
    }
    pace(best, |factor| {
        let slow = demand.slower(factor);
        let stored = Shared::of(&slow, true, able).stored;
        let plain = Plain::follow(&slow, &stored, None, able);
        plain.stops.is_some() || plain.torque_load.is_some_and(|load| load > 1.0)
    })
}

/// Propellant for the torque of a task (kg), and for the force that keeps the base in place if asked.
fn fuel(demand: &Demand, able: &Capability, in_place: bool) -> Option<f64> {
    if able.thrusters.is_empty() {
        return None;
    }
    let flow = |(torque, force): (&Vec3<f64>, &Vec3<f64>)| {
        let force = if in_place { *force } else { Vec3::zero() };
        let couple = least_flow(&able.thrusters, able.p_BScm_B, *torque, Some(force));
        // A set that makes no couples turns the base with what force comes of it.
        let alone = || least_flow(&able.thrusters, able.p_BScm_B, *torque, None);
        if in_place { couple } else { couple.or_else(alone) }
    };
    let flows: Option<Vec<f64>> = demand.torque_B.iter().zip(&demand.force_B).map(flow).collect();
    let flows = flows?;
    let spans = demand.time.windows(2).zip(flows.windows(2));
    Some(spans.map(|(t, f)| 0.5 * (f[0] + f[1]) * (t[1] - t[0])).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::envelope::pyramid::pyramid;
    use wrasse_hardware::{ControlMomentGyro, List, ReactionWheel};
    use wrasse_spatial::vec3;
    use wrasse_vehicle::Equipment;

    /// A motion along x that needs `momentum` half way and comes to rest after 10 s: torque a full
    /// cosine wave, momentum a raised cosine.
    fn motion(momentum: f64) -> Demand {
        use wrasse_spatial::Real;
        let turn = core::f64::consts::TAU;
        let time: Vec<f64> = (0..=1000).map(|k| 0.01 * f64::from(k)).collect();
        let along = |f: &dyn Fn(f64, f64) -> f64| {
            time.iter()
                .map(|t| Real::sin_cos(turn * 0.1 * t))
                .map(|(s, c)| vec3(f(s, c), 0.0, 0.0))
                .collect()
        };
        Demand {
            torque_B: along(&|s, _| -0.5 * momentum * 0.1 * turn * s),
            momentum_B: along(&|_, c| 0.5 * momentum * (1.0 - c)),
            force_B: vec![Vec3::zero(); 1001],
            time,
        }
    }

    /// A torque along x held for 5 s, and on.
    fn push(torque: f64) -> Demand {
        let time: Vec<f64> = (0..=50).map(|k| 0.1 * f64::from(k)).collect();
        Demand {
            torque_B: vec![vec3(torque, 0.0, 0.0); 51],
            momentum_B: time.iter().map(|t| vec3(-torque * t, 0.0, 0.0)).collect(),
            force_B: vec![Vec3::zero(); 51],
            time,
        }
    }

    fn wheels() -> Capability {
        let wheel = |axis_B| ReactionWheel {
            axis_B,
            inertia: 0.1,
            torque_limit: 0.2,
            speed_limit: 500.0,
            ..Default::default()
        };
        let axes = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)];
        let mut equipment = Equipment::default();
        equipment.actuators.wheels = List::new(&axes.map(wheel));
        Capability::of(&equipment, Vec3::zero())
    }

    fn cmgs(momentum: f64) -> Capability {
        let mut equipment = Equipment::default();
        let cmgs = pyramid(0.6, momentum).map(|cmg| ControlMomentGyro { rate_limit: 1.0, ..cmg });
        equipment.actuators.cmgs = List::new(&cmgs);
        Capability::of(&equipment, Vec3::zero())
    }

    /// 40 N·m·s against 50 fit, 4π N·m against 0.2 do not: √(62.8) times slower they do.
    #[test]
    fn wheels_hold_what_they_cannot_give_fast_enough() {
        let verdict = judge(&motion(40.0), &wheels(), true);
        assert_eq!((verdict.torque, verdict.momentum), (Answer::No, Answer::Yes));
        let expected = (2.0 * core::f64::consts::TAU / 0.2).sqrt();
        let found = verdict.slower.best.unwrap();
        // The peak is a sample. Measured 0.
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        assert_eq!(verdict.slower.plain, verdict.slower.best);
        assert_eq!(judge(&motion(40.0), &wheels(), false).slower.best, None);
    }

    /// 60 N·m·s is the middle of the way to 120, where the raised cosine has gained a quarter period.
    #[test]
    fn a_motion_leaves_the_envelope_where_its_momentum_says() {
        let verdict = judge(&motion(100.0), &wheels(), true);
        assert_eq!(verdict.momentum, Answer::No);
        // Linear between samples 0.05 s apart. Measured 0.
        assert!((verdict.saturates.best.unwrap() - 2.5).abs() < 1e-3, "{verdict:?}");
    }

    /// The pyramid of 50 N·m·s stops at 60 with plain steering and holds 160 at most.
    #[test]
    fn cmgs_answer_with_steering_between_the_inner_and_the_outer_surface() {
        let answers = [50.0, 100.0, 200.0].map(|h| judge(&motion(h), &cmgs(50.0), true).momentum);
        assert_eq!(answers, [Answer::Yes, Answer::WithSteering, Answer::No]);
        let verdict = judge(&motion(100.0), &cmgs(50.0), true);
        assert_eq!(verdict.slower.best, Some(1.0));
        // 100 / 60 suffices for the momentum; the torque near the surface asks for a little more.
        let plain = verdict.slower.plain.unwrap();
        assert!(plain > 100.0 / 60.0 && plain < 1.1 * 100.0 / 60.0, "{plain}");
        let stops = verdict.saturates.plain.unwrap();
        // 50 (1 - cos) = 60 after a quarter and 0.0320 of the turn: 2.8205 s. Measured 2.8204.
        assert!((stops - 2.8205).abs() < 5e-3, "{stops}");
    }

    fn jets(force: f64, propellant: f64) -> Equipment {
        use wrasse_hardware::{Tank, Thruster};
        let mut equipment = Equipment::default();
        // Couples about x: from one metre above and below the centre, along y.
        let jet = |z: f64, y: f64| Thruster {
            position_B: vec3(0.0, 0.0, z),
            direction_B: vec3(0.0, y, 0.0),
            force,
            specific_impulse: 200.0,
            ..Default::default()
        };
        let all = [jet(1.0, 1.0), jet(1.0, -1.0), jet(-1.0, 1.0), jet(-1.0, -1.0)];
        equipment.actuators.thrusters = List::new(&all);
        equipment.actuators.tank = Some(Tank { propellant, ..Default::default() });
        equipment
    }

    /// Couples of 2 N·m beside wheels of 50 N·m·s: of 4 N·m half is stored, and lasts 25 s.
    #[test]
    fn wheels_beside_thrusters_fill_with_what_couples_do_not_take() {
        let mut equipment = jets(1.0, 40.0);
        let wheel = ReactionWheel {
            axis_B: vec3(1.0, 0.0, 0.0),
            inertia: 0.1,
            torque_limit: 5.0,
            speed_limit: 500.0,
            ..Default::default()
        };
        equipment.actuators.wheels = List::new(&[wheel]);
        let able = Capability::of(&equipment, Vec3::zero());
        let full = judge(&push(4.0), &able, false).saturates.best.unwrap();
        // Measured 3e-11.
        assert!((full - 25.0).abs() < 1e-6, "{full}");
        // What couples take whole is never full.
        assert_eq!(judge(&push(1.9), &able, false).saturates.best, None);
    }

    /// 1 N·m for 5 s takes 2 x 0.5 N for 5 s: 5 / (200 · 9.80665) = 2.55 g.
    #[test]
    fn a_tank_that_holds_too_little_is_a_no() {
        let answer = |kg| {
            let able = Capability::of(&jets(1.0, kg), Vec3::zero());
            let judged = judge(&push(1.0), &able, false);
            // Measured 5e-19 kg.
            assert!((judged.fuel.unwrap() - 5.0 / (200.0 * 9.80665)).abs() < 1e-8, "{judged:?}");
            judged.propellant
        };
        assert_eq!([answer(0.003), answer(0.002)], [Answer::Yes, Answer::No]);
    }

    /// 4 N·m along x: 60 N·m·s last 15 s, 160 last 40 s; three wheels of 50 last 12.5 s.
    #[test]
    fn a_torque_that_lasts_is_followed_beyond_the_task() {
        let verdict = judge(&push(4.0), &cmgs(50.0), false);
        assert_eq!((verdict.torque, verdict.momentum), (Answer::Yes, Answer::Yes));
        let (plain, best) = (verdict.saturates.plain.unwrap(), verdict.saturates.best.unwrap());
        // Measured 4.4e-4 and 6e-11.
        assert!((plain - 15.0).abs() < 5e-3 && (best - 40.0).abs() < 1e-6, "{plain} {best}");
        let wheels = judge(&push(4.0), &wheels(), false).saturates.best.unwrap();
        assert!((wheels - 12.5).abs() < 1e-9, "{wheels}");
        assert_eq!(judge(&push(4.0), &Capability::ideal(), false).saturates.best, None);
    }
}
