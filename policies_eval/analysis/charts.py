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


def interval_bar(rate: Rate, width: int) -> str:
    """A rate and its interval on a line from 0 to 100 %."""
    if not rate.episodes:
        return ""

    def x(share: float) -> float:
        return 8 + share * (width - 16)

    ticks = "".join(
        f'<line x1="{x(k / 4):.1f}" x2="{x(k / 4):.1f}" y1="6" y2="18" stroke="#d0d5dd"/>' for k in range(5)
    )
    return (
        f'<svg width="{width}" height="24" viewBox="0 0 {width} 24" role="img" style="max-width:100%">'
        f'<title>{rate}</title><line x1="{x(0):.1f}" x2="{x(1):.1f}" y1="12" y2="12" stroke="#e4e7ec"/>{ticks}'
        f'<rect x="{x(rate.low):.1f}" y="8" width="{max(x(rate.high) - x(rate.low), 2):.1f}" height="8" rx="4" '
        f'fill="#9ec9b5"/><circle cx="{x(rate.value):.1f}" cy="12" r="5" fill="#1f7a51"/></svg>'
    )


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
