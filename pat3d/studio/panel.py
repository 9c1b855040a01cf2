"""The panel beside the scene: facts, edits, settling, saving, and sentences; it shows the workbench and asks it."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from pat3d.errors import Pat3dError
from pat3d.exporters.formats import FORMATS, NEED_USD, VIEWS, has_usd
from pat3d.geometry.pose import Pose
from pat3d.progress import Event
from pat3d.studio import facts
from pat3d.studio.session import Session
from pat3d.studio.settling import SettlingFolder
from pat3d.studio.status import StatusLine
from pat3d.studio.store import Store
from pat3d.studio.view import Shown, View
from pat3d.studio.workbench import Watch, Workbench, needed
from pat3d.studio.worker import Run, here

if TYPE_CHECKING:
    import viser

NOTHING = "(nothing)"
_VERBS = ("move", "turn", "replace", "scale", "set", "fix", "free")


class Panel:
    """The interface of one server; all browsers see the same."""

    def __init__(
        self, server: viser.ViserServer, bench: Workbench, status: StatusLine, store: Store, name: str, run: Run = here
    ) -> None:
        """Show `bench`; scenes are saved into `store`, under `name` where nobody says another; `run` does long work."""
        self._bench, self._status, self._store, self._run = bench, status, store, run
        self._drawing = threading.RLock()
        self._filling = False
        self._veiled = False
        self._begun = False
        """Whether a scene is shown that is being made."""
        self._view = View(server, self._click, self._drag)
        self.gui: Any = server.gui
        self.scene: Any = server.scene
        self.server = server
        self._build(name)
        bench.changed = self.show
        self._looked: Any = None
        self.show()

    def veil(self, veiled: bool) -> None:
        """Take the scene out of sight, or show it again."""
        self._veiled, self._looked = veiled, None
        self.show()

    def show(self) -> None:
        """Bring everything up to date."""
        with self._drawing:
            session, status = self._bench.session, self._bench.status
            self._filling = True
            try:
                self._status.show()
                self._orders.content = facts.orders(self._bench.orders)
                self._forget.visible = any(one.state == "waiting" for one in self._bench.orders)
                if status.working and session is self._looked:
                    return
                self._show_session(session)
            finally:
                self._filling = False

    @property
    def name(self) -> str:
        """Under which scenes are saved."""
        return self._name.value

    @property
    def verdict(self) -> str:
        """What it says of the scene as a whole, in Markdown."""
        return self._verdict.content

    def _show_session(self, session: Session | None) -> None:
        before, self._looked = self._looked, session
        other = session is not None and (before is None or before.current.folder != session.current.folder)
        # What was made has been looked at since it began to settle; where it failed, the scene before comes back.
        begun, self._begun = self._begun, False
        if session is not None and other != begun and not self._veiled:
            self._view.look_at(session.scene)
        self._draw()
        self._settling.show(session)
        if session is None:
            self._told.content = "No scene yet. Write a sentence below and press **Make**."
            for button in (self._settle, self._undo, self._redo, self._delete):
                button.disabled = True
            self._table.content = self._about.content = self._verdict.content = self._changed.content = ""
            return
        self._told.content = _told(session)
        self._verdict.content = facts.verdict(session)
        self._table.content = facts.table(session)
        self._about.content = facts.about(session)
        self._changed.content = facts.changed(session)
        self._list.options = (NOTHING, *(obj.name for obj in session.scene.objects))
        self._list.value = session.selected or NOTHING
        self._undo.disabled, self._redo.disabled = not session.past, not session.future
        self._delete.disabled = session.selected is None
        self._settle.disabled = session.at_rest

    def _build(self, name: str) -> None:
        gui = self.gui
        with gui.add_folder("Scene"):
            self._told = gui.add_markdown("")
            self._verdict = gui.add_markdown("")
            self._boxes = {
                "names": gui.add_checkbox("Names", True),
                "hulls": gui.add_checkbox("Convex hulls", False),
                "forces": gui.add_checkbox("Contact forces", False),
                "ghost": gui.add_checkbox("Initial layout", False),
                "before": gui.add_checkbox("Before the edits", False),
                "shadows": gui.add_checkbox("Shadows, reflections", False),
            }
            for box in self._boxes.values():
                box.on_update(lambda _: self._toggle())
        with gui.add_folder("Edit"):
            self._list = gui.add_dropdown("Selected", (NOTHING,))
            self._list.on_update(lambda _: self._choose())
            self._about = gui.add_markdown("")
            self._settle = gui.add_button("Settle", color="green", hint="bring it to rest and verify it")
            self._settle.on_click(lambda _: self._bench.start("Settling", self._settled))
            self._undo, self._redo = gui.add_button("Undo"), gui.add_button("Redo")
            self._undo.on_click(lambda _: self._bench.do(lambda now: needed(now).undone()))
            self._redo.on_click(lambda _: self._bench.do(lambda now: needed(now).redone()))
            self._delete = gui.add_button("Delete", hint="take the selected object away")
            self._delete.on_click(lambda _: self._bench.do(lambda now: needed(now).removed()))
            self._add = gui.add_text("Add", "", hint="a mug on the books")
            gui.add_button("Add it").on_click(lambda _: self._edit("add", self._add.value))
            self._verb = gui.add_dropdown("Otherwise", _VERBS)
            self._words = gui.add_text("In words", "", hint="vase: 10 cm to the right; mug: mass=0.3")
            gui.add_button("Do it").on_click(lambda _: self._edit(self._verb.value, self._words.value))
        with gui.add_folder("Objects"):
            self._table = gui.add_markdown("")
            self._changed = gui.add_markdown("")
        self._settling = SettlingFolder(gui, self._view)
        with gui.add_folder("Save and export", expand_by_default=False):
            self._name = gui.add_text("Name", name, hint="a subfolder of the studio's folder")
            gui.add_button("Save").on_click(lambda _: self._save())
            kinds = [one for one in (*FORMATS, *VIEWS) if one not in NEED_USD or has_usd()]
            self._formats = {one: gui.add_checkbox(one, one == "mjcf") for one in kinds}
            gui.add_button("Export").on_click(lambda _: self._export())
        with gui.add_folder("New scene"):
            self._prompt = gui.add_text("Sentence", "", multiline=True, hint="a red mug on a stack of three books")
            self._seed = gui.add_number("Seed", 0, min=0, max=2**31 - 1, step=1)
            gui.add_button("Plan", hint="say how it is read, and make nothing").on_click(lambda _: self._plan())
            gui.add_button("Make", color="green").on_click(lambda _: self._make())
            self._orders = gui.add_markdown("")
            self._forget = gui.add_button("Drop what waits", visible=False)
            self._forget.on_click(lambda _: self._bench.forget())

    def _click(self, name: str) -> None:
        self._bench.do(lambda now: needed(now).select(name))

    def _drag(self, pose: Pose) -> None:
        self._bench.do(lambda now: needed(now).dragged(pose))
        # Where it was refused or put down elsewhere, the object goes where it is.
        self.show()

    def _choose(self) -> None:
        chosen = self._list.value
        session = self._bench.session
        if self._filling or session is None or chosen == (session.selected or NOTHING):
            return
        self._bench.do(lambda now: needed(now).select(None if chosen == NOTHING else chosen))

    def _toggle(self) -> None:
        with self._drawing:
            if not self._begun:
                self._draw()

    def _draw(self) -> None:
        shown = Shown(**{name: box.value for name, box in self._boxes.items()})
        self._view.draw(None if self._veiled else self._bench.session, shown)

    def _edit(self, verb: str, words: str) -> None:
        def work(now: Session | None, progress: Watch) -> tuple[Session, str]:
            found = needed(now).edited(verb, words, progress=progress, run=self._run)
            return found, "; ".join(found.current.draft.notes[-3:])

        # Adding makes assets, which can take seconds.
        self._bench.start("Editing", work)

    def _save(self) -> None:
        name = self._name.value

        def work(now: Session | None, progress: Watch) -> tuple[Session, str]:
            session = needed(now)
            return session, f"saved: {self._store.saved(session, name, progress, run=self._run)}"

        self._bench.start("Saving", work)

    def _export(self) -> None:
        name, formats = self._name.value, [kind for kind, box in self._formats.items() if box.value]

        def work(now: Session | None, progress: Watch) -> tuple[Session, str]:
            session = needed(now)
            paths = self._store.exported(session, name, formats, progress, run=self._run)
            return session, f"exported and read back: {', '.join(map(str, paths))}"

        self._bench.start("Exporting", work)

    def _plan(self) -> None:
        from pat3d.studio.making import told

        sentence = self._prompt.value
        self._bench.start("Planning", lambda now, progress: (now, told(sentence)))  # type: ignore[arg-type, return-value]

    def _make(self) -> None:
        from pat3d.studio.making import made

        sentence, seed = self._prompt.value, int(self._seed.value)

        def work(now: Session | None, progress: Watch) -> tuple[Session, str]:
            folder, follow = self._store.fresh(), progress.followed(self._follow)
            session, said = made(now, sentence, seed=seed, folder=folder, progress=follow, run=self._run)
            self._name.value = self._store.name_for(sentence)
            return session, said

        if self._bench.order("Making", sentence, work):
            return
        self._bench.do(lambda now: now, "too many sentences wait already.")

    def _settled(self, now: Session | None, progress: Watch) -> tuple[Session, str]:
        session = needed(now).settled(progress.followed(self._follow), run=self._run)
        changes = session.current.changes
        farthest = None if changes is None else changes.farthest
        if changes is None or farthest is None:
            return session, "settled and verified."
        name, motion = farthest
        moved = f'settled and verified. Moved farthest: "{name}" by {motion.mm:.1f} mm.'
        return session, " ".join((moved, *changes.notes, *changes.broke))

    def _follow(self, event: Event) -> None:
        """Show a new scene once it is laid out, and where the objects are while they settle."""
        if self._veiled:
            return
        with self._drawing:
            if event.scene is not None:
                self._begun = True
                self._view.begin(event.scene)
            if event.places is not None:
                self._view.pose(event.places())


def _told(session: Session) -> str:
    """The sentence, and how it was read."""
    from pat3d.studio.making import told

    prompt = session.scene.prompt
    if not prompt:
        return ""
    try:
        return f"*{facts.plain(prompt)}*\n\nRead as: {facts.plain(told(prompt))}"
    except Pat3dError:
        return f"*{facts.plain(prompt)}*"
