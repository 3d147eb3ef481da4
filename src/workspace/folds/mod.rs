//! The boundary of what can be reached with some orientation: the curves along which an interval of orientations vanishes.
//!
//! Write each limit as `g(C, phi) <= 0`. Some orientation is lost at the boundary, so that there the limits active close in on one orientation: with multipliers
//! not negative, not all zero, `sum lam_k dg_k/dphi = 0` (Fritz John), the end of a range of phi counting as a limit. That leaves
//!
//! | active | condition | curve of `C` |
//! |---|---|---|
//! | one limit | `g` least in phi | circles and lines where platform arm and leg are in line ([`motion`]) |
//! | one limit, phi at an end of its range | `g` grows towards the inside of the range | a circle or a line |
//! | two limits of different legs | `dg/dphi` of opposite signs | coupler curve ([`coupled`]) |
//! | two limits of one leg | the same | a circle about the remaining joint, or a line ([`edges`]) |
//! | one limit at the reference point's own pivot | | its own circle or line |
//!
//! [`curves`] lists them with all places where anything about them changes, in closed form or as real modes of triads; [`outline`] keeps what bounds. The derivation `fold_rule` has the rule.

mod arc;
mod coupled;
mod crossings;
mod curves;
mod edges;
mod motion;
mod outline;
mod surface;

pub use arc::CouplerArc;

use super::reach::Reach;
use crate::plane::PhiRange;

impl Reach {
    #[doc(hidden)]
    pub fn debug_outline(&self, range: Option<&PhiRange>) -> (Vec<(super::BoundaryArc, usize, usize)>, usize, usize, Vec<[f64; 2]>) {
        let out = outline::outline(self, range);
        (out.boundary, out.separating.len(), out.isolated.len(), out.undecided)
    }
}
impl Reach {
    #[doc(hidden)]
    pub fn debug_pieces(&self, range: Option<&PhiRange>) -> Vec<String> {
        let mut t = outline::Tracer::new(self, range);
        t.cross();
        let allowed = range.map(PhiRange::set);
        let reached = |at: nalgebra::Vector2<f64>| {
            let set = self.orientations(at);
            match &allowed { Some(range) => !set.intersect(range).is_empty(), None => !set.is_empty() }
        };
        t.folds.iter().map(|p| {
            let (s, look) = t.standing(p, &reached);
            let v = |k: usize| t.curves.vertices[k];
            format!("{:.9} {:.9} -> {:.9} {:.9} [{}->{}] curve {} t {:.12}..{:.12} {:?} phi {:?} {:?} {:?}", v(p.start).x, v(p.start).y, v(p.end).x, v(p.end).y, p.start, p.end, p.curve, p.from, p.to, s, look.as_ref().and_then(|l| l.phi), look.as_ref().map(|l| l.active.iter().map(|x| x.to_string()).collect::<Vec<_>>()), match t.curves.curves[p.curve].course { curves::Course::Coupled{branch,..}=>format!("{branch:?}"), curves::Course::Motion{source,..}=>format!("{source:?}"), _=>"upright".into()})
        }).collect()
    }
}

impl Reach {
    #[doc(hidden)]
    pub fn debug_near(&self, range: Option<&PhiRange>, at: [f64; 2], tol: f64) -> Vec<String> {
        let mut t = outline::Tracer::new(self, range);
        let at: nalgebra::Vector2<f64> = at.into();
        let mut out = vec![];
        for c in 0..t.curves.curves.len() {
            for p in t.pieces(c) {
                let v = |k: usize| t.curves.vertices[k];
                if (v(p.start) - at).norm() > tol && (v(p.end) - at).norm() > tol { continue }
                let names = |g: [usize; 2]| g.map(|g| t.curves.surfaces[g].limits.iter().map(|l| l.active().to_string()).collect::<Vec<_>>());
                let (what, gens) = match t.curves.curves[c].course {
                    curves::Course::Coupled { branch, coupled } => (format!("{branch:?}"), names(t.curves.coupled[coupled].1)),
                    curves::Course::Motion { source, generators, .. } => (format!("{source:?}"), names(generators)),
                    curves::Course::Upright { surface, .. } => ("upright".into(), names([surface, surface])),
                };
                {
                    let pt = t.curves.at(c, 0.5 * (p.from + p.to));
                    if let Some((turn, _)) = pt.turn {
                        let g = match t.curves.curves[c].course { curves::Course::Coupled { coupled, .. } => t.curves.coupled[coupled].1, curves::Course::Motion { generators, .. } => generators, _ => [0, 0] };
                        let place = surface::Place { c: pt.at, turn };
                        for g in g {
                            let su = &t.curves.surfaces[g];
                            for l in &su.limits {
                                out.push(format!("      {} mode {:?} sense {} by_phi {:.3e} bend {:.3e} bounds {} value {:.2e}", l.active(), l.mode, l.sense, su.form.slope(&place).by_phi, outline::bend(&su.form, &place), edges::bounds(&self.legs[su.leg], l, pt.at, turn, 1e-11 * self.size()), su.form.value(&place)));
                            }
                        }
                        out.push(format!("      legs {:?}", self.legs.iter().map(|l| l.allows_pose(pt.at, turn, 1e-11 * self.size())).collect::<Vec<_>>()));
                    }
                }
                out.push(format!("{:.9} {:.9} -> {:.9} {:.9} [{}->{}] curve {c} t {:.12}..{:.12} look {} {what} {gens:?}", v(p.start).x, v(p.start).y, v(p.end).x, v(p.end).y, p.start, p.end, p.from, p.to, t.look(&p, 0.5).is_some()));
            }
        }
        out
    }
}
