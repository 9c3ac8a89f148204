#!/usr/bin/env python3
"""Kills a run of carom at random moments (kill -9) and goes on with it, again and again, until it has ended; all files
of its folder must then be those of the run that nobody disturbed, byte for byte, but for costs.

    tools/kill_resume.py [PROGRAM] [--kills 50] [--seed 1] [--case FILE] [--signal TERM]

The run of its own: a block that falls, turning, on another one, with friction, and both yield; explicit steps,
a checkpoint every 25 steps, one thread and two by turns. Moments are drawn evenly over the time that the run takes, set-up
and the writing of checkpoints included. --signal TERM asks the run to stop instead (as Ctrl-C does), which leaves a checkpoint where
a case asks for none. Exit code 1 with what differs.
"""
import argparse
import json
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

CASE = """units = "SI"
title = "A block falls, turning, on another one"
[[mesh.block]]
size = [0.08, 0.08, 0.04]
divisions = [6, 6, 3]
groups = { cells = "LOWER", zmax = "TOP", zmin = "GROUND" }
[[mesh.block]]
origin = [0.015, 0.02, 0.0402]
size = [0.04, 0.04, 0.04]
divisions = [4, 4, 4]
groups = { cells = "UPPER", zmin = "FACE" }
[materials.soft]
law = "j2"
E = 2e7
nu = 0.3
rho = 1200.0
yield_stress = 2e5
hardening_modulus = 2e6
[[part]]
name = "lower"
cells = "LOWER"
material = "soft"
[[part]]
name = "upper"
cells = "UPPER"
material = "soft"
[[support]]
nodes = "GROUND"
blocked = ["x", "y", "z"]
[[initial]]
part = "upper"
velocity = [3.0, 1.0, -6.0]
[[contact]]
name = "touch"
kind = "pair"
group = "FACE"
master = "TOP"
friction = 0.3
[[probe]]
name = "face"
group = "FACE"
quantities = ["displacement", "velocity", "acceleration", "stress"]
[scheme]
kind = "central_differences"
[time]
end = 1.2e-3
[output]
fields_every = 40
checkpoint_every = 25
"""
APART = ("report.html",)  # made of the other files, with the costs


def contents(folder):
    """Every file but the checkpoints, and the costs of the summary and its number of threads left out."""
    files = {}
    for path in sorted(folder.rglob("*")):
        if path.is_dir() or path.name in APART or path.parent.name == "checkpoints":
            continue
        data = path.read_bytes()
        if path.name == "summary.json":
            summary = json.loads(data)
            summary.pop("cost")
            summary["program"].pop("threads")
            data = json.dumps(summary).encode()
        files[str(path.relative_to(folder))] = data
    return files


def differences(expected, found):
    return [name for name in sorted(expected.keys() | found.keys()) if expected.get(name) != found.get(name)]


class Runs:
    def __init__(self, program, case, seed, kill):
        self.program, self.case, self.random, self.kill = program, case, random.Random(seed), kill
        self.threads = 1

    def command(self, folder, resume):
        self.threads = 3 - self.threads
        what = ["resume", str(folder)] if resume else ["run", str(self.case), "--out", str(folder)]
        return [self.program, *what, "--quiet", "--threads", str(self.threads)]

    def killed_after(self, folder, resume, seconds):
        """True when the kill came before the end."""
        with subprocess.Popen(self.command(folder, resume), stderr=subprocess.PIPE, text=True) as process:
            try:
                process.wait(seconds)
            except subprocess.TimeoutExpired:
                process.send_signal(self.kill)
                process.wait()
            message = process.stderr.read()
        if process.returncode == -self.kill or "goes on from there" in message:
            return True
        is_over = resume and "the run has come to its end" in message  # killed when all was done
        if process.returncode in (0, 1) or is_over:  # the end, whatever the verdict
            return False
        if resume and "there is no checkpoint in it" in message:
            return self.killed_after(folder, False, seconds)
        raise SystemExit(f"{'resume' if resume else 'run'} ended with {process.returncode}: {message}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default="build/release/carom")
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--case", type=pathlib.Path)
    parser.add_argument("--signal", choices=("KILL", "TERM"), default="KILL")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        base = pathlib.Path(name)
        case = options.case or base / "case.toml"
        if not options.case:
            case.write_text(CASE)
        runs = Runs(options.program, case, options.seed, signal.Signals[f"SIG{options.signal}"])
        begin = time.monotonic()
        if runs.killed_after(base / "whole", False, None):
            raise SystemExit("cannot be")
        length = time.monotonic() - begin
        expected = contents(base / "whole")
        kills = ended = 0
        while kills < options.kills or ended == 0:
            folder, resume = base / "killed", False
            shutil.rmtree(folder, ignore_errors=True)
            mine = 0
            while runs.killed_after(folder, resume, runs.random.uniform(0.0, 0.7 * length) if kills < options.kills else None):
                kills, mine, resume = kills + 1, mine + 1, (folder / "case.resolved.toml").exists()
            ended += 1
            found = differences(expected, contents(folder))
            print(f"run {ended}: killed {mine} times, {'differs in ' + ', '.join(found) if found else 'the same files'}", flush=True)
            if found:
                return 1
        print(f"{kills} kills, {ended} runs of {length:.1f} s, {len(expected)} files each: all as undisturbed (seed {options.seed})")
    return 0


if __name__ == "__main__":
    sys.exit(main())
