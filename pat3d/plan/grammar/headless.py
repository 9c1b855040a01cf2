"""Phrases without a noun of their own: members of a group, parts, bare colours."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.chunks import Chunk
from pat3d.plan.grammar.clauses import only_describes
from pat3d.plan.grammar.context import Context
from pat3d.plan.grammar.draft import Group
from pat3d.plan.grammar.groups import recolour
from pat3d.plan.grammar.phrases import Phrase


def members_told(now: Context, chunks: Sequence[Chunk], at: int) -> Group | None:
    """The members that the headless phrase at chunk `at` ("one" on a plate) speaks of; None where it only describes."""
    phrase = chunks[at].phrase
    follower = chunks[at + 1]
    placed = follower.kind in ("side", "verb") or (follower.link is not None and follower.link.manner != "of")
    if phrase is None or not placed or only_describes(chunks, at):
        return None
    if follower.link is not None and follower.link.manner == "sides":
        # "Two lamps, one on each side of the bed": the members are all told of at once.
        return next((group for group in (*now.last, *now.subject) if group.count > 1), None)
    return now.maker.members.told(phrase, [*now.last, *now.subject, *now.before, *now.draft.groups[::-1]])


def describe_owner(now: Context, phrase: Phrase) -> None:
    """A part ("with red covers") or bare colours ("one white and one beige") describe what was read before."""
    frame = now.frames[-1] if now.frames and now.frames[-1].fresh else None
    owners = frame.parents if frame else now.last or now.subject
    if not owners:
        now.draft.set_aside.append(phrase.words)
        return
    owner = owners[-1]
    if phrase.kind == "pieces" and phrase.count is not None and owner.count == 1:
        plural = [*now.carried.get(id(owner), ()), *now.subject]
        owner = next((group for group in plural if group.count > 1), owner)
    if phrase.kind == "pieces" and not phrase.said:
        now.maker.tell_apart(owner, phrase)
    elif phrase.modifiers.colours or phrase.modifiers.palette:
        recolour(owner, phrase.modifiers, part=phrase.said)
    if frame:
        frame.fresh = bool(frame.link.manner == "hold")
        now.last = [owner]
