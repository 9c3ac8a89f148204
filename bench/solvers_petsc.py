#!/usr/bin/python3
"""Iterations and seconds of PETSc's preconditioners on a clamped cube of n^3 cells HEXA8, as bench_solvers measures Carom's.

Usage: solvers_petsc.py N... (Debian: python3-petsc4py-real, python3-scipy). Fully integrated cells, K + 4 M / step^2 with
the consistent mass, a random load, conjugate gradients to eight digits of the true residual, one process. The options are
those that did best in trials: rigid modes for ML and GAMG, three steps of Chebyshev and no aggressive coarsening for the
latter, hypre by unknowns with a threshold of 0.5.
"""

import itertools
import os
import sys
import time

import numpy as np
import scipy.sparse as sp

sys.path.append("/usr/lib/petscdir/petsc3.18/x86_64-linux-gnu-real/lib/python3/dist-packages")

CORNERS = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])
OPTIONS = {
    "ML": {"pc_type": "ml"},
    "GAMG": {"pc_type": "gamg", "pc_gamg_agg_nsmooths": 1, "mg_levels_ksp_max_it": 3, "mg_levels_pc_type": "jacobi"},
    "hypre": {"pc_type": "hypre", "pc_hypre_boomeramg_strong_threshold": 0.5},
    "Jacobi": {"pc_type": "jacobi"},
}


def cell_matrices(h, nu):
    """Stiffness and consistent mass of a cubic cell of edge h, E = rho = 1."""
    lam, mu = nu / ((1 + nu) * (1 - 2 * nu)), 0.5 / (1 + nu)
    D = np.diag([2 * mu] * 3 + [mu] * 3)
    D[:3, :3] += lam
    K, M = np.zeros((24, 24)), np.zeros((24, 24))
    for point in itertools.product((-1 / 3**0.5, 1 / 3**0.5), repeat=3):
        sides = 1 + CORNERS * point
        N = sides.prod(axis=1) / 8
        dN = np.array([CORNERS[:, i] * sides[:, (i + 1) % 3] * sides[:, (i + 2) % 3] / 8 for i in range(3)]) * 2 / h
        B = np.zeros((6, 24))
        for a in range(8):
            x, y, z = dN[:, a]
            B[:, 3 * a:3 * a + 3] = [(x, 0, 0), (0, y, 0), (0, 0, z), (y, x, 0), (0, z, y), (z, 0, x)]
        K += B.T @ D @ B * (h / 2) ** 3
        M += np.kron(np.outer(N, N), np.eye(3)) * (h / 2) ** 3
    return K, M


def system(n, nu, courant):
    """The matrix without the clamped nodes, and the coordinates of the others."""
    K, M = cell_matrices(1.0 / n, nu)
    wave = ((1 - nu) / ((1 + nu) * (1 - 2 * nu))) ** 0.5
    cell = K if courant is None else K + 4 * (n * wave / courant) ** 2 * M
    node = np.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1).transpose(2, 1, 0)  # x first
    corner = (CORNERS + 1) // 2
    cells = np.stack([node[c[0]:n + c[0], c[1]:n + c[1], c[2]:n + c[2]].ravel() for c in corner], axis=1)
    dofs = (3 * cells[:, :, None] + np.arange(3)).reshape(len(cells), 24)
    A = sp.coo_matrix((np.tile(cell.ravel(), len(cells)), (np.repeat(dofs, 24, axis=1).ravel(), np.tile(dofs, 24).ravel())),
                      shape=(3 * node.size,) * 2).tocsr()
    free = np.arange(3 * (n + 1) ** 2, A.shape[0])
    grid = np.arange(n + 1) / n
    X = np.array([(x, y, z) for z in grid for y in grid for x in grid])
    return A[free][:, free].tocsr(), X[(n + 1) ** 2:]


def solve(A, X, name):
    """Iterations, seconds of set-up and of the solve."""
    from petsc4py import PETSc  # in the process that needs it: MPI does not survive a fork
    options = PETSc.Options()
    options.clear()
    for key, value in OPTIONS[name].items():
        options[key] = value
    matrix = PETSc.Mat().createAIJ(A.shape, csr=(A.indptr.astype(np.int32), A.indices.astype(np.int32), A.data), bsize=3)
    place = PETSc.Vec().createWithArray(X.ravel().copy(), bsize=3)
    if name in ("ML", "GAMG"):
        matrix.setNearNullSpace(PETSc.NullSpace().createRigidBody(place))
    b = PETSc.Vec().createWithArray(np.random.default_rng(1).uniform(-1, 1, A.shape[0]))
    x = b.duplicate()
    ksp = PETSc.KSP().create()
    ksp.setOperators(matrix)
    ksp.setType("cg")
    ksp.setNormType(PETSc.KSP.NormType.UNPRECONDITIONED)
    ksp.setTolerances(rtol=1e-8, max_it=5000)
    ksp.setFromOptions()
    begin = time.perf_counter()
    ksp.setUp()
    middle = time.perf_counter()
    ksp.solve(b, x)
    seconds = time.perf_counter() - middle
    assert ksp.getConvergedReason() > 0, ksp.getConvergedReason()
    rest = b.array - A @ x.array
    assert np.linalg.norm(rest) < 1e-7 * np.linalg.norm(b.array), "it has not converged"
    return ksp.getIterationNumber(), middle - begin, seconds


def measure(n, nu, courant, name):
    A, X = system(n, nu, courant)
    iterations, set_up, seconds = solve(A, X, name)
    label = "static" if courant is None else f"{courant:g}"
    print(f"| {n} | {nu} | {label} | {name} | {iterations} | {set_up:.2f} | {seconds:.2f} |", flush=True)


def main():
    print("| cells an edge | nu | Courant | preconditioner | iterations | set-up, s | solve, s |\n|---|---|---|---|---|---|---|",
          flush=True)
    for n in map(int, sys.argv[1:]):
        for nu in (0.3, 0.49):
            for courant in (None, 100.0, 10.0, 1.0):
                for name in OPTIONS:  # each in a process: what one leaves behind would be found by the next
                    if (child := os.fork()) == 0:
                        measure(n, nu, courant, name)
                        os._exit(0)
                    os.waitpid(child, 0)


if __name__ == "__main__":
    main()
