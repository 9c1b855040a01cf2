"""OpenUSD's modules are made by a C++ compiler and tell a type checker nothing; all of them are Any."""

from typing import Any

def __getattr__(name: str) -> Any: ...
