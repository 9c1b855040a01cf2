"""A prompt cut into its sentences, in the order in which they are read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.errors import PromptError
from pat3d.plan.grammar.rewriting.asking import plainly_asked
from pat3d.plan.grammar.rewriting.beforehand import ones_named, told_before
from pat3d.plan.grammar.rewriting.colons import behind_colons, one_for_each, with_goals
from pat3d.plan.grammar.rewriting.doers import told_plainly
from pat3d.plan.grammar.rewriting.exceptions import coloured_alike, exceptions
from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.rewriting.next_deeds import next_deeds
from pat3d.plan.grammar.rewriting.requests import held_over, requested
from pat3d.plan.grammar.rewriting.talk import spoken_before
from pat3d.plan.grammar.rewriting.wanted_states import brought_about
from pat3d.plan.grammar.rewriting.wordings import reworded, wordings
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE, LINKS
from pat3d.plan.grammar.words.modifiers import is_colour_word
from pat3d.plan.grammar.words.number_words import ORDINALS
from pat3d.plan.grammar.words.unmade import base_verb
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.scene.relations import SUPPORT_KINDS

CONDITIONS = frozenset({"once", "when", "whenever", "if", "as"})
"""Words that open what has to be before something is done."""

_MORE = frozenset({"another", "other", "others", "also", "too", "more", "else", "still", "then"})
"""Words by which what there is is said of further things."""
_DENYING = frozenset({"no", "not", "nothing", "neither"})
_MOVED = frozenset({"rolled", "fallen", "slid", "slipped", "dropped", "tumbled", "landed", "bounced", "jumped",
    "climbed", "crept", "crawled", "hopped", "leapt", "flown", "spilled", "spilt", "escaped"})  # fmt: skip
_HAVING = "|".join(lexicon.HAVING)
_APART = wordings((
    # "A wall with two shelves and, below them, a bench"
    (rf"((?:{_HAVING}) [^.]*?)and , ((?:[^ .,]+ )+?them ), ", r"\1 . \2 there is"),
    # "A jug from which two peas have rolled"
    (rf"(?:, )?(?:out of|from|off) which ((?:[^ .,]+ )+?(?:has|have) (?:{'|'.join(_MOVED)}) )", r". \1 off it"),
))  # fmt: skip
_TO = {"into": "in", "onto": "on", "under": "under", "beneath": "under", "underneath": "under", "below": "under"}
"""Where something is that has moved there."""
_LADEN = frozenset({
    "cluttered", "messy", "untidy", "tidy", "neat", "full", "crowded", "packed", "busy", "set", "laid", "laden",
    "organized", "organised",
})  # fmt: skip
"""What a table is when the things that are told of next stand on it."""


_HAD = ("of", "with")
_COUNTING = {"a", "an"} | lexicon.NUMBERS.keys()
_UNNAMED = frozenset({"items", "objects", "things", "elements"})
"""Words for several things of which something else says what they are."""
_LEFT = frozenset({"other", "others", "rest", "remaining", "last"})
"""What is left when some of several were told of: "the rest are empty"."""


def sentences(tokens: Sequence[Token], nouns: Nouns) -> list[list[Token]]:
    """The sentences of `tokens`, which end in a stop; each ends in a stop as well."""
    tokens = reworded(_contents(_and_no_more(told_plainly(next_deeds(tokens))), nouns), _APART)
    cut = with_goals(_cut(tokens, nouns), nouns)
    cut = [each for one in cut for each in held_over(requested(one, len(cut) == 1, nouns))]
    cut = ones_named([each for one in cut for each in told_before(one, nouns)], nouns)
    parts = [part for sentence in cut for part in behind_colons(sentence, nouns)]
    told = _conditions(brought_about(_labelled(parts), nouns))
    told = plainly_asked(_no_longer(told), nouns)
    told = [coloured_alike(each, nouns) for each in exceptions(_come_to_rest(told))]
    told = one_for_each(_reordered(told, nouns))
    return [sentence for sentence in told if len(sentence) > 1]


def _cut(tokens: Sequence[Token], nouns: Nouns) -> list[list[Token]]:
    """`tokens` cut after every stop, and before what a colon begins to tell of the one and of the other.

    So is "The left box holds a ball, the right box is empty", where the right box is not held.
    """
    made: list[list[Token]] = [[]]
    for at, token in enumerate(tokens):
        words = [each.text for each in tokens[at + 1 : at + 5]]
        # "Two buckets: the green one holds three balls, the red one is empty."
        clause = len(words) == 4 and words[0] == "the" and words[2] == "one" and words[3] in FINITE
        # "Four jars: the first contains nuts, the second is empty"
        clause = clause or (len(words) == 4 and words[0] == "the" and words[1] in ORDINALS and words[2] in FINITE)
        told = token.text == "," and any(each.text in FINITE for each in made[-1])
        goes = token.text == ":" and _goes(tokens, at + 1) and not known_verb("".join(t.text for t in made[-1][:1]))
        begins = (clause and (token.text == ":" or told)) or goes
        begins = begins or ((_tells_state(tokens, at, nouns) or _of_another(tokens, at)) and any(map(_holds, made[-1])))
        made[-1].append(replace(token, text=".", mark=True) if begins else token)
        if token.text == "." or begins:
            made.append([])
    return [each for sentence in made if len(sentence) > 1 for each in spoken_before(sentence)]


def _contents(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the desk is messy. There are a mug and a pen." as "the desk is messy: a mug and a pen".

    So is "several objects are on a desk. There is a mug. There is a pen.", where nothing says where they are.
    """
    words, made, before, at = [token.text for token in tokens], list[Token](), list[str](), 0
    while at < len(tokens):
        stop = next((n for n in range(at + 1, len(words)) if words[n] == "."), 0)
        there = stop and words[at] in (":", ".") and words[at + 1] == "there" and words[at + 2] in ("is", "are")
        links = (LINKS.get(tuple(words[n : n + link_at(tokens, n)])) for n in range(at + 3, stop))
        placed = any(link is not None and link.kind in SUPPORT_KINDS and not link.inverse for link in links)
        if there and words[at + 3] not in _MORE | _DENYING and not placed and _lists_next(before, nouns):
            made.append(replace(tokens[at], text="," if ":" in before else ":", mark=True))
            before.append(":")
            at += 3
            continue
        before = [] if words[at] == "." else [*before, words[at]]
        made.append(tokens[at])
        at += 1
    return made


def _lists_next(before: Sequence[str], nouns: Nouns) -> bool:
    """Whether what follows "the desk is messy" or "several objects are on a desk" is there."""
    words = before[: before.index(":")] if ":" in before else before
    verb = max((words.index(word) for word in ("is", "are") if word in words), default=0)
    laden = verb > 0 and words[-1] in _LADEN and len(words) - verb < 4 and words[0] in ("the", "my", "this", "our")
    told = {"such", "including", "like", "these", "all"} & {*words}
    unnamed = bool(_UNNAMED & {*words}) and not told and not known_verb(words[0])
    table = nouns.match(words[verb - 1 : verb] if laden else words[-1:]) if laden or unnamed else None
    on_it = unnamed and words[-2:] == ["on", "it"]
    plain = unnamed or not {"on", "in", "of", "at", "by", "near", ","} & {*words[:verb]}
    return on_it or (table is not None and plain and nouns.of_class(table.noun, lexicon.LEVEL))


def _and_no_more(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` without "nothing else is on the desk", which every scene is: it has what is told of."""
    words = [token.text for token in tokens]
    for at in range(2, len(words) - 2):
        end = next(n for n in range(at, len(words)) if tokens[n].mark)
        no_more = words[at : at + 2] == ["nothing", "else"] and not {"but", "except", "besides"} & {*words[at:end]}
        known = words[end - 1] in (*words[:at], "else", "there", "it", "them")
        if no_more and known and (end == at + 2 or words[at + 2] in lexicon.COPULAS):
            start = at - (words[at - 1] in ("and", "with"))
            start -= tokens[start - 1].mark
            return _and_no_more([*tokens[:start], *tokens[end:]])
    return list(tokens)


def _holds(token: Token) -> bool:
    link = LINKS.get((token.text,))
    return link is not None and link.finite and link.inverse


def _of_another(tokens: Sequence[Token], at: int) -> bool:
    """Whether "another holds" follows a comma or "and" at token `at`: what the one before holds is no such other."""
    first = at + 1 + (tokens[at].text == "," and tokens[min(at + 1, len(tokens) - 1)].text == "and")
    words = [token.text for token in tokens[first : first + 4]]
    verb = 1 + (words[1:2] == ["one"])
    told = tokens[at].text in (",", "and") and words[:1] == ["another"] and len(words) > verb
    return told and _holds(tokens[first + verb])


def _tells_state(tokens: Sequence[Token], at: int, nouns: Nouns) -> bool:
    """Whether "the right box is empty" follows a comma or "and" at token `at`."""
    first = at + 1 + (tokens[at].text == "," and tokens[at + 1].text in ("and", "but", "while"))
    words = [token.text for token in tokens[first : first + 7]]
    verb = next((n for n, word in enumerate(words) if word in ("is", "are")), 0)
    if tokens[at].text not in (",", "and", "but", "while") or verb < 2 or verb > len(words) - 3:
        return False
    rest = words[0] == "the" and words[1] in _LEFT
    named = words[0] in lexicon.DETERMINERS and (rest or nouns.match([words[verb - 1]]) is not None)
    plain = not any(tokens[n].mark or link_at(tokens, n) for n in range(first, first + verb))
    state = words[verb + 1] == "empty" or is_colour_word(words[verb + 1])
    return named and plain and state and tokens[first + verb + 2].mark


def _goes(tokens: Sequence[Token], at: int) -> bool:
    """Whether "the plates go in the sink" stands at token `at`."""
    verb = next((n for n in range(at, min(at + 8, len(tokens) - 1)) if tokens[n].text in ("go", "goes")), 0)
    return bool(verb) and not any(token.text == "." for token in tokens[at:verb]) and link_at(tokens, verb + 1) > 0


def _labelled(told: list[list[Token]]) -> list[list[Token]]:
    """`told` with "object A: a cracker box. B is behind it" as "a cracker box. The cracker box is behind it"."""
    names: dict[str, list[Token]] = {}
    made: list[list[Token]] = []
    for sentence in told:
        words = [token.text for token in sentence]
        named = next((n for n in (0, 1) if words[n + 1 : n + 2] == [":"] and len(words[n]) == 1), -1)
        if named >= 0 and (named == 0 or words[0] in ("object", "item", "thing")) and len(words) < named + 7:
            names[words[named]] = sentence[named + 2 : -1]
            made.append(list(sentence[named + 2 :]))
            continue
        whole: list[Token] = []
        for token, follower in zip(sentence, (*words[1:], ""), strict=True):
            # "A is on a plate": the second is an article.
            article = token.text == "a" and follower not in FINITE
            named_so = [] if article else names.get(token.text, [])
            begun = [each for each in named_so if each.text not in lexicon.DETERMINERS]
            said = [replace(token, text=each.text) for each in begun]
            whole += [replace(token, text="the"), *said] if said else [token]
        made.append(whole)
    return made


def _conditions(told: list[list[Token]]) -> list[list[Token]]:
    """`told` with "once the box is open, drop the pen in it" as two sentences; the comma may be left out."""
    made: list[list[Token]] = []
    for sentence in told:
        words = [token.text for token in sentence]
        comma = words.index(",") if "," in words else 0
        after = comma + 1 + (words[comma + 1 : comma + 2] in (["then"], ["please"]))
        asked = comma > 3 and base_verb(words[after]) == words[after]
        opens = words[0] in CONDITIONS and (words[1] in lexicon.DETERMINERS or words[1] == "there")
        verbs = (n for n in range(4, len(words) - 2)
                 if known_verb(words[n]) and words[n + 1] in lexicon.DEFINITE | {"it", "them"}
                 and FINITE & {*words[1:n]} and words[n - 1] not in lexicon.MODALS | {"to"})  # fmt: skip
        if opens and asked and set(words[1:comma]) & FINITE:
            made += [[*sentence[:comma], replace(sentence[comma], text=".")], list(sentence[after:])]
        elif opens and (verb := next(verbs, 0)) and not any(token.mark for token in sentence[:verb]):
            made += [[*sentence[:verb], sentence[-1]], list(sentence[verb:])]
        else:
            made.append(sentence)
    return made


def _no_longer(told: list[list[Token]]) -> list[list[Token]]:
    """`told` with "there used to be a jug on the mat; now there is a cup" as "there is a cup on the mat".

    So is "the mat used to hold a jug, but now it holds a cup" of the mat: the audit names what was there.
    """
    made: list[list[Token]] = []
    for sentence in told:
        words = [token.text for token in sentence]
        now = next((n for n, word in enumerate(words[:-3]) if word == "now" and words[n - 1] in (".", ",", "but")), -1)
        before = sentence[:now] if now > 1 else made[-1] if made and now >= 0 else []
        said = [token.text for token in before]
        used = next((n for n in range(1, len(said) - 1) if said[n : n + 2] == ["used", "to"]), 0)
        if not used and said[:2] not in (["there", "was"], ["there", "were"]):
            made.append(sentence)
            continue
        there = list(sentence[now + 1 :])
        if said[0] == "there":
            # "Now there is a pear in it"
            end = next((n for n in range(2, len(there)) if link_at(there, n) and there[n].text not in _HAD), -1)
            place = next((n for n in range(4, len(said)) if link_at(before, n) and said[n] not in _HAD), len(said))
            stop = next((n for n in range(place, len(said)) if before[n].mark), len(said))
            if end < 0 or there[-2].text in ("it", "them"):
                there[end:-1] = before[place:stop]
        elif there[0].text in ("it", "they"):
            there[:1] = before[:used]
        made[-1 if now <= 1 else len(made) :] = [there]
    return made


def _come_to_rest(told: list[list[Token]]) -> list[list[Token]]:
    """`told` with "a pea has rolled under the table" as "a pea is under the table".

    "A pea has fallen off the fork onto the mat" is "there is the fork" and "a pea is on the mat".
    """
    made: list[list[Token]] = []
    for sentence in told:
        words = [token.text for token in sentence]
        at = next((n for n in range(1, len(words) - 4) if words[n] in ("has", "have") and words[n + 1] in _MOVED), 0)
        size = link_at(sentence, at + 2)
        link = LINKS.get(tuple(words[at + 2 : at + 2 + size]))
        place = at + 2
        away = link is not None and link.manner == "source"
        away = away and words[at - 1] not in lexicon.RELATIVES
        placed = link is not None and (link.kind or words[place] in _TO) and link.manner != "source"
        if not at or words[place] == "over" or not (away or placed):
            made.append(sentence)
            continue
        is_ = replace(sentence[at], text="is" if words[at] == "has" else "are")
        if away:
            stop = next(n for n in range(place, len(words)) if sentence[n].mark)
            goals = (n for n in range(place + size, stop - 1) if link_at(sentence, n) and words[n] != "of")
            place = next(goals, 0)
            if set(words[at + 2 : place or stop]) & (FINITE | lexicon.STANDING):
                # "A pea has fallen off the fork and now lies beside it"
                made.append(sentence)
                continue
            if not place:
                # "A pea has fallen off the fork": where to is not said.
                off = replace(sentence[at + 1 + size], text="off")
                made.append([*sentence[:at], is_, off, *sentence[at + 2 + size :]])
                continue
            source = [token for token in sentence[at + 2 + size : place] if token.text != "and"]
            if source and source[0].text not in lexicon.PRONOUNS:
                there = [replace(sentence[at], text=word) for word in ("there", "is")]
                made.append([*there, *source, replace(sentence[-1])])
        floored = words[place] == "to" and words[place + 2] in ("floor", "ground")
        where = replace(sentence[place], text="on" if floored else _TO.get(words[place], words[place]))
        made.append([*sentence[:at], is_, where, *sentence[place + 1 :]])
    return made


def _reordered(told: list[list[Token]], known: Nouns) -> list[list[Token]]:
    """`told` with "there are three plates" before the "every plate", or "the plates", of which it gives the number.

    So are "there is a cup on the table" and "on the table are a cup and a jug" before "put the cup on the tray", which
    they tell the beginning of.
    """
    made = list(told)
    for at, sentence in enumerate(made):
        words = [token.text for token in sentence]
        there = words[:2] in (["there", "are"], ["there", "is"], ["there's", "a"])
        # "The tray has a cup and a jug on it"
        own = words[-2:-1] == ["it"] and words[0] in lexicon.DETERMINERS
        follows_on = (len(words) > 6 or not there) and {*words[: -2 if own else None]} & lexicon.PRONOUNS
        scene = base_verb(words[0]) != words[0] and words[0] not in CONDITIONS and {*words} & FINITE
        if not (there or scene) or follows_on or {*words} & _MORE:
            continue
        nouns = {guess for word in words[2:-1] for guess in (word, *singulars(word))} - lexicon.NUMBERS.keys()
        link = next((n for n in range(3, len(words)) if sentence[n].mark or link_at(sentence, n)), 3)
        led = range(2, link) if there else [n for n in range(1, len(words)) if {*words[max(n - 3, 0) : n]} & _COUNTING]
        ones = (guess for n in led for guess in (words[n], *singulars(words[n])))
        told_later = {one for one in ones if known.match([one])} - lexicon.NUMBERS.keys()
        told_later |= {words[n] for n in led if told_later & {*singulars(words[n])}}
        for before in range(at):
            before_it = [token.text for token in made[before]]
            named = [one for one, two in zip(before_it, before_it[1:], strict=False) if two in nouns]
            old = words[:2] in (["there", "are"], ["there's", "a"])
            old = old and bool({*named} & {"each", "every"} or {*named} == {"the"})
            # "Sort the cups", and "the cup" of "put all but the cup in the box"
            asks = base_verb(before_it[0]) == before_it[0] or (before_it[0] == "the" and not {*before_it} & FINITE)
            if old or (asks and told_later & {guess for word in before_it for guess in (word, *singulars(word))}):
                made.insert(before, made.pop(at))
                break
    return made


def check_language(text: str) -> None:
    """Raises: PromptError: `text` is in another language than English."""
    words = [word.strip(".,;:!?").lower() for word in text.split()]
    foreign = [word for word in words if word in lexicon.FOREIGN]
    english = sum(word in lexicon.DETERMINERS or word in ("is", "are", "with", "and", "of") for word in words)
    letters = [letter for letter in text if letter.isalpha()]
    other = [letter for letter in letters if ord(letter) > 0x24F]
    if (len(foreign) >= 2 and len(foreign) > english) or len(other) * 2 > len(letters):
        said = " ".join(foreign[:3]) or "".join(other[:8])
        raise PromptError(f'"{said}": prompts are read in English only: "a red mug on a wooden table".')
