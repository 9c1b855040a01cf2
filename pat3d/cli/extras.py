"""What the installed package says that it needs, and which of its extras brings what.

Read from the metadata that pyproject.toml became, so that no list is kept twice.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from importlib import metadata

ENABLES = {
    "torch": "the optimisation of layouts, losses and gradients in PyTorch",
    "usd": "USD files",
    "meshes": "COLLADA, FBX and 3MF meshes",
    "envs": "Gymnasium environments",
    "robots": "robots and controllers",
    "eval": "policy evaluation: records, servers, films, demonstrations",
    "ray": "suites made by a cluster",
    "models": "sentences read, and pictures judged, by a language model",
    "mcp": "tools for other programs, by the Model Context Protocol",
    "metrics": "R of the paper's Table 1 on remeshed surfaces",
    "vision": "depth, objects and masks of photographs, and CLIP scores, by models of transformers",
    "studio": "scenes in the browser, to look at and edit",
    "docs": "this documentation as a site",
    "gpu": "thousands of scenes at once on a GPU",
    "all": "all of these",
}
"""What an extra is for; one that is not listed is told without words."""

DEVELOPMENT = "dev"
"""The extra of those who work on PAT3D itself."""

_MODULES = {"pxr": "usd-core", "PIL": "pillow", "yaml": "pyyaml"}
"""Modules whose distribution has another name."""

_LINE = re.compile(r"(?P<name>[\w.-]+)(?:\[[^\]]*\])?(?P<version>[^;]*)(?:;(?P<marker>.*))?")


@dataclass(frozen=True, kw_only=True)
class Requirement:
    """A distribution that PAT3D asks for."""

    name: str
    least: str
    """Version; empty where any will do."""
    extra: str
    """That asks for it; empty where everybody needs it."""


@cache
def requirements() -> tuple[Requirement, ...]:
    """What is asked for, in the order of the metadata; empty where the package is not installed, only on the path."""
    try:
        lines = metadata.requires("pat3d") or []
    except metadata.PackageNotFoundError:
        return ()
    return tuple(read(line) for line in lines)


def read(line: str) -> Requirement:
    """A line of the metadata: 'torch>=2.6; extra == "torch"'."""
    found = _LINE.match(line)
    if found is None:
        raise ValueError(f'"{line}" is no requirement: wanted is NAME>=VERSION; extra == "EXTRA".')
    least = re.search(r">=\s*([\w.]+)", found["version"])
    extra = re.search(r"extra\s*==\s*['\"]([\w-]+)['\"]", found["marker"] or "")
    return Requirement(name=found["name"].lower(), least=least[1] if least else "", extra=extra[1] if extra else "")


def how_to_install(module: str) -> str | None:
    """The command that brings the package `module`; None where no extra does."""
    top = module.split(".")[0]
    name = _MODULES.get(top, top.replace("_", "-")).lower()
    extras = [one.extra for one in requirements() if one.name == name]
    if "" in extras:
        return "pip install pat3d again"
    wanted = [extra for extra in extras if extra != DEVELOPMENT]
    return f"pip install 'pat3d[{wanted[0]}]'" if wanted else None
