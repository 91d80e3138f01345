//! Arms and links that are made alike and differ.
//!
//! Alike are chains that leave one body with the same kinds of joints, the same distances between them
//! and the same angles between their axes: a mirror and a turn keep these. Alike are also links and
//! joints whose names differ by left and right. What mirrors and turns keep is compared: masses,
//! principal moments, distances of centres of mass, travels (or their mirror image), rates, efforts.

use super::finding::{Finding, FindingKind, FindingSeverity, Fine, Place};
use super::sides::right_of;
use crate::check::{angle_between, principal_moments};
use crate::figures::figures;
use crate::vehicle::{LinkMatter, Vehicle};
use std::collections::BTreeSet;
use wrasse_dynamics::BodyId;
use wrasse_hardware::JointLimits;
use wrasse_spatial::{SpatialInertia, Vec3};

/// Difference of two numbers that is told, as a part of the larger (–): copies of a number are the same,
/// and where two sides are drawn on their own they differ by 1 to 2 %.
const DIFFERS: f64 = 0.02;
/// Distances (m) and angles (rad) of joints that are alike.
const ALIKE: f64 = 1e-3;
/// Differences of one pair that are told in words; the others are counted.
const TOLD: usize = 4;

/// Two numbers that should be the same: what, of the first, of the second.
type Difference = (String, f64, f64);

/// Findings about pairs that differ, and how many were compared.
pub(super) fn symmetry_findings(vehicle: &Vehicle) -> (Vec<Finding>, Fine) {
    let mut compared = BTreeSet::new();
    let mut pairs = 0;
    let mut found: Vec<Finding> = vec![];
    let matter = || vehicle.matter.iter();
    for left in matter() {
        let Some(name) = right_of(&left.link) else { continue };
        let Some(right) = matter().find(|other| other.link == name) else { continue };
        pairs += 1;
        let place = place_of(vehicle, &left.link);
        let differences = matter_differences(&links_body(left), &links_body(right));
        found.extend(finding((&left.link, &right.link), place, &differences));
    }
    for (j, name) in vehicle.joint_names.iter().enumerate() {
        let Some(other) = right_of(name).and_then(|right| vehicle.joint(&right)) else { continue };
        pairs += 1;
        compared.insert((j.min(other), j.max(other)));
        let differences = limit_differences(&vehicle.limits[j], &vehicle.limits[other]);
        let place = vehicle.places.joints.get(j).cloned();
        found.extend(finding((name, &vehicle.joint_names[other]), place, &differences));
    }
    for (first, second) in chains_alike(vehicle) {
        if first.iter().zip(&second).any(|(&a, &b)| compared.contains(&(a.min(b), a.max(b)))) {
            continue;
        }
        pairs += 1;
        compared.extend(first.iter().zip(&second).map(|(&a, &b)| (a.min(b), a.max(b))));
        found.extend(chain_finding(vehicle, &first, &second));
    }
    let message = match pairs {
        0 => "no two arms or links are alike: not compared".to_owned(),
        pairs => format!("what is made alike does not differ (pairs: {pairs})"),
    };
    let numbers = vec![("pairs", f64::from(pairs))];
    (found, Fine { kind: FindingKind::Asymmetry, message, numbers })
}

fn place_of(vehicle: &Vehicle, link: &str) -> Option<Place> {
    let index = vehicle.frames.iter().position(|frame| frame.name == link)?;
    vehicle.places.matter.get(index).cloned().flatten()
}

fn links_body(matter: &LinkMatter) -> SpatialInertia<f64> {
    SpatialInertia::from_central(matter.mass, matter.p_cm, matter.inertia)
}

fn finding(
    (first, second): (&str, &str),
    place: Option<Place>,
    differences: &[Difference],
) -> Option<Finding> {
    if differences.is_empty() {
        return None;
    }
    let told = differences.iter().take(TOLD);
    let told = told.map(|(what, a, b)| format!("{what} {} and {}", figures(*a), figures(*b)));
    let mut told: Vec<_> = told.collect();
    if differences.len() > TOLD {
        told.push(format!("and {} differences more", differences.len() - TOLD));
    }
    Some(Finding {
        kind: FindingKind::Asymmetry,
        severity: FindingSeverity::Warning,
        subject: format!("{first} and {second}"),
        place,
        message: told.join("; "),
        numbers: vec![("differences", differences.len() as f64)],
    })
}

fn chain_finding(vehicle: &Vehicle, first: &[usize], second: &[usize]) -> Option<Finding> {
    let mut differences = vec![];
    for (&a, &b) in first.iter().zip(second) {
        let [body_a, body_b] = [a, b].map(|j| vehicle.robot.inertia(BodyId::Link(j)));
        let names = format!("{} / {}", vehicle.joint_names[a], vehicle.joint_names[b]);
        let of_limits = limit_differences(&vehicle.limits[a], &vehicle.limits[b]);
        let all = matter_differences(body_a, body_b).into_iter().chain(of_limits);
        differences.extend(all.map(|(what, x, y)| (format!("{names}: {what}"), x, y)));
    }
    let (a, b) = (*first.first()?, *second.first()?);
    let names = (&*vehicle.joint_names[a], &*vehicle.joint_names[b]);
    let found = finding(names, vehicle.places.joints.get(a).cloned(), &differences)?;
    // Front and rear legs are alike, and may have other limits by design.
    let severity = FindingSeverity::Note;
    Some(Finding { subject: format!("the chains from {}", found.subject), severity, ..found })
}

/// Whether two numbers differ, against a scale of which the noise is nothing.
fn differ(a: f64, b: f64, scale: f64) -> bool {
    (a - b).abs() > DIFFERS * a.abs().max(b.abs()).max(scale)
}

/// What mirrors and turns keep of a body: mass, principal moments, distance of the centre of mass.
fn matter_differences(a: &SpatialInertia<f64>, b: &SpatialInertia<f64>) -> Vec<Difference> {
    let mut all = vec![];
    if differ(a.mass, b.mass, 0.0) {
        all.push(("mass (kg)".to_owned(), a.mass, b.mass));
    }
    if a.mass <= 0.0 || b.mass <= 0.0 {
        return all;
    }
    let [moments_a, moments_b] = [a, b].map(|body| principal_moments(body.central()));
    // Small moments of a thin body are noise beside the large one.
    let scale = 0.1 * moments_a[2].max(moments_b[2]);
    for (k, what) in ["least", "middle", "largest"].into_iter().enumerate() {
        if differ(moments_a[k], moments_b[k], scale) {
            all.push((format!("{what} moment (kg·m²)"), moments_a[k], moments_b[k]));
        }
    }
    let [away_a, away_b] = [a, b].map(|body| body.centre_of_mass().norm());
    let gyration = (moments_a[2].max(moments_b[2]) / a.mass.max(b.mass)).sqrt();
    if differ(away_a, away_b, 10.0 * ALIKE + gyration) {
        all.push(("distance of the centre of mass (m)".to_owned(), away_a, away_b));
    }
    all
}

/// Travels that are neither the same nor mirrored, rates, efforts; a limit that one lacks is infinite.
fn limit_differences(a: &JointLimits<f64>, b: &JointLimits<f64>) -> Vec<Difference> {
    let whole = (f64::NEG_INFINITY, f64::INFINITY);
    let [(lower_a, upper_a), (lower_b, upper_b)] = [a, b].map(|l| l.travel.unwrap_or(whole));
    let far = |x: f64, y: f64| x != y && differ(x, y, 1.0);
    let is_same = !far(lower_a, lower_b) && !far(upper_a, upper_b);
    let is_mirrored = !far(lower_a, -upper_b) && !far(upper_a, -lower_b);
    let mut all = vec![];
    if !is_same && !is_mirrored {
        all.push(("lower end (rad or m)".to_owned(), lower_a, lower_b));
        all.push(("upper end (rad or m)".to_owned(), upper_a, upper_b));
    }
    for (what, x, y) in [("rate", a.rate, b.rate), ("effort", a.effort, b.effort)] {
        let [x, y] = [x, y].map(|limit| limit.unwrap_or(f64::INFINITY));
        if x != y && differ(x, y, 0.0) {
            all.push((format!("{what} limit"), x, y));
        }
    }
    all
}

/// Pairs of chains that leave one body and are alike, longest first: each with the first that it is like.
fn chains_alike(vehicle: &Vehicle) -> Vec<(Vec<usize>, Vec<usize>)> {
    let robot = &vehicle.robot;
    let mut pairs = vec![];
    for body in robot.bodies() {
        let roots: Vec<_> = robot.joints().filter(|&j| robot.joint(j).parent == body).collect();
        let chains: Vec<_> = roots.iter().map(|&root| chain(vehicle, root)).collect();
        for (k, second) in chains.iter().enumerate() {
            let like = chains[..k].iter().find(|first| are_alike(vehicle, first, second));
            pairs.extend(like.map(|first| (first.clone(), second.clone())));
        }
    }
    pairs.sort_by_key(|(first, _)| std::cmp::Reverse(first.len()));
    pairs
}

/// A joint and all that it carries, in the robot's order.
fn chain(vehicle: &Vehicle, root: usize) -> Vec<usize> {
    let robot = &vehicle.robot;
    let is_carried = |j: &usize| robot.path_to_base(BodyId::Link(*j)).any(|joint| joint == root);
    robot.joints().filter(is_carried).collect()
}

/// Two or more joints of the same kinds, with the same parents, distances, and angles between axes.
fn are_alike(vehicle: &Vehicle, first: &[usize], second: &[usize]) -> bool {
    let robot = &vehicle.robot;
    let pairs = || first.iter().zip(second).skip(1);
    let parent_in = |chain: &[usize], j: usize| match robot.joint(j).parent {
        BodyId::Base => None,
        BodyId::Link(p) => chain.iter().position(|&at| at == p),
    };
    let to_parent = |j: usize| {
        let joint = robot.joint(j);
        let axis = joint.X_PB_zero.rotation * joint.axis_B;
        let before = match joint.parent {
            BodyId::Base => Vec3::from_array([0.0, 0.0, 1.0]),
            BodyId::Link(p) => robot.joint(p).axis_B,
        };
        (joint.X_PB_zero.translation.norm(), angle_between(axis, before))
    };
    let is_alike = |(&a, &b): (&usize, &usize)| {
        let ((distance_a, angle_a), (distance_b, angle_b)) = (to_parent(a), to_parent(b));
        robot.joint(a).kind == robot.joint(b).kind
            && parent_in(first, a) == parent_in(second, b)
            && (distance_a - distance_b).abs() < ALIKE
            && (angle_a - angle_b).abs() < ALIKE
    };
    first.len() == second.len()
        && first.len() > 1
        && robot.joint(first[0]).kind == robot.joint(second[0]).kind
        && pairs().all(is_alike)
}
