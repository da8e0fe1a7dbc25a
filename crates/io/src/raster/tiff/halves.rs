//! Overviews: rasters of half the columns and rows, whose cells are means.

/// The columns or rows of an overview.
pub(super) fn half(count: usize) -> usize {
    count.div_ceil(2)
}

/// The row of an overview below two rows: the mean of the cells that have data among four, or among two at an odd end.
pub(super) fn halved(upper: &[f64], lower: &[f64]) -> Vec<f64> {
    upper.chunks(2).zip(lower.chunks(2)).map(|(upper, lower)| mean(upper.iter().chain(lower))).collect()
}

/// The mean of numbers, without those that are no data.
fn mean<'a>(numbers: impl Iterator<Item = &'a f64>) -> f64 {
    let (mut sum, mut count, mut low, mut high) = (0.0, 0.0, f64::INFINITY, f64::NEG_INFINITY);
    for &x in numbers.filter(|x| !x.is_nan()) {
        (sum, count, low, high) = (sum + x, count + 1.0, x.min(low), x.max(high));
    }
    // Sums of huge numbers may be infinite, means are between the numbers.
    if count == 0.0 { f64::NAN } else { (sum / count).max(low).min(high) }
}

#[cfg(test)]
mod tests {
    use super::halved;

    #[test]
    fn means_leave_out_what_has_no_data() {
        let nothing = f64::NAN;
        let row = halved(&[1.0, 2.0, nothing, nothing, 5.0], &[3.0, 6.0, nothing, 7.0, 6.0]);
        assert_eq!(row, [3.0, 7.0, 5.5]);
        assert!(halved(&[nothing], &[nothing])[0].is_nan());
        assert_eq!(halved(&[f64::MAX, f64::MAX], &[f64::MAX, f64::MAX]), [f64::MAX]);
    }
}
