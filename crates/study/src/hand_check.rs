//! The demand of a task by hand, from the numbers of its case alone: what the simulation finds has to
//! come near it.

use crate::outcome::HandCheck;
use wrasse_dynamics::{BodyId, Frame, Kinematics, MassProperties, State, kinematics};
use wrasse_flight::trajectory::ProfileShape;
use wrasse_flight::{Axes, Phase, Target, Timing};
use wrasse_rehearsal::{AppliedWrench, Case, PayloadStart};
use wrasse_spatial::{Mat3, Pose, Sym3, Vec3};
use wrasse_vehicle::{JOINTS, VehicleRobot};

/// The vehicle at the start of a task, with what is in its tank and without its load, in base axes.
pub(crate) struct Start<'a> {
    case: &'a Case,
    robot: VehicleRobot,
    state: State<f64, JOINTS>,
}

impl<'a> Start<'a> {
    pub(crate) fn new(case: &'a Case) -> Self {
        let mut robot = case.vehicle.robot;
        if let Some(tank) = case.equipment.actuators.tank {
            let base = Frame { body: BodyId::Base, X_BF: Pose::identity() };
            let matter =
                MassProperties::from_central(tank.propellant, tank.position_B, Sym3::zero());
            robot = robot.with_payload(&base, &matter);
        }
        Self { case, robot, state: State { q: case.start.q, ..State::default() } }
    }
}

/// A straight line of the tool.
struct Line<'a> {
    tool: Frame<f64>,
    displacement: Vec3<f64>,
    axes: Axes,
    timing: &'a Timing<f64>,
}

/// Peak speed (m/s) and acceleration (m/s²) of a motion, and how they are found.
struct Pace {
    speed: f64,
    acceleration: f64,
    how: String,
}

/// The first straight line of a tool that works alone, if load and posture are those of the start until
/// then.
fn first_line(case: &Case) -> Option<Line<'_>> {
    for phase in &case.phases {
        let task = phase.step.tasks().next().filter(|_| phase.step.tasks().count() == 1)?;
        match &task.motion {
            Phase::MoveTool { target: Target::By { displacement, .. }, axes, timing } => {
                let own = task.assignment.unwrap_or(case.setup.assignment);
                let (displacement, axes) = (*displacement, *axes);
                let line = Line { tool: own.tool, displacement, axes, timing };
                return (displacement.norm() > 0.0).then_some(line);
            }
            Phase::Hold { .. } => {}
            _ => return None,
        }
    }
    None
}

/// Whether a load is taken or let go of on the way.
fn changes_the_load(case: &Case) -> bool {
    let mut tasks = case.phases.iter().flat_map(|phase| phase.step.tasks());
    tasks.any(|task| matches!(task.motion, Phase::Grip { .. }))
}

impl Start<'_> {
    /// Whether figures in these axes are turned against those of the base, in which a hand reckons.
    fn is_turned(&self, axes: Axes) -> bool {
        axes == Axes::Inertial && self.case.start.X_NB.rotation != Mat3::identity()
    }
    /// Mass (kg) and centre of mass (m) of the payloads that some tools hold.
    fn load(
        &self,
        k: &Kinematics<'_, f64, JOINTS>,
        counts: impl Fn(&Frame<f64>) -> bool,
    ) -> (f64, Vec3<f64>) {
        let held = self.case.payloads.iter().filter_map(|payload| match &payload.start {
            PayloadStart::Held(tool) if counts(tool) => {
                let M = &payload.matter.M_F_F;
                Some((M.mass, k.pose(tool).point(M.centre_of_mass())))
            }
            _ => None,
        });
        let (mass, moment) =
            held.fold((0.0, Vec3::zero()), |(m, sum), (mass, p)| (m + mass, sum + p * mass));
        (mass, if mass > 0.0 { moment * (1.0 / mass) } else { moment })
    }
    /// Centre of mass of vehicle and load (m).
    pub(crate) fn centre_of_mass(&self) -> Vec3<f64> {
        let k = kinematics(&self.robot, &self.state);
        let ((rest, p_rest), (load, p_load)) = (k.centre_of_mass(), self.load(&k, |_| true));
        (p_rest * rest + p_load * load) * (1.0 / (rest + load))
    }
    /// The demand of the task by hand, if it is one of those that a hand can do: a push at a tool, or
    /// the first straight line. `duration`: how long it is flown (s).
    pub(crate) fn by_hand(&self, duration: f64) -> Option<HandCheck> {
        if self.case.wrenches.is_empty() { self.of_motion() } else { self.of_push(duration) }
    }
    /// Force times lever, and the torque that comes with it; momentum is torque times time.
    fn of_push(&self, duration: f64) -> Option<HandCheck> {
        let turned = self.case.wrenches.iter().any(|wrench| self.is_turned(wrench.axes));
        if turned || changes_the_load(self.case) {
            return None;
        }
        let k = kinematics(&self.robot, &self.state);
        let centre = self.centre_of_mass();
        let (mut torque, mut momentum) = (Vec3::zero(), Vec3::zero());
        let mut how = vec![];
        for wrench in &self.case.wrenches {
            let lever = k.pose(&wrench.on).translation - centre;
            let (force, twist) = (wrench.wrench.force, wrench.wrench.torque);
            let (each, acting) = (lever.cross(force) + twist, acting(wrench, duration));
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
    fn arm(&self, tool: &Frame<f64>) -> Option<(f64, usize)> {
        let robot = &self.case.vehicle.robot;
        let links = robot.path_to_base(tool.body);
        let mass = links.map(|j| robot.inertia(BodyId::Link(j)).mass).sum();
        Some((mass, robot.chain_root(tool.body)?))
    }
    /// Reduced mass times lever times speed for the load, half the tool's speed for the arm.
    fn of_motion(&self) -> Option<HandCheck> {
        let line = first_line(self.case)?;
        if self.is_turned(line.axes) {
            return None;
        }
        let (arm, root) = self.arm(&line.tool)?;
        let by = line.displacement;
        let pace = pace(line.timing, by.norm())?;
        let along = by * (1.0 / by.norm());
        let k = kinematics(&self.robot, &self.state);
        let (load, p_load) = self.load(&k, |tool| *tool == line.tool);
        // What other tools hold belongs to the rest.
        let ((own, p_own), (other, p_other)) =
            (k.centre_of_mass(), self.load(&k, |tool| *tool != line.tool));
        let rest = own + other;
        let p_rest = (p_own * own + p_other * other) * (1.0 / rest);
        let p_arm = (k.joint_origin(root) + k.pose(&line.tool).translation) * 0.5;
        // Seen from the base the load moves against all the rest; seen from outside the rest recoils.
        let reduced = load * rest / (rest + load);
        let inertial = line.axes == Axes::Inertial;
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

/// Time (s) for which a push acts in a flight of this duration, a rise or a fall counted half.
fn acting(wrench: &AppliedWrench, duration: f64) -> f64 {
    let whole = (duration - wrench.from).min(wrench.duration).max(0.0);
    let fallen = wrench.from + wrench.duration <= duration;
    let slopes = if fallen { wrench.ramp } else { 0.5 * wrench.ramp };
    (whole - slopes).max(0.0)
}

/// Of a quintic: 15/8 L/T and 10/√3 L/T². Of an s-curve that reaches its speed: the limits, or where
/// the jerk does not let it reach the acceleration the mean of what it does reach, √(v j).
fn pace(timing: &Timing<f64>, length: f64) -> Option<Pace> {
    let limits = match timing {
        Timing::Duration(duration) => {
            let how = format!("quintic of {duration} s: 1.875 L/T and 5.774 L/T²");
            let speed = 1.875 * length / duration;
            let acceleration = 10.0 / 3.0_f64.sqrt() * length / (duration * duration);
            return Some(Pace { speed, acceleration, how });
        }
        Timing::Limits { shape: ProfileShape::SCurve, linear, .. } => linear,
        Timing::Limits { .. } => return None,
    };
    let (v, a, j) = (limits.speed, limits.acceleration, limits.jerk);
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

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_flight::trajectory::MotionLimits;
    use wrasse_mission::{Mission, read_mission};

    #[test]
    fn a_quintic_peaks_at_fifteen_eighths_and_ten_over_root_three() {
        let pace = pace(&Timing::Duration(10.0), 2.0).unwrap();
        assert_eq!(pace.speed, 0.375);
        // s = 10 t³ - 15 t⁴ + 6 t⁵ has its largest s'' = 60 t - 180 t² + 120 t³ at (3 - √3)/6.
        let t = (3.0 - 3.0_f64.sqrt()) / 6.0;
        let largest = t * (60.0 + t * (-180.0 + t * 120.0)) * 0.02;
        assert!((pace.acceleration - largest).abs() < 1e-15, "{} {largest}", pace.acceleration);
    }

    const LOAD: &str =
        "[payload.cube]\nmass_kg = 1.0\nuniform_box_m = [1, 1, 1]\nheld_by = \"tool\"\n";
    const LINE: &str =
        "[[phase]]\nname = \"line\"\nmove_tool = { by_m = [0.1, 0, 0], duration_s = 1.0 }\n";
    const HOLD: &str = "[[phase]]\nname = \"hold\"\nhold = { duration_s = 1.0 }\n";
    const RELEASE: &str = "[[phase]]\nname = \"go\"\nrelease = { payload = \"cube\" }\n";

    fn mission(parts: &[&str]) -> Mission {
        let text = format!("name = \"m\"\nvehicle = \"atlas-class\"\n{}", parts.concat());
        read_mission("m.toml", text).unwrap_or_else(|found| panic!("{found:?}"))
    }

    #[test]
    fn a_line_behind_a_grip_or_in_turned_axes_is_no_work_for_a_hand() {
        let posture = "[initial]\nposture = \"forward_300mm\"\n";
        let is_first = |phases: &[&str]| {
            let mission = mission(&[&[posture, LOAD], phases].concat());
            first_line(&mission.cases[0]).is_some()
        };
        assert!(is_first(&[HOLD, LINE, RELEASE]));
        assert!(!is_first(&[RELEASE, LINE]));
        assert!(!is_first(&[HOLD]));
        let turned = "[initial]\nposture = \"forward_300mm\"\nattitude = { rpy_deg = [0, 0, 5] }\n";
        let mission = mission(&[turned, LOAD, LINE]);
        let start = Start::new(&mission.cases[0]);
        assert!(start.is_turned(Axes::Inertial) && !start.is_turned(Axes::Base));
        assert!(start.by_hand(1.0).is_none());
    }

    #[test]
    fn a_push_counts_its_slopes_half() {
        let push = "[[world.applied_wrench]]\non = \"tool\"\nforce_n = [1, 0, 0]\nfrom_s = 1.0\n\
                    duration_s = 4.0\nramp_s = 0.5\n";
        let mission = mission(&[push, HOLD]);
        let push = &mission.cases[0].wrenches[0];
        assert_eq!([0.5, 3.0, 9.0].map(|duration| acting(push, duration)), [0.0, 1.75, 3.5]);
    }

    /// The tank of the reference was left out, and with it where thrusters turn the vehicle about.
    #[test]
    fn the_centre_of_mass_is_that_of_the_fuelled_vehicle() {
        let mut mission = mission(&[HOLD]);
        let case = &mut mission.cases[0];
        case.equipment.actuators.tank = None;
        let dry = Start::new(case).centre_of_mass();
        let position_B = Vec3::from_array([0.0, 0.0, 1.0]);
        let propellant = case.vehicle.robot.mass();
        case.equipment.actuators.tank = Some(wrasse_hardware::Tank { position_B, propellant });
        let wet = Start::new(case).centre_of_mass();
        assert!((wet.z - 0.5 * (dry.z + 1.0)).abs() < 1e-14, "{dry:?} {wet:?}");
    }

    /// Ramps of one second: pure jerk doubles the mean acceleration, most of it constant does not.
    #[test]
    fn an_s_curve_peaks_at_its_limits_or_where_its_jerk_ends() {
        let curve = |acceleration, jerk| {
            let linear = MotionLimits { speed: 0.1, acceleration, jerk };
            Timing::Limits { shape: ProfileShape::SCurve, linear, angular: linear }
        };
        let pure = pace(&curve(1.0, 0.4), 1.0).unwrap();
        assert!((pure.acceleration - 0.2).abs() < 1e-15, "{}", pure.acceleration);
        assert!(pure.how.contains("in 1.00 s: torque 2.00 H/t"), "{}", pure.how);
        let flat = pace(&curve(0.125, 0.625), 1.0).unwrap();
        assert!(flat.acceleration == 0.125 && flat.how.contains("in 1.00 s: torque 1.25 H/t"));
        assert!(pace(&curve(1.0, 0.4), 0.09).is_none());
    }
}
