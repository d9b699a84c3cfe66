# SPDX-License-Identifier: Apache-2.0
"""Base class of light fields, faces and fields: arrays that are read on demand."""
from __future__ import annotations

import os
from typing import Any, Union

import numpy as np

from .errors import usage_error

Path = Union[str, "os.PathLike[str]"]


class _WritableView:
    """Writable view of memory from DLPack. NumPy treats it as read-only, because DLPack lacks this information."""

    def __init__(self, values: "np.ndarray[Any, Any]") -> None:
        facts = values.__array_interface__
        self.values, self.__array_interface__ = values, {**facts, "data": (facts["data"][0], False)}


def array_of(values: Any, kind: Any) -> "np.ndarray[Any, Any]":
    """Converts any object that exports its memory to a NumPy array, by DLPack too (torch, cupy, jax). Copies only to
    change the element type."""
    if not isinstance(values, np.ndarray) and hasattr(values, "__dlpack__"):
        values = np.asarray(_WritableView(np.from_dlpack(values)))
    return np.require(values, dtype=kind, requirements="A")


def choice(kind: Any, name: str, what: str) -> Any:
    """Returns the member of an enumeration by its name."""
    members = kind.__members__
    if name not in members:
        raise usage_error(what, f"expected {' or '.join(members)}, not '{name}'")
    return members[name]


class Samples:
    """Array in memory, in a file, or computed on demand."""

    #: Element type.
    dtype: "np.dtype[Any]" = np.dtype(np.float32)

    @property
    def shape(self) -> tuple[int, ...]:
        """Lengths of the axes."""
        raise NotImplementedError

    def read(self, key: Any = (), progress: Any = None) -> "np.ndarray[Any, Any]":
        """Returns the elements selected by slices and integers. Reads or computes only the range that contains them."""
        raise NotImplementedError

    @property
    def ndim(self) -> int:
        """Number of axes."""
        return len(self.shape)

    @property
    def size(self) -> int:
        """Number of elements."""
        return int(np.prod(self.shape, dtype=np.int64))

    @property
    def nbytes(self) -> int:
        """Size of all elements in bytes."""
        return self.dtype.itemsize * self.size

    def __len__(self) -> int:
        return self.shape[0]

    def __getitem__(self, key: Any) -> "np.ndarray[Any, Any]":
        return self.read(key)

    def __array__(self, dtype: Any = None) -> "np.ndarray[Any, Any]":
        values = self.read()
        return values if dtype is None else values.astype(dtype, copy=False)

    def __dlpack__(self, stream: Any = None) -> Any:
        return np.asarray(self).__dlpack__()

    def __dlpack_device__(self) -> tuple[int, int]:
        return 1, 0  # CPU memory
