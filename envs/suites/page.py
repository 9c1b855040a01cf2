"""index.html of a suite: a picture of every scene, filtered at will, then numbers, and what was rejected and why."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from pat3d.envs.suites.folder import SCENES, scene_name
from pat3d.envs.suites.request import SPLITS, in_split

_STYLE = """
:root { color-scheme: light dark; --line: #8884; --dim: #7a7a7a; }
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 78rem; padding: 0 1rem; }
h1 { font-size: 1.5rem; margin: 0 0 .2rem } h2 { font-size: 1.1rem; margin: 2rem 0 .6rem }
p.dim, .dim { color: var(--dim) } code { font-size: .92em }
table { border-collapse: collapse; font-variant-numeric: tabular-nums }
th, td { padding: .18rem .9rem .18rem 0; text-align: right; border-bottom: 1px solid var(--line) }
th:first-child, td:first-child { text-align: left } th.left, td.left { text-align: left; max-width: 48rem }
.tables { display: flex; flex-wrap: wrap; gap: 0 3rem }
.scenes { display: grid; grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr)); gap: 1rem }
figure { margin: 0 } img { width: 100%; border-radius: 6px; display: block; background: #8882; aspect-ratio: 4 / 3 }
figcaption { font-size: .84rem; margin-top: .3rem } figcaption b { display: block; font-weight: 600 }
form { display: flex; flex-wrap: wrap; gap: .6rem 1rem; align-items: center; margin: 0 0 1rem }
select, input { font: inherit; padding: .2rem .4rem; max-width: 100% } figure[hidden] { display: none }
.wide { overflow-x: auto } code { overflow-wrap: anywhere }
@media (max-width: 40rem) {
  body { margin: 1rem auto; font-size: 14px } .scenes { grid-template-columns: repeat(2, 1fr); gap: .7rem }
  .tables { gap: 0 1.5rem } th, td { padding-right: .6rem } td.left { min-width: 14rem }
}
"""

_SCRIPT = """
const form = document.forms[0], figures = [...document.querySelectorAll("figure")];
const shown = () => {
  const words = form.words.value.toLowerCase().split(/\\s+/).filter(Boolean);
  let count = 0;
  for (const one of figures) {
    const text = one.textContent.toLowerCase();
    const split = form.split.value, own = one.dataset.split;
    one.hidden = (form.task.value && form.task.value !== one.dataset.task)
      || (split && own !== split && !own.startsWith(split + "/")) || !words.every((word) => text.includes(word));
    count += !one.hidden;
  }
  document.getElementById("count").textContent = `${count} of ${figures.length} scenes`;
};
form.addEventListener("input", shown);
form.addEventListener("submit", (event) => event.preventDefault());
shown();
"""


_WORDS = {"true": "yes", "false": "no"}
"""Values of axes as the page says them."""


def page(name: str, document: Mapping[str, Any]) -> str:
    """The page of a complete suite; everything in it comes from suite.json."""
    request, scenes, rejected = document["request"], document["scenes"], document["rejected"]
    found = document["numbers"]
    settled = found["settled_in_mujoco"]
    sizes = " to ".join(map(str, sorted(set(request["objects"]))))
    lead = (
        f"{found['scenes']} scenes from {found['candidates']} candidates; seed {request['seed']}, {request['robot']}, "
        f"{sizes} objects, settled on {request.get('device', 'cpu')}. {settled['passed']} of {settled['of']} settled "
        f"scenes stay still in MuJoCo {document['versions'].get('mujoco')}; {found['intersections']} intersections. "
        f"Largest drift of a scene in the suite: {_figure(found['largest_drift_mm'])} mm, "
        f"{_figure(found['largest_turn_degrees'])} degrees in 5 s."
    )
    kinds = request["tasks"]
    splits = [
        [
            split,
            *(sum(in_split(s["split"], split) and s["kind"] == kind for s in scenes) for kind in kinds),
            sum(in_split(s["split"], split) for s in scenes),
        ]
        for split in SPLITS
    ]
    axes = "".join(
        _table(
            [axis.replace("_", " "), "scenes"],
            [[_WORDS.get(str(value), value), count] for value, count in told["scenes"].items()],
            told["about"],
        )
        for axis, told in document["axes"].items()
    )
    held = document["held_out"]["nouns"]
    return f"""<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{escape(name)}</title><style>{_STYLE}</style>
<h1>{escape(name)}</h1>
<p>{escape(lead)}</p>
<p class="dim">checksum <code>{escape(str(document["checksum"]))}</code></p>
<h2>Scenes</h2>
{_filters(kinds)}
<div class="scenes">
{"".join(_figure_of(scene, bool(request["picture"])) for scene in scenes)}
</div>
<h2>Splits</h2>
{_table(["split", *kinds, "all"], splits)}
<p class="dim">By object: what is moved is {escape(", ".join(held["val"]))} (val) or
{escape(", ".join(held["test"]))} (test),
which nothing in training asks to move. By layout: the arrangement's structure occurs in no training scene.</p>
<h2>Difficulty</h2>
<div class="tables">{axes}</div>
<h2>Rejected candidates</h2>
{_rejections(rejected, found["candidates"])}
<script>{_SCRIPT}</script>
</html>
"""


def _filters(kinds: Sequence[str]) -> str:
    """What chooses among the pictures; without a script, all of them are shown."""

    def choice(name: str, values: Sequence[str]) -> str:
        options = "".join(f"<option>{escape(one)}</option>" for one in values)
        return f'<label>{name} <select name="{name}"><option value="">all</option>{options}</select></label>'

    words = '<label>words <input name="words" type="search" placeholder="mug red"></label>'
    return f'<form>{choice("task", kinds)}{choice("split", SPLITS)}{words}<span id="count" class="dim"></span></form>'


def _rejections(rejected: Sequence[Mapping[str, Any]], candidates: int) -> str:
    if not rejected:
        return "<p>None.</p>"
    counts = Counter(str(one["reason"]) for one in rejected)
    rows = []
    for reason, count in counts.most_common():
        example = next(one for one in rejected if one["reason"] == reason)
        rows.append([reason, count, f"{100 * count / candidates:.1f} %", str(example["message"])])
    return _table(["reason", "candidates", "share", "for example"], rows, left=3)


def _figure_of(scene: Mapping[str, Any], picture: bool) -> str:
    folder = f"{SCENES}/{scene_name(scene['place'])}"
    image = f'<img loading="lazy" src="{folder}/preview.png" alt="{escape(scene["prompt"])}">' if picture else ""
    return (
        f'<figure data-task="{escape(scene["kind"])}" data-split="{escape(scene["split"])}">'
        f'<a href="{folder}/">{image}</a><figcaption><b>{escape(scene["instruction"])}</b>'
        f'{escape(scene["prompt"])} <span class="dim">{scene["place"]}, {escape(scene["split"])}</span>'
        "</figcaption></figure>\n"
    )


def _table(head: Sequence[Any], rows: Sequence[Sequence[Any]], about: str = "", left: int = -1) -> str:
    cells = "".join(
        f"<th{' class=left' if place == left else ''}>{escape(str(one))}</th>" for place, one in enumerate(head)
    )
    body = "".join(
        "<tr>"
        + "".join(
            f"<td{' class=left' if place == left else ''}>{escape(str(one))}</td>" for place, one in enumerate(row)
        )
        + "</tr>\n"
        for row in rows
    )
    note = f'<p class="dim">{escape(about)}</p>' if about else ""
    return f"<div class=wide>{note}<table><tr>{cells}</tr>\n{body}</table></div>"


def _figure(value: Any) -> str:
    return "-" if value is None else f"{value:.3g}"
