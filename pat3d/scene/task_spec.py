"""How a task is written down: "pick:red mug", "chain:place:pear:tray:then:stack:cup:saucer".

A kind, then the names of what it is about, with colons between. A chain is several of those, to be done in turn. What
a task asks for and when it is done is told by pat3d.envs.tasks.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from pat3d.scene.relations import LATERAL_KINDS

CHAIN = "chain"
AND_THEN = ":then:"
"""Between the steps of a chain."""
STEPS = (2, 5)
"""Fewest and most steps of a chain."""
PUTTING = frozenset({"place", "stack", "beside"})
"""Kinds of steps at the end of which a thing stands elsewhere; the last step of a chain may be "pick" as well."""
SLIDING = frozenset({"open", "close"})
"""Kinds of steps that leave a drawer where it slides; a chain may open one and shut it."""

ASIDE = tuple(sorted(LATERAL_KINDS - {"around"}))
"""Relations of "beside:OBJECT:RELATION:LANDMARK"."""
_NAMES = {"pick": 1, "unload": 1, "place": 2, "stack": 2, "sort": 0, "open": 1, "close": 1}
"""How many things a step names."""


def steps_of(task: str) -> list[list[str]]:
    """The kind and the names of each step of `task`, which is one step unless it is a chain."""
    kind, _, rest = task.partition(":")
    return [step.split(":") for step in (rest.split(AND_THEN) if kind == CHAIN else [task])]


def about(step: Sequence[str]) -> tuple[str, ...] | None:
    """The names of what `step` is about; None where it is none of the steps that a sentence asks for."""
    kind, *names = step
    if kind == "beside" and len(names) == 3 and names[1] in ASIDE:
        return names[0], names[2]
    return tuple(names) if _NAMES.get(kind) == len(names) else None


def named(task: str) -> tuple[str, ...]:
    """The names of what `task` is about, each once; of a kind that no sentence asks for, all that stands behind it."""
    return tuple(dict.fromkeys(name for step in steps_of(task) for name in about(step) or step[1:]))


def renamed(task: str, called: Mapping[str, str]) -> str:
    """`task` about what is now called otherwise, by the old names."""
    steps = [":".join((step[0], *(called.get(part, part) for part in step[1:]))) for step in steps_of(task)]
    return f"{CHAIN}:{AND_THEN.join(steps)}" if task.startswith(f"{CHAIN}:") else steps[0]


def chain_of(steps: Sequence[str]) -> str | None:
    """The chain of `steps`; None where they make none: too many, one that only looks on, or a thing moved twice."""
    fewest, most = STEPS
    told = [step.split(":") for step in steps]
    moved = [":".join(names) if names[0] in SLIDING else names[1] for names in told if len(names) > 1]
    kinds = [names[0] for names in told]
    puts = all(kind in PUTTING | SLIDING for kind in kinds[:-1])
    puts &= not kinds or kinds[-1] in PUTTING | SLIDING | {"pick"}
    # What is put beside something that is moved later is beside it no more.
    astray = any(step[0] == "beside" and step[3] in moved[at:] for at, step in enumerate(told))
    if not fewest <= len(steps) <= most or not puts or astray or len({*moved}) < len(steps):
        return None
    return f"{CHAIN}:{AND_THEN.join(steps)}"
