#!/usr/bin/env python3
"""Run the impact bar and the bouncing bar with every scheme, on a rigid wall and on penalties: print the table of
docs/schemes.md.

    python3 tools/impact_bar_table.py build/release/carom out/impact_bar

The bars are those of cases/impact_bar/rigid_wall.toml and twenty_impacts.toml, 100 cells, with another [scheme] and
[time]. Measured:
  L2        of the contact force minus the exact one over that of the exact one, both at the ends of the steps; where
            the exact force jumps there, it has jumped;
  peak      greatest contact force over the exact one;
  E, 1      mechanical energy at t = 3 over that of the start, one impact;
  E, 20     the same for the bouncing bar after ten periods, twenty impacts; the potential energy is zero for the bar
            that stands on the wall undeformed.
Standard library only.
"""

import json
import math
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sdnv100_better import read_columns, section  # noqa: E402

CASES = pathlib.Path(__file__).resolve().parents[1] / "cases" / "impact_bar"
CROSSING = 10.0 / 100 / 30.0  # time that a wave needs for a cell
SPRING = 900.0 / 0.1  # E / h
TOUCH, LEAVE, FORCE = 0.5, 0.5 + 2.0 * 10.0 / 30.0, 3.0
PERIOD, BOUNCE_ENERGY = 16.0 / 3.0, 0.05

MULTIPLIERS, PLAIN = '\nenforcement = "lagrange"', '\nenforcement = "plain"'
# name: scheme, Courant number, stiffness of the wall (None: rigid); L2, peak, E 1, E 20 of an earlier, independent
# computation of the same scheme and contact in one dimension, where there is one.
VARIANTS = {
    "Newmark 0.28, 0.55": ('kind = "newmark"\nbeta = 0.28\ngamma = 0.55' + MULTIPLIERS, 1.0, None, None),
    "Newmark 0.28, 0.55, plain": ('kind = "newmark"\nbeta = 0.28\ngamma = 0.55' + PLAIN, 1.0, None,
                                  ("0.253", "2.18", "0.954", "0")),
    "HHT -0.2": ('kind = "hht"\nalpha = -0.2' + MULTIPLIERS, 1.0, None, None),
    "HHT -0.2, plain": ('kind = "hht"\nalpha = -0.2' + PLAIN, 1.0, None, ("0.181", "2.04", "0.981", "0.117")),
    "generalised-alpha, rho_inf 0.5": ('kind = "generalized_alpha"\nrho_inf = 0.5' + MULTIPLIERS, 1.0, None, None),
    "generalised-alpha, rho_inf 0.5, plain": ('kind = "generalized_alpha"\nrho_inf = 0.5' + PLAIN, 1.0, None,
                                              ("0.110", "1.50", "0.980", "0.115")),
    "Bathe composite": ('kind = "bathe"' + MULTIPLIERS, 1.0, None, None),
    "Bathe composite, plain": ('kind = "bathe"' + PLAIN, 1.0, None, ("0.117", "1.75", "0.988", "0.165")),
    "contact-stabilised Newmark, lumped": ('kind = "contact_stabilized_newmark"\nmass = "lumped"', 1.0, None,
                                           ("0.101", "1.12", "0.994", "0.251")),
    "Moreau-Jean, theta 1/2, e 0, lumped": ('kind = "moreau_jean"\nmass = "lumped"', 1.0, None,
                                            ("0.097", "1.06", "0.993", "0.360")),
    "nonsmooth generalised-alpha, rho_inf 0.8": ('kind = "nonsmooth_generalized_alpha"\nrho_inf = 0.8', 1.0, None, None),
    "nonsmooth generalised-alpha, rho_inf 0.5": ('kind = "nonsmooth_generalized_alpha"\nrho_inf = 0.5', 1.0, None, None),
    "energy-momentum, penalty E/h": ('kind = "energy_momentum"', 1.0, SPRING, None),
    "modified mass (1 layer) and Newmark 1/4": ('kind = "newmark"\nmass = "modified"\nlayers = 1' + MULTIPLIERS, 1.0,
                                                None, ("0.099", "1.34", "1.00007", "0.933")),
    "modified mass, semi-explicit, 1 layer": ('kind = "modified_mass"\nlayers = 1', 0.9, None,
                                              ("0.065", "1.30", "0.99909", "0.9955")),
    "modified mass, semi-explicit, 4 layers": ('kind = "modified_mass"\nlayers = 4', 0.9, None, None),
    "central differences, penalty E/h": ('kind = "central_differences"', 0.8, SPRING,
                                         ("0.116", "1.14", "0.9995", "1.038")),
    "forward-increment multipliers": ('kind = "forward_increment"', 0.9, None, ("0.074", "1.04", "0.9943", "0.176")),
    "CD-Lagrange": ('kind = "cd_lagrange"', 0.9, None, ("0.048", "1.07", "0.9966", "0.691")),
}
EXPLICIT = ("modified_mass", "central_differences", "forward_increment", "cd_lagrange")


def is_explicit(scheme):
    return any(f'kind = "{kind}"' in scheme for kind in EXPLICIT)


def case_text(base, scheme, step, steps, stiffness, rows_every=1):
    """A case of cases/impact_bar with that scheme, `steps` of `step`, without its checks."""
    text = (CASES / base).read_text(encoding="utf-8").partition("[[check]]")[0].partition("\n[exact]")[0]
    text = section(text, "scheme", scheme)
    text = section(text, "time", f"end = {steps * step!r}\nstep = {step!r}"
                   + ("" if is_explicit(scheme) else "\nfixed = true"))
    text = section(text, "output", f"fields_every = {10 * steps}\ncurves_every = {rows_every}")
    if not is_explicit(scheme):
        text += '\n[solver]\nkind = "cholmod"\n'
    if stiffness is not None:
        text = text.replace("normal = [0.0, 0.0, 1.0]", f"normal = [0.0, 0.0, 1.0]\nstiffness = {stiffness}")
    return text


def run(carom, folder, text):
    """Runs a case; returns {file: columns}. What stops it is raised."""
    folder.mkdir(parents=True, exist_ok=True)
    case = folder / "case.toml"
    case.write_text(text, encoding="utf-8")
    # 1: ended, and the verdict failed, as it does on penetration and dissipation here.
    done = subprocess.run([str(carom), "run", str(case), "--out", str(folder / "out"), "--quiet"], capture_output=True,
                          text=True, check=False)
    if done.returncode not in (0, 1):
        summary = folder / "out" / "summary.json"
        reason = json.loads(summary.read_text(encoding="utf-8"))["message"] if summary.exists() else done.stderr
        raise RuntimeError(f"{case}: {reason}")
    return {name: read_columns(folder / "out" / f"{name}.csv") for name in ("probes", "contact", "energy")}


def impact(carom, folder, scheme, courant, stiffness):
    step = courant * CROSSING
    return run(carom, folder, case_text("rigid_wall.toml", scheme, step, round(3.0 / step), stiffness))


def bounces(carom, folder, scheme, courant, stiffness):
    step = courant * CROSSING
    steps = math.ceil(10.0 * PERIOD / step - 1.0e-6)
    return run(carom, folder, case_text("twenty_impacts.toml", scheme, step, steps, stiffness, 20))


def exact_force(t):
    s = t + 1.0e-9
    return FORCE if TOUCH <= s < LEAVE else 0.0


def mechanical(energy):
    """Kinetic, strain and contact energy minus the work of gravity, row by row."""
    return [k + s + c - w for k, s, c, w in zip(energy["kinetic"], energy["strain"], energy["contact_stored"],
                                                energy["external_work"])]


def impact_measures(results):
    contact = results["contact"]
    exact = [exact_force(t) for t in contact["time"]]
    energy = mechanical(results["energy"])
    square = sum((f - e)**2 for f, e in zip(contact["wall.force_z"], exact))
    return {"L2": math.sqrt(square / sum(e * e for e in exact)),
            "peak": max(contact["wall.force_z"]) / FORCE, "E1": energy[-1] / energy[0]}


def bounce_measures(results):
    """`last`: least energy over the last of the ten periods."""
    energy = [1.0 + e / BOUNCE_ENERGY for e in mechanical(results["energy"])]
    times = results["energy"]["time"]
    return {"E20": energy[-1], "last": min(e for t, e in zip(times, energy) if t >= 9.0 * PERIOD),
            "penetration": max(results["contact"]["wall.penetration"]),
            "balance": max(map(abs, results["energy"]["imbalance"])) / BOUNCE_ENERGY}


def measures(carom, folder, scheme, courant, stiffness):
    return {**impact_measures(impact(carom, folder, scheme, courant, stiffness)),
            **bounce_measures(bounces(carom, folder, scheme, courant, stiffness))}


FORMATS = (("L2", "{:.3f}"), ("peak", "{:.2f}"), ("E1", "{:.4f}"), ("E20", "{:.3f}"))


def table(found):
    """Lines of the table of docs/schemes.md: measured, and the earlier computation in brackets."""
    lines = ["| scheme and contact | Courant | L2 | peak | E, 1 | E, 20 |", "|---|---|---|---|---|---|"]
    for name, m in found.items():
        _, courant, _, earlier = VARIANTS[name]
        cells = [form.format(m[key]) + (f" ({earlier[i]})" if earlier else "")
                 for i, (key, form) in enumerate(FORMATS)]
        lines.append(f"| {name} | {courant:g} | {' | '.join(cells)} |")
    return lines


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    carom, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    found = {name: measures(carom, out / str(i), *variant[:3]) for i, (name, variant) in enumerate(VARIANTS.items())}
    print("\n".join(table(found)))


if __name__ == "__main__":
    main()
