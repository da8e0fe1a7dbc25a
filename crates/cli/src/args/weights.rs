//! Arguments of commands with weights.

use std::path::Path;

use clap::Args;

/// Weights of points: their regular triangulation, instead of the Delaunay one.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Weights")]
pub(crate) struct WeightArgs {
    /// Weights of the points, squared radii: a file with one for each (npy csv txt), or a column of the text input by name or
    /// number from 1.
    #[arg(long, value_name = "FILE|COLUMN", conflicts_with = "radii")]
    pub(crate) weights: Option<String>,
    /// Radii of the points, which are squared, rounded once: as for --weights.
    #[arg(long, value_name = "FILE|COLUMN")]
    pub(crate) radii: Option<String>,
}

impl WeightArgs {
    /// Where the numbers are.
    pub(crate) fn given(&self) -> Option<&str> {
        self.weights.as_deref().or(self.radii.as_deref())
    }

    /// The weight that a number means, or what is wrong with it.
    pub(crate) fn weight(&self, number: f64) -> Result<f64, String> {
        let is_radius = self.radii.is_some();
        let (what, weight) = if is_radius { ("radius", number * number) } else { ("weight", number) };
        let flaw = if !number.is_finite() {
            "which is not finite"
        } else if is_radius && number < 0.0 {
            "which is negative"
        } else if !weight.is_finite() {
            "whose square is too large for a number"
        } else {
            return Ok(weight);
        };
        Err(format!("the {what} {number:?}, {flaw}"))
    }

    /// The file that is read beside the points, if one is.
    pub(crate) fn file(&self) -> Option<&Path> {
        self.given().map(Path::new).filter(|path| path.exists())
    }
}
