"""What the tests of tools/ share: a scratch tree of files and the run of one tool on it."""

import pathlib
import subprocess
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parent.parent.parent / "tools"


class ToolTest(unittest.TestCase):
    """A test with an empty folder of its own, self.root."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def run_tool(self, name):
        """Exit code and output of tools/<name> on self.root."""
        done = subprocess.run(["/usr/bin/python3", TOOLS / name, self.root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr
