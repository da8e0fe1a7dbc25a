//! Overviews: rasters of half the columns and rows.

use crate::raster::Overviews;

/// The columns or rows of an overview.
pub(super) fn half(count: usize) -> usize {
    count.div_ceil(2)
}

/// The row of an overview of two rows, from the cells that have data among four, or among two at an odd end.
pub(super) fn halved(upper: &[f64], lower: &[f64], how: Overviews) -> Vec<f64> {
    let pairs = upper.chunks(2).zip(lower.chunks(2));
    let cell = |(upper, lower): (&[f64], &[f64])| {
        let mut known = upper.iter().chain(lower).copied().filter(|x| !x.is_nan());
        match how {
            Overviews::Means => mean(known),
            Overviews::Firsts => known.next().unwrap_or(f64::NAN),
        }
    };
    pairs.map(cell).collect()
}

/// The mean of numbers; none of none.
fn mean(numbers: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count, mut low, mut high) = (0.0, 0.0, f64::INFINITY, f64::NEG_INFINITY);
    for x in numbers {
        (sum, count, low, high) = (sum + x, count + 1.0, x.min(low), x.max(high));
    }
    // Sums of huge numbers may be infinite, means are between the numbers.
    if count == 0.0 { f64::NAN } else { (sum / count).max(low).min(high) }
}

#[cfg(test)]
mod tests {
    use super::halved;
    use crate::raster::Overviews;

    #[test]
    fn means_leave_out_what_has_no_data() {
        let nothing = f64::NAN;
        let row =
            halved(&[1.0, 2.0, nothing, nothing, 5.0], &[3.0, 6.0, nothing, 7.0, 6.0], Overviews::Means);
        assert_eq!(row, [3.0, 7.0, 5.5]);
        assert_eq!(halved(&[nothing, 2.0, 3.0], &[1.0, 4.0, 9.0], Overviews::Firsts), [2.0, 3.0]);
        assert!(halved(&[nothing], &[nothing], Overviews::Means)[0].is_nan());
        assert_eq!(halved(&[f64::MAX, f64::MAX], &[f64::MAX, f64::MAX], Overviews::Means), [f64::MAX]);
    }
}
