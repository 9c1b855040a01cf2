"""viser is an extra that the type checker does not need to be installed; all of its names are Any."""

from typing import Any

def __getattr__(name: str) -> Any: ...
