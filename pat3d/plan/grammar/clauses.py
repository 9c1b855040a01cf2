"""What the chunks ahead say about the clause being read."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.chunks import Chunk


def starts_clause(chunks: Sequence[Chunk], at: int) -> bool:
    """Whether the phrase at chunk `at` is the subject of a verb of its own."""
    after = at + 1
    while after + 1 < len(chunks) and chunks[after].kind == "link":
        if _finite(chunks[after]):
            return True
        after += 2 if chunks[after + 1].kind == "phrase" else 1
    return after < len(chunks) and (chunks[after].kind == "verb" or _finite(chunks[after]))


def lists_on(chunks: Sequence[Chunk], at: int) -> bool:
    """Whether from chunk `at` on the clause lists a phrase after "and" that has no verb of its own."""
    while at + 1 < len(chunks) and chunks[at].kind not in ("stop", "clause", "verb", "there", "dash"):
        if _finite(chunks[at]):
            return False
        if chunks[at].kind == "and" and chunks[at + 1].kind == "phrase":
            return not starts_clause(chunks, at + 1)
        at += 1
    return False


def names_second(chunks: Sequence[Chunk], at: int) -> bool:
    """Whether chunks `at` to `at` + 2 end the relation before them with a second phrase: "and a chair."."""
    kinds = [piece.kind for piece in chunks[at : at + 3]]
    return kinds[:2] == ["and", "phrase"] and kinds[2:] not in (["link"], ["side"], ["verb"], ["there"])


def only_describes(chunks: Sequence[Chunk], at: int) -> bool:
    """Whether the headless phrase at chunk `at` ends a list that tells members apart: "one white and one beige"."""
    listed = chunks[max(at - 3, 0) : at]
    if len(listed) < 2 or listed[-1].kind not in ("and", "comma"):
        return False
    before = listed[-2].phrase
    target = len(listed) == 3 and listed[0].kind == "link"
    return before is not None and before.kind == "pieces" and not target


def precedes_phrase(chunks: Sequence[Chunk], at: int) -> bool:
    """Whether what the relation at chunk `at` is said of comes next: "behind, a ball", "in front there is a ball"."""
    kinds = [piece.kind for piece in chunks[at + 1 : at + 3]]
    return kinds[:1] == ["there"] or kinds in (["comma", "there"], ["comma", "phrase"])


def _finite(piece: Chunk) -> bool:
    return piece.link is not None and piece.link.finite
