# SPDX-License-Identifier: Apache-2.0
"""Fields of other programs."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Optional

from . import _core, _record, units
from ._samples import choice
from .errors import usage_error

#: What real numbers are, by the words of the command line.
VALUES = ("amplitude", "phase", "intensity", "real-imaginary", "amplitude-phase")


def description(
    values: Optional[str], phase_code: Any, imaginary: Any, phases: Any, zero: Optional[float], variable: str, conjugate: bool
) -> _core.ExternalField:
    """What the numbers of a file mean, as `hogel photo` takes it."""
    what = _core.ExternalField()
    if phase_code is not None:
        what.phase_code = _core.parse_phase_code(phase_code) if isinstance(phase_code, str) else phase_code
        if phases is None:
            what.values = _core.ExternalField.Values.phase
    if values is not None:
        if values not in VALUES:
            raise usage_error("values", f"{' or '.join(VALUES)} were expected, not '{values}'")
        # Intensities are amplitudes whose mean is taken away.
        name = "amplitude" if values == "intensity" else values.replace("-", "_")
        what.values = choice(_core.ExternalField.Values, name, "values")
    if imaginary is not None:
        what.imaginary = os.fspath(imaginary)
    if phases is not None:
        what.phases = os.fspath(phases)
    what.zero, what.variable, what.conjugate = zero, variable, conjugate
    return what


def external_fields(name: str, pitch: Any, wavelength: Any, what: _core.ExternalField) -> list[_core.FieldSource]:
    """The fields of a file, one for each wavelength."""
    facts = _core.external_facts(name, what)
    if what.variable and facts.format not in ("npz", "mat", "exr"):
        raise usage_error("variable", f"{name} has no variables with names")
    if pitch is not None:
        what.pitch_x = what.pitch_y = units.length(pitch, "pitch")
    elif not facts.pitch_x > 0:
        raise usage_error("pitch", f"{name} does not say the distance of its samples")
    waves = list(facts.wavelengths) if wavelength is None else units.lengths(wavelength, "wavelength")
    if len(waves) != facts.colours:
        raise usage_error("wavelength", f"{name} has {facts.colours} field{'' if facts.colours == 1 else 's'}, and {len(waves)} were said")
    fields = []
    for colour, wave in enumerate(waves):
        what.colour, what.wavelength = colour, wave
        fields.append(_core.open_external_field(name, what))
    return fields


def external_record(name: str, what: _core.ExternalField, **given: Any) -> _record.Record:
    """The options that acted when a file was opened, as the command line says them."""
    facts = _core.external_facts(name, what)
    acted = {"input": name, "conjugate": _record.words(what.conjugate)}
    if given["pitch"] is not None:
        acted["pitch"] = _record.length(given["pitch"])
    elif facts.pitch_x == facts.pitch_y:
        acted["pitch"] = _record.length(facts.pitch_x)
    waves = given["wavelength"]
    acted["wavelength"] = ",".join(map(_record.length, facts.wavelengths)) if waves is None else _record.length(waves)
    for option in "phase-code", "imaginary", "phases", "variable":
        value = given[option.replace("-", "_")]
        if value:
            acted[option] = os.fspath(value) if isinstance(value, (str, os.PathLike)) else "own"
    # A phase code alone says that numbers are phases; files of patterns say what their numbers are.
    if given["phase_code"] is None:
        if facts.phase_code and given["values"] in (None, "phase"):
            acted["phase-code"] = facts.phase_code
        elif given["values"] is not None or facts.values:
            acted["values"] = given["values"] or facts.values
    if given["imaginary"] is not None:
        # Numbers that are not whole have the zero 0.
        whole = facts.numbers.startswith("whole")
        acted["zero"] = _record.number(what.zero) if what.zero is not None else "median" if whole else "0"
    return acted


def reconstructed(
    fields: list[_core.FieldSource],
    values: Optional[str],
    order: Optional[str],
    aperture: float,
    reference_source: Any,
    reconstruct: str,
    focal: Any,
) -> tuple[list[_core.FieldSource], _record.Record]:
    """The object's order of recorded fields, and the image that a lens makes of it; and the options that acted."""
    from .field import Field

    if reconstruct not in ("none", "fourier", "fresnel"):
        raise usage_error("reconstruct", f"none or fourier or fresnel were expected, not '{reconstruct}'")
    if (reconstruct != "none") != (focal is not None):
        raise usage_error("reconstruct, focal", "belong together: what is between the hologram and its image, and how long it is")
    acted: _record.Record = {}
    if order is not None:
        acted["order"] = order
    if aperture:
        acted["aperture"] = _record.number(aperture)
    if reference_source is not None:
        acted["reference-source"] = _record.length(reference_source)
    if reconstruct != "none":
        acted.update(reconstruct=reconstruct, focal=_record.length(focal))
    made = [Field(field, "") for field in fields]
    if order is not None or aperture or values == "intensity" or reference_source is not None:
        which, at = _order_of(order)
        made = [
            field.select_order(which, at=at, aperture=aperture, without_mean=values == "intensity", reference_source=reference_source)
            for field in made
        ]
    if reconstruct != "none":
        made = [getattr(field, f"{reconstruct}_image")(focal) for field in made]
    return [field._source for field in made], acted


def _order_of(order: Optional[str]) -> tuple[str, Optional[Sequence[float]]]:
    names = {None: "center", "0": "center", "+1": "right", "-1": "left"}
    if order in names:
        return names[order], None
    try:
        x, y = map(float, str(order).split(","))
    except ValueError:
        raise usage_error("order", f"'{order}' is none of +1, -1, 0 and FX,FY in cycles per sample, e.g. 0.25,0") from None
    return "at", (x, y)
