/* Two control periods of the ATLAS-class servicer: the first looks around, the second moves the tool.
   Build: cc one_period.c libwrasse_flight_c.a -lm */
#include "atlas_class.h"
#include "wrasse_flight.h"

#include <stdio.h>

/* The flight code brings no memory of its own: here it is static, 16 KiB. */
static WrasseFlight flight;

static int failed(const char *what, WrasseStatus status, const WrasseComplaint *complaint)
{
    fprintf(stderr, "%s: %s\n", what, wrasse_status_text(status));
    if (complaint->field != NULL) {
        fprintf(stderr, "  %s [%d] is %g, expected %s\n", complaint->field, complaint->index,
                complaint->found, complaint->expected);
    }
    return 2;
}

int main(void)
{
    WrasseLaws laws = {
        .law = WRASSE_LAW_ATTITUDE_HELD,
        .task = WRASSE_TASK_POSE,
        .feedforward = WRASSE_FEEDFORWARD_EXACT,
        .measurement = WRASSE_MEASURE_BASE,
        .period = 0.01,
        .tool_gain = 2.0,
        .joint_bandwidth = 10.0,
        .joint_damping = 1.0,
        .attitude_bandwidth = 0.3,
        .attitude_damping = 1.0,
        .damped_below = 0.02,
        .kept_attitude = {1.0, 0.0, 0.0, 0.0},
    };
    /* Out in front of the bus, elbow bent. */
    WrasseSensed sensed = {
        .attitude = {1.0, 0.0, 0.0, 0.0},
        .angular_velocity = {0.001, -0.002, 0.0005},
        .joint_position = {0.2, -0.6, -0.6, 1.9, -0.3, -1.3, 0.4},
    };
    for (int joint = 0; joint < ATLAS_CLASS_LINK_COUNT; ++joint) {
        laws.rate_limit[joint] = 0.2;
        laws.effort_limit[joint] = 500.0;
        sensed.joint_rate[joint] = 0.01 * (joint - 3);
    }

    WrasseComplaint complaint;
    WrasseStatus status = wrasse_flight_set_up(&flight, &ATLAS_CLASS_BASE, ATLAS_CLASS_LINKS,
                                               ATLAS_CLASS_LINK_COUNT, &ATLAS_CLASS_TOOL, &laws,
                                               &complaint);
    if (status != WRASSE_OK) {
        return failed("set up", status, &complaint);
    }

    WrasseArmReference still = {.kind = WRASSE_REFERENCE_STILL};
    /* The tool goes to a place ahead, at 5 cm/s along x. */
    WrasseArmReference tool = {
        .kind = WRASSE_REFERENCE_TOOL,
        .axes = WRASSE_AXES_INERTIAL,
        .tool_position = {1.5, 0.4, 0.1},
        .tool_attitude = {1.0, 0.0, 0.0, 0.0},
        .tool_velocity = {0.0, 0.0, 0.0, 0.05, 0.0, 0.0},
    };
    const WrasseArmReference *reference[] = {&still, &tool};
    WrasseControlOutput output;
    for (int period = 0; period < 2; ++period) {
        status = wrasse_flight_period(&flight, &sensed, reference[period], &output, &complaint);
        if (status != WRASSE_OK) {
            return failed("period", status, &complaint);
        }
    }
    /* Seventeen digits: every bit. */
    for (int joint = 0; joint < ATLAS_CLASS_LINK_COUNT; ++joint) {
        printf("%.17g %.17g %.17g\n", output.joint_position[joint], output.joint_rate[joint],
               output.effort[joint]);
    }
    printf("%.17g %.17g %.17g\n", output.attitude_torque[0], output.attitude_torque[1],
           output.attitude_torque[2]);
    return 0;
}
