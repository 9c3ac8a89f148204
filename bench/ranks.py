#!/usr/bin/python3
"""What ranks compute and send in an explicit step, counted from a mesh, and the gain that follows.

Usage: PYTHONPATH=build/release/python bench/ranks.py (--cells CELLS_AN_EDGE | --mesh FILE) RANKS [RANKS...] [options]

Counted (docs/decisions/0035, 0038): a rank owns the nodes from r N / R on and computes every cell that one of its nodes
stands in, in batches of 8; it sends the displacements of its own nodes to the ranks that compute a cell with them, and
its sums over blocks of 2,048 nodes to all. Nodes of contact, which all ranks hold, come on top where there is contact.

Predicted seconds of a step: T(R) = c cells(R) + l (messages(R) + log2 R) + bytes(R) / b, the busiest rank's; c: seconds
of one cell on one core (measured with one rank), l: latency, b: bandwidth of a rank. The efficiency is T(1) / (R T(R)).
"""

import argparse
import math
import tomllib

import carom
import numpy as np

BATCH = 8  # cells computed together
BLOCK = 2048  # nodes of a block of sums
SUMS = 10  # numbers that a step sums over all nodes

CASE = """
[[mesh.block]]
size = [1.0, 1.0, 1.0]
divisions = [{0}, {0}, {0}]
groups = {{ cells = "CUBE" }}
[materials.any]
law = "linear_elastic"
E = 1.0
nu = 0.3
rho = 1.0
[[part]]
name = "cube"
cells = "CUBE"
material = "any"
[[initial]]
part = "cube"
velocity = [0.0, 0.0, 1.0]
[scheme]
kind = "central_differences"
[time]
end = 1.0
"""


def cells_of_cube(n: int) -> np.ndarray:
    """The rows of nodes as the solver numbers them."""
    return np.asarray(carom.Case(tomllib.loads(CASE.format(n))).start(threads=1).mesh.cells["hexa8"])


def count(cells: np.ndarray, ranks: int) -> dict[str, float]:
    nodes = int(cells.max()) + 1
    owner = np.minimum((np.arange(nodes, dtype=np.int64) * ranks) // nodes, ranks - 1)
    filled = np.concatenate([cells, np.repeat(cells[-1:], -len(cells) % BATCH, axis=0)])
    batches = filled.reshape(-1, BATCH * cells.shape[1])
    owners = owner[batches]
    # Each pair (batch, rank that computes it) once.
    pairs = np.unique(np.arange(len(batches))[:, None] * ranks + owners)
    batch, rank = pairs // ranks, pairs % ranks
    computed = np.bincount(rank, minlength=ranks) * BATCH
    # Each pair (node, other rank that holds it) once.
    held = np.unique((batches[batch].astype(np.int64) * ranks + rank[:, None]).ravel())
    node, holder = held // ranks, held % ranks
    foreign = owner[node] != holder
    node, holder = node[foreign], holder[foreign]
    given = np.bincount(owner[node], minlength=ranks)
    links = np.unique(owner[node] * ranks + holder)
    neighbours = np.bincount(links // ranks, minlength=ranks)
    sums = 8 * SUMS * math.ceil(nodes / BLOCK)
    return {"cells": computed.max(), "all": computed.sum() / len(cells), "neighbours": neighbours.max(),
            "bytes": 24 * given.max() + sums * (ranks - 1) / ranks, "nodes": given.max()}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    body = parser.add_mutually_exclusive_group(required=True)
    body.add_argument("--cells", type=int, help="of a cube, along an edge (HEXA8)")
    body.add_argument("--mesh", help="a mesh file, whose TETRA4 are taken")
    parser.add_argument("ranks", type=int, nargs="+")
    parser.add_argument("--cell", type=float, default=125e-9, help="seconds of one cell")
    parser.add_argument("--latency", type=float, default=2e-6, help="seconds of a message")
    parser.add_argument("--bandwidth", type=float, default=10e9, help="bytes a second of a rank")
    options = parser.parse_args()
    cells = (np.asarray(carom.read_mesh(options.mesh).cells["tetra4"]) if options.mesh
             else cells_of_cube(options.cells))
    alone = options.cell * len(cells)
    print("ranks  cells of a rank  computed/there  neighbours  nodes given  bytes a step  ms a step  efficiency")
    for ranks in options.ranks:
        c = count(cells, ranks)
        seconds = (options.cell * c["cells"] + options.latency * (c["neighbours"] + math.log2(ranks))
                   + c["bytes"] / options.bandwidth)
        print(f"{ranks:5d}  {c['cells']:15.0f}  {c['all']:14.3f}  {c['neighbours']:10.0f}  {c['nodes']:11.0f}  "
              f"{c['bytes']:12.0f}  {1e3 * seconds:9.4g}  {alone / ranks / seconds:10.3f}")


if __name__ == "__main__":
    main()
