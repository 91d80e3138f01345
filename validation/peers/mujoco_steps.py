"""Time of MuJoCo's fourth-order step on a coasting vehicle, nothing else simulated."""
import json
import statistics
import sys
import time

import mujoco
import numpy
from mujoco import rollout

name, path = sys.argv[1:]
spec = mujoco.MjSpec.from_file(path)
spec.worldbody.first_body().add_freejoint()
spec.option.gravity = numpy.zeros(3)
spec.option.timestep = 1e-3
spec.option.integrator = mujoco.mjtIntegrator.mjINT_RK4
spec.option.disableflags = mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
model = spec.compile()
data = mujoco.MjData(model)
data.qvel[:] = 0.1 * numpy.random.default_rng(1).standard_normal(model.nv)
kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
state = numpy.empty(mujoco.mj_stateSize(model, kind))
mujoco.mj_getState(model, data, state, kind)
STEPS = 10_000
nanoseconds = []
for _ in range(15):
    begin = time.perf_counter_ns()
    rollout.rollout(model, data, state, nstep=STEPS)
    nanoseconds.append((time.perf_counter_ns() - begin) / STEPS)
print(json.dumps({
    "peer": f"MuJoCo {mujoco.__version__}", "vehicle": name, "quantity": "coasting_step",
    "minimum_ns": min(nanoseconds), "median_ns": statistics.median(nanoseconds),
}))
