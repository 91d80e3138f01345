//! The numbers of a case that can be dispersed: their names, units, and how far they may go.

use wrasse_dynamics::{JointKind, State};
use wrasse_hardware::Sensors;
use wrasse_rehearsal::Target;
use wrasse_rehearsal::{PayloadCase, PayloadStart};
use wrasse_spatial::{Pose, Vec3};
use wrasse_vehicle::{JOINTS, Vehicle};
use wrasse_world::BaseAttitude;

/// A number that can be dispersed.
#[derive(Debug, Clone)]
pub(crate) struct Dispersible {
    /// Its name, with axis or joint and unit.
    pub(crate) name: String,
    pub(crate) target: Target,
    /// The value of the files, in the unit of the name: of a share of itself a hundred percent, of a turn
    /// from there nothing.
    pub(crate) nominal: f64,
    /// The unit of the name.
    pub(crate) unit: &'static str,
    /// What that unit is in SI.
    pub(crate) scale: f64,
    /// Least and largest deviation that leave it possible, in the unit of the name; and why.
    pub(crate) room: (f64, f64),
    pub(crate) why: String,
}

/// What is known of a case when its dispersions are read.
pub(crate) struct Nominal<'a> {
    vehicle: &'a Vehicle,
    start: &'a State<f64, JOINTS>,
    payloads: &'a [PayloadCase],
    /// As they are fitted: what is drawn of them changes nothing where they are not used.
    sensors: &'a Sensors<f64>,
    base: BaseAttitude,
}

/// How the names are made up, for those who look for one.
pub(crate) const FORMS: &str = "body.LINK or payload.NAME with .mass_kg, .centre_of_mass_m or \
    .inertia_percent; payload.NAME (if free) with .position_m, .rotation_deg, .velocity_m_s or \
    .angular_velocity_deg_s; initial with these four or .joints_deg, .joints_m, .joint_rates_deg_s, \
    .joint_rates_m_s; sensors.gyro.bias_deg_h, sensors.gyro.noise_percent, \
    sensors.star_tracker.noise_percent, sensors.encoder_step_percent. Behind them .x, .y, .z or the name \
    of a joint, or nothing: each of them alike";

const DEGREES: f64 = std::f64::consts::PI / 180.0;
const METRES: (&str, f64) = ("m", 1.0);
const METRES_S: (&str, f64) = ("m/s", 1.0);
const DEG: (&str, f64) = ("deg", DEGREES);
const DEG_S: (&str, f64) = ("deg/s", DEGREES);
const ANYWHERE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
/// Least deviation of something in percent of itself: what is left is above zero.
const PERCENT: (f64, f64) = (-100.0 * NEARLY, f64::INFINITY);
/// A little less than one: what is taken away leaves something.
const NEARLY: f64 = 1.0 - 1e-9;

impl<'a> Nominal<'a> {
    /// A case with this vehicle, start and what becomes of its base, payloads and fitted sensors.
    pub(crate) fn of(
        vehicle: &'a Vehicle,
        (start, base): (&'a State<f64, JOINTS>, BaseAttitude),
        payloads: &'a [PayloadCase],
        sensors: &'a Sensors<f64>,
    ) -> Self {
        Self { vehicle, start, payloads, sensors, base }
    }

    /// All numbers of the case that can be dispersed.
    pub(crate) fn dispersible(&self) -> Vec<Dispersible> {
        let mut all = vec![];
        self.bodies(&mut all);
        self.payloads(&mut all);
        self.base(&mut all);
        self.joints(&mut all);
        self.sensors(&mut all);
        all
    }

    /// The rigid bodies, by every link or frame whose axes are those of the body.
    fn bodies(&self, all: &mut Vec<Dispersible>) {
        let own = |frame: &&wrasse_vehicle::NamedFrame| frame.frame.X_BF == Pose::identity();
        for named in self.vehicle.frames.iter().filter(own) {
            let body = named.frame.body;
            let mass = self.vehicle.robot.inertia(body).mass;
            // Of a body without mass there is nothing to deviate from.
            if mass <= 0.0 {
                continue;
            }
            let name = format!("body.{}", named.name);
            matter(all, &name, mass, Target::BodyMass(body), Target::BodyInertia(body));
            let centre = self.vehicle.robot.inertia(body).centre_of_mass();
            along_axes(all, &format!("{name}.centre_of_mass_m"), METRES, centre, |i| {
                Target::BodyCentre(body, i)
            });
        }
    }

    fn payloads(&self, all: &mut Vec<Dispersible>) {
        for (i, payload) in self.payloads.iter().enumerate() {
            let name = format!("payload.{}", payload.name);
            let mass = payload.matter.M_F_F.mass;
            matter(all, &name, mass, Target::PayloadMass(i), Target::PayloadInertia(i));
            let mut add = |key: &str, unit, nominal, target: fn(usize, usize) -> Target| {
                along_axes(all, &format!("{name}.{key}"), unit, nominal, |axis| target(i, axis));
            };
            let centre = payload.matter.M_F_F.centre_of_mass();
            add("centre_of_mass_m", METRES, centre, Target::PayloadCentre);
            if let PayloadStart::Free(X_NT, V_NT_T) = &payload.start {
                let (w_N, v_N) = (X_NT.rotation * V_NT_T.angular, X_NT.rotation * V_NT_T.linear);
                add("position_m", METRES, X_NT.translation, Target::PayloadPosition);
                add("rotation_deg", DEG, Vec3::zero(), Target::PayloadRotation);
                add("velocity_m_s", METRES_S, v_N, Target::PayloadVelocity);
                add("angular_velocity_deg_s", DEG_S, w_N, Target::PayloadTurn);
            }
        }
    }

    fn base(&self, all: &mut Vec<Dispersible>) {
        let (p, V) = (self.start.X_NB.translation, self.start.V_NB_B);
        along_axes(all, "initial.position_m", METRES, p, Target::Position);
        along_axes(all, "initial.rotation_deg", DEG, Vec3::zero(), Target::Rotation);
        along_axes(all, "initial.velocity_m_s", METRES_S, V.linear, Target::Velocity);
        along_axes(all, "initial.angular_velocity_deg_s", DEG_S, V.angular, Target::Turn);
        if self.base == BaseAttitude::Held {
            for held in all.iter_mut().filter(|d| matches!(d.target, Target::Turn(_))) {
                (held.room, held.why) = ((0.0, 0.0), "a base that is held does not turn".into());
            }
        }
    }

    fn joints(&self, all: &mut Vec<Dispersible>) {
        let vehicle = self.vehicle;
        // A joint that follows another deviates as that one does.
        let follows = |j| vehicle.followers.iter().any(|follower| follower.joint == j);
        let own = vehicle.joint_names.iter().enumerate().filter(|(j, _)| !follows(*j));
        for (j, name) in own {
            let turns = vehicle.robot.joint(j).kind == JointKind::Revolute;
            let (keys, units, scale) = if turns {
                (["joints_deg", "joint_rates_deg_s"], ["deg", "deg/s"], DEGREES)
            } else {
                (["joints_m", "joint_rates_m_s"], ["m", "m/s"], 1.0)
            };
            let (room, why) = match vehicle.limits[j].travel {
                None => (ANYWHERE, String::new()),
                Some((lower, upper)) => {
                    let left = |end: f64| (end - self.start.q[j]) / scale;
                    let why = "the joint starts within its travel".into();
                    ((left(lower).min(0.0), left(upper).max(0.0)), why)
                }
            };
            let [position, rate] = keys.map(|key| format!("initial.{key}.{name}"));
            let (q, v) = (self.start.q[j] / scale, self.start.v[j] / scale);
            all.push(Dispersible {
                name: position,
                target: Target::Joint(j),
                nominal: q,
                unit: units[0],
                scale,
                room,
                why,
            });
            all.push(Dispersible {
                name: rate,
                target: Target::JointRate(j),
                nominal: v,
                unit: units[1],
                scale,
                room: ANYWHERE,
                why: String::new(),
            });
        }
    }

    fn sensors(&self, all: &mut Vec<Dispersible>) {
        let sensors = self.sensors;
        let mut share = |name: &str, target| {
            all.push(of_itself(name.into(), target, "less than nothing cannot be left"));
        };
        if sensors.encoder_step > 0.0 {
            share("sensors.encoder_step_percent", Target::EncoderStep);
        }
        if let Some((gyro, _)) = &sensors.attitude {
            share("sensors.gyro.noise_percent", Target::GyroNoise);
            share("sensors.star_tracker.noise_percent", Target::TrackerNoise);
            let unit = ("deg/h", DEGREES / 3600.0);
            along_axes(all, "sensors.gyro.bias_deg_h", unit, gyro.bias_B, Target::GyroBias);
        }
    }
}

/// Something in percent of itself.
fn of_itself(name: String, target: Target, why: &str) -> Dispersible {
    let (nominal, unit, scale, room) = (100.0, "%", 0.01, PERCENT);
    Dispersible { name, target, nominal, unit, scale, room, why: why.into() }
}

/// Mass and inertia of a body.
fn matter(all: &mut Vec<Dispersible>, name: &str, mass: f64, of_mass: Target, of_inertia: Target) {
    all.push(Dispersible {
        name: format!("{name}.mass_kg"),
        target: of_mass,
        nominal: mass,
        unit: "kg",
        scale: 1.0,
        room: (-mass * NEARLY, f64::INFINITY),
        why: format!("a mass stays above zero, and this one is {mass} kg"),
    });
    let name = format!("{name}.inertia_percent");
    all.push(of_itself(name, of_inertia, "an inertia stays above zero"));
}

/// One for each axis, of a vector in SI.
fn along_axes(
    all: &mut Vec<Dispersible>,
    name: &str,
    (unit, scale): (&'static str, f64),
    nominal: Vec3<f64>,
    target: impl Fn(usize) -> Target,
) {
    for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
        all.push(Dispersible {
            name: format!("{name}.{axis}"),
            target: target(i),
            nominal: nominal.to_array()[i] / scale,
            unit,
            scale,
            room: ANYWHERE,
            why: String::new(),
        });
    }
}
