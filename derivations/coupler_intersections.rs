//! Why two coupler curves meet in 18 points, and when in fewer.
//!
//! `cargo run --release --example coupler_intersections` prints the document; its counts are checked while it is written.

mod page;

use assur::linkage::{CouplerCurve, Partner};
use assur::nalgebra::Vector2;
use page::Page;

const OPENING: &str = "\
Claim. Two four-bar coupler curves meet in 18 finite points, real and complex, with multiplicity. Each focus
they share takes two of them to infinity: 16, 14, 12. Where all three are shared and the first cranks have the
same length as well, 10 remain. A line or circle meets one in six, a circle about a focus in four.

Symbols.  F, G          the curves' equations, of degree 3 in z and in w = z'
          a, b, c       the foci of F: pivots, and (a q - b p) / (q - p)

Source.   The product of two projective lines for the count; the table of special cases was found by
          Groebner bases modulo a prime, and is recounted here by resultants modulo another.";

/// Pivots, guided points and cranks.
type Numbers = ([[f64; 2]; 2], [[f64; 2]; 2], [f64; 2]);

const FIRST: Numbers = ([[0.0, 0.0], [4.0, 1.0]], [[-1.0, -1.5], [2.0, -1.0]], [2.0, 3.5]);

fn curve((pivots, arms, radii): Numbers) -> CouplerCurve {
    CouplerCurve::four_bar(pivots, arms, radii).expect("sound numbers")
}

/// Finite intersections and those at infinity.
fn count(other: Numbers) -> (usize, usize) {
    let found = curve(FIRST).meet(&Partner::Coupler(curve(other))).expect("sound numbers").account;
    assert!(found.adds_up() && found.undecided == 0, "{found:?}");
    (found.real + found.complex, found.at_infinity)
}

fn meet(partner: &Partner) -> (usize, usize) {
    let found = curve(FIRST).meet(partner).expect("sound numbers").account;
    assert!(found.adds_up() && found.undecided == 0, "{found:?}");
    (found.real + found.complex, found.at_infinity)
}

/// The document, checked line by line while it is made.
pub fn document() -> String {
    let mut page = Page::new("Where two coupler curves meet", OPENING);
    let (pivots, arms, radii) = FIRST;
    let general: Numbers = ([[1.0, 2.0], [-3.0, 0.5]], [[0.5, 1.0], [1.5, -2.0]], [2.5, 3.0]);
    page.step(
        "Eighteen",
        "z and w are independent complex numbers, each with its own infinity: two curves of bidegree (3, 3) meet in
3.3 + 3.3 = 18 points of the product of two lines. In the plane Bezout says 36; both curves pass three times through
both circular points, which takes 2 . 3.3 away. At z = infinity F reduces to its leading row, whose roots are the
conjugates of its foci, and w = infinity is never a root of that; so unless a focus is shared, all 18 are finite.",
    );
    page.equal("general four-bars: 18 finite, 0 at infinity", &count(general), &(18, 0));
    page.step(
        "Shared foci",
        "A focus that F and G share is a common point at z = infinity, and by conjugation its mirror image at w =
infinity: two intersections less. Directly similar coupler triangles on the same pivots share the third focus as
well.",
    );
    let one = ([pivots[0], [-3.0, 0.5]], general.1, general.2);
    page.equal("one pivot shared: 16 and 2", &count(one), &(16, 2));
    page.equal("both pivots shared: 14 and 4", &count((pivots, general.1, general.2)), &(14, 4));
    // The triangle turned by a quarter and doubled.
    let similar = arms.map(|[x, y]| [-2.0 * y, 2.0 * x]);
    page.equal("pivots and shape of the coupler shared: 12 and 6", &count((pivots, similar, general.2)), &(12, 6));
    page.step(
        "A tangent at infinity",
        "With the same triangle the two curves have the same tangents at the circular points. If r is the same as well,
they touch there once more on the branch of the first pivot: two more intersections go to infinity.",
    );
    page.equal("the same triangle and r: 10 and 8", &count((pivots, arms, [radii[0], 3.0])), &(10, 8));
    page.equal("the same triangle, another r and s: 12 and 6", &count((pivots, arms, [2.25, 3.0])), &(12, 6));
    page.step(
        "Lines and circles",
        "On a line z = p + u t, w = p' + u' t the equation has degree 6 in t, on a circle z = o + rho tau, w = o' + rho/tau
it runs from tau^-3 to tau^3. The ends are F's leading row and column at w = o': zero where o is a focus.",
    );
    let line = Partner::Line { point: Vector2::new(0.5, 1.0), direction: Vector2::new(1.0, 0.25) };
    let circle = |center: [f64; 2]| Partner::Circle { center: center.into(), radius: 2.5 };
    page.equal("a line: 6 and 0", &meet(&line), &(6, 0));
    page.equal("a circle: 6 and 0", &meet(&circle([1.0, 1.0])), &(6, 0));
    page.equal("a circle about a focus: 4 and 2", &meet(&circle(pivots[1])), &(4, 2));
    page.finish()
}

/// Prints the document.
pub fn main() {
    print!("{}", document());
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_count_of_the_document_holds() {
        assert!(super::document().contains("4. Lines and circles"));
    }
}
