#!/usr/bin/python3
"""Checks the sizes of functions and files.

Usage: check_sizes.py [ROOT]. Fails on a C++ function above 100 lines, on a C++ or Python file above 600 lines and on a
JavaScript file above 300 lines in src/, tests/, bench/ and tools/ (files whose name holds `quadrature` or `generated`
apart). ESLint measures the functions and classes of JavaScript (.eslintrc.json). Prints the 90th percentile
of function lengths (aim: 30) and the median of file lengths (aim: 150) of src/.

Functions are found by matching braces: a brace opened outside of any function opens one when the text before it holds
a parameter list and is no namespace, type or initialiser. Lambdas count as part of the function that holds them.
"""

import pathlib
import re
import sys

FUNCTION_LIMIT = 100
FILE_LIMITS = {".cpp": 600, ".hpp": 600, ".py": 600, ".js": 300}
APART = re.compile(r"quadrature|generated")
# Comments, raw strings, strings, characters; a digit separator (1'000) is no character.
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Fa-f])\'(?:\\.|[^\'\\\n])+\'',
                      re.DOTALL)
DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.MULTILINE)
SCOPE = re.compile(r"\b(namespace|class|struct|union|enum|extern)\b")


def blank(match):
    """The matched text with everything but its line ends removed, so that line numbers stay."""
    return "\n" * match[0].count("\n") or " "


def strip_parentheses(text):
    """Text without what stands inside (...), keeping the outermost pairs as '()'."""
    kept, depth = [], 0
    for char in text:
        if char == "(":
            depth += 1
            if depth == 1:
                kept.append("()")
        elif char == ")":
            depth = max(0, depth - 1)
        elif depth == 0:
            kept.append(char)
    return "".join(kept)


def kind_of(head):
    """What a brace after `head` opens outside of a function: 'scope', 'function' or 'value' (an initialiser)."""
    if head.count("(") > head.count(")"):
        return "value"
    outer = strip_parentheses(re.sub(r"\btemplate\s*<[^;{}()]*>", " ", head)).strip()
    if "()" not in outer:
        return "scope" if SCOPE.search(outer) else "value"
    if re.search(r"^[^()]*[^=!<>]=[^=]", outer) and "operator" not in outer:
        return "value"
    # Inside a list of member initialisers a brace right after a name is a value: Foo() : a_{1} {...}
    if re.search(r"\(\)[^()]*:(?!:).*[\w>]$", outer) and not re.search(r"\b(const|noexcept|override|final)$", outer):
        return "value"
    return "function"


def functions(text):
    """Yields (first line, number of lines, head) of each function."""
    text = DIRECTIVE.sub(blank, NOT_CODE.sub(blank, text))
    stack, head_start, line = [], 0, 1
    for position, char in enumerate(text):
        if char == "\n":
            line += 1
        elif char == "{":
            inside = any(kind == "function" for kind, _, _ in stack)
            kind = "inner" if inside or (stack and stack[-1][0] == "value") else kind_of(text[head_start:position])
            head = text[head_start:position]
            begin = line - head.lstrip().count("\n")
            stack.append((kind, begin, " ".join(head.split())))
            if kind in ("scope", "function"):
                head_start = position + 1
        elif char == "}" and stack:
            kind, begin, head = stack.pop()
            if kind == "function":
                yield begin, line - begin + 1, head
            if kind in ("scope", "function"):
                head_start = position + 1
        elif char == ";" and not any(kind in ("function", "value") for kind, _, _ in stack):
            head_start = position + 1


def percentile(values, fraction):
    """The smallest value that at least `fraction` of the values do not exceed; 0 for no values."""
    ordered = sorted(values)
    return ordered[max(0, -int(-len(ordered) * fraction // 1) - 1)] if ordered else 0


def check(root):
    """Offences as lines of text, lengths of all functions of src/, lengths of all files of src/."""
    lines, lengths, file_lengths = [], [], []
    files = [path for folder in ("src", "tests", "bench", "tools") for path in sorted((root / folder).rglob("*"))
             if path.is_file() and path.suffix in FILE_LIMITS]
    for path in files:
        name = path.relative_to(root)
        text = path.read_text()
        count = text.count("\n")
        limit = FILE_LIMITS[path.suffix]
        if count > limit and not APART.search(path.name):
            lines.append(f"{name}: {count} lines, more than {limit}")
        in_src = name.parts[0] == "src"
        if in_src:
            file_lengths.append(count)
        if path.suffix not in (".cpp", ".hpp"):
            continue
        for begin, length, head in functions(text):
            if in_src:
                lengths.append(length)
            if length > FUNCTION_LIMIT and not APART.search(path.name):
                lines.append(f"{name}:{begin}: function of {length} lines, more than {FUNCTION_LIMIT}: {head[-100:]}")
    return lines, lengths, file_lengths


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    lines, lengths, file_lengths = check(root)
    for line in lines:
        print(line)
    print(f"sizes: {len(lengths)} functions in src, 90th percentile {percentile(lengths, 0.9)} lines, "
          f"longest {max(lengths, default=0)}; {len(file_lengths)} files, median {percentile(file_lengths, 0.5)} lines, "
          f"longest {max(file_lengths, default=0)}")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
