"""Objects put into a scene by their relations while everything else stays where it is."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from pat3d.errors import LayoutError
from pat3d.generation.editing.draft import Draft
from pat3d.layout.layout import arrange


def laid_out(draft: Draft, free: Collection[str], *, seed: int = 0) -> Draft:
    """`draft` with the objects `free`, and all that they carry, put where their relations say.

    Raises:
        LayoutError: there is no room for one of them.
    """
    scene = draft.scene
    assets = {obj.name: obj.asset for obj in scene.objects}
    pinned = {obj.name: obj.pose for obj in scene.objects if obj.name not in free}
    related = {obj.name for obj in scene.objects if obj.name in free}
    layout = arrange(
        assets,
        scene.relations,
        seed=scene.seed + seed,
        fixed_poses=pinned,
        # What is said of the others holds or not, as it did.
        arrangements=tuple(one for one in scene.arrangements if related & set(one.names)),
        postures={obj.name: obj.posture for obj in scene.objects if obj.name in free and obj.posture is not None},
    )
    objects = tuple(replace(obj, pose=layout.poses[obj.name]) if obj.name in related else obj for obj in scene.objects)
    attachments = (
        *(one for one in scene.attachments if one.child not in related),
        *(one for one in layout.attachments if one.child in related),
    )
    blocked = [
        note for note in layout.notes if "may tip or fall" in note and any(f'"{one}"' in note for one in related)
    ]
    if blocked:
        raise LayoutError(f"{blocked[0]} Nothing was written.")
    return draft.with_scene(replace(scene, objects=objects, attachments=attachments), related, notes=layout.notes)
