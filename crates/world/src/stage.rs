//! One stage of a step: how fast every variable of every system changes.

use crate::couplings::{Coupled, FrameMotion, Side};
use crate::effectors::{Load, Stage};
use crate::environment::Environment;
use crate::gears::with_gears;
use crate::scene::{Clock, Scene, SystemId};
use crate::setup::{BaseAttitude, Drive};
use crate::source::{Booking, Bookings, Source};
use crate::system::System;
use crate::variables::{put_vector, vector};
use std::mem::take;
use wrasse_dynamics::{
    Configuration, Dynamics, ForwardDynamics, Frame, JointDrive, Kinematics, Outside, PerBody,
    State, accelerate,
};
use wrasse_hardware::through_gears;
use wrasse_spatial::{Quat, SpatialForce, Vec3, rotation_vector_rate};

/// Places for what the right-hand side works out, used again and again.
#[derive(Debug, Default)]
pub(crate) struct Places<const J: usize> {
    systems: Vec<SystemPlaces<J>>,
    /// A row without a displacement, and one for the rates there.
    pub(crate) zeros: Vec<f64>,
    rates: Vec<f64>,
    /// Variables of a coupling at the stage.
    own: Vec<f64>,
}

/// Those of one system.
#[derive(Debug)]
pub(crate) struct SystemPlaces<const J: usize> {
    pub(crate) configuration: Configuration<f64, J>,
    forward: ForwardDynamics<f64, J>,
    state: State<f64, J>,
    /// The variables and the attitude at the stage.
    row: Vec<f64>,
    quat_NB: Quat<f64>,
    /// Efforts on the joints beside what drives them (N·m or N).
    on_joints: [f64; J],
    /// Wrenches on the bodies at their origins in their axes, where anything pushes them.
    on_bodies: Option<Box<PerBody<SpatialForce<f64>, J>>>,
    /// Of couplings about the origin of N, inertial axes.
    coupled_N: SpatialForce<f64>,
    /// Torque on the base of what turns against it, base axes (N·m).
    internal_B: Vec3<f64>,
}

impl<const J: usize> Default for SystemPlaces<J> {
    fn default() -> Self {
        Self {
            configuration: Configuration::new(),
            forward: ForwardDynamics::new(),
            state: State::default(),
            row: vec![],
            quat_NB: Quat::identity(),
            on_joints: [0.0; J],
            on_bodies: None,
            coupled_N: SpatialForce::zero(),
            internal_B: Vec3::zero(),
        }
    }
}

impl<const J: usize> Places<J> {
    /// For so many systems, with rows of so many numbers.
    pub(crate) fn new(systems: usize, length: usize) -> Self {
        Self {
            systems: (0..systems).map(|_| SystemPlaces::default()).collect(),
            zeros: vec![0.0; length],
            rates: vec![0.0; length],
            own: Vec::with_capacity(length),
        }
    }
    pub(crate) fn of(&mut self, system: usize) -> &mut SystemPlaces<J> {
        if self.systems.len() <= system {
            self.systems.resize_with(system + 1, SystemPlaces::default);
        }
        &mut self.systems[system]
    }
}

impl<const J: usize> Scene<J> {
    /// Rates at displacement `d`, `t` (s) into the current set-points: those of all systems, one after
    /// the other, then those of the bookings.
    pub(crate) fn rates(
        &self,
        places: &mut Places<J>,
        (clock, t): (&Clock, f64),
        d: &[f64],
        rates: &mut [f64],
    ) {
        let mut at = 0;
        for (i, system) in self.systems.iter().enumerate() {
            let Some(system) = system else { continue };
            let length = system.variables.len();
            system.stand(&d[at..at + length], t, places.of(i));
            at += length;
        }
        let (mut of_systems, rest) = rates.split_at_mut(at);
        let of_couplings = self.couplings.iter().flatten().map(|c| c.row.len()).sum();
        let (mut of_couplings, booked) = rest.split_at_mut(of_couplings);
        booked.fill(0.0);
        for coupled in self.couplings.iter().flatten() {
            let length = coupled.row.len();
            let (own, rest) = of_couplings.split_at_mut(length);
            own.fill(0.0);
            if !coupled.by.is_idle() && !coupled.is_within_a_body() {
                self.push_apart(places, coupled, (&d[at..at + length], own), booked);
            }
            (of_couplings, at) = (rest, at + length);
        }
        at = 0;
        for (i, system) in self.systems.iter().enumerate() {
            let Some(system) = system else { continue };
            let length = system.variables.len();
            let (own, rest) = of_systems.split_at_mut(length);
            let turn = vector(d, at);
            let around = (clock, &self.environment);
            system.rates(around, (t, turn), places.of(i), own, booked);
            (of_systems, at) = (rest, at + length);
        }
    }

    /// The wrench of a coupling and its opposite: the same six numbers about the origin of N, added to
    /// one and taken from the other.
    fn push_apart(
        &self,
        places: &mut Places<J>,
        coupled: &Coupled,
        (d, rates): (&[f64], &mut [f64]),
        booked: &mut [f64],
    ) {
        let [E, F] =
            [coupled.E, coupled.F].map(|side| self.frame_motion(places, side.system, &side.frame));
        places.own.clear();
        places.own.extend(coupled.row.iter().zip(d).map(|(x, d)| x + d));
        let on_F = coupled.by.act(&E, &F, &places.own, rates);
        let about_origin = on_F.about(-F.X_NF.translation);
        let at_E = on_F.about(E.X_NF.translation - F.X_NF.translation);
        let power = F.V_NF_N.power(&on_F) - E.V_NF_N.power(&at_E);
        Bookings::book(booked, coupled.by.source(), &Booking::of_work(power));
        self.push(places, coupled.F, &about_origin);
        self.push(places, coupled.E, &-about_origin);
    }

    pub(crate) fn frame_motion(
        &self,
        places: &mut Places<J>,
        id: SystemId,
        frame: &Frame<f64>,
    ) -> FrameMotion {
        let at = places.of(id.0);
        let k = at.kinematics(self.system(id));
        FrameMotion { X_NF: k.pose(frame), V_NF_N: k.velocity(frame) }
    }

    /// A wrench about the origin of N, inertial axes, on the body that carries a frame.
    fn push(&self, places: &mut Places<J>, side: Side, F_N: &SpatialForce<f64>) {
        let at = places.of(side.system.0);
        let body = side.frame.body;
        let X_NB = at.kinematics(self.system(side.system)).X_NB(body);
        let at_body = F_N.about(X_NB.translation);
        let none = || Box::new(PerBody::filled(SpatialForce::zero()));
        at.on_bodies.get_or_insert_with(none)[body] += SpatialForce::new(
            X_NB.rotation.transpose_mul(at_body.torque),
            X_NB.rotation.transpose_mul(at_body.force),
        );
        at.coupled_N += *F_N;
    }

    /// Accelerations and forces of a system now, and the torque on its base of what turns against it.
    pub(crate) fn at_now(&self, id: SystemId) -> (Dynamics<f64, J>, Vec3<f64>) {
        let mut places = self.places.take().unwrap_or_default();
        let clock = Clock { within: self.clock.into_period, ..self.clock };
        let (zeros, mut rates) = (take(&mut places.zeros), take(&mut places.rates));
        self.rates(&mut places, (&clock, clock.into_period), &zeros, &mut rates);
        (places.zeros, places.rates) = (zeros, rates);
        let at = places.of(id.0);
        let found = (at.forward.found, at.internal_B);
        self.places.set(Some(places));
        found
    }
}

impl<const J: usize> SystemPlaces<J> {
    fn kinematics<'a>(&'a self, system: &'a System<J>) -> Kinematics<'a, f64, J> {
        let posture = self.configuration.posture;
        Kinematics { robot: &system.robot, state: &self.state, posture }
    }
}

impl<const J: usize> System<J> {
    /// Where the system is at displacement `d`, `t` (s) into the current set-points.
    pub(crate) fn stand(&self, d: &[f64], t: f64, at: &mut SystemPlaces<J>) {
        at.row.clear();
        at.row.extend(self.row.iter().zip(d).map(|(x, d)| x + d));
        at.quat_NB = self.quat_NB * Quat::exp(vector(d, 0));
        at.state = self.expand(&at.row, &at.quat_NB, t, &mut at.configuration);
        at.coupled_N = SpatialForce::zero();
        if let Some(on) = &mut at.on_bodies {
            **on = PerBody::filled(SpatialForce::zero());
        }
    }

    /// Rates of its variables, and what the sources give.
    fn rates(
        &self,
        around: (&Clock, &Environment),
        (t, turn): (f64, Vec3<f64>),
        at: &mut SystemPlaces<J>,
        rates: &mut [f64],
        booked: &mut [f64],
    ) {
        rates.fill(0.0);
        let (on_base, total_N) = self.load(around, t, at, rates, booked);
        let mut outside = at.on_bodies.as_ref().map_or_else(Outside::nothing, |on| (&**on).into());
        outside.base += on_base;
        let (nu, drives) = (at.state.velocity(), self.joint_drives(t, &at.on_joints));
        let (mode, forward) = (self.base.mode(), &mut at.forward);
        let mut under = |drives: &[JointDrive<f64>; J]| {
            accelerate(&self.robot, &at.configuration, &nu, drives, mode, outside, forward);
            forward.found.force.joints
        };
        if self.followers.is_empty() {
            under(&drives);
        } else {
            with_gears(&self.followers, &drives, &mut under);
            // What a follower takes is taken from the drive of its leader.
            through_gears(&self.followers, &mut at.forward.found.force.joints);
            through_gears(&self.followers, &mut at.on_joints);
        }
        self.book_drives(at, booked);
        let (v, found, state) = (&self.variables, &at.forward.found, &at.state);
        let (X_NB, w_NB_B) = (&state.X_NB, state.V_NB_B.angular);
        let given_N = X_NB.rotation * (found.force.base.torque + self.actuator_torque_B);
        put_vector(rates, 0, rotation_vector_rate(turn, w_NB_B));
        let n = self.robot.joint_count();
        rates[v.q()].copy_from_slice(&state.v[..n]);
        rates[v.v()].copy_from_slice(&found.nudot.joints[..n]);
        let linear = vector(&at.row, v.linear());
        put_vector(rates, v.centre_of_mass(), linear * (1.0 / self.mass));
        put_vector(rates, v.linear(), total_N.force);
        put_vector(rates, v.angular(), total_N.torque + given_N);
        put_vector(rates, v.given(), given_N);
    }

    /// What the effectors and the environment do: on the base at Bo in base axes, the ideal actuator and what turns against
    /// the base with it; and what comes from outside, about the origin of N in inertial axes.
    fn load(
        &self,
        (clock, environment): (&Clock, &Environment),
        t: f64,
        at: &mut SystemPlaces<J>,
        rates: &mut [f64],
        booked: &mut [f64],
    ) -> (SpatialForce<f64>, SpatialForce<f64>) {
        let SystemPlaces { configuration, state, row, on_joints, on_bodies, coupled_N, .. } = at;
        let sees_links = environment.acts() || self.effectors.iter().any(|e| e.sees_links());
        let posture = sees_links.then_some(configuration.posture);
        let k = posture.map(|posture| Kinematics { robot: &self.robot, state, posture });
        let (period_start, within) = (clock.period_start, clock.within);
        let drives = &self.drives;
        let stage = Stage { state, drives, k: k.as_ref(), period_start, t, within };
        *on_joints = [0.0; J];
        let (mut on_base, mut total_N) = (SpatialForce::zero(), *coupled_N);
        let mut internal_B = Vec3::zero();
        for (i, effector) in self.effectors.iter().enumerate() {
            if self.base == BaseAttitude::Held && !effector.acts_on_held_base() {
                continue;
            }
            let mut load = Load::nothing(on_joints, on_bodies);
            let own = self.variables.effector(i);
            effector.act(&stage, &row[own.clone()], &mut load, &mut rates[own]);
            let given = load.given(state);
            Bookings::book(booked, effector.source(), &given);
            total_N += SpatialForce::new(given.angular, given.linear);
            internal_B += load.internal_B;
            on_base += load.on_base;
        }
        if let Some(k) = k.as_ref().filter(|_| environment.acts()) {
            let mut load = Load::nothing(on_joints, on_bodies);
            environment.act(k, &mut load);
            let given = load.given(state);
            Bookings::book(booked, Source::Gravity, &given);
            total_N += SpatialForce::new(given.angular, given.linear);
        }
        on_base.torque += self.actuator_torque_B + internal_B;
        at.internal_B = internal_B;
        (on_base, total_N)
    }

    /// Power of the joint drives, of the ideal actuator and of what holds an attitude.
    fn book_drives(&self, at: &SystemPlaces<J>, booked: &mut [f64]) {
        let (found, state) = (&at.forward.found, &at.state);
        let torque_B = found.force.base.torque + self.actuator_torque_B;
        let by_actuator =
            Booking::of_turn(state.X_NB.rotation * torque_B, torque_B.dot(state.V_NB_B.angular));
        Bookings::book(booked, Source::AttitudeActuator, &by_actuator);
        let joints = self.robot.joints();
        // What springs do beside the drives is booked as theirs.
        let by_drive = |j: usize| match self.drives[j] {
            Drive::Effort(tau) => tau,
            Drive::Follow(_) => found.force.joints[j] - at.on_joints[j],
        };
        let power = joints.fold(0.0, |sum, j| sum + by_drive(j) * state.v[j]);
        Bookings::book(booked, Source::JointDrives, &Booking::of_work(power));
    }
}
