# SPDX-License-Identifier: Apache-2.0
"""Light fields and holograms in hogel's files, as docs/files.md describes them."""
import h5py
import numpy as np


def write_light_field(path, radiance, hogel_pitch, half_u, half_v=None, depth=None, sines=False, centre=(0, 0)):
    """`radiance` is [c][t][s][v][u], `depth` [t][s][v][u]. Directions fill the tangents, or the sines, to half_u and half_v
    around `centre`."""
    kind = "sine" if sines else "tan"
    with h5py.File(path, "w", libver="v108") as file:
        file.attrs["format"], file.attrs["format_version"] = "hogel light field", np.uint64(1)
        data = file.create_dataset("radiance", data=np.asarray(radiance, "f4"))
        data.attrs["axis_order"] = "c,t,s,v,u"
        for name, count in zip(("channels", "hogels_t", "hogels_s", "directions_v", "directions_u"), data.shape):
            data.attrs[name] = np.uint64(count)
        data.attrs["hogel_pitch_m"] = float(hogel_pitch)
        data.attrs[f"{kind}_half_u"] = float(half_u)
        data.attrs[f"{kind}_half_v"] = float(half_u if half_v is None else half_v)
        data.attrs["center_u"], data.attrs["center_v"] = map(float, centre)
        if depth is not None:
            data = file.create_dataset("depth", data=np.asarray(depth, "f4"))
            data.attrs["axis_order"], data.attrs["unit"] = "t,s,v,u", "m"


def add_side(path, name, radiance, hogel_pitch, half, centre):
    """A side of a hemicube; `half` and `centre` are pairs, along U and V."""
    with h5py.File(path, "a", libver="v108") as file:
        data = file.create_dataset(f"{name}/radiance", data=np.asarray(radiance, "f4"))
        data.attrs["axis_order"], data.attrs["face"] = "c,t,s,v,u", name
        for key, count in zip(("channels", "hogels_t", "hogels_s", "directions_v", "directions_u"), data.shape):
            data.attrs[key] = np.uint64(count)
        data.attrs["hogel_pitch_m"] = float(hogel_pitch)
        for axis, width, middle in zip("uv", half, centre):
            data.attrs[f"tan_half_{axis}"], data.attrs[f"center_{axis}"] = float(width), float(middle)


def read_radiance(path):
    with h5py.File(path) as file:
        return file["radiance"][()].astype(float)


def write_field(path, field, pitch, wavelength):
    """`field` is [y][x] around the origin."""
    with h5py.File(path, "w", libver="v108") as file:
        file.attrs["format"], file.attrs["format_version"] = "hogel hologram", np.uint64(1)
        data = file.create_dataset("field0/samples", data=field.astype(np.complex64))
        data.attrs["axis_order"] = "y,x"
        for name, value in (("wavelength_m", wavelength), ("pitch_x_m", pitch), ("pitch_y_m", pitch), ("center_x_m", 0),
                            ("center_y_m", 0), ("z_m", 0)):
            data.attrs[name] = float(value)


def read_field(path):
    with h5py.File(path) as file:
        return file["field0/samples"][()].astype(complex)


def positions(samples, pitch):
    """Of the samples along a side around the origin, from the left; rows from the top have the opposite sign."""
    return (np.arange(samples) - (samples - 1) / 2) * pitch
