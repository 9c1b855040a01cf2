"""Signed results: what is signed cannot be changed, and a leaderboard says whose it is."""

from __future__ import annotations

import json
import stat
from dataclasses import replace

import pytest

pytest.importorskip("pyarrow")
pytest.importorskip("cryptography")

from pat3d.cli.evaluation_documents import RankedFacts, SignedFacts
from pat3d.cli.main import main
from pat3d.errors import EvaluationError
from pat3d.policies_eval.analysis.signing import FILE, make_key, sign, verify
from pat3d.policies_eval.run.manifest import make_manifest
from pat3d.policies_eval.run.records import RecordFolder, read_evaluation
from pat3d.policies_eval.run.settings import RolloutSettings
from tests.documents import document_of
from tests.policies_eval.test_records import result


@pytest.fixture
def done(tmp_path):
    """A finished evaluation of three episodes, one a success."""
    folder = tmp_path / "eval"
    folder.mkdir()
    manifest = make_manifest("mine:make", {}, RolloutSettings(robot="Panda"), {"seed": 0}, 3)
    (folder / "manifest.json").write_text(json.dumps(manifest))
    outcomes = ("success", "missed", "missed")
    rows = [result(k, success=one == "success", outcome=one) for k, one in enumerate(outcomes)]
    RecordFolder(folder).merge(tuple(rows))
    return folder


@pytest.fixture
def key(tmp_path):
    make_key(tmp_path / "keys" / "mine.pem")
    return tmp_path / "keys" / "mine.pem"


def test_what_was_signed_is_signed_and_by_whom(done, key, tmp_path):
    assert verify(read_evaluation(done)).state == "unsigned"
    signer = sign(read_evaluation(done), key)
    found = verify(read_evaluation(done))
    assert (found.state, found.signer, found.good) == ("signed", signer, True)
    statement = json.loads((done / FILE).read_text())["statement"]
    assert (statement["episodes"], statement["successes"], statement["policy"]) == (3, 1, "mine:make")
    make_key(tmp_path / "other.pem")
    assert sign(read_evaluation(done), tmp_path / "other.pem") != signer


def test_the_signature_is_one_that_another_library_would_make(done, key):
    """Ed25519 is deterministic: OpenSSL's, over the statement as compact JSON."""
    from cryptography.hazmat.primitives.serialization import load_pem_private_key

    sign(read_evaluation(done), key)
    document = json.loads((done / FILE).read_text())
    said = json.dumps(document["statement"], sort_keys=True, separators=(",", ":")).encode()
    private = load_pem_private_key(key.read_bytes(), None)
    assert private.sign(said).hex() == document["signature"]  # type: ignore[union-attr, call-arg]


def test_records_that_were_changed_afterwards_are_told(done, key):
    sign(read_evaluation(done), key)
    rows = read_evaluation(done).results
    RecordFolder(done).merge((replace(rows[0]), replace(rows[1], success=True, outcome="success"), rows[2]))
    found = verify(read_evaluation(done))
    assert (found.state, found.good) == ("changed", False)


@pytest.mark.parametrize("damage", ["successes", "signature", "key", "text", "nothing", "large"])
def test_a_statement_that_was_changed_is_forged(done, key, damage, tmp_path):
    sign(read_evaluation(done), key)
    document = json.loads((done / FILE).read_text())
    if damage == "successes":
        document["statement"]["successes"] = 3
    elif damage == "signature":
        document["signature"] = "00" * 64
    elif damage == "key":
        make_key(tmp_path / "other.pem")
        other = json.loads((done / FILE).read_text())
        sign(read_evaluation(done), tmp_path / "other.pem")
        document = other | {"public_key": json.loads((done / FILE).read_text())["public_key"]}
    elif damage == "nothing":
        document = {}
    text = {"text": "{", "large": " " * (2**20 + 1)}.get(damage, json.dumps(document))
    (done / FILE).write_text(text)
    assert verify(read_evaluation(done)).state == "forged"


def test_a_key_is_its_owner_s_alone_and_never_replaced(key):
    assert stat.S_IMODE(key.stat().st_mode) == 0o600
    with pytest.raises(EvaluationError, match="never replaced"):
        make_key(key)


def test_what_is_no_key_or_not_finished_is_refused(done, tmp_path, key):
    (tmp_path / "x.pem").write_text("no key")
    with pytest.raises(EvaluationError, match="no private key"):
        sign(read_evaluation(done), tmp_path / "x.pem")
    unfinished = read_evaluation(done)
    with pytest.raises(EvaluationError, match="2 of 3 episodes"):
        sign(replace(unfinished, results=unfinished.results[:2]), key)
    assert not (done / FILE).exists()


def test_the_leaderboard_says_whose_results_are_and_convicts_changed_ones(done, tmp_path, capsys):
    key, page = str(tmp_path / "k.pem"), tmp_path / "board.html"
    signed = document_of(capsys, ["sign", str(done), "--key", key, "--new-key"], SignedFacts)
    ranked = document_of(capsys, ["leaderboard", str(done), "--page", str(page)], list[RankedFacts])
    assert (ranked[0]["signature"], ranked[0]["signer"]) == ("signed", signed["signer"])
    assert signed["signer"] in page.read_text()
    assert 'class="wrong"' not in page.read_text()
    document = json.loads((done / FILE).read_text())
    document["statement"]["successes"] = 3
    (done / FILE).write_text(json.dumps(document))
    assert main(["leaderboard", str(done), "--page", str(page)]) == 1
    printed = capsys.readouterr()
    assert "forged" in printed.out
    assert "does not vouch" in printed.err
    assert 'class="wrong"' in page.read_text()
