"""The task that the instructions of a prompt are, and notes on what of them no task does."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise, takewhile

from pat3d.plan.doors import HINGED
from pat3d.plan.drawers import DRAWERS
from pat3d.plan.grammar.meaning.entities import Item, Step
from pat3d.plan.grammar.meaning.kinds import KINDS
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.rewriting.instructions import VERBS, base_of
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.holders import FLAT, holds
from pat3d.scene.relations import LATERAL_KINDS, SUPPORT_KINDS
from pat3d.scene.task_spec import STEPS, chain_of

SEVERAL = f"the instruction is several tasks that make no chain ({STEPS[0]} to {STEPS[1]}, each of another thing):"
"""How the note begins that lists them."""
_FORMING = frozenset({"pile", "cluster", "scatter", "spread"})
"""Verbs of placing that say how several things stand together."""
_GIVING_AWAY = frozenset({"release", "hand", "pass", "throw", "toss", "bring", "deliver"})
"""Verbs by which what was picked up is no longer where it was, and at no place of the scene."""
_BELOW = re.compile(r"\b(?:to|on|at) the (?:bottom|lower) (?:side )?of\b", re.IGNORECASE)
"""What is below a thing that holds nothing in it."""
_BRINGING = frozenset(
    {"bring", "carry", "move", "transport", "push", "slide", "drag", "nudge", "shove", "shift", "sweep"}
)
"""Verbs by which something comes to be beside what it is brought "to"."""
_SIDE_OF = re.compile(r"\b(left|right)(?:-hand| hand)? side of\b", re.IGNORECASE)
_AT_SIDE_OF = re.compile(r"\b(?:on|to|at) the (?:left|right)(?:[- ]hand)?(?: side)? of\b", re.IGNORECASE)
"""What is "on the right side of the plate" is in no half of it."""
_ASIDE = r"(?:to the )?(?:left of|right of|in front of|behind|next to|beside|near)\b"
_ASIDE_TWICE = re.compile(rf"\b(?<!from )({_ASIDE} [^,;.]+?),? and (?={_ASIDE})", re.IGNORECASE)
"""Two places of one thing, of which a task has the second."""
_THERE_BEFORE = re.compile(
    rf"{_ASIDE} .*?\b(?<!that )(?<!which )(?:ends? up|winds? up|is|are|should|must|has to|have to|goes|go|belongs?)\b",
    re.IGNORECASE,
)
"""Where a thing is that is to be elsewhere: "make sure the cup behind the jar ends up on the tray"."""
_NOT_BESIDE = frozenset({"hang", "fill"})
"""Verbs of which "at the hook" says where it is done."""
_SMALL_DISHES = ("plate", "saucer")
"""What has no room beside what is on it, but for what is eaten."""
_EATEN = (*KINDS["fruit"], *KINDS["vegetable"])
_HELD_OVER = re.compile(r"hold\b.*?\b((?:over|above) .*)", re.IGNORECASE)
"""Where a thing is held that stands nowhere then."""
_HARDLY = 1.0
"""How unlikely it is that something rests on what it is only brought to."""
_CHOICE = re.compile(r"^(?!.* and ).*\bor\b", re.IGNORECASE)
"""What leaves a choice of two things, and moves no further ones."""
_GROWING = ("planter", "flower pot")
"""What something is brought to without being put in it."""
_KEEPING = ("knife block",)
"""What something is brought to that is kept in it."""
_ELSEWHERE = re.compile(
    r"\b(?:on|onto|in|into|at|(?<!tower )(?<!stack )(?<!pile )from)\b (?!(?:top of )?(?:each|one|another)|an? )|,",
    re.IGNORECASE,
)
"""Words by which a stack is said to stand somewhere, or more is said of it."""


def task_of(world: World, names: Mapping[Item, str]) -> tuple[str | None, list[str]]:
    """The one task that the steps of `world` are, None where no kind of task is, and notes on what is not in it.

    Args:
        world: with what is to be done, in order.
        names: of the objects of the plan.
    """
    steps = world.steps
    undone = [step for step in steps if step.manner == "other" and not _sliding(step, world, names)]
    notes = [f'not modelled: "{step.said}": no task does that.' for step in undone]
    begun = [_begins(step, steps[at + 1 :]) for at, step in enumerate(steps)]
    wanted = [step for step, begins in zip(steps, begun, strict=True)
              if step not in undone and step.items and not begins]  # fmt: skip
    specs: list[str] = []
    for step in wanted:
        made = _specs(step, world, names)
        notes += _unsaid(step, world)
        if not made:
            # "Put the apple on the plate, and the fork beside it": the fork alone has no task.
            several = sum(other.said == step.said for other in steps) > 1
            notes.append(f'not modelled: "{step.part if several and step.part else step.said}": no task does that.')
        specs += made
    if not specs:
        # "Grasp the block, then turn it": of the two, the first is a task; not of "..., then put it beside the cup".
        picked = [step for step in steps if step.manner == "pick" and step not in wanted and not _is_put(step, steps)]
        picks = (_specs(step, world, names) for step in picked)
        specs = next((made for made in picks if made), [])
        if not specs:
            # "Get the keys and hang them on the hook"
            begun_by = [step for step in steps if step.manner == "pick" and step.items and step not in wanted]
            notes += [f'not modelled: "{step.said}": no task does that.' for step in begun_by]
    specs = _moved_once(dict.fromkeys(specs))
    if len(specs) < STEPS[0]:
        return (specs[0] if specs else None), notes
    if (chain := chain_of(specs)) is None and (shorter := _unclosed(specs)) != specs:
        last = ", ".join(specs[len(shorter) :])
        notes.append(f"not modelled: {last}: nothing is closed after something is picked up.")
        return shorter[0] if len(shorter) < STEPS[0] else chain_of(shorter), notes
    if chain is None:
        listed = ", ".join(specs)
        notes.append(f"{SEVERAL} {listed}.")
    return chain, notes


def _unclosed(specs: list[str]) -> list[str]:
    """`specs` without what is closed at their end, where they are a task without it."""
    left = specs[: max((at + 1 for at, spec in enumerate(specs) if not spec.startswith("close:")), default=0)]
    return left if len(left) == 1 or chain_of(left) is not None else specs


def _moved_once(specs: Iterable[str]) -> list[str]:
    """`specs` without that the fork is put on the tray where it comes next to the cup that was put there before it."""
    told = [spec.split(":") for spec in specs]
    put = [(each[1], each[2]) for each in told if each[0] == "place"]
    beside = [(each[1], each[3]) for each in told if each[0] == "beside" and each[2] == "next_to"]
    again = {(one, goal) for one, mark in beside for mate, goal in put if mate == mark and (one, goal) in put}
    return [":".join(each) for each in told if each[0] != "place" or (each[1], each[2]) not in again]


def _begins(step: Step, later: Sequence[Step]) -> bool:
    """Whether `step` begins one of those `later`: to pick what something is done with, or to bring it there.

    "Bring the can to the lamp: put it behind it."
    """
    if step.manner == "pick":
        return any(set(step.items) & set(other.items) for other in later)
    brought = step.link is not None and step.link.manner == "goal"
    return brought and any((step.items, step.goal) == (other.items, other.goal) for other in later)


def _is_put(picked: Step, steps: Sequence[Step]) -> bool:
    """Whether one of `steps` behind `picked` says where its things are to go; handing over is to no place."""
    later = steps[list(steps).index(picked) + 1 :]
    verbs = [next((base_of(word) for word in step.said.lower().split() if base_of(word) in VERBS), "")
             for step in later if set(step.items) & set(picked.items)]  # fmt: skip
    nowhere = _GIVING_AWAY if not any(step.goal for step in later) else frozenset()
    return any(VERBS.get(verb, "other") != "other" and verb not in nowhere for verb in verbs)


def _unsaid(step: Step, world: World) -> list[str]:
    """What `step` asks beyond its task, and what it leaves open."""
    notes: list[str] = []
    verb = next((word for word in step.said.lower().split()[:2] if word in _FORMING), "")
    if _chosen(step) != step:
        notes.append(f'"{step.said}": the first that is named is taken.')
    if step.manner == "pick" and (over := _HELD_OVER.match(step.said)):
        notes.append(f'not modelled: "{over[1]}"')
    if step.manner == "unload" and not any(edge.parent in step.items for edge in world.supports.values()):
        named = " and ".join(dict.fromkeys(f'"{item.group.words}"' for item in step.items))
        if not any(item in world.supports for item in step.items):
            notes.append(f"{named}: what is in it is not said; it is made empty.")
    if step.link and step.link.kind in LATERAL_KINDS and (twice := _ASIDE_TWICE.search(step.said)) is not None:
        # "Put the cup left of the jar and behind the bowl"
        parts = (other.part.lower() for other in world.steps if other.said == step.said)
        if not any(twice[1].lower() in part for part in parts):
            notes.append(f'not modelled: "{twice[1]}"')
    if verb and step.manner == "make":
        notes.append(f'not modelled: "{verb}": a task asks where each thing is put, not how they stand together.')
    moved = [item for item in step.items if not world.on_floor(item)]
    if moved and step.goal and step.manner in ("make", "move", "stack", "sort"):
        # "Put the rug and the cup on the table": the rug stays.
        left = dict.fromkeys(item.group.words for item in step.items if item not in (*moved, *step.goal))
        notes += [f'not modelled: that "{words}" is moved: no task moves furniture or rugs.' for words in left]
    return notes


def put_otherwise(world: World, names: Mapping[Item, str]) -> list[str]:
    """What the steps of `world` are said to put in what a task puts them on, or on what it puts them in, as notes."""
    notes = (_otherwise(step, world, names) for step in world.steps if _specs(step, world, names))
    return [note for note in notes if note]


def _otherwise(step: Step, world: World, names: Mapping[Item, str]) -> str:
    link, goal = step.link, next((item for item in step.goal if item in names), None)
    items = [item for item in step.items if item is not goal]
    if link is None or goal is None or not items or step.manner not in ("make", "move"):
        return ""
    moved, holder, noun = f'"{items[0].group.words}"', f'"{goal.group.words}"', world.noun(goal)
    if noun.split()[-1] == world.noun(items[0]).split()[-1] or noun in FLAT:
        # "Put the small bowl on the large one", "put the egg on the pan"
        return ""
    inside, closet = holds(noun), world.is_a(goal, vessels.SHUT, vessels.CLOSED)
    shelf = world.likely.level(noun) or world.on_floor(goal)
    if link.kind == "in" and not inside and (closet or not shelf):
        return f"not arranged: {moved} inside {holder}; the task puts it on it"
    on = link.kind == "on" and (link.manner == "place" or link.said == "onto") and link.said != "over"
    return f"not arranged: {moved} on {holder}; the task puts it in it" if on and inside else ""


def _chosen(step: Step) -> Step:
    """`step` with the first of what it leaves a choice of: "pick up the pen or the ruler", "in the pot or pan"."""
    if not _CHOICE.search(step.said):
        return step
    items = step.items[:1] if len(step.goal) < 2 else step.items
    return replace(step, items=items, goal=step.goal[:1])


def _specs(step: Step, world: World, names: Mapping[Item, str]) -> list[str]:
    step = _chosen(step)
    if step.manner == "other":
        return _sliding(step, world, names)
    if step.manner == "unload":
        return _unloading(step, world, names)
    if step.manner == "sort":
        return ["sort"] if len(step.goal) > 1 else []
    # No robot moves furniture.
    items = [item for item in step.items if item in names and not world.on_floor(item)]
    if step.manner == "pick" and any(world.noun(item) in DRAWERS for item in items):
        return []
    if step.manner == "pick":
        return [f"pick:{names[items[0]]}"] if len(items) == 1 else []
    goal = next((item for item in step.goal if item in names), None)
    if goal is not None and goal.group.height > 1:
        goal = world.tops(step.goal)[-1]
    if step.manner == "stack" and goal is None and len(items) == 2:
        return [f"stack:{names[items[0]]}:{names[items[1]]}"]
    if step.manner == "stack" and step.link is None and _ELSEWHERE.search(step.said) is None:
        return _tower(items, names)
    if goal is None:
        return []
    if not _is_placing(step, world, items, goal):
        piled = step.manner == "stack" and len(items) > 1 and _beside(step, world, items[:1], goal, names)
        # "Stack the cups to the left of the plate"
        return [*piled, *_tower(items, names)] if piled else _beside(step, world, items, goal, names)
    noun = world.noun(goal)
    stacked = step.manner == "stack" and not world.likely.hollow(noun) and not world.likely.level(noun)
    kind = "stack" if stacked else "place"
    moved = [item for item in items if item is not goal and world.support(item) is not goal]
    if step.manner == "stack":
        # "Stack the three cubes on the tray": the second on the first.
        return [f"{kind}:{names[item]}:{names[goal]}" for item in moved[:1]] + _tower(moved, names)
    alike = [item for item in step.goal if item in names and item.group is goal.group]
    # "Put the two cups on the two plates": one on each.
    goals = alike if goal.group.height == 1 and len(alike) > 1 and goal in alike else [goal]
    pairs = [(item, goals[at % len(goals)]) for at, item in enumerate(item for item in items if item not in goals)]
    return [f"{kind}:{names[item]}:{names[to]}" for item, to in pairs if world.support(item) is not to]


def _sliding(step: Step, world: World, names: Mapping[Item, str]) -> list[str]:
    """The tasks by which drawers, and doors that turn, are opened or shut; none of what has a lid."""
    kind = {"open": "open", "close": "close", "shut": "close"}.get(step.verb)
    moved = [item for item in step.items if item in names and world.noun(item) in {*DRAWERS, *HINGED}]
    return [f"{kind}:{names[item]}" for item in moved] if kind and len(moved) == len(step.items) else []


def _beside(step: Step, world: World, items: Sequence[Item], goal: Item, names: Mapping[Item, str]) -> list[str]:
    """The tasks by which each of `items` comes to stand beside `goal`, on what carries that: "to the left of the bowl".

    What is brought to a thing that carries nothing is put next to it. Of furniture no robot is told to reach around.
    """
    goal = _below_it(step, world, goal, names)
    link, verbs = step.link, {base_of(word) for word in step.said.lower().split()}
    if link is None or link.says is not None or len({*step.goal}) != 1 or world.on_floor(goal) or goal in items:
        return []
    brought = link.manner == "goal" and link.kind == "on" and link.said != "onto" and bool(verbs & _BRINGING)
    # To bring a mug to the mug tree is to hang it there.
    brought = brought and not world.is_a(goal, lexicon.HOOKED)
    half = link.manner == "half" and _AT_SIDE_OF.search(step.said) is not None
    beside = (link.manner == "place" or half) and link.kind in LATERAL_KINDS and link.kind != "around"
    if not (brought or beside) or verbs & _NOT_BESIDE or _BELOW.search(step.said) is not None:
        return []
    if _THERE_BEFORE.search(step.said) is not None:
        return []
    if "between" in step.part.lower().split() or "in the front of" in step.said.lower():
        # "Between the pot and the robot": the robot is none of the scene. In the front of the basket is in it.
        return []
    side = _SIDE_OF.search(step.said) if brought else None
    kind = f"{side[1].lower()}_of" if side else "next_to" if brought else link.kind
    return [f"beside:{names[item]}:{kind}:{names[goal]}" for item in items]


def _below_it(step: Step, world: World, goal: Item, names: Mapping[Item, str]) -> Item:
    """What things are put beside that are to be beside "it", `goal`: what that was put in or on just before.

    "Put the egg in the cup and the spoon beside it" is beside the cup; on a table or a tray things stand beside it.
    """
    if step.part.lower().split()[-1:] != ["it"]:
        return goal
    before = list(takewhile(lambda other: other is not step, world.steps))
    put = next((other for other in reversed(before) if goal in other.items and other.goal), None)
    if put is None or put.link is None or put.link.kind not in SUPPORT_KINDS:
        return goal
    below = next((item for item in put.goal if item in names), goal)
    # "Put the steak on the plate and the carrot next to it"
    served = all(world.is_a(item, _EATEN) for item in step.items)
    roomy = world.likely.level(world.noun(below)) and (served or not world.is_a(below, _SMALL_DISHES))
    return goal if world.on_floor(below) or roomy else below


def _tower(items: Sequence[Item], names: Mapping[Item, str]) -> list[str]:
    """The tasks by which each of `items` comes to stand on the one before it."""
    return [f"stack:{names[item]}:{names[below]}" for below, item in pairwise(items)]


def _unloading(step: Step, world: World, names: Mapping[Item, str]) -> list[str]:
    edges = [(item, world.supports.get(item)) for item in step.items[:1]]
    # "unload the cups from the crate" is about the crate.
    taken = bool({"from", "off", "out"} & set(step.said.lower().split()))
    holders = [edge.parent if edge and (taken or edge.kind == "in") else item for item, edge in edges]
    likely = world.likely
    holders = [item for item in holders if likely.hollow(world.noun(item)) or likely.closet(world.noun(item))]
    return [f"unload:{names[item]}" for item in holders if item in names]


def _is_placing(step: Step, world: World, items: Sequence[Item], goal: Item) -> bool:
    """Whether `step` is that `items` come to rest on `goal`, or in it."""
    link, noun = step.link, world.noun(goal)
    if link is None or link.kind == "hangs_from" or world.is_a(goal, lexicon.HOOKED):
        return False
    if link.manner not in ("place", "goal", "half"):
        return False
    if link.kind not in SUPPORT_KINDS and link.manner in ("place", "goal"):
        return False
    if any(f"{word} to " in step.said.lower() for word in lexicon.DIRECTIONS if word.endswith("er")):
        return False
    if link.manner == "goal" and "into" not in step.said.lower() and world.is_a(goal, _GROWING):
        # "Bring the bucket to the planter"
        return False
    keeps = holds(noun) or world.is_a(goal, _KEEPING) or goal.group.words.lower().endswith("holder")
    if not (world.has_inside(goal) or keeps) and link.manner in ("goal", "place") and link.said != "onto":
        if link.manner == "goal" and all(world.likely.on(world.noun(item), noun) >= _HARDLY for item in items):
            # "Carry the kettle to the lamp" is to beside it.
            return False
        if _BELOW.search(step.said) is not None:
            return False
    beside = len(step.goal) > 1 if link.side == "centre" else not world.is_a(goal, lexicon.LEVEL, lexicon.SEATS)
    if link.manner == "half" and beside:
        # "To the left side of the lamp" is beside it, "in the middle of the plums" among them.
        return False
    if link.said == "over" and not all(world.is_a(item, lexicon.THIN) for item in items):
        # A bowl over a ball is around it.
        return False
    if link.says == "above" or (link.says == "across" and world.likely.hollow(noun)):
        return False
    # A plank on two blocks is on both.
    return link.manner != "place" or goal.group.height > 1 or len(items) != 1 or len(step.goal) == 1
