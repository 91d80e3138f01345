//! Units that slipped: a ratio between two statements of a file that is that of two units.

use super::density::{FOAM, density};
use super::finding::{Finding, FindingKind, FindingSeverity, Fine, Place};
use super::parts::Part;
use crate::check::{OSMIUM, TWO_TURNS};
use crate::figures::figures;
use crate::vehicle::Vehicle;
use core::f64::consts::TAU;
use wrasse_dynamics::JointKind;

/// Radius of gyration of usual parts as a part of how far they reach (–): 0.58 of a rod, 0.4 to 0.8 of
/// boxes, 0.2 of a lump with a long outline.
const USUAL_GYRATION: f64 = 0.5;
/// A ratio is that of two units if it is within this factor of it (–). The ratios between which it
/// tells, the root of a thousand and a thousand, are a factor of 32 apart.
const NEAR: f64 = 3.0;
/// A length in metres that is taken for millimetres: larger than any part, and this many times
/// what else is said of the part or the vehicle (–).
const MILLIMETRES: f64 = 300.0;
/// Shortest length that may be in millimetres (m).
const LONG: f64 = 10.0;
/// Rate of a turning joint above which degrees are likelier (rad/s), one radian per second in degrees:
/// arms that flew turn at less than 0.2 rad/s, walking machines at up to 37.
const FAST: f64 = 57.3;
/// Rates from here on (rad/s) stand for none.
const NO_RATE: f64 = 1000.0;
/// A whole travel below which degrees were turned into radians twice (rad): 6 degrees.
const NARROW: f64 = 0.105;

/// Ratios of a radius of gyration that a wrong unit of inertia or mass makes, and what it was meant in.
/// The radius goes with the root of inertia over mass.
const SLIPS: [(f64, &str); 6] = [
    (1e3, "is its inertia in kg·mm², or is what is drawn in km?"),
    (31.62, "is its inertia in kg·m² times a thousand (g·m²), or its mass in tonnes?"),
    (3.162e4, "is its inertia in g·mm²?"),
    (1e-3, "is what is drawn, or where its joints are, in mm?"),
    (1.0 / 31.62, "is its mass in g, or its inertia a thousandth?"),
    (1.0 / 3.162e4, "is its mass in g, and are its lengths in mm?"),
];

/// Findings about units, and how much was compared.
pub(super) fn unit_findings(vehicle: &Vehicle, parts: &[Part<'_>]) -> (Vec<Finding>, Fine) {
    let mut found: Vec<Finding> =
        parts.iter().filter_map(|part| inertia(part).or(mass(part)).or(offset(part))).collect();
    let usual = usual_offset(vehicle);
    for j in vehicle.robot.joints() {
        found.extend(joint_offset(vehicle, j, usual));
        found.extend(travel_or_rate(vehicle, j));
    }
    let joints = vehicle.robot.joint_count();
    let count = parts.len();
    let message = format!("no ratio of mm, g or deg (links: {count}, joints: {joints})");
    let numbers = vec![("links", count as f64), ("joints", joints as f64)];
    (found, Fine { kind: FindingKind::UnitSlip, message, numbers })
}

/// A radius of gyration that is a ratio of units away from the size of its part.
fn inertia(part: &Part<'_>) -> Option<Finding> {
    let (own, body, of) = part.size()?;
    // More than the whole body has room for, or less than a part of the link's size.
    let size = if part.gyration() > own { body } else { own };
    let ratio = part.gyration() / (USUAL_GYRATION * size);
    // Where joints are says less than what is drawn: a wrist's lie together.
    let is_told = |slip: f64| !part.own.is_empty() || slip.log10().abs() > 2.0;
    let near = |slip: f64| is_told(slip) && (slip / NEAR..slip * NEAR).contains(&ratio);
    let (_, question) = SLIPS.iter().find(|(slip, _)| near(*slip))?;
    let message = format!(
        "its radius of gyration is {} m, {of} {} m from its centre of mass: {} times what is usual; \
         {question}",
        figures(part.gyration()),
        figures(size),
        figures(ratio)
    );
    let numbers = vec![("gyration_m", part.gyration()), ("size_m", size), ("ratio", ratio)];
    Some(part.finding(FindingKind::UnitSlip, FindingSeverity::Warning, message, numbers))
}

/// A mass that is possible in grams and not in kilograms.
fn mass(part: &Part<'_>) -> Option<Finding> {
    // The ellipsoid of a wrong inertia says nothing of the mass.
    let (density, volume) = density(part).filter(|_| !part.own.is_empty())?;
    let in_grams = 1e-3 * density;
    if density <= OSMIUM || !(20.0 * FOAM..OSMIUM).contains(&in_grams) {
        return None;
    }
    let message = format!(
        "{} kg in the volume of {volume}: {} kg/m³; is it in g? Then it has {} kg/m³",
        figures(part.matter.mass),
        figures(density),
        figures(in_grams)
    );
    let numbers = vec![("mass_kg", part.matter.mass), ("density_kg_m3", density)];
    Some(part.finding(FindingKind::UnitSlip, FindingSeverity::Warning, message, numbers))
}

/// A centre of mass that is a thousand times as far from the frame as the link is large.
fn offset(part: &Part<'_>) -> Option<Finding> {
    let offset = part.matter.p_cm.norm();
    if offset < LONG || offset < MILLIMETRES * part.gyration() {
        return None;
    }
    let message = format!(
        "its centre of mass is {} m from its frame, its radius of gyration {} m; is the place in mm?",
        figures(offset),
        figures(part.gyration())
    );
    let numbers = vec![("offset_m", offset), ("gyration_m", part.gyration())];
    Some(part.finding(FindingKind::UnitSlip, FindingSeverity::Warning, message, numbers))
}

/// The median of the distances between joints that are not zero (m); infinite where there are none.
fn usual_offset(vehicle: &Vehicle) -> f64 {
    let robot = &vehicle.robot;
    let lengths = robot.joints().map(|j| robot.joint(j).X_PB_zero.translation.norm());
    let mut lengths: Vec<f64> = lengths.filter(|length| *length > 1e-6).collect();
    lengths.sort_by(f64::total_cmp);
    lengths.get(lengths.len() / 2).copied().unwrap_or(f64::INFINITY)
}

fn joint_offset(vehicle: &Vehicle, j: usize, usual: f64) -> Option<Finding> {
    let offset = vehicle.robot.joint(j).X_PB_zero.translation.norm();
    if offset < LONG || offset < MILLIMETRES * usual {
        return None;
    }
    let message = format!(
        "it is {} m from the joint before it, half of all joints {} m or less; is the place in mm?",
        figures(offset),
        figures(usual)
    );
    let numbers = vec![("offset_m", offset), ("median_offset_m", usual)];
    Some(joint_finding(vehicle, j, message, numbers))
}

/// Limits of a turning joint that are possible in degrees and not in radians, or the other way round.
fn travel_or_rate(vehicle: &Vehicle, j: usize) -> Option<Finding> {
    if vehicle.robot.joint(j).kind != JointKind::Revolute {
        return None;
    }
    let limits = vehicle.limits.get(j)?;
    if let Some((lower, upper)) = limits.travel {
        let largest = lower.abs().max(upper.abs());
        let numbers = vec![("lower_rad", lower), ("upper_rad", upper)];
        // A whole number of degrees, beyond two turns in radians: 90, -135, 180. Less stands for no limit.
        let is_whole = |x: f64| (x - x.round()).abs() < 1e-9;
        if largest > TWO_TURNS && largest <= 720.0 && is_whole(lower) && is_whole(upper) {
            let message =
                format!("it turns from {lower} to {upper} rad; are the limits in degrees?");
            return Some(joint_finding(vehicle, j, message, numbers));
        }
        let once = (upper - lower).to_degrees();
        if upper - lower < NARROW && (0.5..TAU + 1e-6).contains(&once) {
            let message = format!(
                "it turns by {} rad in all; were degrees turned into radians twice? Once gives {} rad",
                figures(upper - lower),
                figures(once)
            );
            return Some(joint_finding(vehicle, j, message, numbers));
        }
    }
    let rate = limits.rate.filter(|rate| *rate > FAST && *rate < NO_RATE)?;
    let message = format!(
        "it turns at up to {} rad/s, {} turns a second; is the rate in deg/s?",
        figures(rate),
        figures(rate / TAU)
    );
    Some(joint_finding(vehicle, j, message, vec![("rate_rad_s", rate)]))
}

fn joint_finding(
    vehicle: &Vehicle,
    j: usize,
    message: String,
    numbers: Vec<(&'static str, f64)>,
) -> Finding {
    Finding {
        kind: FindingKind::UnitSlip,
        severity: FindingSeverity::Warning,
        subject: vehicle.joint_names.get(j).cloned().unwrap_or_default(),
        place: vehicle.places.joints.get(j).cloned(),
        message,
        numbers,
    }
}

impl Part<'_> {
    /// A finding about this link.
    pub(super) fn finding(
        &self,
        kind: FindingKind,
        severity: FindingSeverity,
        message: String,
        numbers: Vec<(&'static str, f64)>,
    ) -> Finding {
        let place: Option<Place> = self.place.cloned();
        Finding { kind, severity, subject: self.matter.link.clone(), place, message, numbers }
    }
}
