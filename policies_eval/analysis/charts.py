"""Drawings of the report, as SVG inside the page."""

from __future__ import annotations

from collections.abc import Mapping

from pat3d.policies_eval.analysis.statistics import Rate

OUTCOME_COLOURS = {
    "success": "#2e9e6b",
    "missed": "#8fa3bf",
    "slipped": "#e6b450",
    "dropped": "#e08a3c",
    "toppled": "#cf5c4f",
    "collided": "#a5568b",
    "timed_out": "#6b7ea8",
    "policy_error": "#3b4252",
    "simulation_error": "#111827",
}


EDGE = 18
"""Room at both ends of an axis for half of its labels [pixel]."""


def axis(width: int) -> str:
    """Labels of the line that `interval_bar` draws, to stand above or below bars of the same width."""
    labels = "".join(
        f'<text x="{_x(k / 4, width):.1f}" y="11" text-anchor="middle" font-size="11" fill="#667085">{25 * k} %</text>'
        for k in range(5)
    )
    return f'<svg viewBox="0 0 {width} 14" role="img" style="{_fits(width)}">{labels}</svg>'


def interval_bar(rate: Rate, width: int) -> str:
    """A rate and its interval on a line from 0 to 100 %."""
    if not rate.episodes:
        return ""
    ticks = "".join(
        f'<line x1="{_x(k / 4, width):.1f}" x2="{_x(k / 4, width):.1f}" y1="6" y2="18" stroke="#d0d5dd"/>'
        for k in range(5)
    )
    low, high = _x(rate.low, width), _x(rate.high, width)
    return (
        f'<svg viewBox="0 0 {width} 24" role="img" style="{_fits(width)}"><title>{rate}</title>'
        f'<line x1="{_x(0.0, width):.1f}" x2="{_x(1.0, width):.1f}" y1="12" y2="12" stroke="#e4e7ec"/>{ticks}'
        f'<rect x="{low:.1f}" y="8" width="{max(high - low, 2):.1f}" height="8" rx="4" '
        f'fill="#9ec9b5"/><circle cx="{_x(rate.value, width):.1f}" cy="12" r="5" fill="#1f7a51"/></svg>'
    )


def _x(share: float, width: int) -> float:
    return EDGE + share * (width - 2 * EDGE)


def _fits(width: int) -> str:
    """As wide as its place, up to `width`: bars and their axis shrink together."""
    return f"display:block;width:100%;max-width:{width}px"


def outcome_bar(outcomes: Mapping[str, int], width: int) -> str:
    """Shares of all outcomes in one bar."""
    total, at, pieces = max(sum(outcomes.values()), 1), 0.0, []
    for name, count in outcomes.items():
        size = width * count / total
        pieces.append(
            f'<rect x="{at:.1f}" y="0" width="{max(size - 1.5, 0.5):.1f}" height="22" fill="{OUTCOME_COLOURS[name]}">'
            f"<title>{name.replace('_', ' ')}: {count}</title></rect>"
        )
        at += size
    return (
        f'<svg viewBox="0 0 {width} 22" width="100%" height="22" preserveAspectRatio="none" role="img" '
        f'style="border-radius:6px;margin-bottom:10px">{"".join(pieces)}</svg>'
    )
