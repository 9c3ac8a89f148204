"""Shows how to go back and branch: a run is saved while its block touches the floor, and goes on from there twice.

The first branch is the case as it is; in the second, a function of time that is Python's pushes the block from that
moment on. A snapshot brings everything back, so the first branch has the bits of a run that was never saved.
"""

import pathlib

import numpy as np

import carom

case = carom.load(pathlib.Path(__file__).with_name("falling_block.toml"))
push = {"since": np.inf}
case.function("push", lambda t: 1.0 if t > push["since"] else 0.0)
case["load"] = [{"gravity": [0.0, 0.0, -2.0e5], "function": "push"}]

run = case.start()
while not run.contact["floor"].closed:
    run.step()
snapshot = run.save()
print("saved:", run, f"({snapshot.nbytes / 1024:.0f} KiB)")
free = run.finish()

push["since"] = snapshot.time
run.restore(snapshot)
pushed = run.finish()

for name, result in (("free", free), ("pushed", pushed)):
    print(f"{name:7s} floor's impulse {result.history['floor.impulse_z'][-1]:7.2f} N s, "
          f"leaves at {result.history['top.velocity_z'][-1]:6.3f} m/s")
push["since"] = np.inf
never_saved = case.start().finish()
assert np.array_equal(free.energy["kinetic"], never_saved.energy["kinetic"])
assert pushed.history["floor.impulse_z"][-1] > free.history["floor.impulse_z"][-1]
