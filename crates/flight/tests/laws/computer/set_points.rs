//! Set-points join, and the tool of the believed vehicle follows its reference.

use super::tours::*;
use crate::laws::flights::{Flight, PERIOD, aside, at_rest, setup};
use crate::laws::postures::LAWS;
use wrasse_flight::{Axes, Held, Measurement, Phase, Sensed};
use wrasse_hardware::{ActuatorReadings, SetPointMotion};
use wrasse_spatial::vec3;
use wrasse_testing::{Worst, larger, largest};

/// Position by the Hermite quadrature `h (v₀+v₁)/2 + h² (a₀-a₁)/12`: of fourth order, so that the
/// quintic that joins two set-points does not wiggle. Positions measured 2.0e-10 rad off, where a
/// joint move stops what is left of holding the tool; rates against the trapezium of the
/// accelerations 3.9e-7 rad/s, for h³/12 of their third derivative.
#[test]
fn set_points_join_in_position_and_rate_by_each_law() {
    let (mut position, mut rate) = (Worst::none(), Worst::none());
    for law in LAWS {
        for axes in [Axes::Inertial, Axes::Base] {
            let start = at_rest();
            let mut flight = Flight::new(&setup(law, Measurement::None), start, &tour(axes));
            let commands = flight.fly_on();
            for j in 0..7 {
                for pair in of_joint(&start, &commands, j).windows(2) {
                    let [a, b] = [pair[0], pair[1]];
                    let way = PERIOD * (a.rate + b.rate) / 2.0
                        + PERIOD * PERIOD * (a.acceleration - b.acceleration) / 12.0;
                    position.see((b.position - a.position - way).abs());
                    let gain = PERIOD * (a.acceleration + b.acceleration) / 2.0;
                    rate.see((b.rate - a.rate - gain).abs());
                }
            }
        }
    }
    position.is_below(1e-9);
    rate.is_below(1e-6);
}

/// Between two set-points the quintic stays within what the set-points themselves do. Measured 1.4e-4
/// of the largest acceleration.
#[test]
fn nothing_wiggles_between_set_points() {
    let start = at_rest();
    let mut worst = Worst::none();
    for law in LAWS {
        let mut flight = Flight::new(&setup(law, Measurement::None), start, &tour(Axes::Inertial));
        let commands = flight.fly_on();
        for j in 0..7 {
            let points = of_joint(&start, &commands, j);
            let most = largest(points.iter().map(|p| p.acceleration.abs()));
            for pair in points.windows(2) {
                let between = SetPointMotion::between(pair[0], pair[1], PERIOD);
                let ends = larger(pair[0].acceleration.abs(), pair[1].acceleration.abs());
                for part in [0.2, 0.4, 0.6, 0.8] {
                    let inside = between.at(part * PERIOD).acceleration.abs();
                    worst.see(larger(inside - ends, 0.0) / most);
                }
            }
        }
    }
    worst.is_below(1e-3);
}

/// The tool of the believed vehicle is on its reference, by a step of third order of 10 ms: measured
/// 1.6e-8 m and 2.5e-8 rad.
#[test]
fn the_believed_tool_stays_on_its_reference() {
    let (mut off, mut turned) = (Worst::none(), Worst::none());
    for law in LAWS {
        for axes in [Axes::Inertial, Axes::Base] {
            let phases = [aside(axes, 4.0)];
            let mut flight = Flight::new(&setup(law, Measurement::None), at_rest(), &phases);
            while !flight.computer.done() {
                flight.step().unwrap();
                let (m, rad) = flight.computer.believed_tool_error();
                off.see(m);
                turned.see(rad);
            }
        }
    }
    off.is_below(1e-7);
    turned.is_below(1e-7);
}

/// Of an error of the tool `e^{-2 h}` is left after each period, with a tool gain of 2/s. Measured 1.0e-6
/// off.
#[test]
fn a_measured_error_is_taken_back_at_the_tool_gain() {
    let (shift, periods) = (vec3(0.004, -0.003, 0.002), 100);
    let phases = [Phase::Hold { what: Held::Tool, duration: 2.0 }];
    let mut worst = Worst::none();
    for law in LAWS {
        let mut flight = Flight::new(&setup(law, Measurement::Base), at_rest(), &phases);
        flight.step().unwrap();
        let mut before: Option<f64> = None;
        for k in 0..periods {
            // The base was pushed aside once, and then does what the law believes.
            let mut state = flight.computer.believed_state();
            if k == 0 {
                state.X_NB.translation += shift;
            }
            flight.computer.step(&Sensed::perfect(&state, ActuatorReadings::default())).unwrap();
            let (off, _) = flight.computer.believed_tool_error();
            // The first set-points still join the rates from before to those that take the error back.
            if let Some(before) = before
                && k > 1
            {
                worst.see((off / before / f64::exp(-2.0 * PERIOD) - 1.0).abs());
            }
            before = Some(off);
        }
    }
    worst.is_below(1e-5);
}
