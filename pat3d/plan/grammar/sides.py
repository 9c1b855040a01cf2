"""Places told without a landmark: "on the left", "to the right", "behind", "nearby"."""

from __future__ import annotations

from pat3d.plan.grammar.context import Context
from pat3d.plan.grammar.draft import Group, Sided
from pat3d.plan.grammar.links import Link, Side
from pat3d.scene.model import SUPPORT_KINDS

_HALVES: dict[str, Side] = {"left": "left", "right": "right", "centre": "centre"}
_BOTH = Link(manner="sides", kind="next_to")
_DEPTHS = {"in_front_of": "front", "behind": "back"}


class Sides:
    """Finds what a place without a landmark is related to.

    In this order: what the list is a list of ("a plate with a fork on the left"), the landmark of the same sentence
    ("a fork to the left of a plate, a knife to the right"), what is said to be on another side ("a mug on the left, a
    bowl on the right"), and what the sentence or the one before it begins with ("a tower of blocks, and a ball to the
    right").
    """

    def __init__(self, now: Context) -> None:
        self._now = now
        self._leading = ""
        """The side of what the clause is going to name."""

    def end_clause(self) -> None:
        """A side said in front holds for its clause only."""
        self._leading = ""

    def lead(self, side: str) -> None:
        """Read a side in front of what is there: "on the left, there is a mug"."""
        landmark = self._now.landmark
        if side == "both":
            if self._now.before:
                self._now.open_beside(_BOTH, self._now.before[0])
        elif landmark is not None and side in ("left", "right", "centre"):
            self._now.open_beside(self._of_landmark(side), landmark)
        else:
            self._leading = side

    def lead_with(self, link: Link) -> None:
        """Read "behind, a ball": of what the clause before is said of."""
        draft, before = self._now.draft, self._now.before
        edge = draft.laterals[-1] if draft.laterals else None
        landmark = edge.parent if edge is not None and edge.child in before else next(iter(before), None)
        if landmark is not None:
            self._now.open_beside(link, landmark)

    def follow(self, group: Group) -> None:
        """`group` was named in a clause; a side may stand in front of it."""
        if self._leading:
            self._say(group, self._leading, self._now.before[0] if self._now.before else None)

    def trail(self, side: str, groups: list[Group]) -> None:
        """Read a side after what is there: "a mug on the left"."""
        for group in groups[-1:]:
            owner = self._now.side_owner(group, side)
            if side == "both":
                _, begun = self._children(group)
                parents = owner[1].parents if owner is not None else [*begun, *self._now.before]
                for parent in parents[:1]:
                    self._now.relate(group, _BOTH, parent)
                continue
            if owner is None:
                self._beside_landmark(side, group)
                continue
            member, frame = owner
            if frame.flank is not None:
                frame.flank.sides[id(member)] = side
            else:
                self._now.draft.sided.append(Sided(group=member, side=side, owner=frame.parents[0]))

    def _beside_landmark(self, side: str, group: Group) -> None:
        now = self._now
        children, begun = self._children(group)
        since = now.sentence - now.landmark_sentence
        landmark = now.landmark if since == 0 or (since == 1 and not begun) else None
        implied = [*begun, *now.before]
        for child in children:
            if landmark is not None and landmark not in children and side in ("left", "right", "centre"):
                now.relate(child, self._of_landmark(side), landmark)
            else:
                self._say(child, side, implied[0] if implied else None, begun=bool(begun))

    def _of_landmark(self, side: str) -> Link:
        if self._now.landmark_is_surface or side == "centre":
            return Link(manner="half", kind="on", side=_HALVES[side])
        return Link(kind="left_of" if side == "left" else "right_of")

    def _say(self, group: Group, side: str, implied: Group | None, *, begun: bool = False) -> None:
        self._now.draft.sided.append(Sided(group=group, side=side, implied=implied, begun=begun))

    def _children(self, group: Group) -> tuple[list[Group], list[Group]]:
        """What the place is said of, of a list that ends in `group`, and what the clause begins with."""
        now, draft = self._now, self._now.draft
        listed = now.top if now.top[-1:] == [group] else [group]
        related = {id(each.group) for each in draft.sided} | {id(edge.child) for edge in draft.laterals}
        related |= draft.supports.keys() | {id(edge.parent) for edge in (*draft.laterals, *draft.supports.values())}
        related |= {id(each.implied) for each in draft.sided if each.begun}
        children = [each for each in listed if each is group or id(each) not in related]
        begun = [each for each in now.subject if each not in children]
        if not begun and len(listed) > len(children):
            begun = [each for each in listed if each not in children]
        if not begun and len(children) > 1 and not now.before:
            return children[1:], children[:1]
        return children, begun

    def without_landmark(self, link: Link) -> None:
        """Read "with a cat on top", "and a bowl nearby": a relation with nothing after it."""
        now, draft = self._now, self._now.draft
        for group in now.last[-1:]:
            frame = now.holder.get(id(group))
            if frame is not None:
                parent = frame.parents[0] if frame.parents else None
                others = [each for each in frame.members if each is not group]
                lateral = link.kind is not None and link.kind not in SUPPORT_KINDS
                if parent and lateral and others and draft.is_table(parent) and not draft.on_floor(group):
                    parent = others[0]
                children = [group]
            else:
                children, begun = self._children(group)
                parent = next(iter([*begun, *now.before]), None)
            if parent is None and link.kind in _DEPTHS:
                self._say(group, _DEPTHS[link.kind], None)
            elif parent is None:
                draft.notes.append(f'"{group.phrase}": what it is {link.kind or link.manner} is not said.')
            for child in children if parent is not None else ():
                if parent is not None and parent is not child:
                    now.relate(child, link, parent)

    def claimed(self, child: Group, link: Link) -> Link:
        """`link`, or for the mug of "a mug on the left and a bowl on the right of a plate" its own side."""
        draft = self._now.draft
        own = next((each for each in draft.sided if each.group is child and each.owner is None), None)
        side = {"left_of": "left", "right_of": "right"}.get(link.kind or "")
        if own is None or own.side not in ("left", "right", "centre") or not (side or link.manner == "half"):
            return link
        draft.sided.remove(own)
        half = link.manner == "half"
        if half or own.side == "centre":
            return Link(manner="half", kind="on", side=_HALVES[own.side])
        return Link(kind="left_of" if own.side == "left" else "right_of")
