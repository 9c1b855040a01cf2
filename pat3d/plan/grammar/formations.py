"""What several objects form together: stacks, rows, towers, an order from left to right."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.chunks import Chunk
from pat3d.plan.grammar.context import Context
from pat3d.plan.grammar.draft import Group
from pat3d.plan.grammar.ellipsis import TOWER


class Formations:
    """Arranges the groups of one prompt."""

    def __init__(self, now: Context) -> None:
        self._now = now
        self.read: list[Group] = []
        """Every group, in the order in which it was last spoken of."""
        self._ordered = ""
        """What stands before the list that it orders: "from left to right"."""
        self._unordered = 0
        """Groups that were read before it."""

    def end_clause(self) -> None:
        """Order the list that "from left to right" stood before."""
        if self._ordered:
            self._line_up(self.read[self._unordered :], self._ordered)
        self._ordered = ""

    def arrange(self, piece: Chunk, follower: Chunk, *, verb: bool) -> None:
        """Read what a list or a group forms: a stack, a row, a tower of what the list names.

        Args:
            piece: the chunk that says so.
            follower: the chunk after it.
            verb: whether a verb stands before it, so that it is said of the subject.
        """
        groups = self._now.subject if verb else self._now.last or self._now.subject
        fronted = follower.kind in ("phrase", "there") or (follower.link is not None and follower.text == ":")
        whole = groups[-1:] if len(groups) == 1 and groups[0].count > 1 else []
        if piece.text in ("rows", "stacks"):
            whole = [group for group in (*groups, *self._now.subject) if group.count > 1][:1]
            if not whole:
                self._now.draft.notes.append(f'"{piece.size} {piece.text}": of what is not said.')
                return
            self._now.maker.recount(whole[0], piece.size * piece.each)
            if piece.text == "rows":
                whole[0].rows = piece.size
            else:
                whole[0].height = -(-whole[0].count // piece.size)
        elif piece.text == TOWER:
            self._stack(self.read[-piece.size :], tall=True)
        elif piece.text == "stack":
            self._stack(whole or (groups if verb else self._now.top), tall=bool(whole))
        elif piece.text in ("order", "reverse") and (fronted or not groups):
            self._ordered, self._unordered = piece.text, len(self.read)
        elif whole:
            whole[0].rows = 1
        else:
            self._line_up(self._now.top if len(self._now.top) > 1 else self._listed(groups), piece.text)

    def _stack(self, groups: Sequence[Group], *, tall: bool) -> None:
        """Put each of `groups` on the one before, or where they are several objects each on one another."""
        for group in groups:
            if group.height == 1 and (tall or all(each.count > 1 for each in groups)):
                group.height = group.count
        if tall or any(each.count == 1 for each in groups):
            for lower, upper in zip(groups, groups[1:], strict=False):
                self._now.draft.place(upper, "on", lower)

    def _listed(self, groups: Sequence[Group]) -> list[Group]:
        frame = self._now.holder.get(id(groups[-1])) if groups else None
        return frame.members if frame is not None else list(groups)

    def _line_up(self, groups: Sequence[Group], how: str) -> None:
        ordered = groups[::-1] if how == "reverse" else groups
        for left, right in zip(ordered, ordered[1:], strict=False):
            if how == "beside":
                self._now.draft.beside(right, "next_to", left)
            else:
                self._now.draft.beside(left, "left_of", right)
