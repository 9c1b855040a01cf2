"""Draws docs/architecture.svg: the floors of the package, and the walk from a sentence to MJCF across them.

python docs/draw_architecture.py
"""

from __future__ import annotations

from html import escape
from pathlib import Path

FLOORS = (
    ("cli", "the pat3d command"),
    ("mcp_server, studio", "tools for other programs; scenes in the browser"),
    ("policies_eval", "policies, paired episodes, statistics, datasets"),
    ("envs", "robots, tasks, suites, GPU worlds"),
    ("generation", "the stages in order, attempts, the report"),
    ("optimize", "layouts that hold, by gradients"),
    ("importers", "scenes and objects of other programs"),
    ("check", "certificate, penetration, stillness"),
    ("exporters", "mjcf, usd, urdf, sdf: writer beside reader"),
    ("vision", "photographs: gravity, fits, what stands on what"),
    ("layout", "poses without contact, relation predicates"),
    ("assets, plan, sim, view", "objects; sentences; settling; pictures"),
    ("scene", "the model that all share, its folder"),
    ("geometry", "hulls, mass, contacts, poses"),
    ("errors, progress", ""),
)
"""From the top; an import goes down or stays on its floor."""

WALK = (
    ("generation", "pipeline.py", "sentence"),
    ("assets, plan, sim, view", "plan/grammar/planner.py", "ScenePlan"),
    ("generation", "request.py", "assets"),
    ("generation", "attempts.py", "one attempt"),
    ("layout", "layout.py", "initial poses"),
    ("generation", "settle_stage.py", "poses at rest"),
    ("exporters", "mjcf/writer.py", "scene.xml"),
    ("check", "verification.py", "Verification"),
)
"""Floor, file, and what comes out of it."""

WIDTH, HEIGHT, TOP, LABELS = 1180, 42, 20, 350
HALO = {"paint_order": "stroke", "stroke": "#eef2f6", "stroke_width": "5", "stroke_linejoin": "round"}
"""Behind words that a line may cross."""
INK, PAPER, BAND, ACCENT = "#1f2933", "#ffffff", ("#eef2f6", "#e3e9ef"), "#b4471f"


def draw() -> str:
    """The picture as SVG."""
    middle = {name: TOP + HEIGHT * (row + 0.5) for row, (name, _) in enumerate(FLOORS)}
    bottom = TOP + HEIGHT * len(FLOORS)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {bottom + 70}" font-family="sans-serif">',
        f'<rect width="100%" height="100%" fill="{PAPER}"/>',
    ]

    def text(x: float, y: float, words: str, size: int, colour: str = INK, **more: str) -> None:
        extra = "".join(f' {key.replace("_", "-")}="{value}"' for key, value in more.items())
        lines.append(f'<text x="{x:g}" y="{y:g}" font-size="{size}" fill="{colour}"{extra}>{escape(words)}</text>')

    for row, (name, about) in enumerate(FLOORS):
        y = TOP + HEIGHT * row
        lines.append(f'<rect x="10" y="{y}" width="{WIDTH - 20}" height="{HEIGHT - 2}" fill="{BAND[row % 2]}"/>')
        text(20, y + 18, name, 14, font_weight="bold")
        text(20, y + 34, about, 12)
    step = (WIDTH - LABELS - 90) / (len(WALK) - 1)
    spots = [(LABELS + 20 + step * number, middle[floor]) for number, (floor, _, _) in enumerate(WALK)]
    points = " ".join(f"{x:g},{y:g}" for x, y in spots)
    lines.append(f'<polyline points="{points}" fill="none" stroke="{ACCENT}" stroke-width="2.5"/>')
    for number, ((x, y), (_, file, gives)) in enumerate(zip(spots, WALK, strict=True), start=1):
        lines.append(f'<circle cx="{x:g}" cy="{y:g}" r="11" fill="{ACCENT}"/>')
        text(x, y + 5, str(number), 13, PAPER, text_anchor="middle", font_weight="bold")
        under = file.rsplit("/", 1)[0] + "/" if "/" in file else ""
        for line, words in enumerate([part for part in (under, file.rsplit("/", 1)[-1]) if part]):
            text(x, y + 25 + 13 * line, words, 12, INK, text_anchor="middle", **HALO)
        text(x, bottom + 25, gives, 13, ACCENT, text_anchor="middle")
        lines.append(
            f'<line x1="{x:g}" y1="{bottom}" x2="{x:g}" y2="{bottom + 8}" stroke="{ACCENT}" stroke-width="1.5"/>'
        )
    text(20, bottom + 25, "Imports go down, never up.", 13)
    text(LABELS + 20, bottom + 50, "The walk from a sentence to MJCF: file by file, with what each gives.", 13)
    return "\n".join([*lines, "</svg>", ""])


if __name__ == "__main__":
    Path(__file__).with_name("architecture.svg").write_text(draw())
