#!/usr/bin/env python3
"""Run SDNV100 (nu = 0) on its 20 cells with several schemes, measure the velocity field, draw a picture.

    python3 tools/sdnv100_better.py build/release/carom out/better docs/images/sdnv100_better.svg

prints the table of docs/sdnv100.md. The bar is that of cases/sdnv100/better.toml; a variant has another [scheme],
another [time] or a penalty wall. Measured over 0 <= t <= 1.4e-4 s against the bar on a rigid wall:
  error     mean over cells and steps of |v - exact| at the middle of both, over v0: v is the mean of the velocities of
            both ends of the cell and of the step; where an exact front passes just there, it counts as passed;
  L1 norm   the same integrated over cells and steps, v linear in each, 8 x 8 points in each;
  peak      greatest contact force over rho c v0 S;
  centre    velocity of the centre of mass at the end;
  kinetic   kinetic energy at the end over that of the start;
  balance   greatest imbalance of powers over the initial energy.
Standard library only.
"""

import csv
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sdnv100_stiffness import Panel  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[1]
CASE = ROOT / "cases" / "sdnv100" / "better.toml"
CELLS, LENGTH, WAVE_SPEED, SPEED, GAP = 20, 0.2, 5000.0, 100.0, 2.0e-3
DENSITY, AREA = 8000.0, 4.0e-4
MASS, PLATEAU = DENSITY * AREA * LENGTH, DENSITY * WAVE_SPEED * SPEED * AREA
ENERGY = 0.5 * MASS * SPEED**2

COURANT_99, IMPLICIT = "step = 1.98e-6", "step = 2.0e-6\nfixed = true"
SEMI_EXPLICIT = 'kind = "modified_mass"'
# name: scheme, time, stiffness of the wall [Pa/m] or None for a rigid one
VARIANTS = {
    "Newmark 0.28, 0.55, penalty 1e14 (manual)":
        ('kind = "newmark"\nbeta = 0.28\ngamma = 0.55', IMPLICIT, 1.0e14),
    "modified mass, 1 layer": (SEMI_EXPLICIT + "\nlayers = 1", COURANT_99, None),
    "modified mass, 2 layers": (SEMI_EXPLICIT + "\nlayers = 2", COURANT_99, None),
    "modified mass, 4 layers (better.toml)": (SEMI_EXPLICIT + "\nlayers = 4", COURANT_99, None),
    "modified mass, 8 layers": (SEMI_EXPLICIT + "\nlayers = 8", COURANT_99, None),
    "modified mass, all 20 layers": (SEMI_EXPLICIT + "\nlayers = 20", COURANT_99, None),
    "modified mass, least squares": (SEMI_EXPLICIT + '\nredistribution = "least_squares"', "safety = 1.0", None),
    "modified mass, 4 layers, Courant 0.9": (SEMI_EXPLICIT + "\nlayers = 4", "step = 1.8e-6", None),
    "modified mass, 4 layers, Courant 0.5": (SEMI_EXPLICIT + "\nlayers = 4", "step = 1.0e-6", None),
    "CD-Lagrange": ('kind = "cd_lagrange"', COURANT_99, None),
    "forward-increment multipliers": ('kind = "forward_increment"', COURANT_99, None),
    "central differences, penalty E/h": ('kind = "central_differences"', "step = 1.795e-6", 2.0e13),
    "Noh-Bathe, penalty E/h": ('kind = "noh_bathe"', "step = 3.04348e-06", 2.0e13),
    "Moreau-Jean, theta 1/2": ('kind = "moreau_jean"', IMPLICIT, None),
    "generalised-alpha, rho_inf 0.5": ('kind = "generalized_alpha"\nrho_inf = 0.5\nenforcement = "lagrange"', IMPLICIT,
                                       None),
    "Bathe composite": ('kind = "bathe"\nenforcement = "lagrange"', IMPLICIT, None),
}
MANUAL, BETTER = (next(name for name in VARIANTS if mark in name) for mark in ("(manual)", "(better.toml)"))


def section(text, name, content):
    """The text of a case with other content in [name]."""
    before, _, after = text.partition(f"\n[{name}]\n")
    return f"{before}\n[{name}]\n{content}\n\n[" + after.partition("\n[")[2]


def case_text(scheme, time, stiffness):
    """better.toml as that variant, without its checks, with a probe at each height of nodes."""
    text = CASE.read_text(encoding="utf-8").partition("[[check]]")[0].partition("\n[exact]")[0]
    text = section(section(text, "scheme", scheme), "time", "end = 1.4e-4\n" + time)
    if stiffness is not None:
        text = text.replace("normal = [0.0, 0.0, 1.0]", f"normal = [0.0, 0.0, 1.0]\nstiffness = {stiffness}")
    for i in range(CELLS + 1):
        text += (f'\n\n[[probe]]\nname = "N{i}"\npoint = [0.01, 0.01, {GAP + LENGTH * i / CELLS!r}]\n'
                 'quantities = ["velocity"]')
    return text + "\n"


def read_columns(path):
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return {name: [float(row[c]) for row in rows[1:]] for c, name in enumerate(rows[0])}


def run(carom, folder, variant):
    """Runs a variant into `folder`; returns {file: columns}."""
    folder.mkdir(parents=True, exist_ok=True)
    case = folder / "case.toml"
    case.write_text(case_text(*variant), encoding="utf-8")
    # 1: ended, and the verdict or a check failed.
    done = subprocess.run([str(carom), "run", str(case), "--out", str(folder / "out"), "--quiet"], capture_output=True,
                          text=True, check=False)
    if done.returncode not in (0, 1):
        raise RuntimeError(f"{case}: {done.stdout}{done.stderr}")
    return {name: read_columns(folder / "out" / f"{name}.csv") for name in ("probes", "contact", "energy")}


def exact_velocity(z, t):
    """Of the bar on a rigid wall; a front counts as passed within 1e-9 of a round trip."""
    s = t - GAP / SPEED + 1.0e-9 * LENGTH / WAVE_SPEED
    if s < z / WAVE_SPEED:
        return -SPEED
    return 0.0 if s < (2.0 * LENGTH - z) / WAVE_SPEED else SPEED


def field_error(times, velocities, points):
    """Mean of |v - exact| over points^2 points in each cell and step, over v0."""
    total, weight = 0.0, 0.0
    places = [(k + 0.5) / points for k in range(points)]
    for j, (t0, t1) in enumerate(zip(times, times[1:])):
        for i in range(CELLS):
            (a0, a1), (b0, b1) = velocities[i][j:j + 2], velocities[i + 1][j:j + 2]
            for y in places:
                a, b = a0 + y * (a1 - a0), b0 + y * (b1 - b0)
                total += (t1 - t0) * sum(
                    abs(a + x * (b - a) - exact_velocity((i + x) * LENGTH / CELLS, t0 + y * (t1 - t0))) for x in places)
        weight += (t1 - t0) * CELLS * points**2
    return total / weight / SPEED


def measures(results):
    probes, energy = results["probes"], results["energy"]
    velocities = [probes[f"N{i}.velocity_z"] for i in range(CELLS + 1)]
    return {
        "error": field_error(probes["time"], velocities, 1),
        "L1 norm": field_error(probes["time"], velocities, 8),
        "peak": max(results["contact"]["wall.force_z"]) / PLATEAU,
        "centre": energy["momentum_z"][-1] / MASS,
        "kinetic": energy["kinetic"][-1] / energy["kinetic"][0],
        "balance": max(map(abs, energy["imbalance"])) / ENERGY,
    }


def table(found):
    """Lines of the table of docs/sdnv100.md."""
    lines = ["| scheme and contact | error | L1 norm | peak force | centre of mass | kinetic energy |",
             "|---|---|---|---|---|---|"]
    for name, m in found.items():
        lines.append(f"| {name} | {100 * m['error']:.2f} % | {100 * m['L1 norm']:.2f} % | {m['peak']:.3f} | "
                     f"{m['centre']:.2f} m/s | {100 * m['kinetic']:.2f} % |")
    return lines


def curve_panel(box, results, column, values, title, exact):
    table_name, column_name, scale = column
    panel = Panel(box, (0.0, 140.0), (values[0], values[-1]), title, "time [&#181;s]")
    for microseconds in range(0, 141, 20):
        panel.x_tick(microseconds, str(microseconds))
    for value in values:
        panel.y_tick(value, f"{value:g}")
    for colour, name in (("#d7191c", MANUAL), ("#2c7bb6", BETTER)):
        columns = results[name][table_name]
        panel.line([(1.0e6 * t, x / scale) for t, x in zip(columns["time"], columns[column_name])], colour)
    panel.line([(0.1 * i, exact(1.0e-7 * i)) for i in range(1401)], "#000", 'stroke-dasharray="5 3"')
    return panel


def picture(results):
    def plateau(t):
        return 1.0 if 0.0 <= t - GAP / SPEED <= 2.0 * LENGTH / WAVE_SPEED else 0.0

    speeds = (-150, -100, -50, 0, 50, 100, 150)
    panels = [
        curve_panel((70, 50, 890, 230), results, ("contact", "wall.force_z", PLATEAU), (0, 0.5, 1, 1.5),
                    "contact force over rho c v0 S", plateau),
        curve_panel((70, 370, 400, 230), results, ("probes", "N10.velocity_z", 1.0), speeds,
                    "velocity of the middle [m/s]", lambda t: exact_velocity(0.5 * LENGTH, t)),
        curve_panel((560, 370, 400, 230), results, ("probes", f"N{CELLS}.velocity_z", 1.0), speeds,
                    "velocity of the free end [m/s]", lambda t: exact_velocity(LENGTH, t)),
    ]
    legend = "".join(f'<rect x="{x}" y="656" width="22" height="4" fill="{colour}"/>'
                     f'<text x="{x + 28}" y="662" font-size="12">{name}</text>'
                     for x, colour, name in ((120, "#d7191c", MANUAL), (450, "#2c7bb6", BETTER)))
    legend += '<text x="780" y="662" font-size="12">dashed: exact</text>'
    body = "\n".join(part for panel in panels for part in panel.parts)
    return ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1000 680" font-family="sans-serif" font-size="13">\n'
            f'<rect width="1000" height="680" fill="#fff"/>\n{body}\n{legend}\n</svg>\n')


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    carom, out, svg = map(pathlib.Path, sys.argv[1:])
    results = {name: run(carom.resolve(), out / str(i), variant) for i, (name, variant) in enumerate(VARIANTS.items())}
    print("\n".join(table({name: measures(result) for name, result in results.items()})))
    svg.parent.mkdir(parents=True, exist_ok=True)
    svg.write_text(picture(results), encoding="utf-8")


if __name__ == "__main__":
    main()
