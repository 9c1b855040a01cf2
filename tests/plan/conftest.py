"""What all tests of the planner have in common."""

from __future__ import annotations

import pytest

from pat3d.plan.audit import auditor


@pytest.fixture(autouse=True)
def _wording_is_no_matter(monkeypatch, request):
    """No note on wording that was not tried, but where that is tested: what was tried changes with every test."""
    if request.module.__name__.rpartition(".")[2] != "test_untried":
        monkeypatch.setattr(auditor, "untried", lambda *_: ())
