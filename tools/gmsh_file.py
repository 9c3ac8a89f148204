"""Meshes for cases in Gmsh's formats 2.2 and 4.1, as text: nodes, cells by corners, named groups."""

POINT, LINE2, TRIA3, QUAD4, TETRA4, HEXA8, PENTA6, PYRA5 = 15, 1, 2, 3, 4, 5, 6, 7
LINE3, TRIA6, QUAD8, QUAD9, TETRA10, HEXA20, HEXA27, PENTA15, PYRA13 = 8, 9, 16, 10, 11, 17, 12, 18, 19
DIMENSION = {POINT: 0, LINE2: 1, LINE3: 1, TRIA3: 2, QUAD4: 2, TRIA6: 2, QUAD8: 2, QUAD9: 2,
             TETRA4: 3, HEXA8: 3, PENTA6: 3, PYRA5: 3, TETRA10: 3, HEXA20: 3, HEXA27: 3, PENTA15: 3, PYRA13: 3}
CORNERS = {TRIA6: 3, TETRA10: 4}
QUAD_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0)]
HEXA_EDGES = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]
HEXA_FACES = [(0, 3, 2, 1), (0, 1, 5, 4), (0, 4, 7, 3), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 6, 7)]
# The corners between which the other nodes lie, in Gmsh's order
MIDDLES = {LINE3: [(0, 1)], TRIA6: [(0, 1), (1, 2), (2, 0)], QUAD8: QUAD_EDGES, QUAD9: [*QUAD_EDGES, (0, 1, 2, 3)],
           TETRA10: [(0, 1), (1, 2), (2, 0), (0, 3), (2, 3), (1, 3)], HEXA20: HEXA_EDGES,
           HEXA27: [*HEXA_EDGES, *HEXA_FACES, (0, 1, 2, 3, 4, 5, 6, 7)],
           PENTA15: [(0, 1), (0, 2), (0, 3), (1, 2), (1, 4), (2, 5), (3, 4), (3, 5), (4, 5)],
           PYRA13: [(0, 1), (0, 3), (0, 4), (1, 2), (1, 4), (2, 3), (2, 4), (3, 4)]}


def tetrahedra(hexa):
    """Six tetrahedra of a hexahedron given by node numbers, in Gmsh's order. Every face is cut along the diagonal at its
    smallest node, so that neighbours fit whatever the order of their nodes is (Dompierre, Labbe, Vallet, Camarero, 8th
    International Meshing Roundtable, 1999)."""
    faces = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    apex = min(hexa)
    return [(*triangle, apex) for face in faces if apex not in (quad := [hexa[a] for a in face])
            for triangle in triangles(quad[::-1])]


def triangles(quad):
    """Two triangles of a quadrilateral, cut at its smallest node."""
    first = quad.index(min(quad))
    a, b, c, d = quad[first:] + quad[:first]
    return [(a, b, c), (a, c, d)]


class GmshFile:
    """Cells are (type, group, node numbers); `middle` may move what lies between nodes, given their positions."""

    def __init__(self, digits=1e-9, middle=None):
        self.digits = digits
        self.middle = middle or (lambda *nodes: [sum(x) / len(x) for x in zip(*nodes)])
        self.numbers = {}
        self.nodes = []
        self.cells = []
        self.middles = {}

    def node(self, x, body=""):
        """Number of the node at x, the same for the same place and body."""
        key = (body, *(round(v / self.digits) for v in x))
        if key not in self.numbers:
            self.nodes.append((list(x) + [0.0, 0.0])[:3])
            self.numbers[key] = len(self.nodes)
        return self.numbers[key]

    def between(self, *corners):
        """Number of the node between others, given by theirs."""
        key = tuple(sorted(corners))
        if key not in self.middles:
            self.nodes.append(self.middle(*(self.nodes[a - 1] for a in corners)))
            self.middles[key] = len(self.nodes)
        return self.middles[key]

    def add(self, kind, group, corners):
        corners = list(corners)
        middles = [self.between(*(corners[a] for a in of)) for of in MIDDLES.get(kind, [])]
        self.cells.append((kind, group, corners + middles))

    def tags(self):
        tags = {}
        for kind, group, _ in self.cells:
            tags.setdefault((DIMENSION[kind], group), len(tags) + 1)
        return tags

    def write(self, path, version="2.2"):
        tags = self.tags()
        names = "".join(f'{dimension} {tag} "{group}"\n' for (dimension, group), tag in tags.items())
        body = self.body_2(tags) if version == "2.2" else self.body_4(tags)
        with open(path, "w", encoding="ascii") as out:
            out.write(f"$MeshFormat\n{version} 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(tags)}\n{names}"
                      f"$EndPhysicalNames\n{body}")
        print(f"{path}: {len(self.nodes)} nodes, {len(self.cells)} cells")

    def body_2(self, tags):
        nodes = "".join(f"{i} {x[0]:.12g} {x[1]:.12g} {x[2]:.12g}\n" for i, x in enumerate(self.nodes, start=1))
        cells = ""
        for number, (kind, group, members) in enumerate(self.cells, start=1):
            tag = tags[(DIMENSION[kind], group)]
            cells += f"{number} {kind} 2 {tag} {tag} {' '.join(map(str, members))}\n"
        return (f"$Nodes\n{len(self.nodes)}\n{nodes}$EndNodes\n"
                f"$Elements\n{len(self.cells)}\n{cells}$EndElements\n")

    def body_4(self, tags):
        """One entity for each group, as Gmsh writes them (all nodes on the first one)."""
        low = [min(x[c] for x in self.nodes) for c in range(3)]
        high = [max(x[c] for x in self.nodes) for c in range(3)]
        entities = [[tag for (dimension, _), tag in tags.items() if dimension == d] for d in range(4)]
        text = "$Entities\n" + " ".join(str(len(of)) for of in entities) + "\n"
        place = " ".join(f"{v:.12g}" for v in low + high)
        for d, of in enumerate(entities):
            for tag in of:
                box = " ".join(f"{v:.12g}" for v in low) if d == 0 else place
                text += f"{tag} {box} 1 {tag}{' 0' if d else ''}\n"
        dimension, tag = max((d, of[0]) for d, of in enumerate(entities) if of)
        count = len(self.nodes)
        text += f"$EndEntities\n$Nodes\n1 {count} 1 {count}\n{dimension} {tag} 0 {count}\n"
        text += "".join(f"{i}\n" for i in range(1, count + 1))
        text += "".join(f"{x[0]:.12g} {x[1]:.12g} {x[2]:.12g}\n" for x in self.nodes) + "$EndNodes\n"
        blocks = {}
        for number, (kind, group, members) in enumerate(self.cells, start=1):
            blocks.setdefault((kind, group), []).append(f"{number} {' '.join(map(str, members))}\n")
        text += f"$Elements\n{len(blocks)} {len(self.cells)} 1 {len(self.cells)}\n"
        for (kind, group), lines in blocks.items():
            dimension = DIMENSION[kind]
            text += f"{dimension} {tags[(dimension, group)]} {kind} {len(lines)}\n" + "".join(lines)
        return text + "$EndElements\n"
