#!/usr/bin/env python3
"""Laws from libraries (docs/user_laws.md): those of examples/laws give the bits of the built-in ones in whole runs, the law of
the page gives Hooke's, and what cannot be used is refused before the run.

    python3 user_laws_test.py build/release/carom c++
"""

import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

CAROM = pathlib.Path(sys.argv[1]).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/user_laws.md").read_text()
SPRING = re.search(r"```c\n(.*?)```", PAGE, re.S).group(1)
FLAGS = ["-O3", "-march=x86-64-v2", "-fno-math-errno", "-fPIC", "-shared", f"-I{ROOT / 'src/material'}"]

# Neither turns by a degree, of which the warning names the law.
NEO = "E = 1e6\nnu = 0.3\nrho = 1000.0\n"
METAL = NEO + "yield_stress = 2e2\nhardening_modulus = 1e4\n"

CASE = """title = "box"
[[mesh.block]]
size = [1.0, 1.0, 2.0]
divisions = [3, 3, 5]
groups = { cells = "BOX", zmin = "FOOT", zmax = "TOP" }
[materials.m]
MATERIAL
[[part]]
name = "box"
cells = "BOX"
material = "m"
formulation = "FORMULATION"
[[support]]
nodes = "FOOT"
blocked = ["x", "y", "z"]
[[initial]]
nodes = "TOP"
velocity = [SPEED, 0.0, -SPEED]
[scheme]
kind = "SCHEME"
[time]
STEPS
[output]
checkpoint_every = 5
"""


def library_file(folder, source, name, *more, language="c++", standard="c++20"):
    """Compiles a text as the page says, for the instruction set that has no fused multiply-add."""
    file = pathlib.Path(folder) / (name + (".cpp" if language == "c++" else ".c"))
    file.write_text(source)
    command = [sys.argv[2], "-x", language, f"-std={standard}", *FLAGS, "-Wall", "-Wextra", "-Wno-psabi", "-Werror", *more]
    subprocess.run([*command, "-o", str(file.with_name(name + ".so")), str(file)], check=True)
    return name + ".so"


def spring(folder, name, *changes):
    """The law of the page, with changes of its text."""
    text = SPRING
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    return library_file(folder, text, name, "-pedantic", language="c", standard="c99")


class UserLawsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.folder.name)
        library_file(cls.root, (ROOT / "examples/laws/laws.cpp").read_text(), "laws")
        spring(cls.root, "spring")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def carom(self, *arguments, isa="v2"):
        done = subprocess.run([CAROM, *map(str, arguments)], capture_output=True, text=True, check=False,
                              env={**os.environ, "CAROM_ISA": isa}, cwd=self.root)
        return done.returncode, done.stdout + done.stderr

    def case(self, name, material, formulation="stabilised", scheme="central_differences", speed=0.2, more="",
             steps="step = 2e-3\nend = 0.05"):
        text = CASE.replace("MATERIAL", material).replace("FORMULATION", formulation).replace("SCHEME", scheme)
        text = text.replace("SPEED", str(speed)).replace("STEPS", steps) + more
        (self.root / name).mkdir(exist_ok=True)
        (self.root / name / "box.toml").write_text(text)
        return self.root / name / "box.toml"

    def run_case(self, case, threads=1, isa="v2"):
        """The results folder."""
        code, text = self.carom("run", case, "--quiet", "--threads", threads, "--out", case.parent / "out", isa=isa)
        self.assertIn(code, (0, 1), text)  # whatever the verdict on steps of this size
        return case.parent / "out"

    def bits(self, out):
        """The last state, without the header that says what case it is of, and the ledger."""
        last = max((out / "checkpoints").glob("*.h5"))
        return last.name, last.read_bytes()[1024:], (out / "energy.csv").read_text()

    def message(self, material, command="check", **options):
        code, text = self.carom(command, self.case("refused", material, **options))
        self.assertEqual(code, 2, text)
        return " ".join(text.split())


class Bits(UserLawsTest):
    def compare(self, built_in, own, values, speed):
        for formulation in ("full", "one_point", "stabilised"):
            for scheme in ("central_differences", "generalized_alpha"):
                with self.subTest(law=own, formulation=formulation, scheme=scheme):
                    options = {"formulation": formulation, "scheme": scheme, "speed": speed}
                    first = self.bits(self.run_case(self.case("run", f'law = "{built_in}"\n{values}', **options)))
                    case = self.case("run", f'library = "../laws.so"\nlaw = "{own}"\n{values}', **options)
                    for threads in (1, 2):
                        self.assertEqual(first, self.bits(self.run_case(case, threads)))
                    out = case.parent / "out"
                    max((out / "checkpoints").glob("*.h5")).unlink()  # goes on from the one before
                    code, text = self.carom("resume", out, "--quiet")
                    self.assertIn(code, (0, 1), text)
                    self.assertEqual(first, self.bits(out))
                    last = first[2].splitlines()
                    names = next(csv.reader([line for line in last if not line.startswith("#")][:1]))
                    plastic = float(last[-1].split(",")[names.index("plastic")])
                    self.assertEqual(plastic > 0.0, own == "metal")  # the metal yields, or nothing was compared

    def test_neo_hookean(self):
        self.compare("neo_hookean", "neo", NEO, 1.0)

    def test_metal(self):
        self.compare("j2_small_strain", "metal", METAL, 0.05)

    def test_far_from_rest(self):
        """Where ln J is by its exponent: compressed to a third."""
        for law, name in (('law = "neo_hookean"\n', "a"), ('library = "../laws.so"\nlaw = "neo"\n', "b")):
            code, text = self.carom("material", self.case(name, law + NEO), "--path", "uniaxial_strain", "--to",
                                    "-0.7,1.5", "--out", self.root / name / "path", isa="v2")
            self.assertEqual(code, 0, text)
        rows = [(self.root / n / "path/box.csv").read_text().split("\n", 2)[2] for n in "ab"]
        self.assertEqual(rows[0], rows[1])
        self.assertGreater(len(rows[0].splitlines()), 400)

    def test_modes_that_a_law_leaves_alone(self):
        """stay elastic, and the ledger closes."""
        text = (ROOT / "examples/laws/laws.cpp").read_text()
        for old, new in (("switch (b->lanes)", "Batch plain = *b; forget(plain); b = &plain; switch (b->lanes)"),
                         ("#define FOR_LANES", "void forget(carom_law_points& b) { b.yield_stress = b.share = 0; b.mode_square = 0; }\n"
                          "void forget(carom_law_changes& b) { b.mode_square = b.half_change = 0; b.share = b.along = 0; }\n"
                          "#define FOR_LANES")):
            self.assertIn(old, text)
            text = text.replace(old, new)
        library_file(self.root, text, "plain")
        for formulation in ("one_point", "stabilised"):
            for scheme in ("noh_bathe", "generalized_alpha"):
                case = self.case("plain_run", 'library = "../plain.so"\nlaw = "metal"\n' + METAL, formulation=formulation,
                                 scheme=scheme, speed=0.05, steps="step = 5e-4\nend = 0.05")
                names, *rows = csv.reader(x for x in (self.run_case(case) / "energy.csv").read_text().splitlines()
                                          if not x.startswith("#"))
                last = dict(zip(names, map(float, rows[-1])))
                self.assertGreater(last["plastic"], 0.0)
                self.assertGreater(last["hourglass"], 0.0)
                self.assertEqual(last["hourglass_loss"], 0.0)
                self.assertLess(abs(last["imbalance"]), 1e-9 * float(rows[0][names.index("kinetic")]))

    def test_page(self):
        """The law of the page is Hooke's: to the rounding of some sums in another order."""
        rows = []
        for law, name in (('law = "linear_elastic"\n', "a"), ('library = "../spring.so"\nlaw = "spring"\n', "b")):
            case = self.case(name, law + NEO, speed=0.01)
            out = self.run_case(case)
            lines = [x for x in (out / "energy.csv").read_text().splitlines() if not x.startswith("#")]
            rows.append(dict(zip(lines[0].split(","), map(float, lines[-1].split(",")))))
        self.assertGreater(rows[0]["strain"], 0.0)
        for key in ("kinetic", "strain"):
            self.assertLess(abs(rows[0][key] - rows[1][key]), 1e-10 * (rows[0]["kinetic"] + rows[0]["strain"]))

    def test_history_is_a_field(self):
        more = 'format = "vtu"\nfields = ["equivalent_plastic_strain", "plastic_strain_zz"]\n'
        case = self.case("fields", 'library = "../laws.so"\nlaw = "metal"\n' + METAL, more=more)
        frames = sorted((self.run_case(case) / "fields").glob("*.vtu"))
        text = frames[-1].read_bytes()
        self.assertIn(b'"plastic_strain_zz"', text)
        self.assertIn(b'"equivalent_plastic_strain"', text)
        code, text = self.carom("check", self.case("fields", 'library = "../laws.so"\nlaw = "metal"\n' + METAL,
                                                   more='fields = ["porosity"]\n'))
        self.assertEqual(code, 2)
        self.assertIn('output.fields[0]: found the unknown name "porosity"', " ".join(text.split()))


class Folders(UserLawsTest):
    """What names the library from elsewhere finds it."""

    material = 'library = "../laws.so"\nlaw = "metal"\n' + METAL

    def test_resolved_case(self):
        out = self.run_case(self.case("first", self.material, speed=0.05))
        code, text = self.carom("check", out / "case.resolved.toml")
        self.assertIn(code, (0, 1), text)
        self.assertRegex((out / "case.resolved.toml").read_text(), r'checksum = "[0-9a-f]{16}"')

    def test_initial_state(self):
        self.run_case(self.case("press", self.material, speed=0.05))
        more = '[initial_state]\nfrom = "../press/out"\n'
        out = self.run_case(self.case("impact", self.material, speed=0.05, more=more))
        names, *rows = csv.reader(x for x in (out / "energy.csv").read_text().splitlines() if not x.startswith("#"))
        self.assertGreater(float(rows[0][names.index("plastic")]), 0.0)  # the history has come along
        other = self.material.replace("hardening_modulus = 1e4", "hardening_modulus = 2e4")
        code, text = self.carom("check", self.case("impact", other, speed=0.05, more=more))
        self.assertEqual(code, 2)
        self.assertIn("materials.m.hardening_modulus", text)

    def test_compare(self):
        case = self.case("many", self.material, speed=0.05)
        code, text = self.carom("compare", case, "--scheme", "central_differences,noh_bathe", "--out", self.root / "variants")
        self.assertIn(code, (0, 1), text)
        self.assertEqual(len(list((self.root / "variants").rglob("energy.csv"))), 2, text)


class Refusals(UserLawsTest):
    def law(self, name="spring", law="spring", values=NEO):
        return f'library = "../{name}.so"\nlaw = "{law}"\n{values}'

    def test_libraries(self):
        self.assertIn('box.toml:7:11: materials.m.library: found "../nothing.so": no such file; expected a library with laws',
                      self.message(self.law("nothing")))
        (self.root / "text.so").write_text("no library")
        self.assertIn("expected a library with laws, made for this machine", self.message(self.law("text")))
        library_file(self.root, "int other() { return 1; }", "other")
        self.assertIn("a library without carom_laws()", self.message(self.law("other")))
        spring(self.root, "newer", ("{CAROM_LAW_INTERFACE,", "{CAROM_LAW_INTERFACE + 1,"))
        self.assertIn("found \"../newer.so\": a library for version 2 of the interface; expected version 1",
                      self.message(self.law("newer")))
        spring(self.root, "half", ("update, tangent", "0, tangent"), ("static void update", "void update"))
        self.assertIn('law "spring" without update', self.message(self.law("half")))
        spring(self.root, "unit", ('"stress"', '"pressure"'))
        self.assertIn('law "spring" with E in "pressure"', self.message(self.law("unit")))

    def test_keys(self):
        self.assertIn('materials.m.law: found "spring_2"; expected "spring". Did you mean "spring"?',
                      self.message(self.law(law="spring_2")))
        self.assertIn("materials.m.nu: found nothing; expected a number > -1 and < 0.5",
                      self.message(self.law(values="E = 1e6\nrho = 1000.0\n")))
        self.assertIn("box.toml:12:1: materials.m.mu: found an unknown key; expected one of law, rho, E, nu, library, checksum",
                      self.message(self.law(values=NEO + "mu = 0.3\n")))
        self.assertIn("materials.m.E: found -1.0; expected a number > 0 in Pa",
                      self.message(self.law(values="E = -1.0\nnu = 0.3\nrho = 1000.0\n")))
        spring(self.root, "picky", ("at_rest, 0, update", "at_rest, check, update"),
               ("static const carom_law laws",
                'static const char* check(const double* p) { return p[0] > 1e5 ? "E beyond 1e5" : 0; }\n'
                "static const carom_law laws"))
        self.assertIn("materials.m: found E beyond 1e5; expected values that the law takes", self.message(self.law("picky")))

    def test_what_every_law_must_be(self):
        """Each is the law of the page with one line wrong."""
        hooke = "stress[c * n + l] = pressure + 2 * G * strain[c * n + l];"
        wrong = {
            "pressed": ((hooke, hooke.replace("pressure", "1.0 + pressure")), "at strain 0 has a stress"),
            "lanes": (("if (b->energy) b->energy", "b->stress[6 * n * p] *= 1.5;\n      if (b->energy) b->energy"),
                      "answers 2 lanes otherwise than one"),
            "skew": ((hooke, hooke.replace("pressure", "pressure + (c == 1 ? 0.2 * G * strain[l] : 0)")),
                     "whose tangent is unsymmetric, by 0.0"),
            "slow": (("= lambda + 2 * G;", "= 0 * lambda;"), "whose wave_modulus at rest is 0"),
            "soft": (("*nu = parameters[1]", "*nu = 0.5 + parameters[1]"), "whose moduli at rest are E = 1e+06, nu = 0.8"),
        }
        for name, (change, expected) in wrong.items():
            with self.subTest(name):
                spring(self.root, name, change)
                self.assertIn(expected, self.message(self.law(name)))

    def test_no_tangent(self):
        spring(self.root, "bare", ("update, tangent", "update, 0"), ("static void tangent", "void tangent"))
        self.run_case(self.case("bare_run", self.law("bare"), speed=0.01))
        self.assertIn('scheme.kind: found "generalized_alpha" with the law "spring" of the part "box", which gives no tangent',
                      self.message(self.law("bare"), scheme="generalized_alpha"))

    def test_another_library(self):
        """A run goes on with the library that it began with, or not at all."""
        spring(self.root, "changing")
        case = self.case("changed", self.law("changing"), speed=0.01)
        out = self.run_case(case)
        max((out / "checkpoints").glob("*.h5")).unlink()
        whole = (self.root / "changing.so").read_bytes()
        spring(self.root, "changing", ('"1.0"', '"1.1"'))
        code, text = self.carom("resume", out, "--quiet")
        self.assertEqual(code, 2, text)
        self.assertRegex(" ".join(text.split()),
                         r"materials.m.checksum: found [0-9a-f]{16} of the library .*changing.so\", version 1.1; expected")
        (self.root / "changing.so").write_bytes(whole)
        code, text = self.carom("resume", out, "--quiet")
        self.assertIn(code, (0, 1), text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
