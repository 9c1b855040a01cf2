"""From a draft of groups to single named objects and the relations between them."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

from pat3d.errors import PromptError
from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.draft import Draft, Group, Sided, carried_by_two
from pat3d.plan.grammar.measures import LARGEST, SMALLEST
from pat3d.plan.grammar.postures import is_natural
from pat3d.plan.scene_plan import Extent, PlannedObject, ScenePlan
from pat3d.scene.model import GROUND, LateralKind, Relation


def build(prompt: str, draft: Draft) -> ScenePlan:
    """The plan that `draft` comes to.

    Raises:
        PromptError: nothing is left to place.
    """
    draft.groups = [group for group in draft.groups if not group.replaced]
    gone = [edge for edge in draft.supports.values() if edge.parent.replaced or edge.child.replaced]
    for edge in gone:
        del draft.supports[id(edge.child)]
    draft.laterals = [edge for edge in draft.laterals if not (edge.parent.replaced or edge.child.replaced)]
    draft.sided = [
        each
        for each in draft.sided
        if not any(group is not None and group.replaced for group in (each.group, each.owner, each.implied))
    ]
    draft.flanks = [flank for flank in draft.flanks if not flank.parent.replaced]
    for flank in draft.flanks:
        flank.members = [group for group in flank.members if not group.replaced and group is not flank.parent]
    if not draft.groups:
        aside = f" Set aside: {'; '.join(draft.set_aside)}." if draft.set_aside else ""
        raise PromptError(f"the prompt names no object to place.{aside} `pat3d catalogue` lists what can be made.")
    _open_boxes(draft)
    _widen_bowls(draft)
    _pair_sides(draft)
    _share_supports(draft)
    members = _members(draft)
    relations = [*_supports(draft, members), *_laterals(draft, members)]
    return ScenePlan(
        prompt=prompt,
        objects=tuple(obj for group in draft.groups for obj in members[id(group)]),
        relations=tuple(dict.fromkeys(relations)),
        set_aside=tuple(dict.fromkeys(draft.set_aside)),
        notes=tuple(dict.fromkeys(draft.notes)),
    )


def _open_boxes(draft: Draft) -> None:
    """Make what holds something an open thing: a carton with balls in it is an open box."""
    for edge in draft.supports.values():
        for closed, opened in lexicon.OPENED.items():
            noun = draft.nouns.resolve(opened)
            if edge.kind == "in" and noun and edge.parent.noun == draft.nouns.resolve(closed):
                edge.parent.noun = noun


def _widen_bowls(draft: Draft) -> None:
    """Make a bowl that holds fruit or more than two things a wide one."""
    for narrow, wide in lexicon.WIDER.items():
        noun = draft.nouns.resolve(wide)
        for bowl in draft.groups:
            if noun is None or bowl.noun != draft.nouns.resolve(narrow):
                continue
            held = [edge.child for edge in draft.supports.values() if edge.kind == "in" and edge.parent is bowl]
            fruit = any(draft.is_a(group, lexicon.FRUIT) or "apple" in group.cycle for group in held)
            if fruit or sum(group.count for group in held) > 2 * bowl.count:
                bowl.noun = noun


def _members(draft: Draft) -> dict[int, list[PlannedObject]]:
    """The objects of every group, by id of the group, with unique names."""
    bare: list[tuple[Group, list[PlannedObject]]] = []
    for group in draft.groups:
        words, objects = group.modifiers, []
        extent = _extent(draft, group)
        for index in range(group.count):
            colours = words.colours
            if index < len(group.member_colours):
                colours = group.member_colours[index]
            noun, said = group.noun, group.said
            if group.cycle:
                said = group.cycle[index % len(group.cycle)]
                noun = draft.nouns.resolve(said) or said
            shown = [colour for colour in colours[:3] if colour not in said.split()]
            name = " ".join(filter(None, (words.size_word, " and ".join(shown), _material_word(group, said), said)))
            plush = (
                "plush" if group.cycle and group.said.split()[0] in ("plush", "stuffed", "soft", "plushie") else None
            )
            objects.append(
                PlannedObject(
                    name=name,
                    noun=noun,
                    phrase=group.phrase,
                    colours=colours,
                    material=words.material or plush,
                    scale=words.scale,
                    extent=extent,
                    adjectives=words.adjectives,
                    proxy=group.proxy,
                )
            )
        bare.append((group, objects))
    total = Counter(obj.name for _, objects in bare for obj in objects)
    seen: Counter[str] = Counter()
    taken = set(total)
    named: dict[int, list[PlannedObject]] = {}
    for group, objects in bare:
        kept = named.setdefault(id(group), [])
        for obj in objects:
            name = obj.name
            if total[name] > 1 or name == GROUND:
                seen[name] += 1
                while f"{name} {seen[name]}" in taken:
                    seen[name] += 1
                name = f"{name} {seen[name]}"
            kept.append(replace(obj, name=name))
    return named


def _extent(draft: Draft, group: Group) -> Extent | None:
    """The size that the prompt gives the objects of `group`; notes on what it gives and the scene does not have.

    Raises:
        PromptError: no object has that size.
    """
    said, notes = group.phrase, draft.notes
    lies = draft.is_a(group, lexicon.LYING)
    for posture in group.modifiers.postures:
        if not is_natural(posture, lies=lies):
            notes.append(f'"{posture}" is left out: "{said}" is placed the way the catalogue makes it.')
    extent = None
    for measure in group.modifiers.measures:
        if measure.distance:
            notes.append(f'"{measure.said}" is left out: distances between objects are not planned.')
        elif not measure.metres:
            notes.append(f'"{measure.said}" is left out: of "{said}" only a size in metres or inches can be set.')
        elif extent is not None:
            notes.append(f'"{measure.said}" is left out: "{said}" has a size already and keeps its proportions.')
        elif not all(SMALLEST <= metres <= LARGEST for metres in measure.metres):
            raise PromptError(f'"{measure.said}": an object may measure {SMALLEST * 1000:g} mm to {LARGEST:g} m.')
        else:
            extent = Extent(metres=max(measure.metres), axis=measure.axis)
            if len(set(measure.metres)) > 1:
                notes.append(f'"{measure.said}": the longest side is {extent.metres:g} m, the others follow.')
    return extent


def _material_word(group: Group, said: str) -> str:
    word = group.modifiers.material_word
    return "" if word in said.split() or word == group.modifiers.size_word else word


def _bases(group: Group, members: list[PlannedObject]) -> list[str]:
    """Names of the objects that stand on the group's support: all, or the lowest of each stack."""
    return [obj.name for obj in members[:: max(group.height, 1)]]


def _tops(group: Group, members: list[PlannedObject]) -> list[str]:
    height = max(group.height, 1)
    return [members[min(start + height, len(members)) - 1].name for start in range(0, len(members), height)]


def _supports(draft: Draft, members: dict[int, list[PlannedObject]]) -> list[Relation]:
    relations: list[Relation] = []
    for group in draft.groups:
        own = members[id(group)]
        edge = draft.supports.get(id(group))
        if edge is not None:
            places = _tops(edge.parent, members[id(edge.parent)])
            if len(places) > len(_bases(group, own)) == 1:
                _check_one_carrier(draft, group, edge.parent, places[0])
            for index, name in enumerate(_bases(group, own)):
                relations.append(Relation(child=name, kind=edge.kind, parent=places[index % len(places)]))
        for index, obj in enumerate(own):
            if index % max(group.height, 1):
                relations.append(Relation(child=obj.name, kind="on", parent=own[index - 1].name))
    return relations


def _check_one_carrier(draft: Draft, group: Group, parents: Group, chosen: str) -> None:
    """Say that one thing "on two books" is on one of them.

    Raises:
        PromptError: the two are no flat things, of which people mean one stack or one of many.
    """
    if not parents.exact or parents.one_of:
        return
    if not draft.is_a(parents, lexicon.THIN):
        raise carried_by_two(group, parents)
    draft.notes.append(f'"{group.phrase}" on "{parents.phrase}" is placed on "{chosen}".')


def _laterals(draft: Draft, members: dict[int, list[PlannedObject]]) -> list[Relation]:
    relations: list[Relation] = []
    for flank in draft.flanks:
        relations += _flanking(draft, flank.parent, flank.members, flank.sides, members)
    for edge in draft.laterals:
        child, parent = _siblings(draft, edge.child, edge.parent)
        if child is None or parent is None:
            draft.notes.append(
                f'"{edge.child.phrase}" {edge.kind} "{edge.parent.phrase}" is left out: one carries the other.'
            )
            continue
        places = _bases(parent, members[id(parent)])
        for index, name in enumerate(_bases(child, members[id(child)])):
            relations.append(Relation(child=name, kind=edge.kind, parent=places[index % len(places)]))
    for group in draft.groups:
        edge = draft.supports.get(id(group))
        if group.heap and (edge is None or edge.kind != "in"):
            names = [obj.name for obj in members[id(group)]]
            relations += [Relation(child=b, kind="next_to", parent=a) for a, b in zip(names, names[1:], strict=False)]
            draft.notes.append(f'"{group.phrase}": its objects lie side by side, since as a stack they would not stay.')
        if group.rows:
            names = _bases(group, members[id(group)])
            length = -(-len(names) // group.rows)
            lines = [names[at : at + length] for at in range(0, len(names), length)]
            pairs = [pair for line in lines for pair in zip(line, line[1:], strict=False)]
            relations += [Relation(child=left, kind="left_of", parent=right) for left, right in pairs]
            pairs = [
                pair
                for line, next_line in zip(lines, lines[1:], strict=False)
                for pair in zip(next_line, line, strict=False)
            ]
            relations += [Relation(child=back, kind="behind", parent=front) for back, front in pairs]
    return relations


def _flanking(
    draft: Draft, parent: Group, groups: list[Group], sides: dict[int, str], members: dict[int, list[PlannedObject]]
) -> list[Relation]:
    """Left and right of `parent`: as the prompt says, else in turn."""
    relations: list[Relation] = []
    known = {"one": "left_of", "left": "left_of", "other": "right_of", "right": "right_of"}
    turn = 0
    for group in groups:
        child, anchor = _siblings(draft, group, parent)
        if child is None or anchor is None:
            continue
        names = _bases(child, members[id(child)])
        place = _bases(anchor, members[id(anchor)])[0]
        for index, name in enumerate(names):
            kind: LateralKind = "right_of" if (turn + (index if len(groups) == 1 else 0)) % 2 else "left_of"
            if id(group) in sides:
                kind = "right_of" if known.get(sides[id(group)]) == "right_of" else "left_of"
            relations.append(Relation(child=name, kind=kind, parent=place))
        turn += 1
    return relations


def _siblings(draft: Draft, child: Group, parent: Group) -> tuple[Group | None, Group | None]:
    """The nearest carriers of `child` and `parent` (or they themselves) that share a support."""
    above_child = [child, *draft.ancestors(child)]
    above_parent = [parent, *draft.ancestors(parent)]
    for one in above_child:
        for other in above_parent:
            if one is not other and draft.support(one) is draft.support(other):
                if one in above_parent or other in above_child:
                    return None, None
                return one, other
    return None, None


_ORDER = {
    "left": (0, 0), "one": (0, 0), "centre": (0, 1), "right": (0, 2), "other": (0, 2), "front": (1, 0), "back": (1, 2),
}  # fmt: skip
_KINDS: dict[tuple[int, int], LateralKind] = {
    (0, 0): "left_of", (0, 2): "right_of", (1, 0): "in_front_of", (1, 2): "behind",
}  # fmt: skip


def _pair_sides(draft: Draft) -> None:
    """Objects on the left are left of what is on the right or in the middle, on the same support."""
    told: set[int] = set()
    for each in draft.sided:
        group, owner = each.group, each.owner
        if owner is not None and owner is not group:
            level = draft.is_a(owner, lexicon.LEVEL + lexicon.SEATS) and draft.support(group) is owner
            if not level and each.side != "centre":
                told.add(id(group))
                draft.beside(group, _KINDS[_ORDER[each.side]], owner)
    for index, each in enumerate(draft.sided):
        for other in draft.sided[index + 1 :]:
            (axis, place), (other_axis, other_place) = _ORDER[each.side], _ORDER[other.side]
            apart = draft.support(each.group) is not draft.support(other.group)
            if each.group is other.group or apart or axis != other_axis or place == other_place:
                continue
            if any(
                one.owner is not None and draft.support(one.group) is None
                for one in draft.sided
                if one.group in (each.group, other.group)
            ):
                continue
            told |= {id(each.group), id(other.group)}
            draft.beside(each.group, _KINDS[axis, 0 if place < other_place else 2], other.group)
    for each in draft.sided:
        inside = any(one.group in draft.ancestors(each.group) for one in draft.sided)
        beside = each.begun and all(other.group is not each.implied for other in draft.sided)
        if each.side != "centre" and not inside and (beside or id(each.group) not in told):
            _side_alone(draft, each)


def _side_alone(draft: Draft, told: Sided) -> None:
    """Put what alone is on a side beside what the prompt implies, or note that the side says nothing."""
    kind = _KINDS[_ORDER[told.side]]
    if told.implied is not None and told.implied is not told.group:
        draft.beside(told.group, kind, told.implied)
    elif all(edge.parent is not told.group and edge.child is not told.group for edge in draft.laterals):
        where = kind.removesuffix("_of").replace("_", " ")
        draft.notes.append(f'"{told.group.phrase}" ({where}): there is nothing beside it that it could be {where} of.')


def _share_supports(draft: Draft) -> None:
    """What stands beside something on a table stands on that table, unless it belongs on the floor."""
    pairs = [(edge.child, edge.parent) for edge in draft.laterals]
    pairs += [(member, flank.parent) for flank in draft.flanks for member in flank.members]
    for _ in range(len(pairs)):
        known = len(draft.supports)
        for pair in pairs:
            for one, other in (pair, pair[::-1]):
                lowest = [other, *draft.ancestors(other)][-1]
                surface = _surface_below(draft, one)
                if surface is None or draft.on_floor(lowest) or lowest in (one, surface, *draft.ancestors(one)):
                    continue
                if draft.is_a(surface, lexicon.LEVEL) or not draft.is_a(lowest, lexicon.BY_A_SEAT):
                    draft.place(lowest, "on", surface)
        if len(draft.supports) == known:
            break


def _surface_below(draft: Draft, group: Group) -> Group | None:
    """The table, shelf or seat that `group` stands on, directly or in a vessel; None where there is none."""
    for carrier in (group, *draft.ancestors(group)):
        edge = draft.supports.get(id(carrier))
        if edge is None or edge.kind == "hangs_from":
            return None
        wide = draft.is_a(edge.parent, lexicon.LEVEL + lexicon.SEATS) and not draft.is_a(edge.parent, lexicon.DISHES)
        if edge.kind == "on" and wide and edge.parent.height == 1:
            return edge.parent
    return None
