//! In which order are the unknowns eliminated?
//!
//! A plan is data: it can be printed, compared and followed by hand. Its steps name polynomials; each step makes a new one from
//! those of the system and of earlier steps, and the last one made is the eliminant.

use std::fmt;

use crate::algebra::{Domain, Poly, Ring};
use crate::eliminate::Power;

/// Steps that lead from a system to a polynomial in one variable.
///
/// ```
/// use assur::{Plan, algebra::Integer};
/// let plan = Plan::<Integer>::new("y").resultant("meeting points", ("circle", "line"), "x");
/// assert_eq!(plan.to_string(), "meeting points = Res_x(circle, line)\nleft: y");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Plan<C> {
    pub(super) variable: String,
    pub(super) steps: Vec<Step<C>>,
    pub(super) degree: Option<usize>,
}

/// One step of a plan.
#[derive(Clone, Debug, PartialEq)]
pub enum Step<C> {
    /// `name = sum of multiplier · polynomial`.
    Combine {
        /// What the sum is called.
        name: String,
        /// Multipliers and the names of what they multiply.
        terms: Vec<(Poly<C>, String)>,
    },
    /// `name = Res_variable(first, second)`.
    Resultant {
        /// What the resultant is called.
        name: String,
        /// The two polynomials, by name.
        of: (String, String),
        /// The variable that goes.
        eliminate: String,
        /// Formal degrees; the actual ones where absent.
        degrees: Option<(u32, u32)>,
    },
    /// `from` is divided by a factor and keeps its name.
    Remove {
        /// What is divided, by name.
        from: String,
        /// The factor.
        factor: Factor<C>,
        /// How often.
        power: Power,
        /// What the factor is called in the record.
        called: String,
    },
}

/// Where an extraneous factor comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Factor<C> {
    /// It is this polynomial.
    Polynomial(Poly<C>),
    /// It is the coefficient of a power of a variable in a named polynomial.
    Coefficient {
        /// The polynomial, by name.
        of: String,
        /// The variable.
        variable: String,
        /// Its power.
        power: u32,
    },
}

impl<C: Domain> Plan<C> {
    /// A plan without steps that leaves this variable.
    pub fn new(variable: impl Into<String>) -> Self {
        Self { variable: variable.into(), steps: Vec::new(), degree: None }
    }

    /// States how many solutions the family has: the degree the eliminant is accounted against.
    ///
    /// Without it, the degree is bounded from the shape of the last resultant, less the factors removed.
    pub fn of_degree(mut self, degree: usize) -> Self {
        self.degree = Some(degree);
        self
    }

    /// Adds `name = sum of multiplier · polynomial`.
    pub fn combine<N: Into<String>>(
        mut self,
        name: impl Into<String>,
        terms: impl IntoIterator<Item = (Poly<C>, N)>,
    ) -> Self {
        let terms = terms.into_iter().map(|(multiplier, of)| (multiplier, of.into())).collect();
        self.steps.push(Step::Combine { name: name.into(), terms });
        self
    }

    /// Adds `name = first - second`.
    pub fn difference(self, name: impl Into<String>, first: impl Into<String>, second: impl Into<String>) -> Self {
        self.combine(name, [(Poly::one(), first.into()), (-Poly::one(), second.into())])
    }

    /// Adds `name = Res_variable(first, second)` at the actual degrees.
    pub fn resultant<N: Into<String>>(
        mut self,
        name: impl Into<String>,
        of: (N, N),
        eliminate: impl Into<String>,
    ) -> Self {
        let of = (of.0.into(), of.1.into());
        self.steps.push(Step::Resultant { name: name.into(), of, eliminate: eliminate.into(), degrees: None });
        self
    }

    /// Adds `name = Res_variable(first, second)`, each polynomial with its formal degree in the variable.
    ///
    /// ```
    /// use assur::{Plan, algebra::Integer};
    /// let plan = Plan::<Integer>::new("y").resultant_formal("R", ("f", 2), ("g", 1), "x");
    /// assert_eq!(plan.to_string(), "R = Res_x(f, g) of formal degrees 2, 1\nleft: y");
    /// ```
    pub fn resultant_formal<N: Into<String>>(
        mut self,
        name: impl Into<String>,
        first: (N, u32),
        second: (N, u32),
        eliminate: impl Into<String>,
    ) -> Self {
        let degrees = Some((first.1, second.1));
        let of = (first.0.into(), second.0.into());
        self.steps.push(Step::Resultant { name: name.into(), of, eliminate: eliminate.into(), degrees });
        self
    }

    /// Divides a named polynomial by a given one; the factor is `called` so in the record.
    pub fn remove(mut self, from: impl Into<String>, factor: Poly<C>, power: Power, called: impl Into<String>) -> Self {
        let factor = Factor::Polynomial(factor);
        self.steps.push(Step::Remove { from: from.into(), factor, power, called: called.into() });
        self
    }

    /// Divides a named polynomial by the coefficient of `variable^exponent` in another.
    pub fn remove_coefficient(
        mut self,
        from: impl Into<String>,
        of: impl Into<String>,
        variable: (impl Into<String>, u32),
        power: Power,
    ) -> Self {
        let (of, exponent) = (of.into(), variable.1);
        let variable = variable.0.into();
        let shown = if exponent == 1 { variable.clone() } else { format!("{variable}^{exponent}") };
        let called = format!("coefficient of {shown} in {of}");
        let factor = Factor::Coefficient { of, variable, power: exponent };
        self.steps.push(Step::Remove { from: from.into(), factor, power, called });
        self
    }

    /// The variable that is left.
    pub fn variable(&self) -> &str {
        &self.variable
    }

    /// The steps, in order.
    pub fn steps(&self) -> &[Step<C>] {
        &self.steps
    }
}

impl<C> fmt::Display for Plan<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for step in &self.steps {
            match step {
                Step::Combine { name, terms } => {
                    let names: Vec<&str> = terms.iter().map(|(_, of)| of.as_str()).collect();
                    writeln!(f, "{name} = combination of {}", names.join(", "))?;
                }
                Step::Resultant { name, of, eliminate, degrees } => {
                    write!(f, "{name} = Res_{eliminate}({}, {})", of.0, of.1)?;
                    match degrees {
                        Some((m, n)) => writeln!(f, " of formal degrees {m}, {n}")?,
                        None => writeln!(f)?,
                    }
                }
                Step::Remove { from, power, called, .. } => match power {
                    Power::Exactly(power) => writeln!(f, "{from}: divided by ({called})^{power}")?,
                    Power::AsOftenAsItDivides => writeln!(f, "{from}: divided by {called} as often as it divides")?,
                },
            }
        }
        write!(f, "left: {}", self.variable)
    }
}
