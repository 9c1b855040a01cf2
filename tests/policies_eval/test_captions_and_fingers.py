"""Captions that nothing covers, and a cloned policy whose fingers only open or close."""

from __future__ import annotations

import numpy as np
import pytest

from pat3d.policies_eval.strip import GAP, PAPER, write_strip


@pytest.mark.parametrize("height", [20, 240])
@pytest.mark.parametrize("texts", [("gypsy jump (q)",), ("pq", "Äg|"), ("", "done")])
def test_captions_stand_free_above_their_pictures(tmp_path, height, texts):
    """Between a caption's lowest ink and its picture there is a gap of paper at least, and none of it is covered."""
    image = pytest.importorskip("PIL.Image")
    from PIL import ImageDraw, ImageFont

    frame = np.full((height, 300, 3), 10, dtype=np.uint8)
    sheet = np.asarray(image.open(write_strip([(text, [frame]) for text in texts], tmp_path / "a.png")))
    paper = (sheet == PAPER).all(axis=(1, 2))
    (tops,) = np.nonzero((sheet[1:, GAP] == 10).all(axis=1) & ~(sheet[:-1, GAP] == 10).all(axis=1))
    assert len(tops) == len(texts)
    font = ImageFont.load_default(size=max(12, height // 14))
    above = 0
    for text, top in zip(texts, tops + 1, strict=True):
        assert paper[top - GAP : top].all()
        alone = image.new("L", (sheet.shape[1], 200))
        ImageDraw.Draw(alone).text((GAP, 50), text, fill=255, font=font)
        inked = np.flatnonzero(np.asarray(alone).max(axis=1) > 20)
        found = np.flatnonzero((sheet[above:top].min(axis=2) < 235).any(axis=1))
        assert (np.ptp(found) == np.ptp(inked)) if text else (len(found) == 0)
        above = top + height
    assert len(sheet) == above + GAP


@pytest.mark.parametrize(("bias", "fingers"), [(3.0, 1.0), (0.2, 1.0), (1e-3, 1.0), (-1e-3, -1.0), (-3.0, -1.0)])
def test_the_fingers_of_a_cloned_policy_open_or_close_and_the_hand_moves_as_the_network_says(tmp_path, bias, fingers):
    torch = pytest.importorskip("torch")
    from pat3d.policies_eval.policies.cloning import ClonedPolicy, make_network, save
    from pat3d.policies_eval.policies.policy import checked

    network = make_network(width=16, layers=1)
    said = torch.tensor([0.5, -0.25, 0.0, 1.0, -1.0, 0.125, bias])
    with torch.no_grad():
        network.body[-2].weight.zero_()
        network.body[-2].bias.copy_(said)
    save(network, tmp_path / "a.pt", {})
    identity = [1.0, 0.0, 0.0, 0.0]
    observation = {"eef_pos": [0.0] * 3, "eef_quat": identity, "gripper_pos": [0.0] * 2}
    action = ClonedPolicy(tmp_path / "a.pt").act(observation | {"target": [0.1] * 3 + identity + [0.2] * 3})
    np.testing.assert_allclose(action[:6], np.tanh(said[:6].numpy()), rtol=1e-6)
    assert action[6] == fingers
    # An action of full size is no policy error.
    values, clipped = checked(action, 7)
    np.testing.assert_array_equal(values, action[None])
    assert clipped == 0
