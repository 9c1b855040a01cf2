"""How well the offline planner reads text that nobody wrote for it, judged against labels made by hand.

    python benchmarks/language.py corpus.tsv [--part PART] [--show]
    python benchmarks/language.py            the sentences of language_fresh.tsv, labelled before the planner saw them

The corpus is a table (text, kind, source, ...) that is not part of the repository; language_labels.tsv holds, by line
and hash of the text, what a person reads: "objects; relations !task ~refuse". Objects are "2 red cup|mug" ("n" for any
number above one, "*fruit" for anything of a kind, "?table" for what may be there or not); relations are "cup on table",
"~" before one that a note may stand in for. A refusal is just where the label says so, or names what the catalogue
lacks. A difference is silent unless a note of the plan names what differs.
"""

from __future__ import annotations

import argparse
import hashlib
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from pat3d.assets.catalogue import lookup
from pat3d.assets.colours import find_colour
from pat3d.errors import PromptError
from pat3d.plan.doors import DOORS, HINGED
from pat3d.plan.drawers import CABINETS, DRAWER, DRAWER_CABINET
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.grammar.words.lexicon import GENERICS, HOUSES
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.plan.scene_plan import PlannedObject, ScenePlan
from pat3d.scene.task_spec import steps_of

LABELS = Path(__file__).with_name("language_labels.tsv")
FRESH = Path(__file__).with_name("language_fresh.tsv")
VERDICTS = ("right", "right with notes", "silently wrong", "refused justly", "refused although expected")
_KINDS = {
    "on", "in", "on|in", "in|on", "hangs_from", "left_of", "right_of", "in_front_of", "behind", "next_to", "around",
    "under", "between", "far_from", "above",
}  # fmt: skip
_NOUNS = Nouns(lookup)
_ALSO_MADE = (("bowl", "fruit bowl"), ("box", "storage box"), ("drawer", "open drawer"),
              *((noun, DRAWER_CABINET) for noun in CABINETS), *HOUSES.items(), *HINGED.items())  # fmt: skip
"""What else a thing may be made as that is labelled so."""


@dataclass(kw_only=True)
class Wanted:
    """One noun phrase of a label."""

    nouns: frozenset[str]
    """Catalogue nouns; empty where the catalogue has none of them."""
    words: str
    count: int | None
    """None for any number above one."""
    colours: frozenset[str]
    optional: bool
    found: list[str] = field(default_factory=list)


@dataclass(frozen=True, kw_only=True)
class Told:
    """One relation of a label."""

    child: Wanted
    kinds: frozenset[str]
    parent: Wanted
    count: int | None
    notable: bool
    said: str


@dataclass(frozen=True, kw_only=True)
class Label:
    """What a person reads in one line."""

    objects: tuple[Wanted, ...]
    relations: tuple[Told, ...]
    task: str | None
    may_refuse: bool


def read_label(text: str) -> Label:
    """The label written as `text`."""
    may_refuse = "~refuse" in text
    body, _, task = text.replace("~refuse", "").strip().partition("!")
    phrases, *relations = (part.strip() for part in body.split(";"))
    objects = tuple(_wanted(phrase.strip()) for phrase in phrases.split(",") if phrase.strip())
    told = tuple(_told(relation, objects) for relation in relations if relation)
    return Label(objects=objects, relations=told, task=task.strip() or None, may_refuse=may_refuse)


def _wanted(phrase: str) -> Wanted:
    optional = phrase.startswith("?")
    first, *rest = phrase.lstrip("?").split()
    count: int | None = 1
    if first == "n" or first.isdecimal():
        count = None if first == "n" else int(first)
        words = rest
    else:
        words = [first, *rest]
    names = " ".join(words).split("|")
    colours: set[str] = set()
    nouns: set[str] = set()
    for name in names:
        parts = name.split()
        while (
            len(parts) > 1
            and not _NOUNS.match(parts)
            and (find_colour(parts[0]) or parts[0] in ("small", "large", "big"))
        ):
            if colour := find_colour(parts.pop(0)):
                colours.add(colour)
        said = " ".join(parts)
        if said.startswith("*"):
            kind = said[1:]
            nouns |= {found for each in GENERICS.get(kind, ()) if (found := _NOUNS.resolve(each))}
        elif match := _NOUNS.match(said.split()):
            nouns.add(match.noun)
    made = {wide for narrow, wide in _ALSO_MADE if narrow in nouns}
    nouns |= made - {DRAWER_CABINET} if DRAWER in nouns else made
    return Wanted(
        nouns=frozenset(nouns), words=" ".join(words), count=count, colours=frozenset(colours), optional=optional
    )


def _told(text: str, objects: Sequence[Wanted]) -> Told:
    notable = text.startswith(("~", "?"))
    words = text.lstrip("~?").split()
    count = int(words.pop(0)) if words[0].isdecimal() else None
    at = next(index for index, word in enumerate(words) if word in _KINDS)
    child, parent = (_named(" ".join(part), objects) for part in (words[:at], words[at + 1 :]))
    return Told(
        child=child, kinds=frozenset(words[at].split("|")), parent=parent, count=count, notable=notable, said=text
    )


def _named(name: str, objects: Sequence[Wanted]) -> Wanted:
    for each in objects:
        options = each.words.split("|")
        if any(option == name or option.endswith(name) for option in options):
            return each
    raise ValueError(f"{name!r} is none of {[each.words for each in objects]}")


def judge(label: Label, plan: ScenePlan) -> tuple[str, list[str]]:
    """The verdict on `plan`, and what differs."""
    told = [note for note in plan.notes if "no task does that" not in note and "several tasks" not in note]
    notes = " ".join((*told, *plan.set_aside)).lower()
    wrong: list[str] = []
    owner: dict[str, Wanted] = {}
    left = list(plan.objects)
    for want in sorted(label.objects, key=lambda each: (-len(each.colours), each.optional)):
        own = [obj for obj in left if obj.noun in want.nouns and want.colours <= set(_colours(obj))]
        own = own[: want.count] if want.count is not None else own
        for obj in own:
            left.remove(obj)
            owner[obj.name] = want
            want.found.append(obj.name)
        short = not own if want.count is None else len(own) < want.count
        if short and not want.optional:
            wrong.append(f"lacks {want.words}")
    # What a drawer is in, and a door, is made though it is not named, and told.
    wrong += [f"adds {obj.name}" for obj in left if obj.noun != DRAWER_CABINET and obj.noun not in DOORS]
    pairs: Counter[tuple[int, str, int]] = Counter()
    for rel in plan.relations:
        if rel.child in owner and rel.parent in owner:
            pairs[id(owner[rel.child]), rel.kind, id(owner[rel.parent])] += 1
    for arrangement in plan.arrangements:
        for child in arrangement.objects:
            for parent in arrangement.of:
                if child in owner and parent in owner:
                    pairs[id(owner[child]), arrangement.kind, id(owner[parent])] += 1
    allowed: set[tuple[int, str, int]] = set()
    for told in label.relations:
        keys = [(id(told.child), kind, id(told.parent)) for kind in told.kinds]
        keys += [(id(told.parent), kind, id(told.child)) for kind in told.kinds & {"next_to"}]
        allowed |= set(keys)
        needed = told.count if told.count is not None else 1 if told.kinds & {"next_to"} else len(told.child.found)
        if sum(pairs[key] for key in keys) < needed and not told.said.startswith("?"):
            wrong.append(f"lacks: {told.said}")
    optional = {id(want) for want in label.objects if want.optional}
    for child, kind, parent in pairs:
        supports = kind in ("on", "in", "hangs_from")
        if supports and (child, kind, parent) not in allowed and parent not in optional:
            names = {id(want): want.words for want in label.objects}
            wrong.append(f"adds: {names[child]} {kind} {names[parent]}")
    if label.task is not None:
        wrong += _task(label.task, plan)
    silent = [each for each in wrong if not _noted(each, notes)]
    if silent:
        return "silently wrong", wrong
    return ("right with notes" if wrong or plan.notes else "right"), wrong


def _task(task: str, plan: ScenePlan) -> list[str]:
    kinds, _, names = task.partition(" ")
    if kinds == "none":
        return [f"task {plan.task}"] if plan.task else []
    if plan.task is None:
        reasons = ("not modelled", "no more is made of it", "several tasks", "read as the scene to make")
        return [] if any(reason in note for note in plan.notes for reason in reasons) else ["no task"]
    nouns = {obj.name: obj.noun for obj in plan.objects}
    wanted = [_wanted(name.strip()) for name in names.split(",")]

    def fits(kind: str, *said: str) -> bool:
        if kind == "beside":
            said, kind = (said[0], said[2]), said[1]
        same = kind in kinds.split("|") and len(said) == len(wanted)
        return same and all(nouns[name] in want.nouns for name, want in zip(said, wanted, strict=True))

    return [] if any(fits(*step) for step in steps_of(plan.task)) else [f"task {plan.task}"]


def _noted(difference: str, notes: str) -> bool:
    """Whether a note speaks of what differs: it names a noun or the relation word."""
    kind, _, rest = difference.partition(" ")
    words = [word.strip("*~?|:") for word in rest.replace("|", " ").split()]
    words = [word for word in words if len(word) > 2 and word not in _KINDS and not word.isdecimal()]
    return kind in ("lacks", "lacks:", "adds", "adds:") and any(word.rstrip("s") in notes for word in words)


def _colours(obj: PlannedObject) -> tuple[str, ...]:
    return tuple(filter(None, map(find_colour, obj.colours)))


Row = tuple[int, str, tuple[str, ...], str]
"""Line, sentence, what it is counted under, label."""


def _labelled(corpus: Path, part: str) -> Iterator[Row]:
    """The labelled lines of `corpus`."""
    lines = corpus.read_text().split("\n")
    for row in LABELS.read_text().splitlines()[1:]:
        number, digest, own, text = row.split("\t")
        said, kind, source = lines[int(number) - 1].split("\t")[:3]
        if hashlib.sha256(said.encode()).hexdigest()[:10] != digest:
            raise SystemExit(f"line {number} is not the line that was labelled.")
        if part in (own, "all"):
            yield int(number), said, (source.split("/")[1].split(":")[0], f"all {kind}s"), text


def fresh() -> Iterator[Row]:
    """The sentences of FRESH."""
    for number, row in enumerate(FRESH.read_text().splitlines()[1:], start=2):
        name, said, text = row.split("\t")
        yield number, said, (name,), text


def main() -> None:
    """Print the verdicts per source and over all."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("corpus", type=Path, nargs="?")
    arguments.add_argument("--part", choices=("dev", "held", "eighth", "ninth", "all"), default="all")
    arguments.add_argument("--show", action="store_true", help="every line that is not right, with what differs")
    options = arguments.parse_args()
    rows = fresh() if options.corpus is None else _labelled(options.corpus, options.part)
    planner = GrammarPlanner()
    table: dict[str, Counter[str]] = defaultdict(Counter)
    for number, said, sources, text in rows:
        label = read_label(text)
        unmakeable = [want.words for want in label.objects if not want.nouns and not want.optional]
        detail: object
        try:
            plan = planner.plan(said)
        except PromptError as error:
            just = label.may_refuse or bool(unmakeable)
            verdict, detail = ("refused justly" if just else "refused although expected"), error
        else:
            verdict, detail = judge(label, plan)
        for name in (*sources, "all"):
            table[name][verdict] += 1
        if options.show and verdict not in ("right", "refused justly"):
            print(f"{number} {verdict}: {said}\n    label: {text}\n    {detail}")
            if not isinstance(detail, PromptError):
                print(f"    {[obj.name for obj in plan.objects]} {[str(rel) for rel in plan.relations]} {plan.task}")
                print(f"    {plan.notes}")
    print(f"{'':34}" + "".join(f"{verdict:>27}" for verdict in VERDICTS))
    for name in sorted(table, key=lambda each: (each.startswith("all"), each)):
        print(f"{name:34}" + "".join(f"{table[name][verdict]:>27}" for verdict in VERDICTS))


if __name__ == "__main__":
    main()
