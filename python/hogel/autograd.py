# SPDX-License-Identifier: Apache-2.0
"""Propagation as a function of torch, with its gradient: import hogel.autograd needs torch."""
from __future__ import annotations

from typing import Any

import numpy as np
import torch  # type: ignore[import]

from . import units
from .field import Field


class _Propagate(torch.autograd.Function):  # type: ignore[misc]
    # Names and stars of the arguments are those of torch's class, for its types.
    @staticmethod
    def forward(ctx: Any, *args: Any, **kwargs: Any) -> Any:
        samples, pitch, wavelength, distance = args
        ctx.optics = pitch, wavelength, distance
        return _moved(samples, pitch, wavelength, distance, adjoint=False)

    @staticmethod
    def backward(ctx: Any, *grad_outputs: Any) -> Any:
        (gradient,) = grad_outputs
        pitch, wavelength, distance = ctx.optics
        return _moved(gradient, pitch, wavelength, distance, adjoint=True), None, None, None


def _moved(samples: Any, pitch: float, wavelength: float, distance: float, adjoint: bool) -> Any:
    values = samples.detach().resolve_conj().to("cpu", torch.complex64).numpy()
    field = Field.from_array(values, pitch=pitch, wavelength=wavelength)
    moved = field.propagate_adjoint(distance, progress=False) if adjoint else field.propagate(distance, progress=False)
    return torch.from_numpy(np.array(moved)).to(samples.device, samples.dtype)


def propagate(samples: Any, *, pitch: units.Length, wavelength: units.Length, distance: units.Length) -> Any:
    """The field [y][x] at a distance along +z, a tensor of complex numbers that torch can differentiate.

    >>> import hogel.autograd, torch
    >>> phase = torch.zeros(16, 16, requires_grad=True)
    >>> far = hogel.autograd.propagate(torch.exp(1j * phase), pitch="4um", wavelength="532nm", distance="1mm")
    >>> far.abs().square().sum().backward()
    >>> phase.grad.shape
    torch.Size([16, 16])
    """
    lengths = units.length(pitch, "pitch"), units.length(wavelength, "wavelength"), units.length(distance, "distance")
    return _Propagate.apply(samples, *lengths)
