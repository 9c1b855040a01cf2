"""Signed results: who vouches for an evaluation, and whether its records are still those that were signed.

A signature (Ed25519) is over what was found and over the checksums of the records, in which every action of every
episode is. So anybody can hold a row of a leaderboard against the records, and the records against the simulation.
"""

from __future__ import annotations

import hashlib
import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pat3d.errors import EvaluationError
from pat3d.policies_eval.run.records import Evaluation, write_text
from pat3d.scene.replacement import replaced_file

FILE = "signature.json"

FORMAT, VERSION = "pat3d-signed-result", 1

SIGNED = ("manifest.json", "episodes.parquet")
"""Files of an evaluation whose checksums are signed."""

MAX_BYTES = 2**20

INSTALL_HINT = "signatures need cryptography: pip install 'pat3d[eval]'."


@dataclass(frozen=True, kw_only=True)
class Signature:
    """What the signature beside an evaluation is worth."""

    state: str
    """"signed", "unsigned", "changed" (records are others than those that were signed) or "forged"."""
    signer: str = ""
    """First 16 digits of the SHA-256 of the public key."""

    @property
    def good(self) -> bool:
        """Whether nothing speaks against it; without a signature, nothing does."""
        return self.state in ("signed", "unsigned")


def told(signature: Signature) -> str:
    """A signature in words."""
    return f"{signature.state} {signature.signer}".strip()


def make_key(file: str | Path) -> str:
    """Write a new private key, readable by its owner alone; returns who signs with it.

    Raises:
        EvaluationError: something is there already.
    """
    path = Path(file)
    if path.exists():
        raise EvaluationError(f"{path} is there already; a key is never replaced.")
    serialization, ed25519 = _cryptography()
    key = ed25519.Ed25519PrivateKey.generate()
    text = key.private_bytes(
        serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    with replaced_file(path) as temporary:
        handle = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
        with os.fdopen(handle, "wb") as target:
            target.write(text)
        temporary.chmod(0o600)
    return _signer(_raw(key.public_key()))


def sign(evaluation: Evaluation, key_file: str | Path) -> str:
    """Sign a finished evaluation: writes signature.json beside its records; returns who signed.

    Raises:
        EvaluationError: the evaluation is unfinished, or the file holds no key of this kind.
    """
    wanted = int(evaluation.manifest["episodes"])
    if len(evaluation.results) < wanted:
        raise EvaluationError(f"{evaluation.folder}: {len(evaluation.results)} of {wanted} episodes; finish it first.")
    key, statement = _read_key(Path(key_file)), statement_of(evaluation)
    public = _raw(key.public_key())
    document = {
        "format": FORMAT,
        "version": VERSION,
        "statement": statement,
        "public_key": public.hex(),
        "signature": key.sign(_bytes(statement)).hex(),
    }
    write_text(evaluation.folder / FILE, json.dumps(document, indent=1, sort_keys=True) + "\n")
    return _signer(public)


def statement_of(evaluation: Evaluation) -> dict[str, Any]:
    """What is signed."""
    manifest = evaluation.manifest
    return {
        "policy": manifest["policy"],
        "policy_details": manifest.get("policy_details", {}),
        "source": manifest["source"],
        "engine": manifest["engine"],
        "episodes": len(evaluation.results),
        "successes": sum(one.success for one in evaluation.results),
        "sha256": {name: _sha256(evaluation.folder / name) for name in SIGNED},
    }


def verify(evaluation: Evaluation) -> Signature:
    """What the signature in the folder of an evaluation is worth.

    Raises:
        EvaluationError: there is a signature, but nothing here to check it with.
    """
    file = evaluation.folder / FILE
    if not file.is_file():
        return Signature(state="unsigned")
    _, ed25519 = _cryptography()
    from cryptography.exceptions import InvalidSignature

    try:
        if file.stat().st_size > MAX_BYTES:
            return Signature(state="forged")
        document = json.loads(file.read_text(encoding="utf-8"))
        public, statement = bytes.fromhex(document["public_key"]), document["statement"]
        key = ed25519.Ed25519PublicKey.from_public_bytes(public)
        key.verify(bytes.fromhex(document["signature"]), _bytes(statement))
    except (OSError, ValueError, KeyError, TypeError, RecursionError, InvalidSignature):
        return Signature(state="forged")
    same = statement == _plain(statement_of(evaluation))
    return Signature(state="signed" if same else "changed", signer=_signer(public))


def _read_key(path: Path) -> Any:
    serialization, ed25519 = _cryptography()
    try:
        if path.stat().st_size > MAX_BYTES:
            raise ValueError("larger than any key")
        key = serialization.load_pem_private_key(path.read_bytes(), password=None)
    except (OSError, ValueError, TypeError) as error:
        raise EvaluationError(f"{path}: no private key: {error}. pat3d sign --new-key makes one.") from error
    if not isinstance(key, ed25519.Ed25519PrivateKey):
        raise EvaluationError(f"{path}: a key of another kind; results are signed with Ed25519.")
    return key


def _raw(public: Any) -> bytes:
    return public.public_bytes_raw()


def _signer(public: bytes) -> str:
    return hashlib.sha256(public).hexdigest()[:16]


def _bytes(statement: Any) -> bytes:
    return json.dumps(statement, sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode()


def _plain(statement: dict[str, Any]) -> Any:
    """As it is read back from JSON."""
    return json.loads(_bytes(statement))


def _sha256(file: Path) -> str:
    try:
        return hashlib.sha256(file.read_bytes()).hexdigest()
    except OSError as error:
        raise EvaluationError(f"{file}: cannot be read ({error.strerror or error}).") from error


def _cryptography() -> Any:
    try:
        from cryptography.hazmat.primitives import serialization
        from cryptography.hazmat.primitives.asymmetric import ed25519
    except ImportError as error:
        raise EvaluationError(INSTALL_HINT) from error
    return serialization, ed25519
