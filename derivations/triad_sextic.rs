//! The sextic of the triad RR-RR-RR: closed form and Sylvester route give the same polynomial.
//!
//! `cargo run --release --example triad_sextic` prints the document; its identities are checked while it is written.

mod dice;
mod page;

use assur::algebra::{Gaussian, Integer, Monomial, Poly, Rational, Ring, Trig, UPoly};
use assur::linkage::{LegNumbers, Row, consistency, constraint_system, leg_row, sylvester_plan};
use assur::{Eliminant, Plan, System, eliminate, triad_degree};
use dice::Dice;
use page::Page;

/// Polynomials in all the symbols of the triad.
type Symbolic = Poly<Integer>;
type Complex = Gaussian<Symbolic>;

const OPENING: &str = "\
Claim. A platform on three legs RR is assembled where
    T(phi) = |G|^2 - l1^2 D^2 = 0,    G = e2 g3 - e3 g2,    D = g2 x g3,
a trigonometric polynomial of order 3 with the leading coefficient
    c_3 = 4 beta2 beta3 (beta2 - beta3) conj(alpha2 alpha3 (alpha3 - alpha2)):
a sextic in theta = e^(i phi), with six roots other than 0 and infinity exactly when no two base pivots
and no two platform pivots coincide. Sylvester's resultants, applied to the three closures, give
    Res = (coefficient of u in row 2) . theta . (theta^3 T) / 4.

Symbols.  a_i, b_i      base pivot and platform pivot of leg i, complex numbers; l_i its length
          alpha_i       a_i - a_1           beta_i    b_i - b_1
          theta         e^(i phi)           '         conjugate; of theta, 1/theta
          u, v          B_1 - a_1 and its conjugate, B_1 the place of platform pivot 1
          k_i           theta beta_i - alpha_i: leg i's pivots seen from leg 1's
          g_i, e_i      the row g_i . u + e_i = 0 of leg i

Source.   Gosselin, Sefrioui, Richard 1992, for the degree and the elimination; the normalised form
          and the factors are worked out here. alpha2, alpha3, beta2, beta3 (two symbols each) and
          l1, l2, l3 are eleven independent symbols: what is checked holds for every triad.";

/// The document, checked line by line while it is made.
pub fn document() -> String {
    let mut page = Page::new("The sextic of RR-RR-RR", OPENING);
    let legs = symbolic_legs();
    let rows = [1, 2].map(|i: usize| symbolic_row(&legs, i));
    closures_become_rows(&mut page, &legs, &rows);
    rows_become_t(&mut page, &legs, &rows);
    order_three(&mut page, &legs, &rows);
    the_chain_of_resultants(&mut page);
    rows_of_the_constraints(&mut page, &legs, &rows);
    the_whole_elimination(&mut page);
    planted_poses(&mut page);
    page.finish()
}

fn closures_become_rows(page: &mut Page, legs: &[LegNumbers<Symbolic>; 3], rows: &[Row<Trig<Symbolic>>; 2]) {
    page.step(
        "Closures become rows",
        "Leg 1 closes where u.u = l1^2, leg i where |u + k_i|^2 = l_i^2. The difference is linear in u:
    g_i.u + e_i = 0,    g_i = 2 k_i,    e_i = k_i.k_i - (l_i^2 - l1^2).",
    );
    let u = Gaussian::new(symbol(11), symbol(12)).map(constant);
    for (leg, row) in legs[1..].iter().zip(rows) {
        let LegNumbers::Circle { alpha, beta, length } = leg else { unreachable!("all legs are RR") };
        let rotation = Gaussian::new(Trig::cosine(), Trig::sine());
        let k = rotation * beta.map(constant) - alpha.map(constant);
        let squares = [length, &symbol(8)].map(|l| constant(l).power(2));
        let closures = (u.clone() + k).norm_sqr() - squares[0].clone() - (u.norm_sqr() - squares[1].clone());
        page.equal(
            "|u + k|^2 - l^2 - (u.u - l1^2) = g.u + e, with g, e of linkage::leg_row",
            &closures,
            &(row.g.dot(&u) + row.e.clone()),
        );
    }
}

fn rows_become_t(page: &mut Page, legs: &[LegNumbers<Symbolic>; 3], rows: &[Row<Trig<Symbolic>>; 2]) {
    page.step(
        "Two rows and a circle",
        "In the plane D u = i (g2 (g3.u) - g3 (g2.u)) for any u; on both rows this is D u = i G. Its square
with u.u = l1^2 is T = 0. Where D is not zero, u = i G / D: one assembly above each root. Where D = 0
as well, G = 0 on the unit circle: both rows are one line, which meets the circle in two assemblies of one
orientation.",
    );
    let [g2, g3, u] = [0, 2, 4].map(|v| Gaussian::new(symbol(v), symbol(v + 1)));
    page.equal(
        "(g2 x g3) u = i (g2 (g3.u) - g3 (g2.u))",
        &u.scaled(&g2.cross(&g3)),
        &(g2.scaled(&g3.dot(&u)) - g3.scaled(&g2.dot(&u))).turned(),
    );
    let [mismatch, cross] = [mismatch(rows).norm_sqr(), rows[0].g.cross(&rows[1].g).power(2)];
    page.equal(
        "linkage::consistency = |G|^2 - l1^2 D^2",
        &closed_form(legs),
        &(mismatch - constant(&symbol(8)).power(2) * cross),
    );
}

fn order_three(page: &mut Page, legs: &[LegNumbers<Symbolic>; 3], rows: &[Row<Trig<Symbolic>>; 2]) {
    page.step(
        "Order 3, though the parts have order 4",
        "Re G and Im G have order 2, so their squares have order 4. But G as a whole runs from theta^-1 to
theta^2 only: its theta^-2 vanishes, since e_i starts with theta^-1 and k_i with theta^0. So |G|^2 = G G'
runs from theta^-3 to theta^3, and the theta^4 of the two squares cancel identically. D = g2 x g3 has
order 1, since (theta beta2)'(theta beta3) is free of theta, and D^2 order 2: c_3 comes from G alone,
the product of the two ends of G.",
    );
    let g = mismatch(rows);
    let d = rows[0].g.cross(&rows[1].g);
    page.equal("orders of Re G, Im G, D: 2, 2, 1", &[g.re.order(), g.im.order(), d.order()], &[2, 2, 1]);
    page.equal(
        "orders of (Re G)^2, (Im G)^2 and of their sum: 4, 4, 3",
        &[g.re.power(2).order(), g.im.power(2).order(), g.norm_sqr().order()],
        &[4, 4, 3],
    );
    // (2 theta)^2 G; coefficients 0..4 belong to theta^-2..theta^2.
    let laurent = g.re.theta(2) + g.im.theta(2).scaled(&imaginary());
    let [(alpha2, beta2), (alpha3, beta3)] = [1, 2].map(|i: usize| match &legs[i] {
        LegNumbers::Circle { alpha, beta, .. } => (alpha.clone(), beta.clone()),
        _ => unreachable!("all legs are RR"),
    });
    let eight = Symbolic::from_int(8);
    page.equal(
        "ends of G: 2 alpha2 alpha3 (beta2 - beta3)' theta^-1\nand 2 beta2 beta3 (alpha3 - alpha2)' theta^2; no theta^-2",
        &[laurent.coefficient(0), laurent.coefficient(1), laurent.coefficient(4)],
        &[
            Complex::zero(),
            (alpha2.clone() * alpha3.clone() * (beta2.clone() - beta3.clone()).conj()).scaled(&eight),
            (beta2.clone() * beta3.clone() * (alpha3.clone() - alpha2.clone()).conj()).scaled(&eight),
        ],
    );
    let t = closed_form(legs);
    let c3 =
        beta2.clone() * beta3.clone() * (beta2 - beta3) * (alpha2.clone() * alpha3.clone() * (alpha3 - alpha2)).conj();
    // (2 theta)^3 T leads with 8 c_3.
    let leading = t.theta(3).leading().cloned();
    page.equal(
        "T has order 3, and c_3 = 4 beta2 beta3 (beta2 - beta3) (alpha2 alpha3 (alpha3 - alpha2))'",
        &(t.order(), leading),
        &(3, Some(c3.scaled(&Symbolic::from_int(32)))),
    );
    page.equal("2 . 3 = triad_degree(RR, RR, RR)", &Some(2 * t.order()), &triad_degree(&["RR"; 3]));
}

fn the_chain_of_resultants(page: &mut Page) {
    page.step(
        "What three resultants do to two rows and a circle",
        "With general rows A_i u + B_i v + C_i and the circle f1 = u v - L, in seven symbols:
    R1  = Res_u(row 2, row 3) = P v + Q,   P = A2 B3 - A3 B2,   Q = A2 C3 - A3 C2
    R2  = Res_u(f1, row 2)    = B2 v^2 + C2 v + L A2
    Res = Res_v(R1, R2)       = B2 Q^2 - C2 P Q + L A2 P^2.
Since B2 Q - C2 P = A2 (B2 C3 - B3 C2), the coefficient A2 of u in row 2 divides: row 2 was used twice.
    Res = A2 ( Q (B2 C3 - B3 C2) + L P^2 )",
    );
    let symbols = |first: usize| [0, 1, 2].map(|k| Complex::real(symbol(first + k)));
    let ([a2, b2, c2], [a3, b3, c3], l) = (symbols(0), symbols(3), Complex::real(symbol(6)));
    let [u, v] = [0, 1].map(Poly::<Complex>::variable);
    let row = |[a, b, c]: [&Complex; 3]| {
        Poly::constant(a.clone()) * u.clone() + Poly::constant(b.clone()) * v.clone() + Poly::constant(c.clone())
    };
    let system = System::new(["u", "v", "theta"])
        .with("f1", u.clone() * v.clone() - Poly::constant(l.clone()))
        .with("row 2", row([&a2, &b2, &c2]))
        .with("row 3", row([&a3, &b3, &c3]));
    let chain = Plan::new("theta")
        .resultant_formal("R1", ("row 2", 1), ("row 3", 1), "u")
        .resultant_formal("R2", ("f1", 1), ("row 2", 1), "u")
        .resultant_formal("Res", ("R1", 1), ("R2", 2), "v");
    let found = eliminate(&system, &chain).expect("the chain suits general rows").polynomial.coefficient(0);
    let p = a2.clone() * b3.clone() - a3.clone() * b2.clone();
    let q = a2.clone() * c3.clone() - a3 * c2.clone();
    let bracket = q * (b2 * c3 - b3 * c2) + l * p.power(2);
    page.equal("Res = A2 ( Q (B2 C3 - B3 C2) + L P^2 )", &found, &(a2 * bracket));
}

fn rows_of_the_constraints(page: &mut Page, legs: &[LegNumbers<Symbolic>; 3], rows: &[Row<Trig<Symbolic>>; 2]) {
    page.step(
        "The rows of this triad",
        "With u.u = u v the closures, cleared of 1/theta, are f_i = (u + theta beta - alpha)(theta v + beta'
- theta alpha') - theta l^2, and row i is f_i - theta f1. It is theta times the row of step 1, because 2 g.u = g' u + g v:
    A_i = theta k_i',   B_i = theta k_i,   C_i = theta e_i.",
    );
    let system = constraint_system(legs, &[], [1, 2, 3]);
    let theta = Poly::<Complex>::variable(2);
    let f = |i: usize| system.equations()[i].1.clone();
    for (i, row) in (1..).zip(rows) {
        let polynomial = f(i) - theta.clone() * f(0);
        let [g, turned] = [row.g.re.theta(1), row.g.im.theta(1).scaled(&imaginary())];
        let (a, b) = (g.clone() - turned.clone(), g + turned);
        let expected = in_theta(&a) * Poly::variable(0)
            + in_theta(&b) * Poly::variable(1)
            + in_theta(&row.e.theta(1)) * Poly::from_int(2);
        page.equal(
            &format!("f{0} - theta f1 = theta (k{0}' u + k{0} v + e{0}), f of linkage::constraint_system", i + 1),
            &(polynomial * Poly::from_int(4)),
            &expected,
        );
    }
    page.step(
        "Together",
        "Put into step 4, with L = l1^2 and G = 2 (e2 k3 - e3 k2), D = 4 k2 x k3:
    Q (B2 C3 - B3 C2) = theta^4 (k2' e3 - k3' e2)(k2 e3 - k3 e2) = theta^4 |G|^2 / 4
    P^2 = theta^4 (k2' k3 - k2 k3')^2 = theta^4 (2i k2 x k3)^2   = -theta^4 D^2 / 4
    Res = A2 theta^4 T / 4.
T carries theta^-3, so theta^3 T is a polynomial with a constant term, and one theta is left over as a
factor. The factors are A2, the coefficient of u in row 2, and theta, each once.",
    );
    let [[a2, b2, c2], [a3, b3, c3]] = rows.each_ref().map(|row| {
        let [g, turned] = [row.g.re.theta(1), row.g.im.theta(1).scaled(&imaginary())];
        // Four times A, B, C.
        [g.clone() - turned.clone(), g + turned, row.e.theta(1).scaled(&Complex::from_int(2))]
    });
    let p = a2.clone() * b3.clone() - a3.clone() * b2.clone();
    let q = a2 * c3.clone() - a3 * c2.clone();
    let radius = UPoly::constant(Complex::real(symbol(8)));
    let bracket = q * (b2 * c3 - b3 * c2) + radius.power(2) * p.power(2);
    // (4^4) . theta^4 T / 4, while theta(3) is 8 theta^3 T.
    page.equal(
        "Q (B2 C3 - B3 C2) + l1^2 P^2 = theta . (theta^3 T) / 4, in all eleven symbols",
        &bracket,
        &closed_form(legs).theta(3).shifted(1).scaled(&Complex::from_int(8)),
    );
}

fn the_whole_elimination(page: &mut Page) {
    let legs = symbolic_legs();
    let system = constraint_system(&legs, &[], [1, 2, 3]);
    let plan = sylvester_plan(&legs, &system);
    let steps: String = plan.to_string().lines().map(|line| format!("    {line}\n")).collect();
    page.step(
        "The library's elimination, followed to its end",
        &format!(
            "linkage::sylvester_plan is this chain and removes the two factors by exact division:
{steps}It is followed here over polynomials in symbols, and the result held against linkage::consistency, in all eleven symbols."
        ),
    );
    let eliminant = eliminate(&system, &plan).expect("the plan suits the triad");
    page.equal(
        "theta^3 T = 4 (eliminant), as polynomials in theta and eleven symbols",
        &closed_form(&legs).theta(3),
        &eliminant.polynomial.scaled(&Complex::from_int(32)),
    );
    page.equal(
        "factors removed: coefficient of u in row 2, once; theta, once",
        &removed(&eliminant),
        &vec![("coefficient of u in row 2".to_string(), 1), ("theta".to_string(), 1)],
    );
}

fn planted_poses(page: &mut Page) {
    page.step(
        "Planted poses",
        "A triad is built from a chosen pose with rational cosine, sine and lengths: a_i = B_i - l_i w_i with
w_i a rational direction. T vanishes there, exactly.",
    );
    let mut dice = Dice::new(3);
    let mut vanishing = 0;
    for _ in 0..200 {
        let mut direction = || {
            let (turn, scale) = dice.turn();
            turn.map(|x| Rational::from(x.clone()) / Rational::from(scale.clone()))
        };
        let rotation = direction();
        let ways = [0; 3].map(|_| direction());
        let mut number = || Rational::from(dice.integer(60));
        let pairs = ways.map(|way| {
            let b = Gaussian::new(number(), number());
            let length = number();
            (b.clone(), rotation.clone() * b - way.scaled(&length), length)
        });
        let (b1, a1, _) = pairs[0].clone();
        let legs =
            pairs.map(|(b, a, length)| LegNumbers::Circle { alpha: a - a1.clone(), beta: b - b1.clone(), length });
        vanishing += usize::from(consistency(&legs, &rotation.re, &rotation.im) == Rational::zero());
    }
    page.equal("T = 0 at 200 of 200 planted poses", &vanishing, &200);
}

fn symbol(v: usize) -> Symbolic {
    Poly::term(Integer::ONE, Monomial::variable(v))
}

fn constant(x: &Symbolic) -> Trig<Symbolic> {
    Trig::constant(x.clone())
}

fn imaginary() -> Complex {
    Complex::new(Symbolic::zero(), Symbolic::one())
}

/// Three RR legs: symbols 0..7 are the parts of alpha2, alpha3, beta2, beta3, and 8, 9, 10 are l1, l2, l3.
fn symbolic_legs() -> [LegNumbers<Symbolic>; 3] {
    let point = |v: usize| Complex::new(symbol(v), symbol(v + 1));
    let leg = |alpha, beta, v| LegNumbers::Circle { alpha, beta, length: symbol(v) };
    [leg(Complex::zero(), Complex::zero(), 8), leg(point(0), point(4), 9), leg(point(2), point(6), 10)]
}

fn symbolic_row(legs: &[LegNumbers<Symbolic>; 3], i: usize) -> Row<Trig<Symbolic>> {
    leg_row(&legs[i].map(constant), &constant(&symbol(8)), &Trig::cosine(), &Trig::sine())
}

/// `G = e2 g3 - e3 g2`.
fn mismatch([second, third]: &[Row<Trig<Symbolic>>; 2]) -> Gaussian<Trig<Symbolic>> {
    third.g.scaled(&second.e) - second.g.scaled(&third.e)
}

fn closed_form(legs: &[LegNumbers<Symbolic>; 3]) -> Trig<Symbolic> {
    consistency(&legs.each_ref().map(|leg| leg.map(constant)), &Trig::cosine(), &Trig::sine())
}

/// A polynomial in theta as one in `u`, `v`, `theta`.
fn in_theta(p: &UPoly<Complex>) -> Poly<Complex> {
    p.coefficients()
        .iter()
        .enumerate()
        .fold(Poly::zero(), |sum, (k, c)| sum + Poly::term(c.clone(), Monomial::variable_power(2, k as u32)))
}

fn removed(eliminant: &Eliminant<Complex>) -> Vec<(String, u32)> {
    eliminant.removed.iter().map(|r| (r.factor.name.clone(), r.power)).collect()
}

/// Prints the document.
pub fn main() {
    print!("{}", document());
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_identity_of_the_document_holds() {
        assert!(super::document().contains("8. Planted poses"));
    }
}
