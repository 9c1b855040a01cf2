"""A new scene from a sentence, inside a studio."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from pat3d.errors import PromptError
from pat3d.progress import Progress, silent
from pat3d.studio.jobs import generated
from pat3d.studio.session import MAX_WORDS, Session
from pat3d.studio.worker import Run, here


@lru_cache(maxsize=32)
def told(sentence: str) -> str:
    """How `sentence` is read by the offline grammar.

    Raises:
        PromptError: it cannot be read.
    """
    from pat3d.plan.grammar.planner import GrammarPlanner
    from pat3d.plan.telling import tell

    plan = GrammarPlanner().plan(_checked(sentence))
    notes = " ".join(f"({note})" for note in (*plan.notes, *(f"set aside: {one}" for one in plan.set_aside)))
    return f"{tell(plan)} {notes}".strip()


def made(
    now: Session | None, sentence: str, *, seed: int, folder: Path, progress: Progress = silent, run: Run = here
) -> tuple[Session, str]:
    """The scene that `sentence` describes, as the next step of the session `now`, and what to say of it.

    Args:
        now: what undo goes back to; None for nothing.
        sentence: English.
        seed: the same seed gives the same scene.
        folder: written; it has to stay while the session is used.
        progress: told of the stages.
        run: does the work.

    Raises:
        Pat3dError: as `generated`.
    """
    from pat3d.generation.editing.editable import load

    seconds = run(generated, _checked(sentence), seed, folder, progress=progress)
    scene = load(folder)
    session = Session(current=scene) if now is None else now.stepped(scene)
    return session, f"made and verified in {seconds:.1f} s."


def _checked(sentence: str) -> str:
    said = sentence.strip()
    if not said:
        raise PromptError("write a sentence: a red mug on a stack of three books.")
    if len(said) > MAX_WORDS:
        raise PromptError(f"the sentence has {len(said)} characters; at most {MAX_WORDS} are read.")
    return said
