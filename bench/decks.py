"""Case files of the benchmarks: a bar of each kind of cell that is thrown against a plane; two blocks that slide."""

import contextlib
import dataclasses
import io
import multiprocessing
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tools"))
import gmsh_file as gmsh  # noqa: E402

SIDE = 0.02  # m, of the bar
WAVE_SPEED = 5801.0  # m/s, of dilatation in the steel below

LAWS = {
    "linear_elastic": "",
    "st_venant_kirchhoff": "",
    "neo_hookean": "",
    "j2_small_strain": "yield_stress = 1.0e3\nhardening_modulus = 1.0e9\n",
    "j2": "yield_stress = 1.0e3\nhardening_modulus = 1.0e9\n",
}

HEAD = 'title = "{title}"\nunits = "SI"\n'

STEEL = """
[materials.steel]
law = "{law}"
E = 2.0e11
nu = 0.3
rho = 8000.0
{parameters}"""

PART = """
[[part]]
name = "{name}"
cells = "{cells}"
material = "steel"
{keys}"""

WALL = """
[[contact]]
name = "wall"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = {normal}
"""

TABLE = """
[[mesh.block]]
size = [0.3, 0.2, 0.1]
divisions = [60, 40, 20]
groups = { cells = "PLATE", zmin = "GROUND", zmax = "TABLE" }

[[mesh.block]]
origin = [0.0513, 0.0217, 0.1]
size = [0.15, 0.15, 0.1]
divisions = [30, 30, 20]
groups = { cells = "BLOCK", zmin = "FOOT", zmax = "TOP" }

[[support]]
nodes = "GROUND"
blocked = ["x", "y", "z"]

[[initial]]
part = "block"
velocity = [10.0, 0.0, -1.0]

[[load]]
group = "TOP"
pressure = 1.0e7

[[contact]]
name = "table"
kind = "pair"
group = "FOOT"
master = "TABLE"
friction = 0.2
"""

END = """
[scheme]
{scheme}

[time]
end = {end:.6g}
{step}
[output]
fields = []
fields_every = 1000000000
curves_every = 1
"""


@dataclasses.dataclass(frozen=True)
class Bar:
    """A bar of `across` cells (of each direction across: one in a plane, none of a line) and `along` rows of them, of
    one cell type, under one law, which goes towards the plane, `gap` away. With `moved` its inner nodes are moved by
    up to a tenth of an edge, so that no two cells are alike; nodes and cells stand in a file in random order."""
    title: str
    cell: str
    across: int
    along: int
    law: str = "linear_elastic"
    formulation: str = ""
    section: str = "solid"
    speed: float = 100.0
    gap: float = 0.0
    moved: bool = False

    def edge(self):
        return SIDE / self.across if self.cell != "LINE2" else SIDE / 16

    def name(self):
        words = (self.cell, self.section, self.formulation, self.law, str(self.across), str(self.along))
        return "_".join(word for word in (*words, "moved" if self.moved else "") if word)

    def cells(self):
        pieces = {"TETRA4": 6, "TETRA10": 6, "PENTA6": 2, "PENTA15": 2, "PYRA5": 6, "PYRA13": 6, "TRIA3": 2,
                  "TRIA6": 2}.get(self.cell, 1)
        power = {"solid": 2, "bar": 0}.get(self.section, 1)
        return pieces * self.across**power * self.along

    def small(self):
        """The same kind of bar that stays in the cache."""
        across, along = {"solid": (min(self.across, 8), 16), "bar": (1, 1000)}.get(self.section, (32, 32))
        return dataclasses.replace(self, across=across, along=along)

    def mesh(self, folder):
        """Its sections; a mesh file is written to the folder where there is no regular block of its cells."""
        length = self.along * self.edge()
        low = -SIDE / 2 if self.section != "axisymmetric" else 0.0
        if self.cell == "HEXA8" and not self.moved:
            return (f"\n[[mesh.block]]\norigin = [{low}, {low}, {self.gap}]\nsize = [{SIDE}, {SIDE}, {length:.9g}]\n"
                    f"divisions = [{self.across}, {self.across}, {self.along}]\n"
                    'groups = { cells = "BAR", zmin = "FOOT" }\n')
        if self.cell == "QUAD4":
            return (f'\n[[mesh.block]]\nkind = "quad"\norigin = [{low}, {self.gap}, 0.0]\n'
                    f'size = [{SIDE}, {length:.9g}]\ndivisions = [{self.across}, {self.along}]\n'
                    f'groups = {{ cells = "BAR", ymin = "FOOT" }}\n')
        if self.cell == "LINE2":
            return (f'\n[[mesh.block]]\nkind = "bar"\norigin = [0.0, 0.0, {self.gap}]\nend = [0.0, 0.0, {length:.9g}]\n'
                    f'divisions = {self.along}\ngroups = {{ cells = "BAR", start = "FOOT" }}\n')
        path = folder / f"{self.name()}.msh"
        if not path.exists():
            # In a process of its own: what this one has taken counts as memory of the programs that it starts later.
            writer = multiprocessing.Process(target=write_mesh, args=(path, self, low))
            writer.start()
            writer.join()
        return f'\n[mesh]\nfile = "{path.name}"\n'

    def start(self):
        axis = 2 if self.section in ("solid", "bar") else 1
        velocity = ["0.0", "0.0", "0.0"]
        if not self.law.startswith("j2"):
            velocity[axis] = str(-self.speed)
            return f'\n[[initial]]\npart = "bar"\nvelocity = [{", ".join(velocity)}]\n'
        # Slow, and stretched at 10 / s, so that all of it yields from the first step on and turns little.
        velocity[axis] = f"-{0.01 * self.speed} + 10 * {'xyz'[axis]}"
        return f'\n[[initial]]\npart = "bar"\nvelocity_field = ["{velocity[0]}", "{velocity[1]}", "{velocity[2]}"]\n'

    def text(self, folder, scheme='kind = "central_differences"', end=0.0, step=0.0, steps=0):
        """The whole case; `steps` of 0.5 h / c unless an end is given."""
        keys = f'formulation = "{self.formulation}"\n' if self.formulation else ""
        keys += f'section = "{self.section}"\n' if self.section != "solid" else ""
        keys += {"plane_strain": "thickness = 0.01\n", "plane_stress": "thickness = 0.01\n",
                 "bar": "area = 1.0e-6\n"}.get(self.section, "")
        normal = "[0.0, 0.0, 1.0]" if self.section in ("solid", "bar") else "[0.0, 1.0, 0.0]"
        end = end or steps * 0.5 * self.edge() / WAVE_SPEED
        return (HEAD.format(title=self.title) + self.mesh(folder) + PART.format(name="bar", cells="BAR", keys=keys) +
                STEEL.format(law=self.law, parameters=LAWS[self.law]) + self.start() + WALL.format(normal=normal) +
                END.format(scheme=scheme, end=end, step=f"step = {step}\n" if step else ""))

    def write(self, folder, **what):
        path = folder / f"{self.name()}.toml"
        path.write_text(self.text(folder, **what))
        return path


def sliding(steps):
    """A block that slides on a plate, 900 faces of it against 2400 of the plate; 66,000 cells."""
    return (HEAD.format(title="Two blocks") + TABLE + PART.format(name="plate", cells="PLATE", keys="") +
            PART.format(name="block", cells="BLOCK", keys="") + STEEL.format(law="linear_elastic", parameters="") +
            END.format(scheme='kind = "central_differences"', end=steps * 0.3 * 0.005 / WAVE_SPEED, step=""))


def write_mesh(path, bar, low):
    """A mesh file of a bar, which begins at x = low."""
    mesh, h = gmsh.GmshFile(digits=1e-7), bar.edge()
    is_solid = bar.section == "solid"
    for k in range(bar.along):
        for j in range(bar.across if is_solid else 1):
            for i in range(bar.across):
                place = lambda a, b, c: (low + (i + a) * h, low + (j + b) * h, (k + c) * h + bar.gap)
                if is_solid:
                    hexa = [mesh.node(place(a, b, c)) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                    add_solid(mesh, bar.cell, hexa, k == 0)
                else:
                    quad = [mesh.node((*place(a, 0, c)[::2], 0.0)) for a, c in ((0, 0), (1, 0), (1, 1), (0, 1))]
                    add_plane(mesh, bar.cell, quad, k == 0)
    if bar.moved:
        move_and_shuffle(mesh, bar)
    with contextlib.redirect_stdout(io.StringIO()):
        mesh.write(path)


def move_and_shuffle(mesh, bar):
    """Moves the inner nodes of a solid bar; nodes and cells go into random order."""
    generator, h = random.Random(1), bar.edge()
    for x in mesh.nodes:
        if max(abs(x[0]), abs(x[1])) < 0.499 * SIDE and 0.5 * h < x[2] - bar.gap < (bar.along - 0.5) * h:
            x[:] = [v + generator.uniform(-0.1, 0.1) * h for v in x]
    order = list(range(len(mesh.nodes)))
    generator.shuffle(order)
    mesh.nodes = [mesh.nodes[a] for a in order]
    new = {old + 1: number for number, old in enumerate(order, start=1)}
    mesh.cells = [(kind, group, [new[a] for a in nodes]) for kind, group, nodes in mesh.cells]
    generator.shuffle(mesh.cells)


def add_solid(mesh, cell, hexa, is_foot):
    """The cells that fill a hexahedron, and its lowest face."""
    quad = [hexa[a] for a in (0, 3, 2, 1)]
    triangles = gmsh.triangles(quad)
    if cell in ("TETRA4", "TETRA10"):
        cells = gmsh.tetrahedra(hexa)
    elif cell in ("PENTA6", "PENTA15"):
        cells = [[hexa[a] for a in (0, 1, 2, 4, 5, 6)], [hexa[a] for a in (0, 2, 3, 4, 6, 7)]]
        triangles = [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
    elif cell in ("PYRA5", "PYRA13"):
        top = mesh.between(*hexa)
        faces = ((0, 1, 2, 3), (7, 6, 5, 4), (4, 5, 1, 0), (5, 6, 2, 1), (6, 7, 3, 2), (7, 4, 0, 3))
        cells = [[hexa[a] for a in face] + [top] for face in faces]
    else:
        cells = [hexa]
    for corners in cells:
        mesh.add(getattr(gmsh, cell), "BAR", corners)
    if not is_foot:
        return
    face = {"TETRA4": "TRIA3", "PENTA6": "TRIA3", "TETRA10": "TRIA6", "PENTA15": "TRIA6", "PYRA13": "QUAD8",
            "HEXA20": "QUAD8", "HEXA27": "QUAD9"}
    for corners in triangles if cell in ("TETRA4", "TETRA10", "PENTA6", "PENTA15") else [quad]:
        mesh.add(getattr(gmsh, face.get(cell, "QUAD4")), "FOOT", corners)


def add_plane(mesh, cell, quad, is_foot):
    """The cells that fill a rectangle, and its lowest edge."""
    for corners in gmsh.triangles(quad) if cell in ("TRIA3", "TRIA6") else [quad]:
        mesh.add(getattr(gmsh, cell), "BAR", corners)
    if is_foot:
        mesh.add(gmsh.LINE3 if cell in ("TRIA6", "QUAD8") else gmsh.LINE2, "FOOT", quad[:2])


def bars():
    """A bar of every element and of the laws whose kernels differ."""
    hexa = lambda title, **keys: Bar(title, "HEXA8", 16, 320, **keys)
    plane = lambda title, cell, section, **keys: Bar(title, cell, 128, 640, section=section, **keys)
    return [
        hexa("HEXA8 stabilised, elastic", formulation="stabilised"),
        hexa("HEXA8 stabilised, neo-Hookean", formulation="stabilised", law="neo_hookean"),
        hexa("HEXA8 stabilised, J2 small strain", formulation="stabilised", law="j2_small_strain"),
        hexa("HEXA8 stabilised, J2", formulation="stabilised", law="j2"),
        hexa("HEXA8 full, elastic", formulation="full"),
        hexa("HEXA8 full, St. Venant-Kirchhoff", formulation="full", law="st_venant_kirchhoff"),
        hexa("HEXA8 full, neo-Hookean", formulation="full", law="neo_hookean"),
        hexa("HEXA8 mean dilatation, elastic", formulation="mean_dilatation"),
        hexa("HEXA8 mean dilatation, neo-Hookean", formulation="mean_dilatation", law="neo_hookean"),
        hexa("HEXA8 mean dilatation, J2 small strain", formulation="mean_dilatation", law="j2_small_strain"),
        hexa("HEXA8 mean dilatation, J2", formulation="mean_dilatation", law="j2"),
        hexa("HEXA8 one point, elastic", formulation="one_point"),
        hexa("HEXA8 one point, neo-Hookean", formulation="one_point", law="neo_hookean"),
        hexa("HEXA8 one point, J2", formulation="one_point", law="j2"),
        Bar("TETRA4, elastic", "TETRA4", 10, 80),
        Bar("TETRA4, neo-Hookean", "TETRA4", 10, 80, law="neo_hookean"),
        Bar("TETRA10 mean dilatation, elastic", "TETRA10", 8, 40, formulation="mean_dilatation"),
        Bar("TETRA10 mean dilatation, J2", "TETRA10", 8, 40, formulation="mean_dilatation", law="j2"),
        Bar("PENTA6, elastic", "PENTA6", 12, 160),
        Bar("PYRA5, elastic", "PYRA5", 10, 80),
        Bar("PENTA15, elastic", "PENTA15", 8, 60),
        Bar("PYRA13, elastic", "PYRA13", 6, 40),
        Bar("HEXA20, elastic", "HEXA20", 8, 80),
        Bar("HEXA27, elastic", "HEXA27", 8, 80),
        plane("QUAD4 plane strain, stabilised", "QUAD4", "plane_strain", formulation="stabilised"),
        plane("QUAD4 plane strain, full", "QUAD4", "plane_strain", formulation="full"),
        plane("QUAD4 plane strain, one point", "QUAD4", "plane_strain", formulation="one_point"),
        plane("QUAD4 plane stress, full", "QUAD4", "plane_stress", formulation="full"),
        plane("QUAD4 axisymmetric, J2", "QUAD4", "axisymmetric", formulation="mean_dilatation", law="j2"),
        plane("TRIA3 plane strain, elastic", "TRIA3", "plane_strain"),
        plane("TRIA6 plane strain, elastic", "TRIA6", "plane_strain"),
        plane("QUAD8 plane strain, elastic", "QUAD8", "plane_strain"),
        Bar("LINE2 bar, elastic", "LINE2", 1, 80000, section="bar"),
    ]
