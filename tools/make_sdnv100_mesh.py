#!/usr/bin/env python3
"""Write the mesh of cases/sdnv100/as_published.toml: Gmsh 2.2 ASCII, 88 nodes, 21 HEXA8.

    python3 tools/make_sdnv100_mesh.py cases/sdnv100/as_published.msh

A quarter of the beam, [0, a/2]^2 x [0, L] in 1 x 1 x 20 cells, and below it one HEXA8 of zero thickness: its upper
nodes are the lower nodes of the beam, its lower nodes (WALL) have the same positions. Groups carry the names of the
Code_Aster manual (V5.03.100): cells BAR and CONTACT; faces PLANSYMX (x = 0), PLANSYMY (y = 0) and WALL; nodes NOBARRE
(all of the beam), A and B (lower and upper end of the axis). Several groups of one entity are joined by "+".
"""

import sys

HALF_SIDE = 0.01
LENGTH = 0.2
LAYERS = 20
CORNERS = [(0.0, 0.0), (HALF_SIDE, 0.0), (HALF_SIDE, HALF_SIDE), (0.0, HALF_SIDE)]
POINT, QUAD4, HEXA8 = 15, 3, 5
DIMENSION = {POINT: 0, QUAD4: 2, HEXA8: 3}


def beam_node(layer, corner):
    return 1 + 4 * layer + corner


def wall_node(corner):
    return 1 + 4 * (LAYERS + 1) + corner


def nodes():
    """(number, x, y, z) of all nodes: the beam from the foot up, then the wall."""
    beam = [(beam_node(k, c), *CORNERS[c], round(LENGTH * k / LAYERS, 12)) for k in range(LAYERS + 1) for c in range(4)]
    return beam + [(wall_node(c), *CORNERS[c], 0.0) for c in range(4)]


def node_group(layer, corner):
    if corner == 0 and layer == 0:
        return "A+NOBARRE"
    if corner == 0 and layer == LAYERS:
        return "B+NOBARRE"
    return "NOBARRE"


def cells():
    """(type, group, nodes) of all cells."""
    for k in range(LAYERS):
        yield HEXA8, "BAR", [beam_node(k + up, c) for up in (0, 1) for c in range(4)]
    yield HEXA8, "CONTACT", [wall_node(c) for c in range(4)] + [beam_node(0, c) for c in range(4)]
    for k in range(LAYERS):
        yield QUAD4, "PLANSYMX", [beam_node(k, 0), beam_node(k, 3), beam_node(k + 1, 3), beam_node(k + 1, 0)]
    for k in range(LAYERS):
        yield QUAD4, "PLANSYMY", [beam_node(k, 0), beam_node(k, 1), beam_node(k + 1, 1), beam_node(k + 1, 0)]
    yield QUAD4, "WALL", [wall_node(c) for c in range(4)]
    for k in range(LAYERS + 1):
        for c in range(4):
            yield POINT, node_group(k, c), [beam_node(k, c)]


def write_mesh(out):
    all_cells = list(cells())
    tags = {}
    for kind, group, _ in all_cells:
        tags.setdefault((DIMENSION[kind], group), len(tags) + 1)
    out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
    out.write(f"$PhysicalNames\n{len(tags)}\n")
    for (dimension, group), tag in tags.items():
        out.write(f'{dimension} {tag} "{group}"\n')
    out.write(f"$EndPhysicalNames\n$Nodes\n{len(nodes())}\n")
    for number, x, y, z in nodes():
        out.write(f"{number} {x:g} {y:g} {z:g}\n")
    out.write(f"$EndNodes\n$Elements\n{len(all_cells)}\n")
    for number, (kind, group, members) in enumerate(all_cells, start=1):
        tag = tags[(DIMENSION[kind], group)]
        out.write(f"{number} {kind} 2 {tag} {tag} {' '.join(map(str, members))}\n")
    out.write("$EndElements\n")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with open(sys.argv[1], "w", encoding="ascii") as out:
        write_mesh(out)


if __name__ == "__main__":
    main()
