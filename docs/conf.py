"""The documentation as a site: `make docs` builds it with Sphinx into build/docs."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))
sys.path.insert(0, str(Path(__file__).parents[1]))

from site_pages import filled
from sphinx.ext.autodoc.mock import mock

import pat3d

project = "PAT3D"
author = "The PAT3D contributors"
project_copyright = author
version = release = pat3d.__version__
html_title = f"PAT3D {release}"
html_theme = "furo"

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
myst_heading_anchors = 4
# Arrays of options and "--" stand as they are typed.
smartquotes = False
# Docstrings name code in single backquotes.
default_role = "code"
autodoc_typehints = "description"
autodoc_member_order = "bysource"
autodoc_class_signature = "separated"
OPTIONAL = ("gymnasium", "torch", "mujoco_warp", "pyarrow", "h5py", "websockets", "pxr", "ray", "openai", "numba")
autodoc_mock_imports = [name for name in OPTIONAL if find_spec(name) is None]


def setup(app: Any) -> None:
    """Fill in what pages take from the code."""

    def fill(_: Any, page: str, source: list[str]) -> None:
        if (Path(app.srcdir) / f"{page}.md").is_file():
            with mock(autodoc_mock_imports):
                source[0] = filled(source[0], f"{page}.md")

    app.connect("source-read", fill)
