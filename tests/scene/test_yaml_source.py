import pytest

from pat3d.errors import SpecError
from pat3d.scene.yaml_source import MAX_BYTES, read_yaml


@pytest.fixture
def write(tmp_path):
    def written(text):
        path = tmp_path / "file.yaml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return written


def test_words_that_old_yaml_takes_for_booleans_stay_words(write):
    document = read_yaml(write("a: [on, off, yes, no, true, false, null]")).document
    assert document["a"] == ["on", "off", "yes", "no", True, False, None]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e3", 1000.0),
        ("010", 10),
        ("-2", -2),
        ("+.5", 0.5),
        ("1:30", "1:30"),
        ("1_000", "1_000"),
        ('"1"', "1"),
        ("2020-01-01", "2020-01-01"),
        ("- 1", [1]),
    ],
)
def test_numbers_are_read_as_json_reads_them(write, text, value):
    found = read_yaml(write(text)).document
    assert found == value
    assert type(found) is type(value)


def test_every_value_has_the_line_of_its_key(write):
    source = read_yaml(write("a: 1\nb:\n  - c: 2\n    d: 3\n"))
    assert source.lines["a",] == (1, 1)
    assert source.lines["b", 0, "d"] == (4, 5)
    assert ":4:5: b[0].d: wrong." in str(source.error(("b", 0, "d"), "wrong."))
    assert ":4:5: b[0].d.e.f: " in str(source.error(("b", 0, "d", "e", "f"), "wrong."))


BOMB = "a: &a [x, x]\nb: &b [*a, *a]\nc: [*b, *b]\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "empty"),
        ("a: [1, 2", "not valid YAML"),
        ("a: 1\na: 2", ':2:1: the key "a" is repeated'),
        (BOMB, "anchors"),
        ("[" * 100_000, "nested deeper"),
        ("a: !!python/object/apply:os.system [ls]", "tag"),
        ("a: !thing b", "tag"),
        ("a: .nan", "finite"),
        ("a: -.inf", "finite"),
        ("a: 1e999", "finite"),
        ("a: " + "9" * 5000, "finite"),
        ("? [a, b]\n: c", "a key must be a word"),
        ("a: 1\n---\nb: 2", "not valid YAML"),
        ("a: \x07", "not valid YAML"),
        (b"a: \xff\xfe", "UTF-8"),
        ("a: " + "x" * MAX_BYTES, "bytes"),
    ],
)
def test_what_is_not_plain_yaml_is_one_clear_error(write, text, words):
    with pytest.raises(SpecError, match=words.replace("(", r"\(")) as caught:
        read_yaml(write(text))
    assert "\n" not in str(caught.value)


def test_a_missing_file_and_a_folder_are_named(tmp_path):
    with pytest.raises(SpecError, match=r"none\.yaml"):
        read_yaml(tmp_path / "none.yaml")
    with pytest.raises(SpecError, match="is a folder"):
        read_yaml(tmp_path)
