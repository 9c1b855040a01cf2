"""From what was read to a plan: sides are paired, supports shared, objects named."""

from __future__ import annotations

from collections import Counter

from pat3d.errors import PromptError
from pat3d.plan.drawers import DRAWERS
from pat3d.plan.grammar.meaning import apart, arranging, attached, covers, orders, ranks
from pat3d.plan.grammar.meaning.entities import Edge, Group, Item, Sided
from pat3d.plan.grammar.meaning.undone import open_or_shut
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.lexing import normalise, singulars, tokenise
from pat3d.plan.grammar.words.measures import LARGEST, SMALLEST
from pat3d.plan.grammar.words.modifiers import Modifiers
from pat3d.plan.grammar.words.postures import is_held, kind_of, stands_on_edge
from pat3d.plan.grammar.words.stand_ins import STAND_IN_SIZES
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.plan.scene_plan import Arrangement, Extent, PlannedObject, Posture, ScenePlan
from pat3d.scene.relations import GROUND, RELATION_WORDS, LateralKind, Relation

_ORDER = {
    "left": (0, 0), "one": (0, 0), "centre": (0, 1), "right": (0, 2), "other": (0, 2), "front": (1, 0), "back": (1, 2),
}  # fmt: skip
_KINDS: dict[tuple[int, int], LateralKind] = {
    (0, 0): "left_of", (0, 2): "right_of", (1, 0): "in_front_of", (1, 2): "behind",
}  # fmt: skip


def _parts(prompt: str) -> str:
    """Which words of `prompt` name a part, a place or any thing at all."""
    tables = lexicon.PARTS | lexicon.BACKGROUND | lexicon.ITEMS | lexicon.DETACHED
    told = [f'"{token.text}" (word {token.number})' for token in tokenise(normalise(prompt))
            if tables & {token.text, *singulars(token.text)}]  # fmt: skip
    return f": {', '.join(told[:3])}: a part or a place is none" if told else ""


def finish(prompt: str, world: World, nouns: Nouns) -> tuple[ScenePlan, dict[Item, str]]:
    """The plan that `world` comes to, and the name of every object.

    Raises:
        PromptError: nothing is left to place.
    """
    if not world.items():
        aside = f" Set aside: {'; '.join(world.aside)}." if world.aside else ""
        told = _parts(prompt)
        raise PromptError(
            f"the prompt names no object to place{told}.{aside} `pat3d catalogue` lists what can be made."
        )
    for item in (item for item in world.items() if item.group.noun not in DRAWERS):
        like = [other for other in world.items() if other.group.noun == item.group.noun]
        if item.place and len(like) == 1:
            world.note(f'"{item.group.words}": there is only one, so it is not told by its place.')
        levels = {*lexicon.LEVELS, *(["middle"] if any(other.place in lexicon.LEVELS for other in like) else [])}
        if item.place in levels and item.group.height == 1 and len(like) > 1 and not item.group.pyramid:
            world.note(f'"{item.place}": "{item.group.words}" are not said to be stacked.')
    world.groups = [group for group in world.groups if not group.replaced]
    there = set(world.items())
    world.supports = {c: e for c, e in world.supports.items() if {c, e.parent} <= there}
    world.laterals = [edge for edge in world.laterals if {edge.child, edge.parent} <= there]
    for item in world.grounded & world.supports.keys():
        if world.supports[item].parent not in item.group.items:
            del world.supports[item]
    apart.settle(world)
    covers.settle(world)
    open_or_shut(world, nouns)
    _widen_bowls(world, nouns)
    ranks.settle(world)
    _pair_sides(world)
    attached.lay_table(world)
    _share_supports(world)
    arranging.settle(world, prompt)
    orders.settle(world, prompt)
    objects = _objects(world, nouns)
    names = {item: obj.name for item, obj in objects.items()}
    relations = [*_supports(world, names), *arranging.further_carriers(world, names), *_laterals(world, names)]
    postures = _postures(world, names)
    arrangements = [
        Arrangement(kind=each.kind, objects=tuple(names[i] for i in each.items if i in names),
                    of=tuple(names[i] for i in each.of if i in names), arranged=each.arranged)
        for each in world.arranged
    ]  # fmt: skip
    plan = ScenePlan(
        prompt=prompt,
        objects=tuple(objects.values()),
        relations=tuple(dict.fromkeys(relations)),
        set_aside=tuple(dict.fromkeys(world.aside)),
        notes=tuple(dict.fromkeys(world.notes)),
        arrangements=tuple(dict.fromkeys(each for each in arrangements if each.objects)),
        postures=tuple(postures),
    )
    return plan, names


def _widen_bowls(world: World, nouns: Nouns) -> None:
    """Make a bowl that holds fruit or more than two things a wide one."""
    for narrow, wide in vessels.WIDER.items():
        noun = nouns.resolve(wide)
        for group in world.groups:
            if noun is None or group.noun != nouns.resolve(narrow) or not nouns.own(group.noun):
                continue
            held = [e.child for e in world.supports.values() if e.kind == "in" and e.parent.group is group]
            fruit = any(world.is_a(item, lexicon.FRUIT) for item in held)
            if fruit or len(held) > 2 * len(group.items):
                group.noun = noun


def _pair_sides(world: World) -> None:
    """Objects on the left are left of what is on the right or in the middle, on the same support."""
    told: set[int] = set()
    order = {item: at for at, item in enumerate(world.items())}
    world.sided.sort(key=lambda each: order.get(each.items[0], 0))
    for each in world.sided:
        item, owner = each.items[0], each.owner
        if owner and item not in owner:
            level = world.is_a(owner[0], lexicon.LEVEL, lexicon.SEATS) and world.support(item) is owner[0]
            if not level and each.side != "centre":
                told.add(id(each))
                kind = _KINDS[_ORDER[each.side]]
                world.beside(each.items, kind, _from_its_end(world, owner, kind))
    for index, each in enumerate(world.sided):
        for other in world.sided[index + 1 :]:
            one, two = each.items[0], other.items[0]
            (axis, place), (other_axis, other_place) = _ORDER[each.side], _ORDER[other.side]
            apart = world.support(one) is not world.support(two)
            if (one.group is two.group and one is two) or apart or axis != other_axis or place == other_place:
                continue
            if any(side.owner and world.support(side.items[0]) is None for side in (each, other)):
                continue
            told |= {id(each), id(other)}
            world.beside(each.items, _KINDS[axis, 0 if place < other_place else 2], other.items)
    for each in world.sided:
        above = world.ancestors(each.items[0])
        inside = any(one.items[0] in above for one in world.sided)
        beside = each.begun and all(other.items != each.implied for other in world.sided)
        if each.side == "centre":
            flanks = {_ORDER[one.side] for one in world.sided if one.side != "centre" and one.owner == each.owner}
            # "A desk with a lamp in the middle and a mug on the left": not only right of the mug.
            carrier = world.support(each.items[0])
            whole = each.owner or ([carrier] if carrier is not None and world.is_a(carrier, lexicon.LEVEL) else [])
            alone = bool(whole) and carrier is whole[0] and len(flanks) < 2
            if id(each) not in told or alone:
                world.arrange("in_middle", each.items, whole, f'"{each.items[0].group.words}" in the middle')
        elif not inside and (beside or id(each) not in told):
            _side_alone(world, each)


def _from_its_end(world: World, items: list[Item], kind: LateralKind) -> list[Item]:
    """`items` from the end at which another stands that is beside them: at the right end of a row from its last on."""
    rows = [each.items for each in world.arranged if each.kind == "row" and {*items} & {*each.items}]
    if rows and kind in ("left_of", "right_of"):
        # "A cup, a jar and a can in a row with a ball at the right end"
        items = rows[0]
    return items[::-1] if kind == "right_of" and (rows or any(item.group.rows for item in items)) else items


def _side_alone(world: World, told: Sided) -> None:
    """Put what alone is on a side beside what the prompt implies, or note that the side says nothing."""
    kind, name = _KINDS[_ORDER[told.side]], f'"{told.items[0].group.words}"'
    below = {item for each in world.arranged if each.kind == "under" for item in each.items + each.of}
    below = below if below & {*told.items} else set()
    implied = [item for item in told.implied or _others_there(world, told) if item not in {*told.items} | below]
    if implied:
        ends = _from_its_end(world, implied, kind)
        rowed = ends is not implied
        firsts = {item.group: item for item in reversed(ends[:1] if rowed else ends)}
        for first in reversed(firsts.values()):
            world.beside(told.items, kind, [first])
    elif not any(_tells_side(edge, told) for edge in world.laterals):
        if told.side in ("one", "other"):
            world.note(f"not arranged: {name} at one end or side")
            return
        where = kind.removesuffix("_of").replace("_", " ")
        if any({edge.child, edge.parent} & {*told.items} for edge in world.laterals):
            world.note(f"not arranged: {name} on the {told.side}; it is only next to what is said")
            return
        world.note(f"{name} ({where}): there is nothing beside it that it could be {where} of.")


def _others_there(world: World, told: Sided) -> list[Item]:
    """What else stands on the surface on a side of which something is told to be, and beside nothing on it."""
    carrier = world.support(told.items[0])
    bare = told.side in ("one", "other") or any(_tells_side(edge, told) for edge in world.laterals)
    if bare or carrier is None or carrier not in told.owner:
        return []
    there = [item for item, edge in world.supports.items() if edge.parent is carrier]
    beside = {edge.child for edge in world.laterals if edge.parent in there}
    return [item for item in there if item not in beside]


def _tells_side(edge: Edge, told: Sided) -> bool:
    """Whether `edge` says on which side of something is what is on a side: "next to it" does not."""
    return edge.kind != "next_to" and (edge.parent in told.items or edge.child in told.items)


def _share_supports(world: World) -> None:
    """What stands beside something on a table stands on that table, unless it belongs on the floor."""
    for each in world.arranged:
        carriers = {world.support(other) for other in each.of}
        if each.kind == "between" and len(carriers) == 1 and (carrier := carriers.pop()) is not None:
            # Of what stands on a board too: between its neighbours is beside both of them.
            free = [item for item in each.items if world.support(item) is None and not world.on_floor(item)]
            edge = world.supports.get(each.of[0])
            free = [item for item in free if item not in world.ancestors(carrier)]
            world.place(free, edge.kind if edge is not None else "on", [carrier])
    edges = [*world.laterals, *arranging.together(world)]
    for _ in range(len(edges)):
        known = len(world.supports)
        for edge in edges:
            for one, other in ((edge.child, edge.parent), (edge.parent, edge.child)):
                lowest = [other, *world.ancestors(other)][-1]
                # "A teapot with two cups on a tray": what is only said to be with it is on the tray too.
                around = edge.kind == "around"
                # "A mug on a tray and a second mug beside it"
                alike = world.noun(one) == world.noun(other)
                surface = _surface_below(world, one, dishes=edge.weak, trays=around or alike)
                taken = (one, surface, *world.ancestors(one))
                # "A table surrounded by chairs on a rug" is on the rug too.
                rug = around and surface is not None and world.is_a(surface, ("rug", "carpet"))
                fixed = lowest in {*taken, *world.grounded, *world.floored}
                if surface is None or fixed or (world.on_floor(lowest) and not rug):
                    continue
                if world.is_a(surface, lexicon.LEVEL) or not world.is_a(lowest, lexicon.BY_A_SEAT):
                    # "A mug on a desk next to a lamp and books": all the books.
                    told = {item for each in edges for item in (each.child, each.parent)} | world.supports.keys()
                    free = [item for item in lowest.group.items if item not in {*told, *world.grounded}]
                    world.place([lowest, *free], "on", [surface])
        if len(world.supports) == known:
            break


def _surface_below(world: World, item: Item, *, dishes: bool, trays: bool) -> Item | None:
    """The table, shelf, seat or tray that `item` stands on, directly or in a vessel; None where there is none.

    What has a rim counts as a surface where `dishes` or, if it is level, `trays` do.
    """
    for carrier in (item, *world.ancestors(item)):
        edge = world.supports.get(carrier)
        if edge is None:
            continue
        if edge.kind == "hangs_from":
            return None
        dish = world.is_a(edge.parent, lexicon.DISHES)
        tray = trays and world.is_a(edge.parent, lexicon.LEVEL)
        wide = dishes or tray if dish else world.is_a(edge.parent, lexicon.LEVEL, lexicon.SEATS)
        if edge.kind == "on" and wide and edge.parent.group.height == 1:
            return edge.parent
    return None


def _objects(world: World, nouns: Nouns) -> dict[Item, PlannedObject]:
    """The objects with unique names."""
    made: list[tuple[Item, str, PlannedObject]] = []
    for group in world.groups:
        words = group.modifiers
        extent = _extent(world, group, words)
        for index, item in enumerate(group.items):
            noun, said = group.noun, group.said
            if group.cycle:
                said = group.cycle[index % len(group.cycle)]
                noun = nouns.resolve(said) or said
            colours = item.colours if item.colours is not None else words.colours
            size = item.told.size_word or words.size_word
            # "A big balloon" is larger than a balloon, not than the ball that stands in.
            scale, usual = words.scale * item.told.scale, STAND_IN_SIZES.get(said)
            shown = [colour for colour in colours[:3] if colour not in said.split()]
            material = words.material_word
            material = "" if material in said.split() or material == size else material
            name = " ".join(filter(None, (size, " and ".join(shown), material, said)))
            soft = group.said.split()[0] in ("plush", "stuffed", "soft", "plushie")
            young = ("young",) if group.said.split()[-1] in lexicon.YOUNG else ()
            planned = PlannedObject(
                name=name, noun=noun, phrase=group.words, colours=colours,
                material=words.material or ("plush" if group.cycle and soft else None),
                scale=scale, extent=extent or (Extent(metres=usual * scale) if usual else None),
                adjectives=tuple(dict.fromkeys((*words.adjectives, *item.told.adjectives, *young))), proxy=group.proxy,
            )  # fmt: skip
            made.append((item, name, planned))
    total = Counter(name for _, name, _ in made)
    seen: Counter[str] = Counter()
    taken = set(total)
    named: dict[Item, PlannedObject] = {}
    for item, name, planned in made:
        if total[name] > 1 or name == GROUND:
            seen[name] += 1
            while f"{name} {seen[name]}" in taken:
                seen[name] += 1
            name = f"{name} {seen[name]}"
        named[item] = PlannedObject(**{**planned.__dict__, "name": name})
    return named


def _extent(world: World, group: Group, words: Modifiers) -> Extent | None:
    """The size that the prompt gives the objects of `group`; notes on what it gives and the scene does not have.

    Raises:
        PromptError: no object has that size.
    """
    said, extent = group.words, None
    for measure in words.measures:
        if measure.distance:
            world.note(f'"{measure.said}" is left out: distances between objects are not planned.')
        elif not measure.metres:
            world.note(f'"{measure.said}" is left out: of "{said}" only a size in metres or inches can be set.')
        elif extent is not None:
            world.note(f'"{measure.said}" is left out: "{said}" has a size already and keeps its proportions.')
        elif not all(SMALLEST <= metres <= LARGEST for metres in measure.metres):
            raise PromptError(f'"{measure.said}": an object may measure {SMALLEST * 1000:g} mm to {LARGEST:g} m.')
        else:
            extent = Extent(metres=max(measure.metres), axis=measure.axis)
            if len(set(measure.metres)) > 1:
                world.note(f'"{measure.said}": the longest side is {extent.metres:g} m, the others follow.')
    return extent


def _postures(world: World, names: dict[Item, str]) -> list[Posture]:
    """How the prompt wants the objects turned; notes on what the layout cannot do."""
    made: list[Posture] = []
    for item, name in names.items():
        group = item.group
        told = (*group.modifiers.postures, *item.told.postures)
        if not told and arranging.shelved(world, item):
            made.append(Posture(object=name, kind="on_its_side", said="upright", arranged=True))
        for said in dict.fromkeys(told):
            kind, held = kind_of(said), is_held(said, lies=world.is_a(item, lexicon.LYING))
            edge = world.supports.get(item)
            racked = edge is not None and edge.kind == "in" and world.is_a(edge.parent, ("dish rack",))
            if racked and stands_on_edge(said) and world.is_a(item, vessels.RACKED):
                # Between its pegs they stand in any case.
                continue
            if kind in ("upright", "on_its_side") and stands_on_edge(said) and world.is_a(item, lexicon.ON_EDGE):
                kind, held = "on_its_side", True
            made.append(Posture(object=name, kind=kind, said=said, arranged=held))
            if not held:
                note = f'not arranged: "{said}"; "{group.words}" is placed the way the catalogue makes it'
                world.note(note)
    return made


def _note_lift(world: World, edge: Edge, pair: tuple[Item, Item]) -> None:
    """Say that what carries an object stands beside the other in its place, but of a stack, which stands as one."""
    lifted = [(said, meant) for said, meant in ((edge.child, pair[0]), (edge.parent, pair[1])) if said is not meant]
    if edge.weak or all(said.group is meant.group or meant.group.height > 1 for said, meant in lifted):
        return
    told, (child, parent) = RELATION_WORDS[edge.kind], (f'"{item.group.words}"' for item in pair)
    world.note(f'"{edge.child.group.words}" {told} "{edge.parent.group.words}": {child} is {told} {parent}.')


def _supports(world: World, names: dict[Item, str]) -> list[Relation]:
    relations: list[Relation] = []
    for item, name in names.items():
        if (edge := world.supports.get(item)) is not None:
            relations.append(Relation(child=name, kind=edge.kind, parent=names[edge.parent]))
        elif (below := world.support(item)) is not None:
            relations.append(Relation(child=name, kind="on", parent=names[below]))
    return relations


def _laterals(world: World, names: dict[Item, str]) -> list[Relation]:
    relations: list[Relation] = []
    for edge in world.laterals:
        pair = world.siblings(edge.child, edge.parent)
        if pair is None:
            if not edge.weak:
                world.note(
                    f'"{edge.child.group.words}" {RELATION_WORDS[edge.kind]} "{edge.parent.group.words}" is left out: '
                    "one carries the other."
                )
            continue
        if not names.keys() >= {*pair}:
            # Of several of which fewer were counted later: "stack blocks: yellow on one next to ...".
            said = f'"{edge.child.group.words}" {RELATION_WORDS[edge.kind]} "{edge.parent.group.words}"'
            world.note(f"{said} is left out: of how many it is said is not clear.")
            continue
        _note_lift(world, edge, pair)
        relations.append(Relation(child=names[pair[0]], kind=edge.kind, parent=names[pair[1]]))
    for group in world.groups:
        first = world.supports.get(group.items[0])
        if group.heap and (first is None or first.kind != "in"):
            beside = zip(group.items, group.items[1:], strict=False)
            relations += [Relation(child=names[b], kind="next_to", parent=names[a]) for a, b in beside]
            world.note(f'"{group.words}": its objects lie side by side, since as a stack they would not stay.')
        if group.rows:
            lines = arranging.rows_of(world, group)
            for line in lines:
                pairs = zip(line, line[1:], strict=False)
                relations += [Relation(child=names[a], kind="left_of", parent=names[b]) for a, b in pairs]
            for front, back in zip(lines, lines[1:], strict=False):
                pairs = zip(back, front, strict=False)
                relations += [Relation(child=names[a], kind="behind", parent=names[b]) for a, b in pairs]
    return relations
