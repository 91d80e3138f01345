/* The control period of wrasse for flight software in C. Made from crates/flight-c by its tests; edit
   that, then: WRASSE_WRITE=1 cargo test -p wrasse-flight-c

   SI units and radians. Angular part first, in every vector of six. Inertial axes are those of the
   navigation; base axes are fixed to the spacecraft's base, whose origin is that of its body.
   Quaternions are w, x, y, z and turn components in base (or tool) axes into those of the motion.

   No function takes memory from a heap or keeps a pointer. */

#ifndef WRASSE_FLIGHT_H
#define WRASSE_FLIGHT_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

// Most links that a robot can have.
#define WRASSE_JOINTS 14

// The arm's law takes the base for bolted to the ground.
#define WRASSE_LAW_TERRESTRIAL 0

// The arm's law takes the base's attitude for held and its translation for free.
#define WRASSE_LAW_ATTITUDE_HELD 1

// The arm's law takes the base for free to turn and to translate.
#define WRASSE_LAW_FREE_FLOATING 2

// Position and orientation of the tool count.
#define WRASSE_TASK_POSE 0

// Only the position of the tool counts.
#define WRASSE_TASK_POSITION 1

// The arm's motion is not fed forward to the attitude control.
#define WRASSE_FEEDFORWARD_NONE 0

// The exact torque that the arm's motion takes is fed forward to the attitude control.
#define WRASSE_FEEDFORWARD_EXACT 1

// After the start the guidance integrates its own model.
#define WRASSE_MEASURE_NOTHING 0

// The guidance takes pose and twist of the base from the sensors, each period.
#define WRASSE_MEASURE_BASE 1

// The tool follows a motion.
#define WRASSE_REFERENCE_TOOL 0

// The joints follow a motion.
#define WRASSE_REFERENCE_JOINTS 1

// The joints stand still where they were sent last.
#define WRASSE_REFERENCE_STILL 2

// Nothing is driven.
#define WRASSE_REFERENCE_COAST 3

// The tool's motion is in inertial axes.
#define WRASSE_AXES_INERTIAL 0

// The tool's motion is relative to the base, in its axes.
#define WRASSE_AXES_BASE 1

// Words of eight bytes of a [`WrasseFlight`].
#define WRASSE_FLIGHT_WORDS 4096

// How a call ended.
enum WrasseStatus
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // Success.
  WRASSE_OK = 0,
  // A pointer that must point to something is null.
  WRASSE_NULL_POINTER = 1,
  // More links than `WRASSE_JOINTS`.
  WRASSE_TOO_MANY_LINKS = 2,
  // A link is mounted on one that does not come before it.
  WRASSE_PARENT_AFTER_CHILD = 3,
  // A number of the set-up, or of the reference, is not finite or not within its bounds.
  WRASSE_BAD_NUMBER = 4,
  // A choice is none of its constants.
  WRASSE_UNKNOWN_CHOICE = 5,
  // The memory was not set up.
  WRASSE_NOT_SET_UP = 6,
  // A reading of the sensors is not finite, or not within its bounds.
  WRASSE_BAD_READING = 7,
  // The output is not finite, passes a limit, or makes a set-point jump.
  WRASSE_BAD_RESULT = 8,
  // The memory would not be finite.
  WRASSE_BAD_MEMORY = 9,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum WrasseStatus WrasseStatus;
#else
typedef int32_t WrasseStatus;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Memory of the flight code, given by the caller. Opaque; do not read or write. Copying it copies its
// state.
typedef struct WrasseFlight {
  // Not to be read or written.
  uint64_t memory[WRASSE_FLIGHT_WORDS];
} WrasseFlight;

// What a body is made of.
typedef struct WrasseBody {
  // Mass (kg), at most 1e9; of the base at least 1e-6, of a link zero or more.
  double mass;
  // Centre of mass, from the body's origin, body axes (m), between -1e4 and 1e4.
  double centre_of_mass[3];
  // Inertia about the centre of mass, body axes: xx, yy, zz, xy, xz, yz (kg·m²), between -1e15 and
  // 1e15: one that matter can have, and of the base one that resists turning about every axis.
  double inertia[6];
} WrasseBody;

// A joint and where it sits on its parent.
typedef struct WrasseJoint {
  // Number of the link that it is mounted on, smaller than its own; -1 for the base.
  int32_t parent;
  // 0: it turns about its axis (rad). 1: it slides along its axis (m).
  int32_t sliding;
  // Origin of the link at zero travel, from the parent's origin, parent axes (m), between -1e4 and
  // 1e4.
  double position[3];
  // Turns link axes into parent axes at zero travel, by rows (–).
  double rotation[3][3];
  // Its axis, link axes, between -1e6 and 1e6; made a unit vector (–).
  double axis[3];
} WrasseJoint;

// A joint and the body that it carries.
typedef struct WrasseLink {
  // The joint.
  struct WrasseJoint joint;
  // The body; its origin is that of the joint.
  struct WrasseBody body;
} WrasseLink;

// A frame fixed to a body: a tool.
typedef struct WrasseFrame {
  // Number of the link that carries it; -1 for the base.
  int32_t link;
  // Its origin, from the body's origin, body axes (m), between -1e4 and 1e4.
  double position[3];
  // Turns its axes into body axes, by rows (–).
  double rotation[3][3];
} WrasseFrame;

// The laws and their numbers. Elements of joints that the robot does not have are not read.
typedef struct WrasseLaws {
  // One of `WRASSE_LAW_...`.
  int32_t law;
  // One of `WRASSE_TASK_...`.
  int32_t task;
  // One of `WRASSE_FEEDFORWARD_...`.
  int32_t feedforward;
  // One of `WRASSE_MEASURE_...`.
  int32_t measurement;
  // Control period (s), between 1e-5 and 100.
  double period;
  // How fast the guidance takes back a tool error (1/s), between 0 and 1e5; its product with the
  // period is below 1.
  double tool_gain;
  // Bandwidth of the joint loops (rad/s), between 0 and 1e5; zero: feedforward only. With b its
  // product with the period and d the damping ratio, b d + b b / 4 is below 1.
  double joint_bandwidth;
  // Damping ratio of the joint loops (–), between 0 and 1e3.
  double joint_damping;
  // Bandwidth of the attitude loop (rad/s), between 0 and 1e5; zero: feedforward only. Its product
  // with the damping ratio and the period is below 1.
  double attitude_bandwidth;
  // Damping ratio of the attitude loop (–), between 0 and 1e3.
  double attitude_damping;
  // Singular value below which the inverse of the arm's Jacobian is damped (m/rad, –), between 1e-9
  // and 1e3.
  double damped_below;
  // Attitude that the base keeps: quaternion w, x, y, z from base axes to inertial axes (–).
  double kept_attitude[4];
  // Posture towards which the freedom that the task leaves is used (rad or m), between -1e6 and 1e6.
  double posture[WRASSE_JOINTS];
  // Largest rate of each joint (rad/s or m/s), between 1e-9 and 100.
  double rate_limit[WRASSE_JOINTS];
  // Largest torque or force of each joint (N·m or N), between 1e-9 and 1e9; zero for none.
  double effort_limit[WRASSE_JOINTS];
} WrasseLaws;

// What is wrong, where, what was found and what was expected.
typedef struct WrasseComplaint {
  // The field, as it is written in this header; null when nothing is wrong.
  const char *field;
  // Number of the link or of the element; -1 where there is but one.
  int32_t index;
  // What was found.
  double found;
  // What was expected; null when nothing is wrong.
  const char *expected;
} WrasseComplaint;

// What the sensors say at the start of a period. A number beyond its bounds is refused; elements of
// joints that the robot does not have are not read.
typedef struct WrasseSensed {
  // Attitude of the base: quaternion w, x, y, z from base axes to inertial axes (–), its squares
  // summing to 1 within 1e-5.
  double attitude[4];
  // Origin of the base, inertial axes (m), between -1e6 and 1e6.
  double position[3];
  // Rate of the base, base axes (rad/s), between -10 and 10.
  double angular_velocity[3];
  // Velocity of the base's origin, base axes (m/s), between -100 and 100.
  double velocity[3];
  // Joint positions (rad or m), between -1e6 and 1e6.
  double joint_position[WRASSE_JOINTS];
  // Joint rates (rad/s or m/s), between -100 and 100.
  double joint_rate[WRASSE_JOINTS];
  // 1 if the wrench at the tool is measured, 0 if not.
  int32_t wrench_measured;
  // That wrench at the tool's origin, tool axes: torque (N·m), then force (N), between -1e6 and 1e6.
  double wrench[6];
} WrasseSensed;

// Reference of the arm at the end of a period.
typedef struct WrasseArmReference {
  // One of `WRASSE_REFERENCE_...`.
  int32_t kind;
  // One of `WRASSE_AXES_...`; for the tool.
  int32_t axes;
  // Where the tool should be (m), between -1e6 and 1e6.
  double tool_position[3];
  // How it should be turned: quaternion w, x, y, z from tool axes to the axes of the motion (–),
  // its squares summing to 1 within 1e-5.
  double tool_attitude[4];
  // Its velocity: angular (rad/s), between -10 and 10, then linear (m/s), between -100 and 100.
  double tool_velocity[6];
  // Time derivative of that (rad/s², m/s²), between -100 and 100.
  double tool_acceleration[6];
  // Drift towards the posture of the laws (1/s), between -10 and 10; zero for joint rates of
  // least norm.
  double posture_gain;
  // How fast that gain changes (1/s²), between -100 and 100.
  double posture_gain_rate;
  // Where the joints should be (rad or m), between -1e6 and 1e6.
  double joint_position[WRASSE_JOINTS];
  // Their rates (rad/s or m/s), between -100 and 100.
  double joint_rate[WRASSE_JOINTS];
  // Their accelerations (rad/s² or m/s²), between -1e4 and 1e4.
  double joint_acceleration[WRASSE_JOINTS];
} WrasseArmReference;

// Commands of the actuators for the period.
typedef struct WrasseControlOutput {
  // Where each joint should be at its end (rad or m).
  double joint_position[WRASSE_JOINTS];
  // Rates there (rad/s or m/s).
  double joint_rate[WRASSE_JOINTS];
  // Accelerations there (rad/s² or m/s²).
  double joint_acceleration[WRASSE_JOINTS];
  // Torque or force of each joint over the period (N·m or N).
  double effort[WRASSE_JOINTS];
  // Torque that the base should feel over the period, base axes (N·m).
  double attitude_torque[3];
  // Force that is known to be needed against a push at the tool, base axes (N).
  double force_ahead[3];
} WrasseControlOutput;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Set up the memory of the flight code for a robot and its laws. `complaint` may be null; otherwise
// it says what is wrong when the status is not `WRASSE_OK`.
//
// # Safety
// Each pointer is null or points to as much as its type says; `links` to `link_count` links.
WrasseStatus wrasse_flight_set_up(struct WrasseFlight *flight,
                                  const struct WrasseBody *base,
                                  const struct WrasseLink *links,
                                  uint32_t link_count,
                                  const struct WrasseFrame *tool,
                                  const struct WrasseLaws *laws,
                                  struct WrasseComplaint *complaint);

// One control period: measurements and reference in, commands of the actuators out. The first period
// after the set-up takes everything from the measurements.
//
// Measurements and reference are held against the bounds that stand at their fields; output and memory
// must be finite. When the status is not `WRASSE_OK` the memory is as it was, to the
// byte, so that later periods are those of a flight without this one; `output` has no torque and no
// force, its rates and accelerations are zero, and its positions are those of the last accepted period
// (zero before the first).
//
// # Safety
// Each pointer is null or points to as much as its type says; `flight` to memory that
// `wrasse_flight_set_up` wrote, or to zeros. They do not overlap.
WrasseStatus wrasse_flight_period(struct WrasseFlight *flight,
                                  const struct WrasseSensed *sensed,
                                  const struct WrasseArmReference *reference,
                                  struct WrasseControlOutput *output,
                                  struct WrasseComplaint *complaint);

// What a status means, in English. Never null.
const char *wrasse_status_text(int32_t status);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* WRASSE_FLIGHT_H */
