"""Plain sentences and what a person reads in them: every object by name, every relation, the task.

What a person reads was labelled before the program ran, but for the rows behind a remark; the table has it in the
names of the plan.
"""

from pathlib import Path

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()
_ROWS = [
    line.split("\t") for line in Path(__file__).with_name("sentences.tsv").read_text().splitlines() if line[0] != "#"
]


def _listed(cell: str) -> list[str]:
    return sorted(cell.split("; ")) if cell else []


@pytest.mark.parametrize(("sentence", "objects", "relations", "task"), _ROWS, ids=[row[0][:60] for row in _ROWS])
def test_a_plain_sentence_is_read_as_a_person_reads_it(sentence: str, objects: str, relations: str, task: str):
    plan = PLANNER.plan(sentence)
    assert sorted(obj.name for obj in plan.objects) == _listed(objects)
    below = [one for one in plan.held() if one.kind == "under"]
    assert sorted(map(str, (*plan.relations, *below))) == _listed(relations)
    assert (plan.task or "") == task
