//! The degree table of the twenty triads.
//!
//! `cargo run --release --example degree_table` prints the document; its identities are checked while it is written.

mod dice;
mod page;

use assur::algebra::{Domain, Gaussian, Integer, Monomial, Poly, Ring, Trig, UPoly};
use assur::linkage::{
    LegNumbers, RotationNumbers, Row, Rows, consistency, constraint_system, sylvester_plan, triad_rows,
};
use assur::solve::Outcome;
use assur::{Eliminant, eliminate, triad_degree};
use dice::Dice;
use page::Page;

type Symbolic = Poly<Integer>;

/// Triads without PP: the dyads, order K of T, naive degree in t, exponent of 1+t^2 in it.
const TURNING: [([&str; 3], usize, usize, usize); 10] = [
    (["RR", "RR", "RR"], 3, 8, 1),
    (["RR", "RR", "PR"], 3, 8, 1),
    (["RR", "RR", "RP"], 3, 8, 1),
    (["RR", "PR", "PR"], 2, 8, 2),
    (["RR", "PR", "RP"], 3, 8, 1),
    (["RR", "RP", "RP"], 2, 8, 2),
    (["PR", "PR", "PR"], 1, 6, 2),
    (["PR", "PR", "RP"], 2, 6, 1),
    (["PR", "RP", "RP"], 2, 6, 1),
    (["RP", "RP", "RP"], 1, 6, 2),
];

/// Triads with PP: the dyads that are not PP, and the degree in v.
const GIVEN: [(&[&str], usize); 10] = [
    (&["RR", "RR"], 2),
    (&["RR", "PR"], 2),
    (&["RR", "RP"], 2),
    (&["PR", "PR"], 1),
    (&["PR", "RP"], 1),
    (&["RP", "RP"], 1),
    (&["RR"], 0),
    (&["PR"], 0),
    (&["RP"], 0),
    (&[], 0),
];

/// Size of the random integers.
const SIZE: u32 = 1000;

/// Primes tried for the factor patterns.
const PRIMES: std::ops::Range<u64> = 5..400;

const OPENING: &str = "\
Claim. A triad without PP has T(phi) of the order K below, hence 2K finite assemblies, real and complex.
Cleared row by row with 1+t^2, t = tan(phi/2), it has the naive degree below and the extraneous factor
(1+t^2)^k; the core left after it has degree 2K and cannot be factored over the rationals, so no
elimination in t has a lower degree. With one PP the orientation is given, and a line meets a circle or
a line; with two or three PP there is no assembly, unless the given orientations agree.

Symbols.  theta, t      e^(i phi), tan(phi/2)
          K             order of T, the largest k with cos(k phi) or sin(k phi) in it
          g_i, e_i      row g_i . u + e_i = 0 of leg i, u the place of leg 1's platform point
          D             g2 x g3, the determinant of two rows
          core          (1+t^2)^K T, a polynomial in t

Source.   Worked out here; the rows are those of linkage::triad.";

/// The document, checked line by line while it is made.
pub fn document() -> String {
    let mut page = Page::new("The degrees of the twenty triads", OPENING);
    orders(&mut page);
    naive_degrees(&mut page);
    finite_assemblies(&mut page);
    cores_are_irreducible(&mut page);
    given_orientations(&mut page);
    inversion(&mut page);
    the_library(&mut page);
    page.finish()
}

fn orders(page: &mut Page) {
    page.step(
        "The order of T, in symbols",
        "With an RR leg, T = |e2 g3 - e3 g2|^2 - l1^2 D^2; without, T = e1 g2 x g3 + e2 g3 x g1 + e3 g1 x g2.
In theta a row reaches
    RR    g from 0 to 1    e from -1 to 1
    PR    g only 0         e from -1 to 1
    RP    g only 1         e from -1 to 1
so e_i g_j reaches from -1 to 2, three steps and not four, and |e2 g3 - e3 g2|^2 has order 3 at most;
two steps and order 2 where legs 2 and 3 are both PR (-1 to 1) or both RP (0 to 2). g_i x g_j has order 1
at most, and 0 for two PR or two RP: D^2 stays below, and three lines give order 1 + 1, or 1 + 0 where all
are alike. T is expanded with every
number of the legs a symbol: the order is a bound for every triad, and met by nearly every one.",
    );
    for (dyads, order, ..) in TURNING {
        let t = closed_form(&symbolic_legs(dyads));
        page.equal(&format!("{}: T has order {order}", dyads.join("-")), &t.order(), &order);
    }
}

fn naive_degrees(page: &mut Page) {
    page.step(
        "The naive degree in t",
        "Every row, multiplied by 1+t^2, is a polynomial in t of degree 2. T made of these has four rows as
factors, or three: degree 8 or 6. Since T has order K, that is (1+t^2)^(4-K) or (1+t^2)^(3-K) times the
core (derivation charts, step 4). The division is carried out at seeded random legs: the power is exact,
for (1+t^2)^(k+1) does not divide.",
    );
    let mut dice = Dice::new(11);
    let circle = UPoly::new([1, 0, 1].map(Integer::from).to_vec());
    for (dyads, order, naive, extraneous) in TURNING {
        let legs = random_legs(dyads, &mut dice);
        let mut rest = cleared_by_rows(&legs);
        let mut found = (rest.degree(), 0);
        while let Some(quotient) = rest.exact_div(&circle) {
            rest = quotient;
            found.1 += 1;
        }
        page.equal(
            &format!(
                "{}: degree {naive}, divided by (1+t^2)^{extraneous}: the core, degree {}",
                dyads.join("-"),
                2 * order
            ),
            &(found, rest.degree(), rest),
            &((Some(naive), extraneous), Some(2 * order), closed_form(&legs).half_angle(order)),
        );
    }
}

fn finite_assemblies(page: &mut Page) {
    page.step(
        "2K finite assemblies",
        "A root of the core gives an assembly, u from two rows, wherever some g_i x g_j is not zero there; and
one only. At seeded random legs the core has no multiple root and no root in common with all of the
g_i x g_j, so there are exactly 2K different finite assemblies. 1+t^2 does not divide the core: none of
them has run to theta = 0 or infinity. All three are open conditions: met at one triad, they are met at
nearly every one.",
    );
    let mut dice = Dice::new(12);
    for (dyads, order, ..) in TURNING {
        let legs = random_legs(dyads, &mut dice);
        let core = closed_form(&legs).half_angle(order);
        let crosses = crosses(&legs)
            .into_iter()
            .fold(UPoly::zero(), |common: UPoly<Integer>, cross| common.gcd(&cross.half_angle(cross.order())));
        page.equal(
            &format!("{}: {} different finite assemblies", dyads.join("-"), 2 * order),
            &(core.degree(), core.gcd(&core.derivative()), core.gcd(&crosses)),
            &(Some(2 * order), UPoly::one(), UPoly::one()),
        );
    }
}

fn cores_are_irreducible(page: &mut Page) {
    page.step(
        "No lower degree will do",
        "A factor over the rationals would have, modulo every prime that keeps the core's degree and leaves it
without multiple factor, a degree that is a sum of factor degrees modulo that prime. The primes listed
leave no such sum but 0 and 2K, so the core at the random legs of step 3 is irreducible. Then so is the
core with symbols for the numbers: its degree does not drop at the random legs, so a factorisation into
parts that both hold t would carry over. A
polynomial over the rationals with one assembly's t for a root has all 2K.",
    );
    let mut dice = Dice::new(12);
    for (dyads, order, ..) in TURNING {
        let core = closed_form(&random_legs(dyads, &mut dice)).half_angle(order).primitive();
        let (primes, sums) = possible_factor_degrees(&core);
        let shown: Vec<String> = primes.iter().map(|(p, degrees)| format!("{p}: {}", plus(degrees))).collect();
        page.equal(&format!("{}: degrees mod {}", dyads.join("-"), shown.join(", mod ")), &sums, &vec![0, 2 * order]);
    }
}

fn given_orientations(page: &mut Page) {
    page.step(
        "With PP the orientation is given",
        "A PP leg is w theta = c + i s. Put into the rows it leaves a circle and a line, or two lines, in u and
v: degree 2 or 1. Two PP legs are two equations in theta alone; their resultant is a constant, not
zero unless the orientations agree. Worked out by linkage::sylvester_plan at seeded random legs.",
    );
    let mut dice = Dice::new(13);
    for (dyads, degree) in GIVEN {
        let legs: Vec<_> = (0..dyads.len()).map(|i| numeric(&symbolic_leg(dyads, i), &mut dice)).collect();
        let rotations: Vec<_> = (dyads.len()..3).map(|_| rotation(&mut dice)).collect();
        let name = [dyads, &["PP"; 3][dyads.len()..]].concat();
        let eliminant = follow(&legs, &rotations);
        let outcome = if degree == 0 { Outcome::NoFiniteSolution } else { Outcome::Roots { at_infinity: 0 } };
        page.equal(
            &format!("{}: degree {degree}", name.join("-")),
            &(eliminant.polynomial.degree(), eliminant.outcome(), triad_degree(&name)),
            &(Some(degree), outcome, Some(degree)),
        );
        if let [first, ..] = &rotations[1..] {
            let agreeing = vec![first.clone(); rotations.len()];
            page.equal(
                "the same with equal orientations: the resultant vanishes, the platform can move",
                &follow(&legs, &agreeing).polynomial,
                &UPoly::zero(),
            );
        }
    }
}

fn inversion(page: &mut Page) {
    page.step(
        "Base and platform exchanged",
        "Seen from the platform, the base moves: phi becomes -phi, a and b change places, RR stays RR, PR
becomes RP and RP becomes PR, with delta = s |m|^2 as a shift of the line by s m. Every row turns by
-phi, e into -e: T is the same function, or its negative where there are three lines. So each entry
of the table equals the one with PR and RP exchanged. In symbols:",
    );
    for (dyads, order, ..) in TURNING {
        let legs = symbolic_legs_with_shifts(dyads);
        let inverted = inverse(dyads);
        let seen = consistency(
            &[0, 1, 2].map(|i: usize| inverted_leg(&legs[i], i).map(|x| Trig::constant(x.clone()))),
            &Trig::cosine(),
            &-Trig::<Symbolic>::sine(),
        );
        let (sign, shown) = if dyads[0] == "RR" { (1, "T") } else { (-1, "-T") };
        page.equal(
            &format!("{} as {}: T(-phi) = {shown}(phi)", dyads.join("-"), inverted.join("-")),
            &(seen, Some(2 * order)),
            &(Trig::from_int(sign) * closed_form(&legs), triad_degree(&inverted)),
        );
    }
}

fn the_library(page: &mut Page) {
    page.step(
        "The library",
        "triad_degree holds the finite assemblies of all twenty triads, and the chain of Sylvester resultants
leaves the core itself, in theta: (2 theta)^K T up to a constant, with its named factors removed.",
    );
    let mut dice = Dice::new(14);
    let mut table = String::from("group        K  assemblies  naive degree in t  extraneous   core");
    for (dyads, order, naive, extraneous) in TURNING {
        let legs = random_legs(dyads, &mut dice);
        let (left, right) = (follow(&legs, &[]).polynomial, closed_form(&legs).theta(order));
        let leading = |p: &UPoly<Gaussian<Integer>>| p.leading().expect("not zero").clone();
        assert_eq!(left.scaled(&leading(&right)), right.scaled(&leading(&left)), "{dyads:?}");
        assert_eq!(triad_degree(&dyads), Some(2 * order), "{dyads:?}");
        table += &format!(
            "\n{:<12} {order}  {:>10}  {naive:>17}  (1+t^2)^{extraneous:<4} {:>4}",
            dyads.join("-"),
            2 * order,
            2 * order
        );
    }
    for (dyads, degree) in GIVEN {
        let name = [dyads, &["PP"; 3][dyads.len()..]].concat();
        table += &format!("\n{:<12} -  {degree:>10}", name.join("-"));
    }
    page.holds(&table, TURNING.len() + GIVEN.len() == 20);
}

/// The numbers of leg `i`: symbols `8 i .. 8 i + 7`. The first leg is the reference.
fn symbolic_leg(dyads: &[&str], i: usize) -> LegNumbers<Symbolic> {
    let symbol = |k: usize| Poly::term(Integer::ONE, Monomial::variable(8 * i + k));
    let point = |k: usize| Gaussian::new(symbol(k), symbol(k + 1));
    let (alpha, beta) = if i == 0 { (Gaussian::zero(), Gaussian::zero()) } else { (point(0), point(2)) };
    match dyads[i] {
        "RR" => LegNumbers::Circle { alpha, beta, length: symbol(6) },
        "PR" => LegNumbers::Line { alpha, beta, normal: point(4) },
        _ => LegNumbers::PlatformLine { alpha, beta, normal: point(4), delta: symbol(7) },
    }
}

fn symbolic_legs(dyads: [&str; 3]) -> [LegNumbers<Symbolic>; 3] {
    [0, 1, 2].map(|i| symbolic_leg(&dyads, i))
}

/// The same, an RP leg's `delta` written as `s |m|²`, the line shifted by `s m`.
fn symbolic_legs_with_shifts(dyads: [&str; 3]) -> [LegNumbers<Symbolic>; 3] {
    symbolic_legs(dyads).map(|leg| match leg {
        LegNumbers::PlatformLine { alpha, beta, normal, delta } => {
            let delta = delta * normal.norm_sqr();
            LegNumbers::PlatformLine { alpha, beta, normal, delta }
        }
        other => other,
    })
}

/// The leg seen from the platform; `i` numbers its symbols.
fn inverted_leg(leg: &LegNumbers<Symbolic>, i: usize) -> LegNumbers<Symbolic> {
    match leg.clone() {
        LegNumbers::Circle { alpha, beta, length } => LegNumbers::Circle { alpha: beta, beta: alpha, length },
        LegNumbers::Line { alpha, beta, normal } => {
            LegNumbers::PlatformLine { alpha: beta, beta: alpha, normal, delta: Symbolic::zero() }
        }
        LegNumbers::PlatformLine { alpha, beta, normal, .. } => {
            let shift = Poly::term(Integer::ONE, Monomial::variable(8 * i + 7));
            LegNumbers::Line { alpha: beta + normal.scaled(&shift), beta: alpha, normal }
        }
    }
}

fn inverse(dyads: [&str; 3]) -> [&str; 3] {
    dyads.map(|dyad| match dyad {
        "PR" => "RP",
        "RP" => "PR",
        other => other,
    })
}

/// The leg with a random integer for every symbol.
fn numeric(leg: &LegNumbers<Symbolic>, dice: &mut Dice) -> LegNumbers<Integer> {
    let values: Vec<Integer> = (0..24).map(|_| Integer::from(dice.integer(SIZE))).collect();
    leg.map(|x| x.evaluate(Clone::clone, &values))
}

fn random_legs(dyads: [&str; 3], dice: &mut Dice) -> [LegNumbers<Integer>; 3] {
    symbolic_legs(dyads).map(|leg| numeric(&leg, dice))
}

fn rotation(dice: &mut Dice) -> RotationNumbers<Integer> {
    let (turn, scale) = dice.turn();
    RotationNumbers { turn, scale }
}

fn closed_form<R: Ring>(legs: &[LegNumbers<R>; 3]) -> Trig<R> {
    consistency(&legs.each_ref().map(|leg| leg.map(|x| Trig::constant(x.clone()))), &Trig::cosine(), &Trig::sine())
}

fn rows(legs: &[LegNumbers<Integer>; 3]) -> Rows<Trig<Integer>> {
    let legs = legs.each_ref().map(|leg| leg.map(|x| Trig::constant(x.clone())));
    triad_rows(&legs, &Trig::cosine(), &Trig::sine())
}

/// T made of rows that were each multiplied by `1+t²`.
fn cleared_by_rows(legs: &[LegNumbers<Integer>; 3]) -> UPoly<Integer> {
    let clear = |row: &Row<Trig<Integer>>| Row {
        g: Gaussian::new(row.g.re.half_angle(1), row.g.im.half_angle(1)),
        e: row.e.half_angle(1),
    };
    match rows(legs) {
        Rows::Circle { radius, rows } => {
            let [second, third] = rows.each_ref().map(clear);
            let cross = second.cross(&third);
            second.mismatch(&third).norm_sqr() - radius.half_angle(0).power(2) * cross.power(2)
        }
        Rows::Lines(rows) => {
            let [first, second, third] = rows.each_ref().map(clear);
            first.e.clone() * second.cross(&third)
                + second.e.clone() * third.cross(&first)
                + third.e.clone() * first.cross(&second)
        }
    }
}

/// The determinants of two rows from which `u` can be found.
fn crosses(legs: &[LegNumbers<Integer>; 3]) -> Vec<Trig<Integer>> {
    match rows(legs) {
        Rows::Circle { rows: [second, third], .. } => vec![second.cross(&third)],
        Rows::Lines([first, second, third]) => vec![first.cross(&second), second.cross(&third), third.cross(&first)],
    }
}

fn follow(legs: &[LegNumbers<Integer>], rotations: &[RotationNumbers<Integer>]) -> Eliminant<Gaussian<Integer>> {
    let system = constraint_system(legs, rotations, [1, 2, 3]);
    eliminate(&system, &sylvester_plan(legs, &system)).expect("the plan suits every triad")
}

fn plus(degrees: &[usize]) -> String {
    degrees.iter().map(usize::to_string).collect::<Vec<_>>().join("+")
}

/// The primes that narrowed the choice, each with the factor degrees modulo it, and the degrees a factor over the rationals can have.
fn possible_factor_degrees(f: &UPoly<Integer>) -> (Vec<(u64, Vec<usize>)>, Vec<usize>) {
    let degree = f.degree().expect("not zero");
    // Bit d is set where degree d is possible.
    let mut possible = (1_u32 << (degree + 1)) - 1;
    let trivial = 1 | 1 << degree;
    let mut used = Vec::new();
    for p in PRIMES.filter(|&p| (2..p).take_while(|d| d * d <= p).all(|d| p % d != 0)) {
        let Some(degrees) = factor_degrees(f, p) else { continue };
        let sums = degrees.iter().fold(1_u32, |sums, &d| sums | sums << d);
        if possible & sums != possible {
            possible &= sums;
            used.push((p, degrees));
        }
        if possible == trivial {
            break;
        }
    }
    (used, (0..=degree).filter(|d| possible >> d & 1 == 1).collect())
}

/// The degrees of the irreducible factors modulo `p`, by distinct degrees; `None` where the degree drops or a factor is repeated.
///
/// The factors of degree d are those of `x^(p^d) - x` that no smaller d has.
fn factor_degrees(f: &UPoly<Integer>, p: u64) -> Option<Vec<usize>> {
    let field = Field(p);
    let image = |c: &Integer| {
        let residue = i64::try_from(c.clone() % Integer::from(p)).expect("below the prime");
        residue.rem_euclid(p as i64) as u64
    };
    let mut rest: Vec<u64> = f.coefficients().iter().map(image).collect();
    if rest.last() == Some(&0) {
        return None;
    }
    let derivative = rest.iter().zip(0..).skip(1).map(|(&c, k)| c * k % p).collect();
    if field.gcd(rest.clone(), trimmed(derivative)).len() > 1 {
        return None;
    }
    let mut degrees = Vec::new();
    let mut power = vec![0, 1];
    for d in 1.. {
        if rest.len() == 1 {
            break;
        }
        power = field.power(&field.remainder(power, &rest), p, &rest);
        let mut less = power.clone();
        less.resize(less.len().max(2), 0);
        less[1] = (less[1] + p - 1) % p;
        let part = field.gcd(rest.clone(), trimmed(less));
        degrees.extend(std::iter::repeat_n(d, (part.len() - 1) / d));
        rest = field.quotient(rest, &part);
    }
    Some(degrees)
}

fn trimmed(mut f: Vec<u64>) -> Vec<u64> {
    while f.last() == Some(&0) {
        f.pop();
    }
    f
}

/// Polynomials modulo a small prime, coefficients ascending, leading one not zero.
struct Field(u64);

impl Field {
    fn inverse(&self, a: u64) -> u64 {
        (1..self.0).find(|b| a * b % self.0 == 1).expect("not zero modulo a prime")
    }

    /// Quotient and remainder of `f` by `g`.
    fn divided(&self, mut f: Vec<u64>, g: &[u64]) -> (Vec<u64>, Vec<u64>) {
        let inverse = self.inverse(*g.last().expect("divisor is not zero"));
        let mut quotient = vec![0; (f.len() + 1).saturating_sub(g.len())];
        while f.len() >= g.len() {
            let offset = f.len() - g.len();
            let factor = f[f.len() - 1] * inverse % self.0;
            for (c, d) in f[offset..].iter_mut().zip(g) {
                *c = (*c + self.0 - factor * d % self.0) % self.0;
            }
            quotient[offset] = factor;
            f = trimmed(f);
        }
        (trimmed(quotient), f)
    }

    fn quotient(&self, f: Vec<u64>, g: &[u64]) -> Vec<u64> {
        self.divided(f, g).0
    }

    fn remainder(&self, f: Vec<u64>, g: &[u64]) -> Vec<u64> {
        self.divided(f, g).1
    }

    fn gcd(&self, mut f: Vec<u64>, mut g: Vec<u64>) -> Vec<u64> {
        while !g.is_empty() {
            (f, g) = (g.clone(), self.remainder(f, &g));
        }
        f
    }

    /// `f^n` modulo `g`.
    fn power(&self, f: &[u64], n: u64, g: &[u64]) -> Vec<u64> {
        (0..n).fold(self.remainder(vec![1], g), |product, _| {
            if product.is_empty() || f.is_empty() {
                return Vec::new();
            }
            let mut out = vec![0; product.len() + f.len() - 1];
            for (i, a) in product.iter().enumerate() {
                for (j, b) in f.iter().enumerate() {
                    out[i + j] = (out[i + j] + a * b) % self.0;
                }
            }
            self.remainder(trimmed(out), g)
        })
    }
}

/// Prints the document.
pub fn main() {
    print!("{}", document());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_identity_of_the_document_holds() {
        assert!(document().contains("7. The library"));
    }

    #[test]
    fn factor_degrees_are_those_of_known_products() {
        let p = |c: &[i64]| UPoly::new(c.iter().map(|&x| Integer::from(x)).collect());
        // x^2 + 1 is irreducible mod 7 and splits mod 5; x^2 (x + 1) has a repeated factor.
        assert_eq!(factor_degrees(&p(&[1, 0, 1]), 7), Some(vec![2]));
        assert_eq!(factor_degrees(&p(&[1, 0, 1]), 5), Some(vec![1, 1]));
        assert_eq!(factor_degrees(&p(&[0, 0, 1, 1]), 5), None);
        let product = p(&[1, 0, 1]) * p(&[-3, 0, 0, 1]);
        assert!(possible_factor_degrees(&product).1.contains(&2));
    }
}
