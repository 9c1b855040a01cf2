"""What a command prints with --json, held against its schema."""

from __future__ import annotations

import json
from typing import Any

import jsonschema

from pat3d.cli.main import main
from pat3d.generation.facts import schema_of


def document_of(captured: Any, argv: list[str], kind: Any, code: int = 0) -> Any:
    """The document of `pat3d ARGV --json`, a dataclass `kind` or a list of them; the exit code has to be `code`."""
    captured.readouterr()
    assert main([*argv, "--json"]) == code
    found = json.loads(captured.readouterr().out)
    jsonschema.Draft202012Validator(schema_of(kind)).validate(found)
    return found
