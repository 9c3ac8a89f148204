"""Shows a parameter study: one case, several speeds of impact, the largest contact force of each.

The case is read once; every run is started from it as it is at that moment and writes nothing.
"""

import pathlib

import carom

case = carom.load(pathlib.Path(__file__).with_name("falling_block.toml"))

print("speed m/s   largest force kN   force / speed kN s/m")
forces = {}
for speed in (1.0, 2.0, 4.0, 8.0):
    case["initial"][0]["velocity"] = [0.0, 0.0, -speed]
    result = case.start().finish()
    if result.verdict != "good":
        raise SystemExit(f"{speed} m/s: {result.message}")
    forces[speed] = result.history["floor.force_z"].max()
    print(f"{speed:9.1f}   {forces[speed] / 1e3:16.1f}   {forces[speed] / speed / 1e3:20.1f}")

# An elastic body answers in proportion, but for the gap, which is closed earlier by a faster body.
assert abs(forces[8.0] / forces[4.0] - 2.0) < 0.1
