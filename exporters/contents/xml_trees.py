"""Two XML documents compared element by element: everything that one of them does not say is a difference."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

from pat3d.errors import ExportError
from pat3d.exporters.common.xml_files import MAX_XML_BYTES
from pat3d.exporters.contents.inertia import same_inertia
from pat3d.exporters.contents.values import FOREIGN, same_words, shown

_IDENTITY = ("name", "class", "file", "filename")
"""Attributes that tell an element from its siblings, in this order."""

_DECLARED = re.compile(rb"<\?xml[^>]*encoding\s*=\s*[\"']([^\"']*)")

Key = tuple[str, str, int]
"""Tag, identity, and place among those that have the same."""


def xml_differences(found: Path, expected: Path) -> Iterator[str]:
    """What the document at `found` says that the one at `expected` does not, and the reverse, a line each.

    Comments and the layout of the text count for nothing.

    Raises:
        ExportError: one of them is not XML that every parser reads alike.
    """
    here, there = _parse(found), _parse(expected)
    if here.tag != there.tag:
        yield f"the root is <{here.tag}> instead of <{there.tag}>"
    else:
        yield from _element(here, there, "")


def _parse(path: Path) -> ET.Element:
    try:
        if path.stat().st_size > MAX_XML_BYTES:
            raise ExportError(f"{path.name}: larger than {MAX_XML_BYTES} bytes.")
        content = path.read_bytes()
        declared = _DECLARED.match(content.lstrip(b"\xef\xbb\xbf \t\r\n"))
        # Parsers differ in what they make of entities and of encodings, so that a file could say two things.
        if b"<!DOCTYPE" in content or b"\0" in content or (declared and declared[1].lower() not in (b"utf-8", b"utf8")):
            raise ExportError(f"{path.name}: has a document type, or an encoding other than UTF-8.")
        return ET.fromstring(content.decode("utf-8-sig").encode())
    except OSError as error:
        raise ExportError(f"{path.name}: cannot be read ({error.strerror or error}).") from error
    except (ET.ParseError, UnicodeDecodeError) as error:
        raise ExportError(f"{path.name}: not well-formed XML ({error}).") from error


def _element(found: ET.Element, expected: ET.Element, above: str) -> Iterator[str]:
    place = f"{above}/{_title(found)}" if above else _title(found)
    if found.tag == "inertial" and same_inertia(found, expected):
        return
    for name in found.attrib.keys() - expected.attrib.keys():
        yield f'{place} has {name}="{shown(found.attrib[name])}", which {FOREIGN}'
    for name in expected.attrib.keys() - found.attrib.keys():
        yield f'{place} lacks {name}="{shown(expected.attrib[name])}"'
    for name in found.attrib.keys() & expected.attrib.keys():
        if not same_words(found.attrib[name], expected.attrib[name]):
            yield f'{place} has {name}="{shown(found.attrib[name])}" instead of "{shown(expected.attrib[name])}"'
    if not same_words(found.text, expected.text):
        yield f'{place} says "{shown(found.text)}" instead of "{shown(expected.text)}"'
    if any((child.tail or "").strip() for child in found):
        yield f"{place} has text between its elements"
    here, there = _children(found), _children(expected)
    for key in here:
        if key in there:
            yield from _element(here[key], there[key], place)
        else:
            yield f"{place}/{_title(here[key])} is there, which {FOREIGN}"
    for key in there:
        if key not in here:
            yield f"{place}/{_title(there[key])} is missing"
    if list(here) != list(there) and here.keys() == there.keys():
        yield f"{place} has its elements in another order"


def _children(element: ET.Element) -> dict[Key, ET.Element]:
    seen: dict[tuple[str, str], int] = defaultdict(int)
    found: dict[Key, ET.Element] = {}
    for child in element:
        identity = (child.tag, _identity(child))
        found[*identity, seen[identity]] = child
        seen[identity] += 1
    return found


def _identity(element: ET.Element) -> str:
    return next((element.attrib[name] for name in _IDENTITY if name in element.attrib), "")


def _title(element: ET.Element) -> str:
    identity = _identity(element)
    return f'<{element.tag} "{shown(identity)}">' if identity else f"<{element.tag}>"
