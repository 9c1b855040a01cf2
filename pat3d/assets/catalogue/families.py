"""Imports every module of recipes in this package; importing one registers its entries."""

from __future__ import annotations

import importlib
import pkgutil
from pathlib import Path

for _module in sorted(module.name for module in pkgutil.iter_modules([str(Path(__file__).parent)])):
    importlib.import_module(f"{__package__}.{_module}")
