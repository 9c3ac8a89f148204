"""Shows observers: what no probe records is looked at after steps, in the arrays of the run itself.

One observer follows the front of the wave that runs up the block after the impact, from the velocities of all nodes;
another takes a picture of the displacements every 20 steps. Both see views, not copies: numpy sums where the solver
keeps its numbers. A view that is kept shows its own instant for ever.
"""

import pathlib

import numpy as np

import carom

case = carom.load(pathlib.Path(__file__).with_name("falling_block.toml"))
case["mesh"]["block"][0]["divisions"] = [4, 4, 40]
run = case.start()
height = run.mesh.points[:, 2] - run.mesh.points[:, 2].min()
front, pictures = [], []


@run.observe
def follow(run):
    slowed = run.velocity[:, 2] > -1.0  # half of the speed of the fall
    front.append((run.time, height[slowed].max() if slowed.any() else 0.0))


run.observe(lambda run: pictures.append(run.displacement), every=20)
result = run.finish()

time, place = np.array(front).T
rises = (place > 0.05) & (place < 0.15)
rises &= np.arange(len(time)) < np.argmax(place)
speed = np.polyfit(time[rises], place[rises], 1)[0]
print(f"{len(pictures)} pictures of {pictures[0].shape[0]} nodes; the wave runs up at {speed:.0f} m/s")
bar, dilatational = np.sqrt(2.1e11 / 7800.0), np.sqrt(2.1e11 * 0.7 / (1.3 * 0.4) / 7800.0)
assert 0.9 * bar < speed < 1.1 * dilatational
