"""What a studio does at present, at the top of its panel, with a button that cancels it."""

from __future__ import annotations

from typing import Any

from pat3d.studio import facts
from pat3d.studio.workbench import Workbench


class StatusLine:
    """A line of words, a bar while work goes on, and a button."""

    def __init__(self, gui: Any, bench: Workbench) -> None:
        self._bench = bench
        self._words = gui.add_markdown("Ready.")
        self._bar = gui.add_progress_bar(0.0, animated=True, visible=False)
        self._stop = gui.add_button("Cancel", color="red", visible=False)
        self._stop.on_click(lambda _: bench.cancel())

    def show(self) -> None:
        """Bring it up to date."""
        status = self._bench.status
        if status.working:
            said = f"**{status.working}**: {facts.plain(status.stage)}"
        else:
            said = f"{'**Refused:** ' if status.failed else ''}{facts.plain(status.said)}" if status.said else "Ready."
        if said != self._words.content:
            self._words.content = said
        self._bar.visible = self._stop.visible = bool(status.working)
        self._bar.value = 100.0 * (status.share or 0.0)
