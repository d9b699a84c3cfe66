# SPDX-License-Identifier: Apache-2.0
"""Fields of other programs."""
from __future__ import annotations

import os
from typing import Any, Optional

from . import _core, units
from ._samples import choice
from .errors import UsageError


def description(
    values: Optional[str], phase_code: Any, imaginary: Any, phases: Any, zero: Optional[float], variable: str, conjugate: bool
) -> _core.ExternalField:
    what = _core.ExternalField()
    if phase_code is not None:
        what.phase_code = _core.parse_phase_code(phase_code) if isinstance(phase_code, str) else phase_code
        if phases is None:
            what.values = _core.ExternalField.Values.phase
    if values is not None:
        what.values = choice(_core.ExternalField.Values, values, "values")
    if imaginary is not None:
        what.imaginary = os.fspath(imaginary)
    if phases is not None:
        what.phases = os.fspath(phases)
    what.zero, what.variable, what.conjugate = zero, variable, conjugate
    return what


def external_fields(name: str, pitch: Any, wavelength: Any, what: _core.ExternalField) -> list[_core.FieldSource]:
    facts = _core.external_facts(name, what)
    if pitch is not None:
        what.pitch_x = what.pitch_y = units.length(pitch, "pitch")
    waves = list(facts.wavelengths) if wavelength is None else units.lengths(wavelength, "wavelength")
    if pitch is None and not facts.pitch_x > 0:
        raise UsageError(f"pitch: {name} does not say the distance of its samples")
    if len(waves) != facts.colours:
        raise UsageError(f"wavelength: {name} has {facts.colours} field{'' if facts.colours == 1 else 's'}, and {len(waves)} were said")
    fields = []
    for colour, wave in enumerate(waves):
        what.colour, what.wavelength = colour, wave
        fields.append(_core.open_external_field(name, what))
    return fields
