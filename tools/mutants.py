"""Places in C++ sources where one operator or constant can be another one, and the sources with both written in.

A mutant is one such change. All of them are compiled at once: in the place of `a + b` stands
`(mutants::on(17) ? (a - b) : (a + b))`, which is the original unless the environment variable MUTANT is 17
(tests/mutation/mutants.hpp). Only the bodies of functions that run are changed: no constant expressions, no
declarations outside of them, no template arguments, and no statement that holds a string, since messages are not what
is tried.

The parser is a small one. It relies on the formatting of the sources (binary operators stand between blanks, signs,
pointers and template brackets do not), and gives up where it cannot tell the operands.
"""

import bisect
import collections
import dataclasses
import re

import check_sizes

PRECEDENCE = {"*": 5, "/": 5, "%": 5, "+": 6, "-": 6, "<<": 7, ">>": 7, "<=>": 8, "<": 9, "<=": 9, ">": 9, ">=": 9,
              "==": 10, "!=": 10, "&": 11, "^": 12, "|": 13, "&&": 14, "||": 15}
# What an operator becomes. Of two the seed chooses: the neighbour, which differs at the boundary, or the opposite.
SWAPS = {"+": "-", "-": "+", "*": "/", "/": "*", "%": "/", "==": "!=", "!=": "==", "&&": "||", "||": "&&",
         "<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<")}
OPENING, CLOSING = set("([{"), set(")]}")
KEYWORDS = {"return", "throw", "else", "in", "do", "co_return", "co_yield"}
# A statement with one of these is not touched.
FORBIDDEN = re.compile(r'"|\b(constexpr|consteval|static_assert|case|enum|template|concept|requires|using|typedef|'
                       r"operator|virtual|alignas|assert|sizeof|goto|asm|decltype|noexcept)\b|\bstatic const\b")
# A constant whose initialiser holds no name, and the end of a list of constants alone: the compiler works them out, so
# that no mutant of them would ever run.
LITERAL = re.compile(r"\bconst (int|unsigned|long|bool|char|Index|std::size_t|std::u?int\w*_t)\s+\w+ ?[={][^a-zA-Z]*$")
CONSTANTS = re.compile(r"[\d\s.,'+\-eE]*}$")
NOT_CODE = re.compile(check_sizes.NOT_CODE.pattern + "|" + r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.DOTALL | re.MULTILINE)
TOKEN = re.compile(
    r"(?P<number>(?<![\w.])(?:0[xX][0-9a-fA-F']+|(?:\d[\d']*\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)[fFuUlLzZ]*)|"
    r"(?P<name>[A-Za-z_]\w*)|(?P<sign>->|::|<=>|(?<=\s)(?:<<|>>)=?(?=\s)|[-+*/%&|^!=<>]=|&&|\|\||\+\+|--|\S)")

Token = collections.namedtuple("Token", "text start end kind")


@dataclasses.dataclass
class Mutant:
    """One change: the text from start to end of the file becomes `after`."""
    file: str
    line: int
    start: int
    end: int
    kind: str
    before: str
    after: str
    number: int = 0

    def written(self):
        """What stands in the source in its place, on as many lines as before."""
        original = " ".join(self.before.split())
        return f"(mutants::on({self.number}) ? ({self.after}) : ({original}))" + "\n" * self.before.count("\n")


def blank(match):
    """A comment or directive as blanks, a string or character as quotation marks; positions and line ends stay."""
    fill = " " if match[0].lstrip()[0] in "/#" else '"'
    return "".join(char if char == "\n" else fill for char in match[0])


def bodies(text):
    """(begin, end) of what stands between the braces of each function that is not for the compiler to evaluate."""
    stack, head_start, found = [], 0, []
    for position, char in enumerate(text):
        if char == "{":
            inside = any(kind == "function" for kind, _, _ in stack)
            head = text[head_start:position]
            kind = "inner" if inside or (stack and stack[-1][0] == "value") else check_sizes.kind_of(head)
            stack.append((kind, position + 1, head))
            if kind in ("scope", "function"):
                head_start = position + 1
        elif char == "}" and stack:
            kind, begin, head = stack.pop()
            if kind == "function" and not re.search(r"\b(constexpr|consteval)\b", head):
                found.append((begin, position))
            if kind in ("scope", "function"):
                head_start = position + 1
        elif char == ";" and not any(kind in ("function", "value") for kind, _, _ in stack):
            head_start = position + 1
    return found


class Source:
    """A file taken apart: its tokens, and the mutants that are possible in it."""

    def __init__(self, name, text):
        self.name, self.text = name, text
        self.code = NOT_CODE.sub(blank, text)
        self.tokens = [Token(found[0], *found.span(), found.lastgroup) for found in TOKEN.finditer(self.code)]
        self.line_ends = [found.start() for found in re.finditer("\n", text)]

    def mutants(self, random):
        """All mutants of the file, in the order of their places."""
        inside, found = bodies(self.code), []
        for index, token in enumerate(self.tokens):
            if not any(begin <= token.start < end for begin, end in inside):
                continue
            mutant = None
            if token.kind == "number":
                mutant = self.constant(index, random)
            elif token.text in SWAPS and self.is_binary(token):
                mutant = self.operation(index, random)
            if mutant is not None:
                found.append(mutant)
        return found

    def is_binary(self, token):
        return self.code[token.start - 1].isspace() and self.code[token.end:token.end + 1].isspace()

    def statement(self, index):
        """The text of the statement around a token, and the part of it before the token."""
        first = index
        while first > 0 and self.tokens[first - 1].text not in ";{}":
            first -= 1
        last = index
        while last + 1 < len(self.tokens) and self.tokens[last].text not in ";{}":
            last += 1
        begin = self.tokens[first].start
        return self.code[begin:self.tokens[last].end], self.code[begin:self.tokens[index].start]

    def is_free(self, index):
        """Whether the statement around a token may be changed, and the token is no template argument."""
        whole, before = self.statement(index)
        return not FORBIDDEN.search(whole) and not LITERAL.search(before) and angles(before) == 0

    def operand_start(self, index, level):
        """Position where the left operand of a token of this precedence begins; None if that cannot be told."""
        depth, position = 0, index - 1
        start = None
        while position >= 0:
            token = self.tokens[position]
            if token.text in "{}":
                return start if token.text == "{" and depth == 0 else None
            if token.text in CLOSING:
                depth += 1
            elif token.text in OPENING:
                if depth == 0:
                    return start
                depth -= 1
            elif depth == 0 and self.ends_operand(token, level, strictly=True):
                return start
            start = token.start
            position -= 1
        return None

    def operand_end(self, index, level):
        """Position where the right operand of a token of this precedence ends; None if that cannot be told."""
        depth, position = 0, index + 1
        end = None
        while position < len(self.tokens):
            token = self.tokens[position]
            if token.text in "{}":
                return end if depth == 0 and end is not None and token.text == "}" else None
            if token.text in OPENING:
                depth += 1
            elif token.text in CLOSING:
                if depth == 0:
                    return end
                depth -= 1
            elif depth == 0 and self.ends_operand(token, level, strictly=False):
                return end
            end = token.end
            position += 1
        return None

    def ends_operand(self, token, level, strictly):
        """Whether a token outside of brackets is no part of the operand: it binds less, or on the right as much."""
        if token.text in KEYWORDS or token.text in (",", ";", "?", ":"):
            return True
        if token.kind != "sign" or not self.is_binary(token):
            return False
        binds = PRECEDENCE.get(token.text)
        return binds is None or (binds > level if strictly else binds >= level)

    def operation(self, index, random):
        token = self.tokens[index]
        if not self.is_free(index):
            return None
        level = PRECEDENCE[token.text]
        start, end = self.operand_start(index, level), self.operand_end(index, level)
        if start is None or end is None:
            return None
        left, right = self.code[start:token.start], self.code[token.end:end]
        raw = self.text[start:end]
        if raw != self.code[start:end] or angles(left) or angles(right) or not left.strip() or not right.strip():
            return None
        swap = SWAPS[token.text]
        other = swap if isinstance(swap, str) else random.choice(swap)
        after = " ".join(f"{left} {other} {right}".split())
        return Mutant(self.name, self.line_of(token.start), start, end, token.text, raw, after)

    def constant(self, index, random):
        token = self.tokens[index]
        if not self.is_free(index) or CONSTANTS.match(self.statement(index)[0]):
            return None
        after = other_constant(token.text, random)
        if after is None:
            return None
        return Mutant(self.name, self.line_of(token.start), token.start, token.end, "constant", token.text, after)

    def line_of(self, position):
        return bisect.bisect_left(self.line_ends, position) + 1


def angles(text):
    """How many template brackets are open at the end of a text; comparisons, between blanks, do not count."""
    text = re.sub(r"->|<=>|(?<=\s)(<|>|<=|>=|<<|>>)(?=\s|$)", " ", text)
    return text.count("<") - text.count(">")


def other_constant(text, random):
    """Another number: nought becomes one, a whole number one more or less, a real one twice, or a thousand times if it
    is written with an exponent, as tolerances are."""
    found = re.fullmatch(r"([\d.']+)(e[+-]?\d+)?([a-zA-Z]*)", text, re.IGNORECASE)
    if found is None:
        return None
    digits, exponent, suffix = found[1].replace("'", ""), found[2] or "", found[3]
    if "." not in digits and not exponent:
        value = int(digits)
        return f"{value + 1 if value == 0 else value + random.choice((-1, 1))}{suffix}"
    value = float(digits + exponent)
    if value == 0.0:
        return "1.0" + suffix
    return f"{value * (1000.0 if exponent else 2.0)!r}{suffix}"


def draw(sources, count, random):
    """`count` mutants of sources {name: text}, folders weighted by their lines, none within another, in any order."""
    lines, possible = collections.Counter(), collections.defaultdict(list)
    for name, text in sorted(sources.items()):
        folder = name.split("/")[1]
        lines[folder] += text.count("\n")
        possible[folder] += Source(name, text).mutants(random)
    chosen, taken = [], collections.defaultdict(list)
    shares = share(lines, count)
    for folder in sorted(possible):
        random.shuffle(possible[folder])
        wanted = shares[folder]
        for mutant in possible[folder]:
            if wanted == 0:
                break
            if all(mutant.end <= begin or end <= mutant.start for begin, end in taken[mutant.file]):
                taken[mutant.file].append((mutant.start, mutant.end))
                chosen.append(mutant)
                wanted -= 1
    random.shuffle(chosen)
    for number, mutant in enumerate(chosen, start=1):
        mutant.number = number
    return chosen


def share(weights, count):
    """`count` divided among the keys in proportion to their weights, at least one for each."""
    total = sum(weights.values())
    exact = {key: count * weight / total for key, weight in weights.items()}
    shares = {key: max(1, int(value)) for key, value in exact.items()}
    for key in sorted(exact, key=lambda key: int(exact[key]) - exact[key]):
        if sum(shares.values()) >= count:
            break
        shares[key] += 1
    return shares


def write_in(text, mutants):
    """A source with its mutants in it."""
    for mutant in sorted(mutants, key=lambda mutant: -mutant.start):
        text = text[:mutant.start] + mutant.written() + text[mutant.end:]
    return text
