//! One held limit: a surface of poses, and what it is near a pose.
//!
//! | dyad | surface | form |
//! |---|---|---|
//! | RR | `\|C + R b - a\| = r` | circle |
//! | PR | `n·(C + R b) = h`, `n = i u` | line |
//! | RP | `(R m)·(a - C) = k`, `m = i v`, `k = m·b + d` | platform line |
//!
//! `C` is the reference point, which is the platform's origin; `n` and `m` have length one. With the orientation held, `C` lies on a circle or a line.

use nalgebra::Vector2;

use crate::linkage::{Dyad, Offset};
use crate::plane::{Carrier, product};

type Point = Vector2<f64>;

/// A vector turned a quarter counter-clockwise.
#[inline]
pub(crate) fn quarter(v: Point) -> Point {
    Point::new(-v.y, v.x)
}

/// A held limit, prepared; see the table of the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Form {
    Circle { a: Point, b: Point, r: f64 },
    Line { n: Point, h: f64, b: Point },
    PlatformLine { a: Point, m: Point, k: f64 },
}

/// A pose as the place of the reference point and the direction of the platform's x axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) c: Point,
    pub(crate) turn: Point,
}

/// A surface near one of its poses: how its function grows with `C` (unit gradient) and with `phi`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope {
    /// Gradient by `C`, of length one.
    pub(crate) gradient: Point,
    /// Derivative by `phi`, a length a radian.
    pub(crate) by_phi: f64,
}

impl Form {
    /// The surface of a dyad; `None` for PP, which is an orientation and no surface of this kind.
    pub(crate) fn of(dyad: &Dyad) -> Option<Self> {
        Some(match *dyad {
            Dyad::RR { a, b, length } => Self::Circle { a, b, r: length },
            Dyad::PR { a, u, b } => {
                let n = quarter(u) / u.norm();
                Self::Line { n, h: n.dot(&a), b }
            }
            Dyad::RP { a, b, v, offset } => {
                let m = quarter(v) / v.norm();
                let d = match offset {
                    Offset::Distance(d) => d,
                    Offset::TimesDirection(delta) => delta / v.norm(),
                };
                Self::PlatformLine { a, m, k: m.dot(&b) + d }
            }
            Dyad::PP { .. } => return None,
        })
    }

    /// The surface carried along with the base frame.
    pub(crate) fn moved(self, by: Point) -> Self {
        match self {
            Self::Circle { a, b, r } => Self::Circle { a: a + by, b, r },
            Self::Line { n, h, b } => Self::Line { n, h: h + n.dot(&by), b },
            Self::PlatformLine { a, m, k } => Self::PlatformLine { a: a + by, m, k },
        }
    }

    /// How far a pose is off the surface, a length; signed as the dyad's value less its bound.
    #[cfg(test)]
    pub(crate) fn value(&self, at: &Place) -> f64 {
        match *self {
            Self::Circle { a, b, r } => (at.c + product(at.turn, b) - a).norm() - r,
            Self::Line { n, h, b } => n.dot(&(at.c + product(at.turn, b))) - h,
            Self::PlatformLine { a, m, k } => product(at.turn, m).dot(&(a - at.c)) - k,
        }
    }

    /// The surface's slope at a pose.
    pub(crate) fn slope(&self, at: &Place) -> Slope {
        match *self {
            Self::Circle { a, b, .. } => {
                let rb = product(at.turn, b);
                let strut = at.c + rb - a;
                let gradient = strut.try_normalize(0.0).unwrap_or_else(|| quarter(at.turn));
                Slope { gradient, by_phi: gradient.dot(&quarter(rb)) }
            }
            Self::Line { n, b, .. } => Slope { gradient: n, by_phi: n.dot(&quarter(product(at.turn, b))) },
            Self::PlatformLine { a, m, .. } => {
                let rm = product(at.turn, m);
                Slope { gradient: -rm, by_phi: quarter(rm).dot(&(a - at.c)) }
            }
        }
    }

    /// Where `C` can be with the platform turned so.
    pub(crate) fn carrier(&self, turn: Point) -> Carrier {
        match *self {
            Self::Circle { a, b, r } => Carrier::Circle { center: a - product(turn, b), radius: r },
            Self::Line { n, h, b } => {
                let at = h - n.dot(&product(turn, b));
                Carrier::Line { point: n * at, direction: -quarter(n) }
            }
            Self::PlatformLine { a, m, k } => {
                let rm = product(turn, m);
                Carrier::Line { point: rm * (rm.dot(&a) - k), direction: -quarter(rm) }
            }
        }
    }

    /// Whether the orientation does not enter: the platform pivot is the reference point, nearer than `tol`.
    pub(crate) fn is_upright(&self, tol: f64) -> bool {
        match *self {
            Self::Circle { b, .. } | Self::Line { b, .. } => b.norm() <= tol,
            Self::PlatformLine { .. } => false,
        }
    }
}
