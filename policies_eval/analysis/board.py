"""A leaderboard as a web page: evaluations of the same episodes together, with intervals and whose they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path

from pat3d.policies_eval.analysis.charts import CHART_STYLE, axis, interval_bar
from pat3d.policies_eval.analysis.compare import comparable, leaderboard
from pat3d.policies_eval.analysis.signing import Signature, told
from pat3d.policies_eval.analysis.statistics import Rate
from pat3d.policies_eval.run.records import Evaluation

_STYLE = """
body { margin: 0 auto; max-width: 1080px; padding: 24px 16px; font: 15px/1.5 system-ui, sans-serif; color: #1c2430; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; margin-bottom: 28px; }
th { text-align: left; color: #667085; font-size: 13px; } th, td { padding: 5px 10px 5px 0; }
td, th { border-bottom: 1px solid #e4e7ec; } .num { text-align: right; white-space: nowrap; } .bar { width: 36%; }
h2 { font-size: 15px; overflow-wrap: anywhere; } .wrong { color: #b42318; font-weight: 600; }
code { overflow-wrap: anywhere; } .scroll { overflow-x: auto; }
"""


def board_page(evaluations: Sequence[Evaluation], signatures: Mapping[Path, Signature]) -> str:
    """The page; rates of different episodes or engines stand in different tables, as they are not comparable.

    Args:
        evaluations: finished or not.
        signatures: of every evaluation, by its folder.
    """
    tables = "".join(_table(title, group, signatures) for title, group in comparable(evaluations))
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1"><title>Leaderboard</title>'
        f"<style>{_STYLE}{CHART_STYLE}</style></head><body><h1>Leaderboard</h1>"
        "<p>Bars are 95 % intervals. Only policies in the same table did the same episodes on the same engine. Every "
        "action is recorded: <code>pat3d replay FOLDER</code> does all episodes of a row again and compares every "
        f"state.</p>{tables}</body></html>\n"
    )


def _table(title: str, group: list[Evaluation], signatures: Mapping[Path, Signature]) -> str:
    rows = "".join(_row(one, rate, errors, signatures[one.folder]) for one, rate, errors in leaderboard(group))
    return (
        f'<h2>{escape(title)}</h2><div class="scroll"><table><tr><th>policy</th><th class="num">success</th>'
        f'<th class="bar">{axis()}</th><th class="num">episodes</th><th class="num">policy errors</th>'
        f"<th>signature</th><th>folder</th></tr>{rows}</table></div>"
    )


def _row(one: Evaluation, rate: Rate, errors: int, signature: Signature) -> str:
    share = f"{100 * rate.value:.1f} %" if rate.episodes else "-"
    kind = "" if signature.good else ' class="wrong"'
    return (
        f"<tr><td>{escape(one.manifest['policy'])}</td><td class='num'>{share}</td>"
        f"<td class='bar'>{interval_bar(rate)}</td><td class='num'>{rate.episodes}/{one.manifest['episodes']}</td>"
        f"<td class='num'>{errors}</td><td{kind}>{escape(told(signature))}</td>"
        f"<td><code>{escape(one.folder.name)}</code></td></tr>"
    )
