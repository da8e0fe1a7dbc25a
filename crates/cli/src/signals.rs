//! Signals that end the program: nothing half-written is left.

/// Removes temporary files when the program is told to end, and lets it end as that signal does.
#[cfg(unix)]
pub(crate) fn clean_up() {
    use std::sync::{Arc, mpsc};

    use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU, SIGXFSZ};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    // Then a file that may not grow any more is an error of its writer.
    _ = signal_hook::flag::register(SIGXFSZ, Arc::default());
    // A signal that is ignored stays so: under nohup the program goes on after a hangup.
    let ignored = ignored();
    let is_wanted = |signal: &i32| ignored >> (signal - 1) & 1 == 0;
    let wanted = [SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU].into_iter().filter(is_wanted);
    let (sender, signals) = mpsc::channel::<Signals>();
    let watch = move || {
        let Ok(mut signals) = signals.recv() else { return };
        for signal in signals.forever() {
            delone_io::wait_for_names();
            delone_io::remove_unfinished();
            _ = emulate_default_handler(signal);
        }
    };
    // Without a thread for it nothing is caught, and signals end the program as before.
    if std::thread::Builder::new().name("signals".to_owned()).spawn(watch).is_ok()
        && let Ok(signals) = Signals::new(wanted)
    {
        _ = sender.send(signals);
    }
}

/// The signals that whoever started the program had ignored, a bit each, as Linux tells; elsewhere hangups are left alone.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.unwrap_or(1 << (signal_hook::consts::SIGHUP - 1))
}

#[cfg(not(unix))]
pub(crate) fn clean_up() {}
