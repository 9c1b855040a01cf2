"""Which objects of a scene words mean: by name, by place ("the bottom book"), or by relation ("the mug on the books").

Relations are read by the planner, so that what makes a scene also tells its objects apart.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from pat3d.errors import EditError, PromptError
from pat3d.layout.predicates import relation_holds
from pat3d.plan.english import plural
from pat3d.plan.scene_plan import Planner, ScenePlan
from pat3d.scene.model import GROUND, Relation, Scene, SceneObject
from pat3d.scene.relations import carriers_of

MAX_WORDS = 1_000
"""Characters that name an object at most."""

_ARTICLES = frozenset({"the", "a", "an", "its", "this", "that", "these", "those", "my", "of", "some"})
_EVERY = frozenset({"all", "both", "every", "each"})
_ORDINALS = {
    word: at
    for at, words in enumerate(
        ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth")
    )
    for word in (words,)
} | {f"{at + 1}{end}": at for at in range(20) for end in ("st", "nd", "rd", "th")}  # fmt: skip

Key = Callable[[SceneObject], float]


def _height(obj: SceneObject) -> float:
    return float(obj.pose.apply(obj.asset.bounds.mean(axis=0)[None])[0, 2])


def _across(axis: int) -> Key:
    return lambda obj: float(obj.pose.apply(obj.asset.bounds.mean(axis=0)[None])[0, axis])


_BY_SIZE: Key = lambda obj: float(obj.asset.size.prod())  # noqa: E731

PLACES: dict[str, tuple[Key, bool]] = {
    **dict.fromkeys(("bottom", "lowest", "bottommost", "lowermost"), (_height, False)),
    **dict.fromkeys(("top", "highest", "topmost", "uppermost"), (_height, True)),
    **dict.fromkeys(("left", "leftmost"), (_across(0), False)),
    **dict.fromkeys(("right", "rightmost"), (_across(0), True)),
    **dict.fromkeys(("front", "nearest", "closest", "frontmost"), (_across(1), False)),
    **dict.fromkeys(("back", "rear", "farthest", "furthest", "hindmost"), (_across(1), True)),
    **dict.fromkeys(("smallest",), (_BY_SIZE, False)),
    **dict.fromkeys(("largest", "biggest"), (_BY_SIZE, True)),
    **dict.fromkeys(("lightest",), (lambda obj: obj.asset.mass_properties.mass, False)),
    **dict.fromkeys(("heaviest",), (lambda obj: obj.asset.mass_properties.mass, True)),
}
"""By what a word orders objects, and whether the largest is meant. The viewer stands at -y."""


def chosen(scene: Scene, words: str, planner: Planner, *, several: bool = False) -> tuple[str, ...]:
    """Names of the objects of `scene` that `words` mean.

    Args:
        scene: whose objects are named.
        words: a name; a noun phrase, in the plural or with "all" for several; with a place or a relation to another.
        planner: reads relations.
        several: whether more than one may be meant.

    Raises:
        EditError: nothing is meant, or one of several is and the words do not tell which.
    """
    found = _meant(scene, words, planner)
    if len(found) > 1 and not several:
        raise EditError(f'"{words}" means {_listed(found)}; say which one. Nothing was written.')
    return found


def _meant(scene: Scene, words: str, planner: Planner) -> tuple[str, ...]:
    text = " ".join(words.split()).strip(" .\"'")
    if not text or len(text) > MAX_WORDS:
        raise EditError(f'"{words[:80]}" names no object. {_there(scene)}')
    names = {obj.name.casefold(): obj.name for obj in scene.objects}
    for said in (text.casefold(), text.casefold().removeprefix("the ")):
        if said in names:
            return (names[said],)
    for read in (_by_place, _by_words):
        found = read(scene, text.casefold(), planner)
        if found:
            return found
    return _by_relation(scene, text, planner)


def _by_place(scene: Scene, text: str, planner: Planner) -> tuple[str, ...]:
    """What "the bottom book", "second book from the left", "the top book of the stack" mean."""
    text = re.sub(r"^the ", "", text)
    counted = re.fullmatch(r"(?P<at>\S+) (?P<what>.+) from the (?P<place>\S+)", text)
    if counted and counted["at"] in _ORDINALS and counted["place"] in PLACES:
        key, largest = PLACES[counted["place"]]
        candidates = _candidates(scene, counted["what"], planner)
        ranked = sorted(candidates, key=key, reverse=largest)
        at = _ORDINALS[counted["at"]]
        if at >= len(ranked):
            raise EditError(f'there are only {len(ranked)} of "{counted["what"]}". {_there(scene)}')
        return (ranked[at].name,)
    first, _, rest = text.partition(" ")
    rest = re.sub(r" (?:of|in) the (?:stack|pile|row|tower)(?: of \w+)?$", "", rest)
    if rest and first in PLACES:
        key, largest = PLACES[first]
        return ((max if largest else min)(_candidates(scene, rest, planner), key=key).name,)
    if rest and first in _ORDINALS:
        candidates = _candidates(scene, rest, planner)
        if _ORDINALS[first] >= len(candidates):
            raise EditError(f'there are only {len(candidates)} of "{rest}". {_there(scene)}')
        return (candidates[_ORDINALS[first]].name,)
    return ()


def _candidates(scene: Scene, text: str, planner: Planner) -> list[SceneObject]:
    """Everything that `text` may mean, whether it is one or several.

    Raises:
        EditError: nothing.
    """
    found = _called(scene, text)
    return found or [scene[name] for name in _by_relation(scene, text, planner, every=True)]


def _by_words(scene: Scene, text: str, planner: Planner) -> tuple[str, ...]:
    words, found = _content(text), _called(scene, text)
    if len(found) > 1 and not _is_plural(text, found):
        exact = [obj for obj in found if _content(_unnumbered(obj.name)) == words]
        found = exact if len(exact) == 1 else found
        if len(found) > 1:
            raise EditError(
                f'"{text}" may be {_listed([obj.name for obj in found])}: say which, as in '
                f'"the left {text.removeprefix("the ")}", or "all". Nothing was written.'
            )
    return tuple(obj.name for obj in found)


def _by_relation(scene: Scene, text: str, planner: Planner, *, every: bool = False) -> tuple[str, ...]:
    """Objects that stand to others as the planner reads it: "the book under the mug"."""
    try:
        plan = planner.plan(text)
    except PromptError as error:
        raise EditError(f'nothing in the scene is called "{text}". {_there(scene)}') from error
    head = plan.objects[0]
    heads = [obj for obj in scene.objects if _is_like(obj, plan, head.name)]
    others = {one.name: one.phrase for one in plan.objects if one.phrase != head.phrase}
    landmarks = {
        name: {obj.name for obj in scene.objects if _is_like(obj, plan, name)} | ({GROUND} if name == GROUND else set())
        for name in others
    }
    held = list(plan.relations)
    for relation in held:
        ends = (relation.child, relation.parent)
        if head.name not in ends:
            continue
        other = ends[1] if ends[0] == head.name else ends[0]
        if other not in landmarks:
            continue
        if not landmarks[other]:
            raise EditError(f'nothing in the scene is "{others[other]}". {_there(scene)}')
        related = [
            obj
            for obj in heads
            if any(_stands(scene, relation, obj.name, mark, other) for mark in landmarks[other] if mark != obj.name)
        ]
        heads = related
    if not heads:
        raise EditError(f'nothing in the scene is "{text}". {_there(scene)}')
    if len(heads) > 1 and not every and not _is_plural(text, heads):
        raise EditError(f'"{text}" may be {_listed([obj.name for obj in heads])}: say which one. Nothing was written.')
    return tuple(obj.name for obj in heads)


def _stands(scene: Scene, relation: Relation, head: str, mark: str, other: str) -> bool:
    """Whether `head` stands to `mark` as `relation` says that they do, `mark` being what `other` is there."""
    child, parent = (head, mark) if relation.parent == other else (mark, head)
    if relation.supports:
        return parent in carriers_of(child, scene.relations)
    assets, poses = ({obj.name: getattr(obj, what) for obj in scene.objects} for what in ("asset", "pose"))
    return relation_holds(Relation(child=child, kind=relation.kind, parent=parent), assets, poses)


def _called(scene: Scene, text: str) -> list[SceneObject]:
    """Objects of which all words are said; those that are what the last word says (a pen holder is no pen), if any."""
    words = _content(text)
    found = [obj for obj in scene.objects if _fits(obj, words)]
    return [obj for obj in found if any(words[-1] in (head, plural(head)) for head in _heads(obj))] or found


def _heads(obj: SceneObject) -> set[str]:
    """What `obj` is in one word each: "holder" for a pen holder."""
    from pat3d.assets import catalogue

    entry = catalogue.find(obj.asset.noun)
    names = (_unnumbered(obj.name), obj.asset.noun, *(entry.synonyms if entry is not None else ()))
    return {name.casefold().split()[-1] for name in names}


def _is_like(obj: SceneObject, plan: ScenePlan, name: str) -> bool:
    """Whether `obj` is what the plan calls `name`: its words, or its noun and colours."""
    planned = next(one for one in plan.objects if one.name == name)
    words = _content(re.split(r"\b(?:on|in|under|next|left|right|behind|above|beside|near)\b", planned.phrase)[0])
    if words and _fits(obj, words):
        return True
    colours = obj.asset.provenance.get("colours", ())
    return obj.asset.noun == planned.noun and all(colour in colours for colour in planned.colours)


def _fits(obj: SceneObject, words: Sequence[str]) -> bool:
    """Whether every one of `words`, as said or in the singular, is said of `obj`."""
    return bool(words) and all(any(word in (own, plural(own)) for own in _words_of(obj)) for word in words)


def _words_of(obj: SceneObject) -> set[str]:
    entry = _entry(obj.asset.noun)
    synonyms = " ".join(entry) if len(obj.asset.noun.split()) < 4 else ""
    return set(_content(f"{_unnumbered(obj.name)} {obj.asset.noun} {obj.phrase} {synonyms}")) | set(
        map(str, obj.asset.provenance.get("colours", ()))
    )


def _entry(noun: str) -> tuple[str, ...]:
    """One-word synonyms of a catalogue noun."""
    from pat3d.assets import catalogue

    found = catalogue.find(noun)
    return () if found is None else tuple(name for name in found.synonyms if " " not in name)


def _content(text: str) -> list[str]:
    """Words of `text` that tell what is meant."""
    words = re.findall(r"[^\W_]+", text.casefold())
    return [word for word in words if word not in _ARTICLES and word not in _EVERY]


def _unnumbered(name: str) -> str:
    return re.sub(r" \d+$", "", name)


def _is_plural(text: str, found: Sequence[SceneObject]) -> bool:
    """Whether `text` means all of `found`."""
    words = set(re.findall(r"[^\W_]+", text.casefold()))
    if words & _EVERY:
        return True
    last = {_unnumbered(obj.name).casefold().split()[-1] for obj in found}
    last |= {obj.asset.noun.split()[-1] for obj in found}
    return any(plural(word) in words for word in last)


def _listed(names: Sequence[str]) -> str:
    return ", ".join(f'"{name}"' for name in names)


def _there(scene: Scene) -> str:
    shown = [obj.name for obj in scene.objects[:40]]
    more = f" and {len(scene.objects) - 40} more" if len(scene.objects) > 40 else ""
    return f"The scene has: {', '.join(shown)}{more}. Nothing was written."
