//! What follows from the verdicts: where CMGs are needed, as the claim of a study has it, where they
//! are not, and what decides. Every sentence counts verdicts; none is written beforehand.

use crate::judgement::Answer;
use crate::lightest::lightest;
use crate::outcome::{Finding, Flown, SetCard, SetKind, SetVerdict, TaskOutcome};
use wrasse_mission::ClaimIs;

/// The findings, in a fixed order; what does not occur is left out, and so is everything where nothing
/// was flown.
pub(crate) fn findings(
    claim: Option<ClaimIs>,
    sets: &[SetCard],
    tasks: &[TaskOutcome],
) -> Vec<Finding> {
    let all = Verdicts { claim, sets, tasks };
    let parts = [
        lightest(sets, &all.that(|_| true)),
        all.only_cmgs(),
        all.wheels_suffice(),
        all.neither(),
        all.torque_decides(),
        all.steering_decides(),
        all.duration_decides(),
        all.thrusters(),
        all.push_moves(),
        all.tool_error_decides(),
        all.nothing_asked(),
    ];
    parts.into_iter().flatten().filter(|finding| !finding.tasks.is_empty()).collect()
}

/// A task that asks for less torque (N·m) and momentum (N·m·s) than this asks for nothing: it is far
/// below the friction of any bearing, and above what round-off leaves.
const NOTHING: f64 = 1e-6;

/// The table of verdicts.
struct Verdicts<'a> {
    /// What the claim of the study says, if it is one that verdicts can be held against.
    claim: Option<ClaimIs>,
    sets: &'a [SetCard],
    tasks: &'a [TaskOutcome],
}

fn is_no_worse(verdict: &SetVerdict, answer: Answer) -> bool {
    verdict.suffices <= answer
}

impl<'a> Verdicts<'a> {
    /// Verdicts of sets of a kind on a task.
    fn of(&self, task: &'a TaskOutcome, kind: SetKind) -> impl Iterator<Item = &'a SetVerdict> {
        let kinds = self.sets.iter().map(move |set| set.kind == kind);
        task.verdicts.iter().zip(kinds.collect::<Vec<_>>()).filter(|(_, is)| *is).map(|(v, _)| v)
    }
    fn some(&self, task: &'a TaskOutcome, kind: SetKind, answer: Answer) -> bool {
        self.of(task, kind).any(|verdict| is_no_worse(verdict, answer))
    }
    /// Tasks that were flown, ask for something, and fulfil a condition.
    fn that(&self, holds: impl Fn(&'a TaskOutcome) -> bool) -> Vec<&'a TaskOutcome> {
        let counts = |t: &&TaskOutcome| t.unflown.is_none() && !asks_nothing(t);
        self.tasks.iter().filter(counts).filter(|t| holds(t)).collect()
    }
    fn asked(&self) -> usize {
        self.that(|_| true).len()
    }
    fn has(&self, kind: SetKind) -> bool {
        self.sets.iter().any(|set| set.kind == kind)
    }
    /// What to say of the claim that CMGs are needed, if the study makes it.
    fn of_the_claim(&self, text: &'static str) -> &'static str {
        if self.claim == Some(ClaimIs::CmgsNeeded) { text } else { "" }
    }
    /// That thrusters suffice in some of the tasks, and what the cheapest that do take at most (kg).
    fn thrusters_too(&self, tasks: &[&'a TaskOutcome]) -> String {
        let least = |t: &&'a TaskOutcome| {
            let enough = self.of(t, SetKind::Thrusters).filter(|v| v.suffices == Answer::Yes);
            enough.filter_map(|v| v.fuel_kg).reduce(f64::min)
        };
        let fuel: Vec<f64> = tasks.iter().filter_map(least).collect();
        if fuel.is_empty() {
            return String::new();
        }
        let most = rounded(1e3 * fuel.iter().copied().fold(0.0, f64::max));
        format!(
            " Thrusters suffice too in {} of them, for up to {most} g of propellant each.",
            fuel.len()
        )
    }
    /// The claim holds against wheels: a set of CMGs does, no set of wheels.
    fn only_cmgs(&self) -> Option<Finding> {
        let cmgs = |t, answer| self.some(t, SetKind::Cmgs, answer);
        let tasks = self.that(|t| {
            !self.some(t, SetKind::Wheels, Answer::WithSteering) && cmgs(t, Answer::WithSteering)
        });
        let steered = tasks.iter().filter(|t| !cmgs(t, Answer::Yes)).count();
        let mut text = format!(
            "In {} of {} tasks a set of CMGs suffices and no set of wheels does.",
            tasks.len(),
            self.asked()
        );
        if steered > 0 {
            text +=
                &format!(" In {steered} of them only if steering passes inner singular surfaces.");
        }
        text += self.of_the_claim(" There the claim holds against wheels.");
        text += &self.thrusters_too(&tasks);
        let both = self.has(SetKind::Wheels) && self.has(SetKind::Cmgs);
        both.then(|| finding("CMGs are needed", text, &tasks))
    }
    /// The claim is not needed: wheels do.
    fn wheels_suffice(&self) -> Option<Finding> {
        let tasks = self.that(|t| self.some(t, SetKind::Wheels, Answer::Yes));
        let text = format!(
            "In {} of {} tasks a set of wheels suffices.{}",
            tasks.len(),
            self.asked(),
            self.of_the_claim(" There the claim does not hold.")
        );
        self.has(SetKind::Wheels).then(|| finding("wheels suffice", text, &tasks))
    }
    /// The claim is not enough: no CMGs do either.
    fn neither(&self) -> Option<Finding> {
        let stored = [SetKind::Wheels, SetKind::Cmgs];
        let tasks =
            self.that(|t| stored.iter().all(|kind| !self.some(t, *kind, Answer::WithSteering)));
        let worst = tasks.iter().map(|t| t.peak_torque_nm).fold(0.0, f64::max);
        let mut text = format!(
            "In {} of {} tasks no set of wheels and no set of CMGs suffices (up to {} N·m).",
            tasks.len(),
            self.asked(),
            rounded(worst)
        );
        if tasks.iter().any(|t| t.own_motion) {
            text += " The vehicle's own motions can be done more slowly.";
        }
        if tasks.iter().any(|t| !t.own_motion) {
            text += " Against what acts from outside the load path can be closed by a grapple, or the \
                     line of action moved towards the centre of mass.";
        }
        text += self.of_the_claim(" There the claim says too little.");
        text += &self.thrusters_too(&tasks);
        self.has(SetKind::Cmgs).then(|| finding("not even CMGs", text, &tasks))
    }
    /// No wheels suffice, and some hold the momentum but cannot give the torque: a slower motion is a
    /// remedy.
    fn torque_decides(&self) -> Option<Finding> {
        let held = |v: &SetVerdict| v.momentum == Answer::Yes && v.torque == Answer::No;
        let tasks = self.that(|t| {
            !self.some(t, SetKind::Wheels, Answer::Yes) && self.of(t, SetKind::Wheels).any(held)
        });
        let factors = tasks.iter().flat_map(|t| self.of(t, SetKind::Wheels).filter(|v| held(v)));
        let factors: Vec<f64> = factors.filter_map(|v| v.slower.plain).collect();
        let low = factors.iter().copied().fold(f64::INFINITY, f64::min);
        let high = factors.iter().copied().fold(0.0, f64::max);
        let remedy = if factors.is_empty() {
            String::new()
        } else {
            format!(
                " Done {low:.1} to {high:.0} times more slowly, the vehicle's own motions are within them."
            )
        };
        let text = format!(
            "In {} of {} tasks no set of wheels suffices, and one can hold the momentum and lacks only \
             the torque.{remedy}",
            tasks.len(),
            self.asked()
        );
        self.has(SetKind::Wheels).then(|| finding("torque decides", text, &tasks))
    }
    /// CMGs that the envelopes do not rule out, if they are steered past the inner singular surfaces.
    fn steering_decides(&self) -> Option<Finding> {
        let needs = |v: &SetVerdict| v.suffices == Answer::WithSteering;
        let tasks = self.that(|t| self.of(t, SetKind::Cmgs).any(needs));
        let pairs: usize =
            tasks.iter().map(|t| self.of(t, SetKind::Cmgs).filter(|v| needs(v)).count()).sum();
        let text = format!(
            "{pairs} times a set of CMGs is not ruled out, but needs steering that starts from good \
             gimbal angles, or avoids or escapes singularities: the demand is within the outer surface, \
             and beyond what the pseudo-inverse reaches. Whether a law gets there, a flight shows."
        );
        (!tasks.is_empty()).then(|| finding("steering decides", text, &tasks))
    }
    /// Tasks that end under load: how long each set lasts.
    fn duration_decides(&self) -> Option<Finding> {
        let tasks = self.that(|t| t.gathered_nm.is_some());
        let lasting = |kind| {
            let times =
                tasks.iter().flat_map(|t| self.of(t, kind)).filter(|v| v.torque != Answer::No);
            let times: Vec<f64> = times.filter_map(|v| v.saturates_s.best).collect();
            let low = times.iter().copied().fold(f64::INFINITY, f64::min);
            let high = times.iter().copied().fold(0.0, f64::max);
            (!times.is_empty()).then_some((low, high))
        };
        let mut text = format!(
            "{} of {} tasks end under load and gather momentum on and on.",
            tasks.len(),
            self.asked()
        );
        for (kind, name) in [(SetKind::Wheels, "wheels"), (SetKind::Cmgs, "CMGs")] {
            match lasting(kind) {
                Some((low, high)) => {
                    text += &format!(
                        " Sets of {name} that can give the torque are full after {} to {} s.",
                        rounded(low),
                        rounded(high)
                    );
                }
                None if self.has(kind) => {
                    text += &format!(" No set of {name} can give the torque.");
                }
                None => {}
            }
        }
        (!tasks.is_empty()).then(|| finding("duration decides", text, &tasks))
    }
    /// Thrusters: what they can do, and what it costs.
    fn thrusters(&self) -> Option<Finding> {
        let tasks = self.that(|t| self.some(t, SetKind::Thrusters, Answer::Yes));
        let enough = tasks.iter().flat_map(|t| self.of(t, SetKind::Thrusters));
        let fuel = enough.filter(|v| v.suffices == Answer::Yes).filter_map(|v| v.fuel_kg);
        let most = rounded(1e3 * fuel.fold(0.0, f64::max));
        let text = format!(
            "In {} of {} tasks a set of thrusters can give the torque, for up to {most} g of propellant a \
             time; momentum leaves with the exhaust, so nothing saturates.",
            tasks.len(),
            self.asked()
        );
        self.has(SetKind::Thrusters).then(|| finding("thrusters", text, &tasks))
    }
    /// A force pushes the vehicle away, whatever holds its attitude.
    fn push_moves(&self) -> Option<Finding> {
        let tasks =
            self.that(|t| !t.own_motion && t.gathered_nm.is_some() && t.tool_error_mm > 1.0);
        let worst = tasks
            .iter()
            .copied()
            .reduce(|a, b| if b.tool_error_mm > a.tool_error_mm { b } else { a })?;
        let text = format!(
            "In {} of {} tasks a force pushes the vehicle away with its attitude held: by {} mm in {} s \
             at most. Wheels and CMGs cannot react a force, thrusters and a grapple can.",
            tasks.len(),
            self.asked(),
            rounded(worst.tool_error_mm),
            worst.duration_s
        );
        Some(finding("no torque reacts a force", text, &tasks))
    }
    /// Closed loop: what the tool says of the sets whose envelope suffices, and of the others.
    fn tool_error_decides(&self) -> Option<Finding> {
        let flown = self.that(|t| t.verdicts.iter().any(|v| v.flown.is_some()));
        let told =
            [SetKind::Wheels, SetKind::Cmgs, SetKind::Thrusters, SetKind::Hybrid].map(|kind| {
                let all: Vec<_> = flown
                    .iter()
                    .flat_map(|t| self.of(t, kind))
                    .filter_map(|v| Some((v.suffices != Answer::No, v.flown.as_ref()?)))
                    .collect();
                let parts = [(true, "suffice"), (false, "do not")].map(|(enough, word)| {
                    errors(
                        all.iter().filter(|(is, _)| *is == enough).map(|(_, flown)| *flown),
                        word,
                    )
                });
                let parts: Vec<String> = parts.into_iter().flatten().collect();
                (!parts.is_empty()).then(|| format!(" {}: {}.", name(kind), parts.join("; ")))
            });
        let told: String = told.into_iter().flatten().collect();
        let text = format!(
            "Largest error of the tool in closed loop, with sets that by their envelopes\u{2026}{told}"
        );
        (!told.is_empty()).then(|| finding("tool error decides", text, &flown))
    }
    /// Tasks that ask the base for nothing: every set suffices, which says nothing of the sets.
    fn nothing_asked(&self) -> Option<Finding> {
        let flown = self.tasks.iter().filter(|t| t.unflown.is_none());
        let tasks: Vec<_> = flown.filter(|t| asks_nothing(t)).collect();
        let text = format!(
            "{} of {} tasks ask the base for no torque and no momentum. They say nothing of the sets and \
             are not counted above.",
            tasks.len(),
            self.tasks.len()
        );
        (!tasks.is_empty()).then(|| finding("nothing asked", text, &tasks))
    }
}

fn asks_nothing(task: &TaskOutcome) -> bool {
    task.peak_torque_nm < NOTHING && task.peak_momentum_nms < NOTHING
}

fn name(kind: SetKind) -> &'static str {
    match kind {
        SetKind::Ideal => "The reference",
        SetKind::Actuator => "The vehicle's ideal actuator",
        SetKind::Wheels => "Wheels",
        SetKind::Cmgs => "CMGs",
        SetKind::Thrusters => "Thrusters",
        SetKind::Hybrid => "CMGs or wheels with thrusters",
        SetKind::Nothing => "Nothing",
    }
}

/// Smallest and largest tool error of flights, and in how many the requirements hold.
fn errors<'a>(flights: impl Iterator<Item = &'a Flown>, word: &str) -> Option<String> {
    let flights: Vec<&Flown> = flights.collect();
    let errors = || flights.iter().map(|flown| flown.tool_error_mm);
    let (low, high) = (errors().fold(f64::INFINITY, f64::min), errors().fold(0.0, f64::max));
    let hold = flights.iter().filter(|flown| flown.requirements_hold).count();
    (!flights.is_empty()).then(|| {
        format!(
            "{word}, {} mm (requirements hold in {hold} of {} flights)",
            span(low, high, FINEST_MM),
            flights.len()
        )
    })
}

/// Two significant digits: what demands and vehicles are known to.
pub(crate) fn rounded(value: f64) -> String {
    let short = format!("{value:.1e}");
    short.parse::<f64>().map_or(short, |value| value.to_string())
}

/// Two figures with two digits each, or one where they are the same, and `least` for what is less.
fn span(low: f64, high: f64, least: f64) -> String {
    let told = |x: f64| if x < least { format!("less than {least}") } else { rounded(x) };
    let (low, high) = (told(low), told(high));
    if low == high { low } else { format!("{low} to {high}") }
}

/// An error of the tool (mm) below which it says nothing: no arm is built or measured to it.
const FINEST_MM: f64 = 0.001;

pub(crate) fn finding(about: &str, text: String, tasks: &[&TaskOutcome]) -> Finding {
    Finding { about: about.into(), text, tasks: tasks.iter().map(|t| t.name.clone()).collect() }
}

#[cfg(test)]
pub(crate) mod tests;
