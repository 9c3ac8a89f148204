"""The case printed in README.md runs and passes. Usage: readme_test.py CAROM."""

import pathlib
import re
import subprocess
import sys
import tempfile

program = sys.argv[1]
readme = (pathlib.Path(__file__).resolve().parent.parent.parent / "README.md").read_text()
(case,) = re.findall(r"```toml\n(.*?)```", readme, re.DOTALL)
with tempfile.TemporaryDirectory() as folder:
    path = pathlib.Path(folder) / "case.toml"
    path.write_text(case)
    done = subprocess.run([program, "run", path, "--quiet", "--out", f"{folder}/out"], check=False)
    summary = pathlib.Path(folder, "out", "summary.json")
    if done.returncode != 0 and summary.is_file():
        print(summary.read_text())
    sys.exit(done.returncode)
