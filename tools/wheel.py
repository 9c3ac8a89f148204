#!/usr/bin/python3
"""Packs a folder of packages as a wheel (the format's version 1.0).

Usage: wheel.py STAGE OUT VERSION GLIBC. STAGE has the package carom, carom.libs with the libraries that it needs, and licences;
GLIBC is the version of the C library that they need. Prints the name of the wheel. It is for the interpreter that runs this: the
module is not made with the limited interface.
"""

import base64
import hashlib
import pathlib
import platform
import sys
import zipfile

# pybind11 before 2.12 reads arrays as numpy 1 has them.
METADATA = """Metadata-Version: 2.1
Name: carom
Version: {version}
Summary: Impact dynamics of deformable solids
License: GPL-3.0-or-later
Requires-Python: >={python},<{next_python}
Requires-Dist: numpy<2
Classifier: Operating System :: POSIX :: Linux
Classifier: Programming Language :: Python :: 3 :: Only
Classifier: Topic :: Scientific/Engineering :: Physics
Classifier: Typing :: Typed

Carom computes impacts of deformable solids: what happens in the microseconds when a body strikes another, with the contact
forces, the waves, and where every joule went. This is its module of Python; the solver and the libraries that it needs are in it.
"""


def record_line(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}"


def main():
    stage, out = map(pathlib.Path, sys.argv[1:3])
    version, c_library = sys.argv[3:]
    major, minor = sys.version_info[:2]
    tag = f"cp{major}{minor}-cp{major}{minor}-manylinux_{c_library.replace('.', '_')}_{platform.machine()}"
    info = f"carom-{version}.dist-info"
    files = {str(path.relative_to(stage)): path.read_bytes()
             for folder in ("carom", "carom.libs") for path in sorted((stage / folder).rglob("*")) if path.is_file()}
    for path in sorted((stage / "licences").iterdir()):
        files[f"{info}/licenses/{path.name}"] = path.read_bytes()
    files[f"{info}/METADATA"] = METADATA.format(version=version, python=f"{major}.{minor}",
                                                next_python=f"{major}.{minor + 1}").encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: tools/wheel.py\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    lines = [record_line(name, data) for name, data in files.items()] + [f"{info}/RECORD,,"]
    files[f"{info}/RECORD"] = ("\n".join(lines) + "\n").encode()
    wheel = out / f"carom-{version}-{tag}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            archive.writestr(entry, data)
    print(wheel)


if __name__ == "__main__":
    main()
