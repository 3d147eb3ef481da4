//! Quartics in the plane, on rays from the origin and over sectors: where they first turn negative, and that they do not.
//!
//! On a ray the quartic is a polynomial of degree 4 in the distance; over a sector, by its polar forms on the two edges, it has Bernstein coefficients in distance and
//! direction. Positive coefficients prove it positive; over a sector they are off by the square of its width.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// By degree: `[k][j]` belongs to `p^(k-j) q^j`; beyond `j = k` there is nothing.
pub(super) type ByDegree = [[f64; 5]; 5];

/// A polynomial of degree 4 in `p` and `q`.
#[derive(Clone, Copy)]
pub(super) struct Quartic(pub(super) ByDegree);

/// Halvings in the search for a root on a ray.
const DEPTH: u32 = 40;
/// Halvings of a sector along its rays before its width is blamed: coefficients of a quartic settle in a few (heuristic).
const RADIAL_DEPTH: u32 = 6;
/// `C(k, j)`.
const BINOMIAL: ByDegree = [
    [1.0, 0.0, 0.0, 0.0, 0.0],
    [1.0, 1.0, 0.0, 0.0, 0.0],
    [1.0, 2.0, 1.0, 0.0, 0.0],
    [1.0, 3.0, 3.0, 1.0, 0.0],
    [1.0, 4.0, 6.0, 4.0, 1.0],
];

impl Quartic {
    /// The polynomial in the distance `t` on the ray of an angle, from the constant up.
    pub(super) fn ray(&self, [cosine, sine]: [f64; 2]) -> [f64; 5] {
        let mut powers = [1.0; 5];
        let mut on_ray = [self.0[0][0], 0.0, 0.0, 0.0, 0.0];
        for k in 1..5 {
            // powers[j] = cosine^(k-j) sine^j
            powers[k] = powers[k - 1] * sine;
            powers[..k].iter_mut().for_each(|power| *power *= cosine);
            on_ray[k] = (0..=k).map(|j| self.0[k][j] * powers[j]).sum();
        }
        on_ray
    }

    /// The derivative by the angle, `p d/dq - q d/dp`: a quartic again.
    pub(super) fn by_angle(&self) -> Self {
        let mut derivative = [[0.0; 5]; 5];
        for (k, (turned, form)) in derivative.iter_mut().zip(&self.0).enumerate() {
            for j in 0..=k {
                if j < k {
                    turned[j + 1] -= (k - j) as f64 * form[j];
                }
                if j > 0 {
                    turned[j - 1] += j as f64 * form[j];
                }
            }
        }
        Self(derivative)
    }

    /// The four quadrants, counter-clockwise from the first.
    pub(super) fn quadrants(&self) -> [Sector; 4] {
        std::array::from_fn(|quadrant| {
            let mut polar = [[0.0; 5]; 5];
            for k in 0..5 {
                for j in 0..=k {
                    // In the second quadrant (p, q) = (-b, a) on the edges a, b; the others are opposite.
                    let (from, flips) = if quadrant % 2 == 0 { (j, 0) } else { (k - j, j) };
                    let odd = (flips + k * (quadrant / 2)) % 2 == 1;
                    let entry = self.0[k][from] / BINOMIAL[k][j];
                    polar[k][j] = if odd { -entry } else { entry };
                }
            }
            Sector { polar, start: FRAC_PI_2 * quadrant as f64, half: FRAC_PI_4 }
        })
    }
}

/// A quartic over a sector of directions.
#[derive(Clone, Copy)]
pub(super) struct Sector {
    /// `[k][j]`: the part of degree `k` polarised, with `j` arguments on the second edge and `k - j` on the first.
    polar: ByDegree,
    /// Angle of the first edge.
    pub(super) start: f64,
    /// Half the angle between the edges.
    pub(super) half: f64,
}

impl Sector {
    /// On the first edge, as [`Quartic::ray`].
    pub(super) fn first_edge(&self) -> [f64; 5] {
        self.polar.map(|form| form[0])
    }

    /// Both halves.
    pub(super) fn halves(&self) -> [Self; 2] {
        // The unit vector between is the edges' sum times this, and polar forms are linear in each argument.
        let weight = 0.5 / self.half.cos();
        let (mut left, mut right) = ([[0.0; 5]; 5], [[0.0; 5]; 5]);
        for k in 0..5 {
            let mut row = self.polar[k];
            for n in 0..=k {
                left[k][n] = row[0];
                right[k][k - n] = row[k - n];
                for i in 0..k - n {
                    row[i] = weight * (row[i] + row[i + 1]);
                }
            }
        }
        let half = 0.5 * self.half;
        [Self { polar: left, start: self.start, half }, Self { polar: right, start: self.start + self.half, half }]
    }

    /// Whether the quartic is shown not to be negative at any distance up to `until`, and by `margin` times its largest coefficient more than that.
    pub(super) fn kept(&self, until: f64, margin: f64) -> bool {
        // The triangle on the edges has to reach as far in the middle.
        let until = until / self.half.cos();
        let (mut columns, mut scale) = ([[0.0; 5]; 5], 1.0);
        for (k, mut raised) in self.polar.into_iter().enumerate() {
            for degree in k + 1..5 {
                for i in (1..=degree).rev() {
                    let share = i as f64 / degree as f64;
                    let own = if i < degree { raised[i] } else { 0.0 };
                    raised[i] = share * raised[i - 1] + (1.0 - share) * own;
                }
            }
            columns.iter_mut().zip(raised).for_each(|(column, x)| column[k] = scale * x);
            scale *= until;
        }
        let columns = columns.map(|column| bernstein(&column));
        let largest = columns.iter().flatten().fold(0.0, |largest: f64, x| largest.max(x.abs()));
        not_below(&columns, margin * largest, RADIAL_DEPTH)
    }
}

fn not_below(columns: &[[f64; 5]; 5], floor: f64, depth: u32) -> bool {
    if columns.iter().flatten().all(|&x| x >= floor) {
        return true;
    }
    // Values at corners are values of the quartic.
    let corners = [columns[0][0], columns[0][4], columns[4][0], columns[4][4]];
    if depth == 0 || corners.iter().any(|&x| x < floor) {
        return false;
    }
    let both = columns.each_ref().map(halves);
    not_below(&both.map(|(near, _)| near), floor, depth - 1) && not_below(&both.map(|(_, far)| far), floor, depth - 1)
}

/// Bernstein coefficients over `[0, 1]` of a polynomial of degree 4.
fn bernstein(p: &[f64; 5]) -> [f64; 5] {
    [
        p[0],
        p[0] + p[1] / 4.0,
        p[0] + p[1] / 2.0 + p[2] / 6.0,
        p[0] + 0.75 * p[1] + p[2] / 2.0 + p[3] / 4.0,
        p[0] + p[1] + p[2] + p[3] + p[4],
    ]
}

/// The first `t` in `(0, until)` at which a polynomial that is not negative at 0 turns negative.
pub(super) fn first_end(ray: &[f64; 5], until: f64) -> Option<f64> {
    let u2 = until * until;
    let scaled = [ray[0], ray[1] * until, ray[2] * u2, ray[3] * u2 * until, ray[4] * u2 * u2];
    first_root(bernstein(&scaled), 0.0, until, DEPTH)
}

/// The first root over a cell, given its Bernstein coefficients, at which the polynomial turns negative.
fn first_root(b: [f64; 5], low: f64, high: f64, depth: u32) -> Option<f64> {
    if b.iter().all(|&x| x >= 0.0) {
        return None;
    }
    if b[0] < 0.0 || depth == 0 {
        return Some(low);
    }
    let changes = b.windows(2).filter(|pair| (pair[0] < 0.0) != (pair[1] < 0.0)).count();
    if changes == 1 {
        return Some(low + (high - low) * only_root(&b));
    }
    let (left, right) = halves(&b);
    let middle = 0.5 * (low + high);
    first_root(left, low, middle, depth - 1).or_else(|| first_root(right, middle, high, depth - 1))
}

/// De Casteljau's averages.
fn halves(b: &[f64; 5]) -> ([f64; 5], [f64; 5]) {
    let (mut left, mut right, mut row) = ([0.0; 5], [0.0; 5], *b);
    for n in 0..5 {
        left[n] = row[0];
        right[4 - n] = row[4 - n];
        for i in 0..4 - n {
            row[i] = 0.5 * (row[i] + row[i + 1]);
        }
    }
    (left, right)
}

/// The only root in `[0, 1]` of a polynomial that falls through it there: Newton's method, kept between bounds.
fn only_root(b: &[f64; 5]) -> f64 {
    let d = [b[1] - b[0], b[2] - b[1], b[3] - b[2], b[4] - b[3]];
    let at = |x: f64| {
        let y = 1.0 - x;
        let value =
            y * y * (y * y * b[0] + 4.0 * y * x * b[1] + 6.0 * x * x * b[2]) + x * x * x * (4.0 * y * b[3] + x * b[4]);
        let slope = 4.0 * (y * y * (y * d[0] + 3.0 * x * d[1]) + x * x * (3.0 * y * d[2] + x * d[3]));
        (value, slope)
    };
    let (mut low, mut high) = (0.0, 1.0);
    let mut x = if b[0] > b[4] { b[0] / (b[0] - b[4]) } else { 0.5 };
    for _ in 0..60 {
        let (value, slope) = at(x);
        if value >= 0.0 {
            low = x;
        } else {
            high = x;
        }
        let newton = x - value / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 2.0 * f64::EPSILON {
            return next;
        }
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(quartic: &Quartic, angle: f64, t: f64) -> f64 {
        quartic.ray([angle.cos(), angle.sin()]).iter().rev().fold(0.0, |sum, x| sum * t + x)
    }

    /// Any quartic will do.
    fn example() -> Quartic {
        let entry = |k: usize, j: usize| if j > k { 0.0 } else { ((7 * k + 3 * j) % 11) as f64 - 4.5 };
        Quartic(std::array::from_fn(|k| std::array::from_fn(|j| entry(k, j))))
    }

    #[test]
    fn first_roots_are_first() {
        // (t - 1/4)(t - 1/2)(t² + 1) turns negative at 1/4.
        let ray = [0.125, -0.75, 1.125, -0.75, 1.0];
        let end = first_end(&ray, 30.0).expect("ends");
        assert!((end - 0.25).abs() < 1e-14);
        assert_eq!(first_end(&ray, 0.2), None);
    }

    #[test]
    fn edges_of_sectors_are_rays() {
        let quartic = example();
        for sector in quartic.quadrants() {
            let [left, right] = sector.halves();
            for part in [sector, left, right, left.halves()[1], right.halves()[1].halves()[0]] {
                let edge = part.first_edge();
                let ray = quartic.ray([part.start.cos(), part.start.sin()]);
                assert!((0..5).all(|k| (edge[k] - ray[k]).abs() < 1e-13), "{edge:?} {ray:?}");
            }
        }
    }

    #[test]
    fn the_derivative_by_the_angle_is_one() {
        let (quartic, h) = (example(), 1e-5);
        let derivative = quartic.by_angle();
        for angle in [0.3_f64, 2.0, 5.1] {
            let difference = (at(&quartic, angle + h, 0.8) - at(&quartic, angle - h, 0.8)) / (2.0 * h);
            assert!((difference - at(&derivative, angle, 0.8)).abs() < 1e-8);
        }
    }

    #[test]
    fn what_is_kept_is_not_negative_and_the_test_settles() {
        // 1 - (p - 0.1)² - q²: negative outside a circle; the nearest point of it is at 0.9, opposite to its centre.
        let mut circle = Quartic([[0.0; 5]; 5]);
        circle.0[0][0] = 0.99;
        circle.0[1][0] = 0.2;
        (circle.0[2][0], circle.0[2][2]) = (-1.0, -1.0);
        let mut sectors = circle.quadrants().to_vec();
        let mut width = 0;
        while sectors.iter().any(|sector| !sector.kept(0.899, 0.0)) {
            sectors = sectors.iter().flat_map(Sector::halves).collect();
            width += 1;
        }
        // Off by the square of the width: a thousandth at some 45°/2^5.
        assert!((3..=6).contains(&width), "{width}");
        assert!(sectors.iter().any(|sector| !sector.kept(0.901, 0.0)));
    }
}
