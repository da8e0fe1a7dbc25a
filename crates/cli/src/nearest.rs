//! `delone nearest`: for each query the vertices nearest to it.

use crate::args::NearestArgs;
use crate::message::Failure;
use crate::queries::answer;
use crate::room::Room;

pub(crate) fn run<R: Room>(args: &NearestArgs, quiet: bool) -> Result<(), Failure> {
    let k = args.k as usize;
    let names: Vec<String> = match k {
        1 => vec!["nearest".to_owned()],
        _ => (1..=k).map(|i| format!("nearest_{i}")).collect(),
    };
    answer::<R>(&args.input, &args.query, &names, quiet, |d, q, work| {
        let found =
            if k == 1 { d.nearest_observed(q, work)?.into_iter().collect() } else { d.k_nearest(q, k)? };
        Ok(found.into_iter().map(|v| v.index()).collect())
    })
}
