"""Talk before the scene or the request begins: "I'm hosting a party. Put the rose in the vase." is the second alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_modifier, looks_like_adjective
from pat3d.plan.grammar.words.unmade import is_quality, makes_nothing
from pat3d.plan.grammar.words.vocabulary import Nouns

_SPEAKERS = frozenset({"i", "we", "i'm", "we're", "i've", "we've"})
_PEOPLE = frozenset({"friend", "friends", "guest", "guests", "mother", "father", "mom", "dad", "wife", "husband",
    "family", "parents", "sister", "brother", "boss", "colleague", "colleagues", "neighbor", "neighbour", "roommate",
    "son", "daughter"})  # fmt: skip
_ABOUT_NOW = frozenset({"it's", "today", "tonight", "tomorrow", "today's", "tonight's"})
"""First words of what tells of the day."""
_IMAGINING = frozenset({"picture", "imagine", "envision", "visualize", "visualise"})
_SAYING = (["it", "is"], ["it", "'s"], ["here", "is"], ["here", "'s"], ["help", "me"], ["be", "careful"])
_BEING = frozenset({"am", "are", "is", "'s", "'re", "i'm", "we're", "feel", "feeling", "was", "were"})
_WITHOUT_ARTICLE = frozenset({"having", "drinking", "eating", "serving", "making"})
_TIMES = frozenset({"today", "tomorrow", "tonight", "monday", "tuesday", "wednesday", "thursday", "friday", "saturday",
    "sunday", "exam", "interview"})  # fmt: skip
_HEAPS = frozenset({"stuff", "clutter", "mess", "salad", "groceries", "ingredients", "supplies"})
"""Words for several things that are no meal."""
_REFERRING = lexicon.PRONOUNS | {"one", "ones", "this", "that", "these", "those"}


def without_talk(told: Sequence[list[Token]], nouns: Nouns) -> tuple[list[list[Token]], list[tuple[Token, Token]]]:
    """The sentences `told` without those before the first that names a thing, and the ends of each left out.

    So is the heading of "Tea for two: a pot and two cups", behind which a list says what is there.
    """
    talk: list[tuple[Token, Token]] = []
    told = [each for sentence in told for each in _imagined(sentence, nouns)]
    for sentence, follower in zip(told, told[1:], strict=False):
        if not (_is_talk(sentence, nouns) and _names_something(follower, nouns)):
            break
        talk.append((sentence[0], sentence[-2]))
    denials = [each for each in told[len(talk) + 1 :] if _is_denial(each)]
    kept = [each for each in told[len(talk) :] if each not in denials]
    talk += [(each[0], each[-2]) for each in denials]
    for at, sentence in enumerate(kept):
        if colon := _heading(sentence):
            talk.append((sentence[0], sentence[colon - 1]))
            kept[at] = sentence[colon + 1 :]
    return kept, talk


def _is_denial(sentence: Sequence[Token]) -> bool:
    """Whether `sentence` only says what those told of before are not: "They are not made of glass"."""
    words = [token.text for token in sentence]
    denies = words[0] in ("it", "they", "these", "this") and {"not", "isn't", "aren't"} & {*words[1:3]}
    placed = any(link_at(sentence, n) and words[n] != "of" for n in range(2, len(words) - 1))
    return bool(denies) and "but" not in words and not placed


def _heading(sentence: Sequence[Token]) -> int:
    """The colon behind the meal or the drink that `sentence` begins with, for whoever it is; 0 without.

    "Tea for two: a cup each" says how many there are; "like at a usual breakfast:" is one too.
    """
    words = [token.text for token in sentence]
    colon = words.index(":") if ":" in words else 0
    like = words[0] in ("like", "as")
    head = like + (like and words[1] in ("at", "in", "for"))
    head += words[head] in ("a", "an", "the", "our", "my")
    while head < colon - 1 and (is_modifier(words[head]) or looks_like_adjective(words[head])):
        head += 1
    if colon <= head:
        return 0
    served = words[head] in lexicon.MEALS - _HEAPS or (words[head] in lexicon.SUBSTANCES and not head)
    shared = {"each", "every", "apiece", "per", "both"} & {*words[colon:]}
    plain = colon == head + 1 or (words[head + 1] == "for" and colon < head + 5)
    return colon if served and plain and not shared and colon < len(words) - 2 else 0


def _imagined(sentence: list[Token], nouns: Nouns) -> list[list[Token]]:
    """Cut "picture a quiet breakfast: a cup on a tray", "it's dinner time: a cup on a tray" at its colon."""
    colon = next((at for at, token in enumerate(sentence) if token.text == ":"), 0)
    opening = [*sentence[:colon], sentence[-1]]
    opens = sentence[0].text in _IMAGINING | {"it", "be"}
    if not opens or not colon or not _is_talk(opening, nouns):
        return [sentence]
    return [opening, list(sentence[colon + 1 :])]


def spoken_before(sentence: list[Token]) -> list[list[Token]]:
    """Tell "my hands are dirty, get the soap" as "my hands are dirty", "get the soap": talk, and what is asked."""
    words = [token.text for token in sentence]
    comma = words.index(",") if "," in words else 0
    after = comma + 1 + (words[comma + 1] in ("so", "please", "now"))
    leads = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.PRONOUNS | lexicon.VIEWERS
    asks = after + 2 * (words[after : after + 2] in (["could", "you"], ["can", "you"], ["would", "you"]))
    asks += words[min(asks, len(words) - 1)] == "please"
    named = asks + 1 + (words[min(asks + 1, len(words) - 1)] in ("away", "up", "down"))
    asked = comma > 1 and named < len(words) - 1 and known_verb(words[asks]) and words[named] in leads
    if not asked:
        return [sentence]
    speaks = words[0] in _SPEAKERS | {"my", "our", "it's"} and "to" not in words[:comma]
    verb = next((n for n in range(2, comma) if words[n] in ("is", "are", "was", "were")), 0)
    plain = not any(link_at(sentence, n) for n in range(comma))
    tells = words[0] in ("the", "this") and verb and comma - verb in (2, 3) and plain
    if not (speaks or tells):
        return [sentence]
    return [[*sentence[:comma], replace(sentence[-1])], list(sentence[after:])]


def _is_talk(sentence: Sequence[Token], nouns: Nouns) -> bool:
    """Whether `sentence` tells of who speaks, or of someone of theirs, and names nothing that could be there."""
    words = [token.text for token in sentence]
    spoken = words[0] in _SPEAKERS | _IMAGINING or (words[0] in ("my", "our", "the") and words[1] in _PEOPLE)
    spoken = spoken or words[0] in _ABOUT_NOW | _PEOPLE | lexicon.MEALS or words[:2] in _SAYING
    return len(words) > 2 and spoken and all(_is_said(sentence, at, nouns) for at in range(1, len(words) - 1))


def _is_said(sentence: Sequence[Token], at: int, nouns: Nouns) -> bool:
    """Whether the word at `at` is no thing: "party", the "garden" of "garden party", the "thirsty" of "I'm thirsty"."""
    word, before, after = sentence[at].text, sentence[at - 1].text, sentence[at + 1]
    if sentence[at].mark or word in _PEOPLE | _TIMES | lexicon.MEALS or (before, word) == ("this", "one"):
        return True
    if word in lexicon.NUMBERS and word not in ("a", "an", "one"):
        return False
    ends = after.mark or after.text in FINITE or after.text in ("and", "or") or link_at(sentence, at + 1) > 0
    about = sentence[at - 2].text if at > 1 else ""
    if before in ("on", "about", "for", "with") and is_quality(about) and nouns.match([word]) is None:
        # "a presentation on Lincoln"
        return word not in lexicon.DETERMINERS | lexicon.NUMBERS.keys() or not ends
    if before in _BEING and ends:
        return nouns.match([word]) is None
    if ends or (after.text in _TIMES and sentence[0].text not in _IMAGINING):
        thing = nouns.match([word]) is not None and not is_quality(word)
        return before in _WITHOUT_ARTICLE if thing else makes_nothing(word)
    # What goes before another noun describes it.
    return True


def _names_something(sentence: Sequence[Token], nouns: Nouns) -> bool:
    """Whether `sentence` names a thing before it refers to one."""
    words = [token.text for token in sentence]
    # "It is on a tray", "give them to me"; "could you give me the cup" refers to nobody but who speaks.
    for word in words:
        if word in _REFERRING - lexicon.VIEWERS:
            return False
        if nouns.match([word]) is not None and not is_quality(word):
            return True
    return False
