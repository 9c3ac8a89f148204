"""tools/setup says in one message what is missing where it may not install, installs where it may, and is silent
where nothing is missing. The programs that it calls are replaced by scripts of the test."""

import os
import pathlib
import shutil
import subprocess
import unittest

from tool_test import TOOLS, ToolTest

PACKAGES = "# comment\nbuild  g++  compiler\nbuild  cmake  builds\ntest   libgtest-dev  tests\n"


class Setup(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("tools/packages.txt", PACKAGES)
        shutil.copy(TOOLS / "setup", self.root / "tools/setup")
        for name in ("awk", "dirname", "grep", "env", "sh"):
            self.link(name)
        self.script("id", "echo 1000")

    def link(self, name):
        (self.root / "bin").mkdir(exist_ok=True)
        (self.root / "bin" / name).symlink_to(shutil.which(name))

    def script(self, name, body):
        self.write(f"bin/{name}", f"#!/bin/sh\n{body}\n").chmod(0o755)

    def dpkg_reports(self, *installed):
        self.script("dpkg-query", "\n".join(f"echo '{name} installed'" for name in installed) or "exit 1")

    def setup_tool(self, *groups):
        environment = {**os.environ, "PATH": str(self.root / "bin")}
        done = subprocess.run(["/bin/sh", self.root / "tools/setup", *groups], capture_output=True, text=True,
                              env=environment, stdin=subprocess.DEVNULL, check=False)
        return done.returncode, done.stdout, done.stderr

    def test_silent_when_nothing_is_missing(self):
        self.dpkg_reports("g++", "cmake")
        self.assertEqual(self.setup_tool("build"), (0, "", ""))

    def test_without_dpkg_names_all_packages(self):
        code, _, message = self.setup_tool("build", "test")
        self.assertEqual(code, 1)
        self.assertIn("  g++ cmake libgtest-dev\n", message)

    def test_without_rights_names_the_missing_packages_only(self):
        self.dpkg_reports("g++")
        self.script("apt-get", "echo must not be called; exit 1")
        code, output, message = self.setup_tool("build", "test")
        self.assertEqual((code, output), (1, ""))
        self.assertIn("neither root nor sudo", message)
        self.assertIn("  cmake libgtest-dev\n", message)

    def test_without_apt(self):
        self.dpkg_reports("g++")
        code, _, message = self.setup_tool("build")
        self.assertEqual(code, 1)
        self.assertIn("no apt-get", message)
        self.assertIn("  cmake\n", message)

    def test_installs_as_root_and_through_sudo(self):
        self.dpkg_reports("g++")
        log = self.root / "apt.log"
        self.script("apt-get", f'echo "$*" >>{log}')
        self.script("id", "echo 0")
        self.assertEqual(self.setup_tool("build")[0], 0)
        self.assertEqual(log.read_text(), "-q -y update\n-q -y install --no-install-recommends cmake\n")
        log.unlink()
        self.script("id", "echo 1000")
        self.script("sudo", '[ "$1" != -n ] || shift; [ "$1" = true ] || exec "$@"')
        self.assertEqual(self.setup_tool("build")[0], 0)
        self.assertIn("install --no-install-recommends cmake\n", log.read_text())

    def test_failing_apt_is_said(self):
        self.dpkg_reports("g++")
        self.script("apt-get", "exit 100")
        self.script("id", "echo 0")
        code, _, message = self.setup_tool("build")
        self.assertEqual(code, 1)
        self.assertIn("could not install", message)
        self.assertIn("  cmake\n", message)

    def test_unknown_group(self):
        self.dpkg_reports("g++", "cmake")
        self.assertEqual(self.setup_tool("nonsense")[0], 2)

    def test_the_real_list_is_well_formed(self):
        for line in pathlib.Path(TOOLS / "packages.txt").read_text().splitlines():
            if line and not line.startswith("#"):
                group, package, _ = line.split(None, 2)
                self.assertIn(group, ("build", "python", "test", "ci", "bench", "book", "package", "verify", "mpi",
                                  "manual", "portable"))
                self.assertRegex(package, r"^[a-z0-9][a-z0-9+.-]+$")


if __name__ == "__main__":
    unittest.main()
