"""Where an instruction leads: back on the tray, out of the pot and onto the plate, upside down, into the left bowl."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon, postures
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.measures import is_measure
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.vocabulary import Nouns

TAKING = frozenset({"grasp", "grab", "pick", "take", "lift", "remove", "fetch"})
_PUTTING = frozenset({"put", "place", "set", "lay", "hang", "bring", "move", "take", "drop", "stack", "slide", "push",
                      "pull"})  # fmt: skip
_SIDES = frozenset({"left", "right", "top", "bottom", "middle", "upper", "lower"})
_LEADING = frozenset(
    {"in", "into", "on", "onto", "to", "from", "and", "under", "behind", "pick", "grab", "grasp", "open"}
)
_NO_THINGS = lexicon.PARTS - {"shelf", "drawer", "door", "compartment"}
_CLOSING = {"cover": "over", "close": "on", "seal": "on", "top": "on", "crown": "on"}
"""Deeds that put one thing on another, and how."""
_TURNING = frozenset({"turn", "rotate", "spin", "twist", "tilt", "roll", "flip", "swivel"})
_COMING = (("from", "above"), ("from", "below"), ("from", "behind"), ("from", "underneath"))
_WAYS = frozenset({"clockwise", "counterclockwise", "anticlockwise"})
_BEFORE = ("lying", "lies", "lie", "laid", "turned", "tipped", "toppled", "knocked", "overturned", "flipped", "facing",
           "tilted", "slanted", "rotated", "leaning", "inverted")  # fmt: skip
"""Beginnings of postures that say how a thing is already."""


def put_back(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "put the cup back on the tray" as "put the cup onto the tray"."""
    made: list[Token] = []
    dropped = False
    for at, token in enumerate(tokens):
        back = token.text == "back" and any(each.text in _PUTTING for each in made) and not link_at(tokens, at)
        behind = back and made[-1].text not in (*lexicon.DETERMINERS, *lexicon.POSSESSIVES, "in", "at", "on")
        if behind and (link_at(tokens, at + 1) or tokens[at + 1].mark or tokens[at + 1].text == "where"):
            dropped = True
            continue
        plain = dropped and token.text in ("on", "in") and link_at(tokens, at) == 1
        made.append(replace(token, text=f"{token.text}to") if plain else token)
        dropped = False
    return made


def closed(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "cover the cup with the plate" as "put the plate over the cup"; "close" is as much as "cover"."""
    words = [token.text for token in tokens]
    leads = {"the", "this", "that"} | lexicon.POSSESSIVES
    for at in (n for n in range(len(words) - 5) if words[n] in _CLOSING and words[n + 1] in leads | {"it"}):
        end = next(n for n in range(at + 1, len(words)) if tokens[n].mark or words[n] in ("and", "then"))
        joint = next((n for n in range(at + 2, end - 1) if words[n] == "with" and words[n + 1] in leads), 0)
        opens = not at or words[at - 1] in ("and", "then", ",", "please")
        if joint and opens and not any(link_at(tokens, n) for n in (*range(at + 1, joint), *range(joint + 2, end))):
            upon = replace(tokens[joint], text=_CLOSING[words[at]])
            put, thing, rest = replace(tokens[at], text="put"), list(tokens[at + 1 : joint]), list(tokens[end:])
            again = next((n for n in range(1, min(4, len(rest))) if rest[n].text == "it"), 0)
            # "Cover the pot with the lid and lift it": the pot.
            rest[again : again + bool(again)] = thing if again else []
            return [*tokens[:at], put, *tokens[joint + 1 : end], upon, *thing, *rest]
    return list(tokens)


def with_articles(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "put red block in left bowl" as "put red block in the left bowl": one of several."""
    made: list[Token] = []
    for at, token in enumerate(tokens):
        before, follower = (tokens[at - 1].text if at else ""), tokens[min(at + 1, len(tokens) - 1)].text
        bare = token.text in _SIDES and nouns.match([follower]) and (before in _LEADING or before in _PUTTING)
        if bare and not nouns.match([token.text, follower]) and follower not in _NO_THINGS:
            made.append(replace(token, text="the"))
        # "The middle shelf of fridge"
        part = before in ("shelf", "drawer", "rack", "door", "compartment", "burner", "corner", "side", "edge", "half")
        if part and token.text == "of" and nouns.match([follower]) and len(made) > 1 and made[-2].text in _SIDES:
            made += [token, replace(tokens[at + 1], text="the", end=tokens[at + 1].start)]
            continue
        made.append(token)
    return made


def end_state(body: list[Token], verb: str, manner: str | None) -> tuple[list[Token], Token | None]:
    """`body` of an instruction without how the thing is to be turned, and the words for that where a task is left.

    Before "turn the bottle on its side" it stands, and "put the mug upside down on the tray" finds it upright. What is
    made by "put a mug upside down on a tray" is so, and "the bottle lying on its side" lies before.
    """
    words = [token.text for token in body]
    made_up = words[:1] and (words[0] in ("a", "an", "some") or words[0] in lexicon.NUMBERS or words[0].isdecimal())
    if verb in _TURNING and manner == "other":
        amount = (n for n in range(2, len(body)) if words[n] in _WAYS or is_measure(words[n]) or
                  (words[n : n + 2] == ["to", "the"] and words[n + 2 :] in (["left"], ["right"])))  # fmt: skip
        end = next(amount, len(body))
        body = body[: end - (end > 0 and words[end - 1] == "by")]
    above = next((n for n in range(1, len(body) - 1) if tuple(words[n : n + 2]) in _COMING), 0)
    if above and above + 2 == len(body):
        whole = replace(body[above], end=body[above + 1].end)
        return body[:above], whole if manner != "other" else None
    if manner not in ("make", "move", "other", "stack") or (made_up and manner != "other"):
        return body, None
    for at in range(1, len(body)):
        said = postures.read_posture(words[at]) if postures.is_posture(words[at]) else ""
        before = words[at - 1]
        ends = at + 1 == len(body) or body[at + 1].mark or link_at(body, at + 1) > 0
        # "Turn the glass upside down" is of a glass, "move the small upside-down cup" of a small one.
        told = before in lexicon.COPULAS | lexicon.DETERMINERS | lexicon.POSSESSIVES
        told = told or (is_modifier(before) and not ends)
        if said and not told and not said.startswith(_BEFORE):
            rest = [*body[:at], *body[at + 1 :]]
            goes = manner != "other" and any(link_at(rest, n) for n in range(1, len(rest)))
            return rest, body[at] if goes else None
    return body, None
