"""Makes ../farrenkopf.csv: the steady state of an attitude estimator about one axis, by its recursion.

    pip install mpmath && python3 validation/tools/farrenkopf.py

The textbook's filter: state (angle, gyro bias), transition [[1, -T], [0, 1]], noise of an interval
[[sv² T + su² T³/3, -su² T²/2], [-su² T²/2, su² T]], an angle measured with sn each interval. The recursion
is repeated in 60 digits until nothing of the covariance changes any more; no closed form is used. The first
row has the numbers of Crassidis and Junkins, Optimal Estimation of Dynamic Systems, 2nd ed., Example 3.3.
"""
import pathlib

from mpmath import mp, mpf, sqrt

mp.dps = 60
HERE = pathlib.Path(__file__).resolve().parent
# Noise of the rate (rad/s^0.5), walk of the bias (rad/s^1.5), noise of a reading (rad), interval (s).
ROWS = [
    (sqrt(mpf(10)) * mpf("1e-7"), sqrt(mpf(10)) * mpf("1e-10"), mpf("17e-6"), mpf(1)),
    (mpf("1e-5"), mpf("3e-7"), mpf("2e-5"), mpf("0.5")),
    (mpf("1e-7"), mpf("1e-6"), mpf("1e-5"), mpf(1)),
]


def steady_state(sv, su, sn, T):
    a, c, b = mpf(1), mpf(0), mpf(1)  # before a reading: angle, both, bias
    while True:
        s = a + sn**2
        after = (a - a * a / s, c - a * c / s, b - c * c / s)
        pa, pc, pb = after
        before = (
            pa - 2 * T * pc + T * T * pb + sv**2 * T + su**2 * T**3 / 3,
            pc - T * pb - su**2 * T**2 / 2,
            pb + su**2 * T,
        )
        change = max(abs(x - y) / abs(x) for x, y in zip(before, (a, c, b)) if x)
        a, c, b = before
        if change < mpf(10) ** -40:
            return sqrt(a), sqrt(pa), sqrt(b), sqrt(pb)


lines = [
    "# Steady state of an attitude estimator about one axis, by validation/tools/farrenkopf.py (mpmath 1.3, 60 digits).",
    "# gyro noise (rad/s^0.5), bias walk (rad/s^1.5), reading (rad), interval (s),"
    " sigma of the angle before and after a reading (rad), of the bias before and after (rad/s)",
]
for row in ROWS:
    numbers = row + steady_state(*row)
    lines.append(",".join(mp.nstr(x, 17, min_fixed=0, max_fixed=1) for x in numbers))
(HERE.parent / "farrenkopf.csv").write_text("\n".join(lines) + "\n")
