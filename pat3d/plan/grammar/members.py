"""Single members of a group: "two mugs, one on a plate and the other on a tray", "the red one", "the left box"."""

from __future__ import annotations

from dataclasses import replace

from pat3d.plan.grammar.draft import Draft, Flank, Group
from pat3d.plan.grammar.modifiers import Modifiers
from pat3d.plan.grammar.phrases import Phrase
from pat3d.scene.model import LateralKind

POSITIONS: dict[str, int] = {
    "left": 0, "leftmost": 0, "first": 0, "middle": 1, "right": -1, "rightmost": -1, "last": -1,
    "second": 1, "third": 2,
}  # fmt: skip
"""Words for one of several by its place, and its index."""
_SAME = {"leftmost": "left", "rightmost": "right"}
REST = frozenset({"other", "others", "rest", "remaining", "remainder"})
"""Heads that speak of the members not spoken of yet."""


def position(phrase: Phrase) -> str:
    """The place by which `phrase` tells its object from others of the kind ("left"), or nothing."""
    found = next((word for word in phrase.modifiers.adjectives if word in POSITIONS), "")
    return _SAME.get(found, found) if phrase.definite else ""


class Members:
    """Takes members out of the groups of one draft, so that something can be said of them alone."""

    def __init__(self, draft: Draft) -> None:
        self._draft = draft
        self._whole: Group | None = None
        """The group whose members are being told of, or were last."""
        self._ended = False
        """The sentence that tells of them is over: only "the other" can still mean one."""

    def end_sentence(self) -> None:
        """What "one" means holds for a sentence."""
        self._ended = True

    def told(self, phrase: Phrase, groups: list[Group]) -> Group | None:
        """The members that a headless `phrase` speaks of, of the last of `groups` that has enough; None if none has."""
        count = phrase.count or 1
        rest = phrase.head in REST
        whole = self._whole if rest or not self._ended else None
        if whole is None or whole.count < (1 if rest else count):
            whole = next((group for group in groups if group.count > count and group.height == 1), None)
        if whole is None:
            return None
        self._whole, self._ended = whole, False
        if (where := position(phrase)) and whole.count > 1:
            return self._at(whole, where, phrase.modifiers)
        if rest and (phrase.count is None or phrase.count == whole.count):
            return whole
        return self.pick(whole, count, phrase.modifiers)

    def chosen(self, group: Group, phrase: Phrase) -> Group:
        """What `phrase`, which refers to `group`, speaks of: one colour or one place of it, or all of it."""
        if group.count == 1 or group.height != 1:
            return group
        colours = phrase.modifiers.colours[:1]
        if colours and colours in group.member_colours:
            count = group.member_colours.count(colours) if phrase.count is None else phrase.count
            return self.pick(group, 1 if phrase.count is None and not phrase.plural else count, phrase.modifiers)
        where = position(phrase)
        return self._at(group, where, Modifiers()) if where and not phrase.plural else group

    def _at(self, group: Group, where: str, told: Modifiers) -> Group:
        """The member of `group` in place `where`."""
        index = group.count // 2 if where == "middle" else POSITIONS[where]
        if not -group.count <= index < group.count:
            return group
        in_row = bool(group.rows)
        picked = self.pick(group, 1, told, at=index % group.count)
        picked.place = where
        if group is not picked and not in_row:
            self.line_up(picked)
        return picked

    def line_up(self, placed: Group) -> None:
        """Relate the left one and the right one of a kind to each other."""
        kind: dict[str, LateralKind] = {"left": "left_of", "right": "right_of"}
        if placed.place in kind:
            for other in self._draft.groups:
                if other is not placed and other.noun == placed.noun and other.place in ("", *kind) and not other.cycle:
                    self._draft.beside(placed, kind[placed.place], other)

    def pick(self, group: Group, count: int, told: Modifiers, *, at: int = 0) -> Group:
        """`count` members of `group` as a group of their own, with all that was said of `group`."""
        if count >= group.count:
            _tell(group, told)
            return group
        if group.rows == 1 and at > 0 and at + count < group.count:
            # The row in three: before, picked, after.
            self.pick(group, at, Modifiers())
            at = 0
        indices = list(range(at, at + count))
        if told.colours and group.member_colours:
            alike = [index for index, own in enumerate(group.member_colours) if own == told.colours[:1]]
            indices = alike[:count] or indices
        picked = replace(group, count=len(indices), member_colours=[], whole=group)
        if group.member_colours:
            picked.member_colours = [group.member_colours[i] for i in indices if i < len(group.member_colours)]
            group.member_colours = [own for i, own in enumerate(group.member_colours) if i not in indices]
        _tell(picked, told)
        group.count -= picked.count
        self._copy_relations(group, picked, before=indices[0] == 0)
        if group.rows == 1:
            left, right = (picked, group) if indices[0] == 0 else (group, picked)
            self._draft.beside(left, "left_of", right)
        return picked

    def _copy_relations(self, group: Group, picked: Group, *, before: bool) -> None:
        draft = self._draft
        index = draft.groups.index(group)
        draft.groups.insert(index if before else index + 1, picked)
        if (edge := draft.supports.get(id(group))) is not None:
            draft.supports[id(picked)] = replace(edge, child=picked)
        for edge in list(draft.laterals):
            if edge.child is group:
                draft.laterals.append(replace(edge, child=picked))
            elif edge.parent is group:
                draft.laterals.append(replace(edge, parent=picked))
        for flank in draft.flanks:
            if group in flank.members:
                flank.members.insert(flank.members.index(group), picked)
        draft.flanks += [Flank(parent=picked, members=[*each.members]) for each in draft.flanks if each.parent is group]
        draft.sided += [replace(each, group=picked) for each in draft.sided if each.group is group]


def _tell(group: Group, told: Modifiers) -> None:
    """Give `group` the colour and the size by which the prompt tells it from its like."""
    own = group.modifiers
    if told.colours and not group.member_colours and not own.colours:
        own = replace(own, colours=told.colours)
    if told.size_word and not own.size_word:
        own = replace(own, size_word=told.size_word, scale=own.scale * told.scale)
    group.modifiers = own
