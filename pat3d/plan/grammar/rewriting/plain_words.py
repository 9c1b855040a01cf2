"""A prompt in plainer words, one construction after another, before it is cut into sentences."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from pat3d.plan.grammar.rewriting.acting import asked_of_the_robot
from pat3d.plan.grammar.rewriting.amounts import worked_out
from pat3d.plan.grammar.rewriting.beforehand import several_told_by_rank
from pat3d.plan.grammar.rewriting.carried_clauses import of_the_carried
from pat3d.plan.grammar.rewriting.compounds import compounds
from pat3d.plan.grammar.rewriting.drinks import of_drinks
from pat3d.plan.grammar.rewriting.meals import served
from pat3d.plan.grammar.rewriting.members_set_off import members_set_off
from pat3d.plan.grammar.rewriting.named_like_colours import blocks_of_colours
from pat3d.plan.grammar.rewriting.note_items import each_at_its_place
from pat3d.plan.grammar.rewriting.numbered import ordinals, steps
from pat3d.plan.grammar.rewriting.one_of_the_counted import of_the_counted
from pat3d.plan.grammar.rewriting.restated import chessmen
from pat3d.plan.grammar.rewriting.row_ends import at_row_ends
from pat3d.plan.grammar.rewriting.set_off_shares import told_behind
from pat3d.plan.grammar.rewriting.shorthand import known_again, out_of_brackets
from pat3d.plan.grammar.rewriting.sided_names import by_side
from pat3d.plan.grammar.rewriting.sized_names import by_size
from pat3d.plan.grammar.rewriting.subkinds import subkinds
from pat3d.plan.grammar.rewriting.terse import in_full
from pat3d.plan.grammar.rewriting.tiers import levels_of
from pat3d.plan.grammar.rewriting.told_by_rank import by_rank
from pat3d.plan.grammar.rewriting.unlike_rows import of_unlike_rows
from pat3d.plan.grammar.rewriting.verbs_like_names import without_names_of_verbs
from pat3d.plan.grammar.rewriting.wordings import in_usual_words
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.vocabulary import Nouns

Rewriting = Callable[[Sequence[Token], Nouns], list[Token]]


def in_plain_words(text: str, tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of `text` with what each rewriting knows in words that the grammar reads.

    Each finds what those before it have left: names are joined before numbers are worked out, and which of several
    things is meant is told last.
    """
    rewritings: tuple[Rewriting, ...] = (
        in_usual_words, without_names_of_verbs, partial(steps, text), partial(ordinals, text), compounds,
        several_told_by_rank, blocks_of_colours,
        members_set_off, partial(each_at_its_place, text), partial(out_of_brackets, text), asked_of_the_robot,
        of_the_counted, told_behind, of_drinks, known_again, in_full, served, worked_out, subkinds, by_side, by_size,
        of_the_carried, by_rank, at_row_ends, of_unlike_rows, levels_of,
    )  # fmt: skip
    tokens = chessmen(tokens)
    for rewrite in rewritings:
        tokens = rewrite(tokens, nouns)
    return list(tokens)
