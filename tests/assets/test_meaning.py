"""Objects of a library by meaning: the real client against a server on the loopback that makes vectors of texts."""

import json

import numpy as np
import pytest

from pat3d.assets.library.index import add_library
from pat3d.assets.library.meaning import EmbeddingSettings, embedding_settings, search
from pat3d.cli.documents import FoundFacts
from pat3d.cli.main import main
from pat3d.errors import ModelError
from tests.assets.things_to_index import MJCF, URDF
from tests.documents import document_of
from tests.loopback import Reply
from tests.plan.llm_server import fault, serving

pytest.importorskip("openai")

MEANINGS = {"sponge": [1.0, 0.1, 0.0], "dumbbell": [0.0, 1.0, 0.2]}


def vectors_of(*texts: list[float]) -> Reply:
    data = [{"object": "embedding", "index": at, "embedding": one} for at, one in enumerate(texts)]
    # Servers need not answer in order.
    body = {"object": "list", "data": data[::-1], "model": "test", "usage": {"prompt_tokens": 1, "total_tokens": 1}}
    return Reply(body=json.dumps(body).encode())


@pytest.fixture
def lab(tmp_path, monkeypatch):
    """A library of a sponge and a dumbbell; the names of the objects in the order of their vectors."""
    monkeypatch.setenv("PAT3D_DATA", str(tmp_path / "data"))
    for name in ("PAT3D_EMBEDDINGS", "PAT3D_EMBEDDINGS_URL", "PAT3D_EMBEDDINGS_KEY", "OPENAI_API_KEY"):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "sponge.urdf").write_text(URDF)
    (tmp_path / "in" / "dumbbell.xml").write_text(MJCF)
    library = add_library(tmp_path / "in", "lab", workers=1)
    return [entry.key for entry in library.ready]


def test_without_a_server_names_decide(lab):
    assert embedding_settings() is None
    assert [one.noun for one in search("sponge", ["lab"])] == ["lab/sponge"]
    assert search("something to lift", ["lab"]) == []


def test_what_is_near_in_meaning_comes_after_what_is_called_so(lab):
    replies = [vectors_of([0.1, 0.9, 0.0]), vectors_of(*(MEANINGS[key] for key in lab)), vectors_of([0.0, 1.0, 0.2])]
    with serving(*replies) as server:
        settings = EmbeddingSettings(model="test", base_url=server.url, key="sesame")
        found = search("something to lift", ["lab"], settings=settings)
        assert [one.noun for one in found] == ["lab/dumbbell", "lab/sponge"]
        cosine = 0.9 / (np.hypot(0.1, 0.9) * np.hypot(1.0, 0.2))
        assert found[0].score == pytest.approx(cosine, abs=1e-6)
        # Objects are asked for once; the request alone is asked for again, and a name wins over a meaning.
        again = search("sponge", ["lab"], settings=settings)
        assert [one.noun for one in again] == ["lab/sponge", "lab/dumbbell"]
        assert again[0].score == 1.0
    sent = [request["input"] for request in server.requests]
    assert [len(texts) for texts in sent] == [1, 2, 1]
    assert sent[0] == ["something to lift"]
    assert any("dumbbell" in text for text in sent[1])
    assert {request["path"] for request in server.requests} == {"/v1/embeddings"}
    assert set(server.keys) == {"Bearer sesame"}


@pytest.mark.parametrize(
    ("reply", "told"),
    [
        (fault(401, "bad key sesame"), r"status 401.*\*\*\*"),
        (Reply(body=b'{"data": "none"}'), "no list of embeddings"),
        (vectors_of([1.0, 0.0], [0.0, 1.0]), "2 vectors for 1 texts"),
        (vectors_of([]), "empty"),
        (vectors_of([float("nan"), 1.0]), "finite"),
    ],
)
def test_what_is_no_vector_is_an_error_that_keeps_the_key_to_itself(lab, reply, told):
    with serving(reply) as server:
        settings = EmbeddingSettings(model="test", base_url=server.url, key="sesame")
        with pytest.raises(ModelError, match=told) as raised:
            search("x", ["lab"], settings=settings)
    assert "sesame" not in str(raised.value)
    assert "sesame" not in repr(settings)


def test_the_hosted_key_goes_to_its_own_server_alone():
    given = {"PAT3D_EMBEDDINGS": "m", "OPENAI_API_KEY": "sesame"}
    hosted = embedding_settings(given)
    own = embedding_settings({**given, "PAT3D_EMBEDDINGS_URL": "http://localhost:1/v1"})
    assert hosted is not None
    assert own is not None
    assert (hosted.key, own.key) == ("sesame", "")
    with pytest.raises(ModelError, match="PAT3D_EMBEDDINGS_URL"):
        embedding_settings({**given, "PAT3D_EMBEDDINGS_URL": "localhost:1"})


def test_the_command_says_what_would_search_by_meaning(lab, capsys, monkeypatch):
    assert main(["library", "search", "sponge"]) == 0
    assert "lab/sponge" in capsys.readouterr().out
    assert document_of(capsys, ["library", "search", "sponge"], list[FoundFacts])[0]["noun"] == "lab/sponge"
    assert main(["library", "search", "something to lift"]) == 1
    assert "PAT3D_EMBEDDINGS" in capsys.readouterr().out
    with serving(vectors_of([0.0, 1.0, 0.0]), vectors_of(*(MEANINGS[key] for key in lab))) as server:
        monkeypatch.setenv("PAT3D_EMBEDDINGS", "test")
        monkeypatch.setenv("PAT3D_EMBEDDINGS_URL", server.url)
        assert main(["library", "search", "something to lift", "--libraries", "lab"]) == 0
    assert capsys.readouterr().out.startswith("lab/dumbbell")
