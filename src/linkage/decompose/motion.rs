//! Rigid motions of the plane on complex numbers.

use num_complex::Complex64;

/// `z -> origin + turn z`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion {
    pub(super) origin: Complex64,
    pub(super) turn: Complex64,
}

impl Motion {
    pub(super) const REST: Self = Self { origin: Complex64::ZERO, turn: Complex64::ONE };

    pub(super) fn about(centre: Complex64, angle: f64) -> Self {
        let turn = Complex64::from_polar(1.0, angle);
        Self { origin: centre - turn * centre, turn }
    }

    pub(super) fn along(direction: Complex64, way: f64) -> Self {
        Self { origin: direction * (way / direction.norm()), turn: Complex64::ONE }
    }

    pub(super) fn after(&self, first: &Self) -> Self {
        Self { origin: self.origin + self.turn * first.origin, turn: self.turn * first.turn }
    }

    pub(super) fn inverse(&self) -> Self {
        let turn = self.turn.conj();
        Self { origin: -(turn * self.origin), turn }
    }

    pub(super) fn of(&self, point: Complex64) -> Complex64 {
        self.origin + self.turn * point
    }
}
