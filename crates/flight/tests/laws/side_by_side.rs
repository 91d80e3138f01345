//! Many vehicles side by side fly as each would alone, to the bit.

use crate::flights::aside;
use crate::spanning_states::{servicer, setup, states};
use std::array;
use wrasse_dynamics::State;
use wrasse_flight::{
    ArmLaw, Asked, Axes, FlightComputer, Guidance, Guided, Held, JointTarget, JointTiming,
    PeriodMemory, Phase, Sensed, Setup, asked_side_by_side, states_side_by_side,
};
use wrasse_hardware::ActuatorReadings;
use wrasse_spatial::{Lanes, SpatialForce};

const N: usize = 4;
const J: usize = 7;

/// A vehicle that flies its phases alone, and what tells the same vehicle in a lane what to do.
struct Vehicle {
    alone: FlightComputer<f64, J>,
    guidance: Guidance<f64, J>,
    start: State<f64, J>,
}

fn phases() -> Vec<Phase<f64, J>> {
    let hold = |what, duration| Phase::Hold { what, duration };
    let positions = array::from_fn(|j| (j % 2 == 0).then_some(0.2));
    vec![
        aside(Axes::Inertial, 0.2),
        hold(Held::Tool, 0.05),
        hold(Held::Nothing, 0.03),
        Phase::MoveJoints {
            to: JointTarget::Positions(positions),
            timing: JointTiming::Duration(0.1),
        },
        hold(Held::Joints, 0.03),
        aside(Axes::Base, 0.1),
    ]
}

fn vehicles(setup: &Setup<f64, J>) -> [Vehicle; N] {
    let (robot, _) = servicer();
    let all = states::<J>();
    // One of them in a singular posture.
    [9, 16, 10, 27].map(|k| Vehicle {
        alone: FlightComputer::new(*setup, &robot, &phases()),
        guidance: Guidance::new(&phases()),
        start: all[k],
    })
}

#[test]
fn a_vehicle_flies_in_a_lane_as_it_flies_alone() {
    let (robot, tool) = servicer::<J>();
    let robot_in_lanes = robot.cast::<Lanes<N>>();
    let no_push = SpatialForce::zero();
    for law in [ArmLaw::Terrestrial, ArmLaw::AttitudeHeld, ArmLaw::FreeFloating] {
        let setup = setup(law, tool);
        let (in_lanes, mut vehicles) = (setup.bare::<Lanes<N>>(), vehicles(&setup));
        let mut memory = PeriodMemory::new();
        let mut sensed: [State<f64, J>; N] = array::from_fn(|i| vehicles[i].start);
        let mut periods = 0;
        while !vehicles[0].alone.done() {
            let together = states_side_by_side(&sensed);
            memory.look(&robot_in_lanes, &in_lanes, &together);
            let asked: [Asked<f64, J>; N] = array::from_fn(|i| {
                let memory = memory.lane(i);
                let of = Guided { robot: &robot, setup: &setup, memory: &memory };
                vehicles[i].guidance.begin(&of).unwrap();
                vehicles[i].guidance.next(&of, &no_push)
            });
            let asked = asked_side_by_side(&asked).expect("the same phase");
            let told = memory.act(&robot_in_lanes, &in_lanes, &together, &asked, None);
            for (i, vehicle) in vehicles.iter_mut().enumerate() {
                let reading = Sensed::perfect(&sensed[i], ActuatorReadings::default());
                let command = vehicle.alone.step(&reading).unwrap();
                for j in 0..J {
                    assert_eq!(command.effort[j], told.effort[j].lane(i), "{law:?}, lane {i}");
                    let (a, b) = (command.set_points[j], told.set_points[j]);
                    assert_eq!(a.position, b.position.lane(i));
                    assert_eq!((a.rate, a.acceleration), (b.rate.lane(i), b.acceleration.lane(i)));
                }
                let torque = told.attitude_torque_B.map(|x| x.lane(i));
                assert_eq!(command.attitude_torque_B, torque, "{law:?}, lane {i}");
                assert_eq!(vehicle.alone.believed_state(), memory.lane(i).believed_state());
                sensed[i] = vehicle.alone.believed_state();
            }
            periods += 1;
        }
        assert_eq!(periods, 51, "all phases were flown");
    }
}
