"""Verbs that are names as well, as other verbs: of "so that you can reach it" no can is made.

A name has an article, a number or a word of kind before it, or stands where only a thing does: "the can you see",
"can on a tray".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import is_number
from pat3d.plan.grammar.words.vocabulary import Nouns

_OTHERWISE = {"can": "could", "throw": "toss", "swing": "turn", "mop": "wash", "matches": "fits"}
_DOERS = frozenset({"i", "you", "we", "they", "he", "she", "it", "everyone", "someone", "anyone", "somebody"})
_ASKING = frozenset({"what", "where", "how", "who", "which", "that", "there"})
_BEING = frozenset({"be", "not", "also", "only", "still", "never", "easily", "then"})
_JOINING = frozenset({"", "and", "but", "so", "or", "then", "please"})
_AWAY = frozenset({"away", "out", "back", "off", "open", "shut"})


def without_names_of_verbs(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of a prompt with "can you help" as "could you help", where "can" names no can."""
    return [
        replace(token, text=_OTHERWISE[token.text]) if token.text in _OTHERWISE and _acts(tokens, at, nouns) else token
        for at, token in enumerate(tokens)
    ]


def _acts(tokens: Sequence[Token], at: int, nouns: Nouns) -> bool:
    """Whether token `at`, which may be a name, is a verb where it stands."""
    word, follower = tokens[at].text, tokens[at + 1].text
    before = "" if not at or tokens[at - 1].mark else tokens[at - 1].text
    led = before in lexicon.DETERMINERS - _ASKING | lexicon.POSSESSIVES or is_number(before) or is_modifier(before)
    if led or (before and nouns.match([before, word])) or nouns.match([word, follower]):
        return False
    known = follower in lexicon.DETERMINERS | lexicon.POSSESSIVES | {"it", "them"}
    if word == "can":
        if before in _JOINING:
            return follower in _DOERS or (before in ("", "please") and known) or (before != "" and follower in _BEING)
        owner = tokens[at - 2].text if before in _ASKING else before
        if link_at(tokens, at - 1 - (owner != before)) or known_verb(owner) or owner in _AWAY | {"up", "down"}:
            return False
        does = tokens[at + 1].text.isalpha() and not link_at(tokens, at + 1) and nouns.match([follower]) is None
        does = (does and before in _ASKING) or follower in _BEING or known_verb(follower)
        return does or (before in _DOERS and tokens[at - 2].text != "if")
    if word == "matches":
        return before not in _JOINING and not link_at(tokens, at - 1) and (known or follower in ("up", "with"))
    if before not in _JOINING | _DOERS | lexicon.MODALS | {"to"}:
        return False
    goal = {"to", "into", "in", "onto"} & {token.text for token in tokens[at + 2 : at + 5]}
    bare = word == "throw" and before == "" and bool(goal) and not (tokens[at + 1].mark or link_at(tokens, at + 1))
    return bare or follower in _AWAY or (known and (word == "swing" or before not in _JOINING))
