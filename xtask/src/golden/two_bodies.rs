//! A servicer and a free target on a bushing between tool and fixture: files `two_bodies_…`.

use super::comparison::{Bound, Found, Tolerances};
use super::file::{Case, Complaint};
use super::kind::Kind;
use super::product::vehicle;
use super::state::{motion, parts, pose, pose_value, twist, xyz};
use serde_json::{Map, Value, json};
use wrasse_dynamics::{BodyId, Frame, MassProperties, kinetic_energy};
use wrasse_hardware::{ActuatorCommand, SetPointMotion};
use wrasse_spatial::{Quat, Sym3, Vec3};
use wrasse_vehicle::{JOINTS, Vehicle};
use wrasse_world::{
    BaseAttitude, Bushing, Drive, Equipment, FrameMotion, FreeBody, Scene, Source, Stepper,
    SystemId, SystemSetup,
};

/// How the motion is integrated: far below what is asked of it.
const STEPPER: Stepper = Stepper::Adaptive { tolerance: 1e-11 };

const TOLERANCES: Tolerances = Tolerances {
    sentence: "positions 1e-7 m, angles 1e-6 rad, velocities 1e-6 (see the deviation of MuJoCo per \
               case for what a second integrator gives); momentum to 1e-12 relative for a \
               momentum-preserving world; energy books (kinetic + elastic + dissipated) 1e-9.",
    every: Bound { relative: 0.0, absolute: 1e-6 },
    of: &[
        ("momentum", Bound { relative: 1e-12, absolute: 0.0 }),
        ("position", Bound { relative: 0.0, absolute: 1e-7 }),
        ("deflection_E", Bound { relative: 0.0, absolute: 1e-7 }),
        // A force is off by the stiffness times what a deflection is, and the damping times what a
        // velocity is.
        ("force_on_fixture_N", Bound { relative: 0.0, absolute: 1e-2 }),
        ("torque_on_fixture_N", Bound { relative: 0.0, absolute: 1e-2 }),
        ("energy_at_start", Bound { relative: 1e-9, absolute: 0.0 }),
    ],
    arrays: &[],
};

pub(super) struct TwoBodies;

impl Kind for TwoBodies {
    fn takes(&self, kind: &str) -> bool {
        kind == "two_bodies"
    }

    fn tolerances(&self) -> &'static Tolerances {
        &TOLERANCES
    }

    fn found(&self, case: &Case) -> Result<Found, Complaint> {
        let vehicle = vehicle(case, case.text("input.vehicle")?)?;
        let mut pair = Pair::read(case, &vehicle)?;
        let rows = case.rows("rows");
        let (linear, angular) = pair.momentum();
        let energy_at_start = pair.kinetic_energy() + pair.stored_energy();
        let rows: Vec<Value> = rows.iter().map(|row| pair.row(&row["t"])).collect();
        let value = json!({
            "momentum": { "linear": xyz(linear), "angular_about_N_origin": xyz(angular) },
            "energy_at_start": energy_at_start,
            "rows": rows,
        });
        let why = "how far another engine was, not a result";
        Ok(Found { value, left_out: vec![("deviation_of_MuJoCo".to_owned(), why)] })
    }
}

/// The two systems, coupled.
struct Pair<'a> {
    vehicle: &'a Vehicle,
    scene: Scene<JOINTS>,
    servicer: SystemId,
    target: SystemId,
    tool: Frame<f64>,
    fixture: Frame<f64>,
    bushing: Bushing,
    /// Energy of the bushing at the start (J).
    stored_at_start: f64,
}

impl<'a> Pair<'a> {
    fn read(case: &Case, vehicle: &'a Vehicle) -> Result<Self, Complaint> {
        let frame = case.text("input.frame")?;
        let tool = vehicle.frame(frame).ok_or_else(|| {
            case.complaint("input.frame", format!("the vehicle has no frame {frame}"))
        })?;
        let state = motion(case, "input.state", vehicle)?.state;
        let (X_NT, V_NT_T) =
            (pose(case, "input.target_pose")?, twist(case, "input.target_velocity")?);
        let mut scene = Scene::new(STEPPER);
        let servicer = scene.add(&SystemSetup {
            robot: &vehicle.robot,
            limits: &[],
            actuator: None,
            equipment: Equipment::default(),
            base: BaseAttitude::Free,
            start: state,
            held: &[],
        });
        let target = scene.add_body(&FreeBody::new(matter(case)?, &X_NT, &V_NT_T));
        let fixture = Frame { body: BodyId::Base, X_BF: pose(case, "input.target.fixture")? };
        let bushing = bushing(case)?;
        scene.couple((servicer, tool), (target, fixture), Box::new(bushing));
        if case.text("input.joints")?.starts_with("locked") {
            let drives = state.q.map(|q| Drive::Follow(SetPointMotion::still(q)));
            let told = ActuatorCommand::default();
            scene.begin_period();
            scene.command(servicer, (&drives, Vec3::zero()), &told, 1.0, &mut vec![]);
        }
        let stored_at_start = 0.0;
        let mut pair =
            Self { vehicle, scene, servicer, target, tool, fixture, bushing, stored_at_start };
        pair.stored_at_start = pair.stored_energy();
        Ok(pair)
    }

    /// Momentum of both: linear, and angular about the origin of N.
    fn momentum(&self) -> (Vec3<f64>, Vec3<f64>) {
        let account = self.scene.account();
        (account.linear, account.angular)
    }

    fn kinetic_energy(&self) -> f64 {
        let energy = |id| self.scene.with_kinematics(id, kinetic_energy);
        energy(self.servicer) + energy(self.target)
    }

    fn frames(&self) -> [FrameMotion; 2] {
        let motion = |id, frame: &Frame<f64>| {
            self.scene.with_kinematics(id, |k| FrameMotion {
                X_NF: k.pose(frame),
                V_NF_N: k.velocity(frame),
            })
        };
        [motion(self.servicer, &self.tool), motion(self.target, &self.fixture)]
    }

    fn stored_energy(&self) -> f64 {
        let [E, F] = self.frames();
        self.bushing.energy(&E, &F)
    }

    /// All that the file asks at a time. One that is missing, lies in the past, or ends in a breakdown
    /// meets no tolerance.
    fn row(&mut self, at: &Value) -> Value {
        let ahead = at.as_f64().unwrap_or(f64::NAN) - self.scene.time();
        let flown = ahead >= 0.0 && self.scene.advance(ahead).is_ok();
        let time = if flown { self.scene.time() } else { f64::NAN };
        let (state, target) = (self.scene.state(self.servicer), self.scene.body(self.target));
        let (V_NB_B, V_NT_T) = (state.V_NB_B, target.twist());
        let [E, F] = self.frames();
        let R_EN = E.X_NF.rotation.transpose();
        let on_F = self.bushing.wrench(&E, &F);
        let (kinetic, elastic) = (self.kinetic_energy(), self.stored_energy());
        // What is gone from both: the work of the bushing that it has not stored.
        let work = self.scene.booked()[Source::Couplings].work;
        let named = self.vehicle.joint_names.iter().enumerate();
        let joints: Map<String, Value> = named
            .map(|(j, name)| {
                (name.clone(), json!({ "position": state.q[j], "velocity": state.v[j] }))
            })
            .collect();
        json!({
            "t": time,
            "base": pose_value(&state.X_NB),
            "base_velocity": parts(V_NB_B.angular, V_NB_B.linear),
            "joints": joints,
            "target_pose": pose_value(&target.pose()),
            "target_velocity": parts(V_NT_T.angular, V_NT_T.linear),
            "grapple": {
                "deflection_E": xyz(R_EN * (F.X_NF.translation - E.X_NF.translation)),
                "rotation_E": xyz(Quat::from_matrix(&(R_EN * F.X_NF.rotation)).log()),
                "force_on_fixture_N": xyz(on_F.force),
                "torque_on_fixture_N": xyz(on_F.torque),
            },
            "kinetic_energy": kinetic,
            "elastic_energy": elastic,
            "dissipated": -work - (elastic - self.stored_at_start),
        })
    }
}

fn matter(case: &Case) -> Result<MassProperties<f64>, Complaint> {
    let target = "input.target";
    let [x, y, z]: [[f64; 3]; 3] = case.read(&format!("{target}.inertia_kgm2"))?;
    let inertia = Sym3 { xx: x[0], xy: x[1], xz: x[2], yy: y[1], yz: y[2], zz: z[2] };
    let centre = Vec3::from_array(case.read(&format!("{target}.centre_of_mass_m"))?);
    Ok(MassProperties::from_central(case.number(&format!("{target}.mass_kg"))?, centre, inertia))
}

fn bushing(case: &Case) -> Result<Bushing, Complaint> {
    let of = |name: &str| case.read(&format!("input.bushing.{name}")).map(Vec3::from_array);
    Ok(Bushing {
        stiffness: of("stiffness_translation")?,
        damping: of("damping_translation")?,
        turning_stiffness: of("stiffness_rotation")?,
        turning_damping: of("damping_rotation")?,
    })
}
