//! Coulomb friction of a disc under even pressure that slides and spins: in closed form.

use core::f64::consts::PI;

/// Force over `μN` and moment over `μNR` (–) of a disc of radius R that slides at v and spins at w, as
/// functions of `v/(w R)` (–, not negative). They act against the motion.
///
/// # Source
/// [`Farkas2003`](wrasse_spatial::references::Farkas2003).
pub fn uniform_disc_friction(speed_over_spin: f64) -> (f64, f64) {
    let e = speed_over_spin;
    if e <= 1.0 {
        let (K, E) = elliptic(e);
        let loss = (e * e - 1.0) * K;
        let force = if e < 0.01 {
            // The terms below cancel; the next one of this series is 1e-14 of the first.
            e * (1.0 - e * e * (1.0 / 8.0 + e * e / 64.0))
        } else {
            4.0 / 3.0 * ((e * e + 1.0) * E + loss) / (e * PI)
        };
        return (force, 4.0 / 9.0 * ((4.0 - 2.0 * e * e) * E + loss) / PI);
    }
    let (K, E) = elliptic(1.0 / e);
    let force = 4.0 / 3.0 * ((e * e + 1.0) * E - (e * e - 1.0) * K) / PI;
    let moment = (4.0 - 2.0 * e * e) * E + (2.0 * e * e - 5.0 + 3.0 / (e * e)) * K;
    (force, 4.0 / 9.0 * e * moment / PI)
}

/// Complete elliptic integrals K and E of a modulus from 0 to 1, by the arithmetic-geometric mean.
fn elliptic(modulus: f64) -> (f64, f64) {
    if modulus >= 1.0 {
        // K is infinite there; what it multiplies above is zero.
        return (0.0, 1.0);
    }
    let (mut a, mut b, mut c) = (1.0, ((1.0 - modulus) * (1.0 + modulus)).sqrt(), modulus);
    let (mut sum, mut weight) = (0.5 * c * c, 1.0);
    while c.abs() > 1e-16 {
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
        sum += weight * c * c;
        weight *= 2.0;
    }
    let K = PI / (2.0 * a);
    (K, K * (1.0 - sum))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sliding alone meets `μN` and no moment, spinning alone `2/3 μNR`; both sides meet at 1.
    #[test]
    fn limits_are_those_of_sliding_and_of_spinning() {
        let (force, moment) = uniform_disc_friction(0.0);
        assert!(force == 0.0 && (moment - 2.0 / 3.0).abs() < 1e-15);
        let meet = [0.01 - 1e-12, 0.01].map(|e| uniform_disc_friction(e).0);
        assert!((meet[0] / meet[1] - 1.0).abs() < 1e-9, "{meet:?}");
        let (force, moment) = uniform_disc_friction(1e-6);
        assert!((force / 1e-6 - 1.0).abs() < 1e-6 && (moment - 2.0 / 3.0).abs() < 1e-11);
        let (force, moment) = uniform_disc_friction(100.0);
        assert!(
            (force - 1.0).abs() < 2e-5 && (moment - 0.25 / 100.0).abs() < 1e-6,
            "{force} {moment}"
        );
        let (below, above) = (uniform_disc_friction(1.0 - 1e-9), uniform_disc_friction(1.0 + 1e-9));
        assert!((below.0 - above.0).abs() < 1e-7 && (below.1 - above.1).abs() < 1e-7);
        assert!((uniform_disc_friction(1.0).0 - 8.0 / (3.0 * PI)).abs() < 1e-15);
    }

    /// By summing friction over the disc, 400 x 400 parts by the midpoint rule: 2e-5.
    #[test]
    fn the_closed_form_is_the_integral_over_the_disc() {
        for e in [0.1, 0.5, 0.9, 1.3, 4.0] {
            let (mut force, mut moment) = (0.0, 0.0);
            for i in 0..400 {
                let r = (f64::from(i) + 0.5) / 400.0;
                for k in 0..400 {
                    let angle = 2.0 * PI * (f64::from(k) + 0.5) / 400.0;
                    let (x, y) = (r * angle.cos(), r * angle.sin());
                    let (vx, vy) = (e - y, x);
                    let v = (vx * vx + vy * vy).sqrt();
                    let share = 2.0 * r / (400.0 * 400.0);
                    force += share * vx / v;
                    moment += share * (x * vy - y * vx) / v;
                }
            }
            let (f, m) = uniform_disc_friction(e);
            assert!((f - force).abs() < 1e-4 && (m - moment).abs() < 1e-4, "{e}: {force} {moment}");
        }
    }
}
