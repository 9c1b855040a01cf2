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

CHART_STYLE = """
.axis, .interval { position: relative; margin: 0 18px; }
.axis { height: 15px; font-size: 11px; font-weight: 400; color: #667085; }
.axis i { position: absolute; transform: translateX(-50%); font-style: normal; white-space: nowrap; }
.interval { height: 24px; border-top: 0; }
.interval i { position: absolute; }
.interval .line { left: 0; right: 0; top: 12px; border-top: 1px solid #e4e7ec; }
.interval .tick { top: 6px; height: 12px; border-left: 1px solid #d0d5dd; }
.interval .span { top: 8px; height: 8px; min-width: 2px; border-radius: 4px; background: #9ec9b5; }
.interval .rate { top: 7px; width: 10px; height: 10px; margin-left: -5px; border-radius: 5px; background: #1f7a51; }
@media (max-width: 600px) { .axis .fine { display: none; } }
"""
"""Of `axis` and `interval_bar`; the axis leaves out its labels at the odd quarters where there is little room."""

_QUARTERS = (0, 25, 50, 75, 100)


def axis() -> str:
    """Labels of the line that `interval_bar` draws, to stand above or below bars of the same width."""
    labels = "".join(f'<i style="left:{at}%"{" class=fine" if at % 50 else ""}>{at} %</i>' for at in _QUARTERS)
    return f'<div class="axis">{labels}</div>'


def interval_bar(rate: Rate) -> str:
    """A rate and its interval on a line from 0 to 100 %, as wide as its place."""
    if not rate.episodes:
        return ""
    low, high, value = (100.0 * one for one in (rate.low, rate.high, rate.value))
    ticks = "".join(f'<i class="tick" style="left:{at}%"></i>' for at in _QUARTERS)
    return (
        f'<div class="interval" role="img" title="{rate}"><i class="line"></i>{ticks}'
        f'<i class="span" style="left:{low:.2f}%;width:{high - low:.2f}%"></i>'
        f'<i class="rate" style="left:{value:.2f}%"></i></div>'
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
