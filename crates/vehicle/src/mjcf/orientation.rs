//! Where an element is on its parent, in the five ways of MJCF to give an orientation.

use super::compiler::{AngleUnit, Compiler};
use super::defaults::Styled;
use crate::rotation::sin_cos;
use crate::xml::{Element, Reading};
use wrasse_spatial::{Mat3, Pose, Quat, Real, Vec3, vec3};

/// Attributes that give an orientation. Where a class gives one way and the element another, MuJoCo
/// takes `quat` last.
const OTHERS: [&str; 4] = ["axisangle", "xyaxes", "zaxis", "euler"];

impl Compiler {
    /// The pose that `pos` and an orientation give; the identity where there is none.
    pub(super) fn pose(&self, of: &Styled<'_, '_, '_>, reading: &mut Reading<'_>) -> Pose<f64> {
        let p = reading.vector(of.giver("pos"), "pos").unwrap_or_default();
        Pose::new(self.rotation(of, reading).unwrap_or(Mat3::identity()), p)
    }

    /// The rotation that an element gives, if it does.
    fn rotation(&self, of: &Styled<'_, '_, '_>, reading: &mut Reading<'_>) -> Option<Mat3<f64>> {
        for element in of.levels() {
            let given: Vec<_> =
                OTHERS.into_iter().filter(|name| element.attribute(name).is_some()).collect();
            if let [_, second, ..] = given[..] {
                let message = format!("<{}> gives its orientation in two ways", element.tag);
                let at = element.attribute(second).map_or(&element.at, |written| &written.at);
                reading.found.error(at, message, "the second", "leave out one of them");
            }
            if let [name, ..] = given[..] {
                return self.by(name, element, reading);
            }
        }
        self.by("quat", of.giver("quat"), reading)
    }

    fn by(
        &self,
        name: &str,
        element: &Element<'_, '_>,
        reading: &mut Reading<'_>,
    ) -> Option<Mat3<f64>> {
        let expected = match name {
            "quat" | "axisangle" => 4,
            "xyaxes" => 6,
            _ => 3,
        };
        let numbers = reading.numbers(element, name, expected)?;
        let turned = match (name, &numbers[..]) {
            ("quat", &[w, x, y, z]) => {
                let quat = Quat::new(w, x, y, z);
                (quat.norm() > LEAST).then(|| quat.normalized().to_matrix())
            }
            ("axisangle", &[x, y, z, angle]) => {
                unit(vec3(x, y, z)).map(|axis| turn(axis, self.sin_cos(angle)))
            }
            ("xyaxes", &[a, b, c, d, e, f]) => from_x_and_y(vec3(a, b, c), vec3(d, e, f)),
            ("zaxis", &[x, y, z]) => unit(vec3(x, y, z)).map(from_z),
            (_, &[first, second, third]) => Some(self.euler([first, second, third])),
            _ => None,
        };
        if turned.is_none() {
            let message = format!("`{name}` of <{}> gives no direction", element.tag);
            let at = element.attribute(name).map_or(&element.at, |written| &written.at);
            reading.found.error(at, message, "zero, or parallel axes", "write other numbers");
        }
        turned
    }

    /// Turns about the axes of `eulerseq`, one after the other.
    fn euler(&self, angles: [f64; 3]) -> Mat3<f64> {
        self.euler.into_iter().zip(angles).fold(Mat3::identity(), |R, (letter, angle)| {
            let axis = match letter {
                'x' | 'X' => vec3(1.0, 0.0, 0.0),
                'y' | 'Y' => vec3(0.0, 1.0, 0.0),
                _ => vec3(0.0, 0.0, 1.0),
            };
            let next = turn(axis, self.sin_cos(angle));
            if letter.is_lowercase() { R * next } else { next * R }
        })
    }

    fn sin_cos(&self, angle: f64) -> (f64, f64) {
        match self.angle {
            AngleUnit::Degree => sin_cos(angle),
            AngleUnit::Radian => Real::sin_cos(angle),
        }
    }
}

/// What is shorter (–) has no direction.
const LEAST: f64 = 1e-10;

/// A vector's direction, if it has one.
pub(super) fn unit(a: Vec3<f64>) -> Option<Vec3<f64>> {
    let length = a.norm();
    (length > LEAST).then(|| a * (1.0 / length))
}

/// A turn about a unit vector, from sine and cosine of its angle.
fn turn(axis: Vec3<f64>, (s, c): (f64, f64)) -> Mat3<f64> {
    let with = |k: f64, m: Mat3<f64>| Mat3 { rows: m.rows.map(|row| row * k) };
    with(c, Mat3::identity()) + with(s, axis.skew()) + with(1.0 - c, axis.outer(axis))
}

/// Axes whose x is given, whose y is given but for what it has along x.
fn from_x_and_y(x: Vec3<f64>, y: Vec3<f64>) -> Option<Mat3<f64>> {
    let x = unit(x)?;
    let y = unit(y - x * x.dot(y))?;
    Some(Mat3::from_columns(x, y, x.cross(y)))
}

/// The least turn that brings z to a unit vector; a half turn about x if that is -z.
pub(super) fn from_z(z: Vec3<f64>) -> Mat3<f64> {
    let across = vec3(0.0, 0.0, 1.0).cross(z);
    match unit(across) {
        Some(axis) => turn(axis, (across.norm(), z.z)),
        None => turn(vec3(1.0, 0.0, 0.0), (0.0, z.z.signum())),
    }
}
