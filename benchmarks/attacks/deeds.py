"""Ways to change the files of a folder; a deed returns False where there is nothing to do it to."""

from __future__ import annotations

import json
import re
import shutil
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path
from typing import Any

Deed = Callable[[Path], Any]

DRAKE = "http://drake.mit.edu"


def xml(file: str, change: Callable[[ET.Element], Any]) -> Deed:
    """Change the tree of an XML file."""

    def deed(folder: Path) -> Any:
        ET.register_namespace("drake", DRAKE)
        tree = ET.parse(one(folder, file))
        done = change(tree.getroot())
        tree.write(one(folder, file))
        return done

    return deed


def add(above: str, tag: str, **attributes: str) -> Callable[[ET.Element], Any]:
    """An element more in the first element `above`; several tags with slashes make a branch."""

    def change(root: ET.Element) -> None:
        parent = root if above == "." else root.find(above)
        for name in tag.split("/"):
            parent = ET.SubElement(parent if parent is not None else root, name)
        parent.attrib.update({key.rstrip("_"): value for key, value in attributes.items()})  # type: ignore[union-attr]

    return change


def put(path: str, **attributes: str) -> Callable[[ET.Element], Any]:
    """Other attributes of the first element at `path`."""

    def change(root: ET.Element) -> Any:
        element = root.find(path)
        if element is None:
            return False
        element.attrib.update({key.rstrip("_"): value for key, value in attributes.items()})
        return True

    return change


def say(path: str, text: str) -> Callable[[ET.Element], Any]:
    """Another text of the first element at `path`."""

    def change(root: ET.Element) -> Any:
        element = root.find(path)
        if element is None:
            return False
        element.text = text
        return True

    return change


def text(file: str, pattern: str, to: str) -> Deed:
    """Replace what `pattern` matches first in a text file."""

    def deed(folder: Path) -> Any:
        path = one(folder, file)
        old = path.read_text(encoding="utf-8")
        new = re.sub(pattern, to, old, count=1, flags=re.DOTALL)
        path.write_text(new, encoding="utf-8")
        return new != old

    return deed


def document(file: str, change: Callable[[Any], Any]) -> Deed:
    """Change a JSON file."""

    def deed(folder: Path) -> Any:
        path = one(folder, file)
        held = json.loads(path.read_text(encoding="utf-8"))
        done = change(held)
        path.write_text(json.dumps(held, indent=1), encoding="utf-8")
        return done

    return deed


def swap(pattern: str) -> Deed:
    """Let one file be another one of its kind."""

    def deed(folder: Path) -> Any:
        files = sorted(folder.glob(pattern))
        other = next((file for file in files[1:] if file.read_bytes() != files[0].read_bytes()), None)
        if other is None:
            return False
        shutil.copyfile(other, files[0])
        return True

    return deed


def dent(pattern: str) -> Deed:
    """Pull one corner of a part to its middle: it is not convex any more."""

    def deed(folder: Path) -> Any:
        path = one(folder, pattern)
        lines = path.read_text(encoding="utf-8").split("\n")
        rows = [number for number, line in enumerate(lines) if line.startswith("v ")]
        points = [[float(word) for word in lines[row].split()[1:]] for row in rows]
        middle = [sum(axis) / len(points) for axis in zip(*points, strict=True)]
        lines[rows[0]] = "v " + " ".join(repr(0.9 * m + 0.1 * p) for m, p in zip(middle, points[0], strict=True))
        path.write_text("\n".join(lines), encoding="utf-8")

    return deed


def remove(pattern: str) -> Deed:
    """Lose a file."""
    return lambda folder: one(folder, pattern).unlink()


def more(file: str, content: str) -> Deed:
    """A file that was not there."""
    return lambda folder: (folder / file).write_text(content, encoding="utf-8")


def one(folder: Path, pattern: str) -> Path:
    """The first file that `pattern` fits."""
    return sorted(folder.glob(pattern))[0]
