"""Clauses and tails that name nothing to be made: "to boil the water faster", "that the robot has to avoid".

A sentence that cannot be read whole is read without the shortest of them at which its reading fails; a note has its
words. None names an object of the catalogue that is named nowhere else, or a thing that the catalogue lacks.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from pat3d.plan.grammar.rewriting.remarks import MOVING, Remarks
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import JOINERS, link_at
from pat3d.plan.grammar.words.lexing import Span, Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_marked, is_modifier, looks_like_adjective
from pat3d.plan.grammar.words.senses import PACKED
from pat3d.plan.grammar.words.unmade import base_verb, is_quality, makes_nothing
from pat3d.plan.grammar.words.vocabulary import Nouns

_SUBORDINATING = frozenset({
    "while", "as", "so", "because", "since", "until", "when", "after", "before", "though", "although", "whereas",
    "once", "without", "using", "via", "due", "thanks", "despite", "like", "unlike", "instead",
})  # fmt: skip
_COUNTING = frozenset({"a", "an", "another", "some", "several", "many", "few", "more"})
_TELLING = lexicon.NUMBERS.keys() | lexicon.POSITIONS.keys() | lexicon.SUPERLATIVES.keys() | {
    "one", "ones", "other", "others", "each", "either", "rest", "neither", "none", "another",
}  # fmt: skip
"""Words that may stand for an object."""
_LEADING = frozenset({"in", "at", "with", "by", "for", "during"})
"""What leads to a manner or a time."""
_AGREEING = frozenset({"matching", "corresponding", "different", "various", "specific", "random", "similar", "certain",
    "equal", "given"})  # fmt: skip
_OWING = frozenset(
    {"has", "have", "needs", "need", "is", "are", "was", "were", "want", "wants", "able", "used", "ready"}
)
"""Words before "to" that tell of a duty or a fact."""
_PUTTING = frozenset({"put", "place", "move", "pick", "stack", "take", "bring", "insert", "get", "hold", "set", "lay",
    "grasp", "grab", "lift", "be", "stand", "lie", "form", "make", "build"})  # fmt: skip
"""What is done in a scene, and no purpose of it."""
_MARKED = frozenset({"line", "trail", "path", "goal", "zone", "spot", "mark", "level", "pile", "mixture", "end"})
"""Qualities that are places too."""
_LOOSE = frozenset({"away", "again", "altogether", "sideways", "outwards", "inwards", "outward", "inward", "upwards",
    "downwards", "aside", "maybe", "perhaps", "somehow", "everywhere", "nowadays", "anew", "meanwhile", "indoors",
    "outdoors", "here", "overall", "apart", "backwards", "forwards"})  # fmt: skip
"""Adverbs that place nothing."""
_GOING = frozenset({"fall", "drop", "roll", "fly", "go", "run", "jump", "slide", "spill", "leave", "make", "form",
    "build",
    "miss", "lack", "have", "point", "face", "lean", "hang", "replace", "exchange", "divide", "split"})  # fmt: skip
"""Verbs that say where something is, or how much of it."""
_REACHING = frozenset({"reach", "touch", "sniff", "lick", "smell", "greet", "catch", "inspect"})
"""Deeds that bring one thing to another."""
_PARTICLES = frozenset({"up", "over", "down"})
_NO_VERBS = frozenset(
    {"lacks", "needs", "missing", "lacking", "becomes", "means", "as", "towards", "besides", "is", "has"}
)
_SCREENS = frozenset({"screen", "screens", "display", "displays", "wallpaper"})
_CELLS = frozenset({"row", "column", "line"})
_LEAVING = frozenset({"off", "from", "out", "of", "into", "onto", "to"})
_ADVERBS = frozenset({"apart", "away", "aside", "back", "ago", "later", "before", "so"})
_SOMEBODY = frozenset({"she", "he", "they", "we", "i", "you", "someone", "somebody", "everyone", "everybody"})
_PEOPLE = frozenset({"guest", "guests", "friend", "friends", "mother", "father", "mom", "dad", "wife", "husband",
    "family", "parents", "sister", "brother", "boss", "colleagues", "neighbor", "neighbour", "kids", "children", "baby",
    "visitors", "people", "party", "meeting"})  # fmt: skip
_ARRIVING = frozenset({"come", "comes", "arrive", "arrives", "arrived"})
_TRIED = 10
"""Spans without which a sentence is tried."""


class Tails(Remarks):
    """Finds what may be set aside of one sentence, which ends in a stop."""

    def __init__(self, tokens: Sequence[Token], nouns: Nouns, known: Mapping[str, str]) -> None:
        """Look at `tokens`; `known` are the catalogue nouns of the sentences before, with the words they were in."""
        super().__init__(tokens, nouns)
        self._known = known

    def around(self, number: int) -> list[Span]:
        """What may be set aside so that word `number` of the prompt is no longer read, shortest first."""
        fault = next((at for at, token in enumerate(self._tokens) if token.number == number and not token.mark), -1)
        made = [
            (start, end)
            for start in range(len(self._words) - 1)
            for end in self._ends(start)
            if fault < 0 or start <= fault < end or end == fault
        ]
        made.sort(key=lambda span: (span[1] - span[0], span))
        return [span for span in made if self._idle(*span)][:_TRIED]

    def _idle(self, start: int, end: int) -> bool:
        idle = self._words[start] != "of" and (self._says_nothing(start, end) or self._is_purpose(start, end))
        return idle or self._is_content(start, end)

    def _is_content(self, start: int, end: int) -> bool:
        """Whether "of lye", "of BaCl2 and KOH" tells what no table has, and "with tasty ingredients" nothing."""
        if self._words[start] == "with":
            return self._words[end - 1] == "ingredients" and end - start < 4
        held, joints = self._words[start + 1 : end : 2], {*self._words[start + 2 : end : 2]}
        told = (
            lexicon.LEADING | FINITE | lexicon.PRONOUNS | lexicon.VIEWERS | lexicon.GENERICS.keys() | lexicon.SUBSTANCES
        )
        known = any(at in self._named for at in range(start, end)) or bool({*held} & told)
        vessel = self._words[start] == "of" and self._behind_noun(start) and joints <= {"and", ","}
        return vessel and not known and not any(singulars(word) or is_quality(word) for word in held)

    def _is_purpose(self, start: int, end: int) -> bool:
        """Whether "to sweeten the tea" or "for slicing bread" ends a sentence that names something before it."""
        word, verb = self._words[start], self._words[start + 1]
        deed = base_verb(verb) or verb
        ends = end == len(self._words) - 1 and any(at < start for at in self._named)
        plain = not (set(self._words[start:end]) & {",", "and", "then"}) and self._words[start - 1] not in _OWING
        leads = (word == "to" and not verb.endswith("ing")) or (word == "for" and verb.endswith("ing"))
        plain = plain and (word == "for" or deed not in _PUTTING)
        return leads and ends and plain and (base_verb(verb) or word == "to") is not None

    def loose(self, number: int) -> list[Span]:
        """Words around word `number` that name, count and relate nothing, fewest first: "away", "at random places"."""
        fault = next((at for at, token in enumerate(self._tokens) if token.number == number and not token.mark), -1)
        if fault < 0:
            return []
        made = [
            (start, end)
            for end in range(fault, min(fault + 6, len(self._words)))
            for start in range(max(1, fault - 8), fault + 2)
            if start < end and self._is_loose(start, end)
        ]
        made.sort(key=lambda span: (span[1] - span[0], span))
        cells = [span for span in made if self._words[span[1] - 1] in _CELLS]
        return [span for span in made if span in cells or self._says_nothing(*span)][:_TRIED]

    def unrelated(self, number: int) -> list[Span]:
        """Verbs near word `number` that may relate one thing to another, and that no table has: "guards a bowl"."""
        made: list[Span] = []
        for at in range(1, len(self._words) - 2):
            end = at + 1 + (self._words[at + 1] in _PARTICLES)
            # "leaps to reach a counter"
            reaches = self._words[at + 1] == "to" and self._words[at + 2] in _REACHING
            end += 2 * reaches
            near = 0 <= number - self._tokens[at].number <= 4 and not self._tokens[at].mark
            word, verb = self._words[at], base_verb(self._words[at])
            acts = verb is not None or (word.endswith(("s", "ed")) and not link_at(self._tokens, at))
            plain = reaches or (verb not in _GOING and word not in MOVING | FINITE | _NO_VERBS)
            plain = plain and at not in self._named and self._words[at - 1] != ","
            leads = self._begins(end) or (reaches and self._leads(end))
            if near and acts and plain and self._behind_noun(at) and leads:
                made.append((at, end))
        return made

    def _is_loose(self, start: int, end: int) -> bool:
        """Whether tokens `start` to `end` tell only how: an adverb, a verb before its relation, "at random places"."""
        words, before, after = self._words[start:end], self._words[start - 1], self._words[end]
        words = words[:1] if len(words) == 2 and words[1].endswith("ly") else words  # "flickers softly"
        if any(token.mark for token in self._tokens[start:end]) or any(at in self._named for at in range(start, end)):
            return False
        if any(self._placing(at) for at in range(start, end)) or after in ("of", "than", "as", ":"):
            return False
        if len(words) == 1 and is_marked(words[0]):
            return before in ("hang", "hangs", "hanging", "hung")
        if len(words) == 1 and after in lexicon.ROWS and before in ("a", "one", "two", "three"):
            return looks_like_adjective(words[0])
        if len(words) > 1:
            head = {words[-1], *singulars(words[-1])}
            how = is_quality(words[-1]) and not head & (lexicon.PARTS | _MARKED)
            opens = words[0] in _LEADING or (words[0] == "of" and words[-2] in _AGREEING)
            return how and opens and all(self._describes(at) for at in range(start + 1, end - 1))
        if words[0] in _LOOSE or (words[0].endswith("ly") and len(words[0]) > 4):
            return before not in lexicon.DETERMINERS | _LEADING or self._leads(end)
        acts = base_verb(words[0]) is not None and base_verb(words[0]) not in _GOING and self._behind_noun(start)
        return acts and words[0] not in MOVING and self._placing(end) and after not in _LEAVING

    def _describes(self, at: int) -> bool:
        """Whether the word at `at` stands before the name of a quality: "at the same random places"."""
        word = self._words[at]
        return word in lexicon.DETERMINERS | _AGREEING or is_modifier(word) or looks_like_adjective(word)

    def unknown(self) -> list[Token]:
        """Words of things that the catalogue lacks: heads of phrases with a determiner or a number, and plurals."""
        made: list[Token] = []
        for at, token in enumerate(self._tokens[:-1]):
            after = self._words[at + 1]
            head = self._tokens[at + 1].mark or after in JOINERS or after in FINITE or link_at(self._tokens, at + 1)
            head = head or self._acts(at + 1) or (after.endswith(("ing", "ed")) and base_verb(after) is not None)
            before = self._words[max(0, at - 3) : at]
            told = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys()
            counted = any(word in told for word in before) or bool(singulars(token.text))
            if head and counted and token.text.isalpha() and not self._in_name(at) and not _is_told(token.text):
                made.append(token)
        return made

    def adds_nothing(self, known: Collection[str]) -> bool:
        """Whether the sentence only tells more of the `known` catalogue nouns."""
        new = {token.number for token in self.unknown()}
        indefinite = any(
            token.number in new and _COUNTING & set(self._words[max(0, at - 3) : at])
            for at, token in enumerate(self._tokens)
        )
        return not indefinite and super().adds_nothing(known)

    def _unknown_deed(self, at: int) -> bool:
        """Whether a word that no table has stands at `at`, and what it is done to behind it: "to sweeten the tea"."""
        word, after = self._words[at], min(at + 1, len(self._words) - 2)
        # "To brighten up the room"
        after += self._words[after] in _PARTICLES
        leads = self._words[after] in lexicon.DETERMINERS | lexicon.POSSESSIVES | {"it", "them"}
        known = is_modifier(word) or is_quality(word) or word in JOINERS or link_at(self._tokens, at)
        return word.isalpha() and leads and not (known or self._begins(at))

    def _acts(self, at: int) -> bool:
        """Whether the word at `at` is a verb, and no plural."""
        word = self._words[at]
        leads = self._words[min(at + 1, len(self._words) - 1)] in lexicon.DETERMINERS
        return word.endswith("s") and base_verb(word) is not None and (leads or not is_quality(word))

    def _in_name(self, at: int) -> bool:
        return any(start <= at < start + size for start, size in self._named.items())

    def depicts(self, known: Collection[str]) -> bool:
        """Whether the sentence tells what the screen of a `known` thing shows: "the screen shows a spreadsheet"."""
        shown = any(word in _SCREENS and self._words[at - 1] in ("the", "its", "'s", "their", "on")
                    for at, word in enumerate(self._words))  # fmt: skip
        named = ((at, self._nouns.match(self._words[at : at + size])) for at, size in self._named.items())
        told = {found.noun for at, found in named if found is not None and self._words[at] not in _SCREENS}
        return shown and told <= set(known)

    def whole(self) -> bool:
        """Whether the sentence names nothing new at all, and places nothing: "The challenge lies in the angles"."""
        last = len(self._words) - 1
        head = next((at for at in range(1, last) if self._tokens[at].mark or link_at(self._tokens, at)
                     or self._words[at] in FINITE), last)  # fmt: skip
        head -= self._words[head - 1] in ("here", "now", "also", "mainly") and head > 1
        owned = next((at for at in range(1, head) if self._words[at] == "of"), head)
        told = {self._words[head - 1], self._words[owned - 1]}
        abstract = head - 1 not in self._named and any(is_quality(word) for word in told)
        placed = any(self._placing(at) and self._words[at] != "of" for at in range(last))
        return (abstract or not placed) and self._says_nothing(0, last, abstract=abstract)

    def _ends(self, at: int) -> list[int]:
        """Where what begins at token `at` may end; empty where nothing that may be set aside begins there."""
        word, follower = self._words[at], self._words[at + 1]
        marks = [n for n in range(at + 1, len(self._words)) if self._tokens[n].mark]
        if at == 0:
            # "After that, ..."
            return [n + 1 for n in marks[:-1] if self._words[n] in (",", ":")]
        behind = self._behind_noun(at)
        if word == "of" or (word == "with" and "ingredients" in self._words[at:]):
            ends = {"and", *FINITE}
            return [
                n for n in range(at + 2, len(self._words)) if n in marks or self._words[n] in ends or self._placing(n)
            ]
        finite = [n for n in range(at + 2, len(self._words)) if self._words[n] in FINITE and n < marks[-1]]
        if word == ",":
            return [] if follower in FINITE or self._placing(at + 1) else marks
        if word in lexicon.RELATIVES:
            behind = behind or self._words[at - 1] in lexicon.BACKGROUND
            # "that the robot has to avoid", "that is too old", "that was not rinsed" of "into the sink"
            goals = [n for n in range(at + 3, marks[0]) if self._words[n] in ("into", "onto") and self._placing(n)]
            return [*finite[follower not in FINITE :], *goals, *marks] if behind else []
        if word in _SUBORDINATING or (word in ("by", "for") and follower.endswith("ing")):
            clause = base_verb(follower) is not None or self._someone_acts(at + 1)
            return marks if not link_at(self._tokens, at) or clause else []
        # "wait on a board to be diced"
        deed = base_verb(follower) is not None or (follower == "be" and self._words[at - 1] not in _OWING)
        if word == "to" and not self._named.get(at + 1) and (deed or self._unknown_deed(at + 1)):
            return marks
        if word in ("it", "they", "he", "she", "you", "we") and behind and base_verb(follower) is not None:
            # "the drawer it came from"
            return marks[:1]
        verb = base_verb(word) is not None and at not in self._named
        if word in ("and", "but"):
            predicate = base_verb(follower) is not None and at + 1 not in self._named and follower.endswith("s")
            return marks if predicate and not self._tokens[at + 2].mark else []
        if not verb or not behind or word in MOVING or self._words[at - 1] in FINITE:
            return []
        if word.endswith(("ing", "ed")):
            placed = [n for n in range(at + 1, marks[0]) if self._placing(n)]
            return [*placed, *finite, *marks]
        # "two flags completed the setup": what is done, to nothing that is there.
        related = any(self._placing(n) for n in range(at, marks[0]))
        several = bool(singulars(self._words[at - 1])) or "and" in self._words[:at]
        bare = word == base_verb(word) and not several
        return [] if related or bare or self._tokens[at + 1].mark else marks[:1]

    def _someone_acts(self, at: int) -> bool:
        """Whether "she arrives" or "the guests come" stands at token `at`: somebody, and what no scene has."""
        who = at + (self._words[at] in lexicon.DETERMINERS | lexicon.POSSESSIVES)
        verb = min(who + 1, len(self._words) - 1)
        acts = base_verb(self._words[verb]) is not None or self._words[verb] in _ARRIVING
        return self._words[who] in (_SOMEBODY if who == at else _PEOPLE) and acts

    def _placing(self, at: int) -> bool:
        size = link_at(self._tokens, at)
        return size > 0 and self._leads(at + size)

    def _says_nothing(self, start: int, end: int, *, abstract: bool = False) -> bool:
        """Whether tokens `start` to `end` name nothing that is not named elsewhere, and all the rest something.

        What is said of something `abstract` may name what nobody knows: "the sight of the ensemble".
        """
        elsewhere: dict[str, str] = {}
        for at, size in self._named.items():
            if not start <= at < end and (found := self._nouns.match(self._words[at : at + size])):
                words = " ".join(self._words[max(0, at - 4) : at + size])
                elsewhere[found.noun] = f"{elsewhere.get(found.noun, '')} {words}"
        facing = self._words[start] in ("so", "such") and bool(lexicon.PARTS & set(self._words[start:end]))
        told = _TELLING - lexicon.POSITIONS.keys() if facing else _TELLING
        told = told - {"both"} if end == len(self._words) - 1 and not start else told
        doing = self._words[start] == "," and self._words[start + 1].endswith("ing")
        telling = set(self._words[start:end]) & told and not abstract and not doing
        if not (elsewhere or self._known) or telling:
            return False
        known = {**elsewhere, **{noun: f"{elsewhere.get(noun, '')} {words}" for noun, words in self._known.items()}}
        at = start
        while at < end:
            size = self._named.get(at, 0)
            said = self._words[max(start, at - 3) : at]
            if size and not (size == 1 and self._is_no_thing(at)):
                found = self._nouns.match(self._words[at : at + size])
                if self._owns_part(at, size):
                    at += size
                    continue
                if found is None or _COUNTING & set(said) or found.noun not in known:
                    return False
                if any(is_modifier(word) and word not in known[found.noun].split() for word in said):
                    # "Unlike the red box, the blue box ..."
                    return False
            elif (
                not size
                and not self._tokens[at].mark
                and not self._makes_nothing(start, at, end, abstract)
                and (not abstract or _COUNTING & set(said))
            ):
                return False
            at += size or 1
        return True

    def _owns_part(self, at: int, size: int) -> bool:
        """Whether only a part is meant of what the catalogue name at `at` says: "steam rising from the cup's rim"."""
        part = self._words[min(at + size + 1, len(self._words) - 1)]
        return self._words[at - 1] == "the" and self._words[at + size] == "'s" and part in lexicon.PARTS

    def _makes_nothing(self, start: int, at: int, end: int, abstract: bool) -> bool:
        """Whether the word at `at`, which the catalogue lacks, is none that names a thing."""
        word = self._words[at]
        forms = (word, *singulars(word))
        if any(form in lexicon.GENERICS for form in forms):
            return False
        inner = at + 1 < end and word not in JOINERS and not self._tokens[at + 1].mark
        inner = inner and (at + 1 in self._named or self._noun(at + 1))
        if is_colour_word(word) and not inner and not abstract:
            # "Red at the bottom, then blue": of one of them each.
            return False
        article = any(self._words[n] in ("a", "an") for n in range(max(start, at - 2), at))
        if not inner and article and (is_modifier(word) or word in lexicon.SUBSTANCES) and not is_marked(word):
            # "Held down by a stone", "with a cork in front of it"
            return False
        if not inner and article and not (word in _ADVERBS or is_quality(word) or set(forms) & lexicon.PARTS):
            return False
        plain = at > 1 and (self._someone_acts(at - 1) or self._someone_acts(at - 2))
        plain = plain or word.isdecimal() or word == "'s" or is_marked(word) or is_modifier(word) or word in JOINERS
        if plain or makes_nothing(word) or word in lexicon.VAGUE:
            return True
        general = lexicon.STACK_NOUNS | lexicon.ITEMS | lexicon.PIECES | lexicon.ROWS
        if any(form in general for form in forms) or link_at(self._tokens, at):
            return True
        # What goes before another noun describes it.
        return inner

    def _is_no_thing(self, at: int) -> bool:
        """Whether what the catalogue has by the name of the word at `at` is not what is meant: "the light"."""
        word, before = self._words[at], self._words[at - 1] if at else ""
        if before in ("a", "an") or before in lexicon.NUMBERS:
            return False
        noun = before in lexicon.DETERMINERS or before in lexicon.POSSESSIVES or is_modifier(before)
        done = base_verb(word) is not None and self._words[at + 1] in lexicon.DETERMINERS | lexicon.POSSESSIVES
        return is_quality(word) or (done and not noun)

    def _noun(self, at: int) -> bool:
        word = self._words[at]
        return makes_nothing(word) and not (
            self._acts(at) or link_at(self._tokens, at) or word in JOINERS or word in FINITE
        )


def _is_told(word: str) -> bool:
    """Whether a table has `word`, or its ending tells that it names no thing."""
    forms = {word, *singulars(word)}
    tables = (lexicon.STACK_NOUNS, lexicon.ITEMS, lexicon.PIECES, lexicon.COLLECTIVES, lexicon.ROWS, lexicon.PORTIONS,
              lexicon.SHAPES, lexicon.MEALS, lexicon.NUMBERS, lexicon.VAGUE, JOINERS, PACKED)  # fmt: skip
    generic = {part for name in lexicon.GENERICS for part in name.split()}
    return (
        makes_nothing(word) or is_modifier(word) or bool(generic & forms) or any(forms & set(each) for each in tables)
    )
