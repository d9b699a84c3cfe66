# SPDX-License-Identifier: Apache-2.0
"""Propagation as a differentiable function of torch. Importing hogel.autograd requires torch."""
from __future__ import annotations

from typing import Any

import numpy as np
import torch  # type: ignore[import]

from . import units
from .field import Field


class _Propagate(torch.autograd.Function):  # type: ignore[misc]
    # The signatures match torch's base class, for its types.
    @staticmethod
    def forward(ctx: Any, *args: Any, **kwargs: Any) -> Any:
        samples, pitch, wavelength, distance = args
        ctx.optics = pitch, wavelength, distance
        return _propagated(samples, pitch, wavelength, distance, adjoint=False)

    @staticmethod
    def backward(ctx: Any, *grad_outputs: Any) -> Any:
        (gradient,) = grad_outputs
        pitch, wavelength, distance = ctx.optics
        return _propagated(gradient, pitch, wavelength, distance, adjoint=True), None, None, None


def _propagated(samples: Any, pitch: float, wavelength: float, distance: float, adjoint: bool) -> Any:
    values = samples.detach().resolve_conj().to("cpu", torch.complex64).numpy()
    field = Field.from_array(values, pitch=pitch, wavelength=wavelength)
    propagated = field.propagate_adjoint(distance, progress=False) if adjoint else field.propagate(distance, progress=False)
    return torch.from_numpy(np.array(propagated)).to(samples.device, samples.dtype)


def propagate(samples: Any, *, pitch: units.Length, wavelength: units.Length, distance: units.Length) -> Any:
    """Propagates a complex field [y][x] by a distance along +z. Returns a tensor that torch can differentiate.

    >>> import hogel.autograd, torch
    >>> phase = torch.zeros(16, 16, requires_grad=True)
    >>> far = hogel.autograd.propagate(torch.exp(1j * phase), pitch="4um", wavelength="532nm", distance="1mm")
    >>> far.abs().square().sum().backward()
    >>> phase.grad.shape
    torch.Size([16, 16])
    """
    lengths = units.length(pitch, "pitch"), units.length(wavelength, "wavelength"), units.length(distance, "distance")
    return _Propagate.apply(samples, *lengths)
