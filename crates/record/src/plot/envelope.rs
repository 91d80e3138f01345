//! The momentum that a set of actuators can hold, as a solid seen from outside and cut open, with
//! the singular surfaces inside and what tasks ask for on top.

use std::fmt::Write;

use maud::{Markup, html};
use wrasse_spatial::{Real, Vec3, vec3};
use wrasse_study::Mesh;

use super::{Length, Line, corners, multiples, step};
use crate::wording::numbers::significant;

/// Half the width of a view (SVG units; ten to a pixel, so that figures are whole).
const HALF: f64 = 2300.0;
/// How far the surfaces reach from the middle of a view (SVG units).
const REACH: f64 = 1650.0;
/// About how wide the name of an axis and a figure on it are, and how high (SVG units).
const NAME: f64 = 480.0;
const FIGURE: f64 = 230.0;
const LINE: f64 = 110.0;
/// Most figures on an axis.
const TICKS: f64 = 6.5;
/// Azimuth and elevation of the eye (rad).
const EYE: [f64; 2] = [-0.95, 0.42];
/// Shades from away from the light to facing it.
const SHADES: usize = 4;

/// A line through momentum space, with its name.
#[derive(Debug, Clone)]
pub(crate) struct MomentumPath<'a> {
    pub(crate) name: &'a str,
    /// Base axes (N·m·s).
    pub(crate) points: &'a [Vec3<f64>],
}

/// Where the eye stands, and the scale.
struct View {
    right: Vec3<f64>,
    up: Vec3<f64>,
    towards: Vec3<f64>,
    scale: f64,
}

impl View {
    fn new(size: f64) -> Self {
        let [(sin_a, cos_a), (sin_e, cos_e)] = EYE.map(Real::sin_cos);
        let towards = vec3(cos_e * cos_a, cos_e * sin_a, sin_e);
        let right = vec3(-sin_a, cos_a, 0.0);
        Self { right, up: towards.cross(right), towards, scale: REACH / size }
    }
    /// Where a point is on the sheet, y downwards.
    fn place(&self, p: Vec3<f64>) -> [f64; 2] {
        [HALF + self.scale * p.dot(self.right), HALF - self.scale * p.dot(self.up)]
    }
    /// Whether a point is on the eye's side of the upright plane through the middle.
    fn is_cut_away(&self, p: Vec3<f64>) -> bool {
        p.dot(vec3(self.towards.x, self.towards.y, 0.0)) > 0.0
    }
}

/// A face ready to be drawn.
struct Sheet {
    depth: f64,
    class: String,
    path: String,
}

/// The solid from outside, then cut open once for each kind of singular surface, as a figure. The
/// first mesh is the outer surface, the others lie inside.
pub(crate) fn envelope_figure(
    title: &str,
    meshes: &[Mesh],
    paths: &[MomentumPath<'_>],
) -> Option<Markup> {
    let reached = meshes.iter().flat_map(|mesh| &mesh.points).map(|p| p.norm());
    let size = reached.fold(0.0, f64::max);
    if size <= 0.0 || !size.is_finite() {
        return None;
    }
    let view = View::new(size);
    let most = meshes.iter().map(|mesh| mesh.against).max().unwrap_or(0);
    let looks = (0..=most).map(|against| match against {
        0 => (String::from("From outside"), against),
        1 => (String::from("Cut open: one rotor against the rest"), against),
        _ => (format!("Cut open: {against} rotors against the rest"), against),
    });
    let shown = |against: u32| -> Vec<&Mesh> {
        meshes.iter().filter(|m| m.against == 0 || m.against == against).collect()
    };
    Some(html! {
        figure.envelope {
            div.views {
                @for (name, against) in looks {
                    div { p.view { (name) } (sheet(&view, &name, &shown(against), paths, size)) }
                }
            }
            figcaption { (title) " " (legend(meshes, paths)) }
        }
    })
}

/// What the colours and dashes are.
fn legend(meshes: &[Mesh], paths: &[MomentumPath<'_>]) -> Markup {
    let inside = [1, 2, 3, 4].into_iter().filter(|k| meshes.iter().any(|mesh| mesh.against == *k));
    html! {
        span.swatch.outer { "what can be held at most" } " "
        @for against in inside {
            span class={ "swatch inner-" (against) } {
                "singular inside, "
                @if against == 1 { "one rotor" } @else { (against) " rotors" }
                " against the rest"
            }
            " "
        }
        @for (k, path) in paths.iter().enumerate() {
            (line(k).key(&format!("asked for: {}", path.name)))
        }
    }
}

/// The line of the k-th path.
fn line(k: usize) -> Line {
    if k == 0 { Line::FIRST } else { Line::nth(k - 1) }
}

fn sheet(
    view: &View,
    name: &str,
    meshes: &[&Mesh],
    paths: &[MomentumPath<'_>],
    size: f64,
) -> Markup {
    // Only what lies inside needs the cut.
    let open = meshes.iter().any(|mesh| mesh.against > 0);
    let mut sheets: Vec<Sheet> = meshes.iter().flat_map(|mesh| sheets(view, mesh, open)).collect();
    // Farthest first; equal depths stay in the order of the meshes.
    sheets.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    let side = 2.0 * HALF;
    html! {
        svg viewBox={ "0 0 " (format!("{side} {side}")) } role="img"
            aria-label={ (name) ": momentum that can be held" } {
            (axes(view, size))
            // Neighbours in the order of drawing that look alike become one path.
            @for group in sheets.chunk_by(|a, b| a.class == b.class) {
                @let path: String = group.iter().map(|sheet| sheet.path.as_str()).collect();
                path class=(group[0].class) d=(path) {}
            }
            @for (k, path) in paths.iter().enumerate() {
                (asked(view, path, line(k)).unwrap_or_default())
            }
        }
    }
}

/// Faces of a surface.
fn sheets<'a>(view: &'a View, mesh: &'a Mesh, open: bool) -> impl Iterator<Item = Sheet> + 'a {
    mesh.faces.iter().filter_map(move |face| {
        let corners: Vec<_> = face.iter().filter_map(|k| mesh.points.get(*k).copied()).collect();
        let middle =
            corners.iter().fold(Vec3::zero(), |a, p| a + *p) * (1.0 / corners.len() as f64);
        if open && view.is_cut_away(middle) {
            return None;
        }
        let shade = shade(&corners);
        let class = match mesh.against {
            0 => format!("outer s{shade}"),
            against => format!("inner-{} s{shade}", against.min(4)),
        };
        Some(Sheet { depth: middle.dot(view.towards), class, path: outline(view, &corners) })
    })
}

/// How a face stands to the light, which comes from above and the left of the eye.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 3")]
fn shade(corners: &[Vec3<f64>]) -> usize {
    let [a, b, c, d] = match corners {
        [a, b, c] => [a, b, c, a],
        [a, b, c, d, ..] => [a, b, c, d],
        _ => return 0,
    };
    let normal = (*c - *a).cross(*d - *b);
    let light = vec3(0.2, -0.75, 0.63);
    let facing = normal.dot(light).abs() / normal.norm().max(1e-300);
    ((facing * SHADES as f64) as usize).min(SHADES - 1)
}

/// A closed line in whole units, each corner seen from the one before it.
#[allow(clippy::cast_possible_truncation, reason = "within the sheet")]
fn outline(view: &View, corners: &[Vec3<f64>]) -> String {
    let mut path = String::new();
    let mut from = [0_i64; 2];
    for (k, corner) in corners.iter().enumerate() {
        let at = view.place(*corner).map(|x| x.round() as i64);
        let letter = if k == 0 { 'M' } else { 'l' };
        let _ = write!(path, "{letter}{} {}", at[0] - from[0], at[1] - from[1]);
        from = at;
    }
    path + "z"
}

/// The three axes from end to end, with their figures.
fn axes(view: &View, size: f64) -> Markup {
    let far = 1.16 * size;
    let step = step(2.0 * far, TICKS);
    let units = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)];
    html! {
        @for (name, unit) in ["x", "y", "z"].iter().zip(units) {
            @let end = view.place(unit * (1.23 * size));
            // The name of an upright axis stands on its end, others begin there.
            @let name_x = if end[0] > HALF + 1.0 { end[0] } else { end[0] - 0.5 * NAME };
            @let [from, to] = [-far, far].map(|x| view.place(unit * x));
            polyline.axle points=(corners(&[from, to])) {}
            text.axis x=(Length(name_x)) y=(Length(end[1])) { (name) " (N·m·s)" }
            @for value in multiples(-far, far, step).into_iter().filter(|v| v.abs() > 0.5 * step) {
                @let [x, y] = view.place(unit * value);
                @let at = [x + 30.0, y + 100.0];
                circle.tick cx=(Length(x)) cy=(Length(y)) r="14" {}
                @if !is_under([name_x, end[1]], at) {
                    text.figure x=(Length(at[0])) y=(Length(at[1])) { (significant(value)) }
                }
            }
        }
    }
}

/// Whether a figure that begins here would touch the name of an axis that begins there.
fn is_under([x, y]: [f64; 2], figure: [f64; 2]) -> bool {
    (-FIGURE..NAME).contains(&(figure[0] - x)) && (figure[1] - y).abs() < 1.5 * LINE
}

/// What a task asks for, as a line from its first to its last point.
fn asked(view: &View, path: &MomentumPath<'_>, line: Line) -> Option<Markup> {
    let points: Vec<_> = path.points.iter().map(|p| view.place(*p)).collect();
    let [x, y] = *points.last()?;
    let colour = line.colour();
    Some(html! {
        polyline class={ "asked " (colour) " " (line.dash()) } points=(corners(&points)) {}
        circle class={ "asked " (colour) } cx=(Length(x)) cy=(Length(y)) r="30" {}
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_hardware::ControlMomentGyro;
    use wrasse_study::singular_surfaces;

    fn pyramid() -> Vec<ControlMomentGyro<f64>> {
        let (s, c) = (0.8, 0.6);
        let sides = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
        let cmg = |(x, y): (f64, f64)| ControlMomentGyro {
            gimbal_axis_B: vec3(s * x, s * y, c),
            spin_axis_B: vec3(-y, x, 0.0),
            momentum: 75.0,
            ..Default::default()
        };
        sides.into_iter().map(cmg).collect()
    }

    #[test]
    fn the_figure_stays_on_its_sheet_and_the_cut_shows_less_of_the_outer_surface() {
        let meshes = singular_surfaces(&pyramid(), 12);
        let points = [Vec3::zero(), vec3(90.0, 0.0, 0.0)];
        let path = MomentumPath { name: "a <task>", points: &points };
        let figure = envelope_figure("Four CMGs", &meshes, &[path]).unwrap().0;
        assert!(figure.contains("a &lt;task&gt;") && !figure.contains("NaN"));
        let views: Vec<_> = figure.split("<svg").skip(1).collect();
        let outer = |view: &str| view.split("class=\"outer").skip(1).map(faces).sum::<usize>();
        let (whole, cut) = (outer(views[0]), outer(views[1]));
        assert_eq!(whole, meshes[0].faces.len());
        // Half of it, but for the faces that the plane crosses.
        assert!(cut * 5 < whole * 3 && cut * 5 > whole * 2, "{cut} of {whole}");
    }

    fn faces(group: &str) -> usize {
        group.split("</path>").next().unwrap_or_default().matches('z').count()
    }

    #[test]
    fn no_figure_of_an_axis_touches_the_name_of_an_axis() {
        let starts = |svg: &str, class: &str| -> Vec<[f64; 2]> {
            let number = |text: &str, key: &str| {
                let rest = text.split(key).nth(1).unwrap_or_default();
                rest.split('"').next().and_then(|n| n.parse().ok()).unwrap_or(f64::NAN)
            };
            let mark = format!("<text class=\"{class}\"");
            let texts = svg.split(&mark).skip(1);
            texts.map(|text| [number(text, " x=\""), number(text, " y=\"")]).collect()
        };
        for size in [47.0, 49.0, 131.0, 245.0, 408.0, 816.0] {
            let svg = axes(&View::new(size), size).0;
            let (names, figures) = (starts(&svg, "axis"), starts(&svg, "figure"));
            assert!(names.len() == 3 && figures.len() >= 6, "{size}: {svg}");
            for [x, y] in names {
                let free = figures
                    .iter()
                    .all(|f| f[0] + 200.0 < x || f[0] > x + 470.0 || (f[1] - y).abs() > 110.0);
                assert!(free, "{size}: {figures:?} at {x} {y}");
            }
        }
    }

    #[test]
    fn nothing_to_hold_is_nothing_to_draw() {
        assert!(envelope_figure("none", &[Mesh::default()], &[]).is_none());
    }

    #[test]
    fn x_goes_to_the_right_and_towards_the_eye_and_z_goes_up() {
        let view = View::new(1.0);
        let [middle, x, z] = [Vec3::zero(), vec3(1.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0)];
        assert!(view.place(x)[0] > view.place(middle)[0]);
        assert!(view.place(z)[1] < view.place(middle)[1]);
        assert!(view.is_cut_away(x) && !view.is_cut_away(-x));
    }
}
