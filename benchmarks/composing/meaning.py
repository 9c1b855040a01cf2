"""What a sentence means, by construction, and how a plan differs from that."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from benchmarks.composing.nouns import MATERIALS, SIZES, Noun
from pat3d.assets.catalogue import lookup
from pat3d.assets.colours import find_colour
from pat3d.plan.grammar.meaning.tasks import SEVERAL
from pat3d.plan.scene_plan import PlannedObject, ScenePlan
from pat3d.scene.task_spec import steps_of

GROUND = "the ground"
_TURNED = {"right_of": "left_of", "behind": "in_front_of"}
_SUPPORTS = frozenset({"on", "in", "hangs_from"})
_CUPBOARDS = ("cabinet", "wardrobe", "sideboard")
"""What things are on, or in."""
_PAIRINGS = 5000
"""Pairings tried before things are taken to be told apart by their qualities alone."""


@dataclass(eq=False)
class Thing:
    """One object that is meant."""

    noun: Noun
    colour: str | None = None
    material: str | None = None
    size: str | None = None

    def label(self) -> str:
        """In words."""
        return " ".join((*self._adjectives(), self.noun.word))

    def fits(self, obj: PlannedObject) -> bool:
        """Whether `obj` is such a thing; what a synonym says already ("small plate") need not be said of it again."""
        kept = {word: named for word in self._adjectives() if (named := lookup.find(f"{word} {self.noun.word}"))}
        if obj.noun not in {*self.noun.catalogue, *(named.noun for named in kept.values())}:
            return False
        found = (find_colour(obj.colours[0]) if obj.colours else None, obj.material, (obj.scale > 1) - (obj.scale < 1))
        said = (self.colour, self.material, self.size)
        wanted = (
            find_colour(self.colour) if self.colour else None,
            MATERIALS[self.material] if self.material else None,
            SIZES[self.size] if self.size else 0,
        )
        return all(
            own == want or (word in kept and not own) for own, want, word in zip(found, wanted, said, strict=True)
        )

    def _adjectives(self) -> list[str]:
        return [word for word in (self.size, self.colour, self.material) if word]


Fact = tuple[str, "Thing | str", "Thing | str"]
"""Relation, child, parent; the ground is a word."""


@dataclass(eq=False)
class Meaning:
    """Things and all that is said of them."""

    things: list[Thing] = field(default_factory=list)
    facts: list[tuple[frozenset[str], Thing, Thing | str]] = field(default_factory=list)
    """What has to be: one of several relations, between child and parent."""
    free: set[Thing] = field(default_factory=set)
    """Of what nobody says what carries it."""
    rows: list[tuple[frozenset[str], tuple[Thing, ...]]] = field(default_factory=list)
    arrangements: list[tuple[str, frozenset[Thing], frozenset[Thing]]] = field(default_factory=list)
    far: list[tuple[Thing, Thing]] = field(default_factory=list)
    """What is said to be farthest from what, which a plan may keep beside the order of the row."""
    postures: dict[Thing, str] = field(default_factory=dict)
    task: tuple[str, ...] | None = None
    """Kinds of task any of which is right; empty for what no task does."""
    of_task: list[Thing] = field(default_factory=list)
    steps: list[tuple[list[str], list[Thing]]] = field(default_factory=list)
    """Several tasks, in order: kinds any of which is right, and what each is about.

    A place beside something is a kind of its own for each side: "beside:left_of".
    """
    words: set[str] = field(default_factory=set)
    """Words that say how things belong together ("respectively"): a note that quotes one names what differs."""

    def add(self, kinds: str, children: Iterable[Thing], parent: Thing | str) -> None:
        """Say that `children` are related to `parent` by one of `kinds` ("on|in")."""
        for child in children:
            self.facts.append((frozenset(kinds.split("|")), child, parent))

    def support(self, thing: Thing) -> tuple[frozenset[str], Thing | str]:
        """What carries `thing`."""
        for kinds, child, parent in self.facts:
            if child is thing and kinds <= _SUPPORTS:
                return kinds, parent
        return frozenset({"on"}), GROUND


@dataclass(frozen=True)
class Difference:
    """Something that is not as meant, with the nouns it is about."""

    said: str
    nouns: tuple[str, ...]
    words: tuple[str, ...] = ()
    """Other words by which a note may name it."""


def differences(meaning: Meaning, plan: ScenePlan) -> list[Difference]:
    """How `plan` differs from `meaning`, with the best pairing of things and objects."""
    wrong = _things(meaning, plan)
    if wrong:
        return wrong
    best: list[Difference] | None = None
    for number, pairing in enumerate(_pairings(meaning, plan)):
        found = _facts(meaning, plan, pairing)
        if best is None or len(found) < len(best):
            best = found
        if not best or number > _PAIRINGS:
            break
    return best or []


def _things(meaning: Meaning, plan: ScenePlan) -> list[Difference]:
    left = list(plan.objects)
    wrong: list[Difference] = []
    missing: list[Thing] = []
    for thing in meaning.things:
        own = next((obj for obj in left if thing.fits(obj)), None)
        if own is None:
            missing.append(thing)
        else:
            left.remove(own)
    for thing in missing:
        words = tuple(word for word in (thing.colour, thing.material, thing.size) if word)
        wrong.append(Difference(f"lacks {thing.label()}", (thing.noun.word,), words))
    for obj in left:
        # Where a note names the red of a cup that lacks it, the cup without it is no further difference.
        words = tuple(word for each in wrong for word in each.words if obj.noun in each.nouns)
        wrong.append(Difference(f"adds {obj.name}", (obj.noun,), words))
    return wrong


def _pairings(meaning: Meaning, plan: ScenePlan) -> Iterator[dict[str, Thing]]:
    """Every way to take the objects of `plan` for the things that are meant; the likeliest first."""
    order = sorted(meaning.things, key=lambda thing: sum(thing.fits(obj) for obj in plan.objects))
    supports = {obj.name: plan.parent(obj.name) for obj in plan.objects}
    pairing: dict[str, Thing] = {}

    def extend(at: int) -> Iterator[dict[str, Thing]]:
        if at == len(order):
            yield dict(pairing)
            return
        thing = order[at]
        free = [obj for obj in plan.objects if obj.name not in pairing and thing.fits(obj)]
        _, parent = meaning.support(thing)
        free.sort(key=lambda obj: pairing.get(supports[obj.name]) is not parent)
        for obj in free:
            pairing[obj.name] = thing
            yield from extend(at + 1)
            del pairing[obj.name]

    return extend(0)


def _facts(meaning: Meaning, plan: ScenePlan, pairing: Mapping[str, Thing]) -> list[Difference]:
    told: set[Fact] = set()
    for rel in plan.relations:
        told |= _both(rel.kind, pairing[rel.child], pairing[rel.parent])
    carried = {child for kind, child, _ in told if kind in _SUPPORTS}
    told |= {("on", thing, GROUND) for thing in meaning.things if thing not in carried}
    wrong = [_carried(meaning, thing, told) for thing in meaning.things if thing not in meaning.free]
    wrong = [each for each in wrong if each.said]
    for kinds, child, parent in meaning.facts:
        if not kinds & _SUPPORTS and not any((kind, child, parent) in told for kind in kinds):
            wrong.append(_difference("lacks", "|".join(sorted(kinds)), child, parent))
    for kind, child, parent in told - _allowed(meaning):
        again = kind in _TURNED or (kind == "next_to" and isinstance(parent, Thing) and id(child) > id(parent))
        if kind not in _SUPPORTS and not again:
            wrong.append(_difference("adds", kind, child, parent))
    wrong += _arranged(meaning, plan, pairing, told)
    postures = {pairing[each.object]: each.kind for each in plan.postures}
    for thing in meaning.things:
        said, read = meaning.postures.get(thing), postures.get(thing)
        standing = said is None and (read == "upright" or (read == "on_its_side" and _is_shelved(meaning, thing)))
        if said != read and not standing:
            difference = f"posture of {thing.label()}: {read} for {said}"
            wrong.append(Difference(difference, (thing.noun.word,), tuple((said or "").split("_"))))
    return wrong + _task(meaning, plan, pairing)


def _carried(meaning: Meaning, thing: Thing, told: set[Fact]) -> Difference:
    """How what carries `thing` differs from what is meant; empty where it does not."""
    kinds, parent = meaning.support(thing)
    if isinstance(parent, Thing) and parent.noun.word in _CUPBOARDS:
        # "A cabinet holds a plate"
        kinds |= {"in"}
    found = [fact for fact in told if fact[1] is thing and fact[0] in _SUPPORTS]
    if len(found) == 1 and found[0][0] in kinds and found[0][2] is parent:
        return Difference("", ())
    wanted = _difference("lacks", "|".join(sorted(kinds)), thing, parent)
    read = [_difference("", kind, child, other) for kind, child, other in found]
    nouns = tuple(noun for each in (wanted, *read) for noun in each.nouns)
    return Difference(f"{wanted.said}, but{' and'.join(each.said[1:] for each in read)}", nouns)


def _both(kind: str, child: Thing, parent: Thing) -> set[Fact]:
    """A relation, and the same from the other side."""
    if kind == "next_to":
        return {(kind, child, parent), (kind, parent, child)}
    turned = {**_TURNED, **{other: kind for kind, other in _TURNED.items()}}
    return {(kind, child, parent), (turned[kind], parent, child)} if kind in turned else {(kind, child, parent)}


def _allowed(meaning: Meaning) -> set[Fact]:
    """All that follows from what is said."""
    allowed: set[Fact] = set()
    for kinds, child, parent in meaning.facts:
        for kind in kinds:
            if isinstance(parent, Thing):
                allowed |= _both(kind, child, parent)
            else:
                allowed.add((kind, child, parent))
    allowed |= {("on", thing, GROUND) for thing in meaning.things if meaning.support(thing)[1] is GROUND}
    for _, row in meaning.rows:
        for at, first in enumerate(row):
            for second in row[at + 1 :]:
                for kind in ("left_of", "right_of", "next_to", "in_front_of", "behind"):
                    allowed |= _both(kind, first, second)
    for kind, objects, of in meaning.arrangements:
        for thing in objects:
            for landmark in of:
                sides = ("left_of", "right_of", "next_to", "behind", "in_front_of")
                for side in (*sides, "around") if kind == "circle" else sides:
                    allowed |= _both(side, thing, landmark)
        if kind in ("at_ends", "in_corners", "circle"):
            for thing in objects:
                for other in objects - {thing}:
                    for side in ("left_of", "next_to"):
                        allowed |= _both(side, thing, other)
    for side in ("left_of", "in_front_of"):
        grown = True
        while grown:
            chain = {(a, b) for kind, a, b in allowed if kind == side}
            more = {(a, d) for a, b in chain for c, d in chain if b is c and a is not d} - chain
            for first, second in more:
                if isinstance(first, Thing) and isinstance(second, Thing):
                    allowed |= _both(side, first, second)
            grown = bool(more)
    beside = {(a, b) for kind, a, b in allowed if kind in ("left_of", "right_of", "in_front_of", "behind")}
    return allowed | {("next_to", a, b) for a, b in beside}


def _arranged(meaning: Meaning, plan: ScenePlan, pairing: Mapping[str, Thing], told: set[Fact]) -> list[Difference]:
    wrong: list[Difference] = []
    left = [
        (each.kind, tuple(pairing[name] for name in each.objects), frozenset(pairing[name] for name in each.of))
        for each in plan.arrangements
    ]
    for kinds, row in meaning.rows:
        own = next((one for one in left if one[0] in kinds and one[1] in (row, row[::-1])), None)
        if own is None:
            nouns = tuple(dict.fromkeys(thing.noun.word for thing in row))
            wrong.append(
                Difference(f"lacks {'|'.join(sorted(kinds))} of {_listed(row)}", nouns, ("row", "line", "side"))
            )
        else:
            left.remove(own)
    wanted = Counter((kind, thing, of) for kind, objects, of in meaning.arrangements for thing in objects)
    found = Counter((kind, thing, of) for kind, objects, of in left for thing in objects)
    around = {(thing, frozenset((of,))) for kind, thing, of in told if kind == "around"}
    for kind, thing, of in wanted - found:
        if kind != "circle" or (thing, of) not in around:
            difference = f"lacks {thing.label()} {kind} {_listed(of)}"
            wrong.append(Difference(difference, (thing.noun.word,), (kind.split("_")[-1],)))
    far = {(thing, frozenset((of,))) for thing, of in meaning.far}
    for kind, thing, of in found - wanted:
        if kind == "far_from" and (thing, of) in far:
            continue
        if kind != "row" or not _is_shelved(meaning, thing):
            wrong.append(Difference(f"adds {thing.label()} {kind} {_listed(of)}", (thing.noun.word,)))
    return wrong


def _is_shelved(meaning: Meaning, thing: Thing) -> bool:
    """Whether it is a book on a shelf, where books stand in a row on their long edges without anybody saying so."""
    parent = meaning.support(thing)[1]
    return thing.noun.word in ("book", "notebook") and isinstance(parent, Thing) and parent.noun.word == "shelf"


def _task(meaning: Meaning, plan: ScenePlan, pairing: Mapping[str, Thing]) -> list[Difference]:
    if meaning.steps:
        return _steps(meaning, plan, pairing)
    nouns = tuple(dict.fromkeys(thing.noun.word for thing in meaning.of_task))
    if plan.task is None:
        return [Difference("no task", nouns, ("task",))] if meaning.task else []
    kind, names = _about(plan.task.split(":"))
    if not meaning.task:
        return [Difference(f"task {plan.task}", nouns, ("task",))]
    if kind in meaning.task and [pairing.get(name) for name in names] == meaning.of_task:
        return []
    return [Difference(f"task {plan.task} for {meaning.task} {_listed(meaning.of_task)}", nouns, ("task",))]


def _steps(meaning: Meaning, plan: ScenePlan, pairing: Mapping[str, Thing]) -> list[Difference]:
    """How the tasks that a note lists, where a plan has no single one, differ from the steps that are meant."""
    told = next((note.removeprefix(SEVERAL).strip(" .") for note in plan.notes if note.startswith(SEVERAL)), "")
    found = [*map(_about, steps_of(plan.task) if plan.task else [step.split(":") for step in told.split(", ")])]
    right = len(found) == len(meaning.steps) and all(
        kind in kinds and [pairing.get(name) for name in names] == things
        for (kind, names), (kinds, things) in zip(found, meaning.steps, strict=True)
    )
    nouns = tuple(dict.fromkeys(thing.noun.word for _, things in meaning.steps for thing in things))
    return [] if right else [Difference(f"steps {told or plan.task}", nouns, ("task",))]


def _about(step: Sequence[str]) -> tuple[str, list[str]]:
    """The kind of a step, with the side of what is put beside something, and the names of what it is about."""
    kind, *names = step
    return (f"beside:{names[1]}", [names[0], names[2]]) if kind == "beside" else (kind, names)


def _listed(things: Iterable[Thing]) -> str:
    return ", ".join(sorted(thing.label() for thing in things))


def _difference(how: str, kind: str, child: Thing | str, parent: Thing | str) -> Difference:
    labels = [end if isinstance(end, str) else end.label() for end in (child, parent)]
    nouns = tuple(end.noun.word for end in (child, parent) if not isinstance(end, str))
    return Difference(f"{how}: {labels[0]} {kind} {labels[1]}", nouns)
