"""Runs that are made wrong on purpose: none may be called good without a word that names the cause.

    wrong_on_purpose_test.py PROGRAM [NAME...]

Every case below is a sound one with one mistake in it. A mistake is caught where `carom run` refuses the case, ends with
an error or a failed verdict, or warns, in words that match the mistake; the words of a warning must stand in summary.json.
The sound cases themselves must run without any warning: a warning that always comes says nothing.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

STEEL = """
[materials.steel]
law = "linear_elastic"
E = 2.1e11
nu = 0.3
rho = 7800.0
"""

BLOCK = """
[[mesh.block]]
size = [0.1, 0.1, 0.2]
divisions = [3, 3, 6]
groups = { cells = "BLOCK", zmin = "FOOT", zmax = "TOP", xmin = "SIDE" }
[[part]]
name = "block"
cells = "BLOCK"
material = "steel"
"""

FLOOR = """
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, -1e-4]
normal = [0.0, 0.0, 1.0]
"""

FALL = """
[[initial]]
part = "block"
velocity = [0.0, 0.0, -2.0]
"""

EXPLICIT = """
[scheme]
kind = "central_differences"
[time]
end = 2e-4
[output]
fields = []
"""

PROBE = """
[[probe]]
name = "top"
group = "TOP"
quantities = ["velocity"]
"""

LID = """
[[mesh.block]]
origin = [0.0, 0.0, 0.2001]
size = [0.1, 0.1, 0.1]
divisions = [2, 2, 2]
groups = { cells = "LID", zmin = "UNDER", zmax = "OVER" }
[[part]]
name = "lid"
cells = "LID"
material = "steel"
[[initial]]
part = "lid"
velocity = [0.0, 0.0, -2.0]
"""

PAIR = """
[[contact]]
name = "touch"
kind = "pair"
group = "TOP"
master = "UNDER"
"""

GRAVITY = """
[[load]]
gravity = [0.0, 0.0, -9.81]
"""

SHEET = """
[[mesh.block]]
kind = "quad"
origin = [-0.1, -0.1, -1e-4]
size = [0.3, 0.3]
divisions = [1, 1]
groups = { cells = "SHEET" }
[[contact]]
name = "sheet"
kind = "surface"
surface = "SHEET"
group = "FOOT"
"""

STOP = """
[[contact]]
name = "stop"
kind = "stop"
group = "FOOT"
normal = [0.0, 0.0, 1.0]
gap = 1e-4
stiffness = 1e8
damping = 0.0
"""

STRIP = """
[[mesh.block]]
kind = "quad"
size = [0.2, 0.01]
divisions = [80, 4]
groups = { cells = "STRIP", xmin = "ROOT", xmax = "TIP", ymax = "FACE" }
[[part]]
name = "strip"
cells = "STRIP"
material = "steel"
section = "plane_strain"
[[support]]
nodes = "ROOT"
blocked = ["x", "y"]
[[load]]
group = "TIP"
force = [0.0, -10.0, 0.0]
[scheme]
kind = "statics"
[time]
end = 1.0
step = 1.0
[output]
fields = []
"""

SOFT_BLOCKS = """
[materials.foam]
law = "neo_hookean"
E = 1e6
nu = 0.3
rho = 1000.0
[[mesh.block]]
size = [0.1, 0.1, 0.1]
divisions = [4, 4, 4]
groups = { cells = "LOW", zmax = "LOW_TOP" }
[[mesh.block]]
origin = [0.0, 0.0, 0.11]
size = [0.1, 0.1, 0.1]
divisions = [4, 4, 4]
groups = { cells = "HIGH", zmin = "HIGH_FOOT" }
[[part]]
name = "low"
cells = "LOW"
material = "foam"
[[part]]
name = "high"
cells = "HIGH"
material = "foam"
[[initial]]
part = "high"
velocity = [0.0, 0.0, -1.0]
[[contact]]
name = "touch"
kind = "pair"
group = "HIGH_FOOT"
master = "LOW_TOP"
[scheme]
kind = "central_differences"
[time]
end = 0.02
[output]
fields = []
curves_every = 20
"""

SOUND = {
    "fall": 'units = "SI"' + STEEL + BLOCK + FLOOR + FALL + PROBE + EXPLICIT,
    "pair": 'units = "SI"' + STEEL + BLOCK + LID + PAIR + EXPLICIT,
    "sheet": 'units = "SI"' + STEEL + BLOCK + SHEET + FALL + EXPLICIT,
    "stop": 'units = "SI"' + STEEL + BLOCK + STOP + FALL + EXPLICIT,
    "strip": 'units = "SI"' + STEEL + STRIP,
    "soft": 'units = "SI"' + SOFT_BLOCKS,
}


def changed(name, *changes):
    """A sound case with changes: (old, new) replaces, a text is put before the first section."""
    text = SOUND[name]
    for old, new in changes:
        assert old in text, (name, old)
        text = text.replace(old, new, 1)
    return text


UNITS = 'units = "SI"'
FULL = ('section = "plane_strain"', 'section = "plane_strain"\nformulation = "full"')
ONE_POINT = ('section = "plane_strain"', 'section = "plane_strain"\nformulation = "one_point"')

# name: case, what must be said
WRONG = {
    "contact too soft": (changed("fall", ("group = \"FOOT\"\npoint", "group = \"FOOT\"\nstiffness = 1e10\npoint")),
                         r"\"floor\" is soft"),
    "contact too stiff": (changed("fall", ("group = \"FOOT\"\npoint", "group = \"FOOT\"\nstiffness = 1e15\npoint")),
                          r"times stiffer than a cell"),
    "bodies fast enough to tunnel": (changed("soft", ("-1.0]", "-400.0]"), ("end = 0.02", "end = 0.001")),
                                     r"\"touch\" is soft|overlap|penetration|inside out|inverted"),
    "half of the mesh in no part": (changed("pair", ("[[part]]\nname = \"lid\"\ncells = \"LID\"\nmaterial = \"steel\"\n", ""),
                                            ("[[initial]]\npart = \"lid\"\nvelocity = [0.0, 0.0, -2.0]\n", FALL),
                                            (PAIR, FLOOR)),
                                    r"cells that nothing takes: 8 HEXA8 in \"LID\""),
    "one cell through a bent plate": (changed("strip", ("divisions = [80, 4]", "divisions = [10, 1]"), FULL),
                                      r"will lock where it bends"),
    "one soft point through it": (changed("strip", ("divisions = [80, 4]", "divisions = [80, 1]"), ONE_POINT),
                                  r"bends too easily"),
    "nearly incompressible": (changed("strip", ("nu = 0.3", "nu = 0.4995"), FULL), r"lock"),
    "incompressible but for rounding": (changed("fall", ("nu = 0.3", "nu = 0.499999")), r"nu = 0.499999 makes the bulk modulus"),
    "implicit step across all cells": (changed("fall", ("central_differences", "newmark"), ("end = 2e-4", "end = 1e-2\nstep = 1e-3")),
                                       r"Courant number"),
    "explicit step too long": (changed("fall", ("end = 2e-4", "end = 2e-4\nstep = 1e-5")), r"stable"),
    "Newmark that is not stable": (changed("fall", ("\"central_differences\"", "\"newmark\"\nbeta = 0.05\ngamma = 0.5"),
                                           ("end = 2e-4", "end = 2e-4\nstep = 1e-5")), r"stable for small steps only"),
    "contact on the far side": (changed("fall", ("group = \"FOOT\"\npoint", "group = \"TOP\"\npoint")), r"looks at the obstacle"),
    "pair of faces that look away": (changed("pair", ("group = \"TOP\"", "group = \"FOOT\"")), r"looks at a face of \"UNDER\""),
    "back of a rigid surface": (changed("sheet", ("group = \"FOOT\"", "group = \"TOP\""), ("-1e-4]\nsize", "0.2001]\nsize"),
                                        ("velocity = [0.0, 0.0, -2.0]", "velocity = [0.0, 0.0, 2.0]")), r"look away from"),
    "two contacts on the same faces": (changed("fall", (FLOOR, FLOOR + FLOOR.replace("\"floor\"", "\"ground\""))),
                                       r"that \"floor\" \(line \d+\) sees already"),
    "a pair beside contact of all": (changed("pair", (PAIR, PAIR + "[[contact]]\nname = \"every\"\nkind = \"all\"\n")),
                                     r"that \"touch\" \(line \d+\) sees already"),
    "gravity twice": (changed("fall", (FALL, FALL + GRAVITY + GRAVITY)), r"counts twice"),
    "load twice": (changed("strip", ("[scheme]", "[[load]]\ngroup = \"TIP\"\nforce = [0.0, -10.0, 0.0]\n[scheme]")), r"counts twice"),
    "gap with the wrong sign": (changed("fall", ("point = [0.0, 0.0, -1e-4]", "point = [0.0, 0.0, 1e-4]")), r"penetrate at the start"),
    "density in t/mm3": (changed("fall", ("rho = 7800.0", "rho = 7.8e-9"), ("end = 2e-4", "end = 2e-10")), r"density"),
    "modulus in MPa": (changed("fall", ("E = 2.1e11", "E = 2.1e5")), r"is E in"),
    "gravity in m/s2 among mm": (changed("strip", (UNITS, 'units = "mm-t-s"'), ("2.1e11", "2.1e5"), ("7800.0", "7.8e-9"),
                                         ("[scheme]", "[[load]]\ngravity = [0.0, -9.81, 0.0]\n[scheme]")), r"earth's gravity"),
    "probe far away": (changed("fall", ("group = \"TOP\"\nquantities", "point = [1000.0, 0.0, 0.0]\nquantities")), r"from the nearest node"),
    "side of a section in its plane": (changed("fall", ("quantities = [\"velocity\"]", "quantities = [\"section_force\"]\nside = [1.0, 0.0, 0.0]")),
                                       r"lies in the plane of the section"),
    "velocity with the wrong sign": (changed("fall", ("-2.0]", "2.0]")), r"nothing moves towards it"),
    "end before the impact": (changed("fall", ("end = 2e-4", "end = 2e-5")), r"not reached before the end"),
    "bodies that pass by": (changed("pair", ("velocity = [0.0, 0.0, -2.0]", "velocity = [5000.0, 0.0, -0.1]"),
                                    ("origin = [0.0, 0.0, 0.2001]", "origin = [0.0, 0.0, 0.4]")), r"do not come together"),
    "velocity of all, a held block among them": (changed("pair", ("part = \"lid\"\nvelocity", "nodes = \"all\"\nvelocity"),
                                                         (PAIR, PAIR + "[[support]]\nnodes = \"FOOT\"\nblocked = [\"x\", \"y\", \"z\"]\n")),
                                                 r"gives part \"block\" a velocity along z that support\[0\].*part = \"lid\""),
    "a velocity that the next section overwrites": (changed("fall", (FALL, FALL + FALL.replace("velocity = [0.0, 0.0, -2.0]", "drop_height = 0.2") + GRAVITY)),
                                                    r"is without effect"),
    "a fall counted twice": (changed("fall", (FALL, FALL + "drop_height = 0.2\n" + GRAVITY)), r"the two are added"),
    "a fall away from the floor": (changed("fall", (FALL, FALL.replace("velocity = [0.0, 0.0, -2.0]", "drop_height = 0.2") + GRAVITY.replace("-9", "9"))),
                                   r"ahead of what falls"),
    "a height in mm": (changed("fall", (FALL, FALL.replace("velocity = [0.0, 0.0, -2.0]", "drop_height = 1000.0") + GRAVITY)),
                       r"is it written in another unit"),
    "a law of contact that ends too soon": (changed("fall", ("group = \"FOOT\"\npoint", "group = \"FOOT\"\ndepths = [1e-6]\npressures = [2e7]\npoint")),
                                            r"times the last of its `depths`"),
    "friction as an angle": (changed("fall", ("group = \"FOOT\"\npoint", "group = \"FOOT\"\nfriction = 30.0\npoint")), r"friction of 30"),
    "damper that eats the step": (changed("stop", ("damping = 0.0", "damping = 1e9"), ("end = 2e-4", "end = 2e-8")),
                                  r"damping makes the explicit step|not reached"),
    "rigid surface of a part's faces": (changed("pair", ("kind = \"pair\"\ngroup = \"TOP\"\nmaster = \"UNDER\"",
                                                         "kind = \"surface\"\ngroup = \"TOP\"\nsurface = \"UNDER\"")),
                                        r"faces of a part that can move"),
    "small strain that turns": (changed("fall", (FALL, FALL + "[[initial]]\nnodes = \"TOP\"\nvelocity = [300.0, 0.0, -2.0]\n"),
                                        (FLOOR, "")), r"small-strain|small strain"),
    "filter on sparse rows": (changed("fall", ("quantities = [\"velocity\"]", "quantities = [\"velocity\"]\ncfc = 1000"),
                                      ("[output]", "[output]\ncurves_every = 40")), r"filter"),
    "check of what is not there": (changed("fall", (PROBE, PROBE + "[[check]]\nquantity = \"velocity_w\"\nplace = \"top\"\nvalue = 2.0\ntolerance = 0.1\n")),
                                   r"which no table of this run holds"),
    "no inertia where the foot yields": (changed("fall", ("law = \"linear_elastic\"", "law = \"j2\"\nyield_stress = 2e7"),
                                                 ("central_differences", "modified_mass")), r"takes the inertia of contact nodes"),
    "load that nothing holds": (changed("strip", ("blocked = [\"x\", \"y\"]", "blocked = [\"x\"]")), r"no support and no contact holds|nothing holds"),
    "springs that take a part of the stroke": (changed("strip", ("[[load]]\ngroup = \"TIP\"\nforce = [0.0, -10.0, 0.0]",
                                                                 "[[support]]\nnodes = \"FACE\"\ndisplacement = { y = -2e-5, function = \"ramp\" }\n"
                                                                 "[functions.ramp]\ntime = [0.0, 1.0]\nvalue = [0.0, 1.0]\n"
                                                                 "[[contact]]\nname = \"bed\"\nkind = \"plane\"\ngroup = \"BED\"\n"
                                                                 "point = [0.0, 0.0, 0.0]\nnormal = [0.0, 1.0, 0.0]"),
                                                       ("[[support]]\nnodes = \"ROOT\"\nblocked = [\"x\", \"y\"]", "[[support]]\nnodes = \"ROOT\"\nblocked = [\"x\"]"),
                                                       ("ymax = \"FACE\"", "ymin = \"BED\", ymax = \"FACE\""),
                                                       ("kind = \"statics\"", "kind = \"statics\"\nenforcement = \"penalty\"")),
                                               r"of the motion that is imposed"),
    "restitution of a soft block": (changed("fall", ("group = \"FOOT\"\npoint", "group = \"FOOT\"\nrestitution = 0.5\npoint"),
                                            ("central_differences", "cd_lagrange")), r"restitution"),
    "small strain where cells are crushed": (changed("strip", ("[[load]]\ngroup = \"TIP\"\nforce = [0.0, -10.0, 0.0]",
                                                               "[[support]]\nnodes = \"TIP\"\ndisplacement = { x = -0.15, function = \"ramp\" }\n"
                                                               "[functions.ramp]\ntime = [0.0, 1.0]\nvalue = [0.0, 1.0]")), r"small.strain"),
    "key of 50,000 dots": (SOUND["fall"] + "\n" + "a." * 50000 + "b = 1\n", r"parts|dots|deep"),
    "formulation of other cells": (changed("strip", ("section = \"plane_strain\"", "section = \"plane_strain\"\nformulation = \"reduced\"")),
                                   r"formulation"),
    "mass of another world": (changed("fall", ("central_differences\"", "central_differences\"\nmass_scaling_step = 1e-4")), r"mass_scaling_limit"),
    "a second shift of the plane": (changed("fall", ("point = [0.0, 0.0, -1e-4]", "point = [0.0, 0.0, -1e-1]")), r"not reached before the end"),
    "two materials of one name": (SOUND["fall"] + STEEL, r"materials.steel|steel"),
    "text in UTF-16": (SOUND["fall"].encode("utf-16"), r"UTF-16.*save it as UTF-8"),
    "text in Latin-1": ((UNITS + "\ntitle = \"Stoß\"" + SOUND["fall"][len(UNITS):]).encode("latin-1"), r"Latin-1.*save it as UTF-8"),
}


class Run:
    def __init__(self, program, folder, text):
        case = folder / "case.toml"
        case.write_bytes(text if isinstance(text, bytes) else text.encode())
        done = subprocess.run([program, "run", case, "--quiet", "--threads", "1", "--out", folder / "out"],
                              capture_output=True, text=True, check=False, timeout=60)
        self.code, self.said = done.returncode, done.stderr
        summary = folder / "out" / "summary.json"
        self.summary = json.loads(summary.read_text()) if summary.exists() else None

    def warnings(self):
        return self.summary["warnings"] if self.summary else []


def fault_of_sound(run):
    if run.code != 0:
        return f"exit code {run.code}: {run.said}"
    return f"warned: {run.warnings()}" if run.warnings() else ""


def fault_of_wrong(run, words):
    what_is_said = "\n".join(run.warnings()) if run.code == 0 else run.said
    if re.search(words, what_is_said, re.DOTALL):
        return ""
    return f"exit code {run.code}, and nothing like /{words}/ in: {what_is_said or 'nothing'}"


def main():
    program, chosen = sys.argv[1], sys.argv[2:]
    faults = 0
    cases = [(name, text, None) for name, text in SOUND.items()]
    cases += [(name, text, words) for name, (text, words) in WRONG.items()]
    for name, text, words in cases:
        if chosen and name not in chosen:
            continue
        with tempfile.TemporaryDirectory() as folder:
            run = Run(program, pathlib.Path(folder), text)
        fault = fault_of_sound(run) if words is None else fault_of_wrong(run, words)
        print(f"{'ok  ' if not fault else 'FAIL'} {'sound' if words is None else 'wrong'}: {name}, exit {run.code}")
        if fault:
            faults += 1
            print("     " + fault.replace("\n", "\n     "))
    print(f"{len(WRONG)} wrong on purpose, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
