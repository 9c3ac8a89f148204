"""Shows how to draw: contact force and energies of a run, into block.png in the working folder."""

import pathlib

import matplotlib
matplotlib.use("Agg")  # no screen is needed
import matplotlib.pyplot as plt

import carom

result = carom.load(pathlib.Path(__file__).with_name("falling_block.toml")).start().finish()
history, energy = result.history, result.energy

figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(7, 6))
above.plot(1e6 * history["time"], history["floor.force_z"] / 1e3)
above.set_ylabel("force of the floor, kN")
for name in ("kinetic", "strain", "contact_stored"):
    below.plot(1e6 * energy["time"], energy[name], label=name.replace("_", " "))
below.set_xlabel("time, microseconds")
below.set_ylabel("energy, J")
below.legend()
figure.suptitle(f"{result.summary['case']['title']}: {result.verdict}")
figure.savefig("block.png", dpi=100)
print("block.png")
