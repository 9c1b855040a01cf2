"""Who is told and where it is seen, before what is told: "Robot, put the cup away", "Task: ...", "In the photo, ...".

The robot that is told is no object of the scene, and the picture that shows it is none either.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import FILLERS, known_verb
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.vocabulary import Nouns

_TOLD = frozenset({"robot", "bot", "assistant", "agent", "machine"})
_HAILING = frozenset({"hi", "hello", "hey", "dear", "ok", "okay", "alright"})
_TIMES = frozenset({"morning", "afternoon", "evening", "day"})
_ALL = frozenset({"there", "everyone", "everybody", "all", "team", "folks", "friend", "buddy"})
"""Who is hailed besides by a name."""
_ASKING = frozenset({"please", "kindly", "now", "then", "carefully", "gently", "can", "could", "would", "will", "i"})
_NOBODY = lexicon.GREETINGS | lexicon.BACKGROUND | lexicon.NUMBERS.keys() | FILLERS | {
    "outside", "inside", "indoors", "outdoors", "upstairs", "downstairs", "there", "here", "nearby", "task",
}  # fmt: skip
"""First words before a comma that are not spoken to."""
_CARRYING = (lexicon.FLOOR, lexicon.LEVEL, vessels.HOLLOW, lexicon.DISHES)
_LEADING = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys()
_LABELS = frozenset({"task", "instruction", "command", "request", "order", "goal", "objective", "step", "mission"})
_PICTURES = frozenset({"picture", "photo", "image", "photograph", "scene"})
_SEERS = frozenset({"i", "we", "you", "one"})
_SHOWN = frozenset({"this", "the", "our", "a"})


def unaddressed(text: str, told: Sequence[Sequence[Token]], nouns: Nouns) -> tuple[list[list[Token]], list[str]]:
    """The sentences `told` of `text` without whom they are said to and the picture they are of; and what was left out.

    "In the photo" stays where a sentence before names a photo, and so does everything where nothing else is said.
    """
    made: list[list[Token]] = []
    aside: list[str] = []
    for sentence in told:
        before = {token.text for each in made for token in each}
        spoken = _without_person(text, sentence, nouns)
        plain = _unpictured(_without_label(_without_name(spoken)), before, nouns) if len(spoken) > 1 else spoken
        kept = {token.start for token in plain}
        away = [token for token in sentence if token.start not in kept and not token.mark]
        aside += [text[away[0].start : away[-1].end]] if away else []
        if len(plain) > 1:
            made.append(plain)
    return (made, aside) if made else ([list(sentence) for sentence in told], [])


def _without_person(text: str, tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of `text` with "hi Tom, put the cup away" as "put the cup away", and so without "Tom," alone."""
    words = [token.text for token in tokens]
    good = 2 if words[0] == "good" and words[1] in _TIMES else 0
    at = next(n for n in range(good, len(words)) if words[n] not in (*_HAILING, ","))
    after = at + 1
    if not tokens[min(after, len(tokens) - 1)].mark or tokens[at].mark:
        return list(tokens)
    if not at and _endeared(tokens, nouns):
        return list(tokens[2:])
    name = text[tokens[at].start : tokens[at].end]
    known = nouns.match([words[at]]) is not None or is_modifier(words[at]) or known_verb(words[at])
    person = name[:1].isupper() and name[1:].islower() and not known and not words[at].endswith("ly")
    hailed = at > 0 and (person or words[at] in _ALL)
    asked = person and words[at] not in FILLERS | _TOLD | _LABELS and words[after] != "."
    asked = asked and _commands(words[after + 1 :])
    rest = tokens[after + (words[after] != ".") :]
    return list(rest) if hailed or asked else list(tokens)


def _endeared(tokens: Sequence[Token], nouns: Nouns) -> bool:
    """Whether `tokens` begin with whom they are said to: "Honey, your keys are on the table", "Sugar, move the cup".

    "Honey, bread and a knife are on the table" lists, and "desk, a lamp is on the left" says where the lamp is.
    """
    words = [token.text for token in tokens]
    name = nouns.match(words[:1])
    no_one = words[0] in _NOBODY or words[0].endswith("ly") or link_at(tokens, 0)
    if name is not None:
        no_one = no_one or name.plural or any(nouns.of_class(name.noun, table) for table in _CARRYING)
    if len(words) < 6 or words[1] != "," or no_one or (name is None and is_modifier(words[0])):
        return False
    if words[3] in _LEADING | {"me"} and known_verb(words[2]):
        return True
    asked = words[2] in lexicon.MODALS and words[3] == "you"
    ends = (n for n in range(3, len(words)) if words[n] in FINITE or tokens[n].mark or words[n] == "and")
    told = words[2] in _LEADING | {"there"} and words[next(ends, 0)] in FINITE
    return asked or (told and not lexicon.PRONOUNS & {*words})


def _without_name(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` without "hey robot," in front of what it is to do, and without ", robot" behind it."""
    words = [token.text for token in tokens]
    at = _greeted(words)
    named = at + (words[at] in _TOLD)
    end = named + (words[named] in (",", ":") and named > 0)
    hailed = bool(at) and words[0] in _HAILING and len(words) < at + 4
    if end and (words[end] == "." or (hailed and words[-1] == "." and not any(map(known_verb, words[:-1])))):
        # "Hello! Put the cup away.", "Hello, kitchen robot. Put the cup away."
        return [tokens[-1]]
    if named > at and _commands(words[end:]) and (end > named or at):
        return _without_name_behind(tokens[end:])
    if 0 < at == named and words[0] not in ("so", "now", "right") and "," in words[1:end]:
        # "Okay, now put the cup away."
        return _without_name_behind(tokens[end:])
    return _without_name_behind(tokens)


def _without_name_behind(tokens: Sequence[Token]) -> list[Token]:
    words = [token.text for token in tokens]
    behind = len(words) > 4 and words[-3] == "," and words[-2] in _TOLD and _commands(words)
    return [*tokens[:-3], tokens[-1]] if behind else list(tokens)


def _greeted(words: Sequence[str]) -> int:
    """The word after "okay, hey" that `words` begin with."""
    at = 0
    while words[at] in lexicon.GREETINGS:
        at += 1 + (words[at + 1] == "," and words[at + 2] in lexicon.GREETINGS | _TOLD)
    return at


def _commands(words: Sequence[str]) -> bool:
    """Whether `words` tell somebody what to do, or ask for it."""
    at = next((n for n, word in enumerate(words) if word not in _ASKING | {"you", ","}), 0)
    return known_verb(words[at]) or (words[0] in _ASKING - {"i"} and at > 1)


def _without_label(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` without "task:" and "step 2:" in front of what is to be done."""
    words = [token.text for token in tokens]
    at = int(words[0] in ("the", "your", "next", "first"))
    at += int(words[at] in _LABELS)
    numbered = words[at - 1] == "step" and (words[at].isdecimal() or words[at] in lexicon.NUMBERS)
    at += int(numbered)
    labelled = at > 0 and words[at - 1 - numbered] in _LABELS and words[at] == ":"
    return list(tokens[at + 1 :]) if labelled and _commands(words[at + 1 :]) else list(tokens)


def _unpictured(tokens: Sequence[Token], before: set[str], nouns: Nouns) -> list[Token]:
    """`tokens` with "in the picture, a bowl is on a mat" as "a bowl is on a mat"; nothing where a picture is an object.

    "In this picture we see a bowl" is "there is a bowl"; "in the picture" may stand behind it.
    """
    words = [token.text for token in tokens]
    if len(words) > 5 and words[0] == "in" and words[1] in _SHOWN and words[2] in _PICTURES - before:
        at = 3 + (words[3] in (",", ":"))
        end = at + 1 + (words[at + 1] == "could")
        if words[at] in _SEERS and words[end] in ("see", "find"):
            return [replace(tokens[end], text="there"), replace(tokens[end], text="is"), *tokens[end + 1 :]]
        if words[3] in ("is", "are") and _begins(words[4], nouns):
            return [replace(tokens[3], text="there"), replace(tokens[3], text="is"), *tokens[4:]]
        if words[at] == "there" or (_begins(words[at], nouns) and words[2] != "scene"):
            return list(tokens[at:])
    behind = len(words) > 6 and words[-4] == "in" and words[-3] in ("this", "the") and words[-2] in _PICTURES - before
    return [*tokens[:-4], tokens[-1]] if behind else list(tokens)


def _begins(word: str, nouns: Nouns) -> bool:
    """Whether `word` begins a phrase that names something."""
    leads = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys() | lexicon.VAGUE.keys()
    plural = bool(singulars(word)) and nouns.match([word]) is not None
    return word in leads or word.isdecimal() or plural
