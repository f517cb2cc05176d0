//! Aureole from Rust: an integral over the cube by 16 randomisations of one Sobol' net, with its standard error.
//!
//!     rustc -O examples/rust/integral.rs -L build/release -l aureole -o integral
//!     LD_LIBRARY_PATH=build/release ./integral
//!
//! The declarations are those of aureole/core.h and aureole/pointset.h; bindgen makes all of them from the headers. A struct of options
//! begins with its size, by which the library knows the version that it was declared from, and aur_..._init fills it.
use std::ffi::{c_void, CStr, CString};
use std::os::raw::{c_char, c_double, c_int};
use std::{mem, ptr};

#[repr(C)]
struct AurError {
    result: c_int,
    line: usize,
    column: usize,
    file: [c_char; 1024],
    message: [c_char; 1024],
}
#[repr(C)]
struct AurPointsetOptions {
    size: usize,
    count: u64,
    dimension: usize,
    scramble: c_int,
    seed: u64,
    warning: Option<extern "C" fn(*mut c_void, *const c_char)>,
    warning_user: *mut c_void,
}
#[repr(C)]
struct AurPointset {
    _private: [u8; 0],
}
extern "C" {
    fn aur_scramble_from_name(name: *const c_char, scramble: *mut c_int, error: *mut AurError) -> c_int;
    fn aur_pointset_options_init(count: u64, options: *mut AurPointsetOptions, error: *mut AurError) -> c_int;
    fn aur_pointset_create(set: *const c_char, options: *const AurPointsetOptions, made: *mut *mut AurPointset,
                           error: *mut AurError) -> c_int;
    fn aur_pointset_destroy(set: *mut AurPointset);
    fn aur_pointset_points(set: *const AurPointset, first: u64, count: usize, capacity: usize, points: *mut c_double,
                           error: *mut AurError) -> c_int;
}

/// Calls a function whose last argument is an error, which becomes the message of an Err.
fn checked(call: impl FnOnce(*mut AurError) -> c_int) -> Result<(), String> {
    let mut error: AurError = unsafe { mem::zeroed() };
    match call(&mut error) {
        0 => Ok(()),
        _ => Err(unsafe { CStr::from_ptr(error.message.as_ptr()) }.to_string_lossy().into_owned()),
    }
}

/// A set made ready: any part of it, from any thread.
struct Points(*mut AurPointset, usize);
unsafe impl Sync for Points {}

impl Points {
    fn new(set: &str, count: u64, dimension: usize, scramble: &str, seed: u64) -> Result<Points, String> {
        let (set, scramble) = (CString::new(set).unwrap(), CString::new(scramble).unwrap());
        let mut options: AurPointsetOptions = unsafe { mem::zeroed() };
        options.size = mem::size_of::<AurPointsetOptions>();
        checked(|error| unsafe { aur_pointset_options_init(count, &mut options, error) })?;
        checked(|error| unsafe { aur_scramble_from_name(scramble.as_ptr(), &mut options.scramble, error) })?;
        options.dimension = dimension;
        options.seed = seed;
        let mut made = ptr::null_mut();
        checked(|error| unsafe { aur_pointset_create(set.as_ptr(), &options, &mut made, error) })?;
        Ok(Points(made, dimension))
    }

    fn part(&self, first: u64, count: usize) -> Result<Vec<f64>, String> {
        let mut points = vec![0.0; count * self.1];
        checked(|error| unsafe { aur_pointset_points(self.0, first, count, points.len(), points.as_mut_ptr(), error) })?;
        Ok(points)
    }
}

impl Drop for Points {
    fn drop(&mut self) {
        unsafe { aur_pointset_destroy(self.0) }
    }
}

fn main() -> Result<(), String> {
    let (n, dimension, turns) = (4096, 4, 16);
    let mut means = Vec::new();
    for seed in 0..turns {
        let points = Points::new("sobol", n, dimension, "owen", seed)?.part(0, n as usize)?;
        let f = |x: &[f64]| x.iter().map(|x| 0.5 * std::f64::consts::PI * (std::f64::consts::PI * x).sin()).product::<f64>();
        means.push(points.chunks(dimension).map(f).sum::<f64>() / n as f64);
    }
    let mean = means.iter().sum::<f64>() / turns as f64;
    let squares: f64 = means.iter().map(|m| (m - mean) * (m - mean)).sum();
    println!("integral {:.9} error {:.2e} exact 1", mean, (squares / (turns * (turns - 1)) as f64).sqrt());
    println!("point 7 of seed 3: {:?}", Points::new("sobol", n, dimension, "owen", 3)?.part(7, 1)?);
    println!("a wrong name: {}", Points::new("sobl", n, dimension, "owen", 3).err().unwrap_or_default());
    Ok(())
}
