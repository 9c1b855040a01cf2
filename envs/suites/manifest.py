"""suite.json: written when a suite begins and when it is complete, from what is in its folder."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterable, Sequence
from statistics import median
from typing import Any

from pat3d.envs.suites.composition import structure_names
from pat3d.envs.suites.folder import (
    FORMAT,
    HUB,
    MANIFEST,
    PAGE,
    RECORD,
    REJECTED,
    SELF,
    VERSION,
    SuiteFolder,
    checksum_of_document,
    read_document,
    write_document,
    write_text,
)
from pat3d.envs.suites.pools import partition
from pat3d.envs.suites.request import SPLITS, Request, in_split
from pat3d.scene.versions import version_of, versions

AXES = {
    "objects": "objects in the scene, containers among them",
    "clutter": "objects that have nothing to do with the task",
    "container": "whether what is moved comes from, or goes to, something with an inside",
    "stack_height": "most objects one upon another",
    "friction": "least friction coefficient of the objects that are moved",
}
"""Along which scenes are more or less difficult."""

_HUB = '''"""The suite for LeRobot's EnvHub: a vector environment for every kind of task, over the test split."""


def make_env(n_envs=1, use_async_envs=False, cfg=None):
    """Vector environments by kind of task: {"pick": {0: env}, ...}."""
    from pat3d.envs.lerobot import make_env as make

    return make(__file__, n_envs=n_envs, use_async_envs=use_async_envs)
'''


def begin_manifest(folder: SuiteFolder, request: Request) -> None:
    """Say what the suite is going to be, so that an unfinished one can be told from a finished one."""
    write_document(folder.path / MANIFEST, {**_head(request), "complete": False})


def finish_manifest(folder: SuiteFolder, request: Request) -> dict[str, Any]:
    """Write suite.json, the page, the card and env.py of a suite whose scenes are all there; returns the document."""
    from pat3d.envs.suites.card import CARD, card
    from pat3d.envs.suites.page import page

    scenes = [read_document(folder.scene(place) / RECORD) for place in range(request.scenes)]
    rejected = [read_document(path) for path in sorted((folder.path / REJECTED).glob("*.json"))]
    rejected = [one for one in rejected if one.get("place", 0) < request.scenes]
    whole = hashlib.sha256("".join(str(scene["checksum"]) for scene in scenes).encode())
    document = {
        **_head(request),
        "complete": True,
        "checksum": whole.hexdigest(),
        "splits": {name: [scene["place"] for scene in scenes if in_split(scene["split"], name)] for name in SPLITS},
        "axes": {
            name: {"about": about, "scenes": _histogram(scene["axes"][name] for scene in scenes)}
            for name, about in AXES.items()
        },
        "numbers": numbers(scenes, rejected),
        "scenes": scenes,
        "rejected": rejected,
    }
    document[SELF] = checksum_of_document(document)
    write_document(folder.path / MANIFEST, document)
    write_text(folder.path / HUB, _HUB)
    write_text(folder.path / CARD, card(folder.path.name, document))
    write_text(folder.path / PAGE, page(folder.path.name, document))
    return document


def numbers(scenes: Sequence[dict[str, Any]], rejected: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """What came of all candidates, without the clock."""
    verifications = [one["verification"] for one in (*scenes, *rejected) if one.get("verification")]
    still = [verification for verification in verifications if verification["mujoco"]["passed"]]
    drift = [scene["verification"]["mujoco"]["mm"] for scene in scenes]
    turned = [scene["verification"]["mujoco"]["degrees"] for scene in scenes]
    return {
        "scenes": len(scenes),
        "candidates": len(scenes) + len(rejected),
        "rejected": dict(sorted(Counter(str(one.get("reason")) for one in rejected).items())),
        "settled_in_mujoco": {"passed": len(still), "of": len(verifications)},
        "intersections": sum(verification["intersections"] for verification in verifications),
        "largest_drift_mm": max(drift, default=None),
        "largest_turn_degrees": max(turned, default=None),
        "seen_percent": _seen(scenes),
        "by_task": dict(sorted(Counter(scene["kind"] for scene in scenes).items())),
    }


def _seen(scenes: Sequence[dict[str, Any]]) -> dict[str, float] | None:
    """Least and median of what the objects of the tasks cover [%]; None where nobody looked."""
    shares = [share for scene in scenes for share in scene.get("seen", {}).values()]
    return {"least": min(shares), "median": median(shares)} if shares else None


def _head(request: Request) -> dict[str, Any]:
    return {
        "format": FORMAT,
        "version": VERSION,
        "seed": request.seed,
        "request": request.as_dict(),
        "device": request.device,
        "versions": {**versions(), **{name: version_of(name) for name in ("robosuite", "gymnasium")}},
        "held_out": {
            "nouns": partition(request.seed),
            "structures": {kind: structure_names(request, kind) for kind in request.tasks},
        },
    }


def _histogram(values: Iterable[Any]) -> dict[str, int]:
    counted = Counter(values)
    return {str(value).lower(): counted[value] for value in sorted(counted, key=lambda value: (value is None, value))}
