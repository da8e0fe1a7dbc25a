//! Which points of LAS, LAZ and EPT are read, and what of them.

use clap::Args;
use delone_io::{LAS_CLASSES, LasFilter, LasFlag, Returns};

/// Which points of LAS, LAZ and EPT are read, and what of them.
#[derive(Clone, Debug, Default, Args)]
pub struct LasArgs {
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
    /// Box of the LAS points to keep, with its border. Of COPC and EPT the nodes that do not meet it are not read.
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = rectangle, allow_hyphen_values = true)]
    within: Option<[f64; 4]>,
    /// Dimensions of LAS points that go along as attributes, separated by commas: intensity, gps_time, red, ..., or names of extra bytes.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub(crate) attributes: Vec<String>,
}

impl LasArgs {
    /// The filter of the library.
    pub(crate) fn filter(&self) -> LasFilter {
        LasFilter::default()
            .classes(self.class.clone())
            .returns(self.returns.unwrap_or_default())
            .skip(self.skip.clone())
            .withheld(self.withheld)
            .heights(self.z_range)
            .within(self.within)
    }

    /// The first option that was given.
    pub(crate) fn option(&self) -> Option<&'static str> {
        let given = [
            (!self.class.is_empty(), "--class"),
            (self.returns.is_some(), "--returns"),
            (!self.skip.is_empty(), "--skip"),
            (self.withheld, "--withheld"),
            (self.z_range.is_some(), "--z-range"),
            (self.within.is_some(), "--within"),
            (!self.attributes.is_empty(), "--attributes"),
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

/// Numbers that commas are between.
fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(',').map(|number| number.trim().parse().ok()).collect()
}

/// A box in the plane: its lower left corner and its upper right one.
fn rectangle(text: &str) -> Result<[f64; 4], String> {
    match numbers(text).as_deref() {
        Some(&[x0, y0, x1, y1]) if x0 <= x1 && y0 <= y1 => Ok([x0, y0, x1, y1]),
        _ => Err("a box is four numbers, the least x and y first: 500,900,600,1000".to_owned()),
    }
}

/// Two numbers, the second not less than the first.
fn range(text: &str) -> Result<[f64; 2], String> {
    match numbers(text).as_deref() {
        Some(&[low, high]) if low <= high => Ok([low, high]),
        _ => Err("a range is two numbers, the lower one first: 0,150".to_owned()),
    }
}
