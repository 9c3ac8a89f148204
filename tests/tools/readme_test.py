"""The case printed in README.md runs and passes, and what is said of citing Carom names its version. Usage: readme_test.py CAROM."""

import pathlib
import re
import subprocess
import sys
import tempfile

program = sys.argv[1]
root = pathlib.Path(__file__).resolve().parent.parent.parent
readme = (root / "README.md").read_text()
version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
for place, pattern in (("README.md", r"version = \{(.*)\}"), ("CITATION.cff", r"\nversion: (.*)")):
    (named,) = re.findall(pattern, (root / place).read_text())
    if named != version:
        sys.exit(f"{place} names the version {named}, the program is {version}")
(case,) = re.findall(r"```toml\n(.*?)```", readme, re.DOTALL)
with tempfile.TemporaryDirectory() as folder:
    path = pathlib.Path(folder) / "case.toml"
    path.write_text(case)
    done = subprocess.run([program, "run", path, "--quiet", "--out", f"{folder}/out"], check=False)
    summary = pathlib.Path(folder, "out", "summary.json")
    if done.returncode != 0 and summary.is_file():
        print(summary.read_text())
    sys.exit(done.returncode)
