"""Makes ../mujoco_coast.json: coasting free-flyers integrated by MuJoCo, for comparison.

    pip install mujoco numpy && python3 validation/tools/mujoco_coast.py

No gravity, no contact, no joint limits, no damping. MuJoCo's free joint gives the origin of the root
body in world axes, its attitude (w x y z), the origin's velocity in world axes and the angular velocity in
body axes. Its fourth-order stepper is run at three step sizes; the finest is kept, and how far the next
coarser one is from it says how much of it to believe.
"""
import json
import pathlib

import mujoco
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
GOLDEN = HERE.parent / "golden"
DURATION = 4.0
STEPS = [2e-3, 1e-3, 5e-4]


def model_of(urdf, step):
    spec = mujoco.MjSpec.from_string(urdf)
    spec.worldbody.first_body().add_freejoint()
    spec.option.gravity = [0, 0, 0]
    spec.option.timestep = step
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_RK4
    spec.option.disableflags = (
        mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    )
    return spec.compile()


def state_of(model, data):
    joints = {}
    for j in range(model.njnt):
        if model.jnt_type[j] != mujoco.mjtJoint.mjJNT_FREE:
            q, v = model.jnt_qposadr[j], model.jnt_dofadr[j]
            joints[model.joint(j).name] = {"position": data.qpos[q], "velocity": data.qvel[v]}
    return {
        "position": data.qpos[0:3].tolist(),
        "attitude_wxyz": data.qpos[3:7].tolist(),
        "velocity_in_inertial_axes": data.qvel[0:3].tolist(),
        "angular_velocity_in_base_axes": data.qvel[3:6].tolist(),
        "joints": joints,
    }


def flown(urdf, step, seed):
    model = model_of(urdf, step)
    data = mujoco.MjData(model)
    random = np.random.default_rng(seed)
    for j in range(model.njnt):
        if model.jnt_type[j] != mujoco.mjtJoint.mjJNT_FREE:
            data.qpos[model.jnt_qposadr[j]] = random.uniform(-0.8, 0.8)
    data.qpos[0:3] = random.uniform(-1, 1, 3)
    quat = random.normal(size=4)
    data.qpos[3:7] = quat / np.linalg.norm(quat)
    data.qvel[:] = random.uniform(-0.3, 0.3, model.nv)
    start = state_of(model, data)
    for _ in range(round(DURATION / step)):
        mujoco.mj_step(model, data)
    return start, state_of(model, data), np.concatenate([data.qpos, data.qvel])


cases = []
for name, seed in [("one_arm", 1), ("two_arms", 2), ("atlas_class_500kg", 3)]:
    urdf = (GOLDEN / f"{name}.urdf").read_text()
    ends = [flown(urdf, step, seed) for step in STEPS]
    spread = [float(np.abs(a[2] - ends[-1][2]).max()) for a in ends[:-1]]
    start, end, _ = ends[-1]
    cases.append(
        {"vehicle": f"golden/{name}.urdf", "duration_s": DURATION, "start": start, "end": end,
         "spread_of_coarser_steps": spread}
    )
result = {
    "claim": "motion of coasting free-flyers",
    "made_by": f"validation/tools/mujoco_coast.py, MuJoCo {mujoco.__version__}, RK4 at {STEPS[-1]} s",
    "cases": cases,
}
(HERE.parent / "mujoco_coast.json").write_text(json.dumps(result, indent=1) + "\n")
for case in cases:
    print(case["vehicle"], case["spread_of_coarser_steps"])
