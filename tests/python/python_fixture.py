"""A case in memory, and a folder that goes away, for the tests of the Python module."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

os.environ.setdefault("OMP_WAIT_POLICY", "passive")

import carom

PROGRAM = os.environ["CAROM_PROGRAM"]


def falling_block(scheme="central_differences", end=1.0e-4, speed=-5.0):
    """A block that hits a plane soon after its start: about 60 explicit steps of 256 cells."""
    tree = {
        "title": "block", "units": "SI",
        "mesh": {"block": [{"origin": [0.0, 0.0, 5e-5], "size": [0.1, 0.1, 0.2], "divisions": [4, 4, 8],
                            "groups": {"cells": "BLOCK", "zmin": "FOOT", "zmax": "TOP"}}]},
        "materials": {"steel": {"law": "linear_elastic", "E": 2.1e11, "nu": 0.3, "rho": 7800.0}},
        "part": [{"name": "block", "cells": "BLOCK", "material": "steel"}],
        "initial": [{"part": "block", "velocity": [0.0, 0.0, speed]}],
        "contact": [{"name": "floor", "kind": "plane", "group": "FOOT", "point": [0.0, 0.0, 0.0],
                     "normal": [0.0, 0.0, 1.0], "measure": "area", "stiffness": 1.0e13}],
        "scheme": {"kind": scheme}, "time": {"end": end},
        "output": {"fields": ["displacement"], "fields_every": 10},
        "probe": [{"name": "top", "group": "TOP", "quantities": ["displacement", "velocity"]}]}
    if scheme != "central_differences":
        tree["time"]["step"] = end / 40
    return carom.Case(tree)


def on_a_bed(case, gap=5e-5):
    """Another block below, of other cells."""
    case["mesh"]["block"].append({"origin": [-0.01, -0.02, 5e-5 - gap - 0.1], "size": [0.13, 0.13, 0.1],
                                  "divisions": [3, 3, 2], "groups": {"cells": "BED", "zmax": "HEAD"}})
    case["part"].append({"name": "bed", "cells": "BED", "material": "steel"})
    return case


def resting_block(end=1.0e-4):
    """The same without contact and at rest, for loads and imposed motions."""
    case = falling_block(end=end)
    del case["contact"], case["initial"]
    return case


class FolderTest(unittest.TestCase):
    """With a temporary folder that is the working folder."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="carom_python_"))
        self.before = os.getcwd()
        os.chdir(self.folder)

    def tearDown(self):
        os.chdir(self.before)
        shutil.rmtree(self.folder)

    def command_line(self, case, out, *arguments):
        """Runs `carom run` on a case and returns its results folder."""
        pathlib.Path("cli.toml").write_text(case.resolved())
        subprocess.run([PROGRAM, "run", "cli.toml", "--out", out, "--quiet", *arguments], check=True)
        return pathlib.Path(out)
