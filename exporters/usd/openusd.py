"""The modules of OpenUSD (the package usd-core), in the one place that knows it may be absent.

They are made by a C++ compiler and tell a type checker nothing, so their types are Any here.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any, TypeAlias

from pat3d.errors import ExportError


def _load(name: str) -> Any:
    try:
        return import_module(f"pxr.{name}")
    except ImportError as error:
        raise ExportError(f"USD needs usd-core, which cannot be loaded ({error}): pip install 'pat3d[usd]'.") from error


Gf, Kind, Sdf, Tf, Vt = map(_load, ("Gf", "Kind", "Sdf", "Tf", "Vt"))
Usd, UsdGeom, UsdLux, UsdPhysics = map(_load, ("Usd", "UsdGeom", "UsdLux", "UsdPhysics"))
UsdSemantics, UsdShade, UsdUtils = map(_load, ("UsdSemantics", "UsdShade", "UsdUtils"))

Stage: TypeAlias = Any
"""Usd.Stage"""

Prim: TypeAlias = Any
"""Usd.Prim"""

PrimPath: TypeAlias = Any
"""Sdf.Path"""

Shape: TypeAlias = Any
"""UsdGeom.Gprim"""

Surface: TypeAlias = Any
"""UsdShade.Material"""
