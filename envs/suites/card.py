"""README.md of a suite: its card. What it is, how it was made, what it measures and what not, how to cite it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pat3d.envs.suites.reference import Reference, reference_of
from pat3d.envs.suites.request import SPLITS, Request, in_split

CARD = "README.md"

_MEASURES = """\
## What it measures

Whether a policy does what a sentence asks for, with one object after the other, in scenes that stand still until the
robot touches them. Success is decided on the state of the simulation. `val/object` and `test/object` ask for kinds of
objects that training never moves; `val/layout` and `test/layout` have arrangements whose structure training never has.

## What it does not measure

- Looks: objects are parametric, with plain textures, under one light. Nothing transparent, no people, no real pictures.
- Contact-rich skill: every task is done by rigid grasps of a parallel gripper, from above for the most part.
- Strategy: what is to be moved is named, and the scripted policy does it in a few moves.
- Other grippers and arms than the one it was rehearsed with: they may not reach or hold what is asked for.
"""


def card(name: str, document: Mapping[str, Any]) -> str:
    """The card of a complete suite; everything in it comes from suite.json and the reference it is of."""
    request = Request.from_dict(document["request"], name)
    of = reference_of(request)
    scenes, numbers, kinds = document["scenes"], document["numbers"], document["request"]["tasks"]
    title = of.name if of is not None and request.scenes == of.request.scenes else name
    rows = [
        [split, *(sum(in_split(s["split"], split) and s["kind"] == kind for s in scenes) for kind in kinds)]
        for split in SPLITS
    ]
    held = document["held_out"]["nouns"]
    versions = ", ".join(f"{package} {value}" for package, value in document["versions"].items() if value)
    axes = "\n".join(f"- {axis.replace('_', ' ')}: {told['about']}" for axis, told in document["axes"].items())
    moved = sorted({noun for scene in scenes for noun in scene["nouns"]})
    held_out = f"{', '.join(held['val'])} (validation); {', '.join(held['test'])} (test)"
    cited = (
        f"{title}, {len(scenes)} scenes, checksum {document['checksum'][:16]}, PAT3D {document['versions']['pat3d']}"
    )
    drift = f"{numbers['largest_drift_mm']:.2g} mm and {numbers['largest_turn_degrees']:.2g} degrees"
    return f"""\
---
license: apache-2.0
task_categories: [robotics]
tags: [manipulation, benchmark, simulation, mujoco, pat3d]
pretty_name: {title}
---

# {title}

{len(scenes)} tabletop scenes with a task each ({", ".join(kinds)}), for {request.robot}; {len(moved)} kinds of objects
are moved. Checksum of the scenes: `{document["checksum"]}`.

{_command(request, of)}
{_conditions(request, numbers.get("seen_percent"))}{_table(["split", *kinds], rows)}

## How it was made

Compositions are drawn from the seed {request.seed}, said in a sentence, made of parametric objects, settled with
barrier contact to static equilibrium, and verified: no intersection ({numbers["intersections"]} in the suite), still in
MuJoCo for 5 s (at most {drift}). The scripted
policy's moves were gone through without physics for every task: reach, grip, and room for arm and object. Of
{numbers["candidates"]} candidates {len(scenes)} are in the suite; `rejected/` says why the others are not
{_reasons(numbers)}.
Made with {versions}.

Held out by kind: {held_out}.

Difficulty of every scene, in `suite.json`:

{axes}

{_MEASURES}
{_baselines(of)}## Licence and citation

Apache-2.0: objects, textures, scenes and instructions were made by PAT3D; nothing in them is anybody else's.

    The PAT3D contributors: {cited}.
"""


def _reasons(numbers: Mapping[str, Any]) -> str:
    counted = ", ".join(f"{reason} {count}" for reason, count in numbers.get("rejected", {}).items())
    return f"({counted or 'none was left out'})"


def _command(request: Request, of: Reference | None) -> str:
    """How to make it again."""
    if of is not None:
        plain, few = of.name.removeprefix("pat3d/"), request.scenes < of.request.scenes
        more = f" --scenes {request.scenes}" if few else ""
        part = f"The first {request.scenes} of the {of.request.scenes} scenes of {of.name}. " if few else ""
        line = f"pat3d suite generate OUT --reference {plain}{more}"
        return f"{part}Made again by\n\n    {line}\n\nand held against the published one by `pat3d suite check OUT`.\n"
    line = f"pat3d suite generate OUT --tasks {','.join(request.tasks)} --scenes {request.scenes} --seed {request.seed}"
    line += f" --objects {request.objects[0]}-{request.objects[1]} --robot {request.robot}"
    if request.clutter:
        line += f" --clutter {','.join(map(str, request.clutter))}"
    if request.rooms:
        line += f" --rooms {','.join(request.rooms)}"
    for option in ("alike", "visible", "vary"):
        if (value := getattr(request, option)) != getattr(Request, option):
            line += f" --{option} {value:g}"
    return f"Made again by\n\n    {line}\n"


def _conditions(request: Request, seen: Mapping[str, float] | None) -> str:
    """What holds of every scene; `seen` is what the objects of the tasks cover [%], where somebody looked."""
    told = []
    if request.alike:
        told.append(f"- distractors by likeness in every scene, of another colour, size or kind: {request.alike}")
    if request.visible:
        told.append(
            f"- every object of a task covers {request.visible:g} % of the agent's picture at the start at least, as "
            "the scene was verified"
            + (f" (least {seen['least']:.2f} %, median {seen['median']:.2f} %)" if seen else "")
        )
    else:
        told.append("- nothing says how much of the agent's picture the objects of a task cover")
    if request.rooms:
        told.append(f"- scenes are in rooms that are seen and touch nothing: {', '.join(request.rooms)}")
    if request.vary:
        told.append(
            f"- every reset moves what stands on the table by up to {request.vary:g} m along x and y, and turns it"
        )
    return "".join(f"{line}\n" for line in told) + ("\n" if told else "")


def _baselines(of: Reference | None) -> str:
    if of is None or not of.baselines:
        return ""
    from scipy.stats import binomtest

    rows = []
    for one in of.baselines:
        done, count = one["successes"], one["episodes"]
        between = binomtest(done, count).proportion_ci(method="wilson")
        rate = f"{100 * done / count:.1f} % [{100 * between.low:.1f}, {100 * between.high:.1f}] of {count}"
        rows.append([one["policy"], one["split"], rate])
    return f"## Baselines\n\n{_table(['policy', 'episodes of', 'success'], rows)}\n\n"


def _table(head: list[str], rows: list[list[Any]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)
