"""The network of the package `hama` by numpy: what its engine computes, in a fraction of its time, and where it has no engine at all.

log mel spectrum, 80 bands each 10 ms (window 25 ms) ─ convolution to a frame each 20 ms ─ 4 conformer blocks of 144 ─ 191 signs

A block is that of Gulati et al., "Conformer: Convolution-augmented Transformer for Speech Recognition" (2020), with plain
attention: half a feed-forward, attention of four heads, a gated convolution of 31 frames, half a feed-forward, a norm. The weights
are read from the package's own file: "HAMAPK", a version, a count, then for each tensor its name, kind (0 float32, 1 float16), shape, place and size,
and the numbers from the next multiple of 16 on.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["Conformer", "gelu", "unpacked"]

Floats: TypeAlias = NDArray[np.float32]

WINDOW, HOP = 400, 160
"""Of the spectrum: 25 ms and 10 ms [samples]."""
BANDS, BLOCKS, WIDTH, HEADS, REACH = 80, 4, 144, 4, 31
"""Bands of the spectrum, conformer blocks, numbers a frame, heads of the attention, frames of the convolution."""
WIDE = 4 * WIDTH
"""Numbers a frame in the middle of a feed-forward."""
MODEL = "acoustic_model.model."
CONVOLVED, MULTIPLIED = "onnx::Conv_", "onnx::MatMul_"
"""What lost its name when the network was written has a number behind this; the order is left."""
KINDS = ("<f4", "<f2")
ALIGNED = 16
MIN_POWER = 1e-10
"""No band has less power, so that its logarithm stays finite."""


def unpacked(packed: bytes) -> dict[str, Floats]:
    """The tensors of a weight file by name; ValueError for anything else."""
    if packed[:6] != b"HAMAPK":
        raise ValueError("these are no weights of hama")
    try:
        (count,), at = struct.unpack_from("<I", packed, 8), 12
        heads: list[tuple[str, int, tuple[int, ...], int, int]] = []
        for _ in range(count):
            (length,) = struct.unpack_from("<H", packed, at)
            name, at = packed[at + 2 : at + 2 + length].decode(), at + 2 + length
            kind, axes = struct.unpack_from("<BB", packed, at)
            shape = struct.unpack_from(f"<{axes}I", packed, at + 2)
            place, size = struct.unpack_from("<QQ", packed, at + 2 + 4 * axes)
            heads.append((name, kind, shape, place, size))
            at += 2 + 4 * axes + 16
        first = -(-at // ALIGNED) * ALIGNED
        return {
            name: np.frombuffer(packed, KINDS[kind], size // np.dtype(KINDS[kind]).itemsize, first + place)
            .reshape(shape)
            .astype(np.float32)
            for name, kind, shape, place, size in heads
        }
    except (struct.error, IndexError, OverflowError, ValueError) as problem:
        raise ValueError(f"these weights cannot be read: {problem}") from problem


@dataclass(frozen=True, slots=True)
class _Linear:
    weight: Floats
    bias: Floats

    def __call__(self, x: Floats) -> Floats:
        found: Floats = x @ self.weight
        found += self.bias
        return found


@dataclass(frozen=True, slots=True)
class _Norm:
    weight: Floats
    bias: Floats

    def __call__(self, x: Floats) -> Floats:
        x = x - x.mean(axis=1, keepdims=True)
        x *= 1.0 / np.sqrt(np.einsum("tc,tc->t", x, x) / x.shape[1] + np.float32(1e-5))[:, None]
        x *= self.weight
        x += self.bias
        return x


@dataclass(frozen=True, slots=True)
class _Forward:
    norm: _Norm
    wide: _Linear
    narrow: _Linear

    def __call__(self, x: Floats) -> Floats:
        """Half of what it says is to be added: the half is in `narrow`."""
        return self.narrow(_swish(self.wide(self.norm(x))))


@dataclass(frozen=True, slots=True)
class _Attention:
    norm: _Norm
    asks: _Linear
    tells: _Linear

    def __call__(self, x: Floats) -> Floats:
        frames = len(x)
        parts = self.asks(self.norm(x)).reshape(frames, 3, HEADS, WIDTH // HEADS).transpose(1, 2, 0, 3)
        wanted, keys, values = parts
        weights: Floats = np.matmul(wanted, keys.transpose(0, 2, 1), dtype=np.float32)
        weights -= weights.max(axis=2, keepdims=True)
        np.exp(weights, out=weights)
        weights /= weights.sum(axis=2, keepdims=True)
        heard: Floats = np.matmul(weights, values, dtype=np.float32).transpose(1, 0, 2).reshape(frames, WIDTH)
        return self.tells(heard)


@dataclass(frozen=True, slots=True)
class _Gated:
    norm: _Norm
    open: _Linear
    along: Floats
    """Channels x reach."""
    bias: Floats
    close: _Linear

    def __call__(self, x: Floats) -> Floats:
        gated = self.open(self.norm(x))
        values, gates = gated[:, :WIDTH], gated[:, WIDTH:]
        around = np.zeros((WIDTH, len(x) + REACH - 1), np.float32)
        around[:, REACH // 2 : REACH // 2 + len(x)] = (values * _sigmoid(gates)).T
        windows = np.lib.stride_tricks.sliding_window_view(around, REACH, axis=1)
        mixed: Floats = np.matmul(windows, self.along[:, :, None])[:, :, 0].T + self.bias
        return self.close(_swish(mixed))


@dataclass(frozen=True, slots=True)
class _Block:
    before: _Forward
    attention: _Attention
    gated: _Gated
    after: _Forward
    norm: _Norm

    def __call__(self, x: Floats) -> Floats:
        x = x + self.before(x)
        x += self.attention(x)
        x += self.gated(x)
        x += self.after(x)
        return self.norm(x)


class Conformer:
    """The whole network, of one utterance at a time; from any number of threads, since nothing is kept between two."""

    def __init__(self, weights: dict[str, Floats]) -> None:
        """ValueError for weights of another network: one layer more or another width would compute nonsense in silence."""
        convolved, products = _numbered(weights, CONVOLVED), _numbered(weights, MULTIPLIED)
        _checked(weights, [one.shape for one in convolved], [one.shape for one in products])
        self._spectrum = np.concatenate(
            [weights[f"stft_{part}_kernel"][:, 0].T for part in ("real", "imag")], axis=1
        )
        self._bands = weights["mel_fb"]
        stem = convolved[0].transpose(2, 1, 0).reshape(-1, WIDTH)
        self._stem = _Linear(np.ascontiguousarray(stem), convolved[1])
        self._blocks = [
            _block(weights, place, products[6 * place :], convolved[2 + 2 * place :])
            for place in range(BLOCKS)
        ]
        self._signs = _pointwise(weights, f"{MODEL}proj")

    def __call__(self, wave: Floats) -> Floats:
        """Log probability of each sign in each frame of 20 ms: frames x signs. Samples at 16 kHz, -1 to 1; at least 25 ms."""
        return self.signs(self.frames(wave))

    def frames(self, wave: Floats) -> Floats:
        """What it hears in each frame of 20 ms before it decides for a sign: frames x 144."""
        x = gelu(self._stem(self._convolved(self._log_mel(wave))))
        for block in self._blocks:
            x = block(x)
        return x

    def signs(self, frames: Floats) -> Floats:
        """Log probability of each sign in each of the `frames`."""
        signs = self._signs(frames)
        signs -= signs.max(axis=1, keepdims=True)
        signs -= np.log(np.exp(signs).sum(axis=1, keepdims=True))
        return signs

    def _log_mel(self, wave: Floats) -> Floats:
        around = np.pad(wave.astype(np.float32), WINDOW // 2, mode="reflect")
        frames = np.lib.stride_tricks.sliding_window_view(around, WINDOW)[::HOP][: len(wave) // HOP + 1]
        parts = np.square(np.ascontiguousarray(frames) @ self._spectrum)
        powers = (parts[:, : WINDOW // 2 + 1] + parts[:, WINDOW // 2 + 1 :]) @ self._bands
        rounded: Floats = np.log(np.maximum(powers, MIN_POWER)).astype(np.float16).astype(np.float32)
        return rounded

    def _convolved(self, bands: Floats) -> Floats:
        """Each second frame with its neighbours."""
        around = np.pad(bands, ((1, 1), (0, 0)))
        count = (len(bands) + 1) // 2
        return np.concatenate([around[first : first + 2 * count - 1 : 2] for first in range(3)], axis=1)


def _shapes(signs: int) -> dict[str, tuple[int, ...]]:
    """Of all that has a name, for so many signs."""
    half = WINDOW // 2 + 1
    shapes: dict[str, tuple[int, ...]] = {
        "stft_real_kernel": (half, 1, WINDOW),
        "stft_imag_kernel": (half, 1, WINDOW),
        "mel_fb": (half, BANDS),
        f"{MODEL}proj.weight": (signs, WIDTH, 1),
        f"{MODEL}proj.bias": (signs,),
    }
    for place in range(BLOCKS):
        block: dict[str, tuple[int, ...]] = {
            "attn.in_proj_bias": (3 * WIDTH,),
            "attn.out_proj.bias": (WIDTH,),
            "conv.pointwise1.weight": (2 * WIDTH, WIDTH, 1),
            "conv.pointwise1.bias": (2 * WIDTH,),
            "conv.pointwise2.weight": (WIDTH, WIDTH, 1),
            "conv.pointwise2.bias": (WIDTH,),
        }
        for norm in ("attn_norm", "conv.norm", "ffn1.norm", "ffn2.norm", "norm"):
            block |= {f"{norm}.weight": (WIDTH,), f"{norm}.bias": (WIDTH,)}
        for forward in ("ffn1", "ffn2"):
            block |= {f"{forward}.fc1.bias": (WIDE,), f"{forward}.fc2.bias": (WIDTH,)}
        shapes |= {f"{MODEL}blocks.{place}.{name}": shape for name, shape in block.items()}
    return shapes


def _checked(
    weights: dict[str, Floats], convolved: list[tuple[int, ...]], products: list[tuple[int, ...]]
) -> None:
    """ValueError where a tensor is missing, is one too many, or has another shape."""
    signs = weights.get(f"{MODEL}proj.bias", np.zeros(0)).size
    wanted = _shapes(signs)
    found = {name: one.shape for name, one in weights.items() if not name.startswith((CONVOLVED, MULTIPLIED))}
    other = [name for name in wanted | found if wanted.get(name) != found.get(name)]
    if convolved != [(WIDTH, BANDS, 3), (WIDTH,), *[(WIDTH, 1, REACH), (WIDTH,)] * BLOCKS]:
        other.append(CONVOLVED)
    forward = [(WIDTH, WIDE), (WIDE, WIDTH)]
    if products != [*forward, (WIDTH, 3 * WIDTH), (WIDTH, WIDTH), *forward] * BLOCKS:
        other.append(MULTIPLIED)
    if other:
        raise ValueError(f"these are weights of another network: {', '.join(other[:3])} not as expected")


def _block(weights: dict[str, Floats], place: int, products: list[Floats], convolved: list[Floats]) -> _Block:
    """`products` and `convolved` have lost their names, not their order."""
    name = f"{MODEL}blocks.{place}."

    def norm(of: str) -> _Norm:
        return _Norm(weights[f"{name}{of}.weight"], weights[f"{name}{of}.bias"])

    def forward(of: str, wide: Floats, narrow: Floats) -> _Forward:
        first, second = (weights[f"{name}{of}.{layer}.bias"] for layer in ("fc1", "fc2"))
        return _Forward(norm(f"{of}.norm"), _Linear(wide, first), _Linear(0.5 * narrow, 0.5 * second))

    scale = np.ones(3 * WIDTH, np.float32)
    scale[:WIDTH] = (WIDTH / HEADS) ** -0.5
    asks = _Linear(products[2] * scale, weights[f"{name}attn.in_proj_bias"] * scale)
    tells = _Linear(products[3], weights[f"{name}attn.out_proj.bias"])
    gated = _Gated(
        norm("conv.norm"),
        _pointwise(weights, f"{name}conv.pointwise1"),
        np.ascontiguousarray(convolved[0][:, 0]),
        convolved[1],
        _pointwise(weights, f"{name}conv.pointwise2"),
    )
    return _Block(
        forward("ffn1", products[0], products[1]),
        _Attention(norm("attn_norm"), asks, tells),
        gated,
        forward("ffn2", products[4], products[5]),
        norm("norm"),
    )


def _pointwise(weights: dict[str, Floats], name: str) -> _Linear:
    return _Linear(np.ascontiguousarray(weights[f"{name}.weight"][:, :, 0].T), weights[f"{name}.bias"])


def _numbered(weights: dict[str, Floats], name: str) -> list[Floats]:
    """Those whose name is a number, in its order."""
    names = [one for one in weights if one.startswith(name)]
    try:
        return [weights[one] for one in sorted(names, key=lambda one: int(one.removeprefix(name)))]
    except ValueError as problem:
        raise ValueError(f"these are weights of another network: {problem}") from problem


def _sigmoid(x: Floats) -> Floats:
    """By the tangent: it overflows nowhere."""
    found: Floats = np.tanh(x * np.float32(0.5))
    found += 1.0
    found *= 0.5
    return found


def _swish(x: Floats) -> Floats:
    found = _sigmoid(x)
    found *= x
    return found


def gelu(x: Floats) -> Floats:
    """The smooth step between a number and nothing (Hendrycks, Gimpel 2016)."""
    found: Floats = x * (0.5 * (1.0 + _erf(x * np.float32(0.5**0.5))))
    return found


def _erf(x: Floats) -> Floats:
    """To 1.5e-7: Abramowitz, Stegun, "Handbook of Mathematical Functions" (1964), 7.1.26."""
    t = 1.0 / (1.0 + 0.3275911 * np.abs(x))
    polynomial = t * (
        0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429)))
    )
    found: Floats = np.copysign(1.0 - polynomial * np.exp(-np.square(x)), x).astype(np.float32)
    return found
