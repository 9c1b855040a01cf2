"""Which of the masks that a finder offers are the objects of a picture."""

import numpy as np
import pytest

from pat3d.errors import ModelError
from pat3d.vision.detection import Found
from pat3d.vision.finding import Sought, find_masks, sought_of

PICTURE = np.zeros((60, 80, 3), dtype=np.uint8)


def rectangle(left, upper, right, lower):
    mask = np.zeros((60, 80), dtype=bool)
    mask[upper:lower, left:right] = True
    return mask


class Offering:
    """Offers what it was made with."""

    name = "offering"

    def __init__(self, **offers):
        self.offers = offers

    def find(self, picture, phrase):
        return [Found(phrase=phrase, score=score, mask=mask) for score, mask in self.offers.get(phrase, [])]


def test_names_with_numbers_are_several_of_a_kind():
    assert sought_of(["book 1", "red mug", "book 2"]) == (Sought(phrase="book", count=2), Sought(phrase="red mug"))


def test_the_likeliest_are_taken_as_many_as_are_sought_and_none_twice():
    books = [(0.9, rectangle(40, 0, 60, 20)), (0.8, rectangle(41, 0, 60, 20)), (0.7, rectangle(0, 30, 20, 50))]
    books += [(0.3, rectangle(60, 40, 80, 60))]
    found = find_masks(PICTURE, [Sought(phrase="book", count=2)], Offering(book=books))
    assert found.phrases == ("book", "book")
    assert found.scores == (0.7, 0.9)
    assert np.array_equal(found.values == 1, books[2][1])
    assert np.array_equal(found.values == 2, books[0][1])
    assert not found.notes


def test_two_words_for_one_thing_give_one_object():
    offers = {"mug": [(0.6, rectangle(0, 0, 20, 20))], "cup": [(0.7, rectangle(0, 0, 20, 21))]}
    found = find_masks(PICTURE, [Sought(phrase="mug"), Sought(phrase="cup")], Offering(**offers))
    assert found.phrases == ("cup",)
    assert found.notes == ('0 of 1 "mug" found by offering',)


def test_what_stands_on_a_table_lies_over_its_mask_and_what_is_covered_is_no_object():
    table, mug = rectangle(0, 20, 80, 60), rectangle(30, 25, 50, 45)
    under = rectangle(32, 27, 48, 43)
    offers = {"table": [(0.9, table)], "mug": [(0.5, mug)], "plate": [(0.9, under)]}
    found = find_masks(PICTURE, [Sought(phrase="table"), Sought(phrase="mug")], Offering(**offers))
    assert found.phrases == ("table", "mug") or found.phrases == ("mug", "table")
    number = 1 + found.phrases.index("mug")
    assert np.array_equal(found.values == number, mug)
    assert np.array_equal(found.values > 0, table | mug)


def test_masks_of_few_pixels_are_none_and_nothing_at_all_is_refused():
    specks = {"mug": [(0.9, rectangle(0, 0, 3, 3))], "book": [(0.9, np.zeros((60, 80), dtype=bool))]}
    with pytest.raises(ModelError, match="finds nothing of: mug, book"):
        find_masks(PICTURE, [Sought(phrase="mug"), Sought(phrase="book")], Offering(**specks))
