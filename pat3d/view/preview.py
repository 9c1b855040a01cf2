"""Picture files of scenes and assets: previews, contact sheets, turntables.

Files are PNG and appear complete or not at all.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.materials import surface_of
from pat3d.errors import SpecError
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import VisualMesh
from pat3d.scene.model import GROUND, Scene
from pat3d.scene.replacement import replaced_file
from pat3d.view.camera import ELEVATION, frame
from pat3d.view.geometry import Item
from pat3d.view.render import render
from pat3d.view.viewpoint import overlooking

if TYPE_CHECKING:
    from PIL import Image

_PAPER = (250, 250, 249)
_INK = (52, 54, 58)
_STAGE = 0.5
"""Size from which on a table is a stage for what is on it [m]."""
_LEVEL = frozenset(
    {"table", "desk", "counter", "workbench", "bench", "cabinet", "dresser", "sideboard", "floor", "stand"}
)
"""Nouns of what pictures need not show whole."""
_LARGEST_PAGE = 16_384
"""Longest side of a sheet [pixel]."""


def scene_items(scene: Scene, *, initial: bool = False) -> list[Item]:
    """The meshes of `scene` at rest, or as laid out before settling."""
    return [
        (obj.asset.visual, obj.initial_pose if initial else obj.pose, surface_of(obj.asset).opacity)
        for obj in scene.objects
    ]


def stage_of(scene: Scene) -> int | None:
    """Index of the one piece of furniture that carries all else of `scene`, if there is one and it is only that."""
    standing = [obj for obj in scene.objects if scene.parent(obj.name) == GROUND]
    if len(standing) != 1 or len(scene.objects) < 2:
        return None
    carrier = standing[0]
    extent = float(carrier.asset.size.max())
    return scene.objects.index(carrier) if extent > _STAGE and _LEVEL & {*carrier.asset.noun.split()} else None


def save_preview(
    scene: Scene,
    path: str | os.PathLike[str],
    *,
    width: int = 800,
    height: int = 600,
) -> None:
    """Write the initial layout beside the settled scene, seen by one camera that shows all of both.

    Args:
        scene: what to draw.
        path: of the PNG file.
        width: of each of the two pictures [pixel].
        height: of each of the two pictures [pixel].
    """
    panels = [("initial layout", scene_items(scene, initial=True)), ("settled", scene_items(scene))]
    save_png(side_by_side(panels, width=width, height=height, stage=stage_of(scene)), path)


def side_by_side(
    panels: Sequence[tuple[str, Sequence[Item]]],
    *,
    width: int = 800,
    height: int = 600,
    stage: int | None = None,
) -> Image.Image:
    """Captioned pictures in a row, seen by one camera; arguments as for `save_preview` and `overlooking`."""
    camera = overlooking([items for _, items in panels], aspect=width / height, stage=stage)
    sheet = _Sheet(columns=len(panels), rows=1, width=width, height=height, gap=8, text=max(round(height / 30), 11))
    for index, (caption, items) in enumerate(panels):
        sheet.put(index, render(items, camera=camera, width=width, height=height), caption)
    return sheet.image


def save_row(panels: Sequence[tuple[str, NDArray[np.uint8]]], path: str | os.PathLike[str]) -> None:
    """Write captioned pictures of one size, shape (height, width, 3), in a row."""
    height, width = panels[0][1].shape[:2]
    sheet = _Sheet(columns=len(panels), rows=1, width=width, height=height, gap=8, text=max(round(height / 30), 11))
    for index, (caption, picture) in enumerate(panels):
        sheet.put(index, picture, caption)
    save_png(sheet.image, path)


def save_picture(
    scene: Scene,
    path: str | os.PathLike[str],
    *,
    width: int = 960,
    height: int = 720,
) -> None:
    """Write the settled scene alone, without a caption; arguments as for `save_preview`."""
    items = scene_items(scene)
    camera = overlooking([items], aspect=width / height, stage=stage_of(scene))
    save_png(render(items, camera=camera, width=width, height=height), path)


def contact_sheet(
    entries: Iterable[tuple[str, VisualMesh, float]],
    path: str | os.PathLike[str],
    *,
    columns: int = 8,
    width: int = 240,
    height: int = 180,
    per_page: int | None = None,
) -> list[Path]:
    """Write a grid of captioned pictures of meshes, each framed by itself.

    Args:
        entries: caption, mesh and opacity of every cell; drawn one at a time, so a generator saves memory.
        path: of the PNG file; further pages get "-2", "-3", ... before the suffix.
        columns: cells in a row.
        width: of a cell's picture [pixel].
        height: of a cell's picture [pixel].
        per_page: most cells on a page; None puts all on one tall page.

    Returns:
        The files written, in order.

    Raises:
        SpecError: there are no entries, or the page would be too large.
    """
    if columns < 1 or (per_page is not None and per_page < 1):
        raise SpecError(f"a contact sheet needs at least 1 column and 1 cell a page, got {columns}, {per_page}.")
    pictures = [
        (caption, render([(mesh, Pose(), opacity)], width=width, height=height, ground=float(mesh.bounds[0, 2])))
        for caption, mesh, opacity in entries
    ]
    if not pictures:
        raise SpecError("a contact sheet needs at least one entry.")
    size = per_page or len(pictures)
    written = []
    for page, first in enumerate(range(0, len(pictures), size), start=1):
        cells = pictures[first : first + size]
        used = min(columns, len(cells))
        rows = math.ceil(len(cells) / used)
        sheet = _Sheet(columns=used, rows=rows, width=width, height=height, gap=6, text=max(round(height / 12), 11))
        for index, (caption, picture) in enumerate(cells):
            sheet.put(index, picture, caption)
        file = Path(path) if page == 1 else Path(path).with_name(f"{Path(path).stem}-{page}{Path(path).suffix}")
        save_png(sheet.image, file)
        written.append(file)
    return written


def save_turntable(
    mesh: VisualMesh,
    path: str | os.PathLike[str],
    *,
    caption: str = "",
    opacity: float = 1.0,
    views: int = 4,
    width: int = 480,
    height: int = 400,
    elevation: float = ELEVATION,
) -> None:
    """Write one mesh from `views` sides in a row, at one scale, the front first.

    Args:
        mesh: what to draw, standing on its lowest point.
        path: of the PNG file.
        caption: text under the first picture.
        opacity: of the mesh [-].
        views: pictures in the row, 1 to 16.
        width: of each picture [pixel].
        height: of each picture [pixel].
        elevation: of the camera above the horizon [deg].
    """
    if not 1 <= views <= 16:
        raise SpecError(f"a turntable shows 1 to 16 views, got {views}.")
    low, high = mesh.bounds
    middle = np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]])
    poses = []
    for view in range(views):
        turned = Pose.from_yaw(2.0 * math.pi * view / views, (0.0, 0.0, 0.0))
        x, y, z = turned.rotation @ -middle
        poses.append(Pose(position=(float(x), float(y), float(z)), quat_wxyz=turned.quat_wxyz))
    everything = np.concatenate([pose.apply(mesh.vertices) for pose in poses])
    camera = frame(everything, aspect=width / height, elevation=elevation)
    sheet = _Sheet(columns=views, rows=1, width=width, height=height, gap=6, text=max(round(height / 22), 11))
    for view, pose in enumerate(poses):
        picture = render([(mesh, pose, opacity)], camera=camera, width=width, height=height)
        sheet.put(view, picture, caption if view == 0 else "")
    save_png(sheet.image, path)


def save_png(picture: NDArray[np.uint8] | Image.Image, path: str | os.PathLike[str]) -> None:
    """Write an RGB picture, shape (h, w, 3), as PNG; an existing file is replaced at once or not at all."""
    from PIL import Image

    image = Image.fromarray(picture) if isinstance(picture, np.ndarray) else picture
    with replaced_file(Path(path)) as temporary:
        image.save(temporary, format="PNG", optimize=False)


class _Sheet:
    """A page of equal pictures with a caption under each."""

    def __init__(self, *, columns: int, rows: int, width: int, height: int, gap: int, text: int) -> None:
        from PIL import Image, ImageDraw, ImageFont

        self._columns, self._gap = columns, gap
        self._width, self._height, self._strip = width, height, round(text * 1.9)
        size = (columns * (width + gap) + gap, rows * (height + self._strip) + gap)
        if max(size) > _LARGEST_PAGE:
            raise SpecError(
                f"a sheet of {size[0]} x {size[1]} pixels is too large; at most {_LARGEST_PAGE}: use smaller or fewer "
                "pictures a page."
            )
        self.image = Image.new("RGB", size, _PAPER)
        self._draw = ImageDraw.Draw(self.image)
        self._font = ImageFont.load_default(size=text)

    def put(self, index: int, picture: NDArray[np.uint8], caption: str) -> None:
        """Place a picture, shape (height, width, 3), in cell `index`, counted along the rows."""
        from PIL import Image

        row, column = divmod(index, self._columns)
        x = self._gap + column * (self._width + self._gap)
        y = self._gap + row * (self._height + self._strip)
        self.image.paste(Image.fromarray(picture), (x, y))
        middle = (x + self._width / 2, y + self._height + (self._strip - self._gap) / 2 + 1)
        self._draw.text(middle, self._fitted(caption), fill=_INK, font=self._font, anchor="mm")

    def _fitted(self, caption: str) -> str:
        """`caption` on one line, cut to the width of a picture."""
        line = " ".join(caption.split())[:400]
        if self._draw.textlength(line, font=self._font) <= self._width - 8:
            return line
        while line and self._draw.textlength(line + "...", font=self._font) > self._width - 8:
            line = line[:-1]
        return line.rstrip() + "..."
