//! Following one path `x(t)` of `H(x, t) = 0` from one `t` to another: predict, correct by Newton, adapt the step.

use num_complex::Complex64;

use super::linear::{Factored, Matrix, Vector};

/// Highest power of the local series; what the Padé approximant needs.
pub const ORDER: usize = 3;

/// `H`, square in `N` unknowns.
pub trait Homotopy<const N: usize> {
    /// `H` and its Jacobian in the unknowns.
    fn system(&self, x: &Vector<N>, t: f64) -> (Vector<N>, Matrix<N>);

    /// Derivative of `H` by `t`.
    fn drift(&self, x: &Vector<N>, t: f64) -> Vector<N>;

    /// Coefficients of `h`, `h²`, `h³` in `x(t + h)`; `None` where the Jacobian is singular.
    fn series(&self, x: &Vector<N>, t: f64) -> Option<[Vector<N>; ORDER]>;

    /// Square of the size of a correction relative to the point.
    fn relative(&self, dx: &Vector<N>, x: &Vector<N>) -> f64;
}

/// How the next point of a path is guessed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Predictor {
    /// Along the tangent.
    Euler,
    /// Classical Runge-Kutta of order 4.
    RungeKutta,
    /// Local series of order 3.
    Series,
    /// The same, as a Padé approximant of type (2, 1) in each unknown.
    Pade,
}

/// Knobs of the tracker, all relative to the size of the point.
///
/// The defaults are the fastest of those tried (`cargo bench --bench homotopy`) with which the parameter homotopy lost no solution of
/// 6000; looser ones gain a few percent and begin to fail.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// How points are guessed.
    pub predictor: Predictor,
    /// First step in `t`.
    pub first_step: f64,
    /// A prediction that the first correction moves by more than this is refused.
    pub trust: f64,
    /// The step is chosen so that the next first correction is about this large.
    pub aim: f64,
    /// Corrections go on until one is below this.
    pub accuracy: f64,
    /// Steps below this end the path as failed.
    pub smallest_step: f64,
    /// More steps than this end the path as failed.
    pub most_steps: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            predictor: Predictor::Pade,
            first_step: 0.1,
            trust: 0.1,
            aim: 0.02,
            accuracy: 1e-3,
            smallest_step: 1e-11,
            most_steps: 2000,
        }
    }
}

impl Settings {
    /// Short steps, for paths that failed or jumped.
    pub fn careful(self) -> Self {
        Self { first_step: 0.01, trust: 1e-3, aim: 1e-4, accuracy: 1e-7, most_steps: 20_000, ..self }
    }
}

/// Corrections at most, at one value of `t`.
const CORRECTIONS: usize = 3;

/// Limits on how fast a step grows and shrinks.
const GROWTH: (f64, f64) = (0.25, 4.0);

/// The point at `end` of the path through `x` at `start`; `None` if it failed. Adds to `steps`.
#[inline]
pub fn track<const N: usize, H: Homotopy<N>>(
    homotopy: &H,
    mut x: Vector<N>,
    start: f64,
    end: f64,
    settings: &Settings,
    steps: &mut usize,
) -> Option<Vector<N>> {
    let by_series = matches!(settings.predictor, Predictor::Series | Predictor::Pade);
    let mut t = start;
    let mut step = settings.first_step * (end - start);
    let mut local = None;
    for _ in 0..settings.most_steps {
        *steps += 1;
        let last = step >= end - t;
        let h = if last { end - t } else { step };
        if by_series && local.is_none() {
            local = Some(homotopy.series(&x, t)?);
        }
        let guess = match (settings.predictor, &local) {
            (Predictor::Pade, Some(series)) => pade(&x, series, h),
            (_, Some(series)) => polynomial(&x, series, h),
            (Predictor::Euler, None) => ahead(&x, &tangent(homotopy, &x, t)?, h),
            _ => runge_kutta(homotopy, &x, t, h)?,
        };
        match correct(homotopy, guess, t + h, settings) {
            (first, Some(point)) => {
                x = point;
                local = None;
                if last {
                    return Some(x);
                }
                t += h;
                // The error of the prediction goes with the fourth power of the step (with the square for Euler).
                step = h * rate(settings.aim / first, settings.predictor);
            }
            (first, None) => step = h * rate(settings.aim / first, settings.predictor).min(0.5),
        }
        if step < settings.smallest_step * (1.0 - t).max(1e-3) {
            return None;
        }
    }
    None
}

/// Newton from `x` until it no longer moves; the smallest correction seen, relative, and the point.
pub fn polish<const N: usize, H: Homotopy<N>>(homotopy: &H, mut x: Vector<N>, t: f64) -> Option<Vector<N>> {
    let mut last = f64::INFINITY;
    for _ in 0..8 {
        let (value, jacobian) = homotopy.system(&x, t);
        let dx = Factored::new(jacobian)?.solve(&value);
        let moved = homotopy.relative(&dx, &x);
        // At the level of rounding corrections stop shrinking.
        if moved >= last || moved.is_nan() {
            break;
        }
        last = moved;
        x = sub(&x, &dx);
        if moved < 1e-30 {
            break;
        }
    }
    (last < 1e-12).then_some(x)
}

fn rate(shrink: f64, predictor: Predictor) -> f64 {
    let root = shrink.sqrt();
    let rate = if predictor == Predictor::Euler { root } else { root.sqrt() };
    // Without a finite error the step shrinks as fast as it may.
    if rate.is_nan() { GROWTH.0 } else { rate.clamp(GROWTH.0, GROWTH.1) }
}

/// The first correction, relative, and the corrected point unless it is refused.
#[inline]
fn correct<const N: usize, H: Homotopy<N>>(
    homotopy: &H,
    mut x: Vector<N>,
    t: f64,
    settings: &Settings,
) -> (f64, Option<Vector<N>>) {
    let mut first = f64::INFINITY;
    let mut before = f64::INFINITY;
    for i in 0..CORRECTIONS {
        let (value, jacobian) = homotopy.system(&x, t);
        let Some(factored) = Factored::new(jacobian) else { return (first, None) };
        let dx = factored.solve(&value);
        let moved = homotopy.relative(&dx, &x).sqrt();
        if i == 0 {
            first = moved;
        }
        // Newton converges quadratically or it is not trusted.
        if !(moved < settings.trust && moved < 0.1 * before) {
            return (first, None);
        }
        x = sub(&x, &dx);
        if moved < settings.accuracy {
            return (first, Some(x));
        }
        before = moved;
    }
    (first, None)
}

fn tangent<const N: usize, H: Homotopy<N>>(homotopy: &H, x: &Vector<N>, t: f64) -> Option<Vector<N>> {
    let (_, jacobian) = homotopy.system(x, t);
    let direction = Factored::new(jacobian)?.solve(&homotopy.drift(x, t));
    Some(direction.map(|d| -d))
}

fn runge_kutta<const N: usize, H: Homotopy<N>>(homotopy: &H, x: &Vector<N>, t: f64, h: f64) -> Option<Vector<N>> {
    let k1 = tangent(homotopy, x, t)?;
    let k2 = tangent(homotopy, &ahead(x, &k1, 0.5 * h), t + 0.5 * h)?;
    let k3 = tangent(homotopy, &ahead(x, &k2, 0.5 * h), t + 0.5 * h)?;
    let k4 = tangent(homotopy, &ahead(x, &k3, h), t + h)?;
    Some(std::array::from_fn(|i| x[i] + (k1[i] + (k2[i] + k3[i]) * 2.0 + k4[i]) * (h / 6.0)))
}

fn polynomial<const N: usize>(x: &Vector<N>, [first, second, third]: &[Vector<N>; ORDER], h: f64) -> Vector<N> {
    std::array::from_fn(|i| x[i] + (first[i] + (second[i] + third[i] * h) * h) * h)
}

/// `x + first h + second h² / (1 - (third/second) h)`.
fn pade<const N: usize>(x: &Vector<N>, [first, second, third]: &[Vector<N>; ORDER], h: f64) -> Vector<N> {
    std::array::from_fn(|i| {
        let denominator = second[i] - third[i] * h;
        let size = denominator.norm_sqr();
        let square = second[i] * second[i] * denominator.conj();
        // A pole nearby, or a straight path: the polynomial serves.
        if size > 0.01 * second[i].norm_sqr() && size > 1e-30 {
            x[i] + (first[i] + square * (h / size)) * h
        } else {
            x[i] + (first[i] + (second[i] + third[i] * h) * h) * h
        }
    })
}

fn ahead<const N: usize>(x: &Vector<N>, direction: &Vector<N>, h: f64) -> Vector<N> {
    std::array::from_fn(|i| x[i] + direction[i] * h)
}

fn sub<const N: usize>(x: &Vector<N>, y: &Vector<N>) -> Vector<N> {
    std::array::from_fn(|i| x[i] - y[i])
}

/// Larger of two squared moduli; for norms.
pub fn larger(bound: f64, z: &Complex64) -> f64 {
    bound.max(z.norm_sqr())
}
