"""A new scene from a sentence, inside a studio."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from pat3d.errors import CheckError, PromptError
from pat3d.progress import Progress
from pat3d.studio.session import MAX_WORDS, Session


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


def made(now: Session | None, sentence: str, *, seed: int, folder: Path, progress: Progress) -> tuple[Session, str]:
    """The scene that `sentence` describes, as the next step of the session `now`, and what to say of it.

    Args:
        now: what undo goes back to; None for nothing.
        sentence: English.
        seed: the same seed gives the same scene.
        folder: written; it has to stay while the session is used.
        progress: told of the stages.

    Raises:
        PromptError: the sentence cannot be read.
        LayoutError: something does not fit.
        SimulationError: the layout cannot be simulated.
        CheckError: no attempt passed the verification.
    """
    from pat3d.generation.editing.editable import load
    from pat3d.generation.pipeline import run_prompt
    from pat3d.generation.settings import Settings

    outcome = run_prompt(_checked(sentence), out=folder, settings=Settings(seed=seed), progress=progress)
    if outcome.report.failures:
        raise CheckError(f"no attempt passed its verification: {outcome.report.failures[0]}")
    scene = load(folder)
    session = Session(current=scene) if now is None else now.stepped(scene)
    return session, f"made and verified in {outcome.report.seconds['total']:.1f} s."


def _checked(sentence: str) -> str:
    said = sentence.strip()
    if not said:
        raise PromptError("write a sentence: a red mug on a stack of three books.")
    if len(said) > MAX_WORDS:
        raise PromptError(f"the sentence has {len(said)} characters; at most {MAX_WORDS} are read.")
    return said
