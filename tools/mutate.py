#!/usr/bin/python3
"""A mutation trial: changes one operator or constant of src/ at a time and looks whether the unit tests notice.

Usage: mutate.py [FOLDER] [--count 300] [--seed 1] [--jobs N] [--seconds S] [--budget S] [--cmake ARGUMENT]...

FOLDER (build/mutation) becomes a copy of the tree with all mutants in it (tools/mutants.py), compiled once; mutants
that do not compile are taken out. Each test program then runs once without a mutant, and it is noted which mutants
each test reaches. Last, for each mutant, the tests that reach it run until one fails: those of the program of its
folder first, the quick ones first, as many as take --budget seconds without a mutant. Three times that time and ten
seconds more, and it counts as killed. Tests that fail without a mutant, because they compare the sources, do not take
part. Called again, the script goes on where it ended. After --seconds it begins no other mutant. It leaves its table
in FOLDER/mutation.md and FOLDER/results.json.
"""

import argparse
import collections
import concurrent.futures
import dataclasses
import json
import os
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time

import mutants

ROOT = pathlib.Path(__file__).resolve().parent.parent
SPARE = 1.15  # drawn for one wanted, since some do not compile
CAPACITY = 4096  # of tests/mutation/mutants.hpp, bytes of the file of mutants reached
NOT_BUILT = {"python"}  # folders of src that no program of unit tests holds
FILE_LIMIT, MEMORY_LIMIT = 1 << 30, 8 << 30  # bytes that a process of a mutant may write into one file, and have
STEPS = (2.0, 8.0, 30.0)  # seconds of tests after which it is seen whether one has failed


class Trial:
    """The folder of a trial, and what is kept in it."""

    def __init__(self, folder):
        self.folder = folder
        self.tree, self.build = folder / "tree", folder / "build"
        self.drawn, self.reach, self.results = folder / "drawn.json", folder / "reach.json", folder / "results.json"

    def load_mutants(self):
        return [mutants.Mutant(**row) for row in json.loads(self.drawn.read_text())]

    def save_mutants(self, chosen):
        self.drawn.write_text(json.dumps([dataclasses.asdict(mutant) for mutant in chosen], indent=1))

    def programs(self):
        return sorted(path for path in (self.build / "tests").glob("*_tests"))


def sources():
    """{name: text} of the files of src that are tried."""
    found = sorted(path for path in (ROOT / "src").rglob("*.?pp"))
    names = {path.relative_to(ROOT): path for path in found}
    return {str(name): path.read_text() for name, path in names.items() if name.parts[1] not in NOT_BUILT}


def prepare(trial, count, seed):
    """The copy of the tree, with the header of mutants and the listener of the tests."""
    if trial.drawn.exists():
        return
    trial.folder.mkdir(parents=True, exist_ok=True)
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True, text=True).stdout
    for name in filter(None, listed.split("\0")):
        target = trial.tree / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if (ROOT / name).is_file():
            shutil.copy2(ROOT / name, target)
    main = trial.tree / "tests/main.cpp"
    text = main.read_text()
    called = "testing::InitGoogleTest(&argc, argv);\n"
    if text.count(called) != 1:
        raise SystemExit("mutate: tests/main.cpp does not initialise GoogleTest as it did")
    text = text.replace(called, called + "  mutants::listen();\n")
    main.write_text(f'#include "{ROOT}/tests/mutation/listener.hpp"\n{text}')
    chosen = mutants.draw(sources(), int(count * SPARE), random.Random(seed))
    write(trial, chosen, {mutant.file for mutant in chosen})
    trial.save_mutants(chosen)


def write(trial, chosen, files):
    """Writes the named files of src anew, with what is left of the mutants. They keep their times: what has compiled
    with a mutant that is taken out, because it does not compile elsewhere, need not be compiled again."""
    for file in sorted(files):
        text, target = (ROOT / file).read_text(), trial.tree / file
        written = target.stat()
        target.write_text(mutants.write_in(text, [mutant for mutant in chosen if mutant.file == file]))
        os.utime(target, ns=(written.st_atime_ns, written.st_mtime_ns))


def configure(trial, arguments):
    if (trial.build / "build.ninja").exists():
        return
    subprocess.run(["cmake", "-G", "Ninja", "-S", trial.tree, "-B", trial.build,
                    "-DCMAKE_BUILD_TYPE=Release", "-DCAROM_TESTS=ON",
                    f"-DCMAKE_CXX_FLAGS=-include {ROOT}/tests/mutation/mutants.hpp -w -Wno-narrowing",
                    "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DCAROM_TEST_OPTIMISATION=-O0", *arguments],
                   check=True, stdout=subprocess.DEVNULL)


def compile_all(trial, jobs):
    """Compiles the tree, and takes out what does not compile until it does."""
    while True:
        programs = [f"tests/{name}_tests" for name in groups(ROOT)] + ["carom"]
        done = subprocess.run(["ninja", "-C", trial.build, "-k", "0", "-j", str(jobs), *programs],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode == 0:
            return
        chosen = trial.load_mutants()
        bad = guilty(done.stdout, chosen)
        if not bad:
            raise SystemExit(done.stdout[-4000:] + "\nmutate: the tree does not compile, and no mutant is named")
        left = [mutant for mutant in chosen if mutant.number not in bad]
        write(trial, left, {mutant.file for mutant in chosen if mutant.number in bad})
        trial.save_mutants(left)
        print(f"taken out, since they do not compile: {len(bad)}; left: {len(left)}", flush=True)


def guilty(output, chosen):
    """Numbers of the mutants on lines that the compiler names: in errors, or else in what it says beside them."""
    places = collections.defaultdict(set)
    for mutant in chosen:
        for line in range(mutant.line, mutant.line + 1 + mutant.before.count("\n")):
            places[(mutant.file, line)].add(mutant.number)
    for kind in (r" (?:fatal )?error:", ""):
        named = re.findall(rf"(src/[\w/]+\.[ch]pp):(\d+):(?:\d+:)?{kind}", output)
        bad = set().union(*(places[(file, int(line))] for file, line in named))
        if bad:
            return bad
    return set()


def groups(root):
    """{program: the folders that it tests}, as tests/unit/CMakeLists.txt has them."""
    text = (root / "tests/unit/CMakeLists.txt").read_text()
    return {found[1]: found[2].split() for found in re.finditer(r"^carom_tests\((\w+) ([\w ]+)\)", text, re.MULTILINE)}


def environment(extra):
    """As the tests are run by ctest, but with a folder of their own for what they write."""
    return {**os.environ, "OMP_WAIT_POLICY": "passive", **extra}


def long_ones(root):
    """Patterns of the tests that take long and run what others run too: those that the preset `sanitize` leaves out by
    part of their names. Whole suites (^Threads) are left out there because of the sanitizers."""
    presets = json.loads((root / "CMakePresets.json").read_text())["testPresets"]
    left_out = next(preset for preset in presets if preset["name"] == "sanitize")["filter"]["exclude"]["name"]
    return [f"*{name}*" for name in left_out.split("|") if not name.startswith("^")]


def find_reach(trial, jobs):
    """Runs every program of tests once, and keeps for each test: program, seconds, mutants reached."""
    if trial.reach.exists():
        return
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        tests = {}
        for program, found in pool.map(lambda path: (path.name, reach_of(trial, path)), trial.programs()):
            print(f"{program}: {len(found)} tests, {sum(test['seconds'] for test in found.values()):.1f} s", flush=True)
            tests.update({f"{program}:{name}": test for name, test in found.items()})
    trial.reach.write_text(json.dumps(tests, indent=0))


def reach_of(trial, path):
    log = trial.folder / f"{path.name}.log"
    if not log.exists() or not log.read_text().endswith("end\n"):
        log.write_text("")
        run_all(path, log)
        with log.open("a") as file:
            file.write("end\n")
    found = {}
    for line in log.read_text().splitlines()[:-1]:
        name, seconds, passed, reached = line.split("\t")
        if passed == "1":
            found[name] = {"program": path.name, "seconds": float(seconds),
                           "reached": [int(number) for number in reached.split()]}
    return found


def run_all(path, log):
    """Runs all tests of a program into the log; where one ends the program, those after it in another process."""
    left_out = long_ones(ROOT)
    while True:
        with tempfile.TemporaryDirectory(prefix="mutate_", ignore_cleanup_errors=True) as folder:
            shared, flags = pathlib.Path(folder) / "reached", pathlib.Path(folder) / "flags"
            shared.write_bytes(bytes(CAPACITY))
            flags.write_text("--gtest_filter=-" + ":".join(left_out) + "\n")
            code, output = run(path, [f"--gtest_flagfile={flags}"], folder,
                               {"MUTANTS_REACHED": str(shared), "MUTANTS_LOG": str(log)})
        if code in (0, 1):
            return
        done = [line.split("\t")[0] for line in log.read_text().splitlines()]
        begun = re.findall(r"\[ RUN      \] ([\w./]+)", output)
        if not begun or begun[-1] in done:
            raise SystemExit(f"mutate: {path.name} ends with {code}, and not in a test\n{output[-2000:]}")
        print(f"{path.name}: {begun[-1]} ends the program without a mutant, and does not take part", flush=True)
        left_out += [*done, begun[-1]]


def limit():
    resource.setrlimit(resource.RLIMIT_FSIZE, (FILE_LIMIT, FILE_LIMIT))
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY_LIMIT, MEMORY_LIMIT))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(path, arguments, folder, extra, seconds=None):
    """Runs a program of tests, and the processes that it starts, with a folder to write into. Its exit code and output;
    None for the code if it was still running at the end of its time."""
    with (pathlib.Path(folder) / "output").open("w+", errors="replace") as output:
        process = subprocess.Popen([path, *arguments], cwd=folder, env=environment({"TMPDIR": folder, **extra}),
                                   stdout=output, stderr=subprocess.STDOUT, preexec_fn=limit, start_new_session=True)
        try:
            code = process.wait(seconds)
        except subprocess.TimeoutExpired:
            code = None
        try:
            os.killpg(process.pid, 9)
        except ProcessLookupError:
            pass
        process.wait()
        output.seek(0)
        return code, output.read()[-100000:]


def batches(number, file, tests, budget):
    """The tests that reach a mutant, as lists to be run one after the other: [(program, names, seconds)]."""
    own = {f"{group}_tests" for group, folders in groups(ROOT).items() if file.split("/")[1] in folders}
    reaching = [(test["program"] not in own, test["seconds"], test["program"], key.split(":", 1)[1])
                for key, test in tests.items() if number in test["reached"]]
    steps, total, found = list(STEPS), 0.0, []
    step = collections.defaultdict(list)
    for _, seconds, program, name in sorted(reaching):
        if total + seconds > budget and total > 0.0:
            continue
        total += seconds
        step[program].append((name, seconds))
        if steps and total > steps[0]:
            steps = [bound for bound in steps if bound > total]
            found.append(step)
            step = collections.defaultdict(list)
    return [(program, [name for name, _ in named], sum(seconds for _, seconds in named))
            for step in (*found, step) for program, named in step.items()], len(reaching)


def attempt(trial, mutant, tests, budget):
    """What became of a mutant: a row of the results."""
    todo, reaching = batches(mutant.number, mutant.file, tests, budget)
    row = {**dataclasses.asdict(mutant), "reaching": reaching, "run": 0,
           "result": "survived" if reaching else "not reached"}
    begin = time.monotonic()
    for program, names, seconds in todo:
        with tempfile.TemporaryDirectory(prefix="mutate_", ignore_cleanup_errors=True) as folder:
            flags = pathlib.Path(folder) / "flags"
            flags.write_text("--gtest_filter=" + ":".join(names) + "\n")
            code, output = run(trial.build / "tests" / program, [f"--gtest_flagfile={flags}", "--gtest_fail_fast"],
                               folder, {"MUTANT": str(mutant.number)}, 3.0 * seconds + 10.0)
        row["run"] += len(names)
        if code != 0:
            failed = re.search(r"\[  FAILED  \] ([\w./]+)", output)
            started = re.findall(r"\[ RUN      \] ([\w./]+)", output)
            how = "failed" if failed else "time" if code is None else "crashed"
            row.update(result="killed", how=how, program=program, by=failed[1] if failed else (started or [""])[-1])
            break
    row["seconds"] = round(time.monotonic() - begin, 1)
    return row


def try_all(trial, options):
    """Tries the mutants that have no result yet, until the time is over."""
    tests = json.loads(trial.reach.read_text())
    for test in tests.values():
        test["reached"] = set(test["reached"])
    rows = {row["number"]: row for row in json.loads(trial.results.read_text())} if trial.results.exists() else {}
    chosen = trial.load_mutants()[:options.count]
    end = time.monotonic() + options.seconds

    def one(mutant):
        return attempt(trial, mutant, tests, options.budget) if time.monotonic() < end else None

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        todo = [mutant for mutant in chosen if mutant.number not in rows]
        for row in filter(None, pool.map(one, todo)):
            rows[row["number"]] = row
            trial.results.write_text(json.dumps(list(rows.values()), indent=1))
            print(f"{row['number']:4} {row['result']:11} {row['seconds']:6.1f} s  {row['file']}:{row['line']}",
                  flush=True)
    return list(rows.values())


def table(rows):
    """The results as a page: figures by folder, then what was not killed, then who killed how many."""
    counts = collections.defaultdict(collections.Counter)
    for row in rows:
        for folder in (row["file"].split("/")[1], "all"):
            counts[folder][row["result"]] += 1
    lines = ["| folder | mutants | killed | survived | not reached |", "|---|---|---|---|---|"]
    for folder in [*sorted(key for key in counts if key != "all"), "all"]:
        count = counts[folder]
        cells = [folder, sum(count.values()), count["killed"], count["survived"], count["not reached"]]
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    lines += ["", "| place | before | after | result | tests run, of those that reach it |", "|---|---|---|---|---|"]
    for row in sorted(rows, key=lambda row: (row["file"], row["line"])):
        if row["result"] != "killed":
            before, after = (" ".join(row[key].split()).replace("|", "\\|") for key in ("before", "after"))
            lines.append(f"| `{row['file']}:{row['line']}` | `{before}` | `{after}` | {row['result']} | "
                         f"{row['run']} of {row['reaching']} |")
    killers = collections.Counter((row["program"], row["how"]) for row in rows if row["result"] == "killed")
    lines += ["", "| killed by | how | mutants |", "|---|---|---|"]
    lines += [f"| `{program}` | {how} | {count} |" for (program, how), count in sorted(killers.items())]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", default=ROOT / "build/mutation", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--seconds", type=float, default=1e9)
    parser.add_argument("--budget", type=float, default=60.0)
    parser.add_argument("--cmake", action="append", default=[])
    options = parser.parse_args()
    if options.count * SPARE >= CAPACITY:
        parser.error(f"more than {int(CAPACITY / SPARE)} mutants at once")
    trial = Trial(options.folder.resolve())
    prepare(trial, options.count, options.seed)
    configure(trial, options.cmake)
    compile_all(trial, options.jobs)
    find_reach(trial, options.jobs)
    rows = try_all(trial, options)
    (trial.folder / "mutation.md").write_text(table(rows))
    killed = sum(row["result"] == "killed" for row in rows)
    print(f"mutate: {killed} of {len(rows)} mutants killed, {killed / max(1, len(rows)):.1%}; "
          f"{trial.folder}/mutation.md")
    return 0


if __name__ == "__main__":
    sys.exit(main())
