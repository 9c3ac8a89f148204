#!/usr/bin/python3
"""Gives a program, or a module of Python, the shared libraries that it needs, so that it runs where they are not installed.

Usage: carry.py BINARY LIBRARIES LICENCES [--leave PACKAGE]... [--built-in PACKAGE]...

Copies what the dynamic loader finds for BINARY into the folder LIBRARIES, but for the C library and the libraries of
packages that are to be left to the system, and makes all of them find each other there. Copies have names of their own
(a part of their checksum), so that a process which has the system's library of that name as well keeps both apart.
LICENCES gets the copyright of each package that a copy is from, or that is built in (headers), the common licences that
they refer to, and a list, with the source packages. Prints the version of the C library that is needed.

HDF5 as Debian builds it needs libcurl, for files on servers of Amazon, which Carom does not open, and with it 27 more, which
have to be kept up to date, and one of which (SASL) has a licence that does not go with the GPL. They are not carried:
tools/no_network.c stands in for them.
"""

import argparse
import functools
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys

NO_NETWORK = pathlib.Path(__file__).resolve().parent / "no_network"
STAND_IN = "libcarom_no_network.so"
REPLACED = re.compile(r"lib(curl|crypto)\.so")
C_LIBRARY = "libc6"
COMMON = pathlib.Path("/usr/share/common-licenses")


class CarryError(Exception):
    """The binary cannot be made to run elsewhere."""


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def found_by_loader(binary):
    """Place of each library that the loader finds for a binary, by name."""
    return dict(re.findall(r"^\s*(\S+) => (/\S+) \(", output("ldd", binary), re.MULTILINE))


def needed(binary):
    return output("patchelf", "--print-needed", binary).split()


@functools.cache
def package_of(library):
    """The Debian package that a library is from."""
    real = str(pathlib.Path(library).resolve())
    for name in (real, real.removeprefix("/usr")):  # as packages name it, which may be older than the merge of both
        done = subprocess.run(["dpkg-query", "-S", name], capture_output=True, text=True, check=False)
        if done.returncode == 0:
            return done.stdout.split(":")[0]
    raise CarryError(f"{library} is of no Debian package, so that its licence is not known")


def carried(binary, left):
    """(place, package) of each library that is to be copied, by the name under which others need it."""
    places, libraries, waiting = found_by_loader(binary), {}, [binary]
    while waiting:
        for name in needed(waiting.pop()):
            if name in libraries or REPLACED.match(name) or name.startswith("ld-linux"):
                continue
            if name not in places:
                raise CarryError(f"the dynamic loader does not find {name}, which {binary} needs")
            package = package_of(places[name])
            if package not in left:
                libraries[name] = (places[name], package)
                waiting.append(places[name])
    return libraries


def own_name(name, place):
    """libfmt.so.9 as libfmt-1a2b3c4d.so.9."""
    stem, dot, version = name.partition(".so")
    return f"{stem}-{hashlib.sha256(pathlib.Path(place).read_bytes()).hexdigest()[:8]}{dot}{version}"


def patch(file, *changes):
    """One change a call: patchelf 0.14 spoils its table of strings by several at once."""
    for change in changes:
        output("patchelf", *change, file)


def carry(binary, libraries, folder):
    """Copies the libraries into the folder; they and the binary find each other there."""
    folder.mkdir(parents=True)
    names = {name: own_name(name, place) for name, (place, _) in libraries.items()}
    for name, (place, _) in libraries.items():
        shutil.copyfile(place, folder / names[name])
        patch(folder / names[name], ["--set-soname", names[name]])
    if any(REPLACED.match(name) for place, _ in libraries.values() for name in needed(place)):
        output("cc", "-shared", "-fPIC", "-O1", "-s", f"-Wl,-soname,{STAND_IN}", f"-Wl,--version-script={NO_NETWORK}.map",
               "-o", folder / STAND_IN, f"{NO_NETWORK}.c")
    for file in [binary, *(folder / name for name in names.values())]:
        new = {name: STAND_IN if REPLACED.match(name) else names.get(name) for name in needed(file)}
        pairs = [word for old, given in new.items() if given for word in ("--replace-needed", old, given)]
        if pairs:
            patch(file, pairs)
        # RPATH: a RUNPATH would come after LD_LIBRARY_PATH.
        patch(file, ["--force-rpath", "--set-rpath", f"$ORIGIN/{os.path.relpath(folder, file.parent)}"])


def check(binary, folder, left):
    """That all is found, in the folder or in the packages that are left to the system, functions too."""
    lines = output("ldd", "-r", binary).splitlines()
    wrong = [line for line in lines if "not found" in line or re.search(r"undefined symbol: (?!_?Py)", line)]
    strange = [place for place in found_by_loader(binary).values()
               if pathlib.Path(place).resolve().parent != folder.resolve() and package_of(place) not in left]
    if wrong or strange:
        raise CarryError(f"{binary} would not run elsewhere:\n" + "\n".join(wrong + strange))


def write_licences(folder, libraries, built_in):
    """Copyright of each package, the common licences that they name, and what is from where."""
    folder.mkdir(parents=True)
    packages = sorted({package for _, package in libraries.values()} | set(built_in))
    text = ""
    for package in packages:
        copyright_file = pathlib.Path("/usr/share/doc", package, "copyright")
        text += copyright_file.read_text(encoding="utf-8")
        shutil.copyfile(copyright_file, folder / f"{package}.txt")
    for name in sorted(set(re.findall(rf"{COMMON}/([A-Za-z0-9.-]*[A-Za-z0-9])", text)) | {"GPL-3"}):
        shutil.copyfile(COMMON / name, folder / f"{name}.txt")
    sources = dict(line.split(" ", 1) for line in output(
        "dpkg-query", "-W", "-f", "${Package} ${source:Package} ${source:Version}\n", *packages).splitlines())
    lines = ["What is carried, or built in, and the source package of Debian that it is made from:", ""]
    lines += [f"{name}: {sources[package]}" for name, (_, package) in sorted(libraries.items())]
    lines += [f"{package} (built in): {sources[package]}" for package in sorted(built_in)]
    (folder / "SOURCES.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")


def oldest_c_library(files):
    """The version of the C library that the files need, by the versions of its symbols."""
    versions = re.findall(r"GLIBC_(\d+)\.(\d+)", output("objdump", "-T", *files))
    return ".".join(map(str, max((int(major), int(minor)) for major, minor in versions)))


def main():
    parser = argparse.ArgumentParser()
    for name in ("binary", "libraries", "licences"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--leave", nargs="*", default=[])
    parser.add_argument("--built-in", nargs="*", default=[])
    given = parser.parse_args()
    left = {C_LIBRARY, *given.leave}
    try:
        libraries = carried(given.binary, left)
        carry(given.binary, libraries, given.libraries)
        check(given.binary, given.libraries, left)
        write_licences(given.licences, libraries, given.built_in)
        print(oldest_c_library([given.binary, *given.libraries.iterdir()]))
    except CarryError as error:
        return f"tools/carry.py: {error}"
    except subprocess.CalledProcessError as error:
        return f"tools/carry.py: {error}\n{error.stderr}"
    return 0


if __name__ == "__main__":
    sys.exit(main())
