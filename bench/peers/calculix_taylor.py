#!/usr/bin/env python3
"""Write a CalculiX deck of the copper Taylor bar on a mesh of tools/make_taylor_meshes.py, and read its result.

    python3 tools/make_taylor_meshes.py out hexa8_2
    python3 bench/peers/calculix_taylor.py out/taylor_hexa8_2.msh out/taylor.inp [--type C3D8R] [--explicit]
    cd out && OMP_NUM_THREADS=1 ccx -i taylor > taylor.log; cd ..
    python3 bench/peers/calculix_taylor.py --result out/taylor.dat

The foot slides on the wall and never leaves it (its nodes keep y = 0): CalculiX's contact does not survive this impact.
Material, speed and end are those of cases/taylor_bar. Standard library only.
"""

import argparse

YOUNG, POISSON, DENSITY, YIELD, HARDENING = 117.0e9, 0.35, 8930.0, 400.0e6, 100.0e6
SPEED, END = 227.0, 80.0e-6
RADIUS, LENGTH = 3.2e-3, 32.4e-3
HEXA8, QUAD4, POINT = 5, 3, 15


def read_gmsh(path):
    """Nodes, and (type, group, nodes) of each cell of a file in format 2.2."""
    with open(path, encoding="ascii") as file:
        lines = iter(file.read().splitlines())
    nodes, cells, names = {}, [], {}
    for line in lines:
        if line == "$PhysicalNames":
            for _ in range(int(next(lines))):
                dimension, tag, name = next(lines).split()
                names[int(tag)] = name.strip('"')
        elif line == "$Nodes":
            for _ in range(int(next(lines))):
                number, *x = next(lines).split()
                nodes[int(number)] = [float(v) for v in x]
        elif line == "$Elements":
            for _ in range(int(next(lines))):
                numbers = [int(v) for v in next(lines).split()]
                cells.append((numbers[1], names[numbers[3]], numbers[3 + numbers[2]:]))
    return nodes, cells


def deck_lines(nodes, cells, kind, explicit, step):
    """The deck, line by line."""
    yield "*HEADING\nCopper bar against a rigid wall\n*NODE, NSET=BAR"
    for number, x in nodes.items():
        yield f"{number}, " + ", ".join(f"{v:.12g}" for v in x)
    yield f"*ELEMENT, TYPE={kind}, ELSET=BAR"
    for number, cell in enumerate((c for t, _, c in cells if t == HEXA8), start=1):
        yield f"{number}, " + ", ".join(map(str, cell))
    for group in ("FOOT", "SYMX", "SYMZ", "RIM", "CROWN"):
        yield f"*NSET, NSET={group}"
        for node in sorted({n for _, name, cell in cells if name == group for n in cell}):
            yield str(node)
    end = YIELD + HARDENING * 4.0
    yield f"*MATERIAL, NAME=COPPER\n*ELASTIC\n{YOUNG:g}, {POISSON:g}\n*DENSITY\n{DENSITY:g}"
    yield f"*PLASTIC\n{YIELD:g}, 0.\n{end:g}, 4."
    yield "*SOLID SECTION, ELSET=BAR, MATERIAL=COPPER"
    yield "*BOUNDARY\nFOOT, 2, 2\nSYMX, 1, 1\nSYMZ, 3, 3"
    yield f"*INITIAL CONDITIONS, TYPE=VELOCITY\nBAR, 2, {-SPEED:g}"
    yield "*STEP, INC=1000000, NLGEOM"
    yield f"*DYNAMIC{', EXPLICIT' if explicit else ''}\n{step:g}, {END:g}"
    for group in ("RIM", "CROWN"):
        yield f"*NODE PRINT, NSET={group}, FREQUENCY=1\nU"
    yield "*END STEP"


def print_result(path):
    """Radius of the foot and length of the bar at the last time of a .dat file."""
    at, group, found = 0.0, "", {}
    with open(path, encoding="ascii") as file:
        for line in file:
            words = line.split()
            if line.startswith(" displacements"):
                group, at = words[words.index("set") + 1], float(words[-1])
            elif len(words) == 4 and group:
                found[group] = (at, [float(v) for v in words[1:]])
    print(f"t = {found['RIM'][0]:.6g}: face radius {1e3 * (RADIUS + found['RIM'][1][0]):.4f} mm, "
          f"length {1e3 * (LENGTH + found['CROWN'][1][1]):.4f} mm")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--type", default="C3D8", help="element of CalculiX: C3D8, C3D8R, C3D8I")
    parser.add_argument("--explicit", action="store_true", help="explicit steps")
    parser.add_argument("--step", type=float, default=2.0e-7, help="first step, s")
    parser.add_argument("--result", help="a .dat file to read instead")
    parser.add_argument("mesh", nargs="?")
    parser.add_argument("deck", nargs="?")
    given = parser.parse_args()
    if given.result:
        print_result(given.result)
        return
    if not given.deck:
        parser.error("a mesh and a deck are needed")
    nodes, cells = read_gmsh(given.mesh)
    with open(given.deck, "w", encoding="ascii") as deck:
        for line in deck_lines(nodes, cells, given.type, given.explicit, given.step):
            deck.write(line + "\n")


if __name__ == "__main__":
    main()
