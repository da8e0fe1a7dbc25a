//! The end of a command: remarks, a proof, counts and files of a triangulation.

use std::path::PathBuf;

use delone::tiles::Fingerprint;
use delone_io::{Cloud, Format, picture, write_mesh};

use crate::args::TriangulateArgs;
use crate::files;
use crate::message::{Failure, answer, note};
use crate::progress::Phase;
use crate::room::{self, Room};
use crate::stats::Stats;

/// Remarks, checks, counts and writes.
pub(crate) fn finish<R: Room>(
    args: &TriangulateArgs,
    outputs: &[(PathBuf, Format)],
    d: &R,
    points: &[R::Point],
    about: &Cloud,
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    room::remark(d, quiet);
    if args.check {
        let _phase = Phase::start(quiet, "checking");
        d.check().map_err(|flaw| {
            Failure::new(
                format!("the triangulation is wrong: {flaw}"),
                "please report this with the input: it is a bug",
            )
        })?;
        stats.phase("check");
        note(quiet, "checked: this is the canonical Delaunay triangulation");
    }
    stats.triangulation(d, d.counters());
    if args.fingerprint {
        let fingerprint = Fingerprint::of(d).to_string();
        answer(&format!("{fingerprint}\n"))?;
        stats.set("fingerprint", fingerprint);
        stats.phase("fingerprint");
    }
    let trim = room::trim_border(d, &args.border(), stats, quiet);
    let mesh = room::mesh(d, points, about, trim.as_ref());
    let phase = Phase::start(quiet, "writing");
    for (path, format) in outputs {
        let options = picture::Options::default();
        files::write_mesh(path, quiet, |out| write_mesh(out, *format, &mesh, &files::drawn(&options)))?;
    }
    drop(phase);
    stats.phase("write");
    stats.tell(quiet, R::WORDS.simplex);
    Ok(())
}
