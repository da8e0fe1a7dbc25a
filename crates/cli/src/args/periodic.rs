//! Arguments of cells in space: boxes that repeat, and decimal grids.

use clap::Args;
use delone::{DecimalGrid, Grid, Lattice3};

use crate::message::Failure;

/// Cells of space alone.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Space")]
pub(crate) struct PeriodicArgs {
    /// The box repeats along all of its axes: its three sides LX,LY,LZ; or LX,LY,LZ,XY,XZ,YZ, with tilt factors as in LAMMPS; or the nine
    /// numbers of its axes, one axis after the other; without numbers the box of the file (lammpstrj extxyz). Points may be outside of it.
    /// Nothing is clipped.
    #[arg(long, value_name = "BOX", num_args = 0..=1, default_missing_value = "auto", value_parser = parse_box, allow_negative_numbers = true, conflicts_with_all = ["bounds", "clip"])]
    pub(crate) periodic: Option<PeriodicBox>,
    /// Take coordinates for decimals: multiples of STEP, or of the power of ten that all are multiples of but for rounding (`auto`). So
    /// crystals have no faces that rounding makes.
    #[arg(long, value_name = "auto|STEP", value_parser = parse_grid, allow_negative_numbers = true)]
    pub(crate) grid: Option<GridChoice>,
}

/// The box that repeats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PeriodicBox {
    /// That of the file.
    OfFile,
    /// By its axes, one a row.
    Axes([[f64; 3]; 3]),
}

/// Which grid is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum GridChoice {
    Auto,
    Step(DecimalGrid),
}

impl PeriodicArgs {
    /// The option that is given, if one is.
    pub(crate) fn option(&self) -> Option<&'static str> {
        let periodic = self.periodic.map(|_| "--periodic");
        periodic.or(self.grid.map(|_| "--grid"))
    }

    /// A box that repeats, on the grid that is asked for.
    ///
    /// # Errors
    /// Axes that span no box.
    pub(crate) fn lattice(&self, axes: [[f64; 3]; 3]) -> Result<Lattice3, Failure> {
        if axes.as_flattened().iter().all(|x| x.is_finite())
            && let Some(axis) = axes.iter().position(|axis| *axis == [0.0; 3])
        {
            return Err(Failure::usage(
                format!("--periodic: axis {axis} of the box, counted from 0, is zero"),
                "give a box that repeats along all axes: cells of others are not bounded, and not made yet",
            ));
        }
        let lattice = Lattice3::with_axes(axes).map_err(|error| {
            Failure::usage(
                format!("--periodic: {error}"),
                "give positive sides, as in --periodic 10,10,10, or three axes that are right-handed",
            )
        })?;
        Ok(lattice.grid(match self.grid {
            None => Grid::Binary,
            Some(GridChoice::Auto) => Grid::Auto,
            Some(GridChoice::Step(grid)) => Grid::Decimal(grid),
        }))
    }
}

fn parse_box(text: &str) -> Result<PeriodicBox, String> {
    if text == "auto" {
        return Ok(PeriodicBox::OfFile);
    }
    let number = |word: &str| {
        let word = word.trim();
        word.parse::<f64>().map_err(|_| format!("{word:?} is not a number"))
    };
    let numbers = text.split(',').map(number).collect::<Result<Vec<f64>, String>>()?;
    match numbers[..] {
        [x, y, z] => Ok(PeriodicBox::Axes([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]])),
        [x, y, z, xy, xz, yz] => Ok(PeriodicBox::Axes([[x, 0.0, 0.0], [xy, y, 0.0], [xz, yz, z]])),
        [ax, ay, az, bx, by, bz, cx, cy, cz] => {
            Ok(PeriodicBox::Axes([[ax, ay, az], [bx, by, bz], [cx, cy, cz]]))
        }
        _ => Err(format!("{} numbers, where a box has 3, 6 or 9", numbers.len())),
    }
}

fn parse_grid(text: &str) -> Result<GridChoice, String> {
    if text == "auto" {
        return Ok(GridChoice::Auto);
    }
    let step = text.parse().map_err(|_| "a step, or `auto`, is expected".to_owned())?;
    DecimalGrid::with_step(step).map(GridChoice::Step).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::PeriodicBox::{Axes, OfFile};
    use super::{GridChoice, parse_box, parse_grid};

    #[test]
    fn boxes_are_three_six_or_nine_numbers() {
        let cube = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
        assert_eq!(parse_box("2,2,2"), Ok(Axes(cube)));
        assert_eq!(parse_box("2,2,2,0,0,0"), Ok(Axes(cube)));
        assert_eq!(parse_box(" 2, 0,0, 0,2,0, 0,0,2"), Ok(Axes(cube)));
        // As LAMMPS has them: b leans along x, c along x and y.
        assert_eq!(parse_box("4,5,6,-1,2,3"), Ok(Axes([[4.0, 0.0, 0.0], [-1.0, 5.0, 0.0], [2.0, 3.0, 6.0]])));
        assert_eq!(parse_box("auto"), Ok(OfFile));
        for (text, flaw) in [("1,2", "2 numbers"), ("1,2,x", "\"x\" is not a number"), ("", "not a number")] {
            assert!(parse_box(text).expect_err(text).contains(flaw), "{text}");
        }
    }

    #[test]
    fn grids_are_steps() {
        assert_eq!(parse_grid("auto"), Ok(GridChoice::Auto));
        assert!(matches!(parse_grid("1e-9"), Ok(GridChoice::Step(grid)) if grid.step() == 1e-9));
        for text in ["0", "-1", "inf", "fine"] {
            assert!(parse_grid(text).is_err(), "{text}");
        }
    }
}
