"""One call for every format: `export(scene, ("mjcf", "usd", "urdf"), "exports/desk")`."""

from __future__ import annotations

from collections.abc import Iterable
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from pat3d.errors import ExportError, SpecError
from pat3d.progress import Event, Progress, silent
from pat3d.scene.model import Scene

FORMATS = ("mjcf", "usd", "urdf", "sdf")
"""Names of the formats, each also the name of its folder."""

VIEWS = ("html", "glb", "simready")
"""Formats of which nothing is read back, likewise: two to look at, and the assets for NVIDIA's asset libraries."""

NEED_USD = ("usd", "simready")
"""Those that usd-core writes."""

_WRITERS = {
    "mjcf": ("pat3d.exporters.mjcf.writer", "write_mjcf"),
    "usd": ("pat3d.exporters.usd.writer", "write_usd"),
    "urdf": ("pat3d.exporters.urdf.writer", "write_urdf"),
    "sdf": ("pat3d.exporters.sdf.writer", "write_sdf"),
    "html": ("pat3d.exporters.html.writer", "write_html"),
    "glb": ("pat3d.exporters.glb.writer", "write_glb"),
    "simready": ("pat3d.exporters.simready.writer", "write_simready"),
}


def export(
    scene: Scene,
    formats: Iterable[str],
    out: str | Path,
    *,
    progress: Progress = silent,
    **usd: Any,
) -> dict[str, Path]:
    """Write `scene` in every format of `formats`, each into its own folder in `out`.

    Args:
        scene: what to write.
        formats: names of FORMATS and VIEWS.
        out: folder, made if missing; `out/mjcf`, `out/usd`, ... in it are replaced, other files are kept.
        progress: told what is being written.
        usd: settings of `write_usd`: `text` for .usda, `package` for a .usdz, `levels` of detail.

    Returns:
        The main file of every format: scene.xml, scene.usdc, manifest.json, scene.sdf, scene.html, scene.glb.

    Raises:
        SpecError: an unknown format.
        ExportError: a format's packages are missing, or a folder cannot be written.
    """
    names = chosen(formats)
    folder = Path(out)
    if folder.exists() and not folder.is_dir():
        raise ExportError(f"{folder} is a file; give a folder.")
    paths = {}
    for number, name in enumerate(names):
        progress(Event(stage="writing", detail=name, step=number, steps=len(names)))
        module, function = _WRITERS[name]
        write = getattr(import_module(module), function)
        paths[name] = write(scene, folder / name, **(usd if name == "usd" else {}))
    return paths


def exported(folder: str | Path) -> tuple[tuple[str, ...], dict[str, Any]]:
    """The formats that `folder` holds, MJCF always, and the settings of `write_usd` that write its USD anew.

    Raises:
        ExportError: the packages that one needs are not installed.
    """
    here = Path(folder)
    formats = chosen([name for name in (*FORMATS, *VIEWS) if name == "mjcf" or (here / name).is_dir()])
    text, package = (here / "usd" / "scene.usda").is_file(), (here / "usd" / "scene.usdz").is_file()
    settings: dict[str, Any] = {"text": text, "package": package}
    if "usd" in formats:
        settings["levels"] = import_module("pat3d.exporters.usd.writer").levels_of(here / "usd")
    return formats, settings


def chosen(formats: Iterable[str]) -> tuple[str, ...]:
    """The formats named in `formats`, commas allowed, each once; they can be written here.

    Raises:
        SpecError: an unknown format, or none.
        ExportError: the packages that one needs are not installed.
    """
    names = [name.strip().lower() for item in formats for name in item.split(",") if name.strip()]
    unknown = [name for name in names if name not in (*FORMATS, *VIEWS)]
    if unknown or not names:
        raise SpecError(f'unknown format "{", ".join(unknown)}". Valid: {", ".join((*FORMATS, *VIEWS))}.')
    lacking = [name for name in names if name in NEED_USD]
    if lacking and not has_usd():
        raise ExportError(f"{lacking[0]} needs usd-core, which is not installed: pip install 'pat3d[usd]'.")
    return tuple(dict.fromkeys(names))


def has_usd() -> bool:
    """Whether usd-core is installed."""
    return find_spec("pxr") is not None
