//! Mass properties of a body: `<inertial>`, or the sum of its geoms, and what `<compiler>` makes of
//! them.

use super::compiler::{Compiler, FromGeoms};
use super::defaults::Styled;
use super::geom::Geom;
use super::solid::Solid;
use crate::assembly::{Matter, Rounding};
use crate::check::principal_moments;
use crate::figures::figures;
use crate::xml::{Element, Kind, Reading};
use nalgebra::{Matrix3, SymmetricEigen};
use roxmltree::Node;
use std::ops::Range;
use wrasse_spatial::{Mat3, Sym3, vec3};

const INERTIAL: Kind = Kind {
    tag: "inertial",
    attributes: &[
        "pos",
        "quat",
        "axisangle",
        "xyaxes",
        "zaxis",
        "euler",
        "mass",
        "diaginertia",
        "fullinertia",
    ],
    children: &[],
    unused: &[],
};

/// Attributes that turn the axes of an inertia.
const TURNS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

/// More than any decomposition of three by three takes.
const MOST_ITERATIONS: usize = 1000;

impl Compiler {
    /// Mass properties of a body; nothing of a mere frame. After a complaint about its inertia,
    /// neutral values stand in: the rest is still checked.
    pub(super) fn matter(
        &self,
        body: (&str, &Range<usize>),
        inertial: Option<Node<'_, '_>>,
        geoms: &[Geom],
        reading: &mut Reading<'_>,
    ) -> Option<Matter> {
        let written = inertial.map(|node| self.inertial(node, reading));
        let of_geoms = match self.from_geoms {
            FromGeoms::Never => false,
            FromGeoms::Always => true,
            FromGeoms::Auto => written.is_none(),
        };
        let summed = if of_geoms { sum_of_geoms(body, geoms, reading) } else { None };
        let matter = summed.or(written).unwrap_or_else(|| Matter {
            mass: 0.0,
            mass_at: body.1.clone(),
            p_cm: vec3(0.0, 0.0, 0.0),
            inertia: Sym3::zero(),
            inertia_at: body.1.clone(),
            rounding: Rounding::default(),
            accept_nonphysical: None,
        });
        let matter = self.corrected(body.0, matter, reading);
        (matter.mass != 0.0 || matter.inertia != Sym3::zero()).then_some(matter)
    }

    /// What `<inertial>` says.
    fn inertial(&self, node: Node<'_, '_>, reading: &mut Reading<'_>) -> Matter {
        let element = reading.open(node, &INERTIAL);
        element.required("pos", reading);
        let mass = reading.required_number(&element, "mass");
        let mass_at = element.attribute("mass").map_or(&element.at, |written| &written.at).clone();
        let inertia = inertia(&element, reading);
        let given = element.attribute("fullinertia").or(element.attribute("diaginertia"));
        let inertia_at = given.map_or(&element.at, |written| &written.at).clone();
        let X_BC = self.pose(&Styled::plain(element), reading);
        Matter {
            mass: mass.unwrap_or(1.0),
            mass_at,
            p_cm: X_BC.translation,
            inertia: X_BC.rotation.congruence(inertia.unwrap_or(Sym3::diagonal(1.0, 1.0, 1.0))),
            inertia_at,
            rounding: Rounding::default(),
            accept_nonphysical: None,
        }
    }

    /// What `<compiler>` makes of mass properties: least values, and inertias that cannot be.
    fn corrected(&self, body: &str, matter: Matter, reading: &mut Reading<'_>) -> Matter {
        // What is negative is refused later; MuJoCo refuses it too.
        let mass = if matter.mass < 0.0 { matter.mass } else { matter.mass.max(self.least_mass) };
        let mut inertia = matter.inertia;
        let [least, ..] = principal_moments(inertia);
        if least < self.least_inertia && self.least_inertia > 0.0 {
            inertia = raised(inertia, self.least_inertia).unwrap_or(inertia);
        }
        if mass != matter.mass || inertia != matter.inertia {
            let message =
                format!("mass or inertia of '{body}' is raised to what <compiler> asks for");
            reading.found.warning(&matter.mass_at, message, "this body", "");
        }
        let [a, b, c] = principal_moments(inertia);
        if self.balance && c > (a + b) * (1.0 + 1e-12) {
            let mean = (inertia.xx + inertia.yy + inertia.zz) / 3.0;
            let message = format!(
                "inertia of '{body}' cannot be, and is balanced as <compiler> asks for: all its \
                 moments become {} kg·m²",
                figures(mean)
            );
            let help = "no rigid body has the moments that stand here";
            reading.found.warning(&matter.inertia_at, message, "this inertia", help);
            inertia = Sym3::diagonal(mean, mean, mean);
        }
        Matter { mass, inertia, ..matter }
    }
}

/// The inertia in the axes of the inertial frame; nothing after a complaint.
fn inertia(element: &Element<'_, '_>, reading: &mut Reading<'_>) -> Option<Sym3<f64>> {
    if element.attribute("fullinertia").is_none() {
        if element.attribute("diaginertia").is_none() {
            let message = "<inertial> has neither `diaginertia` nor `fullinertia`".to_owned();
            let help = "write diaginertia=\"xx yy zz\", or leave out <inertial> and give the \
                        geoms mass";
            reading.found.error(&element.at, message, "no inertia", help);
        }
        let [xx, yy, zz] = reading.numbers(element, "diaginertia", 3)?[..] else { return None };
        return Some(Sym3::diagonal(xx, yy, zz));
    }
    for other in TURNS.into_iter().chain(["diaginertia"]) {
        if let Some(written) = element.attribute(other) {
            let message = format!("<inertial> has both `fullinertia` and `{other}`");
            let help = "`fullinertia` is in the axes of the body; leave out one of them";
            reading.found.error(&written.at, message, "beside `fullinertia`", help);
        }
    }
    let [xx, yy, zz, xy, xz, yz] = reading.numbers(element, "fullinertia", 6)?[..] else {
        return None;
    };
    Some(Sym3 { xx, yy, zz, xy, xz, yz })
}

/// The sum of a body's geoms, if any has mass; complains of mass that cannot be known.
fn sum_of_geoms(
    (body, at): (&str, &Range<usize>),
    geoms: &[Geom],
    reading: &mut Reading<'_>,
) -> Option<Matter> {
    for geom in geoms {
        if let Some(what) = geom.unknown {
            let message =
                format!("the inertia of '{body}' comes from its geoms, and one of them is {what}");
            let help = "give the body an <inertial>, as MuJoCo writes it with saveinertial=\"true\", \
                        or the geom mass=\"0\"";
            reading.found.error(&geom.at, message, "cannot be computed", help);
        }
    }
    let of_geom = |geom: &Geom| geom.unknown.map(|_| Solid::stand_in()).or(geom.solid);
    let solids: Vec<_> = geoms.iter().filter_map(of_geom).collect();
    let Solid { mass, p_cm, inertia } = Solid::sum(&solids)?;
    let at = geoms.iter().find(|geom| geom.solid.is_some()).map_or(at, |geom| &geom.at);
    Some(Matter {
        mass,
        mass_at: at.clone(),
        p_cm,
        inertia,
        inertia_at: at.clone(),
        rounding: Rounding::default(),
        accept_nonphysical: None,
    })
}

/// The same inertia, no principal moment below a least one.
fn raised(I: Sym3<f64>, least: f64) -> Option<Sym3<f64>> {
    let matrix = Matrix3::new(I.xx, I.xy, I.xz, I.xy, I.yy, I.yz, I.xz, I.yz, I.zz);
    let eigen = SymmetricEigen::try_new(matrix, f64::EPSILON, MOST_ITERATIONS)?;
    let axis = |k: usize| {
        let v = eigen.eigenvectors.column(k);
        vec3(v[0], v[1], v[2])
    };
    let [a, b, c] = [0, 1, 2].map(|k| eigen.eigenvalues[k].max(least));
    let R: Mat3<f64> = Mat3::from_columns(axis(0), axis(1), axis(2));
    Some(R.congruence(Sym3::diagonal(a, b, c)))
}
