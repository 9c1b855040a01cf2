"""What a suite is going to be, before anything is made: places, splits, compositions, sentences."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import pytest

from pat3d.assets import catalogue
from pat3d.envs.suites.composer import natural
from pat3d.envs.suites.composition import SILHOUETTE, draft, structure_splits
from pat3d.envs.suites.fixtures import DRAWERS, FIXTURES, fixtures
from pat3d.envs.suites.pools import CONTAINERS, GROUPS, ITEMS, partition
from pat3d.envs.suites.request import SPLITS, TASKS, TWO_ARMED, Request, check_split, in_split
from pat3d.envs.suites.structures import CORES, SIDES, SORTED
from pat3d.envs.suites.worker_pool import worker_count
from pat3d.envs.tasks.registry import TASKS as JUDGED
from pat3d.envs.tasks.registry import parse_task
from pat3d.errors import SuiteError
from pat3d.plan.doors import HINGED
from pat3d.plan.drawers import DRAWER_CABINET
from pat3d.plan.grammar.planner import GrammarPlanner

FIXTURE_OF = {HINGED[of]: of for of in FIXTURES if of in HINGED} | {DRAWER_CABINET: DRAWERS}
REQUEST = Request(tasks=TASKS, scenes=300)


def test_unknown_names_are_answered_with_the_valid_ones():
    with pytest.raises(SuiteError, match=r'no task "juggle".*pick, place, stack, sort, unload, retrieve, chain'):
        Request(tasks=("pick", "juggle"))
    with pytest.raises(SuiteError, match=r'no split "tset".*train, val, test'):
        check_split("tset")
    with pytest.raises(SuiteError, match=r'"auto" or a number from 1 to'):
        worker_count("many")


@pytest.mark.parametrize(
    "wrong",
    [
        {"tasks": ()},
        {"tasks": ("pick", "pick")},
        {"scenes": 0},
        {"seed": -1},
        {"objects": (9, 5)},
        {"objects": (2, 3)},
        {"objects": (5, 99)},
        {"picture": 3},
    ],
)
def test_requests_out_of_range_are_refused(wrong):
    with pytest.raises(SuiteError):
        replace(REQUEST, **wrong)


def test_a_request_survives_its_json_and_damage_is_told():
    assert Request.from_dict(REQUEST.as_dict(), "x") == REQUEST
    for damage in ({}, None, {**REQUEST.as_dict(), "scenes": "many"}, {**REQUEST.as_dict(), "objects": [1, 2, 3]}):
        with pytest.raises(SuiteError, match="here: the suite's request is damaged"):
            Request.from_dict(damage, "here")


def test_every_task_of_suites_has_a_judge_and_those_for_two_arms_ask_for_two():
    # What is lifted and put back is a step of chains.
    assert {*TASKS, *TWO_ARMED, "lift"} == set(JUDGED)
    with pytest.raises(SuiteError, match='"carry" takes two arms, and panda is one'):
        Request(tasks=("carry",), robot="panda")
    assert Request(tasks=("carry",), robot="panda+panda").tasks == ("carry",)


def test_eighty_percent_train_and_a_twentieth_for_every_way_of_holding_out():
    request = Request(scenes=1000)
    counts = Counter((request.split_of(place), request.task_of(place)) for place in range(1000))
    for task in request.tasks:
        assert counts["train", task] == 160
        for split in SPLITS[3:]:
            assert counts[split, task] == 10


def test_val_is_both_ways_of_holding_out_for_validation():
    assert [split for split in SPLITS if in_split(split, "val")] == ["val", "val/layout", "val/object"]
    assert all(in_split(split, None) for split in SPLITS)
    assert not in_split("train", "val")


def test_a_longer_suite_begins_with_the_shorter_one():
    longer = replace(REQUEST, scenes=10_000)
    for place in range(12):
        assert draft(REQUEST, place, 0) == draft(longer, place, 0)


def test_another_seed_or_candidate_is_another_composition():
    own = [draft(REQUEST, place, 0).plan.prompt for place in range(12)]
    assert own != [draft(REQUEST, place, 1).plan.prompt for place in range(12)]
    assert own != [draft(replace(REQUEST, seed=1), place, 0).plan.prompt for place in range(12)]


@pytest.mark.parametrize("seed", range(5))
def test_nouns_are_held_out_without_overlap_and_from_every_group(seed):
    parts = partition(seed)
    assert sorted(sum(parts.values(), ())) == sorted(item.noun for item in ITEMS)
    groups = {item.noun: item.group for item in ITEMS}
    assert all({groups[noun] for noun in nouns} == set(GROUPS) for nouns in parts.values())


@pytest.mark.parametrize("seed", range(5))
def test_what_means_the_same_is_held_out_together(seed):
    """Where a soda can is held out, a soup can is too: every kind of noun is in one part alone."""
    parts = partition(seed)
    places = {item.noun: part for item in ITEMS for part, nouns in parts.items() if item.noun in nouns}
    for meaning in {item.meaning for item in ITEMS}:
        assert len({places[item.noun] for item in ITEMS if item.meaning == meaning}) == 1
    assert places["can"] == places["soda can"] == places["tomato soup can"]


def test_what_is_moved_is_not_of_the_colour_of_what_it_comes_from_or_goes_to():
    for place in range(0, 300, 2):
        made = draft(REQUEST, place, 0)
        colours = {obj.name: set(obj.colours) or natural(obj.noun) for obj in made.plan.objects}
        if made.task == "sort" or made.task.startswith(("open", "close")):
            continue
        for name in made.moved:
            carriers = {rel.parent for rel in made.plan.relations if rel.child == name}
            assert not any(colours[name] & colours[where] for where in carriers), made.plan.prompt
    assert made


def test_suites_use_a_hundred_nouns_and_no_kind_of_them_is_a_third():
    counts = Counter(item.meaning for item in ITEMS)
    assert len(ITEMS) >= 95
    assert counts.most_common(1)[0][1] < len(ITEMS) / 8


@pytest.mark.parametrize("objects", [(4, 6), (6, 6), (5, 8), (10, 12)])
def test_structures_are_held_out_without_overlap_at_every_size(objects):
    request = Request(tasks=TASKS, objects=objects)
    for task in TASKS:
        parts = structure_splits(request, task)
        names = [{(core.name, side.name) for core, side in found} for found in parts.values()]
        assert all(names)
        assert sum(map(len, names)) == len(set().union(*names))


def test_compositions_keep_their_split_s_promise():
    """Object splits move held-out nouns only, the others training nouns only; layouts have their split's structures."""
    nouns = partition(REQUEST.seed)
    for place in range(0, 300):
        made, split = draft(REQUEST, place, 0), REQUEST.split_of(place)
        part, _, way = split.partition("/")
        by_name = {obj.name: obj.noun for obj in made.plan.objects}
        shown = part if way == "object" else "train"
        if made.task.startswith(("open:", "close:")):
            (noun,) = (by_name[name] for name in made.places)
            assert FIXTURE_OF[noun] in fixtures(REQUEST.seed)[shown]
        else:
            assert {by_name[name] for name in made.moved} <= set(nouns[shown])
        structures = structure_splits(REQUEST, REQUEST.task_of(place))["train" if way == "object" else part]
        assert made.structure in {f"{core.name} + {side.name}" for core, side in structures}
        assert REQUEST.objects[0] <= len(made.plan.objects) <= REQUEST.objects[1]


def test_the_grammar_reads_every_sentence_as_the_composition_it_describes():
    for place in range(90):
        plan = draft(REQUEST, place, 0).plan
        read = GrammarPlanner(False).plan(plan.prompt)
        assert _content(read) == _content(plan), plan.prompt


def test_tasks_name_objects_of_their_scene():
    for place in range(60):
        made = draft(REQUEST, place, 0)
        kind, *moved = made.task.split(":")
        names = {obj.name for obj in made.plan.objects}
        assert kind == REQUEST.task_of(place)
        # Where things are rearranged to, or pushed, or beside what, is drawn with the scene.
        drawn = {"rearrange": moved, "push": moved[:1], "beside": moved}
        assert set(drawn[kind] if kind in drawn else parse_task(made.task).names) <= names
        assert set(made.moved) <= names


def test_in_sorting_scenes_only_what_is_to_be_sorted_has_the_colour_of_a_container():
    containers = {one.noun for one in CONTAINERS}
    request = Request(tasks=("sort",))
    for place in range(60):
        made = draft(request, place, 0)
        colours = {obj.colours for obj in made.plan.objects if obj.noun in containers and obj.colours}
        # Fruit bowls and boards come in white and woods.
        colours.add(("white",))
        matching = {obj.name for obj in made.plan.objects if obj.noun not in containers and obj.colours in colours}
        assert matching == set(made.moved)


def test_everything_that_suites_use_is_in_the_catalogue():
    assert all(catalogue.find(one.noun) is not None for one in (*ITEMS, *CONTAINERS))


def _content(plan):
    objects = sorted((obj.noun, obj.colours, str(obj.material)) for obj in plan.objects)
    return objects, sorted((rel.child, rel.kind, rel.parent) for rel in plan.relations)


def test_the_least_tilt_is_part_of_a_request_and_unsaid_where_it_is_the_usual_one():
    """So that suites of before, whose requests say nothing of it, are still of the same request."""
    usual, asked = Request(), Request(least_tilt=2.0)
    assert "least_tilt" not in usual.as_dict()
    assert Request.from_dict(usual.as_dict(), "here") == usual
    assert Request.from_dict(asked.as_dict(), "here") == asked != usual
    with pytest.raises(SuiteError, match="0 to 8 degrees"):
        Request(least_tilt=9.0)


HARD = Request(tasks=TASKS, scenes=300, clutter=(2, 4, 8), alike=2, visible=0.5, vary=0.05)


def test_conditions_of_a_request_are_named_only_where_they_are_asked_for_and_survive_json():
    assert Request.from_dict(HARD.as_dict(), "x") == HARD
    assert not {"clutter", "alike", "vary"} & REQUEST.as_dict().keys()


@pytest.mark.parametrize(
    "wrong",
    [{"clutter": (3, 3)}, {"clutter": (11,)}, {"alike": 3}, {"visible": 6.0}, {"vary": 0.2}, {"vary": -0.01}],
)
def test_conditions_out_of_range_are_refused(wrong):
    with pytest.raises(SuiteError):
        replace(HARD, **wrong)


def test_scenes_have_the_clutter_of_their_level_and_all_levels_come():
    """More only where a held-out structure brings more; what the task needs is not counted."""
    seen = Counter()
    for place in range(120):
        made = draft(HARD, place, 0)
        task = HARD.task_of(place)
        core = next(core for core in CORES[task] if made.structure.startswith(f"{core.name} + "))
        side = next(side for side in SIDES if made.structure.endswith(f" + {side.name}"))
        level = HARD.clutter_of(place)
        assert level is not None
        beside = len(made.plan.objects) - core.size
        assert beside == max(level, side.size + HARD.alike)
        assert beside == level or HARD.split_of(place).endswith("/layout")
        seen[level] += 1
    assert set(seen) == {2, 4, 8}
    assert min(seen.values()) > 20


def test_what_is_too_small_to_be_seen_is_not_tried_and_what_is_sorted_is_larger():
    """Half a percent leaves every noun to move; a sort, with two homes in the picture, and more take larger ones."""

    def moved(visible):
        request = Request(tasks=("pick", "sort"), scenes=400, visible=visible)
        found: dict[str, list[str]] = {"pick": [], "sort": []}
        for place in range(200):
            if request.split_of(place) == "train":
                made = draft(request, place, 0)
                found[request.task_of(place)] += [obj.noun for obj in made.plan.objects if obj.name in made.moved]
        return {kind: set(nouns) for kind, nouns in found.items()}

    sizes = {item.noun: item.width * item.height for item in ITEMS}
    usual, anything, more = moved(0.5), moved(0.0), moved(2.0)
    assert usual["pick"] == anything["pick"]
    assert min(sizes[noun] for noun in usual["pick"]) < min(sizes[noun] for noun in usual["sort"])
    assert min(sizes[noun] for noun in usual["sort"]) >= 0.5 * SILHOUETTE * SORTED
    assert min(sizes[noun] for noun in anything["sort"]) < 0.5 * SILHOUETTE * SORTED
    assert min(sizes[noun] for noun in more["pick"]) >= 2.0 * SILHOUETTE


def test_distractors_are_like_what_is_moved_and_words_still_tell_them_apart():
    """Of its noun in another colour or size, or of its kind; the sentence reads back with sizes and colours."""
    sized = 0
    for place in range(0, 210, 5):
        if HARD.task_of(place) in ("open", "close"):
            # A second microwave has no room.
            continue
        made = draft(HARD, place, 0)
        known = {obj.name: obj for obj in made.plan.objects}
        first = known[made.moved[0]]
        others = [obj for obj in made.plan.objects if obj.name != first.name and obj.name not in made.moved]
        twins = [obj for obj in others if obj.noun == first.noun]
        if first.colours:
            assert any(twin.colours != first.colours or twin.scale != first.scale for twin in twins)
        else:
            meanings = {item.noun: item.meaning for item in ITEMS}
            assert any(meanings.get(obj.noun) == meanings[first.noun] for obj in others)
        assert not any(other.name.endswith(f" {first.name}") for other in others)
        sized += first.scale != 1.0
        if HARD.task_of(place) == "sort":
            homes = {known[name].colours for name in made.places}
            assert sum(obj.colours in homes for obj in made.plan.objects) == len(made.moved) + len(made.places)
        read = GrammarPlanner().plan(made.plan.prompt)
        assert {(o.noun, o.colours, o.scale) for o in read.objects} == {
            (o.noun, o.colours, o.scale) for o in made.plan.objects
        }
    assert sized > 5
