"""The offline planner: a grammar over English prompts."""

from __future__ import annotations

from pat3d.errors import PromptError
from pat3d.plan.grammar.build import build
from pat3d.plan.grammar.chunks import chunk
from pat3d.plan.grammar.draft import Draft
from pat3d.plan.grammar.ellipsis import completed
from pat3d.plan.grammar.groups import GroupMaker
from pat3d.plan.grammar.reader import Reader
from pat3d.plan.grammar.vocabulary import Nouns, Vocabulary
from pat3d.plan.scene_plan import ScenePlan

MAX_CHARACTERS = 2000
"""Length of the longest prompt."""
_CHOICE = '"or" is read as "and": everything named is placed.'


class GrammarPlanner:
    """Plans a prompt with word tables and a shallow grammar: no model, no network, the same plan every time.

    With `allow_proxies` an unknown noun becomes a plain box, said so in the plan's notes, instead of an error.
    """

    def __init__(self, allow_proxies: bool = False, *, vocabulary: Vocabulary | None = None) -> None:
        """Plan with the nouns of `vocabulary`, by default the catalogue's; see the class for `allow_proxies`."""
        if vocabulary is None:
            from pat3d.assets.catalogue import lookup

            vocabulary = lookup
        self._nouns = Nouns(vocabulary)
        self._allow_proxies = allow_proxies

    def plan(self, prompt: str) -> ScenePlan:
        """Plan `prompt`.

        Raises:
            PromptError: the prompt is empty or too long, names something that cannot be made, asks for too many
                objects, or has an object rest on itself.
        """
        if not prompt.strip():
            raise PromptError('the prompt is empty. Describe a scene: "a red mug on a wooden table".')
        if len(prompt) > MAX_CHARACTERS:
            raise PromptError(f"the prompt has {len(prompt)} characters; at most {MAX_CHARACTERS} are read.")
        draft = Draft(self._nouns)
        maker = GroupMaker(draft, allow_proxies=self._allow_proxies)
        unread: list[str] = []
        Reader(draft, maker).read(completed(chunk(prompt, self._nouns, unread), self._nouns))
        draft.notes += [_CHOICE if word == "or" else f'"{word}" is left out.' for word in unread]
        return build(prompt, draft)
