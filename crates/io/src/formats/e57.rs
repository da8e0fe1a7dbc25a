//! E57 scans, by the `e57` crate: the points of all scans of a file, in the coordinates they share.

use e57::{CartesianCoordinate, E57Reader};

use crate::{Cloud, Error, Source, guard, xml};

/// Reads the valid points.
pub(crate) fn read(mut source: Box<dyn Source>) -> Result<Cloud, Error> {
    let broken = |error: e57::Error| Error::content(format!("E57: {error}"));
    guard::decode("E57", || {
        xml::check(&E57Reader::raw_xml(&mut source).map_err(broken)?)?;
        source.rewind()?;
        let mut reader = E57Reader::new(source).map_err(broken)?;
        let mut cloud = Cloud::with_capacity(0, true);
        let mut invalid = 0_usize;
        let (mut has_colors, mut has_intensities) = (false, false);
        for scan in reader.pointclouds() {
            has_colors |= scan.has_color();
            has_intensities |= scan.has_intensity();
            for point in reader.pointcloud_simple(&scan).map_err(broken)? {
                match point.map_err(broken)?.cartesian {
                    CartesianCoordinate::Valid { x, y, z } => cloud.push([x, y], z),
                    _ => invalid += 1,
                }
            }
        }
        let values = [("color", has_colors), ("intensity", has_intensities)];
        cloud.lose_values(values.into_iter().filter(|value| value.1).map(|value| value.0));
        if invalid > 0 {
            cloud.remarks.push(format!("{invalid} measurements without a position were left out"));
        }
        Ok(cloud)
    })
}
