//! ESRI ASCII grids: six lines that say where the raster is, then its values as text, from north to south.
//!
//! Format: Esri, "Esri ASCII raster format"; GDAL's `dx` and `dy` for cells that are not square are read, not written.

use std::io::Write;

use delone::surface::Grid;

use super::{Raster, RasterInfo, Sample, placed};
use crate::error::excerpt;
use crate::{Crs, Error, Format, Source};

/// The number for no data where nothing else is said.
pub const ASC_NODATA: f64 = -9999.0;

/// Writes rows as they come.
#[derive(Debug)]
pub(super) struct Writer<W> {
    out: W,
    columns: usize,
    sample: Sample,
    nodata: String,
    text: Vec<u8>,
}

impl<W: Write> Writer<W> {
    pub(super) fn create(mut out: W, info: &RasterInfo) -> Result<Self, Error> {
        let (grid, step) = (&info.grid, info.grid.step());
        if step[0] <= 0.0 || step[0] != -step[1] {
            return Err(Error::NotSquare { format: Format::Asc, step });
        }
        let [columns, rows] = [grid.columns(), grid.rows()];
        if columns == 0 || rows == 0 {
            return Err(Error::Extent { format: Format::Asc, columns, rows });
        }
        let ([west, _], [_, south]) = (grid.corner(), grid.far_corner());
        let nodata = info.nodata.unwrap_or(ASC_NODATA);
        let nodata = if nodata.fract() == 0.0 && nodata.abs() < 1e15 {
            format!("{nodata:.0}")
        } else {
            format!("{nodata:?}")
        };
        write!(
            out,
            "ncols {columns}\nnrows {rows}\nxllcorner {west:?}\nyllcorner {south:?}\ncellsize {:?}\nNODATA_value {nodata}\n",
            step[0]
        )?;
        Ok(Self { out, columns, sample: info.sample, nodata, text: Vec::new() })
    }

    pub(super) fn write_rows(&mut self, values: &[f64]) -> std::io::Result<()> {
        for row in values.chunks_exact(self.columns) {
            self.text.clear();
            for (column, value) in row.iter().enumerate() {
                if column > 0 {
                    self.text.push(b' ');
                }
                match self.sample {
                    _ if value.is_nan() => self.text.extend_from_slice(self.nodata.as_bytes()),
                    Sample::F32 => write!(self.text, "{:?}", *value as f32)?,
                    Sample::F64 => write!(self.text, "{value:?}")?,
                    Sample::U8 => write!(self.text, "{}", value.round().clamp(0.0, 255.0))?,
                }
            }
            self.text.push(b'\n');
            self.out.write_all(&self.text)?;
        }
        Ok(())
    }

    pub(super) fn finish(mut self) -> Result<W, Error> {
        self.out.flush()?;
        Ok(self.out)
    }
}

/// The head of a file.
#[derive(Default)]
struct Head {
    columns: Option<usize>,
    rows: Option<usize>,
    /// Along each axis: where the lower left cell is, and whether that is its center.
    place: [Option<(f64, bool)>; 2],
    step: [Option<f64>; 2],
    nodata: Option<f64>,
}

impl Head {
    /// Takes a line of the head; `false` for one that is none.
    fn take(&mut self, line: &str, number: usize) -> Result<bool, Error> {
        let mut words = line.split_ascii_whitespace();
        let Some(key) = words.next().filter(|key| key.starts_with(|c: char| c.is_ascii_alphabetic())) else {
            return Ok(false);
        };
        let key = key.to_ascii_lowercase();
        if ["nan", "inf", "null"].contains(&&*key) {
            return Ok(false);
        }
        let wrong = |what: String| Error::Line { line: number, what };
        let word = words.next().unwrap_or_default();
        let value =
            || word.parse::<f64>().map_err(|_| wrong(format!("{key} is no number: {:?}", excerpt(word))));
        let count = || {
            word.parse::<usize>().map_err(|_| wrong(format!("{key} is no whole number: {:?}", excerpt(word))))
        };
        match &*key {
            "ncols" => self.columns = Some(count()?),
            "nrows" => self.rows = Some(count()?),
            "xllcorner" => self.place[0] = Some((value()?, false)),
            "yllcorner" => self.place[1] = Some((value()?, false)),
            "xllcenter" => self.place[0] = Some((value()?, true)),
            "yllcenter" => self.place[1] = Some((value()?, true)),
            "cellsize" => self.step = [Some(value()?); 2],
            "dx" => self.step[0] = Some(value()?),
            "dy" => self.step[1] = Some(value()?),
            "nodata_value" => self.nodata = Some(value()?),
            other => return Err(wrong(format!("an ASCII grid says nothing of {:?}", excerpt(other)))),
        }
        Ok(true)
    }

    fn raster(&self) -> Result<Raster, Error> {
        let missing = |name: &str| Error::content(format!("no ASCII grid: its head does not say {name}"));
        let columns = self.columns.filter(|&n| n > 0).ok_or_else(|| missing("ncols"))?;
        let rows = self.rows.filter(|&n| n > 0).ok_or_else(|| missing("nrows"))?;
        let mut corner = [0.0; 2];
        let mut step = [0.0; 2];
        for (k, name) in ["xllcorner", "yllcorner"].into_iter().enumerate() {
            step[k] = self.step[k].ok_or_else(|| missing("cellsize"))?;
            let (place, is_center) = self.place[k].ok_or_else(|| missing(name))?;
            corner[k] = if is_center { place - 0.5 * step[k] } else { place };
        }
        corner[1] += rows as f64 * step[1];
        let grid = placed(corner, [step[0], -step[1]], columns, rows)?;
        Ok(Raster { grid, crs: None, values: Vec::new(), losses: Vec::new() })
    }
}

/// The next line, if there is one.
fn next<'a>(source: &mut dyn Source, line: &'a mut Vec<u8>, number: usize) -> Result<Option<&'a str>, Error> {
    line.clear();
    if source.read_until(b'\n', line)? == 0 {
        return Ok(None);
    }
    let text = str::from_utf8(line);
    text.map(Some).map_err(|_| Error::Line { line: number, what: "it is not text".to_owned() })
}

/// Where the cells are; the system is in no file of this format.
pub(super) fn read_place(mut source: Box<dyn Source>) -> Result<(Grid, Option<Crs>), Error> {
    let (mut head, mut line) = (Head::default(), Vec::new());
    for number in 1.. {
        match next(&mut *source, &mut line, number)? {
            Some(text) if head.take(text, number)? || text.trim_ascii().is_empty() => {}
            _ => break,
        }
    }
    Ok((head.raster()?.grid, None))
}

/// Reads a grid; memory grows with the values that are really there.
pub(crate) fn read(mut source: Box<dyn Source>) -> Result<Raster, Error> {
    let mut head = Head::default();
    let mut raster = None;
    let mut line = Vec::new();
    for number in 1.. {
        let Some(text) = next(&mut *source, &mut line, number)? else { break };
        if raster.is_none() && head.take(text, number)? {
            continue;
        }
        let raster = match &mut raster {
            Some(raster) => raster,
            None if text.trim_ascii().is_empty() => continue,
            none => none.insert(head.raster()?),
        };
        let most = raster.grid.cells();
        for word in text.split_ascii_whitespace() {
            let value: f64 = word.parse().map_err(|_| Error::Line {
                line: number,
                what: format!("{:?} is no number", excerpt(word)),
            })?;
            if raster.values.len() as f64 >= most {
                let what = format!("there are more than {most} values");
                return Err(Error::Line { line: number, what });
            }
            raster.values.push(if head.nodata == Some(value) { f64::NAN } else { value });
        }
    }
    let raster = raster.map_or_else(|| head.raster(), Ok)?;
    let (found, all) = (raster.values.len(), raster.grid.cells());
    if (found as f64) < all {
        return Err(Error::Truncated(format!("after {found} of {all} values")));
    }
    Ok(raster)
}
