#!/usr/bin/env python3
"""The recurrences and energy identities of docs/scheme_formulas.md, written down again here for one oscillator, against the
program: displacement, velocity and the `algorithmic` of the ledger at every step.

    python3 scheme_formulas_test.py build/release/carom
"""

import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
STIFFNESS, U0, V0, FORCE, STEP, STEPS = 1.0, 0.1, 0.2, 0.3, 0.3, 20
END = STEP * STEPS

# One cell of a bar, held at one end: m = rho A L / 3 at the other with a consistent mass, half of the cell with a lumped one.
CASE = """title = "An oscillator"

[[mesh.block]]
kind = "bar"
end = [1.0, 0.0, 0.0]
divisions = 1
groups = {{ cells = "BAR", start = "START", end = "END" }}

[materials.any]
law = "linear_elastic"
E = 1.0
nu = 0.0
rho = 3.0

[[part]]
name = "bar"
cells = "BAR"
material = "any"
section = "bar"
area = 1.0

[[support]]
nodes = "START"
blocked = ["x", "y", "z"]

[[support]]
nodes = "END"
blocked = ["y", "z"]

[[initial]]
nodes = "END"
displacement = [{u0}, 0.0, 0.0]
velocity = [{v0}, 0.0, 0.0]

[[load]]
group = "END"
force = [{force}, 0.0, 0.0]
function = "ramp"

[functions.ramp]
time = [0.0, {end}]
value = [0.0, 1.0]

[scheme]
kind = "{kind}"
{keys}

[time]
end = {end}
step = {step}

[guards]
energy_growth = 10.0

[[probe]]
name = "end"
group = "END"
quantities = ["displacement", "velocity"]
"""


def load(t):
    return FORCE * t / END


class Step:
    """What is known at both ends of a step of one dof, as the identities of the page name it."""

    def __init__(self, m, t, h, u0, v0, u1, v1):
        self.m, self.u0, self.v0, self.u1, self.v1 = m, u0, v0, u1, v1
        self.r0, self.r1 = load(t) - STIFFNESS * u0, load(t + h) - STIFFNESS * u1  # f - F
        self.du, self.dv, self.dr = u1 - u0, v1 - v0, self.r1 - self.r0
        self.dT = 0.5 * m * (v1 * v1 - v0 * v0)


def generalized_alpha(alpha_m, alpha_f, beta, gamma):
    def step(m, t, h, u0, v0, memory):
        a0, = memory
        uh, vh = u0 + h * v0 + h * h * (0.5 - beta) * a0, v0 + h * (1 - gamma) * a0
        known = (1 - alpha_f) * (load(t + h) - STIFFNESS * uh) + alpha_f * (load(t) - STIFFNESS * u0) - m * alpha_m * a0
        a1 = known / (m * (1 - alpha_m) + (1 - alpha_f) * STIFFNESS * beta * h * h)
        s = Step(m, t, h, u0, v0, uh + beta * h * h * a1, vh + gamma * h * a1)
        mean = (1 - alpha_m) * a1 + alpha_m * a0
        return s, s.du * m * mean - s.dT - (0.5 - alpha_f) * s.du * s.dr, (a1,)

    return step


def newmark(beta, gamma):
    of_alpha = generalized_alpha(0.0, 0.0, beta, gamma)

    def step(m, t, h, u0, v0, memory):
        s, general, new = of_alpha(m, t, h, u0, v0, memory)
        a0, a1 = memory[0], new[0]
        b, g = beta - gamma / 2, gamma - 0.5
        own = -g * s.du * s.dr + 0.5 * h * h * b * m * (a1 * a1 - a0 * a0) + h * h * g * b * m * (a1 - a0) ** 2
        assert abs(own - general) < 1e-12, (own, general)
        return s, own, new

    return step


def chung_hulbert(r):
    alpha_m, alpha_f = (2 * r - 1) / (r + 1), r / (r + 1)
    return alpha_m, alpha_f, 0.25 * (1 - alpha_m + alpha_f) ** 2, 0.5 - alpha_m + alpha_f


def bathe(m, t, h, u0, v0, memory):
    a0, = memory
    k = h / 2
    # Trapezoidal rule to the middle.
    uh, vh = u0 + k * v0 + k * k / 4 * a0, v0 + k / 2 * a0
    ah = (load(t + k) - STIFFNESS * uh) / (m + STIFFNESS * k * k / 4)
    u, v = uh + k * k / 4 * ah, vh + k / 2 * ah
    # h a1 = v0 - 4 v + 3 v1, h v1 = u0 - 4 u + 3 u1.
    vp = (4 * v - v0) / 3
    up = (h * vp + 4 * u - u0) / 3
    a1 = (load(t + h) - STIFFNESS * up) / (m + STIFFNESS * h * h / 9)
    v1 = vp + h / 3 * a1
    u1 = up + h * h / 9 * a1
    second = Step(m, t + k, k, u, v, u1, v1)
    return Step(m, t, h, u0, v0, u1, v1), second.du * m * 0.5 * (ah + a1) - second.dT, (a1,)


def contact_stabilized_newmark(gamma):
    def step(m, t, h, u0, v0, _memory):
        uh = u0 + h * v0  # nothing is touched: u_hat
        known = (1 - gamma) * (load(t) - STIFFNESS * u0) + gamma * (load(t + h) - STIFFNESS * uh)
        a = known / (m + gamma * STIFFNESS * h * h / 2)
        s = Step(m, t, h, u0, v0, uh + h * h / 2 * a, v0 + h * a)
        return s, -(gamma - 0.5) * s.dr * s.du, (a,)

    return step


def moreau_jean(theta):
    def step(m, t, h, u0, v0, _memory):
        # u1 = u0 + h (theta v1 + (1 - theta) v0), m (v1 - v0) = h (theta r1 + (1 - theta) r0)
        r0, f1 = load(t) - STIFFNESS * u0, load(t + h)
        up = u0 + h * (1 - theta) * v0
        v1 = (m * v0 + h * (1 - theta) * r0 + h * theta * (f1 - STIFFNESS * up)) / (m + h * h * theta**2 * STIFFNESS)
        s = Step(m, t, h, u0, v0, up + h * theta * v1, v1)
        return s, (theta - 0.5) * (m * s.dv**2 - s.dr * s.du), ((v1 - v0) / h,)

    return step


def energy_momentum(m, t, h, u0, v0, memory):
    s, _, new = moreau_jean(0.5)(m, t, h, u0, v0, memory)  # the midpoint rule, for a linear body
    return s, 0.0, new


def nonsmooth_generalized_alpha(r):
    alpha_m, alpha_f, beta, gamma = chung_hulbert(r)

    def step(m, t, h, u0, v0, memory):
        a0, z0 = memory if len(memory) == 2 else (memory[0], memory[0])
        kappa = (1 - alpha_f) / (1 - alpha_m)
        carried = (alpha_f * z0 - alpha_m * a0) / (1 - alpha_m)
        up = u0 + h * v0 + h * h * ((0.5 - beta) * a0 + beta * carried)
        z1 = (load(t + h) - STIFFNESS * up) / (m + STIFFNESS * h * h * beta * kappa)
        a1 = kappa * z1 + carried
        s = Step(m, t, h, u0, v0, up + h * h * beta * kappa * z1, v0 + h * ((1 - gamma) * a0 + gamma * a1))
        own = s.du * m * ((z0 + z1) / 2 - (1 - gamma) * a0 - gamma * a1) + h * (beta - gamma / 2) * (a1 - a0) * m * s.dv
        return s, own, (a1, z1)

    return step


def statics(m, t, h, u0, v0, _memory):
    s = Step(m, t, h, u0, v0, load(t + h) / STIFFNESS, 0.0)
    return s, -0.5 * s.du * s.dr - s.dT, (0.0,)


def central_differences(m, t, h, u0, v0, memory):
    a0, = memory
    half = v0 + h / 2 * a0
    u1 = u0 + h * half
    a1 = (load(t + h) - STIFFNESS * u1) / m
    return Step(m, t, h, u0, v0, u1, half + h / 2 * a1), -h * h / 8 * m * (a1 * a1 - a0 * a0), (a1,)


def of_explicit_books(s, h, A, B, a0, a1):
    return s.du * s.m * (0.5 * (a0 + a1) - A) - h * h * (0.5 * A - B) * s.m * A


def hulbert_chung(r):
    alpha_m, beta = (2 * r - 1) / (1 + r), (5 - 3 * r) / ((1 + r) ** 2 * (2 - r))
    gamma = 1.5 - alpha_m

    def step(m, t, h, u0, v0, memory):
        a0, e0 = memory if len(memory) == 2 else (memory[0], memory[0])
        e1 = (a0 - alpha_m * e0) / (1 - alpha_m)
        A, B = (1 - gamma) * e0 + gamma * e1, (0.5 - beta) * e0 + beta * e1
        s = Step(m, t, h, u0, v0, u0 + h * v0 + h * h * B, v0 + h * A)
        a1 = s.r1 / m
        return s, of_explicit_books(s, h, A, B, a0, a1), (a1, e1)

    return step


def noh_bathe(p):
    q1 = (1 - 2 * p) / (2 * p * (1 - p))
    q2 = 0.5 - p * q1
    q0 = 0.5 - q1 - q2

    def step(m, t, h, u0, v0, memory):
        a0, = memory
        first, lent, (ap,) = central_differences(m, t, p * h, u0, v0, memory)
        k, up, vp = (1 - p) * h, first.u1, first.v1
        u1 = up + k * vp + k * k / 2 * ap
        a1 = (load(t + h) - STIFFNESS * u1) / m
        A, B = q0 * a0 + (0.5 + q1) * ap + q2 * a1, 0.5 * ap
        second = Step(m, t + p * h, k, up, vp, u1, vp + k * A)
        return Step(m, t, h, u0, v0, u1, second.v1), lent + of_explicit_books(second, k, A, B, ap, a1), (a1,)

    return step


def tchamwa_wielgosz(phi):
    def step(m, t, h, u0, v0, memory):
        a0, = memory
        s = Step(m, t, h, u0, v0, u0 + h * v0 + phi * h * h * a0, v0 + h * a0)
        return s, of_explicit_books(s, h, a0, phi * a0, a0, s.r1 / m), (s.r1 / m,)

    return step


# Name, keys of [scheme], recurrence.
SCHEMES = (
    ("newmark", "", newmark(0.25, 0.5)),
    ("newmark", "beta = 0.3\ngamma = 0.6", newmark(0.3, 0.6)),
    ("hht", "alpha = -0.2", generalized_alpha(0.0, 0.2, 0.36, 0.7)),
    ("wbz", "alpha = -0.2", generalized_alpha(-0.2, 0.0, 0.36, 0.7)),
    ("generalized_alpha", "rho_inf = 0.5", generalized_alpha(*chung_hulbert(0.5))),
    ("bathe", "", bathe),
    ("contact_stabilized_newmark", "gamma = 0.7", contact_stabilized_newmark(0.7)),
    ("energy_momentum", "", energy_momentum),
    ("moreau_jean", "theta = 0.7", moreau_jean(0.7)),
    ("nonsmooth_generalized_alpha", "rho_inf = 0.5", nonsmooth_generalized_alpha(0.5)),
    ("central_differences", "", central_differences),
    ("cd_lagrange", "", central_differences),
    ("forward_increment", "", central_differences),
    ("modified_mass", "", central_differences),
    ("hulbert_chung", "rho_inf = 0.5", hulbert_chung(0.5)),
    ("noh_bathe", "p = 0.6", noh_bathe(0.6)),
    ("tchamwa_wielgosz", "phi = 1.1", tchamwa_wielgosz(1.1)),
    ("statics", "", statics),
)
LUMPED = {"central_differences", "cd_lagrange", "forward_increment", "modified_mass", "hulbert_chung", "noh_bathe",
          "tchamwa_wielgosz"}
# Rounding, and what iterative solvers leave; the numbers are of the order of 1.
TOLERANCE = 1e-10


def rows_of(path):
    with open(path, encoding="utf-8") as table:
        return list(csv.DictReader(line for line in table if not line.startswith("#")))


class Formulas(unittest.TestCase):
    carom = ""

    def compare(self, kind, keys, recurrence):
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder) / "case.toml"
            case.write_text(CASE.format(u0=U0, v0=V0, force=FORCE, end=END, step=STEP, kind=kind, keys=keys))
            out = pathlib.Path(folder) / "out"
            done = subprocess.run([self.carom, "run", case, "--out", out, "--quiet"], check=False, capture_output=True,
                                  text=True)
            # 1 is a verdict that has failed: dissipation is what is looked at here.
            self.assertIn(done.returncode, (0, 1), done.stderr + done.stdout)
            probes, energies = rows_of(out / "probes.csv"), rows_of(out / "energy.csv")
        self.assertEqual(len(probes), STEPS + 1)
        mass = 1.5 if kind in LUMPED else 1.0
        u, v = float(probes[0]["end.displacement_x"]), float(probes[0]["end.velocity_x"])
        memory, algorithmic = ((load(0.0) - STIFFNESS * u) / mass,), 0.0
        for n in range(STEPS):
            step, own, memory = recurrence(mass, n * STEP, STEP, u, v, memory)
            u, v, algorithmic = step.u1, step.v1, algorithmic + own
            for found, name in ((u, "end.displacement_x"), (v, "end.velocity_x")):
                self.assertAlmostEqual(float(probes[n + 1][name]), found, delta=TOLERANCE, msg=f"{kind}, step {n + 1}, {name}")
            self.assertAlmostEqual(float(energies[n + 1]["algorithmic"]), algorithmic, delta=TOLERANCE,
                                   msg=f"{kind}, step {n + 1}, algorithmic")

    def test_the_program_does_what_the_page_says(self):
        for kind, keys, recurrence in SCHEMES:
            with self.subTest(kind=kind, keys=keys):
                self.compare(kind, keys, recurrence)

    def test_the_page_has_every_scheme(self):
        schema = json.loads(subprocess.run([self.carom, "schema"], check=True, capture_output=True, text=True).stdout)
        kinds = set(schema["properties"]["scheme"]["properties"]["kind"]["enum"])
        self.assertEqual({kind for kind, _, _ in SCHEMES}, kinds)
        page = (ROOT / "docs" / "scheme_formulas.md").read_text(encoding="utf-8")
        headings = "\n".join(re.findall(r"^### .*$", page, re.MULTILINE))
        self.assertEqual(set(re.findall(r"`(\w+)`", headings)), kinds)


if __name__ == "__main__":
    Formulas.carom = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
