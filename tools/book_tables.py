"""Tables of the verification book: the checks of a case with digits that mean something, and what all of them come to."""

import html
import math
import re
import statistics
import typing

# Against what a value stands, by how its source begins or what it names; the first that fits. What fits none is an exact
# statement about the case itself: an exact solution, a closed form, a quantity as it was imposed.
KINDS = (
    ("published values", "manuals and papers of other programs", r"^Code_Aster manual|published codes"),
    ("independent codes", "other programs run on the same problem", r"^Code_Aster, test|^independent 1-D computation"),
    ("other runs of Carom", "a finer mesh, another model of the same body, the driver of a point",
     r"^the same (by cells|case)|^the bar in one piece|^as \w+\.toml|^carom material|cells, -?\d"),
    ("balances and symmetries", "what holds for any exact solution",
     r"^balance|symmetry|^the scheme |^the rollers press alike|exchange their speeds|^momentum of|nothing holds"),
    ("exact solutions", "closed forms, waves in one dimension, Hertz's theory, what was imposed", r""),
)


class Kind(typing.NamedTuple):
    name: str
    text: str
    checks: list  # (name of the case, check)


def kind_of(sources):
    """The position in KINDS of the last of the sources of a case; "as above" is of the kind of the one before."""
    source = next((s for s in reversed(sources) if s not in ("as above", "the same")), "")
    return next(k for k, (_, _, pattern) in enumerate(KINDS) if re.search(pattern, source))


def sorted_by_kind(runs):
    """Those that have checks."""
    kinds = [Kind(name, text, []) for name, text, _ in KINDS]
    for found in runs:
        sources = []
        for check in found.summary["checks"]:
            sources.append(check["source"])
            kinds[kind_of(sources)].checks.append((found.name, check))
    return [kind for kind in kinds if kind.checks]


def significant(value, digits):
    """At most so many digits; a dash where there is no number."""
    if value is None:
        return "–"
    return f"{value:.{digits}g}"


def allowed_error(check):
    """In the unit of the value."""
    return check["tolerance"] * (abs(check["reference"]) if check["tolerance_kind"] == "relative" else 1.0)


def to_tolerance(value, allowed):
    """A value to the second digit of what it may be off by, at most nine digits: what is below that is a zero."""
    if value is None:
        return "–"
    if value == 0.0 or not allowed > 0.0:
        return f"{value:.9g}"
    digits = math.floor(math.log10(abs(value))) - math.floor(math.log10(allowed)) + 2
    return f"{value:.{min(digits, 9)}g}" if digits > 0 else "0"


def relative_error(check):
    """None where nothing was reached, and where the theory is zero or so near to it that percent of it say nothing."""
    if check["difference"] is None or allowed_error(check) > 0.2 * abs(check["reference"]) or check["reference"] == 0.0:
        return None
    return abs(check["difference"] / check["reference"])


def error_text(check):
    """Three digits, in percent of the theory where that is not about zero."""
    relative = relative_error(check)
    if relative is None:
        return significant(check["difference"], 3)
    return f"{math.copysign(100.0 * relative, check['difference']):.3g} %"


def tolerance_text(check):
    return f"{100 * check['tolerance']:.2g} %" if check["tolerance_kind"] == "relative" else significant(check["tolerance"], 2)


COLUMNS = (("Quantity", ""), ("time", "number"), ("value", "number"), ("theory", "number"), ("error", "number"),
           ("allowed", "number"), ("", ""), ("source", "number"))


def check_row(check, number_of_source):
    allowed = allowed_error(check)
    cells = (check["name"], significant(check["time"], 6), to_tolerance(check["value"], allowed),
             to_tolerance(check["reference"], allowed), error_text(check), tolerance_text(check))
    mark = '<span class="pass">✓</span>' if check["pass"] else '<span class="fail">✗ fails</span>'
    row = "".join(f'<td class="{style}">{html.escape(cell)}</td>' for cell, (_, style) in zip(cells, COLUMNS))
    return f'<tr>{row}<td>{mark}</td><td class="number">{number_of_source}</td></tr>'


def check_table(checks, sources):
    """The rows name their sources by position in the list, which grows by those that are new."""
    rows = []
    for check in checks:
        if check["source"] not in sources:
            sources.append(check["source"])
        rows.append(check_row(check, sources.index(check["source"]) + 1))
    head = "".join(f'<th class="{style}">{title}</th>' for title, style in COLUMNS)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"


def source_list(sources):
    entries = "".join(f"<li>{html.escape(source)}</li>" for source in sources)
    return f'<p class="soft">Sources:</p><ol class="sources">{entries}</ol>' if sources else ""


def summary_table(runs):
    """How many values of which kind, and how far they are off: of those whose theory is not about zero in percent of it, of
    the others in shares of what is allowed."""
    rows = []
    for kind in sorted_by_kind(runs):
        relative = [(relative_error(check), name) for name, check in kind.checks if relative_error(check) is not None]
        zeros = [(abs(check["difference"]) / allowed_error(check), name) for name, check in kind.checks
                 if relative_error(check) is None and check["difference"] is not None and allowed_error(check) > 0.0]
        passed = sum(check["pass"] for _, check in kind.checks)
        cases = len({name for name, _ in kind.checks})

        def largest(errors, text):
            if not errors:
                return "–"
            error, name = max(errors)
            return f'{text(error)}<br><a href="#{anchor(name)}">{html.escape(name).replace("/", "/<wbr>")}</a>'

        def percent(error):
            return f"{100 * error:.2g} %"

        median = percent(statistics.median(error for error, _ in relative)) if relative else "–"
        rows.append(f'<tr><td>{html.escape(kind.name)}<br><span class="soft">{html.escape(kind.text)}</span></td>'
                    + "".join(f'<td class="number">{cell}</td>' for cell in (
                        len(kind.checks), cases, passed, len(relative), median, largest(relative, percent), len(zeros),
                        largest(zeros, percent)))
                    + "</tr>")
    titles = ("Against", "values", "in cases", "passed", "not about zero", "their median error", "their largest error", "about zero",
              "their largest error, of what is allowed")
    head = "".join(f'<th class="{"" if k == 0 else "number"}">{title}</th>' for k, title in enumerate(titles))
    return f'<table class="sums"><thead><tr>{head}</tr></thead><tbody>{"".join(rows)}</tbody></table>'


def anchor(name):
    return "case-" + name.replace("/", "-")


def said_once(texts):
    """Of the paragraphs of cases that stand below each other, each without the sentences that one before has said, and which
    of the names before has said what is left out, or None."""
    said, result = {}, []
    for name, text in texts:
        kept, elsewhere = [], None
        for sentence in re.split(r"(?<=[.:;]) (?=[A-Z])", text):
            if sentence in said:
                elsewhere = elsewhere or said[sentence]
            else:
                said[sentence] = name
                kept.append(sentence)
        result.append((" ".join(kept), elsewhere))
    return result
