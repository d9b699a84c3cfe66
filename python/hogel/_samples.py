# SPDX-License-Identifier: Apache-2.0
"""What light fields, their faces and fields have in common: arrays that are read when they are needed."""
from __future__ import annotations

import os
from typing import Any, Union

import numpy as np

from .errors import usage_error

Path = Union[str, "os.PathLike[str]"]


class _Lent:
    """Memory that was lent by DLPack, which NumPy takes for read-only, because DLPack does not say whether it is."""

    def __init__(self, values: "np.ndarray[Any, Any]") -> None:
        facts = values.__array_interface__
        self.values, self.__array_interface__ = values, {**facts, "data": (facts["data"][0], False)}


def array_of(values: Any, kind: Any) -> "np.ndarray[Any, Any]":
    """An array of NumPy of anything that lends its memory, by DLPack too (torch, cupy, jax); copied only to change the
    type of its numbers."""
    if not isinstance(values, np.ndarray) and hasattr(values, "__dlpack__"):
        values = np.asarray(_Lent(np.from_dlpack(values)))
    return np.require(values, dtype=kind, requirements="A")


def choice(kind: Any, name: str, what: str) -> Any:
    """The member of an enumeration by its name."""
    members = kind.__members__
    if name not in members:
        raise usage_error(what, f"{' or '.join(members)} were expected, not '{name}'")
    return members[name]


class Samples:
    """An array that is in memory, in a file, or computed when it is read."""

    #: The type of its elements.
    dtype: "np.dtype[Any]" = np.dtype(np.float32)

    @property
    def shape(self) -> tuple[int, ...]:
        """The lengths of the axes."""
        raise NotImplementedError

    def read(self, key: Any = (), progress: Any = None) -> "np.ndarray[Any, Any]":
        """The elements that slices and whole numbers take; no others are read or computed than those between them."""
        raise NotImplementedError

    @property
    def ndim(self) -> int:
        """The number of axes."""
        return len(self.shape)

    @property
    def size(self) -> int:
        """The number of elements."""
        return int(np.prod(self.shape, dtype=np.int64))

    @property
    def nbytes(self) -> int:
        """Bytes of all elements."""
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
        return 1, 0  # the processor's memory
