//! Pairs of missions: one that goes well, and one that does not for a reason of physics.

/// A mission that goes well and one that does not.
pub(crate) struct Pair {
    pub(crate) name: &'static str,
    pub(crate) good: String,
    pub(crate) bad: String,
}

const HEAD: &str = "name = \"flown\"\nrequirements = []\n";

const ARM: &str = r#"
vehicle = "atlas-class"
[initial]
posture = "sideways_300mm"
[world]
base_attitude = "controlled"
joints = "torque"
"#;

const LAWS: &str = "[control]\narm_law = \"attitude-held\"\n";

/// A load in the grip.
fn load(mass_kg: f64) -> String {
    format!(
        "[payload.module]\nmass_kg = {mass_kg}\ncentre_of_mass_m = [0.5, 0.0, 0.0]\nuniform_box_m = [1.0, 1.0, \
         1.0]\nheld_by = \"tool\"\n"
    )
}

/// A line of the tool sideways, and a stop.
fn reach(metres: f64, seconds: f64) -> String {
    format!(
        "[[phase]]\nname = \"reach\"\nmove_tool = {{ by_m = [0.0, {metres}, 0.0], duration_s = {seconds} }}\n\
         [[phase]]\nname = \"settle\"\nhold = {{ duration_s = 0.2, keep = \"tool\" }}\n"
    )
}

/// Drives, attitude actuator and tool, with a load that suits them and one of 20 t at a pace that asks
/// more than they have.
fn drives() -> Pair {
    let mission =
        |mass, way: String| format!("{HEAD}{ARM}{}{LAWS}actuators = \"ideal\"\n{way}", load(mass));
    let turn = "[[phase]]\nname = \"turn\"\nmove_joints = { to_deg = { joint4 = 60 }, duration_s = 5.0 }\n";
    let turn = turn.to_owned();
    Pair { name: "drives", good: mission(200.0, reach(0.02, 2.0)), bad: mission(2e4, turn) }
}

/// Joints that nothing drives, slowly and beyond rates and travel.
fn coast() -> Pair {
    let mission = |rate: f64| {
        let rates = format!("joint_rates_deg_s = {{ joint2 = {rate}, joint4 = {rate} }}");
        let arm =
            ARM.replace("300mm\"\n", &format!("300mm\"\n{rates}\n")).replace("controlled", "free");
        let phase =
            "[[phase]]\nname = \"coast\"\nhold = { duration_s = 3.0, keep = \"nothing\" }\n";
        format!("{HEAD}{arm}{LAWS}{phase}")
    };
    Pair { name: "coast", good: mission(0.1), bad: mission(60.0) }
}

/// Four wheels of 0.2 N·m: an empty arm, and a load with wheels that are all but at their limits.
fn wheels() -> Pair {
    let mission = |rpm: f64, mass, way: String| {
        let wheel = |i: i32, axis: &str, sign: f64| {
            format!(
                "[[actuators.wheel]]\nname = \"w{i}\"\nmodel = \"honeywell-hr16-100\"\naxis = {axis}\n\
                 speed_rpm = {:.1}\n",
                rpm * sign
            )
        };
        let wheels = [
            wheel(1, "[1.0, 1.0, 1.0]", 1.0),
            wheel(2, "[1.0, -1.0, 1.0]", -1.0),
            wheel(3, "[1.0, -1.0, -1.0]", 1.0),
            wheel(4, "[1.0, 1.0, -1.0]", -1.0),
        ];
        format!(
            "{HEAD}{ARM}{}{LAWS}[actuators]\nname = \"4\"\n{}{way}",
            load(mass),
            wheels.concat()
        )
    };
    Pair {
        name: "wheels",
        good: mission(300.0, 1.0, reach(0.003, 1.0)),
        bad: mission(5999.0, 200.0, reach(0.1, 3.0)),
    }
}

/// A pyramid of four CMGs, and one that a quick load takes to its limits.
fn cmgs() -> Pair {
    let mission = |mass, way: String| {
        let arm = ARM.replace("\"torque\"\n", "\"torque\"\nstep_s = 0.0025\n");
        format!(
            "{HEAD}{arm}{}{LAWS}[actuators]\nname = \"4\"\ncmg_array = [{{ name = \"g\", model = \
             \"airbus-cmg-15-45s\", arrangement = \"pyramid\", skew_deg = 53.13 }}]\n{way}",
            load(mass)
        )
    };
    Pair {
        name: "cmgs",
        good: mission(1.0, reach(0.003, 1.0)),
        bad: mission(200.0, reach(0.3, 2.5)),
    }
}

/// Thrusters that hold the base against a pull that they can bear, and one that they cannot.
fn thrusters() -> Pair {
    let mission = |newtons: f64| {
        format!(
            "{HEAD}{ARM}[[world.applied_wrench]]\non = \"tool\"\nforce_n = [-{newtons:.1}, 0.0, 0.0]\nfrom_s \
             = 0.1\nduration_s = 10.0\nramp_s = 0.1\n{LAWS}attitude_bandwidth_rad_s = 1.0\nmeasure_tool_wrench \
             = true\nposition_hold = {{ bandwidth_rad_s = 0.7 }}\n[actuators]\nname = \"24\"\nthruster_set = \
             [{{ name = \"t\", model = \"moog-monarc-22-6\", arrangement = \"box\", count = 24, edges_m = \
             [1.8, 1.6, 1.6], position_m = [0.0, 0.0, 0.0] }}]\ntank = {{ propellant_kg = 60.0, position_m = \
             [-0.5, 0.0, 0.0], source.assumed = \"some\" }}\n[[phase]]\nname = \"hold\"\nhold = {{ duration_s \
             = 2.0, keep = \"joints\" }}\n"
        )
    };
    Pair { name: "thrusters", good: mission(1.0), bad: mission(400.0) }
}

/// An estimator with a rate gyro without bias, and with one of 5000 deg/h that it does not know of.
fn estimator() -> Pair {
    let mission = |bias: f64| {
        format!(
            "{HEAD}{ARM}{LAWS}actuators = \"unlimited\"\n[sensors]\nencoder_step_deg = 0.0003\nsource.assumed = \
             \"some\"\ngyro = {{ bias_deg_h = [{bias:.1}, 0.0, 0.0], angle_random_walk_deg_sqrt_h = 0.001, \
             bias_random_walk_deg_h_sqrt_h = 0.003 }}\nstar_tracker = {{ boresight = [-1.0, 0.0, 0.0], \
             noise_across_arcsec = 20.0, noise_about_arcsec = 120.0, rate_hz = 4.0, latency_s = 0.1, \
             rate_limit_deg_s = 1.0 }}\n[[phase]]\nname = \"hold\"\nhold = {{ duration_s = 2.0, keep = \
             \"tool\" }}\n"
        )
    };
    Pair { name: "estimator", good: mission(0.0), bad: mission(5000.0) }
}

/// A slider that nothing drives, slowly and beyond its travel.
fn slider() -> Pair {
    let mission = |rate: f64| {
        format!(
            "{HEAD}vehicle = \"slider.toml\"\n[initial]\nposture = \"ready\"\njoint_rates_m_s = {{ rail = \
             {rate:.3} }}\njoint_rates_deg_s = {{ hinge = {:.1} }}\n[world]\nbase_attitude = \"free\"\njoints = \"torque\"\n[control]\narm_law = \
             \"free-floating\"\ntask = \"position\"\n[[phase]]\nname = \"coast\"\nhold = {{ duration_s = 1.0, \
             keep = \"nothing\" }}\n",
            200.0 * rate
        )
    };
    Pair { name: "slider", good: mission(0.001), bad: mission(0.28) }
}

/// Propellant that swings, pushed aside a little and far.
fn slosh() -> Pair {
    let mission = |newtons: f64| {
        format!(
            "{HEAD}{ARM}[[world.applied_wrench]]\non = \"bus\"\nforce_n = [0.0, 0.0, {newtons:.1}]\nfrom_s = \
             0.0\nduration_s = 2.0\n{LAWS}actuators = \"unlimited\"\n[actuators.tank]\npropellant_kg = 200.0\n\
             position_m = [-0.2, 0.0, 0.0]\nslosh = {{ sphere = {{ radius_m = 0.45 }}, axis = [1.0, 0.0, 0.0], \
             density_kg_m3 = 1004.0, damping_ratio = 0.05, acceleration_m_s2 = 0.25, source.assumed = \"some\" \
             }}\nsource.assumed = \"some\"\n[[phase]]\nname = \"hold\"\nhold = {{ duration_s = 2.0, keep = \
             \"joints\" }}\n"
        )
    };
    Pair { name: "slosh", good: mission(1.0), bad: mission(400.0) }
}

/// All of them.
pub(crate) fn pairs() -> Vec<Pair> {
    vec![drives(), coast(), wheels(), cmgs(), thrusters(), estimator(), slider(), slosh()]
}
