"""What the reader knows at one point of a prompt, and what relation words come to there."""

from __future__ import annotations

from dataclasses import dataclass, field

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.draft import Group
from pat3d.plan.grammar.links import Link
from pat3d.plan.grammar.phrases import Phrase
from pat3d.plan.grammar.relations import Frame, Relations
from pat3d.scene.model import LATERAL_KINDS, SUPPORT_KINDS


@dataclass(kw_only=True, eq=False)
class Context(Relations):
    """The open lists, the subject, and what pronouns may mean."""

    subject: list[Group] = field(default_factory=list)
    """Subject of the clause."""
    before: list[Group] = field(default_factory=list)
    """Subject of the clause before this one."""
    last: list[Group] = field(default_factory=list)
    """What a relation without a comma attaches to."""
    top: list[Group] = field(default_factory=list)
    """Members of the list that the clause begins with, while nothing else was said of them."""
    listed: list[Group] = field(default_factory=list)
    """All members of the list that the clause begins with."""
    top_joined: bool = False
    """Whether "and" stood before the last of them."""
    more: bool = False
    """Whether the clause goes on to list after the phrase being read."""
    holder: dict[int, Frame] = field(default_factory=dict)
    """The list that a group is a member of, by id of the group."""
    shared_out: set[int] = field(default_factory=set)
    """Groups of which there is one for each of another, by id: the forks of "a fork beside each plate"."""
    carried: dict[int, list[Group]] = field(default_factory=dict)
    """What was last put on a group, by id of the group."""
    related: list[Group] = field(default_factory=list)
    """What the last relation was said of."""
    mark: str = "start"
    """What stands before the chunk being read: "start", "comma", "and", "comma and", "dash" or nothing."""

    def close(self) -> None:
        """Forget the clause; keep its subject for pronouns."""
        self.before = self.subject or self.before
        self.subject, self.last, self.top, self.frames, self.related = [], [], [], [], []
        self.listed = []

    def begun(self) -> list[Group]:
        """What the clause before is about: in "a bottle, behind it a can", the bottle."""
        for group in self.before[-1:]:
            frame = self.holder.get(id(group))
            if frame is not None and frame.link.kind in LATERAL_KINDS and not frame.link.inverse:
                return frame.parents
        return self.before

    def wait_for_child(self) -> None:
        """Keep only the list opened by a relation in front ("On a table, there is ...")."""
        self.frames = [frame for frame in self.frames if not frame.link.inverse and not frame.members][-1:]
        for frame in self.frames:
            frame.fresh = True

    def replace_generic(self, generic: Group) -> None:
        """The list that follows stands in place of `generic` ("toys, including ...")."""
        self.maker.inherit(generic)
        holder = self.holder.get(id(generic))
        if holder is not None:
            holder.fresh, holder.closed = True, False
            kept = self.frames[: self.frames.index(holder)] if holder in self.frames else []
            self.frames = [*kept, holder]
            return
        self.subject = [group for group in self.subject if group is not generic]
        self.top = [group for group in self.top if group is not generic]
        edge = self.draft.supports.get(id(generic))
        if edge is not None:
            self.frames = [Frame(link=Link(kind=edge.kind), parents=[edge.parent])]

    def open_frame(self, group: Group, phrase: Phrase) -> Frame | None:
        """The innermost open list that `group` can belong to.

        "X, Y and Z" is complete: what follows goes on the list around it, or where there is none stays on the table
        that the list stands on.
        """
        lacking = next((frame for frame in reversed(self.frames) if frame.lacks_partner), None)
        if lacking is not None and "and" in self.mark and not self.more:
            del self.frames[self.frames.index(lacking) + 1 :]
            return lacking
        for index in range(len(self.frames) - 1, -1, -1):
            frame = self.frames[index]
            if frame.link.manner == "of" and (phrase.determined or self.mark != "and"):
                continue
            if frame.closed and (frame.commas or self.mark != "and"):
                continue
            # "a lamp, a crate of toys, and a mug": the mug goes on the list that has commas already.
            wider = (each for each in reversed(self.frames[:index]) if each.parents[0] is not frame.parents[0])
            outer = next((each.members for each in wider), self.top)
            if "comma" in self.mark and len(frame.members) < 2 <= len(outer) and frame.parents[0] in outer:
                continue
            loose = frame.flank is not None or frame.link.manner in ("surround", "include")
            holders = frame.parents[:1]
            if loose or all(self._takes(frame, parent, group) for parent in holders):
                del self.frames[index + 1 :]
                return frame
        for index in range(len(self.frames) - 1, -1, -1):
            frame = self.frames[index]
            if frame.closed and self._is_surface(frame) and self.draft.fits(group, frame.parents[0]):
                del self.frames[index + 1 :]
                return frame
        return None

    def _is_surface(self, frame: Frame) -> bool:
        """Whether the list names what stands on a table or the like."""
        carries = frame.link.kind in ("on", "in") or (frame.link.kind is None and frame.link.manner in ("with", "hold"))
        return carries and self.draft.is_table(frame.parents[0])

    def _takes(self, frame: Frame, parent: Group, group: Group) -> bool:
        vague = frame.link.manner == "with" and frame.link.kind is None
        picky = self.draft.is_a(parent, lexicon.NARROW + lexicon.DISHES + lexicon.HOLLOW)
        return self.draft.fits(group, parent) or (vague and not picky)

    def enlist(self, frame: Frame, group: Group, known: bool) -> None:
        """Add `group` to an open list and relate it as the list says."""
        frame.fresh = frame.lacks_partner = False
        frame.commas = frame.commas or self.mark == "comma"
        frame.closed = "and" in self.mark
        frame.members.append(group)
        self.holder[id(group)] = frame
        link = frame.link
        if frame.flank is not None:
            frame.flank.members.append(group)
            return
        for parent in frame.parents[:1]:
            if parent is group:
                continue
            if frame.each:
                self.maker.multiply(group, parent.count)
            if link.manner == "surround":
                self.draft.beside(group, "around", parent)
            elif not link.inverse:
                self.relate(group, link, parent)
            elif link.manner == "include" or (link.kind is None and link.manner == "with"):
                if not known:
                    self.draft.join_with(group, parent)
            elif link.kind == "on":
                self.draft.place(group, "on", parent)
            elif not known or link.manner != "of":
                self._hold(group, parent)

    def _hold(self, group: Group, parent: Group) -> None:
        if self.draft.is_a(group, lexicon.FLOOR) and not self.draft.on_floor(parent):
            self.draft.beside(group, "next_to", parent)
            return
        self.maker.settle_generic(group, parent)
        self.draft.place(group, self.draft.containment(parent), parent)

    def antecedent(self, children: list[Group], phrase: Phrase, kind: str = "") -> list[Group]:
        """What `phrase` ("it", "them", "its head", "one of the shelves") speaks of, that holds things of a `kind`."""
        child = children[-1] if children else None
        if phrase.kind == "pieces" and phrase.said == "stack":
            stacks = [group for group in self.draft.groups if group.height != 1 and group is not child]
            return stacks[-1:]
        frame = self.holder.get(id(child)) if child is not None else None
        if child is not None and phrase.head in lexicon.DEMONSTRATIVES:
            return self.draft.groups[: self.draft.groups.index(child)][-1:]
        if frame is not None and frame.parents and frame.parents[0].count == 1 and phrase.head in ("them", "they"):
            # "A desk with two monitors and a keyboard in front of them".
            plural = [group for group in frame.members if group.count > 1 and group is not child]
            if plural:
                return plural[-1:]
        if frame is not None and frame.parents and frame.flank is None:
            central = [each.group for each in self.draft.sided if each.side == "centre" and each.group in frame.members]
            if central and child not in central:
                return central[-1:]
            if kind == "in" and not self.draft.is_a(frame.parents[0], lexicon.HOLLOW):
                # "A pan on a stove with two eggs in it".
                upon = [group for group in self.draft.groups if self.draft.support(group) is frame.parents[0]]
                hollow = [group for group in upon if group is not child and self.draft.is_a(group, lexicon.HOLLOW)]
                if hollow:
                    return hollow[-1:]
            return frame.parents[:1]
        if phrase.each or phrase.head in ("them", "they", "each"):
            plural = [
                group
                for group in self.draft.groups
                if group.count > 1 and group is not child and id(group) not in self.shared_out
            ]
            if plural:
                return plural[-1:]
        for options in (self.subject, self.before, self.draft.groups[::-1]):
            chosen = [group for group in options if group is not child and group not in children]
            if phrase.head in ("it", "its", "itself"):
                chosen = [group for group in chosen if group.count == 1 or group.height > 1] or (
                    chosen if options is not self.subject else []
                )
            if chosen:
                return chosen[:1]
        return []

    def climb(self, children: list[Group], link: Link, parent: Group) -> list[Group]:
        """From the nearest phrase to the one that the relation speaks of.

        "a cup holding pens on a desk" puts the cup on the desk; "a mug on a table next to a plate" the mug next to the
        plate; "a fork, a knife and a spoon on a plate" all three on the plate.
        """
        draft = self.draft
        supports = link.kind in SUPPORT_KINDS
        floor = draft.on_floor(parent)
        # "a mug, a pear on a plate and a lamp": the list goes on, so only the pear is on the plate.
        held = self.holder.get(id(children[-1])) if children else None
        if not supports and held is not None and held is self.holder.get(id(parent)):
            # "with a keyboard in front of it and a mouse beside the keyboard": the mouse is.
            for carrier in held.parents if draft.support(parent) is None else ():
                draft.forget_guess(children[-1], carrier)
            return children[-1:]
        ends = not self.more or self.top_joined
        if ends and len(self.top) > 1 and children[-1:] == self.top[-1:] and parent not in self.top:
            told = [edge.child for edge in draft.laterals]
            free = [group for group in self.top if group not in told or group in children]
            return [group for group in free if not (supports and draft.on_floor(group) and floor)] or children
        child = self._carrier(children[-1], link, parent)
        if child is not children[-1] and len(self.top) > 1 and child is self.top[-1]:
            return self.climb([child], link, parent)
        if not supports and not floor and draft.on_floor(child) and id(child) in self.carried:
            return self.carried[id(child)]
        return [child]

    def list_on(self, children: list[Group], parent: Group) -> list[Group]:
        """`children` and, where the last of a list is on a table, the rest of the list.

        "a crate, a loaf on a board and a bottle on a table" puts the crate and the board on the table too; in "a loaf
        on a board and a bottle on a table" each has its own place.
        """
        draft = self.draft
        earlier = [group for group in self.listed if group not in (self.listed[-1], parent)]
        bare = [
            group
            for group in earlier
            if draft.support(group) is None and not any(edge.child is group for edge in draft.laterals)
        ]
        whole = self.top_joined and self.listed[-1:] == children[-1:] and draft.is_table(parent)
        if not whole or not any(not draft.on_floor(group) for group in bare):
            return children
        chosen: list[Group] = []
        for group in (*earlier, *children):
            lowest = [group, *draft.ancestors(group)][-1]
            if not draft.on_floor(lowest) and lowest is not parent and lowest not in chosen:
                chosen.append(lowest)
        return chosen or children

    def list_of(self, children: list[Group], parent: Group) -> list[Group]:
        """`children` and, in "a napkin with a fork and a knife on it", what the list names before them."""
        frame = self.holder.get(id(children[-1])) if children else None
        if frame is None or not frame.closed or frame.parents[:1] != [parent]:
            return children
        draft = self.draft
        fixed = [edge.child for edge in (*draft.supports.values(), *draft.laterals) if not edge.weak]
        return [group for group in frame.members if group in children or group not in fixed]

    def _carrier(self, child: Group, link: Link, parent: Group) -> Group:
        """What carries `child` and is itself what `link` speaks of."""
        draft = self.draft
        supports = link.kind in SUPPORT_KINDS
        floor = draft.on_floor(parent)
        seen = [child]
        while not draft.on_floor(child) or (floor and not supports):
            frame = self.holder.get(id(child))
            if not supports and id(child) in self.carried and not frame and not floor:
                break
            if frame is None or not frame.parents or frame.flank or not frame.link.inverse:
                break
            above = frame.parents[0]
            # A prompt may list two groups in each other.
            if above is parent or above is parent.whole or above in seen:
                break
            if draft.on_floor(above) and (supports or not floor):
                break
            dish = draft.is_a(above, lexicon.DISHES) and not draft.is_a(parent, lexicon.LEVEL)
            if supports and not floor and (dish or draft.is_a(above, lexicon.LEVEL)):
                break
            if supports and (draft.supports.get(id(above)) is not None and not draft.supports[id(above)].weak):
                break
            child = above
            seen.append(child)
        return child

    def carry_all(self, link: Link, parent: Group) -> None:
        """Put everything that has no support yet on `parent`."""
        for group in self.draft.groups:
            loose = self.draft.support(group) is None and group not in self.draft.ancestors(parent)
            if loose and group is not parent:
                self.relate(group, link, parent)
        self.subject, self.last = [parent], [parent]

    def open_beside(self, link: Link, landmark: Group) -> None:
        """What is named next stands in relation `link` to `landmark`."""
        self.frames = [Frame(link=link, parents=[landmark])]

    def side_owner(self, group: Group, side: str) -> tuple[Group, Frame] | None:
        """The listed group that "on the other side" speaks of, from the innermost list outwards."""
        member: Group | None = group
        found: list[tuple[Group, Frame]] = []
        while member is not None and (frame := self.holder.get(id(member))) is not None and len(found) < 8:
            found.append((member, frame))
            member = frame.parents[0] if frame.parents else None
        flanked = [(each, frame) for each, frame in found if frame.flank is not None]
        if flanked:
            return flanked[0]
        if side in ("other", "right"):
            for each, frame in found:
                if any(told.group in frame.members and told.group is not each for told in self.draft.sided):
                    return each, frame
        return found[0] if found else None
