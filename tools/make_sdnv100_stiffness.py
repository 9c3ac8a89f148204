#!/usr/bin/env python3
"""Write the sweep of the contact stiffness, cases/sdnv100/stiffness/E_n_1e12.toml to E_n_1e16.toml.

    python3 tools/make_sdnv100_stiffness.py

Each is cases/sdnv100/as_published.toml with another stiffness and checks of its own, whose reference values come from
the one-dimensional program in tests/verification/reference_1d. Standard library only.
"""

import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "verification" / "reference_1d"))

import sdnv100_reference as reference  # noqa: E402

EXPONENTS = (12, 13, 14, 15, 16)
POINTS = [("displacement_z", "A", "4.0e-5"), ("displacement_z", "B", "8.0e-5"), ("velocity_z", "A", "8.0e-5"),
          ("velocity_z", "B", "1.2e-4")]
# A velocity that swings through zero is compared to its own size, the speed of the impact, not to its momentary value.
TOLERANCE = {"displacement_z": "1e-11", "velocity_z": "1e-6"}
TOLERANCE_REASON = "absolute: 5e-9 of the gap and 1e-8 of the speed"


def check(quantity, place, time, value):
    return "\n".join([
        "[[check]]",
        f'quantity = "{quantity}"',
        f'place = "{place}"',
        f"time = {time}",
        f"value = {value:.12g}",
        f"tolerance = {TOLERANCE[quantity]}",
        "absolute = true",
        f'source = "independent 1-D computation, tests/verification/reference_1d; {TOLERANCE_REASON}"',
        "",
    ])


def checks(stiffness):
    history, _ = reference.run(*reference.as_published(stiffness))
    blocks = []
    for quantity, place, time in POINTS:
        displacement, velocity, _ = history[round(float(time) / reference.DT)]
        field = displacement if quantity == "displacement_z" else velocity
        blocks.append(check(quantity, place, time, field[0 if place == "A" else -1]))
    return "\n".join(blocks)


def case_text(published, exponent):
    body = published[:published.index("[[check]]")]
    body = body[body.index("[mesh]"):]
    head = [
        f"# SDNV100 as published, with the contact stiffness 1e{exponent} Pa/m: one of the sweep that shows how",
        "# a stiffer contact improves the displacements and makes the velocities oscillate. Written by",
        "# tools/make_sdnv100_stiffness.py from as_published.toml.",
        f'title = "SDNV100, contact stiffness 1e{exponent} Pa/m"',
        'units = "SI"',
        "", "",
    ]
    body = body.replace('file = "as_published.msh"', 'file = "../as_published.msh"')
    if body.count("stiffness = 1.0e14") != 2:
        raise ValueError("as_published.toml should name its stiffness twice: in [[contact]] and in [exact]")
    body = body.replace("stiffness = 1.0e14", f"stiffness = 1.0e{exponent}")
    return "\n".join(head) + body + checks(10.0**exponent)


def main():
    folder = ROOT / "cases" / "sdnv100"
    published = (folder / "as_published.toml").read_text(encoding="utf-8")
    for exponent in EXPONENTS:
        path = folder / "stiffness" / f"E_n_1e{exponent}.toml"
        path.parent.mkdir(exist_ok=True)
        path.write_text(case_text(published, exponent), encoding="utf-8")


if __name__ == "__main__":
    main()
