//! The one rule by which everything is integrated that has no closed form.

/// Gauss-Legendre nodes and weights of order 12 on [-1, 1], positive half: exact for polynomials of degree 23.
const RULE: [[f64; 2]; 6] = [
    [0.125_233_408_511_468_9, 0.249_147_045_813_402_8],
    [0.367_831_498_998_180_2, 0.233_492_536_538_354_8],
    [0.587_317_954_286_617_4, 0.203_167_426_723_065_92],
    [0.769_902_674_194_304_7, 0.160_078_328_543_346_23],
    [0.904_117_256_370_474_9, 0.106_939_325_995_318_43],
    [0.981_560_634_246_719_2, 0.047_175_336_386_511_83],
];

/// The places of the rule between two numbers, each with its weight.
pub(crate) fn gauss(from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    RULE.into_iter().flat_map(move |[node, weight]| {
        [half * node, -half * node].into_iter().map(move |offset| (middle + offset, weight * half))
    })
}

#[cfg(test)]
mod tests {
    use super::gauss;

    #[test]
    fn powers_are_integrated_exactly_up_to_degree_23() {
        for degree in 0..=23 {
            let sum: f64 = gauss(1.0, 2.0).map(|(x, weight)| weight * x.powi(degree)).sum();
            let exact = (2_f64.powi(degree + 1) - 1.0) / f64::from(degree + 1);
            let off = (sum / exact - 1.0).abs();
            assert!(off < 1e-14, "{degree} {off:e}");
        }
        // And no further.
        let next: f64 = gauss(-1.0, 1.0).map(|(x, weight)| weight * x.powi(24)).sum();
        assert!((next * 12.5 - 1.0).abs() > 1e-8);
    }
}
