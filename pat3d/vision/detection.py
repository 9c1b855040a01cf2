"""Objects of a picture found by words: a role, and the adapters for models of transformers.

Grounding DINO says in which boxes a phrase is seen, SAM and SAM 2 which pixels of a box are the object's; SAM 3 does
both. Every phrase is looked for alone: asked for several at once, detectors answer with pieces of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import ModelError
from pat3d.vision.models import EXAMPLES, VARIABLES, loaded, model_type

LEAST_SCORE = 0.25
"""Below which a box or a mask is not believed."""
MOST_BOXES = 32
"""Of one phrase."""
_OF_WORDS = ("sam3", "sam3_video")
_OF_BOXES = ("sam", "sam2", "sam2_video", "sam_hq")


@dataclass(frozen=True, kw_only=True, eq=False)
class Found:
    """Something in a picture that a phrase may mean."""

    phrase: str
    score: float
    """From 0 to 1."""
    mask: NDArray[np.bool_]
    """Its pixels, shape (height, width)."""


class Finder(Protocol):
    """Finds objects by words."""

    @property
    def name(self) -> str:
        """As reports name it."""
        ...

    def find(self, picture: NDArray[np.uint8], phrase: str) -> list[Found]:
        """Everything in an RGB picture, shape (height, width, 3), that `phrase` may mean; the likeliest first."""
        ...


class GroundedSegmentation:
    """A detector of boxes, and a model that says which of their pixels are the object's."""

    def __init__(self, detection: str, segmentation: str, *, device: str = "cpu") -> None:
        """Load both models, by their names on the hub or their folders.

        Raises:
            ModelError: one cannot be loaded.
        """
        self.name, self._device = f"{detection} and {segmentation}", device
        self._dino = loaded(
            "detection",
            detection,
            device,
            lambda one: one.AutoModelForZeroShotObjectDetection,
            lambda one: one.AutoProcessor,
        )
        self._sam = loaded(
            "segmentation",
            segmentation,
            device,
            lambda one: one.AutoModelForMaskGeneration,
            lambda one: one.AutoProcessor,
        )

    def find(self, picture: NDArray[np.uint8], phrase: str) -> list[Found]:
        """See `Finder`.

        Raises:
            ModelError: a model answers with something else than boxes and masks.
        """
        scores, boxes = self._boxes(picture, phrase)
        if not len(boxes):
            return []
        masks = self._masks(picture, boxes)
        return [Found(phrase=phrase, score=float(s), mask=mask) for s, mask in zip(scores, masks, strict=True)]

    def _boxes(self, picture: NDArray[np.uint8], phrase: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Scores, the highest first, and boxes [pixel] (left, upper, right, lower), shape (n, 4), in the picture."""
        import torch

        processor, model = self._dino
        height, width = picture.shape[:2]
        with torch.inference_mode():
            inputs = processor(images=picture, text=[[phrase]], return_tensors="pt").to(self._device)
            found = processor.post_process_grounded_object_detection(
                model(**inputs), threshold=LEAST_SCORE, target_sizes=[(height, width)]
            )[0]
        scores, boxes = (found[key].double().cpu().numpy() for key in ("scores", "boxes"))
        order = np.argsort(-scores, kind="stable")[:MOST_BOXES]
        scores, boxes = scores[order], np.clip(boxes[order], 0.0, [width, height, width, height])
        whole = np.isfinite(scores) & (boxes[:, 2] - boxes[:, 0] >= 1.0) & (boxes[:, 3] - boxes[:, 1] >= 1.0)
        return scores[whole], boxes[whole]

    def _masks(self, picture: NDArray[np.uint8], boxes: NDArray[np.float64]) -> NDArray[np.bool_]:
        """The best mask of every box, shape (n, height, width)."""
        import torch

        processor, model = self._sam
        with torch.inference_mode():
            inputs = processor(images=picture, input_boxes=[boxes.tolist()], return_tensors="pt").to(self._device)
            outputs = model(**inputs, multimask_output=True)
            # SAM pads its pictures, and has to be told by how much; its successors do not.
            padded = {key: inputs[key] for key in ("reshaped_input_sizes",) if key in inputs}
            masks = processor.post_process_masks(outputs.pred_masks, original_sizes=inputs["original_sizes"], **padded)
            best = outputs.iou_scores[0].argmax(dim=-1)
            chosen = masks[0][torch.arange(len(best)), best.cpu()]
        return _checked(chosen.bool().cpu().numpy(), len(boxes), picture)


class ConceptSegmentation:
    """A model that finds the masks of words by itself: SAM 3."""

    def __init__(self, segmentation: str, *, device: str = "cpu") -> None:
        """Load the model, by its name on the hub or its folder.

        Raises:
            ModelError: it cannot be loaded.
        """
        self.name, self._device = segmentation, device
        self._sam = loaded(
            "segmentation", segmentation, device, lambda one: one.Sam3Model, lambda one: one.Sam3Processor
        )

    def find(self, picture: NDArray[np.uint8], phrase: str) -> list[Found]:
        """See `Finder`.

        Raises:
            ModelError: the model answers with something else than masks.
        """
        import torch

        processor, model = self._sam
        with torch.inference_mode():
            inputs = processor(images=picture, text=phrase, return_tensors="pt").to(self._device)
            found: dict[str, Any] = processor.post_process_instance_segmentation(
                model(**inputs), threshold=LEAST_SCORE, target_sizes=[picture.shape[:2]]
            )[0]
        scores = found["scores"].double().cpu().numpy()
        if not len(scores):
            return []
        masks = _checked(found["masks"].bool().cpu().numpy(), len(scores), picture)
        order = np.argsort(-scores, kind="stable")[:MOST_BOXES]
        return [Found(phrase=phrase, score=float(scores[k]), mask=masks[k]) for k in order if np.isfinite(scores[k])]


def finder_named(detection: str | None, segmentation: str | None, *, device: str = "cpu") -> Finder:
    """What finds objects with the models of these names.

    Raises:
        ModelError: they are not named, of no known kind, or cannot be loaded.
    """
    if segmentation is None:
        raise ModelError(
            f"no model can find the objects: set {VARIABLES['segmentation']} (such as {EXAMPLES['segmentation']}) and "
            f"{VARIABLES['detection']} (such as {EXAMPLES['detection']}), or segmentation and detection in [vision] of "
            "pat3d.toml."
        )
    kind = model_type("segmentation", segmentation)
    if kind in _OF_WORDS:
        return ConceptSegmentation(segmentation, device=device)
    if kind not in _OF_BOXES:
        raise ModelError(
            f'segmentation model "{segmentation}" is of kind "{kind}"; valid: {", ".join((*_OF_BOXES, *_OF_WORDS))}.'
        )
    if detection is None:
        raise ModelError(
            f'"{segmentation}" needs boxes to look into: set {VARIABLES["detection"]}, or [vision] detection in '
            f"pat3d.toml, to the name or the folder of a model such as {EXAMPLES['detection']}."
        )
    return GroundedSegmentation(detection, segmentation, device=device)


def _checked(masks: NDArray[np.bool_], count: int, picture: NDArray[np.uint8]) -> NDArray[np.bool_]:
    if masks.shape != (count, *picture.shape[:2]):
        raise ModelError(f"the segmentation model gives masks of shape {masks.shape} for a picture {picture.shape}.")
    return masks
