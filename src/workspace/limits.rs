//! What bounds a leg: each end of a joint's range, and the merging of its two working modes, as a dyad with a side.

use std::f64::consts::{PI, TAU};
use std::fmt;
use std::str::FromStr;

use arrayvec::ArrayVec;
use nalgebra::Vector2;
use thiserror::Error;

use crate::linkage::{Dyad, Offset};
use crate::manipulator::DescriptionError;
use crate::plane::{Carrier, conjugate, principal, product};

/// Which working modes of the legs count.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub enum WorkspaceModes {
    /// Either mode of each leg, changed at will.
    #[default]
    Both,
    /// One mode a leg, leg 1 first; `true` is +.
    Signs(Vec<bool>),
}

impl WorkspaceModes {
    /// Whether a leg (from 0) may be in a mode (`true` is +).
    pub fn allow(&self, leg: usize, plus: bool) -> bool {
        match self {
            Self::Both => true,
            Self::Signs(signs) => signs.get(leg) == Some(&plus),
        }
    }
}

impl FromStr for WorkspaceModes {
    type Err = WorkspaceError;

    /// `both`, or a sign for each leg.
    ///
    /// ```
    /// use assur::workspace::WorkspaceModes;
    /// assert_eq!("+-+".parse(), Ok(WorkspaceModes::Signs(vec![true, false, true])));
    /// assert_eq!("both".parse::<WorkspaceModes>().unwrap().to_string(), "both");
    /// assert!("+0+".parse::<WorkspaceModes>().unwrap_err().to_string().starts_with("mode \"+0+\""));
    /// ```
    fn from_str(text: &str) -> Result<Self, WorkspaceError> {
        if text == "both" {
            return Ok(Self::Both);
        }
        let sign = |letter| match letter {
            '+' => Some(true),
            '-' => Some(false),
            _ => None,
        };
        let signs: Option<Vec<bool>> = text.chars().map(sign).collect();
        signs
            .filter(|signs| !signs.is_empty())
            .map(Self::Signs)
            .ok_or_else(|| WorkspaceError::Modes { text: text.to_owned() })
    }
}

impl fmt::Display for WorkspaceModes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Both => f.write_str("both"),
            Self::Signs(signs) => signs.iter().try_for_each(|&plus| f.write_str(if plus { "+" } else { "-" })),
        }
    }
}

/// Why a workspace cannot be asked for. Legs, joints and links are counted from 1.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum WorkspaceError {
    /// The description is no manipulator.
    #[error(transparent)]
    Description(#[from] DescriptionError),
    /// A leg of another type.
    #[error("leg {leg}: workspaces of legs {joints} are not covered; those of RPR, RRR and PRR are")]
    LegNotCovered {
        /// Leg, from 1.
        leg: usize,
        /// Its joints, base first.
        joints: String,
    },
    /// A link that joins two pivots has no length, so that they would turn against each other freely.
    #[error("leg {leg}: links[{link}]: a length of 0 joins two pivots into one, which workspaces do not cover")]
    NoLength {
        /// Leg, from 1.
        leg: usize,
        /// Index of the link in `links`.
        link: usize,
    },
    /// The text names no working modes.
    #[error("mode \"{text}\": must be \"both\" or a sign + or - for each leg")]
    Modes {
        /// The text found.
        text: String,
    },
    /// Not as many signs as legs.
    #[error("mode \"{modes}\": {} signs, must be {legs}, one a leg", .modes.len())]
    ModeCount {
        /// The signs found.
        modes: String,
        /// Number of legs.
        legs: usize,
    },
    /// A number is NaN or infinite.
    #[error("{what}: {value} must be finite")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// The value found.
        value: f64,
    },
    /// A range of orientations runs backwards.
    #[error("width of the range of phi: {value} must be ≥ 0")]
    NegativeWidth {
        /// The value found.
        value: f64,
    },
    /// No leg has a bounded reach.
    #[error("leg {leg}: joint {joint} has no limits, and no other leg is bounded either, so the workspace is infinite")]
    Unbounded {
        /// Leg, from 1.
        leg: usize,
        /// The joint whose limits would bound it, from 1.
        joint: usize,
    },
    /// Two parts of the configuration space may be one: at an orientation a slice of it cannot be followed.
    #[error(
        "assemblies not decided: near phi = {phi} rad digits run out, and parts of the configuration space cannot be followed"
    )]
    AssembliesUndecided {
        /// The orientation, radians.
        phi: f64,
    },
    /// The pose that names an assembly is none: a leg does not allow it.
    #[error("leg {leg}: does not allow the pose of the assembly")]
    PoseNotAllowed {
        /// Leg, from 1.
        leg: usize,
    },
}

/// What about a leg is at its end. Joints are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum LimitCause {
    /// A joint is at the beginning of its range.
    JointMin {
        /// The joint, from 0.
        joint: usize,
        /// Whether it is the only driven joint of its leg; reports then leave its number out.
        driven: bool,
    },
    /// A joint is at the end of its range.
    JointMax {
        /// The joint, from 0.
        joint: usize,
        /// Whether it is the only driven joint of its leg.
        driven: bool,
    },
    /// RRR: both links in line, one behind the other; the modes merge.
    Stretched,
    /// RRR: both links in line, one on the other; the modes merge.
    Folded,
    /// PRR: the link stands across the slider, to the left of it; the modes merge.
    Left,
    /// PRR: the same, to the right.
    Right,
    /// RPR with its slider beside the pivot: the pivots are as near as the offset; the modes merge.
    Shortest,
}

impl LimitCause {
    /// The joint that is at an end of its range, from 0; `None` where modes merge.
    pub fn joint(&self) -> Option<usize> {
        match *self {
            Self::JointMin { joint, .. } | Self::JointMax { joint, .. } => Some(joint),
            _ => None,
        }
    }
}

/// A limit that is active on a piece of boundary.
///
/// ```
/// use assur::workspace::{ActiveLimit, LimitCause};
/// let max = ActiveLimit::Leg { leg: 0, cause: LimitCause::JointMax { joint: 1, driven: true } };
/// assert_eq!(max.to_string(), "leg 1 max");
/// let passive = ActiveLimit::Leg { leg: 1, cause: LimitCause::JointMin { joint: 2, driven: false } };
/// assert_eq!(passive.to_string(), "leg 2 joint 3 min");
/// assert_eq!(ActiveLimit::PhiFrom.to_string(), "phi from");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ActiveLimit {
    /// A limit of a leg.
    Leg {
        /// The leg, from 0.
        leg: usize,
        /// Which limit of it.
        cause: LimitCause,
    },
    /// The beginning of the range of orientations.
    PhiFrom,
    /// The end of the range of orientations.
    PhiTo,
}

impl fmt::Display for LimitCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::JointMin { driven: true, .. } => f.write_str("min"),
            Self::JointMax { driven: true, .. } => f.write_str("max"),
            Self::JointMin { joint, .. } => write!(f, "joint {} min", joint + 1),
            Self::JointMax { joint, .. } => write!(f, "joint {} max", joint + 1),
            Self::Stretched => f.write_str("stretched"),
            Self::Folded => f.write_str("folded"),
            Self::Left | Self::Right => f.write_str("side"),
            Self::Shortest => f.write_str("shortest"),
        }
    }
}

impl fmt::Display for ActiveLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Leg { leg, cause } => write!(f, "leg {} {cause}", leg + 1),
            Self::PhiFrom => f.write_str("phi from"),
            Self::PhiTo => f.write_str("phi to"),
        }
    }
}

/// A bound of a leg: a surface in pose space, and the side that the leg allows.
///
/// The surface is a dyad's, in the frame of the reference point: the pose is (C, phi), platform points are given from `C`. Whether a place on the surface
/// is a bound there depends on the other joints and on the working mode: the surface carries it, membership decides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// The leg, from 0.
    pub leg: usize,
    /// The working mode that it bounds, `true` is +; `None` where the modes merge.
    pub mode: Option<bool>,
    /// What is at its end.
    pub cause: LimitCause,
    /// What the leg is with the limit held; never PP.
    pub dyad: Dyad,
    /// Near the bound the leg allows the poses with `sense * value <= 0`, see [`Limit::value`].
    pub sense: f64,
}

impl Limit {
    /// The name of the limit in reports.
    pub fn active(&self) -> ActiveLimit {
        ActiveLimit::Leg { leg: self.leg, cause: self.cause }
    }

    /// The limit carried along with the base frame.
    pub(super) fn moved(mut self, by: Vector2<f64>) -> Self {
        match &mut self.dyad {
            Dyad::RR { a, .. } | Dyad::PR { a, .. } | Dyad::RP { a, .. } => *a += by,
            Dyad::PP { .. } => {}
        }
        self
    }

    /// The dyad's own measure, a length, zero on the surface; `turn` is the unit vector at phi.
    ///
    /// RR: `|C + R b - a| - length`. PR: how far `C + R b` lies to the left of the line. RP: `(R i v/|v|)·(a - C - R b) - d`.
    pub fn value(&self, c: Vector2<f64>, turn: Vector2<f64>) -> f64 {
        match self.dyad {
            Dyad::RR { a, b, length } => (c + product(turn, b) - a).norm() - length,
            Dyad::PR { a, u, b } => u.perp(&(c + product(turn, b) - a)) / u.norm(),
            Dyad::RP { a, b, v, offset } => {
                product(turn, v).perp(&(a - c - product(turn, b))) / v.norm() - beside(v, offset)
            }
            Dyad::PP { .. } => unreachable!("no limit of a covered leg leaves two sliders"),
        }
    }

    /// The places of `C` on the surface at one orientation: a circle or a line.
    pub fn at_orientation(&self, turn: Vector2<f64>) -> Carrier {
        match self.dyad {
            Dyad::RR { a, b, length } => Carrier::Circle { center: a - product(turn, b), radius: length },
            Dyad::PR { a, u, b } => Carrier::Line { point: a - product(turn, b), direction: u.normalize() },
            Dyad::RP { a, b, v, offset } => {
                // i v·(a - C) = d + i v·b with v turned.
                let v = product(turn, v).normalize();
                let left = Vector2::new(-v.y, v.x);
                let d = beside(v, offset) + left.dot(&product(turn, b));
                Carrier::Line { point: a - left * d, direction: v }
            }
            Dyad::PP { .. } => unreachable!("no limit of a covered leg leaves two sliders"),
        }
    }

    /// The places of `C` where the measure is stationary in the orientation, on the surface: two circles or lines, or one.
    ///
    /// RR: `C`, the platform pivot and the base pivot in line. PR: the platform arm across the line. RP: the arm to the base pivot across the platform line.
    /// Where the measure does not depend on the orientation at all (`b` = 0), its own circle or line.
    pub fn alignments(&self) -> ArrayVec<Carrier, 2> {
        let mut out = ArrayVec::new();
        match self.dyad {
            Dyad::RR { a, b, length } => {
                let arm = b.norm();
                out.push(Carrier::Circle { center: a, radius: length + arm });
                if arm > 0.0 && length > 0.0 {
                    out.push(Carrier::Circle { center: a, radius: (length - arm).abs() });
                }
            }
            Dyad::PR { a, u, b } => {
                let (u, arm) = (u.normalize(), b.norm());
                let left = Vector2::new(-u.y, u.x);
                out.push(Carrier::Line { point: a + left * arm, direction: u });
                if arm > 0.0 {
                    out.push(Carrier::Line { point: a - left * arm, direction: u });
                }
            }
            Dyad::RP { a, b, v, offset } => {
                out.push(Carrier::Circle { center: a, radius: (beside(v, offset) + v.perp(&b) / v.norm()).abs() });
            }
            Dyad::PP { .. } => unreachable!("no limit of a covered leg leaves two sliders"),
        }
        out
    }

    /// The orientations in which `C` is on the surface, at most two, radians in [-pi, pi); none also where every orientation is one.
    ///
    /// In the forms that keep their digits where two of them merge; what misses merging by less than `tol` (a length) counts as merged.
    pub fn orientations_at(&self, c: Vector2<f64>, tol: f64) -> ArrayVec<f64, 2> {
        match self.dyad {
            Dyad::RR { a, b, length } => {
                // |d u + R b| = length with d u = C - a: the angle psi from u to R b.
                let (away, arm) = (c - a, b.norm());
                let d = away.norm();
                if d == 0.0 || arm == 0.0 {
                    return ArrayVec::new();
                }
                let middle = away.y.atan2(away.x) - b.y.atan2(b.x);
                either(
                    middle,
                    (d + arm - length) * (d + arm + length),
                    (length - (d - arm)) * (length + (d - arm)),
                    tol * (d + arm + length),
                )
            }
            Dyad::PR { a, u, b } => {
                // u x (C - a) + |b| sin(phi + beta - alpha) = 0.
                let (u, arm) = (u.normalize(), b.norm());
                let h = u.perp(&(c - a));
                if arm == 0.0 {
                    return ArrayVec::new();
                }
                let left = u.x.atan2(-u.y) - b.y.atan2(b.x);
                // cos(phi + beta - (alpha + pi/2)) = -h/|b|
                either(left, arm + h, arm - h, tol)
            }
            Dyad::RP { a, b, v, offset } => {
                // left(v)·R'(a - C) = d + left(v)·b.
                let v = v.normalize();
                let left = Vector2::new(-v.y, v.x);
                let (to, d) = (a - c, beside(v, offset) + left.dot(&b));
                let distance = to.norm();
                if distance == 0.0 {
                    return ArrayVec::new();
                }
                // The angle of R left against a - C has cosine d/|a - C|.
                let middle = to.y.atan2(to.x) - left.y.atan2(left.x);
                either(middle, distance - d, distance + d, tol)
            }
            Dyad::PP { .. } => ArrayVec::new(),
        }
    }
}

/// The angles `middle ± psi` with `tan²(psi/2) = above/below`; none where one of the two is negative by more than `tol`.
fn either(middle: f64, above: f64, below: f64, tol: f64) -> ArrayVec<f64, 2> {
    let mut out = ArrayVec::new();
    if above < -tol || below < -tol {
        return out;
    }
    let psi = 2.0 * above.max(0.0).sqrt().atan2(below.max(0.0).sqrt());
    out.push(principal(middle + psi));
    if psi > 0.0 && psi < PI {
        out.push(principal(middle - psi));
    }
    out
}

/// The distance `d` of an RP dyad.
pub(super) fn beside(v: Vector2<f64>, offset: Offset) -> f64 {
    match offset {
        Offset::Distance(d) => d,
        Offset::TimesDirection(delta) => delta / v.norm(),
    }
}

/// Beginning and width of a range of angles; `None` where it excludes nothing.
pub(super) fn angle_range(limits: Option<[f64; 2]>) -> Option<(f64, f64)> {
    let [low, high] = limits?;
    let span = high - low;
    if span >= TAU {
        return None;
    }
    Some((low, if span >= 0.0 { span } else { span.rem_euclid(TAU) }))
}

/// A direction seen from a frame turned by another.
pub(super) fn seen_from(frame: Vector2<f64>, d: Vector2<f64>) -> Vector2<f64> {
    product(conjugate(frame), d)
}
