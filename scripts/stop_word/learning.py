"""Learning: the network of `app/inputs/voice/recognition/stop_word.py` in torch, which only this needs."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.recognition.stop_word import AFTER, BEFORE, TAPS

__all__ = ["learn"]

HEARD, WIDE, LAYERS = 144, 48, 3
"""Numbers of a frame, of the network's own, and its convolutions."""
BATCH, RATE, WEIGHT_DECAY, WARM_UP = 128, 2e-3, 1e-3, 0.15
"""Windows of a step; the greatest rate of learning, after this part of all steps."""
LEFT_OUT = 0.15
"""Part of the numbers that are left out at random while it learns."""
SHARPNESS = 3.0
"""Of the soft maximum over the frames of a window, which is what counts."""


def learn(
    windows: NDArray[np.float16], truth: NDArray[np.bool_], rounds: int, seed: int
) -> dict[str, NDArray[np.float16]]:
    """Weights as `stop_word.npz` has them, after so many rounds through all `windows`, count x frames x 144, with the `truth` of each."""
    import torch

    torch.manual_seed(seed)
    torch.set_num_threads(1)
    rng, network = np.random.default_rng(seed), _network(torch)
    steps = len(truth) // BATCH
    optimiser = torch.optim.AdamW(network.parameters(), RATE, weight_decay=WEIGHT_DECAY)
    schedule = torch.optim.lr_scheduler.OneCycleLR(
        optimiser, RATE, total_steps=rounds * steps + 1, pct_start=WARM_UP
    )
    error = torch.nn.functional.binary_cross_entropy_with_logits
    for number in range(rounds):
        order, total = rng.permutation(len(truth)), 0.0
        for step in range(steps):
            chosen = np.sort(order[step * BATCH : (step + 1) * BATCH])
            found = network(torch.from_numpy(windows[chosen].astype(np.float32)))
            loss = error(
                torch.logsumexp(SHARPNESS * found, 1) / SHARPNESS,
                torch.from_numpy(truth[chosen].astype(np.float32)),
            )
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
            schedule.step()
            total += loss.item()
        print(f"round {number + 1} of {rounds}: {total / steps:.4f}", flush=True)
    return _weights(network)


def _network(torch: Any) -> Any:
    nn: Any = torch.nn

    class Network(nn.Module):  # type: ignore[misc]
        def __init__(self) -> None:
            super().__init__()
            self.norm = nn.LayerNorm(HEARD, elementwise_affine=False)
            self.first, self.left_out = nn.Linear(HEARD, WIDE), nn.Dropout(LEFT_OUT)
            self.layers = nn.ModuleList([nn.Conv1d(WIDE, WIDE, TAPS, dilation=2**n) for n in range(LAYERS)])
            self.last = nn.Conv1d(WIDE, 1, 1)

        def forward(self, frames: Any) -> Any:
            """Log odds of each frame."""
            x = nn.functional.gelu(self.first(self.left_out(self.norm(frames)))).transpose(1, 2)
            x = nn.functional.pad(x, (BEFORE, AFTER))
            for layer in self.layers:
                x = nn.functional.gelu(layer(self.left_out(x)))
            return self.last(x)[:, 0]

    return Network()


def _weights(network: Any) -> dict[str, NDArray[np.float16]]:
    told = {name: array.numpy() for name, array in network.state_dict().items()}
    weights = {"first": told["first.weight"].T, "first_bias": told["first.bias"]}
    for n in range(LAYERS):
        weights[f"layer{n}"] = told[f"layers.{n}.weight"].transpose(2, 1, 0).reshape(-1, WIDE)
        weights[f"layer{n}_bias"] = told[f"layers.{n}.bias"]
    weights |= {"last": told["last.weight"][0, :, 0], "last_bias": told["last.bias"]}
    return {name: array.astype(np.float16) for name, array in weights.items()}
