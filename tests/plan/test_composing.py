"""What nothing has a noun for is composed in the shape language, through the real client, and kept."""

import json

import pytest

from pat3d.assets import sources
from pat3d.assets.generated.orders import Orders, kept_order
from pat3d.assets.nouns.source import OwnNouns
from pat3d.errors import ModelError
from pat3d.plan.llm.chat import Chat
from pat3d.plan.llm.planner import LLMPlanner
from pat3d.plan.llm.settings import ModelSettings
from tests.plan.llm_server import said, serving

BOARD = """noun: raspberry pi board
material: electronics
colours: [green]
parts:
  - {colour: 0, shape: {box: [0.085, 0.056, 0.0014]}}
  - colour: [190, 193, 198]
    shape: {box: [0.021, 0.016, 0.014], then: [{move: [0.034, 0.01, 0.001]}]}
"""
FLOATING = BOARD.replace("box: [0.085, 0.056, 0.0014]", "box: [85, 56, 1.4]")
CODE = BOARD.replace("0.085", "__import__('os').system('touch /tmp/x')")


def plan(*objects, missing=()):
    empty = {"relations": [], "set_aside": [], "notes": [], "arrangements": [], "postures": [], "task": None}
    return {"plan": {"objects": list(objects), **empty}, "missing": list(missing)}


def board(noun):
    return {
        "name": "board", "noun": noun, "phrase": "a Raspberry Pi board", "colours": [], "material": None, "scale": 1.0,
        "extent": None, "adjectives": [],
    }  # fmt: skip


@pytest.fixture
def planner(tmp_path, monkeypatch):
    monkeypatch.setenv("PAT3D_DATA", str(tmp_path / "data"))
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")

    def made(server) -> LLMPlanner:
        chat = Chat(ModelSettings(name="test", base_url=server.url, key="k"), cache_dir=tmp_path / "answers")
        return LLMPlanner(chat, composes=True)

    return made


FIRST, LAST = plan(missing=["Raspberry Pi board"]), plan(board("composed/raspberry_pi_board"))


def test_an_unknown_noun_is_composed_kept_and_planned_with(planner):
    with serving(said(FIRST), said({"program": BOARD}), said(LAST)) as server:
        one = planner(server)
        made = one.plan("a Raspberry Pi board")
        assert [obj.noun for obj in made.objects] == ["composed/raspberry_pi_board"]
        assert any("composed" in note for note in made.notes)
        assert one.record()["composed"] == {"Raspberry Pi board": "composed/raspberry_pi_board"}
        assert one.record()["requests"] == 3
        assert "composed/raspberry_pi_board" in json.dumps(server.requests[2])
        assert "Raspberry Pi board" in server.requests[1]["messages"][1]["content"]
    asset = sources.make("composed/raspberry_pi_board")
    assert asset.size.tolist() == pytest.approx([0.087, 0.056, 0.015], abs=1e-3)
    assert asset.provenance["source"] == "composed"
    with serving(said(LAST)) as server:
        # The next time it is a noun like any other.
        planner(server).plan("a Raspberry Pi board, please")
        assert "composed/raspberry_pi_board" in json.dumps(server.requests[0])


@pytest.mark.parametrize(
    ("bad", "words"),
    [(FLOATING, "20 m"), (CODE, "program, line 5"), (BOARD.replace("box", "cube"), "cube"), ("- [", "YAML"),
     ("", "1 to")],
)  # fmt: skip
def test_what_is_wrong_goes_back_with_the_reason(planner, bad, words):
    with serving(said(FIRST), said({"program": bad}), said({"program": BOARD}), said(LAST)) as server:
        planner(server).plan("a Raspberry Pi board")
        told = server.requests[2]["messages"][-1]["content"]
        assert words in told
        assert "Answer again" in told


def test_it_goes_back_twice_and_then_nothing_is_kept(planner):
    replies = [said({"program": FLOATING})] * 3
    with serving(said(FIRST), *replies) as server:
        with pytest.raises(ModelError, match="3 attempts"):
            planner(server).plan("a Raspberry Pi board")
        assert len(server.requests) == 4
    assert OwnNouns("composed").nouns() == []


def test_with_a_mesh_server_an_unknown_noun_is_ordered_and_not_composed(tmp_path, monkeypatch):
    monkeypatch.setenv("PAT3D_DATA", str(tmp_path / "data"))
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    orders = Orders("http://127.0.0.1:1")
    noun = orders.order("Raspberry Pi board").noun
    with serving(said(FIRST), said(plan(board(noun)))) as server:
        chat = Chat(ModelSettings(name="test", base_url=server.url, key="k"), cache_dir=tmp_path / "answers")
        one = LLMPlanner(chat, composes=True, orders=Orders("http://127.0.0.1:1"))
        made = one.plan("a Raspberry Pi board")
        assert len(server.requests) == 2
    assert [obj.noun for obj in made.objects] == [noun]
    assert any("mesh server 127.0.0.1:1" in note for note in made.notes)
    assert one.record()["ordered"] == {"Raspberry Pi board": noun}
    assert kept_order(noun).words == "raspberry pi board"
