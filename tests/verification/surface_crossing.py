"""Do the surfaces of two bodies cross, and how deep? An independent answer from the triangles of their skins.

Facets are taken as the program takes them: a quadrilateral by four triangles about the middle of its corners, faces of
second order by linear pieces over their nodes. Nodes and middles that are inside, by the winding number (van Oosterom and
Strackee, The solid angle of a plane triangle, IEEE Transactions on Biomedical Engineering 30, 1983), count with their
distance from the surface. An edge that goes in and out again counts with the least way that takes its part
inside out of the body, out of the half-space below the triangle it comes in by, or goes out by, or below one that is
nearest to a point of that part; or over the ridge of the first two, along the cross product of edge and ridge. It is at
least the greatest distance of points of that part from the surface.
Needs numpy.
"""

import numpy as np

RIDGE = 0.1  # sine of the angle between two triangles above which they have a ridge
SAMPLES = np.linspace(0.0, 1.0, 10)[1:-1, None]  # of the part of an edge that is inside

PIECES = {3: ((0, 1, 2),), 4: ((0, 1, 2, 3),), 6: ((0, 3, 5), (1, 4, 3), (2, 5, 4), (3, 4, 5)),
          8: ((0, 4, 7), (1, 5, 4), (2, 6, 5), (3, 7, 6), (4, 5, 6, 7)),
          9: ((0, 4, 8, 7), (4, 1, 5, 8), (8, 5, 2, 6), (7, 8, 6, 3))}


class Skin:
    """The closed skin of one body: facets of 3, 4, 6, 8 or 9 nodes, seen from outside, corners first."""

    def __init__(self, facets):
        used = sorted({i for f in facets for i in f})
        place = {i: k for k, i in enumerate(used)}
        self.nodes = np.array(used)
        pieces = [[place[f[i]] for i in piece] for f in facets for piece in PIECES[len(f)]]
        self.quads = np.array([p for p in pieces if len(p) == 4], dtype=int).reshape(-1, 4)
        triangles, owner, centre = [], [], len(used)
        for number, p in enumerate(pieces):
            if len(p) == 3:
                triangles.append(p)
                owner.append(number)
                continue
            triangles += [(p[i], p[(i + 1) % 4], centre) for i in range(4)]
            owner += [number] * 4
            centre += 1
        self.triangles, self.owner = np.array(triangles), np.array(owner)
        sides = {}
        for t, corners in enumerate(triangles):
            for a, b in zip(corners, corners[1:] + corners[:1]):
                sides.setdefault((min(a, b), max(a, b)), []).append(t)
        self.edges = np.array(list(sides))
        self.beside = np.array([(t[0], t[-1]) for t in sides.values()])

    def points(self, x):
        """Positions of the corners and of the middles of the quadrilaterals; x of all nodes."""
        corners = np.asarray(x)[self.nodes]
        return np.vstack([corners, corners[self.quads].mean(axis=1)])

    def placed(self, x):
        return Placed(self, self.points(x))

    def unlike(self, x):
        """Greatest distance of the triangles from the bilinear faces: a quarter of the part w of x = ... + w xi eta."""
        corners = np.asarray(x)[self.nodes][self.quads]
        w = 0.25 * (corners[:, 0] - corners[:, 1] + corners[:, 2] - corners[:, 3])
        return 0.25 * np.linalg.norm(w, axis=1).max(initial=0.0)


class Placed:
    """A skin at its place."""

    def __init__(self, skin, x):
        self.skin, self.x = skin, x
        self.corner = x[skin.triangles]
        normal = np.cross(self.corner[:, 1] - self.corner[:, 0], self.corner[:, 2] - self.corner[:, 0])
        self.normal = normal / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
        self.low, self.high = x.min(axis=0), x.max(axis=0)
        self.ends = x[skin.edges]
        self.sides = self.normal[skin.beside]  # of each edge

    def winding(self, p):
        """1 of points inside, 0 outside."""
        if not len(p):
            return np.zeros(0)
        a = self.corner[None] - p[:, None, None]
        length = np.linalg.norm(a, axis=3)
        det = (a[:, :, 0] * np.cross(a[:, :, 1], a[:, :, 2])).sum(axis=2)
        dots = [(a[:, :, i] * a[:, :, (i + 1) % 3]).sum(axis=2) * length[:, :, (i + 2) % 3] for i in range(3)]
        return (2.0 * np.arctan2(det, length.prod(axis=2) + sum(dots))).sum(axis=1) / (4.0 * np.pi)

    def nearest(self, p):
        """Distances from the surface, and the triangles."""
        a = self.corner
        d = p[:, None] - a[None, :, 0]
        plane = (d * self.normal[None]).sum(axis=2)
        foot = p[:, None] - plane[..., None] * self.normal[None]
        within = np.ones(plane.shape, dtype=bool)
        best = np.full(plane.shape, np.inf)
        for i in range(3):
            side = a[:, (i + 1) % 3] - a[:, i]
            rest = p[:, None] - a[None, :, i]
            share = np.clip((rest * side).sum(axis=2) / np.maximum((side * side).sum(axis=1), 1e-300), 0.0, 1.0)
            best = np.minimum(best, np.linalg.norm(rest - share[..., None] * side, axis=2))
            within &= (np.cross(side[None], foot - a[None, :, i]) * self.normal[None]).sum(axis=2) >= 0.0
        best = np.where(within, np.abs(plane), best)
        return best.min(axis=1), best.argmin(axis=1)

    def inside(self, p):
        """Depth of points inside, 0 of others, and the nearest triangles of those inside, -1."""
        depth, triangle = np.zeros(len(p)), np.full(len(p), -1)
        near = np.flatnonzero(((p > self.low) & (p < self.high)).all(axis=1))
        for part in np.array_split(near, 1 + len(near) * len(self.corner) // 200000):
            hit = part[self.winding(p[part]) > 0.5]
            if len(hit):
                depth[hit], triangle[hit] = self.nearest(p[hit])
        return depth, triangle


def crossing_depths(a, b):
    """How deep two placed skins are in each other: by nodes inside, and by edges that go in and out again."""
    if (a.low > b.high).any() or (b.low > a.high).any():
        return 0.0, 0.0
    return float(max(a.inside(b.x)[0].max(), b.inside(a.x)[0].max())), max(pierced(a, b), pierced(b, a))


def pierced(a, b):
    """Greatest depth of an edge of a that goes into b and out again."""
    e, t = near_pairs(a, b)
    p, q = a.ends[e, 0], a.ends[e, 1]
    corner, normal = b.corner[t], b.normal[t]
    above, below = ((p - corner[:, 0]) * normal).sum(axis=1), ((q - corner[:, 0]) * normal).sum(axis=1)
    hit = np.flatnonzero(above * below < 0.0)
    e, t, p, q, corner, normal, above, below = (v[hit] for v in (e, t, p, q, corner, normal, above, below))
    share = above / (above - below)
    x = p + share[:, None] * (q - p)
    within = np.ones(len(x), dtype=bool)
    for i in range(3):
        side = corner[:, (i + 1) % 3] - corner[:, i]
        within &= (np.cross(side, x - corner[:, i]) * normal).sum(axis=1) >= 0.0
    e, t, x, share, enters = e[within], t[within], x[within], share[within], above[within] > 0.0
    order = np.lexsort((share, e))
    first, last = order[:-1], order[1:]
    chords = (e[first] == e[last]) & enters[first] & ~enters[last]
    first, last = first[chords], last[chords]
    if not len(first):
        return 0.0
    start, end, normals = x[first], x[last], b.normal[np.stack([t[first], t[last]], axis=1)]
    points = start[:, None] + SAMPLES * (end - start)[:, None]
    depth, triangle = (v.reshape(len(first), -1) for v in b.inside(points.reshape(-1, 3)))
    return max(chord_depth(b, *chord) for chord in zip(start, end, normals, depth, triangle))


def chord_depth(b, start, end, normals, depths, nearest):
    """How deep the part of an edge between two points of the surface of b is inside; normals at these points, depths and
    nearest triangles of some between."""
    way = end - start
    depth, t = min(-normals[0] @ way, normals[1] @ way), nearest[nearest >= 0]
    if len(t):
        below = [((b.corner[t, 0] - x) * b.normal[t]).sum(axis=1) for x in (start, end)]
        depth = min(depth, np.maximum(*below).min())
    ridge = np.cross(*normals)
    out = np.cross(way, ridge)
    if np.linalg.norm(ridge) > RIDGE and np.linalg.norm(out) > RIDGE * np.linalg.norm(way) * np.linalg.norm(ridge):
        on_ridge = np.linalg.lstsq(normals, [normals[0] @ start, normals[1] @ end], rcond=None)[0]
        depth = min(depth, abs((on_ridge - start) @ out) / np.linalg.norm(out))
    return float(max(depth, depths.max()))


def near_pairs(a, b):
    """Edges of a and triangles of b whose boxes overlap."""
    low, high = a.ends.min(axis=1), a.ends.max(axis=1)
    bottom, top = b.corner.min(axis=1), b.corner.max(axis=1)
    edges = np.flatnonzero(((high >= b.low) & (low <= b.high)).all(axis=1))
    triangles = np.flatnonzero(((top >= a.low) & (bottom <= a.high)).all(axis=1))
    touch = np.ones((len(edges), len(triangles)), dtype=bool)
    for c in range(3):
        touch &= (high[edges, c][:, None] >= bottom[triangles, c]) & (low[edges, c][:, None] <= top[triangles, c])
    i, j = np.nonzero(touch)
    return edges[i], triangles[j]


# ------------------------------------------------------------------------------------------------- known configurations
def self_test():
    """Prints each known configuration with the depth found and due; returns the number that is wrong."""
    import shape_bodies as bodies  # pylint: disable=import-outside-toplevel

    def skin(body, turn=np.eye(3), shift=(0.0, 0.0, 0.0)):
        return Skin(body.facets()).placed(body.nodes @ np.asarray(turn).T + shift)

    def about(axis, angle):
        return np.array(bodies.rotation(axis, angle))

    quarter, roll = about((0, 0, 1), 0.5 * np.pi), about((1, 0, 0), 0.25 * np.pi)
    bar = bodies.box((4.0, 1.0, 1.0), (8, 2, 2))
    cube = bodies.box((1.0, 1.0, 1.0), (2, 2, 2))
    plate = bodies.box((4.0, 4.0, 1.0), (5, 5, 1))
    ball = bodies.ball(1.0, 6)
    on_corner = about(np.cross((1.0, 1.0, 1.0), (0.0, 0.0, -1.0)), np.arccos(-1.0 / np.sqrt(3.0)))
    d, wrong = 0.05, 0
    known = [
        ("crossed bars, flat on flat", skin(bar), skin(bar, quarter, (0.13, 0.07, 1.0 - d)), d),
        ("crossed bars, flat on flat, touching", skin(bar), skin(bar, quarter, (0.13, 0.07, 1.0)), 0.0),
        ("crossed bars, flat on flat, apart", skin(bar), skin(bar, quarter, (0.13, 0.07, 1.0 + d)), 0.0),
        ("bars side by side, nearly", skin(bar), skin(bar, about((0, 0, 1), 0.01), (0.3, 0.2, 1.0 - d)), d),
        ("edge on edge", skin(bar, roll), skin(bar, quarter @ roll, (0.13, 0.07, np.sqrt(2.0) - d)), d),
        ("edge on edge, askew", skin(bar, roll),
         skin(bar, about((0, 0, 1), 0.8) @ roll, (0.13, 0.07, np.sqrt(2.0) - d)), d),
        ("edge on edge, apart", skin(bar, roll), skin(bar, quarter @ roll, (0.13, 0.07, np.sqrt(2.0) + d)), 0.0),
        ("edge in face", skin(plate), skin(bar, quarter @ roll, (0.1, 0.05, 0.5 + np.sqrt(0.5) - d)), d),
        ("corner in face", skin(plate), skin(cube, on_corner, (0.17, 0.11, 0.5 + np.sqrt(0.75) - d)), d),
        ("corner on face, apart", skin(plate), skin(cube, on_corner, (0.17, 0.11, 0.5 + np.sqrt(0.75) + d)), 0.0),
        ("ball in plate", skin(plate), skin(ball, shift=(0.17, 0.11, 1.5 - d)), d),
        ("ball on plate, touching", skin(plate), skin(ball, shift=(0.17, 0.11, 1.5)), 0.0),
        ("cells of second order, flat on flat", skin(bodies.box((4.0, 1.0, 1.0), (8, 2, 2)).of_type("HEXA20")),
         skin(bodies.box((4.0, 1.0, 1.0), (8, 2, 2)).of_type("TETRA10"), quarter, (0.13, 0.07, 1.0 - d)), d)]
    for name, one, two, due in known:
        found = max(crossing_depths(one, two))
        right = abs(found - due) <= 1e-9
        wrong += not right
        print(f"{name:40} depth {found:.6f}, due {due:.6f}{'' if right else '  WRONG'}")
    return wrong
