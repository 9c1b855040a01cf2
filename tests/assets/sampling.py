"""Which nouns of the catalogue the quick tests make."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from _pytest.mark import ParameterSet


def sampled(nouns: Sequence[str], *, every: int = 5) -> list[str | ParameterSet]:
    """All nouns, of which every fifth is quick: a family lists kindred nouns one after the other."""
    return [noun if k % every == 0 else pytest.param(noun, marks=pytest.mark.slow) for k, noun in enumerate(nouns)]
