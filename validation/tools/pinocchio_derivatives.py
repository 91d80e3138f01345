"""Makes ../golden/derivatives_*.json: derivatives of inverse and forward dynamics by Pinocchio.

    pip install pin==4.1.0 && python3 validation/tools/pinocchio_derivatives.py

computeRNEADerivatives and computeABADerivatives at the second state of each golden vehicle, no gravity.
Pinocchio puts the linear part first; here the angular part comes first. Its free-flyer moves by a twist in
body axes, as here, so nothing else is converted. Rows and columns: the base's six, then the joints as listed.
"""
import json
import pathlib

import numpy as np
import pinocchio as pin

GOLDEN = pathlib.Path(__file__).resolve().parent.parent / "golden"
STATE = 1


def six(parts, angular, linear):
    return np.array(parts[linear] + parts[angular])


def case(name):
    model = pin.buildModelFromUrdf(str(GOLDEN / f"{name}.urdf"), pin.JointModelFreeFlyer())
    model.gravity.setZero()
    data = model.createData()
    state = json.loads((GOLDEN / f"{name}.json").read_text())["input"]["states"][STATE]
    q, v, a, tau = pin.neutral(model), np.zeros(model.nv), np.zeros(model.nv), np.zeros(model.nv)
    attitude = state["base"]["attitude"]
    q[:3] = state["base"]["position"]
    q[3:7] = [attitude[k] for k in "xyzw"]
    v[:6] = six(state["base_velocity"], "angular", "linear")
    a[:6] = six(state["base_acceleration"], "angular", "linear")
    tau[:6] = six(state["base_wrench"], "torque", "force")
    names = list(model.names)[2:]
    for joint in names:
        j, given = model.joints[model.getJointId(joint)], state["joints"][joint]
        at = given["position"]
        q[j.idx_q : j.idx_q + j.nq] = [np.cos(at), np.sin(at)] if j.nq == 2 else [at]
        v[j.idx_v], a[j.idx_v], tau[j.idx_v] = (
            given[key] for key in ("velocity", "acceleration", "torque")
        )
    q = pin.normalize(model, q)
    order = [3, 4, 5, 0, 1, 2] + [model.joints[model.getJointId(n)].idx_v for n in names]

    def rows(matrix):
        return np.asarray(matrix)[np.ix_(order, order)].tolist()

    def symmetric(matrix):
        return rows(np.triu(matrix) + np.triu(matrix, 1).T)

    pin.computeRNEADerivatives(model, data, q, v, a)
    inverse = {
        "by_position": rows(data.dtau_dq),
        "by_velocity": rows(data.dtau_dv),
        "by_acceleration": symmetric(data.M),
    }
    pin.computeABADerivatives(model, data, q, v, tau)
    forward = {
        "by_position": rows(data.ddq_dq),
        "by_velocity": rows(data.ddq_dv),
        "by_force": symmetric(data.Minv),
    }
    return {
        "made_by": f"Pinocchio {pin.__version__} computeRNEADerivatives, computeABADerivatives; "
        "validation/tools/pinocchio_derivatives.py",
        "vehicle": f"{name}.urdf",
        "input": state,
        "joint_names": names,
        "inverse_dynamics": inverse,
        "forward_dynamics": forward,
    }


for name in ("one_arm", "two_arms"):
    (GOLDEN / f"derivatives_{name}.json").write_text(json.dumps(case(name), indent=1) + "\n")
