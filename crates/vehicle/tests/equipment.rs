//! What the actuators and sensors of a vehicle file become.

use wrasse_document::{Document, Step, at, render};
use wrasse_hardware::{ControlMomentGyro, Thruster};
use wrasse_spatial::{Real, Vec3, vec3};
use wrasse_testing::larger;
use wrasse_vehicle::{
    Equipment, EquipmentFile, Grade, Vehicle, hardware, read_equipment, read_vehicle,
};

const GOOD: &str = include_str!("data/servicer.toml");

/// The servicer's vehicle.
fn servicer() -> Vehicle {
    read_vehicle("servicer.toml", GOOD).unwrap_or_else(|c| panic!("{}", render(&c, false)))
}

/// The equipment of a table `[actuators]` without mistakes.
#[track_caller]
fn equipment(actuators: &str) -> Equipment {
    let document = Document::parse("table.toml", actuators).expect("a table");
    let file = document.read::<EquipmentFile>().unwrap_or_else(|c| panic!("{}", render(&c, false)));
    let path: &[Step<'_>] = at![];
    let (equipment, complaints) = read_equipment(&document, path, &file);
    assert_eq!(render(&complaints, false), "");
    equipment
}

fn array(arrangement: &str) -> Equipment {
    equipment(&format!(
        "[[cmg_array]]\nname = \"a\"\nmodel = \"airbus-cmg-15-45s\"\narrangement = {arrangement}\n"
    ))
}

#[test]
fn wheels_arrive_in_si_with_their_models_numbers_and_their_own() {
    let equipment = servicer().equipment;
    let rpm = core::f64::consts::TAU / 60.0;
    let [x, y, z] = equipment.actuators.wheels[..] else { panic!("three wheels") };
    assert_eq!(equipment.wheel_names, ["wheel-x", "wheel-y", "wheel-z"]);
    assert_eq!((x.axis_B, x.torque_limit, x.coulomb), (vec3(1.0, 0.0, 0.0), 0.2, 0.0005));
    assert_eq!(x.speed_limit, 6000.0 * rpm);
    assert_eq!((x.momentum_limit(), equipment.wheel_speed[0]), (100.0, 600.0 * rpm));
    assert_eq!((y.inertia, y.coulomb, y.torque_step), (0.16, 0.0, 0.0));
    // Its own momentum and friction; the rest is the model's.
    assert_eq!((z.momentum_limit(), z.coulomb, z.torque_limit), (50.0, 0.0, 0.2));
    assert_eq!(equipment.wheel_speed[1..], [0.0; 7]);
}

#[test]
fn a_cmgs_rate_follows_from_its_torque_and_momentum() {
    let equipment = servicer().equipment;
    let lone = &equipment.actuators.cmgs[0];
    assert_eq!((lone.spin_axis_B, lone.momentum), (vec3(0.0, -1.0, 0.0), 15.0));
    assert_eq!((lone.rate_limit, lone.torque_limit()), (2.0, 30.0));
    assert_eq!(equipment.gimbal_angle[0], 30.0_f64.to_radians());
    let names = ["lone", "cluster-1", "cluster-2", "cluster-3", "cluster-4"];
    assert_eq!(equipment.cmg_names, names);
    assert_eq!(equipment.actuators.cmgs[4].rate_limit, 1.0);
}

#[test]
fn thrusters_and_tank_arrive_in_the_bases_frame() {
    let equipment = servicer().equipment;
    let thrusters = &equipment.actuators.thrusters;
    assert_eq!((thrusters.len(), equipment.thruster_names.len()), (13, 13));
    assert_eq!(equipment.thruster_names[12], "box-12");
    let main = &thrusters[0];
    assert_eq!((main.direction_B, main.position_B), (vec3(1.0, 0.0, 0.0), vec3(-0.9, 0.0, 0.0)));
    assert_eq!((main.force, main.specific_impulse, main.minimum_on_time), (445.0, 234.0, 0.025));
    assert_eq!((thrusters[1].impulse_noise, thrusters[1].rise_time), (0.05, 0.0));
    // The middle of the box lies 0.1 m ahead of the base's frame.
    assert_eq!(thrusters[1].position_B, vec3(1.0, 0.8, 0.0));
    let tank = equipment.actuators.tank.unwrap();
    assert_eq!((tank.propellant, tank.position_B.x), (120.0, -0.2));
}

#[test]
fn propellant_comes_on_top_of_the_bodies_and_actuators_do_not() {
    assert_eq!(servicer().robot.mass(), 1500.0);
}

#[test]
fn sensors_arrive_in_si() {
    let sensors = servicer().sensors;
    let (gyro, tracker) = sensors.attitude.unwrap();
    let close = |found: f64, expected: f64| {
        // Two or three products of numbers that are not exact. Measured: 2.2e-16.
        assert!((found / expected - 1.0).abs() < 1e-15, "{found:e} for {expected:e}");
    };
    // 3.6 deg/h are 0.001 deg/s.
    close(gyro.bias_B.x, 0.001_f64.to_radians());
    // 0.02 deg/√h are 0.02/60 deg/√s; 0.05 deg/h/√h are 0.05/3600/60 deg/s/√s.
    close(gyro.angle_random_walk, (0.02_f64 / 60.0).to_radians());
    close(gyro.bias_random_walk, (0.05_f64 / 216_000.0).to_radians());
    close(gyro.rate_step, 0.001_f64.to_radians());
    close(tracker.noise_about, 0.01_f64.to_radians());
    assert_eq!((tracker.interval, tracker.latency), (0.25, 0.0));
    assert_eq!(tracker.boresight_B, vec3(0.0, 0.0, -1.0));
    assert_eq!(sensors.encoder_step, 0.01_f64.to_radians());
}

#[test]
fn a_vehicle_that_says_nothing_of_them_has_no_equipment_and_perfect_sensors() {
    let text = GOOD.split_once("[[actuators.wheel]]").unwrap().0;
    let bare = read_vehicle("bare.toml", text).unwrap();
    assert_eq!(bare.equipment, Equipment::default());
    assert!(bare.equipment.actuators.is_empty() && bare.sensors.attitude.is_none());
}

#[test]
fn a_set_weighs_and_takes_what_its_units_say() {
    let wheels = |last: &str| {
        let wheel = |name, axis, more| {
            format!(
                "[[wheel]]\nname = \"{name}\"\naxis = {axis}\nmodel = \"honeywell-hr14-50\"\n{more}"
            )
        };
        equipment(&(wheel("x", "[1, 0, 0]", "") + &wheel("y", "[0, 1, 0]", "") + last))
    };
    let third = "[[wheel]]\nname = \"z\"\naxis = [0, 0, 1]\ntorque_limit_nm = 0.1\n\
                 speed_limit_rpm = 4000\nmomentum_nms = 40\nmass_kg = 7\n";
    let set = wheels(third);
    assert_eq!(set.name, "2 x honeywell-hr14-50, 1 x wheel");
    assert_eq!((set.mass, set.power), (Some(24.0), None));
    assert_eq!(equipment("name = \"nothing\"\n").name, "nothing");
    assert_eq!(equipment("").mass, None);
}

/// Momentum of an array in units of one rotor's.
fn momentum(equipment: &Equipment, angles: &[f64]) -> Vec3<f64> {
    let mut all = [0.0; 8];
    all[..angles.len()].copy_from_slice(angles);
    equipment.actuators.cmg_momentum(&all) * (1.0 / equipment.actuators.cmgs[0].momentum)
}

/// Determinant of A Aᵀ, A the derivative of the momentum by the gimbal angles at the start (–).
fn manipulability(equipment: &Equipment) -> f64 {
    let cmgs = equipment.actuators.cmgs.iter().zip(equipment.gimbal_angle);
    let columns: Vec<_> = cmgs.map(|(cmg, angle)| cmg.torque_axis(angle)).collect();
    let row = |of: fn(&Vec3<f64>) -> f64| columns.iter().map(of).collect::<Vec<_>>();
    let rows = [row(|a| a.x), row(|a| a.y), row(|a| a.z)];
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let [x, y, z] = [0, 1, 2].map(|i| Vec3::from_array([0, 1, 2].map(|j| dot(&rows[i], &rows[j]))));
    x.dot(y.cross(z))
}

/// The closed form of the pyramid of 53.13 deg, cosine 0.6, sine 0.8.
#[test]
fn the_momentum_of_a_pyramid_is_that_of_its_closed_form() {
    let skew = Real::atan2(0.8_f64, 0.6).to_degrees();
    let pyramid = array(&format!("\"pyramid\"\nskew_deg = {skew}"));
    let (c, s) = (0.6, 0.8);
    let mut worst: f64 = 0.0;
    for angles in [[0.0; 4], [0.3, -1.1, 2.2, 0.7], [-1.6, 0.1, 1.5, 3.0]] {
        let [(s1, c1), (s2, c2), (s3, c3), (s4, c4)] = angles.map(Real::sin_cos);
        let expected =
            vec3(-c * s1 - c2 + c * s3 + c4, c1 - c * s2 - c3 + c * s4, s * (s1 + s2 + s3 + s4));
        worst = larger(worst, (momentum(&pyramid, &angles) - expected).norm());
    }
    // A few roundings of numbers of the order of one.
    assert!(worst < 2e-15, "measured 4.4e-16: {worst:e}");
}

#[test]
fn every_array_starts_without_momentum_and_can_make_torque_about_every_axis() {
    let arrays = [
        ("\"pyramid\"\nskew_deg = 54.74", 4),
        ("\"pyramid\"\nskew_deg = 30", 4),
        ("\"box\"", 4),
        ("\"roof\"\nskew_deg = 45\ncount = 4", 4),
        ("\"roof\"\nskew_deg = 30\ncount = 6", 6),
        ("\"roof\"\nskew_deg = 60\ncount = 8", 8),
    ];
    for (arrangement, count) in arrays {
        let array = array(arrangement);
        assert_eq!(array.actuators.cmgs.len(), count, "{arrangement}");
        for cmg in array.actuators.cmgs.iter() {
            assert!(cmg.gimbal_axis_B.dot(cmg.spin_axis_B).abs() < 1e-15);
            assert!((cmg.gimbal_axis_B.norm() - 1.0).abs() < 1e-15);
        }
        let rest = momentum(&array, &array.gimbal_angle).norm();
        assert!(rest < 1e-15, "{arrangement}, measured 1.2e-16: {rest:e}");
        let volume = manipulability(&array);
        // One CMG too few leaves none at all.
        assert!(volume > 1.0, "{arrangement}, measured 1.18 to 13.97: {volume}");
    }
}

#[test]
fn a_box_is_two_crossed_pairs_of_parallel_gimbals() {
    let gimbals: Vec<_> =
        array("\"box\"").actuators.cmgs.iter().map(|g| g.gimbal_axis_B.to_array()).collect();
    let sides = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];
    assert_eq!(gimbals, sides);
}

#[test]
fn a_roof_has_two_rows_of_parallel_gimbals() {
    let roof = array("\"roof\"\nskew_deg = 45\ncount = 6");
    let gimbal = |k: usize| roof.actuators.cmgs[k].gimbal_axis_B;
    let (sin, cos) = Real::sin_cos(45.0_f64.to_radians());
    assert!((0..3).all(|k| gimbal(k) == vec3(0.0, sin, cos)));
    assert!((3..6).all(|k| gimbal(k) == vec3(0.0, -sin, cos)));
    let spin = |k: usize| roof.actuators.cmgs[k].spin_axis_B;
    assert_eq!((spin(0), spin(3)), (vec3(1.0, 0.0, 0.0), vec3(-1.0, 0.0, 0.0)));
    let start = roof.gimbal_angle.map(f64::to_degrees);
    assert_eq!(start[..6], [-45.0, 0.0, 45.0, -45.0, 0.0, 45.0]);
}

#[test]
fn an_array_turns_with_its_orientation() {
    let turned = array("\"pyramid\"\nskew_deg = 54.74\norientation.rpy_deg = [0, 90, 0]");
    let plain = array("\"pyramid\"\nskew_deg = 54.74");
    for (a, b) in turned.actuators.cmgs.iter().zip(plain.actuators.cmgs.iter()) {
        // A quarter turn about y takes z to x and x to -z.
        let about_y = |v: Vec3<f64>| vec3(v.z, v.y, -v.x);
        let both = |g: &ControlMomentGyro<f64>| (g.gimbal_axis_B, g.spin_axis_B);
        assert_eq!(both(a), (about_y(b.gimbal_axis_B), about_y(b.spin_axis_B)));
    }
}

/// The six components of a thruster's push about a point (m, –).
fn wrench(thruster: &Thruster<f64>, about: Vec3<f64>) -> [f64; 6] {
    let torque = (thruster.position_B - about).cross(thruster.direction_B).to_array();
    let force = thruster.direction_B.to_array();
    [torque[0], torque[1], torque[2], force[0], force[1], force[2]]
}

/// Rank of vectors by elimination with the largest pivot; what is below 1e-9 is zero.
fn rank(mut rows: Vec<[f64; 6]>) -> usize {
    let mut rank = 0;
    for column in 0..6 {
        let size = |row: &[f64; 6]| row[column].abs();
        let pivot = (rank..rows.len()).max_by(|&a, &b| size(&rows[a]).total_cmp(&size(&rows[b])));
        let Some(pivot) = pivot.filter(|&k| size(&rows[k]) > 1e-9) else { continue };
        rows.swap(rank, pivot);
        let lead = rows[rank];
        for row in &mut rows[rank + 1..] {
            let part = row[column] / lead[column];
            row.iter_mut().zip(lead).for_each(|(x, y)| *x -= part * y);
        }
        rank += 1;
    }
    rank
}

/// Thrusters that span six dimensions and can all push at once to no effect can make any force and
/// torque: each is then the opposite of a sum of the others.
#[test]
fn a_set_on_a_box_gives_force_and_torque_both_ways_about_every_axis() {
    for count in [12, 16, 24] {
        let set = equipment(&format!(
            "[[thruster_set]]\nname = \"t\"\nmodel = \"moog-monarc-22-6\"\narrangement = \"box\"\n\
             count = {count}\nedges_m = [1.8, 1.6, 1.4]\nposition_m = [0.2, 0.1, -0.3]\n"
        ));
        let thrusters = &set.actuators.thrusters;
        assert_eq!(thrusters.len(), count);
        let wrenches: Vec<_> = thrusters.iter().map(|t| wrench(t, vec3(0.3, -0.1, 0.2))).collect();
        assert_eq!(rank(wrenches.clone()), 6, "{count} thrusters");
        for k in 0..6 {
            let sum: f64 = wrenches.iter().map(|w| w[k]).sum();
            assert!(sum.abs() < 1e-14, "{count} thrusters, measured 2.2e-16: {sum:e}");
        }
    }
}

#[test]
fn opposite_thrusters_of_twelve_make_a_couple_about_z() {
    let set = servicer().equipment;
    let thrusters = &set.actuators.thrusters[1..];
    let middle = vec3(0.1, 0.0, 0.0);
    // On the face +x at +y, and on the face -x at -y.
    let pair = [wrench(&thrusters[0], middle), wrench(&thrusters[3], middle)];
    let sum: Vec<f64> = (0..6).map(|k| pair[0][k] + pair[1][k]).collect();
    assert_eq!(sum, [0.0, 0.0, 1.6, 0.0, 0.0, 0.0]);
}

#[test]
fn every_source_of_the_equipment_is_in_its_provenance() {
    let own: Vec<_> = servicer().equipment.provenance;
    let first: Vec<_> = own.iter().take(2).map(|row| row.of.as_str()).collect();
    assert_eq!(first, ["model.honeywell-hr16-100", "model.honeywell-hr16-100.coulomb_friction_nm"]);
    // A model that two units name is told once.
    assert_eq!(own.iter().filter(|row| row.of == "model.honeywell-hr16-100").count(), 1);
    let text = GOOD.replace(
        "axis = [2, 0, 0]\n",
        "axis = [2, 0, 0]\nsource.published = \"a drawing\"\nsource_of.axis.assumed = \"a guess\"\n",
    );
    let said = read_vehicle("servicer.toml", text).unwrap().equipment.provenance;
    assert_eq!((said[0].of.as_str(), said[0].grade), ("actuators.wheel.wheel-x", Grade::Published));
    assert_eq!(said[1].of, "actuators.wheel.wheel-x.axis");
    let sensors = servicer().provenance;
    assert!(sensors.iter().any(|row| row.of == "model.rate-gyro-class-usual"));
}

#[test]
fn every_unit_of_the_hardware_catalogue_can_be_named() {
    let mut count = 0;
    for entry in hardware() {
        let name = &entry.name;
        let text = match entry.kind {
            "reaction wheel" => {
                let wheel = |axis| {
                    format!("[[wheel]]\nname = \"{axis}\"\nmodel = \"{name}\"\naxis = {axis}\n")
                };
                ["[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"].map(wheel).concat()
            }
            "control moment gyro" => {
                format!("[[cmg_array]]\nname = \"a\"\nmodel = \"{name}\"\narrangement = \"box\"\n")
            }
            "thruster" => format!(
                "[[thruster_set]]\nname = \"t\"\nmodel = \"{name}\"\narrangement = \"box\"\n\
                 count = 12\nedges_m = [1, 1, 1]\nposition_m = [0, 0, 0]\n"
            ),
            _ => continue,
        };
        let set = equipment(&text);
        assert!(set.name.ends_with(name.as_str()) && set.mass.is_some(), "{name}");
        count += 1;
    }
    assert_eq!(count, 44);
}

#[test]
fn every_number_of_the_hardware_catalogue_says_where_it_comes_from() {
    let all = hardware();
    assert_eq!(all.len(), 50);
    for (i, entry) in all.iter().enumerate() {
        assert!(all[..i].iter().all(|other| other.name != entry.name), "{} twice", entry.name);
        assert!(!entry.numbers.is_empty() && !entry.provenance.is_empty());
        let of = format!("model.{}", entry.name);
        assert_eq!(entry.provenance[0].of, of);
        // Each source is of a number that is there.
        for row in &entry.provenance[1..] {
            let key = row.of.strip_prefix(&format!("{of}.")).unwrap();
            assert!(entry.numbers.iter().any(|(known, _)| *known == key), "{}", row.of);
        }
        // What no data sheet gives is not published.
        for key in
            ["viscous_friction_nms", "gimbal_inertia_kgm2", "servo_bandwidth_rad_s", "rise_time_s"]
        {
            if entry.numbers.iter().any(|(known, _)| *known == key)
                && entry.provenance[0].grade == Grade::Published
            {
                let row = entry.provenance.iter().find(|row| row.of == format!("{of}.{key}"));
                assert_eq!(row.map(|row| row.grade), Some(Grade::Assumed), "{of}.{key}");
            }
        }
        // A class is no product.
        assert!(!entry.name.contains("class") || entry.provenance[0].grade == Grade::Assumed);
    }
}
