"""Numbers in attributes of XML files: as many as asked for, all of them finite, or an error that says where."""

import numpy as np
import pytest

from pat3d.errors import ExportError
from pat3d.exporters.common.xml_files import numbers

WHERE = "scene.xml, body"


def test_numbers_are_read_between_any_white_space():
    np.testing.assert_array_equal(numbers(" 1 -2.5e-3\n\t3 ", 3, WHERE), [1.0, -2.5e-3, 3.0])
    assert numbers(None, 0, WHERE).shape == numbers("  ", 0, WHERE).shape == (0,)


@pytest.mark.parametrize("words", [None, "", "1 2", "1 2 3 4", "1 nan 3", "inf 2 3", "1 2 -inf"])
def test_other_than_so_many_finite_numbers_are_refused_with_the_place_and_the_words(words):
    with pytest.raises(ExportError) as refused:
        numbers(words, 3, WHERE)
    assert str(refused.value) == f'{WHERE}: expected 3 finite numbers, got "{words}".'


def test_what_is_no_number_is_refused_with_the_place_and_the_word():
    with pytest.raises(ExportError, match=f"^{WHERE}: .*'two'"):
        numbers("1 two 3", 3, WHERE)
