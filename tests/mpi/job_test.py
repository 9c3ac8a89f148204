#!/usr/bin/python3
"""How a job of several processes begins, is stopped, goes on and fails. Usage: job_test.py CAROM CAROM_MPI."""

import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import same_bits

CAROM, CAROM_MPI = sys.argv[1:3]

# Some hundred steps of some milliseconds.
BLOCK = """
[[mesh.block]]
origin = [0.0, 0.0, 0.001]
size = [0.02, 0.02, 0.02]
divisions = [12, 12, 12]
groups = { cells = "BLOCK", zmin = "FOOT" }
[materials.steel]
law = "j2"
E = 2.0e11
nu = 0.3
rho = 7800.0
yield_stress = 3.0e8
[[part]]
name = "block"
cells = "BLOCK"
material = "steel"
[[initial]]
part = "block"
velocity = [5.0, 0.0, -50.0]
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
friction = 0.3
[scheme]
kind = "central_differences"
[time]
end = 2.0e-4
[output]
checkpoint_every = 50
"""


def job(ranks, *arguments, **options):
    return subprocess.run(list(map(str, same_bits.on_ranks(ranks, CAROM_MPI, *arguments))), capture_output=True,
                          text=True, timeout=120, env=os.environ | same_bits.ENVIRONMENT, **options)


def libraries(program):
    lines = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"^\s*(\S+)", lines, re.MULTILINE))


def processes_of(case):
    """The numbers of the processes that run a case."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0") if entry.name.isdigit() else []
        except OSError:
            continue
        if words and words[0] == os.fsencode(CAROM_MPI) and os.fsencode(case) in words:
            found.append(int(entry.name))
    return sorted(found)


def ends(running, case):
    """Waits until no process runs the case: the exit code of mpirun, None where a process went on. Once in 80 kills mpirun
    itself (OpenMPI 4.1) stayed when all that it had started had ended: that is not Carom's, and it is ended then."""
    end = time.monotonic() + 15.0
    while processes_of(case) and time.monotonic() < end:
        time.sleep(0.02)
    left = processes_of(case)
    try:
        return None if left else running.wait(timeout=5)
    except subprocess.TimeoutExpired:
        return "stayed"
    finally:
        for process in left:
            os.kill(process, signal.SIGKILL)
        running.kill()
        running.communicate()


class Job(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.case = self.folder / "block.toml"
        self.case.write_text(BLOCK)

    # The sequential library of MUMPS defines the functions of MPI: each process would take itself for the only one.
    def test_each_program_has_its_libraries(self):
        self.assertFalse([name for name in libraries(CAROM_MPI) if "_seq" in name])
        self.assertFalse([name for name in libraries(CAROM) if name.startswith("libmpi.")])

    def test_ranks_share_out_the_cores_that_they_may_all_use(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "case.toml").write_text(BLOCK.replace("2.0e-4", "2.0e-6"), encoding="utf-8")
            done = job(2, "run", "case.toml", cwd=folder)
        threads = max(1, len(os.sched_getaffinity(0)) // 2)
        self.assertRegex(done.stdout + done.stderr, rf"2 ranks of {threads} threads? each")

    def test_other_commands_are_done_once(self):
        done = job(3, "check", self.case)
        self.assertEqual(done.returncode, 0, done.stderr)
        alone = subprocess.run([CAROM, "check", self.case], capture_output=True, text=True, check=True)

        def untimed(text):
            """Without what the clock decides: how far a second of rehearsal comes, and what it foretells."""
            return [line for line in text.splitlines() if not re.match("  (step|rehearsed|cost) ", line)]

        self.assertEqual(untimed(done.stdout), untimed(alone.stdout))
        self.assertGreater(len(untimed(alone.stdout)), 5)

    def test_what_all_processes_find_wrong_is_said_once(self):
        self.case.write_text(BLOCK.replace("j2", "j3"))
        done = job(3, "run", self.case, "--out", self.folder / "out")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("error: "), 1, done.stderr)
        self.assertIn("j3", done.stderr)

    def test_ranks_of_different_instruction_sets_are_refused(self):
        of_rank = self.folder / "of_rank"
        of_rank.write_text(f"#!/bin/sh\n[ $OMPI_COMM_WORLD_RANK = 1 ] && export CAROM_ISA=v2\nexec {CAROM_MPI} \"$@\"\n")
        of_rank.chmod(0o755)
        done = subprocess.run([same_bits.ROOT / "tools/on_ranks", "2", of_rank, "run", self.case, "--out",
                               self.folder / "out"], capture_output=True, text=True, timeout=60,
                              env=os.environ | same_bits.ENVIRONMENT)
        self.assertEqual(done.returncode, 3)
        self.assertIn("CAROM_ISA", done.stderr)
        self.assertEqual(done.stderr.count("error: "), 1, done.stderr)

    def test_the_end_of_one_process_ends_all(self):
        for number in (1, 0):
            with self.subTest(killed=number):
                running = subprocess.Popen(
                    list(map(str, same_bits.on_ranks(3, CAROM_MPI, "run", self.case, "--out", self.folder / "out",
                                                     "--quiet"))),
                    env=os.environ | same_bits.ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                self.wait_until(lambda: (self.folder / "out/energy.csv").is_file() and len(self.processes()) == 3)
                ranks = self.processes()
                os.kill(ranks[number], signal.SIGKILL)
                self.assertNotIn(ends(running, self.case), (None, 0))

    def wait_until(self, is_so):
        end = time.monotonic() + 60.0
        while not is_so():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.02)

    def processes(self):
        return processes_of(self.case)

    # The checkpoint is of all ranks together: it says nothing of their number.
    def test_a_stopped_run_goes_on_on_another_number_of_ranks(self):
        subprocess.run([CAROM, "run", self.case, "--out", self.folder / "whole", "--quiet"], check=True,
                       env=os.environ | same_bits.ENVIRONMENT)
        out = self.folder / "out"
        running = subprocess.Popen(
            list(map(str, same_bits.on_ranks(3, CAROM_MPI, "run", self.case, "--out", out, "--quiet"))),
            env=os.environ | same_bits.ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.wait_until(lambda: list(out.glob("checkpoints/*")))
        running.send_signal(signal.SIGTERM)
        _, said = running.communicate(timeout=30)
        self.assertIn(b"goes on from there", said)
        done = job(2, "resume", out, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(same_bits.differences(self.folder / "whole", out), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
