"""A plan in plain words, composed from the plan alone, so that a person sees a misreading before anything is made."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import groupby

from pat3d.plan.doors import DOORS
from pat3d.plan.english import counted, is_plural, joined, plural, some
from pat3d.plan.holders import FLAT, HOUSING, holds
from pat3d.plan.naming import Names
from pat3d.plan.scene_plan import Arrangement, ScenePlan
from pat3d.scene.arrangements import ARRANGEMENTS, TIERS, crossing
from pat3d.scene.relations import GROUND, OPPOSITE, RELATION_WORDS, Relation
from pat3d.scene.task_spec import steps_of

_DEEDS = {"place": "put {0} {where} {1}", "stack": "stack {0} on {1}", "pick": "pick up {0}",
          "unload": "take everything out of {0}", "sort": "sort what is there", "open": "open {0}",
          "close": "close {0}"}  # fmt: skip
"""What a task asks for, of the objects that it names."""
_WAYS = {"height": "high", "width": "wide", "depth": "deep", "length": "long", "thickness": "thick"}


def tell(plan: ScenePlan) -> str:
    """What `plan` says, in English sentences."""
    return _Teller(plan).told()


class _Teller(Names):
    def __init__(self, plan: ScenePlan) -> None:
        super().__init__(plan)
        self._named: set[str] = set()
        self._pyramids = self._all_pyramids()
        """Everything in each pyramid, its lowest row first, by the objects of that row."""

    def told(self) -> str:
        sentences = [*self._supports(), *self._doors(), *self._rows(), *self._arranged(), *self._laterals()]
        sentences += [*self._postures(), *self._tiers(), *self._sizes(), *self._task()]
        return " ".join(f"{sentence[0].upper()}{sentence[1:]}." for sentence in sentences)

    def _tiers(self) -> list[str]:
        """How many shelves furniture is made with, where the prompt says it."""
        made: dict[tuple[str, str], list[str]] = {}
        for obj in self._plan.objects:
            parts = "boards" if self._base[obj.name].split()[-1] == "shelf" else "shelves"
            for word in (one for one in obj.adjectives if one[0].isdecimal() and one.endswith("-tier")):
                made.setdefault((counted(int(word.removesuffix("-tier"))), parts), []).append(obj.name)
        return [f"{self._all(of)} {'have' if of[1:] else 'has'} {' '.join(told)}{' each' * (len(of) > 1)}"
                for told, of in made.items()]  # fmt: skip

    def _sizes(self) -> list[str]:
        """How large things are that the prompt measures."""
        made: dict[str, list[str]] = {}
        for obj in self._plan.objects:
            if obj.extent is not None:
                way = _WAYS.get(obj.extent.axis or "", "on the longest side")
                made.setdefault(f"{obj.extent.metres:.3g} m {way}", []).append(obj.name)
        return [f"{self._all(names)} {self._is(names)} {size}" for size, names in made.items()]

    def _task(self) -> list[str]:
        """What is to be done, in words and as it is written down."""
        if self._plan.task is None:
            return []
        deeds = [self._deed(*step) for step in steps_of(self._plan.task)]
        if not all(deeds):
            return [f"The task is {self._plan.task}"]
        return [f"The task is to {', then to '.join(deeds)} ({self._plan.task})"]

    def _deed(self, kind: str, *names: str) -> str:
        """What a step of the task asks for: "put the pear on the tray"; empty where it is no such step."""
        if kind == "beside":
            moved, relation, landmark = names
            return f"put {self._the(moved)} {RELATION_WORDS[relation]} {self._the(landmark)}"
        known = names and all(name in self._base for name in names)
        if kind not in _DEEDS or not (known or kind == "sort"):
            return ""
        where = self._where(names[1]) if len(names) == 2 else ""
        return _DEEDS[kind].format(*map(self._the, names[:1]), *map(self._upon, names[1:]), where=where)

    def _where(self, name: str) -> str:
        """Whether what is put to object `name` is put "in" or "on" it: as the prompt has it where both are right."""
        noun = next(obj.noun for obj in self._plan.objects if obj.name == name)
        if noun not in FLAT:
            return "in" if holds(noun) or noun in HOUSING else "on"
        head = re.escape(self._base[name].split()[-1])
        said = re.findall(rf"\b(in|into|inside|on|onto|to)(?: \w+){{0,4}}? {head}\b", self._plan.prompt, re.IGNORECASE)
        return "in" if said and said[-1].lower().startswith("in") else "on"

    def _all_pyramids(self) -> dict[tuple[str, ...], list[str]]:
        above = {self._carriers(obj.name): obj.name for obj in self._plan.objects if len(self._carriers(obj.name)) > 1}
        found: dict[tuple[str, ...], list[str]] = {}
        for each in self._plan.arrangements:
            row = list(each.objects) if each.kind == "side_by_side" and len(each.objects) > 1 else []
            whole = list(row)
            while len(row) > 1:
                row = [above[pair] for pair in zip(row, row[1:], strict=False) if pair in above]
                whole += row
            rows = len(each.objects)
            if len(whole) == rows * (rows + 1) // 2 and whole and {*whole} == {*self._like[whole[0]]}:
                found[each.objects] = whole
        return found

    # Supports

    def _supports(self) -> list[str]:
        """What stands on the ground, then what stands on each of that, stacks as one."""
        made: list[str] = []
        told = {obj.name for obj in self._plan.objects if obj.noun in DOORS}
        waiting = [GROUND]
        while waiting:
            parent = waiting.pop(0)
            children = self._children(parent)
            waiting += [name for name in children if name not in waiting]
            for kind in ("on", "in", "hangs_from"):
                own = [name for name in children if self._kind(name) == kind and name not in told]
                own = [name for name in own if not self._continues_stack(name)]
                heaped = {name for whole in self._pyramids.values() for name in whole}
                across = [name for name in own if len(self._carriers(name)) > 1]
                told |= heaped & {*across}
                own = [name for name in own if name not in told]
                across = [name for name in across if name not in told]
                for name in across:
                    own.remove(name)
                    told.add(name)
                    made.append(f"{self._listed([name])} {self._is([name])} across {self._all(self._carriers(name))}")
                if not own:
                    continue
                told |= set(own)
                verb = (
                    "is" if len(own) == 1 and (self._stack(own[0])[1:] or not is_plural(self._base[own[0]])) else "are"
                )
                if parent == GROUND:
                    stand = "stands" if verb == "is" else "stand"
                    made.append(f"{self._listed(own)} {stand} on the ground")
                elif (spread := self._spread(parent, kind)) is not None:
                    names, sentence = spread
                    made.append(sentence)
                    told |= set(names)
                else:
                    others, place = self._same_parents(parent, own, kind)
                    is_or_are = "are" if len(others) > 1 else verb
                    made.append(f"{self._listed(others)} {is_or_are} {self._how(parent, kind)} {place}")
                    told |= set(others)
        return made

    def _doors(self) -> list[str]:
        """How the doors are that turn."""
        made: list[str] = []
        for state in (False, True):
            doors = [obj.name for obj in self._plan.objects if DOORS.get(obj.noun) is state]
            if doors:
                made.append(f"{self._all(doors)} {self._is(doors)} {'open' if state else 'shut'}")
        return made

    def _how(self, parent: str, kind: str) -> str:
        """In which words things are `kind` to `parent`: what stands on the floor of a cage is in it."""
        housed = kind == "on" and any(obj.name == parent and obj.noun in HOUSING for obj in self._plan.objects)
        return RELATION_WORDS["in" if housed else kind]

    def _kind(self, name: str) -> str:
        return self._below[name].kind if name in self._below else "on"

    def _children(self, parent: str) -> list[str]:
        return [obj.name for obj in self._plan.objects if self._plan.parent(obj.name) == parent]

    def _same_parents(self, parent: str, own: list[str], how: str) -> tuple[list[str], str]:
        """`own` and its like on the like of `parent`, where every one of these has its own."""
        kind = self._like[parent]
        if len(kind) > 1 and len(own) == 1 and not any(self._continues_stack(name) for name in kind):
            pairs = [(other, self._children(other)) for other in kind]
            likes = [[name for name in names if self._base[name] == self._base[own[0]]] for _, names in pairs]
            if all(len(each) == 1 for each in likes) and all(len(names) == 1 for _, names in pairs):
                place = f"the {counted(len(kind))} {plural(self._base[parent])}"
                return [each[0] for each in likes], f"{place}, one {self._how(parent, how)} each"
        return own, self._upon(parent)

    def _spread(self, parent: str, kind: str) -> tuple[list[str], str] | None:
        """What is spread over all that are like `parent`, and how that is said; None where nothing is."""
        like = self._like[parent]
        shares = [[name for name in self._children(each) if self._kind(name) == kind] for each in like]
        names = [name for share in shares for name in share]
        split = any(
            len({at for at, share in enumerate(shares) if {*share} & {*self._like[name]}}) > 1 for name in names
        )
        alone = {*names} == {*self._like[names[0]]} and len(names) == len(like)
        if len(like) < 2 or not split or alone or any(self._stack(name)[1:] for name in (*names, *like)):
            return None
        sizes = list(dict.fromkeys(map(len, shares)))
        one_kind = len({self._like[name][0] for name in names}) == 1
        parents = f"the {counted(len(like))} {plural(self._base[parent])}"
        verb = self._how(parent, kind)
        if one_kind and len(sizes) == 1:
            return names, f"{self._listed(names)} are {verb} {parents}, {counted(sizes[0])} {verb} each"
        how = f": {joined([counted(len(share)) if share else 'none' for share in shares])}" if one_kind else ""
        return names, f"{self._listed(names)} are spread over {parents}{how}"

    def _continues_stack(self, name: str) -> bool:
        below = self._below.get(name)
        if len(self._carriers(name)) > 1:
            return False
        return below is not None and below.kind == "on" and self._base[below.parent] == self._base[name] and (
            name in self._stack(below.parent)
        )  # fmt: skip

    # Beside each other

    def _rows(self) -> list[str]:
        rows = [each for each in self._plan.arrangements if each.kind == "row" and each.arranged]
        grids = crossing([each.objects for each in rows])
        made = [self._grid(cells) for cells in grids]
        alone = [each for each in rows if len(each.objects) > 1 and not any(set(each.objects) <= set(g) for g in grids)]
        return made + [self._row(each) for each in alone]

    def _row(self, row: Arrangement) -> str:
        if order := self._in_order(row.objects):
            return f"in a row {self._direction(row)} are {order}"
        return f"{self._all(row.objects)} are in a row {self._direction(row)}"

    def _in_order(self, names: Sequence[str]) -> str:
        """`names` one after the other, where to list them by kind would say another order; else nothing."""
        runs = [first for first, _ in groupby(names, key=lambda name: self._like[name][0])]
        return self._along(names, names) if len(runs) > len({*runs}) else ""

    def _along(self, row: Sequence[str], among: Sequence[str]) -> str:
        """What `row`, a part of `among`, is made of from its first to its last."""
        parts: list[str] = []
        for _, run in groupby(row, key=lambda name: self._like[name][0]):
            own = list(run)
            whole = self._like[own[0]]
            alone = len(whole) > 1 and whole == [name for name in among if name in whole]
            parts.append(some(self._base[own[0]], len(own)) if alone else self._all(own))
        return joined(parts)

    def _grid(self, cells: Mapping[str, tuple[int, int]]) -> str:
        """Several rows with aligned columns."""
        among = sorted(cells, key=lambda name: cells[name][::-1])
        rows = [list(row) for _, row in groupby(among, key=lambda name: cells[name][1])]
        lengths = [len(row) for row in rows]
        each = f"of {counted(lengths[0])}" if len(set(lengths)) == 1 else f"of {joined([counted(n) for n in lengths])}"
        told = f"{self._all(list(cells))} are in {counted(len(lengths))} rows {each}, one behind the other"
        if not self._in_order(among):
            return told
        along = "; ".join(self._along(row, among) for row in rows)
        return f"{told}; from left to right these are, front row first: {along}"

    def _direction(self, row: Arrangement) -> str:
        """Where a row runs: as a relation of its first two has it, else to the right."""
        first, second = row.objects[:2]
        ways = {"in_front_of": ("front", "back"), "behind": ("back", "front"), "right_of": ("right", "left")}
        relations = {(rel.child, rel.parent): rel.kind for rel in self._plan.relations if not rel.supports}
        kinds = [relations.get((first, second), ""), OPPOSITE.get(relations.get((second, first), ""), "")]
        start, end = next((ways[kind] for kind in kinds if kind in ways), ("left", "right"))
        return f"from {start} to {end}"

    def _arranged(self) -> list[str]:
        """Every other arrangement that the scene is to hold."""
        made: list[str] = []
        for each in self._plan.arrangements:
            rule = ARRANGEMENTS.get(each.kind)
            if each.kind == "row" or not each.arranged or rule is None:
                continue
            if each.kind == "across" and len(each.of) > 1:
                continue
            if each.objects in self._pyramids:
                lowest = counted(len(each.objects))
                made.append(f"{self._all(self._pyramids[each.objects])} are in a pyramid, {lowest} at the bottom")
                continue
            shelf = each.kind in TIERS and any(name.rstrip(" 0123456789").split()[-1] == "shelf" for name in each.of)
            # "The top shelf of the shelf" has a board in it.
            said = rule.words.replace("shelf", "board") if shelf else rule.words
            words = f"{said} {self._all(each.of)}" if each.of else rule.alone
            names = [name for name in each.objects if not self._carries(each.kind, name, each.of)]
            if words and names:
                made.append(f"{self._all(names)} {self._is(names)} {words}")
        return made

    def _carries(self, kind: str, name: str, of: Sequence[str]) -> bool:
        """Whether a support says that `name` is there: a mat under a vase."""
        carried = {rel.child for rel in self._plan.relations if rel.supports and rel.parent == name}
        return kind == "under" and bool(carried & {*of})

    def _postures(self) -> list[str]:
        held = {one.object: one.kind for one in self._plan.turned()}
        kinds = {"upside_down": "upside down", "on_its_side": "on its side"}
        told = {name: kinds[kind] for name, kind in held.items() if kind in kinds}
        # What lies by nature and is said to stand does so on its edge.
        on_end = {one.object for one in self._plan.postures if re.search(r"upright|end|edge", one.said)}
        told |= {name: "on its edge" for name in told if name in on_end and held[name] == "on_its_side"}
        by_how: dict[str, list[str]] = {}
        for name, how in told.items():
            by_how.setdefault(how, []).append(name)
        return [
            f"{self._all(names)} {self._is(names)} {how if len(names) == 1 else how.replace('its', 'their')}"
            for how, names in by_how.items()
        ]

    def _laterals(self) -> list[str]:
        """Lateral relations, those of equal children to one parent in one sentence."""
        grouped: dict[tuple[str, str], list[str]] = {}
        for rel in self._plan.relations:
            if not rel.supports and not self._said(rel):
                grouped.setdefault((rel.kind, rel.parent), []).append(rel.child)
        made = self._pairs(grouped)
        parents: dict[tuple[str, tuple[str, ...]], list[str]] = {}
        for (kind, parent), children in grouped.items():
            parents.setdefault((kind, tuple(children)), []).append(parent)
        for (kind, children), of in parents.items():
            made.append(f"{self._all(children)} {self._is(children)} {RELATION_WORDS[kind]} {self._all(of)}")
        return made

    def _pairs(self, grouped: dict[tuple[str, str], list[str]]) -> list[str]:
        """Relations of likes to likes, which leave `grouped`: "each of the four forks is next to one of the knives"."""
        made: list[str] = []
        kinds: dict[tuple[str, str, str], list[tuple[str, str]]] = {}
        for (kind, parent), children in grouped.items():
            for child in children:
                kinds.setdefault((kind, self._like[child][0], self._like[parent][0]), []).append((child, parent))
        for (kind, first, other), pairs in kinds.items():
            children, whole = [child for child, _ in pairs], self._like[first]
            if first == other:
                told = kind == "next_to" and len(pairs) == len(whole) - 1 > 1
                said = f"the {counted(len(whole))} {plural(self._base[first])} are next to each other"
            else:
                parents = {parent for _, parent in pairs}
                told = (
                    len({*children}) == len(children) == len(whole) > 1 and len(parents) == len(self._like[other]) > 1
                )
                one = f"one of the {counted(len(self._like[other]))} {plural(self._base[other])}"
                said = f"each of the {counted(len(whole))} {plural(self._base[first])} is {RELATION_WORDS[kind]} {one}"
            if told:
                made.append(said)
                for child, parent in pairs:
                    grouped[kind, parent].remove(child)
        for key in [key for key, children in grouped.items() if not children]:
            del grouped[key]
        return made

    def _said(self, rel: Relation) -> bool:
        """Whether a row or "between" says it."""
        for each in self._plan.arrangements:
            if each.arranged and each.kind in ("row", "side_by_side") and {rel.child, rel.parent} <= set(each.objects):
                return True
            beside = each.kind in ("circle", "leaning_against") and rel.kind in ("around", "next_to")
            if each.arranged and beside and rel.child in each.objects and rel.parent in each.of:
                return True
            if each.arranged and each.kind == "between" and rel.parent in each.objects and rel.child in each.of:
                return True
        return False

    def _listed(self, names: Sequence[str]) -> str:
        """Read "a mug and two plates", by kind, towers as one."""
        by_kind: dict[str, list[str]] = {}
        towers: Counter[str] = Counter()
        for name in names:
            tower = self._stack(name)
            if len(tower) > 1:
                towers[f"stack of {counted(len(tower))} {plural(self._base[name])}"] += 1
                self._named |= set(tower)
            else:
                by_kind.setdefault(self._like[name][0], []).append(name)
        parts = [some(tower, count) for tower, count in towers.items()]
        told: set[str] = set()
        for own in by_kind.values():
            base, whole = self._base[own[0]], self._like[own[0]]
            if tuple(own) in self._pyramids:
                # What is on them is told of with them.
                own = self._pyramids[tuple(own)]
            fresh = not set(whole) & self._named
            if len(own) == len(whole) or (fresh and len(own) > 1):
                further = f"another {base}" if len(own) == 1 else f"{counted(len(own))} other {plural(base)}"
                parts.append(further if base in told else some(base, len(own)))
            elif len(own) == 1:
                parts.append(self._the(own[0]))
            else:
                parts.append(f"{counted(len(own))} of the {counted(len(whole))} {plural(base)}")
            self._named |= set(own)
            told.add(base)
        return joined(parts)
