"""What of a scene a format cannot hold, or holds where few readers look: what its export report tells."""

from __future__ import annotations

from pat3d.assets.materials import surface_of
from pat3d.scene.model import Scene
from pat3d.scene.naming import slug


def left_out(scene: Scene, format: str) -> tuple[str, ...]:
    """A line for everything of `scene` that an export as `format` lacks; none where nothing is lost.

    Args:
        scene: what is written.
        format: one of the exchange formats.
    """
    lines = []
    maps = sorted({name for obj in scene.objects for name in obj.asset.visual.maps})
    looks = [surface_of(obj.asset) for obj in scene.objects]
    if format == "mjcf" and maps:
        lines.append(f"MuJoCo's own renderer draws no {_listed(maps)} maps; they are layers of the materials.")
    if format == "urdf":
        lines.append("which objects are loose, and where they stand, is in manifest.json.")
        lines.append(f"roughness and metallic{_and(maps)} are in visual.mtl only.")
        if any(look.opacity < 1.0 for look in looks):
            lines.append("opacity is in the material's colour, which SAPIEN takes in place of the texture.")
        if scene.attachments:
            lines.append("what hangs by points is in manifest.json.")
    if format == "sdf":
        if "opacity" in maps:
            lines.append("opacity maps are in visual.mtl only.")
        if any(slug(obj.name) != obj.name for obj in scene.objects):
            lines.append("names of objects are those of files: small letters, digits and underscores.")
    if format == "usd":
        lines.append("masses and points are in single precision.")
    return tuple(lines)


def _and(maps: list[str]) -> str:
    more = [f"{name} maps" for name in maps]
    return f", {_listed(more)}" if more else ""


def _listed(names: list[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
