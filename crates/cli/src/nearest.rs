//! `delone nearest`: for each query the vertices nearest to it.

use delone::{Ask, Work};

use crate::args::NearestArgs;
use crate::locate::answer;
use crate::message::Failure;
use crate::space;

pub(crate) fn run(args: &NearestArgs, quiet: bool) -> Result<(), Failure> {
    let k = args.k as usize;
    if args.dim.is_space() {
        return space::nearest(&args.input, &args.query, k, quiet);
    }
    let mut work = Work::default();
    answer(&args.input, &args.query, k, quiet, |triangulation, q, row| {
        let end = row.len() + k;
        if k == 1 {
            row.extend(triangulation.nearest_observed(q, &mut work)?.map(|v| v.index() as i64));
        } else {
            row.extend(triangulation.k_nearest(q, k)?.iter().map(|v| v.index() as i64));
        }
        row.resize(end, -1);
        Ok(work)
    })
}
