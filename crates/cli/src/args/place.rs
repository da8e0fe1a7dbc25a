//! Where the cells of a raster are.

use std::path::PathBuf;

use clap::Args;

/// The place of a raster.
#[derive(Debug, Args)]
pub(crate) struct PlaceArgs {
    /// The area that cells cover, instead of that of the points: the least x and y, then the largest.
    #[arg(
        long, value_name = "X0,Y0,X1,Y1", value_parser = numbers::<4>, allow_hyphen_values = true, help_heading = "Cells"
    )]
    pub(crate) extent: Option<[f64; 4]>,
    /// A corner of cells, which the others are multiples of their size away from [default: 0,0].
    #[arg(long, value_name = "X,Y", value_parser = numbers::<2>, allow_hyphen_values = true, help_heading = "Cells")]
    pub(crate) origin: Option<[f64; 2]>,
    /// A raster (tif asc) whose cells these are, with its system of coordinates.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["extent", "origin"], help_heading = "Cells")]
    pub(crate) like: Option<PathBuf>,
}

/// `N` finite numbers between commas.
fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
    let numbers: Option<[f64; N]> = numbers.ok().and_then(|numbers| numbers.try_into().ok());
    let numbers = numbers.filter(|numbers| numbers.iter().all(|x| x.is_finite()));
    let numbers = numbers.ok_or_else(|| format!("{N} numbers with commas between them are wanted"))?;
    if N == 4 && (0..2).any(|k| numbers[k] >= numbers[k + 2]) {
        return Err("the least x and y come first, then the largest".to_owned());
    }
    Ok(numbers)
}

#[cfg(test)]
mod tests {
    use super::numbers;

    #[test]
    fn numbers_are_as_many_as_wanted() {
        assert_eq!(numbers::<2>("-1, 2.5"), Ok([-1.0, 2.5]));
        assert_eq!(numbers::<4>("0,0,1,2"), Ok([0.0, 0.0, 1.0, 2.0]));
        for text in ["", "1", "1,2,3", "1,x", "nan,1", "inf,1"] {
            assert!(numbers::<2>(text).is_err(), "{text}");
        }
        assert!(numbers::<4>("0,0,0,2").is_err());
        assert!(numbers::<4>("0,3,1,2").is_err());
    }
}
