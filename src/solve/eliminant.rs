//! Following a plan: from a system to a polynomial in one variable.

use thiserror::Error;

use super::plan::{Factor, Plan, Step};
use super::system::System;
use crate::algebra::{Domain, Poly, Ring, UPoly};
use crate::eliminate::{
    FactorError, FormalDegreeTooLow, NamedFactor, Power, RemovedFactor, SylvesterMatrix, determinant_degree_bound,
    resultant_formal,
};

/// What a plan leaves: a polynomial in one variable whose roots carry the solutions, and how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Eliminant<C> {
    /// The variable that is left.
    pub variable: String,
    /// The polynomial; zero where the elimination degenerates (see [`Eliminant::outcome`]).
    pub polynomial: UPoly<C>,
    /// The degree it is accounted against: stated by the plan, or bounded by the shape of the last resultant less what was removed.
    pub degree_bound: usize,
    /// The factors that were removed, in order, each with its power.
    pub removed: Vec<RemovedFactor<C>>,
    /// Every polynomial of the system and of the plan, by name, in the order made.
    pub polynomials: Vec<(String, Poly<C>)>,
    /// The first polynomial the plan made that vanished identically.
    pub vanished: Option<String>,
}

/// How an elimination ended. All three are answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// A polynomial with roots; so many of them went to infinity (the degree dropped).
    Roots {
        /// Degree bound less actual degree.
        at_infinity: usize,
    },
    /// A constant that is not zero: no finite solution exists.
    NoFiniteSolution,
    /// The named polynomial vanished identically: solutions form a curve, or the plan does not suit these coefficients.
    IdenticallyZero {
        /// The first polynomial that vanished.
        name: String,
    },
}

/// Why a plan cannot be followed.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum EliminateError {
    /// A step names a polynomial that is not there.
    #[error("plan: no polynomial is called `{name}`")]
    UnknownPolynomial {
        /// The name.
        name: String,
    },
    /// A step names a variable that is not there.
    #[error("plan: no variable is called `{name}`")]
    UnknownVariable {
        /// The name.
        name: String,
    },
    /// The plan has no step that makes a polynomial.
    #[error("plan: no step makes a polynomial")]
    Empty,
    /// Two polynomials would share a name.
    #[error("plan: the name `{name}` is taken")]
    NameTaken {
        /// The name.
        name: String,
    },
    /// Neither polynomial contains the variable.
    #[error("resultant `{name}`: neither polynomial contains the variable to be eliminated")]
    NothingToEliminate {
        /// The resultant's name.
        name: String,
    },
    /// A stated formal degree is too low.
    #[error("resultant `{name}`: {source}")]
    FormalDegree {
        /// The resultant's name.
        name: String,
        /// Which degree.
        source: FormalDegreeTooLow,
    },
    /// A factor that was said to divide does not.
    #[error("removal from `{from}`: {source}")]
    Factor {
        /// What was to be divided.
        from: String,
        /// Why not.
        source: FactorError,
    },
    /// The last polynomial still holds another variable.
    #[error("plan: `{name}` still contains `{variable}`")]
    NotUnivariate {
        /// The polynomial's name.
        name: String,
        /// A variable beside the one that should be left.
        variable: String,
    },
}

impl<C: Domain> Eliminant<C> {
    /// How the elimination ended.
    pub fn outcome(&self) -> Outcome {
        match (self.polynomial.degree(), &self.vanished) {
            (None, vanished) => Outcome::IdenticallyZero { name: vanished.clone().unwrap_or_default() },
            (Some(0), _) => Outcome::NoFiniteSolution,
            (Some(degree), _) => Outcome::Roots { at_infinity: self.degree_bound - degree },
        }
    }

    /// A polynomial of the system or the plan.
    pub fn polynomial_called(&self, name: &str) -> Option<&Poly<C>> {
        find(&self.polynomials, name)
    }
}

/// Follows a plan exactly, from a system to its eliminant.
///
/// **Proof:** exact; every solution of the system has its value of the variable among the roots, unless the plan removes a factor that
/// is not extraneous. **Errors:** see [`EliminateError`]; a polynomial that vanishes identically is an [`Outcome`], no error.
///
/// ```
/// use assur::{Outcome, Plan, System, algebra::{Integer, Poly, Ring}, eliminate};
/// let [x, y] = [0, 1].map(Poly::<Integer>::variable);
/// let system = System::new(["x", "y"])
///     .with("circle", x.power(2) + y.power(2) - Poly::from_int(25))
///     .with("line", x - y - Poly::one());
/// let eliminant = eliminate(&system, &Plan::new("y").resultant("meet", ("circle", "line"), "x"))?;
/// assert_eq!(eliminant.polynomial.coefficients(), [-24, 2, 2].map(Integer::from));
/// assert_eq!(eliminant.outcome(), Outcome::Roots { at_infinity: 0 });
/// # Ok::<(), assur::EliminateError>(())
/// ```
pub fn eliminate<C: Domain>(system: &System<C>, plan: &Plan<C>) -> Result<Eliminant<C>, EliminateError> {
    let left = variable_number(system, plan.variable())?;
    let mut polynomials = system.equations().to_vec();
    let mut removed: Vec<RemovedFactor<C>> = Vec::new();
    let mut vanished = None;
    let mut last = None;
    for step in plan.steps() {
        let (name, made) = match step {
            Step::Combine { name, terms } => (name, combine(&polynomials, terms)?),
            Step::Resultant { name, of, eliminate, degrees } => {
                let variable = variable_number(system, eliminate)?;
                let (f, g) = (look_up(&polynomials, &of.0)?, look_up(&polynomials, &of.1)?);
                let degrees = degrees.unwrap_or_else(|| (f.degree_in(variable), g.degree_in(variable)));
                let made = match degrees {
                    _ if f.vanishes() || g.vanishes() => Poly::zero(),
                    (0, 0) => return Err(EliminateError::NothingToEliminate { name: name.clone() }),
                    _ => resultant_formal(f, g, variable, degrees)
                        .map_err(|source| EliminateError::FormalDegree { name: name.clone(), source })?,
                };
                (name, made)
            }
            Step::Remove { from, factor, power, called } => {
                let factor = match factor {
                    Factor::Polynomial(factor) => factor.clone(),
                    Factor::Coefficient { of, variable, power } => {
                        let mut all = look_up(&polynomials, of)?.coefficients_in(variable_number(system, variable)?);
                        let k = *power as usize;
                        if k < all.len() { all.swap_remove(k) } else { Poly::zero() }
                    }
                };
                let factor = NamedFactor::new(called, factor);
                let slot = polynomials.iter_mut().find(|(known, _)| known == from);
                let (_, target) = slot.ok_or_else(|| EliminateError::UnknownPolynomial { name: from.clone() })?;
                let (rest, power) = remove(&factor, target, *power)
                    .map_err(|source| EliminateError::Factor { from: from.clone(), source })?;
                *target = rest;
                removed.push(RemovedFactor { factor, power });
                continue;
            }
        };
        if find(&polynomials, name).is_some() {
            return Err(EliminateError::NameTaken { name: name.clone() });
        }
        if made.vanishes() && vanished.is_none() {
            vanished = Some(name.clone());
        }
        polynomials.push((name.clone(), made));
        last = Some((name, removed.len()));
    }
    let (name, removed_before) = last.ok_or(EliminateError::Empty)?;
    let polynomial = look_up(&polynomials, name)?;
    let univariate = polynomial.univariate(left).ok_or_else(|| {
        let other = (0..system.variables().len()).find(|&v| v != left && polynomial.degree_in(v) > 0);
        let variable = other.map_or_else(String::new, |v| system.variables()[v].clone());
        EliminateError::NotUnivariate { name: name.clone(), variable }
    })?;
    let degree = univariate.degree().unwrap_or(0);
    let degree_bound = match plan.degree {
        Some(degree) => degree,
        None => {
            let shape = shape_bound(system, plan, &polynomials, name, left)?.unwrap_or(degree);
            let gone = removed[removed_before..].iter().map(|r| r.power * r.factor.polynomial.degree_in(left));
            shape.saturating_sub(gone.sum::<u32>() as usize)
        }
    };
    Ok(Eliminant {
        variable: plan.variable().to_string(),
        polynomial: univariate,
        // A stated degree that the polynomial exceeds is no bound; the polynomial is exact.
        degree_bound: degree_bound.max(degree),
        removed,
        polynomials,
        vanished,
    })
}

/// The degree the last resultant can have by the degrees of the entries of its matrix; `None` where it is no resultant.
fn shape_bound<C: Domain>(
    system: &System<C>,
    plan: &Plan<C>,
    polynomials: &[(String, Poly<C>)],
    last: &str,
    left: usize,
) -> Result<Option<usize>, EliminateError> {
    for step in plan.steps() {
        if let Step::Resultant { name, of, eliminate, degrees } = step
            && name == last
        {
            let variable = variable_number(system, eliminate)?;
            let (f, g) = (look_up(polynomials, &of.0)?, look_up(polynomials, &of.1)?);
            let degrees = degrees.unwrap_or_else(|| (f.degree_in(variable), g.degree_in(variable)));
            let matrix = SylvesterMatrix::in_variable((&of.0, f), (&of.1, g), (variable, eliminate), degrees)
                .map_err(|source| EliminateError::FormalDegree { name: name.clone(), source })?;
            let degree = |p: &Poly<C>| (!p.vanishes()).then(|| p.degree_in(left) as usize);
            return Ok(determinant_degree_bound(matrix.rows(), degree));
        }
    }
    Ok(None)
}

fn combine<C: Domain>(known: &[(String, Poly<C>)], terms: &[(Poly<C>, String)]) -> Result<Poly<C>, EliminateError> {
    let mut sum = Poly::zero();
    for (multiplier, of) in terms {
        sum = sum + multiplier.clone() * look_up(known, of)?.clone();
    }
    Ok(sum)
}

/// Nothing is removed from the zero polynomial: what made it vanish is the answer, whatever became of the factor.
fn remove<C: Domain>(factor: &NamedFactor<C>, from: &Poly<C>, power: Power) -> Result<(Poly<C>, u32), FactorError> {
    if from.vanishes() { Ok((Poly::zero(), 0)) } else { factor.remove_from(from, power) }
}

fn find<'a, C>(polynomials: &'a [(String, Poly<C>)], name: &str) -> Option<&'a Poly<C>> {
    polynomials.iter().find(|(known, _)| known == name).map(|(_, polynomial)| polynomial)
}

fn look_up<'a, C>(polynomials: &'a [(String, Poly<C>)], name: &str) -> Result<&'a Poly<C>, EliminateError> {
    find(polynomials, name).ok_or_else(|| EliminateError::UnknownPolynomial { name: name.to_string() })
}

fn variable_number<C: Domain>(system: &System<C>, name: &str) -> Result<usize, EliminateError> {
    system.variable_number(name).ok_or_else(|| EliminateError::UnknownVariable { name: name.to_string() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Integer;

    fn circle_and_line() -> System<Integer> {
        let [x, y] = [0, 1].map(Poly::<Integer>::variable);
        System::new(["x", "y"])
            .with("circle", x.power(2) + y.power(2) - Poly::from_int(25))
            .with("line", x - y - Poly::one())
    }

    #[test]
    fn what_cannot_be_followed_is_said_by_name() {
        let system = circle_and_line();
        let plan = || Plan::<Integer>::new("y");
        let message = |plan: Plan<Integer>| eliminate(&system, &plan).unwrap_err().to_string();
        assert_eq!(message(plan()), "plan: no step makes a polynomial");
        assert_eq!(message(plan().resultant("r", ("circle", "lime"), "x")), "plan: no polynomial is called `lime`");
        assert_eq!(message(plan().resultant("r", ("circle", "line"), "z")), "plan: no variable is called `z`");
        assert_eq!(message(plan().resultant("r", ("circle", "line"), "y")), "plan: `r` still contains `x`");
        assert_eq!(message(plan().resultant("line", ("circle", "line"), "x")), "plan: the name `line` is taken");
        let low = plan().resultant_formal("r", ("circle", 1), ("line", 1), "x");
        assert_eq!(message(low), "resultant `r`: formal degree 1 is below the degree 2 the polynomial has");
        let wrong =
            plan().resultant("r", ("circle", "line"), "x").remove("r", Poly::variable(1), Power::Exactly(1), "y");
        assert!(message(wrong).starts_with("removal from `r`: factor `y` does not divide"));
    }

    #[test]
    fn factors_formal_degrees_and_a_drop_are_recorded() {
        let system = circle_and_line();
        // A missing degree of the circle brings the line's leading coefficient in x, one; a multiplier y brings y².
        let y = Poly::variable(1);
        let plan = Plan::new("y")
            .combine("tilted", [(y.clone(), "line")])
            .resultant_formal("r", ("circle", 2), ("tilted", 1), "x")
            .remove_coefficient("r", "tilted", ("x", 1), Power::AsOftenAsItDivides)
            .of_degree(3);
        let eliminant = eliminate(&system, &plan).unwrap();
        assert_eq!(eliminant.polynomial.coefficients(), [-24, 2, 2].map(Integer::from));
        assert_eq!(eliminant.removed.len(), 1);
        assert_eq!(
            (eliminant.removed[0].factor.name.as_str(), eliminant.removed[0].power),
            ("coefficient of x in tilted", 2)
        );
        assert_eq!(eliminant.outcome(), Outcome::Roots { at_infinity: 1 });
        assert_eq!(eliminant.polynomial_called("tilted").unwrap().total_degree(), 2);
    }

    #[test]
    fn vanishing_is_an_outcome() {
        let [x, y] = [0, 1].map(Poly::<Integer>::variable);
        let shared = x.clone() + y.clone();
        let system = System::new(["x", "y"])
            .with("f", shared.clone() * (x.clone() - Poly::one()))
            .with("g", shared * (y.clone() + Poly::from_int(2)));
        let plan = Plan::new("y").resultant("r", ("f", "g"), "x").remove("r", y, Power::Exactly(1), "y");
        let eliminant = eliminate(&system, &plan).unwrap();
        assert_eq!(eliminant.outcome(), Outcome::IdenticallyZero { name: "r".into() });
        let parallel = System::new(["x", "y"]).with("f", x.clone()).with("g", x - Poly::one());
        let eliminant = eliminate(&parallel, &Plan::new("y").resultant("r", ("f", "g"), "x")).unwrap();
        assert_eq!(eliminant.outcome(), Outcome::NoFiniteSolution);
    }
}
