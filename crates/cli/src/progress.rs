//! Progress on standard error: on a terminal only, and only for what takes over a second.

use std::io::{self, BufRead, IsTerminal, Read, Seek, SeekFrom};
use std::sync::mpsc::{self, Sender};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// How long a phase may take in silence.
const PATIENCE: Duration = Duration::from_secs(1);

/// How often the bar moves that nothing else moves.
const TICK: Duration = Duration::from_millis(100);

/// One phase of the work. The bar appears after a second and goes away with the phase.
pub struct Phase {
    bar: ProgressBar,
    /// Dropped, it ends the thread that waits to show the bar.
    done: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Phase {
    /// A phase of unknown length.
    pub fn start(quiet: bool, what: &'static str) -> Self {
        Self::with_bar(quiet, ProgressBar::hidden(), what, "{spinner} {msg} {elapsed}")
    }

    /// A phase that goes through `bytes`.
    pub(crate) fn bytes(quiet: bool, what: &'static str, bytes: u64) -> Self {
        let bar = ProgressBar::with_draw_target(Some(bytes), ProgressDrawTarget::hidden());
        Self::with_bar(quiet, bar, what, "{spinner} {msg} {wide_bar} {bytes}/{total_bytes} {eta}")
    }

    /// A phase of so many equal parts.
    pub fn count(quiet: bool, what: &'static str, parts: u64) -> Self {
        let bar = ProgressBar::with_draw_target(Some(parts), ProgressDrawTarget::hidden());
        Self::with_bar(quiet, bar, what, "{spinner} {msg} {wide_bar} {pos}/{len} {eta}")
    }

    /// A phase of unknown length that makes something, which is counted.
    pub(crate) fn making(quiet: bool, what: &'static str, things: &'static str) -> Self {
        let template = format!("{{spinner}} {{msg}} {{elapsed}}, {{human_pos}} {things}");
        Self::with_bar(quiet, ProgressBar::hidden(), what, &template)
    }

    /// So much was made.
    pub(crate) fn made(&self, count: usize) {
        self.bar.set_position(count as u64);
    }

    /// One part of it is done.
    pub fn advance(&self) {
        self.bar.inc(1);
    }

    fn with_bar(quiet: bool, bar: ProgressBar, what: &'static str, template: &str) -> Self {
        if quiet || !io::stderr().is_terminal() {
            return Self { bar, done: None };
        }
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_message(what);
        let (done, wait) = mpsc::channel();
        let shown = bar.clone();
        let watch = move || {
            let goes_on = |time| wait.recv_timeout(time) == Err(mpsc::RecvTimeoutError::Timeout);
            if goes_on(PATIENCE) {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                while goes_on(TICK) {
                    shown.tick();
                }
                shown.finish_and_clear();
            }
        };
        // Without a thread for it there is no bar.
        let waiter = std::thread::Builder::new().spawn(watch).ok();
        Self { bar, done: waiter.map(|waiter| (done, waiter)) }
    }

    /// A reader that moves the bar.
    pub(crate) fn watch<R>(&self, reader: R) -> Watched<R> {
        Watched { reader, bar: self.bar.clone(), unseen: 0 }
    }
}

impl Drop for Phase {
    fn drop(&mut self) {
        if let Some((done, waiter)) = self.done.take() {
            drop(done);
            _ = waiter.join();
        }
    }
}

/// A reader whose position a bar shows. Buffered bytes count as read.
pub(crate) struct Watched<R> {
    reader: R,
    bar: ProgressBar,
    /// Bytes that the bar does not know yet: it asks for the time with every step, which costs more than a line of text.
    unseen: u64,
}

/// Bytes of a step of the bar.
const STEP: u64 = 1 << 16;

impl<R> Watched<R> {
    fn advance(&mut self, count: usize) {
        self.unseen += count as u64;
        if self.unseen >= STEP {
            self.bar.inc(self.unseen);
            self.unseen = 0;
        }
    }
}

impl<R: Read> Read for Watched<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.reader.read(buffer)?;
        self.advance(count);
        Ok(count)
    }
}

impl<R: BufRead> BufRead for Watched<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.reader.fill_buf()
    }

    fn consume(&mut self, count: usize) {
        self.advance(count);
        self.reader.consume(count);
    }
}

impl<R: Seek> Seek for Watched<R> {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        let position = self.reader.seek(position)?;
        self.bar.set_position(position);
        self.unseen = 0;
        Ok(position)
    }
}
