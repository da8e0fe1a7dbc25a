//! A quantity measured several times: its mean, and how well that is known.

use std::fmt;

use super::table::short;

/// Measured values of one quantity.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trials {
    values: Vec<f64>,
}

impl Trials {
    pub(crate) fn add(&mut self, value: f64) {
        self.values.push(value);
    }

    /// The mean; NaN of nothing.
    pub(crate) fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }

    /// The standard deviation of the values, estimated from them; zero of a single one.
    pub(crate) fn deviation(&self) -> f64 {
        let mean = self.mean();
        let squares: f64 = self.values.iter().map(|value| (value - mean).powi(2)).sum();
        (squares / (self.values.len().max(2) - 1) as f64).sqrt()
    }

    /// The standard error of the mean, estimated from the values; zero of a single one.
    pub(crate) fn error(&self) -> f64 {
        self.deviation() / (self.values.len().max(1) as f64).sqrt()
    }

    /// The quantity in another unit.
    pub(crate) fn over(&self, unit: f64) -> Self {
        self.values.iter().map(|value| value / unit).collect()
    }

    /// The largest.
    pub(crate) fn most(&self) -> f64 {
        self.values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }
}

impl Extend<f64> for Trials {
    fn extend<I: IntoIterator<Item = f64>>(&mut self, values: I) {
        self.values.extend(values);
    }
}

impl FromIterator<f64> for Trials {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        Self { values: values.into_iter().collect() }
    }
}

/// Mean and standard error: `27.4 ± 0.3`; the value alone, if there is one.
impl fmt::Display for Trials {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.values.len() {
            0 => write!(f, "-"),
            1 => write!(f, "{}", short(self.mean())),
            _ => write!(f, "{} ± {}", short(self.mean()), decimals(self.error(), self.mean())),
        }
    }
}

/// An error with as many decimals as its mean is given with.
fn decimals(error: f64, mean: f64) -> String {
    let digits = match mean.abs() {
        x if x >= 100.0 => 0,
        x if x >= 10.0 => 1,
        x if x >= 1.0 => 2,
        x if x >= 0.1 => 3,
        _ => 4,
    };
    format!("{error:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::Trials;

    #[test]
    fn mean_and_error() {
        let trials: Trials = [2.0, 4.0, 6.0].into_iter().collect();
        assert_eq!(trials.to_string(), "4.00 ± 1.15");
        assert_eq!(trials.deviation(), 2.0);
        assert_eq!(trials.over(2.0).to_string(), "2.00 ± 0.58");
        assert_eq!(trials.most(), 6.0);
        assert_eq!(Trials::default().to_string(), "-");
        assert_eq!([7.25].into_iter().collect::<Trials>().to_string(), "7.25");
    }
}
