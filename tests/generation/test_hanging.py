"""From a sentence to a swing that hangs still: every stage, with MuJoCo as the judge."""

from dataclasses import replace

import numpy as np
import pytest

from pat3d.assets.catalogue import make
from pat3d.check.certificate import certify
from pat3d.check.penetration import penetration
from pat3d.check.settle import settle_in_mujoco
from pat3d.exporters.mjcf.writer import write_mjcf
from pat3d.layout.layout import arrange
from pat3d.layout.predicates import check_relations
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.scene.model import Scene, SceneObject
from pat3d.sim.model import ModelBuilder, poses_from_states
from pat3d.sim.settling import settle


def at_rest(prompt: str, seed: int) -> Scene:
    plan = GrammarPlanner().plan(prompt)
    assets = {obj.name: make(obj.noun, scale=obj.scale, seed=seed) for obj in plan.objects}
    layout = arrange(assets, plan.relations, seed=seed)
    scene = Scene(
        objects=tuple(
            SceneObject(name=name, asset=asset, pose=layout.poses[name], initial_pose=layout.poses[name])
            for name, asset in assets.items()
        ),
        relations=plan.relations,
        attachments=layout.attachments,
    )
    builder = ModelBuilder()
    builder.add_scene(scene)
    model = builder.finalize("cpu")
    settled = settle(model)
    assert settled.at_rest.all()
    poses = poses_from_states(model, settled.q)
    return replace(
        scene, objects=tuple(replace(obj, pose=pose) for obj, pose in zip(scene.objects, poses, strict=True))
    )


@pytest.mark.parametrize(
    ("prompt", "seed"),
    [
        ("A swing hanging from a tree.", 0),
        ("A swing hanging from a tree with a teddy bear on the swing.", 1),
        ("A chair hanging from a tree.", 0),
    ],
)
def test_what_hangs_from_a_tree_is_verified_and_hangs_still_in_mujoco(prompt, seed, tmp_path):
    scene = at_rest(prompt, seed)
    hung = scene.attachments[0]
    on_child, on_parent = hung.ends(scene[hung.child].pose, scene[hung.parent].pose)
    # Gravity strains the affine body by 1e-5 of the two metres between its anchors and its seat.
    np.testing.assert_allclose(on_child, on_parent, atol=5e-5)
    assert certify(scene).passed
    assert not penetration(scene).hulls
    results = check_relations(
        scene.relations,
        {obj.name: obj.asset for obj in scene.objects},
        {obj.name: obj.pose for obj in scene.objects},
        attachments=scene.attachments,
    )
    assert all(result.holds for result in results), results
    report = settle_in_mujoco(write_mjcf(scene, tmp_path / "mjcf"))
    assert report.passed, report
    # The tree stands: its own weight and the swing's are over its roots.
    assert scene["tree"].pose.rotation[2, 2] > 1 - 1e-9


def test_the_ropes_of_a_swing_end_at_its_anchors():
    swing = make("swing", scale=0.5, seed=3)
    top = swing.bounds[1, 2]
    ends = np.unique(
        np.round([part.bounds.mean(axis=0)[0] for part in swing.parts if part.bounds[1, 2] > top - 1e-6], 6)
    )
    np.testing.assert_allclose(sorted(point[0] for point in swing.anchors), ends, atol=1e-5)
    np.testing.assert_allclose([point[2] for point in swing.anchors], top)
