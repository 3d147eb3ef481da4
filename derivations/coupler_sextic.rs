//! The sextic of a four-bar's coupler curve, and why it is tricircular.
//!
//! `cargo run --release --example coupler_sextic` prints the document; its identities are checked while it is written.

mod dice;
mod page;

use assur::algebra::{Gaussian, Integer, Ring};
use assur::eliminate::determinant_expanded;
use assur::linkage::{SideNumbers, coupler_equation};
use dice::Dice;
use page::Page;

type Complex = Gaussian<Integer>;

const OPENING: &str = "\
Claim. The point z of a coupler whose points z + theta p and z + theta q stay on circles about a and b
lies on
    F(z, w) = N N* + D^2 = 0,    w = z',
of degree 3 in z and 3 in w: a curve of degree six whose coefficients are a Hermitian 4x4 matrix. Its
leading row is |q - p|^2 (w - a')(w - b')(w - c'), so it passes three times through each circular point,
with the foci a, b and c = (a q - b p) / (q - p).

Symbols.  a, b, r, s    pivots and cranks          p, q     guided points, in the coupler's frame
          theta         rotation of the coupler    '        conjugate; of theta, 1/theta
          W1, W2        (z-a)(w-a') + p p' - r^2, (z-b)(w-b') + q q' - s^2

Source.   Roberts 1875 for tricircularity and the third focus; the form N N* + D^2 is worked out
          here.
          Identities are checked at 40 seeded random points of six digits; a polynomial of degree
          16 that is not zero vanishes at one with a chance below 1e-5, at all below 1e-200.";

/// A four-bar in integers.
struct FourBar {
    a: Complex,
    b: Complex,
    p: Complex,
    q: Complex,
    r: Integer,
    s: Integer,
}

impl FourBar {
    fn random(dice: &mut Dice) -> Self {
        let mut number = || Integer::from(dice.integer(1_000_000));
        let mut point = || Gaussian::new(number(), number());
        let (a, b, p, q) = (point(), point(), point(), point());
        Self { a, b, p, q, r: number(), s: number() }
    }

    fn sides(&self) -> [SideNumbers<Integer>; 2] {
        let Self { a, b, p, q, r, s } = self;
        [
            SideNumbers::Circle { a: a.clone(), p: p.clone(), r: r.clone() },
            SideNumbers::Circle { a: b.clone(), p: q.clone(), r: s.clone() },
        ]
    }

    /// `A, B, C` of `A theta^2 + B theta + C` for either side, from the circle's equation.
    fn quadratics(&self, z: &Complex, w: &Complex) -> [[Complex; 3]; 2] {
        let side = |a: &Complex, p: &Complex, r: &Integer| {
            let (u, v) = (z.clone() - a.clone(), w.clone() - a.conj());
            let middle = u.clone() * v.clone() + p.clone() * p.conj() - Gaussian::real(r.clone() * r.clone());
            [p.clone() * v, middle, p.conj() * u]
        };
        [side(&self.a, &self.p, &self.r), side(&self.b, &self.q, &self.s)]
    }
}

/// The document, checked line by line while it is made.
pub fn document() -> String {
    let mut page = Page::new("The sextic of a coupler curve", OPENING);
    let mut dice = Dice::new(6);
    let samples: Vec<(FourBar, Complex, Complex)> = (0..40)
        .map(|_| {
            let four_bar = FourBar::random(&mut dice);
            let mut point = || Gaussian::new(dice.integer(1_000_000).into(), dice.integer(1_000_000).into());
            (four_bar, point(), point())
        })
        .collect();
    let o = Complex::zero;
    page.step(
        "Each circle is a quadratic in theta",
        "(z - a + theta p)(w - a' + p'/theta) = r^2 times theta is
    A1 theta^2 + B1 theta + C1 = 0,    A1 = p (w - a'),    B1 = W1,    C1 = p' (z - a),
and likewise A2, B2, C2 with b, q, s.",
    );
    page.step(
        "Their resultant",
        "Two quadratics share a root where Sylvester's determinant vanishes,
    Res = (A1 C2 - A2 C1)^2 - (A1 B2 - A2 B1)(B1 C2 - B2 C1).
With D = A1 C2 - A2 C1, N = C1 B2 - C2 B1 and N* = A1 B2 - A2 B1 this is D^2 + N N*; eliminating theta^2
from both gives theta = N / D wherever D is not zero.",
    );
    let sylvester = samples.iter().all(|(four_bar, z, w)| {
        let [[a1, b1, c1], [a2, b2, c2]] = four_bar.quadratics(z, w);
        let rows = vec![
            vec![a1.clone(), b1.clone(), c1.clone(), o()],
            vec![o(), a1, b1, c1],
            vec![a2.clone(), b2.clone(), c2.clone(), o()],
            vec![o(), a2, b2, c2],
        ];
        determinant_expanded(&rows) == coupler_equation(&four_bar.sides()).at(z, w)
    });
    page.holds("linkage::coupler_equation = Sylvester's determinant of the two quadratics", sylvester);
    page.step(
        "Hermitian",
        "Conjugation exchanges z and w, A and C; it takes N to minus N* of the exchanged kind and D to -D, so F to
itself: the coefficient of z^i w^j is conjugate to that of z^j w^i. Sixteen real numbers.",
    );
    let hermitian = samples.iter().all(|(four_bar, _, _)| {
        let form = coupler_equation(&four_bar.sides());
        (0..4).all(|i| (0..4).all(|j| form.0[i][j] == form.0[j][i].conj()))
    });
    page.holds("F_ij = F_ji'", hermitian);
    page.step(
        "Three circular branches",
        "D has degree 1 in z, N degree 2, N* degree 1. So z^3 comes from N N* alone: from p'z . z (w - b') - q'z . z
(w - a') = z^2 [p'(w - b') - q'(w - a')] and z (p (w - a')(w - b') - q (w - b')(w - a')). Together
    F_3 = z^3 (p - q)(w - a')(w - b') [p'(w - b') - q'(w - a')].
The bracket is (p' - q')(w - c'), which is where c comes from. A line w = const through a circular point meets the
curve in three more finite points in general, in two where w is the conjugate of a focus: the tangents at the
circular points pass through a, b, c. Six by degree, less three: the point is threefold.",
    );
    let leading = samples.iter().all(|(four_bar, _, w)| {
        let FourBar { a, b, p, q, .. } = four_bar;
        let form = coupler_equation(&four_bar.sides());
        let top = form.0[3].iter().rev().fold(o(), |sum, c| sum * w.clone() + c.clone());
        let (u, v) = (w.clone() - a.conj(), w.clone() - b.conj());
        let bracket = p.conj() * v.clone() - q.conj() * u.clone();
        top == (p.clone() - q.clone()) * u * v * bracket
    });
    page.holds("sum_j F_3j w^j = (p - q)(w - a')(w - b')(p'(w - b') - q'(w - a'))", leading);
    page.step(
        "Planted poses",
        "A pose is chosen with a rational rotation, the pivots a = z + theta p - r u with rational directions u
put under it. Scaled to integers, F vanishes there exactly.",
    );
    let mut vanishing = 0;
    for _ in 0..100 {
        let (turn, n) = dice.turn();
        let ((u, m), (v, k)) = (dice.turn(), dice.turn());
        let mut number = || Integer::from(dice.integer(1000));
        let mut point = || Gaussian::new(number(), number());
        let (z, p, q) = (point(), point(), point());
        let (r, s) = (number(), number());
        // Everything times n m k: theta = turn / n, u / m and v / k are rotations.
        let whole = Gaussian::real(n.clone() * m.clone() * k.clone());
        let [z, p, q] = [z, p, q].map(|x| x * whole.clone());
        let turned = |x: &Complex| {
            let product = turn.clone() * x.clone();
            Gaussian::new(product.re / n.clone(), product.im / n.clone())
        };
        let crank = |length: &Integer, way: &Complex, rest: Integer| way.scaled(&(length.clone() * rest));
        let a = z.clone() + turned(&p) - crank(&r, &u, n.clone() * k.clone());
        let b = z.clone() + turned(&q) - crank(&s, &v, n.clone() * m.clone());
        let (r, s) = (r * whole.re.clone(), s * whole.re);
        let four_bar = FourBar { a, b, p, q, r, s };
        vanishing += usize::from(coupler_equation(&four_bar.sides()).at(&z, &z.conj()) == o());
    }
    page.equal("F = 0 at 100 of 100 planted poses", &vanishing, &100);
    page.finish()
}

/// Prints the document.
pub fn main() {
    print!("{}", document());
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_identity_of_the_document_holds() {
        assert!(super::document().contains("5. Planted poses"));
    }
}
