//! The law of a pair, from its two surfaces.

use super::law::{Bristle, BristleDamping, ContactLaw, FrictionLaw};
use super::normal_force::{NormalForce, power};
use super::restitution::{LEAST_RESTITUTION, damping_number};
use wrasse_hardware::{Friction, Hardness, Surface};

/// How two surfaces are curved where they meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Curvature {
    /// `1/R = 1/R_A + 1/R_B` with this R (m): two balls, or a ball on a flat.
    Radius(f64),
    /// A flat of this area (m²) on something at least as large and this deep (m) behind it.
    Flat {
        /// (m²)
        area: f64,
        /// (m)
        thickness: f64,
    },
}

/// Why two surfaces have no law together.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PairRefused {
    /// One is a spring of one exponent, the other of another.
    #[error("their exponents differ ({0} and {1}): springs of one exponent only act in series")]
    Exponents(f64, f64),
    /// A restitution for which there is no damping.
    #[error(
        "a restitution of {0} is not between 0.05 and 1: below, the damping grows without bound"
    )]
    Restitution(f64),
}

/// The law of two surfaces that meet with this curvature.
///
/// Their springs act in series: both feel one force, and the depth is the sum of what each gives way. The
/// damping is the mean of theirs, weighed by how much each gives way. The smaller coefficient of friction
/// counts, with its law.
///
/// # Errors
/// If they have no law together.
///
/// # Source
/// [`Johnson1985`](wrasse_spatial::references::Johnson1985) ch. 4 for Hertz's `4/3 E* √R`, and for the flat
/// the compression of an elastic layer `E A/t`.
pub fn law_of_pair(
    A: &Surface<f64>,
    B: &Surface<f64>,
    curvature: Curvature,
) -> Result<ContactLaw, PairRefused> {
    for surface in [A, B] {
        if !(LEAST_RESTITUTION..=1.0).contains(&surface.restitution) {
            return Err(PairRefused::Restitution(surface.restitution));
        }
    }
    let (kA, n) = spring(A, curvature);
    let (kB, m) = spring(B, curvature);
    if n != m {
        return Err(PairRefused::Exponents(n, m));
    }
    // f = k dⁿ: d = (f/k)^(1/n) on each side. Between two elastic bodies the area is one and the same, and
    // what each gives way goes as 1/E.
    let as_one = matches!(curvature, Curvature::Radius(_)) && both_elastic(A, B);
    let order = if as_one { 1.0 } else { n };
    let (give_A, give_B) = (power(kA, -1.0 / order), power(kB, -1.0 / order));
    let stiffness = power(give_A + give_B, -order);
    let given_by_A = give_A / (give_A + give_B);
    let damping = |s: &Surface<f64>| damping_number(s.restitution) / s.restitution_speed;
    let damping = given_by_A * damping(A) + (1.0 - given_by_A) * damping(B);
    let normal = NormalForce { stiffness, exponent: n, damping };
    let rougher = if mu(&B.friction) < mu(&A.friction) { B } else { A };
    let friction = friction(&rougher.friction, &normal, rougher.restitution_speed);
    Ok(ContactLaw { normal, friction, given_by_A })
}

/// Stiffness (N/mⁿ) and exponent of a surface against something rigid.
fn spring(surface: &Surface<f64>, curvature: Curvature) -> (f64, f64) {
    match (surface.hardness, curvature) {
        (Hardness::Spring { stiffness, exponent }, _) => (stiffness, exponent),
        (Hardness::Elastic { youngs_modulus, poisson_ratio }, Curvature::Radius(R)) => {
            let plane_strain = youngs_modulus / (1.0 - poisson_ratio * poisson_ratio);
            (4.0 / 3.0 * plane_strain * R.sqrt(), 1.5)
        }
        (Hardness::Elastic { youngs_modulus, .. }, Curvature::Flat { area, thickness }) => {
            (youngs_modulus * area / thickness, 1.0)
        }
    }
}

fn both_elastic(A: &Surface<f64>, B: &Surface<f64>) -> bool {
    [A, B].iter().all(|surface| matches!(surface.hardness, Hardness::Elastic { .. }))
}

fn mu(friction: &Friction<f64>) -> f64 {
    match friction {
        Friction::None => 0.0,
        Friction::ElastoPlastic { mu, .. }
        | Friction::Tanh { mu, .. }
        | Friction::LuGre { mu, .. } => *mu,
    }
}

/// Friction of a pair with this normal law. With an exponent of 1.5 the normal stiffness grows with the
/// load; that of the bristle is constant: that at the depth of a free impact of one kilogram at the speed
/// for which the restitution is given.
fn friction(of: &Friction<f64>, normal: &NormalForce, speed: f64) -> FrictionLaw {
    let bristle = |mu: f64, ratio: f64, damping: f64| {
        let stiffness = ratio * normal.tangent(normal.deepest(1.0, speed));
        Bristle { mu, stiffness, damping: BristleDamping::Ratio(damping) }
    };
    match *of {
        Friction::None => FrictionLaw::None,
        Friction::Tanh { mu, speed } => FrictionLaw::Tanh { mu, speed },
        Friction::ElastoPlastic { mu, stiffness_ratio, damping_ratio } => {
            FrictionLaw::ElastoPlastic(bristle(mu, stiffness_ratio, damping_ratio))
        }
        Friction::LuGre { mu, stiffness_ratio, damping_ratio } => {
            FrictionLaw::LuGre(bristle(mu, stiffness_ratio, damping_ratio))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steel(restitution: f64) -> Surface<f64> {
        let hardness = Hardness::Elastic { youngs_modulus: 2e5, poisson_ratio: 0.3 };
        Surface { hardness, restitution, restitution_speed: 1.0, friction: Friction::None }
    }

    /// Two balls of 0.5 m: R = 0.25 m, 1/E* = 2 (1 - 0.09)/2e5, k = 4/3 E* √R = 73 260.07 N/m^1.5.
    #[test]
    fn two_balls_have_the_stiffness_of_hertz() {
        let law = law_of_pair(&steel(0.5), &steel(0.5), Curvature::Radius(0.25)).unwrap();
        assert!((law.normal.stiffness - 73_260.073_26).abs() < 1e-4, "{law:?}");
        assert_eq!((law.normal.exponent, law.given_by_A), (1.5, 0.5));
        assert!((law.normal.restitution(1.0) - 0.5).abs() < 1e-12);
    }

    /// 1e6 and 3e6 N/m in series: 7.5e5 N/m, of which the softer one gives way by three quarters.
    #[test]
    fn springs_act_in_series() {
        let of = |stiffness: f64| Surface {
            hardness: Hardness::Spring { stiffness, exponent: 1.0 },
            ..steel(1.0)
        };
        let flat = Curvature::Radius(1.0);
        let law = law_of_pair(&of(1e6), &of(3e6), flat).unwrap();
        assert!(
            (law.normal.stiffness - 7.5e5).abs() < 1e-6 && (law.given_by_A - 0.75).abs() < 1e-15
        );
        // The softer one, which gives way by three quarters, throws back with 0.5 at 1 m/s, the other one whole.
        let soft = Surface { restitution: 0.5, ..of(1e6) };
        let law = law_of_pair(&soft, &of(3e6), flat).unwrap();
        assert!((law.normal.damping / damping_number(0.5) - 0.75).abs() < 1e-14, "{law:?}");
        assert!(law_of_pair(&of(1e6), &steel(0.5), flat).is_err());
        assert!(law_of_pair(&steel(0.04), &steel(0.5), flat).is_err());
    }

    /// A layer of 1e7 Pa, 1e-4 m² and 10 mm deep: 1e5 N/m. Two of them in series, half; the bristle of the pair
    /// has 0.8 of that, and the smaller coefficient, whichever of them is called A.
    #[test]
    fn the_smoother_surface_decides_how_a_pair_rubs() {
        let layer = |mu: f64| Surface {
            hardness: Hardness::Elastic { youngs_modulus: 1e7, poisson_ratio: 0.3 },
            friction: Friction::ElastoPlastic { mu, stiffness_ratio: 0.8, damping_ratio: 0.5 },
            ..steel(0.5)
        };
        let flat = Curvature::Flat { area: 1e-4, thickness: 0.01 };
        for (a, b) in [(0.2, 0.6), (0.6, 0.2)] {
            let law = law_of_pair(&layer(a), &layer(b), flat).unwrap();
            assert!((law.normal.stiffness - 5e4).abs() < 1e-9 && law.normal.exponent == 1.0);
            let FrictionLaw::ElastoPlastic(bristle) = law.friction else { panic!("{law:?}") };
            assert!((bristle.stiffness - 4e4).abs() < 1e-9, "{bristle:?}");
            assert_eq!((bristle.mu, bristle.damping), (0.2, BristleDamping::Ratio(0.5)));
        }
    }
}
