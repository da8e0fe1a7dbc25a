//! Boxes of periodic sets, as files tell them.

use std::fmt;

/// A box whose content repeats along some of its axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitCell {
    /// The axes, one a row.
    pub axes: [[f64; 3]; 3],
    /// Along which axes it repeats.
    pub periodic: [bool; 3],
    /// Where it begins.
    pub origin: [f64; 3],
}

impl fmt::Display for UnitCell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let axis = |axis: &[f64; 3]| format!("({})", axis.map(|x| format!("{x:?}")).join(", "));
        write!(f, "the box has the axes {}", self.axes.each_ref().map(axis).join(", "))?;
        if self.origin != [0.0; 3] {
            write!(f, ", begins at {}", axis(&self.origin))?;
        }
        match self.periodic {
            [true, true, true] => write!(f, " and repeats along all"),
            [false, false, false] => write!(f, " and does not repeat"),
            periodic => {
                let along = ["first", "second", "third"].into_iter().zip(periodic).filter(|axis| axis.1);
                let along: Vec<&str> = along.map(|axis| axis.0).collect();
                write!(f, " and repeats along the {} alone", along.join(" and the "))
            }
        }
    }
}
