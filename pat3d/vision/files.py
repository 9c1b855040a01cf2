"""Pictures, depth, masks, labels and cameras in files, which may come from anybody: read within limits, or refused."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import SpecError
from pat3d.scene.yaml_source import read_yaml, validate
from pat3d.vision.camera import Pinhole
from pat3d.vision.intrinsics import depth_per_metre, require_same_shape
from pat3d.vision.observation import Observation
from pat3d.vision.stance import Facing, Posture, Stance

MAX_PIXELS = 50_000_000
MAX_BYTES = 256 * 2**20
WORKING_SIDE = 1280
"""Longest side of what is measured [pixel]; larger pictures are thinned."""
MAX_OBJECTS = 64
FILM_WIDTH = 36.0
"""Of the film that focal lengths in the notes of a photograph are told for [mm]."""
_FOCAL_LENGTH_ON_FILM = 41989
_CAMERA_NOTES = 0x8769
"""EXIF tags."""

_NAME = {"type": "string", "minLength": 1, "maxLength": 60, "pattern": "^[^/\\\\\\x00-\\x1f\\x7f]+$"}
_NOUN = {"type": "string", "minLength": 1, "maxLength": 120}
_POSITIVE = {"type": "number", "exclusiveMinimum": 0, "maximum": 1e6}

LABELS_SCHEMA: dict[str, Any] = {
    "type": "object",
    "properties": {
        "objects": {
            "type": "array",
            "minItems": 1,
            "maxItems": MAX_OBJECTS,
            "items": {
                "type": "object",
                "properties": {
                    "name": {**_NAME, "description": "Unique in the picture."},
                    "noun": {**_NOUN, "description": "Of the catalogue or a library; the name where not given."},
                    "value": {
                        "type": "integer",
                        "minimum": 1,
                        "maximum": 65535,
                        "description": "Of its pixels in the masks; its place in this list, from 1, where not given.",
                    },
                    "colours": {"type": "array", "items": _NAME, "maxItems": 8},
                    "material": _NAME,
                    "size": {**_POSITIVE, "description": "Longest side [m], if it is known."},
                    "posture": {"enum": list(get_args(Posture)), "description": "Usual, the default, or fallen."},
                    "facing": {"enum": list(get_args(Facing)), "description": "Where its front points in the picture."},
                },
                "required": ["name"],
                "additionalProperties": False,
            },
        },
        "depth": {
            "enum": ["metric", "relative"],
            "description": "Metres, the default; or right up to a factor, which then follows from the sizes.",
        },
        "least_occluded": {**_NAME, "description": "Name of the object of which least is hidden."},
    },
    "required": ["objects"],
    "additionalProperties": False,
}
"""Of the file of labels."""


@dataclass(frozen=True, kw_only=True)
class Label:
    """What somebody says of one object of a picture."""

    name: str
    noun: str
    value: int
    """Of its pixels in the masks."""
    colours: tuple[str, ...] = ()
    material: str | None = None
    size: float | None = None
    """Longest side [m]."""
    posture: Posture = "usual"
    facing: Facing = "unclear"

    @property
    def stance(self) -> Stance:
        """How it stands, as the label says."""
        return Stance(posture=self.posture, facing=self.facing)


@dataclass(frozen=True, kw_only=True)
class Labels:
    """What somebody says of a picture."""

    objects: tuple[Label, ...]
    metric: bool = True
    """Whether the depth is in metres, or right up to a factor."""
    least_occluded: str | None = None
    """Name of the object of which least is hidden; None where nobody says."""


def read_labels(path: Path) -> Labels:
    """The labels in a JSON or YAML file.

    Raises:
        SpecError: it cannot be read or is not as LABELS_SCHEMA says.
    """
    source = read_yaml(path)
    validate(source, LABELS_SCHEMA)
    found: list[Label] = []
    for number, entry in enumerate(source.document["objects"]):
        name, value = entry["name"].strip(), entry.get("value", number + 1)
        for key, taken, own in (
            ("name", [one.name for one in found], name),
            ("value", [one.value for one in found], value),
        ):
            if own in taken:
                raise source.error(("objects", number, key), f'two objects have the {key} "{own}".')
        if not name or name == "ground" or not name.isprintable():
            raise source.error(("objects", number, "name"), f'"{name}" cannot be the name of an object.')
        found.append(
            Label(
                name=name,
                noun=entry.get("noun", name).strip(),
                value=value,
                colours=tuple(entry.get("colours", ())),
                material=entry.get("material"),
                size=entry.get("size"),
                posture=entry.get("posture", "usual"),
                facing=entry.get("facing", "unclear"),
            )
        )
    least = source.document.get("least_occluded")
    if least is not None and least not in [one.name for one in found]:
        raise source.error(("least_occluded",), f'no object is called "{least}".')
    labels = Labels(
        objects=tuple(found),
        metric=source.document.get("depth", "metric") == "metric",
        least_occluded=least,
    )
    if not labels.metric and all(one.size is None for one in found):
        raise SpecError(f'{path}: depth that is "relative" needs the size of at least one object.')
    return labels


def read_picture(path: Path) -> tuple[NDArray[np.uint8], float | None]:
    """A PNG or JPEG: RGB, shape (height, width, 3), and the angle across its longer side [deg] where its notes say.

    Only the pixels are taken, so whatever else the file holds goes nowhere.

    Raises:
        SpecError: it cannot be read, or is too large.
    """
    from PIL import ImageOps

    image = _opened(path)
    try:
        film = image.getexif().get_ifd(_CAMERA_NOTES).get(_FOCAL_LENGTH_ON_FILM)
        focal = float(film) if isinstance(film, int | float) else 0.0
        pixels = np.array(ImageOps.exif_transpose(image).convert("RGB"))
    except (OSError, ValueError, SyntaxError, MemoryError) as error:
        raise SpecError(f"{path}: the picture cannot be read ({error}).") from error
    return pixels, float(np.degrees(2 * np.arctan(FILM_WIDTH / 2 / focal))) if 5.0 <= focal <= 500.0 else None


def read_depth(path: Path, camera: Path | None = None) -> NDArray[np.float32]:
    """Depth [m], shape (height, width): of an .npy file, or a 16-bit PNG in millimetres or as file `camera` says.

    What is not known is NaN, infinite or at most 0 there, and NaN in what is returned.

    Raises:
        SpecError: it cannot be read, or holds something else.
    """
    if path.suffix.lower() == ".npy":
        found = _array(path)
        if found.dtype.kind not in "fiu" or found.ndim != 2:
            raise SpecError(f"{path}: depth is an array of numbers, shape (height, width); got {_said(found)}.")
        depth = np.array(found, dtype=np.float32)
    else:
        image = _opened(path, formats=("PNG",))
        if not image.mode.startswith("I"):
            raise SpecError(f'{path}: depth as a PNG has 16 bits; this one is "{image.mode}".')
        depth = (_pixels(path, image) / depth_per_metre(camera)).astype(np.float32)
    with np.errstate(invalid="ignore"):
        depth[~(np.isfinite(depth) & (depth > 0.0))] = np.nan
    if np.isnan(depth).all():
        raise SpecError(f"{path}: no pixel has a depth; numbers greater than 0 are metres.")
    return depth


def read_masks(path: Path) -> NDArray[np.int32]:
    """The value of every pixel, 0 for no object, shape (height, width).

    The file is a PNG or .npy of such values, or an .npy of one mask an object, shape (objects, height, width), whose
    values are then 1, 2, ..., and of which later ones lie over earlier ones.

    Raises:
        SpecError: it cannot be read, or holds something else.
    """
    if path.suffix.lower() == ".npy":
        found = np.asarray(_array(path))
        if found.dtype.kind not in "biu" or found.ndim not in (2, 3):
            raise SpecError(f"{path}: masks are whole numbers or truth values; got {_said(found)}.")
    else:
        image = _opened(path, formats=("PNG",))
        if image.mode not in ("L", "P", "1") and not image.mode.startswith("I"):
            raise SpecError(f'{path}: masks as a PNG have one number a pixel; this one is "{image.mode}".')
        found = _pixels(path, image)
    if found.ndim == 2:
        return found.astype(np.int32)
    if len(found) > MAX_OBJECTS:
        raise SpecError(f"{path}: {len(found)} masks; at most {MAX_OBJECTS} are read.")
    values = np.zeros(found.shape[1:], dtype=np.int32)
    for number, layer in enumerate(found, start=1):
        values[layer != 0] = number
    return values


def instances_of(values: NDArray[np.int32], labels: Labels) -> NDArray[np.int32]:
    """1 + index of the label of every pixel, 0 for none, shape (height, width).

    Raises:
        SpecError: an object has no pixel.
    """
    instances = np.zeros(values.shape, dtype=np.int32)
    for number, one in enumerate(labels.objects, start=1):
        mask = values == one.value
        if not mask.any():
            there = ", ".join(map(str, np.unique(values)[:20]))
            raise SpecError(f'no pixel of the masks shows "{one.name}" (value {one.value}). Values: {there}.')
        instances[mask] = number
    return instances


def observed(
    *,
    picture: NDArray[np.uint8],
    depth: NDArray[np.float32],
    instances: NDArray[np.int32],
    labels: Labels,
    camera: Pinhole,
) -> Observation:
    """All of a picture at one size: that of the depth, or less where this is large.

    Raises:
        SpecError: they do not belong together.
    """
    height, width = depth.shape
    for what, shape in (("the picture", picture.shape[:2]), ("masks", instances.shape)):
        require_same_shape(what, shape[::-1], (width, height))
    thin = max(1, -(-max(width, height) // WORKING_SIDE))
    rows, columns = np.arange(thin // 2, height, thin), np.arange(thin // 2, width, thin)

    def thinned(array: NDArray[Any]) -> NDArray[Any]:
        """The pixels of `array` in the middles of the pixels that are kept."""
        return np.ascontiguousarray(like(array, depth)[rows][:, columns])

    own = camera.resized(width, height)
    # Pixel k of the thinned picture has its middle at (thin k + thin // 2 + 0.5) of the whole one.
    shift = thin // 2 + 0.5 - 0.5 * thin
    pinhole = replace(
        own,
        width=len(columns),
        height=len(rows),
        fx=own.fx / thin,
        fy=own.fy / thin,
        cx=(own.cx - shift) / thin,
        cy=(own.cy - shift) / thin,
    )
    return Observation(
        camera=pinhole,
        depth=thinned(depth),
        instances=thinned(instances),
        names=tuple(one.name for one in labels.objects),
        picture=thinned(picture),
    )


def like(array: NDArray[Any], other: NDArray[Any]) -> NDArray[Any]:
    """`array` with as many rows and columns as `other` has: the nearest pixels.

    Raises:
        SpecError: their proportions differ.
    """
    (high, wide), (height, width) = array.shape[:2], other.shape[:2]
    require_same_shape("a picture", (wide, high), (width, height))
    row = np.minimum(((np.arange(height) + 0.5) * high / height).astype(int), high - 1)
    column = np.minimum(((np.arange(width) + 0.5) * wide / width).astype(int), wide - 1)
    return array if array.shape[:2] == other.shape[:2] else array[row][:, column]


def _opened(path: Path, formats: tuple[str, ...] = ("PNG", "JPEG")) -> Any:
    """The picture at `path`, not decoded yet."""
    from PIL import Image, UnidentifiedImageError

    _check_size(path)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            image = Image.open(path, formats=formats)
    except (UnidentifiedImageError, Image.DecompressionBombError, OSError, ValueError, SyntaxError) as error:
        raise SpecError(f"{path}: not a {' or '.join(formats)} picture ({type(error).__name__}).") from error
    width, height = image.size
    if width * height > MAX_PIXELS:
        image.close()
        raise SpecError(
            f"{path}: {width} x {height} pixels; at most {MAX_PIXELS // 10**6} million are read. Make it smaller."
        )
    return image


def _pixels(path: Path, image: Any) -> NDArray[Any]:
    try:
        return np.array(image)
    except (OSError, ValueError, SyntaxError, MemoryError) as error:
        raise SpecError(f"{path}: the picture cannot be read ({error}).") from error


def _array(path: Path) -> NDArray[Any]:
    """The array of an .npy file; mapped, so that a header cannot ask for memory."""
    _check_size(path)
    try:
        found = np.load(path, mmap_mode="r", allow_pickle=False)
    except (OSError, ValueError, EOFError, TypeError, OverflowError, SyntaxError) as error:
        raise SpecError(f"{path}: not a readable .npy file ({error}).") from error
    if not isinstance(found, np.ndarray) or found.size > MAX_PIXELS * 8 or found.size == 0:
        raise SpecError(f"{path}: an array of a picture's size was expected.")
    return found


def _check_size(path: Path) -> None:
    try:
        size = path.stat().st_size
    except OSError as error:
        raise SpecError(f"{path}: {error.strerror or error}.") from error
    if not path.is_file() or size > MAX_BYTES:
        raise SpecError(f"{path} is no file, or larger than {MAX_BYTES // 2**20} MiB.")


def _said(array: NDArray[Any]) -> str:
    return f"shape {array.shape} of {array.dtype}"
