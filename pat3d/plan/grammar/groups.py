"""Turns noun phrases into groups of objects, or finds the group that a phrase refers back to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.errors import PromptError
from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.draft import Draft, Group
from pat3d.plan.grammar.lexing import singulars
from pat3d.plan.grammar.members import POSITIONS, Members, position
from pat3d.plan.grammar.modifiers import Modifiers, is_modifier, looks_like_adjective
from pat3d.plan.grammar.phrases import Phrase

MAX_OBJECTS = 60
"""Objects in one scene."""
_SOFT_ALREADY = ("pillow", "cushion", "floor cushion", "blanket", "towel")


class GroupMaker:
    """Makes the groups of one draft."""

    def __init__(self, draft: Draft, *, allow_proxies: bool) -> None:
        self._draft = draft
        self._allow_proxies = allow_proxies
        self._inherited: Group | None = None
        self.members = Members(draft)
        self._stated = 0
        """Groups of the statements before this one."""

    def refer(self, phrase: Phrase, *, besides: Sequence[Group] = ()) -> Group | None:
        """The group already read that `phrase` speaks of, or None.

        "the bowl" is a bowl, or else what was last called some kind of bowl and is not one of `besides`.
        """
        if (
            not (phrase.definite or self._bare(phrase))
            or phrase.kind not in ("object", "unknown")
            or phrase.head == "another"
        ):
            return None
        known = self._same_noun(phrase) or self._same_head(phrase, besides)
        return self.members.chosen(known, phrase) if known else self._storage(phrase)

    def _bare(self, phrase: Phrase) -> bool:
        """Whether a noun without an article repeats one of an earlier statement: "mug on tray; spoon in mug"."""
        bare = not (phrase.determined or phrase.plural or phrase.height or phrase.cycle)
        return bare and any(group.noun == phrase.noun for group in self._draft.groups[: self._stated])

    def _same_noun(self, phrase: Phrase) -> Group | None:
        if phrase.kind == "unknown":
            return None
        for group in reversed(self._draft.groups):
            same = group.noun == phrase.noun if phrase.noun else bool(group.cycle) and group.cycle == phrase.cycle
            if same and _agrees(group, phrase):
                return group
        return None

    def _same_head(self, phrase: Phrase, besides: Sequence[Group]) -> Group | None:
        wanted = {phrase.said or phrase.head, *singulars(phrase.said or phrase.head)}
        for group in reversed(self._draft.groups):
            if group not in besides and not group.cycle and wanted & _heads(group) and _agrees(group, phrase):
                return group
        return None

    def _storage(self, phrase: Phrase) -> Group | None:
        if phrase.head in lexicon.STORAGE_PARTS and phrase.count in (None, 1):
            storage = [group for group in self._draft.groups if self._draft.is_a(group, lexicon.STORAGE)]
            return storage[-1] if storage else None
        return None

    def make(self, phrase: Phrase, *, filling: bool = False) -> Group:
        """A new group for `phrase`.

        Raises:
            PromptError: the noun is unknown and proxies are not allowed, or the count is impossible.
        """
        noun, said, proxy = phrase.noun, phrase.said, False
        if phrase.kind == "unknown":
            noun, said, proxy = self._proxy(phrase)
        count, height = self._count(phrase, filling)
        group = Group(
            noun=noun, said=said, phrase=phrase.words, count=count, counted=phrase.count is not None,
            exact=phrase.count is not None and not phrase.vague, one_of=phrase.one_of,
            plural=phrase.plural, modifiers=phrase.modifiers, cycle=phrase.cycle, height=height,
            rows=phrase.rows, heap=phrase.heap, proxy=proxy, place=position(phrase),
        )  # fmt: skip
        self._note_kind(phrase)
        self._share_colours(group)
        if self._inherited is not None:
            self._take_after(group, self._inherited)
        self._draft.groups.append(group)
        self.members.line_up(group)
        self._check_total()
        return group

    def _note_kind(self, phrase: Phrase) -> None:
        """Say what a kind of object is made as where only its head is known: "knife block"."""
        if phrase.left_out:
            self._draft.notes.append(f'"of {phrase.left_out}" is left out of "{phrase.words}".')
        for word in phrase.modifiers.adjectives:
            kind = self._draft.nouns.match([word]) is not None or word in lexicon.SUBSTANCES
            if kind and word not in POSITIONS and not is_modifier(word) and not looks_like_adjective(word):
                self._draft.notes.append(f'"{word}" of "{phrase.words}" is left out: it is made as a "{phrase.said}".')

    def _proxy(self, phrase: Phrase) -> tuple[str, str, bool]:
        if self._allow_proxies:
            self._draft.notes.append(
                f'"{phrase.head}" (word {phrase.number}) is not in the catalogue: a plain box stands in.'
            )
            return "box", phrase.head[:40], True
        near = self._draft.nouns.nearest(phrase.head)
        hint = f"Nearest: {', '.join(map(_quoted, near))}." if near else "`pat3d catalogue` lists what can be made."
        raise PromptError(
            f'"{phrase.head}" is not in the catalogue (word {phrase.number}). {hint} Bring a mesh of '
            "your own with pat3d build, or accept a plain box with --allow-proxies."
        )

    def _count(self, phrase: Phrase, filling: bool) -> tuple[int, int]:
        """Objects, and objects in a stack."""
        modifiers = phrase.modifiers
        count = phrase.count
        plural = phrase.plural or (phrase.kind == "unknown" and phrase.head.endswith("s") and not phrase.determined)
        noted = True
        if count is None:
            several = plural or phrase.height is not None or (bool(phrase.cycle) and not phrase.determined)
            if not several:
                count, noted = 1, False
            elif modifiers.palette_word:
                count = lexicon.PALETTE_COUNT.get(modifiers.palette_word, lexicon.COLOURFUL_COUNT)
            elif phrase.height is not None or modifiers.stacked:
                count = lexicon.STACK_HEIGHT
            elif phrase.noun in lexicon.COMES_IN_TWOS:
                count = 2
            else:
                count = max(lexicon.FILLING if filling else lexicon.BARE_PLURAL, len(modifiers.colours))
            colours = len(modifiers.colours)
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
        if noted:
            self._draft.notes.append(f'"{phrase.words}": {count} assumed.')
        return count, height

    def _share_colours(self, group: Group) -> None:
        """As many colours as objects, or three and more, are shared out among the objects."""
        named, palette = group.modifiers.colours, group.modifiers.palette
        if palette and group.count == 1:
            group.modifiers = replace(group.modifiers, colours=palette)
        elif palette:
            group.member_colours = [(palette[index % len(palette)],) for index in range(group.count)]
        elif group.count > 1 and (
            len(named) == group.count or len(named) >= 3 or (len(named) == 2 and self._in_turn(group))
        ):
            group.member_colours = [(named[index % len(named)],) for index in range(group.count)]

    @staticmethod
    def _in_turn(group: Group) -> bool:
        """Whether two colours are those of different objects: "red and blue blocks"."""
        return not group.counted or "alternating" in group.modifiers.adjectives

    def _check_total(self) -> None:
        total = sum(group.count for group in self._draft.groups if not group.replaced)
        if total > MAX_OBJECTS:
            raise PromptError(
                f'the prompt asks for {total} objects by "{self._draft.groups[-1].phrase[:60]}"; a scene holds at most '
                f"{MAX_OBJECTS}. Ask for fewer."
            )

    def recount(self, group: Group, count: int) -> None:
        """`group` has `count` objects (0: nothing new is said): "in three rows of four".

        Raises:
            PromptError: the prompt has given another number, or there would be too many.
        """
        if group.exact and count not in (0, group.count):
            raise PromptError(f'"{group.phrase}" are {group.count} objects and cannot stand as {count}.')
        if count:
            group.count = count
            self._forget_note(group)
            self._share_colours(group)
            self._check_total()

    def multiply(self, group: Group, factor: int) -> None:
        """One `group` for each of `factor` objects."""
        if factor > 1:
            group.count *= factor
            self._share_colours(group)
            self._check_total()

    def inherit(self, generic: Group) -> None:
        """What is made from now on in this sentence is of the kind of `generic` ("plush toys, including ...")."""
        self._inherited = generic
        generic.replaced = True
        self._forget_note(generic)

    def _forget_note(self, group: Group) -> None:
        self._draft.notes = [note for note in self._draft.notes if not note.startswith(f'"{group.phrase}": ')]

    def end_statement(self) -> None:
        """The sentence is over, or what stands before a semicolon."""
        self._stated = len(self._draft.groups)
        self.members.end_sentence()

    def end_relation(self) -> None:
        """A relation of a list of relations is over: "bowl on plate, spoon in bowl"."""
        self._stated = len(self._draft.groups)

    def end_sentence(self) -> None:
        """Nothing is inherited past the end of a list."""
        self._inherited = None

    def _take_after(self, group: Group, generic: Group) -> None:
        word = generic.said.split()[0] if " " in generic.said else ""
        material = generic.modifiers.material or ("plush" if word in ("plush", "stuffed", "soft") else None)
        if material and not group.modifiers.material and not self._draft.is_a(group, _SOFT_ALREADY):
            group.modifiers = replace(group.modifiers, material=material)

    def settle_generic(self, group: Group, parent: Group) -> None:
        """Let the counted mention win: "a basket of fruit" with "five fruits" in it holds five."""
        if not group.cycle:
            return
        for other in self._draft.groups:
            same = other is not group and other.cycle == group.cycle and not other.replaced
            if same and self._draft.support(other) is parent and not other.counted:
                other.replaced = True
                self._forget_note(other)

    def tell_apart(self, group: Group, phrase: Phrase) -> None:
        """Read "two bars - one white and one beige", "blocks, featuring red, blue and green pieces"."""
        colours, palette = phrase.modifiers.colours, phrase.modifiers.palette
        group.modifiers = group.modifiers.marked_as(phrase.modifiers)
        if phrase.determined and not phrase.plural and phrase.count is not None and group.count > 1:
            told = len(group.member_colours) % group.count
            listed = [*group.member_colours[:told], *[colours] * phrase.count]
            group.member_colours = [*listed, *[()] * (group.count - len(listed))][: group.count]
            group.member_colours = [colour or group.modifiers.colours for colour in group.member_colours]
            while group.member_colours and not group.member_colours[-1]:
                group.member_colours.pop()
            return
        shared = palette or colours
        if not shared:
            return
        if group.count > 1:
            if not group.counted:
                tall = group.height == group.count
                group.count = max(len(shared), group.count if palette else len(shared))
                group.height = group.count if tall else group.height
                self._forget_note(group)
                self._check_total()
            group.member_colours = [(shared[index % len(shared)],) for index in range(group.count)]
        else:
            group.modifiers = replace(group.modifiers, colours=(*group.modifiers.colours, *shared))


def recolour(group: Group, modifiers: Modifiers, part: str = "") -> None:
    """Give `group` what a later remark says of it: "is wooden", or of its `part`: "with red covers".

    The colour of a part that shows little ("a mug with a blue handle") is not the object's main colour.
    """
    own = group.modifiers
    colours = (*modifiers.colours, *modifiers.palette[: 1 if group.count > 1 else None])
    adjectives = modifiers.adjectives
    if part and not own.colours and part not in lexicon.MAIN_PARTS:
        adjectives, colours = (*adjectives, *(f"{colour}-{part}" for colour in colours)), ()
    group.modifiers = replace(
        own.marked_as(modifiers),
        colours=tuple(dict.fromkeys((*own.colours, *colours))),
        material=own.material or (modifiers.material if not part else None),
        adjectives=(*own.adjectives, *adjectives),
    )


def _agrees(group: Group, phrase: Phrase) -> bool:
    """Whether colours and number of `phrase` allow it to speak of `group`."""
    wanted = phrase.modifiers.colours
    if group.member_colours and wanted and (wanted[0],) not in group.member_colours:
        return False
    if position(phrase) and group.place and position(phrase) != group.place:
        return False
    clash = wanted and group.modifiers.colours and not set(wanted) & set(group.modifiers.colours)
    return not clash and (phrase.count is None or phrase.count <= group.count)


def _heads(group: Group) -> set[str]:
    """The single words that "the ..." may call `group` by: "bowl" for a fruit bowl, "loaf" for a loaf of bread."""
    names = (group.said, group.noun) if not group.proxy else (group.said,)
    return {word for name in names for words in [name.split(" of ")] for word in (words[0].split()[-1:])}


def _quoted(name: str) -> str:
    return f'"{name}"'
