#!/usr/bin/python3
"""Checks that no two types of src/ have the same name in the same namespace.

Usage: check_types.py [ROOT]. Two classes of one name in two files that never see each other are no error for compiler
and linker, which then takes the functions of one of them for both (C++ calls it undefined: the one-definition rule,
[basic.def.odr]). Names in unnamed namespaces are their file's own. Prints each offence and exits with 1 if there is
any.
"""

import collections
import pathlib
import re
import sys

OPENS = re.compile(r"namespace (?:([\w:]+) )?\{")
CLOSES = re.compile(r"\}  // namespace")
# At the beginning of a line: clang-format indents nothing within namespaces, and all that is within types.
TYPE = re.compile(r"(?:struct|class|union|enum(?: class)?)(?: alignas\(\w+\))? (\w+)(?: final)?(?: : [^:].*)?"
                  r" ?(?:\{|$)")


def types_of(text):
    """Line number and full name of every type that a file defines outside unnamed namespaces."""
    spaces = []
    for number, line in enumerate(text.splitlines(), 1):
        if opens := OPENS.match(line):
            spaces.append(opens[1])
        elif CLOSES.match(line) and spaces:
            spaces.pop()
        elif (found := TYPE.match(line)) and None not in spaces:
            yield number, "::".join([*spaces, found[1]])


def main(root):
    places = collections.defaultdict(list)
    for path in sorted(p for p in (root / "src").rglob("*") if p.suffix in {".hpp", ".cpp", ".h"}):
        for number, name in types_of(path.read_text(encoding="utf-8")):
            places[name].append(f"{path.relative_to(root)}:{number}")
    twice = {name: where for name, where in places.items() if len(where) > 1}
    for name, where in sorted(twice.items()):
        print(f"{where[0]}: {name} is defined in {', '.join(where[1:])} as well: give one of them another name")
    if twice:
        return 1
    print(f"types: {len(places)} names, each of one type")
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)))
