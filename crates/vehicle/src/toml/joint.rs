//! The tables `[[joint]]`: how each moves, and what it can do.

use crate::assembly::{AssemblyJoint, Mimic};
use crate::table::{OrientationFile, ProvenanceFile, Reading, under};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_dynamics::JointKind;
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Vec3, vec3};

/// A joint between two bodies.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct JointFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// How it moves.
    pub(crate) kind: KindFile,
    /// The body that carries it.
    #[schemars(length(min = 1))]
    pub(crate) parent: String,
    /// The body that it carries.
    #[schemars(length(min = 1))]
    pub(crate) child: String,
    /// Origin of the child's frame at zero travel, in the parent's frame (m).
    pub(crate) position_m: [f64; 3],
    /// How the child's frame is turned from the parent's at zero travel; not at all if not given.
    pub(crate) orientation: Option<OrientationFile>,
    /// Direction of the axis through the child's origin, in the child's frame (–); any length.
    pub(crate) axis: Option<[f64; 3]>,
    /// What it can do.
    #[serde(flatten)]
    pub(crate) limits: LimitsFile,
    /// The joint that it follows, if it has no drive of its own.
    pub(crate) mimic: Option<MimicFile>,
    /// Where these numbers come from.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// A joint that follows another one, by a gear without play: its travel is `ratio` times that of the
/// other, plus the offset; torque or force on it is felt by the other, `ratio` times.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MimicFile {
    /// The joint that is followed.
    #[schemars(length(min = 1))]
    pub(crate) joint: String,
    /// Travel per travel of the other, in SI (rad or m per rad or m); 1 if not given.
    pub(crate) ratio: Option<f64>,
    /// Travel when the other is at zero, of a joint that turns (deg); zero if not given.
    pub(crate) offset_deg: Option<f64>,
    /// Travel when the other is at zero, of a joint that slides (m); zero if not given.
    pub(crate) offset_m: Option<f64>,
}

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum KindFile {
    /// Turns about its axis, within its travel.
    Revolute,
    /// Turns about its axis without end.
    Continuous,
    /// Slides along its axis, within its travel.
    Prismatic,
    /// Does not move.
    Fixed,
}

/// What a joint can do; what is not given is not limited.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
pub(crate) struct LimitsFile {
    /// Lower and upper end of the travel of a revolute joint (deg).
    pub(crate) travel_deg: Option<[f64; 2]>,
    /// Lower and upper end of the travel of a prismatic joint (m).
    pub(crate) travel_m: Option<[f64; 2]>,
    /// Largest rate of a joint that turns (deg/s).
    pub(crate) rate_deg_s: Option<f64>,
    /// Largest rate of a joint that slides (m/s).
    pub(crate) rate_m_s: Option<f64>,
    /// Largest torque of the drive of a joint that turns (N·m).
    pub(crate) effort_nm: Option<f64>,
    /// Largest force of the drive of a joint that slides (N).
    pub(crate) effort_n: Option<f64>,
    /// Inertia of the rotor of the drive of a joint that turns, seen from the joint: that of the rotor
    /// times the square of the gear ratio (kg·m²).
    pub(crate) rotor_inertia_kgm2: Option<f64>,
    /// The same of a joint that slides: what the drive adds to the mass that slides (kg).
    pub(crate) rotor_inertia_kg: Option<f64>,
}

/// How the joint moves; `None` if it does not.
pub(crate) fn moving(kind: KindFile) -> Option<JointKind> {
    match kind {
        KindFile::Revolute | KindFile::Continuous => Some(JointKind::Revolute),
        KindFile::Prismatic => Some(JointKind::Prismatic),
        KindFile::Fixed => None,
    }
}

/// A joint given by the pose of its child.
pub(crate) fn joint(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    file: &JointFile,
) -> AssemblyJoint {
    let below = |key| reading.below(path, key);
    let (at, parent_at, child_at) = (below("name"), below("parent"), below("child"));
    let (axis_at, limits_at) = (below("axis"), below(limits_key(&file.limits)));
    AssemblyJoint {
        name: file.name.clone(),
        at,
        parent: file.parent.clone(),
        parent_at,
        child: file.child.clone(),
        child_at,
        kind: moving(file.kind),
        X_PC: reading.pose(path, file.position_m, file.orientation.as_ref()),
        axis: axis(reading, path, file),
        axis_at,
        limits: limits(reading, path, &file.name, file.kind, &file.limits),
        limits_at,
        rotor: rotor(reading, path, file.kind, &file.limits),
        mimic: mimic(reading, path, file),
    }
}

/// What a joint follows; complains of an offset in the unit of another kind of joint.
fn mimic(reading: &mut Reading<'_>, path: &[Step<'_>], file: &JointFile) -> Option<Mimic> {
    let given = file.mimic.as_ref()?;
    let path = under(path, "mimic");
    let (wrong, right) = match moving(file.kind) {
        Some(JointKind::Prismatic) => (given.offset_deg.map(|_| "offset_deg"), "offset_m"),
        _ => (given.offset_m.map(|_| "offset_m"), "offset_deg"),
    };
    if let Some(key) = wrong {
        let message = format!("joint '{}' is of another kind than `{key}`", file.name);
        reading.wrong_key(&under(&path, key), message, "wrong unit", &format!("write `{right}`"));
    }
    let offset = given.offset_deg.map(f64::to_radians).or(given.offset_m).unwrap_or(0.0);
    let at = reading.below(&path, "joint");
    Some(Mimic { leader: given.joint.clone(), at, ratio: given.ratio.unwrap_or(1.0), offset })
}

fn axis(reading: &mut Reading<'_>, path: &[Step<'_>], file: &JointFile) -> Vec3<f64> {
    match (file.axis, moving(file.kind)) {
        (Some(axis), Some(_)) => Vec3::from_array(axis),
        (None, None) => vec3(0.0, 0.0, 1.0),
        (None, Some(_)) => {
            let message = format!("joint '{}' has no `axis`", file.name);
            let help = "`axis` is the direction of the axis in the child's frame: axis = [0, 0, 1]";
            reading.error(path, message, "`axis` is missing", help);
            vec3(0.0, 0.0, 1.0)
        }
        (Some(_), None) => {
            let message = format!("joint '{}' is fixed, and has an axis", file.name);
            reading.wrong_key(&under(path, "axis"), message, "no axis", "leave it out");
            vec3(0.0, 0.0, 1.0)
        }
    }
}

/// The key that stands for the limits of a joint: its travel, if it has any.
pub(crate) fn limits_key(limits: &LimitsFile) -> &'static str {
    given(limits).first().copied().unwrap_or("kind")
}

/// Keys of the limits that are given.
fn given(limits: &LimitsFile) -> Vec<&'static str> {
    let keys = [
        ("travel_deg", limits.travel_deg.is_some()),
        ("travel_m", limits.travel_m.is_some()),
        ("rate_deg_s", limits.rate_deg_s.is_some()),
        ("rate_m_s", limits.rate_m_s.is_some()),
        ("effort_nm", limits.effort_nm.is_some()),
        ("effort_n", limits.effort_n.is_some()),
        ("rotor_inertia_kgm2", limits.rotor_inertia_kgm2.is_some()),
        ("rotor_inertia_kg", limits.rotor_inertia_kg.is_some()),
    ];
    keys.into_iter().filter(|(_, there)| *there).map(|(key, _)| key).collect()
}

/// What a joint can do, in SI; complains of limits that do not belong to its kind.
pub(crate) fn limits(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    name: &str,
    kind: KindFile,
    file: &LimitsFile,
) -> JointLimits<f64> {
    let (does, allowed, travel): (_, &[&str], _) = match kind {
        KindFile::Revolute => {
            ("turns", &["travel_deg", "rate_deg_s", "effort_nm", TURNING_ROTOR], Some("travel_deg"))
        }
        KindFile::Continuous => {
            ("turns without end", &["rate_deg_s", "effort_nm", TURNING_ROTOR], None)
        }
        KindFile::Prismatic => {
            ("slides", &["travel_m", "rate_m_s", "effort_n", SLIDING_ROTOR], Some("travel_m"))
        }
        KindFile::Fixed => ("is fixed", &[], None),
    };
    for key in given(file).into_iter().filter(|key| !allowed.contains(key)) {
        let message = format!("joint '{name}' {does}, and has `{key}`");
        let stem = key.split('_').next();
        let help = match allowed.iter().find(|other| other.split('_').next() == stem) {
            Some(other) => format!("write `{other}`"),
            None if kind == KindFile::Continuous => "a joint with limits is \"revolute\"".into(),
            None => "leave it out".into(),
        };
        reading.wrong_key(&under(path, key), message, "not for this kind", &help);
    }
    if let Some(key) = travel.filter(|key| !given(file).contains(key)) {
        let message = format!("joint '{name}' {does}, and has no `{key}`");
        let help = match kind {
            KindFile::Revolute => "a joint without limits is \"continuous\"",
            _ => "say how far it slides: travel_m = [0, 0.5]",
        };
        reading.error(&under(path, "kind"), message, "how far?", help);
    }
    let travel_m = in_order(reading, path, name, "m", file.travel_m);
    let travel_deg = in_order(reading, path, name, "deg", file.travel_deg);
    let mut above_zero = |key: &str, value: Option<f64>| {
        let value = value?;
        if value != 0.0 {
            return Some(value);
        }
        let message = format!("{key} of joint '{name}' is 0: the joint could not be driven");
        let help = "leave out what is not limited; a joint that never moves has kind = \"fixed\"";
        reading.error(&under(path, key), message, "this limit", help);
        None
    };
    let rate = above_zero("rate_deg_s", file.rate_deg_s).map(f64::to_radians);
    let rate = rate.or(above_zero("rate_m_s", file.rate_m_s));
    let effort = above_zero("effort_nm", file.effort_nm).or(above_zero("effort_n", file.effort_n));
    JointLimits {
        travel: travel_deg
            .map(|ends| ends.map(f64::to_radians))
            .or(travel_m)
            .map(|[lower, upper]| (lower, upper)),
        rate,
        effort,
    }
}

/// Keys of the rotor's inertia.
const TURNING_ROTOR: &str = "rotor_inertia_kgm2";
const SLIDING_ROTOR: &str = "rotor_inertia_kg";

/// Inertia of the rotor, seen from the joint (kg·m² or kg); zero if none is given.
pub(crate) fn rotor(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    kind: KindFile,
    file: &LimitsFile,
) -> f64 {
    let (key, given) = match moving(kind) {
        Some(JointKind::Prismatic) => (SLIDING_ROTOR, file.rotor_inertia_kg),
        _ => (TURNING_ROTOR, file.rotor_inertia_kgm2),
    };
    let inertia = given.unwrap_or(0.0);
    if inertia < 0.0 {
        let message = format!("`{key}` must not be negative, found {inertia}");
        reading.error(&under(path, key), message, "this inertia", "leave out the sign");
    }
    inertia
}

/// The ends of a travel, lower first; complains in the unit of the file if they are not.
fn in_order(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    name: &str,
    unit: &str,
    travel: Option<[f64; 2]>,
) -> Option<[f64; 2]> {
    let [lower, upper] = travel?;
    if lower <= upper {
        return travel;
    }
    let key = format!("travel_{unit}");
    let message = format!(
        "the limits of joint '{name}' are reversed: lower {lower} {unit}, upper {upper} {unit}"
    );
    reading.error(&under(path, &key), message, "lower is above upper", "exchange them");
    Some([upper, lower])
}
