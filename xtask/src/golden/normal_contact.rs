//! Impacts against closed forms and another integrator: files `normal_contact_…`.

use super::comparison::{Bound, Found, Tolerances};
use super::file::{Case, Complaint};
use super::kind::Kind;
use super::state::{pose_value, xyz};
use super::touching_bodies::Bodies;
use serde::Deserialize;
use serde_json::{Value, json};
use wrasse_dynamics::{BodyId, MassProperties};
use wrasse_geometry::Shape;
use wrasse_spatial::{Pose, Quat, SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_world::{ContactLaw, FreeBody, FrictionLaw, NormalForce, SystemId};

/// As the files have it.
const SENTENCE: &str = "1-D: 1e-9 relative for an event-detecting integrator (the routes agree to 1e-10 in \
    the contact time, 2e-13 or better elsewhere). For a fixed-step world that does not locate touch: RK4 \
    with the force in every stage errs by O(h^2) for n = 1 and O(h^2.5) for n = 1.5, worst over where in \
    the step touch falls; the worst of 15 phases falls by factors that scatter between 2.7 and 6.8 under \
    halving (gen/kink_order.py: e = 0.5, m = 10, k = 1e5, h = 0.5 ms: 6e-5). 3-D twists: 1e-8 relative \
    to the largest component; impulse theory: see stiff_limit.";

const TOLERANCES: Tolerances = Tolerances {
    sentence: SENTENCE,
    every: Bound { relative: 1e-9, absolute: 0.0 },
    of: &[
        ("exact", Bound { relative: 1e-8, absolute: 0.0 }),
        // From the twist, whose largest component is above 0.1.
        ("rebound_speed_of_corner", Bound { relative: 1e-8, absolute: 1e-9 }),
        // A difference of twists: 1e-8 of their largest component, which is below 1.
        ("deviation_of_twist_from_impulse_theory", Bound { relative: 0.0, absolute: 1e-8 }),
        // The file's own route keeps positions to 1e-12, which is 1e-6 of the depth at 1e12 N/m^1.5.
        ("stiff_limit", Bound { relative: 1e-6, absolute: 0.0 }),
    ],
    arrays: &[],
};

pub(super) struct NormalContact;

impl Kind for NormalContact {
    fn takes(&self, kind: &str) -> bool {
        kind.starts_with("normal_contact/")
    }

    fn tolerances(&self) -> &'static Tolerances {
        &TOLERANCES
    }

    fn found(&self, case: &Case) -> Result<Found, Complaint> {
        let value = match case.kind.rsplit('/').next() {
            Some("two_free_spheres") => two_spheres(case)?,
            Some("box_corner_on_wall") => CornerCase::read(case)?.found(case),
            _ => ball_on_wall(case)?,
        };
        Ok(Found { value, left_out: vec![] })
    }
}

fn law(case: &Case, speed: f64) -> Result<NormalForce, Complaint> {
    let (k, n) = (case.number("input.stiffness")?, case.number("input.exponent")?);
    Ok(NormalForce::with_restitution(k, n, (case.number("input.restitution")?, speed)))
}

/// Forces act where the first shape is.
fn frictionless(normal: NormalForce) -> ContactLaw {
    ContactLaw { normal, friction: FrictionLaw::None, given_by_A: 0.0 }
}

/// A ball that does not turn, on the x axis.
fn ball(bodies: &mut Bodies, mass: f64, x: f64, v: f64) -> SystemId {
    let matter = MassProperties::from_central(mass, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
    let X = Pose { translation: vec3(x, 0.0, 0.0), ..Pose::identity() };
    let V = SpatialVelocity::new(Vec3::zero(), vec3(v, 0.0, 0.0));
    bodies.scene.add_body(&FreeBody::new(matter, &X, &V))
}

/// A point that flies against a wall.
fn ball_on_wall(case: &Case) -> Result<Value, Complaint> {
    let normal = law(case, case.number("input.design_speed")?)?;
    let (mass, v) = (case.number("input.mass_kg")?, case.number("input.approach_speed")?);
    let mut bodies = Bodies::fine();
    let a = ball(&mut bodies, mass, -normal.deepest(mass, v), v);
    let point = (a, Shape::Sphere { radius: 0.0 }, Vec3::zero());
    let wall = (Vec3::zero(), vec3(-1.0, 0.0, 0.0));
    let id = bodies.touch_wall(point, wall, frictionless(normal));
    bodies.fly_until_parted(id);
    let (rebound, record) = (-bodies.velocity(a).x, bodies.record(id));
    Ok(json!({
        "D": normal.damping * v,
        "damping_c": normal.damping,
        "restitution": rebound / v,
        "peak_penetration": record.deepest,
        "peak_force": record.largest_force,
        "contact_time": record.duration,
        "rebound_speed": rebound,
        "impulse": mass * (v + rebound),
        "energy_loss": bodies.energy(id).normal_loss,
    }))
}

fn two_spheres(case: &Case) -> Result<Value, Complaint> {
    let normal = law(case, case.number("input.design_speed")?)?;
    let of = |name: &str| case.number(&format!("input.{name}"));
    let (m, v) = ([of("mass_1_kg")?, of("mass_2_kg")?], [of("velocity_1")?, of("velocity_2")?]);
    let reduced = m[0] * m[1] / (m[0] + m[1]);
    // As far apart as they come into each other, and small: beside large numbers that would be rounded off.
    let gap = normal.deepest(reduced, v[0] - v[1]);
    let (radius, mut bodies) = (10.0 * gap, Bodies::fine());
    let start = [-2.0 * radius - gap, 0.0];
    let ids = [0, 1].map(|i| ball(&mut bodies, m[i], start[i], v[i]));
    let id = bodies.touch((ids[0], radius), (ids[1], radius), frictionless(normal));
    let parted = bodies.fly_until_parted(id);
    let (record, after) = (bodies.record(id), ids.map(|id| bodies.velocity(id).x));
    let displacement = |i: usize| {
        let now = bodies.scene.body(ids[i]).pose().translation.x;
        let at_parting = now - after[i] * (bodies.scene.time() - parted);
        at_parting - (start[i] + v[i] * record.first_time)
    };
    Ok(json!({
        "reduced_mass": reduced,
        "damping_c": normal.damping,
        "restitution": (after[1] - after[0]) / (v[0] - v[1]),
        "peak_penetration": record.deepest,
        "peak_force": record.largest_force,
        "contact_time": record.duration,
        "velocity_1_after": after[0],
        "velocity_2_after": after[1],
        "impulse": m[0] * (v[0] - after[0]),
        "energy_loss": bodies.energy(id).normal_loss,
        "displacement_1": displacement(0),
        "displacement_2": displacement(1),
    }))
}

#[derive(Deserialize)]
struct AtTouch {
    position: [f64; 3],
    attitude: Quaternion,
    angular: [f64; 3],
    linear: [f64; 3],
}

#[derive(Deserialize)]
struct Quaternion {
    w: f64,
    x: f64,
    y: f64,
    z: f64,
}

/// A corner of a free box on a wall.
struct CornerCase {
    start: FreeBody,
    corner: Vec3<f64>,
    wall: (Vec3<f64>, Vec3<f64>),
    law: NormalForce,
    restitution: f64,
    /// Of the corner towards the wall at touch (m/s).
    speed: f64,
}

impl CornerCase {
    fn read(case: &Case) -> Result<Self, Complaint> {
        let of = |name: &str| case.read::<[f64; 3]>(&format!("input.{name}")).map(Vec3::from_array);
        let (corner, n, I) =
            (of("corner_in_body_m")?, of("wall_outward_normal_N")?, of("inertia_kgm2_body_axes")?);
        let inertia = Sym3::diagonal(I.x, I.y, I.z);
        let matter =
            MassProperties::from_central(case.number("input.mass_kg")?, Vec3::zero(), inertia);
        let at: AtTouch = case.read("input.at_touch")?;
        let Quaternion { w, x, y, z } = at.attitude;
        let X = Pose::from_quat(Quat { w, x, y, z }, Vec3::from_array(at.position));
        let V = SpatialVelocity::new(Vec3::from_array(at.angular), Vec3::from_array(at.linear));
        let start = FreeBody::new(matter, &X, &V);
        let speed = -n.dot(velocity_of(&start, corner));
        Ok(Self {
            wall: (of("wall_through")?, n),
            law: law(case, speed)?,
            restitution: case.number("input.restitution")?,
            start,
            corner,
            speed,
        })
    }

    fn found(&self, case: &Case) -> Value {
        let theory = self.impulse_theory();
        let rows = case.rows("stiff_limit");
        let stiff_limit: Vec<Value> = rows
            .iter()
            .map(|row| {
                let stiffness = row["stiffness"].as_f64().unwrap_or(f64::NAN);
                let found = self.impact(NormalForce { stiffness, ..self.law });
                json!({
                    "stiffness": stiffness,
                    "deviation_of_twist_from_impulse_theory": twist_deviation(&found, &theory),
                    "contact_time": found["contact_time"],
                })
            })
            .collect();
        json!({
            "damping_c": self.law.damping,
            "exact": self.impact(self.law),
            "impulse_theory": theory,
            "stiff_limit": stiff_limit,
        })
    }

    fn scene(&self, law: NormalForce) -> (Bodies, SystemId, wrasse_world::CouplingId) {
        let mut bodies = Bodies::fine();
        let id = bodies.scene.add_body(&self.start);
        let point = (id, Shape::Sphere { radius: 0.0 }, self.corner);
        let contact = bodies.touch_wall(point, self.wall, frictionless(law));
        (bodies, id, contact)
    }

    /// The state at separation: a first flight finds when that is, a second one ends there.
    fn impact(&self, law: NormalForce) -> Value {
        let (mut bodies, _, contact) = self.scene(law);
        let parted = bodies.fly_until_parted(contact);
        let record = bodies.record(contact);
        let (mut bodies, id, _) = self.scene(law);
        if !bodies.fly_to(parted) {
            return Value::Null;
        }
        let body = bodies.scene.body(id);
        let twist = body.twist();
        let mut value = pose_value(&body.pose());
        for (key, more) in [
            ("contact_time", json!(record.duration)),
            ("peak_penetration", json!(record.deepest)),
            ("angular", xyz(twist.angular)),
            ("linear", xyz(twist.linear)),
            ("impulse", json!((body.linear - self.start.linear).norm())),
            ("energy_loss", json!(self.start.kinetic_energy() - body.kinetic_energy())),
            ("rebound_speed_of_corner", json!(self.wall.1.dot(velocity_of(&body, self.corner)))),
        ] {
            value[key] = more;
        }
        value
    }

    /// The twist after an impact in which nothing moves, by the world's effective mass.
    fn impulse_theory(&self) -> Value {
        let (mut bodies, n) = (Bodies::fine(), self.wall.1);
        let id = bodies.scene.add_body(&self.start);
        let X = self.start.pose();
        let W = bodies.scene.mobility(id, BodyId::Base, X.point(self.corner));
        let mass = 1.0 / n.dot(W * n);
        let impulse = (1.0 + self.restitution) * mass * self.speed;
        let arm = X.rotation * self.corner;
        let after = FreeBody {
            linear: self.start.linear + n * impulse,
            angular: self.start.angular + arm.cross(n * impulse),
            ..self.start
        };
        json!({
            "effective_mass": mass,
            "normal_speed": self.speed,
            "impulse": impulse,
            "angular": xyz(after.twist().angular),
            "linear": xyz(after.twist().linear),
            "energy_loss": self.start.kinetic_energy() - after.kinetic_energy(),
        })
    }
}

/// Velocity of a point of a body, inertial axes (m/s).
fn velocity_of(body: &FreeBody, p: Vec3<f64>) -> Vec3<f64> {
    let V = body.twist();
    body.pose().rotation * (V.linear + V.angular.cross(p))
}

/// The largest difference between the components of two twists; NaN where one is missing.
fn twist_deviation(a: &Value, b: &Value) -> f64 {
    let each = ["angular", "linear"].into_iter().flat_map(|key| (0..3).map(move |i| (key, i)));
    let number = |of: &Value, (key, i): (&str, usize)| of[key][i].as_f64().unwrap_or(f64::NAN);
    each.map(|at| (number(a, at) - number(b, at)).abs())
        .fold(0.0, |most: f64, x| if x.is_nan() { x } else { most.max(x) })
}
