//! The functions that C calls. They check what they are given, take no memory of their own, and keep
//! none of the pointers.
#![allow(unsafe_code, reason = "C passes pointers; each is checked for null and used only here")]

use crate::complaint::{ONLY, Refused, WrasseComplaint, WrasseStatus, refused};
use crate::fault::refusal;
use crate::laws_table::WrasseLaws;
use crate::period_data::{WrasseArmReference, WrasseControlOutput, WrasseSensed};
use crate::robot_table::{
    WRASSE_JOINTS, WrasseBody, WrasseFrame, WrasseLink, check, frame_from_table, robot_from_tables,
};
use core::ffi::{CStr, c_char};
use core::slice;
use wrasse_dynamics::Robot;
use wrasse_flight::{PeriodMemory, Setup, checked_period};

/// Words of eight bytes of a [`WrasseFlight`].
pub const WRASSE_FLIGHT_WORDS: usize = 4096;

/// Memory of the flight code, given by the caller. Opaque; do not read or write. Copying it copies its
/// state.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct WrasseFlight {
    /// Not to be read or written.
    pub memory: [u64; WRASSE_FLIGHT_WORDS],
}

/// What a [`WrasseFlight`] holds.
#[derive(Clone, Copy)]
struct Flight {
    /// That it was set up.
    mark: u64,
    robot: Robot<f64, WRASSE_JOINTS>,
    setup: Setup<f64, WRASSE_JOINTS>,
    memory: PeriodMemory<f64, WRASSE_JOINTS>,
}

const MARK: u64 = 0x5752_4153_5345_0001;

const _: () = assert!(size_of::<Flight>() <= size_of::<WrasseFlight>());
const _: () = assert!(align_of::<Flight>() <= align_of::<WrasseFlight>());

/// Set up the memory of the flight code for a robot and its laws. `complaint` may be null; otherwise
/// it says what is wrong when the status is not `WRASSE_OK`.
///
/// # Safety
/// Each pointer is null or points to as much as its type says; `links` to `link_count` links.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wrasse_flight_set_up(
    flight: *mut WrasseFlight,
    base: *const WrasseBody,
    links: *const WrasseLink,
    link_count: u32,
    tool: *const WrasseFrame,
    laws: *const WrasseLaws,
    complaint: *mut WrasseComplaint,
) -> WrasseStatus {
    // SAFETY: by this function's own condition; null is turned into nothing.
    let tables = unsafe { (base.as_ref(), tool.as_ref(), laws.as_ref()) };
    let result = match tables {
        (Some(base), Some(tool), Some(laws)) if !flight.is_null() => {
            // SAFETY: by this function's own condition.
            unsafe { links_of(links, link_count) }
                .and_then(|links| new_flight(base, links, tool, laws))
                // SAFETY: it is not null, and big and aligned enough by the assertions above.
                .map(|made| unsafe { flight.cast::<Flight>().write(made) })
        }
        _ => Err(null(c"flight, base, tool or laws")),
    };
    // SAFETY: by this function's own condition.
    unsafe { answer(result, complaint) }
}

/// One control period: measurements and reference in, commands of the actuators out. The first period
/// after the set-up takes everything from the measurements.
///
/// Measurements and reference are held against the bounds that stand at their fields; output and memory
/// must be finite. When the status is not `WRASSE_OK` the memory is as it was, to the
/// byte, so that later periods are those of a flight without this one; `output` has no torque and no
/// force, its rates and accelerations are zero, and its positions are those of the last accepted period
/// (zero before the first).
///
/// # Safety
/// Each pointer is null or points to as much as its type says; `flight` to memory that
/// `wrasse_flight_set_up` wrote, or to zeros. They do not overlap.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wrasse_flight_period(
    flight: *mut WrasseFlight,
    sensed: *const WrasseSensed,
    reference: *const WrasseArmReference,
    output: *mut WrasseControlOutput,
    complaint: *mut WrasseComplaint,
) -> WrasseStatus {
    // SAFETY: by this function's own condition; null is turned into nothing.
    let (sensed, reference, output) =
        unsafe { (sensed.as_ref(), reference.as_ref(), output.as_mut()) };
    // SAFETY: by this function's own condition.
    let mut known = if flight.is_null() { None } else { unsafe { set_up_flight(flight) } };
    let mut safe = WrasseControlOutput::default();
    if let Some(flight) = &known {
        safe = WrasseControlOutput::from_output(&flight.memory.safe_output());
    }
    let result = match (&mut known, sensed, reference, &output) {
        _ if flight.is_null() => Err(null(c"flight, sensed, reference or output")),
        (Some(flight), Some(sensed), Some(reference), Some(_)) => period(flight, sensed, reference),
        (None, Some(_), Some(_), Some(_)) => Err(refused(
            WrasseStatus::WRASSE_NOT_SET_UP,
            c"flight",
            ONLY,
            0.0,
            c"memory that wrasse_flight_set_up wrote",
        )),
        _ => Err(null(c"flight, sensed, reference or output")),
    };
    if let Some(output) = output {
        *output = result.unwrap_or(safe);
    }
    // SAFETY: by this function's own condition.
    unsafe { answer(result.map(|_| ()), complaint) }
}

/// What a status means, in English. Never null.
#[unsafe(no_mangle)]
pub extern "C" fn wrasse_status_text(status: i32) -> *const c_char {
    let text = match status {
        0 => c"success",
        1 => c"a pointer that must point to something is null",
        2 => c"there are more links than WRASSE_JOINTS",
        3 => c"a link is mounted on one that does not come before it",
        4 => c"a number of the set-up or of the reference is not finite or not within its bounds",
        5 => c"a choice is none of its constants",
        6 => c"the memory was not set up",
        7 => c"a reading is not finite or not within its bounds",
        8 => c"the output is not finite, passes a limit or jumps",
        9 => c"the memory would not be finite",
        _ => c"no status has this number",
    };
    text.as_ptr()
}

/// The links that C points to.
///
/// # Safety
/// The pointer is null or points to so many links.
unsafe fn links_of<'a>(links: *const WrasseLink, count: u32) -> Result<&'a [WrasseLink], Refused> {
    let length = usize::try_from(count).unwrap_or(usize::MAX);
    if length > WRASSE_JOINTS {
        let (status, found) = (WrasseStatus::WRASSE_TOO_MANY_LINKS, f64::from(count));
        return Err(refused(status, c"link_count", ONLY, found, c"at most WRASSE_JOINTS"));
    }
    match (length, links.is_null()) {
        (0, _) => Ok(&[]),
        (_, true) => Err(null(c"links")),
        // SAFETY: by this function's own condition.
        (_, false) => Ok(unsafe { slice::from_raw_parts(links, length) }),
    }
}

/// The flight code in its memory; nothing if it was not set up.
///
/// # Safety
/// The pointer is not null and points to a [`WrasseFlight`] that was set up, or to zeros.
unsafe fn set_up_flight<'a>(flight: *mut WrasseFlight) -> Option<&'a mut Flight> {
    let flight = flight.cast::<Flight>();
    // SAFETY: the mark is a number, which any bits are.
    let mark = unsafe { (&raw const (*flight).mark).read() };
    // SAFETY: whoever wrote the mark wrote all of it.
    (mark == MARK).then(|| unsafe { &mut *flight })
}

fn new_flight(
    base: &WrasseBody,
    links: &[WrasseLink],
    tool: &WrasseFrame,
    laws: &WrasseLaws,
) -> Result<Flight, Refused> {
    check(base, links, tool)?;
    let setup = laws.setup(frame_from_table(tool), links.len())?;
    // Checked above, so it is a robot.
    let robot = robot_from_tables(base, links).map_err(|_| null(c"links"))?;
    Ok(Flight { mark: MARK, robot, setup, memory: PeriodMemory::new() })
}

fn period(
    flight: &mut Flight,
    sensed: &WrasseSensed,
    reference: &WrasseArmReference,
) -> Result<WrasseControlOutput, Refused> {
    let Flight { robot, setup, memory, .. } = flight;
    let links = robot.joint_count();
    let (state, push) = sensed.read(links)?;
    let reference = reference.read(links)?;
    let output = checked_period(robot, setup, memory, &state, &reference, push.as_ref());
    output.map(|output| WrasseControlOutput::from_output(&output)).map_err(refusal)
}

fn null(field: &'static CStr) -> Refused {
    refused(WrasseStatus::WRASSE_NULL_POINTER, field, ONLY, 0.0, c"a pointer that is not null")
}

/// The status, and the complaint where C wants it.
///
/// # Safety
/// The pointer is null or points to a complaint.
unsafe fn answer(result: Result<(), Refused>, complaint: *mut WrasseComplaint) -> WrasseStatus {
    let (status, said) = match result {
        Ok(()) => (WrasseStatus::WRASSE_OK, WrasseComplaint::none()),
        Err(Refused { status, complaint }) => (status, complaint),
    };
    // SAFETY: by this function's own condition.
    if let Some(complaint) = unsafe { complaint.as_mut() } {
        *complaint = said;
    }
    status
}
