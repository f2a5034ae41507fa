"""The network by numpy says what the package's own engine says."""

from __future__ import annotations

import struct
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.recognition.conformer import Conformer, _shapes, unpacked
from app.inputs.voice.recognition.model import _engine, _ours
from tests.app.inputs.voice.sounds import quiet, voice
from tests.lacking import package


@pytest.fixture(scope="module")
def ours():
    package("hama")
    return _ours()


@pytest.fixture(scope="module")
def engine():
    package("hama")
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


def test_sizes_that_no_file_has_are_a_value_error():
    head = b"HAMAPK\x01\x02" + struct.pack("<IH", 1, 1) + b"a" + struct.pack("<BBI", 0, 1, 4)
    for place, size in ((2**64 - 1, 16), (0, 2**64 - 1), (2**40, 16)):
        with pytest.raises(ValueError, match="weights"):
            unpacked(head + struct.pack("<QQ", place, size) + bytes(64))


@pytest.fixture(scope="module")
def weights():
    """Nothing but ones, in the shapes of the network."""
    forward = [(144, 576), (576, 144)]
    shapes = {
        **_shapes(191),
        **{
            f"onnx::MatMul_{10 + number}": shape
            for number, shape in enumerate([*forward, (144, 432), (144, 144), *forward] * 4)
        },
        **{
            f"onnx::Conv_{number}": shape
            for number, shape in enumerate([(144, 80, 3), (144,), *[(144, 1, 31), (144,)] * 4])
        },
    }
    return {name: np.full(shape, 0.01, np.float32) for name, shape in shapes.items()}


def test_weights_of_this_network_are_taken(weights):
    assert Conformer(weights)(quiet(0.1)).shape == (6, 191)


def test_attention_that_is_sure_beyond_what_an_exponential_holds_stays_a_number(weights):
    sure = {
        f"acoustic_model.model.blocks.{n}.attn.in_proj_bias": np.full(432, 100.0, np.float32)
        for n in range(4)
    }
    assert np.isfinite(Conformer(weights | sure)(quiet(0.1))).all()


def test_the_spectrum_is_rounded_as_the_network_learned_it(weights):
    spectrum = Conformer(weights)._log_mel(quiet(0.1, 0.1))
    assert np.array_equal(spectrum, spectrum.astype(np.float16))


@pytest.mark.parametrize(
    "change",
    [
        {"acoustic_model.model.blocks.4.norm.bias": (144,)},
        {"onnx::MatMul_99": (144, 576)},
        {"onnx::Conv_99": (144,)},
        {"mel_fb": (201, 40)},
        {"stft_real_kernel": (201, 400)},
        {"acoustic_model.model.blocks.1.ffn1.fc1.bias": (1,)},
        {"onnx::MatMul_12": (144, 288)},
        {"acoustic_model.model.proj.bias": (190,)},
        {"onnx::Conv_4": (144, 1, 15)},
        {"onnx::Conv_last": (144,)},
        {"mel_fb": None},
        {"onnx::Conv_0": None},
    ],
    ids=str,
)
def test_weights_of_another_network_are_a_value_error(weights, change):
    other = dict(weights)
    for name, shape in change.items():
        other.pop(name, None)
        if shape is not None:
            other[name] = np.ones(shape, np.float32)
    with pytest.raises(ValueError, match="another network"):
        Conformer(other)


def test_weights_that_are_none_are_a_value_error():
    with pytest.raises(ValueError, match="another network"):
        Conformer({})


def test_two_threads_hear_the_same_as_one(weights):
    network = Conformer(weights)
    waves = [quiet(0.2 + 0.01 * number) for number in range(8)]
    alone = [network(wave) for wave in waves]
    with ThreadPoolExecutor(2) as pool:
        together = list(pool.map(network, waves))
    assert all(np.array_equal(one, other) for one, other in zip(alone, together, strict=True))
