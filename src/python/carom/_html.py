"""What notebooks show of runs and results: HTML with its styles inside, in the colours of the page around it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from html import escape

import numpy as np
from numpy.typing import NDArray

_CURVES = ("#1f77c8", "#d9652b", "#2f9e6e", "#9a5fb5", "#b8962a", "#3b9cb5", "#c2517e", "#7c838a")
_WORDS = {"good": "#2f9e6e", "recommended": "#2f9e6e", "failed": "#d0453a", "error": "#d0453a", "stopped": "#b8862a",
          "none recommended": "#b8862a", "running": "#1f77c8"}
_MOST_POINTS = 400


def page(*parts: str) -> str:
    """Parts below each other."""
    return ('<div style="max-width:56em;font-size:14px;line-height:1.45">' + "".join(parts) + "</div>")


def banner(word: str, title: str, text: str) -> str:
    """A verdict in its colour, the title of the case and a sentence."""
    colour = _WORDS[word]
    return (f'<div style="border-left:4px solid {colour};background:{colour}1f;padding:.5em .8em;border-radius:4px">'
            f'<strong style="color:{colour}">{escape(word.capitalize())}</strong> {escape(title)}'
            f'<div style="opacity:.8">{escape(text)}</div></div>')


def listed(items: Sequence[str]) -> str:
    """A list, nothing where there is none."""
    return "<ul>" + "".join(f"<li>{escape(item)}</li>" for item in items) + "</ul>" if items else ""


def folded(title: str, items: Sequence[str]) -> str:
    """A list that the reader unfolds."""
    return f"<details><summary>{escape(title)}</summary>{listed(items)}</details>" if items else ""


def figures(found: Iterable[tuple[str, str, str]]) -> str:
    """Title, value and remark of key figures, side by side."""
    boxes = "".join(f'<div><div style="opacity:.7;font-size:.9em">{escape(title)}</div>'
                    f'<div style="font-size:1.2em;font-weight:600">{escape(value)}</div>'
                    f'<div style="opacity:.7;font-size:.9em">{escape(remark)}</div></div>' for title, value, remark in found)
    return ('<div style="display:grid;grid-template-columns:repeat(auto-fill,minmax(14em,1fr));gap:.8em;margin:.8em 0">'
            + boxes + "</div>") if boxes else ""


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table of texts."""
    body = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows)
    return ("<table><thead><tr>" + "".join(f"<th>{escape(cell)}</th>" for cell in head) + f"</tr></thead><tbody>{body}"
            "</tbody></table>")


def progress(share: float) -> str:
    """A bar."""
    return f'<progress max="1" value="{share:.4f}" style="width:100%"></progress>'


def chart(title: str, unit: str, time: NDArray[np.float64], time_unit: str,
          curves: Mapping[str, NDArray[np.float64]]) -> str:
    """A small picture of curves over time; nothing where there is nothing to draw."""
    finite = {name: y for name, y in curves.items() if len(y) and np.isfinite(y).all()}
    if not finite or len(time) < 2 or not time[-1] > time[0]:
        return ""
    low, high = min(0.0, *(float(y.min()) for y in finite.values())), max(float(y.max()) for y in finite.values())
    if not high > low:
        return ""
    width, height = 400.0, 150.0
    lines = ""
    for i, (name, y) in enumerate(finite.items()):
        rows = _drawn(y)
        x = width * (time[rows] - time[0]) / (time[-1] - time[0])
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, height * (high - y[rows]) / (high - low)))
        lines += f'<polyline points="{points}" fill="none" stroke="{_CURVES[i % len(_CURVES)]}" stroke-width="1.5"/>'
    legend = " ".join(f'<span style="color:{_CURVES[i % len(_CURVES)]};white-space:nowrap">&#9644; {escape(name)}</span>'
                      for i, name in enumerate(finite))
    zero = height * high / (high - low)
    caption = f"{title}, {unit}" if unit else title
    label = 'font-size="11" fill="currentColor" opacity=".75"'
    return (f'<figure style="display:inline-block;margin:.4em 1em .4em 0;max-width:100%"><figcaption>{escape(caption)} '
            f'<span style="font-size:.85em">{legend}</span></figcaption>'
            f'<svg viewBox="-72 -8 {width + 84:.0f} {height + 28:.0f}" width="470" role="img" aria-label="{escape(title)}" '
            f'style="max-width:100%;height:auto"><rect width="{width}" height="{height}" fill="none" '
            f'stroke="currentColor" opacity=".25"/><line x1="0" x2="{width}" y1="{zero:.1f}" y2="{zero:.1f}" '
            f'stroke="currentColor" opacity=".25"/>{lines}'
            f'<text x="-4" y="8" text-anchor="end" {label}>{high:.4g}</text>'
            f'<text x="-4" y="{height}" text-anchor="end" {label}>{low:.4g}</text>'
            f'<text x="0" y="{height + 15}" {label}>{time[0]:.4g}</text>'
            f'<text x="{width}" y="{height + 15}" text-anchor="end" {label}>{time[-1]:.4g} {escape(time_unit)}</text>'
            "</svg></figure>")


def frame(document: str, height: int) -> str:
    """A document of its own in a frame; nothing is loaded from anywhere."""
    return (f'<iframe srcdoc="{escape(document)}" style="width:100%;height:{height}px;border:0" '
            'allow="fullscreen"></iframe>')


def _drawn(y: NDArray[np.float64]) -> NDArray[np.int64]:
    """Rows that show all that a small picture can: of each piece the least and the largest, and both ends."""
    if len(y) <= _MOST_POINTS:
        return np.arange(len(y))
    kept = {0, len(y) - 1}
    for piece in np.array_split(np.arange(len(y)), _MOST_POINTS // 2):
        kept.update((int(piece[y[piece].argmin()]), int(piece[y[piece].argmax()])))
    return np.array(sorted(kept))
