"""The network's arithmetic against the sums that it stands for."""

from __future__ import annotations

import numpy as np
import pytest

from robotside.perception.network import computed


def summed(array: np.ndarray, kernel: np.ndarray, stride: int) -> np.ndarray:
    """A convolution as it is written down: each cell by itself."""
    edge = kernel.shape[0]
    border = edge // 2
    framed = np.pad(array, ((border, border), (border, border), (0, 0)))
    rows, columns = range(0, array.shape[0], stride), range(0, array.shape[1], stride)
    return np.array(
        [
            [
                np.einsum("rci,rcio->o", framed[row : row + edge, column : column + edge], kernel)
                for column in columns
            ]
            for row in rows
        ]
    )


@pytest.mark.parametrize("stride", [1, 2])
@pytest.mark.parametrize("size", [(6, 8), (7, 5), (1, 1)])
def test_a_layer_gives_the_sums_of_its_neighbours(size: tuple[int, int], stride: int) -> None:
    rng = np.random.default_rng(3)
    array = rng.standard_normal((*size, 4), dtype=np.float32)
    kernel = rng.standard_normal((3, 3, 4, 5), dtype=np.float32)
    assert computed(array, kernel, stride) == pytest.approx(summed(array, kernel, stride), abs=1e-4)


def test_a_layer_of_one_cell_mixes_its_channels_alone() -> None:
    rng = np.random.default_rng(4)
    array = rng.standard_normal((3, 4, 6), dtype=np.float32)
    kernel = rng.standard_normal((1, 1, 6, 2), dtype=np.float32)
    assert computed(array, kernel, 1) == pytest.approx(summed(array, kernel, 1), abs=1e-4)
