//! The demand of a task by hand, from the numbers of its file alone: what the simulation finds has to
//! come near it.

use crate::outcome::HandCheck;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use wrasse_dynamics::{BodyId, Frame, Kinematics, MassProperties, State, kinematics};
use wrasse_hardware::Tank;
use wrasse_spatial::{Pose, Sym3, Vec3};
use wrasse_vehicle::{JOINTS, Vehicle, VehicleRobot};

/// What a mission file says of the load, the motion and the push. The rest is not read.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(crate) struct TaskFile {
    payload: BTreeMap<String, LoadFile>,
    world: PushFile,
    phase: Vec<PhaseFile>,
    initial: InitialFile,
    control: ControlFile,
}

#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(default)]
struct InitialFile {
    attitude: Option<TurnFile>,
}

/// The vector part of a quaternion: zero where nothing is turned.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(default)]
struct TurnFile {
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(default)]
struct ControlFile {
    tool: Option<String>,
}

#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(default)]
struct LoadFile {
    mass_kg: f64,
    centre_of_mass_m: [f64; 3],
    held_by: Option<String>,
}

#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(default)]
struct PushFile {
    applied_wrench: Vec<WrenchFile>,
}

#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(default)]
struct WrenchFile {
    on: String,
    axes: Option<String>,
    from_s: f64,
    duration_s: f64,
    ramp_s: f64,
    force_n: [f64; 3],
    torque_nm: [f64; 3],
}

#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(default)]
struct PhaseFile {
    move_tool: Option<MoveFile>,
    move_joints: Option<OtherFile>,
    unload_by_posture: Option<OtherFile>,
    grasp: Option<OtherFile>,
    release: Option<OtherFile>,
}

/// Something that is done, whatever it is in detail.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
struct OtherFile {}

#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(default)]
struct MoveFile {
    by_m: Option<[f64; 3]>,
    axes: Option<String>,
    duration_s: Option<f64>,
    limits: Option<LimitsFile>,
}

#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(default)]
struct LimitsFile {
    shape: String,
    speed_m_s: f64,
    acceleration_m_s2: f64,
    jerk_m_s3: f64,
}

/// The vehicle at the start of a task, with what is in its tank and without its load.
pub(crate) struct Start<'a> {
    vehicle: &'a Vehicle,
    robot: VehicleRobot,
    state: State<f64, JOINTS>,
}

impl<'a> Start<'a> {
    pub(crate) fn new(
        vehicle: &'a Vehicle,
        tank: Option<Tank<f64>>,
        state: &State<f64, JOINTS>,
    ) -> Self {
        let mut robot = vehicle.robot;
        if let Some(tank) = tank {
            let base = Frame { body: BodyId::Base, X_BF: Pose::identity() };
            let matter =
                MassProperties::from_central(tank.propellant, tank.position_B, Sym3::zero());
            robot = robot.with_payload(&base, &matter);
        }
        Self { vehicle, robot, state: *state }
    }
}

/// Peak speed (m/s) and acceleration (m/s²) of a motion, and how they are found.
struct Pace {
    speed: f64,
    acceleration: f64,
    how: String,
}

impl TaskFile {
    /// Whether figures in these axes are turned against those of the base, in which a hand reckons.
    fn is_turned(&self, axes: Option<&str>) -> bool {
        let turned = |turn: &TurnFile| [turn.x, turn.y, turn.z].iter().any(|part| *part != 0.0);
        axes != Some("base") && self.initial.attitude.as_ref().is_some_and(turned)
    }
    /// The first straight line, if load and posture are those of the start until then.
    fn first_line(&self) -> Option<&MoveFile> {
        let at = self.phase.iter().position(|phase| phase.move_tool.is_some())?;
        let before = self.phase[..at].iter();
        let same = before.clone().all(|phase| !phase.moves() && !phase.changes_the_load());
        self.phase[at].move_tool.as_ref().filter(|_| same)
    }
}

impl PhaseFile {
    fn moves(&self) -> bool {
        self.move_joints.is_some() || self.unload_by_posture.is_some()
    }
    fn changes_the_load(&self) -> bool {
        self.grasp.is_some() || self.release.is_some()
    }
}

impl Start<'_> {
    fn tool(
        &self,
        k: &Kinematics<'_, f64, JOINTS>,
        name: Option<&str>,
    ) -> Option<wrasse_spatial::Pose<f64>> {
        let name = name.or_else(|| self.vehicle.tools.first().map(String::as_str))?;
        self.vehicle.frame(name).map(|frame| k.pose(&frame))
    }
    /// Mass (kg) and centre of mass (m) of the payloads that tools of some names hold.
    fn load(
        &self,
        k: &Kinematics<'_, f64, JOINTS>,
        file: &TaskFile,
        counts: impl Fn(&str) -> bool,
    ) -> (f64, Vec3<f64>) {
        let held = file.payload.values().filter_map(|load| {
            let name = load.held_by.as_deref().filter(|name| counts(name))?;
            let tool = self.tool(k, Some(name))?;
            Some((load.mass_kg, tool.point(Vec3::from_array(load.centre_of_mass_m))))
        });
        let (mass, moment) =
            held.fold((0.0, Vec3::zero()), |(m, sum), (mass, p)| (m + mass, sum + p * mass));
        (mass, if mass > 0.0 { moment * (1.0 / mass) } else { moment })
    }
    /// Centre of mass of vehicle and load (m).
    pub(crate) fn centre_of_mass(&self, file: &TaskFile) -> Vec3<f64> {
        let k = kinematics(&self.robot, &self.state);
        let ((rest, p_rest), (load, p_load)) = (k.centre_of_mass(), self.load(&k, file, |_| true));
        (p_rest * rest + p_load * load) * (1.0 / (rest + load))
    }
    /// The demand of the task by hand, if it is one of those that a hand can do: a push at a tool, or
    /// the first straight line. `duration`: how long it is flown (s).
    pub(crate) fn by_hand(&self, file: &TaskFile, duration: f64) -> Option<HandCheck> {
        if file.world.applied_wrench.is_empty() {
            self.of_motion(file)
        } else {
            self.of_push(file, duration)
        }
    }
    /// Force times lever, and the torque that comes with it; momentum is torque times time.
    fn of_push(&self, file: &TaskFile, duration: f64) -> Option<HandCheck> {
        let turned = file.world.applied_wrench.iter().any(|w| file.is_turned(w.axes.as_deref()));
        if turned || file.phase.iter().any(PhaseFile::changes_the_load) {
            return None;
        }
        let k = kinematics(&self.robot, &self.state);
        let centre = self.centre_of_mass(file);
        let (mut torque, mut momentum) = (Vec3::zero(), Vec3::zero());
        let mut how = vec![];
        for wrench in &file.world.applied_wrench {
            let lever = self.tool(&k, Some(&wrench.on))?.translation - centre;
            let (force, twist) =
                (Vec3::from_array(wrench.force_n), Vec3::from_array(wrench.torque_nm));
            let (each, acting) = (lever.cross(force) + twist, wrench.acting(duration));
            torque += each;
            momentum += each * acting;
            let size = force.norm();
            if size > 0.0 {
                let arm = lever.cross(force).norm() / size;
                how.push(format!("{size:.0} N at a lever of {arm:.3} m from the centre of mass"));
            }
            if twist.norm() > 0.0 {
                how.push(format!("{:.0} N·m", twist.norm()));
            }
        }
        Some(HandCheck { momentum: momentum.norm(), torque: torque.norm(), how: how.join(", ") })
    }
    /// The chain that carries a tool: its mass (kg), and the number of its first joint.
    fn arm(&self, tool: &str) -> Option<(f64, usize)> {
        let (robot, body) = (&self.vehicle.robot, self.vehicle.frame(tool)?.body);
        let masses = robot.path_to_base(body).map(|j| robot.inertia(BodyId::Link(j)).mass);
        Some((masses.sum(), robot.chain_root(body)?))
    }
    /// Reduced mass times lever times speed for the load, half the tool's speed for the arm.
    fn of_motion(&self, file: &TaskFile) -> Option<HandCheck> {
        let motion = file.first_line()?;
        if file.is_turned(motion.axes.as_deref()) {
            return None;
        }
        let first = self.vehicle.tools.first().map(String::as_str);
        let tool = file.control.tool.as_deref().or(first)?;
        let (arm, root) = self.arm(tool)?;
        let by = Vec3::from_array(motion.by_m?);
        let pace = motion.pace(by.norm())?;
        let along = by * (1.0 / by.norm());
        let k = kinematics(&self.robot, &self.state);
        let (load, p_load) = self.load(&k, file, |name| name == tool);
        // What other tools hold belongs to the rest.
        let ((own, p_own), (other, p_other)) =
            (k.centre_of_mass(), self.load(&k, file, |name| name != tool));
        let rest = own + other;
        let p_rest = (p_own * own + p_other * other) * (1.0 / rest);
        let p_arm = (k.joint_origin(root) + self.tool(&k, Some(tool))?.translation) * 0.5;
        // Seen from the base the load moves against all the rest; seen from outside the rest recoils.
        let reduced = load * rest / (rest + load);
        let inertial = motion.axes.as_deref() != Some("base");
        let moved = if inertial { load } else { reduced };
        let each =
            (p_load - p_rest).cross(along) * moved + (p_arm - p_rest).cross(along) * (0.5 * arm);
        let size = each.norm();
        let lever = (p_load - p_rest).cross(along).norm();
        let mut how = String::new();
        if load > 0.0 {
            let name = if inertial { "load" } else { "reduced mass" };
            how = format!("{name} {moved:.0} kg at a lever of {lever:.2} m, ");
        }
        how += &format!("arm {arm:.0} kg at half the speed; {}", pace.how);
        Some(HandCheck { momentum: size * pace.speed, torque: size * pace.acceleration, how })
    }
}

impl WrenchFile {
    /// Time (s) for which it acts in a flight of this duration, a rise or a fall counted half.
    fn acting(&self, duration: f64) -> f64 {
        let whole = (duration - self.from_s).min(self.duration_s).max(0.0);
        let fallen = self.from_s + self.duration_s <= duration;
        let slopes = if fallen { self.ramp_s } else { 0.5 * self.ramp_s };
        (whole - slopes).max(0.0)
    }
}

impl MoveFile {
    /// Of a quintic: 15/8 L/T and 10/√3 L/T². Of an s-curve that reaches its speed: the limits, or where
    /// the jerk does not let it reach the acceleration the mean of what it does reach, √(v j).
    fn pace(&self, length: f64) -> Option<Pace> {
        if let Some(duration) = self.duration_s {
            let how = format!("quintic of {duration} s: 1.875 L/T and 5.774 L/T²");
            let speed = 1.875 * length / duration;
            let acceleration = 10.0 / 3.0_f64.sqrt() * length / (duration * duration);
            return Some(Pace { speed, acceleration, how });
        }
        let limits = self.limits.as_ref().filter(|limits| limits.shape == "s-curve")?;
        let (v, a, j) = (limits.speed_m_s, limits.acceleration_m_s2, limits.jerk_m_s3);
        let acceleration = a.min((v * j).sqrt());
        let ramp = v / acceleration + acceleration / j;
        // The way must be long enough for the speed: half of it in each ramp.
        (length >= v * ramp).then(|| Pace {
            speed: v,
            acceleration,
            how: format!(
                "s-curve to {v} m/s in {ramp:.2} s: torque {:.2} H/t",
                acceleration * ramp / v
            ),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quintic_peaks_at_fifteen_eighths_and_ten_over_root_three() {
        let pace = MoveFile { duration_s: Some(10.0), ..MoveFile::default() }.pace(2.0).unwrap();
        assert_eq!(pace.speed, 0.375);
        // s = 10 t³ - 15 t⁴ + 6 t⁵ has its largest s'' = 60 t - 180 t² + 120 t³ at (3 - √3)/6.
        let t = (3.0 - 3.0_f64.sqrt()) / 6.0;
        let largest = t * (60.0 + t * (-180.0 + t * 120.0)) * 0.02;
        assert!((pace.acceleration - largest).abs() < 1e-15, "{} {largest}", pace.acceleration);
    }

    #[test]
    fn a_line_behind_a_grasp_or_in_turned_axes_is_no_work_for_a_hand() {
        let line = || PhaseFile {
            move_tool: Some(MoveFile { duration_s: Some(1.0), ..MoveFile::default() }),
            ..PhaseFile::default()
        };
        let grasp = PhaseFile { grasp: Some(OtherFile {}), ..PhaseFile::default() };
        let of = |phase| TaskFile { phase, ..TaskFile::default() };
        assert!(of(vec![PhaseFile::default(), line(), grasp.clone()]).first_line().is_some());
        assert!(of(vec![grasp, line()]).first_line().is_none());
        let mut turned = of(vec![]);
        assert!(!turned.is_turned(None));
        turned.initial.attitude = Some(TurnFile { z: 0.1, ..TurnFile::default() });
        assert!(turned.is_turned(None) && !turned.is_turned(Some("base")));
    }

    #[test]
    fn a_push_counts_its_slopes_half() {
        let push =
            WrenchFile { from_s: 1.0, duration_s: 4.0, ramp_s: 0.5, ..WrenchFile::default() };
        assert_eq!([0.5, 3.0, 9.0].map(|duration| push.acting(duration)), [0.0, 1.75, 3.5]);
    }

    /// The tank of the reference was left out, and with it where thrusters turn the vehicle about.
    #[test]
    fn the_centre_of_mass_is_that_of_the_fuelled_vehicle() {
        let vehicle = wrasse_vehicle::find_vehicle("planar-two-link", None).unwrap();
        let mass = vehicle.robot.mass();
        let tank = Tank { position_B: Vec3::from_array([0.0, 0.0, 1.0]), propellant: mass };
        let centre = |tank| {
            Start::new(&vehicle, tank, &State::default()).centre_of_mass(&TaskFile::default())
        };
        let (dry, wet) = (centre(None), centre(Some(tank)));
        assert!((wet.z - 0.5 * (dry.z + 1.0)).abs() < 1e-14, "{dry:?} {wet:?}");
    }

    /// Ramps of one second: pure jerk doubles the mean acceleration, most of it constant does not.
    #[test]
    fn an_s_curve_peaks_at_its_limits_or_where_its_jerk_ends() {
        let curve = |acceleration_m_s2, jerk_m_s3| MoveFile {
            limits: Some(LimitsFile {
                shape: "s-curve".into(),
                speed_m_s: 0.1,
                acceleration_m_s2,
                jerk_m_s3,
            }),
            ..MoveFile::default()
        };
        let pure = curve(1.0, 0.4).pace(1.0).unwrap();
        assert!((pure.acceleration - 0.2).abs() < 1e-15, "{}", pure.acceleration);
        assert!(pure.how.contains("in 1.00 s: torque 2.00 H/t"), "{}", pure.how);
        let flat = curve(0.125, 0.625).pace(1.0).unwrap();
        assert!(flat.acceleration == 0.125 && flat.how.contains("in 1.00 s: torque 1.25 H/t"));
        assert!(curve(1.0, 0.4).pace(0.09).is_none());
    }
}
