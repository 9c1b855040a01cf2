"""MuJoCo's compiled module carries no types that a checker can read; all of its names are Any."""

from typing import Any

def __getattr__(name: str) -> Any: ...
