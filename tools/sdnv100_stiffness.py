#!/usr/bin/env python3
"""Show what the contact stiffness does in SDNV100: print a table, draw a picture, fail if the conclusion does not hold.

    for e in 12 13 14 15 16; do
      build/release/carom run cases/sdnv100/stiffness/E_n_1e$e.toml --out out/stiffness/E_n_1e$e
    done
    python3 tools/sdnv100_stiffness.py out/stiffness docs/images/sdnv100_stiffness.svg

The manual (V5.03.100) concludes that a stiffer contact improves the displacement field and brings strong oscillations
of the velocity field around the analytical one. Measured at the foot A:
  displacement error    root mean square over the run of u_A minus that on a rigid wall;
  velocity oscillation  greatest |v_A - analytical| during the shock, the analytical velocity being that of the elastic
                        bar on a wall of the same stiffness, so that only what the discretisation adds is counted.
Standard library only.
"""

import csv
import math
import pathlib
import sys

EXPONENTS = (12, 13, 14, 15, 16)
DENSITY, LENGTH, SPEED, GAP = 8000.0, 0.2, 100.0, 2.0e-3
WAVE_SPEED = math.sqrt(2.0e11 * 0.7 / (1.3 * 0.4) / DENSITY)
TOUCH, ROUND_TRIP = GAP / SPEED, 2.0 * LENGTH / WAVE_SPEED
COLOURS = {12: "#7b3294", 13: "#2c7bb6", 14: "#1a9850", 15: "#f28e2b", 16: "#d7191c"}


def rigid_wall_displacement(t):
    """u_A on a rigid wall; it counts the initial +2 mm."""
    return GAP - SPEED * min(t, TOUCH) + SPEED * max(0.0, t - TOUCH - ROUND_TRIP)


def rigid_wall_velocity(t):
    if t < TOUCH:
        return -SPEED
    return SPEED if t > TOUCH + ROUND_TRIP else 0.0


def analytical_velocity(t, stiffness):
    """v_A of the elastic bar on a wall of traction = stiffness x penetration, until the end of the second round trip.

    With T the round trip and t_c = rho c / E_n, the up-going wave is F = 1 - exp(-s / t_c) for s < T (in units of
    rho c v0), then p + F(s - T) with p = exp(-x) (2 - exp(-T / t_c) + 2 x) - 1, x = (s - T) / t_c, until p vanishes.
    """
    s, t_c = t - TOUCH, DENSITY * WAVE_SPEED / stiffness
    return SPEED * (-1.0 + upgoing_wave(s, t_c) + upgoing_wave(s - ROUND_TRIP, t_c))


def upgoing_wave(s, t_c):
    if s <= 0.0:
        return 0.0
    if s <= ROUND_TRIP:
        return 1.0 - math.exp(-s / t_c)
    x = (s - ROUND_TRIP) / t_c
    pressure = math.exp(-x) * (2.0 - math.exp(-ROUND_TRIP / t_c) + 2.0 * x) - 1.0
    return max(0.0, pressure) + upgoing_wave(s - ROUND_TRIP, t_c)


def read_foot(path):
    """[(time, u_A, v_A)]"""
    with open(path, encoding="utf-8", newline="") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [(float(r["time"]), float(r["A.displacement_z"]), float(r["A.velocity_z"])) for r in rows]


def measures(foot, stiffness):
    """(displacement error [m], velocity oscillation [m/s])"""
    squares = [(u - rigid_wall_displacement(t)) ** 2 for t, u, _ in foot]
    shock = [abs(v - analytical_velocity(t, stiffness)) for t, _, v in foot if TOUCH < t < TOUCH + ROUND_TRIP]
    return math.sqrt(sum(squares) / len(squares)), max(shock)


class Panel:
    """One set of linear axes of the picture; what leaves them is cut off."""

    def __init__(self, box, x_range, y_range, title, x_label):
        self.left, self.top, self.width, self.height = box
        self.x_range, self.y_range = x_range, y_range
        self.clip = f"clip-{self.left}-{self.top}"
        self.parts = [
            f'<clipPath id="{self.clip}"><rect x="{self.left}" y="{self.top}" width="{self.width}" '
            f'height="{self.height}"/></clipPath>',
            f'<rect x="{self.left}" y="{self.top}" width="{self.width}" height="{self.height}" fill="none" '
            'stroke="#888"/>',
            f'<text x="{self.left}" y="{self.top - 10}" font-weight="bold">{title}</text>',
            f'<text x="{self.left + self.width / 2}" y="{self.top + self.height + 36}" text-anchor="middle">'
            f"{x_label}</text>",
        ]

    def x(self, value):
        low, high = self.x_range
        return self.left + self.width * (value - low) / (high - low)

    def y(self, value):
        low, high = self.y_range
        return self.top + self.height * (high - value) / (high - low)

    def x_tick(self, value, text):
        self.parts.append(f'<text x="{self.x(value):.1f}" y="{self.top + self.height + 17}" text-anchor="middle" '
                          f'font-size="11">{text}</text>')

    def y_tick(self, value, text):
        y = self.y(value)
        self.parts.append(f'<line x1="{self.left}" y1="{y:.1f}" x2="{self.left + self.width}" y2="{y:.1f}" '
                          'stroke="#ddd"/>'
                          f'<text x="{self.left - 6}" y="{y + 4:.1f}" text-anchor="end" font-size="11">{text}</text>')

    def line(self, points, colour, style=""):
        text = " ".join(f"{self.x(x):.1f},{self.y(y):.1f}" for x, y in points)
        self.parts.append(f'<polyline points="{text}" clip-path="url(#{self.clip})" fill="none" stroke="{colour}" '
                          f'stroke-width="1.6" {style}/>')

    def dots(self, points):
        for x, y in points:
            self.parts.append(f'<circle cx="{self.x(x):.1f}" cy="{self.y(y):.1f}" r="4.5" fill="{COLOURS[x]}"/>')


def time_panel(box, runs, column, y_ticks, title, exact):
    """Curves of one column of the runs over time, and the exact one on a rigid wall."""
    y_range = (y_ticks[0], y_ticks[-1])
    panel = Panel(box, (0.0, 140.0), y_range, title, "time [&#181;s]")
    for microseconds in range(0, 141, 20):
        panel.x_tick(microseconds, str(microseconds))
    for value in y_ticks:
        panel.y_tick(value, f"{value:g}")
    scale = 1.0e3 if column == 1 else 1.0
    for exponent, foot in runs.items():
        panel.line([(1.0e6 * row[0], scale * row[column]) for row in foot], COLOURS[exponent])
    panel.line([(0.1 * i, scale * exact(1.0e-7 * i)) for i in range(1401)], "#000", 'stroke-dasharray="5 3"')
    panel.parts.append(f'<text x="{box[0] + 8}" y="{box[1] + 18}" font-size="11">dashed: on a rigid wall</text>')
    return panel


def trend_panel(box, values, y_range, decades, title):
    """Logarithm of the values over the exponents of the stiffness."""
    panel = Panel(box, (11.7, 16.3), y_range, title, "contact stiffness E_n [Pa/m]")
    for exponent in EXPONENTS:
        panel.x_tick(exponent, f"1e{exponent}")
    for decade in decades:
        panel.y_tick(math.log10(decade), f"{decade:g}")
    points = [(exponent, math.log10(value)) for exponent, value in values.items()]
    panel.line(points, "#555")
    panel.dots(points)
    return panel


def picture(runs, errors, oscillations):
    panels = [
        time_panel((70, 50, 400, 230), runs, 1, (-1, 0, 1, 2, 3, 4), "displacement of the foot [mm]",
                   rigid_wall_displacement),
        time_panel((560, 50, 400, 230), runs, 2, (-150, -100, -50, 0, 50, 100, 150), "velocity of the foot [m/s]",
                   rigid_wall_velocity),
        trend_panel((70, 370, 400, 200), {k: 1.0e3 * v for k, v in errors.items()}, (-1.0, 0.7), (0.1, 0.3, 1, 3),
                    "displacement error, r.m.s. [mm]: falls"),
        trend_panel((560, 370, 400, 200), oscillations, (0.4, 2.2), (3, 10, 30, 100),
                    "velocity oscillation, greatest [m/s]: grows"),
    ]
    legend = "".join(f'<rect x="{230 + 120 * i}" y="626" width="22" height="4" fill="{COLOURS[e]}"/>'
                     f'<text x="{258 + 120 * i}" y="632" font-size="12">1e{e} Pa/m</text>'
                     for i, e in enumerate(EXPONENTS))
    body = "\n".join(part for panel in panels for part in panel.parts)
    return ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1000 650" font-family="sans-serif" font-size="13">\n'
            f'<rect width="1000" height="650" fill="#fff"/>\n{body}\n{legend}\n</svg>\n')


def is_monotone(values, sign):
    numbers = list(values.values())
    return all(sign * (b - a) > 0.0 for a, b in zip(numbers, numbers[1:]))


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    out, svg = map(pathlib.Path, sys.argv[1:])
    runs = {e: read_foot(out / f"E_n_1e{e}" / "probes.csv") for e in EXPONENTS}
    errors, oscillations = {}, {}
    print(f"{'E_n [Pa/m]':>10}{'displacement error [mm]':>26}{'velocity oscillation [m/s]':>29}")
    for e, foot in runs.items():
        errors[e], oscillations[e] = measures(foot, 10.0**e)
        print(f"{f'1e{e}':>10}{1e3 * errors[e]:>26.4f}{oscillations[e]:>29.2f}")
    svg.parent.mkdir(parents=True, exist_ok=True)
    svg.write_text(picture(runs, errors, oscillations), encoding="utf-8")
    if not (is_monotone(errors, -1.0) and is_monotone(oscillations, 1.0)):
        sys.exit("sdnv100_stiffness: the displacement error should fall and the oscillation grow with every stiffness")


if __name__ == "__main__":
    main()
