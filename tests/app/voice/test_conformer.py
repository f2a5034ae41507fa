"""The network by numpy says what the package's own engine says."""

from __future__ import annotations

import struct

import numpy as np
import pytest

from app.voice.conformer import Conformer, unpacked
from app.voice.model import _engine, _ours
from app.voice.noise import RATE
from tests.app.voice.sounds import quiet, voice


@pytest.fixture(scope="module")
def ours():
    pytest.importorskip("hama")
    return _ours()


@pytest.fixture(scope="module")
def engine():
    pytest.importorskip("hama")
    return _engine()


@pytest.mark.parametrize(
    "wave",
    [
        np.concatenate((quiet(0.3), voice(0.4), quiet(0.3))),
        quiet(0.5, 0.2),
        np.zeros(RATE // 4, np.float32),
        np.clip(voice(0.3, 3.0), -1, 1),
        quiet(0.025),
        quiet(0.0301),
    ],
    ids=["a voice", "noise", "silence", "overdriven", "one window", "an odd length"],
)
def test_it_hears_what_the_engine_hears(ours, engine, wave):
    said, truth = ours(wave), engine(wave)
    assert said.shape == truth.shape
    assert np.exp(said) == pytest.approx(np.exp(truth), abs=0.002)


def packed(tensors: dict[str, np.ndarray]) -> bytes:
    head, body = b"HAMAPK\x01\x02" + struct.pack("<I", len(tensors)), b""
    for name, tensor in tensors.items():
        head += struct.pack("<H", len(name)) + name.encode()
        head += struct.pack("<BB", 0 if tensor.dtype == np.float32 else 1, tensor.ndim)
        head += struct.pack(f"<{tensor.ndim}I", *tensor.shape) + struct.pack("<QQ", len(body), tensor.nbytes)
        body += tensor.tobytes()
    return head + bytes(-len(head) % 16) + body


def test_weights_are_read_in_both_kinds():
    tensors = {"a": np.arange(6, dtype=np.float32).reshape(2, 3), "b": np.array([0.5, 2], np.float16)}
    read = unpacked(packed(tensors))
    assert {name: tensor.tolist() for name, tensor in read.items()} == {
        name: tensor.tolist() for name, tensor in tensors.items()
    }


@pytest.mark.parametrize(
    "broken",
    [b"", b"RIFF", b"HAMAPK", b"HAMAPK\x01\x02\xff\xff\x00\x00", packed({"a": np.ones(4, np.float32)})[:-4]],
    ids=["empty", "a sound", "cut at once", "more tensors than there are", "cut at the end"],
)
def test_a_broken_file_is_a_value_error(broken):
    with pytest.raises(ValueError, match="weights"):
        unpacked(broken)


def test_weights_of_another_network_are_a_value_error():
    with pytest.raises(ValueError, match="another network"):
        Conformer({"mel_fb": np.ones((201, 80), np.float32)})
