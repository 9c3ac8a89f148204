#!/usr/bin/python3
"""What can go wrong on one of several processes. Usage: faults_test.py CAROM CAROM_MPI [KILLS [SEED]].

KILLS: how often a run loses a process at a random moment, goes on on another number of ranks, and has to end with the
bytes of a run that nothing happened to.
"""

import os
import pathlib
import random
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import same_bits
from job_test import BLOCK, ends, processes_of

CAROM, CAROM_MPI, KILLS, SEED = sys.argv[1], sys.argv[2], int((sys.argv + ["3"])[3]), int((sys.argv + ["3", "1"])[4])
ENVIRONMENT = os.environ | same_bits.ENVIRONMENT
ONE_CELL = re.sub(r"divisions = .*", "divisions = [1, 1, 1]", BLOCK)


class Faults(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.case = self.folder / "block.toml"
        self.case.write_text(BLOCK)

    def job(self, ranks, rank_one, *arguments):
        """Runs a job whose rank 1 (rank 0 where it is said so) does some lines of shell before; its words and seconds."""
        of_rank = self.folder / "of_rank"
        of_rank.write_text(f"#!/bin/sh\n{rank_one}\nexec {shlex.quote(CAROM_MPI)} \"$@\"\n")
        of_rank.chmod(0o755)
        begin = time.monotonic()
        done = subprocess.run(list(map(str, (same_bits.ROOT / "tools/on_ranks", ranks, of_rank, *arguments))),
                              capture_output=True, text=True, timeout=100, env=ENVIRONMENT)
        return done, time.monotonic() - begin

    def expect_end(self, done, seconds, *words):
        self.assertNotEqual(done.returncode, 0)
        self.assertLess(seconds, 30.0)
        self.assertEqual(done.stderr.count("error: "), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_a_case_that_one_rank_cannot_read(self):
        gone = 'if [ "$OMPI_COMM_WORLD_RANK" = 1 ]; then shift 2; set -- run gone.toml "$@"; fi'
        done, seconds = self.job(3, gone, "run", self.case, "--out", self.folder / "out")
        self.expect_end(done, seconds, "rank 1 of 3", "gone.toml")

    def test_ranks_with_other_cases(self):
        (self.folder / "other.toml").write_text(BLOCK.replace("[12, 12, 12]", "[12, 12, 11]"))
        other = f'if [ "$OMPI_COMM_WORLD_RANK" = 1 ]; then shift 2; set -- run {self.folder}/other.toml "$@"; fi'
        done, seconds = self.job(2, other, "run", self.case, "--out", self.folder / "out")
        self.expect_end(done, seconds, "do not make the same run", "a disk that all of them see")

    # A process that ignores the signal is told that a file has no room. 5 MB (blocks of 512 bytes): MPI has files of 4.
    def test_a_disk_that_is_full(self):
        self.case.write_text(BLOCK.replace("[12, 12, 12]", "[28, 28, 28]") + "format = \"vtu\"\nprecision = \"double\"\n")
        full = "if [ \"$OMPI_COMM_WORLD_RANK\" = 0 ]; then trap '' XFSZ; ulimit -f 10000; fi"
        done, seconds = self.job(2, full, "run", self.case, "--out", self.folder / "out")
        self.expect_end(done, seconds, "out")

    def test_more_ranks_than_cells(self):
        self.case.write_text(ONE_CELL)
        subprocess.run([CAROM, "run", self.case, "--out", self.folder / "alone", "--quiet"], check=True, env=ENVIRONMENT)
        done, _ = self.job(5, "", "run", self.case, "--out", self.folder / "out", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(same_bits.differences(self.folder / "alone", self.folder / "out"), [])

    def test_runs_whose_processes_are_killed(self):
        chance = random.Random(SEED)
        begin = time.monotonic()
        subprocess.run([CAROM, "run", self.case, "--out", self.folder / "whole", "--quiet"], check=True, env=ENVIRONMENT)
        length = time.monotonic() - begin
        for kill in range(KILLS):
            ranks, others, when = chance.choice((2, 3, 4)), chance.choice((1, 2, 3)), chance.uniform(0.0, 1.5 * length)
            with self.subTest(kill=kill, ranks=ranks, others=others, when=when):
                self.kill_and_go_on(self.folder / f"out{kill}", ranks, others, when, chance)

    def kill_and_go_on(self, out, ranks, others, when, chance):
        running = subprocess.Popen(list(map(str, same_bits.on_ranks(ranks, CAROM_MPI, "run", self.case, "--out", out,
                                                                    "--quiet"))),
                                   env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        end = time.monotonic() + 60.0
        while not list(out.glob("checkpoints/*")) and running.poll() is None:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.02)
        time.sleep(when)
        if victims := processes_of(self.case):
            os.kill(chance.choice(victims), signal.SIGKILL)
        code = ends(running, self.case)
        self.assertIsNotNone(code, "processes that go on when another has been killed")
        command = [CAROM, "resume", out, "--quiet"] if others == 1 else \
            list(map(str, same_bits.on_ranks(others, CAROM_MPI, "resume", out, "--quiet")))
        if code != 0 and not (out / "report.html").exists():  # the last file: with it the run had come to its end before
            done = subprocess.run(command, capture_output=True, text=True, timeout=100, env=ENVIRONMENT)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(same_bits.differences(self.folder / "whole", out), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
