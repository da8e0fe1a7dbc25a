//! Values between points.

use delone_library::surface::{Contours, Interpolator, Levels, Outside};

use crate::planes;
use crate::tray;

export! {
    /// Leaves values at the points on the tray, from a value for each point of the triangulation as numbers on it. `method`: 0 linear,
    /// 1 natural neighbors by areas (Sibson), 2 by edges (Laplace). `outside` of the hull: 0 NaN, 1 the nearest
    /// point's, 2 that at the nearest place of the hull.
    fn interpolate(plane: usize, method: u32, outside: u32) -> i32 {
        let (queries, values) = (tray::points(), tray::numbers());
        planes::with(plane, |plane| {
            let d = &plane.triangulation;
            let f = match method {
                0 => Interpolator::linear(d),
                1 => Interpolator::sibson(d),
                _ => Interpolator::laplace(d),
            };
            let f = f.outside(match outside {
                0 => Outside::Nothing,
                1 => Outside::Nearest,
                _ => Outside::Hull,
            });
            tray::leave_floats(0, f.many(&queries, &values, 1)?);
            Ok(0)
        })
    }

    /// Leaves contour lines of the surface over the triangles: values of the points are the numbers on the tray, followed by so many
    /// levels. As integers: where each line ends, in coordinates, and whether it is closed. As numbers: coordinates, and levels.
    fn contours(plane: usize, levels: usize) -> i32 {
        let mut values = tray::numbers();
        let levels = values.split_off(values.len().saturating_sub(levels));
        planes::with(plane, |plane| {
            let lines = Contours::new(&plane.triangulation, &values)?.lines(&Levels::given(&levels)?)?;
            let (mut ends, mut coordinates) = (Vec::new(), Vec::new());
            for line in &lines {
                coordinates.extend(line.points.as_flattened());
                ends.push(coordinates.len() as u32);
            }
            tray::leave_ints(0, ends);
            tray::leave_ints(1, lines.iter().map(|line| u32::from(line.is_closed)).collect());
            tray::leave_floats(0, coordinates);
            tray::leave_floats(1, lines.iter().map(|line| line.level).collect());
            Ok(0)
        })
    }
}
