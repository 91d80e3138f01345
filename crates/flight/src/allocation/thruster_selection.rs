//! Thruster selection: which thrusters fire, and for what share of the time.

use super::bounded_simplex::BoundedSimplex;
use wrasse_hardware::{THRUSTERS, Thruster};
use wrasse_spatial::{Scalar, SpatialForce, Vec3, vec3};

/// Axes of the base: torque about them, force along them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WrenchAxes {
    /// Torque about each base axis.
    pub torque: [bool; 3],
    /// Force along each base axis.
    pub force: [bool; 3],
}

impl WrenchAxes {
    /// Torque and force.
    pub const ALL: Self = Self { torque: [true; 3], force: [true; 3] };
    /// Torque; the force that comes with it is not controlled.
    pub const TORQUE: Self = Self { torque: [true; 3], force: [false; 3] };

    fn to_array(self) -> [bool; 6] {
        let ([a, b, c], [d, e, f]) = (self.torque, self.force);
        [a, b, c, d, e, f]
    }
}

/// What each thruster should give, and what is missing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Selection<T> {
    /// Share of each thruster's full force, 0 to 1 (–).
    pub duty: [T; THRUSTERS],
    /// What was wanted less what these give, about the system's centre of mass, base axes (N·m, N).
    /// On axes that are not controlled: the opposite of what these give.
    pub missing: SpatialForce<T>,
    /// Whether this is the best there is; if not, the search was cut short, and it is only possible.
    pub best: bool,
}

/// The variables: thrusters, shares of the wanted torque and force, torque beyond the share about
/// each axis, unwanted force along each axis; then the start of the search, one for each row, which
/// for the force is unwanted force the other way.
const TORQUE_SHARE: usize = THRUSTERS;
const FORCE_SHARE: usize = TORQUE_SHARE + 1;
const MORE_TORQUE: usize = FORCE_SHARE + 1;
const UNWANTED_FORCE: usize = MORE_TORQUE + 3;
const START: usize = UNWANTED_FORCE + 3;
const VARIABLES: usize = START + 6;

type Search<T> = BoundedSimplex<T, 6, VARIABLES>;

/// Shares of full force with which thrusters give a wanted torque and force on the controlled axes,
/// with the least propellant, each between zero and one.
///
/// What cannot be given exactly is given in this order: the largest share of the whole torque; what
/// more there is of the torque about single axes, never beyond what is wanted; as little unwanted
/// force as possible; the largest share of the whole force; the least propellant.
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `usable` | whether each thruster may be used | – |
/// | `p_BScm_B` | centre of mass of the whole system, base frame | m |
/// | `wanted` | torque about that point and force, base axes | N·m, N |
/// | `controlled` | the axes that count; the others are left to themselves | – |
pub fn thruster_duties<T: Scalar>(
    thrusters: &[Thruster<T>],
    usable: &[bool; THRUSTERS],
    p_BScm_B: Vec3<T>,
    wanted: &SpatialForce<T>,
    controlled: WrenchAxes,
) -> Selection<T> {
    let columns = wrenches(thrusters, usable, p_BScm_B);
    let target = masked(wanted, controlled);
    let mut found = Selection { duty: [T::zero(); THRUSTERS], missing: target, best: true };
    if target.to_array().iter().all(|x| x.is_finite()) {
        let problem = Problem::new(columns);
        let mut search = problem.search(&target, controlled);
        found.best = problem.settle(&mut search, &target, &propellant(thrusters));
        found.duty = core::array::from_fn(|i| search.value(i).min(T::one()));
    }
    for (F, &duty) in columns.iter().zip(&found.duty) {
        found.missing = found.missing - *F * duty;
    }
    found
}

/// Axes on which thrusters can push both ways: torque about each axis without torque about the
/// others, whatever the force; force along each axis without torque and without other force.
pub fn controllable_axes<T: Scalar>(
    thrusters: &[Thruster<T>],
    usable: &[bool; THRUSTERS],
    p_BScm_B: Vec3<T>,
) -> WrenchAxes {
    let problem = Problem::new(wrenches(thrusters, usable, p_BScm_B));
    let both = |axis: usize| {
        let size = problem.scale.to_array()[axis];
        size > T::zero() && problem.possible(axis, size) && problem.possible(axis, -size)
    };
    WrenchAxes { torque: [0, 1, 2].map(both), force: [3, 4, 5].map(both) }
}

/// What each usable thruster gives when fully open, about the system's centre of mass, base axes.
fn wrenches<T: Scalar>(
    thrusters: &[Thruster<T>],
    usable: &[bool; THRUSTERS],
    p_BScm_B: Vec3<T>,
) -> [SpatialForce<T>; THRUSTERS] {
    let mut columns = [SpatialForce::zero(); THRUSTERS];
    for ((column, thruster), &usable) in columns.iter_mut().zip(thrusters).zip(usable) {
        let force = thruster.direction_B * thruster.force;
        let F = SpatialForce::new((thruster.position_B - p_BScm_B).cross(force), force);
        let possible = thruster.force > T::zero() && F.to_array().iter().all(|x| x.is_finite());
        if usable && possible {
            *column = F;
        }
    }
    columns
}

fn masked<T: Scalar>(F: &SpatialForce<T>, axes: WrenchAxes) -> SpatialForce<T> {
    let (F, axes) = (F.to_array(), axes.to_array());
    SpatialForce::from_array(core::array::from_fn(|k| if axes[k] { F[k] } else { T::zero() }))
}

/// Propellant that each thruster takes per second of full force, relative to the largest.
fn propellant<T: Scalar>(thrusters: &[Thruster<T>]) -> [T; THRUSTERS] {
    let mut flow = [T::zero(); THRUSTERS];
    for (flow, thruster) in flow.iter_mut().zip(thrusters) {
        // Without a specific impulse: as of one second, so that such a thruster goes last.
        let counts = thruster.specific_impulse > T::one();
        let impulse = if counts { thruster.specific_impulse } else { T::one() };
        *flow = thruster.force.abs() / impulse;
    }
    let most = flow.iter().fold(T::zero(), |m, &x| m.max(x));
    flow.map(|x| if most > T::zero() && x.is_finite() { x / most } else { T::zero() })
}

fn largest<T: Scalar>(v: Vec3<T>) -> T {
    v.x.abs().max(v.y.abs()).max(v.z.abs())
}

/// A cost of so much for each of these variables.
fn cost<T: Scalar>(of: impl Iterator<Item = usize>, each: f64) -> [T; VARIABLES] {
    let mut cost = [T::zero(); VARIABLES];
    of.for_each(|j| cost[j] = T::from_f64(each));
    cost
}

/// The thrusters, and what torque and force are measured in so that no row is tiny.
struct Problem<T> {
    columns: [SpatialForce<T>; THRUSTERS],
    /// Largest torque and largest force of one thruster, each three times; one where there is none.
    scale: SpatialForce<T>,
}

impl<T: Scalar> Problem<T> {
    fn new(columns: [SpatialForce<T>; THRUSTERS]) -> Self {
        let most = |part: fn(&SpatialForce<T>) -> Vec3<T>| {
            let size = columns.iter().fold(T::zero(), |m, F| m.max(largest(part(F))));
            let size = if size > T::zero() { size } else { T::one() };
            vec3(size, size, size)
        };
        Self { columns, scale: SpatialForce::new(most(|F| F.torque), most(|F| F.force)) }
    }
    /// The rows `given = share · target + more torque + unwanted force`, nothing given so far.
    fn search(&self, target: &SpatialForce<T>, controlled: WrenchAxes) -> Search<T> {
        let (o, i) = (T::zero(), T::one());
        let (scale, controlled) = (self.scale.to_array(), controlled.to_array());
        let most = [largest(target.torque), largest(target.force)];
        let mut rows = [[o; VARIABLES]; 6];
        for k in 0..6 {
            rows[k][START + k] = i;
            if !controlled[k] {
                continue;
            }
            for (j, F) in self.columns.iter().enumerate() {
                rows[k][j] = F.to_array()[k] / scale[k];
            }
            let (wanted, most) = (target.to_array()[k], most[k / 3]);
            rows[k][TORQUE_SHARE + k / 3] = if most > o { -wanted / most } else { o };
            match k {
                0..3 => rows[k][MORE_TORQUE + k] = if wanted < o { i } else { -i },
                _ => rows[k][UNWANTED_FORCE + k - 3] = -i,
            }
        }
        let mut upper = [i; VARIABLES];
        upper[TORQUE_SHARE] = most[0] / scale[0];
        upper[FORCE_SHARE] = most[1] / scale[3];
        upper[MORE_TORQUE..UNWANTED_FORCE].fill(o);
        upper[START..START + 3].fill(o);
        // No sum of thrusters is larger.
        let enough = T::from_f64(2.0 * THRUSTERS as f64);
        upper[UNWANTED_FORCE..START].fill(enough);
        upper[START + 3..].fill(enough);
        Search::new(rows, upper)
    }
    /// One goal after the other, as `thruster_duties` says. Whether all were reached.
    fn settle(
        &self,
        search: &mut Search<T>,
        target: &SpatialForce<T>,
        flow: &[T; THRUSTERS],
    ) -> bool {
        let mut best = search.minimise(&cost(TORQUE_SHARE..FORCE_SHARE, -1.0));
        search.freeze(TORQUE_SHARE);
        let wanted = target.torque.to_array();
        let most = largest(target.torque);
        for k in 0..3 {
            let share = if most > T::zero() { wanted[k].abs() / most } else { T::zero() };
            let rest = wanted[k].abs() / self.scale.torque.x - share * search.value(TORQUE_SHARE);
            search.widen(MORE_TORQUE + k, rest);
        }
        let unwanted = (UNWANTED_FORCE..START).chain(START + 3..VARIABLES);
        for goal in [
            cost(MORE_TORQUE..UNWANTED_FORCE, -1.0),
            cost(unwanted, 1.0),
            cost(FORCE_SHARE..MORE_TORQUE, -1.0),
        ] {
            best &= search.minimise(&goal);
            search.lock(&goal);
        }
        let mut fuel = [T::zero(); VARIABLES];
        fuel[..THRUSTERS].copy_from_slice(flow);
        best & search.minimise(&fuel)
    }
    /// Whether there is torque about an axis alone, or force along an axis alone without torque.
    fn possible(&self, axis: usize, size: T) -> bool {
        let mut target = [T::zero(); 6];
        target[axis] = size;
        let (axes, share) = match axis {
            0..3 => (WrenchAxes::TORQUE, TORQUE_SHARE),
            _ => (WrenchAxes::ALL, FORCE_SHARE),
        };
        let mut search = self.search(&SpatialForce::from_array(target), axes);
        for k in 0..3 {
            search.widen(UNWANTED_FORCE + k, T::zero());
            search.widen(START + 3 + k, T::zero());
        }
        search.minimise(&cost(core::iter::once(share), -1.0));
        search.value(share) > T::from_f64(1e-3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A number in -1..1 from a step of a linear congruence.
    fn next(state: &mut u64) -> f64 {
        *state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(state: &mut u64) -> Vec3<f64> {
        vec3(next(state), next(state), next(state))
    }

    /// The search ends long before its exchanges do, by either of its rules, at the same cost. Measured:
    /// 47 exchanges at most, by the least index 160; costs 4e-11 apart, of up to 24.
    #[test]
    fn a_selection_needs_few_exchanges() {
        let (mut state, mut most, mut apart) = (20_040_901, [0; 2], 0.0_f64);
        for _ in 0..2000 {
            let columns = [(); THRUSTERS].map(|()| {
                let (p, f) = (vector(&mut state), vector(&mut state));
                SpatialForce::new(p.cross(f), f)
            });
            let target = SpatialForce::new(vector(&mut state) * 3.0, vector(&mut state) * 3.0);
            let problem = Problem::new(columns);
            let start = problem.search(&target, WrenchAxes::ALL);
            let mut searches = [start, start.halfway()];
            let begun = searches.map(|search| search.exchanges());
            let cost = searches.each_mut().map(|search| {
                assert!(problem.settle(search, &target, &[1.0; THRUSTERS]));
                (0..THRUSTERS).map(|i| search.value(i)).sum::<f64>()
            });
            for i in 0..2 {
                most[i] = most[i].max(searches[i].exchanges() - begun[i]);
            }
            apart = wrasse_testing::larger(apart, (cost[0] - cost[1]).abs());
        }
        assert!(most[0] < 60 && most[1] < 180, "{most:?}");
        assert!(apart < 1e-9, "{apart}");
    }
}
