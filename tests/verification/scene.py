"""Bodies, decks for them, and what their recorded nodes say: momenta, spins, depths; the program's own sums are not
asked.

Needs numpy.
"""

import json
import subprocess

import numpy as np

import shape_bodies
import surface_crossing
from ball_on_plate import read_csv, read_field, with_vtu

# Gauss's points of the cells and the derivatives of their shape functions there: volumes of the shares of nodes
POINT = 1.0 / np.sqrt(3.0)
SIGNS = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])


def nodal_masses(body, density):
    """Row sums of the mass matrix, of HEXA8 and TETRA4."""
    x = body.nodes[np.array(body.cells)]
    share = np.zeros(len(body.nodes))
    if body.kind == "TETRA4":
        volume = np.einsum("ij,ij->i", np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), x[:, 3] - x[:, 0]) / 6.0
        np.add.at(share, np.array(body.cells), (volume / 4.0)[:, None])
        return density * share
    if body.kind != "HEXA8":
        raise ValueError(body.kind)
    for point in POINT * SIGNS:
        factors = 0.5 * (1.0 + SIGNS * point)
        slopes = 0.5 * SIGNS * np.stack([factors[:, 1] * factors[:, 2], factors[:, 2] * factors[:, 0],
                                         factors[:, 0] * factors[:, 1]], axis=1)
        volume = np.linalg.det(np.einsum("cni,nj->cij", x, slopes))
        np.add.at(share, np.array(body.cells), volume[:, None] * factors.prod(axis=1)[None])
    return density * share


class Scene:
    """Bodies with a material and a motion each, and the rest of the deck as text."""

    def __init__(self, title, end):
        self.title, self.end = title, end
        self.bodies, self.density, self.material, self.motion = [], [], [], []
        self.groups, self.text = [], []

    def add(self, body, material, velocity=(0.0, 0.0, 0.0), spin=(0.0, 0.0, 0.0)):
        """A body; material: law, E, nu, rho; spin about the middle of its mass."""
        self.bodies.append(body)
        self.material.append(material)
        self.motion.append((np.array(velocity, dtype=float), np.array(spin, dtype=float)))
        body.mass = nodal_masses(body, material["rho"])
        body.skin = surface_crossing.Skin(body.facets())
        body.cell_size = body.cell()
        return body

    def group(self, name, body, facets):
        """Facets of a body, as groups of the mesh."""
        self.groups.append((name, self.bodies.index(body), facets))

    def write(self, folder, scheme, extra=""):
        folder.mkdir(parents=True, exist_ok=True)
        self.write_mesh(folder / "bodies.msh")
        text = [f'title = "{self.title}"', '[mesh]\nfile = "bodies.msh"']
        for i, (material, (v, w)) in enumerate(zip(self.material, self.motion)):
            keys = "\n".join(f"{key} = {json.dumps(value)}" for key, value in material.items() if key not in PART_KEYS)
            own = "".join(f"\n{key} = {json.dumps(value)}" for key, value in material.items() if key in PART_KEYS)
            text.append(f'[materials.B{i}]\n{keys}\n[[part]]\nname = "B{i}"\ncells = "B{i}"\nmaterial = "B{i}"{own}')
            if v.any() or w.any():
                centre = self.centre(i, self.bodies[i].nodes)
                text.append(f'[[initial]]\npart = "B{i}"\nvelocity = {v.tolist()}\nangular_velocity = {w.tolist()}\n'
                            f"centre = {centre.tolist()}")
        text += self.text
        text.append(f"[scheme]\n{scheme}\n[time]\nend = {self.end!r}{extra}")
        (folder / "case.toml").write_text(with_vtu("\n".join(text) + "\n"), encoding="utf-8")

    def centre(self, i, x):
        mass = self.bodies[i].mass
        return mass @ x / mass.sum()

    def write_mesh(self, path):
        """Gmsh's format 2.2."""
        names = [f'3 {i} "B{i - 1}"' for i in range(1, len(self.bodies) + 1)]
        names += [f'2 {len(self.bodies) + i} "{g[0]}"' for i, g in enumerate(self.groups, 1)]
        nodes = np.vstack([b.nodes for b in self.bodies])
        self.first = np.cumsum([0] + [len(b.nodes) for b in self.bodies])
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)), *names]
        lines += ["$EndPhysicalNames", "$Nodes", str(len(nodes))]
        lines += [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(nodes.tolist(), 1)]
        elements = []
        for tag, body in enumerate(self.bodies, 1):
            elements += [f"{shape_bodies.GMSH[body.kind]} 2 {tag} {tag} " +
                         " ".join(str(n + self.first[tag - 1] + 1) for n in cell) for cell in body.cells]
        for tag, (_, body, facets) in enumerate(self.groups, len(self.bodies) + 1):
            elements += [f"{3 if len(f) == 4 else 2} 2 {tag} {tag} " +
                         " ".join(str(n + self.first[body] + 1) for n in f) for f in facets]
        lines += ["$EndNodes", "$Elements", str(len(elements))]
        lines += [f"{i} {element}" for i, element in enumerate(elements, 1)] + ["$EndElements", ""]
        path.write_text("\n".join(lines), encoding="utf-8")

    def run(self, carom, folder, scheme, extra="", timeout=None):
        """Writes and runs the case."""
        self.write(folder, scheme, extra)
        run = subprocess.run([carom, "run", "case.toml", "--out", "out", "--quiet", "--threads", "1"], cwd=folder,
                             text=True, capture_output=True, check=False, timeout=timeout)
        return Recorded(self, folder / "out", run)


PART_KEYS = ("formulation", "linear_bulk_viscosity", "quadratic_bulk_viscosity", "hourglass")


class Recorded:
    """What a run has left: frames of positions and velocities, body by body, and its curves."""

    def __init__(self, scene, out, run):
        self.scene, self.out, self.code = scene, out, run.returncode
        self.said = run.stdout + run.stderr
        file = out / "summary.json"
        self.summary = json.loads(file.read_text(encoding="utf-8")) if file.exists() else {"message": self.said}
        self.refused = {i["name"]: i["value"] for i in self.summary.get("verdict", []) if not i["pass"]}
        if self.code not in (0, 1, 3) or not file.exists():
            raise RuntimeError(f"exit code {self.code}: {self.said}")
        self.energy, self.contact = read_csv(out / "energy.csv"), read_csv(out / "contact.csv")
        self.read_frames()

    def read_frames(self):
        files = sorted((self.out / "fields").glob("step_*.vtu"))
        points = np.array(read_field(files[0], "Points")).reshape(-1, 3)
        at = {tuple(p): i for i, p in enumerate(points.tolist())}
        nodes = np.vstack([b.nodes for b in self.scene.bodies])
        order = [at[tuple(p)] for p in nodes.tolist()]
        steps = [int(f.stem[5:]) for f in files]
        by_step = dict(zip(map(int, self.energy["step"]), self.energy["time"]))
        self.times = np.array([by_step.get(s, 0.0) for s in steps])
        self.x = [nodes + np.array(read_field(f, "displacement")).reshape(-1, 3)[order] for f in files]
        self.v = [np.array(read_field(f, "velocity")).reshape(-1, 3)[order] for f in files]

    def of(self, field, i):
        a, b = self.scene.first[i:i + 2]
        return [frame[a:b] for frame in field]

    def velocity(self, i):
        """Of the centre of mass, at all frames."""
        m = self.scene.bodies[i].mass
        return np.array([m @ v / m.sum() for v in self.of(self.v, i)])

    def centre(self, i):
        m = self.scene.bodies[i].mass
        return np.array([m @ x / m.sum() for x in self.of(self.x, i)])

    def spin(self, i):
        """Angular velocity of the rigid body with the same angular momentum and inertia, at all frames."""
        m, out = self.scene.bodies[i].mass, []
        for x, v in zip(self.of(self.x, i), self.of(self.v, i)):
            r = x - m @ x / m.sum()
            u = v - m @ v / m.sum()
            inertia = (m * (r * r).sum(axis=1)).sum() * np.eye(3) - np.einsum("n,ni,nj->ij", m, r, r)
            out.append(np.linalg.solve(inertia, (m[:, None] * np.cross(r, u)).sum(axis=0)))
        return np.array(out)

    def kinetic(self):
        """Of all bodies, at all frames."""
        m = np.concatenate([b.mass for b in self.scene.bodies])
        return np.array([0.5 * (m[:, None] * v * v).sum() for v in self.v])

    def momentum(self):
        m = np.concatenate([b.mass for b in self.scene.bodies])
        return np.array([m @ v for v in self.v])

    def angular_momentum(self):
        m = np.concatenate([b.mass for b in self.scene.bodies])
        return np.array([(m[:, None] * np.cross(x, v)).sum(axis=0) for x, v in zip(self.x, self.v)])

    def depths(self, frames=None):
        """Greatest depth of two skins in each other over frames, in the smaller cell; which and when."""
        bodies, deepest = self.scene.bodies, (0.0, "")
        for k in frames if frames is not None else range(len(self.x)):
            placed = [b.skin.placed(self.of(self.x, i)[k]) for i, b in enumerate(bodies)]
            for i, one in enumerate(placed):
                for j, two in enumerate(placed[:i]):
                    cell = min(bodies[i].cell_size, bodies[j].cell_size)
                    for depth, what in zip(surface_crossing.crossing_depths(two, one), ("nodes", "edges")):
                        deepest = max(deepest, (depth / cell, f"{what} of {j} and {i}, frame {k}"))
        return deepest
