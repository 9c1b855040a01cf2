"""What was done to a scene after it was made, one entry for each edit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

from pat3d.errors import SpecError

EditVerb = Literal["add", "remove", "move", "turn", "replace", "scale", "set", "fix", "free"]
VERBS: tuple[str, ...] = get_args(EditVerb)
MAX_HISTORY = 10_000


@dataclass(frozen=True, kw_only=True)
class Edit:
    """One edit of a scene."""

    verb: EditVerb
    said: str
    """As the user put it: "vase: 10 cm to the right"."""
    objects: tuple[str, ...]
    """What it was done to, by the names at that time."""

    def __post_init__(self) -> None:
        if self.verb not in VERBS:
            raise SpecError(f'unknown edit "{self.verb}". Valid: {", ".join(VERBS)}.')

    def __str__(self) -> str:
        return f'{self.verb} "{self.said}"'
