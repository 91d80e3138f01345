//! Times of the kernels: `cargo xtask bench` runs this and makes a page of it.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;
use wrasse_bench::{Call, DERIVATIVES, KERNELS, STATES, Subject, subject, widened};
use wrasse_lanes::{Level, OnAnyLevel};
use wrasse_spatial::{Baseline, Instructions, Lanes, Real, Work};
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
    let subject: &Subject<f64, J> = &subject(name).expect("a golden vehicle");
    let mut group = criterion.benchmark_group(name);
    for (kernel, quantity) in KERNELS {
        alone(&mut group, kernel, |state| Call { quantity, subject, state });
    }
    for (kernel, quantity) in DERIVATIVES {
        alone(&mut group, kernel, |state| Call { quantity, subject, state });
    }
    // With two lanes at a time nothing flies side by side.
    Level::best().choose_wide(InLanes { group: &mut group, subject });
    let mut world = coasting(subject);
    group.bench_function("coasting_step.single", |bencher| {
        bencher.iter(|| black_box(&mut world).advance(STEP).is_ok());
    });
    group.finish();
}

type Group<'a> = BenchmarkGroup<'a, WallTime>;

/// A kernel for single numbers, by the calls for its states.
fn alone<W: Work>(group: &mut Group<'_>, kernel: &str, call: impl Fn(usize) -> W) {
    built_for::<Baseline, W>(group, &format!("{kernel}.single"), &call);
    #[cfg(target_arch = "x86_64")]
    if Level::Avx2.is_available() {
        built_for::<wrasse_lanes::Avx2, W>(group, &format!("{kernel}.single_avx2"), &call);
    }
}

fn built_for<I: Instructions, W: Work>(
    group: &mut Group<'_>,
    name: &str,
    call: &impl Fn(usize) -> W,
) {
    let mut turn = 0;
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            turn = (turn + 1) % STATES;
            I::run(call(turn))
        });
    });
}

/// Kernels for eight states at a time.
struct InLanes<'a, 'g, const J: usize> {
    group: &'a mut Group<'g>,
    subject: &'a Subject<f64, J>,
}

impl<const J: usize> OnAnyLevel for InLanes<'_, '_, J> {
    type Out = ();
    fn with<I: Instructions>(self) {
        let subject: &Subject<Lanes<8, I>, J> = &widened(self.subject);
        for (kernel, quantity) in KERNELS {
            let mut turn = 0;
            self.group.bench_function(format!("{kernel}.lanes"), |bencher| {
                bencher.iter(|| {
                    turn = (turn + 1) % STATES;
                    Lanes::<8, I>::apart(Call { quantity, subject, state: turn });
                });
            });
        }
    }
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
struct PeakOf<'a>(&'a mut Criterion);

impl OnAnyLevel for PeakOf<'_> {
    type Out = ();
    fn with<I: Instructions>(self) {
        let mut group = self.0.benchmark_group("peak");
        group.bench_function("lanes_19200_operations", |bencher| {
            bencher.iter(|| {
                let start = [black_box(Lanes::<8, I>::from_f64(1.0)); 12];
                Lanes::<8, I>::apart(Peak(start));
            });
        });
        group.finish();
    }
}

fn all(criterion: &mut Criterion) {
    Level::best().choose(PeakOf(criterion));
    vehicle::<7>(criterion, "one_arm");
    vehicle::<13>(criterion, "two_arms");
}

criterion_group! { name = kernels; config = settings(); targets = all }
criterion_main!(kernels);
