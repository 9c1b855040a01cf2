"""Axes of perturbation one at a time: levels, paired episodes, what each axis changes, and the curves."""

from __future__ import annotations

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from pat3d.cli.main import main
from pat3d.errors import EvaluationError
from pat3d.policies_eval.analysis.curves import curves, drawing, lines_of
from pat3d.policies_eval.run.axes import STRENGTHS, episodes_along, levels
from pat3d.policies_eval.run.episodes import Setting, episodes_of
from pat3d.policies_eval.run.perturb import LIMITS, Noise, Perturbation

MUG = Setting(scene="", task="pick:red mug")


def test_every_axis_has_strengths_within_its_limits():
    assert set(STRENGTHS) == set(LIMITS)
    for name, values in STRENGTHS.items():
        assert list(values) == sorted(values)
        assert all(Perturbation(**{name: value}).active == (name,) for value in values)


def test_levels_are_the_plain_one_and_every_axis_alone():
    found = levels(["all"])
    assert found[0] == Perturbation()
    assert len(found) == 1 + sum(map(len, STRENGTHS.values())) == len(set(found))
    assert all(len(one.active) == 1 for one in found[1:])
    assert levels(["pose=0.01,0.2", "words"])[1:] == (
        Perturbation(pose=0.01), Perturbation(pose=0.2), Perturbation(words=1.0),
    )  # fmt: skip


@pytest.mark.parametrize(
    ("names", "said"),
    [
        (["gravity"], "Axes: all, pose"),
        (["all=3"], "no axis"),
        (["all", "pose"], '"pose" is named twice'),
        (["pose=a"], "are numbers"),
        (["pose=0.2,0.1"], "growing"),
        (["pose=0"], "above 0"),
        (["pose=9"], r"0 to 0\.3"),
    ],
)
def test_what_is_no_axis_is_told(names, said):
    with pytest.raises(EvaluationError, match=said):
        levels(names)


def test_every_level_has_the_same_episodes_and_a_longer_run_extends_a_shorter_one():
    along = levels(["pose", "mass"])
    few, many = episodes_along([MUG], 3, along, seed=5), episodes_along([MUG], 8, along, seed=5)
    assert few == many[: len(few)]
    assert [one.index for one in many] == list(range(8 * 7))
    plain = episodes_of([MUG], 8, seed=5)
    for level, perturbation in enumerate(along):
        own = many[level :: len(along)]
        assert {one.perturbation for one in own} == {perturbation}
        assert [(one.scene, one.task, one.seed) for one in own] == [(p.scene, p.task, p.seed) for p in plain]


def evaluation(outcomes):
    """Of axes pose 0.1 and 0.2; `outcomes` are those of every level."""
    along = levels(["pose=0.1,0.2"])
    episodes = episodes_along([MUG], len(outcomes[0]), along)
    results = [SimpleNamespace(episode=one, success=bool(outcomes[one.index % 3][one.index // 3])) for one in episodes]
    return SimpleNamespace(manifest={"source": {"levels": 3}}, results=results)


def test_curves_count_each_level_and_compare_it_with_the_plain_one_in_pairs():
    found = curves(evaluation([[1, 1, 1, 1, 0], [1, 1, 0, 1, 0], [0, 0, 0, 0, 1]]))  # type: ignore[arg-type]
    assert list(found) == ["pose"]
    plain, weak, strong = found["pose"]
    assert [(one.strength, one.rate.successes, one.rate.episodes) for one in found["pose"]] == [
        (0.0, 4, 5), (0.1, 3, 5), (0.2, 1, 5),
    ]  # fmt: skip
    assert plain.paired is None
    assert weak.paired is not None
    assert (weak.paired.only_first, weak.paired.only_second) == (1, 0)
    assert strong.paired is not None
    assert (strong.paired.only_first, strong.paired.only_second) == (4, 1)
    # Five pairs that differ, four one way: 2 * (1 + 5) / 2^5.
    assert strong.paired.p_value == pytest.approx(0.375)
    said = lines_of(found)
    assert said[0].startswith("without perturbation: 80.0 %")
    assert "pose 0.2: 20.0 %" in said[2]
    assert "-60.0 points" in said[2]
    assert ", +0.0 points" in lines_of(curves(evaluation([[1], [1], [1]])))[1]  # type: ignore[arg-type]
    assert drawing(found).count("<circle") == 3


def test_an_evaluation_that_was_not_along_axes_has_no_curves():
    assert curves(SimpleNamespace(manifest={"source": {}}, results=[])) == {}  # type: ignore[arg-type]


def test_noise_of_pictures_and_numbers_has_its_deviation():
    picture, depth = np.full((200, 200, 3), 128, np.uint8), np.full((200, 200, 1), 2.0, np.float32)
    seen = {"a_image": picture, "a_depth": depth, "a_segmentation": picture, "eef_pos": np.zeros(20_000, np.float32)}
    noisy = Noise(0.1, 3).on(seen)
    assert {name: value.dtype for name, value in noisy.items()} == {name: value.dtype for name, value in seen.items()}
    assert np.std(noisy["a_image"]) == pytest.approx(25.5, rel=0.02)
    assert np.std(noisy["a_depth"]) == pytest.approx(0.02, rel=0.02)
    assert np.std(noisy["eef_pos"]) == pytest.approx(0.01, rel=0.02)
    assert noisy["a_segmentation"] is picture
    np.testing.assert_array_equal(Noise(0.1, 3).on(seen)["a_image"], noisy["a_image"])
    assert (Noise(0.1, 4).on(seen)["a_image"] != noisy["a_image"]).any()
    assert Noise(0.0, 3).on(seen) is seen


def test_the_arm_starts_elsewhere_within_the_strength_and_touches_nothing(runner, episode):
    runner.start(episode)
    home = runner.env.simulation.arm.copy()
    _, _, drawn = runner.start(replace(episode, perturbation=Perturbation(start=0.3)))
    simulation = runner.env.simulation
    np.testing.assert_allclose(simulation.arm, home + drawn["start"], atol=1e-12)
    assert 0.05 < np.abs(drawn["start"]).max() <= 0.3
    assert not simulation.touching
    runner.start(episode)
    np.testing.assert_array_equal(runner.env.simulation.arm, home)


def test_a_hand_that_is_in_the_tray_touches_something(runner, episode):
    """What the posture is refused by sees a contact where there is one."""
    import mujoco

    runner.start(episode)
    simulation = runner.env.simulation
    simulation.data.qpos[simulation.arm_addresses[1]] += 1.0
    mujoco.mj_forward(simulation.model, simulation.data)
    assert simulation.touching
    runner.start(episode)
    assert not runner.env.simulation.touching


def test_another_background_is_seen_and_taken_back(runner, episode):
    """Table, floor and sky have other colours; the objects and the arm have theirs."""

    def picture():
        return runner.env.pictures.take("frontview", 64, 64, segmentation=True)

    runner.start(episode)
    model = runner.env.simulation.model
    before, texels, fog = picture(), model.tex_data.copy(), np.array(model.vis.rgba.fog)
    plain = before.segmentation == 0
    _, _, drawn = runner.start(replace(episode, perturbation=Perturbation(background=1.0)))
    assert set(drawn["background"]) == {"bench", "ground", "sky"}
    changed = picture()
    assert (model.tex_data != texels).any(), "the sky that OpenGL draws"
    differ = np.abs(changed.image.astype(int) - before.image).max(axis=2)
    assert (differ[plain] > 10).mean() > 0.9
    assert differ[~plain].max() == 0
    runner.start(episode)
    np.testing.assert_array_equal(picture().image, before.image)
    np.testing.assert_array_equal(model.tex_data, texels)
    np.testing.assert_array_equal(model.vis.rgba.fog, fog)


def test_one_command_evaluates_along_axes(tmp_path, capsys, monkeypatch):
    pytest.importorskip("pyarrow")
    pytest.importorskip("robosuite")
    # In this process, which has everything loaded.
    monkeypatch.setattr("pat3d.envs.suites.worker_pool.worker_count", lambda count: 0)
    out = tmp_path / "axes"
    command = ["evaluate", "--policy", "random", "--episodes", "1", "--max-steps", "3", "--out", str(out)]
    assert main([*command, "--no-pictures", "--axes", "words", "start=0.1", "noise=0.1"]) == 0
    printed = capsys.readouterr().out
    for line in ("without perturbation: 0.0 %", "start 0.1: 0.0 %", "noise 0.1: 0.0 %", "words 1: 0.0 %"):
        assert line in printed
    page = (out / "report.html").read_text()
    assert page.count("<figcaption>") == 3
    assert json.loads((out / "manifest.json").read_text())["source"]["levels"] == 4
    assert main([*command, "--perturb", "pose=0.1", "--axes", "all"]) == 2
    assert "leave out one of them" in capsys.readouterr().err
