//! Sliding, sticking and rolling: files `friction_…`.

use super::comparison::{Bound, Found, Tolerances};
use super::file::{Case, Complaint};
use super::kind::Kind;
use super::state::{pose_value, xyz};
use super::touching_bodies::Bodies;
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::sync::{Arc, Mutex};
use wrasse_dynamics::{MassProperties, PerBody};
use wrasse_geometry::Shape;
use wrasse_spatial::{Pose, SpatialForce, SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_world::{
    AppliedWrench, Bristle, BristleDamping, ContactAccuracy, ContactLaw, CouplingId, Crossing,
    Event, FreeBody, FrictionForce, FrictionLaw, NormalForce, Stepper, SystemId,
    uniform_disc_friction,
};

/// As the files have it.
const SENTENCE: &str = "rows: 1e-6 relative to the largest value in the row set with a good integrator (see \
    agreement); regularised closed forms 1e-9; coulomb entries are limits: regularised approaches them \
    as v_s -> 0 (distance to rest: + m v_s^2 pi^2/(12 mu N)).";

const TOLERANCES: Tolerances = Tolerances {
    sentence: SENTENCE,
    every: Bound { relative: 1e-9, absolute: 0.0 },
    of: &[("rows", Bound { relative: 1e-6, absolute: 0.0 })],
    arrays: &["rows"],
};

/// Why some of it is not compared.
const LEFT_OUT: [(&str, &str); 4] = [
    ("coulomb", "a limit of sharp laws, which no smooth law reaches"),
    ("distance_coulomb", "a limit of sharp laws, which no smooth law reaches"),
    ("time_coulomb", "a limit of sharp laws, which no smooth law reaches"),
    ("elastic_deflection", "one input over another"),
];

/// What presses stands on a spring as soft as this (1/s): the normal motion is none, and bounds no step.
const SOFT: f64 = 1.0;

/// Bristles are some nanometres long, and asked for to 1e-6 of that.
const STEPPER: Stepper = Stepper::Adaptive { tolerance: 1e-16 };

pub(super) struct Friction;

impl Kind for Friction {
    fn takes(&self, kind: &str) -> bool {
        kind.starts_with("friction/")
    }

    fn tolerances(&self) -> &'static Tolerances {
        &TOLERANCES
    }

    fn found(&self, case: &Case) -> Result<Found, Complaint> {
        let value = match case.kind.rsplit('/').next() {
            Some("disc_patch") => {
                let (force, moment) =
                    uniform_disc_friction(case.number("input.speed_over_spin_times_radius")?);
                json!({ "force_over_muN": force, "moment_over_muNR": moment })
            }
            Some("sphere_slips_then_rolls") => rolling(case)?,
            Some("box_on_four_corners") => on_four_corners(case)?,
            Some("block_slides_to_first_stop") => Block::read(case)?.first_stop(),
            _ => Block::read(case)?.found(case),
        };
        Ok(Found { value, left_out: LEFT_OUT.map(|(name, why)| (name.to_owned(), why)).to_vec() })
    }
}

/// The law of the case.
fn friction(case: &Case) -> Result<FrictionLaw, Complaint> {
    let mu = case.number("input.mu")?;
    let bristle = || {
        let damping = BristleDamping::Given(case.number("input.sigma1")?);
        Ok(Bristle { mu, stiffness: case.number("input.sigma0")?, damping })
    };
    match case.text("law")? {
        "regularised" => Ok(FrictionLaw::Tanh { mu, speed: case.number("input.v_s")? }),
        "lugre" => bristle().map(FrictionLaw::LuGre),
        "elasto_plastic" => bristle().map(FrictionLaw::ElastoPlastic),
        other => Err(case.complaint("law", format!("no law is called {other}"))),
    }
}

/// A body pressed on a wall whose normal is n, with this force (N), in equilibrium; the wrench on it at its
/// origin, inertial axes, is that and `more`, a force that depends on the time.
fn press(
    bodies: &mut Bodies,
    id: SystemId,
    pressing: Vec3<f64>,
    more: impl Fn(f64) -> Vec3<f64> + Send + Sync + 'static,
) {
    let course = move |at: wrasse_world::Instant, k: &wrasse_dynamics::Kinematics<'_, f64, 1>| {
        let mut on = PerBody::filled(SpatialForce::zero());
        let R_NB = k.X_NB(wrasse_dynamics::BodyId::Base).rotation;
        let force = R_NB.transpose_mul(pressing + more(at.time));
        on.base = SpatialForce::new(Vec3::zero(), force);
        on
    };
    bodies.scene.apply(id, AppliedWrench::new(Box::new(course), &[]));
}

fn bodies() -> Bodies {
    Bodies::new(STEPPER, ContactAccuracy::Everyday)
}

/// A point on a plane.
struct Block {
    bodies: Bodies,
    id: SystemId,
    contact: CouplingId,
    law: FrictionLaw,
    /// Normal force and load (N).
    forces: (f64, f64),
    /// Twice the time that Coulomb's friction takes to stop it (s).
    longest: f64,
}

impl Block {
    fn read(case: &Case) -> Result<Self, Complaint> {
        let optional = |name: &str| case.number(&format!("input.{name}")).unwrap_or(0.0);
        let (mass, normal) = (case.number("input.mass_kg")?, case.number("input.normal_force")?);
        let (v0, load) = (optional("v0"), optional("load"));
        let pulsates = case.kind.ends_with("pulsating_load_60s");
        let law = friction(case)?;
        let stiffness = mass * SOFT * SOFT;
        let mut bodies = bodies();
        let inertia = Sym3::diagonal(mass, mass, mass);
        let matter = MassProperties::from_central(mass, Vec3::zero(), inertia);
        let X = Pose { translation: vec3(0.0, 0.0, -normal / stiffness), ..Pose::identity() };
        let V = SpatialVelocity::new(Vec3::zero(), vec3(v0, 0.0, 0.0));
        let id = bodies.scene.add_body(&FreeBody::new(matter, &X, &V));
        press(&mut bodies, id, vec3(0.0, 0.0, -normal), move |t| {
            let share = if pulsates { 1.0 - (TAU * t).cos() } else { 1.0 };
            vec3(load * share, 0.0, 0.0)
        });
        let contact_law = ContactLaw {
            normal: NormalForce { stiffness, exponent: 1.0, damping: 0.0 },
            friction: law,
            given_by_A: 0.0,
        };
        let point = (id, Shape::Sphere { radius: 0.0 }, Vec3::zero());
        let contact = bodies.touch_wall(point, (Vec3::zero(), vec3(0.0, 0.0, 1.0)), contact_law);
        let longest = 2.0 * mass * v0 / (case.number("input.mu")? * normal);
        Ok(Self { bodies, id, contact, law, forces: (normal, load), longest })
    }

    fn seen(&self) -> Value {
        let bristle = self.bodies.scene.bristle(self.contact, 0).map_or(f64::NAN, |z| z.x);
        json!({
            "t": self.bodies.scene.time(),
            "position": self.bodies.scene.body(self.id).pose().translation.x,
            "speed": self.bodies.velocity(self.id).x,
            "bristle": bristle,
        })
    }

    fn found(mut self, case: &Case) -> Value {
        let rows = case.rows("rows");
        let rows: Vec<Value> = rows.iter().map(|row| self.at(row["t"].as_f64())).collect();
        let creep = self.steady_creep();
        // What slides to rest is there before three times the last row; loads last for 60 s.
        let last_row = rows.last().and_then(|row| row["t"].as_f64());
        let last = self.at(last_row.map_or(Some(60.0), |t| Some(3.0 * t)));
        json!({
            "rows": rows,
            "distance_to_rest": last["position"],
            "position_at_60_s": last["position"],
            "speed_at_60_s": last["speed"],
            "steady_creep_speed": creep,
        })
    }

    /// What is seen at a time (s); nothing if it cannot be flown to.
    fn at(&mut self, time: Option<f64>) -> Value {
        let flown = time.is_some_and(|t| self.bodies.fly_to(t));
        if flown { self.seen() } else { Value::Null }
    }

    /// The speed (m/s) at which friction bears the load.
    fn steady_creep(&self) -> f64 {
        let FrictionLaw::Tanh { mu, speed } = self.law else { return f64::NAN };
        let law = FrictionForce::Tanh { mu, speed };
        let (normal, load) = self.forces;
        let (mut low, mut high) = (0.0, 100.0 * speed);
        for _ in 0..200 {
            let v = 0.5 * (low + high);
            let (force, _) = law.act(normal, vec3(v, 0.0, 0.0), Vec3::zero());
            if -force.x < load { low = v } else { high = v }
        }
        0.5 * (low + high)
    }

    /// Where and when it stands still first.
    fn first_stop(mut self) -> Value {
        let (id, stop) = (self.id, Arc::new(Mutex::new(None)));
        let stopped = Arc::clone(&stop);
        let contact = self.contact;
        self.bodies.scene.add_event(Event {
            value: Box::new(move |scene| scene.momentum(id).0.x),
            crossing: Crossing::Falling,
            then: Box::new(move |scene| {
                let x = scene.body(id).pose().translation.x;
                let bristle = scene.bristle(contact, 0).map_or(f64::NAN, |z| z.x);
                let at = (scene.time_within_period(), x, bristle);
                stopped.lock().into_iter().for_each(|mut first| {
                    first.get_or_insert(at);
                });
            }),
        });
        let longest = self.longest;
        let flown = self.bodies.fly_to(longest);
        let first = stop.lock().ok().and_then(|first| *first).filter(|_| flown);
        first.map_or(Value::Null, |(time, position, bristle)| {
            json!({
                "first_stop_position": position,
                "first_stop_time": time,
                "bristle_at_stop": bristle,
            })
        })
    }
}

/// A ball that slips until it rolls.
fn rolling(case: &Case) -> Result<Value, Complaint> {
    let of = |name: &str| case.read::<[f64; 3]>(&format!("input.{name}")).map(Vec3::from_array);
    let (mass, radius) = (case.number("input.mass_kg")?, case.number("input.radius_m")?);
    let (lever, normal) =
        (case.number("input.contact_radius_m")?, case.number("input.normal_force")?);
    let (n, v, w) = (of("normal")?, of("velocity")?, of("spin")?);
    let stiffness = mass * SOFT * SOFT;
    let mut bodies = bodies();
    let I = 0.4 * mass * radius * radius;
    let matter = MassProperties::from_central(mass, Vec3::zero(), Sym3::diagonal(I, I, I));
    let start = n * (lever - normal / stiffness);
    let X = Pose { translation: start, ..Pose::identity() };
    let id = bodies.scene.add_body(&FreeBody::new(matter, &X, &SpatialVelocity::new(w, v)));
    press(&mut bodies, id, n * -normal, |_| Vec3::zero());
    let law = ContactLaw {
        normal: NormalForce { stiffness, exponent: 1.0, damping: 0.0 },
        friction: friction(case)?,
        given_by_A: 0.0,
    };
    bodies.touch_wall((id, Shape::Sphere { radius: lever }, Vec3::zero()), (Vec3::zero(), n), law);
    let rows = bodies.fly_rows(case.rows("rows"), |bodies| {
        let body = bodies.scene.body(id);
        json!({
            "t": bodies.scene.time(),
            "velocity": xyz(bodies.velocity(id)),
            "spin": xyz(body.pose().rotation * body.twist().angular),
            "displacement": xyz(body.pose().translation - start),
        })
    });
    Ok(json!({ "rows": rows }))
}

/// A box that slides and turns on its four lower corners.
fn on_four_corners(case: &Case) -> Result<Value, Complaint> {
    let of = |name: &str| case.read::<[f64; 3]>(&format!("input.{name}")).map(Vec3::from_array);
    let (mass, size) = (case.number("input.mass_kg")?, of("size_m")?);
    let (pressing, k) =
        (case.number("input.pressing_force")?, case.number("input.stiffness_per_corner")?);
    let (exponent, damping) = (case.number("input.exponent")?, case.number("input.damping_c")?);
    let [a, b, c] = size.map(|edge| edge * edge * mass / 12.0).to_array();
    let mut bodies = bodies();
    let matter =
        MassProperties::from_central(mass, Vec3::zero(), Sym3::diagonal(b + c, a + c, a + b));
    let depth = (pressing / 4.0 / k).powf(1.0 / exponent);
    let X = Pose { translation: vec3(0.0, 0.0, 0.5 * size.z - depth), ..Pose::identity() };
    let V = SpatialVelocity::new(of("angular_velocity")?, of("velocity")?);
    let id = bodies.scene.add_body(&FreeBody::new(matter, &X, &V));
    press(&mut bodies, id, vec3(0.0, 0.0, -pressing), |_| Vec3::zero());
    let law = ContactLaw {
        normal: NormalForce { stiffness: k, exponent, damping },
        friction: friction(case)?,
        given_by_A: 0.0,
    };
    for (x, y) in [(-0.5, -0.5), (-0.5, 0.5), (0.5, -0.5), (0.5, 0.5)] {
        let corner = vec3(x * size.x, y * size.y, -0.5 * size.z);
        let wall = (Vec3::zero(), vec3(0.0, 0.0, 1.0));
        bodies.touch_wall((id, Shape::Sphere { radius: 0.0 }, corner), wall, law);
    }
    let rows = bodies.fly_rows(case.rows("rows"), |bodies| {
        let body = bodies.scene.body(id);
        let mut value = pose_value(&body.pose());
        value["t"] = json!(bodies.scene.time());
        value["angular"] = xyz(body.twist().angular);
        value["linear_inertial"] = xyz(bodies.velocity(id));
        value
    });
    Ok(json!({ "rows": rows }))
}
