"""Detectors and segmenters: the real classes of transformers, of a few random weights, loaded as a user's are."""

import numpy as np
import pytest

from pat3d.errors import ModelError
from pat3d.vision.detection import LEAST_SCORE, ConceptSegmentation, GroundedSegmentation, finder_named
from tests.vision import tiny

pytestmark = pytest.mark.slow
PICTURE = np.random.default_rng(0).integers(0, 255, (60, 80, 3), dtype=np.uint8)


@pytest.mark.parametrize("segmenter", [tiny.sam, tiny.sam2])
def test_every_box_of_the_detector_becomes_the_segmenter_s_best_mask(tmp_path, segmenter):
    folders = tiny.grounding_dino(tmp_path / "dino"), segmenter(tmp_path / "sam")
    finder = finder_named(*folders)
    assert isinstance(finder, GroundedSegmentation)
    found = finder.find(PICTURE, "red mug")
    assert 1 <= len(found) <= 6
    scores = [one.score for one in found]
    assert scores == sorted(scores, reverse=True)
    assert min(scores) > LEAST_SCORE
    assert all(one.phrase == "red mug" and one.mask.shape == (60, 80) and one.mask.dtype == bool for one in found)

    import torch
    import transformers

    # What the models themselves say, without our choice of boxes and masks.
    processor = transformers.AutoProcessor.from_pretrained(folders[0])
    model = transformers.AutoModelForZeroShotObjectDetection.from_pretrained(folders[0]).eval()
    with torch.inference_mode():
        outputs = model(**processor(images=PICTURE, text="red mug.", return_tensors="pt"))
        likely = outputs.logits.sigmoid().max(dim=-1).values[0]
        order = likely.argsort(descending=True)
        x, y, wide, high = (outputs.pred_boxes[0][order] * torch.tensor([80.0, 60.0, 80.0, 60.0])).T
        boxes = torch.stack([x - wide / 2, y - high / 2, x + wide / 2, y + high / 2], dim=-1)
        boxes = boxes.clamp(min=torch.zeros(4), max=torch.tensor([80.0, 60.0, 80.0, 60.0]))
        large = ((boxes[:, 2:] - boxes[:, :2]) >= 1.0).all(dim=-1)
        boxes, likely = boxes[large], likely[order][large]
        assert scores == pytest.approx(likely.tolist(), abs=1e-6)
        processor = transformers.AutoProcessor.from_pretrained(folders[1])
        model = transformers.AutoModelForMaskGeneration.from_pretrained(folders[1]).eval()
        inputs = processor(images=PICTURE, input_boxes=[boxes.tolist()], return_tensors="pt")
        outputs = model(**inputs)
        padded = {"reshaped_input_sizes": inputs["reshaped_input_sizes"]} if segmenter is tiny.sam else {}
        masks = processor.post_process_masks(outputs.pred_masks, inputs["original_sizes"], **padded)[0]
    for k, one in enumerate(found):
        assert np.array_equal(one.mask, masks[k, int(outputs.iou_scores[0, k].argmax())].numpy())


def test_sam_3_finds_words_without_boxes(tmp_path):
    finder = finder_named(None, tiny.sam3(tmp_path / "sam", seed=3))
    assert isinstance(finder, ConceptSegmentation)
    found = finder.find(PICTURE, "a b")
    assert found
    assert all(one.mask.shape == (60, 80) and LEAST_SCORE < one.score <= 1.0 for one in found)
    assert [one.score for one in found] == sorted((one.score for one in found), reverse=True)
    assert all(np.array_equal(a.mask, b.mask) for a, b in zip(found, finder.find(PICTURE, "a b"), strict=True))
    # With other weights its scores are at most 0.21.
    assert finder_named(None, tiny.sam3(tmp_path / "unsure", seed=0)).find(PICTURE, "a b") == []


def test_what_is_missing_or_no_segmenter_is_said(tmp_path):
    with pytest.raises(ModelError, match="PAT3D_SEGMENTATION_MODEL"):
        finder_named(None, None)
    own = tiny.sam(tmp_path / "sam")
    with pytest.raises(ModelError, match="PAT3D_DETECTION_MODEL"):
        finder_named(None, own)
    with pytest.raises(ModelError, match="cannot be loaded"):
        finder_named(own, str(tmp_path / "no"))
    with pytest.raises(ModelError, match=r'detection model ".*" cannot be loaded'):
        finder_named(own, own)
    with pytest.raises(ModelError, match='is of kind "grounding-dino"'):
        finder_named(own, tiny.grounding_dino(tmp_path / "dino"))
