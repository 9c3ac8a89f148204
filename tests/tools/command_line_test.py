"""What the command line says to words that it does not know, and what `check` counts."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

CAROM = str(pathlib.Path(sys.argv.pop(1)).resolve())
CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"


def carom(*words):
    done = subprocess.run([CAROM, *words], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


class CommandLine(unittest.TestCase):
    def test_a_word_that_is_no_command_is_named_with_those_that_are(self):
        code, out, error = carom("runn", "case.toml")
        self.assertEqual((code, out), (2, ""))
        self.assertEqual(error, 'error: "runn" is no command of carom; it has run, resume, check, init, convert, compare, material, report, watch, mesh, '
                                "schema (carom --help)\n")

    def test_no_command_at_all(self):
        code, out, error = carom()
        self.assertEqual((code, error), (2, ""))
        self.assertIn("carom check CASE.toml", out)
        self.assertIn("docs/tutorial.md", out)

    def test_an_option_that_is_none_is_named_with_the_one_that_was_meant(self):
        code, out, error = carom("run", "case.toml", "--thread", "2")
        self.assertEqual((code, out), (2, ""))
        self.assertEqual(error, "error: carom run has no option --thread; did you mean --threads? (carom run --help)\n")

    def test_a_deck_of_another_program_is_recognised(self):
        with tempfile.TemporaryDirectory() as folder:
            deck = pathlib.Path(folder) / "drop.k"
            deck.write_text("$ a comment\n*KEYWORD\n*NODE\n1,0,0,0\n*END\n")
            code, _, error = carom("check", str(deck))
        self.assertEqual(code, 2)
        self.assertIn("seems to be a deck of LS-DYNA", error)

    def test_nodes_where_springs_end_in_the_ground_are_not_counted(self):
        code, out, _ = carom("check", str(CASES / "springs/block_on_springs.toml"))
        self.assertEqual(code, 0)
        self.assertIn(" 8 nodes, 1 solid cell,", out)  # one cell of eight nodes, a spring at each

    def test_a_folder_that_no_run_has_written_is_named_alone(self):
        """What is wrong is said of the folder, which has no lines."""
        for command in ("report", "watch"):
            with tempfile.TemporaryDirectory() as folder:
                code, out, error = carom(command, folder)
            self.assertEqual((code, out), (2, ""))
            self.assertEqual(error, f"error: {folder}: found a folder without energy.csv and summary.json; expected the results folder of a run "
                                    "(carom run CASE.toml --out FOLDER)\n")

    def test_tables_of_runs_are_printed_in_the_format_that_is_asked_for(self):
        case = CASES / "springs/block_on_springs.toml"
        with tempfile.TemporaryDirectory() as folder:
            runs = [str(pathlib.Path(folder) / name) for name in ("one", "two")]
            for run in runs:
                self.assertEqual(carom("run", str(case), "--out", run, "--threads", "1", "--quiet")[0], 0)
            code, out, error = carom("report", *runs, "--format", "markdown")
            self.assertEqual((code, error), (0, ""))
            self.assertRegex(out, r"(?m)^\| kinetic \| \S+ \| \S+ \| none \|$")  # the same run twice
            self.assertFalse((pathlib.Path(runs[0]) / "../comparison.html").exists())
            for words in (("--format", "word"), ("--format", "latex", "--out", "page.html")):
                self.assertEqual(carom("report", *runs, *words)[0], 2)
            code, out, error = carom("compare", str(case), "--courant", "0.4", "--format", "latex", "--out", folder + "/compared")
            self.assertIn(out.splitlines()[0], (r"\begin{tabular}{lrrrrrrrl}", "% in all variants: Courant 0.4"))
            self.assertEqual(out.splitlines()[-1], r"\end{tabular}")
            self.assertIn("recommend", error.lower())

    def test_a_case_begun_with_an_example_runs(self):
        """Of the sources around a build; and of share/carom beside the bin of an installation."""
        with tempfile.TemporaryDirectory() as folder:
            mine = pathlib.Path(folder) / "mine"
            code, out, error = carom("init", str(mine), "--like", "sdnv100/current_msh")
            self.assertEqual((code, error), (0, ""))
            self.assertEqual(out.splitlines(), [f"{mine}/mine.toml and {mine}/sdnv100a.msh written",
                                                f"carom check {mine}/mine.toml    says what it will do"])
            self.assertEqual(carom("run", f"{mine}/mine.toml", "--out", folder + "/out", "--threads", "1", "--quiet")[0], 0)
            installed = pathlib.Path(folder) / "usr"
            for part in ("bin", "share/carom"):
                (installed / part).mkdir(parents=True)
            shutil.copy(CAROM, installed / "bin/carom")
            (installed / "share/carom/cases").symlink_to(CASES)
            done = subprocess.run([installed / "bin/carom", "init", "other", "--like", "balls/oblique"], cwd=folder, check=True,
                                  capture_output=True, text=True)
            self.assertEqual(done.stdout.splitlines()[0], "other/other.toml and other/balls.msh written")
            self.assertEqual((mine.parent / "other/balls.msh").read_bytes(), (CASES / "balls/balls.msh").read_bytes())

    def test_an_example_that_is_none_is_answered_by_all_that_there_are(self):
        code, out, error = carom("init", "mine", "--like", "tutorial/phones")
        self.assertEqual((code, out), (2, ""))
        self.assertIn('error: --like: found "tutorial/phones"; expected one of\n  balls/oblique\n', error)
        self.assertTrue(error.endswith("Did you mean tutorial/phone?\n"), error)
        self.assertFalse(pathlib.Path("mine").exists())
        code, out, error = carom("init", "mine")
        self.assertEqual((code, out), (2, ""))
        self.assertIn("error: --like: found no case to begin with; expected one of\n  balls/oblique\n", error)

    def test_ranges_of_options_are_said_in_few_digits(self):
        for word in ("-1", "0", "abc", "inf"):
            code, _, error = carom("compare", "case.toml", "--courant", word)
            self.assertEqual(code, 2)
            self.assertTrue(error.startswith(f"--courant: found {word}; expected a number > 0\n"), error)

    def test_a_program_without_its_examples_says_where_they_go(self):
        with tempfile.TemporaryDirectory() as folder:
            alone = pathlib.Path(folder) / "usr/local/bin/carom"
            alone.parent.mkdir(parents=True)
            shutil.copy(CAROM, alone)
            done = subprocess.run([alone, "init", "mine", "--like", "balls/oblique"], cwd=folder, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("no examples beside the program", done.stderr)
        self.assertIn("Start it where it was installed or built, or copy", done.stderr)

    def test_two_runs_in_the_place_of_a_case_are_sent_to_report(self):
        with tempfile.TemporaryDirectory() as folder:
            code, out, error = carom("compare", folder)
            self.assertEqual((code, out), (2, ""))
            self.assertEqual(error, f"error: {folder}: found a folder; expected a case file (.toml), of which variants are run. Of runs that are done, "
                                    "the results folders of two runs are laid over each other by `carom report A B`.\n")
        code, out, error = carom("compare", "out/a", "out/b", "--scheme", "newmark")
        self.assertEqual((code, out), (2, ""))
        self.assertEqual(error, 'error: carom compare takes one case, of which it runs variants, and found "out/b" as well; the results folders of two '
                                "runs are laid over each other by `carom report A B`\n")

    def test_little_address_space_is_said_and_does_not_hang(self):
        """OpenBLAS asks again for ever: 150 MB are too little for it, 600 MB enough for a block."""
        if b"__asan_init" in pathlib.Path(CAROM).read_bytes():
            self.skipTest("the shadow memory of the address sanitizer is larger than any limit")
        for kilobytes, wanted in ((150000, 3), (600000, 0)):
            command = f'ulimit -v {kilobytes} && exec "{CAROM}" check "{CASES}/springs/block_on_springs.toml"'
            done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=False, timeout=60)
            self.assertEqual(done.returncode, wanted, done.stderr)
            self.assertEqual("ulimit -v" in done.stderr, wanted == 3)


if __name__ == "__main__":
    unittest.main()
