"""How success falls along every axis of perturbation, each level compared with the plain episodes in pairs."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from typing import Any

from pat3d.policies_eval.analysis.statistics import INTERVALS, Comparison, Rate, compare
from pat3d.policies_eval.run.records import Evaluation
from pat3d.policies_eval.run.rollout import Result

WIDTH, HEIGHT, LEFT, TOP, BOTTOM = 300, 170, 34, 12, 34
"""Of a drawing and its margins [pixel]."""

CURVE_STYLE = """
.curves { display: grid; grid-template-columns: repeat(auto-fill, minmax(260px, 1fr)); gap: 12px 20px; }
.curves figure { margin: 0; } .curves figcaption { font-weight: 600; font-size: 14px; }
.curves svg { width: 100%; height: auto; font: 11px system-ui, sans-serif; fill: #667085; }
.curves .grid { stroke: #e4e7ec; } .curves .bar { stroke: #9ec9b5; stroke-width: 5; stroke-linecap: round; }
.curves .line { stroke: #1f7a51; fill: none; stroke-width: 1.5; } .curves circle { fill: #1f7a51; }
"""


@dataclass(frozen=True, kw_only=True)
class Level:
    """One strength of one axis."""

    strength: float
    """0 for the plain episodes."""
    rate: Rate
    paired: Comparison | None
    """The plain episodes first, this level second; None for the plain ones themselves."""


def curves(evaluation: Evaluation, interval: str = "wilson") -> dict[str, tuple[Level, ...]]:
    """The levels of every axis, the plain one first; nothing of an evaluation that was not along axes.

    Args:
        evaluation: one of `--axes`, finished or not.
        interval: of the rates, one of INTERVALS.
    """
    count = int(evaluation.manifest["source"].get("levels", 0))
    if not count:
        return {}
    rate_of = INTERVALS[interval]
    plain = {one.episode.index // count: one for one in evaluation.results if not one.episode.perturbation.active}
    found: dict[tuple[str, float], dict[int, Result]] = {}
    for one in evaluation.results:
        for name in one.episode.perturbation.active:
            strength = float(getattr(one.episode.perturbation, name))
            found.setdefault((name, strength), {})[one.episode.index // count] = one
    first = Level(strength=0.0, rate=rate_of(sum(one.success for one in plain.values()), len(plain)), paired=None)
    drawn: dict[str, list[Level]] = {}
    for (name, strength), results in sorted(found.items(), key=lambda item: item[0][1]):
        pairs = [(plain[k].success, one.success) for k, one in sorted(results.items()) if k in plain]
        rate = rate_of(sum(one.success for one in results.values()), len(results))
        drawn.setdefault(name, [first]).append(Level(strength=strength, rate=rate, paired=compare(pairs)))
    return {name: tuple(levels) for name, levels in drawn.items()}


def lines_of(found: dict[str, tuple[Level, ...]]) -> list[str]:
    """For a terminal."""
    lines = []
    for name, levels in found.items():
        if not lines:
            lines.append(f"without perturbation: {levels[0].rate}")
        lines += [f"  {name} {one.strength:g}: {one.rate}{_said(one)}" for one in levels[1:]]
    return lines


def drawing(found: dict[str, tuple[Level, ...]]) -> str:
    """A small plot for every axis, for a page."""
    figures = "".join(
        f"<figure><figcaption>{escape(name)}</figcaption>{_plot(levels)}</figure>" for name, levels in found.items()
    )
    return f'<div class="curves">{figures}</div>'


def _said(level: Level) -> str:
    """What the pairs say, where they say something."""
    if level.paired is None or not level.paired.episodes:
        return ""
    change = f", {0.0 - 100 * level.paired.difference:+.1f} points"
    return f"{change} (p = {level.paired.p_value:.2g})"


def _plot(levels: tuple[Level, ...]) -> str:
    """Success over strength, with intervals, as SVG."""
    right, low = WIDTH - 12, HEIGHT - BOTTOM
    most = levels[-1].strength

    def x(value: float) -> float:
        return LEFT + (right - LEFT) * value / most

    def y(value: float) -> float:
        return low - (low - TOP) * value

    parts: list[Any] = []
    for share in (0.0, 0.5, 1.0):
        parts.append(f'<line class="grid" x1="{LEFT}" x2="{right}" y1="{y(share):.1f}" y2="{y(share):.1f}"/>')
        parts.append(f'<text x="{LEFT - 5}" y="{y(share) + 4:.1f}" text-anchor="end">{100 * share:.0f}</text>')
    done = [one for one in levels if one.rate.episodes]
    for one in done:
        at = x(one.strength)
        parts.append(
            f'<line class="bar" x1="{at:.1f}" x2="{at:.1f}" y1="{y(one.rate.low):.1f}" y2="{y(one.rate.high):.1f}">'
            f"<title>{one.strength:g}: {one.rate}{_said(one)}</title></line>"
        )
    way = " ".join(f"{x(one.strength):.1f},{y(one.rate.value):.1f}" for one in done)
    parts.append(f'<polyline class="line" points="{way}"/>')
    for one in done:
        parts.append(f'<circle cx="{x(one.strength):.1f}" cy="{y(one.rate.value):.1f}" r="3.5"/>')
        parts.append(f'<text x="{x(one.strength):.1f}" y="{low + 15}" text-anchor="middle">{one.strength:g}</text>')
    parts.append(f'<text x="{(LEFT + right) / 2:.0f}" y="{HEIGHT - 4}" text-anchor="middle">strength</text>')
    return f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img">{"".join(parts)}</svg>'
