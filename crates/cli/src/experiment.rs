pub(crate) fn run(_: &crate::args::ExperimentArgs, _: bool) -> Result<(), crate::message::Failure> { Ok(()) }
