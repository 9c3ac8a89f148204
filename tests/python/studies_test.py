"""Studies: many runs side by side, of which some fail."""

import contextlib
import io
import multiprocessing
import os
import pathlib
import pickle
import signal
import threading
import time
import unittest

import numpy as np

import carom
from python_fixture import FolderTest, falling_block


def impulse(speed):
    """What the floor gives to a block of this speed; some have an accident."""
    if speed == 3.0:
        raise ValueError("three is unlucky")
    if speed == 4.0:
        os.kill(os.getpid(), signal.SIGKILL)
    if speed == 5.0:
        os._exit(0)
    if speed == 6.0:
        time.sleep(0.3)
    if speed == 7.0:
        time.sleep(600.0)
    with open("calls.txt", "a") as calls:
        calls.write(f"{speed}\n")
    return falling_block(speed=-speed).start(threads=1).finish().history["floor.impulse_z"][-1]


class StudyTest(FolderTest):
    def test_outcomes_are_those_of_runs_alone_in_the_order_of_the_work(self):
        outcomes = carom.study([6.0, 2.0, 1.0], impulse, jobs=3, progress=False)
        self.assertEqual([one.given for one in outcomes], [6.0, 2.0, 1.0])
        for one in outcomes:
            self.assertEqual(one.value, impulse(one.given))
            self.assertEqual((one.error, one.failed), ("", False))
            self.assertGreater(one.seconds, 0.0)

    def test_one_that_fails_does_not_concern_the_others(self):
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            outcomes = carom.study([1.0, 3.0, 4.0, 5.0, 2.0], impulse, jobs=2)
        self.assertEqual([one.failed for one in outcomes], [False, True, True, True, False])
        self.assertIn("three is unlucky", outcomes[1].error)
        self.assertIn("impulse", outcomes[1].error)  # where
        self.assertIn("signal 9", outcomes[2].error)
        self.assertIn("without an answer", outcomes[3].error)
        self.assertIsNone(outcomes[2].value)
        lines = said.getvalue().splitlines()
        self.assertEqual(len(lines), 5)
        self.assertRegex(lines[1], "^2 of 5 done(, [12] failed)?, about .* s left$")
        self.assertRegex(lines[4], "^5 of 5 done, 3 failed in .* s$")

    def test_cases_are_brought_to_their_ends(self):
        cases = [falling_block(speed=-speed) for speed in (1.0, 2.0)]
        cases[0]["title"] = "slow"
        slow, fast = carom.study(cases, progress=False)
        self.assertEqual(slow.value.summary["case"]["title"], "slow")
        alone = cases[1].start().finish()
        np.testing.assert_array_equal(fast.value.energy["kinetic"], alone.energy["kinetic"])
        self.assertEqual(fast.value.figures, alone.figures)

    def test_what_is_done_is_kept(self):
        first = carom.study([1.0, 3.0, 2.0], impulse, progress=False, keep="study.pickle")
        again = carom.study([1.0, 3.0, 2.0], impulse, progress=False, keep="study.pickle")
        calls = sorted(pathlib.Path("calls.txt").read_text().split())
        self.assertEqual(calls, ["1.0", "2.0"])  # each once; the one that fails is tried again
        self.assertEqual([one.value for one in again], [one.value for one in first])
        self.assertEqual([one.seconds for one in again][::2], [one.seconds for one in first][::2])
        self.assertTrue(again[1].failed)
        with self.assertRaisesRegex(ValueError, "study.pickle is of another study"):
            carom.study([1.0, 2.0], impulse, progress=False, keep="study.pickle")
        # Broken off while the last outcome was written.
        whole = pathlib.Path("study.pickle").read_bytes()
        pathlib.Path("study.pickle").write_bytes(whole[:-3])
        carom.study([1.0, 3.0, 2.0], impulse, progress=False, keep="study.pickle")
        self.assertEqual(len(pathlib.Path("calls.txt").read_text().split()), 3)

    def test_interrupt_ends_the_processes_and_keeps_what_is_done(self):
        def interrupt():
            while not pathlib.Path("study.pickle").exists() or pathlib.Path("study.pickle").stat().st_size == size:
                time.sleep(0.05)
            os.kill(os.getpid(), signal.SIGINT)

        size = len(pickle.dumps([pickle.dumps((impulse, speed)) for speed in (1.0, 7.0)]))  # before any outcome
        threading.Thread(target=interrupt).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            carom.study([1.0, 7.0], impulse, jobs=2, progress=False, keep="study.pickle")
        self.assertLess(time.monotonic() - begin, 60.0)
        self.assertEqual(multiprocessing.active_children(), [])
        self.assertEqual(carom.studies._Kept(pathlib.Path("study.pickle"), [
            pickle.dumps((impulse, speed)) for speed in (1.0, 7.0)]).found.keys(), {0})

    def test_what_cannot_be_sent_is_refused_before_anything_runs(self):
        with self.assertRaisesRegex(TypeError, "find the function in a module"):
            carom.study([1.0], lambda speed: speed)
        case = falling_block()
        case.function("push", lambda t: 1.0)
        with self.assertRaisesRegex(TypeError, "pickled"):
            carom.study([falling_block(), case])

    def test_results_can_be_sent(self):
        result = falling_block().start().finish()
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(result)).energy["kinetic"], result.energy["kinetic"])


if __name__ == "__main__":
    unittest.main()
