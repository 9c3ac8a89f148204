"""Meshes and cases of element_tables.py: grids of any kind of cell that a function bends into shape, and runs of them."""

import collections
import itertools
import json
import pathlib
import subprocess
import sys

from ball_on_plate import read_csv, read_field, with_vtu

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
import gmsh_file as gmsh  # noqa: E402

PLANES = {"QUAD4": gmsh.QUAD4, "TRIA3": gmsh.TRIA3, "QUAD8": gmsh.QUAD8, "TRIA6": gmsh.TRIA6}
SOLIDS = {"HEXA8": gmsh.HEXA8, "HEXA20": gmsh.HEXA20, "HEXA27": gmsh.HEXA27, "TETRA4": gmsh.TETRA4,
          "TETRA10": gmsh.TETRA10, "PENTA6": gmsh.PENTA6}
FACE_OF = {gmsh.TETRA4: gmsh.TRIA3, gmsh.TETRA10: gmsh.TRIA6, gmsh.HEXA8: gmsh.QUAD4, gmsh.HEXA20: gmsh.QUAD8,
           gmsh.HEXA27: gmsh.QUAD9, gmsh.QUAD4: gmsh.LINE2, gmsh.TRIA3: gmsh.LINE2, gmsh.QUAD8: gmsh.LINE3,
           gmsh.TRIA6: gmsh.LINE3}
TETRA_FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
# Shares of a face's nodes in a uniform traction, corners and middles (and centre); TETRA10 has four linear pieces on it.
SHARES = {gmsh.LINE2: [1 / 2] * 2, gmsh.LINE3: [1 / 6] * 2 + [2 / 3], gmsh.TRIA3: [1 / 3] * 3,
          gmsh.TRIA6: [1 / 12] * 3 + [1 / 4] * 3, gmsh.QUAD4: [1 / 4] * 4, gmsh.QUAD8: [-1 / 12] * 4 + [1 / 3] * 4,
          gmsh.QUAD9: [1 / 36] * 4 + [1 / 9] * 4 + [4 / 9]}


class Grid:
    """n[0] x n[1] (x n[2]) cells over the unit square or cube, at place(s, t(, r))."""

    def __init__(self, kind, n, place):
        self.file = gmsh.GmshFile()
        self.kind = PLANES.get(kind) or SOLIDS[kind]
        corner = [(0, 0), (1, 0), (1, 1), (0, 1)]
        steps = corner if len(n) == 2 else [(*c, k) for k in (0, 1) for c in corner]
        for at in itertools.product(*(range(m) for m in n)):
            box = [self.file.node(place(*((a + s) / m for a, s, m in zip(at, step, n)))) for step in steps]
            for cell in self.pieces(kind, box):
                self.file.add(self.kind, "B", cell)
        self.skin = self.faces()

    def pieces(self, kind, box):
        if kind.startswith("TRIA"):
            return gmsh.triangles(box)
        return gmsh.tetrahedra(box) if kind.startswith("TETRA") else [box]

    def faces(self):
        seen = collections.Counter()
        kept = {}
        for kind, _, members in self.file.cells:
            if kind in (gmsh.TETRA4, gmsh.TETRA10):
                of = [[members[i] for i in face] for face in TETRA_FACES]
            elif kind in SOLIDS.values():
                of = [[members[i] for i in face] for face in gmsh.HEXA_FACES]
            else:
                ring = members[:3 if kind in (gmsh.TRIA3, gmsh.TRIA6) else 4]
                of = [list(pair) for pair in zip(ring, ring[1:] + ring[:1])]
            for face in of:
                seen[tuple(sorted(face))] += 1
                kept[tuple(sorted(face))] = face
        return [face for key, face in kept.items() if seen[key] == 1]

    def position(self, node):
        return self.file.nodes[node - 1]

    def group(self, name, where):
        """The faces of the skin whose corners are all where `where` says; the shares of their nodes in a traction."""
        kind, shares, areas = FACE_OF[self.kind], collections.Counter(), 0.0
        for face in self.skin:
            if all(where(*self.position(node)) for node in face):
                self.file.add(kind, name, face)
                area = self.area(face)
                areas += area
                for node, share in zip(self.file.cells[-1][2], SHARES[kind]):
                    shares[node] += share * area
        if not areas:
            raise ValueError(f"no face is in {name}")
        return {node: share / areas for node, share in shares.items() if abs(share) > 1e-12 * areas}

    def area(self, face):
        x = [self.position(node) for node in face]
        diagonals = ([[b - a for a, b in zip(x[0], x[1])], [b - a for a, b in zip(x[0], x[2])]] if len(x) == 3 else
                     [[b - a for a, b in zip(x[i], x[i + 2])] for i in (0, 1)] if len(x) == 4 else None)
        if diagonals is None:
            return sum((a - b)**2 for a, b in zip(*x))**0.5
        (a, b, c), (d, e, f) = diagonals
        return 0.5 * ((b * f - c * e)**2 + (c * d - a * f)**2 + (a * e - b * d)**2)**0.5

    def point(self, name, node):
        self.file.add(gmsh.POINT, name, [node])

    def nodes(self, name, where):
        """A group of the nodes that are where `where` says."""
        used = sorted({node for kind, _, members in self.file.cells if kind == self.kind for node in members})
        found = [node for node in used if where(*self.position(node))]
        for node in found:
            self.point(name, node)
        return found

    def forces(self, shares, force):
        """Sections [[load]] for a force that is spread by shares, or for a function of the node and its share."""
        if not callable(force):
            given = force
            force = lambda node, share: [share * f for f in given]  # noqa: E731
        text = ""
        for node, share in shares.items():
            self.point(f"N{node}", node)
            text += f'[[load]]\ngroup = "N{node}"\nforce = {[float(f) for f in force(node, share)]}\n'
        return text


class Run:
    """What a run has left behind."""

    def __init__(self, carom, folder, grid, text, units="SI"):
        folder.mkdir(parents=True, exist_ok=True)
        with open(folder / "mesh.log", "w", encoding="utf-8") as log:
            out, sys.stdout = sys.stdout, log
            try:
                grid.file.write(folder / "mesh.msh")
            finally:
                sys.stdout = out
        (folder / "case.toml").write_text(with_vtu(f'units = "{units}"\n[mesh]\nfile = "mesh.msh"\n{text}'),
                                          encoding="utf-8")
        done = subprocess.run([carom, "run", "case.toml", "--out", "out", "--quiet", "--threads", "1"], cwd=folder,
                              text=True, capture_output=True, check=False)
        self.out, self.said = folder / "out", done.stdout + done.stderr
        file = self.out / "summary.json"
        if done.returncode not in (0, 1, 3) or not file.exists():
            raise RuntimeError(f"{folder}: exit code {done.returncode}: {self.said}")
        self.summary = json.loads(file.read_text(encoding="utf-8"))
        self.outcome, self.seconds = self.summary["outcome"], self.summary["cost"]["cpu_seconds"]
        self.energy = read_csv(self.out / "energy.csv")

    def probes(self):
        return read_csv(self.out / "probes.csv")

    def contact(self):
        return read_csv(self.out / "contact.csv")

    def last(self, column):
        return float(self.probes()[column][-1])

    def field(self, name):
        return read_field(sorted((self.out / "fields").glob("step_*.vtu"))[-1], name)

    def remark(self):
        """What a reader of a table should know: nothing for a good run."""
        if self.outcome == "good":
            return ""
        items = [item["name"] for item in self.summary.get("verdict", []) if not item["pass"]]
        reached = self.summary["scheme"]["time_reached"] / self.summary["scheme"]["time_end"]
        return f"stops at {100 * reached:.0f} %" if reached < 0.999 else f"{self.outcome}: {', '.join(items)}"


def part(section, formulation, **keys):
    text = f'[[part]]\nname = "B"\ncells = "B"\nmaterial = "M"\nsection = "{section}"\n'
    if formulation != "default":
        text += f'formulation = "{formulation}"\n'
    return text + "".join(f"{key} = {value}\n" for key, value in keys.items())


def material(law, **keys):
    return f'[materials.M]\nlaw = "{law}"\n' + "".join(f"{key} = {value}\n" for key, value in keys.items())


def probe(name, quantity, **keys):
    keys = "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items())
    return f'[[probe]]\nname = "{name}"\ngroup = "{name}"\nquantities = ["{quantity}"]\n{keys}'
