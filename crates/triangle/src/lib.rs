//! The C interface of Triangle, `triangle.h`, on Delone: a shared library for programs that were written for Triangle (J. R. Shewchuk), under
//! the licence of Delone. The header is `include/triangle.h`; the README has the switches, and tells how results differ.
//!
//! An input is copied and checked (`input`); what is built (`graph`, `again` for meshes that are read, `built`) is numbered in rows and written
//! straight into the memory of the results (`output`, `edges`, `voronoi`). Nothing is kept between calls but a pool of threads and, for each
//! thread, the words of its last error.

#![allow(unsafe_code, reason = "an interface of C has pointers")]

mod again;
mod built;
mod edges;
mod fault;
mod graph;
mod input;
mod layout;
mod markers;
mod memory;
mod output;
mod switches;
mod threads;
mod values;
mod voronoi;

use std::ffi::{CStr, c_char, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};

use built::Built;
use fault::{Fault, Status};
use input::Input;
pub use layout::{PlainTest, Test, TriError, TriangulateIo, WORD_BYTES};
use output::Output;
use switches::Switches;

/// A test of the caller, with what it gave along. It is asked on the thread of the call alone.
#[derive(Clone, Copy)]
enum Asked {
    Test(Test, *mut c_void),
    Plain(PlainTest),
}

impl Asked {
    fn ask(self, [mut a, mut b, mut c]: [[f64; 2]; 3], area: f64) -> bool {
        // SAFETY: the caller gave a function that may be called so.
        let said = unsafe {
            match self {
                Self::Test(test, user) => test(a.as_ptr(), b.as_ptr(), c.as_ptr(), area, user),
                Self::Plain(test) => test(a.as_mut_ptr(), b.as_mut_ptr(), c.as_mut_ptr(), area),
            }
        };
        said != 0
    }
}

/// Pointers that go to another thread, while this one waits.
struct Handed<T>(T);

// SAFETY: the one that waits does nothing with them.
unsafe impl<T> Send for Handed<T> {}

impl<T> Handed<T> {
    fn take(self) -> T {
        self.0
    }
}

/// A call, as C has it.
struct Call {
    switches: *const c_char,
    input: *const TriangulateIo,
    out: *mut TriangulateIo,
    vorout: *mut TriangulateIo,
}

impl Call {
    /// # Safety
    /// As [`delone_triangulate`].
    unsafe fn run(&self, text: &[u8], asked: Option<Asked>) -> Result<(), Fault> {
        let s = Switches::parse(text)?;
        if s.user && asked.is_none() {
            let words = "switch u needs a test: define EXTERNAL_TEST before the header, or give one to delone_triangulate";
            return Err(Fault::new(Status::Argument, words));
        }
        if s.voronoi && self.vorout.is_null() {
            return Err(Fault::new(Status::Argument, "switch v needs vorout, which is NULL"));
        }
        // SAFETY: as the caller says.
        let mut input = unsafe { Input::read(self.input, &s)? };
        let handed = Handed((self.out, self.vorout, self.input, asked));
        threads::run(&s, input.points.len(), || {
            let (out, vorout, given, asked) = handed.take();
            let ask = |corners: [[f64; 2]; 3], area: f64| asked.is_some_and(|asked| asked.ask(corners, area));
            let built = if s.is_plain() {
                Built::plain(&mut input)?
            } else {
                graph::build(&mut input, &s, s.user.then_some(&ask))?
            };
            // SAFETY: as the caller says.
            unsafe { Output::new(&built, &input, &s).write(out, vorout, given) }
        })
    }

    /// Runs, tells the caller, and at an error leaves results without rows. Gives the error.
    ///
    /// # Safety
    /// As [`delone_triangulate`].
    unsafe fn told(&self, asked: Option<Asked>, error: *mut TriError) -> Result<(), Fault> {
        // SAFETY: as the caller says.
        unsafe {
            let text =
                if self.switches.is_null() { &[][..] } else { CStr::from_ptr(self.switches).to_bytes() };
            let missing = [
                ("switches", self.switches.is_null()),
                ("in", self.input.is_null()),
                ("out", self.out.is_null()),
            ];
            let done = match missing.into_iter().find(|(_, is_null)| *is_null) {
                Some((name, _)) => Err(Fault::new(Status::Argument, format!("{name} is NULL"))),
                None => catch_unwind(AssertUnwindSafe(|| self.run(text, asked)))
                    .unwrap_or_else(|_| Err(Fault::bug())),
            };
            match &done {
                Ok(()) => fault::tell_good(error.as_mut()),
                Err(fault) => {
                    output::clear(self.out);
                    if Switches::name_voronoi(text) {
                        output::clear(self.vorout);
                    }
                    fault.tell(error.as_mut());
                }
            }
            done
        }
    }

    /// Runs, and prints an error on stderr.
    ///
    /// # Safety
    /// As [`delone_triangulate`].
    unsafe fn printed(&self, asked: Option<Asked>) -> c_int {
        // SAFETY: as the caller says.
        let done = unsafe { self.told(asked, std::ptr::null_mut()) };
        status(done, Fault::print)
    }
}

/// The status of a result, whose error is shown.
fn status(done: Result<(), Fault>, show: impl Fn(&Fault)) -> c_int {
    match done {
        Ok(()) => 0,
        Err(fault) => {
            show(&fault);
            fault.status as c_int
        }
    }
}

/// Triangulates as the switches say, and gives a status; see the header.
///
/// # Safety
/// `switches` is NULL or ends with a zero. The structures are NULL or readable, results writable too. Lists that the switches use have the
/// lengths that counts say; lists of results are NULL or have room. `error` is NULL, or writable, and its size is set. The test may be called.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn delone_triangulate(
    switches: *const c_char,
    input: *const TriangulateIo,
    out: *mut TriangulateIo,
    vorout: *mut TriangulateIo,
    test: Option<Test>,
    user: *mut c_void,
    error: *mut TriError,
) -> c_int {
    let call = Call { switches, input, out, vorout };
    // SAFETY: as the caller says.
    let done = unsafe { call.told(test.map(|test| Asked::Test(test, user)), error) };
    status(done, |_| ())
}

/// Triangulates with a test of Triangle's form for switch u; an error is printed.
///
/// # Safety
/// As [`delone_triangulate`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn delone_tri_with_test(
    switches: *const c_char,
    input: *const TriangulateIo,
    out: *mut TriangulateIo,
    vorout: *mut TriangulateIo,
    test: Option<PlainTest>,
) -> c_int {
    // SAFETY: as the caller says.
    unsafe { Call { switches, input, out, vorout }.printed(test.map(Asked::Plain)) }
}

/// Triangulates as Triangle's function; an error is printed, and it returns.
///
/// # Safety
/// As [`delone_triangulate`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn triangulate(
    switches: *mut c_char,
    input: *mut TriangulateIo,
    out: *mut TriangulateIo,
    vorout: *mut TriangulateIo,
) -> c_int {
    // SAFETY: as the caller says.
    unsafe { Call { switches, input, out, vorout }.printed(None) }
}

/// Gives memory of results back.
///
/// # Safety
/// `memory` is NULL or of `malloc`, and used no more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trifree(memory: *mut c_void) {
    // SAFETY: as the caller says.
    unsafe { libc::free(memory) }
}

/// The words of the last error on this thread, or "".
#[unsafe(no_mangle)]
pub extern "C" fn delone_tri_last_error() -> *const c_char {
    fault::last()
}
