//! Which rotations take three directions into given angles with three normals: `n_i · R v_i = k_i`?
//!
//! 1. `R v1` runs over a circle, by one angle `theta`; about it, `R` turns by a second angle `psi`.
//! 2. The two conditions left are linear in `(cos psi, sin psi)`, with coefficients `A, B, C` of order 1 in `theta`; their resultant in `psi` is
//!    `(B2 C3 - B3 C2)² + (C2 A3 - C3 A2)² - (A2 B3 - A3 B2)²`: order 4, so degree 8 in `tan(theta/2)`, and at most eight rotations (derivation `tripod_orientation`).
//! 3. Its roots come from the companion matrix; each gives `psi`, by the linear equations where they determine it and by each alone where
//!    they do not (two rotations that share `theta`: a double root); Newton's method on the rotation polishes all.
//!
//! Normals and directions need not belong to a three-legged robot: the Hexapteron's orientations are of this kind with `k ≠ 0`.

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::algebra::UPoly;
use crate::roots::companion_roots_real;
use crate::solve::Account;

/// Three conditions `n_i · R v_i = k_i`; `n_i`, `v_i` of length 1, `k_i` a cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneConditions {
    /// `n_i`, in the base frame.
    pub normals: [Vector3<f64>; 3],
    /// `v_i`, in the platform's frame.
    pub directions: [Vector3<f64>; 3],
    /// `k_i`.
    pub cosines: [f64; 3],
}

/// The rotations that meet three conditions.
#[derive(Clone, Debug, PartialEq)]
pub struct Orientations {
    /// Each real rotation with its multiplicity: 2 where two meet.
    pub rotations: Vec<(Rotation3<f64>, usize)>,
    /// Degree 8 = real + complex; a condition that no direction can meet makes all eight complex. Decided numerically.
    pub account: Account,
    /// Whether the resultant vanishes: a whole curve of rotations, or directions in line.
    pub self_motion: bool,
}

/// The zero of `theta` is turned by this angle, in radians, so that the half-turn, where the half-angle runs to infinity, is no place people choose.
const TURN: f64 = 0.7213;
/// Coefficients this small over the largest possible make the resultant zero (heuristic; sums of some hundred roundings).
const VANISHING: f64 = 1e-13;
/// Roots with a larger imaginary part, over `1 + |root|²`, start no search: a double root comes with one of 1e-8 (heuristic; a start too many is refused).
const NEARLY_REAL: f64 = 1e-3;
/// The two equations in `psi` count as parallel below this sine; then each alone is tried as well (heuristic; likewise).
const PARALLEL: f64 = 1e-3;
/// A rotation meets its conditions to this.
const MET: f64 = 1e-12;
/// Rotations whose matrices are closer than this are one.
const SAME: f64 = 1e-7;
/// The normalised determinant below which a rotation counts twice: two meet (heuristic).
const DOUBLE: f64 = 1e-6;
/// A start lifted from an exact root is nearer to its rotation than this (heuristic: six digits are left even where eight solutions crowd).
const NEAR: f64 = 1e-3;
const NEWTON_STEPS: usize = 30;

impl PlaneConditions {
    /// Every rotation that meets the conditions.
    ///
    /// **Shape**: at most eight. **Accuracy**: polished to rounding unless two meet. **Proof**: none; the count is numerical. **Cost**: some tens of microseconds.
    /// **Source**: the derivation `tripod_orientation`.
    pub fn solve(&self) -> Orientations {
        let mut account = Account { degree: 8, ..Account::default() };
        let nothing = |account| Orientations { rotations: Vec::new(), account, self_motion: false };
        if self.cosines.iter().any(|k| k.abs() > 1.0) {
            account.complex = 8;
            return nothing(account);
        }
        let frame = Frame::new(self);
        let resultant = frame.resultant();
        let coefficients = resultant.coefficients();
        let largest = coefficients.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        if largest <= VANISHING {
            account.self_motion = 8;
            return Orientations { rotations: Vec::new(), account, self_motion: true };
        }
        // Trailing noise would make roots far out, which stand for the half-turn all the same.
        let mut padded = coefficients.to_vec();
        while padded.last().is_some_and(|c| c.abs() <= f64::EPSILON * largest) {
            padded.pop();
        }
        let Ok(roots) = companion_roots_real(&padded) else {
            account.undecided = 8;
            return nothing(account);
        };
        let mut found: Vec<(Rotation3<f64>, usize)> = Vec::new();
        let at_half_turn = (padded.len() < 9).then_some((-1.0, 0.0));
        let starts = roots.finite.iter().filter(|t| t.im.abs() <= NEARLY_REAL * (1.0 + t.norm_sqr())).map(|t| {
            let w = 1.0 + t.re * t.re;
            ((1.0 - t.re * t.re) / w, 2.0 * t.re / w)
        });
        for (cosine, sine) in starts.chain(at_half_turn) {
            for seed in frame.seeds(cosine, sine).into_iter().flatten() {
                let Some((rotation, regular)) = self.polished(seed) else { continue };
                if found.iter().all(|(known, _)| (known.matrix() - rotation.matrix()).norm() > SAME) {
                    found.push((rotation, if regular > DOUBLE { 1 } else { 2 }));
                }
            }
        }
        sort(&mut found);
        account.real = found.iter().map(|(_, multiplicity)| multiplicity).sum::<usize>().min(8);
        account.complex = 8 - account.real;
        Orientations { rotations: found, account, self_motion: false }
    }

    /// The polynomial of degree 8 in the half-angle whose real roots carry the rotations, ascending, and the frame it is about.
    ///
    /// For checking it against the general elimination: `R v1 = k1 n1 + sqrt(1 - k1²)(cos theta a + sin theta b)`, where the columns of the matrix are
    /// `a`, `b`, `n1`.
    pub fn resultant(&self) -> (UPoly<f64>, Matrix3<f64>) {
        let frame = Frame::new(self);
        (frame.resultant(), Matrix3::from_columns(&[frame.a, frame.b, frame.n]))
    }

    /// How far a rotation is from meeting the conditions.
    pub fn residual(&self, rotation: &Rotation3<f64>) -> f64 {
        self.values(rotation).amax()
    }

    /// The rotation that Newton's method finds near a start; `None` where it strays or does not settle.
    pub(super) fn polished_from(&self, seed: Rotation3<f64>) -> Option<Rotation3<f64>> {
        let (rotation, _) = self.polished(seed)?;
        ((rotation.matrix() - seed.matrix()).norm() <= NEAR).then_some(rotation)
    }

    fn values(&self, rotation: &Rotation3<f64>) -> Vector3<f64> {
        Vector3::from_fn(|k, _| self.normals[k].dot(&(rotation * self.directions[k])) - self.cosines[k])
    }

    /// Newton's method on the rotation, and the normalised determinant where it ends.
    fn polished(&self, mut rotation: Rotation3<f64>) -> Option<(Rotation3<f64>, f64)> {
        let mut last = f64::INFINITY;
        for _ in 0..NEWTON_STEPS {
            let values = self.values(&rotation);
            let rows: [Vector3<f64>; 3] =
                std::array::from_fn(|k| (rotation * self.directions[k]).cross(&self.normals[k]));
            let size = values.amax();
            let [a, b, c] = rows;
            let determinant = a.dot(&b.cross(&c));
            if size <= 2.0 * f64::EPSILON || (size <= MET && size >= 0.5 * last) {
                let lengths = rows.iter().map(|row| row.norm()).product::<f64>();
                let regular = if lengths > 0.0 { determinant.abs() / lengths } else { 0.0 };
                return Some((rotation, regular));
            }
            last = size;
            let step = -(b.cross(&c) * values.x + c.cross(&a) * values.y + a.cross(&b) * values.z) / determinant;
            if !step.iter().all(|x| x.is_finite()) {
                return None;
            }
            // A long step is no step towards a root; cut, it may still lead to one.
            let length = step.norm();
            rotation = Rotation3::new(if length > 1.0 { step / length } else { step }) * rotation;
            // One step of Newton's iteration for the nearest rotation: rounding leaves no more to do.
            let m = rotation.into_inner();
            rotation = Rotation3::from_matrix_unchecked(m * (Matrix3::identity() * 3.0 - m.transpose() * m) * 0.5);
        }
        // Slow convergence: a multiple rotation.
        (self.values(&rotation).amax() <= MET.sqrt()).then_some((rotation, 0.0))
    }
}

/// Rotations in the order of their entries, column by column.
pub(super) fn sort(rotations: &mut [(Rotation3<f64>, usize)]) {
    rotations.sort_by(|(a, _), (b, _)| {
        let key = |r: &Rotation3<f64>| r.matrix().map(|x| (x * 1e9).round());
        key(a).iter().partial_cmp(key(b).iter()).unwrap_or(std::cmp::Ordering::Equal)
    });
}

/// The frame in which the two angles are measured.
struct Frame {
    a: Vector3<f64>,
    b: Vector3<f64>,
    n: Vector3<f64>,
    k: f64,
    h: f64,
    /// The frame on the platform: `v1` and two across.
    platform: Matrix3<f64>,
    /// `(A, B, C)` of the conditions 2 and 3, each as coefficients of `1, cos theta, sin theta`.
    equations: [[[f64; 3]; 3]; 2],
}

impl Frame {
    fn new(conditions: &PlaneConditions) -> Self {
        let [n, ..] = conditions.normals;
        let across = |v: Vector3<f64>| {
            let least = v.iamin();
            v.cross(&Vector3::from_fn(|i, _| f64::from(i == least))).normalize()
        };
        let (first, second) = (across(n), n.cross(&across(n)));
        let (s, c) = TURN.sin_cos();
        let (a, b) = (first * c + second * s, second * c - first * s);
        let k = conditions.cosines[0];
        let h = ((1.0 - k) * (1.0 + k)).sqrt();
        let v1 = conditions.directions[0];
        let e = across(v1);
        let platform = Matrix3::from_columns(&[v1, e, v1.cross(&e)]);
        // p = k n + h (a c + b s), t = b c - a s, f = p × t = k (n × t) + h n, with n × t = -(a c + b s).
        let equations = [1, 2].map(|i| {
            let normal = conditions.normals[i];
            let local = platform.transpose() * conditions.directions[i];
            let (na, nb, nn) = (normal.dot(&a), normal.dot(&b), normal.dot(&n));
            let p = [k * nn, h * na, h * nb];
            let t = [0.0, nb, -na];
            let f = [h * nn, -k * na, -k * nb];
            let mix = |x: f64, y: f64, p: &[f64; 3], q: &[f64; 3]| std::array::from_fn(|j| x * p[j] + y * q[j]);
            let mut constant: [f64; 3] = p.map(|x| local.x * x);
            constant[0] -= conditions.cosines[i];
            [mix(local.y, local.z, &t, &f), mix(local.y, -local.z, &f, &t), constant]
        });
        Self { a, b, n, k, h, platform, equations }
    }

    fn resultant(&self) -> UPoly<f64> {
        // x + y cos + z sin over (1 + t²): (x + y) + 2 z t + (x - y) t².
        let chart = |[x, y, z]: [f64; 3]| UPoly::new(vec![x + y, 2.0 * z, x - y]);
        let [[a2, b2, c2], [a3, b3, c3]] = self.equations.map(|equation| equation.map(chart));
        let minor = |p: &UPoly<f64>, q: &UPoly<f64>, r: &UPoly<f64>, s: &UPoly<f64>| {
            let difference = p.clone() * q.clone() - r.clone() * s.clone();
            difference.clone() * difference
        };
        minor(&b2, &c3, &b3, &c2) + minor(&c2, &a3, &c3, &a2) - minor(&a2, &b3, &a3, &b2)
    }

    /// Rotations to start from, for one `theta`.
    fn seeds(&self, cosine: f64, sine: f64) -> [Option<Rotation3<f64>>; 5] {
        let [[a2, b2, c2], [a3, b3, c3]] =
            self.equations.map(|equation| equation.map(|[x, y, z]| x + y * cosine + z * sine));
        let p = self.n * self.k + (self.a * cosine + self.b * sine) * self.h;
        let t = self.b * cosine - self.a * sine;
        let f = p.cross(&t);
        let rotation = |c: f64, s: f64| {
            let size = c.hypot(s);
            (size > 0.0).then(|| {
                let (c, s) = (c / size, s / size);
                let base = Matrix3::from_columns(&[p, t * c + f * s, f * c - t * s]);
                Rotation3::from_matrix_unchecked(base * self.platform.transpose())
            })
        };
        let determinant = a2 * b3 - a3 * b2;
        let sizes = a2.hypot(b2) * a3.hypot(b3);
        // An equation that vanishes at a root, as where two normals are square to each other, is left with noise: the other one alone tells.
        let faint = a2.hypot(b2).min(a3.hypot(b3)) <= PARALLEL;
        let mut seeds = [None; 5];
        if determinant.abs() > 1e-9 * sizes {
            seeds[0] = rotation((b2 * c3 - b3 * c2) / determinant, (c2 * a3 - c3 * a2) / determinant);
        }
        if determinant.abs() <= PARALLEL * sizes || faint {
            for (k, [a, b, c]) in [[a2, b2, c2], [a3, b3, c3]].into_iter().enumerate() {
                let square = a * a + b * b;
                let rest = (square - c * c).max(0.0).sqrt();
                if square > 0.0 {
                    for (j, side) in [1.0, -1.0].into_iter().enumerate() {
                        seeds[1 + 2 * k + j] =
                            rotation((-a * c - side * b * rest) / square, (-b * c + side * a * rest) / square);
                    }
                }
            }
        }
        seeds
    }
}
