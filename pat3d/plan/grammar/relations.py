"""What a relation word between two groups comes to in the draft."""

from __future__ import annotations

from dataclasses import dataclass, field

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.draft import Draft, Flank, Group, Sided, carried_by_two
from pat3d.plan.grammar.groups import GroupMaker
from pat3d.plan.grammar.links import Link
from pat3d.scene.model import SUPPORT_KINDS

_BETWEEN = Link(manner="flank")


@dataclass(kw_only=True, eq=False)
class Frame:
    """An open list: "a table with A, B and C", "On a table there are A, B and C"."""

    link: Link
    parents: list[Group]
    members: list[Group] = field(default_factory=list)
    flank: Flank | None = None
    each: bool = False
    fresh: bool = True
    """The next phrase belongs to the list without a comma or "and"."""
    commas: bool = False
    """Whether a comma has joined two members."""
    closed: bool = False
    """Whether "and" has joined the last member: what follows belongs to a wider list."""
    lacks_partner: bool = False
    """Opened by "between", whose second neighbour is still to come."""


@dataclass(kw_only=True, eq=False)
class Relations:
    """Relates groups to each other, and knows the landmark of what was related last."""

    draft: Draft
    maker: GroupMaker
    frames: list[Frame] = field(default_factory=list)
    """Open lists, innermost last."""
    landmark: Group | None = None
    """What "the left side of" or "to the left of" was last said of."""
    landmark_is_surface: bool = True
    """Whether it was "the left side of": on it rather than beside it."""
    landmark_sentence: int = 0
    """The sentence that said it."""
    sentence: int = 0
    """Sentences read."""
    second: bool = False
    """Whether the relation being read has a second phrase after its first: "across a box and a chair"."""

    def relate(self, child: Group, link: Link, parent: Group) -> None:
        """Record that `child` stands in relation `link` to `parent`.

        Raises:
            PromptError: `child` would rest on two things at once.
        """
        draft = self.draft
        self._stand_in(child, link, parent)
        if link.manner == "gaze" or (link.kind is None and link.manner != "under"):
            return
        if link.manner == "under":
            draft.forget_guess(child, parent)
            thin = draft.is_a(child, lexicon.THIN) and not (
                draft.is_a(child, ("table",)) and not draft.on_floor(parent)
            )
            if thin or (draft.is_a(child, lexicon.STACKABLE) and not draft.on_floor(parent)):
                draft.place(parent, "on", child)
            else:
                draft.beside(child, "next_to", parent)
                draft.notes.append(f'"{child.phrase}" under "{parent.phrase}" is placed next to it.')
        elif link.manner == "sides":
            draft.forget_guess(child, parent)
            self.maker.multiply(child, 2 if child.count == 1 else 1)
            draft.flanks.append(Flank(parent=parent, members=[child]))
        elif link.manner == "edge":
            level = draft.is_a(parent, lexicon.LEVEL + lexicon.SEATS + lexicon.DISHES)
            self.relate(child, Link(kind="on" if level else "next_to"), parent)
        elif link.manner == "between":
            draft.forget_guess(child, parent)
            # Both neighbours are said of the one between them: "A left_of child", "B right_of child".
            flank = Flank(parent=child, members=[parent])
            draft.flanks.append(flank)
            if parent.count == 1:
                self.frames.append(Frame(link=_BETWEEN, parents=[child], flank=flank, fresh=False, lacks_partner=True))
        elif link.manner == "half":
            self.on_half([child], link.side or "centre", parent)
        elif link.kind in SUPPORT_KINDS:
            kind = link.kind
            if kind == "in" and not draft.is_a(parent, lexicon.HOLLOW) and draft.on_floor(parent):
                kind = "on"
            self.maker.settle_generic(child, parent)
            draft.place(child, kind, parent)
        else:
            if link.kind in ("left_of", "right_of"):
                self._set_landmark(parent, surface=False)
            draft.beside(child, link.kind or "next_to", parent)

    def _stand_in(self, child: Group, link: Link, parent: Group) -> None:
        """Say what stands in for a relation that no plan has."""
        if link.instead == "bridging":
            if parent.count > 1 or self.second:
                raise carried_by_two(child, parent)
        elif link.instead:
            where = "on" if link.kind == "on" else "next to"
            self.draft.notes.append(f'"{child.phrase}" {link.instead} "{parent.phrase}" is placed {where} it.')

    def _set_landmark(self, group: Group | None, *, surface: bool) -> None:
        self.landmark, self.landmark_is_surface, self.landmark_sentence = group, surface, self.sentence

    def on_half(self, children: list[Group], side: str, parent: Group | None) -> None:
        """Read "on the left side of the table": on it when it is a surface, else beside it."""
        for child in children:
            level = parent is not None and self.draft.is_a(parent, lexicon.LEVEL + lexicon.SEATS)
            self._set_landmark(parent or self.landmark, surface=True)
            if parent is not None and (side == "centre" or (level and not self.draft.on_floor(child))):
                self.draft.place(child, self.draft.containment(parent), parent)
                self.draft.sided.append(Sided(group=child, side=side))
            elif parent is not None:
                self.draft.beside(child, "left_of" if side == "left" else "right_of", parent)
            else:
                self.draft.sided.append(Sided(group=child, side=side))
