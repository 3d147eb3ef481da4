//! Coefficient-parameter homotopy: from one generic complex member of a family of triads to any other, one path a solution.

use num_complex::Complex64;

use super::Outcome;
use super::linear::{Factored, Matrix, Vector};
use super::rows::{Problem, Row, support, system};
use super::total_degree::{Numbers, solve_rows};
use super::track::{Homotopy, ORDER, Settings, larger, polish, track};

/// Two ends closer than this, relative, are one solution: the paths jumped.
const SAME: f64 = 1e-9;

/// The most solutions of any triad.
const MOST: usize = 6;

/// A straight line between the rows of two triads of one name.
pub struct Segment {
    start: [Row; 3],
    delta: [Row; 3],
}

impl Segment {
    /// From one triad's rows, at `t = 0`, to another's, at `t = 1`.
    pub fn new(start: &[Row; 3], end: &[Row; 3]) -> Self {
        let delta = std::array::from_fn(|i| std::array::from_fn(|j| end[i][j] - start[i][j]));
        Self { start: *start, delta }
    }

    #[inline]
    fn at(&self, t: f64) -> [Row; 3] {
        std::array::from_fn(|i| std::array::from_fn(|j| self.start[i][j] + self.delta[i][j] * t))
    }
}

impl Homotopy<3> for Segment {
    #[inline]
    fn system(&self, x: &Vector<3>, t: f64) -> (Vector<3>, Matrix<3>) {
        system(&self.at(t), x)
    }

    #[inline]
    fn drift(&self, [theta, u, v]: &Vector<3>, _: f64) -> Vector<3> {
        let tau = theta.inv();
        self.delta
            .map(|d| u * (d[0] * v + d[1] * tau + d[3]) + v * (d[2] * theta + d[4]) + d[5] * theta + d[6] * tau + d[7])
    }

    /// Order by order: the rows with this order's unknowns left out, then one solve with the same Jacobian.
    #[inline]
    fn series(&self, x: &Vector<3>, t: f64) -> Option<[Vector<3>; ORDER]> {
        let rows = self.at(t);
        let factored = Factored::new(system(&rows, x).1)?;
        let zero = Complex64::ZERO;
        let (mut theta, mut u, mut v, mut tau) =
            ([zero; ORDER + 1], [zero; ORDER + 1], [zero; ORDER + 1], [zero; ORDER + 1]);
        (theta[0], u[0], v[0], tau[0]) = (x[0], x[1], x[2], x[0].inv());
        // Each row is u·p + v·q + r with p, q linear in the unknowns.
        let (mut p, mut q) = ([[zero; ORDER + 1]; 3], [[zero; ORDER + 1]; 3]);
        for i in 0..3 {
            let c = &rows[i];
            p[i][0] = c[1] * tau[0] + c[3];
            q[i][0] = c[2] * theta[0] + c[4];
        }
        // Only the reference leg has u v.
        let (c0, d0) = (rows[0][0], self.delta[0][0]);
        p[0][0] += c0 * v[0];
        let mut out = [[zero; 3]; ORDER];
        for k in 1..=ORDER {
            // tau·theta = 1, this order of theta left out.
            let mut sum = zero;
            for i in 1..k {
                sum += theta[i] * tau[k - i];
            }
            tau[k] = -tau[0] * sum;
            let mut value = [zero; 3];
            for i in 0..3 {
                let (c, d) = (&rows[i], &self.delta[i]);
                p[i][k] = c[1] * tau[k] + d[1] * tau[k - 1];
                if i == 0 {
                    p[0][k] += d0 * v[k - 1];
                }
                q[i][k] = d[2] * theta[k - 1];
                let mut r = c[6] * tau[k] + d[5] * theta[k - 1] + d[6] * tau[k - 1];
                if k == 1 {
                    p[i][1] += d[3];
                    q[i][1] += d[4];
                    r += d[7];
                }
                for j in 0..k {
                    r += u[j] * p[i][k - j] + v[j] * q[i][k - j];
                }
                value[i] = -r;
            }
            let next = factored.solve(&value);
            (theta[k], u[k], v[k]) = (next[0], next[1], next[2]);
            let more = -tau[0] * tau[0] * theta[k];
            tau[k] += more;
            for i in 0..3 {
                let c = &rows[i];
                p[i][k] += c[1] * more;
                q[i][k] += c[2] * theta[k];
            }
            p[0][k] += c0 * v[k];
            out[k - 1] = next;
        }
        Some(out)
    }

    #[inline]
    fn relative(&self, dx: &Vector<3>, x: &Vector<3>) -> f64 {
        // theta by itself, for it may be small or large; u and v together.
        let place = x[1].norm_sqr() + x[2].norm_sqr();
        (dx[0].norm_sqr() / x[0].norm_sqr()).max((dx[1].norm_sqr() + dx[2].norm_sqr()) / place)
    }
}

/// All triads of one name, with a generic complex member solved.
pub struct Family {
    names: [&'static str; 3],
    start: [Row; 3],
    solutions: Vec<Vector<3>>,
}

impl Family {
    /// The family of these legs, RR before PR before RP.
    ///
    /// A random member is solved by the total degree; then its solutions are carried around triangles of random members until
    /// several in turn bring no new one (monodromy). So a path lost at first is found here.
    pub fn new(names: [&'static str; 3], seed: u64) -> Self {
        let mut numbers = Numbers::new(seed);
        let mut member = || member(&names, &mut numbers);
        let start = member();
        let settings = Settings::default().careful();
        let (mut solutions, _) = solve_rows(&start, seed, &settings);
        let mut quiet = 0;
        while quiet < 4 {
            let corners = [start, member(), member(), start];
            let sides: [Segment; 3] = std::array::from_fn(|i| Segment::new(&corners[i], &corners[i + 1]));
            let before = solutions.len();
            for mut x in solutions.clone() {
                let mut steps = 0;
                let end = sides.iter().try_for_each(|side| {
                    x = track(side, x, 0.0, 1.0, &settings, &mut steps)?;
                    Some(())
                });
                let end = end.and_then(|()| polish(&sides[2], x, 1.0));
                solutions.extend(end.filter(|x| !solutions.iter().any(|y| alike(x, y))));
            }
            quiet = if solutions.len() == before && before > 0 { quiet + 1 } else { 0 };
        }
        Self { names, start, solutions }
    }

    /// How many solutions the generic member has.
    pub fn degree(&self) -> usize {
        self.solutions.len()
    }

    /// The solutions of a triad of this family.
    pub fn solve(&self, problem: &Problem, settings: &Settings) -> Outcome {
        assert_eq!(self.names, problem.names, "a triad of another family");
        let segment = Segment::new(&self.start, &problem.rows);
        let mut out = Outcome { paths: self.solutions.len(), ..Outcome::default() };
        let mut ends: [Option<Vector<3>>; MOST] = [None; MOST];
        let mut again = [false; MOST];
        for (end, start) in ends.iter_mut().zip(&self.solutions) {
            *end = follow(&segment, start, settings, &mut out.steps);
        }
        for (i, end) in ends.iter().enumerate().take(out.paths) {
            let meets = |j: usize| j != i && matches!((end, ends[j]), (Some(x), Some(y)) if alike(x, &y));
            again[i] = end.is_none() || (0..out.paths).any(meets);
        }
        let careful = settings.careful();
        for i in (0..out.paths).filter(|&i| again[i]) {
            out.repeated += 1;
            ends[i] = follow(&segment, &self.solutions[i], &careful, &mut out.steps);
        }
        let mut kept: [Option<Vector<3>>; MOST] = [None; MOST];
        out.solutions.reserve_exact(out.paths);
        for (i, end) in ends.iter().enumerate().take(out.paths) {
            match end {
                None => out.failed += 1,
                Some(x) if kept[..i].iter().flatten().any(|y| alike(x, y)) => out.jumped += 1,
                Some(x) => {
                    kept[i] = Some(*x);
                    out.solutions.push(problem.solution(x));
                }
            }
        }
        out
    }
}

#[inline]
fn follow(segment: &Segment, start: &Vector<3>, settings: &Settings, steps: &mut usize) -> Option<Vector<3>> {
    let end = track(segment, *start, 0.0, 1.0, settings, steps)?;
    polish(segment, end, 1.0)
}

/// Whether two points are one solution.
pub fn alike(x: &Vector<3>, y: &Vector<3>) -> bool {
    let size = x.iter().chain(y).fold(0.0, larger);
    let apart = (0..3).map(|i| (x[i] - y[i]).norm_sqr()).fold(0.0, f64::max);
    apart <= SAME * SAME * size
}

/// Random complex rows on the support of these legs; the coefficient of `u v` stays 1.
fn member(names: &[&str; 3], numbers: &mut Numbers) -> [Row; 3] {
    support(names).map(|terms| {
        let mut row = terms.map(|present| if present { numbers.complex() } else { Complex64::ZERO });
        if terms[0] {
            row[0] = Complex64::ONE;
        }
        row
    })
}
