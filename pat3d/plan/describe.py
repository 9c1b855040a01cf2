"""A plan as text: the scene tree with the relation of every object to what carries it."""

from __future__ import annotations

from pat3d.plan.scene_plan import ScenePlan
from pat3d.scene.relations import GROUND


def describe(plan: ScenePlan) -> str:
    """The scene tree of `plan`, one object a line, its relations in a column at the right; notes below.

    Lateral relations and arrangements follow the support ("on; next_to red mug"); of several carriers, those beside the
    one that it stands under are named ("on; on block 2").
    """
    tree = plan.tree()
    words: dict[str, list[str]] = {obj.name: [] for obj in plan.objects}
    for relation in sorted(plan.relations, key=lambda relation: not relation.supports):
        plain = relation.supports and relation.parent == plan.parent(relation.child)
        words[relation.child].append(relation.kind if plain else f"{relation.kind} {relation.parent}")
    for each in plan.held():
        for name in each.objects:
            words[name].append(f"{each.kind} {', '.join(each.of)}".rstrip())
    for each in plan.turned():
        words[each.object].append(each.kind)
    proxies = {obj.name for obj in plan.objects if obj.proxy}
    rows: list[tuple[str, str]] = []
    waiting = [(GROUND, 0)]
    while waiting:
        name, depth = waiting.pop()
        label = f"{name} (box)" if name in proxies else name
        rows.append(("  " * depth + label, "; ".join(words.get(name, ()))))
        waiting += [(child, depth + 1) for child in reversed(tree.get(name, ()))]
    width = max(len(left) for left, _ in rows) + 4
    lines = [f"{left:<{width}}{right}".rstrip() for left, right in rows]
    if plan.set_aside:
        lines.append(f"set aside: {'; '.join(plan.set_aside)}")
    lines += [f"note: {note}" for note in plan.notes]
    return "\n".join(lines)
