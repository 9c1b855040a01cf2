"""How well the offline planner reads sentences whose meaning is known by construction.

    python benchmarks/composed.py [--family F] [--seed S] [--count N] [--show silent|noted|refused]

A small grammar (benchmarks/composing) draws a scene (objects with counts, colours, sizes and materials; what carries
them and what they stand beside; rows, stacks, corners; postures; a task) and words it in English in many ways, none of
which a person reads otherwise. Nothing of what is meant is read from the planner. A difference between plan and
meaning is silent unless a note names the words of what differs.
"""

from __future__ import annotations

import argparse
import re
import sys
import zlib
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from random import Random

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from benchmarks.composing.arranged import arrangement, posture
from benchmarks.composing.aside import aside
from benchmarks.composing.asked import instruction
from benchmarks.composing.captions import captions
from benchmarks.composing.clauses import clauses
from benchmarks.composing.compared import positions
from benchmarks.composing.dense import dense
from benchmarks.composing.extremes import extremes
from benchmarks.composing.household import household
from benchmarks.composing.meaning import Difference, Meaning, differences
from benchmarks.composing.mixed import mixed
from benchmarks.composing.nested import nested
from benchmarks.composing.parallel import several
from benchmarks.composing.scenes import contents, describe, groups, multi
from benchmarks.composing.shares import shares
from benchmarks.composing.singled import reference
from benchmarks.composing.steps import steps
from benchmarks.composing.terse import terse
from benchmarks.composing.wording import Draw
from pat3d.errors import PromptError
from pat3d.plan.grammar.meaning.tasks import SEVERAL
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

FAMILIES: dict[str, Callable[[Draw], str]] = {
    "groups": groups, "describe": describe, "several": several, "multi": multi, "posture": posture,
    "arrangement": arrangement, "contents": contents, "instruction": instruction, "reference": reference,
    "nested": nested, "shares": shares, "clauses": clauses, "mixed": mixed, "terse": terse, "steps": steps,
    "positions": positions, "captions": captions, "dense": dense, "household": household, "extremes": extremes,
    "aside": aside,
}  # fmt: skip
VERDICTS = ("right", "right with notes", "silently wrong", "refused")


@dataclass(frozen=True, kw_only=True)
class Judged:
    """What came of one sentence."""

    text: str
    verdict: str
    wrong: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    refusal: str = ""
    plan: ScenePlan | None = None


def compose(family: str, seed: int, number: int) -> tuple[str, Meaning]:
    """Sentence `number` of `family` in the series of `seed`, and what it means."""
    draw = Draw(Random(zlib.crc32(f"{family} {seed} {number}".encode())))
    return FAMILIES[family](draw), draw.meaning


def judge(planner: GrammarPlanner, text: str, meaning: Meaning) -> Judged:
    """How `planner` reads `text`, which means `meaning`."""
    try:
        plan = planner.plan(text)
    except PromptError as error:
        return Judged(text=text, verdict="refused", refusal=str(error))
    wrong = differences(meaning, plan)
    # That there are several steps says nothing of a step that is wrong.
    notes = tuple(note for note in (*plan.notes, *plan.set_aside) if not note.startswith(SEVERAL))
    silent = [each for each in wrong if not any(names(note, each, text, meaning) for note in notes)]
    verdict = "silently wrong" if silent else "right with notes" if wrong or plan.notes else "right"
    said = tuple(f"{'' if each in silent else '(noted) '}{each.said}" for each in wrong)
    return Judged(text=text, verdict=verdict, wrong=said, notes=notes, plan=plan)


def names(note: str, difference: Difference, text: str, meaning: Meaning) -> bool:
    """Whether `note` names what differs: a noun of it or a word for it; not by quoting all of `text`."""
    words = set(re.findall(r"[a-z-]+", note.lower()))
    if len(words & set(re.findall(r"[a-z-]+", text.lower()))) > 0.8 * len(set(text.lower().split())) > 6:
        return False
    heads = tuple(noun.split()[-1].rstrip("s").removesuffix("fe") for noun in difference.nouns)
    return any(word.startswith(heads) for word in words) or bool(words & {*difference.words, *meaning.words})


def main() -> None:
    """Print the verdicts of every family."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--family", choices=tuple(FAMILIES))
    arguments.add_argument("--seed", type=int, default=0)
    arguments.add_argument("--count", type=int, default=300)
    arguments.add_argument("--show", choices=("silent", "noted", "refused", "all"))
    options = arguments.parse_args()
    planner = GrammarPlanner()
    table: dict[str, Counter[str]] = {}
    for family in (options.family,) if options.family else FAMILIES:
        table[family] = Counter()
        for number in range(options.count):
            judged = judge(planner, *compose(family, options.seed, number))
            table[family][judged.verdict] += 1
            if options.show == "all" or (options.show and options.show in judged.verdict.replace("notes", "noted")):
                _show(judged, f"{family} {number}")
    print(f"{'':14}" + "".join(f"{verdict:>18}" for verdict in VERDICTS))
    for family, counts in table.items():
        print(f"{family:14}" + "".join(f"{counts[verdict]:>18}" for verdict in VERDICTS))
    whole = sum(table.values(), Counter[str]())
    print(f"{'all':14}" + "".join(f"{whole[verdict]:>18}" for verdict in VERDICTS))


def _show(judged: Judged, where: str) -> None:
    print(f"{where} {judged.verdict}: {judged.text}")
    for line in judged.wrong:
        print(f"    {line}")
    if judged.plan is not None:
        print(f"    {'; '.join(map(str, judged.plan.relations))} {judged.plan.task or ''}")
    for line in (*judged.notes, judged.refusal):
        if line:
            print(f"    - {line}")


if __name__ == "__main__":
    main()
