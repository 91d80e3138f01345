//! Several systems in one scene: apart they do not know of each other; coupled they push each other and
//! nothing else.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod branched;

use branched::{J, moving, robot};
use wrasse_dynamics::{BodyId, Frame, JointKind, MassProperties, State};
use wrasse_hardware::{ActuatorCommand, SetPoint, SetPointMotion};
use wrasse_spatial::{Pose, Quat, SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_testing::larger;
use wrasse_world::{
    BaseAttitude, Bushing, Drive, Equipment, FreeBody, Scene, Source, Stepper, SystemId,
    SystemSetup,
};

const FIXED: Stepper = Stepper::Fixed { step: 0.01 };

fn servicer(scene: &mut Scene<J>, start: State<f64, J>) -> SystemId {
    scene.add(&SystemSetup {
        robot: &robot(),
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        start,
        held: &[],
    })
}

fn elsewhere() -> State<f64, J> {
    let start = moving();
    State {
        X_NB: Pose::from_quat(Quat::exp(vec3(0.4, 1.1, -0.3)), vec3(6.0, -3.0, 2.0)),
        q: start.q.map(|q| 0.3 - q),
        v: start.v.map(|v| -0.7 * v),
        ..start
    }
}

/// Joint torques for a second, ten times.
fn fly(scene: &mut Scene<J>, driven: &[SystemId]) {
    let (mut cut, told) = (vec![], ActuatorCommand::default());
    for k in 0..10 {
        scene.begin_period();
        for (i, id) in driven.iter().enumerate() {
            let size = 0.1 * f64::from(k) - 0.3 * if i == 0 { 1.0 } else { -1.0 };
            let drives = [0.9, -0.5, 0.7, -0.3].map(|tau| Drive::Effort(tau * size));
            scene.command(*id, (&drives, Vec3::zero()), &told, 0.1, &mut cut);
        }
        scene.advance(0.1).expect("stays finite");
    }
}

fn bits(scene: &Scene<J>, id: SystemId) -> (Quat<f64>, Vec<f64>) {
    (scene.attitude(id), scene.variables(id).to_vec())
}

#[test]
fn two_systems_without_a_coupling_fly_as_each_alone_bit_for_bit() {
    let alone = |start, first: bool| {
        let mut scene = Scene::new(FIXED);
        let id = servicer(&mut scene, start);
        let (mut cut, told) = (vec![], ActuatorCommand::default());
        for k in 0..10 {
            scene.begin_period();
            let size = 0.1 * f64::from(k) - 0.3 * if first { 1.0 } else { -1.0 };
            let drives = [0.9, -0.5, 0.7, -0.3].map(|tau| Drive::Effort(tau * size));
            scene.command(id, (&drives, Vec3::zero()), &told, 0.1, &mut cut);
            scene.advance(0.1).expect("stays finite");
        }
        bits(&scene, id)
    };
    let mut both = Scene::new(FIXED);
    let first = servicer(&mut both, moving());
    let second = servicer(&mut both, elsewhere());
    fly(&mut both, &[first, second]);
    assert_eq!(bits(&both, first), alone(moving(), true));
    assert_eq!(bits(&both, second), alone(elsewhere(), false));
    assert_ne!(bits(&both, first), alone(elsewhere(), false));
}

/// With error control the step is chosen for both. Measured 2e-13, of a tolerance of 1e-11.
#[test]
fn under_error_control_they_fly_as_each_alone_to_the_tolerance() {
    let stepper = Stepper::Adaptive { tolerance: 1e-11 };
    let mut alone = Scene::new(stepper);
    let id = servicer(&mut alone, moving());
    fly(&mut alone, &[id]);
    let mut both = Scene::new(stepper);
    let first = servicer(&mut both, moving());
    let second = servicer(&mut both, elsewhere());
    fly(&mut both, &[first, second]);
    let (_, alone) = bits(&alone, id);
    let (_, beside) = bits(&both, first);
    for (a, b) in alone.iter().zip(&beside) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}

/// A tool 0.3 m from the last link, and a body whose fixture is near it.
fn coupled(bushing: Bushing, spin: Vec3<f64>) -> (Scene<J>, SystemId, SystemId) {
    let mut scene = Scene::new(Stepper::Fixed { step: 0.002 });
    let servicer = servicer(&mut scene, moving());
    let tool = Frame {
        body: BodyId::Link(3),
        X_BF: Pose::new(Quat::exp(vec3(0.1, 0.2, 0.3)).to_matrix(), vec3(0.3, 0.0, 0.1)),
    };
    let I = Sym3 { xx: 30.0, xy: 1.0, xz: -2.0, yy: 40.0, yz: 0.5, zz: 50.0 };
    let matter = MassProperties::from_central(120.0, vec3(0.2, -0.1, 0.4), I);
    let X_TF = Pose::new(Quat::exp(vec3(-0.3, 0.5, 0.1)).to_matrix(), vec3(-0.5, 0.2, 0.1));
    let X_NE = scene.pose(servicer, &tool);
    let near = Pose::new(Quat::exp(vec3(0.02, -0.01, 0.03)).to_matrix(), vec3(0.01, 0.02, -0.01));
    let X_NT = X_NE * near * X_TF.inverse();
    let body = FreeBody::new(matter, &X_NT, &SpatialVelocity::new(spin, vec3(0.1, -0.2, 0.15)));
    let client = scene.add_body(&body);
    let fixture = Frame { body: BodyId::Base, X_BF: X_TF };
    scene.couple((servicer, tool), (client, fixture), Box::new(bushing));
    (scene, servicer, client)
}

const STIFF: Bushing = Bushing {
    stiffness: Vec3 { x: 3000.0, y: 5000.0, z: 4000.0 },
    damping: Vec3 { x: 40.0, y: 50.0, z: 60.0 },
    turning_stiffness: Vec3 { x: 300.0, y: 500.0, z: 400.0 },
    turning_damping: Vec3 { x: 4.0, y: 5.0, z: 6.0 },
};

/// Joints that slide stay where they are, or they would be gone by 80 m; the others turn freely.
fn slides_stay(scene: &Scene<J>, id: SystemId) -> [Drive; J] {
    let (robot, state) = (scene.robot(id), scene.state(id));
    std::array::from_fn(|j| {
        if robot.joint(j).kind == JointKind::Revolute {
            return Drive::Effort(0.0);
        }
        let here = SetPoint { position: state.q[j], ..SetPoint::default() };
        Drive::Follow(SetPointMotion::between(here, here, 0.1))
    })
}

/// 100,000 steps: what one has gained the other has lost, read from poses and twists. Against the largest
/// that one of them gained or lost, or the floors 1e-15 of |r × p| and of m|v|.
#[test]
fn two_systems_on_a_bushing_keep_their_momentum_to_rounding() {
    let (mut scene, servicer, _) = coupled(STIFF, vec3(0.02, 0.05, -0.03));
    let mut ledger = scene.open_ledger();
    let at_start = scene.momentum(servicer);
    let (mut angular, mut linear) = (0.0_f64, 0.0_f64);
    let stays = slides_stay(&scene, servicer);
    let (told, mut cut) = (ActuatorCommand::default(), vec![]);
    for _ in 0..2000 {
        scene.begin_period();
        scene.command(servicer, (&stays, Vec3::zero()), &told, 0.1, &mut cut);
        scene.advance(0.1).expect("stays finite");
        scene.update_ledger(&mut ledger);
        let (l, a) = scene.momentum(servicer);
        linear = larger(linear, (l - at_start.0).norm());
        angular = larger(angular, (a - at_start.1).norm());
    }
    let [lost_angular, lost_linear, _] = ledger.worst;
    assert!(angular > 1.0 && linear > 1.0, "nothing was exchanged: {angular} {linear}");
    assert!(lost_angular <= larger(1e-14 * angular, 1e-15 * ledger.scale[0]), "{lost_angular:e}");
    assert!(lost_linear <= larger(1e-14 * linear, 1e-15 * ledger.scale[1]), "{lost_linear:e}");
}

/// Kinetic energy, what the bushing has taken and the ledger agree; the damper has dissipated.
#[test]
fn the_work_of_a_bushing_is_booked() {
    let (mut scene, ..) = coupled(STIFF, vec3(0.02, 0.05, -0.03));
    let mut ledger = scene.open_ledger();
    for _ in 0..50 {
        scene.begin_period();
        scene.advance(0.1).expect("stays finite");
        scene.update_ledger(&mut ledger);
    }
    let work = ledger.sources[Source::Couplings].work;
    assert!(work < -0.1, "{work} J");
    assert!(ledger.worst[2] < 1e-6 * ledger.scale[2], "{:e} J", ledger.worst[2]);
}
