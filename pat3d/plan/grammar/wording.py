"""A prompt's tokens in plainer words, before phrases are looked for; and what a scene cannot be told by.

"First stack three bowls" becomes "three stacked bowls", "should be on" becomes "is on". An instruction to a robot and
a negation describe no scene: they are refused with what would.
"""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.errors import PromptError
from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.arrangements import of_what
from pat3d.plan.grammar.boundaries import link_at
from pat3d.plan.grammar.lexing import Token
from pat3d.plan.grammar.vocabulary import Nouns

_INSTRUCTIONS = frozenset({
    "pick", "grasp", "grab", "open", "close", "turn", "push", "pull", "pour", "sort", "lift", "remove", "take", "fetch",
    "bring", "wipe", "clean", "wash", "cook", "slide", "rotate", "flip", "unstack", "press", "switch", "find", "throw",
    "hand", "serve", "heat", "cut", "slice", "fold", "unfold", "empty", "shake", "stir", "plug", "assemble", "navigate",
    "go", "walk", "reach", "drag", "transfer", "carry", "swap", "retrieve", "unload", "scoop", "toss", "touch",
    "collect", "gather", "tidy", "grip", "release", "pack", "unpack", "separate",
})  # fmt: skip
"""Verbs that open an instruction: what a robot is to do, not where things are."""
_ACTORS = frozenset({"robot", "arm", "gripper", "agent", "manipulator", "you", "hand"})
_MODALS = frozenset({"should", "must", "shall", "will", "can", "could", "may", "might", "would"})
_ARRANGING = frozenset({
    "move", "lay", "position", "fill", "stand", "hang", "lean", "leave", "balance", "drop", "stack", "pile", "scatter",
    "spread", "stick", "keep", "insert", "store", "distribute", "rest", "center", "centre", "line", "align", "sit",
})  # fmt: skip
"""Verbs that tell where something is by telling to put it there."""
_LEFT_STANDING = {"hang": "hanging", "lean": "leaning", "fill": "filled"}
"""What an arranging verb leaves before the relation: "hang a mug on a hook" is "a mug hanging on a hook"."""
_IN_ORDER = frozenset({"first", "firstly", "second", "secondly", "third", "lastly", "afterwards", "afterward", "last"})
_NEGATIONS = frozenset({"not", "never", "neither", "nor", "isn't", "aren't", "don't", "doesn't", "cannot", "can't"})


def plainer(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` in plainer words.

    Raises:
        PromptError: the prompt instructs a robot, or says what is not there.
    """
    kept: list[Token] = []
    waiting: list[Token] = []
    """Words to go after the determiner and number that follow."""
    standing: list[Token] = []
    """Words to go before the relation that follows."""
    tokens = of_what(tokens)
    for at, token in enumerate(tokens[:-1]):
        follower = tokens[at + 1]
        opens = not kept or kept[-1].mark or kept[-1].text in ("and", "then", "please", "now", "next", "finally", "but")
        before = kept[-1].text if kept else ""
        if waiting and not _leads(token):
            kept, waiting = [*kept, *waiting], []
        if standing and link_at(tokens, at):
            kept, standing = [*kept, *standing], []
        if token.text in _NEGATIONS:
            raise PromptError(
                f'"{token.text}" (word {token.number}): a prompt says what is there, not what is not. Say where things '
                "are, and leave the rest out."
            )
        if token.text in _MODALS and follower.text == "be" and before not in ("", "."):
            continue
        if token.text == "can" and before in ("you", "we", "i") and follower.text in lexicon.COMMANDS:
            continue
        if before in _ACTORS and _obliges(before, token, follower):
            raise _instruction(tokens[at + 1 if follower.text != "to" else at + 2])
        if not opens or nouns.match([token.text, follower.text]):
            kept.append(token)
            continue
        if token.text in _IN_ORDER and (
            follower.mark or follower.text in lexicon.COMMANDS | _ARRANGING or _leads(follower)
        ):
            continue
        told = _leads(follower) or follower.text in lexicon.PRONOUNS
        if token.text in _INSTRUCTIONS and (told or follower.text in ("up", "on", "off", "out", "down")):
            raise _instruction(token)
        if token.text in _ARRANGING and told:
            if token.text in lexicon.STACK_NOUNS:
                kept, waiting = _stacked(tokens, at, kept)
            elif token.text in _LEFT_STANDING:
                standing = [_said(_LEFT_STANDING[token.text], token)]
            continue
        kept.append(token)
    return [*kept, *waiting, tokens[-1]]


def _obliges(actor: str, token: Token, follower: Token) -> bool:
    """Whether "the robot should sort" begins here; "you can see" and "a robot has a hat" do not."""
    if token.text in ("needs", "has", "have"):
        return follower.text == "to"
    modals = _MODALS if actor != "you" else {"should", "must"}
    return token.text in modals and not follower.mark


def _leads(token: Token) -> bool:
    """Whether `token` is a determiner or a number."""
    words = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys() | lexicon.VAGUE.keys()
    return token.text in words or token.text.isdecimal()


def _stacked(tokens: Sequence[Token], at: int, kept: list[Token]) -> tuple[list[Token], list[Token]]:
    """The verb "stack" at token `at` as "a stack of" before a list, else as "stacked" before the noun."""
    verb, after = tokens[at], at + 1
    while not link_at(tokens, after) and tokens[after].text not in (".", "and", ","):
        after += 1
    words = ("a", "stack", "of") if tokens[after].text in ("and", ",") else ("stacked",)
    made = [_said(word, verb) for word in words]
    return ([*kept, *made], []) if len(made) > 1 else (kept, made)


def _said(word: str, instead: Token) -> Token:
    return Token(text=word, start=instead.start, end=instead.end, number=instead.number)


def _instruction(verb: Token) -> PromptError:
    return PromptError(
        f'"{verb.text}" (word {verb.number}) tells a robot what to do; a prompt tells where things are: "three cans '
        'and a bottle in a bin".'
    )
