"""From noun phrases to groups of objects: how many, of what, in which colours."""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from pat3d.assets.colours import COLOURS, find_colour
from pat3d.assets.materials import find_material
from pat3d.errors import PromptError
from pat3d.plan.drawers import DRAWERS, ROW_WORDS
from pat3d.plan.grammar.chunking.failures import UnknownNounError, UnreadError
from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.counting import check_total
from pat3d.plan.grammar.meaning.described import share_colours
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.meaning.world import MAX_OBJECTS, World
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import singulars
from pat3d.plan.grammar.words.modifiers import (
    ONE_OF,
    Modifiers,
    is_colour_word,
    is_modifier,
    is_part_colour,
    looks_like_adjective,
)
from pat3d.plan.grammar.words.senses import TWOFOLD
from pat3d.plan.grammar.words.stand_ins import STAND_IN_SIZES, STAND_INS
from pat3d.plan.grammar.words.unmade import base_verb, is_no_noun, is_quality, makes_nothing
from pat3d.plan.grammar.words.vocabulary import Nouns

if TYPE_CHECKING:
    # Who reads a sentence without a server waits for no numpy.
    from pat3d.assets.generated.orders import Orders

_NO_THINGS = frozenset({"me", "us", "out", "off", "away", "already", "though", "altogether", "high", "else", "nowhere",
    "taken", "fallen", "done"})  # fmt: skip
_SOFT_ALREADY = ("pillow", "cushion", "floor cushion", "blanket", "towel")


class Maker:
    """Makes the groups of one scene."""

    def __init__(self, nouns: Nouns, *, allow_proxies: bool, orders: Orders | None = None) -> None:
        self._nouns = nouns
        self._allow_proxies = allow_proxies
        self._orders = orders

    def make(self, world: World, phrase: Phrase, *, filling: bool = False, kind: Group | None = None) -> Group:
        """A new group for `phrase`, of the generic `kind` where it lists one ("plush toys, including ...").

        Raises:
            PromptError: the noun is unknown and proxies are not allowed, or the count is impossible.
        """
        phrase = _matched(world, phrase)
        phrase, whole = self._ordered(world, phrase), phrase
        ordered = phrase is not whole
        noun, said, proxy = phrase.noun, phrase.said, False
        if phrase.kind == "unknown" and not noun:
            noun, said, proxy = self._proxy(world, phrase)
        count, height = self._count(world, phrase, filling)
        if phrase.cycle:
            # "A banana in front of some fruits": of which the banana is none.
            there = {each.noun for each in world.groups}
            cycle = sorted(phrase.cycle, key=lambda name: (self._nouns.resolve(name) or name) in there)
            phrase = replace(phrase, cycle=tuple(cycle))
        group = Group(
            phrase=phrase, noun=noun, said=said, modifiers=phrase.modifiers, counted=phrase.count is not None,
            exact=phrase.count is not None and not phrase.vague, height=height, rows=phrase.rows, heap=phrase.heap,
            pyramid=phrase.pyramid, proxy=proxy,
        )  # fmt: skip
        group.items = [Item(group=group) for _ in range(count)]
        if count > 1 and phrase.said in ("grape", "grapes"):
            world.note(f'"{phrase.words}": every one of the {count} is made as a bunch.')
        if {phrase.head, said} & (TWOFOLD - {noun}) or (said in STAND_INS and not ordered):
            size, scale = STAND_IN_SIZES.get(said), phrase.modifiers.scale
            measured = f" of {size * scale:.2g} m" if size and not phrase.modifiers.measures else ""
            world.note(f'"{phrase.words}" is made as {"an" if noun[0] in "aeiou" else "a"} "{noun}"{measured}.')
        if phrase.left_out:
            world.note(f'"of {phrase.left_out}" is left out of "{phrase.words}".')
        if phrase.substance:
            world.note(f'"{phrase.substance}" of "{phrase.words}" is left out: it is no rigid body.')
        if not ordered:
            # The prompt of a mesh server has the adjectives too.
            self.note_adjectives(world, phrase)
        if phrase.cycle:
            stand_in = dict.fromkeys(phrase.cycle[at % len(phrase.cycle)] for at in range(count))
            assumed = f"{count} assumed: " if phrase.count is None or phrase.vague else ""
            world.note(f'"{phrase.words}": {assumed}{", ".join(stand_in)}; which is not said.')
        if kind is not None:
            self._take_after(world, group, kind)
        if count == 1 and phrase.modifiers.palette_word in ONE_OF and not phrase.modifiers.colours:
            world.note(f'not modelled: of what colour "{phrase.words}" is')
        share_colours(group)
        world.groups.append(group)
        check_total(world)
        return group

    def note_adjectives(self, world: World, phrase: Phrase, told: Modifiers | None = None) -> None:
        """Say which words (those of `told`, if given) describe what `phrase` names and make no difference to it."""
        said = f'"{phrase.words}"'
        idle: list[str] = []
        for word in (told or phrase.modifiers).adjectives:
            shaded = word not in ("light", "pale") or phrase.modifiers.colours or phrase.modifiers.material
            if word in lexicon.SAID_OTHERWISE or (word in lexicon.SHADE_WORDS and shaded):
                continue
            row = phrase.noun in DRAWERS and word in ROW_WORDS
            if row or (word in lexicon.HONOURED and self._nouns.takes(phrase.noun, word)):
                continue
            full = self._nouns.match([word, *phrase.said.split()]) if word in lexicon.SUBSTANCES else None
            if word in (phrase.said or phrase.noun).split() or (full and full.noun == phrase.noun):
                continue  # "A paper shredder" has no other name.
            kind = self._nouns.match([word]) is not None or word in lexicon.SUBSTANCES
            whole = [
                colour
                for part in word.split("-")
                if (colour := find_colour(part)) in (told or phrase.modifiers).colours
            ]
            if is_part_colour(word) and whole:
                world.note(f'"{word}" of {said}: it is made {" and ".join(map(str, whole))} all over.')
            elif kind and not is_modifier(word):
                world.note(f'"{word}" of {said} is left out: it is made as a "{phrase.said or phrase.head}".')
            elif (colour := nearest_colour(word)) and not is_modifier(word):
                world.note(f'"{word}" of {said} is no colour known here; did you mean "{colour}"?')
            else:
                idle.append(f'"{word}"')
        if idle:
            world.note(f"not modelled: {', '.join(idle)} of {said}")

    def _ordered(self, world: World, phrase: Phrase) -> Phrase:
        """`phrase` with the noun of an order where a server is to make what no source has, or has without a part of it.

        "A teapot dinosaur" is no dinosaur, and no source has the whole.
        """
        if self._orders is None or phrase.kind not in ("object", "unknown") or phrase.cycle:
            return phrase
        words = phrase.modifiers.adjectives
        if phrase.kind == "unknown":
            if self.no_thing(phrase.head):
                return phrase
            named = tuple(word for word in words if not is_modifier(word))
            several = phrase.several or not phrase.determined
            head = (singulars(phrase.head) or (phrase.head,))[0] if several else phrase.head
        else:
            named, head = tuple(word for word in words if self.is_thing(word)), phrase.said
            if not named:
                return phrase
        order = self._orders.order(" ".join((*named, head)))
        self._nouns.learn(order.noun, order.like)
        world.note(self._orders.told(order))
        left = tuple(word for word in words if word not in named)
        modifiers = replace(phrase.modifiers, adjectives=left)
        return replace(phrase, noun=order.noun, said=order.words, modifiers=modifiers)

    def is_thing(self, word: str) -> bool:
        """Whether `word`, before another noun, names a thing of its own."""
        return self._nouns.match([word]) is not None and not is_modifier(word) and word not in lexicon.SUBSTANCES

    def _proxy(self, world: World, phrase: Phrase) -> tuple[str, str, bool]:
        if self._allow_proxies and not self.no_thing(phrase.head):
            world.note(f'"{phrase.head}" (word {phrase.number}) is not in the catalogue: a plain box stands in.')
            return "box", phrase.head[:40], True
        raise self.unknown(phrase)

    def unknown(self, phrase: Phrase) -> PromptError:
        """The error for a noun that the catalogue lacks."""
        word, number = phrase.head, phrase.number
        if word in lexicon.MEALS:
            return UnreadError(
                f'"{word}" (word {number}) names no single thing. Say what is there: "a plate with two eggs and '
                'a cup".',
                number,
            )
        if is_quality(word) and is_no_noun(word):
            return UnreadError(
                f'"{word}" (word {number}) names nothing that can be placed. Leave it out, or name the thing that is '
                "meant.",
                number,
            )
        before = phrase.words.lower().split()[: -len(word.split())][-1:]
        if is_colour_word(word) and before not in (["a"], ["an"]) and find_material(word) is None:
            return UnreadError(
                f'"{word}" (word {number}) is a colour, and of what is not said where it stands. Say "a {word} cup" or '
                f'"the cup is {word}".',
                number,
            )
        counted = lexicon.DETERMINERS | lexicon.NUMBERS.keys()
        named = bool(before) and (before[0] in counted or is_modifier(before[0]))
        one = phrase.words.lower().split()[:1] in (["a"], ["an"], ["one"]) and not word.endswith("s")
        compound = one and self._names(before) and word not in lexicon.VERBS | {"hang"}
        stands = phrase.determined and bool({word, *singulars(word)} & lexicon.NOUNS_LIKE_VERBS)
        doing = base_verb(word) is not None and not (named or compound or stands)
        if (self.no_thing(word) and not stands) or (doing and not self._nouns.respelled(word)):
            return UnreadError(
                f'"{word}" (word {number}) is not understood where it stands. Say one thing a sentence: "A mug is on '
                'the table. A spoon is to the left of the mug."',
                number,
            )
        near = ", ".join(map(_quoted, self._nouns.nearest(word)))
        hint = f"Nearest: {near}." if near else "`pat3d catalogue` lists what can be made."
        whole = phrase.words.lower().endswith(word) and (compound or stands or base_verb(word) is None)
        said = f"{before[0]} {word}" if whole and self._names(before) else word
        kinds = self._nouns.kinds((singulars(word) or (word,))[0])
        if said == word and len(kinds) > 1:
            hint = f"Say which kind: {', '.join(map(_quoted, kinds))}."
        return UnknownNounError(
            f'"{said}" is not in the catalogue (word {number}). {hint} Bring a mesh of '
            "your own with pat3d build, or accept a plain box with --allow-proxies.",
            phrase,
        )

    @staticmethod
    def _names(before: Sequence[str]) -> bool:
        """Whether the word before the head belongs to its name: the "sewing" of a sewing machine."""
        plain = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys() | lexicon.VAGUE.keys() | _NO_THINGS
        if (
            not before
            or not before[0].isalpha()
            or singulars(before[0])
            or before[0] in plain
            or is_modifier(before[0])
        ):
            return False
        # "A sewing machine", but not "a delicate machine".
        return before[0].endswith("ing") or not (looks_like_adjective(before[0]) or makes_nothing(before[0]))

    @staticmethod
    def no_thing(word: str) -> bool:
        """Whether `word` is none that names things, so that the sentence was not understood."""
        tables = (lexicon.VERBS, lexicon.PARTICIPLES, lexicon.ADVERBS, lexicon.DIRECTIONS, lexicon.POSITIONS,
                  lexicon.COPULAS, lexicon.MEALS, lexicon.STATES, lexicon.SAID_OTHERWISE, lexicon.LEVELS,
                  lexicon.MODALS, _NO_THINGS)  # fmt: skip
        participle = word.endswith(("ed", "ing")) and len(word) > 5 and word not in lexicon.NOT_VERBS
        return any(word in table for table in tables) or participle or len(word) == 1 or is_no_noun(word)

    def _count(self, world: World, phrase: Phrase, filling: bool) -> tuple[int, int]:
        """Objects, and objects in a stack."""
        modifiers, count, noted = phrase.modifiers, phrase.count, True
        plural = phrase.plural or (phrase.kind == "unknown" and phrase.head.endswith("s") and not phrase.determined)
        if count is None:
            # "Pick up toy animal" is of one, "pick up fruit" of some.
            bare = bool(phrase.cycle) and not phrase.determined
            mass = phrase.said in lexicon.MASS_GENERICS or phrase.said.endswith(("food", "fruit"))
            several = plural or phrase.height is not None or (bare and mass)
            colours = len(modifiers.colours)
            if not several:
                count, noted = 1, False
            elif modifiers.palette_word:
                count = lexicon.PALETTE_COUNT.get(modifiers.palette_word, lexicon.COLOURFUL_COUNT)
            elif phrase.height is not None or modifiers.stacked:
                count = lexicon.STACK_HEIGHT
            elif phrase.noun in lexicon.COMES_IN_TWOS:
                count = 2
            else:
                count = max(lexicon.FILLING if filling else lexicon.BARE_PLURAL, colours)
            if several and colours >= 3:
                count = -(-count // colours) * colours
        else:
            noted = phrase.vague
        if not 1 <= count <= MAX_OBJECTS:
            raise PromptError(
                f'"{phrase.words[:60]}" (word {phrase.number}) asks for {count} objects; '
                f"a scene holds 1 to {MAX_OBJECTS}."
            )
        height = 1
        if phrase.height is not None:
            height = phrase.height or count
            count = count if phrase.height else count * phrase.chains
        elif modifiers.stacked and count > 1:
            height = count
        if noted and not phrase.cycle:
            world.note(f'"{phrase.words}": {count} assumed.')
        return count, height

    @staticmethod
    def _take_after(world: World, group: Group, kind: Group) -> None:
        word = kind.said.split()[0] if " " in kind.said else ""
        material = kind.modifiers.material or ("plush" if word in ("plush", "stuffed", "soft") else None)
        if material and not group.modifiers.material and not world.likely.is_a(group.noun, _SOFT_ALREADY):
            group.modifiers = replace(group.modifiers, material=material)


def _matched(world: World, phrase: Phrase) -> Phrase:
    """`phrase` in the colour and of the material of what it matches: "a red sofa and two matching armchairs"."""
    own, there = phrase.modifiers, [group for group in world.groups if not group.replaced]
    if "matching" not in own.adjectives or own.colours or own.palette or own.material or not there:
        return phrase
    # "A white teapot on a bamboo tray, and four matching cups" match the teapot.
    large = (*lexicon.LEVEL, *lexicon.FLOOR)
    alike = [group for group in there
             if world.likely.is_a(group.noun, large) == world.likely.is_a(phrase.noun, large)]  # fmt: skip
    like = (alike or there)[-1].modifiers
    colours = like.colours if len(like.colours) < 2 or len(there[-1].items) == 1 else ()
    if not (colours or like.material) and any(group.modifiers.colours for group in there):
        world.note(f'"matching" of "{phrase.words}": what it matches is not told; it is made as usual.')
    return replace(phrase, modifiers=replace(own, colours=colours, material=like.material,
                                             material_word=like.material_word))  # fmt: skip


def nearest_colour(word: str) -> str | None:
    """The colour of which `word` is probably a misspelling."""
    near = difflib.get_close_matches(word, COLOURS, n=1, cutoff=0.8)
    return near[0] if near else None


def _quoted(name: str) -> str:
    return f'"{name}"'
