//! Dixon pencils, with the triad's sextic as the determinant of the 6x6 one.
//!
//! `cargo run --release --example dixon_pencils` prints the document; its identities are checked while it is written.

mod dice;
mod page;

use assur::algebra::{Gaussian, Integer, Ring, Trig, UPoly};
use assur::eliminate::{DixonPencil, determinant_bareiss};
use assur::linkage::{LegNumbers, baranov_trusses, consistency};
use dice::Dice;
use page::Page;

type Complex = Gaussian<Integer>;

const OPENING: &str = "\
Claim. l equations c_0 + c_h x + sum_j c_j t_j = 0 and l equations d_0 + d_h / x + sum_j d_j / t_j = 0 in x and
2l - 1 others t_j are solved by the pencil (M0 + x M1) v = 0 of size C(2l, l): every solution makes v, the products of
l - 1 and of l of the t_j, a kernel vector. For l = 2, with a triad's loops and its platform hidden,
    det (M0 + x M1) = l1^2 l2^2 l3^2 x^3 T(x) / 4,
T the triad's sextic: nothing superfluous.

Symbols.  I             a set of unknowns; t^I the product of its members
          c_I           the columns of those unknowns, in ascending order
          [c_0, c_I]    a determinant of l columns
          others as in triad_sextic

Source.   Nielsen and Roth 1999, Wampler 2001; the determinant of the 6x6 case is worked out here.";

fn number(dice: &mut Dice) -> Complex {
    Gaussian::new(dice.integer(1000).into(), dice.integer(1000).into())
}

/// The document, checked line by line while it is made.
pub fn document() -> String {
    let mut page = Page::new("Dixon pencils", OPENING);
    let mut dice = Dice::new(20);
    page.step(
        "Removing l - 1 unknowns",
        "For |I| = l - 1 take the determinant of the l equations' left side, as one column, with the columns c_I. The t_j
with j in I meet their own column and vanish; the rest is linear in x and the other t_j. Times t^I,
    ([c_0, c_I] + x [c_h, c_I]) t^I + sum_{j not in I} [c_j, c_I] t^(I+j) = 0,
linear in the products of l - 1 and of l unknowns. There are C(2l-1, l-1) such rows.",
    );
    page.step(
        "The inverses",
        "For |I| = l let J be the rest, l - 1 unknowns; the same with d_J, times x t^I, is
    (x [d_0, d_J] + [d_h, d_J]) t^I + x sum_{j in I} [d_j, d_J] t^(I-j) = 0.
Together C(2l-1, l-1) + C(2l-1, l) = C(2l, l) rows in as many products: 2, 6, 20, 70 for one to four loops.",
    );
    for (l, size) in [(1usize, 2usize), (2, 6), (3, 20), (4, 70)] {
        // Rotations but for their size; any numbers do, the inverses cleared of denominators.
        let values: Vec<Complex> = (0..2 * l).map(|_| dice.turn().0).collect();
        let whole = values.iter().fold(Complex::one(), |product, v| product * v.clone());
        let cleared: Vec<Complex> = (0..2 * l)
            .map(|k| (0..2 * l).filter(|j| *j != k).fold(Complex::one(), |product, j| product * values[j].clone()))
            .collect();
        let mut rows = |inverse: bool| {
            let row = |_| {
                let coefficients: Vec<Complex> = (0..2 * l).map(|_| number(&mut dice)).collect();
                // Upper: constant = -sum c v. Lower, times the product of all: constant = -sum d whole / v, scale whole.
                let terms = coefficients
                    .iter()
                    .enumerate()
                    .map(|(k, c)| c.clone() * if inverse { cleared[k].clone() } else { values[k].clone() });
                let sum = terms.fold(Complex::zero(), |sum, term| sum + term);
                let scale = if inverse { whole.clone() } else { Complex::one() };
                let mut row = vec![-sum];
                row.extend(coefficients.into_iter().map(|c| c * scale.clone()));
                row
            };
            (0..l).map(row).collect::<Vec<_>>()
        };
        let (upper, lower) = (rows(false), rows(true));
        let pencil = DixonPencil::new(&upper, &lower).expect("l equations of 2l + 1 coefficients");
        let product = |set: &u32| {
            (0..2 * l - 1).filter(|j| set >> j & 1 == 1).fold(Complex::one(), |p, j| p * values[j + 1].clone())
        };
        let vector: Vec<Complex> = pencil.monomials().iter().map(product).collect();
        let vanishes = pencil.constant().iter().zip(pencil.linear()).all(|(m0, m1)| {
            let entries = m0.iter().zip(m1).zip(&vector);
            let terms = entries.map(|((a, b), v)| (a.clone() + values[0].clone() * b.clone()) * v.clone());
            terms.fold(Complex::zero(), |sum, term| sum + term) == Complex::zero()
        });
        let statement =
            format!("eliminate::DixonPencil, l = {l}: size {size}, and a planted solution lies in the kernel");
        page.equal(&statement, &(pencil.monomials().len(), vanishes), &(size, true));
    }
    page.step(
        "The triad",
        "Legs with rotations R_i close where -alpha_i + theta beta_i + l1 R1 - l_i R_i = 0, i = 2, 3: two loops, with x = theta
and three others. The determinant has degree 6 in x and is the sextic of triad_sextic up to a factor. Checked as
polynomials in x at 12 random integer triads; a difference of degree 24 in three-digit integers would vanish at
one with a chance of about 1e-2, at all below 1e-22.",
    );
    let same = (0..12).all(|_| {
        let mut length = || Integer::from(dice.integer(500) + 600);
        let lengths = [length(), length(), length()];
        let zero = Complex::zero;
        let [a2, a3, b2, b3] = [0; 4].map(|_| number(&mut dice));
        let real = |x: &Integer| Gaussian::real(x.clone());
        let upper = [
            vec![-a2.clone(), b2.clone(), real(&lengths[0]), -real(&lengths[1]), zero()],
            vec![-a3.clone(), b3.clone(), real(&lengths[0]), zero(), -real(&lengths[2])],
        ];
        let lower = upper.each_ref().map(|row| row.iter().map(Gaussian::conj).collect::<Vec<_>>());
        let pencil = DixonPencil::new(&upper, &lower).expect("two equations of five coefficients");
        // A determinant of degree 6 at seven points, against the sextic there.
        let leg = |alpha: &Complex, beta: &Complex, k: usize| LegNumbers::Circle {
            alpha: alpha.clone(),
            beta: beta.clone(),
            length: lengths[k].clone(),
        };
        let legs = [leg(&zero(), &zero(), 0), leg(&a2, &b2, 1), leg(&a3, &b3, 2)];
        let lift = |leg: &LegNumbers<Integer>| leg.map(|x| Trig::constant(x.clone()));
        // 8 theta^3 T.
        let sextic: UPoly<Complex> = consistency(&legs.each_ref().map(lift), &Trig::cosine(), &Trig::sine()).theta(3);
        let factor = lengths.iter().fold(Integer::ONE, |product, l| product * l.clone() * l.clone());
        (0..=6).all(|x| {
            let x = Complex::from_int(x - 3);
            let entry = |(a, b): (&Complex, &Complex)| a.clone() + x.clone() * b.clone();
            let rows = pencil.constant().iter().zip(pencil.linear());
            let matrix = rows.map(|(m0, m1)| m0.iter().zip(m1).map(entry).collect()).collect();
            determinant_bareiss(matrix) * Complex::from_int(32) == sextic.evaluate(&x) * real(&factor)
        })
    });
    page.holds("det (M0 + x M1) = l1^2 l2^2 l3^2 (x^3 T) / 4, T = linkage::consistency", same);
    page.step(
        "More loops",
        "For three and four loops the determinant has a few roots that belong to no solution, and for special numbers or a special choice of
the hidden unknown it vanishes identically. Both are settled by measuring what is lifted, and by hiding another link.
The catalogue says how many solutions there have to be:",
    );
    for links in [5, 7, 9] {
        let counts: Vec<usize> = baranov_trusses().filter(|truss| truss.links == links).map(|t| t.count).collect();
        let (least, most) = (counts.iter().min(), counts.iter().max());
        let (Some(least), Some(most)) = (least, most) else { continue };
        page.holds(
            &format!("{links} links: {} trusses with {least} to {most} solutions", counts.len()),
            counts.iter().all(|count| count.is_multiple_of(2)),
        );
    }
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
        assert!(super::document().contains("4. More loops"));
    }
}
