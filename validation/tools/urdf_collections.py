"""Other people's URDF files, read by wrasse and by Pinocchio: the mass matrix of each in two postures.

A file is read and its mass matrix agrees, as it is and as `wrasse convert` writes it; or it is refused, and Pinocchio's own mass matrix must show
why; or it has more joints than a vehicle may have.

    python -m venv peers && peers/bin/pip install pin==4.1.0 example-robot-data==6.0.0 icub-models==3.2.0
    peers/bin/python validation/tools/urdf_collections.py --wrasse target/release/wrasse \
        --page book/src/validation/urdf_collections.md FOLDER...

FOLDER is searched for *.urdf; without one, those of the two packages of this interpreter are.
Exit code 1 if a file is neither read nor refused for a reason that is confirmed.
"""

import argparse
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import numpy as np
import pinocchio as pin

# Largest deviation of an element, as a part of the root of its two diagonal elements.
TOLERANCE = 1e-12
# An eigenvalue that is told from zero, of a matrix whose diagonal is scaled to one. A complaint names its
# posture with four figures, and an eigenvalue goes with the square of what that leaves out.
SINGULAR = 1e-8


def packages():
    """The folders of the two packages."""
    root = pathlib.Path(sys.prefix)
    return [
        *root.glob("lib/python*/site-packages/cmeel.prefix/share/example-robot-data/robots"),
        *root.glob("share/iCub/robots"),
    ]


def run(wrasse, *arguments, text=None):
    return subprocess.run([wrasse, *arguments], input=text, capture_output=True, text=True)


def root_link(path):
    robot = ElementTree.parse(path).getroot()
    children = {joint.find("child").get("link") for joint in robot.findall("joint")}
    links = [link.get("name") for link in robot.findall("link")]
    world = [j for j in robot.findall("joint") if j.find("parent").get("link") == "world"]
    if len(world) == 1 and world[0].get("type") == "floating":
        return world[0].find("child").get("link")
    return next(name for name in links if name not in children)


def evaluated(wrasse, vehicle, frame, states):
    """What wrasse answers, or None if it refuses the vehicle."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({"frame": frame, "states": states}, file)
        file.flush()
        answer = run(wrasse, "eval", str(vehicle), "--states", file.name)
    return json.loads(answer.stdout) if answer.returncode == 0 else None


def mass_matrix(model, data, position):
    """Pinocchio's, with the angular part of the base first and joints in its own order."""
    q = pin.neutral(model)
    for joint, value in position.items():
        j = model.getJointId(joint)
        at = model.idx_qs[j]
        if model.nqs[j] == 2:
            q[at], q[at + 1] = math.cos(value), math.sin(value)
        else:
            q[at] = value
    M = pin.crba(model, data, q)
    M = np.triu(M) + np.triu(M, 1).T
    names = list(model.names[2:])
    rows = [3, 4, 5, 0, 1, 2] + [model.idx_vs[model.getJointId(name)] for name in names]
    return names, M[np.ix_(rows, rows)]


def deviation(ours, names, theirs, their_names):
    order = list(range(6)) + [6 + their_names.index(name) for name in names]
    M, P = np.array(ours), theirs[np.ix_(order, order)]
    scale = np.sqrt(np.abs(np.outer(np.diag(P), np.diag(P))))
    scale[scale == 0.0] = 1.0
    return float(np.max(np.abs(M - P) / scale))


def least_pivot(M):
    scale = np.sqrt(np.diag(M))
    if np.any(scale <= 0.0):
        return 0.0
    return float(np.linalg.eigvalsh(M / np.outer(scale, scale))[0])


def moments_of_a_body(inertia):
    """Principal moments about the centre of mass, from Pinocchio's mass matrix of this body alone."""
    model = pin.Model()
    joint = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "body")
    model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
    M = pin.crba(model, model.createData(), pin.neutral(model))
    M = np.triu(M) + np.triu(M, 1).T
    mass = M[0, 0]
    first = np.array([M[2, 4], M[0, 5], M[1, 3]])
    about_origin = M[3:, 3:]
    if mass == 0.0:
        return mass, np.linalg.eigvalsh(about_origin)
    lever = -first / mass
    steiner = mass * (lever @ lever * np.eye(3) - np.outer(lever, lever))
    return mass, np.linalg.eigvalsh(about_origin - steiner)


def not_a_body(model):
    """Bodies that no matter makes, as Pinocchio's mass matrices show."""
    wrong = []
    for j in range(1, model.njoints):
        mass, (a, b, c) = moments_of_a_body(model.inertias[j])
        about_origin = max(abs(a), abs(c), 1e-9 * mass)
        if (mass == 0.0 and c != 0.0) or a < -1e-9 * about_origin or c > (a + b) * (1 + 1e-9) + 1e-9 * about_origin:
            wrong.append(f"{model.names[j]}: {mass:.4g} kg, {a:.4g}, {b:.4g}, {c:.4g} kg m2")
    return wrong


def fixed_at(model, path):
    """Where `fix` puts joints: at zero or the end of the travel nearest to it; followers at their offset."""
    q = np.clip(0.0, model.lowerPositionLimit, model.upperPositionLimit)
    q[:7] = pin.neutral(model)[:7]
    for j in range(2, model.njoints):
        if model.nqs[j] == 2:
            q[model.idx_qs[j] : model.idx_qs[j] + 2] = 1.0, 0.0
    for joint in ElementTree.parse(path).getroot().findall("joint"):
        mimic = joint.find("mimic")
        if mimic is not None and model.existJointName(joint.get("name")):
            q[model.idx_qs[model.getJointId(joint.get("name"))]] = float(mimic.get("offset", 0.0))
    return q


def postures(names, seed):
    source = random.Random(seed)
    return [{name: source.uniform(-1.0, 1.0) for name in names} for _ in range(2)]


def compared(wrasse, path, vehicle, frame, prefix=""):
    """Largest deviation in two postures, or None if refused."""
    first = evaluated(wrasse, vehicle, frame, [{}])
    if first is None:
        return None
    names = first["joint_names"]
    at = postures(names, str(path.name))
    states = [{"joints": {name: {"position": q} for name, q in position.items()}} for position in at]
    answer = evaluated(wrasse, vehicle, frame, states)
    model = pin.buildModelFromUrdf(str(path), pin.JointModelFreeFlyer())
    if len(names) < model.njoints - 2:
        fixed = [j for j in range(2, model.njoints) if model.names[j] not in names]
        model = pin.buildReducedModel(model, fixed, fixed_at(model, path))
    worst = 0.0
    for position, result in zip(at, answer["results"]):
        their_names, P = mass_matrix(model, model.createData(), position)
        worst = max(worst, deviation(result["mass_matrix"], names, P, their_names))
    return len(names), worst


def converted(wrasse, path, frame):
    """Largest deviation of the file that `wrasse convert` writes; infinity if it is not read."""
    told = run(wrasse, "convert", str(path))
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "converted.toml"
        file.write_text(told.stdout)
        again = compared(wrasse, path, file, frame) if told.returncode == 0 else None
    return math.inf if again is None else again[1]


def included(folder, path, more):
    file = pathlib.Path(folder) / "vehicle.toml"
    text = f'name = "v"\nsummary = "one file"\nsource.assumed = "none"\n[[include]]\nvehicle = {json.dumps(str(path))}\n{more}\n'
    file.write_text(text)
    return file


def posture_told(message):
    """The posture that a complaint names, in SI."""
    q = {}
    for name, value, unit in re.findall(r"'([^']+)' = ([-\d.e]+) (deg|m)", message):
        q[name] = math.radians(float(value)) if unit == "deg" else float(value)
    return q


def refused(wrasse, path):
    """Why wrasse refuses a file, whether Pinocchio agrees, and with what it is read then."""
    told = run(wrasse, "check", str(path)).stderr
    errors = [line[7:] for line in told.splitlines() if line.startswith("error: ")]
    frame = root_link(path) if "has no links" not in told else ""
    if "has no links" in told:
        links = ElementTree.parse(path).getroot().findall("link")
        return "no links", not links, "none in the file" if not links else "?", ""
    model = pin.buildModelFromUrdf(str(path), pin.JointModelFreeFlyer())
    with tempfile.TemporaryDirectory() as folder:
        many = [e for e in errors if "moving joints: a vehicle has at most" in e]
        if many:
            count = model.njoints - 2
            vehicle = included(folder, path, 'fix = ["hand_*"]')
            after = compared(wrasse, path, vehicle, frame)
            limit = int(many[0].split()[-1])
            return many[0], count > limit, f"{count} joints", said(after, '`fix = ["hand_*"]`')
        missing = [e for e in errors if "which is no joint" in e]
        if missing:
            text = path.read_text()
            leaders = set(re.findall(r"<mimic\s+joint\s*=\s*\"([^\"]+)\"", text))
            absent = sorted(name for name in leaders if f'name="{name}"' not in text and f'name = "{name}"' not in text)
            followers = re.findall(r"joint '([^']+)' follows", "\n".join(missing))
            vehicle = included(folder, path, f"fix = {json.dumps(followers)}")
            after = compared(wrasse, path, vehicle, frame)
            return f"{len(missing)} joints mimic joints that are not in the file", bool(absent), "names " + ", ".join(absent), said(after, "`fix` of these")
        singular = [e for e in errors if "singular" in e]
        if singular:
            _, M = mass_matrix(model, model.createData(), posture_told(singular[0]))
            least = least_pivot(M)
            return f"{singular[0]}" + (f" ({len(singular)} such)" if len(singular) > 1 else ""), least < SINGULAR, f"least eigenvalue {least:.1e} of a unit diagonal", ""
        wrong = not_a_body(model)
        vehicle = included(folder, path, 'accept_nonphysical = "as in the file"')
        after = compared(wrasse, path, vehicle, frame)
        return f"{len(errors)} bodies: {errors[0]}", bool(wrong), f"{len(wrong)} bodies; {wrong[0] if wrong else ''}", said(after, "`accept_nonphysical`")


def said(after, how):
    if after is None:
        return f"refused with {how} too"
    return f"with {how}: {after[0]} joints, {after[1]:.1e}"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--wrasse", default="target/release/wrasse")
    options.add_argument("--page", type=pathlib.Path, help="write the table between the marks of this page")
    options.add_argument("folders", nargs="*", type=pathlib.Path)
    options = options.parse_args()
    read, rejected, bad = [], [], 0
    for folder in options.folders or packages():
        for path in sorted(folder.rglob("*.urdf")):
            name = str(path.relative_to(folder))
            outcome = compared(options.wrasse, path, path, root_link(path)) if path.read_text(errors="replace").count("<link") else None
            if outcome is not None:
                joints, worst = outcome
                again = converted(options.wrasse, path, root_link(path))
                agrees = max(worst, again) <= TOLERANCE
                bad += not agrees
                read.append((name, joints, worst, again))
                print(f"{name}: {joints} joints, {worst:.1e}, converted {again:.1e}{'' if agrees else '  DIFFERS'}", flush=True)
            else:
                why, confirmed, shown, then = refused(options.wrasse, path)
                bad += not confirmed
                rejected.append((name, why, confirmed, shown, then))
                print(f"{name}: REFUSED: {why} | {'confirmed' if confirmed else 'NOT CONFIRMED'}: {shown} | {then}", flush=True)
    worst = max((row[2] for row in read), default=0.0)
    again = max((row[3] for row in read), default=0.0)
    print(f"{len(read)} read, largest deviation {worst:.1e}, converted {again:.1e}; {len(rejected)} refused; {bad} not as it should be")
    if options.page:
        write(options.page, read, rejected, worst, again)
    return 1 if bad else 0


def write(page, read, rejected, worst, again):
    lines = [
        f"{len(read) + len(rejected)} files: {len(read)} read, {len(rejected)} refused. Pinocchio {pin.__version__}; largest deviation {worst:.1e}, of the converted files {again:.1e}.",
        "",
        "| refused | why | Pinocchio | then |",
        "|---|---|---|---|",
    ]
    for name, why, confirmed, shown, then in rejected:
        lines.append(f"| `{name}` | {why} | {'confirmed' if confirmed else 'not confirmed'}: {shown} | {then} |")
    lines += ["", "| read | moving joints | deviation | converted |", "|---|---|---|---|"]
    lines += [f"| `{name}` | {joints} | {deviation:.1e} | {converted:.1e} |" for name, joints, deviation, converted in read]
    text = page.read_text()
    before, rest = text.split("<!-- table -->\n", 1)
    after = rest.split("<!-- end of table -->", 1)[1]
    page.write_text(before + "<!-- table -->\n" + "\n".join(lines) + "\n<!-- end of table -->" + after)


if __name__ == "__main__":
    sys.exit(main())
