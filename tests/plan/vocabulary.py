"""A small fixed vocabulary, so that the planner's tests do not depend on what the catalogue makes; steps of a task."""

from __future__ import annotations

import difflib
from dataclasses import dataclass

from pat3d.plan.grammar.meaning.tasks import SEVERAL
from pat3d.plan.scene_plan import ScenePlan
from pat3d.scene.task_spec import chain_of, steps_of

NOUNS: dict[str, tuple[str, ...]] = {
    "bed": (), "bedside table": ("nightstand",), "lamp": ("table lamp",), "bookshelf": ("bookcase",), "dog": ("puppy",),
    "sofa": ("couch",), "coffee table": (), "sculpture": ("art piece", "statue"), "rug": ("carpet",), "plant": (),
    "potted plant": ("houseplant",), "book": ("hardcover book", "spell book"), "rabbit": ("bunny", "hare"),
    "pancake": (), "wizard": (), "desk": ("writing desk",), "crystal ball": (), "bird": ("blue jay",), "basket": (),
    "macaron": (), "table": ("dining table",), "vase": (), "bouquet": ("bouquet of flowers", "flowers"), "plate": (),
    "cake": ("slice of cake",), "apple": (), "orange": (), "banana": (), "lemon": (), "pear": (), "cup": (),
    "mug": ("coffee mug",), "bowl": (), "toothbrush": (), "toothpaste": ("toothpaste tube",), "razor": (),
    "soap dish": (), "soap": ("bar of soap",), "radio": (), "cow figurine": (), "pencil": (), "pen": (),
    "teddy bear": (), "elephant": (), "giraffe": (), "pillow": ("throw pillow",), "floor cushion": (), "cushion": (),
    "inflatable pool": ("pool", "paddling pool"), "ball": ("plastic ball",), "toy sailboat": ("sailboat",),
    "rubber duck": (), "turtle": (), "starfish": (), "fire extinguisher": (), "shelf": ("shelving unit", "shelves"),
    "cap": ("baseball cap",), "hat": (), "cardboard sheet": (), "cart": ("wheeled cart", "trolley"),
    "block": ("building block",), "plush dog": ("toy dog",), "pen holder": (), "ruler": (), "scissors": (),
    "chair": (), "side table": (), "swing": (), "tree": (), "box": ("cardboard box",), "spoon": (), "fork": (),
    "knife": (), "bottle": (), "candle": (), "tray": (), "glass": ("drinking glass",), "towel": (), "bench": (),
    "octagon puzzle": (), "jar": (), "cookie": (), "teapot": (), "stool": (), "watermelon": (), "egg": (), "pot": (),
    "cutting board": (), "bread": ("loaf of bread",), "carrot": (), "tomato": (), "glasses": (), "crate": (),
    "fruit bowl": (), "napkin": (), "peach": (),
}  # fmt: skip
IRREGULAR = {"knives": "knife", "bookshelves": "bookshelf", "boxes": "box"}


@dataclass(frozen=True, kw_only=True)
class Word:
    noun: str
    plurals: tuple[str, ...] = ()


class Table:
    """find, names and nearest over NOUNS, as the catalogue's registry offers them."""

    def __init__(self) -> None:
        plurals: dict[str, tuple[str, ...]] = {}
        for plural, single in IRREGULAR.items():
            plurals[single] = (*plurals.get(single, ()), plural)
        self._names: dict[str, Word] = {}
        for noun, synonyms in NOUNS.items():
            word = Word(noun=noun, plurals=plurals.get(noun, ()))
            for name in (noun, *synonyms, *word.plurals):
                self._names[name] = word

    def find(self, name: str, /) -> Word | None:
        return self._names.get(name)

    def names(self) -> tuple[str, ...]:
        return tuple(sorted(self._names))

    def nearest(self, name: str, count: int = 3) -> tuple[str, ...]:
        return tuple(difflib.get_close_matches(name, self.names(), n=count, cutoff=0.5))


def steps(plan: ScenePlan) -> list[str]:
    """The steps of the task of `plan`, or those of which a note says that they are more than a chain holds."""
    told = [note.removeprefix(SEVERAL).strip(" .") for note in plan.notes if note.startswith(SEVERAL)]
    if plan.task is None:
        return told[0].split(", ") if told else []
    # What is a task is not told as more than one.
    assert not told
    return [":".join(step) for step in steps_of(plan.task)]


def chain(*made: str) -> str:
    """The task that is the steps `made`, one after the other."""
    task = chain_of(made)
    assert task is not None
    return task


def told(plan: ScenePlan) -> tuple[str, str, str | None, list[str]]:
    """The objects, the relations with what is arranged but in rows, the task, or several, and the notes."""
    arranged = [
        f"{', '.join(one.objects)} {one.kind} {', '.join(one.of)}"
        for one in plan.arrangements
        if one.arranged and one.kind != "row"
    ]
    notes = [note for note in plan.notes if not note.startswith("worded like nothing") and " assumed." not in note]
    task = ", ".join(steps(plan)) or None
    objects = ", ".join(obj.name for obj in plan.objects)
    notes = [note for note in notes if not note.startswith(SEVERAL)]
    return objects, ", ".join([*map(str, plan.relations), *arranged]), task, notes
