//! A system with no mechanism in it: three quadrics in cyclic pairs, solved completely by two resultants.
//!
//! `cargo run --release --example three_quadrics`

use assur::algebra::{Integer, Poly, Ring};
use assur::solve::show_polynomial;
use assur::{Plan, System, eliminate, lift};

fn main() -> Result<(), assur::SolveError> {
    let [s1, s2, s3] = [0, 1, 2].map(Poly::<Integer>::variable);
    let quadric = |x: &Poly<Integer>, y: &Poly<Integer>, [a, b, c, d, e, f]: [i64; 6]| {
        let n = Poly::from_int;
        n(a) * x.power(2)
            + n(b) * x.clone() * y.clone()
            + n(c) * y.power(2)
            + n(d) * x.clone()
            + n(e) * y.clone()
            + n(f)
    };
    let system = System::new(["s1", "s2", "s3"])
        .with("Q12", quadric(&s1, &s2, [1, 1, 2, -3, 1, -6]))
        .with("Q23", quadric(&s2, &s3, [2, -1, 1, 1, -2, -5]))
        .with("Q31", quadric(&s3, &s1, [1, -2, 1, -1, 3, -8]));
    println!("{system}\n");

    let plan =
        Plan::new("s2").resultant("F23", ("Q12", "Q31"), "s1").resultant("octic", ("F23", "Q23"), "s3").of_degree(8);
    println!("{plan}\n");

    let eliminant = eliminate(&system, &plan)?;
    if let Some(octic) = eliminant.polynomial_called("octic") {
        println!("octic: {} = 0", show_polynomial(octic, system.variables()));
    }
    match eliminant.removed.as_slice() {
        [] => println!("removed factors: none, the octic is the eliminant itself\n"),
        removed => removed.iter().for_each(|r| println!("removed: ({})^{}", r.factor.name, r.power)),
    }

    let found = lift(&system, &plan, &eliminant)?;
    println!("{:>34} {:>34} {:>34}   residual", "s1", "s2", "s3");
    for solution in &found.solutions {
        for value in &solution.values {
            print!("{:>34} ", if solution.real { format!("{:.15}", value.re) } else { format!("{value:.12}") });
        }
        println!("  {:.0e}", solution.residual);
    }
    let account = found.account;
    println!(
        "\n{} real + {} complex + {} rejected + {} at infinity = {}",
        account.real, account.complex, account.rejected, account.at_infinity, account.degree
    );
    Ok(())
}
