"""Meshes of text-to-3D servers: the real client, against a server on the loopback that misbehaves on demand."""

import base64
import json
import struct

import numpy as np
import pytest
import trimesh

from pat3d.assets import sources
from pat3d.assets.generated.client import Client
from pat3d.assets.generated.orders import Orders, orders_of
from pat3d.assets.generated.settings import ServerSettings, server_settings
from pat3d.assets.generated.sizes import usual_size
from pat3d.assets.generated.source import MeshServers
from pat3d.assets.variant import Variant
from pat3d.errors import AssetError, PromptError
from pat3d.generation.request import objects_of_plan
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.progress import silent
from tests.assets.mesh_server import said, serving
from tests.loopback import Reply

KINDS = ("sglang", "hunyuan", "hunyuan21", "generate")
LINE = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]], process=False)
SENTENCE = "a cute teapot dinosaur on a plate"


def exported(mesh: trimesh.Trimesh) -> bytes:
    """The mesh as a GLB file."""
    data = mesh.export(file_type="glb")
    assert isinstance(data, bytes)
    return data


def glb(*, tall: float = 2.0) -> bytes:
    """A box that is `tall` along y and 1 along x and z, in units that mean nothing."""
    return exported(trimesh.creation.box((1.0, tall, 1.0)))


def edited(data: bytes, change) -> bytes:
    """A GLB file whose JSON `change` changes."""
    length = struct.unpack_from("<I", data, 12)[0]
    tree = json.loads(data[20 : 20 + length])
    change(tree)
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + length :]
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest


class Time:
    """A clock that only waiting moves."""

    def __init__(self) -> None:
        self.now, self.waits = 0.0, list[float]()

    def sleep(self, seconds: float) -> None:
        self.waits.append(seconds)
        self.now += seconds


@pytest.fixture
def time():
    return Time()


@pytest.fixture(autouse=True)
def apart(tmp_path, monkeypatch):
    """Folders and environment of the test's own."""
    monkeypatch.setenv("PAT3D_DATA", str(tmp_path / "data"))
    monkeypatch.setenv("PAT3D_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    for name in ("PAT3D_MESH_KEY", "PAT3D_MESH_TIMEOUT", "PAT3D_MESH_PICTURES"):
        monkeypatch.delenv(name, raising=False)


@pytest.fixture
def source(time):
    return MeshServers(connect=lambda settings: Client(settings, sleep=time.sleep, clock=lambda: time.now))


def ordered(server, words="teapot dinosaur") -> str:
    """The noun of an order that is kept."""
    orders = Orders(server.url)
    noun = orders.order(words).noun
    orders.keep([noun])
    return noun


@pytest.mark.parametrize("kind", KINDS)
def test_a_mesh_has_its_size_from_words_and_stands_upright(source, kind):
    with serving(kind, glb(), busy=2) as server:
        asset = source.make(ordered(server, "gramophone"), Variant(seed=7, colours=("red",), adjectives=("old",)))
    # 0.6 m by the table of usual sizes along the file's y axis, whatever the file's 2 units are.
    assert asset.size.tolist() == pytest.approx([0.3, 0.3, 0.6], abs=2e-4)
    assert asset.bounds[0][2] == 0.0
    record = asset.provenance
    assert record["source"] == "mesh"
    assert record["server"] == server.url.removeprefix("http://")
    assert record["prompt"] == "old red gramophone, one object, standing upright"
    assert record["seed"] == 7
    assert len(record["sha256"]) == 64
    assert record.get("model") == ("tencent/Hunyuan3D-2" if kind == "sglang" else None)
    # Its mesh has no texture, so the colour that was asked for is put on it.
    assert (
        asset.visual.texture.reshape(-1, 3).mean(axis=0)[0] > 100 > asset.visual.texture.reshape(-1, 3).mean(axis=0)[2]
    )
    sent = server.asked[0]
    if kind == "sglang":
        assert sent == {"prompt": record["prompt"].encode(), "seed": b"7", "output_format": b"glb"}
    else:
        assert sent == {"seed": 7, "type": "glb", "texture": kind == "hunyuan21", "text": record["prompt"]}


def test_the_same_wish_is_asked_once(source, tmp_path):
    with serving("sglang", glb()) as server:
        noun = ordered(server)
        first = source.make(noun, Variant(seed=1))
        assert np.array_equal(source.make(noun, Variant(seed=1)).visual.vertices, first.visual.vertices)
        # A larger one is the same mesh.
        assert source.make(noun, Variant(seed=1, scale=2.0)).size.tolist() == pytest.approx((2 * first.size).tolist())
        assert server.count("POST /v1/meshes") == 1
        source.make(noun, Variant(seed=2))
        source.make(noun, Variant(seed=1, adjectives=("old",)))
        assert server.count("POST /v1/meshes") == 3
        for path in (tmp_path / "cache").glob("meshes/*/mesh.glb"):
            path.write_bytes(path.read_bytes()[:-4])
        source.make(noun, Variant(seed=1))
        assert server.count("POST /v1/meshes") == 4
    # What is kept needs no server.
    source.make(noun, Variant(seed=1))


def test_a_sentence_becomes_a_plan_whose_nouns_say_all(source, monkeypatch):
    with serving("sglang", glb()) as server:
        orders = orders_of(f"mesh:{server.url}")
        plan = GrammarPlanner(orders=orders).plan(f"{SENTENCE} beside two small gramophones")
        assert server.requests == []
        assert sorted(obj.noun.split("_")[0] for obj in plan.objects) == [
            "mesh/gramophone", "mesh/gramophone", "mesh/teapot", "plate",
        ]  # fmt: skip
        assert plan.parent("teapot dinosaur") == "plate"
        assert any("0.6 m long" in note and "gramophone" in note for note in plan.notes)
        # The prompt has the adjective, so that no note says that it is left out.
        assert not any("cute" in note for note in plan.notes if not note.startswith("worded like"))
        monkeypatch.setattr(sources, "MeshServers", lambda: source)
        source_of = sources.source_of
        monkeypatch.setattr(sources, "source_of", lambda noun: source if "mesh/" in noun else source_of(noun))
        made = {one.name: one.asset for one in objects_of_plan(plan, 3, silent)}
        assert made["teapot dinosaur"].provenance["seed"] != made["small gramophone 1"].provenance["seed"]
        assert made["small gramophone 1"].size.max() < 0.6
        assert sources.fingerprint(obj.noun for obj in plan.objects).keys() == {
            obj.noun for obj in plan.objects if "/" in obj.noun
        }


def test_the_size_of_a_phrase_counts_before_the_usual_one(source, monkeypatch):
    with serving("sglang", glb()) as server:
        plan = GrammarPlanner(orders=orders_of(f"mesh:{server.url}")).plan("a 30 cm tall theremin on a table")
        source_of = sources.source_of
        monkeypatch.setattr(sources, "source_of", lambda noun: source if "mesh/" in noun else source_of(noun))
        made = {one.name: one.asset for one in objects_of_plan(plan, 0, silent)}
    assert made["theremin"].size[2] == pytest.approx(0.3, abs=2e-4)


def test_what_the_catalogue_has_is_not_ordered():
    plan = GrammarPlanner(orders=Orders("http://127.0.0.1:1")).plan("a red mug and a soup bowl on a kitchen table")
    assert not [obj.noun for obj in plan.objects if "/" in obj.noun]


def test_usual_sizes_come_from_the_last_word_that_is_known():
    assert usual_size("brass gramophone").metres == 0.6
    assert usual_size("teapot dinosaur").like == usual_size("dinosaur").like == "dinosaur"
    assert "assumed" in usual_size("blorb").why


@pytest.mark.parametrize("kind", ["sglang", "hunyuan"])
def test_a_busy_server_is_asked_again_and_says_how_long_to_wait(source, time, kind):
    create = "POST /v1/meshes" if kind == "sglang" else "POST /send"
    faults = {
        create: [said({"detail": "busy"}, 429, Retry_After="7"), said({"detail": "oops"}, 500), Reply(status=503)]
    }
    with serving(kind, glb(), faults=faults) as server:
        source.make(ordered(server))
        assert server.count(create) == 4
    assert time.waits[:3] == [7.0, 2.0, 4.0]


def test_a_server_that_stays_busy_is_given_up(source, time):
    with serving("sglang", glb(), faults={"POST": [said({"error": {"message": "full"}}, 429)] * 9}) as server:
        with pytest.raises(AssetError, match=r"127\.0\.0\.1:\d+: status 429: full"):
            source.make(ordered(server))
        assert server.count("POST") == 5
    assert time.waits == [1.0, 2.0, 4.0, 8.0]


def test_the_time_is_bounded_and_the_job_is_deleted(source, time, monkeypatch):
    monkeypatch.setenv("PAT3D_MESH_TIMEOUT", "60")
    with serving("sglang", glb(), busy=10**6) as server:
        with pytest.raises(AssetError, match="no mesh in 60 s; PAT3D_MESH_TIMEOUT"):
            source.make(ordered(server))
        assert server.requests[-1] == "DELETE /v1/meshes/job-1"
    assert time.now <= 60.0


def test_an_interrupt_deletes_the_job():
    def interrupt(seconds):
        raise KeyboardInterrupt

    with serving("sglang", glb(), busy=10**6) as server:
        stopped = MeshServers(connect=lambda settings: Client(settings, sleep=interrupt))
        with pytest.raises(KeyboardInterrupt):
            stopped.make(ordered(server))
        assert server.requests[-1] == "DELETE /v1/meshes/job-1"


def test_silence_ends_with_the_time_allowed(time):
    with serving("sglang", glb(), faults={"GET": [Reply(stalls=True)] * 9}) as server:
        settings = ServerSettings(url=server.url, answer_seconds=0.2, retries=1)
        client = Client(settings, sleep=time.sleep, clock=lambda: time.now)
        with pytest.raises(AssetError, match=r"no answer in 0\.2 s"):
            client.json("/v1/meshes")
        assert server.count("GET") == 2


def test_a_failed_job_says_why(source):
    failed = said({"id": "job-1", "status": "failed", "error": {"message": "out of\nmemory"}})
    with (
        serving("sglang", glb(), faults={"GET /v1/meshes/job-1": [failed]}) as server,
        pytest.raises(AssetError, match="job-1 is failed: out of memory"),
    ):
        source.make(ordered(server))


@pytest.mark.parametrize(
    ("body", "words"),
    [
        (glb()[:-40], "says version 2 and"),
        (b"<html>hello</html>" * 9, "no GLB file"),
        (b"", "no GLB file"),
        (b"glTF" + struct.pack("<IIII", 2, 40, 20, 0x4E4F534A) + b"[" * 20, "no use"),
        (edited(glb(), lambda tree: tree["accessors"][0].update(count=10**9)), "triangles"),
        (exported(LINE), "no use"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("kind", ["sglang", "hunyuan"])
def test_broken_meshes_meet_the_gates_of_files(source, tmp_path, kind, body, words):
    with serving(kind, body) as server, pytest.raises(AssetError, match=words):
        source.make(ordered(server))
    # What is of no use is asked for again the next time.
    assert not list((tmp_path / "cache").glob("meshes/*/mesh.glb"))


@pytest.mark.slow
def test_an_open_mesh_becomes_a_solid_as_a_users_file_does(source):
    box = trimesh.creation.box((1.0, 1.0, 1.0))
    box.update_faces(box.face_normals[:, 1] < 0.5)
    with serving("sglang", exported(box)) as server:
        asset = source.make(ordered(server))
    assert asset.mass_properties.volume > 0.0
    assert not asset.provenance["watertight"]


@pytest.mark.parametrize("uri", ["http://127.0.0.1:{port}/leak.bin", "file://{secret}", "{secret}", "../../{name}"])
@pytest.mark.parametrize("where", ["buffers", "images"])
def test_what_a_mesh_refers_to_is_never_opened(source, tmp_path, uri, where, monkeypatch):
    secret = tmp_path / "cache" / "secret.png"
    secret.parent.mkdir()
    secret.write_bytes(b"secret")
    opened = []
    plain = type(secret).read_bytes
    monkeypatch.setattr(type(secret), "read_bytes", lambda path: opened.append(path.name) or plain(path))
    with serving("sglang", b"") as server:
        said_uri = uri.format(port=server.url.rsplit(":", 1)[1], secret=secret, name=secret.name)

        def refer(tree):
            if where == "buffers":
                tree["buffers"][0]["uri"] = said_uri
                tree["buffers"].append({"uri": said_uri, "byteLength": 6})
            else:
                tree["images"], tree["textures"] = [{"uri": said_uri}], [{"source": 0}]
                tree["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
                tree["meshes"][0]["primitives"][0]["material"] = 0

        server.mesh = edited(glb(), refer)
        try:
            asset = source.make(ordered(server))
        except AssetError:
            asset = None
        assert where == "buffers" or asset is not None
        assert not server.count("GET /leak")
    assert "secret.png" not in opened


def test_huge_answers_are_not_read(time):
    def settings(server):
        return ServerSettings(url=server.url, max_bytes=1000, retries=0)

    with serving("sglang", b"x" * 5000) as server:
        for length in (None, 10**12):
            server.faults = {"GET": [Reply(body=b"x" * 5000, length=length)]}
            client = Client(settings(server), sleep=time.sleep)
            with pytest.raises(AssetError, match="are read"):
                client.bytes("/v1/meshes/job-1/content")
    with serving("hunyuan", b"x" * 5000) as server:
        big = said({"status": "completed", "model_base64": base64.b64encode(b"x" * 5000).decode()})
        server.faults = {"GET /status/a-b-c": [big]}
        from pat3d.assets.generated.adapter import Wish
        from pat3d.assets.generated.hunyuan import Hunyuan3D

        client = Client(settings(server), sleep=time.sleep)
        with pytest.raises(AssetError, match="too large"):
            Hunyuan3D().make(client, Wish(prompt="x", seed=0))


def test_a_connection_that_breaks_is_tried_again(source):
    whole = glb()
    torn = Reply(body=whole[:200], length=len(whole))
    with serving("sglang", whole, faults={"GET /v1/meshes/job-1/content": [torn, torn]}) as server:
        source.make(ordered(server))
        assert server.count("GET /v1/meshes/job-1/content") == 3


def test_the_key_goes_to_the_server_and_nowhere_else(source, monkeypatch, tmp_path):
    monkeypatch.setenv("PAT3D_MESH_KEY", "sesame")
    with serving("sglang", glb()) as server, serving("sglang", glb()) as other:
        asset = source.make(ordered(server))
        assert set(server.keys) == {"Bearer sesame"}
        # A redirect would carry it along.
        server.faults = {"POST": [Reply(status=307, headers={"Location": f"{other.url}/v1/meshes"})]}
        with pytest.raises(AssetError, match="status 307"):
            source.make(ordered(server), Variant(seed=5))
        assert other.requests == []
        server.faults = {"POST": [said({"detail": "bad key sesame"}, 401)]}
        with pytest.raises(AssetError, match=r"bad key \*\*\*"):
            source.make(ordered(server), Variant(seed=6))
    assert "sesame" not in json.dumps(asset.provenance)
    assert "sesame" not in repr(server_settings(server.url))
    kept = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert kept
    assert not [path for path in kept if b"sesame" in path.read_bytes()]


@pytest.mark.parametrize("kind", ["sglang", "hunyuan21"])
def test_servers_that_want_pictures_get_them(source, kind, tmp_path, monkeypatch):
    with serving(kind, glb(), needs_picture=True) as server:
        noun = ordered(server)
        with pytest.raises(AssetError, match="PAT3D_MESH_PICTURES"):
            source.make(noun)
        before = source.digest(noun)
        (tmp_path / "pictures").mkdir()
        (tmp_path / "pictures" / "teapot_dinosaur.png").write_bytes(b"\x89PNG\r\n--a picture\r\n")
        monkeypatch.setenv("PAT3D_MESH_PICTURES", str(tmp_path / "pictures"))
        assert source.digest(noun) != before
        asset = source.make(noun)
        sent = server.asked[-1]["image"]
        assert (sent if kind == "sglang" else base64.b64decode(sent)) == b"\x89PNG\r\n--a picture\r\n"
        assert len(asset.provenance["picture"]) == 64


def test_other_servers_are_told_apart(source):
    with (
        serving("sglang", glb(), faults={"GET": [said({"detail": "Not Found"}, 404)] * 9}) as server,
        pytest.raises(AssetError, match=r"none of the protocols known here \(sglang, hunyuan3d\)"),
    ):
        source.make(ordered(server))


@pytest.mark.parametrize("assets", ["mesh:", "mesh:ftp://x", "http://x", "mesh:http://u:p@x", "mesh:http://x?k=1"])
def test_assets_that_are_no_server_are_refused(assets):
    with pytest.raises(AssetError, match=r"mesh server|mesh:http"):
        orders_of(assets)


def test_an_order_that_is_not_there_or_was_changed_is_refused(source, tmp_path):
    with pytest.raises(PromptError, match="--assets"):
        source.make("mesh/../../etc_123456")
    noun = ordered(type("Server", (), {"url": "http://127.0.0.1:1"}))
    path = next((tmp_path / "data" / "orders").glob("*.json"))
    path.write_text(path.read_text().replace("127.0.0.1:1", "evil.example"))
    with pytest.raises(AssetError, match="was changed"):
        source.make(noun)
    assert list(source.nouns()) == []
