//! Powers of two, by the bits of numbers: the same on every machine, and for the least numbers too, where logarithms and `powi` are not.

/// The largest power of two that is not above a positive number; zero for zero, and what is not finite stays.
pub(crate) fn power_below(x: f64) -> f64 {
    let bits = x.to_bits();
    if x < f64::MIN_POSITIVE {
        return f64::from_bits(bits.checked_ilog2().map_or(0, |k| 1 << k));
    }
    if x.is_finite() { f64::from_bits(bits >> 52 << 52) } else { x }
}

#[cfg(test)]
mod tests {
    use super::power_below;

    #[test]
    fn powers_are_below_numbers_at_any_size() {
        let least = f64::from_bits(1);
        for (x, expected) in [
            (0.0, 0.0),
            (least, least),
            (3.0 * least, 2.0 * least),
            (f64::MIN_POSITIVE, f64::MIN_POSITIVE),
            (f64::MIN_POSITIVE.next_down(), f64::MIN_POSITIVE / 2.0),
            (1.0_f64.next_down(), 0.5),
            (1.0, 1.0),
            (3.9, 2.0),
            (f64::MAX, 2.0_f64.powi(1023)),
            (f64::INFINITY, f64::INFINITY),
        ] {
            assert_eq!(power_below(x), expected, "{x:e}");
        }
    }
}
