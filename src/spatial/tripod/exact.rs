//! How many rotations meet three conditions `n_i · R v_i = k_i`, exactly, and which of them are spurious?
//!
//! 1. In a quaternion `q` of `R` each condition is a quadric `qᵀ M_i q = 0`, `M_i` over the numbers given: three quadrics in projective space, so eight
//!    solutions with multiplicity, or a curve of them.
//! 2. On the planes `t = (q1 + i q2 + i² q3)/q0` of a pencil they are three conics, and these have a point in common where the determinant of size 6 of the conics
//!    and of the derivatives of their Jacobian vanishes (Salmon 1885, art. 90): the eliminant, of degree 8 in `t`, by evaluation and interpolation.
//! 3. Its square-free parts tell multiplicities, Descartes' rule its real roots. Eight distinct roots, and each carries one solution: real exactly where `t` is. With fewer,
//!    two solutions might share a `t`; of 57 values of `i` one at least parts them all, since two points share the `t` of at most two, and there are 28 pairs.
//! 4. A root is lifted by the null vector of the same matrix and polished on the conditions.
//! 5. Spurious solutions of a leg have `R v` along `w`, a direction that is given: then the resultant of the two other conditions is a number
//!    `E0 ± E1·sqrt(d)` over the rationals, and whether it vanishes is decided.
//!
//! A quaternion of length 0 is never real, so nothing real is counted that is no rotation.

use std::cmp::Ordering;

use nalgebra::{DMatrix, Quaternion, Rotation3, UnitQuaternion, Vector3};

use super::orientation::{Orientations, PlaneConditions, sort};
use crate::algebra::{Integer, Rational, Ring, UPoly, dyadic, nearest_f64};
use crate::eliminate::determinant_interpolated;
use crate::roots::isolate_real_roots;
use crate::solve::Account;

type Exact3 = [Rational; 3];

/// Three conditions `n_i · R v_i = k_i` over the rationals; vectors of any length.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ExactConditions {
    pub(super) normals: [Exact3; 3],
    pub(super) directions: [Exact3; 3],
    pub(super) products: [Rational; 3],
}

/// Two points share the `t` of at most two forms, so one of these parts any 28 pairs.
const FORMS: i64 = 57;
/// A solution with `q0 = 0` lies on the axis of at most two pencils: when this many eliminants vanish, there is a curve.
const VANISHING_FORMS: i64 = 17;
/// Coordinates in which to try: a solution with `q0 = 0` makes the degree drop, and each of eight is so in at most three of these.
const FRAMES: i64 = 25;
/// Bits to which a root is isolated before it is lifted.
const BITS: usize = 120;

impl ExactConditions {
    /// Conditions of the `f64`s given; `None` unless all are finite.
    pub(super) fn new(normals: [Exact3; 3], directions: [[f64; 3]; 3], products: [Rational; 3]) -> Option<Self> {
        let [a, b, c] = directions.map(|v| exact3(&v));
        Some(Self { normals, directions: [a?, b?, c?], products })
    }

    /// The quadrics, integer and primitive.
    fn quadrics(&self) -> [[[Integer; 4]; 4]; 3] {
        std::array::from_fn(|i| {
            let (n, v, k) = (&self.normals[i], &self.directions[i], &self.products[i]);
            let along = dot(n, v);
            let across = cross(v, n);
            let entry = |row: usize, column: usize| match (row, column) {
                (0, 0) => along.clone() - k.clone(),
                (0, j) | (j, 0) => across[j - 1].clone(),
                (a, b) => {
                    let (a, b) = (a - 1, b - 1);
                    let outer = n[a].clone() * v[b].clone() + v[a].clone() * n[b].clone();
                    if a == b { outer - along.clone() - k.clone() } else { outer }
                }
            };
            let entries: [[Rational; 4]; 4] = std::array::from_fn(|r| std::array::from_fn(|c| entry(r, c)));
            primitive(&entries)
        })
    }

    /// Every real rotation with its multiplicity, and the account; the numbers in it are exact.
    pub(super) fn solve(&self, measured: &PlaneConditions) -> Orientations {
        let quadrics = self.quadrics();
        let mut account = Account { degree: 8, ..Account::default() };
        let mut best: Option<Pencil> = None;
        let mut vanishing = 0;
        'frames: for frame in 0..FRAMES {
            // The first two would not part the rotations that permute the axes, which are the spurious ones of the Cartesian robot.
            for form in 2..2 + FORMS {
                let pencil = Pencil::new(&quadrics, frame, form);
                if pencil.eliminant.vanishes() {
                    vanishing += 1;
                    if vanishing >= VANISHING_FORMS {
                        account.self_motion = 8;
                        return Orientations { rotations: Vec::new(), account, self_motion: true };
                    }
                    continue;
                }
                if pencil.eliminant.degree() != Some(8) {
                    // A half-turn of this frame.
                    continue 'frames;
                }
                let distinct = pencil.distinct();
                if best.as_ref().is_none_or(|known| distinct > known.distinct()) {
                    best = Some(pencil);
                }
                if distinct == 8 {
                    break 'frames;
                }
            }
            if best.is_some() {
                break;
            }
        }
        let Some(pencil) = best else {
            account.undecided = 8;
            return Orientations { rotations: Vec::new(), account, self_motion: false };
        };
        let mut rotations = Vec::new();
        for (factor, multiplicity) in &pencil.parts {
            for isolation in isolate_real_roots(factor) {
                account.real += multiplicity;
                let t = nearest_f64(&isolation.refined(factor, BITS).low);
                match pencil.lifted(t).and_then(|seed| measured.polished_from(seed)) {
                    Some(rotation) => rotations.push((rotation, *multiplicity)),
                    None => account.undecided += multiplicity,
                }
            }
        }
        account.complex = 8 - account.real;
        account.real -= account.undecided;
        sort(&mut rotations);
        Orientations { rotations, account, self_motion: false }
    }

    /// How many solutions have `R v` along a direction `w` square to the normal, for one of the conditions; `None` for a curve of them.
    pub(super) fn along(&self, leg: usize, w: &Exact3) -> Option<usize> {
        let (other, third) = ((leg + 1) % 3, (leg + 2) % 3);
        let (n1, v1, p) = (&self.normals[leg], &self.directions[leg], w);
        let [n2, n3] = [&self.normals[other], &self.normals[third]];
        let [v2, v3] = [&self.directions[other], &self.directions[third]];
        let (p_square, n_square, v_square) = (dot(p, p), dot(n1, n1), dot(v1, v1));
        let side = cross(p, n1);
        let (a2, a3) = (dot(v2, v1), dot(v3, v1));
        let (m2, m3) = (
            v_square.clone() * dot(v2, v2) - a2.clone() * a2.clone(),
            v_square.clone() * dot(v3, v3) - a3.clone() * a3.clone(),
        );
        let delta = v_square.clone() * dot(v2, v3) - a2.clone() * a3.clone();
        let x = dot(v1, &cross(v2, v3));
        let [g2, g3] = [dot(n2, n1), dot(n3, n1)];
        let [h2, h3] = [dot(n2, &side), dot(n3, &side)];
        let [k2, k3] = [dot(n2, p), dot(n3, p)];
        let big_p = p_square.clone() * g2.clone() * g3.clone() + h2.clone() * h3.clone();
        let q = g2.clone() * h3.clone() - h2.clone() * g3.clone();
        let (c2, c3) = (a2.clone() * k2, a3.clone() * k3);
        let square = |x: &Rational| x.clone() * x.clone();
        // |(A, B)|² of either condition, times |v1|².
        let [s2, s3] =
            [m2 * (p_square.clone() * square(&g2) + square(&h2)), m3 * (p_square.clone() * square(&g3) + square(&h3))];
        let two = Rational::from_int(2);
        let e0 = n_square.clone()
            * (square(&c2) * s3.clone() + square(&c3) * s2.clone()
                - two.clone() * c2.clone() * c3.clone() * delta.clone() * big_p.clone())
            - p_square.clone() * square(&delta) * square(&q)
            - v_square.clone() * square(&x) * square(&big_p);
        let e1 = two.clone() * delta.clone() * q.clone() * x.clone() * big_p.clone()
            - two * n_square.clone() * c2.clone() * c3.clone() * x.clone() * q.clone();
        let root_square = p_square * v_square;
        let mut count = 0;
        for sign in [1, -1] {
            let signed = |y: &Rational| if sign > 0 { y.clone() } else { -y.clone() };
            if surd_sign(&e0, &signed(&e1), &root_square) != Ordering::Equal {
                continue;
            }
            // The equations in psi are parallel where s·delta·q = sqrt(v²)·x·P; times sqrt(v²).
            let parallel = surd_sign(
                &-(self.square_of_direction(leg) * x.clone() * big_p.clone()),
                &signed(&(delta.clone() * q.clone())),
                &root_square,
            );
            if parallel != Ordering::Equal {
                count += 1;
                continue;
            }
            let zero = Rational::zero();
            let (s, c) = if s2 == zero { (&s3, &c3) } else { (&s2, &c2) };
            if *s == zero {
                return None;
            }
            // Times |v1|²: the line A X + B Y + C = 0 meets the circle.
            let reach = s.clone() - n_square.clone() * square(c);
            count += match reach.partial_cmp(&zero) {
                Some(Ordering::Greater) => 2,
                Some(Ordering::Equal) => 1,
                _ => 0,
            };
        }
        Some(count)
    }

    fn square_of_direction(&self, leg: usize) -> Rational {
        dot(&self.directions[leg], &self.directions[leg])
    }

    /// Whether the normals lie in a plane: the place is not determined.
    pub(super) fn coplanar(&self) -> bool {
        let [a, b, c] = &self.normals;
        dot(a, &cross(b, c)) == Rational::zero()
    }
}

/// The conics on the planes of one pencil.
struct Pencil {
    /// Symmetric, in `q0, q2, q3`; entries are polynomials in `t`.
    conics: [[[UPoly<Integer>; 3]; 3]; 3],
    frame: i64,
    form: i64,
    eliminant: UPoly<Integer>,
    /// Its square-free parts with their multiplicities.
    parts: Vec<(UPoly<Integer>, usize)>,
}

impl Pencil {
    fn new(quadrics: &[[[Integer; 4]; 4]; 3], frame: i64, form: i64) -> Self {
        let int = |n: i64| UPoly::constant(Integer::from(n));
        let t = UPoly::<Integer>::variable();
        // q = frame · (q0, t q0 - i q2 - i² q3, q2, q3)
        let slice: [[UPoly<Integer>; 3]; 4] = [
            [int(1), int(0), int(0)],
            [t, int(-form), int(-form * form)],
            [int(0), int(1), int(0)],
            [int(0), int(0), int(1)],
        ];
        let turn = frame_matrix(frame);
        let columns: [[UPoly<Integer>; 3]; 4] = std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                (0..4).fold(UPoly::zero(), |sum, k| sum + slice[k][column].scaled(&Integer::from(turn[row][k])))
            })
        });
        let conics = quadrics.each_ref().map(|m| {
            let half: [[UPoly<Integer>; 3]; 4] = std::array::from_fn(|r| {
                std::array::from_fn(|c| (0..4).fold(UPoly::zero(), |sum, k| sum + columns[k][c].scaled(&m[r][k])))
            });
            std::array::from_fn(|r| {
                std::array::from_fn(|c| {
                    (0..4).fold(UPoly::zero(), |sum, k| sum + columns[k][r].clone() * half[k][c].clone())
                })
            })
        });
        let eliminant = determinant_interpolated(&resultant_rows(&conics));
        let parts = eliminant.square_free();
        Self { conics, frame, form, eliminant, parts }
    }

    fn distinct(&self) -> usize {
        self.parts.iter().filter_map(|(part, _)| part.degree()).sum()
    }

    /// The rotation above a root: the null vector of the matrix holds the squares and products of `q0, q2, q3`.
    fn lifted(&self, t: f64) -> Option<Rotation3<f64>> {
        // Rows of length 1, so that none counts for more than another.
        let point = dyadic(t)?;
        let conics = self.conics.each_ref().map(|conic| {
            let exact: [[Rational; 3]; 3] = conic
                .each_ref()
                .map(|row| row.each_ref().map(|entry| entry.map(|c| Rational::from(c.clone())).evaluate(&point)));
            let largest = exact.iter().flatten().map(|x| if *x < Rational::zero() { -x.clone() } else { x.clone() });
            let largest = largest.max().unwrap_or(Rational::one());
            let scale = if largest == Rational::zero() { Rational::one() } else { largest };
            exact.map(|row| row.map(|x| UPoly::constant(nearest_f64(&(x / scale.clone())))))
        });
        let rows = resultant_rows(&conics);
        let matrix = DMatrix::from_fn(6, 6, |r, c| rows[r][c].coefficient(0));
        let lengths: Vec<f64> = matrix.row_iter().map(|row| row.norm()).collect();
        let matrix = DMatrix::from_fn(6, 6, |r, c| if lengths[r] > 0.0 { matrix[(r, c)] / lengths[r] } else { 0.0 });
        let svd = matrix.svd(false, true);
        let least = svd.singular_values.imin();
        let null = svd.v_t?.row(least).into_owned();
        // Monomials as in `resultant_rows`: x², y², z², xy, xz, yz.
        let products = |k: usize| match k {
            0 => [null[0], null[3], null[4]],
            1 => [null[3], null[1], null[5]],
            _ => [null[4], null[5], null[2]],
        };
        let largest = (0..3).max_by(|&a, &b| null[a].abs().total_cmp(&null[b].abs()))?;
        let [x, y, z] = products(largest);
        let form = self.form as f64;
        let sliced = [x, t * x - form * y - form * form * z, y, z];
        let turn = frame_matrix(self.frame);
        let q: [f64; 4] = std::array::from_fn(|r| (0..4).map(|k| turn[r][k] as f64 * sliced[k]).sum());
        let quaternion = Quaternion::new(q[0], q[1], q[2], q[3]);
        let unit = UnitQuaternion::try_new(quaternion, 0.0)?;
        Some(unit.to_rotation_matrix())
    }
}

/// `q0 + m q1 + m² q2 + m³ q3`, which takes the place of `q0`: the quaternion from the coordinates of a pencil. `m` from 3, so that it vanishes on none of the rotations that permute
/// the axes.
fn frame_matrix(frame: i64) -> [[i64; 4]; 4] {
    let m = frame + 3;
    [[1, -m, -m * m, -m * m * m], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
}

/// Rows of the matrix whose determinant is the resultant of three conics: the conics and the derivatives of their Jacobian, in the monomials `x², y², z², xy, xz, yz`.
fn resultant_rows<R: Ring>(conics: &[[[UPoly<R>; 3]; 3]; 3]) -> Vec<Vec<UPoly<R>>> {
    const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
    let quadratic = |entry: &dyn Fn(usize, usize) -> UPoly<R>| -> Vec<UPoly<R>> {
        PAIRS.iter().map(|&(i, j)| if i == j { entry(i, i) } else { entry(i, j) + entry(j, i) }).collect()
    };
    let [a, b, c] = conics;
    // det[A e_i, B e_j, C e_k]; rows are columns.
    let mut volumes: Vec<UPoly<R>> = Vec::with_capacity(27);
    for first in a {
        for second in b {
            let cross: [UPoly<R>; 3] = std::array::from_fn(|m| {
                let (n, o) = ((m + 1) % 3, (m + 2) % 3);
                first[n].clone() * second[o].clone() - first[o].clone() * second[n].clone()
            });
            for third in c {
                volumes.push((0..3).fold(UPoly::zero(), |sum, m| sum + cross[m].clone() * third[m].clone()));
            }
        }
    }
    let volume = |i: usize, j: usize, k: usize| volumes[9 * i + 3 * j + k].clone();
    let mut rows: Vec<Vec<UPoly<R>>> = conics.iter().map(|conic| quadratic(&|i, j| conic[i][j].clone())).collect();
    for m in 0..3 {
        rows.push(quadratic(&|i, j| volume(m, i, j) + volume(i, m, j) + volume(i, j, m)));
    }
    rows
}

/// The sign of `a + b·sqrt(square)`.
fn surd_sign(a: &Rational, b: &Rational, square: &Rational) -> Ordering {
    let zero = Rational::zero();
    let sign = |x: &Rational| x.partial_cmp(&zero).expect("rationals are ordered");
    let linear = if *square == zero { Ordering::Equal } else { sign(b) };
    match (sign(a), linear) {
        (constant, Ordering::Equal) => constant,
        (Ordering::Equal, linear) => linear,
        (constant, linear) if constant == linear => constant,
        // Opposite signs: the larger square wins.
        (constant, linear) => match sign(&(a.clone() * a.clone() - b.clone() * b.clone() * square.clone())) {
            Ordering::Greater => constant,
            Ordering::Less => linear,
            Ordering::Equal => Ordering::Equal,
        },
    }
}

/// Integers in the same ratio, without a common factor.
fn primitive(entries: &[[Rational; 4]; 4]) -> [[Integer; 4]; 4] {
    let common = entries.iter().flatten().fold(Rational::one(), |product, x| {
        // Denominators are powers of two: the largest is a common one.
        let denominator = Rational::from(Integer::from(x.denominator().clone()));
        if denominator > product { denominator } else { product }
    });
    let whole = UPoly::new(
        entries.iter().flatten().map(|x| (x.clone() * common.clone()).numerator().clone()).collect::<Vec<_>>(),
    );
    let primitive = whole.primitive();
    std::array::from_fn(|r| std::array::from_fn(|c| primitive.coefficient(4 * r + c)))
}

pub(super) fn exact3(v: &[f64; 3]) -> Option<Exact3> {
    let [x, y, z] = v.map(dyadic);
    Some([x?, y?, z?])
}

pub(super) fn dot(a: &Exact3, b: &Exact3) -> Rational {
    (0..3).fold(Rational::zero(), |sum, k| sum + a[k].clone() * b[k].clone())
}

pub(super) fn cross(a: &Exact3, b: &Exact3) -> Exact3 {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i].clone() * b[j].clone() - a[j].clone() * b[i].clone()
    })
}

/// A vector of rationals to the nearest `f64`s.
pub(super) fn rounded(v: &Exact3) -> Vector3<f64> {
    Vector3::from_fn(|k, _| nearest_f64(&v[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_conics_with_a_common_point_have_no_resultant() {
        // x² - y², xy - z², xz - yz: all vanish at (1, 1, 1).
        let with = |entries: &[(usize, usize, i64)]| {
            let mut conic: [[UPoly<Integer>; 3]; 3] = std::array::from_fn(|_| std::array::from_fn(|_| UPoly::zero()));
            for &(i, j, value) in entries {
                conic[i][j] = UPoly::constant(Integer::from(value));
                conic[j][i] = UPoly::constant(Integer::from(value));
            }
            conic
        };
        let common = [with(&[(0, 0, 1), (1, 1, -1)]), with(&[(0, 1, 1), (2, 2, -2)]), with(&[(0, 2, 1), (1, 2, -1)])];
        assert!(determinant_interpolated(&resultant_rows(&common)).vanishes());
        let none = [with(&[(0, 0, 1)]), with(&[(1, 1, 1)]), with(&[(2, 2, 1)])];
        assert!(!determinant_interpolated(&resultant_rows(&none)).vanishes());
    }
}
