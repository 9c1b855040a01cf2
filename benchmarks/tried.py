"""Collects the wording of sentences whose reading is checked: pat3d/plan/audit/tried.txt, see pat3d.plan.audit.untried.

    PYTHONPATH=. python benchmarks/tried.py [--check]

Checked are the sentences that the tests of the planner have it read, the texts in all tests, the sentences of
language_fresh.tsv that are not silently misread, and composed ones whose reading is what they mean; a pattern counts
that two of them have. It runs the tests of the planner, which takes minutes. With `--check` nothing is written: the
patterns that the file lacks are counted.
"""

from __future__ import annotations

import argparse
import ast
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from unittest.mock import patch

import pytest

from benchmarks import composed, language
from pat3d.assets.catalogue import lookup
from pat3d.errors import PromptError
from pat3d.plan.audit.auditor import heard
from pat3d.plan.audit.untried import TRIED, tried
from pat3d.plan.audit.wording import patterns, worded
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.plan.scene_plan import ScenePlan

_TESTS = Path(__file__).resolve().parents[1] / "tests"
_LEFT_OUT = ("test_grammar_properties", "test_cut_off", "test_composed", "test_composing", "test_untried")
"""Tests whose texts are drawn by chance, cut off or worded as nothing is."""
_COMPOSED = 150
"""Sentences of each family, of a seed that no figure is measured with."""
_SEED = 7
_FEWEST = 3
"""Words of a sentence."""
_OFTEN = 2
"""Sentences that a pattern is in at least: what a single one has says as little as what none has."""


def texts() -> Iterator[str]:
    """What the tests of the planner have it read, and every string in tests."""
    read: list[str] = []
    plan = GrammarPlanner.readings

    def recording(planner: GrammarPlanner, prompt: str) -> tuple[ScenePlan, ...]:
        read.append(prompt)
        return plan(planner, prompt)

    with patch.object(GrammarPlanner, "readings", recording):
        left_out = [f"--ignore={_TESTS / 'plan' / name}.py" for name in _LEFT_OUT]
        pytest.main([str(_TESTS / "plan"), "-q", "--no-header", "--tb=no", "-p", "no:cacheprovider", *left_out])
    yield from read
    for path in sorted(path for path in _TESTS.rglob("*.py") if path.stem not in _LEFT_OUT):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                yield node.value


def checked(planner: GrammarPlanner) -> Iterator[ScenePlan]:
    """The plans of sentences whose reading is checked."""
    for text in dict.fromkeys(texts()):
        if text.count(" ") + 1 >= _FEWEST and len(text) < 1000:
            try:
                yield planner.plan(text)
            except PromptError:
                continue
    for _, said, _, label in language.fresh():
        try:
            plan = planner.plan(said)
        except PromptError:
            continue
        if language.judge(language.read_label(label), plan)[0] != "silently wrong":
            yield plan
    for family in composed.FAMILIES:
        for number in range(_COMPOSED):
            judged = composed.judge(planner, *composed.compose(family, _SEED, number))
            if judged.plan is not None and judged.verdict.startswith("right"):
                yield judged.plan


def main() -> None:
    """Write the file, or say what it lacks."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--check", action="store_true")
    only_check = arguments.parse_args().check
    find = Nouns(lookup).resolve
    counts = Counter(pattern for plan in checked(GrammarPlanner())
                     for pattern in {each for each, _, _ in patterns(worded(heard(plan, find), plan))})  # fmt: skip
    found = {pattern for pattern, count in counts.items() if count >= _OFTEN}
    if only_check:
        print(f"{len(found - tried())} of {len(found)} patterns are not in {TRIED.name}.")
        return
    rows: dict[str, set[str]] = defaultdict(set)
    for *first, last in found:
        rows[" ".join(first)].add(last)
    written = TRIED.with_suffix(".new")
    written.write_text("".join(f"{first}\t{' '.join(sorted(rows[first]))}\n" for first in sorted(rows)))
    written.replace(TRIED)
    print(f"{len(found)} patterns, {TRIED.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
