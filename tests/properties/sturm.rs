//! How many real orientations a triad has, counted by Sturm's sequence on a half-angle polynomial.
//!
//! The polynomial is put together here from the legs' rows, each cleared by `1 + t²`; of the library only ring arithmetic is used.
//! Extraneous powers of `1 + t²` have no real root and are of full degree: they change no count and are divided out only to be quick.

use assur::Dyad;
use assur::algebra::{Integer, Rational, UPoly, dyadic};
use dashu_int::ops::BitTest;

type Poly = UPoly<Integer>;

/// Real roots of a polynomial, each counted as often as it occurs; the zero polynomial has none to count.
pub fn real_roots(p: &Poly) -> usize {
    let mut count = 0;
    let mut rest = primitive(p.clone());
    // Roots of p, of gcd(p, p'), of that one's gcd …: an m-fold root is in m of them.
    while rest.degree().unwrap_or(0) > 0 {
        let sequence = sturm_sequence(&rest);
        count += changes(&sequence, false) - changes(&sequence, true);
        rest = sequence.last().expect("a sequence begins with its polynomial").clone();
    }
    count
}

/// `p`, `p'` and minus each remainder in turn, up to positive factors.
fn sturm_sequence(p: &Poly) -> Vec<Poly> {
    let mut sequence = vec![p.clone(), primitive(p.derivative())];
    loop {
        let [.., dividend, divisor] = &sequence[..] else { return sequence };
        let lead_negative = divisor.leading().is_some_and(|lead| *lead < Integer::ZERO);
        let steps = dividend.coefficients().len() + 1 - divisor.coefficients().len();
        let rest = dividend.pseudo_remainder(divisor);
        if rest.vanishes() {
            return sequence;
        }
        // The pseudo-remainder carries lead^steps.
        let rest = if lead_negative && steps % 2 == 1 { rest } else { -rest };
        sequence.push(primitive(rest));
    }
}

/// Sign changes of a sequence at plus or minus infinity.
fn changes(sequence: &[Poly], at_plus: bool) -> usize {
    let positive = |p: &Poly| {
        let odd = p.degree().unwrap_or(0) % 2 == 1;
        (*p.leading().expect("no zero polynomial in a sequence") > Integer::ZERO) == (at_plus || !odd)
    };
    sequence.windows(2).filter(|pair| positive(&pair[0]) != positive(&pair[1])).count()
}

/// Without the common factor of its coefficients.
fn primitive(p: Poly) -> Poly {
    let content = p.coefficients().iter().fold(Integer::ZERO, |g, c| {
        let (mut a, mut b) = (g, c.clone());
        while !b.is_zero() {
            (a, b) = (b.clone(), a % b);
        }
        a
    });
    let content = if content < Integer::ZERO { -content } else { content };
    if content.is_zero() { p } else { p.divided_by_constant(&content).expect("the content divides") }
}

/// A complex number with polynomial parts.
#[derive(Clone)]
struct Plane(Poly, Poly);

impl Plane {
    fn times(&self, k: &Poly) -> Self {
        Self(self.0.clone() * k.clone(), self.1.clone() * k.clone())
    }
    fn less(&self, other: &Self) -> Self {
        Self(self.0.clone() - other.0.clone(), self.1.clone() - other.1.clone())
    }
    fn turned_by(&self, other: &Self) -> Self {
        let (a, b) = (self, other);
        Self(
            a.0.clone() * b.0.clone() - a.1.clone() * b.1.clone(),
            a.0.clone() * b.1.clone() + a.1.clone() * b.0.clone(),
        )
    }
    fn dot(&self, other: &Self) -> Poly {
        self.0.clone() * other.0.clone() + self.1.clone() * other.1.clone()
    }
    fn cross(&self, other: &Self) -> Poly {
        self.0.clone() * other.1.clone() - self.1.clone() * other.0.clone()
    }
}

/// Real orientations, with multiplicity, in which three legs without PP are consistent; `None` if they are in all.
///
/// RP legs must give `delta`, so that every number is dyadic.
pub fn real_orientations(legs: &[Dyad; 3]) -> Option<usize> {
    let int = |x: i64| UPoly::constant(Integer::from(x));
    // Lengths in units of 2^-1074 are integers whatever they are; a smaller power keeps the numbers short.
    let shift = legs.iter().flat_map(numbers).map(denominator_bits).max().unwrap_or(0);
    let whole = |x: f64| {
        let scaled = dyadic(x).expect("finite") * Rational::from(Integer::ONE << shift);
        UPoly::constant(scaled.numerator().clone())
    };
    let plane = |p: &assur::nalgebra::Vector2<f64>| Plane(whole(p.x), whole(p.y));
    let t = Poly::variable();
    let w = int(1) + t.clone() * t.clone();
    let rotation = Plane(int(1) - t.clone() * t.clone(), int(2) * t);
    let turned = |p: &Plane| p.turned_by(&rotation);
    // Row g·X + e = 0 of a slider leg, times w.
    let slider = |leg: &Dyad| match leg {
        Dyad::PR { a, u, b } => {
            let n = Plane(-whole(u.y), whole(u.x));
            let k = turned(&plane(b)).less(&plane(a).times(&w));
            (n.times(&w), n.dot(&k))
        }
        Dyad::RP { a, b, v, offset: assur::Offset::TimesDirection(delta) } => {
            let m = Plane(-whole(v.y), whole(v.x));
            let g = turned(&m);
            let delta = whole(*delta) * UPoly::constant(Integer::ONE << shift);
            let e = m.dot(&plane(b)) * w.clone() - g.dot(&plane(a)) + delta * w.clone();
            (g, e)
        }
        _ => panic!("not a slider leg with dyadic numbers"),
    };
    let circles: Vec<(Plane, Plane, Poly)> = legs
        .iter()
        .filter_map(|leg| match leg {
            Dyad::RR { a, b, length } => Some((plane(a), plane(b), whole(*length))),
            _ => None,
        })
        .collect();
    let sliders = legs.iter().filter(|leg| !matches!(leg, Dyad::RR { .. }));
    let (polynomial, formal) = match circles.split_first() {
        None => {
            let rows: Vec<(Plane, Poly)> = sliders.map(slider).collect();
            let minor = |i: usize, j: usize| rows[i].0.cross(&rows[j].0);
            let e = |i: usize| rows[i].1.clone();
            // Each of g and e carries one w: degree 2 each.
            (e(0) * minor(1, 2) + e(1) * minor(2, 0) + e(2) * minor(0, 1), 6)
        }
        Some(((a1, b1, l1), others)) => {
            // About the first circle: X = X' + a1 - R b1, |X'| = l1. Everything of an RR row is then times w².
            let about = |a: &Plane, b: &Plane| turned(&b.less(b1)).less(&a.less(a1).times(&w));
            let mut rows: Vec<(Plane, Poly)> = others
                .iter()
                .map(|(a, b, l)| {
                    let k = about(a, b);
                    let lengths = l.clone() * l.clone() - l1.clone() * l1.clone();
                    let e = k.dot(&k) - lengths * w.clone() * w.clone();
                    (k.times(&(int(2) * w.clone())), e)
                })
                .collect();
            rows.extend(sliders.map(|leg| {
                let (g, e) = slider(leg);
                // e was about the origin: g·(X' + a1 - R b1) + e, with g·w and R·w multiplied out.
                let shift = a1.times(&w).less(&turned(b1));
                let e = e * w.clone() + g.dot(&shift);
                (g.times(&w), e)
            }));
            let [(g2, e2), (g3, e3)] = &rows[..] else { panic!("two legs beside the first") };
            let mismatch = g3.times(e2).less(&g2.times(e3));
            let cross = g2.cross(g3);
            let t = mismatch.dot(&mismatch) - l1.clone() * l1.clone() * cross.clone() * cross;
            (t, 16)
        }
    };
    let (polynomial, formal) = without_factor(polynomial, &w, formal);
    // Degrees missing at the top are roots at phi = pi.
    polynomial.degree().map(|degree| real_roots(&polynomial) + (formal - degree))
}

/// Divides out the extraneous powers of `1 + t²`, to be quick.
fn without_factor(mut p: Poly, w: &Poly, mut formal: usize) -> (Poly, usize) {
    use assur::algebra::Domain;
    while let Some(quotient) = p.exact_div(w).filter(|q| !q.vanishes()) {
        (p, formal) = (quotient, formal - 2);
    }
    (p, formal)
}

fn numbers(leg: &Dyad) -> Vec<f64> {
    match leg {
        Dyad::RR { a, b, length } => vec![a.x, a.y, b.x, b.y, *length],
        Dyad::PR { a, u, b } => vec![a.x, a.y, b.x, b.y, u.x, u.y],
        Dyad::RP { a, b, v, offset } => {
            let (assur::Offset::Distance(d) | assur::Offset::TimesDirection(d)) = offset;
            vec![a.x, a.y, b.x, b.y, v.x, v.y, *d]
        }
        Dyad::PP { .. } => Vec::new(),
    }
}

/// `k` of a number `m / 2^k`.
fn denominator_bits(x: f64) -> usize {
    dyadic(x).expect("finite").denominator().bit_len() - 1
}
