"""Ordinary things that no source has, and what is so like them in kind or shape that it stands in: a note says so."""

from __future__ import annotations

from pathlib import Path


def _read() -> tuple[dict[str, str], dict[str, float]]:
    nouns: dict[str, str] = {}
    metres: dict[str, float] = {}
    for line in Path(__file__).with_suffix(".txt").read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            noun, _, names = line.partition(": ")
            known, _, size = noun.rpartition(" ")
            sized = size[0].isdecimal()
            for name in names.split(", "):
                nouns[name] = known if sized else noun
                if sized:
                    metres[name] = float(size)
    return nouns, metres


STAND_INS, STAND_IN_SIZES = _read()
"""The catalogue's nouns, and longest sides [m] where they are not that noun's: a balloon is no ball of 7 cm."""
