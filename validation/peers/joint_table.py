"""The joints of a URDF on a free base as plain numbers, one joint a line, for pinocchio.cpp.

Pinocchio's own reader is compiled for a narrower vector unit than -march=native and does not mix.
A line: kind, parent's number, axis (3), placement on the parent (rotation by rows, translation),
mass, centre of mass (3), inertia about it by rows (9).
"""
import sys

import pinocchio

ALIGNED = {"JointModelRX": "rx", "JointModelRY": "ry", "JointModelRZ": "rz"}


def kind_and_axis(joint):
    name = joint.shortname()
    if name == "JointModelFreeFlyer":
        return "free", [0, 0, 0]
    if name in ALIGNED:
        return ALIGNED[name], [0, 0, 0]
    data = joint.createData()
    joint.calc(data, pinocchio.neutral(model))
    motion = data.S.reshape(-1)
    slides = max(abs(motion[:3])) > max(abs(motion[3:]))
    return ("slide", motion[:3]) if slides else ("turn", motion[3:])


model = pinocchio.buildModelFromUrdf(sys.argv[1], pinocchio.JointModelFreeFlyer())
for number in range(1, model.njoints):
    kind, axis = kind_and_axis(model.joints[number])
    placement, inertia = model.jointPlacements[number], model.inertias[number]
    row = [*axis, *placement.rotation.ravel(), *placement.translation]
    row += [inertia.mass, *inertia.lever, *inertia.inertia.ravel()]
    print(kind, model.parents[number], *(repr(float(x)) for x in row))
