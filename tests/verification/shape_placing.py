"""How the bodies of the trial of shapes are turned onto each other and how far one can fly until it meets another.

Needs numpy.
"""

import collections
import math

import numpy as np

from impact_trial import rotation

MEETINGS = (("edge", "edge"),) * 4 + (("corner", "face"),) * 3 + (
    ("face", "corner"), ("edge", "face"), ("face", "edge"), ("corner", "edge"), ("corner", "corner"), ("face", "face"))


def feature(draw, body, kind):
    """(point, direction): a random corner, edge or face of the body, and where it looks."""
    skin = body.skin.placed(body.nodes)
    sides, triangles = skin.sides, skin.corner
    across = triangles[body.skin.beside[:, 1]].mean(axis=1) - skin.ends[:, 0]
    sharp = ((across * sides[:, 0]).sum(axis=1) < 0.0) & ((sides[:, 0] * sides[:, 1]).sum(axis=1) < 0.75)
    sharp = [int(e) for e in np.flatnonzero(sharp)]
    if kind == "face" or not sharp:
        t = draw.randrange(len(triangles))
        return triangles[t].mean(axis=0), skin.normal[t]
    if kind == "edge":
        e, share = draw.choice(sharp), draw.random()
        point, looks = skin.ends[e, 0] * (1.0 - share) + skin.ends[e, 1] * share, sides[e].sum(axis=0)
    else:
        ends = collections.Counter(int(i) for i in body.skin.edges[sharp].ravel())
        corner = draw.choice([i for i, n in ends.items() if n >= 3] or list(ends))
        point = skin.x[corner]
        looks = sides[[e for e in sharp if corner in body.skin.edges[e]]].sum(axis=(0, 1))
    return point, looks / np.linalg.norm(looks)


def turn_onto(draw, looks, onto):
    """A rotation that takes a direction to another, with a random spin about that, and half the time a small tilt."""
    axis = np.cross(looks, onto)
    if np.linalg.norm(axis) < 1e-9:
        axis = np.cross(looks, [0.3, 0.5, 0.8])
    turn = np.array(rotation(axis, math.acos(max(-1.0, min(1.0, float(np.dot(looks, onto)))))))
    turn = np.array(rotation(onto, draw.uniform(0.0, 2.0 * math.pi))) @ turn
    tilt = [draw.gauss(0.0, 1.0) for _ in range(3)]
    return np.array(rotation(tilt, draw.choice((0.0, draw.uniform(0.01, 0.3))))) @ turn


def place(draw, bodies, body, gap, target):
    """Turns and moves a body until it stands at the gap before one of the others; returns the direction that closes it."""
    own, others = draw.choice(MEETINGS)
    there, looks = feature(draw, target, others)
    direction = -looks
    point, looks = feature(draw, body, own)
    turn = turn_onto(draw, looks, direction)
    body.nodes, point = body.nodes @ turn.T, turn @ point
    beside = np.cross(direction, [draw.gauss(0.0, 1.0) for _ in range(3)])
    beside *= draw.choice((0.0, draw.uniform(0.0, 0.3))) * body.size / np.linalg.norm(beside)
    for offset in (beside, 0.0 * beside, None):
        shift = there - point + offset if offset is not None else target.nodes.mean(axis=0) - body.nodes.mean(axis=0)
        moved = body.nodes + shift
        back = max((moved @ direction).max() - min((b.nodes @ direction).min() for b in bodies), 0.0) + body.size
        body.nodes, start = moved - back * direction, body.nodes
        free = min(way(body, b, direction) for b in bodies)
        if math.isfinite(free):
            body.nodes = body.nodes + (free - gap) * direction
            body.meeting = f"{own} on {others}"
            return direction
        body.nodes = start
    raise ValueError("the bodies do not meet")


def way(a, b, u):
    """How far a can go along u until it meets b; infinite where it passes."""
    e_1 = np.cross(u, np.eye(3)[np.argmin(np.abs(u))])
    e_1 /= np.linalg.norm(e_1)
    frame = np.array([e_1, np.cross(u, e_1), u])
    x, y = a.skin.points(a.nodes) @ frame.T, b.skin.points(b.nodes) @ frame.T
    low = np.maximum(x.min(axis=0), y.min(axis=0))[:2]
    high = np.minimum(x.max(axis=0), y.max(axis=0))[:2]
    if (low > high).any():
        return math.inf
    return min(to_triangles(x, y[b.skin.triangles], low, high), -to_triangles(y, x[a.skin.triangles], low, high, -1.0),
               to_edges(x[a.skin.edges], y[b.skin.edges], low, high))


def within(ends, low, high):
    """Which of the edges or triangles reach into the rectangle."""
    return ends[((ends.min(axis=1)[:, :2] <= high) & (ends.max(axis=1)[:, :2] >= low)).all(axis=1)]


def to_triangles(x, corners, low, high, sign=1.0):
    """Least height of triangles over points (sign 1), or greatest (-1, negative where below)."""
    x, corners = within(x[:, None], low, high)[:, 0], within(corners, low, high)
    if not len(x) or not len(corners):
        return sign * math.inf
    a, d, g = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    det = d[:, 0] * g[:, 1] - d[:, 1] * g[:, 0]
    flat = np.abs(det) > 1e-14 * (np.abs(d[:, 0] * g[:, 1]) + np.abs(d[:, 1] * g[:, 0]))
    a, d, g, det = a[flat], d[flat], g[flat], det[flat]
    r = x[:, None] - a[None]
    s = (r[..., 0] * g[:, 1] - r[..., 1] * g[:, 0]) / det
    t = (d[:, 0] * r[..., 1] - d[:, 1] * r[..., 0]) / det
    height = sign * (s * d[:, 2] + t * g[:, 2] - r[..., 2])
    return sign * float(np.where((s >= 0.0) & (t >= 0.0) & (s + t <= 1.0), height, math.inf).min(initial=math.inf))


def to_edges(a, b, low, high):
    """Least height of edges b over edges a where they cross."""
    a, b = within(a, low, high), within(b, low, high)
    if not len(a) or not len(b):
        return math.inf
    d, g = (a[:, 1] - a[:, 0])[:, None], (b[:, 1] - b[:, 0])[None]
    r = b[None, :, 0] - a[:, None, 0]
    det = d[..., 0] * g[..., 1] - d[..., 1] * g[..., 0]
    parallel = np.abs(det) <= 1e-12 * np.linalg.norm(d, axis=2) * np.linalg.norm(g, axis=2)
    det = np.where(parallel, 1.0, det)
    s = (r[..., 0] * g[..., 1] - r[..., 1] * g[..., 0]) / det
    t = (r[..., 0] * d[..., 1] - r[..., 1] * d[..., 0]) / det
    height = r[..., 2] + t * g[..., 2] - s * d[..., 2]
    cross = ~parallel & (s >= 0.0) & (s <= 1.0) & (t >= 0.0) & (t <= 1.0)
    return float(np.where(cross, height, math.inf).min(initial=math.inf))
