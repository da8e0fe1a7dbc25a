//! Numbers brought to one size by powers of two, which is exact unless they leave the range: so products stay in it.

/// The largest size of some numbers.
pub fn largest<const N: usize>(values: [f64; N]) -> f64 {
    values.into_iter().fold(0.0, |most, x| x.abs().max(most))
}

/// The power of two that a number is divided by to be from a half to one; 0 for zero and for what is not finite.
pub fn exponent(x: f64) -> i32 {
    if x == 0.0 || !x.is_finite() {
        return 0;
    }
    let biased = |x: f64| ((x.to_bits() >> 52) & 0x7ff) as i32;
    // Those below the normal ones are made normal.
    if x.is_normal() { biased(x) - 1022 } else { biased(x * power(64)) - 1022 - 64 }
}

/// A power of two that is a normal number.
fn power(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// A number times a power of two, rounded once.
pub fn times_power(mut x: f64, mut exponent: i32) -> f64 {
    while exponent > 1023 && x.is_finite() && x != 0.0 {
        x *= power(1023);
        exponent -= 1023;
    }
    // Steps end 53 bits above the least normal number: what is rounded by one of them is lost by the next.
    while exponent < -1022 && x != 0.0 {
        x *= power(53 - 1022);
        exponent += 1022 - 53;
    }
    x * power(exponent.clamp(-1022, 1023))
}
