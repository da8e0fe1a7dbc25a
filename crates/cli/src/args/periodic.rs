//! Arguments of cells: boxes that repeat, and decimal grids.

use clap::Args;
use delone::{DecimalGrid, Grid, Lattice};
use delone_io::{LeastFace, UnitCell};

use crate::message::{Failure, note};

/// Boxes that repeat, and grids.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Boxes")]
pub(crate) struct PeriodicArgs {
    /// The box repeats: its three sides LX,LY,LZ; or LX,LY,LZ,XY,XZ,YZ, with tilt factors as in LAMMPS; or the nine numbers of its axes, one axis after
    /// the other; in the plane LX,LY, or LX,LY,XY, or four numbers; without numbers the box of the file (lammpstrj extxyz). Points may be outside of it. Nothing is clipped along axes that repeat.
    #[arg(long, value_name = "BOX", num_args = 0..=1, default_missing_value = "auto", value_parser = parse_box, allow_negative_numbers = true, conflicts_with_all = ["bounds", "clip"])]
    pub(crate) periodic: Option<PeriodicBox>,
    /// The axes along which the box repeats, by letters (`xy`) or a word for each axis (`1,1,0`, `T,T,F`, `p,p,f`); cells end at the walls of the box
    /// along others [default: what the file tells of its box, all of a box of numbers].
    #[arg(long, value_name = "AXES", value_parser = parse_axes, requires = "periodic")]
    pub(crate) axes: Option<RepeatingAxes>,
    /// Where the box begins, which matters for walls [default: what the file tells of its box, 0,0,0 for a box of numbers].
    #[arg(
        long,
        value_name = "X,Y,Z",
        value_delimiter = ',',
        num_args = 1,
        allow_hyphen_values = true,
        requires = "periodic"
    )]
    pub(crate) origin: Vec<f64>,
    /// In space, count neighbors: cells that share a face of at least this area, in coordinate units squared. csv, json and vtu have `neighbors` then. So
    /// faces that rounding makes do not count; cells stay as they are.
    #[arg(long, value_name = "AREA", value_parser = super::length)]
    pub(crate) min_area: Option<f64>,
    /// As `--min-area`, with faces of at least this part of the surface of the cell, as 1e-6.
    #[arg(long, value_name = "PART", value_parser = super::length)]
    pub(crate) min_relative_area: Option<f64>,
    /// Take coordinates for decimals: multiples of STEP, or of the power of ten that all are multiples of but for rounding (`auto`). So
    /// crystals have no faces that rounding makes.
    #[arg(long, value_name = "auto|STEP", value_parser = parse_grid, allow_negative_numbers = true)]
    pub(crate) grid: Option<GridChoice>,
}

/// The box that repeats.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum PeriodicBox {
    /// That of the file.
    OfFile,
    /// Its sides, with tilt factors or not, or its axes.
    Numbers(Vec<f64>),
}

/// Along which axes a box repeats.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum RepeatingAxes {
    /// Some of x, y and z.
    Letters(String),
    /// A flag for each axis.
    Flags(Vec<bool>),
}

/// Which grid is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum GridChoice {
    Auto,
    Step(DecimalGrid),
}

impl PeriodicArgs {
    /// Refuses what is not for the plane.
    pub(crate) fn refuse_in_plane(&self) -> Result<(), Failure> {
        if self.least().is_some() {
            let what = "--min-area and --min-relative-area are for cells in space";
            return Err(Failure::usage(what, "add --dim 3"));
        }
        if self.periodic.is_none() && self.grid.is_some() {
            return Err(Failure::usage(
                "--grid is for cells in space, or in boxes",
                "add --dim 3, or a box as --periodic LX,LY, which has walls all around with --axes 0,0",
            ));
        }
        Ok(())
    }

    /// Which faces are those of neighbors, if these are to be counted.
    pub(crate) fn least(&self) -> Option<LeastFace> {
        let (area, part) = (self.min_area, self.min_relative_area);
        area.or(part).map(|_| LeastFace { area: area.unwrap_or(0.0), part: part.unwrap_or(0.0) })
    }

    /// The box by its numbers, on the grid that is asked for; none if it is that of the file, or if there is none.
    ///
    /// # Errors
    /// Numbers that are no box, or are not for these dimensions.
    pub(crate) fn of_numbers<const D: usize>(&self) -> Result<Option<Lattice<D>>, Failure> {
        let Some(PeriodicBox::Numbers(numbers)) = &self.periodic else { return Ok(None) };
        let axes = axes_of(numbers)?;
        let periodic = self.repeating()?.unwrap_or([true; D]);
        self.lattice(axes, periodic, self.begins()?.unwrap_or([0.0; D])).map(Some)
    }

    /// The box that a file tells, with the axes and the beginning that are asked for.
    ///
    /// # Errors
    /// A box that none can repeat, or that is not for these dimensions.
    pub(crate) fn of_cell<const D: usize>(
        &self,
        cell: &UnitCell,
        quiet: bool,
    ) -> Result<Lattice<D>, Failure> {
        let first = |p: [f64; 3]| std::array::from_fn(|k| p[k]);
        let is_across = |i: usize, k: usize| (i < D) != (k < D) && cell.axes[i][k] != 0.0;
        if (0..3).any(|i| (0..3).any(|k| is_across(i, k))) {
            return Err(Failure::new(
                format!("{cell}: that is no box of the plane"),
                "give that of the plane as --periodic LX,LY, or add --dim 3",
            ));
        }
        let periodic = std::array::from_fn(|k| cell.periodic[k]);
        let (asked, begins) = (self.repeating()?, self.begins()?);
        if asked.is_some_and(|asked| asked != periodic) {
            note(quiet, "--axes is taken: the file says otherwise");
        }
        let axes = std::array::from_fn(|axis| first(cell.axes[axis]));
        self.lattice(axes, asked.unwrap_or(periodic), begins.unwrap_or(first(cell.origin)))
    }

    /// Tells where a file says that its box does not repeat, but the one that is taken does.
    pub(crate) fn compare(&self, cell: Option<&UnitCell>, quiet: bool) {
        let is_told = self.axes.is_some() || self.periodic.is_none();
        if let Some(cell) = cell.filter(|cell| !is_told && cell.periodic != [true; 3]) {
            let axes = ["x", "y", "z"].into_iter().zip(cell.periodic).filter(|axis| axis.1);
            let axes: String = axes.map(|axis| axis.0).collect();
            let axes = if axes.is_empty() { "0,0,0" } else { &axes };
            note(
                quiet,
                format_args!(
                    "the box of --periodic repeats along all axes; that of the file does as with --axes {axes}"
                ),
            );
        }
    }

    fn repeating<const D: usize>(&self) -> Result<Option<[bool; D]>, Failure> {
        let Some(axes) = &self.axes else { return Ok(None) };
        let found = match axes {
            RepeatingAxes::Letters(letters) => {
                let names = ["x", "y", "z"];
                let is_here = |letter: char| names[..D].iter().any(|name| name.contains(letter));
                letters.chars().all(is_here).then(|| std::array::from_fn(|k| letters.contains(names[k])))
            }
            RepeatingAxes::Flags(flags) => flags.as_slice().try_into().ok(),
        };
        found.map(Some).ok_or_else(|| {
            Failure::usage(
                format!("--axes is not for {D} dimensions"),
                if D == 2 { "as in --axes x, or --axes 1,0" } else { "as in --axes xy, or --axes 1,1,0" },
            )
        })
    }

    fn begins<const D: usize>(&self) -> Result<Option<[f64; D]>, Failure> {
        if self.origin.is_empty() {
            return Ok(None);
        }
        let origin: Option<[f64; D]> = self.origin.as_slice().try_into().ok();
        origin.filter(|origin| origin.iter().all(|x| x.is_finite())).map(Some).ok_or_else(|| {
            Failure::usage(
                format!("--origin takes {D} finite numbers"),
                "give the corner where the box begins",
            )
        })
    }

    fn lattice<const D: usize>(
        &self,
        axes: [[f64; D]; D],
        periodic: [bool; D],
        origin: [f64; D],
    ) -> Result<Lattice<D>, Failure> {
        if axes.as_flattened().iter().all(|x| x.is_finite())
            && let Some(axis) = axes.iter().position(|axis| *axis == [0.0; D])
        {
            return Err(Failure::usage(
                format!("--periodic: axis {axis} of the box, counted from 0, is zero"),
                "give each axis a length: along those that do not repeat cells end at the walls of the box",
            ));
        }
        let lattice = Lattice::with_axes(axes).map_err(|error| {
            Failure::usage(
                format!("--periodic: {error}"),
                "give positive sides, as in --periodic 10,10,10, or three axes that are right-handed",
            )
        })?;
        Ok(lattice.periodic(periodic).origin(origin).grid(match self.grid {
            None => Grid::Binary,
            Some(GridChoice::Auto) => Grid::Auto,
            Some(GridChoice::Step(grid)) => Grid::Decimal(grid),
        }))
    }
}

/// The axes of a box by its numbers: sides, sides and tilt factors, or all coordinates.
fn axes_of<const D: usize>(numbers: &[f64]) -> Result<[[f64; D]; D], Failure> {
    let mut axes = [[0.0; D]; D];
    if numbers.len() == D * D {
        axes.as_flattened_mut().copy_from_slice(numbers);
        return Ok(axes);
    }
    // Tilt factors in the order of LAMMPS: xy, xz, yz.
    let tilts = (1..D).flat_map(|axis| (0..axis).map(move |k| (axis, k)));
    let places: Vec<(usize, usize)> = (0..D).map(|axis| (axis, axis)).chain(tilts).collect();
    if numbers.len() != D && numbers.len() != places.len() {
        return Err(Failure::usage(
            format!(
                "--periodic: {} numbers, where a box has {D}, {} or {}",
                numbers.len(),
                places.len(),
                D * D
            ),
            "give the sides of the box, as in --periodic 10,10,10",
        ));
    }
    places.into_iter().zip(numbers).for_each(|((axis, k), &x)| axes[axis][k] = x);
    Ok(axes)
}

fn parse_box(text: &str) -> Result<PeriodicBox, String> {
    if text == "auto" {
        return Ok(PeriodicBox::OfFile);
    }
    let number = |word: &str| {
        let word = word.trim();
        word.parse::<f64>().map_err(|_| format!("{word:?} is not a number"))
    };
    text.split(',').map(number).collect::<Result<_, _>>().map(PeriodicBox::Numbers)
}

fn parse_axes(text: &str) -> Result<RepeatingAxes, String> {
    let text = text.trim().to_lowercase();
    if !text.is_empty() && text.chars().all(|letter| "xyz".contains(letter)) {
        return Ok(RepeatingAxes::Letters(text));
    }
    let flag = |word: &str| match word {
        "1" | "t" | "true" | "p" | "pp" => Ok(true),
        // As LAMMPS has fixed and shrunk sides.
        "0" | "f" | "false" | "ff" | "s" | "ss" | "m" | "mm" | "fs" | "sf" | "fm" | "mf" | "sm" | "ms" => {
            Ok(false)
        }
        _ => Err(format!(
            "letters of axes, as xy, or words as 1,1,0, T,T,F or p,p,f are expected, not {word:?}"
        )),
    };
    let words = text.split([',', ' ']).filter(|word| !word.is_empty());
    let flags = words.map(flag).collect::<Result<Vec<_>, _>>()?;
    if flags.is_empty() {
        flag("").map(|_| RepeatingAxes::Flags(flags))
    } else {
        Ok(RepeatingAxes::Flags(flags))
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
    use super::PeriodicBox::{Numbers, OfFile};
    use super::RepeatingAxes::{Flags, Letters};
    use super::{GridChoice, PeriodicArgs, axes_of, parse_axes, parse_box, parse_grid};

    #[test]
    fn boxes_are_sides_tilts_or_axes() {
        let axes = |numbers: &[f64]| axes_of::<3>(numbers).map_err(|error| error.to_string());
        let cube = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
        assert_eq!(axes(&[2.0; 3]), Ok(cube));
        assert_eq!(axes(&[2.0, 2.0, 2.0, 0.0, 0.0, 0.0]), Ok(cube));
        assert_eq!(axes(cube.as_flattened()), Ok(cube));
        // As LAMMPS has them: b leans along x, c along x and y.
        let tilted = axes(&[4.0, 5.0, 6.0, -1.0, 2.0, 3.0]);
        assert_eq!(tilted, Ok([[4.0, 0.0, 0.0], [-1.0, 5.0, 0.0], [2.0, 3.0, 6.0]]));
        assert!(axes(&[1.0, 2.0]).expect_err("two").contains("2 numbers, where a box has 3, 6 or 9"));
        let flat = |numbers: &[f64]| axes_of::<2>(numbers).ok();
        assert_eq!(flat(&[2.0, 3.0]), Some([[2.0, 0.0], [0.0, 3.0]]));
        assert_eq!(flat(&[2.0, 3.0, 1.0]), Some([[2.0, 0.0], [1.0, 3.0]]));
        assert_eq!(flat(&[2.0, 1.0, 0.5, 3.0]), Some([[2.0, 1.0], [0.5, 3.0]]));
        assert_eq!(flat(&[2.0; 6]), None);
        assert_eq!(parse_box(" 2, 0"), Ok(Numbers(vec![2.0, 0.0])));
        assert_eq!(parse_box("auto"), Ok(OfFile));
        for (text, flaw) in [("1,2,x", "\"x\" is not a number"), ("", "not a number")] {
            assert!(parse_box(text).expect_err(text).contains(flaw), "{text}");
        }
    }

    #[test]
    fn axes_are_letters_or_flags() {
        assert_eq!(parse_axes("XY"), Ok(Letters("xy".to_owned())));
        for text in ["1,1,0", "T T F", "p,p,f", "true, true, false", "pp,pp,ss"] {
            assert_eq!(parse_axes(text), Ok(Flags(vec![true, true, false])), "{text}");
        }
        for text in ["", ",", "xw", "1,2,0"] {
            assert!(parse_axes(text).is_err(), "{text}");
        }
        let along = |text: &str| PeriodicArgs { axes: parse_axes(text).ok(), ..PeriodicArgs::default() };
        assert_eq!(along("zx").repeating::<3>().ok(), Some(Some([true, false, true])));
        assert_eq!(along("y").repeating::<2>().ok(), Some(Some([false, true])));
        assert!(along("z").repeating::<2>().is_err() && along("1,1").repeating::<3>().is_err());
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
