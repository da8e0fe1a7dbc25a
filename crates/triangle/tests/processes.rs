//! Threads, forks, and a closed standard error.

use delone_generators::Kind;

use super::client::{Given, frame};

fn many(count: usize, seed: u64) -> Given {
    Given { points: Kind::Uniform.points(count, seed), ..Given::default() }
}

#[test]
fn threads_do_not_meet() {
    let expected = (many(40_000, 1).run("zenQ").expect("good"), frame().run("zpq30a0.1Q").expect("good"));
    std::thread::scope(|scope| {
        for _ in 0..8 {
            scope.spawn(|| {
                assert_eq!(many(40_000, 1).run("zenQ").expect("good"), expected.0);
                assert_eq!(frame().run("zpq30a0.1Q").expect("good"), expected.1);
                assert!(many(2, 1).run("z").is_err());
            });
        }
    });
}

#[cfg(unix)]
#[test]
fn a_fork_goes_on_after_work_of_its_parent() {
    let given = many(200_000, 2);
    let expected = given.run("zenQ").expect("good");
    for _ in 0..3 {
        // SAFETY: the child does what a program does that calls the library after a fork, and ends without cleaning up.
        let child = unsafe { libc::fork() };
        if child == 0 {
            let is_same = given.run("zenQ").is_ok_and(|got| got == expected);
            // SAFETY: a process may end itself.
            unsafe { libc::_exit(i32::from(!is_same)) };
        }
        assert_eq!(ended(child), Some(0), "the child hangs or differs");
    }
    assert_eq!(given.run("zenQ").expect("good"), expected);
}

/// The status that a child ends with; a child that hangs is ended.
#[cfg(unix)]
fn ended(child: i32) -> Option<i32> {
    let mut status = 0;
    for _ in 0..600 {
        // SAFETY: it is a child of this process.
        if unsafe { libc::waitpid(child, &raw mut status, libc::WNOHANG) } == child {
            return libc::WIFEXITED(status).then(|| libc::WEXITSTATUS(status));
        }
        std::thread::sleep(std::time::Duration::from_millis(100));
    }
    // SAFETY: as before.
    unsafe {
        libc::kill(child, libc::SIGKILL);
        libc::waitpid(child, &raw mut status, 0);
    }
    None
}

#[cfg(unix)]
#[test]
fn a_closed_standard_error_is_no_harm() {
    let io = many(2, 1).io("zQ");
    // SAFETY: as above; the child closes its own standard error.
    let child = unsafe { libc::fork() };
    if child == 0 {
        let mut out = super::client::unwritten();
        let mut input = io;
        // SAFETY: the input is refused.
        let status = unsafe {
            libc::close(2);
            let none = std::ptr::null_mut();
            delone_triangle::triangulate(c"zQ".as_ptr().cast_mut(), &raw mut input, &raw mut out, none)
        };
        // SAFETY: a process may end itself.
        unsafe { libc::_exit(status + 10) };
    }
    assert_eq!(ended(child), Some(11));
}
