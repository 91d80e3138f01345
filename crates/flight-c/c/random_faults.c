/* Random faults of single words: in readings, in the reference, in the tables of the set-up. Counts what
   must not be: a status of WRASSE_OK beside a number that is not finite, a refusal that leaves a trace.
   Build: cc random_faults.c libwrasse_flight_c.a -lm; run with the numbers of faults of periods and of
   set-ups. */
#include "atlas_class.h"
#include "wrasse_flight.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t seed = 20040901;

static uint64_t random_bits(void)
{
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return seed;
}

/* Numbers that break formulas. */
static const double ODD[] = {NAN,    INFINITY, -INFINITY, 1e308, -1e308, 1e200, 1e160, 1e100, 1e30, 1e-300,
                             5e-324, 0.0,      -0.0,      -1.0,  1.0,    1e12,  1e9,   1e5,   1e-12, 3.2};

/* One word with one bit, all bits, or its number changed. */
static void spoil(void *words, size_t count)
{
    unsigned char *word = (unsigned char *)words + 8 * (random_bits() % count);
    uint64_t bits;
    memcpy(&bits, word, 8);
    double number;
    switch (random_bits() % 4) {
    case 0: bits ^= (uint64_t)1 << (random_bits() % 64); break;
    case 1: bits = random_bits(); break;
    case 2: number = (double)(int64_t)random_bits() * 1e-18; memcpy(&bits, &number, 8); break;
    default: number = ODD[random_bits() % (sizeof ODD / sizeof *ODD)]; memcpy(&bits, &number, 8);
    }
    memcpy(word, &bits, 8);
}

static WrasseLaws good_laws(int32_t law)
{
    WrasseLaws laws = {.law = law, .feedforward = 1, .measurement = 1, .period = 0.01, .tool_gain = 2.0,
                       .joint_bandwidth = 10.0, .joint_damping = 1.0, .attitude_bandwidth = 0.3,
                       .attitude_damping = 1.0, .damped_below = 0.02, .kept_attitude = {1, 0, 0, 0}};
    for (int j = 0; j < WRASSE_JOINTS; ++j) {
        laws.rate_limit[j] = 0.2;
        laws.effort_limit[j] = 500.0;
    }
    return laws;
}

static WrasseSensed good_sensed(void)
{
    WrasseSensed sensed = {.attitude = {1, 0, 0, 0}, .angular_velocity = {0.001, -0.002, 0.0005},
                           .joint_position = {0.2, -0.6, -0.6, 1.9, -0.3, -1.3, 0.4}};
    for (int j = 0; j < 7; ++j) {
        sensed.joint_rate[j] = 0.01 * (j - 3);
    }
    return sensed;
}

static WrasseArmReference good_reference(uint64_t kind)
{
    WrasseArmReference reference = {.kind = (int32_t)(kind % 4), .axes = (int32_t)(kind / 4 % 2),
                         .tool_position = {1.5, 0.4, 0.1}, .tool_attitude = {1, 0, 0, 0},
                         .tool_velocity = {0, 0, 0, 0.05, 0, 0}, .posture_gain = 0.1,
                         .joint_position = {0.2, -0.6, -0.6, 1.9, -0.3, -1.3, 0.4}};
    return reference;
}

static int is_finite(const WrasseControlOutput *output)
{
    const double *words = (const double *)output;
    for (size_t k = 0; k < sizeof *output / 8; ++k) {
        if (!isfinite(words[k])) {
            return 0;
        }
    }
    return 1;
}

/* No torque, no force, no motion. */
static int is_safe(const WrasseControlOutput *output)
{
    static const WrasseControlOutput none;
    return is_finite(output) && !memcmp(output->joint_rate, none.joint_rate, sizeof none.joint_rate)
        && !memcmp(output->joint_acceleration, none.joint_acceleration, sizeof none.joint_acceleration)
        && !memcmp(output->effort, none.effort, sizeof none.effort)
        && !memcmp(output->attitude_torque, none.attitude_torque, sizeof none.attitude_torque)
        && !memcmp(output->force_ahead, none.force_ahead, sizeof none.force_ahead);
}

static WrasseStatus set_up(WrasseFlight *flight, int32_t law)
{
    WrasseLaws laws = good_laws(law);
    return wrasse_flight_set_up(flight, &ATLAS_CLASS_BASE, ATLAS_CLASS_LINKS, ATLAS_CLASS_LINK_COUNT,
                                &ATLAS_CLASS_TOOL, &laws, NULL);
}

/* Accepted, refused, by status; what must not be. */
static long accepted, refused[10], not_finite, not_finite_next, next_refused, changed, not_safe, silent;

/* One period with a fault, then one without, in the flight and in one that never saw the fault. */
static void period_with_a_fault(WrasseFlight *flight, const WrasseSensed *sensed, uint64_t kind)
{
    WrasseSensed bad_sensed = *sensed;
    WrasseArmReference reference = good_reference(kind), bad_reference = reference;
    if (random_bits() & 1) {
        spoil(&bad_sensed, sizeof bad_sensed / 8);
    } else {
        spoil(&bad_reference, sizeof bad_reference / 8);
    }
    WrasseControlOutput output, expected;
    WrasseComplaint complaint;
    memset(&output, 0x5a, sizeof output);
    memset(&complaint, 0, sizeof complaint);
    WrasseFlight before = *flight;
    WrasseStatus status = wrasse_flight_period(flight, &bad_sensed, &bad_reference, &output, &complaint);
    if (status == WRASSE_OK) {
        ++accepted;
        not_finite += !is_finite(&output);
        next_refused += wrasse_flight_period(flight, sensed, &reference, &output, NULL) != WRASSE_OK;
        not_finite_next += !is_finite(&output);
        *flight = before;
        return;
    }
    ++refused[status];
    changed += memcmp(flight, &before, sizeof before) != 0;
    not_safe += !is_safe(&output);
    silent += complaint.field == NULL || complaint.expected == NULL;
    wrasse_flight_period(flight, sensed, &reference, &output, NULL);
    wrasse_flight_period(&before, sensed, &reference, &expected, NULL);
    changed += memcmp(&output, &expected, sizeof output) || memcmp(flight, &before, sizeof before);
}

/* Faults along flights of each law, in which the joints follow their set-points. */
static void faults_of_periods(long count)
{
    static WrasseFlight flight;
    WrasseSensed sensed = good_sensed();
    for (long k = 0; k < count; ++k) {
        if (k % 1000 == 0) {
            sensed = good_sensed();
            if (set_up(&flight, (int32_t)(k / 1000 % 3)) != WRASSE_OK) {
                abort();
            }
        }
        sensed.wrench_measured = (int32_t)(random_bits() % 2);
        sensed.wrench[3] = 5.0;
        period_with_a_fault(&flight, &sensed, random_bits() % 8);
        WrasseControlOutput output;
        WrasseArmReference reference = good_reference(0);
        if (k % 8 == 0 && wrasse_flight_period(&flight, &sensed, &reference, &output, NULL) == WRASSE_OK) {
            memcpy(sensed.joint_position, output.joint_position, sizeof output.joint_position);
            memcpy(sensed.joint_rate, output.joint_rate, sizeof output.joint_rate);
        }
    }
}

/* A set-up with a fault that is accepted flies good readings. */
static long set_ups, set_ups_accepted, set_ups_changed, set_ups_not_finite, set_ups_that_do_not_fly;

static void fault_of_a_set_up(void)
{
    WrasseBody base = ATLAS_CLASS_BASE;
    WrasseLink links[ATLAS_CLASS_LINK_COUNT];
    memcpy(links, ATLAS_CLASS_LINKS, sizeof links);
    WrasseFrame tool = ATLAS_CLASS_TOOL;
    WrasseLaws laws = good_laws((int32_t)(random_bits() % 3));
    switch (random_bits() % 4) {
    case 0: spoil(&base, sizeof base / 8); break;
    case 1: spoil(links, sizeof links / 8); break;
    case 2: spoil(&tool, sizeof tool / 8); break;
    default: spoil(&laws, sizeof laws / 8);
    }
    static WrasseFlight flight;
    memset(&flight, 0x5a, sizeof flight);
    WrasseFlight before = flight;
    ++set_ups;
    if (wrasse_flight_set_up(&flight, &base, links, ATLAS_CLASS_LINK_COUNT, &tool, &laws, NULL) != WRASSE_OK) {
        set_ups_changed += memcmp(&flight, &before, sizeof flight) != 0;
        return;
    }
    ++set_ups_accepted;
    WrasseSensed sensed = good_sensed();
    for (uint64_t k = 0; k < 4; ++k) {
        WrasseArmReference reference = good_reference(k % 3);
        WrasseControlOutput output;
        WrasseStatus status = wrasse_flight_period(&flight, &sensed, &reference, &output, NULL);
        set_ups_not_finite += !is_finite(&output);
        set_ups_that_do_not_fly += status != WRASSE_OK;
    }
}

int main(int argc, char **argv)
{
    faults_of_periods(argc > 1 ? atol(argv[1]) : 1000000);
    for (long k = argc > 2 ? atol(argv[2]) : 50000; k > 0; --k) {
        fault_of_a_set_up();
    }
    printf("accepted %ld\n", accepted);
    for (int status = 1; status < 10; ++status) {
        printf("refused_by_status_%d %ld\n", status, refused[status]);
    }
    printf("not_finite %ld\nnot_finite_next %ld\nnext_refused %ld\nchanged %ld\nnot_safe %ld\nsilent %ld\n",
           not_finite, not_finite_next, next_refused, changed, not_safe, silent);
    printf("set_ups %ld\nset_ups_accepted %ld\nset_ups_changed %ld\nset_ups_not_finite %ld\n"
           "set_ups_that_do_not_fly %ld\n",
           set_ups, set_ups_accepted, set_ups_changed, set_ups_not_finite, set_ups_that_do_not_fly);
    return 0;
}
