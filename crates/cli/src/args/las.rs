//! Which points of LAS and LAZ files are read.

use clap::Args;
use delone_io::{LAS_CLASSES, LasFilter, LasFlag, Returns};

/// Which points of LAS and LAZ files are read.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct LasArgs {
    /// LAS classes to keep, by number or name (ground, building, water, ...), separated by commas.
    #[arg(long, value_name = "CLASS", value_delimiter = ',', value_parser = class)]
    pub(crate) class: Vec<u8>,
    /// Returns of LAS files to keep: first, last, only, or a number [default: all].
    #[arg(long, value_name = "WHICH", value_parser = str::parse::<Returns>)]
    returns: Option<Returns>,
    /// Flags of LAS points that are left out: synthetic, key-point, overlap, separated by commas.
    #[arg(long, value_name = "FLAG", value_delimiter = ',', value_parser = str::parse::<LasFlag>)]
    skip: Vec<LasFlag>,
    /// Take points of LAS files that are withheld too, which are left out otherwise.
    #[arg(long)]
    withheld: bool,
    /// Heights of LAS points to keep: the lowest and the highest.
    #[arg(long, value_name = "LOW,HIGH", value_parser = range, allow_hyphen_values = true)]
    z_range: Option<[f64; 2]>,
}

impl LasArgs {
    /// The filter of the library.
    pub(crate) fn filter(&self) -> LasFilter {
        LasFilter {
            classes: self.class.clone(),
            returns: self.returns.unwrap_or_default(),
            skip: self.skip.clone(),
            withheld: self.withheld,
            heights: self.z_range,
        }
    }

    /// The first option that was given.
    pub(crate) fn option(&self) -> Option<&'static str> {
        let given = [
            (!self.class.is_empty(), "--class"),
            (self.returns.is_some(), "--returns"),
            (!self.skip.is_empty(), "--skip"),
            (self.withheld, "--withheld"),
            (self.z_range.is_some(), "--z-range"),
        ];
        given.into_iter().find(|option| option.0).map(|option| option.1)
    }
}

/// A LAS class by its number or its name.
fn class(text: &str) -> Result<u8, String> {
    let named = LAS_CLASSES.iter().find(|(name, _)| text.eq_ignore_ascii_case(name)).map(|class| class.1);
    named.or_else(|| text.parse().ok()).ok_or_else(|| {
        let names: Vec<&str> = LAS_CLASSES.iter().map(|class| class.0).collect();
        format!("a class is a number up to 255 or one of {}", names.join(", "))
    })
}

/// Two numbers, the second not less than the first.
fn range(text: &str) -> Result<[f64; 2], String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[low, high]) if low <= high => Ok([low, high]),
        _ => Err("a range is two numbers, the lower one first: 0,150".to_owned()),
    }
}
