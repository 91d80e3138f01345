//! Plastic capture of a free target: files `capture_…`.

use super::comparison::{Bound, Found, Tolerances};
use super::file::{Case, Complaint};
use super::kind::Kind;
use super::product::vehicle;
use super::state::{Motion, motion, parts, pose, pose_value, twist, xyz};
use serde_json::{Map, Value, json};
use wrasse_dynamics::{
    BodyId, Frame, MassProperties, State, base_rows, kinematics, kinetic_energy,
};
use wrasse_hardware::{ActuatorCommand, SetPoint, SetPointMotion};
use wrasse_spatial::{SpatialForce, Sym3, Vec3};
use wrasse_vehicle::{JOINTS, Vehicle};
use wrasse_world::{BaseAttitude, Drive, Equipment, FreeBody, GripOffset, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// States may be off by this where a motion was integrated.
const MOTION: Bound = Bound { relative: 1e-8, absolute: 1e-12 };

const TOLERANCES: Tolerances = Tolerances {
    sentence: "1e-9 relative to the largest element of each array (the routes agree to 1e-11, \
               condition of M about 1e5); locked_motion 1e-8.",
    // The floor is that of the contract, for what is zero but for rounding.
    every: Bound { relative: 1e-9, absolute: 1e-12 },
    of: &[("locked_motion_after_joints_free_base_free", MOTION)],
    arrays: &["joint_rates", "holding_impulse_at_joints", "least_joint_rates_that_stop_the_base"],
};

/// Why some of it is not compared.
const LEFT_OUT: [(&str, &str); 3] = [
    ("holding_impulse_at_joints", "the world does not tell it"),
    ("least_joint_rates_that_stop_the_base", "no law of the product gives them"),
    ("energy_loss_of_impact", "joints that keep their rates do work in the impact"),
];
/// Why a mode is not compared: the file means an attitude that keeps its rate.
const TURNS: &str = "the world holds an attitude at rest only";

/// A grasp takes what it finds, wherever it is and however it moves.
const ANY_GRIP: GripOffset = GripOffset {
    distance: f64::INFINITY,
    angle: f64::INFINITY,
    angular_speed: f64::INFINITY,
    linear_speed: f64::INFINITY,
};

/// The four modes of an impact, and the motion of the vehicle with locked joints afterwards.
pub(super) struct Capture;

impl Kind for Capture {
    fn takes(&self, kind: &str) -> bool {
        kind == "capture"
    }

    fn tolerances(&self) -> &'static Tolerances {
        &TOLERANCES
    }

    fn found(&self, case: &Case) -> Result<Found, Complaint> {
        let vehicle = vehicle(case, case.text("input.vehicle")?)?;
        let scene = Scene::read(case, &vehicle)?;
        let (mut modes, mut left_out) = (Map::new(), LEFT_OUT.map(owned).to_vec());
        for name in case.expect["modes"].as_object().into_iter().flat_map(Map::keys) {
            let mode = mode(name).ok_or_else(|| {
                case.complaint(&format!("expect.modes.{name}"), "the world has no such mode")
            })?;
            let turns = scene.motion.state.V_NB_B.angular.norm() > 0.0;
            if mode.base == BaseAttitude::Held && turns {
                left_out.push((name.clone(), TURNS));
            } else {
                modes.insert(name.clone(), scene.mode(mode));
            }
        }
        let free = Mode { base: BaseAttitude::Free, joints_keep_rates: false };
        let value = json!({
            "modes": modes,
            "locked_motion_after_joints_free_base_free": scene.locked_motion(case, free),
        });
        Ok(Found { value, left_out })
    }
}

fn owned((name, why): (&str, &'static str)) -> (String, &'static str) {
    (name.to_owned(), why)
}

/// What holds during the impact.
#[derive(Clone, Copy)]
struct Mode {
    base: BaseAttitude,
    joints_keep_rates: bool,
}

/// A mode by the words of the file.
fn mode(name: &str) -> Option<Mode> {
    let (joints, base) = name.split_once("_base_")?;
    let joints_keep_rates = match joints {
        "joints_free" => false,
        "joints_rates_kept" => true,
        _ => return None,
    };
    let base = match base {
        "free" => BaseAttitude::Free,
        "attitude_held" => BaseAttitude::Held,
        _ => return None,
    };
    Some(Mode { base, joints_keep_rates })
}

/// A vehicle and a target beside it.
struct Scene<'a> {
    vehicle: &'a Vehicle,
    tool: Frame<f64>,
    motion: Motion,
    target: FreeBody,
}

impl<'a> Scene<'a> {
    fn read(case: &Case, vehicle: &'a Vehicle) -> Result<Self, Complaint> {
        let frame = case.text("input.frame")?;
        let tool = vehicle.frame(frame).ok_or_else(|| {
            case.complaint("input.frame", format!("the vehicle has no frame {frame}"))
        })?;
        let target = "input.target";
        let [x, y, z]: [[f64; 3]; 3] = case.read(&format!("{target}.inertia_kgm2"))?;
        let inertia = Sym3 { xx: x[0], xy: x[1], xz: x[2], yy: y[1], yz: y[2], zz: z[2] };
        let centre = Vec3::from_array(case.read(&format!("{target}.centre_of_mass_m"))?);
        let mass = case.number(&format!("{target}.mass_kg"))?;
        let matter = MassProperties::from_central(mass, centre, inertia);
        let (X_NT, V_NT_T) =
            (pose(case, "input.target_pose")?, twist(case, "input.target_velocity")?);
        let motion = motion(case, "input.state", vehicle)?;
        Ok(Self { vehicle, tool, motion, target: FreeBody::new(matter, &X_NT, &V_NT_T) })
    }

    fn world(
        &self,
        base: BaseAttitude,
        start: &State<f64, JOINTS>,
        held: &[(Frame<f64>, MassProperties<f64>)],
    ) -> OneSystem<JOINTS> {
        OneSystem::new(&OneSystemSetup {
            robot: &self.vehicle.robot,
            limits: &[],
            actuator: None,
            equipment: Equipment::default(),
            base,
            stepper: Stepper::Adaptive { tolerance: 1e-13 },
            start: *start,
            held,
        })
    }

    /// The world just after the capture, and the change of energy (J).
    fn captured(&self, mode: Mode) -> (OneSystem<JOINTS>, f64) {
        let start = self.motion.state;
        let mut world = self.world(mode.base, &start, &[]);
        if mode.joints_keep_rates {
            let keeps = |j: usize| {
                let at = |t: f64| SetPoint {
                    position: start.q[j] + start.v[j] * t,
                    rate: start.v[j],
                    acceleration: 0.0,
                };
                Drive::Follow(SetPointMotion::between(at(0.0), at(1.0), 1.0))
            };
            command(&mut world, &std::array::from_fn(keeps), 1.0);
        }
        let number = world.add_body(&self.target);
        let change = world.grasp(&self.tool, number, &ANY_GRIP);
        (world, change.unwrap_or(f64::NAN))
    }

    /// All that the file asks of a mode.
    fn mode(&self, mode: Mode) -> Value {
        let (mut world, change) = self.captured(mode);
        let (before, after) = (self.motion.state, world.state());
        let p_NScm_N = world.centre_of_mass(world.id);
        let (linear, about_origin) = world.momentum(world.id);
        let angular = about_origin - p_NScm_N.cross(linear);
        let energy = kinetic_energy(&kinematics(world.robot(), &after));
        let holding_B = -world.stored_momentum_B();
        let mut locked = self.locked(&world);
        let locked_value = locked_value(&locked);
        let (target, target_locked) = (released(&mut world), released(&mut locked));
        let shares =
            |state: &State<f64, JOINTS>, target: &FreeBody| self.shares(state, target, p_NScm_N);
        let k = kinematics(&self.vehicle.robot, &before);
        let given = about(&self.target, target.p_NTcm_N) - about(&target, target.p_NTcm_N);
        let at_tool = given.about(k.pose(&self.tool).translation - target.p_NTcm_N);
        let V_NT_T = target.twist();
        let mut found = json!({
            "impulse_on_vehicle_at_tool": parts(at_tool.torque, at_tool.force),
            "vehicle_after": {
                "base_velocity": parts(after.V_NB_B.angular, after.V_NB_B.linear),
                "joint_rates": self.by_name(&after.v),
            },
            "target_after": parts(V_NT_T.angular, V_NT_T.linear),
            "kinetic_energy_before": kinetic_energy(&k) + self.target.kinetic_energy(),
            "kinetic_energy_after": energy,
            "holding_impulse_on_base": { "angular": xyz(holding_B) },
            "total_momentum_after": {
                "angular_about_common_centre_of_mass": xyz(angular),
                "linear": xyz(linear),
            },
            "common_centre_of_mass": xyz(p_NScm_N),
            "angular_momentum_shares": {
                "before": shares(&before, &self.target),
                "after": shares(&after, &target),
                "locked": shares(&locked.state(), &target_locked),
            },
            "all_joints_locked": locked_value,
        });
        let at_rest = before.v.iter().all(|v| *v == 0.0);
        if !mode.joints_keep_rates || at_rest {
            found["energy_loss_of_impact"] = json!(-change);
        }
        found
    }

    fn by_name(&self, joints: &[f64; JOINTS]) -> Map<String, Value> {
        let named = self.vehicle.joint_names.iter().zip(joints);
        named.map(|(name, x)| (name.clone(), json!(x))).collect()
    }

    /// Angular momentum of base, arm and target about a point, inertial axes, body by body.
    fn shares(&self, state: &State<f64, JOINTS>, target: &FreeBody, point_N: Vec3<f64>) -> Value {
        let robot = &self.vehicle.robot;
        let k = kinematics(robot, state);
        let of = |body: BodyId| {
            let (X_NB, h_B) = (k.X_NB(body), *robot.inertia(body) * k.V_NB_B(body));
            let h_N = SpatialForce::new(X_NB.rotation * h_B.torque, X_NB.rotation * h_B.force);
            h_N.about(point_N - X_NB.translation).torque
        };
        let base = of(BodyId::Base);
        let arm = robot.joints().fold(Vec3::zero(), |sum, j| sum + of(BodyId::Link(j)));
        let target = about(target, point_N).torque;
        json!({
            "base": xyz(base),
            "arm": xyz(arm),
            "target": xyz(target),
            "total": xyz(base + arm + target),
        })
    }

    /// The same vehicle with its joints locked from now on, and free to turn.
    fn locked(&self, captured: &OneSystem<JOINTS>) -> OneSystem<JOINTS> {
        let start = captured.state();
        let held: Vec<_> = captured.held().iter().map(|(_, h)| (h.frame, h.matter)).collect();
        let mut world = self.world(BaseAttitude::Free, &start, &held);
        let drives = start.q.map(|position| Drive::Follow(SetPointMotion::still(position)));
        // The momentum is that of the start, rates of the joints included; from now on they stand.
        command(&mut world, &drives, 1.0);
        world
    }

    /// The vehicle with its joints locked after the capture, at the times that the file names.
    fn locked_motion(&self, case: &Case, mode: Mode) -> Value {
        let rows = case.expect["locked_motion_after_joints_free_base_free"].as_array();
        let mut world = self.locked(&self.captured(mode).0);
        let row = |row: &Value| {
            // A time that is missing, lies in the past, or ends in a breakdown meets no tolerance.
            let ahead = row["t"].as_f64().unwrap_or(f64::NAN) - world.time();
            let flown = ahead >= 0.0 && world.advance(ahead).is_ok();
            let (time, state) = (if flown { world.time() } else { f64::NAN }, world.state());
            json!({
                "t": time,
                "base": pose_value(&state.X_NB),
                "base_velocity": parts(state.V_NB_B.angular, state.V_NB_B.linear),
            })
        };
        rows.into_iter().flatten().map(row).collect()
    }
}

/// Momentum of a body about a point, inertial axes.
fn about(body: &FreeBody, point_N: Vec3<f64>) -> SpatialForce<f64> {
    SpatialForce::new(body.angular, body.linear).about(point_N - body.p_NTcm_N)
}

fn command(world: &mut OneSystem<JOINTS>, drives: &[Drive; JOINTS], period: f64) {
    world.command(drives, Vec3::zero(), &ActuatorCommand::default(), period);
}

/// The target as it goes on if it is let go at once.
fn released(world: &mut OneSystem<JOINTS>) -> FreeBody {
    let number = world.release(0);
    world.body(number)
}

/// What the file says of the vehicle once its joints are locked.
fn locked_value(world: &OneSystem<JOINTS>) -> Value {
    let (state, robot) = (world.state(), world.robot());
    let (R_NB, k) = (state.X_NB.rotation, kinematics(robot, &state));
    let I_N = base_rows(&k).M_bb.in_axes(&R_NB).central();
    let inertia = [[I_N.xx, I_N.xy, I_N.xz], [I_N.xy, I_N.yy, I_N.yz], [I_N.xz, I_N.yz, I_N.zz]];
    json!({
        "base_velocity": parts(state.V_NB_B.angular, state.V_NB_B.linear),
        "spin_inertial": xyz(R_NB * state.V_NB_B.angular),
        "kinetic_energy": kinetic_energy(&k),
        "inertia_about_common_centre_of_mass": inertia,
        "velocity_of_common_centre_of_mass": xyz(world.momentum(world.id).0 * (1.0 / robot.mass())),
    })
}
