"""Notes told once: words that another note names already, or that say nothing where they stand, need none of their own.

Only notes on words are touched ("not understood", "not modelled", "not heard"), never one on a thing or on a place.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.words import HOLLOW, NUMBERS, PLACING, SHAPES_OF_STACKS, SILENT
from pat3d.scene.relations import carriers_of
from pat3d.scene.task_spec import named

_ON_WORDS = re.compile(r'not (understood|modelled|heard): "([^"]*)"(?: "([^"]*)")?(?: of "[^"]*"| after "[^"]*")?')
"""A note on words: which, and what they lead to."""
_MISSING = re.compile(r'not (understood|modelled|heard|in the scene): |"[^"]*" of "[^"]*" is left out|.*is made as')
_UNDONE = "no task does"
_QUOTED = re.compile(r'"([^"]*)"')
_WORD = re.compile(r"[^\W_]+(?:['-][^\W_]+)*")
_TURNING = frozenset({"rotate", "turn", "spin", "tilt", "twist", "face", "swivel"})
_SIZES = {"biggest": ("big", "large"), "largest": ("large", "big"), "smallest": ("small",), "widest": ("wide",)}
_PARTICLES = frozenset({"on", "off", "in", "out", "up"})


def told_once(it: Compared, notes: Sequence[str]) -> tuple[str, ...]:
    """`notes` without those that repeat another, or name what says nothing."""
    kept = [note for note in notes if not (_idle(it, note) or _true(it, note))]
    for note in list(kept):
        if _repeats(it, note, [other for other in kept if other != note]):
            kept.remove(note)
    return tuple(_joined(it.plan.prompt, kept))


def _idle(it: Compared, note: str) -> bool:
    """Whether `note` names a word that says nothing where it stands, or that the plan has."""
    found = re.fullmatch(r'not understood: "([^"]*)"(?: "([^"]*)")?', note)
    if found is None:
        return False
    said, words = found[1].lower().split(), it.said.words
    if found[2] is not None:
        if said == ["to"] and found[2] in ("top", "the top"):
            return _stands_so(it, "bottom to top")
        return said == ["with"] and _carried_before(it, found[2].lower())
    if set(said) & SHAPES_OF_STACKS and len(said) == 2 and (said[0] in NUMBERS or said[0].isdecimal()):
        # "one tower", of which the plan has one.
        return _towers(it) == [NUMBERS[said[0]] if said[0] in NUMBERS else int(said[0])]
    if " ".join(said) in ("the bottom", "the top", "bottom to top", "bottom", "top"):
        return _stands_so(it, " ".join(said))
    at = words.index(said[0]) if len(said) == 1 and words.count(said[0]) == 1 else -1
    ends = [n for n, word in enumerate(words) if said == [word] and _dangles(words, n)]
    if len(said) == 1 and said[0] in _PARTICLES and len(ends) == 1 and ("turn" in words or "switch" in words):
        return True
    if len(said) == 1 and said[0] == "on" and ends and any(words[n - 2] in ("its", "their", "a") for n in ends):
        # "with its lid on", "has a hat on"
        return True
    if at <= 0:
        return False
    before, after = words[at - 1], words[at + 1] if at + 1 < len(words) else "."
    return {
        "which": before in PLACING or words[at + 1 : at + 3] == ["has", "no"],
        "that": (before in PLACING and after in ("is", "are")) or words[at + 1 : at + 3] == ["has", "no"],
        "all": before in ("them", "they", "these"),
        "many": before == "as" and after == "as" and words[at + 2 : at + 3] != ["the"],
        "each": _towers(it) and words[at - 2] in NUMBERS and _heights(it) == {NUMBERS[words[at - 2]]},
        "flat": before in ("lies", "lie", "lying", "laid"),
        "towards": words[at - 1] in ("go", "move", "walk", "drive"),
        "everything": after in ("in", "into", "on", "onto") and ":" in words[at:],
    }.get(said[0], False) is True


def _carried_before(it: Compared, phrase: str) -> bool:
    """Whether something named before "with `phrase`" carries it: "two tables with a lamp on one of them"."""
    words = phrase.split()
    at = next((n for n in range(len(it.said.words)) if it.said.words[n : n + len(words)] == words), 0)
    before = {obj.name for mention in it.said.mentions if mention.end <= at for obj in it.of(mention)}
    own = [obj.name for obj in it.plan.objects if obj.phrase.lower() == phrase]
    return bool(own) and all(rel.parent in before for name in own for rel in [it.support(name)] if rel) and all(
        it.support(name) is not None for name in own
    )  # fmt: skip


def _stands_so(it: Compared, said: str) -> bool:
    """Whether the stack of the plan has at `said` what is named before it, or the order in which it is told of."""
    words = it.said.words
    nouns = {obj.name: obj.noun for obj in it.plan.objects}
    below = {rel.parent for rel in it.plan.relations if rel.supports}
    chains = [[*it.above(name)[::-1], name] for name in nouns if name not in below]
    stacks = [chain for chain in chains if len(chain) > 1 and len({nouns[name] for name in chain}) == 1]
    if len(stacks) != 1 or it.undone:
        return False
    objects = {obj.name: obj for obj in it.plan.objects}
    if said == "bottom to top":
        places = [next((words.index(c) for c in objects[name].colours if c in words), -1) for name in stacks[0]]
        return -1 not in places and places == sorted(places)
    side = said.removeprefix("the ")
    for at in (at for at, word in enumerate(words) if word == side and words[at - 2 : at] == ["at", "the"]):
        told = {word for word in words[max(at - 4, 0) : at - 2] if word != "one"}
        end = objects[stacks[0][0 if side == "bottom" else -1]]
        sizes = {each for word in told for each in _SIZES.get(word, ())}
        if not (told | sizes) & {*end.colours, *end.adjectives, *end.name.split()}:
            return False
    return side in words


def _true(it: Compared, note: str) -> bool:
    """Whether what `note` names is so in the plan, or is of a deed that another note names."""
    if found := re.fullmatch(r'not modelled: "empty" of "([^"]*)"', note):
        own = [obj for obj in it.plan.objects if obj.phrase.lower() == found[1].lower()]
        carrying = {rel.parent for rel in it.plan.relations if rel.supports}
        free = [obj.name not in carrying and obj.noun.split()[-1] in HOLLOW for obj in own]
        return any(free) if len(own) > 1 else all(free) and bool(own)
    if found := re.fullmatch(r'"([^"]*)" of "([^"]*)" is left out: it is no rigid body.', note):
        own = [obj for obj in it.plan.objects if obj.phrase.lower() == found[2].lower()]
        # A wine bottle has its wine; a wine glass is empty.
        return bool(own) and all(found[1] in obj.noun.split() and "glass" not in obj.noun for obj in own)
    if found := re.fullmatch(r'"([^"]*)" is left out: distances between objects are not planned.', note):
        return found[1].endswith(("degrees", "\u00b0")) and found[1].lower() in it.undone
    if found := re.fullmatch(r'"([^"]*)" \((left|right|in front|behind)\): there is nothing beside it .*', note):
        return found[1].lower() in it.undone and bool(_TURNING & set(_words(it.undone)))
    return False


def _dangles(words: Sequence[str], at: int) -> bool:
    """Whether the particle at word `at` leads to nothing: "with its lid on and", "turn it on."."""
    after = words[at + 1] if at + 1 < len(words) else "."
    return not after[0].isalnum() or after in ("and", "to", "then", "for") or after in _PARTICLES


def _heights(it: Compared) -> set[int]:
    """How many likes are in each stack."""
    nouns = {obj.name: obj.noun for obj in it.plan.objects}
    below = {name: carriers_of(name, it.plan.relations)[0] for name in nouns}
    upon = {name: low for name, low in below.items() if low in nouns and nouns[low] == nouns[name]}
    return {1 + sum(nouns[low] == nouns[name] for low in it.above(name)) for name in upon if name not in upon.values()}


def _towers(it: Compared) -> list[int]:
    """The number of stacks of likes, of each kind."""
    nouns = {obj.name: obj.noun for obj in it.plan.objects}
    pairs = [(rel.child, rel.parent) for rel in it.plan.relations
             if rel.kind == "on" and nouns.get(rel.parent) == nouns[rel.child]]  # fmt: skip
    lowest = {low for _, low in pairs} - {high for high, _ in pairs}
    kinds = dict.fromkeys(nouns[low] for low in sorted(lowest))
    return [sum(nouns[low] == kind for low in lowest) for kind in kinds]


def _repeats(it: Compared, note: str, others: Sequence[str]) -> bool:
    """Whether what `note` names is within what another note names, and stands once in the prompt."""
    found = _ON_WORDS.fullmatch(note)
    if found is None:
        return False
    said = _words(" ".join(part for part in found.groups()[1:] if part))
    prompt = _words(it.plan.prompt)
    if not said or sum(prompt[n : n + len(said)] == said for n in range(len(prompt))) != 1:
        return False
    empty = set(said) <= SILENT and " of " not in note
    for other in others:
        undone = _UNDONE in other
        plain = empty and (set(said) <= _PARTICLES | {"to", "towards"} or not _of_the_task(it, other))
        if not _MISSING.match(other) or (undone and not plain):
            continue
        whole = _ON_WORDS.fullmatch(other)
        texts = [" ".join(part for part in whole.groups()[1:] if part)] if whole else _QUOTED.findall(other)[:1]
        if any(len(long) > len(said) and _within(said, long) for long in map(_words, texts)):
            return True
    return False


def _of_the_task(it: Compared, note: str) -> bool:
    """Whether `note` is on what the plan's task is made of all the same."""
    names = named(it.plan.task) if it.plan.task is not None else ()
    told = {word.rstrip("s") for name in names for word in re.findall(r"[a-z]+", name)}
    return bool(told & {word.rstrip("s") for word in _words(note)})


def _words(text: str) -> list[str]:
    return _WORD.findall(text.lower())


def _within(part: Sequence[str], whole: Sequence[str]) -> bool:
    return any(whole[n : n + len(part)] == part for n in range(len(whole)))


def _joined(prompt: str, notes: Sequence[str]) -> list[str]:
    """`notes` with those on words that stand side by side in `prompt` as one: "its handle broken off"."""
    spans = [(found.start(), found.end()) for found in _WORD.finditer(prompt)]
    words = _words(prompt)
    found = {note: span for note in notes if (span := _span(note, words)) is not None}
    order = sorted(found, key=lambda note: found[note])
    made = dict(zip(notes, notes, strict=True))
    runs: list[list[str]] = []
    for note in order:
        end = found[runs[-1][-1]][1] if runs else -1
        if end == found[note][0] and not re.search(r"[^\w\s'-]", prompt[spans[end - 1][1] : spans[end][0]]):
            runs[-1].append(note)
        else:
            runs.append([note])
    for run in (run for run in runs if len(run) > 1):
        text = prompt[spans[found[run[0]][0]][0] : spans[found[run[-1]][1] - 1][1]]
        if '"' in text or "\n" in text:
            continue
        kind = "understood" if any("understood" in note for note in run) else "modelled"
        first = min(run, key=list(notes).index)
        for note in run:
            made[note] = ""
        made[first] = f'not {kind}: "{text}"'
    return [note for note in made.values() if note]


def _span(note: str, words: Sequence[str]) -> tuple[int, int] | None:
    """Where the words of a note on words stand, where they stand once."""
    found = _ON_WORDS.fullmatch(note)
    if found is None:
        return None
    said = _words(" ".join(part for part in found.groups()[1:] if part))
    places = [n for n in range(len(words)) if said and words[n : n + len(said)] == said]
    return (places[0], places[0] + len(said)) if len(places) == 1 else None
