//! Extraneous factors go by name.
//!
//! A chain of resultants brings factors in that no solution needs: leading coefficients, powers of `theta`. Each is stated as a
//! polynomial with a name and removed by exact division, which either succeeds or says that the claim was wrong.

use thiserror::Error;

use crate::algebra::{Domain, Poly};

/// A polynomial that is known to divide, and what it is.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedFactor<R> {
    /// What the factor is, in words: `coefficient of z in leg 2`.
    pub name: String,
    /// The factor.
    pub polynomial: Poly<R>,
}

/// How often a factor is to be removed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Power {
    /// Exactly so often; an error if it does not divide. Once is `Exactly(1)`; what is left may contain it again.
    Exactly(u32),
    /// Until it divides no more. A constant counts as no factor and is left in.
    AsOftenAsItDivides,
}

/// A factor that was removed.
#[derive(Clone, Debug, PartialEq)]
pub struct RemovedFactor<R> {
    /// What was removed.
    pub factor: NamedFactor<R>,
    /// How often.
    pub power: u32,
}

/// A factor that is none.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FactorError {
    /// The division leaves a rest.
    #[error("factor `{name}` does not divide {} times: division {} leaves a rest", .power, .divided + 1)]
    DoesNotDivide {
        /// The factor's name.
        name: String,
        /// How often it was to be removed.
        power: u32,
        /// How often it did divide.
        divided: u32,
    },
    /// The factor is the zero polynomial.
    #[error("factor `{name}` is the zero polynomial")]
    Zero {
        /// The factor's name.
        name: String,
    },
}

impl<R: Domain> NamedFactor<R> {
    /// A factor with its name.
    pub fn new(name: impl Into<String>, polynomial: Poly<R>) -> Self {
        Self { name: name.into(), polynomial }
    }

    /// `polynomial / self^power` and the power that was removed. From the zero polynomial nothing is removed by
    /// [`Power::AsOftenAsItDivides`].
    ///
    /// # Errors
    /// The factor is zero, or does not divide as often as stated.
    ///
    /// ```
    /// use assur::{algebra::{Integer, Poly, Ring}, eliminate::{NamedFactor, Power}};
    /// let [x, y] = [0, 1].map(Poly::<Integer>::variable);
    /// let factor = NamedFactor::new("x - y", x.clone() - y.clone());
    /// let product = (x.clone() - y.clone()).power(2) * (x.clone() + y.clone());
    /// assert_eq!(factor.remove_from(&product, Power::AsOftenAsItDivides), Ok((x + y, 2)));
    /// assert!(factor.remove_from(&product, Power::Exactly(3)).is_err());
    /// ```
    pub fn remove_from(&self, polynomial: &Poly<R>, power: Power) -> Result<(Poly<R>, u32), FactorError> {
        if self.polynomial.vanishes() {
            return Err(FactorError::Zero { name: self.name.clone() });
        }
        let mut rest = polynomial.clone();
        let mut divided = 0;
        match power {
            Power::Exactly(power) => {
                while divided < power {
                    rest = rest.exact_div(&self.polynomial).ok_or_else(|| FactorError::DoesNotDivide {
                        name: self.name.clone(),
                        power,
                        divided,
                    })?;
                    divided += 1;
                }
            }
            Power::AsOftenAsItDivides => {
                if self.polynomial.total_degree() > 0 && !rest.vanishes() {
                    while let Some(quotient) = rest.exact_div(&self.polynomial) {
                        rest = quotient;
                        divided += 1;
                    }
                }
            }
        }
        Ok((rest, divided))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Rational, Ring};

    #[test]
    fn limits_of_dividing() {
        let x = Poly::<Rational>::variable(0);
        let often = Power::AsOftenAsItDivides;
        let three = NamedFactor::new("three", Poly::from_int(3));
        assert_eq!(three.remove_from(&x, often), Ok((x.clone(), 0)));
        assert_eq!(three.remove_from(&(Poly::from_int(3) * x.clone()), Power::Exactly(1)), Ok((x.clone(), 1)));
        let own = NamedFactor::new("x", x.clone());
        assert_eq!(own.remove_from(&Poly::zero(), often), Ok((Poly::zero(), 0)));
        assert_eq!(own.remove_from(&x.power(4), Power::Exactly(3)), Ok((x.clone(), 3)));
        let refused = own.remove_from(&(x.power(2) - x.clone()), Power::Exactly(2)).unwrap_err();
        assert_eq!(refused.to_string(), "factor `x` does not divide 2 times: division 2 leaves a rest");
        let zero = NamedFactor::new("nothing", Poly::<Rational>::zero());
        assert_eq!(zero.remove_from(&x, often), Err(FactorError::Zero { name: "nothing".into() }));
    }
}
