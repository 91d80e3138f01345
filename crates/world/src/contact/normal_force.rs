//! The normal force of a contact after Hunt and Crossley, and what follows from it in closed form.

use super::restitution::{damping_number, g, restitution_at};

/// `f = k dⁿ (1 + c ḋ)`, never below zero: no contact pulls.
///
/// # Source
/// [`HuntCrossley1975`](wrasse_spatial::references::HuntCrossley1975).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalForce {
    /// k (N/mⁿ)
    pub stiffness: f64,
    /// n (–): 1, or 1.5 between curved elastic bodies.
    pub exponent: f64,
    /// c (s/m)
    pub damping: f64,
}

impl NormalForce {
    /// With the damping that throws back with this restitution (–) at this speed (m/s).
    pub fn with_restitution(
        stiffness: f64,
        exponent: f64,
        (restitution, speed): (f64, f64),
    ) -> Self {
        Self { stiffness, exponent, damping: damping_number(restitution) / speed }
    }
    /// Elastic force (N) at a depth (m); of depths below zero it goes on smoothly, for the stages of a step.
    pub(crate) fn spring(&self, depth: f64) -> f64 {
        let d = depth.abs();
        let of_one = if self.exponent == 1.0 { d } else { d * power(d, self.exponent - 1.0) };
        (self.stiffness * of_one).copysign(depth)
    }
    /// The force (N) at a depth (m) that grows at a rate (m/s).
    pub fn force(&self, depth: f64, rate: f64) -> f64 {
        if depth <= 0.0 { 0.0 } else { (self.spring(depth) * (1.0 + self.damping * rate)).max(0.0) }
    }
    /// Energy that the spring stores (J).
    pub fn stored(&self, depth: f64) -> f64 {
        if depth <= 0.0 { 0.0 } else { self.spring(depth) * depth / (self.exponent + 1.0) }
    }
    /// `∂f/∂d` without damping (N/m): how stiff it is at a depth (m).
    pub fn tangent(&self, depth: f64) -> f64 {
        let d = depth.max(0.0);
        let n = self.exponent;
        if n == 1.0 { self.stiffness } else { n * self.stiffness * power(d, n - 1.0) }
    }
    /// The restitution (–) of a free impact at a speed (m/s).
    pub fn restitution(&self, speed: f64) -> f64 {
        restitution_at(self.damping * speed)
    }
    /// Deepest penetration (m) of a free impact of a reduced mass (kg) at a speed (m/s).
    pub fn deepest(&self, mass: f64, speed: f64) -> f64 {
        let (n, k, c) = (self.exponent, self.stiffness, self.damping);
        let D = c * speed;
        // g(D)/c² tends to v²/2 where there is no damping.
        let energy = if D > 0.0 { mass * g(D) / (c * c) } else { 0.5 * mass * speed * speed };
        power((n + 1.0) * energy / k, 1.0 / (n + 1.0))
    }
    /// Largest force (N) of a free impact of a reduced mass (kg) at a speed (m/s).
    pub fn largest(&self, mass: f64, speed: f64) -> f64 {
        let (n, c) = (self.exponent, self.damping);
        let D = c * speed;
        if D <= 0.0 {
            return self.force(self.deepest(mass, speed), 0.0);
        }
        // At its largest, g(D) - g(u) = n/(n + 1) u with u = c ḋ: the left side falls with u, the right grows.
        let (mut low, mut high) = (0.0, D);
        for _ in 0..200 {
            let u = 0.5 * (low + high);
            if u <= low || u >= high {
                break;
            }
            if g(D) - g(u) > n / (n + 1.0) * u { low = u } else { high = u }
        }
        let u = 0.5 * (low + high);
        let energy = mass * (g(D) - g(u)) / (c * c);
        let depth = power((n + 1.0) * energy / self.stiffness, 1.0 / (n + 1.0));
        self.force(depth, u / c)
    }
}

/// `xᵖ` of a number that is not negative.
pub(crate) fn power(x: f64, p: f64) -> f64 {
    if p == 0.5 { x.sqrt() } else { libm::pow(x, p) }
}
