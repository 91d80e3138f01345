//! The lightest set that suffices: for all tasks, or for as many as it can.
//!
//! What counts is the mass of the units, and beside it the propellant that the task takes. Sets of the
//! same mass are ordered by their power, then as the table has them.

use super::wording::{finding, rounded};
use crate::judgement::Answer;
use crate::outcome::{Finding, SetCard, SetKind, SetVerdict, TaskOutcome};

/// Sets that are named beside the lightest.
const NEXT: usize = 3;

/// A set that suffices for some of the tasks.
struct Candidate<'a> {
    set: &'a SetCard,
    /// Units, and the propellant of the task that takes most (kg).
    mass: f64,
    fuel: f64,
}

impl Candidate<'_> {
    fn told(&self) -> String {
        let units = kilograms(self.mass - self.fuel);
        if self.fuel > 0.0 {
            let (name, fuel) = (&self.set.name, rounded(1e3 * self.fuel));
            format!("{name}, {units} kg and {fuel} g of propellant")
        } else {
            format!("{}, {units} kg", self.set.name)
        }
    }
}

/// Three significant digits: data sheets know masses to them.
fn kilograms(mass: f64) -> String {
    let short = format!("{mass:.2e}");
    short.parse::<f64>().map_or(short, |mass| mass.to_string())
}

/// Whether a set suffices: by its envelope, and where it was flown by its flight. What its envelope does
/// not rule out may suffice with steering: that, a flight has to show.
fn suffices(verdict: &SetVerdict) -> bool {
    match &verdict.flown {
        Some(flown) => {
            verdict.suffices != Answer::No && flown.requirements_hold && flown.ended.is_none()
        }
        None => verdict.suffices == Answer::Yes,
    }
}

/// Sets that suffice for all of the tasks and say their mass, the lightest first.
fn candidates<'a>(
    sets: &'a [SetCard],
    tasks: &[&TaskOutcome],
    suffices: impl Fn(&SetVerdict) -> bool,
) -> Vec<Candidate<'a>> {
    let each = sets.iter().enumerate().filter(|(_, set)| set.kind != SetKind::Ideal);
    let mut all: Vec<_> = each
        .filter(|(k, _)| tasks.iter().all(|t| t.verdicts.get(*k).is_some_and(&suffices)))
        .filter_map(|(k, set)| {
            let fuel = tasks.iter().filter_map(|t| t.verdicts[k].fuel_kg).fold(0.0, f64::max);
            Some(Candidate { set, mass: set.mass_kg? + fuel, fuel })
        })
        .collect();
    let power = |c: &Candidate<'_>| c.set.power_w.unwrap_or(f64::INFINITY);
    all.sort_by(|a, b| a.mass.total_cmp(&b.mass).then(power(a).total_cmp(&power(b))));
    all
}

/// The lightest set that suffices for all of the tasks that ask for something; where there is none, that
/// of each task.
pub(super) fn lightest(sets: &[SetCard], tasks: &[&TaskOutcome]) -> Option<Finding> {
    if tasks.is_empty() || sets.iter().all(|set| set.kind == SetKind::Ideal) {
        return None;
    }
    let all = candidates(sets, tasks, suffices);
    let whole =
        if tasks.len() == 1 { "the task".to_owned() } else { format!("all {} tasks", tasks.len()) };
    let mut text = match all.first() {
        Some(first) => format!("For {whole} the lightest set that suffices: {}.", first.told()),
        None => format!("No set that says its mass suffices for {whole}.{}", by_task(sets, tasks)),
    };
    let next: Vec<_> = all.iter().skip(1).take(NEXT).map(Candidate::told).collect();
    if !next.is_empty() {
        text += &format!(" Then {}.", next.join("; "));
    }
    text += &lighter_by_envelope(sets, tasks, all.first());
    text += &without_mass(sets, tasks);
    Some(finding("lightest", text, tasks))
}

/// In how many tasks each set is the lightest that suffices.
fn by_task(sets: &[SetCard], tasks: &[&TaskOutcome]) -> String {
    if tasks.len() == 1 {
        return String::new();
    }
    let mut counts: Vec<(String, usize)> = vec![];
    let mut none = 0;
    for task in tasks {
        match candidates(sets, &[*task], suffices).first() {
            None => none += 1,
            Some(first) => {
                let name = &first.set.name;
                let known = counts.iter_mut().find(|(known, _)| known == name);
                match known {
                    Some((_, count)) => *count += 1,
                    None => counts.push((name.clone(), 1)),
                }
            }
        }
    }
    let mut told: Vec<_> = counts.iter().map(|(name, n)| format!("{name} in {n}")).collect();
    if none > 0 {
        told.push(format!("none in {none}"));
    }
    format!(" Task by task the lightest is {}.", told.join("; "))
}

/// Sets that would be lighter, and suffice by their envelopes alone: their flights miss a requirement.
fn lighter_by_envelope(
    sets: &[SetCard],
    tasks: &[&TaskOutcome],
    first: Option<&Candidate<'_>>,
) -> String {
    let envelope = candidates(sets, tasks, |v| v.suffices == Answer::Yes);
    let fails = |c: &&Candidate<'_>| {
        first.is_none_or(|first| c.mass < first.mass && c.set.name != first.set.name)
    };
    let told: Vec<_> = envelope.iter().filter(fails).take(NEXT).map(Candidate::told).collect();
    if told.is_empty() {
        return String::new();
    }
    format!(
        " By its envelope alone this would do, and its flight misses a requirement: {}.",
        told.join("; ")
    )
}

/// Sets that suffice and do not say what they weigh.
fn without_mass(sets: &[SetCard], tasks: &[&TaskOutcome]) -> String {
    let is_one = |(k, set): &(usize, &SetCard)| {
        set.kind != SetKind::Ideal
            && set.mass_kg.is_none()
            && tasks.iter().all(|t| t.verdicts.get(*k).is_some_and(suffices))
    };
    let names: Vec<_> =
        sets.iter().enumerate().filter(is_one).map(|(_, set)| set.name.as_str()).collect();
    if names.is_empty() {
        return String::new();
    }
    format!(" Without a mass, and so not weighed, but enough: {}.", names.join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::findings::tests::{flown, set, task, verdict};
    use Answer::{No, WithSteering, Yes};

    fn weighed(name: &str, kg: f64, watt: f64) -> SetCard {
        SetCard { mass_kg: Some(kg), power_w: Some(watt), ..set(name, SetKind::Wheels) }
    }

    #[test]
    fn the_lightest_set_that_suffices_is_named_with_its_mass_and_equal_ones_by_power() {
        let sets = [
            set("ideal", SetKind::Ideal),
            weighed("heavy", 48.3, 10.0),
            weighed("thirsty", 24.0, 20.0),
            weighed("frugal", 24.0, 10.0),
            weighed("weak", 12.0, 1.0),
            set("unknown", SetKind::Cmgs),
        ];
        let verdicts = vec![
            verdict("ideal", Yes, Yes),
            verdict("heavy", Yes, Yes),
            verdict("thirsty", Yes, Yes),
            verdict("frugal", Yes, Yes),
            verdict("weak", No, Yes),
            verdict("unknown", Yes, Yes),
        ];
        let task = task("reach", verdicts);
        let told = lightest(&sets, &[&task]).unwrap().text;
        let named = "For the task the lightest set that suffices: frugal, 24 kg. Then thirsty, 24 kg; \
                     heavy, 48.3 kg. Without a mass, and so not weighed, but enough: unknown.";
        assert_eq!(told, named);
    }

    /// An envelope promises, a flight shows: both ways.
    #[test]
    fn a_flight_that_misses_a_requirement_does_not_suffice_and_one_that_holds_them_does() {
        let sets = [weighed("light", 10.0, 1.0), weighed("steered", 20.0, 1.0)];
        let mut light = verdict("light", Yes, Yes);
        light.flown = Some(crate::outcome::Flown { requirements_hold: false, ..flown() });
        let mut steered = verdict("steered", Yes, WithSteering);
        steered.flown = Some(flown());
        let told = lightest(&sets, &[&task("reach", vec![light, steered])]).unwrap().text;
        assert!(
            told.starts_with("For the task the lightest set that suffices: steered, 20 kg."),
            "{told}"
        );
        assert!(told.ends_with("its flight misses a requirement: light, 10 kg."), "{told}");
    }

    #[test]
    fn the_propellant_of_the_task_is_weighed_with_the_thrusters() {
        let sets = [weighed("jets", 16.8, 1.0), weighed("wheels", 17.0, 1.0)];
        let jets = SetVerdict { fuel_kg: Some(0.5), ..verdict("jets", Yes, Yes) };
        let told = lightest(&sets, &[&task("reach", vec![jets, verdict("wheels", Yes, Yes)])]);
        let named = "For the task the lightest set that suffices: wheels, 17 kg. Then jets, 16.8 kg and \
                     500 g of propellant.";
        assert_eq!(told.unwrap().text, named);
    }

    #[test]
    fn where_no_set_does_all_tasks_each_task_has_its_own() {
        let sets = [weighed("a", 10.0, 1.0), weighed("b", 20.0, 1.0)];
        let with = |a, b| vec![verdict("a", a, Yes), verdict("b", b, Yes)];
        let tasks = [task("1", with(Yes, No)), task("2", with(No, Yes)), task("3", with(No, No))];
        let told = lightest(&sets, &tasks.iter().collect::<Vec<_>>()).unwrap().text;
        let named = "No set that says its mass suffices for all 3 tasks. Task by task the lightest is a in \
                     1; b in 1; none in 1.";
        assert_eq!(told, named);
        assert_eq!(lightest(&sets, &[]), None);
    }
}
