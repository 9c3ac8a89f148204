#!/usr/bin/env python3
"""A ball falls on a plate, coarse meshes, default contact settings: over speeds and ratios of cells and stiffnesses
every run must end well, keep its energy and not sink in, and the unit system must not matter.

    python3 ball_on_plate.py build/release/carom                      all runs, some minutes
    python3 ball_on_plate.py build/release/carom --small              some of them, some seconds
    python3 ball_on_plate.py build/release/carom --method two_pass    with another method of contact

Ball: radius 1, a cube of N^3 cells mapped to it, off the middle of the plate. Plate: on a fixed ground, two radii wide,
two thirds thick, or as much as two cells and one. Both neo-Hookean, nu = 0.3, one density. The ball's skin is the
slave, the plate's top the master, but with "all"; penalty, central differences, nothing chosen but the method. Lengths
are in radii of the ball, times in radii over the wave speed sqrt(M / rho) of the softer body, M its p-wave modulus; E
and its cell are the softer body's too.
Measured:
  sinks     deepest node of the ball's skin under the plate's deformed top, from the fields: the program's own gap is
            not asked. In cells of the softer body;
  gap       the program's penetration, in the same cells;
  allowed   the larger of 1 % and twice p / E, p the greatest contact pressure at a node in the fields;
  energy    kinetic + strain + contact + dissipated - supplied, its greatest change over the first, over the run and at
            the end;
  books     residual of the balance of powers;
  force     greatest contact force over Hertz's of a ball on a half-space: how coarse the bodies are, not judged.
A run is bad if it stops, if the verdict refuses anything but the penetration, which is judged here, if energy or books
exceed 1 %, if sinks or gap exceed what is allowed, or if nothing touches.
Standard library only.
"""

import argparse
import array
import csv
import itertools
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import time

NU, DENSITY, MODULUS, RADIUS = 0.3, 1000.0, 1.0e9, 0.01  # of the softer body, SI
P_WAVE = (1.0 - NU) / ((1.0 + NU) * (1.0 - 2.0 * NU))  # M / E
SPEEDS = (1e-5, 1e-4, 1e-3, 1e-2)
MESHES = (0.25, 0.5, 1.0, 2.0, 4.0)  # cell of the plate over cell of the ball
STIFFNESSES = (1e-3, 1e-1, 1.0, 1e1, 1e3)  # E of the ball over E of the plate
BALL_DIVISIONS = {0.25: 2, 0.5: 3, 1.0: 4, 2.0: 5, 4.0: 6}
PAIR = 'kind = "pair"\ngroup = "SKIN"\nmaster = "TOP"'
CENTRE = (0.137, 0.211)
GAP = 1.0e-6
# name: factors of length, time, mass
UNITS = {"SI": (1.0, 1.0, 1.0), "mm-t-s": (1e3, 1.0, 1e-3), "mm-kg-ms": (1e3, 1e3, 1.0), "1/1000": (1e-3, 1e-3, 1e-9)}


def ball_nodes(n):
    """{(i, j, k): position} of a cube of n^3 cells mapped to the unit ball: shells keep |x|_inf, rounder outwards."""
    line = [math.tan(0.25 * math.pi * (2.0 * i / n - 1.0)) for i in range(n + 1)]
    nodes = {}
    for key in itertools.product(range(n + 1), repeat=3):
        p = [line[i] for i in key]
        size, length = max(map(abs, p)), math.hypot(*p)
        if length > 0.0:
            stretch = (1.0 - size) / 1.3 + size * size / length
            p = [x * stretch for x in p]
        nodes[key] = p
    return nodes


def grid_cells(n):
    """Corners (i, j, k) of each cell of a grid of n[0] x n[1] x n[2] cells in the order of HEXA8."""
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    for cell in itertools.product(*(range(m) for m in n)):
        yield [tuple(a + b for a, b in zip(cell, corner)) for corner in corners]


def grid_faces(n, axis, last):
    """Corners of the faces of one side of a grid, seen from outside."""
    d, e = (axis + 1) % 3, (axis + 2) % 3
    for i, j in itertools.product(range(n[d]), range(n[e])):
        face = []
        for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
            key = [0, 0, 0]
            key[axis], key[d], key[e] = (n[axis] if last else 0), i + a, j + b
            face.append(tuple(key))
        yield face if last else face[::-1]


class Bodies:
    """The meshes of ball and plate."""

    def __init__(self, ratio):
        n = BALL_DIVISIONS[ratio]
        self.ball_cell = 2.0 / n
        self.plate_cell = ratio * self.ball_cell
        wide, high = max(2, round(2.0 / self.plate_cell)), max(1, round(0.67 / self.plate_cell))
        self.wide = wide
        self.nodes, number = [], {}
        for key, p in ball_nodes(n).items():
            number["BALL", key] = len(self.nodes)
            self.nodes.append([p[0] + CENTRE[0], p[1] + CENTRE[1], p[2]])
        bottom = min(p[2] for p in self.nodes)
        for p in self.nodes:
            p[2] += GAP - bottom
        for key in itertools.product(range(wide + 1), range(wide + 1), range(high + 1)):
            number["PLATE", key] = len(self.nodes)
            i, j, k = key
            self.nodes.append([(i - 0.5 * wide) * self.plate_cell, (j - 0.5 * wide) * self.plate_cell,
                               (k - high) * self.plate_cell])
        sizes = {"BALL": (n, n, n), "PLATE": (wide, wide, high)}
        self.cells = {body: [[number[body, c] for c in cell] for cell in grid_cells(size)]
                      for body, size in sizes.items()}
        skin = [face for axis in range(3) for last in (False, True) for face in grid_faces(sizes["BALL"], axis, last)]
        self.faces = {"SKIN": [[number["BALL", c] for c in face] for face in skin],
                      "TOP": [[number["PLATE", c] for c in face] for face in grid_faces(sizes["PLATE"], 2, True)],
                      "GROUND": [[number["PLATE", c] for c in face] for face in grid_faces(sizes["PLATE"], 2, False)]}
        self.skin = sorted({i for face in self.faces["SKIN"] for i in face})
        self.top = [[number["PLATE", (i, j, high)] for j in range(wide + 1)] for i in range(wide + 1)]

    def write(self, path, length):
        """The mesh in Gmsh's format 2.2, lengths multiplied."""
        names = [(3, body, cells) for body, cells in self.cells.items()] + \
                [(2, name, faces) for name, faces in self.faces.items()]
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
        lines += [f'{dimension} {tag} "{name}"' for tag, (dimension, name, _) in enumerate(names, 1)]
        lines += ["$EndPhysicalNames", "$Nodes", str(len(self.nodes))]
        lines += [f"{i} {x * length!r} {y * length!r} {z * length!r}" for i, (x, y, z) in enumerate(self.nodes, 1)]
        elements = [f"{5 if dimension == 3 else 3} 2 {tag} {tag} " + " ".join(str(i + 1) for i in cell)
                    for tag, (dimension, _, cells) in enumerate(names, 1) for cell in cells]
        lines += ["$EndNodes", "$Elements", str(len(elements))]
        lines += [f"{i} {element}" for i, element in enumerate(elements, 1)] + ["$EndElements", ""]
        path.write_text("\n".join(lines), encoding="utf-8")

    def order(self, points, radius):
        """Where each node stands in the program's own order."""
        at = {tuple(points[3 * i:3 * i + 3]): i for i in range(len(points) // 3)}
        return [at[tuple(x * radius for x in p)] for p in self.nodes]

    def deepest(self, displacement):
        """How far a node of the skin is under the deformed top: bilinear in the top's own grid, found by iteration."""
        least = math.inf
        for i in self.skin:
            x, y, z = (self.nodes[i][c] + displacement[3 * i + c] for c in range(3))
            s, t = x, y
            for _ in range(6):
                u = self.on_top(displacement, s, t)
                s, t = x - u[0], y - u[1]
            least = min(least, z - u[2])
        return -least

    def on_top(self, displacement, x, y):
        """Displacement of the top over the reference position (x, y)."""
        cell, weight = [], []
        for value in (x, y):
            at = value / self.plate_cell + 0.5 * self.wide
            cell.append(min(max(int(at), 0), self.wide - 1))
            weight.append(at - cell[-1])
        u = [0.0, 0.0, 0.0]
        for a, b in itertools.product((0, 1), repeat=2):
            w = (weight[0] if a else 1.0 - weight[0]) * (weight[1] if b else 1.0 - weight[1])
            node = self.top[cell[0] + a][cell[1] + b]
            u = [u[c] + w * displacement[3 * node + c] for c in range(3)]
        return u


class Impact:
    """One fall: speed over the wave speed, ratios of cells and stiffnesses."""

    def __init__(self, speed, mesh, stiffness, contact=PAIR):
        self.speed, self.mesh, self.stiffness, self.contact = speed, mesh, stiffness, contact
        self.bodies = Bodies(mesh)
        self.modulus = {"BALL": max(1.0, stiffness), "PLATE": max(1.0, 1.0 / stiffness)}  # over the softer one's
        soft = {"BALL": stiffness <= 1.0, "PLATE": stiffness >= 1.0}
        cells = {"BALL": self.bodies.ball_cell, "PLATE": self.bodies.plate_cell}
        self.cell = max(cells[body] for body in soft if soft[body])
        # Hertz, in E of the softer body, its density / P_WAVE and the radius; speed in sqrt(M / rho).
        compliance = sum((1.0 - NU * NU) / self.modulus[body] for body in self.modulus)
        energy = 0.5 * (4.0 / 3.0 * math.pi) * P_WAVE * speed**2
        depth = (energy * 15.0 / 8.0 * compliance) ** 0.4
        self.hertz_force = 4.0 / 3.0 / compliance * depth**1.5
        self.hertz_time = 2.9432 * depth / speed

    def name(self):
        return f"{self.speed:g} {self.mesh:g} {self.stiffness:g}"

    def write(self, folder, unit, end):
        length, clock, mass = UNITS[unit]
        radius = RADIUS * length
        stress, velocity, density = mass / (length * clock**2), length / clock, mass / length**3
        wave = math.sqrt(P_WAVE * MODULUS / DENSITY) * velocity
        folder.mkdir(parents=True, exist_ok=True)
        self.bodies.write(folder / "bodies.msh", radius)
        name = "SI" if unit == "1/1000" else unit
        text = [f'title = "Ball on plate, {self.name()}"', f'units = "{name}"',
                '[mesh]\nfile = "bodies.msh"']
        for body, factor in self.modulus.items():
            text.append(f'[materials.{body}]\nlaw = "neo_hookean"\nE = {factor * MODULUS * stress!r}\nnu = {NU}\n'
                        f'rho = {DENSITY * density!r}')
            text.append(f'[[part]]\nname = "{body}"\ncells = "{body}"\nmaterial = "{body}"')
        text.append('[[support]]\nnodes = "GROUND"\nblocked = ["x", "y", "z"]')
        text.append(f'[[initial]]\npart = "BALL"\nvelocity = [0.0, 0.0, {-self.speed * wave!r}]')
        text.append('[[contact]]\nname = "touch"\n' + self.contact)
        text.append('[scheme]\nkind = "central_differences"')
        text.append(f"[time]\nend = {end * radius / wave!r}")
        text.append(with_vtu('[output]\nfields = ["displacement", "contact_pressure"]\n'))
        (folder / "case.toml").write_text("\n".join(text), encoding="utf-8")

    def end(self):
        """Flight and twice Hertz's time, coarse bodies differ. The default method waits for the mean gap of a facet."""
        flight = GAP if "method" in self.contact else GAP + 0.25 * self.bodies.ball_cell**2
        return flight / self.speed + 2.0 * self.hertz_time


def read_csv(path):
    with path.open(encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return {name: array.array("d", map(float, column)) for name, column in zip(rows[0], zip(*rows[1:]))}


def with_vtu(text):
    """The case with frames that read_field reads: VTK's files, in double precision."""
    keys = '[output]\nformat = "vtu"\nprecision = "double"\n'
    return text.replace("[output]\n", keys, 1) if "[output]\n" in text else f"{text}\n{keys}"


def read_field(path, name):
    """An array of a .vtu file with raw appended data."""
    data = path.read_bytes()
    head, _, tail = data.partition(b'<AppendedData encoding="raw">')
    tail = tail[tail.index(b"_") + 1:]
    line = next(line for line in head.decode().splitlines() if f'Name="{name}"' in line)
    offset = int(line.partition('offset="')[2].partition('"')[0])
    size = struct.unpack_from("<Q", tail, offset)[0]
    kind = line.partition('type="')[2].partition('"')[0]
    values = array.array({"Float64": "d", "Float32": "f"}[kind])
    values.frombytes(tail[offset + 8:offset + 8 + size])
    return values


def permuted(field, nodes, unit):
    """A vector field in the order of nodes, over the unit."""
    return [field[3 * i + c] / unit for i in nodes for c in range(3)]


class Result:
    """What a run says, in E, radius and wave speed of the softer body."""

    def __init__(self, carom, folder, impact, unit="SI"):
        out = folder / "out"
        impact.write(folder, unit, impact.end())
        begin = time.monotonic()
        run = subprocess.run([carom, "run", "case.toml", "--out", "out", "--quiet", "--threads", "1"], cwd=folder,
                             text=True, capture_output=True, check=False)
        self.wall = time.monotonic() - begin
        self.code, self.said = run.returncode, run.stdout + run.stderr
        if self.code not in (0, 1):
            summary = out / "summary.json"
            message = json.loads(summary.read_text(encoding="utf-8"))["message"] if summary.exists() else self.said
            raise RuntimeError(f"exit code {self.code}: {message}")
        length, clock, mass = UNITS[unit]
        radius, stress = RADIUS * length, MODULUS * mass / (length * clock**2)
        self.summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
        self.refused = [item["name"] for item in self.summary["verdict"] if not item["pass"]]
        energy, contact = read_csv(out / "energy.csv"), read_csv(out / "contact.csv")
        self.force = [f / (stress * radius**2) for f in contact["touch.force_z"]]
        self.gap = max(contact["touch.penetration"]) / radius
        self.balance(energy)
        frames = sorted((out / "fields").glob("*.vtu"))
        nodes = impact.bodies.order(read_field(frames[0], "Points"), radius)
        displacements = (permuted(read_field(f, "displacement"), nodes, radius) for f in frames)
        self.sinks = 0.0
        for u in displacements:
            self.sinks, self.displacement = max(self.sinks, impact.bodies.deepest(u)), u
        self.pressure = max(max(read_field(f, "contact_pressure")) for f in frames) / stress

    def balance(self, energy):
        sums = [-a - q for a, q in zip(energy["algorithmic"], energy["quadrature"])]
        first = energy["kinetic"][0]
        self.energy, self.energy_end = max(map(abs, sums)) / first, sums[-1] / first
        self.books = max(map(abs, energy["imbalance"])) / first


METHODS = {"default": PAIR, "node_to_surface": PAIR + '\nmethod = "node_to_surface"',
           "two_pass": PAIR + '\nmethod = "two_pass"',
           "surface_to_surface": PAIR + '\nmethod = "surface_to_surface"', "all": 'kind = "all"'}
BASE = (1e-3, 1.0, 1.0)


def full_matrix():
    yield from ((1e-3, mesh, stiffness) for mesh in MESHES for stiffness in STIFFNESSES)
    yield from ((speed, 1.0, 1.0) for speed in SPEEDS if speed != 1e-3)


def small_matrix():
    yield from (BASE, (1e-3, 4.0, 1.0), (1e-3, 0.25, 1.0), (1e-3, 1.0, 10.0), (1e-3, 1.0, 0.1), (1e-4, 1.0, 1.0),
                (1e-2, 1.0, 1.0))


def faults(result, impact):
    """What the run does that it must not."""
    allowed = max(0.01, 2.0 * result.pressure)
    refused = [name for name in result.refused if name != "penetration"]  # judged here
    found = ["fails: " + ", ".join(refused)] if refused else []
    if not max(result.force) > 0.0:
        found.append("no contact")
    if result.energy > 0.01 or result.books > 0.01:
        found.append("energy")
    if max(result.gap, result.sinks) > allowed * impact.cell:
        found.append("penetration")
    return found


def judge_matrix(carom, folder, matrix, contact):
    """Runs and prints the impacts; returns the number of bad ones."""
    print(f"{'speed':>6} {'cells':>5} {'stiff':>6} {'steps':>6} {'sinks':>9} {'gap':>9} {'allowed':>9} {'energy':>9} "
          f"{'at end':>9} {'books':>8} {'force':>6} {'wall':>5}  faults")
    bad = 0
    for i, (speed, mesh, stiffness) in enumerate(matrix):
        impact = Impact(speed, mesh, stiffness, contact)
        line = f"{speed:6g} {mesh:5g} {stiffness:6g} "
        try:
            result = Result(carom, folder / str(i), impact)
        except RuntimeError as error:
            print(line + str(error), flush=True)
            bad += 1
            continue
        found = faults(result, impact)
        bad += bool(found)
        print(line + f"{result.summary['scheme']['steps']:6d} {result.sinks / impact.cell:9.2e} "
              f"{result.gap / impact.cell:9.2e} {max(0.01, 2.0 * result.pressure):9.2e} {result.energy:9.2e} "
              f"{result.energy_end:9.2e} {result.books:8.1e} {max(result.force) / impact.hertz_force:6.3f} "
              f"{result.wall:5.1f}  {'; '.join(found)}", flush=True)
    return bad


def difference(a, b):
    """Greatest difference of two lists over the greatest entry."""
    if len(a) != len(b):
        return math.inf
    return max(abs(x - y) for x, y in zip(a, b)) / max(map(abs, a))


def judge_units(carom, folder, contact):
    """The base impact in each unit system: dimensionless force history and displacements at the end, to 1e-9."""
    bad, reference = 0, None
    for i, unit in enumerate(UNITS):
        result = Result(carom, folder / f"unit{i}", Impact(*BASE, contact), unit)
        reference = reference or result
        force = difference(reference.force, result.force)
        displacement = difference(reference.displacement, result.displacement)
        bad += not max(force, displacement) <= 1e-9
        print(f"{unit:>9}: {len(result.force)} rows, force differs by {force:.1e}, displacement by {displacement:.1e}")
    return bad


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("carom", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--small", action="store_true", help="the corners only")
    parser.add_argument("--method", choices=METHODS, default="default")
    given = parser.parse_args()
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as name:
        folder, contact = pathlib.Path(name), METHODS[given.method]
        bad = judge_matrix(given.carom, folder, small_matrix() if given.small else full_matrix(), contact)
        bad += judge_units(given.carom, folder, contact)
    print(f"{bad} bad; {time.monotonic() - begin:.0f} s")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
