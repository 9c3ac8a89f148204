#!/usr/bin/env python3
"""cases/gears: what a pair of gears must keep, whatever their teeth do, when one drives the other and when it brakes it.

    python3 gears.py build/release/carom [--keep DIR]

Involutes turn at the ratio of the teeth (18 / 24): over each whole number of the driver's teeth from the start on the
angles, and so the mean speeds, keep to it within 1 % of those teeth (3 %
through the backlash and back, which are 0.4 of 15.7 mm with the bending). Their forces lie on the line that touches both base
circles, so that the driver's moment about its own axis over that about the gear's is the same ratio: the integral of the
first gives the change of the gear's angular momentum, within 2 % of the integral of its absolute value, while facets and
bent teeth shift that line. The driver's work is the integral of moment times speed (2e-3: two sums over steps), and what
the bodies have taken up; the ledger closes. Outlines: no node of either is deeper in the other than 3 % of a facet in any
recorded frame, tested here against the polygons. Every run must end good.

drives   the case as it is
brakes   the driver goes faster, then slower: the gear passes through the backlash, and the tips of its teeth come into
         those of the driver bent the other way. Corners of the driver that no node of the gear meets once jammed it.
Needs numpy.
"""

import argparse
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

from ball_on_plate import read_csv, read_field, with_vtu

CASE = pathlib.Path(__file__).resolve().parents[2] / "cases/gears/involute.toml"
RATIO, PITCH, BETWEEN, FACET = 18 / 24, 2 * math.pi / 18, 0.105, 1.25e-3
BRAKES = {"time": "[0.0, 0.5e-3, 1.0e-3, 2.2e-3]", "value": "[1.0, 1.05, 1.05, 0.93]"}


def read_mesh(path):
    """Nodes, and the lines of the groups TEETH and DRIVER as pairs of places among them."""
    lines = path.read_text(encoding="ascii").splitlines()
    def section(name):
        first = lines.index(f"${name}") + 1
        return [line.split() for line in lines[first + 1:first + 1 + int(lines[first])]]
    names = {tag: name.strip('"') for _, tag, name in section("PhysicalNames")}
    groups = {}
    for _, kind, _, tag, _, *members in section("Elements"):
        if kind == "1":
            groups.setdefault(names[tag], []).append([int(n) - 1 for n in members])
    nodes = np.array([[float(v) for v in x[1:3]] for x in section("Nodes")])
    return nodes, {name: np.array(pairs) for name, pairs in groups.items()}


def deepest(points, ends):
    """How deep one of the points is inside of the polygon of the segments, which stand in any order."""
    a, b = ends[:, 0], ends[:, 1]
    p = points[:, None]
    way = b - a
    share = np.clip(((p - a) * way).sum(2) / (way * way).sum(1), 0.0, 1.0)
    distance = np.linalg.norm(p - a - share[..., None] * way, axis=2).min(1)
    y = p[..., 1]
    spans = (a[:, 1] <= y) != (b[:, 1] <= y)
    with np.errstate(divide="ignore", invalid="ignore"):
        right = a[:, 0] + (y - a[:, 1]) * way[:, 0] / way[:, 1] > p[..., 0]
    inside = (spans & right).sum(1) % 2 == 1
    return distance[inside].max(initial=0.0)


def integral(t, values):
    return np.concatenate([[0.0], np.cumsum(0.5 * np.diff(t) * (values[1:] + values[:-1]))])


class Run:
    def __init__(self, carom, folder, changes):
        text = CASE.read_text(encoding="utf-8").replace('"involute.msh"', f'"{CASE.with_suffix(".msh")}"')
        for key, value in changes.items():
            text = re.sub(rf"(?<=speed_up\]\n)((?:.*\n)??){key} = .*", rf"\g<1>{key} = {value}", text, count=1)
        if changes:
            text = text[:text.index("[[check]]")]
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "case.toml").write_text(with_vtu(text), encoding="utf-8")
        done = subprocess.run([carom, "run", "case.toml", "--out", "out", "--quiet"], cwd=folder, text=True,
                              capture_output=True, check=False)
        self.out = folder / "out"
        self.summary = json.loads((self.out / "summary.json").read_text(encoding="utf-8"))
        self.said = f"exit code {done.returncode}: {self.summary['message']}"
        self.is_good = done.returncode == 0
        tables = [read_csv(self.out / name) for name in ("energy.csv", "contact.csv", "probes.csv")]
        self.energy, self.contact, self.probes = ({k: np.array(v) for k, v in table.items()} for table in tables)
        self.t = self.energy["time"]
        self.turned = integral(self.t, self.contact["driver.angular_velocity_z"])

    def ratio_error(self):
        """Largest difference of the gear's angle from that of the ratio at whole teeth, over those teeth."""
        nodes, _ = read_mesh(CASE.with_suffix(".msh"))
        mark = nodes[np.argmin(np.hypot(nodes[:, 0] - 0.035 * math.cos(math.pi / 24 + 0.1 / 120),
                                        nodes[:, 1] - 0.035 * math.sin(math.pi / 24 + 0.1 / 120)))]
        x, y = (mark[c] + self.probes[f"mark.displacement_{axis}"] for c, axis in enumerate("xy"))
        angle = -(np.unwrap(np.arctan2(y, x)) - math.atan2(mark[1], mark[0]))
        teeth = np.arange(1, int(self.turned[-1] / PITCH + 1e-6) + 1)
        at = np.interp(teeth * PITCH, self.turned, angle)
        return max(abs(at - RATIO * teeth * PITCH) / (RATIO * teeth * PITCH)), len(teeth)

    def moment_error(self):
        """The change of the angular momentum less the integral of the moment over the ratio, over that of its size."""
        moment = self.contact["driver.moment_z"] / RATIO
        change = -(self.energy["angular_momentum_z"] - self.energy["angular_momentum_z"][0])
        return max(abs(change - integral(self.t, moment))) / integral(self.t, abs(moment))[-1]

    def work_error(self):
        """Work of the driver: by its moment, and by the energies that the gear has gained."""
        work = self.energy["support_work"]
        by_moment = integral(self.t, self.contact["driver.moment_z"] * self.contact["driver.angular_velocity_z"])
        terms = ("kinetic", "strain", "contact_stored", "algorithmic", "quadrature")
        stored = sum(self.energy[k] for k in terms)
        return (max(abs(work - by_moment)) / max(abs(work)),
                max(abs(self.energy["imbalance"])) / stored[0])

    def depth(self):
        nodes, groups = read_mesh(CASE.with_suffix(".msh"))
        teeth, driver = groups["TEETH"], groups["DRIVER"]
        frames = sorted((self.out / "fields").glob("step_*.vtu"))
        points = np.array(read_field(frames[0], "Points")).reshape(-1, 3)[:, :2]
        at = {tuple(p): i for i, p in enumerate(np.round(points, 12).tolist())}
        own = np.array([at.get(tuple(p), -1) for p in np.round(nodes, 12).tolist()])
        times = dict(re.findall(r'timestep="([^"]*)".*file="fields/(step_[0-9]*.vtu)"',
                                (self.out / "fields.pvd").read_text(encoding="utf-8")))
        times = {file: float(t) for t, file in times.items()}
        worst = 0.0
        for frame in frames:
            gear = nodes + np.array(read_field(frame, "displacement")).reshape(-1, 3)[own][:, :2]
            angle = np.interp(times[frame.name], self.t, self.turned)
            c, s = math.cos(angle), math.sin(angle)
            rigid = (nodes + [BETWEEN, 0.0]) @ np.array([[c, s], [-s, c]]) - [BETWEEN, 0.0]
            worst = max(worst, deepest(gear[np.unique(teeth)], rigid[driver]),
                        deepest(rigid[np.unique(driver)], gear[teeth]))
        return worst / FACET, len(frames)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("carom", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_args()
    faults = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.keep or pathlib.Path(scratch)
        for name, changes in (("drives", {}), ("brakes", BRAKES)):
            run = Run(options.carom.resolve(), folder / name, changes)
            ratio, teeth = run.ratio_error()
            moment = run.moment_error()
            by_moment, imbalance = run.work_error()
            depth, frames = run.depth()
            print(f"{name}: ratio {ratio:.2%} over {teeth} teeth, moment {moment:.2%}, work {by_moment:.1e}, ledger "
                  f"{imbalance:.1e}, depth {depth:.2%} of a facet in {frames} frames; {run.said}")
            limits = {"moment": (moment, 0.02), "work": (by_moment, 2e-3), "ledger": (imbalance, 1e-12),
                      "depth": (depth, 0.03), "ratio": (ratio, 0.01 if not changes else 0.03)}
            faults += [f"{name}: {what}" for what, (value, limit) in limits.items() if not value <= limit]
            faults += [] if run.is_good else [f"{name}: {run.said}"]
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
