"""YAML from people, read with care: plain data, and the line of everything in it.

Only what JSON can say: mappings, lists, text, numbers, true, false and null. `on`, `yes` and `no` are words here, as
in YAML 1.2. No anchors, no tags, no repeated keys, nothing deep or large.
"""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from pat3d.errors import SpecError

MAX_BYTES = 1_000_000
MAX_DEPTH = 20

Place = tuple[str | int, ...]
"""Keys and indices that lead to a value."""


class _Loader(yaml.SafeLoader):
    """Resolves plain words as JSON would."""


_Loader.yaml_implicit_resolvers = {}
_Loader.add_implicit_resolver("tag:yaml.org,2002:null", re.compile(r"^(?:null|~|)$"), ["n", "~", ""])
_Loader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile(r"^(?:true|false)$"), list("tf"))
_Loader.add_implicit_resolver("tag:yaml.org,2002:int", re.compile(r"^[-+]?\d+$"), list("-+0123456789"))
_Loader.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(r"^[-+]?(?:\.\d+|\d+(?:\.\d*)?)(?:[eE][-+]?\d+)?$|^[-+]?\.(?:inf|Inf|INF)$|^\.(?:nan|NaN|NAN)$"),
    list("-+.0123456789"),
)


@dataclass(frozen=True, kw_only=True)
class Source:
    """A document and where its parts stand."""

    path: Path
    document: Any
    lines: dict[Place, tuple[int, int]]
    """Line and column of every value, from 1; of a mapping's value, those of its key."""

    def error(self, place: Sequence[str | int], message: str) -> SpecError:
        """An error at `place`, named by line, column and keys."""
        found = tuple(place)
        while found and found not in self.lines:
            found = found[:-1]
        line, column = self.lines.get(found, (1, 1))
        return SpecError(f"{self.path}:{line}:{column}: {dotted(place)}: {message} Nothing was written.")


def dotted(place: Sequence[str | int]) -> str:
    """("objects", 2, "pose") -> objects[2].pose."""
    text = "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in place)
    return text.lstrip(".") or "the file"


def read_yaml(path: Path) -> Source:
    """Read a YAML file.

    Raises:
        SpecError: there is no such file, or it is not plain YAML within the limits.
    """
    try:
        if path.is_dir():
            raise SpecError(f"{path} is a folder; give a YAML file. Nothing was written.")
        if path.stat().st_size > MAX_BYTES:
            raise SpecError(f"{path} has {path.stat().st_size:,} bytes; at most {MAX_BYTES:,} are read.")
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise SpecError(f"{path}: cannot be read ({error.strerror or error}). Nothing was written.") from error
    except UnicodeDecodeError as error:
        raise SpecError(f"{path}: not text in UTF-8 (byte {error.start}). Nothing was written.") from error
    try:
        _refuse_tricks(path, text)
        node = yaml.compose(text, Loader=_Loader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        at = f":{mark.line + 1}:{mark.column + 1}" if mark else ""
        raise SpecError(f"{path}{at}: not valid YAML ({error.problem}). Nothing was written.") from error
    except yaml.YAMLError as error:
        first = str(error).splitlines()[0]
        raise SpecError(f"{path}: not valid YAML ({first}). Nothing was written.") from error
    if node is None:
        raise SpecError(f"{path}: the file is empty. Nothing was written.")
    lines: dict[Place, tuple[int, int]] = {}
    return Source(path=path, document=_value(path, node, (), lines), lines=lines)


def validate(source: Source, schema: Mapping[str, Any]) -> None:
    """Raise SpecError for the first place where the document of `source` does not follow the JSON `schema`."""
    import jsonschema

    errors = sorted(
        jsonschema.Draft202012Validator(schema).iter_errors(source.document),
        # A misspelt key is told before what it was meant to be is missed.
        key=lambda error: (
            source.lines.get(tuple(error.absolute_path), (0, 0)),
            error.validator != "additionalProperties",
        ),
    )
    if not errors:
        return
    error = errors[0]
    place = tuple(error.absolute_path)
    if error.validator == "additionalProperties":
        known = list(error.schema["properties"])
        key = next(key for key in error.instance if key not in known)
        raise source.error((*place, key), f'unknown key "{key}".{nearest(key, known)}')
    if error.validator == "required":
        missing = next(key for key in error.validator_value if key not in error.instance)
        raise source.error(place, f'"{missing}" is missing.')
    if error.validator == "enum":
        valid = ", ".join(map(str, error.validator_value))
        raise source.error(place, f'"{error.instance}" is not valid. Valid: {valid}.')
    text = error.message if len(error.message) < 160 else f"{error.message[:160]} ..."
    described = (error.schema.get("description") or "").rstrip(".")
    raise source.error(place, f"{text}{f' ({described})' if described else ''}.")


def nearest(word: str, known: Sequence[str]) -> str:
    """A hint at the known words most like `word`, or at all of them where they are few."""
    near = difflib.get_close_matches(word, known, n=3, cutoff=0.4)
    if near:
        return f" Nearest: {', '.join(near)}."
    return f" Valid: {', '.join(known)}." if 0 < len(known) <= 30 else ""


def _refuse_tricks(path: Path, text: str) -> None:
    """Raise for anchors and for nesting that would exhaust the parser."""
    depth = 0
    for event in yaml.parse(text, Loader=_Loader):
        where = f"{path}:{event.start_mark.line + 1}:{event.start_mark.column + 1}"
        if isinstance(event, yaml.AliasEvent) or getattr(event, "anchor", None):
            raise SpecError(f"{where}: anchors and aliases (& and *) are not read; write it out. Nothing was written.")
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1
        if depth > MAX_DEPTH:
            raise SpecError(f"{where}: nested deeper than {MAX_DEPTH} levels. Nothing was written.")


def _value(path: Path, node: yaml.Node, place: Place, lines: dict[Place, tuple[int, int]]) -> Any:
    at = (node.start_mark.line + 1, node.start_mark.column + 1)
    lines.setdefault(place, at)
    where = f"{path}:{at[0]}:{at[1]}"
    if isinstance(node, yaml.MappingNode) and node.tag == "tag:yaml.org,2002:map":
        found: dict[str, Any] = {}
        for key_node, value_node in node.value:
            key = getattr(key_node, "value", None)
            mark = key_node.start_mark
            here = f"{path}:{mark.line + 1}:{mark.column + 1}"
            if not isinstance(key_node, yaml.ScalarNode) or not isinstance(key, str):
                raise SpecError(f"{here}: a key must be a word. Nothing was written.")
            if key in found:
                raise SpecError(f'{here}: the key "{key}" is repeated. Nothing was written.')
            lines[(*place, key)] = (mark.line + 1, mark.column + 1)
            found[key] = _value(path, value_node, (*place, key), lines)
        return found
    if isinstance(node, yaml.SequenceNode) and node.tag == "tag:yaml.org,2002:seq":
        return [_value(path, child, (*place, number), lines) for number, child in enumerate(node.value)]
    if isinstance(node, yaml.ScalarNode):
        return _scalar(node, where)
    raise SpecError(f'{where}: the tag "{node.tag}" is not read; only plain YAML is. Nothing was written.')


def _scalar(node: yaml.ScalarNode, where: str) -> Any:
    kind = node.tag.removeprefix("tag:yaml.org,2002:")
    if kind == "null":
        return None
    if kind == "bool":
        return node.value == "true"
    if kind == "str":
        return node.value
    if kind == "int" and len(node.value) <= 20:
        return int(node.value)
    if kind == "float":
        text = node.value.lower()
        number = float(text.replace(".inf", "inf").replace(".nan", "nan"))
        if math.isfinite(number):
            return number
    if kind in ("int", "float"):
        raise SpecError(f"{where}: {node.value[:40]} is not a finite number of sensible size. Nothing was written.")
    raise SpecError(f'{where}: the tag "{node.tag}" is not read; only plain YAML is. Nothing was written.')
