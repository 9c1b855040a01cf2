"""Constructions that are rare and not read: a note, or a refusal, has their words, and no plan is silently another."""

from __future__ import annotations

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "said"),
    [
        ("Between every two vases lies a nut.", '"between every two"'),
        ("Between each pair of vases on the bench is a nut.", '"between each pair"'),
        ("A row of four white vases with a nut between each.", "between more than two"),
        ("Three plates stand in a row, a fork between each pair.", '"pair"'),
        ("The cups outnumber the plates.", '"outnumber"'),
        ("More pears in the bowl than on the table.", '"than"'),
        ("Four lemons are in two bowls, two in each.", '"two in each"'),
        ("Table for four; each setting has a plate and a cup.", '"for four"'),
        ("A table is set for 6 people: at each seat there is a plate and a spoon.", '"for 6 people"'),
        ("A bench with a loose plate and three stacked ones", '"three stacked ones"'),
        ("Two stacks of boxes, each three high, on a pallet.", '"high"'),
        ("There are four mugs on a shelf. Every mug but one holds a pen.", "Every mug but one"),
        ("Three hats, all grey but for one pink one.", '"for one pink one"'),
        ("A tray that lacks a cup and a plate.", '"a plate" is read as there'),
        ("A cup holds one pencil, another two pencils and the third a pen.", "another two pencils"),
        ("Wherever there is a tray there is a mug on it.", "Wherever there is a tray"),
        ("The number of hats in the crate is four.", "The number of hats"),
        ("Bowls, of which there are two, stand on a counter.", '"Bowls": 3 assumed'),
        ("There are two cups, one is red and the other is not.", '"not"'),
        ("One boot is under the chair, the other nowhere to be seen.", '"nowhere"'),
        ("Swimming in the pool are four rubber ducks.", '"Swimming"'),
        ("Fetch whichever of the two jugs is bigger.", '"whichever"'),
        ("Grab the red cup as the other arm grabs the blue cup.", '"the other arm grabs"'),
        ("Make room on the tray by moving the glass to the mat.", '"by moving'),
        ("Check whether the jar is empty and put it on the tray.", '"whether"'),
        ("keeping the mug on the tray, put the pear in it", '"keeping"'),
        ("Stack three bricks so that the white one is at the bottom and the blue one on top.",
         "so that the white one is at the bottom"),
    ],
)  # fmt: skip
def test_what_is_not_read_is_named(prompt: str, said: str):
    try:
        told = " ".join(PLANNER.plan(prompt).notes)
    except PromptError as refused:
        told = str(refused)
    assert said in told
