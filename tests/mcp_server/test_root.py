"""Where a server may read and write."""

import pytest

from pat3d.errors import SpecError
from pat3d.mcp_server.root import Root


@pytest.mark.parametrize("name", ["", "..", "a/b", "a\\b", ".hidden", "x" * 65, "a b", "C:", "a\0", "-x", "é"])
def test_names_that_could_lead_elsewhere_are_refused(tmp_path, name):
    with pytest.raises(SpecError, match="no scene name"):
        Root.at(tmp_path).named(name)


def test_a_root_that_is_a_file_is_refused(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(SpecError, match="not a folder"):
        Root.at(tmp_path / "file")
