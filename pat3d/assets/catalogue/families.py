"""Imports every module of recipes in this package; importing one registers its entries."""

from __future__ import annotations

import importlib
import pkgutil

from pat3d.assets import catalogue

for _module in sorted(module.name for module in pkgutil.iter_modules(catalogue.__path__)):
    importlib.import_module(f"{catalogue.__name__}.{_module}")
