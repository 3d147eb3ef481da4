//! Every curve along which a manipulator's orientations can vanish, and the places on them where that can change.

use std::f64::consts::{PI, TAU};

use arrayvec::ArrayVec;
use nalgebra::Vector2;

use super::super::limits::{ActiveLimit, Limit};
use super::super::reach::Reach;
use super::coupled::{Branch, Coupled, End};
use super::edges;
use super::motion::Motion;
use super::surface::{Form, Place};
use crate::linkage::Triad;
use crate::plane::{Carrier, PhiRange, direction, principal};

type Point = Vector2<f64>;

/// Lengths below this share of the mechanism's are touches and coincidences (error bound: some hundred roundings; what is decided with it moves the boundary by no more).
pub(super) const TOUCH: f64 = 1e-13;
/// A pivot nearer to the reference point than this share of the mechanism's length is at it: its limits then do not depend on the orientation, and the
/// boundary moves by no more than this.
const AT_PIVOT: f64 = 1e-12;
/// A pose further from a coupled curve than this share of the mechanism's length is not on it, but on a carrier that both limits have in common (error
/// bound: a pose's own roundings, some thousand).
const ON_CURVE: f64 = 1e-10;
/// Straight candidates are followed this many times the mechanism's length; bounded workspaces end before.
const FAR: f64 = 8.0;

/// A limit's surface; modes that share it are listed together.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    pub(super) leg: usize,
    pub(super) form: Form,
    pub(super) limits: Vec<Limit>,
    /// Whether the orientation does not enter.
    pub(super) upright: bool,
}

/// Why a motion is a candidate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Source {
    /// The limit is stationary in the orientation.
    Stationary,
    /// The orientation is at the beginning (`false`) or end (`true`) of its range.
    PhiEnd(bool),
    /// Two limits at once.
    Pair,
}

/// What a curve is.
#[derive(Clone, Copy, Debug)]
pub(super) enum Course {
    /// A motion in closed form.
    Motion { motion: Motion, source: Source, generators: [usize; 2] },
    /// One branch of a coupled curve.
    Coupled { coupled: usize, branch: Branch },
    /// A limit that does not depend on the orientation.
    Upright { on: Carrier, surface: usize },
}

/// A candidate curve with the places that divide it.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    pub(super) course: Course,
    /// Parameter and vertex.
    pub(super) marks: Vec<(f64, usize)>,
}

/// A point of a curve with its derivative by the parameter, and the pose where one belongs to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct CurvePoint {
    pub(super) at: Point,
    pub(super) velocity: Point,
    pub(super) turn: Option<(Point, f64)>,
}

/// All candidates.
pub(super) struct Curves {
    pub(super) surfaces: Vec<Surface>,
    pub(super) coupled: Vec<(Coupled, [usize; 2])>,
    pub(super) curves: Vec<Curve>,
    pub(super) vertices: Vec<Point>,
    /// Orientations at which limits begin or cease to meet each other.
    turning: Vec<f64>,
    /// Poses at which limits that leave no motion are met: one of each of three legs, two of one leg and one of another, one where it is stationary and another's.
    pub(super) poses: Vec<(Place, ArrayVec<usize, 3>)>,
    /// First of the branches of each coupled curve.
    pub(super) first_branch: Vec<usize>,
    pub(super) tol: f64,
    far: f64,
    pub(super) size: f64,
}

impl Curves {
    /// None.
    pub(super) fn empty(reach: &Reach) -> Self {
        let size = reach.size();
        Self {
            surfaces: Vec::new(),
            coupled: Vec::new(),
            curves: Vec::new(),
            vertices: Vec::new(),
            turning: Vec::new(),
            poses: Vec::new(),
            first_branch: Vec::new(),
            tol: TOUCH * size,
            far: FAR * size,
            size,
        }
    }

    /// The candidates of a manipulator, divided where another limit or the end of the range of orientations is met, or where their own sense changes.
    pub(super) fn new(reach: &Reach, range: Option<&PhiRange>) -> Self {
        let mut all = Self { surfaces: surfaces(reach, reach.size()), ..Self::empty(reach) };
        let stationary = all.add_stationary();
        let ends = range.map(|range| all.add_phi_ends(range));
        let upright = all.add_upright();
        let edges = all.add_edges(reach);
        let coupled = all.add_coupled();
        let book = Book { stationary, ends, upright, edges, coupled };
        all.mark_stationary(&book);
        all.mark_poles(&book, range);
        if let Some(range) = range {
            all.mark_phi_ends(&book, range);
        }
        all.mark_edges(reach, &book, range);
        all.mark_triads(&book);
        all.mark_branch_ends();
        all.mark_frozen();
        all
    }

    /// The range of a curve's parameter and whether its ends are the same place.
    pub(super) fn span(&self, curve: usize) -> ([f64; 2], bool) {
        let on = match self.curves[curve].course {
            Course::Coupled { .. } => return ([0.0, 1.0], false),
            Course::Motion { motion, .. } => motion.carrier(),
            Course::Upright { on, .. } => on,
        };
        match on {
            Carrier::Circle { .. } => ([-PI, PI], true),
            Carrier::Line { .. } => ([-self.far, self.far], false),
        }
    }

    /// A point of a curve.
    pub(super) fn at(&self, curve: usize, t: f64) -> CurvePoint {
        match self.curves[curve].course {
            Course::Coupled { coupled, branch } => {
                let spot = self.coupled[coupled].0.at(branch, t);
                CurvePoint { at: spot.place.c, velocity: spot.velocity, turn: Some((spot.place.turn, spot.phi)) }
            }
            Course::Motion { motion, .. } => {
                let place = motion.place(t);
                let velocity = along(&motion.carrier(), t);
                CurvePoint { at: place.c, velocity, turn: Some((place.turn, motion.phi(t))) }
            }
            Course::Upright { on, .. } => CurvePoint { at: on.at(t), velocity: along(&on, t), turn: None },
        }
    }

    /// Orientations at which the places allowed at one orientation can change their shape, sorted, in [-pi, pi).
    pub(super) fn turning_points(&self) -> Vec<f64> {
        let mut out: Vec<f64> = self.turning.iter().map(|phi| principal(*phi)).filter(|phi| phi.is_finite()).collect();
        for curve in &self.curves {
            if let Course::Motion { motion: Motion::Sliding { phi, .. }, source: Source::Pair, .. } = curve.course {
                out.push(principal(phi));
            }
        }
        for (curve, _) in &self.coupled {
            for branch in curve.branches() {
                out.extend([0.0, 1.0].map(|t| principal(curve.phi(branch, t))));
            }
        }
        out.sort_by(f64::total_cmp);
        out
    }

    pub(super) fn vertex(&mut self, at: Point) -> usize {
        self.vertices.push(at);
        self.vertices.len() - 1
    }

    pub(super) fn mark(&mut self, curve: usize, t: f64, vertex: usize) {
        self.curves[curve].marks.push((t, vertex));
    }

    pub(super) fn push(&mut self, course: Course) -> usize {
        self.curves.push(Curve { course, marks: Vec::new() });
        self.curves.len() - 1
    }

    fn add_stationary(&mut self) -> Vec<Vec<usize>> {
        let mut out = vec![Vec::new(); self.surfaces.len()];
        for (surface, list) in out.iter_mut().enumerate() {
            if self.surfaces[surface].upright {
                continue;
            }
            for motion in Motion::stationary(&self.surfaces[surface].form) {
                list.push(self.push(Course::Motion {
                    motion,
                    source: Source::Stationary,
                    generators: [surface, surface],
                }));
            }
        }
        out
    }

    fn add_phi_ends(&mut self, range: &PhiRange) -> Vec<[Option<usize>; 2]> {
        let mut out = vec![[None; 2]; self.surfaces.len()];
        for (surface, pair) in out.iter_mut().enumerate() {
            if self.surfaces[surface].upright {
                continue;
            }
            for (end, phi) in [(0, range.from), (1, range.to())] {
                let on = self.surfaces[surface].form.carrier(direction(phi));
                pair[end] = Some(self.push(Course::Motion {
                    motion: Motion::sliding(phi, on),
                    source: Source::PhiEnd(end == 1),
                    generators: [surface, surface],
                }));
            }
        }
        out
    }

    fn add_upright(&mut self) -> Vec<Option<usize>> {
        let mut out = vec![None; self.surfaces.len()];
        for (surface, curve) in out.iter_mut().enumerate() {
            if self.surfaces[surface].upright {
                let on = self.surfaces[surface].form.carrier(Point::x());
                // As the pivot is at the reference point, no orientation moves it.
                let on = match (on, self.surfaces[surface].form) {
                    (Carrier::Circle { radius, .. }, Form::Circle { a, .. }) => Carrier::Circle { center: a, radius },
                    _ => on,
                };
                *curve = Some(self.push(Course::Upright { on, surface }));
            }
        }
        out
    }

    fn add_edges(&mut self, reach: &Reach) -> Vec<(usize, [usize; 2])> {
        let mut out: Vec<(usize, [usize; 2])> = Vec::new();
        for one in 0..self.surfaces.len() {
            for other in one + 1..self.surfaces.len() {
                let leg = self.surfaces[one].leg;
                if self.surfaces[other].leg != leg {
                    continue;
                }
                // Surfaces of two modes are one, but what they hold together depends on both.
                let mut motions: Vec<Motion> = Vec::new();
                for first in &self.surfaces[one].limits {
                    for second in &self.surfaces[other].limits {
                        let agree = first.mode.is_none() || second.mode.is_none() || first.mode == second.mode;
                        let motion = edges::edge(reach.leg_of(leg), first, second).filter(|_| agree);
                        if let Some(motion) = motion
                            && !motions.contains(&motion)
                        {
                            motions.push(motion);
                        }
                    }
                }
                for motion in motions {
                    let generators = [one, other];
                    let curve = self.push(Course::Motion { motion, source: Source::Pair, generators });
                    out.push((curve, generators));
                }
            }
        }
        for (leg, reach) in reach.legs.iter().enumerate() {
            let Some(motion) = edges::apex(reach) else { continue };
            // The two ends of a joint's range meet at the pivot.
            for joint in [0, 2] {
                let ends = |s: &usize| {
                    self.surfaces[*s].leg == leg && self.surfaces[*s].limits[0].cause.joint() == Some(joint)
                };
                let found: Vec<usize> = (0..self.surfaces.len()).filter(ends).collect();
                if let [one, other] = found[..] {
                    let generators = [one, other];
                    let curve = self.push(Course::Motion { motion, source: Source::Pair, generators });
                    out.push((curve, generators));
                }
            }
        }
        out
    }

    fn add_coupled(&mut self) -> Vec<(usize, [usize; 2])> {
        let mut out = Vec::new();
        for one in 0..self.surfaces.len() {
            for other in one + 1..self.surfaces.len() {
                let (first, second) = (&self.surfaces[one], &self.surfaces[other]);
                if first.leg == second.leg || first.upright || second.upright {
                    continue;
                }
                let (curve, frozen) = Coupled::new(first.form, second.form);
                let carrier = |phi: f64| first.form.carrier(direction(phi));
                let motions: Vec<Motion> = frozen.into_iter().map(|phi| Motion::sliding(phi, carrier(phi))).collect();
                for motion in motions {
                    self.push(Course::Motion { motion, source: Source::Pair, generators: [one, other] });
                }
                if let Some(curve) = curve {
                    let coupled = self.coupled.len();
                    self.coupled.push((curve, [one, other]));
                    self.first_branch.push(self.curves.len());
                    for branch in curve.branches() {
                        self.push(Course::Coupled { coupled, branch });
                    }
                    out.push((coupled, [one, other]));
                }
            }
        }
        out
    }

    /// Marks a pose on the curve of two limits of different legs, if there is one.
    fn mark_coupled(&mut self, book: &Book, pair: [usize; 2], place: &Place, phi: f64, vertex: usize) {
        let [one, other] = if pair[0] < pair[1] { pair } else { [pair[1], pair[0]] };
        let Ok(found) = book.coupled.binary_search_by(|entry| entry.1.cmp(&[one, other])) else { return };
        let coupled = book.coupled[found].0;
        let (branch, t, off) = self.coupled[coupled].0.locate(place, phi);
        if off.is_nan() || off > ON_CURVE * self.size {
            return;
        }
        let branches = self.coupled[coupled].0.branches();
        if let Some(k) = branches.into_iter().position(|own| own == branch) {
            self.mark(self.first_branch[coupled] + k, t, vertex);
        }
    }

    /// Marks a place on the curve of an upright limit, if it is one.
    fn mark_upright(&mut self, book: &Book, surface: usize, at: Point, vertex: usize) {
        if let Some(curve) = book.upright[surface]
            && let Course::Upright { on, .. } = self.curves[curve].course
        {
            self.mark(curve, on.parameter(at), vertex);
        }
    }

    fn motion(&self, curve: usize) -> Motion {
        match self.curves[curve].course {
            Course::Motion { motion, .. } => motion,
            _ => unreachable!("asked of motions only"),
        }
    }

    /// Places on a motion of one leg where a limit of another leg is met; marked on every curve through them.
    fn meet_others(&mut self, book: &Book, curve: usize, generators: &[usize], only_after: Option<usize>) {
        let motion = self.motion(curve);
        let leg = self.surfaces[generators[0]].leg;
        for k in 0..self.surfaces.len() {
            if self.surfaces[k].leg == leg || only_after.is_some_and(|after| k <= after && !self.surfaces[k].upright) {
                continue;
            }
            for t in motion.meets(&self.surfaces[k].form, self.tol) {
                let place = motion.place(t);
                let vertex = self.vertex(place.c);
                self.mark(curve, t, vertex);
                let phi = motion.phi(t);
                self.turning.push(phi);
                self.poses.push((place, generators.iter().copied().chain([k]).collect()));
                for &g in generators {
                    self.mark_coupled(book, [g, k], &place, phi, vertex);
                    self.mark_upright(book, g, place.c, vertex);
                }
                self.mark_upright(book, k, place.c, vertex);
                // With the orientation at an end of its range the other limit's own circle or line passes here too.
                if let (Course::Motion { source: Source::PhiEnd(end), .. }, Some(ends)) =
                    (self.curves[curve].course, &book.ends)
                    && let Some(other) = ends[k][usize::from(end)]
                {
                    let t = self.motion(other).carrier().parameter(place.c);
                    self.mark(other, t, vertex);
                }
            }
        }
    }

    fn mark_stationary(&mut self, book: &Book) {
        for surface in 0..self.surfaces.len() {
            for &curve in &book.stationary[surface] {
                self.meet_others(book, curve, &[surface], None);
            }
        }
    }

    /// Where a limit is met in every orientation its sense changes along all curves through the place.
    fn mark_poles(&mut self, book: &Book, range: Option<&PhiRange>) {
        for g in 0..self.surfaces.len() {
            let surface = &self.surfaces[g];
            let Some(at) = Motion::pole(&surface.form, self.tol).filter(|_| !surface.upright) else { continue };
            let leg = surface.leg;
            let vertex = self.vertex(at);
            if let (Some(ends), Some(_)) = (&book.ends, range) {
                for curve in ends[g].into_iter().flatten() {
                    let t = self.motion(curve).carrier().parameter(at);
                    self.mark(curve, t, vertex);
                }
            }
            for k in 0..self.surfaces.len() {
                if self.surfaces[k].leg == leg {
                    continue;
                }
                for phi in Motion::orientations_at(at, &self.surfaces[k].form, self.tol) {
                    self.mark_coupled(book, [g, k], &Place { c: at, turn: direction(phi) }, phi, vertex);
                }
                if let Some(Course::Upright { on, .. }) = book.upright[k].map(|curve| self.curves[curve].course)
                    && on.distance(at).abs() <= self.tol
                {
                    self.mark_upright(book, k, at, vertex);
                }
            }
            for &(curve, generators) in &book.edges {
                let on = self.motion(curve).carrier();
                if generators.contains(&g) && on.distance(at).abs() <= self.tol {
                    self.mark(curve, on.parameter(at), vertex);
                }
            }
        }
    }

    fn mark_phi_ends(&mut self, book: &Book, range: &PhiRange) {
        let Some(ends) = &book.ends else { return };
        for (surface, pair) in ends.iter().enumerate() {
            for (end, phi) in [(0, range.from), (1, range.to())] {
                let Some(curve) = pair[end] else { continue };
                self.meet_others(book, curve, &[surface], Some(surface));
                // Where the limit is stationary in the orientation.
                for &stationary in &book.stationary[surface] {
                    let motion = self.motion(stationary);
                    if let Some(t) = motion.at_phi(phi) {
                        let at = motion.place(t).c;
                        let vertex = self.vertex(at);
                        self.mark(stationary, t, vertex);
                        let own = self.motion(curve).carrier().parameter(at);
                        self.mark(curve, own, vertex);
                    }
                }
            }
        }
    }

    fn mark_edges(&mut self, reach: &Reach, book: &Book, range: Option<&PhiRange>) {
        for &(curve, generators) in &book.edges {
            self.meet_others(book, curve, &generators, None);
            let motion = self.motion(curve);
            let leg = self.surfaces[generators[0]].leg;
            for g in generators {
                for t in motion.alignments(&self.surfaces[g].form) {
                    let place = motion.place(t);
                    let vertex = self.vertex(place.c);
                    self.mark(curve, t, vertex);
                    for k in generators {
                        self.mark_upright(book, k, place.c, vertex);
                    }
                    // The nearer of the stationary motions passes here.
                    let near = book.stationary[g].iter().copied().min_by(|&x, &y| {
                        let off = |curve: usize| self.motion(curve).carrier().distance(place.c).abs();
                        off(x).total_cmp(&off(y))
                    });
                    if let Some(stationary) = near {
                        let t = self.motion(stationary).carrier().parameter(place.c);
                        self.mark(stationary, t, vertex);
                    }
                }
            }
            for k in 0..self.surfaces.len() {
                if self.surfaces[k].leg == leg && !generators.contains(&k) {
                    for t in motion.meets(&self.surfaces[k].form, self.tol) {
                        let place = motion.place(t);
                        let at = place.c;
                        self.poses.push((place, [generators[0], generators[1], k].into()));
                        self.turning.push(motion.phi(t));
                        let vertex = self.vertex(at);
                        self.mark(curve, t, vertex);
                        for g in generators {
                            self.mark_upright(book, g, at, vertex);
                        }
                    }
                }
            }
            for phi in edges::free_ends(&self.surfaces[generators[0]], &self.surfaces[generators[1]], reach) {
                if let Some(t) = motion.at_phi(phi) {
                    let vertex = self.vertex(motion.place(t).c);
                    self.mark(curve, t, vertex);
                }
            }
            if let Carrier::Circle { center, radius } = motion.carrier()
                && radius <= self.tol
            {
                // The pin is the reference point itself.
                let vertex = self.vertex(center);
                for g in generators {
                    self.mark_upright(book, g, center, vertex);
                }
            }
            let Some(range) = range else { continue };
            for (end, phi) in [(0, range.from), (1, range.to())] {
                let Some(t) = motion.at_phi(phi) else { continue };
                let at = motion.place(t).c;
                let vertex = self.vertex(at);
                self.mark(curve, t, vertex);
                for g in generators {
                    self.mark_upright(book, g, at, vertex);
                    if let Some(other) = book.ends.as_ref().and_then(|ends| ends[g][end]) {
                        let own = self.motion(other).carrier().parameter(at);
                        self.mark(other, own, vertex);
                    }
                }
            }
        }
    }

    /// Poses that hold a limit of each of three legs.
    fn mark_triads(&mut self, book: &Book) {
        let count = self.surfaces.len();
        for i in 0..count {
            for j in i + 1..count {
                for k in j + 1..count {
                    let legs = [i, j, k].map(|s| self.surfaces[s].leg);
                    if legs[0] == legs[1] || legs[1] == legs[2] || legs[0] == legs[2] {
                        continue;
                    }
                    let dyads = [i, j, k].map(|s| self.surfaces[s].limits[0].dyad);
                    let Ok(triad) = Triad::new(dyads) else { continue };
                    for mode in triad.real_modes().modes() {
                        let c = Point::new(mode.pose.x, mode.pose.y);
                        let place = Place { c, turn: direction(mode.pose.phi) };
                        self.turning.push(mode.pose.phi);
                        self.poses.push((place, [i, j, k].into()));
                        let vertex = self.vertex(c);
                        for pair in [[i, j], [i, k], [j, k]] {
                            self.mark_coupled(book, pair, &place, mode.pose.phi, vertex);
                        }
                        for surface in [i, j, k] {
                            self.mark_upright(book, surface, c, vertex);
                        }
                    }
                }
            }
        }
    }

    /// Where branches of one coupled curve join.
    pub(super) fn mark_branch_ends(&mut self) {
        for coupled in 0..self.coupled.len() {
            let (curve, _) = self.coupled[coupled];
            let first = self.first_branch[coupled];
            let branches: Vec<Branch> = curve.branches().collect();
            for (k, end) in curve.ends.into_iter().enumerate() {
                let t = k as f64;
                let mut seen: Vec<(Branch, usize)> = Vec::new();
                for (own, &branch) in branches.iter().enumerate() {
                    let joins = |other: &Branch| match end {
                        End::Turn => other.half == branch.half,
                        End::Through => other.sigma == branch.sigma,
                        End::Swap => (other.half == branch.half) == (other.sigma == branch.sigma),
                        End::Crossing => true,
                        End::Off => false,
                    };
                    let vertex = match seen.iter().find(|(other, _)| joins(other)) {
                        Some((_, vertex)) => *vertex,
                        None => self.vertex(curve.at(branch, t).place.c),
                    };
                    seen.push((branch, vertex));
                    self.mark(first + own, t, vertex);
                }
            }
        }
    }

    /// Along two limits that are one carrier at an orientation: where others are met, and where the coupled curve passes.
    fn mark_frozen(&mut self) {
        let own = |curve: &Curve| match curve.course {
            Course::Motion { motion: motion @ Motion::Sliding { .. }, source: Source::Pair, generators } => {
                Some((motion, generators))
            }
            _ => None,
        };
        for curve in 0..self.curves.len() {
            let Some((motion, generators)) = own(&self.curves[curve]) else { continue };
            if self.surfaces[generators[0]].leg == self.surfaces[generators[1]].leg {
                continue;
            }
            let Motion::Sliding { on, turn, .. } = motion else { continue };
            for k in 0..self.surfaces.len() {
                if generators.contains(&k) {
                    continue;
                }
                for t in motion.meets(&self.surfaces[k].form, self.tol) {
                    let vertex = self.vertex(motion.place(t).c);
                    self.mark(curve, t, vertex);
                }
            }
            for g in generators {
                for t in sliding_alignments(&self.surfaces[g].form, turn, &on) {
                    let vertex = self.vertex(motion.place(t).c);
                    self.mark(curve, t, vertex);
                }
            }
            let ends: Vec<usize> = (0..self.curves.len())
                .filter(|&other| match self.curves[other].course {
                    Course::Coupled { coupled, .. } => self.coupled[coupled].1 == generators,
                    _ => false,
                })
                .collect();
            for other in ends {
                for (t, vertex) in self.curves[other].marks.clone() {
                    if (t == 0.0 || t == 1.0) && on.distance(self.vertices[vertex]).abs() <= self.tol {
                        let own = on.parameter(self.vertices[vertex]);
                        self.mark(curve, own, vertex);
                    }
                }
            }
        }
    }
}

/// Where, the orientation held, a limit that holds all along a carrier is stationary in the orientation.
fn sliding_alignments(form: &Form, turn: Point, on: &Carrier) -> Vec<f64> {
    use crate::plane::product;
    match (*form, on) {
        (Form::Circle { b, .. }, Carrier::Circle { center, .. }) if b.norm() > 0.0 => {
            let rb = product(turn, b);
            vec![on.parameter(center + rb), on.parameter(center - rb)]
        }
        (Form::PlatformLine { a, m, k }, Carrier::Line { .. }) => vec![on.parameter(a - product(turn, m) * k)],
        _ => Vec::new(),
    }
}

/// Where the curves of each surface are.
struct Book {
    stationary: Vec<Vec<usize>>,
    ends: Option<Vec<[Option<usize>; 2]>>,
    upright: Vec<Option<usize>>,
    edges: Vec<(usize, [usize; 2])>,
    /// Sorted by the pair.
    coupled: Vec<(usize, [usize; 2])>,
}

/// The derivative of a carrier's point by its parameter.
fn along(on: &Carrier, t: f64) -> Point {
    match on {
        Carrier::Circle { radius, .. } => super::surface::quarter(direction(t)) * *radius,
        Carrier::Line { direction, .. } => *direction,
    }
}

/// The limits of a manipulator, those of one surface together.
pub(super) fn surfaces(reach: &Reach, size: f64) -> Vec<Surface> {
    let mut out: Vec<Surface> = Vec::new();
    for limit in reach.limits() {
        let Some(form) = Form::of(&limit.dyad) else { continue };
        // A circle of no radius is a pin, and comes with the edges of its leg.
        if matches!(form, Form::Circle { r, .. } if r <= AT_PIVOT * size) {
            continue;
        }
        match out.iter_mut().find(|surface| surface.leg == limit.leg && surface.limits[0].dyad == limit.dyad) {
            Some(surface) => surface.limits.push(*limit),
            None => out.push(Surface {
                leg: limit.leg,
                form,
                limits: vec![*limit],
                upright: form.is_upright(AT_PIVOT * size),
            }),
        }
    }
    out
}

/// Names of the limits active on a curve, of the variants given.
pub(super) fn active_of(limits: &[&Limit], source: Option<Source>) -> Vec<ActiveLimit> {
    let mut out: Vec<ActiveLimit> = limits.iter().map(|limit| limit.active()).collect();
    out.dedup();
    match source {
        Some(Source::PhiEnd(false)) => out.push(ActiveLimit::PhiFrom),
        Some(Source::PhiEnd(true)) => out.push(ActiveLimit::PhiTo),
        _ => {}
    }
    out
}

/// How far an orientation is outside a range, radians; not positive inside.
pub(super) fn outside(range: &PhiRange, phi: f64) -> f64 {
    if range.is_full() {
        return -1.0;
    }
    let middle = range.from + 0.5 * range.width;
    principal(phi - middle).abs() - 0.5 * range.width
}

/// A turn around a closed curve.
pub(super) const AROUND: f64 = TAU;
