//! Is there exactly one zero of this system in this box, or none?
//!
//! Krawczyk's operator `K(X) = x - Y f(x) + (1 - Y F'(X)) (X - x)` holds every zero of `f` that lies in the box `X`. If `K(X)` lies strictly inside
//! `X`, there is a zero in `X`, and only one; if the two do not meet, there is none (Krawczyk 1969; Moore 1977, theorem 8.2 of Moore, Kearfott,
//! Cloud 2009). `x` is the box's middle and `Y` any matrix; near the inverse of `f'(x)` works. Nothing here knows where the system came from.
//!
//! What it cannot do: decide multiple zeros, at which `f'` has no inverse.

use super::Verdict;
use crate::algebra::Interval;

/// A box: one interval for each unknown.
pub type Region<const N: usize> = [Interval; N];

/// An enclosure of a function and of its matrix of derivatives over any box.
pub trait Enclosure<const N: usize> {
    /// Holds `f(x)` for every `x` of the box.
    fn values(&self, region: &Region<N>) -> [Interval; N];
    /// Holds the derivatives `[equation][unknown]` at every `x` of the box.
    fn derivatives(&self, region: &Region<N>) -> [[Interval; N]; N];
}

/// A function and its derivatives given as two closures.
impl<const N: usize, F, D> Enclosure<N> for (F, D)
where
    F: Fn(&Region<N>) -> [Interval; N],
    D: Fn(&Region<N>) -> [[Interval; N]; N],
{
    fn values(&self, region: &Region<N>) -> [Interval; N] {
        self.0(region)
    }

    fn derivatives(&self, region: &Region<N>) -> [[Interval; N]; N] {
        self.1(region)
    }
}

/// Whether a box holds exactly one zero.
///
/// `Proven`: it does, and the box returned, inside the first, holds it. `Refuted`: it holds none. `Undecided`: neither was shown.
///
/// ```
/// use assur::Verdict;
/// use assur::algebra::Interval;
/// use assur::certify::unique_zero;
/// // x² + y² = 25, x y = 12: (4, 3) and (3, 4) and their opposites.
/// let circle = |[x, y]: &[Interval; 2]| [x.square() + y.square() - Interval::point(25.0), *x * *y - Interval::point(12.0)];
/// let slopes = |[x, y]: &[Interval; 2]| [[x.scale(1), y.scale(1)], [*y, *x]];
/// let near = |x: f64, y: f64| [Interval::around(x, 0.01), Interval::around(y, 0.01)];
/// let (verdict, found) = unique_zero(&(circle, slopes), &near(4.001, 3.0));
/// assert_eq!(verdict, Verdict::Proven);
/// assert!(found[0].contains(4.0) && found[0].width() < 0.01);
/// assert_eq!(unique_zero(&(circle, slopes), &near(4.1, 3.0)).0, Verdict::Refuted);
/// ```
pub fn unique_zero<const N: usize>(system: &impl Enclosure<N>, region: &Region<N>) -> (Verdict, Region<N>) {
    if system.values(region).iter().any(|value| !value.contains(0.0)) {
        return (Verdict::Refuted, *region);
    }
    let middle = region.map(Interval::middle);
    let values = system.values(&middle.map(Interval::point));
    let slopes = system.derivatives(&middle.map(Interval::point)).map(|row| row.map(Interval::middle));
    match inverse(slopes) {
        Some(inverse) => decide(system, region, &middle, &values, &inverse),
        None => (Verdict::Undecided, *region),
    }
}

/// A small box around `start` that holds exactly one zero; `None` where none could be shown.
///
/// Newton's method from `start`, then a box as wide as the last steps ask for, widened a few times if need be.
/// **Cost**: three evaluations of the function and one of its derivatives, as a rule.
pub fn enclose_zero<const N: usize>(system: &impl Enclosure<N>, start: [f64; N]) -> Option<Region<N>> {
    let mut x = start;
    let mut step = [0.0f64; N];
    let mut matrix = inverse(slopes_at(system, &x))?;
    for round in 0..NEWTON_ROUNDS {
        let values = system.values(&x.map(Interval::point)).map(Interval::middle);
        step = times(&matrix, &values);
        let large = (0..N).any(|k| step[k].abs() > SAME_SLOPES * x[k].abs().max(1.0));
        x = std::array::from_fn(|k| x[k] - step[k]);
        if x.iter().any(|x| !x.is_finite()) {
            return None;
        }
        if !large {
            break;
        }
        if round + 1 < NEWTON_ROUNDS {
            matrix = inverse(slopes_at(system, &x))?;
        }
    }
    let values = system.values(&x.map(Interval::point));
    // What the rounding of f alone moves the zero by, and the last step.
    let mut radius: [f64; N] = std::array::from_fn(|i| {
        let moved: f64 = (0..N).map(|j| matrix[i][j].abs() * values[j].magnitude()).sum();
        2.0 * moved + step[i].abs() * step[i].abs() + 2.0 * f64::EPSILON * x[i].abs().max(f64::EPSILON)
    });
    for _ in 0..INFLATIONS {
        let region: Region<N> = std::array::from_fn(|k| Interval::around(x[k], radius[k]));
        if let (Verdict::Proven, found) = decide(system, &region, &x, &values, &matrix) {
            return Some(found);
        }
        radius = radius.map(|r| INFLATION * r);
    }
    None
}

/// Newton steps before the box is tried; from `f64` accuracy one is enough.
const NEWTON_ROUNDS: usize = 4;
/// Below this relative step the derivatives are taken once and kept.
const SAME_SLOPES: f64 = 1e-5;
/// How often the box may be widened, and by how much each time.
const INFLATIONS: usize = 3;
const INFLATION: f64 = 8.0;

fn slopes_at<const N: usize>(system: &impl Enclosure<N>, x: &[f64; N]) -> [[f64; N]; N] {
    system.derivatives(&x.map(Interval::point)).map(|row| row.map(Interval::middle))
}

fn times<const N: usize>(matrix: &[[f64; N]; N], vector: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| (0..N).map(|j| matrix[i][j] * vector[j]).sum())
}

/// Krawczyk's test with a given middle, the values there, and a matrix.
fn decide<const N: usize>(
    system: &impl Enclosure<N>,
    region: &Region<N>,
    middle: &[f64; N],
    values: &[Interval; N],
    matrix: &[[f64; N]; N],
) -> (Verdict, Region<N>) {
    let slopes = system.derivatives(region);
    let away: Region<N> = std::array::from_fn(|k| region[k] - Interval::point(middle[k]));
    let image: Region<N> = std::array::from_fn(|i| {
        let y = &matrix[i];
        let mut sum = Interval::point(middle[i]);
        for j in 0..N {
            sum = sum - values[j].times(y[j]);
            let mut rest = if i == j { Interval::ONE } else { Interval::ZERO };
            for (row, &factor) in slopes.iter().zip(y) {
                if row[j] != Interval::ZERO {
                    rest = rest - row[j].times(factor);
                }
            }
            sum = sum + rest * away[j];
        }
        sum
    });
    if (0..N).all(|k| region[k].encloses_strictly(image[k])) {
        return (Verdict::Proven, image);
    }
    if (0..N).any(|k| region[k].intersection(image[k]).is_none()) {
        return (Verdict::Refuted, *region);
    }
    (Verdict::Undecided, *region)
}

/// The inverse by elimination with row exchanges, in `f64`; any matrix is sound here, so nothing depends on its accuracy but success.
fn inverse<const N: usize>(mut a: [[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let mut out: [[f64; N]; N] = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
    for column in 0..N {
        let pivot = (column..N).max_by(|&p, &q| a[p][column].abs().total_cmp(&a[q][column].abs()))?;
        a.swap(column, pivot);
        out.swap(column, pivot);
        let scale = 1.0 / a[column][column];
        if !scale.is_finite() {
            return None;
        }
        a[column] = a[column].map(|x| x * scale);
        out[column] = out[column].map(|x| x * scale);
        let (pivot_row, pivot_out) = (a[column], out[column]);
        for row in (0..N).filter(|&row| row != column) {
            let factor = a[row][column];
            for k in 0..N {
                a[row][k] -= factor * pivot_row[k];
                out[row][k] -= factor * pivot_out[k];
            }
        }
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: &Region<1>) -> [Interval; 1] {
        [x[0].square() - Interval::point(2.0)]
    }

    fn slope(x: &Region<1>) -> [[Interval; 1]; 1] {
        [[x[0].scale(1)]]
    }

    fn between(lo: f64, hi: f64) -> Region<1> {
        [Interval::new(lo, hi).expect("ordered")]
    }

    #[test]
    fn one_zero_is_proved_none_refuted_and_two_left_open() {
        let system = (square, slope);
        assert_eq!(unique_zero(&system, &between(1.3, 1.5)).0, Verdict::Proven);
        assert_eq!(unique_zero(&system, &between(1.42, 1.5)).0, Verdict::Refuted);
        assert_ne!(unique_zero(&system, &between(-2.0, 2.0)).0, Verdict::Proven);
        // Both roots together are no single one.
        assert_ne!(unique_zero(&system, &between(-1.5, 1.6)).0, Verdict::Proven);
    }

    #[test]
    fn a_zero_at_the_edge_is_not_claimed() {
        let line = |x: &Region<1>| [x[0] - Interval::ONE];
        let one = |_: &Region<1>| [[Interval::ONE]];
        assert_ne!(unique_zero(&(line, one), &between(1.0, 2.0)).0, Verdict::Refuted);
        assert_eq!(unique_zero(&(line, one), &between(0.5, 2.0)).0, Verdict::Proven);
        // The image fills this box to its ends: the theorem asks for its inside.
        assert_eq!(unique_zero(&(line, one), &between(1.0, 1.0)).0, Verdict::Undecided);
    }

    #[test]
    fn a_double_zero_is_never_proved_simple() {
        let system = (|x: &Region<1>| [x[0].square()], |x: &Region<1>| [[x[0].scale(1)]]);
        assert!(enclose_zero(&system, [1e-9]).is_none());
        let near_double = (|x: &Region<1>| [x[0].square() + Interval::point(1e-30)], |x: &Region<1>| [[x[0].scale(1)]]);
        assert!(enclose_zero(&near_double, [1e-9]).is_none());
    }

    #[test]
    fn enclosures_are_as_small_as_the_numbers_allow() {
        let found = enclose_zero(&(square, slope), [1.4]).expect("a simple zero");
        assert!(found[0].contains(std::f64::consts::SQRT_2) && found[0].width() < 1e-14, "{found:?}");
    }
}
