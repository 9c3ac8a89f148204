"""Functions of time and observers that are Python's, and meshes from arrays."""

import gc
import math
import os
import pathlib
import pickle
import signal
import subprocess
import threading
import time
import unittest

import numpy as np

import carom
from carom.mesh import Mesh
from python_fixture import PROGRAM, FolderTest, falling_block, resting_block


class FunctionTest(FolderTest):
    def test_load_follows_the_callable(self):
        # Gravity g(t) = 1e4 sin(w t) on a free body: momentum m times its integral, by the trapezoidal rule of the steps.
        case = resting_block()
        w = 2 * math.pi / 1e-4
        case.function("pulse", lambda t: math.sin(w * t))
        case["load"] = [{"gravity": [0.0, 0.0, 1e4], "function": "pulse"}]
        run = case.start()
        times = [run.time]
        run.observe(lambda r: times.append(r.time))
        energy = run.finish().energy
        g = 1e4 * np.sin(w * np.array(times))
        momentum = 0.1 * 0.1 * 0.2 * 7800.0 * np.concatenate([[0], np.cumsum(0.5 * (g[1:] + g[:-1]) * np.diff(times))])
        np.testing.assert_allclose(energy["momentum_z"], momentum, rtol=0, atol=1e-11 * np.abs(momentum).max())

    def test_same_bits_as_the_table_of_a_linear_function(self):
        # On powers of two both compute the same product.
        case = resting_block()
        case["load"] = [{"gravity": [0.0, 0.0, 1024.0], "function": "ramp"}]
        case["functions"] = {"ramp": {"time": [0.0, 1.0], "value": [0.0, 1.0]}}
        table = case.start().finish().energy["kinetic"]
        case["functions"]["ramp"] = lambda t: t
        np.testing.assert_array_equal(case.start().finish().energy["kinetic"], table)

    def test_imposed_motions(self):
        # x = A (1 - cos w t) of one end, imposed as displacement, velocity and acceleration.
        w, A = 2 * math.pi / 1e-4, 1e-5
        functions = {"displacement": lambda t: A * (1 - math.cos(w * t)), "velocity": lambda t: A * w * math.sin(w * t),
                     "acceleration": lambda t: A * w * w * math.cos(w * t)}
        for kind, f in functions.items():
            for scheme in ("central_differences", "newmark"):
                case = resting_block()
                case["scheme"]["kind"] = scheme
                if scheme == "newmark":
                    case["time"]["step"] = 2.5e-6
                case.function("move", f)
                case["support"] = [{"nodes": "TOP", kind: {"z": 1.0, "function": "move"}}]
                result = case.start().finish()
                time = result.history["time"]
                exact = A * (1 - np.cos(w * time))
                np.testing.assert_allclose(result.history["top.displacement_z"], exact, rtol=0, atol=1e-7 * A,
                                           err_msg=f"{kind} {scheme}")
                self.assertLess(next(i["value"] for i in result.items if i["name"] == "energy balance"), 1e-10)

    def test_obstacle_moves_by_the_callable(self):
        case = falling_block()
        del case["initial"]
        case["contact"][0].update(velocity=[0.0, 0.0, 2.0], function="push")
        case.function("push", lambda t: 1.0 + 1e4 * t)
        run = case.start()
        run.finish()
        time = run.history["time"]
        np.testing.assert_allclose(run.history["floor.displacement_z"], 2.0 * (time + 0.5e4 * time**2), rtol=1e-12,
                                   atol=1e-18)

    def test_snapshots_with_callables(self):
        case = resting_block()
        case.function("pulse", lambda t: math.sin(1e5 * t))
        case["load"] = [{"gravity": [0.0, 0.0, 1e4], "function": "pulse"}]
        run = case.start()
        run.step(10)
        snapshot = run.save()
        first = run.finish().energy["kinetic"]
        run.restore(snapshot)
        np.testing.assert_array_equal(run.finish().energy["kinetic"], first)

    def test_resuming_is_refused(self):
        case = resting_block()
        case.function("pulse", lambda t: 1.0)
        case["load"] = [{"gravity": [0.0, 0.0, 1.0], "function": "pulse"}]
        run = case.start("out")
        run.step(5)
        run.stop()
        with self.assertRaisesRegex(carom.CaseError, "functions.pulse.*a program computes"):
            carom.resume("out")
        answer = subprocess.run([PROGRAM, "resume", "out"], capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 2)
        self.assertIn("a function that a program computes", answer.stderr)

    def test_errors_of_callables_come_out(self):
        for f, error in ((lambda t: 1 / 0 if t > 3e-5 else 1.0, ZeroDivisionError),
                         (lambda t: "one" if t > 3e-5 else 1.0, TypeError),
                         (lambda t: math.nan if t > 3e-5 else 1.0, ValueError)):
            case = resting_block()
            case.function("pulse", f)
            case["load"] = [{"gravity": [0.0, 0.0, 1.0], "function": "pulse"}]
            run = case.start()
            snapshot = run.save()
            with self.assertRaises(error):
                run.finish()
            with self.assertRaises(carom.RunError):
                run.step()
            run.restore(snapshot)
            run.step()
            self.assertEqual(run.stop().verdict, "stopped")

    def test_interrupt_within_a_callable_waits_for_the_step(self):
        def pulse(t):
            if t > 3e-5 and not sent:
                sent.append(t)
                os.kill(os.getpid(), signal.SIGINT)
            return math.sin(1e5 * t)
        sent = [0.0]
        case = resting_block()
        case.function("pulse", pulse)
        case["load"] = [{"gravity": [0.0, 0.0, 1e4], "function": "pulse"}]
        whole = case.start().finish().energy["kinetic"]
        sent.clear()
        run = case.start()
        with self.assertRaises(KeyboardInterrupt):
            run.finish()
        self.assertFalse(run.at_end)
        np.testing.assert_array_equal(run.finish().energy["kinetic"], whole)

    def test_a_run_is_not_stepped_from_its_own_step(self):
        case = resting_block()
        runs = []
        case.function("pulse", lambda t: runs[0].step() if runs else 1.0)
        case["load"] = [{"gravity": [0.0, 0.0, 1.0], "function": "pulse"}]
        runs.append(case.start())
        with self.assertRaisesRegex(RuntimeError, "middle of a step"):
            runs[0].step()


class ObserverTest(FolderTest):
    def test_every_step_every_tenth_and_the_last(self):
        run = falling_block().start()
        all_steps, tenth = [], []
        run.observe(lambda r: all_steps.append(r.steps))
        run.observe(lambda r: tenth.append(r.steps), every=10)
        run.finish()
        self.assertEqual(all_steps, list(range(1, run.steps + 1)))
        self.assertEqual(tenth, sorted({*range(10, run.steps + 1, 10), run.steps}))

    def test_observers_are_let_go_of(self):
        run = falling_block().start()
        seen = []

        def look(r):
            seen.append(r.steps)
            raise ArithmeticError

        run.observe(look, every=2)
        with self.assertRaises(ArithmeticError):
            run.step(5)
        run.unobserve(look)
        run.step(3)
        self.assertEqual(seen, [2])
        with self.assertRaises(ValueError):
            run.unobserve(look)

    def test_numbers_that_mean_nothing_are_refused(self):
        run = falling_block().start()
        for call in (lambda: run.step(-3), lambda: run.until(float("nan")), lambda: falling_block().start(threads=-5)):
            with self.assertRaises(ValueError):
                call()
        self.assertEqual(run.steps, 0)

    def test_observers_change_no_bits_and_may_hold_views(self):
        plain = falling_block().start().finish()
        run = falling_block().start()
        kept = []

        @run.observe
        def look(r):
            kept.append(r.velocity)

        result = run.finish()
        np.testing.assert_array_equal(plain.energy["kinetic"], result.energy["kinetic"])
        top = run.mesh.nodes_of("TOP")
        means = [v[top][:, 2].mean() for v in kept]
        np.testing.assert_allclose(means, result.history["top.velocity_z"][1:], rtol=1e-13)

    def test_an_observer_that_refers_to_its_run_does_not_keep_it(self):
        run = falling_block().start("out")
        run.observe(lambda _: run.time)
        run.step()
        del run
        gc.collect()
        falling_block().start("out").stop()  # not locked any more

    def test_another_thread_sees_how_far_it_is(self):
        run = falling_block(end=2e-3).start(threads=1)
        done, read = threading.Semaphore(0), threading.Semaphore(0)

        @run.observe
        def wait(r):  # after each of the first three steps, until the other thread has read
            if r.steps <= 3:
                done.release()
                read.acquire(timeout=60)

        thread = threading.Thread(target=run.finish)
        thread.start()
        seen = []
        for _ in range(3):
            self.assertTrue(done.acquire(timeout=60))
            seen.append(run.steps)
            read.release()
        while thread.is_alive():
            time.sleep(0.001)
            try:
                run.history
            except RuntimeError as error:
                self.assertIn("middle of a step", str(error))
        self.assertEqual(seen, [1, 2, 3])
        self.assertGreaterEqual(run.time, 2e-3 * (1 - 1e-12))

    def test_what_an_observer_raises_comes_out_after_the_step(self):
        whole = falling_block().start().finish().energy["kinetic"]
        run = falling_block().start()

        @run.observe
        def stop(r):
            if r.steps == 7:
                raise LookupError("seven")

        with self.assertRaises(LookupError):
            run.finish()
        self.assertEqual(run.steps, 7)
        np.testing.assert_array_equal(run.finish().energy["kinetic"], whole)


def two_cells():
    """Two hexahedra on top of each other, faces of the ends."""
    points = [[x, y, z] for z in (0.0, 1.0, 2.0) for y in (0.0, 1.0) for x in (0.0, 1.0)]
    cells = {"hexa8": [[0, 1, 3, 2, 4, 5, 7, 6], [4, 5, 7, 6, 8, 9, 11, 10]], "quad4": [[0, 2, 3, 1], [8, 9, 11, 10]]}
    return Mesh(points, cells, node_groups={"EDGE": [8, 9]},
                cell_groups={"BODY": [0, 1], "UPPER": {"hexa8": [1]}, "FOOT": {"quad4": [0]}, "HEAD": {"quad4": [1]}})


def case_of(mesh):
    case = carom.Case({"units": "SI", "materials": {"soft": {"law": "linear_elastic", "E": 2.0, "nu": 0.3, "rho": 1.5}},
                       "part": [{"name": "body", "cells": "BODY", "material": "soft"}],
                       "support": [{"nodes": "FOOT", "blocked": ["x", "y", "z"]}],
                       "load": [{"group": "HEAD", "pressure": 0.01}], "scheme": {"kind": "central_differences"},
                       "time": {"end": 10.0}, "probe": [{"name": "head", "node": 9, "quantities": ["displacement"]}]})
    case.mesh = mesh
    return case


class MeshTest(FolderTest):
    def test_arrays_make_the_mesh_and_the_folder_can_be_gone_on_from(self):
        case = case_of(two_cells())
        whole = case.start().finish()
        run = case.start("out")
        self.assertEqual(sorted(run.mesh.cell_groups), ["BODY", "FOOT", "HEAD", "UPPER"])
        self.assertEqual(list(run.mesh.node_groups), ["EDGE"])
        np.testing.assert_allclose(run.mesh.points[run.mesh.nodes_of("EDGE")], [[0, 0, 2], [1, 0, 2]])
        run.step(2)
        run.stop()
        np.testing.assert_array_equal(carom.resume("out").finish().energy["strain"], whole.energy["strain"])
        subprocess.run([PROGRAM, "run", "out/case.resolved.toml", "--out", "again", "--quiet"], check=True)
        self.assertEqual(pathlib.Path("again/energy.csv").read_text(), pathlib.Path("out/energy.csv").read_text())

    def test_quadratic_cells_keep_their_order(self):
        # Rows of a TETRA10 in VTK's order: mid-side nodes on 01, 12, 02, 03, 13, 23.
        corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        sides = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
        points = np.vstack([corners, [(corners[a] + corners[b]) / 2 for a, b in sides]])
        mesh = Mesh(points, {"tetra10": [range(10)]}, cell_groups={"BODY": [0]})
        case = case_of(mesh)
        del case["support"], case["load"]
        case["initial"] = [{"part": "body", "velocity": [1.0, 0.0, 0.0]}]
        run = case.start()
        row = run.mesh.cells["tetra10"][0]
        x = run.mesh.points[row]
        for i, (a, b) in enumerate(sides):
            np.testing.assert_allclose(x[4 + i], (x[a] + x[b]) / 2)
        self.assertAlmostEqual(run.energy["momentum_x"][0], 1.5 / 6, delta=1e-14)

    def test_wrong_arrays(self):
        good = two_cells()
        wrong = [({"points": [[0.0, 1.0]]}, carom.CaseError), ({"cells": {"hexa9": [[0]]}}, carom.CaseError),
                 ({"cells": {"hexa8": [[0, 1, 2, 3, 4, 5, 6, 99]]}}, carom.CaseError),
                 ({"cells": {"hexa8": [[0, 1]]}}, carom.CaseError),
                 ({"cells": {"hexa8": [[0.5] * 8]}}, TypeError),
                 ({"node_groups": {"A+B": [0]}}, carom.CaseError), ({"node_groups": {"A": [-1]}}, carom.CaseError),
                 ({"cell_groups": {"A": {"tetra4": [0]}}}, carom.CaseError),
                 ({"points": np.full((12, 3), np.nan)}, carom.CaseError)]
        for change, error in wrong:
            given = {"points": good.points, "cells": good.cells, "node_groups": {}, "cell_groups": {}, **change}
            with self.assertRaises(error, msg=str(change)):
                case_of(None).mesh = Mesh(**given)

    def test_missing_packages_are_named(self):
        for module, convert in (("meshio", two_cells().to_meshio), ("pyvista", two_cells().to_pyvista)):
            try:
                __import__(module)
            except ImportError:
                with self.assertRaisesRegex(ImportError, "not installed"):
                    convert()
            else:  # with all groups, where it is there
                self.assertEqual(len(convert().points), 12)
                if module == "meshio":
                    again = Mesh.from_meshio(convert())
                    self.assertEqual(sorted(again.cell_groups), ["BODY", "FOOT", "HEAD", "UPPER"])
                    np.testing.assert_array_equal(again.nodes_of("HEAD"), two_cells().nodes_of("HEAD"))

    def test_from_meshio(self):
        class Block:
            def __init__(self, type, data):
                self.type, self.data = type, np.array(data)

        class Meshio:  # as meshio.Mesh has it
            points = two_cells().points
            cells = [Block("hexahedron", two_cells().cells["hexa8"][:1]), Block("quad", two_cells().cells["quad4"]),
                     Block("hexahedron", two_cells().cells["hexa8"][1:])]
            point_sets = {"EDGE": np.array([8, 9])}
            cell_sets = {"BODY": [np.array([0]), np.array([], dtype=int), np.array([0])],
                         "HEAD": [None, np.array([1]), None], "FOOT": [None, np.array([0]), None]}

        case = case_of(Mesh.from_meshio(Meshio))
        np.testing.assert_array_equal(case.start().finish().energy["strain"],
                                      case_of(two_cells()).start().finish().energy["strain"])

    def test_read_mesh(self):
        case_of(two_cells()).start("out").stop()
        mesh = carom.read_mesh("out/case.mesh.msh")
        self.assertEqual({name: len(rows) for name, rows in mesh.cells.items()}, {"hexa8": 2, "quad4": 2, "point1": 2})
        with self.assertRaises(carom.CaseError):
            carom.read_mesh("nowhere.msh")

    def test_cases_can_be_copied_and_sent(self):
        case = case_of(two_cells())
        copy = pickle.loads(pickle.dumps(case))
        copy["time"]["end"] = 2.0
        self.assertEqual((case.end, copy.end), (10.0, 2.0))
        self.assertEqual(copy.copy().start().mesh.points.shape, (12, 3))


if __name__ == "__main__":
    unittest.main()
