"""Do the surfaces of two bodies cross, and how deep? An independent answer from the triangles of their skins.

Facets are taken as the program takes them: a quadrilateral by four triangles about the middle of its corners, faces of
second order by linear pieces over their nodes. Nodes and middles that are inside, by the winding number (van Oosterom and
Strackee, The solid angle of a plane triangle, IEEE Transactions on Biomedical Engineering 30, 1983), count with their
distance from the surface. An edge that goes in and out again counts with the least of
  - the depth of the one end of its part inside below the plane of the triangle at the other;
  - the distance between an edge of its facets and one of the pierced facets along their cross product n, where n stands in
    the arc between the normals on both sides of the one edge, and -n in that of the other: there the bodies part along n
    (Gregorius, The separating axis test between convex polyhedra, Game Developers Conference, 2013);
or with the greatest distance of points of that part from the surface, where the faces are so bent that it is more.
Needs numpy.
"""

import numpy as np

ARC = 0.05  # rad by which a direction may stand outside of the arc of an edge's normals

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
        self.of_facet = [[] for _ in pieces]
        for e, t in enumerate(sides.values()):
            for facet in {owner[k] for k in t}:
                self.of_facet[facet].append(e)

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

    def in_arc(self, e, n):
        """Do the directions n, normal to the edges e, stand between the normals on the sides of edges that bulge?"""
        one, two = self.sides[e, 0], self.sides[e, 1]
        across = self.corner[self.skin.beside[e, 1]].mean(axis=1) - self.ends[e, 0]
        bend, first, second = (np.arccos(np.clip((x * y).sum(axis=1), -1.0, 1.0))
                               for x, y in ((one, two), (n, one), (n, two)))
        bulges = ((across * one).sum(axis=1) < 0.0) | (bend < ARC)
        return bulges & (first + second <= bend + ARC)

    def winding(self, p):
        """1 of points inside, 0 outside."""
        if not len(p):
            return np.zeros(0)
        a = self.corner[None] - p[:, None, None]
        length = np.linalg.norm(a, axis=3)
        det = (a[:, :, 0] * np.cross(a[:, :, 1], a[:, :, 2])).sum(axis=2)
        dots = [(a[:, :, i] * a[:, :, (i + 1) % 3]).sum(axis=2) * length[:, :, (i + 2) % 3] for i in range(3)]
        return (2.0 * np.arctan2(det, length.prod(axis=2) + sum(dots))).sum(axis=1) / (4.0 * np.pi)

    def distance(self, p):
        """From the surface."""
        if not len(p):
            return np.zeros(0)
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
        return np.where(within, np.abs(plane), best).min(axis=1)

    def inside(self, p):
        """Depth of points inside, 0 of others."""
        depth = np.zeros(len(p))
        near = np.flatnonzero(((p > self.low) & (p < self.high)).all(axis=1))
        for part in np.array_split(near, 1 + len(near) * len(self.corner) // 200000):
            hit = part[self.winding(p[part]) > 0.5]
            depth[hit] = self.distance(p[hit])
        return depth


def crossing_depths(a, b):
    """How deep two placed skins are in each other: by nodes inside, and by edges that go in and out again."""
    if (a.low > b.high).any() or (b.low > a.high).any():
        return 0.0, 0.0
    return float(max(a.inside(b.x).max(), b.inside(a.x).max())), max(pierced(a, b), pierced(b, a))


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
    way = x[last] - x[first]
    depth = np.minimum(-(way * b.normal[t[first]]).sum(axis=1), (way * b.normal[t[last]]).sum(axis=1))
    depth = np.minimum(depth, np.minimum(parting(a, b, e[first], t[first]), parting(a, b, e[last], t[last])))
    inside = (x[first][:, None] + np.linspace(0.0, 1.0, 10)[1:-1, None] * way[:, None]).reshape(-1, 3)
    return float(np.maximum(depth, b.inside(inside).reshape(len(first), -1).max(axis=1)).max())


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


def parting(a, b, e, t):
    """Of edges of a and triangles of b that they pierce: least way along a cross product of edges that parts them, or inf."""
    which, d, f = [], [], []
    for k, facet in enumerate(b.skin.owner[t]):
        own = sorted({i for side in a.skin.beside[e[k]] for i in a.skin.of_facet[a.skin.owner[side]]})
        for other in b.skin.of_facet[facet]:
            which += [k] * len(own)
            d += own
            f += [other] * len(own)
    which, d, f = np.array(which), np.array(d), np.array(f)
    u, v = a.ends[d], b.ends[f]
    along_a, along_b = u[:, 1] - u[:, 0], v[:, 1] - v[:, 0]
    n = np.cross(along_a, along_b)
    size = np.linalg.norm(n, axis=1)
    good = size > 0.02 * np.linalg.norm(along_a, axis=1) * np.linalg.norm(along_b, axis=1)
    n /= np.where(size > 0.0, size, 1.0)[:, None]
    n *= np.where((n * b.sides[f].sum(axis=1)).sum(axis=1) < 0.0, -1.0, 1.0)[:, None]
    good &= b.in_arc(f, n) & a.in_arc(d, -n)
    way = ((v[:, 0] - u[:, 0]) * n).sum(axis=1)
    good &= way > 0.0
    least = np.full(len(e), np.inf)
    np.minimum.at(least, which[good], way[good])
    return least


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
