//! The generic engine on systems with no mechanism in them: every solution found, and the account adds up.

use assur::algebra::{Gaussian, Integer, Monomial, Poly, Rational, Ring};
use assur::num_complex::Complex64;
use assur::solve::ToComplex;
use assur::{Outcome, Plan, RootRejection, Solutions, System, solve};
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, RngSeed};

type P = Poly<Rational>;

/// The seed of the properties here.
const SEED: u64 = 20_030_807;

/// The same cases every time; `ENGINE_CASES` sets how many, `ENGINE_SEED` which.
fn cases(count: u32) -> ProptestConfig {
    let set = |name: &str| std::env::var(name).ok().and_then(|value| value.parse::<u64>().ok());
    let seed = set("ENGINE_SEED").unwrap_or(SEED);
    println!("seed {seed}");
    ProptestConfig {
        cases: set("ENGINE_CASES").map_or(count, |cases| cases as u32),
        rng_algorithm: RngAlgorithm::ChaCha,
        rng_seed: RngSeed::Fixed(seed),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

fn n(value: i64) -> P {
    P::from_int(value)
}

fn xyz() -> [P; 3] {
    [0, 1, 2].map(P::variable)
}

fn solved<C: ToComplex>(system: &System<C>, plan: &Plan<C>) -> Solutions {
    let found = solve(system, plan).unwrap();
    assert!(found.account.adds_up(), "{:?}", found.account);
    assert!(found.worst_residual() < 1e-11);
    let listed: usize = found.solutions.iter().map(|s| s.multiplicity).sum();
    assert_eq!(listed, found.account.real + found.account.complex);
    found
}

/// `s_i² + a s_i s_j + b s_j² + c s_i + d s_j + e` in the cyclic pairs.
fn three_quadrics(coefficients: &[[i64; 6]; 3]) -> System<Rational> {
    let mut system = System::new(["s1", "s2", "s3"]);
    for (k, c) in coefficients.iter().enumerate() {
        let (i, j) = (k, (k + 1) % 3);
        let powers = [(2, 0), (1, 1), (0, 2), (1, 0), (0, 1), (0, 0)];
        let quadric = powers.iter().zip(c).fold(P::zero(), |sum, (&(p, q), &c)| {
            let monomial = Monomial::variable_power(i, p) * Monomial::variable_power(j, q);
            sum + Poly::term(Rational::from(c) * Rational::from_parts(1.into(), 7u8.into()), monomial)
        });
        system.add(format!("quadric {}", k + 1), quadric);
    }
    system
}

/// The quadrics with their constants chosen so that a point lies on all three, and squares that keep the variables in.
fn through(mut c: [[i64; 6]; 3], at: [i64; 3]) -> [[i64; 6]; 3] {
    for (k, quadric) in c.iter_mut().enumerate() {
        (quadric[0], quadric[2]) = (quadric[0].max(1), quadric[2].min(-1));
        let (s, t) = (at[k], at[(k + 1) % 3]);
        let [a, b, d, e, f, _] = *quadric;
        quadric[5] = -(a * s * s + b * s * t + d * t * t + e * s + f * t);
    }
    c
}

fn octic() -> Plan<Rational> {
    Plan::new("s2").resultant("F23", ("quadric 1", "quadric 3"), "s1").resultant("octic", ("F23", "quadric 2"), "s3")
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn three_random_quadrics_have_eight_solutions(c in prop::array::uniform3(prop::array::uniform6(1i64..40)), signs in 0u32..1 << 18) {
        let mut c = c;
        for (bit, entry) in c.iter_mut().flatten().enumerate() {
            if signs >> bit & 1 == 1 {
                *entry = -*entry;
            }
        }
        let found = solve(&three_quadrics(&c), &octic()).unwrap();
        prop_assert_eq!(found.account.degree, 8);
        prop_assert!(found.account.adds_up());
        prop_assert_eq!(found.account.real + found.account.complex, 8, "{:?}", found);
        prop_assert!(found.worst_residual() < 1e-11);
    }

    /// Three quadrics through a rational point have it among their solutions.
    #[test]
    fn planted_solutions_come_back(c in prop::array::uniform3(prop::array::uniform6(-9i64..10)), at in prop::array::uniform3(-5i64..6)) {
        let c = through(c, at);
        let found = solve(&three_quadrics(&c), &octic()).unwrap();
        prop_assert!(found.account.adds_up());
        if found.account.undecided + found.account.self_motion == 0 {
            let near = |s: &assur::Solution| s.values.iter().zip(&at).all(|(z, &x)| (z - x as f64).norm() < 1e-5);
            prop_assert!(found.solutions.iter().any(near), "{:?} {:?}", at, found);
        }
    }
}

#[test]
fn circle_and_line_by_position() {
    let [x, y, _] = xyz();
    let plan = Plan::new("y").resultant("meet", ("circle", "line"), "x");
    for (height, real, complex) in [(0, 2, 0), (6, 0, 2)] {
        let system =
            System::new(["x", "y"]).with("circle", x.power(2) + y.power(2) - n(25)).with("line", x.clone() - n(height));
        let found = solved(&system, &plan);
        assert_eq!((found.account.real, found.account.complex, found.account.degree), (real, complex, 2));
    }
    // A tangent: one solution of multiplicity two.
    let system = System::new(["x", "y"]).with("circle", x.power(2) + y.power(2) - n(25)).with("line", x - n(5));
    let found = solved(&system, &plan);
    assert_eq!(found.solutions.len(), 1);
    assert_eq!((found.solutions[0].multiplicity, found.solutions[0].real), (2, true));
}

#[test]
fn two_solutions_above_one_root() {
    // y = 0 carries x = 3 and x = -3: a simple solution each, the root double, the corank two.
    let [x, y, _] = xyz();
    let system = System::new(["x", "y"])
        .with("f", x.power(2) + y.power(2) - n(9))
        .with("g", x.power(2) + n(4) * y.power(2) + y.clone() - n(9));
    let found = solved(&system, &Plan::new("y").resultant("r", ("f", "g"), "x"));
    assert_eq!((found.account.degree, found.account.real), (4, 4));
    assert!(found.solutions.iter().all(|s| s.multiplicity == 1));
    let above_zero = found.solutions.iter().filter(|s| s.values[1].norm() < 1e-12).count();
    assert_eq!(above_zero, 2);
}

#[test]
fn two_circles_lose_two_solutions_to_infinity() {
    let [x, y, _] = xyz();
    let system = System::new(["x", "y"])
        .with("c1", x.power(2) + y.power(2) - n(4))
        .with("c2", (x - n(3)).power(2) + y.power(2) - n(4));
    let found = solved(&system, &Plan::new("y").resultant("r", ("c1", "c2"), "x").of_degree(4));
    assert_eq!((found.account.real, found.account.at_infinity), (2, 2));
    assert!((found.solutions[0].values[0] - 1.5).norm() < 1e-14);
}

#[test]
fn katsura_2() {
    // x + 2y + 2z = 1, x² + 2y² + 2z² = x, 2xy + 2yz = y: four solutions, all real; (1, 0, 0) and (1/3, 0, 1/3) among them.
    let [x, y, z] = xyz();
    let system = System::new(["x", "y", "z"])
        .with("sum", x.clone() + n(2) * y.clone() + n(2) * z.clone() - n(1))
        .with("squares", x.power(2) + n(2) * y.power(2) + n(2) * z.power(2) - x.clone())
        .with("products", n(2) * x * y.clone() + n(2) * y.clone() * z - y);
    let plan = Plan::new("z")
        .resultant("a", ("squares", "sum"), "x")
        .resultant("b", ("products", "sum"), "x")
        .resultant("left", ("a", "b"), "y");
    let found = solved(&system, &plan);
    assert_eq!((found.account.degree, found.account.real), (4, 4), "{found:?}");
    for expected in [[1.0, 0.0, 0.0], [1.0 / 3.0, 0.0, 1.0 / 3.0]] {
        let near = |s: &assur::Solution| s.values.iter().zip(expected).all(|(v, e)| (v - e).norm() < 1e-12);
        assert!(found.solutions.iter().any(near), "{expected:?}");
    }
}

#[test]
fn gaussian_coefficients() {
    // z w = 1 and z = (1 + i) w: w² = 1/(1 + i).
    type G = Poly<Gaussian<Integer>>;
    let [z, w] = [0, 1].map(G::variable);
    let unit = G::constant(Gaussian::new(Integer::ONE, Integer::ONE));
    let system = System::new(["z", "w"]).with("circle", z.clone() * w.clone() - G::one()).with("line", z - unit * w);
    let found = solved(&system, &Plan::new("w").resultant("r", ("circle", "line"), "z"));
    assert_eq!(found.account.complex, 2);
    for s in &found.solutions {
        assert!((s.values[1].powu(2) * Complex64::new(1.0, 1.0) - 1.0).norm() < 1e-15);
    }
}

#[test]
fn degenerate_systems_end_with_a_name() {
    let [x, y, _] = xyz();
    let plan = Plan::new("y").resultant("r", ("f", "g"), "x");
    // A shared component.
    let shared = System::new(["x", "y"])
        .with("f", x.clone() * (x.clone() - y.clone()))
        .with("g", (x.clone() - y.clone()) * (y.clone() - n(2)));
    assert_eq!(solved(&shared, &plan).outcome, Outcome::IdenticallyZero { name: "r".into() });
    // Parallel lines.
    let parallel = System::new(["x", "y"]).with("f", x.clone() - y.clone()).with("g", x.clone() - y.clone() - n(1));
    assert_eq!(solved(&parallel, &plan).outcome, Outcome::NoFiniteSolution);
    // A root that a third equation refuses.
    let refused = System::new(["x", "y"])
        .with("f", x.power(2) + y.power(2) - n(25))
        .with("g", x.clone() - n(4))
        .with("third", x.clone() + y.clone() - n(7));
    let found = solved(&refused, &plan);
    assert_eq!((found.account.real, found.account.rejected), (1, 1));
    assert_eq!(found.rejected[0].reason, RootRejection::NothingAbove);
    // A plan that multiplies its own extraneous root in.
    let doubled = Plan::new("y").combine("fy", [(y.clone() - n(3), "f")]).resultant("r", ("fy", "g"), "x");
    let system = System::new(["x", "y"]).with("f", x.power(2) + y.power(2) - n(25)).with("g", x.clone() - n(4));
    let found = solved(&system, &doubled);
    assert_eq!((found.account.real, found.account.rejected), (2, 1), "{found:?}");
    assert_eq!(found.rejected[0].reason, RootRejection::ExtraMultiplicity);
    // Nothing leads back to x.
    let error = solve(&system, &Plan::new("y").combine("r", [(n(1), "f"), (-(x.clone() + n(4)), "g")])).unwrap_err();
    assert_eq!(error.to_string(), "plan: no step eliminates `x`, so it cannot be lifted");
}

#[test]
fn a_change_of_unit_scales_the_solutions_exactly() {
    let coefficients = [[3, -2, 5, 7, -11, 4], [2, 3, -7, 1, 5, -9], [-4, 1, 3, 8, -6, -13]];
    let base = solved(&three_quadrics(&coefficients), &octic());
    for exponent in [-20i32, 20] {
        let unit = if exponent > 0 {
            Rational::from(1i64 << exponent)
        } else {
            Rational::from_parts(1.into(), (1u64 << -exponent).into())
        };
        let mut system = System::new(["s1", "s2", "s3"]);
        for (label, polynomial) in three_quadrics(&coefficients).equations() {
            // s -> s / unit
            let scaled = polynomial.terms().fold(P::zero(), |sum, (m, c)| {
                let c = (0..m.total_degree()).fold(c.clone(), |c, _| c / unit.clone());
                sum + Poly::term(c, m.clone())
            });
            system.add(label.clone(), scaled);
        }
        let found = solved(&system, &octic());
        assert_eq!(found.account, base.account);
        for (a, b) in base.solutions.iter().zip(&found.solutions) {
            for (u, v) in a.values.iter().zip(&b.values) {
                assert!((u * 2f64.powi(exponent) - v).norm() < 1e-12 * v.norm());
            }
        }
    }
}

/// Two solutions with almost the same `t`: the eliminant has a near-double root, known to half its digits only, and each solution must
/// still be found and counted once.
#[test]
fn solutions_that_nearly_share_a_root() {
    type G = Poly<Gaussian<Integer>>;
    let g = |re: i64, im: i64| G::constant(Gaussian::new(Integer::from(re), Integer::from(im)));
    let [z, w, t] = [0, 1, 2].map(G::variable);
    let radius = G::constant(Gaussian::new(Ring::power(&Integer::from(10), 30), Integer::ZERO));
    let row = |c: [(i64, i64); 6]| {
        let [a, b, d, e, f, h] = c.map(|(re, im)| g(re, im));
        (a + b * t.clone()) * z.clone() + (d + e * t.clone()) * w.clone() + f + h * t.clone()
    };
    let system = System::new(["z", "w", "t"])
        .with("circle", z.clone() * w.clone() - radius)
        .with("L2", row([(3, 1), (-2, 5), (4, -7), (1, 6), (-8, 3), (2, 2)]))
        .with("L3", row([(-1, 4), (6, -3), (2, 9), (-5, 1), (7, 7), (-3, 4)]));
    let plan = Plan::new("t")
        .resultant_formal("R1", ("L2", 1), ("L3", 1), "z")
        .resultant_formal("R2", ("circle", 1), ("L2", 1), "z")
        .resultant_formal("T", ("R1", 1), ("R2", 2), "w")
        .remove_coefficient("T", "L2", ("z", 1), assur::eliminate::Power::Exactly(1));
    let found = solved(&system, &plan);
    assert_eq!(found.account.degree, 4);
    assert_eq!(found.account.complex, 4, "{found:?}");
}

/// Three roots within a hundredth of each other leave the one at 4 with eleven digits, and there two unknowns vanish: no branch
/// above it passes for shared, and the second pass has to find (0, 4, 0).
#[test]
fn zeros_above_a_root_with_close_neighbours() {
    let at = [0, 4, 0];
    let c = through([[2, 2, 0, 3, 1, 0], [6, -1, -2, 2, 8, 0], [8, -5, 0, -7, -4, 0]], at);
    let found = solved(&three_quadrics(&c), &octic());
    assert_eq!((found.account.real, found.account.complex), (6, 2));
    assert!(found.solutions.iter().any(|s| s.values.iter().zip(at).all(|(z, x)| (z - x as f64).norm() < 1e-12)));
}

/// Above s2 = 1 lie a simple and a double solution. Started from afar, Newton comes to the double one along many ways and stops
/// at slightly different places; they are one.
#[test]
fn a_double_solution_beside_a_simple_one() {
    let c = through([[0, -4, 0, 4, 0, 0], [3, 0, 0, 2, 0, 0], [0, 1, -2, 0, 4, 0]], [0, 1, -4]);
    let found = solved(&three_quadrics(&c), &octic());
    let above_one =
        |s3: f64| found.solutions.iter().filter(move |s| (s.values[1] - 1.0).norm() + (s.values[2] - s3).norm() < 1e-5);
    assert_eq!(above_one(4.0).map(|s| s.multiplicity).collect::<Vec<_>>(), [1]);
    assert_eq!(above_one(-4.0).map(|s| s.multiplicity).collect::<Vec<_>>(), [2]);
}

#[test]
fn solutions_at_the_origin() {
    // The origin alone, simple and double.
    let [x, y, _] = xyz();
    let plan = Plan::new("y").resultant("r", ("f", "g"), "x");
    let simple = System::new(["x", "y"]).with("f", x.clone() - y.clone()).with("g", x.clone() + y.clone());
    let found = solved(&simple, &plan);
    assert_eq!((found.account.real, found.solutions[0].values.as_slice()), (1, &[Complex64::ZERO; 2][..]));
    let double = System::new(["x", "y"]).with("f", x.power(2) + y.power(2)).with("g", x.clone() + n(2) * y.clone());
    let found = solved(&double, &plan);
    assert_eq!((found.solutions.len(), found.solutions[0].multiplicity, found.account.real), (1, 2, 2));
    // The origin among others.
    let among = System::new(["x", "y"]).with("f", x.power(2) - x.clone() - y.clone()).with("g", y.clone() - n(3) * x);
    let found = solved(&among, &plan);
    assert_eq!(found.account.real, 2);
    assert_eq!(found.solutions[0].values, [Complex64::ZERO; 2]);
}
