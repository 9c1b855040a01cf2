"""A planner that asks a language model; its plan passes every check that the grammar's passes."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from pat3d.errors import AnswerError, PromptError, SpecError
from pat3d.plan.doors import with_doors
from pat3d.plan.drawers import in_cabinets
from pat3d.plan.grammar.meaning.world import MAX_OBJECTS
from pat3d.plan.grammar.words.measures import LARGEST, SMALLEST
from pat3d.plan.llm.chat import Chat, Message
from pat3d.plan.llm.language import quoted, scene_language
from pat3d.plan.llm.schema import Shape
from pat3d.plan.scene_plan import ScenePlan
from pat3d.scene.arrangements import ARRANGEMENTS, POSTURES, Arrangement
from pat3d.scene.relations import GROUND
from pat3d.scene.task_spec import about, chain_of, steps_of

if TYPE_CHECKING:
    from pat3d.assets.generated.orders import Orders

MAX_CHARACTERS = 4000
"""Of a prompt."""
MAX_NAME = 80
"""Characters of an object's name."""
MAX_COMPOSED = 5
"""Nouns that are composed for one prompt."""
PROXY = "box"
_SCALE = (0.05, 20.0)


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What the model answers."""

    plan: ScenePlan
    missing: tuple[str, ...] = ()
    """Words of the description that name objects which no noun of the catalogue names."""


class LLMPlanner:
    """Plans prompts of any language with the model that `chat` asks."""

    def __init__(
        self,
        chat: Chat,
        allow_proxies: bool = False,
        libraries: Sequence[str] = (),
        *,
        composes: bool = False,
        orders: Orders | None = None,
    ) -> None:
        """Ask `chat`; what catalogue and `libraries` lack becomes a plain box, or the model composes it.

        Args:
            chat: the model.
            allow_proxies: plain boxes stand in for what nothing has.
            libraries: to take objects from before the catalogue.
            composes: the model describes what nothing has in the shape language, and it is kept.
            orders: a mesh server makes what nothing has, and the model composes nothing.
        """
        self._chat, self._libraries, self._orders = chat, libraries, orders
        self._composes = composes or orders is not None
        self._composed: dict[str, str] = {}
        self._proxies = allow_proxies
        self._cost: dict[str, int] = {}

    def plan(self, prompt: str) -> ScenePlan:
        """Plan `prompt`.

        Raises:
            PromptError: the prompt is empty or too long, or names what the catalogue lacks.
            ModelError: the model gives no plan that can be made.
        """
        self._composed = {}
        return self._ask(prompt, self._messages(prompt))

    def revise(self, prompt: str, plan: ScenePlan, faults: Sequence[str]) -> ScenePlan:
        """Another plan of `prompt`, where the scene of `plan` was seen to have `faults`.

        Raises:
            PromptError: as for `plan`.
            ModelError: as for `plan`.
        """
        from pat3d.plan.describe import describe

        seen = "\n".join(f"- {fault}" for fault in faults)
        words = (
            f"A plan of this description was:\n{describe(plan)}\n\n"
            f"Who looked at pictures of its scene says:\n{seen}\n\n"
            "Plan the description again so that this becomes right. Change nothing that is right already."
        )
        return self._ask(prompt, [*self._messages(prompt), {"role": "user", "content": words}])

    def record(self) -> dict[str, Any]:
        """What the report says: the model, and what the last plan has cost."""
        settings = self._chat.settings
        return {
            "planner": "llm",
            "model": settings.name,
            "server": settings.server,
            **self._cost,
            **({("ordered" if self._orders else "composed"): self._composed} if self._composed else {}),
        }

    def _messages(self, prompt: str) -> list[Message]:
        if not prompt.strip():
            raise PromptError('the prompt is empty. Describe a scene: "a red mug on a wooden table".')
        if len(prompt) > MAX_CHARACTERS:
            raise PromptError(f"the prompt has {len(prompt)} characters; at most {MAX_CHARACTERS} are read.")
        names = self._names
        told = scene_language(
            names["PlannedObject.noun"],
            names["PlannedObject.colours"],
            names["PlannedObject.material"],
            allow_proxies=self._proxies,
        )
        return [{"role": "system", "content": told}, {"role": "user", "content": quoted(prompt)}]

    def _ask(self, prompt: str, messages: list[Message]) -> ScenePlan:
        hidden: dict[str, Any] = {"ScenePlan.prompt": prompt, "ScenePlan.otherwise": ""}
        if not self._proxies:
            hidden["PlannedObject.proxy"] = False
        shape = Shape(kind=Answer, choices=self._names, hidden=hidden)

        def made(data: Any) -> Answer:
            missing = tuple(data.get("missing", ()))
            # What is missing is said before a plan without it is looked at.
            return replace(_NONE, missing=missing) if missing else _slid(_checked(shape.made(Answer, data)))

        before = self._chat.usage.as_dict()
        answer = self._chat.ask(messages, shape, made=made)
        self._cost = {name: count - before[name] for name, count in self._chat.usage.as_dict().items()}
        if answer.missing and self._composes and not self._composed:
            return self._composing(prompt, answer.missing, messages, before)
        if answer.missing:
            words = ", ".join(f'"{word}"' for word in answer.missing)
            raise PromptError(
                f"{words}: not in the catalogue. `pat3d catalogue` lists what is; use meshes of your own with pat3d "
                "build, or accept a plain box with --allow-proxies."
            )
        return _noted(answer.plan)

    def _composing(
        self, prompt: str, missing: Sequence[str], messages: list[Message], before: Mapping[str, int]
    ) -> ScenePlan:
        """The plan of `prompt` once the model has composed what is `missing`; `before` is what was used before it."""
        from pat3d.plan.llm.composing import compose

        orders, told = self._orders, list[str]()
        for words in missing[:MAX_COMPOSED]:
            if orders is not None:
                order = orders.order(words)
                self._composed[words] = order.noun
                told.append(orders.told(order))
            else:
                self._composed[words] = compose(self._chat, words)
                told.append(f'"{words}": the model composed {self._composed[words]}; look at it.')
        if orders is not None:
            orders.keep(self._composed.values())
        self.__dict__.pop("_names", None)
        plan = self._ask(prompt, [*self._messages(prompt), *messages[2:]])
        self._cost = {name: count - before[name] for name, count in self._chat.usage.as_dict().items()}
        return replace(plan, notes=(*plan.notes, *told))

    @cached_property
    def _names(self) -> Mapping[str, Sequence[str]]:
        """The names that the catalogue, the colours and the materials have."""
        from pat3d.assets.colours import COLOURS
        from pat3d.assets.materials import material_names
        from pat3d.plan.grammar.words.names import known_names

        known = known_names(self._libraries)
        ordered = self._orders.names().values() if self._orders is not None else ()
        nouns = {*ordered} | {found.noun for name in known.names() if (found := known.find(name)) is not None}
        return {
            "PlannedObject.noun": sorted(nouns),
            "PlannedObject.colours": sorted(COLOURS),
            "PlannedObject.material": material_names(),
        }


_NONE = Answer(plan=None)  # type: ignore[arg-type]


def _checked(answer: Answer) -> Answer:
    """`answer`, if it can be made.

    Raises:
        AnswerError: the types allow what no scene can have.
    """
    plan, faults = answer.plan, []
    names = {obj.name for obj in plan.objects}
    if len(names) > MAX_OBJECTS:
        faults.append(f"{len(names)} objects; at most {MAX_OBJECTS}.")
    for obj in plan.objects:
        if not obj.name or len(obj.name) > MAX_NAME or obj.name == GROUND or ":" in obj.name:
            faults.append(f'"{obj.name}" is no name: 1 to {MAX_NAME} characters, no colon, not "{GROUND}".')
        if not _SCALE[0] <= obj.scale <= _SCALE[1]:
            faults.append(f'scale {obj.scale} of "{obj.name}": it must be from {_SCALE[0]} to {_SCALE[1]}.')
        if obj.extent is not None and not SMALLEST <= obj.extent.metres <= LARGEST:
            faults.append(f'{obj.extent.metres} m of "{obj.name}": it must be from {SMALLEST} to {LARGEST}.')
        if obj.proxy and obj.noun != PROXY:
            faults.append(f'"{obj.name}" is a proxy, so its noun must be "{PROXY}".')
    for relation in plan.relations:
        if not relation.supports and plan.parent(relation.child) != plan.parent(relation.parent):
            faults.append(f'"{relation}" holds only between two objects with the same support.')
    faults += _not_held(plan)
    if plan.task is not None and not _is_task(plan.task, names):
        faults.append(
            f'no task "{plan.task}": pick:A, place:A:B, stack:A:B, beside:A:left_of:B, unload:A, sort, '
            "open:OBJECT, close:OBJECT or chain:STEP:then:STEP, with names of objects."
        )
    if faults:
        raise AnswerError("\n".join(faults))
    return answer


def _slid(answer: Answer) -> Answer:
    """`answer` with its drawers in a cabinet, and doors in what its task opens or shuts.

    Raises:
        AnswerError: there are too many of them.
    """
    try:
        return replace(answer, plan=with_doors(in_cabinets(answer.plan)))
    except PromptError as error:
        raise AnswerError(str(error)) from error


def _is_task(task: str, names: Collection[str]) -> bool:
    """Whether `task` is about objects called `names`, and a chain where it has several steps."""
    steps = steps_of(task)
    known = all((named := about(step)) is not None and {*named} <= {*names} for step in steps)
    return known and (len(steps) == 1 or chain_of([":".join(step) for step in steps]) == task)


def _not_held(plan: ScenePlan) -> list[str]:
    """What `plan` says that the scene is to hold, and no scene can."""
    faults = []
    for each in plan.arrangements:
        if not each.arranged:
            continue
        if each.kind not in ARRANGEMENTS:
            faults.append(f'no scene holds "{each.kind}": `arranged` must be false.')
            continue
        try:
            Arrangement(kind=each.kind, objects=each.objects, of=each.of)  # type: ignore[arg-type]
        except SpecError as error:
            faults.append(str(error))
    faults += [
        f'no scene holds that "{each.object}" is {each.kind}: `arranged` must be false.'
        for each in plan.postures
        if each.arranged and each.kind not in POSTURES
    ]
    return faults


def _noted(plan: ScenePlan) -> ScenePlan:
    """`plan` with a note on everything that it records and does not bring about."""
    notes = list(plan.notes)
    for each in plan.arrangements:
        if not getattr(each, "arranged", True):
            notes.append(f"not arranged: {', '.join(each.objects)} {each.kind.replace('_', ' ')}")
    for each in plan.postures:
        if not getattr(each, "arranged", True):
            notes.append(f'not arranged: "{each.said}" of "{each.object}"')
    for obj in plan.objects:
        if obj.proxy:
            notes.append(f'"{obj.phrase or obj.name}" is not in the catalogue: a plain box stands in.')
    return replace(plan, notes=tuple(dict.fromkeys(notes)))
