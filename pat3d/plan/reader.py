"""Reads the chunks of a prompt into a draft: who is on, in or beside whom."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from pat3d.plan import lexicon
from pat3d.plan.chunks import Chunk
from pat3d.plan.draft import Draft, Flank, Group
from pat3d.plan.groups import GroupMaker, recolour
from pat3d.plan.links import Link
from pat3d.plan.phrases import Phrase
from pat3d.scene import SUPPORT_KINDS


@dataclass(kw_only=True, eq=False)
class Frame:
    """An open list: "a table with A, B and C"."""

    link: Link
    parents: list[Group]
    members: list[Group] = field(default_factory=list)
    flank: Flank | None = None
    each: bool = False
    fresh: bool = True
    """No member read yet."""


class Reader:
    """The state of reading one prompt."""

    def __init__(self, draft: Draft, maker: GroupMaker) -> None:
        self._draft = draft
        self._maker = maker
        self._chunks: Sequence[Chunk] = ()
        self._frames: list[Frame] = []
        self._subject: list[Group] = []
        self._before: list[Group] = []
        """Subject of the clause before this one."""
        self._last: list[Group] = []
        """What a relation without a comma attaches to."""
        self._top: list[Group] = []
        """Members of the list that the clause begins with, while nothing else was said of them."""
        self._holder: dict[int, Frame] = {}
        self._carried: dict[int, list[Group]] = {}
        self._all = False
        self._verb = False
        self._had_verb = False
        self._each = False
        self._side = ""
        self._mark = "start"

    def read(self, chunks: Sequence[Chunk]) -> None:
        """Read all chunks."""
        self._chunks = chunks
        at = 0
        while at < len(chunks):
            at = self._step(at)

    def _step(self, at: int) -> int:
        piece = self._chunks[at]
        if piece.kind in ("stop", "clause"):
            self._end_clause()
        elif piece.kind in ("comma", "and", "dash"):
            joined = piece.kind == "and" and self._mark == "comma"
            self._mark = self._mark if self._mark == "start" else "comma and" if joined else piece.kind
            return at + 1
        elif piece.kind == "aside":
            self._draft.set_aside.append(piece.text)
        elif piece.kind == "there":
            self._there()
        elif piece.kind == "verb":
            self._on_verb()
        elif piece.kind == "quality":
            self._qualify(piece)
        elif piece.kind == "arrange":
            self._arrange(piece.text)
        elif piece.kind == "each":
            self._on_each(at)
        elif piece.kind == "side":
            self._on_side(piece.text, at)
        elif piece.kind == "link" and piece.link is not None:
            return self._on_link(piece.link, at)
        elif piece.phrase is not None:
            self._on_phrase(piece.phrase, at)
        if piece.kind not in ("stop", "clause"):
            self._mark = ""
        return at + 1

    def _end_clause(self) -> None:
        self._before = self._subject or self._before
        self._subject, self._last, self._top, self._frames = [], [], [], []
        self._verb = self._had_verb = self._all = self._each = False
        self._side, self._mark = "", "start"

    def _there(self) -> None:
        pending = [frame for frame in self._frames if frame.link.manner == "place"]
        if not pending and self._subject:
            self._before = self._subject
        self._frames = pending[-1:]
        for frame in self._frames:
            frame.fresh = True
        self._subject, self._top, self._had_verb, self._verb = [], [], True, False

    def _on_verb(self) -> None:
        pending = [frame for frame in self._frames if frame.link.manner == "place" and not frame.members]
        self._frames = pending[-1:]
        for frame in self._frames:
            frame.fresh = True
        self._verb = self._had_verb = True

    def _qualify(self, piece: Chunk) -> None:
        if self._subject:
            for group in self._subject:
                recolour(group, piece.modifiers)
        else:
            self._draft.set_aside.append(piece.text)

    def _arrange(self, how: str) -> None:
        groups = self._last or self._subject
        if how == "stack":
            if len(groups) == 1 and groups[0].count > 1:
                groups[0].height = groups[0].count if groups[0].height == 1 else groups[0].height
            elif len(self._top) > 1:
                for lower, upper in zip(self._top, self._top[1:]):
                    self._draft.place(upper, "on", lower)
        else:
            for group in groups[-1:]:
                group.row = True
            if len(groups) == 1 and groups[0].count == 1:
                for left, right in zip(self._top, self._top[1:]):
                    self._draft.beside(right, "next_to", left)

    def _on_each(self, at: int) -> None:
        follower = self._chunks[at + 1] if at + 1 < len(self._chunks) else None
        before = self._chunks[at - 1] if at else None
        if follower is not None and follower.kind == "link":
            self._each = True
            return
        if before is not None and before.kind == "phrase":
            for group in self._last:
                frame = self._holder.get(id(group))
                if frame is not None and frame.parents:
                    self._maker.multiply(group, frame.parents[0].count)

    # Phrases

    def _on_phrase(self, phrase: Phrase, at: int) -> None:
        if phrase.kind == "pronoun":
            if self._mark == "start" or not self._subject:
                self._subject = self._last = list(self._before)
            return
        if phrase.kind == "items":
            if self._starts_clause(at) or self._mark == "start":
                self._subject, self._last, self._all = [], [], True
            self._draft.set_aside.append(phrase.words)
            return
        if phrase.kind in ("part", "pieces"):
            self._detail(phrase)
            return
        if phrase.kind == "background":
            self._background(phrase, at)
            return
        group, known = self._group(phrase)
        if group is None:
            return
        self._all = False
        if self._had_verb and self._mark in ("and", "comma and", "comma", "dash") and self._starts_clause(at):
            self._end_clause()
        if self._frames and self._frames[-1].fresh and self._mark in ("", "comma", "start"):
            self._enlist(self._frames[-1], group, known)
        elif self._mark in ("comma", "and", "comma and", "dash") and (frame := self._open_frame(group, phrase)):
            self._enlist(frame, group, known)
        else:
            if self._mark == "start" or (self._verb and not self._subject):
                self._subject = []
            self._frames = []
            if not self._had_verb or not self._subject:
                self._subject = [*self._subject, group]
            self._top.append(group)
        if self._frames and self._frames[-1].link.manner == "place" and group in self._frames[-1].members:
            self._subject = [*self._subject, group]
        self._verb = False
        self._last = [group]
        if self._side:
            self._draft.sided.append((group, self._side, None))

    def _group(self, phrase: Phrase) -> tuple[Group | None, bool]:
        """The group that `phrase` means, and whether it was known before."""
        known = self._maker.refer(phrase)
        if known is not None:
            return known, True
        frame = self._frames[-1] if self._frames else None
        return self._maker.make(phrase, filling=bool(frame and frame.fresh and frame.link.filling)), False

    def _background(self, phrase: Phrase, at: int) -> None:
        self._draft.set_aside.append(phrase.words)
        if phrase.substance:
            self._draft.notes.append(f'"{phrase.words}" is no rigid body and is left out.')
        if self._frames and self._frames[-1].fresh:
            self._frames[-1].fresh = False
            return
        if self._mark == "start" or self._starts_clause(at):
            self._before = self._subject or self._before
            self._subject, self._last, self._top, self._frames = [], [], [], []

    def _detail(self, phrase: Phrase) -> None:
        """A part ("with red covers") or bare colours ("one white and one beige") describe what was read before."""
        frame = self._frames[-1] if self._frames and self._frames[-1].fresh else None
        owners = frame.parents if frame else self._last or self._subject
        if not owners:
            self._draft.set_aside.append(phrase.words)
            return
        owner = owners[-1]
        if phrase.kind == "pieces" and not phrase.said:
            self._maker.tell_apart(owner, phrase)
        elif phrase.modifiers.colours or phrase.modifiers.palette:
            recolour(owner, phrase.modifiers)
        if frame:
            frame.fresh = bool(frame.link.manner == "hold")
            self._last = [owner]

    def _starts_clause(self, at: int) -> bool:
        """Whether the phrase at chunk `at` is the subject of a verb of its own."""
        after = at + 1
        while after + 1 < len(self._chunks) and self._chunks[after].kind == "link":
            link = self._chunks[after].link
            if link is not None and link.finite:
                return True
            after += 2 if self._chunks[after + 1].kind == "phrase" else 1
        piece = self._chunks[after] if after < len(self._chunks) else None
        return piece is not None and (piece.kind == "verb" or bool(piece.link and piece.link.finite))

    def _open_frame(self, group: Group, phrase: Phrase) -> Frame | None:
        """The innermost open list that `group` can belong to."""
        for index in range(len(self._frames) - 1, -1, -1):
            frame = self._frames[index]
            if frame.link.manner == "of" and (phrase.determined or self._mark != "and"):
                continue
            loose = frame.flank is not None or frame.link.manner in ("surround", "include")
            holders = frame.parents[:1]
            if loose or all(self._draft.fits(group, parent) or frame.link.manner == "with" and frame.link.kind is None
                            and not self._draft.is_a(parent, lexicon.NARROW + lexicon.DISHES) for parent in holders):  # fmt: skip
                del self._frames[index + 1 :]
                return frame
        return None

    def _enlist(self, frame: Frame, group: Group, known: bool) -> None:
        frame.fresh = False
        frame.members.append(group)
        self._holder[id(group)] = frame
        link = frame.link
        if frame.flank is not None:
            frame.flank.members.append(group)
            return
        for parent in frame.parents[:1]:
            if parent is group:
                continue
            if frame.each:
                self._maker.multiply(group, parent.count)
            if link.manner == "surround":
                self._draft.beside(group, "around", parent)
            elif link.manner == "place" and link.kind is not None:
                self._relate(group, link, parent)
            elif link.manner == "include" or (link.kind is None and link.manner == "with"):
                if not known:
                    self._draft.join_with(group, parent)
            elif link.kind == "on":
                self._draft.place(group, "on", parent)
            elif not known or link.manner != "of":
                self._hold(group, parent)

    def _hold(self, group: Group, parent: Group) -> None:
        if self._draft.is_a(group, lexicon.FLOOR) and not self._draft.on_floor(parent):
            self._draft.beside(group, "next_to", parent)
            return
        self._maker.settle_generic(group, parent)
        self._draft.place(group, self._draft.containment(parent), parent)

    # Relations

    def _on_link(self, link: Link, at: int) -> int:
        if link.finite:
            self._frames = []
            self._had_verb = True
        follower = self._chunks[at + 1] if at + 1 < len(self._chunks) else None
        apart = link.finite or self._verb or "comma" in self._mark or self._mark == "dash"
        near = self._subject if apart else self._last or self._subject
        if link.manner == "include":
            near = self._last or self._subject
        if link.inverse:
            self._open(link, near)
            self._verb, self._mark = False, ""
            return at + 1
        target = follower.phrase if follower is not None and follower.kind == "phrase" else None
        if follower is not None and follower.kind == "each":
            target = Phrase(kind="pronoun", head="each", each=True)
        if target is None:
            self._without_target(link)
            self._verb, self._mark = False, ""
            return at + 1
        fronted = self._fronted(at, near)
        if fronted and self._subject:
            self._before, self._subject, self._last, self._top, self._frames = self._subject, [], [], [], []
        self._forward(link, target, [] if fronted else near, apart=apart, at=at)
        self._verb, self._mark = False, ""
        return at + 2

    def _fronted(self, at: int, near: list[Group]) -> bool:
        """Whether the relation at chunk `at` speaks of a phrase that is still to come."""
        if self._all:
            return False
        kinds = [piece.kind for piece in self._chunks[at + 2 : at + 5]]
        if self._mark == "start" or not near:
            return True
        if not self._mark:
            return False
        return (
            kinds[:1] == ["there"] or kinds[:2] in (["comma", "there"], ["verb", "phrase"]) or kinds[:1] == ["phrase"]
        )

    def _open(self, link: Link, parents: list[Group]) -> None:
        if link.manner == "include" and parents and parents[-1].cycle and not parents[-1].replaced:
            generic = parents[-1]
            generic.replaced = True
            holder = self._holder.get(id(generic))
            self._maker.inherit(generic)
            if holder is not None:
                holder.fresh = True
                self._frames = (
                    [*self._frames[: self._frames.index(holder)], holder] if holder in self._frames else [holder]
                )
            else:
                self._subject = [group for group in self._subject if group is not generic]
                self._top = [group for group in self._top if group is not generic]
                edge = self._draft.supports.get(id(generic))
                if edge is not None:
                    self._frames = [Frame(link=Link(kind=edge.kind), parents=[edge.parent])]
            return
        if not parents:
            return
        if link.manner == "include" and (holder := self._holder.get(id(parents[-1]))):
            holder.fresh = True
            return
        parents = parents[-1:] if not self._each else parents
        flank = None
        if link.manner == "flank":
            flank = Flank(parent=parents[0])
            self._draft.flanks.append(flank)
        if link.finite or link.manner != "of":
            self._frames = [
                frame for frame in self._frames if any(m in parents for m in frame.members) or not link.finite
            ]
        self._frames.append(Frame(link=link, parents=parents, flank=flank, each=self._each))
        self._each = False

    def _without_target(self, link: Link) -> None:
        """ "with a cat on top", "with two cushions in front": of what the list speaks of."""
        for group in self._last[-1:]:
            frame = self._holder.get(id(group))
            parents = (
                frame.parents if frame else [other for other in self._subject if other is not group] or self._before
            )
            for parent in parents[:1]:
                if parent is not group:
                    self._relate(group, link, parent)

    def _forward(self, link: Link, phrase: Phrase, children: list[Group], *, apart: bool, at: int) -> None:
        if link.manner == "half" and phrase.kind == "background":
            self._on_half(children, link.side or "centre", None)
        if phrase.kind in ("background", "part", "pieces", "items"):
            self._to_place(phrase, children, link)
            return
        if phrase.kind == "pronoun":
            parents, known = self._antecedent(children, phrase), True
        else:
            group, known = self._group(phrase)
            parents = [group] if group is not None else []
        if not parents:
            return
        parent = parents[0]
        if self._all:
            if link.kind in SUPPORT_KINDS:
                self._carry_all(link, parent)
            return
        if not children:
            frame = Frame(link=link, parents=parents, each=phrase.each)
            self._frames = [frame]
            self._last = [] if known and phrase.kind == "pronoun" else parents
            return
        if not apart:
            children = self._climb(children, link, parent, known)
        for child in children:
            if phrase.each and parent.count > 1:
                self._maker.multiply(child, parent.count)
            if child is not parent:
                self._relate(child, link, parent)
                self._carried[id(parent)] = [child]
        if link.manner == "between":
            self._second_of_between(children)
        self._top = []
        self._last = parents
        if phrase.kind == "pronoun":
            self._last = children

    def _second_of_between(self, children: list[Group]) -> None:
        self._frames.append(Frame(link=Link(manner="flank"), parents=children, flank=Flank(parent=children[0])))
        self._frames[-1].fresh = False

    def _carry_all(self, link: Link, parent: Group) -> None:
        for group in self._draft.groups:
            if (
                group is not parent
                and self._draft.support(group) is None
                and group not in self._draft.ancestors(parent)
            ):
                self._relate(group, link, parent)
        self._subject, self._last, self._all = [parent], [parent], False

    def _to_place(self, phrase: Phrase, children: list[Group], link: Link) -> None:
        """A relation to the floor, a part or the items in general."""
        if phrase.kind == "background":
            self._draft.set_aside.append(phrase.words)
            if children:
                self._last = []
                self._top = []
            else:
                self._frames = []
            return
        if phrase.kind in ("part", "pieces"):
            owners = self._antecedent(children, phrase)
            if children and owners and link.kind is not None:
                for child in children:
                    self._relate(child, link, owners[0])
            elif owners:
                self._frames = [Frame(link=link, parents=owners)]
            return
        self._draft.set_aside.append(phrase.words)

    def _antecedent(self, children: list[Group], phrase: Phrase) -> list[Group]:
        """What "it", "them", "its head" or "the shelf" of something speaks of."""
        child = children[-1] if children else None
        if phrase.kind == "pieces" and phrase.said == "stack":
            stacks = [group for group in self._draft.groups if group.height != 1 and group is not child]
            return stacks[-1:]
        frame = self._holder.get(id(child)) if child is not None else None
        if frame is not None and frame.parents and frame.flank is None:
            return frame.parents[:1]
        if phrase.each or phrase.head in ("them", "they", "each"):
            plural = [group for group in self._draft.groups if group.count > 1 and group is not child]
            if plural:
                return plural[-1:]
        for options in (self._subject, self._before, self._draft.groups[::-1]):
            chosen = [group for group in options if group is not child and group not in children]
            if chosen:
                return chosen[:1]
        return []

    def _climb(self, children: list[Group], link: Link, parent: Group, known: bool) -> list[Group]:
        """From the nearest phrase to the one that the relation speaks of.

        "a cup holding pens on a desk" puts the cup on the desk; "a mug on a table next to a plate" the mug next to the
        plate; "a fork, a knife and a spoon on a plate" all three on the plate.
        """
        draft = self._draft
        supports = link.kind in SUPPORT_KINDS
        floor = draft.on_floor(parent)
        if len(self._top) > 1 and children[-1:] == self._top[-1:] and parent not in self._top:
            return [group for group in self._top if not (supports and draft.on_floor(group) and floor)] or children
        child = children[-1]
        while not draft.is_a(child, lexicon.FLOOR) or floor and not supports:
            frame = self._holder.get(id(child))
            if not supports and id(child) in self._carried and not frame and not floor:
                break
            if (
                frame is None
                or not frame.parents
                or frame.flank
                or len(frame.members) > 1
                or frame.link.manner == "place"
            ):
                break
            above = frame.parents[0]
            if above is parent:
                break
            if draft.on_floor(above) and (supports or not floor):
                break
            if supports and not floor and draft.is_a(above, lexicon.LEVEL + lexicon.DISHES):
                break
            if supports and (draft.supports.get(id(above)) is not None and not draft.supports[id(above)].weak):
                break
            child = above
        if not supports and not floor and draft.on_floor(child) and id(child) in self._carried:
            return self._carried[id(child)]
        return [child]

    def _relate(self, child: Group, link: Link, parent: Group) -> None:
        draft = self._draft
        if link.manner == "gaze" or link.kind is None and link.manner != "under":
            return
        if link.manner == "under":
            if draft.is_a(child, lexicon.THIN) and not (draft.is_a(child, ("table",)) and not draft.on_floor(parent)):
                draft.place(parent, "on", child)
            else:
                draft.beside(child, "next_to", parent)
                draft.notes.append(f'"{child.phrase}" under "{parent.phrase}" is placed next to it.')
        elif link.manner == "sides":
            self._maker.multiply(child, 2 if child.count == 1 else 1)
            draft.flanks.append(Flank(parent=parent, members=[child]))
        elif link.manner == "half":
            self._on_half([child], link.side or "centre", parent)
        elif link.kind in SUPPORT_KINDS:
            kind = link.kind
            if kind == "in" and not draft.is_a(parent, lexicon.HOLLOW) and draft.on_floor(parent):
                kind = "on"
            self._maker.settle_generic(child, parent)
            draft.place(child, kind, parent)
        else:
            draft.beside(child, link.kind or "next_to", parent)

    def _on_half(self, children: list[Group], side: str, parent: Group | None) -> None:
        """ "on the left side of the table": on it when it is a surface, else beside it."""
        for child in children:
            level = parent is not None and self._draft.is_a(parent, lexicon.LEVEL + lexicon.SEATS)
            if parent is not None and (side == "centre" or (level and not self._draft.on_floor(child))):
                self._draft.place(child, self._draft.containment(parent), parent)
                self._draft.sided.append((child, side, None))
            elif parent is not None:
                self._draft.beside(child, "left_of" if side == "left" else "right_of", parent)
            else:
                self._draft.sided.append((child, side, None))

    def _on_side(self, side: str, at: int) -> None:
        """ "on the left": of the clause's next phrase when it comes first, else of what was read last."""
        kinds = [piece.kind for piece in self._chunks[at + 1 : at + 3]]
        coming = (
            kinds[:1] in (["there"], ["verb"])
            or kinds in (["comma", "there"], ["comma", "phrase"])
            and self._mark == "start"
        )
        if self._mark == "start" or (self._mark and (coming or kinds[:1] == ["phrase"])):
            if self._mark != "start":
                self._end_clause()
            self._side = side
            return
        groups = self._subject if self._verb else self._last
        for group in groups[-1:]:
            owner = self._side_owner(group, side)
            if owner is None:
                self._draft.sided.append((group, side, None))
            else:
                member, frame = owner
                if frame.flank is not None:
                    frame.flank.sides[id(member)] = side
                else:
                    self._draft.sided.append((member, side, frame.parents[0]))
        self._verb = False

    def _side_owner(self, group: Group, side: str) -> tuple[Group, Frame] | None:
        """The listed group that "on the other side" speaks of, from the innermost list outwards."""
        member: Group | None = group
        found: list[tuple[Group, Frame]] = []
        while member is not None and (frame := self._holder.get(id(member))) is not None and len(found) < 8:
            found.append((member, frame))
            member = frame.parents[0] if frame.parents else None
        flanked = [(each, frame) for each, frame in found if frame.flank is not None]
        if flanked:
            return flanked[0]
        if side in ("other", "right"):
            for each, frame in found:
                if any(group in frame.members and group is not each for group, _, _ in self._draft.sided):
                    return each, frame
        return found[0] if found else None
