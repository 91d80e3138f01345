//! Restitution, and the damping that gives it: the exact law of a Hunt–Crossley contact.
//!
//! With `f = k dⁿ (1 + c ḋ)` a free impact at speed v rebounds at e v where `g(D) = g(-e D)`, `D = c v` and
//! `g(u) = u - ln(1 + u)`: whatever the stiffness, the exponent and the masses.
//!
//! # Source
//! [`HuntCrossley1975`](wrasse_spatial::references::HuntCrossley1975) for the force; the law follows by
//! integration of `m v dv = -f dd` (book, page contact).

/// Least restitution (–): below it the damping grows without bound, at zero there is none that gives it.
pub const LEAST_RESTITUTION: f64 = 0.05;

/// `u - ln(1 + u)`, to the last bits also where both terms cancel.
pub(crate) fn g(u: f64) -> f64 {
    if u.abs() > 0.05 {
        return u - libm::log1p(u);
    }
    // u²/2 - u³/3 + …: 14 terms are 1e-18 of the first at 0.05.
    let mut sum = 0.0;
    for k in (2..16).rev() {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        sum = sign / f64::from(k) + u * sum;
    }
    u * u * sum
}

/// The damping number `D = c v` (–) that a restitution from 0.05 to 1 asks for.
pub fn damping_number(restitution: f64) -> f64 {
    let e = restitution;
    if e >= 1.0 {
        return 0.0;
    }
    // The excess grows from zero up to where its slope vanishes, and falls to -∞ at 1/e.
    let excess = |D: f64| g(D) - g(-e * D);
    let (mut low, mut high) = ((1.0 - e) / (e * (1.0 + e)), 1.0 / e);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if excess(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The restitution (–) of a free impact whose damping number is `D = c v`.
pub fn restitution_at(damping_number: f64) -> f64 {
    let D = damping_number;
    if D <= 0.0 {
        return 1.0;
    }
    let wanted = g(D);
    let (mut low, mut high) = (0.0, 1.0_f64.min(1.0 / D));
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if g(-middle * D) < wanted { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of `shared/golden/contact/normal_contact`, found there by quadrature. Measured 3e-14: the
    /// excess is flat where e is near 1.
    #[test]
    fn the_damping_number_is_that_of_the_exact_law() {
        for (e, D) in [
            (0.1, 9.998_159_397_495_668),
            (0.3, 3.087_081_981_129_624_6),
            (0.5, 1.432_750_533_271_375),
            (0.7, 0.634_828_281_266_416_9),
            (0.9, 0.166_481_950_685_306_9),
        ] {
            let found = damping_number(e);
            assert!((found / D - 1.0).abs() < 1e-13, "{e}: {found} {D}");
        }
    }

    /// The law itself, and back. Measured 2e-14.
    #[test]
    fn restitution_and_damping_number_are_inverse() {
        for k in 0..=190 {
            let e = 0.05 + 0.005 * f64::from(k);
            let D = damping_number(e);
            assert!((restitution_at(D) - e).abs() < 1e-12, "{e} {D} {}", restitution_at(D));
            let law = (1.0 + D).ln() - (1.0 - e * D).ln() - D * (1.0 + e);
            // At 0.05 the last bits of D are 1e-8 of 1 - e D.
            assert!(law.abs() < 1e-12 + 1e-15 / (1.0 - e * D), "{e}: {law:e}");
        }
        assert_eq!((damping_number(1.0), restitution_at(0.0)), (0.0, 1.0));
    }

    /// Table of d v against e, worked out by hand for the issue of contact.
    #[test]
    fn the_restitution_falls_with_the_speed() {
        for (D, e) in [(0.01, 0.99338), (0.125, 0.92303), (1.0, 0.59362), (5.0, 0.19698)] {
            assert!((restitution_at(D) - e).abs() < 5e-6, "{D}: {}", restitution_at(D));
        }
        assert!((restitution_at(20.0) - 0.05).abs() < 5e-6);
    }
}
