//! Sine and cosine: one source for every scalar, without a branch on the value, so that lanes give
//! the same bits as single numbers.

use crate::Real;

/// π/2 in three parts, of which the first two have so few digits that their products with the
/// number of quarter turns are exact, and the number that rounds to whole numbers when added.
struct QuarterTurn {
    parts: [f64; 3],
    rounder: f64,
}

/// A number of quarter turns, counted from 0 to 3, and the angle that is left (rad, |angle| ≤ π/4)
/// with its rounding error.
struct Reduced<R> {
    quarter: R,
    angle: R,
    tail: R,
}

/// Sine and cosine of any angle (rad). Angles that no joint turns through go the long way.
#[inline(always)]
pub(crate) fn sin_cos_f64(x: f64) -> (f64, f64) {
    if is_near(x) { near_sin_cos(x) } else { libm::sincos(x) }
}

/// The same in single precision.
#[inline(always)]
pub(crate) fn sin_cos_f32(x: f32) -> (f32, f32) {
    if x.abs() <= LARGEST_F32 { near_sin_cos_f32(x) } else { libm::sincosf(x) }
}

/// Whether the common way holds for an angle (rad).
#[inline(always)]
pub(crate) fn is_near(x: f64) -> bool {
    x.abs() < BEYOND
}

/// Sine and cosine of an angle (rad) that [`is_near`].
///
/// # Source
/// [`CodyWaite1980`](crate::references::CodyWaite1980) for the reduction by parts; the polynomials
/// are those of fdlibm.
#[inline(always)]
pub(crate) fn near_sin_cos<R: Real>(x: R) -> (R, R) {
    let c = R::from_f64;
    let reduced = reduce(x, &QUARTER_F64);
    let (r, tail) = (reduced.angle, reduced.tail);
    let z = r * r;
    let v = z * r;
    let w = z * z;
    // sin r = r - r³/6 + …, the tail added where it counts.
    let s = c(S[1]) + z * (c(S[2]) + z * c(S[3])) + z * w * (c(S[4]) + z * c(S[5]));
    let half = c(0.5);
    let sine = r - ((z * (half * tail - v * s) - tail) - v * c(S[0]));
    // cos r = 1 - r²/2 + …: what 1 - r²/2 loses by rounding is given back.
    let t = z * (c(C[0]) + z * (c(C[1]) + z * c(C[2])))
        + w * w * (c(C[3]) + z * (c(C[4]) + z * c(C[5])));
    let (one, half_square) = (R::one(), half * z);
    let lead = one - half_square;
    let cosine = lead + (((one - lead) - half_square) + (z * t - r * tail));
    in_quarter(reduced.quarter, sine, cosine)
}

/// The same in single precision, up to [`LARGEST_F32`].
///
/// # Source
/// The polynomials are those of the Cephes library.
#[inline(always)]
fn near_sin_cos_f32<R: Real>(x: R) -> (R, R) {
    let c = R::from_f64;
    let reduced = reduce(x, &QUARTER_F32);
    let (r, tail) = (reduced.angle, reduced.tail);
    let z = r * r;
    let sine = r + (z * r * (c(S_F32[0]) + z * (c(S_F32[1]) + z * c(S_F32[2]))) + tail);
    let cosine = R::one()
        - (c(0.5) * z - (z * z * (c(C_F32[0]) + z * (c(C_F32[1]) + z * c(C_F32[2]))) - r * tail));
    in_quarter(reduced.quarter, sine, cosine)
}

/// The nearest multiple of a quarter turn taken off.
#[inline(always)]
fn reduce<R: Real>(x: R, by: &QuarterTurn) -> Reduced<R> {
    let c = R::from_f64;
    // No closure: it would not be inlined into what is built for wider registers.
    let rounder = c(by.rounder);
    let n = (x * c(core::f64::consts::FRAC_2_PI) + rounder) - rounder;
    let whole_turns = ((n - c(1.5)) * c(0.25) + rounder) - rounder;
    let near = x - n * c(by.parts[0]);
    let second = n * c(by.parts[1]);
    let r = near - second;
    let tail = ((near - r) - second) - n * c(by.parts[2]);
    let angle = r + tail;
    Reduced { quarter: n - whole_turns * c(4.0), angle, tail: (r - angle) + tail }
}

/// Sine and cosine of an angle that lies this many quarter turns further.
#[inline(always)]
fn in_quarter<R: Real>(quarter: R, sine: R, cosine: R) -> (R, R) {
    let c = R::from_f64;
    let odd = ((quarter - c(2.0)).abs() - R::one()).abs().lt(c(0.5));
    let (s, c1) = (R::select(odd, cosine, sine), R::select(odd, sine, cosine));
    let below = c(1.5).lt(quarter);
    let left = (quarter - c(1.5)).abs().lt(R::one());
    (R::select(below, -s, s), R::select(left, -c1, c1))
}

/// Angles (rad) that the reduction is exact for are smaller: 2²⁰ quarter turns.
pub(crate) const BEYOND: f64 = 1.6e6;
/// The same in single precision.
const LARGEST_F32: f32 = 8192.0;

const QUARTER_F64: QuarterTurn = QuarterTurn {
    parts: [
        f64::from_bits(0x3FF9_21FB_5440_0000),
        f64::from_bits(0x3DD0_B461_1A60_0000),
        f64::from_bits(0x3BA3_198A_2E03_7073),
    ],
    rounder: 6_755_399_441_055_744.0,
};
const QUARTER_F32: QuarterTurn = QuarterTurn {
    parts: [1.570_312_5, 4.837_512_969_970_703e-4, 7.549_789_954_891_882e-8],
    rounder: 12_582_912.0,
};

const S: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
const C: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];
const S_F32: [f64; 3] = [-1.666_665_461_1e-1, 8.332_160_873_6e-3, -1.951_529_589_1e-4];
const C_F32: [f64; 3] =
    [4.166_664_568_298_827e-2, -1.388_731_625_493_765e-3, 2.443_315_711_809_948e-5];
