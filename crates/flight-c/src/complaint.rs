//! What a call from C answers, and the first thing that is wrong with what it was given.

use core::ffi::{CStr, c_char};
use core::ptr;

/// How a call ended.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WrasseStatus {
    /// Success.
    WRASSE_OK = 0,
    /// A pointer that must point to something is null.
    WRASSE_NULL_POINTER = 1,
    /// More links than `WRASSE_JOINTS`.
    WRASSE_TOO_MANY_LINKS = 2,
    /// A link is mounted on one that does not come before it.
    WRASSE_PARENT_AFTER_CHILD = 3,
    /// A number of the set-up, or of the reference, is not finite or not within its bounds.
    WRASSE_BAD_NUMBER = 4,
    /// A choice is none of its constants.
    WRASSE_UNKNOWN_CHOICE = 5,
    /// The memory was not set up.
    WRASSE_NOT_SET_UP = 6,
    /// A reading of the sensors is not finite, or not within its bounds.
    WRASSE_BAD_READING = 7,
    /// The output is not finite, passes a limit, or makes a set-point jump.
    WRASSE_BAD_RESULT = 8,
    /// The memory would not be finite.
    WRASSE_BAD_MEMORY = 9,
}

/// What is wrong, where, what was found and what was expected.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrasseComplaint {
    /// The field, as it is written in this header; null when nothing is wrong.
    pub field: *const c_char,
    /// Number of the link or of the element; -1 where there is but one.
    pub index: i32,
    /// What was found.
    pub found: f64,
    /// What was expected; null when nothing is wrong.
    pub expected: *const c_char,
}

impl WrasseComplaint {
    /// Nothing is wrong.
    pub(crate) fn none() -> Self {
        Self { field: ptr::null(), index: -1, found: 0.0, expected: ptr::null() }
    }
}

/// A call that was refused.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Refused {
    pub(crate) status: WrasseStatus,
    pub(crate) complaint: WrasseComplaint,
}

impl Refused {
    /// The same about the link of this number.
    pub(crate) fn of(mut self, link: usize) -> Self {
        self.complaint.index = i32::try_from(link).unwrap_or(-1);
        self
    }

    /// The same about a reading.
    pub(crate) fn of_reading(mut self) -> Self {
        if self.status == WrasseStatus::WRASSE_BAD_NUMBER {
            self.status = WrasseStatus::WRASSE_BAD_READING;
        }
        self
    }
}

/// Refuse because of a field.
pub(crate) fn refused(
    status: WrasseStatus,
    field: &'static CStr,
    index: usize,
    found: f64,
    expected: &'static CStr,
) -> Refused {
    let index = i32::try_from(index).unwrap_or(-1);
    let (field, expected) = (field.as_ptr(), expected.as_ptr());
    Refused { status, complaint: WrasseComplaint { field, index, found, expected } }
}

/// Where there is but one.
pub(crate) const ONLY: usize = usize::MAX;

/// Each of these numbers is finite and holds to a rule.
pub(crate) fn each(
    field: &'static CStr,
    numbers: &[f64],
    expected: &'static CStr,
    rule: impl Fn(f64) -> bool,
) -> Result<(), Refused> {
    for (index, x) in numbers.iter().enumerate() {
        if !(x.is_finite() && rule(*x)) {
            let index = if numbers.len() == 1 { ONLY } else { index };
            return Err(refused(WrasseStatus::WRASSE_BAD_NUMBER, field, index, *x, expected));
        }
    }
    Ok(())
}

/// Each of these numbers is finite.
pub(crate) fn finite(field: &'static CStr, numbers: &[f64]) -> Result<(), Refused> {
    each(field, numbers, c"a finite number", |_| true)
}

/// A unit quaternion, within the round-off of one that was kept in single precision.
pub(crate) fn unit(field: &'static CStr, quaternion: &[f64; 4]) -> Result<(), Refused> {
    finite(field, quaternion)?;
    let square: f64 = quaternion.iter().map(|x| x * x).sum();
    each(field, &[square], c"components whose squares sum to 1", |s| (s - 1.0).abs() < 1e-5)
}

/// A choice by its number.
pub(crate) fn choice<E: Copy, const N: usize>(
    field: &'static CStr,
    found: i32,
    of: [E; N],
) -> Result<E, Refused> {
    let chosen = usize::try_from(found).ok().and_then(|k| of.get(k).copied());
    let (status, expected) = (WrasseStatus::WRASSE_UNKNOWN_CHOICE, c"one of its constants");
    chosen.ok_or_else(|| refused(status, field, ONLY, f64::from(found), expected))
}
