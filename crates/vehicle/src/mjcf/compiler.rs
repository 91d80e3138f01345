//! `<compiler>`: how the rest of the file is to be read.

use crate::xml::{Element, Kind, Reading, Text};
use roxmltree::Node;
use wrasse_document::closest;

const COMPILER: Kind = Kind {
    tag: "compiler",
    attributes: &[
        "angle",
        "eulerseq",
        "autolimits",
        "inertiafromgeom",
        "inertiagrouprange",
        "boundmass",
        "boundinertia",
        "balanceinertia",
        "settotalmass",
        "coordinate",
        "alignfree",
    ],
    children: &[],
    unused: &[
        "assetdir",
        "conflict",
        "convexhull",
        "discardvisual",
        "exactmeshinertia",
        "fitaabb",
        "fusestatic",
        "lengthrange",
        "meshdir",
        "passthrough",
        "savecanonical",
        "savecompiled",
        "saveinertial",
        "strippath",
        "texturedir",
        "usethread",
    ],
};

/// When mass properties are computed from geoms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FromGeoms {
    Never,
    Always,
    /// Where a body has no `<inertial>`.
    Auto,
}

/// The unit of the angles of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum AngleUnit {
    Degree,
    Radian,
}

/// What `<compiler>` says; MuJoCo's defaults where it is silent.
#[derive(Debug, Clone, Copy)]
pub(super) struct Compiler {
    pub(super) angle: AngleUnit,
    /// Axes of `euler`: x, y, z about axes that turn along, X, Y, Z about fixed ones.
    pub(super) euler: [char; 3],
    /// A range limits without the word `limited`.
    pub(super) autolimits: bool,
    pub(super) from_geoms: FromGeoms,
    /// Groups of the geoms that have mass, both included (–).
    pub(super) groups: (f64, f64),
    /// Least mass of a body (kg) and least principal moment (kg·m²).
    pub(super) least_mass: f64,
    pub(super) least_inertia: f64,
    /// Inertias that cannot be become those of a ball with the same trace.
    pub(super) balance: bool,
    /// The frame of a body that floats alone is moved to its centre of mass and principal axes.
    pub(super) align_free: bool,
    /// Mass of the whole (kg), to which all masses and inertias are scaled.
    pub(super) total_mass: Option<f64>,
}

impl Default for Compiler {
    fn default() -> Self {
        Self {
            angle: AngleUnit::Degree,
            euler: ['x', 'y', 'z'],
            autolimits: true,
            from_geoms: FromGeoms::Auto,
            groups: (0.0, 5.0),
            least_mass: 0.0,
            least_inertia: 0.0,
            balance: false,
            align_free: false,
            total_mass: None,
        }
    }
}

impl Compiler {
    /// An angle of the file (rad).
    pub(super) fn radians(&self, angle: f64) -> f64 {
        match self.angle {
            AngleUnit::Degree => angle.to_radians(),
            AngleUnit::Radian => angle,
        }
    }

    /// Takes over what one `<compiler>` says.
    pub(super) fn read(&mut self, node: Node<'_, '_>, reading: &mut Reading<'_>) {
        let element = reading.open(node, &COMPILER);
        self.angle = match reading.word(&element, "angle", &["degree", "radian"]) {
            Some("degree") => AngleUnit::Degree,
            Some(_) => AngleUnit::Radian,
            None => self.angle,
        };
        if let Some(written) = element.attribute("eulerseq") {
            self.euler = reading.sequence(written).unwrap_or(self.euler);
        }
        let mut yes = |name, default| reading.truth(&element, name).unwrap_or(default);
        self.autolimits = yes("autolimits", self.autolimits);
        self.balance = yes("balanceinertia", self.balance);
        self.align_free = yes("alignfree", self.align_free);
        match reading.word(&element, "inertiafromgeom", &["false", "true", "auto"]) {
            Some("false") => self.from_geoms = FromGeoms::Never,
            Some("true") => self.from_geoms = FromGeoms::Always,
            Some(_) => self.from_geoms = FromGeoms::Auto,
            None => {}
        }
        if let Some([lowest, highest]) =
            reading.numbers(&element, "inertiagrouprange", 2).as_deref()
        {
            self.groups = (*lowest, *highest);
        }
        self.least_mass = reading.number(&element, "boundmass").unwrap_or(self.least_mass);
        self.least_inertia = reading.number(&element, "boundinertia").unwrap_or(self.least_inertia);
        let total = reading.number(&element, "settotalmass");
        // MuJoCo's default is -1: the masses are not scaled.
        self.total_mass = total.map_or(self.total_mass, |total| (total > 0.0).then_some(total));
        if reading.word(&element, "coordinate", &["local", "global"]) == Some("global") {
            let message = "global coordinates are not supported".to_owned();
            let at = element.attribute("coordinate").map_or(&element.at, |written| &written.at);
            let help = "MuJoCo dropped them too: save the model with local coordinates";
            reading.found.error(at, message, "not supported", help);
        }
    }
}

impl Reading<'_> {
    /// One of a few words, if the attribute is there; nothing after a complaint.
    pub(super) fn word(
        &mut self,
        element: &Element<'_, '_>,
        name: &str,
        words: &[&'static str],
    ) -> Option<&'static str> {
        let written = element.attribute(name)?;
        let known = words.iter().find(|word| **word == written.text.trim());
        if known.is_none() {
            let message =
                format!("`{name}` of <{}> cannot be '{}'", element.tag, written.text.trim());
            let help = match closest(written.text, words.iter().copied()) {
                Some(meant) => format!("did you mean \"{meant}\"?"),
                None => format!("it is one of {}", words.join(", ")),
            };
            self.found.error(&written.at, message, "unknown word", &help);
        }
        known.copied()
    }

    /// True or false, if the attribute is there and does not leave it open; nothing after a complaint.
    pub(super) fn truth(&mut self, element: &Element<'_, '_>, name: &str) -> Option<bool> {
        match self.word(element, name, &["true", "false", "auto"])? {
            "true" => Some(true),
            "false" => Some(false),
            _ => None,
        }
    }

    /// Three axes out of x, y, z, X, Y, Z.
    fn sequence(&mut self, written: &Text<'_>) -> Option<[char; 3]> {
        let axes: Vec<_> = written.text.chars().filter(|axis| "xyzXYZ".contains(*axis)).collect();
        if let ([first, second, third], 3) = (&axes[..], written.text.chars().count()) {
            return Some([*first, *second, *third]);
        }
        let message =
            format!("`eulerseq` must be three of x, y, z, X, Y, Z: found '{}'", written.text);
        let help = "small letters turn about axes that turn along, large ones about fixed axes";
        self.found.error(&written.at, message, "three letters", help);
        None
    }
}
