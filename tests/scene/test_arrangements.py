"""Objects with several carriers, arrangements and postures as a scene holds them."""

from dataclasses import replace
from pathlib import Path
from typing import get_args

import pytest

from pat3d.assets.shapes import box
from pat3d.envs.tasks.task import children
from pat3d.errors import SpecError
from pat3d.generation.optimize_stage import arranged
from pat3d.scene.arrangements import ARRANGEMENTS, POSTURES, Arrangement, ArrangementKind, Posture, PostureKind
from pat3d.scene.model import Relation, Scene, check_tree
from pat3d.scene.relations import (
    LATERAL_KINDS,
    RELATION_WORDS,
    SUPPORT_KINDS,
    RelationKind,
    built_together,
    carriers_of,
)
from tests.scenes import asset_of, placed, scene_of

BLOCK = asset_of(box(0.05, 0.05, 0.05))


def on(child: str, *parents: str, kind: RelationKind = "on") -> tuple[Relation, ...]:
    return tuple(Relation(child=child, kind=kind, parent=parent) for parent in parents)


def bridge(**settings) -> Scene:
    things = [placed(name, BLOCK, (k, 0, 0)) for k, name in enumerate(("a", "b", "plank", "mug", "far"))]
    return scene_of(*things, relations=(*on("plank", "a", "b"), *on("mug", "plank")), **settings)


def test_every_kind_is_declared_with_its_words_and_meaning():
    assert set(ARRANGEMENTS) == set(get_args(ArrangementKind))
    assert set(POSTURES) == set(get_args(PostureKind))
    assert set(RELATION_WORDS) == SUPPORT_KINDS | LATERAL_KINDS
    assert all(rule.words and rule.holds for rule in ARRANGEMENTS.values())


def test_what_lies_on_two_things_rests_on_both():
    scene = bridge()
    assert scene.carriers("plank") == ("a", "b")
    assert scene.carriers("a") == ("ground",)
    assert scene.parent("plank") == "a"
    assert children(scene, "a") == children(scene, "b") == ("plank",)


@pytest.mark.parametrize(
    ("relations", "words"),
    [
        ((*on("c", "a"), *on("c", "b", kind="in")), "two supports"),
        ((*on("c", "a"), *on("c", "a")), "said twice"),
        ((*on("c", "a"), *on("c", "ground")), "two supports"),
        ((*on("c", "a", "b"), *on("b", "c")), "cycle: b -> c -> b"),
        ((*on("c", "a", "b"), *on("a", "d"), *on("d", "c")), "cycle: a -> d -> c -> a"),
    ],
)
def test_carriers_that_make_no_sense_are_refused(relations, words):
    with pytest.raises(SpecError, match=words):
        check_tree(["a", "b", "c", "d"], relations)


def test_a_pyramid_is_one_structure():
    relations = (*on("d", "a", "b"), *on("e", "b", "c"), *on("f", "d", "e"), *on("g", "f"))
    names = list("abcdefgh")
    assert check_tree(names, relations) is None
    assert built_together(names, relations) == dict.fromkeys("abcdef", "a")
    assert carriers_of("f", relations) == ("d", "e")


def test_a_scene_refuses_arrangements_of_what_it_does_not_have():
    with pytest.raises(SpecError, match='"nothing", which is not in the scene'):
        bridge(arrangements=(Arrangement(kind="far_from", objects=("a",), of=("nothing",)),))


def test_a_posture_is_the_angle_of_the_vertical():
    turned = Posture(object="a", kind="on_its_side")
    assert turned.holds((1.0, 0.0, 0.0)) == (True, pytest.approx(90.0))
    assert not turned.holds((0.6, 0.0, 0.8))[0]
    assert Posture(object="a", kind="upside_down").holds((0.0, 0.0, -1.0))[0]
    with pytest.raises(SpecError, match='unknown posture "lying"'):
        Posture(object="a", kind="lying")  # type: ignore[arg-type]


def test_the_optimisation_leaves_alone_what_it_does_not_know_of():
    """Everything that carries it stays too: moving a block would move the plank."""
    assert arranged(bridge()) == {"a", "b", "plank"}
    row = bridge(arrangements=(Arrangement(kind="row", objects=("mug", "far")),))
    assert arranged(row) == {"a", "b", "plank", "mug", "far"}
    plain = replace(row, relations=on("mug", "a"), arrangements=())
    assert arranged(plain) == set()


def test_every_specification_of_the_scenes_page_is_valid(tmp_path):
    from pat3d.generation.spec import load_spec

    page = Path(__file__).parents[2] / "docs" / "scenes.md"
    blocks = [block.partition("```")[0] for block in page.read_text().split("```yaml\n")[1:]]
    shown = [block for block in blocks if "mesh:" not in block]
    assert len(shown) >= 9
    for block in shown:
        (tmp_path / "scene.yaml").write_text(block)
        load_spec(tmp_path / "scene.yaml")
    assert [kind for kind in [*ARRANGEMENTS, "upside_down", "on_its_side"] if kind not in "".join(shown)] == []
