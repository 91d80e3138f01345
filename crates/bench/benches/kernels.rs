//! Times of the kernels: `cargo xtask bench` runs this and makes a page of it.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;
use wrasse_bench::{KERNELS, STATES, Subject, Work, subject, widened};
use wrasse_lanes::{Kernel, Level};
use wrasse_spatial::{Lanes, Real};
use wrasse_world::{BaseAttitude, Equipment, Stepper, World, WorldSetup};

/// Samples as the peers take them: fifteen batches.
fn settings() -> Criterion {
    Criterion::default()
        .sample_size(15)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .without_plots()
}

/// Every kernel alone, alone on AVX2, and in lanes on the widest level there is.
fn vehicle<const J: usize>(criterion: &mut Criterion, name: &str) {
    let one: Subject<f64, J> = subject(name).expect("a golden vehicle");
    let many = widened(&one);
    let mut group = criterion.benchmark_group(name);
    for (kernel, quantity) in KERNELS {
        for (how, level) in [("single", Level::Base), ("single_avx2", Level::Avx2)] {
            let mut turn = 0;
            group.bench_function(format!("{kernel}.{how}"), |bencher| {
                bencher.iter(|| {
                    turn = (turn + 1) % STATES;
                    level.run(Work { quantity, subject: &one, state: turn });
                });
            });
        }
        let (mut turn, level) = (0, Level::best());
        group.bench_function(format!("{kernel}.lanes"), |bencher| {
            bencher.iter(|| {
                turn = (turn + 1) % STATES;
                level.run(Work { quantity, subject: &many, state: turn });
            });
        });
    }
    let mut world = coasting(&one);
    group.bench_function("coasting_step.single", |bencher| {
        bencher.iter(|| black_box(&mut world).advance(STEP).is_ok());
    });
    group.finish();
}

/// Length of a coasting step (s), as for the peer.
const STEP: f64 = 1e-3;

fn coasting<const J: usize>(of: &Subject<f64, J>) -> World<J> {
    let mut start = of.states[0].0;
    start.v = start.v.map(|v| 0.1 * v);
    World::new(&WorldSetup {
        robot: &of.robot,
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        stepper: Stepper::Fixed { step: STEP },
        start,
        held: &[],
    })
}

/// Products and sums that wait for nothing: what a core can do at most, without fusing them.
struct Peak([Lanes<8>; 12]);

impl Kernel for Peak {
    type Out = ();
    #[inline(always)]
    fn run(self) {
        let (mut x, a, b) = (self.0, Lanes::from_f64(0.999_999), Lanes::from_f64(1e-6));
        for _ in 0..100 {
            for x in &mut x {
                *x = *x * a + b;
            }
        }
        black_box(&x);
    }
}

/// 100 × 12 × 2 × 8 operations.
fn peak(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("peak");
    group.bench_function("lanes_19200_operations", |bencher| {
        bencher.iter(|| Level::best().run(Peak([black_box(Lanes::from_f64(1.0)); 12])));
    });
    group.finish();
}

fn all(criterion: &mut Criterion) {
    peak(criterion);
    vehicle::<7>(criterion, "one_arm");
    vehicle::<13>(criterion, "two_arms");
}

criterion_group! { name = kernels; config = settings(); targets = all }
criterion_main!(kernels);
