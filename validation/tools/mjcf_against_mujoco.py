"""Holds the mass matrices that wrasse computes for MJCF files against MuJoCo's.

    pip install mujoco==4.0.0
    python3 validation/tools/mjcf_against_mujoco.py FILE_OR_FOLDER… [--wrasse PROGRAM] [--states N]
    python3 validation/tools/mjcf_against_mujoco.py FILE… --golden FOLDER

Each file is read by `wrasse eval` and by MuJoCo, and the mass matrices are compared at random states: joints
within ±1 (rad, m), any attitude. The largest difference is told as a part of the largest element.
Two things are done to MuJoCo's reading first, and no more:

- what has no mass or needs a file is taken out: sensors, drives, textures, mocap bodies on the world, meshes
  and the geoms made of them (where a body has no <inertial>, wrasse refuses them);
- a base that is fixed to the world gets a <freejoint/>, because it floats in wrasse.

mj_fullM orders the base as [linear in world axes; angular in body axes]; here it is [angular; linear] in
body axes, which is a permutation and a rotation. Joints are matched by name, never by place.
With --golden the states and MuJoCo's matrices are written, one JSON for each file.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import mujoco
import numpy as np


def without_meshes(spec):
    """Takes out all that needs a file, and what depends on it."""
    for kind in ("sensors", "tendons", "actuators", "keys", "equalities", "excludes", "pairs"):
        for element in list(getattr(spec, kind, [])):
            spec.delete(element)
    for body in spec.bodies:
        for geom in list(body.geoms):
            if geom.meshname or geom.hfieldname:
                spec.delete(geom)
    for kind in ("skins", "meshes", "hfields"):
        for element in list(getattr(spec, kind, [])):
            spec.delete(element)
    for body in spec.bodies:
        for shown in [*body.geoms, *body.sites]:
            shown.material = ""
    for kind in ("materials", "textures"):
        for element in list(getattr(spec, kind, [])):
            spec.delete(element)


def model(path):
    spec = mujoco.MjSpec.from_file(str(path))
    without_meshes(spec)
    for mark in [body for body in spec.worldbody.bodies if body.mocap]:
        spec.delete(mark)
    if len(spec.worldbody.bodies) != 1:
        raise ValueError(f"{len(spec.worldbody.bodies)} bodies on the world")
    [base] = spec.worldbody.bodies
    if not any(joint.type == mujoco.mjtJoint.mjJNT_FREE for joint in base.joints):
        base.add_freejoint()
    # Its mass properties are in MuJoCo's own frame otherwise, where the base is alone.
    spec.compiler.alignfree = False
    compiled = spec.compile()
    # A <freejoint> takes no armature from a class; one that is added here does.
    compiled.dof_armature[:6] = 0
    return compiled


def joint_name(compiled, joint):
    return compiled.joint(joint).name or f"joint{joint}"


def mass_matrix(compiled, state):
    """MuJoCo's matrix as [angular; linear] in body axes, then the joints by name."""
    data = mujoco.MjData(compiled)
    free = [j for j in range(compiled.njnt) if compiled.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE]
    [free] = free
    names = {joint_name(compiled, j): j for j in range(compiled.njnt) if j != free}
    at = compiled.jnt_qposadr[free]
    attitude = state["base"]["attitude"]
    data.qpos[at : at + 3] = state["base"]["position"]
    data.qpos[at + 3 : at + 7] = [attitude[k] for k in "wxyz"]
    for name, value in state["joints"].items():
        data.qpos[compiled.jnt_qposadr[names[name]]] = value["position"]
    mujoco.mj_kinematics(compiled, data)
    mujoco.mj_comPos(compiled, data)
    mujoco.mj_makeM(compiled, data)
    full = np.zeros((compiled.nv, compiled.nv))
    mujoco.mj_fullM(compiled, data, full)
    R = np.zeros(9)
    mujoco.mju_quat2Mat(R, data.qpos[at + 3 : at + 7])
    v = compiled.jnt_dofadr[free]
    turn = np.eye(compiled.nv)
    turn[v : v + 3, v : v + 3] = R.reshape(3, 3)
    full = turn.T @ full @ turn
    order = [*range(v + 3, v + 6), *range(v, v + 3)]
    order += [compiled.jnt_dofadr[names[name]] for name in state["joints"]]
    return full[np.ix_(order, order)]


def random_states(names, count):
    random = np.random.default_rng(42)
    states = []
    for _ in range(count):
        quat = random.normal(size=4)
        quat /= np.linalg.norm(quat)
        states.append({
            "base": {
                "position": random.uniform(-1, 1, 3).tolist(),
                "attitude": dict(zip("wxyz", quat.tolist())),
            },
            "joints": {name: {"position": random.uniform(-1, 1)} for name in names},
        })
    return states


def evaluated(program, path, frame, states):
    with tempfile.NamedTemporaryFile("w", suffix=".json") as question:
        json.dump({"frame": frame, "states": states}, question)
        question.flush()
        command = [program, "eval", str(path), "--states", question.name]
        return subprocess.run(command, capture_output=True, text=True)


def compare(program, path, count):
    try:
        compiled = model(path)
    except (ValueError, mujoco.FatalError) as why:
        return None, f"MuJoCo: {str(why).splitlines()[0]}"
    bodies = [compiled.body(b).name for b in range(1, compiled.nbody)]
    names = [joint_name(compiled, j) for j in range(1, compiled.njnt)]
    states = random_states(names, count)
    answer = evaluated(program, path, bodies[0] or "body1", states)
    if answer.returncode != 0:
        told = [line for line in answer.stderr.splitlines() if line.startswith("error")]
        return None, "wrasse: " + (told or answer.stderr.splitlines() or ["no answer"])[0]
    answer = json.loads(answer.stdout)
    if answer["joint_names"] != names:
        return None, f"joints differ: {answer['joint_names']} and {names}"
    worst = 0.0
    for state, result in zip(states, answer["results"]):
        expected = mass_matrix(compiled, state)
        off = np.abs(np.array(result["mass_matrix"]) - expected).max()
        worst = max(worst, off / np.abs(expected).max())
    return worst, f"{len(names)} joints"


def golden(path, folder, count):
    compiled = model(path)
    names = [joint_name(compiled, j) for j in range(1, compiled.njnt)]
    states = random_states(names, count)
    answer = {
        "made_by": f"MuJoCo {mujoco.__version__} mj_fullM; "
        "validation/tools/mjcf_against_mujoco.py",
        "vehicle": path.name,
        "joint_names": names,
        "states": states,
        "mass_matrices": [mass_matrix(compiled, state).tolist() for state in states],
    }
    (folder / f"{path.stem}.json").write_text(json.dumps(answer) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    parser.add_argument("--wrasse", default="target/release/wrasse")
    parser.add_argument("--states", type=int, default=2)
    parser.add_argument("--golden", type=pathlib.Path)
    args = parser.parse_args()
    files = [f for given in args.files for f in (sorted(given.rglob("*.xml")) if given.is_dir() else [given])]
    if args.golden:
        for path in files:
            golden(path, args.golden, args.states)
        return 0
    agreed, wrong = 0, 0
    for path in files:
        worst, told = compare(args.wrasse, path, args.states)
        if worst is None:
            print(f"{'':>9}  {path}: {told}")
            continue
        print(f"{worst:9.1e}  {path}: {told}")
        agreed, wrong = agreed + (worst < 1e-10), wrong + (not worst < 1e-10)
    print(f"{agreed} agree within 1e-10, {wrong} do not, {len(files) - agreed - wrong} are not compared")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
