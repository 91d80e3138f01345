//! Propellant that swings in a plane: against Newton's equations written out for a body with a rod and a
//! point on it, and against the frequency that they give for small swings under thrust.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

use wrasse_dynamics::{BodyId, Frame, MassProperties, PerBody, Robot, State, kinematics};
use wrasse_hardware::{ActuatorCommand, Slosh, Tank, TankShape};
use wrasse_spatial::{Pose, SpatialForce, Sym3, Vec3, vec3};
use wrasse_world::{BaseAttitude, Equipment, SloshPendulum, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

const J: usize = 4;
const UP: Vec3<f64> = Vec3 { x: 0.0, y: 0.0, z: 1.0 };
const TANK: Slosh = Slosh {
    axis_B: UP,
    shape: TankShape::UprightCylinder { radius: 0.4, height: 0.6 },
    density: 1000.0,
    damping_ratio: 0.04,
    acceleration: 0.1,
    stiffness: 0.0,
};
const PROPELLANT: Tank<f64> =
    Tank { position_B: Vec3 { x: 0.0, y: 0.0, z: 0.6 }, propellant: 150.0 };

/// A base of 300 kg; its propellant above its centre of mass if nothing else is said.
fn robot(p_cm: Vec3<f64>) -> Robot<f64, J> {
    let I = Sym3::diagonal(60.0, 80.0, 70.0);
    Robot::new(MassProperties::from_central(300.0, p_cm, I), &[]).unwrap()
}

fn world(p_cm: Vec3<f64>, slosh: Slosh, start: State<f64, J>) -> OneSystem<J> {
    let mut equipment = Equipment { slosh: Some(slosh), ..Equipment::default() };
    equipment.actuators.tank = Some(PROPELLANT);
    OneSystem::new(&OneSystemSetup {
        robot: &robot(p_cm),
        limits: &[],
        actuator: None,
        equipment,
        base: BaseAttitude::Free,
        stepper: Stepper::Adaptive { tolerance: 1e-12 },
        start,
        held: &[],
    })
}

/// The body without what swings, about its centre of mass.
struct Body {
    mass: f64,
    /// About y (kg·m²).
    inertia: f64,
    p_cm: Vec3<f64>,
    /// (m)
    hinge: Vec3<f64>,
}

fn body(p_cm: Vec3<f64>, p: &SloshPendulum) -> Body {
    let depth = PROPELLANT.propellant / (1000.0 * std::f64::consts::PI * 0.16);
    let bottom = PROPELLANT.position_B - UP * (0.5 * depth);
    let at_rest =
        MassProperties::from_central(p.rest_mass, bottom + UP * p.rest_height, Sym3::zero());
    let both = MassProperties::from_central(300.0, p_cm, Sym3::diagonal(60.0, 80.0, 70.0));
    let M = both.and(&at_rest).M_F_F;
    let p_cm = M.centre_of_mass();
    let inertia = (M.central() * vec3(0.0, 1.0, 0.0)).y;
    Body { mass: M.mass, inertia, p_cm, hinge: bottom + UP * p.hinge_height }
}

/// With M and I of the body without what swings, d from its centre of mass up to the hinge and thrust along the axis
/// through it: `ω² = a/L (1 + m/M + m d (d - L)/I)`, `a` the common acceleration. Measured 1e-10, which is
/// what is left of the velocity products.
#[test]
fn a_tank_under_thrust_swings_at_the_frequency_of_the_closed_form() {
    let undamped = Slosh { damping_ratio: 0.0, ..TANK };
    let p = SloshPendulum::of(&undamped, PROPELLANT.propellant).unwrap();
    for p_cm in [Vec3::zero(), vec3(0.0, 0.0, 1.4), vec3(0.0, 0.0, -1.0)] {
        let b = body(p_cm, &p);
        let (d, thrust) = (b.hinge.z - b.p_cm.z, 25.0);
        let a = thrust / (b.mass + p.mass);
        let square =
            a / p.length * (1.0 + p.mass / b.mass + p.mass * d * (d - p.length) / b.inertia);
        let small = 1e-5;
        let mut q = [0.0; J];
        q[1] = small;
        let mut world = world(p_cm, undamped, State { q, ..State::default() });
        let force = SpatialForce::new(b.p_cm.cross(UP * thrust), UP * thrust);
        let on = PerBody { base: force, links: [SpatialForce::zero(); J] };
        world.set_outside_wrench(Box::new(move |_, _| on), &[]);
        let found = -world.dynamics().nudot.joints[1] / small;
        assert!((found / square - 1.0).abs() < 1e-9, "{found} {square}");
        // A quarter of a period on, the rod goes through the axis.
        let quarter = 0.5 * std::f64::consts::PI / square.sqrt();
        world.command(&[], Vec3::zero(), &ActuatorCommand::default(), quarter);
        world.advance(quarter).unwrap();
        let left = world.state().q[1] / small;
        assert!(left.abs() < 1e-6, "{left}");
    }
}

/// Place and attitude of the body, angle of the rod in N (about y), and their rates.
type Flat = [f64; 8];

/// Newton's equations of a body and a point on a massless rod, in the plane of x and z; `tau` is the torque
/// on the rod about its hinge. The tension follows from the rod's length.
fn rates(b: &Body, p: &SloshPendulum, force: &dyn Fn(f64) -> (f64, f64, f64), s: &Flat) -> Flat {
    let [_, _, turn, rod, vx, vz, turning, swinging] = *s;
    let (m, L) = (p.mass, p.length);
    let dot = |a: (f64, f64), c: (f64, f64)| a.0 * c.0 + a.1 * c.1;
    let (sin, cos) = (turn.sin(), turn.cos());
    // A rotation about y takes z to (sin, cos) and x to (cos, -sin).
    let of_body = |x: f64, z: f64| (cos * x + sin * z, -sin * x + cos * z);
    let arm = of_body(b.hinge.x - b.p_cm.x, b.hinge.z - b.p_cm.z);
    let arm_rate = (arm.1, -arm.0);
    let (up, up_rate) = ((rod.sin(), rod.cos()), (rod.cos(), -rod.sin()));
    let tau = -p.damping * (swinging - turning);
    let (fx, fz, moment) = force(turn);
    // The hinge's acceleration is g0 + T g1 for a tension T.
    let free_turn = (moment - tau) / b.inertia;
    let torque_of = |f: (f64, f64)| arm.1 * f.0 - arm.0 * f.1;
    let across = (up_rate.0 * tau / L, up_rate.1 * tau / L);
    let turn0 = free_turn + torque_of(across) / b.inertia;
    let turn1 = -torque_of(up) / b.inertia;
    let g0 = (
        (fx + across.0) / b.mass + turn0 * arm_rate.0 - turning * turning * arm.0,
        (fz + across.1) / b.mass + turn0 * arm_rate.1 - turning * turning * arm.1,
    );
    let g1 = (-up.0 / b.mass + turn1 * arm_rate.0, -up.1 / b.mass + turn1 * arm_rate.1);
    // Along the rod: T/m = (g0 + T g1)·up + L α̇².
    let T = (dot(g0, up) + L * swinging * swinging) / (1.0 / m - dot(g1, up));
    let g = (g0.0 + T * g1.0, g0.1 + T * g1.1);
    // Across it: -τ/(L m) = g·up' - L α̈.
    let swing = (dot(g, up_rate) + tau / (L * m)) / L;
    let ax = (fx + across.0 - T * up.0) / b.mass;
    let az = (fz + across.1 - T * up.1) / b.mass;
    [vx, vz, turning, swinging, ax, az, turn0 + T * turn1, swing]
}

fn stepped(s: &Flat, h: f64, f: &dyn Fn(&Flat) -> Flat) -> Flat {
    let at = |k: &Flat, h: f64| core::array::from_fn(|i| s[i] + h * k[i]);
    let a = f(s);
    let b = f(&at(&a, 0.5 * h));
    let c = f(&at(&b, 0.5 * h));
    let d = f(&at(&c, h));
    core::array::from_fn(|i| s[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
}

/// A damped swing through more than half a turn beside a thrust off the centre of mass, 30 s long, by a Runge–Kutta
/// of its own at 1 ms. Measured 2e-11 m of the base and of the bob.
#[test]
fn a_swing_in_a_plane_is_that_of_newtons_equations() {
    let (p_cm, pulled) = (vec3(0.05, 0.0, -0.1), vec3(-3.0, 0.0, 8.0));
    let p = SloshPendulum::of(&TANK, PROPELLANT.propellant).unwrap();
    let b = body(p_cm, &p);
    let mut v = [0.0; J];
    v[1] = 1.1;
    let mut world = world(p_cm, TANK, State { v, ..State::default() });
    let on = PerBody {
        base: SpatialForce::new(vec3(0.0, 0.4, 0.0), pulled),
        links: [SpatialForce::zero(); J],
    };
    world.set_outside_wrench(Box::new(move |_, _| on), &[]);
    let moment = 0.4 - b.p_cm.cross(pulled).y;
    let force = |turn: f64| {
        let (sin, cos) = (turn.sin(), turn.cos());
        (cos * pulled.x + sin * pulled.z, -sin * pulled.x + cos * pulled.z, moment)
    };
    let mut s: Flat = [b.p_cm.x, b.p_cm.z, 0.0, 0.0, 0.0, 0.0, 0.0, v[1]];
    let (mut worst, mut farthest) = (0.0_f64, 0.0_f64);
    for _ in 0..30 {
        for _ in 0..1000 {
            s = stepped(&s, 1e-3, &|s| rates(&b, &p, &force, s));
        }
        world.command(&[], Vec3::zero(), &ActuatorCommand::default(), 1.0);
        world.advance(1.0).unwrap();
        let state = world.state();
        let p_N = kinematics(world.robot(), &state).X_NB(BodyId::Base).point(b.p_cm);
        let end = Pose { translation: UP * -p.length, ..Pose::identity() };
        let bob = world.pose(&Frame { body: BodyId::Link(1), X_BF: end }).translation;
        let (sin, cos) = (s[2].sin(), s[2].cos());
        let (x, z) = (b.hinge.x - b.p_cm.x, b.hinge.z - b.p_cm.z);
        let hinge = (s[0] + cos * x + sin * z, s[1] - sin * x + cos * z);
        let expected = (hinge.0 - p.length * s[3].sin(), hinge.1 - p.length * s[3].cos());
        worst = worst.max((p_N.x - s[0]).abs()).max((p_N.z - s[1]).abs());
        worst = worst.max((bob.x - expected.0).abs()).max((bob.z - expected.1).abs());
        farthest = farthest.max((s[3] - s[2]).abs());
    }
    assert!(worst < 1e-9, "{worst:e} m");
    assert!(farthest > 3.2, "swung by {farthest} rad");
}
