//! Versions, statuses, threads.

use std::ffi::{CStr, c_char};

use crate::failure::{CError, Status, guard};

/// `DELONE_ABI_VERSION`.
const ABI_VERSION: u32 = 1 << 16;

#[unsafe(no_mangle)]
pub(crate) extern "C" fn delone_abi_version() -> u32 {
    ABI_VERSION
}

#[unsafe(no_mangle)]
pub(crate) extern "C" fn delone_version() -> *const c_char {
    const VERSION: &CStr =
        match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
            Ok(version) => version,
            Err(_) => c"unknown",
        };
    VERSION.as_ptr()
}

#[unsafe(no_mangle)]
pub(crate) extern "C" fn delone_status_name(status: i32) -> *const c_char {
    let known = Status::ALL.into_iter().find(|&known| known as i32 == status);
    let name = match known {
        Some(Status::Good) => c"good",
        Some(Status::Argument) => c"wrong argument",
        Some(Status::NotFinite) => c"not finite",
        Some(Status::Crossing) => c"segments cross",
        Some(Status::Index) => c"index out of range",
        Some(Status::TooMany) => c"too many",
        Some(Status::Memory) => c"no memory",
        Some(Status::Stopped) => c"stopped",
        Some(Status::Dimension) => c"wrong dimension",
        Some(Status::Bug) => c"bug",
        None => c"unknown",
    };
    name.as_ptr()
}

#[unsafe(no_mangle)]
pub(crate) extern "C" fn delone_set_threads(count: u32, error: *mut CError) -> i32 {
    guard(error, || {
        delone_pool::set_threads(count as usize);
        Ok(())
    })
}
