"""Parts of a sentence without which the rest of it is read: "before it burns", "but leave out the knives"."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Span, Token

_CONDITIONS = frozenset({"if", "unless", "whichever", "whenever", "provided", "when"})
"""Words that open what only may be so."""
_OPENING = _CONDITIONS | {
    "before", "after", "while", "since", "because", "so", "until", "till", "although", "though", "wherever", "where",
    "except", "excluding", "apart", "but", "whereas", "once", "instead", "without",
}  # fmt: skip
"""Words that open a part of a sentence that is said of the rest."""
_COUNTING = frozenset({"all", "every", "each", "none", "neither", "either", "or"})
"""Words without which it is another number that is told of."""


def unread_spans(tokens: Sequence[Token], number: int, *, instructed: bool, opened: bool) -> list[Span]:
    """What may be left unread of `tokens` of one sentence so that word `number` of the prompt is, shortest first.

    What a comma sets off is so of what is `instructed` alone: "three pots, the smallest in the largest" tells of pots.
    Of a question that is `opened` it is what only may be so: "if you can".
    """
    words, last = [token.text for token in tokens], len(tokens) - 1
    fault = next((at for at, token in enumerate(tokens) if token.number == number and not token.mark), -1)
    opening = _CONDITIONS if opened else _OPENING | lexicon.RELATIVES
    made: set[Span] = set()
    for at in range(last):
        opens = words[at] in opening and not any(link_at(tokens, n) == at - n for n in range(max(0, at - 4), at))
        if not opens and not (instructed and not opened and words[at] in (",", "and", "then")):
            continue
        # "Before it rains, put ...": its comma goes with it.
        deeds = [n for n in range(at + 1, last) if words[n] == "and" and known_verb(words[n + 1])]
        # "... that was not rinsed into the box"
        ends = [n for n in range(at + 1, last + 1) if tokens[n].mark or n in deeds or words[n] in ("into", "onto")]
        ends = ends if at else [end + 1 for end in ends if words[end] == ","]
        start = at
        while start and opens and words[start - 1] in _OPENING | {",", "and", "then"}:
            # "... so that there are six"
            start -= 1
        # "A dog that doesn't sit on the sofa" is not of a dog and a sofa.
        places = [
            n for n in range(at, last) if words[at] in lexicon.RELATIVES and not instructed and link_at(tokens, n)
        ]
        ends = [end for end in ends if not any(n < end for n in places)]
        made |= {(start, end) for end in ends if fault < 0 or start <= fault < end}
    kept = [span for span in made if not {*words[slice(*span)]} & _COUNTING and span[1] - span[0] > 1]
    return sorted(kept, key=lambda span: (span[1] - span[0], span))
