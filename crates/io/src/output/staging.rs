//! Folders for what is half made, beside what it becomes: `.delone-XXXXXX`, which go with the work.
//!
//! A folder is locked as long as its process lives, whatever ends that. So the next run in the same place knows what a killed one left, and
//! removes it. Where a file system has no locks, left-overs stay.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::time::Duration;

use tempfile::TempDir;

/// The first letters of the names of all these folders.
const PREFIX: &str = ".delone-";

/// Folders of this process that exist.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Where this process has looked for left-overs.
static SEEN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// The folders that outputs of the same place share, by that place.
static SHARED: Mutex<Vec<(PathBuf, Weak<TemporaryFolder>)>> = Mutex::new(Vec::new());

fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all temporary files and folders of this process, which is about to be ended by a signal.
pub fn remove_unfinished() {
    /// Threads go on meanwhile, and may write into a folder that is being emptied.
    const TRIES: usize = 10;
    if let Some(mut paths) = lock_soon(&UNFINISHED) {
        for path in paths.drain(..) {
            _ = (0..TRIES).any(|_| fs::remove_dir_all(&path).is_ok());
        }
    }
}

/// Locks what another thread mostly holds for no longer than it takes to make a file; but whoever holds it may be the one that was stopped.
fn lock_soon<T>(mutex: &Mutex<T>) -> Option<MutexGuard<'_, T>> {
    const TRIES: usize = 200;
    (0..TRIES).find_map(|_| match mutex.try_lock() {
        Ok(guard) => Some(guard),
        Err(std::sync::TryLockError::Poisoned(error)) => Some(error.into_inner()),
        Err(std::sync::TryLockError::WouldBlock) => {
            std::thread::sleep(Duration::from_millis(5));
            None
        }
    })
}

/// Whether a path is in a temporary folder of this process: what is there goes with the work.
pub(super) fn is_temporary(path: &Path) -> bool {
    held(&UNFINISHED).iter().any(|folder| path.starts_with(folder))
}

/// A folder for work, which goes with all that is in it when this is dropped, or by [`remove_unfinished`].
#[derive(Debug)]
pub struct TemporaryFolder {
    folder: TempDir,
    /// Held for others to see; none where the file system has no locks.
    _lock: Option<File>,
}

impl TemporaryFolder {
    /// Makes it in another folder, which only its owner may read; removes what killed runs left there.
    pub fn create(within: &Path) -> io::Result<Self> {
        /// Another run may take a folder that is not locked yet for a left-over: then it is made again.
        const TRIES: usize = 100;
        for _ in 0..TRIES {
            if let Some(folder) = Self::attempt(within)? {
                remove_left_overs(within, folder.path());
                return Ok(folder);
            }
        }
        Err(io::Error::other("other runs remove folders that are made"))
    }

    /// One that is locked, or none if somebody else was sooner.
    fn attempt(within: &Path) -> io::Result<Option<Self>> {
        let mut name = tempfile::Builder::new();
        name.prefix(PREFIX);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            name.permissions(fs::Permissions::from_mode(0o700));
        }
        // Known before a signal can come between.
        let folder = {
            let mut paths = held(&UNFINISHED);
            let folder = name.tempdir_in(within)?;
            paths.push(folder.path().to_owned());
            folder
        };
        let lock = File::open(folder.path()).ok();
        let outcome = lock.as_ref().map(|lock| lock.try_lock());
        let made = Self { folder, _lock: lock };
        let is_ours = !matches!(outcome, Some(Err(TryLockError::WouldBlock))) && made.path().exists();
        Ok(is_ours.then_some(made))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// The one that all outputs of a folder share.
    pub(super) fn shared(within: &Path) -> io::Result<Arc<Self>> {
        let mut all = held(&SHARED);
        all.retain(|known| known.1.strong_count() > 0);
        if let Some(known) = all.iter().find(|known| known.0 == within).and_then(|known| known.1.upgrade()) {
            return Ok(known);
        }
        let folder = Arc::new(Self::create(within)?);
        all.push((within.to_owned(), Arc::downgrade(&folder)));
        Ok(folder)
    }

    /// A name in it that no other file of this process has.
    pub(super) fn new_name(&self) -> PathBuf {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        self.path().join(COUNT.fetch_add(1, Ordering::Relaxed).to_string())
    }
}

impl Drop for TemporaryFolder {
    fn drop(&mut self) {
        // Forgotten when it is gone: a signal in between still finds it.
        _ = fs::remove_dir_all(self.path());
        held(&UNFINISHED).retain(|known| known != self.path());
    }
}

/// Removes what killed runs of the same user left in a folder, once for each folder.
fn remove_left_overs(within: &Path, own: &Path) {
    {
        let mut seen = held(&SEEN);
        if seen.iter().any(|known| known == within) {
            return;
        }
        seen.push(within.to_owned());
    }
    for entry in fs::read_dir(within).into_iter().flatten().flatten() {
        let path = entry.path();
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        let is_named = entry.file_name().to_string_lossy().starts_with(PREFIX);
        if is_folder
            && is_named
            && path != own
            && have_one_owner(&path, own)
            && let Some(_locked) = left(&path)
        {
            _ = fs::remove_dir_all(&path);
        }
    }
}

/// The lock of a folder whose process is gone: nobody held it.
fn left(path: &Path) -> Option<File> {
    File::open(path).ok().filter(|folder| folder.try_lock().is_ok())
}

#[cfg(unix)]
fn have_one_owner(one: &Path, other: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let owner = |path: &Path| fs::symlink_metadata(path).map(|about| about.uid()).ok();
    owner(one).is_some() && owner(one) == owner(other)
}

#[cfg(not(unix))]
fn have_one_owner(_: &Path, _: &Path) -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::lock_soon;
    use std::sync::{Mutex, mpsc};
    use std::time::Duration;

    #[test]
    fn a_lock_that_another_thread_holds_is_waited_for() {
        let mutex = Mutex::new(1);
        let (ready, wait) = mpsc::channel();
        std::thread::scope(|scope| {
            scope.spawn(|| {
                let _held = mutex.lock();
                _ = ready.send(());
                std::thread::sleep(Duration::from_millis(30));
            });
            assert!(wait.recv().is_ok());
            assert!(lock_soon(&mutex).is_some());
        });
        // One that is never given back ends the patience.
        let _held = mutex.lock();
        assert!(lock_soon(&mutex).is_none());
    }

    #[cfg(unix)]
    #[test]
    fn left_overs_go_and_what_others_work_in_stays() {
        use super::TemporaryFolder;
        use std::fs::{self, File};
        let place = tempfile::tempdir().expect("a temporary folder");
        let at = |name: &str| place.path().join(name);
        for name in [".delone-left", ".delone-held", "other"] {
            fs::create_dir(at(name)).expect("room");
            fs::write(at(name).join("0"), "half").expect("room");
        }
        fs::write(at(".delone-file"), "whose?").expect("room");
        std::os::unix::fs::symlink(at("other"), at(".delone-link")).expect("room");
        let others = File::open(at(".delone-held")).expect("there");
        others.try_lock().expect("free");
        let own = TemporaryFolder::create(place.path()).expect("room");
        let names = || {
            let entries = fs::read_dir(place.path()).expect("readable").flatten();
            let mut names: Vec<_> = entries.filter(|entry| entry.path() != own.path()).collect();
            names.sort_by_key(fs::DirEntry::file_name);
            names.iter().map(|entry| entry.file_name().into_string().expect("UTF-8")).collect::<Vec<_>>()
        };
        assert_eq!(names(), [".delone-file", ".delone-held", ".delone-link", "other"]);
        assert!(at("other/0").exists() && at(".delone-held/0").exists() && own.path().exists());
        // Nobody takes it for one that is left.
        assert!(File::open(own.path()).expect("there").try_lock().is_err());
    }
}
