"""Masses from a table."""

import pytest

from pat3d.errors import SpecError
from pat3d.generation.masses import read_masses


def table(folder, text):
    path = folder / "masses.csv"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("text", ["mug,0.31\nred_bowl,0.5\n", "name,kg\nmug.obj, 0.31\n\nRed Bowl,0.5,note\n"])
def test_rows_name_meshes_with_or_without_suffix_and_heading(tmp_path, text):
    assert read_masses(table(tmp_path, text), {"mug", "red_bowl", "can"}) == {"mug": 0.31, "red_bowl": 0.5}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("mug,heavy\nmug,1", None),
        ("mug,1\nmug,heavy", 'line 2: "heavy" is no mass'),
        ("mug,-1", "more than 0 kg"),
        ("mug,nan", "more than 0 kg"),
        ("mug", "a name and a mass"),
        ("cup,1", 'no mesh is called "cup". Known: mug'),
        ("mug,1\nmug.obj,2", "twice"),
    ],
)
def test_a_row_that_is_wrong_is_named_with_its_line(tmp_path, text, message):
    path = table(tmp_path, text)
    if message is None:
        assert read_masses(path, {"mug"}) == {"mug": 1.0}
        return
    with pytest.raises(SpecError, match=message.replace(".", r"\.")):
        read_masses(path, {"mug"})
