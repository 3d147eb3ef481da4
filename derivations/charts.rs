//! Three charts of the circle: the angle, `theta = e^(i phi)` and `t = tan(phi/2)`.
//!
//! `cargo run --example charts` prints the document; its identities are checked while it is written.

mod page;

use assur::algebra::{Gaussian, Monomial, Poly, Rational, Ring, Trig, UPoly};
use page::Page;

/// Numbers of the charts: rational, with symbols for the coefficients of T.
type Symbolic = Poly<Rational>;
type Complex = Gaussian<Symbolic>;

/// The largest order that is worked out.
const ORDERS: usize = 4;

const OPENING: &str = "\
Claim. A trigonometric polynomial T(phi) of order K is, in theta = e^(i phi), a polynomial of degree
2K over theta^K, and in t = tan(phi/2) one of degree 2K over (1+t^2)^K. If it is cleared with a larger
power N than its order, a factor (1+t^2)^(N-K) stays in t; in theta there stay N-K zeros at either
end of the coefficient list and nothing to divide by. The half-turn phi = pi is theta = -1, an
ordinary point, and t = infinity, where degrees are lost.

Symbols.  c, s          cos phi, sin phi
          theta, t      e^(i phi), tan(phi/2)
          K, N          order of T; order it is cleared with, N >= K
          x, p_k, q_k   T = x + sum over k = 1..K of p_k cos(k phi) + q_k sin(k phi)
          P_N(theta)    (2 theta)^N T, coefficients P_0 .. P_2N
          H_N(t)        (1+t^2)^N T

Source.   The substitutions are classical; the bookkeeping of the extra factors is worked out here.
          Coefficients x, p_k, q_k are symbols throughout: what is checked holds for every T of
          order up to 4.";

/// The document, checked line by line while it is made.
pub fn document() -> String {
    let mut page = Page::new("The theta chart and the half-angle chart", OPENING);
    both_charts_are_charts(&mut page);
    theta_coefficients(&mut page);
    from_theta_to_t(&mut page);
    extraneous_factors(&mut page);
    the_half_turn(&mut page);
    other_charts(&mut page);
    the_library(&mut page);
    page.finish()
}

fn both_charts_are_charts(page: &mut Page) {
    page.step(
        "Both charts lie on the circle",
        "Both fulfil c^2 + s^2 = 1, and theta = (1+it)/(1-it) leads from one to the other:
    c = (theta^2 + 1)/(2 theta)    s = (theta^2 - 1)/(2 i theta)
    c = (1 - t^2)/(1 + t^2)        s = 2t/(1 + t^2)",
    );
    let theta = UPoly::<Complex>::variable();
    let square = theta.power(2);
    let (sum, difference) = (square.clone() + UPoly::one(), square - UPoly::one());
    let i = UPoly::constant(imaginary());
    page.equal(
        "(theta^2 + 1)^2 - (theta^2 - 1)^2 = (2 theta)^2",
        &(sum.power(2) - difference.power(2)),
        &(UPoly::from_int(2) * theta).power(2),
    );
    let [plus, minus] = [1, -1].map(|sign| UPoly::one() + UPoly::from_int(sign) * i.clone() * UPoly::variable());
    let t = UPoly::<Complex>::variable();
    let (numerator_c, numerator_s) = (UPoly::one() - t.power(2), UPoly::from_int(2) * t.clone());
    let circle = UPoly::one() + t.power(2);
    page.equal("(1 - t^2)^2 + (2t)^2 = (1 + t^2)^2", &(numerator_c.power(2) + numerator_s.power(2)), &circle.power(2));
    page.equal(
        "(1 - t^2) + i (2t) = (1 + it)^2   and   (1 + it)(1 - it) = 1 + t^2",
        &[numerator_c + i.clone() * numerator_s, plus.clone() * minus.clone()],
        &[plus.power(2), circle],
    );
    // As a ratio t = n : d the half-turn is 1 : 0.
    let at = |n: Complex, d: Complex| [d.clone() + imaginary() * n.clone(), d - imaginary() * n];
    let [top, bottom] = at(Complex::one(), Complex::zero());
    page.equal("with t = n/d, theta = (d + in)/(d - in): at d = 0, t = infinity, theta = -1", &top, &-bottom);
    page.holds(
        "t = i is theta = 0, and t = -i is theta = infinity",
        at(imaginary(), Complex::one())[0] == Complex::zero() && at(-imaginary(), Complex::one())[1] == Complex::zero(),
    );
}

fn theta_coefficients(page: &mut Page) {
    page.step(
        "T in theta",
        "cos(k phi) = (theta^k + theta^-k)/2 and sin(k phi) = (theta^k - theta^-k)/(2i), so that
the coefficients of (2 theta)^K T are, counted from the middle one,
    P_K = 2^K x,   P_(K+k) = 2^(K-1) (p_k - i q_k),   P_(K-k) = 2^(K-1) (p_k + i q_k):
2K + 1 of them, self-conjugate, and degree 2K as long as p_K, q_K are not both zero.",
    );
    for order in 1..=ORDERS {
        let expected = theta_polynomial(order);
        page.equal(
            &format!("K = {order}: Trig::theta({order}) has these coefficients"),
            &general(order).theta(order),
            &expected,
        );
    }
}

fn from_theta_to_t(page: &mut Page) {
    page.step(
        "From theta to t and back",
        "theta = (1+it)/(1-it) and theta (1-it)^2 = 1+t^2 turn P(theta) = (2 theta)^K T into
    2^K H(t) = sum of P_j (1+it)^j (1-it)^(2K-j).
t = -i (theta-1)/(theta+1) and 1+t^2 = 4 theta/(theta+1)^2 lead back:
    2^K P(theta) = sum of H_j (-i)^j (theta-1)^j (theta+1)^(2K-j).",
    );
    for order in 1..=ORDERS {
        let (p, h) = (theta_polynomial(order), general(order).half_angle(order).map(real));
        let i = imaginary();
        let forth = mix(&p, order, &linear(Complex::one(), i.clone()), &linear(Complex::one(), -i.clone()));
        let sums = [linear(-i.clone() * -Complex::one(), -i), linear(Complex::one(), Complex::one())];
        let back = mix(&h, order, &sums[0], &sums[1]);
        let factor = Complex::from_int(1 << order);
        page.equal(
            &format!("K = {order}: both hold, with H = Trig::half_angle({order})"),
            &[forth, back],
            &[h.scaled(&factor), p.scaled(&factor)],
        );
    }
}

fn extraneous_factors(page: &mut Page) {
    page.step(
        "Where (1+t^2)^k comes from",
        "Rows of a mechanism are cleared one by one: each is multiplied by 1+t^2 or by 2 theta. A product
of N rows is then cleared N times, whatever the order K of the sum is after terms have cancelled:
    H_N = (1+t^2)^(N-K) H_K,     P_N = (2 theta)^(N-K) P_K.
In t the surplus is a factor, to be found and divided out. In theta it shows as N-K zeros below and
N-K zeros above the coefficients of P_K: the roots theta = 0 and theta = infinity, which are t = i
and t = -i. At the exact order nothing is left to divide out, for
    H_K(i) = 2^K P_0,     H_K(-i) = 2^K P_2K,
and 1+t^2 divides the real polynomial H_K if and only if p_K = q_K = 0.",
    );
    let circle = UPoly::new(vec![Symbolic::one(), Symbolic::zero(), Symbolic::one()]);
    let two_theta = UPoly::new(vec![Complex::zero(), Complex::from_int(2)]);
    for order in 1..=ORDERS {
        let general = general(order);
        let surplus = |extra: usize| {
            general.half_angle(order + extra) == general.half_angle(order) * circle.power(extra as u32)
                && general.theta(order + extra) == general.theta(order) * two_theta.power(extra as u32)
        };
        page.holds(&format!("K = {order}, N = K+1, K+2, K+3: both identities"), (1..=3).all(surplus));
        let (h, p) = (general.half_angle(order).map(real), general.theta(order));
        let factor = Complex::from_int(1 << order);
        page.equal(
            &format!("K = {order}: H(i) = 2^K P_0 and H(-i) = 2^K P_2K"),
            &[h.evaluate(&imaginary()), h.evaluate(&-imaginary())],
            &[factor.clone() * p.coefficient(0), factor * p.coefficient(2 * order)],
        );
    }
    let (c, s) = (Trig::<Symbolic>::cosine(), Trig::<Symbolic>::sine());
    let [cleared_c, cleared_s] = [c.half_angle(1), s.half_angle(1)];
    page.equal(
        "smallest case: c c + s s, cleared row by row, is (1-t^2)^2 + (2t)^2 = (1+t^2)^2 . 1",
        &(cleared_c.power(2) + cleared_s.power(2)),
        &(circle.power(2) * (c.power(2) + s.power(2)).half_angle(0)),
    );
}

fn the_half_turn(page: &mut Page) {
    page.step(
        "The half-turn",
        "phi = pi is theta = -1: P(-1) = (-2)^K T(pi). In t it is the point at infinity: the coefficient of
t^2K in H is T(pi), so an assembly turned by pi makes the degree drop, once for each multiplicity.",
    );
    for order in 1..=ORDERS {
        let general = general(order);
        let at_pi = general.evaluate(Clone::clone, &-Symbolic::one(), &Symbolic::zero());
        let power = Complex::from_int((-2_i64).pow(order as u32));
        page.holds(
            &format!("K = {order}: P(-1) = (-2)^K T(pi), and H_2K = T(pi)"),
            general.theta(order).evaluate(&-Complex::one()) == power * real(&at_pi)
                && general.half_angle(order).coefficient(2 * order) == at_pi,
        );
    }
    let above = Trig::<Symbolic>::one() + Trig::cosine();
    let root = linear(Complex::one(), Complex::one());
    for order in 1..=3_u32 {
        let folded = above.power(order);
        page.holds(
            &format!(
                "(1+c)^{order}: (theta+1)^{} in theta; in t the constant {}, no degree left",
                2 * order,
                1 << order
            ),
            folded.theta(order as usize) == root.power(2 * order)
                && folded.half_angle(order as usize) == UPoly::from_int(1 << order),
        );
    }
}

fn other_charts(page: &mut Page) {
    page.step(
        "Turning the half-angle chart",
        "With t measured from another direction phi0, tan(phi0/2) = tau, the old t is (t+tau)/(1-tau t):
    H_tau(t) = (1-tau t)^2K H((t+tau)/(1-tau t)),
whose point at infinity is phi0 + pi; its leading coefficient is (1+tau^2)^K T(phi0 + pi). T has at
most 2K roots, so among 2K+1 charts one has all its roots finite.",
    );
    for tau in [1_i64, -2, 3] {
        let holds = (1..=ORDERS).all(|order| {
            let general = general(order);
            let turned = general.half_angle_about(order, tau).map(real);
            let [upper, lower] = [[tau, 1], [1, -tau]].map(|[a, b]| linear(Complex::from_int(a), Complex::from_int(b)));
            let scale = Rational::from(1 + tau * tau);
            let part = |x: i64| Symbolic::constant(Rational::from(x) / scale.clone());
            // cos and sin of phi0 + pi.
            let opposite = general.evaluate(Clone::clone, &part(tau * tau - 1), &part(-2 * tau));
            turned == mix(&general.half_angle(order).map(real), order, &upper, &lower)
                && turned.coefficient(2 * order)
                    == real(&(Symbolic::from_int((1 + tau * tau).pow(order as u32)) * opposite))
        });
        page.holds(&format!("tau = {tau}, K = 1..{ORDERS}: both hold, with H_tau = Trig::half_angle_about"), holds);
    }
}

fn the_library(page: &mut Page) {
    page.step(
        "The library",
        "`algebra::Trig` holds T as A(c) + s B(c). Above, its theta, half_angle and half_angle_about were
held against the formulas. It also leads back: from_theta returns T from P up to the factor 2^K, and
refuses a polynomial that is not self-conjugate.",
    );
    for order in 1..=ORDERS {
        let (general, p) = (general(order), theta_polynomial(order));
        page.equal(
            &format!("K = {order}: from_theta(theta(T)) = 2^K T"),
            &Trig::from_theta(&p, order),
            &Some(Trig::from_int(1 << order) * general),
        );
        page.equal("i P is refused", &Trig::from_theta(&p.scaled(&imaginary()), order), &None);
    }
    page.equal(
        "order() is exact: cos(4 phi) + c - cos(4 phi) has order 1",
        &(multiple(4).re + Trig::<Symbolic>::cosine() - multiple(4).re).order(),
        &1,
    );
}

fn imaginary() -> Complex {
    Complex::new(Symbolic::zero(), Symbolic::one())
}

fn real(x: &Symbolic) -> Complex {
    Complex::real(x.clone())
}

fn linear(a: Complex, b: Complex) -> UPoly<Complex> {
    UPoly::new(vec![a, b])
}

/// `sum of f_j upper^j lower^(2K-j)`.
fn mix(f: &UPoly<Complex>, order: usize, upper: &UPoly<Complex>, lower: &UPoly<Complex>) -> UPoly<Complex> {
    (0..=2 * order).fold(UPoly::zero(), |sum, j| {
        let weight = upper.power(j as u32) * lower.power((2 * order - j) as u32);
        sum + weight.scaled(&f.coefficient(j))
    })
}

/// `cos(k phi) + i sin(k phi)`, by de Moivre.
fn multiple(k: u32) -> Gaussian<Trig<Symbolic>> {
    Gaussian::new(Trig::cosine(), Trig::sine()).power(k)
}

/// The symbols `x`, `p_k`, `q_k`.
fn symbols(k: usize) -> [Symbolic; 2] {
    [2 * k, 2 * k + 1].map(|v| Symbolic::term(Rational::from(1), Monomial::variable(v)))
}

/// `x + sum of p_k cos(k phi) + q_k sin(k phi)`, all coefficients symbols.
fn general(order: usize) -> Trig<Symbolic> {
    let [x, _] = symbols(0);
    (1..=order).fold(Trig::constant(x), |sum, k| {
        let [p, q] = symbols(k).map(Trig::constant);
        let Gaussian { re: cos, im: sin } = multiple(k as u32);
        sum + p * cos + q * sin
    })
}

/// The coefficients of step 2.
fn theta_polynomial(order: usize) -> UPoly<Complex> {
    let mut coefficients = vec![Complex::zero(); 2 * order + 1];
    let half = Symbolic::from_int(1 << (order - 1));
    coefficients[order] = real(&(Symbolic::from_int(1 << order) * symbols(0)[0].clone()));
    for k in 1..=order {
        let [p, q] = symbols(k);
        let upper = Complex::new(p, -q).scaled(&half);
        coefficients[order - k] = upper.conj();
        coefficients[order + k] = upper;
    }
    UPoly::new(coefficients)
}

/// Prints the document.
pub fn main() {
    print!("{}", document());
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_identity_of_the_document_holds() {
        assert!(super::document().contains("7. The library"));
    }
}
