"""What --json prints."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from typing import Any

from pat3d.cli.options import option

JSON = option("--json", "print what came of it as JSON, as docs/json.md describes", action="store_true")


def print_facts(facts: Any) -> None:
    """Print a dataclass of pat3d.generation.facts, or several, as JSON."""
    several = isinstance(facts, Sequence)
    plain = [dataclasses.asdict(one) for one in facts] if several else dataclasses.asdict(facts)
    print(json.dumps(plain, indent=2, allow_nan=False, ensure_ascii=False))
