"""tools/carry.py makes a program that runs with the libraries that it carries, wherever it is moved, and refuses what it has no
licence of. Skipped where patchelf is not installed (tools/setup portable)."""

import shutil
import subprocess
import unittest

from tool_test import TOOLS, ToolTest

# Needs libsz, zlib and, for what is never called, libcurl and libcrypto.
PROGRAM = """#include <hdf5.h>
#include <stdio.h>
int main(void) {
  unsigned a, b, c;
  if (H5open() < 0 || H5get_libversion(&a, &b, &c) < 0) return 1;
  return printf("HDF5 %u\\n", a) > 0 ? 0 : 1;
}
"""


@unittest.skipUnless(shutil.which("patchelf"), "patchelf is not installed (tools/setup portable)")
class Carry(ToolTest):
    def compile(self, name, text, *options):
        source = self.write(f"{name}.c", text)
        subprocess.run(["cc", source, "-o", self.root / name, *options], check=True)
        return self.root / name

    def carry(self, program):
        folder = self.root / "there"
        folder.mkdir()
        shutil.move(program, folder / "program")
        return subprocess.run(["/usr/bin/python3", TOOLS / "carry.py", folder / "program", folder / "lib",
                               folder / "licences", "--built-in", "libcli11-dev"],
                              capture_output=True, text=True, check=False)

    def test_a_program_runs_where_it_is_moved(self):
        options = subprocess.run(["pkg-config", "--cflags", "--libs", "hdf5-serial"], capture_output=True, text=True,
                                 check=True).stdout.split()
        done = self.carry(self.compile("program", PROGRAM, *options))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertRegex(done.stdout, r"^2\.\d+\n$")
        moved = (self.root / "there").rename(self.root / "elsewhere")
        found = subprocess.run(["ldd", "-r", moved / "program"], capture_output=True, text=True, check=True).stdout
        self.assertNotRegex(found, "not found|undefined|libcurl|libcrypto")
        for name in ("libhdf5_serial-", "libsz-", "libz-", "libcarom_no_network"):
            self.assertRegex(found, f"{name}.* => {moved}/(../elsewhere/)?lib/")
        # Every function is looked up before main, those that stand in for the network's as well.
        run = subprocess.run([moved / "program"], env={"LD_BIND_NOW": "1"}, capture_output=True, text=True, check=False)
        self.assertEqual((run.returncode, run.stdout), (0, "HDF5 1\n"))
        names = {path.name for path in (moved / "licences").iterdir()}
        self.assertLessEqual({"zlib1g.txt", "libcli11-dev.txt", "GPL-3.txt", "SOURCES.txt"}, names)
        self.assertRegex((moved / "licences/SOURCES.txt").read_text(), r"libz\.so\.1: zlib 1:\d")

    def test_a_library_of_no_package_is_refused(self):
        self.compile("libown.so", "int own(void) { return 1; }", "-shared", "-fPIC", "-Wl,-soname,libown.so")
        program = self.compile("program", "int own(void); int main(void) { return own(); }", f"-L{self.root}", "-lown",
                               f"-Wl,-rpath,{self.root}")
        done = self.carry(program)
        self.assertEqual(done.returncode, 1)
        self.assertIn("libown.so is of no Debian package", done.stderr)


if __name__ == "__main__":
    unittest.main()
