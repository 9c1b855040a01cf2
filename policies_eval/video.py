"""Frames to a film: MP4 where imageio-ffmpeg is installed, else GIF, or PNG files in a folder."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import EvaluationError
from pat3d.scene.replacement import replaced_file

INSTALL_HINT = "MP4 needs imageio-ffmpeg: pip install 'pat3d[eval]'; name a .gif or a folder for PNG files instead."

Frames = Sequence[NDArray[np.uint8]]
"""RGB pictures of one size, shape (height, width, 3) each."""


def can_write_mp4() -> bool:
    """Whether MP4 files can be written."""
    try:
        import imageio_ffmpeg  # noqa: F401
    except ImportError:
        return False
    return True


def write_video(frames: Frames, file: str | os.PathLike[str], fps: float) -> Path:
    """Write a film; what the name ends with decides its kind.

    Raises:
        EvaluationError: no frames, or a kind that cannot be written here.
    """
    path = Path(file)
    if not frames:
        raise EvaluationError("a film needs a frame.")
    path.parent.mkdir(parents=True, exist_ok=True)
    kind = path.suffix.lower()
    if kind == "":
        for number, frame in enumerate(frames):
            path.mkdir(exist_ok=True)
            _image(frame).save(path / f"{number:05d}.png")
        return path
    if kind not in (".mp4", ".gif"):
        raise EvaluationError(f'a film is FILE.mp4, FILE.gif or a folder for PNG files, not "{path.name}".')
    write = _write_gif if kind == ".gif" else _write_mp4
    with replaced_file(path) as temporary:
        write(frames, temporary, fps)
    return path


def _write_gif(frames: Frames, path: Path, fps: float) -> None:
    images = [_image(frame) for frame in frames]
    images[0].save(path, save_all=True, append_images=images[1:], duration=round(1000 / fps), loop=0)


def _write_mp4(frames: Frames, path: Path, fps: float) -> None:
    writer = FilmWriter(path, frames[0].shape[:2], fps)
    try:
        for frame in frames:
            writer.add(frame)
    finally:
        writer.close()


class FilmWriter:
    """An MP4 file that grows by one frame at a time.

    Args:
        path: of the file.
        size: height and width [pixel]; an odd last line or column is cut off.
        fps: frames a second.

    Raises:
        EvaluationError: imageio-ffmpeg is not installed.
    """

    def __init__(self, path: Path, size: tuple[int, ...], fps: float) -> None:
        try:
            import imageio_ffmpeg
        except ImportError as error:
            raise EvaluationError(INSTALL_HINT) from error
        # H.264 in its common form has pictures of even sizes only.
        self._height, self._width = size[0] // 2 * 2, size[1] // 2 * 2
        self._writer: Any = imageio_ffmpeg.write_frames(
            str(path),
            (self._width, self._height),
            fps=fps,  # type: ignore[arg-type] FFmpeg takes any number
            codec="libx264",
            pix_fmt_out="yuv420p",
            macro_block_size=2,
            quality=6,
            output_params=["-movflags", "+faststart"],
            ffmpeg_log_level="error",
        )
        self._writer.send(None)

    def add(self, frame: NDArray[np.uint8]) -> None:
        """Append a picture, shape (height, width, 3)."""
        self._writer.send(np.ascontiguousarray(frame[: self._height, : self._width]))

    def close(self) -> None:
        """Finish the file."""
        self._writer.close()


def _image(frame: NDArray[np.uint8]) -> Any:
    from PIL import Image

    return Image.fromarray(frame)
