"""The structures of compositions: cores, which a task needs, and side groups, which stand beside them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from pat3d.envs.suites.composer import STACKED_WIDTH, Composer
from pat3d.envs.suites.pools import BOWL, BOWL_WIDTH, BROAD, COLOURS, FLAT, HOME_WIDTH, LONG, STANDING, WIDE
from pat3d.envs.tasks.beside import Beside
from pat3d.envs.tasks.goals import Rearrange
from pat3d.envs.tasks.push import Push
from pat3d.scene.relations import SupportKind
from pat3d.scene.task_spec import AND_THEN

TO_A_SIDE, NEXT = ":to a side", ":next"
"""End the task of a core that pushes something by a distance or to an edge, or next to something else: what exactly is
drawn with the scene."""


@dataclass(frozen=True, kw_only=True)
class Core:
    """What a task needs in its scene."""

    name: str
    size: int
    """Objects that it adds."""
    build: Callable[[Composer], str]
    """Adds them, and says which task they are for."""
    steps: int = 1
    """Of a chain."""


def _pick_loose(c: Composer) -> str:
    return f"pick:{c.item(moved=True)}"


def _pick_in(c: Composer) -> str:
    return f"pick:{c.into(c.container('in', place=True), moved=True)}"


def _pick_beside(c: Composer) -> str:
    carrier = c.container("on", capacity=2, place=True)
    target = c.into(carrier, moved=True)
    c.into(carrier)
    return f"pick:{target}"


def _pick_top(height: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        return f"pick:{_on_tower(c, height)}"

    return build


def _on_tower(c: Composer, height: int) -> str:
    """Something to move, on top of `height` others."""
    base = c.tower(height)
    c.places.append(base)
    return c.item(base, "on", moved=True, groups=(FLAT, STANDING), width=STACKED_WIDTH)


def _place_loose(kind: str, companions: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        where = c.container(kind, capacity=companions + 1, place=True)
        for _ in range(companions):
            c.into(where)
        return f"place:{c.item(moved=True, width=where[1].width)}:{where[0]}"

    return build


def _place_from_tower(c: Composer) -> str:
    where = c.container(place=True)
    base = c.tower(1)
    c.places.append(base)
    width = min(STACKED_WIDTH, where[1].width)
    return f"place:{c.item(base, 'on', moved=True, groups=(FLAT, STANDING), width=width)}:{where[0]}"


def _place_across(c: Composer) -> str:
    where = c.container("in", place=True)
    source = c.container("on", place=True)
    width = min(where[1].width, source[1].width)
    return f"place:{c.item(source[0], 'on', moved=True, width=width)}:{where[0]}"


def _stack_loose(height: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        base = c.tower(height)
        c.places.append(base)
        return f"stack:{c.item(moved=True, groups=(FLAT, STANDING), width=STACKED_WIDTH)}:{base}"

    return build


def _stack_from(kind: str) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        source = c.container(kind, place=True)
        base = c.tower(1)
        c.places.append(base)
        width = min(source[1].width, STACKED_WIDTH)
        carried = "in" if source[1].kind == "in" else "on"
        lowest = source[1].lowest
        moved = c.item(source[0], carried, moved=True, groups=(FLAT, STANDING), width=width, height=lowest)
        return f"stack:{moved}:{base}"

    return build


SORTED = 1.7
"""Between the areas that the agent's camera shows where things are sorted, which is two homes and more, and where one
thing is moved, roughly."""


def _sort(first: int, second: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        colours = [COLOURS[place] for place in c.rng.permutation(6)[:2]]
        c.avoid, c.coloured_only = (*colours, "white"), True
        # A bystander of a container's colour would have a home there: containers are white, and nothing else is.
        c.container_colours = ("white",)
        c.least_silhouette *= SORTED
        for colour, count in zip(colours, (first, second), strict=True):
            c.home(colour)
            for _ in range(count):
                c.item(moved=True, colour=colour, width=HOME_WIDTH)
        return "sort"

    return build


def _unload(kind: str, count: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        where = c.container(kind, capacity=count, place=True)
        for _ in range(count):
            c.into(where, moved=True)
        return f"unload:{where[0]}"

    return build


def _retrieve(height: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        target = c.item(moved=True, groups=(FLAT,), width=STACKED_WIDTH)
        c.places.append(c.tower(height, parent=target))
        return f"retrieve:{target}"

    return build


def _chain_into(kind: str, count: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        where = c.container(kind, capacity=count, place=True)
        steps = [f"place:{c.item(moved=True, width=where[1].width)}:{where[0]}" for _ in range(count)]
        return f"chain:{AND_THEN.join(steps)}"

    return build


def _chain_tower(c: Composer) -> str:
    base = c.tower(1)
    c.places.append(base)
    middle = c.item(moved=True, groups=(FLAT,), width=STACKED_WIDTH)
    top = c.item(moved=True, groups=(FLAT, STANDING), width=STACKED_WIDTH)
    return f"chain:stack:{middle}:{base}{AND_THEN}stack:{top}:{middle}"


def _chain_then_pick(c: Composer) -> str:
    where = c.container("in", place=True)
    first = c.item(moved=True, width=where[1].width)
    return f"chain:place:{first}:{where[0]}{AND_THEN}pick:{c.item(moved=True)}"


def _chain_two_places(first: int, second: int) -> Callable[[Composer], str]:
    """So many into something, then so many onto something else."""

    def build(c: Composer) -> str:
        both = c.container("in", capacity=first, place=True), c.container("on", capacity=second, place=True)
        counts = [both[0]] * first + [both[1]] * second
        steps = [f"place:{c.item(moved=True, width=one[1].width)}:{one[0]}" for one in counts]
        return f"chain:{AND_THEN.join(steps)}"

    return build


def _chain_lifts(count: int) -> Callable[[Composer], str]:
    """One thing after the other lifted and put back: how far it is cannot be seen."""

    def build(c: Composer) -> str:
        return f"chain:{AND_THEN.join(f'lift:{c.item(moved=True)}' for _ in range(count))}"

    return build


def _chain_lifts_between(count: int) -> Callable[[Composer], str]:
    """Things lifted and put back before and after something is put somewhere, and a pick at the end."""

    def build(c: Composer) -> str:
        where = c.container(place=True)
        lifts = [f"lift:{c.item(moved=True)}" for _ in range(count)]
        put = f"place:{c.item(moved=True, width=where[1].width)}:{where[0]}"
        return f"chain:{AND_THEN.join((lifts[0], put, *lifts[1:], f'pick:{c.item(moved=True)}'))}"

    return build


def _chain_carried(count: int) -> Callable[[Composer], str]:
    """Things put into a bowl, then the bowl onto a tray, and others after it."""

    def build(c: Composer) -> str:
        bowl, tray = c.item(moved=True, groups=(BOWL,)), c.container("on", capacity=4, place=True)
        inside = f"place:{c.item(moved=True, width=BOWL_WIDTH)}:{bowl}"
        beside = [f"place:{c.item(moved=True, width=tray[1].width / 2)}:{tray[0]}" for _ in range(count)]
        return f"chain:{AND_THEN.join((inside, f'place:{bowl}:{tray[0]}', *beside))}"

    return build


def _rearrange(count: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        # Where they are to go is drawn when it is known where everything stands.
        return ":".join((Rearrange.kind, *(c.item(moved=True) for _ in range(count))))

    return build


def _push(how: str) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        # Where to is drawn when it is known where everything stands.
        return f"{Push.kind}:{c.item(moved=True, groups=(WIDE, BROAD))}{how}"

    return build


def _beside_loose(c: Composer) -> str:
    # In which relation is drawn when it is known where everything stands.
    target = c.item(moved=True)
    c.places.append(c.item())
    return f"{Beside.kind}:{target}:{c.places[-1]}"


def _beside_container(kind: str) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        landmark = c.container(kind, place=True)
        return f"{Beside.kind}:{c.item(moved=True)}:{landmark[0]}"

    return build


def _beside_from(kind: str) -> Callable[[Composer], str]:
    """From in or on something to beside something else."""

    def build(c: Composer) -> str:
        target = c.into(c.container(kind), moved=True)
        c.places.append(c.item())
        return f"{Beside.kind}:{target}:{c.places[-1]}"

    return build


def _carry_empty(c: Composer) -> str:
    return f"carry:{c.item(moved=True, groups=(BROAD,))}"


def _carry_loaded(c: Composer) -> str:
    carried = c.item(moved=True, groups=(BROAD,))
    kind: SupportKind = "on" if carried.endswith("tray") else "in"
    c.item(carried, kind, groups=(FLAT, STANDING), width=0.085, height=0.0 if kind == "on" else 0.04)
    return f"carry:{carried}"


def _hand_over(c: Composer) -> str:
    return f"handover:{c.item(moved=True, groups=(LONG,))}"


def _opening(kind: str) -> Callable[[Composer], str]:
    return lambda c: f"{kind}:{c.fixture(kind)}"


def _core(name: str, size: int, build: Callable[[Composer], str], steps: int = 1) -> Core:
    return Core(name=name, size=size, build=build, steps=steps)


CORES: dict[str, tuple[Core, ...]] = {
    "pick": (
        _core("loose", 1, _pick_loose),
        _core("in a container", 2, _pick_in),
        _core("beside another on a carrier", 3, _pick_beside),
        _core("on top of one", 2, _pick_top(1)),
        _core("on top of two", 3, _pick_top(2)),
    ),
    "place": (
        _core("into an empty container", 2, _place_loose("in", 0)),
        _core("onto an empty carrier", 2, _place_loose("on", 0)),
        _core("beside another in a container", 3, _place_loose("in", 1)),
        _core("beside another on a carrier", 3, _place_loose("on", 1)),
        _core("from a stack", 3, _place_from_tower),
        _core("from a carrier into a container", 3, _place_across),
    ),
    "stack": (
        _core("on one", 2, _stack_loose(1)),
        _core("on two", 3, _stack_loose(2)),
        _core("on three", 4, _stack_loose(3)),
        _core("from a carrier", 3, _stack_from("on")),
        _core("from a container", 3, _stack_from("in")),
    ),
    "sort": (
        _core("one and one", 4, _sort(1, 1)),
        _core("two and one", 5, _sort(2, 1)),
        _core("two and two", 6, _sort(2, 2)),
        _core("three and one", 6, _sort(3, 1)),
    ),
    "unload": (
        _core("two from a container", 3, _unload("in", 2)),
        _core("two from a carrier", 3, _unload("on", 2)),
        _core("three from a container", 4, _unload("in", 3)),
        _core("three from a carrier", 4, _unload("on", 3)),
    ),
    "chain": (
        _core("two into a container", 3, _chain_into("in", 2), 2),
        _core("two onto a carrier", 3, _chain_into("on", 2), 2),
        _core("three onto a carrier", 4, _chain_into("on", 3), 3),
        _core("into one and onto another", 4, _chain_two_places(1, 1), 2),
        _core("a tower of three", 3, _chain_tower, 2),
        _core("into a container, then a pick", 3, _chain_then_pick, 2),
        _core("into a bowl, then that onto a tray", 3, _chain_carried(0), 2),
        _core("two lifted in turn", 2, _chain_lifts(2), 2),
        _core("three lifted in turn", 3, _chain_lifts(3), 3),
        _core("one lifted, one put, one picked", 4, _chain_lifts_between(1), 3),
        _core("four onto a carrier", 5, _chain_into("on", 4), 4),
        _core("two into one and two onto another", 6, _chain_two_places(2, 2), 4),
        _core("four lifted in turn", 4, _chain_lifts(4), 4),
        _core("two lifted, one put, one picked", 5, _chain_lifts_between(2), 4),
        _core("into a bowl, that onto a tray, two beside it", 5, _chain_carried(2), 4),
        _core("two into one and three onto another", 7, _chain_two_places(2, 3), 5),
        _core("five lifted in turn", 5, _chain_lifts(5), 5),
        _core("three lifted, one put, one picked", 6, _chain_lifts_between(3), 5),
    ),
    "rearrange": tuple(_core(name, count, _rearrange(count)) for count, name in enumerate(("one", "two", "three"), 1)),
    "push": (
        _core("to a point", 1, _push("")),
        _core("to a side", 1, _push(TO_A_SIDE)),
        _core("next to another", 1, _push(NEXT)),
    ),
    "beside": (
        _core("another", 2, _beside_loose),
        _core("a container", 2, _beside_container("in")),
        _core("a carrier", 2, _beside_container("on")),
        _core("another, from a container", 3, _beside_from("in")),
        _core("another, from a carrier", 3, _beside_from("on")),
    ),
    "carry": (_core("empty", 1, _carry_empty), _core("with something in or on it", 2, _carry_loaded)),
    "handover": (_core("loose", 1, _hand_over),),
    "open": (_core("a drawer or a door", 2, _opening("open")),),
    "close": (_core("a drawer or a door", 2, _opening("close")),),
    "retrieve": (_core("under one", 2, _retrieve(1)), _core("under two", 3, _retrieve(2))),
}


def _side_none(c: Composer) -> str:
    return ""


def _side_tower(height: int) -> Callable[[Composer], str]:
    return lambda c: c.tower(height)


def _side_container(kind: str, count: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        where = c.container(kind, capacity=count)
        for _ in range(count):
            c.into(where)
        return where[0]

    return build


SIDES = (
    _core("nothing", 0, _side_none),
    _core("a stack of two", 2, _side_tower(2)),
    _core("a stack of three", 3, _side_tower(3)),
    _core("one in a container", 2, _side_container("in", 1)),
    _core("two on a carrier", 3, _side_container("on", 2)),
    _core("two in a container", 3, _side_container("in", 2)),
)
