"""Runs from Python: the command line's bits, stepping, snapshots, views, errors, signals, threads."""

import gc
import json
import os
import pathlib
import signal
import subprocess
import threading
import time
import unittest

import numpy as np

import carom
from python_fixture import PROGRAM, FolderTest, falling_block, resting_block

TABLES = ("energy.csv", "contact.csv", "probes.csv", "parts.csv")


def text(path):
    return pathlib.Path(path).read_text()


class LibraryTest(FolderTest):
    def test_law_of_a_library(self):
        """Of a tree without a file, paths are those from the working folder. The bits may differ by what is fused."""
        source = pathlib.Path(os.environ["CAROM_SOURCE"])
        subprocess.run([os.environ["CAROM_COMPILER"], "-std=c++20", "-O2", "-fPIC", "-shared", "-Wno-psabi",
                        f"-I{source / 'src/material'}", "-o", "laws.so", source / "examples/laws/laws.cpp"], check=True)
        tops = []
        for law in ({"law": "neo_hookean"}, {"library": "laws.so", "law": "neo"}):
            case = falling_block()
            case["materials"]["steel"] = {**law, "E": 2.1e11, "nu": 0.3, "rho": 7800.0}
            tops.append(case.start().finish().history["top.velocity_z"])
        np.testing.assert_allclose(tops[0], tops[1], rtol=0, atol=1e-9 * 5.0)
        case["materials"]["steel"]["law"] = "old"
        with self.assertRaises(carom.CaseError) as error:
            case.start()
        self.assertEqual(error.exception.key, "materials.steel.law")


class DeckTest(FolderTest):
    def test_notes_of_a_deck_are_those_of_check_and_run(self):
        deck = pathlib.Path(__file__).resolve().parent.parent / "data/decks/two_bars.inp"
        told = subprocess.run([PROGRAM, "check", deck], capture_output=True, text=True, check=False).stdout
        case = carom.load(deck)
        notes = case.check().notes
        self.assertGreater(len(notes), 2)
        for note in notes:
            self.assertIn(f"note: {note}", told)
        run = case.start("out")
        run.step()
        run.stop()
        summary = json.loads(pathlib.Path("out/summary.json").read_text(encoding="utf-8"))
        self.assertTrue(set(notes) <= set(summary["notes"]))

    def test_losses_are_accepted_by_name(self):
        deck = pathlib.Path(__file__).resolve().parent.parent / "data/decks/two_bars.inp"
        lossy = pathlib.Path("lossy.inp")
        lossy.write_text(deck.read_text(encoding="utf-8").replace("*Step", "*MPC\n1\n*Step", 1), encoding="utf-8")
        with self.assertRaises(carom.CaseError):
            carom.load(lossy)
        self.assertTrue(any("MPC" in note for note in carom.load(lossy, accept=["*MPC"]).check().notes))


class BitsTest(FolderTest):
    def assert_same(self, one, other):
        for table in TABLES:
            self.assertEqual(text(f"{one}/{table}"), text(f"{other}/{table}"), table)

    def test_folder_from_the_start_and_at_the_end_as_the_command_line(self):
        # Explicit steps; Newmark with contact by penalty, which factors matrices by CHOLMOD and BLAS.
        for scheme in ("central_differences", "newmark"):
            case = falling_block(scheme)
            self.command_line(case, "cli", "--threads", "1")
            self.assertEqual(case.start("early", threads=2).finish().verdict, "good")
            case.start(threads=2).finish("late")
            self.assert_same("cli", "early")
            self.assert_same("cli", "late")
            early = sorted(p.relative_to("early") for p in pathlib.Path("early").rglob("*"))
            self.assertEqual(early, sorted(p.relative_to("cli") for p in pathlib.Path("cli").rglob("*")))

    def test_result_holds_what_the_files_hold(self):
        result = falling_block().start("out").finish()
        for table, curves in (("energy", result.energy), ("probes", result.history), ("contact", result.history),
                              ("parts", result.parts)):
            header, *rows = [line.split(",") for line in text(f"out/{table}.csv").splitlines() if line[0] != "#"]
            for name, column in zip(header, np.array(rows, dtype=float).T):
                np.testing.assert_array_equal(curves[name], column, name)
        self.assertEqual(result.folder, "out")
        with self.assertRaisesRegex(KeyError, "top.velocity_z"):
            result.history["top.speed"]

    def test_nothing_is_written_without_a_folder(self):
        result = falling_block().start().finish()
        self.assertEqual(list(self.folder.iterdir()), [])
        self.assertEqual(result.folder, "")

    def test_resume(self):
        case = falling_block()
        whole = case.start().finish()
        run = case.start("out")
        run.step(20)
        self.assertEqual(run.stop().verdict, "stopped")
        resumed = carom.resume("out", threads=1)
        self.assertEqual(resumed.steps, 20)
        result = resumed.finish()
        for name in whole.energy:
            np.testing.assert_array_equal(whole.energy[name], result.energy[name], name)
        with self.assertRaises(carom.CheckpointError):
            carom.resume("out")
        with self.assertRaises(carom.CheckpointError):
            carom.resume("nowhere")

    def test_command_line_resumes_what_python_has_stopped(self):
        case = falling_block()
        self.command_line(case, "cli")
        run = case.start("out")
        run.step(20)
        run.stop()
        subprocess.run([PROGRAM, "resume", "out", "--quiet"], check=True)
        self.assert_same("cli", "out")


class StepTest(FolderTest):
    def test_steps_and_until(self):
        run = falling_block().start()
        self.assertEqual((run.time, run.steps, run.at_end), (0.0, 0, False))
        run.step()
        self.assertEqual(run.steps, 1)
        self.assertEqual(run.time, run.dt)
        run.step(3)
        self.assertEqual(run.steps, 4)
        run.until(5e-5)
        self.assertGreaterEqual(run.time, 5e-5 * (1 - 1e-12))
        self.assertLess(run.time - run.dt, 5e-5)
        run.until(1.0)
        self.assertTrue(run.at_end)
        steps = run.steps
        run.step()
        self.assertEqual(run.steps, steps)
        result = run.finish()
        self.assertEqual(result.summary["scheme"]["steps"], steps)
        with self.assertRaisesRegex(RuntimeError, "finished"):
            run.step()

    def test_contact_of_the_instant(self):
        run = falling_block().start()
        self.assertEqual(run.contact["floor"].closed, 0)
        while run.contact["floor"].force[2] <= 0.0:
            run.step()
        self.assertGreater(run.contact["floor"].closed, 0)
        self.assertEqual(run.contact["floor"].force[2], run.history["floor.force_z"][-1])
        self.assertIsNone(run.contact["floor"].velocity)

    def test_snapshot_gives_the_same_bits_again_and_in_another_run(self):
        for scheme in ("central_differences", "newmark"):
            case = falling_block(scheme)
            run = case.start()
            run.step(15)
            snapshot = run.save()
            self.assertEqual((snapshot.steps, snapshot.time), (15, run.time))
            first = run.finish()
            run.restore(snapshot)
            self.assertEqual((run.steps, len(run.energy["time"])), (15, 16))
            again = run.finish()
            other = case.start(threads=1)
            other.restore(snapshot)
            third = other.finish()
            for name in first.energy:
                np.testing.assert_array_equal(first.energy[name], again.energy[name], name)
                np.testing.assert_array_equal(first.energy[name], third.energy[name], name)

    def test_snapshot_takes_the_folder_back(self):
        case = falling_block()
        case.start("plain").finish()
        run = case.start("out")
        run.step(15)
        snapshot = run.save()
        run.step(20)
        run.restore(snapshot)
        run.finish()
        for table in TABLES:
            self.assertEqual(text(f"plain/{table}"), text(f"out/{table}"))
        self.assertEqual(text("plain/fields.xdmf"), text("out/fields.xdmf"))
        with self.assertRaisesRegex(RuntimeError, "closed"):
            run.restore(snapshot)

    def test_snapshot_of_another_case_is_refused(self):
        run = falling_block().start()
        other = falling_block(speed=-4.0).start()
        with self.assertRaises(carom.CheckpointError):
            other.restore(run.save())
        other.step()  # untouched

    def test_views_keep_their_instant_and_their_memory(self):
        run = falling_block().start()
        begin = run.velocity
        copy = begin.copy()
        self.assertIs(begin.flags.writeable, False)
        self.assertFalse(begin.flags.owndata)
        self.assertEqual(begin.ctypes.data, run.velocity.ctypes.data)  # no copies
        with self.assertRaises(ValueError):
            begin.flags.writeable = True
        run.step(5)
        later = run.velocity
        np.testing.assert_array_equal(begin, copy)
        self.assertTrue((later != begin).any())
        last = later.copy()
        del run
        gc.collect()
        np.testing.assert_array_equal(later, last)

    def test_state_is_that_of_the_probe(self):
        run = falling_block().start()
        run.step(30)
        top = run.mesh.nodes_of("TOP")
        mean = run.displacement[top].mean(axis=0)
        self.assertAlmostEqual(mean[2], run.history["top.displacement_z"][-1], delta=1e-14 * abs(mean[2]))
        np.testing.assert_allclose(run.mesh.points[top][:, 2], 0.2 + 5e-5, rtol=1e-15)

    def test_runs_side_by_side(self):
        case = falling_block()
        alone = case.start().finish().energy["kinetic"]
        runs = [case.start(threads=n) for n in (1, 2)]
        while not runs[0].at_end:
            for run in runs:
                run.step()
        for run in runs:
            np.testing.assert_array_equal(run.finish().energy["kinetic"], alone)

    def test_runs_in_threads(self):
        case = falling_block("newmark")
        alone = case.start(threads=1).finish().energy["kinetic"]
        found = []
        threads = [threading.Thread(target=lambda: found.append(case.start(threads=1).finish().energy["kinetic"]))
                   for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(found), 3)
        for kinetic in found:
            np.testing.assert_array_equal(kinetic, alone)

    def test_a_dropped_run_leaves_no_threads_and_no_lock(self):
        def tasks():
            return len(os.listdir("/proc/self/task"))
        gc.collect()
        before = tasks()
        run = falling_block().start("out", threads=2)
        run.step(12)
        with self.assertRaises(carom.OutputError):
            falling_block().start("out")
        del run
        gc.collect()
        self.assertLessEqual(tasks(), before)
        falling_block().start("out").stop()


class ErrorTest(FolderTest):
    def test_case_error_of_a_file_has_its_place(self):
        lines = falling_block().resolved().splitlines()
        line = next(i for i, text in enumerate(lines) if text.startswith("rho"))
        lines[line] = "rho = -1.0"
        pathlib.Path("bad.toml").write_text("\n".join(lines))
        with self.assertRaises(carom.CaseError) as caught:
            carom.load("bad.toml")
        error = caught.exception
        self.assertEqual((error.file, error.line, error.column), ("bad.toml", line + 1, 7))
        self.assertEqual((error.key, error.found), ("materials.steel.rho", "-1.0"))
        self.assertIn("> 0", error.expected)

    def test_case_error_of_a_tree_has_its_key(self):
        case = falling_block()
        case["materials"]["steel"]["law"] = "linear_elastik"
        with self.assertRaises(carom.CaseError) as caught:
            case.check()
        self.assertEqual((caught.exception.line, caught.exception.key), (0, "materials.steel.law"))
        self.assertIn("linear_elastic", caught.exception.suggestion)

    def test_values_that_are_none_of_a_case(self):
        for value in (None, object(), {1: 2}, 2**70):
            case = falling_block()
            case["title"] = value
            with self.assertRaises(carom.CaseError):
                case.check()

    def test_places_of_what_has_not_been_changed(self):
        pathlib.Path("case.toml").write_text(falling_block().resolved())
        case = carom.load("case.toml")
        line = next(i for i, text in enumerate(pathlib.Path("case.toml").read_text().splitlines(), 1)
                    if text.startswith("material ") or "material = " in text)
        case["materials"]["copper"] = case["materials"].pop("steel")
        with self.assertRaises(carom.CaseError) as caught:
            case.start()
        self.assertEqual((caught.exception.key, caught.exception.line), ("part[0].material", line))

    def test_run_error_has_step_and_time_and_snapshots_bring_the_run_back(self):
        case = falling_block()
        case["initial"][0].update(angular_velocity=[0.0, 0.0, 1.0e3], centre=[0.05, 0.05, 0.1])  # 0.1 rad in all
        case["guards"] = {"rotation_warning": 0.5, "rotation_stop": 1.0}
        run = case.start()
        snapshot = run.save()
        with self.assertRaises(carom.RunError) as caught:
            run.finish()
        self.assertGreater(caught.exception.step, 0)
        self.assertEqual(caught.exception.time, run.time)
        self.assertEqual(str(caught.exception).count("step "), 1, caught.exception)  # one place, not two
        with self.assertRaises(carom.RunError):
            run.step()
        run.restore(snapshot)
        run.step()
        with self.assertRaises(carom.RunError):
            run.finish()
        self.assertEqual(run.stop().verdict, "error")

    def test_arguments_of_the_wrong_kind_are_refused_in_a_sentence(self):
        run = falling_block().start()
        with self.assertRaisesRegex(TypeError, "^n: 1.5, and a number of steps is wanted$"):
            run.step(1.5)
        with self.assertRaisesRegex(TypeError, "^time: 'end', and a number is wanted$"):
            run.until("end")
        with self.assertRaisesRegex(TypeError, "^every: '2', and a number of steps, at least 1, is wanted$"):
            run.observe(print, every="2")
        with self.assertRaisesRegex(TypeError, "^snapshot: 3, and what Run.save gives is wanted$"):
            run.restore(3)
        with self.assertRaisesRegex(TypeError, "^threads: 'all', and a number of cores, or 0 for all, is wanted$"):
            falling_block().start(threads="all")
        with self.assertRaisesRegex(TypeError, "^end: 'later', and a time is wanted$"):
            carom.resume("out", end="later")
        run.step(np.int32(1))  # numpy's numbers are numbers
        run.until(np.float32(1e-6))

    def test_names_that_are_none_are_answered_with_those_there_are(self):
        case = falling_block()
        run = case.start()
        with self.assertRaisesRegex(KeyError, "there is no contact 'flor'; there are floor; did you mean 'floor'?"):
            _ = run.contact["flor"]
        with self.assertRaisesRegex(KeyError, "no column 'top.velocity_w'; there are .*did you mean 'top.velocity_"):
            _ = run.history["top.velocity_w"]
        with self.assertRaisesRegex(KeyError, "no field 'stres'; there are .*did you mean 'stress'?"):
            _ = run.fields["stres"]
        with self.assertRaisesRegex(KeyError, "no section or value 'probes'; there are title, .*did you mean 'probe'?"):
            _ = case["probes"]
        with self.assertRaisesRegex(KeyError, "no group 'TIP'; there are .*TOP"):
            run.mesh.nodes_of("TIP")
        self.assertIsNone(run.contact.get("flor"))
        self.assertEqual(list(run.contact), ["floor"])

    def test_a_total_force_is_shared(self):
        case = resting_block()
        case["load"] = [{"total_force": np.array([0.0, 0.0, -100.0]), "group": "TOP"}]
        self.assertIn('load      on "TOP": (0, 0, -100) N in all', str(case.check()))

    def test_tables_are_those_of_the_command(self):
        case = falling_block()
        result = case.start("out").finish()
        for form, text in (("markdown", result.to_markdown()), ("latex", result.to_latex()), ("csv", result.to_csv())):
            told = subprocess.run([PROGRAM, "report", "--format", form, "out"], capture_output=True, text=True, check=True)
            self.assertEqual(text, told.stdout)
        self.assertIn("| velocity |", result.to_markdown())  # of the probe
        in_memory = case.start().finish().to_csv()
        self.assertEqual(in_memory.replace(",value\n", ",out\n"), result.to_csv())

    def test_output_error(self):
        pathlib.Path("file").write_text("")
        with self.assertRaises(carom.OutputError) as caught:
            falling_block().start("file")
        self.assertIn("file", caught.exception.path)

    def test_interrupt_leaves_a_usable_run(self):
        # Half a second of steps; the signal is sent once ten are made, so it meets the run within the call.
        def interrupt(run):
            while run.steps < 10:
                time.sleep(0.0005)
            os.kill(os.getpid(), signal.SIGINT)

        case = falling_block(end=4e-2)
        case["output"] = {"curves_every": 100}
        whole = case.start(threads=1).finish()
        for act in (lambda run: run.finish(), lambda run: run.until(1.0), lambda run: run.step(10**6)):
            run = case.start(threads=1)
            thread = threading.Thread(target=interrupt, args=(run,))
            with self.assertRaises(KeyboardInterrupt):
                thread.start()
                act(run)
            thread.join()
            self.assertFalse(run.at_end)
            np.testing.assert_array_equal(whole.energy["kinetic"], run.finish().energy["kinetic"])

    def test_check_prints_what_the_command_line_prints(self):
        case = falling_block()
        pathlib.Path("cli.toml").write_text(case.resolved())
        printed = subprocess.run([PROGRAM, "check", "cli.toml"], capture_output=True, text=True, check=False).stdout
        self.assertEqual(str(carom.load("cli.toml").check("out/cli")) + "\n", printed)
        self.assertTrue(case.check())


if __name__ == "__main__":
    unittest.main()
