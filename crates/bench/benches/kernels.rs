//! Times of the kernels: `cargo xtask bench` runs this and makes a page of it.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;
use wrasse_bench::{BATCHES, KERNELS, Places, Quantity, STATES, Subject, subject, widened};
use wrasse_spatial::{Instructions, Lanes, Level, Real, Work};
use wrasse_world::{BaseAttitude, Equipment, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// Samples as the peers take them: fifteen batches.
fn settings() -> Criterion {
    Criterion::default()
        .sample_size(15)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(300))
        .without_plots()
}

type Group<'a> = BenchmarkGroup<'a, WallTime>;

/// Every kernel for one vehicle on each level, and for many states on the widest.
fn vehicle<const J: usize>(criterion: &mut Criterion, name: &str) {
    let subject: &Subject<f64, J> = &subject(name).expect("a golden vehicle");
    let mut group = criterion.benchmark_group(name);
    for level in [Level::Base, Level::Avx2].into_iter().filter(|level| level.is_available()) {
        level.restrict();
        for (kernel, quantity) in KERNELS {
            alone(&mut group, &format!("{kernel}.{}", name_of(level)), subject, quantity);
        }
        let mut world = coasting(subject);
        group.bench_function(format!("coasting_step.{}", name_of(level)), |bencher| {
            bencher.iter(|| black_box(&mut world).advance(STEP).is_ok());
        });
    }
    #[cfg(target_arch = "x86_64")]
    match Level::best() {
        Level::Avx512 => many::<wrasse_spatial::Avx512, J>(&mut group, subject),
        Level::Avx2 => many::<wrasse_spatial::Avx2, J>(&mut group, subject),
        Level::Base => many::<wrasse_spatial::Baseline, J>(&mut group, subject),
    }
    group.finish();
}

/// As results call a level.
fn name_of(level: Level) -> &'static str {
    match level {
        Level::Base => "base",
        Level::Avx2 => "avx2",
        Level::Avx512 => "avx512",
    }
}

/// A kernel for one state at a time.
fn alone<const J: usize>(
    group: &mut Group<'_>,
    name: &str,
    subject: &Subject<f64, J>,
    quantity: Quantity,
) {
    let (mut turn, mut places) = (0, Places::new());
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            turn = (turn + 1) % STATES;
            places.call_any(quantity, subject, turn);
        });
    });
}

/// Kernels for eight states at a time.
fn many<I: Instructions, const J: usize>(group: &mut Group<'_>, subject: &Subject<f64, J>) {
    let subject: &Subject<Lanes<8, I>, J> = &widened(subject);
    for (kernel, quantity) in &KERNELS[..BATCHES] {
        let (mut turn, mut places) = (0, Places::new());
        group.bench_function(format!("{kernel}.batch_of_8"), |bencher| {
            bencher.iter(|| {
                turn = (turn + 1) % subject.states.len();
                places.call(*quantity, subject, turn);
            });
        });
    }
}

/// Length of a coasting step (s), as for the peer.
const STEP: f64 = 1e-3;

fn coasting<const J: usize>(of: &Subject<f64, J>) -> OneSystem<J> {
    let mut start = of.states[0].0;
    start.v = start.v.map(|v| 0.1 * v);
    OneSystem::new(&OneSystemSetup {
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
struct Peak<I: Instructions>([Lanes<8, I>; 12]);

impl<I: Instructions> Work for Peak<I> {
    type Out = ();
    #[inline(always)]
    fn run(self) {
        let (mut x, a, b) = (self.0, Lanes::from_f64(0.999_999), Lanes::from_f64(1e-6));
        let on = |x: Lanes<8, I>| x * a + b;
        for _ in 0..100 {
            // By name, so that all of them stay in registers.
            let [c, d, e, f, g, h, i, j, k, l, m, n] = x;
            x = [
                on(c),
                on(d),
                on(e),
                on(f),
                on(g),
                on(h),
                on(i),
                on(j),
                on(k),
                on(l),
                on(m),
                on(n),
            ];
        }
        black_box(&x);
    }
}

/// 100 × 12 × 2 × 8 operations.
fn peak<I: Instructions>(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("peak");
    group.bench_function("lanes_19200_operations", |bencher| {
        bencher.iter(|| {
            let start = [black_box(Lanes::<8, I>::from_f64(1.0)); 12];
            Lanes::<8, I>::apart(Peak(start));
        });
    });
    group.finish();
}

fn all(criterion: &mut Criterion) {
    #[cfg(target_arch = "x86_64")]
    match Level::best() {
        Level::Avx512 => peak::<wrasse_spatial::Avx512>(criterion),
        Level::Avx2 => peak::<wrasse_spatial::Avx2>(criterion),
        Level::Base => peak::<wrasse_spatial::Baseline>(criterion),
    }
    vehicle::<8>(criterion, "one_arm");
    vehicle::<16>(criterion, "two_arms");
}

criterion_group! { name = kernels; config = settings(); targets = all }
criterion_main!(kernels);
