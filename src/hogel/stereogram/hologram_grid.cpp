// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/hologram.h"
#include "hogel/stereogram/diffraction.h"
#include "hogel/units.h"

namespace hogel {

using stereogram::samples_per_hogel;

namespace {

// A hogel of width d needs a sample, and two directions with sines λ/d apart in −1 … 1.
void require_hogels_that_diffract(const LightFieldGrid& light_field, double wavelength, double pitch) {
    if (wavelength > 2 * light_field.pitch)
        throw Error(ErrorCode::usage, "wavelength",
                    fmt::format("at a wavelength of {} a hogel of {} does not resolve two directions; expected at "
                                "most twice the hogel, {}",
                                format_length(wavelength), format_length(light_field.pitch),
                                format_length(2 * light_field.pitch)));
    if (pitch > 2 * light_field.pitch)
        throw Error(ErrorCode::usage, "pitch",
                    fmt::format("a pitch of {} leaves a hogel of {} without samples; expected at "
                                "most the hogel",
                                format_length(pitch), format_length(light_field.pitch)));
}

// One wave per ray: rays farther apart than a hogel's lobes would leave gaps.
void require_enough_directions(const LightFieldGrid& light_field, double wavelength) {
    const double step = wavelength / light_field.pitch;
    if (std::max(light_field.step_u(), light_field.step_v()) <= step) return;
    const auto enough = [&](double half) { return std::ceil(2 * half / step); };
    throw Error(ErrorCode::usage, "method",
                fmt::format("a hogel of {} shows directions {:.4f} apart at {}, but the light field's are {:.4f} "
                            "apart; added phases need {}x{} directions or more",
                            format_length(light_field.pitch), step, format_length(wavelength),
                            std::max(light_field.step_u(), light_field.step_v()), enough(light_field.half_u()),
                            enough(light_field.half_v())));
}

void require_diffraction(const LightFieldGrid& light_field, double wavelength, double pitch) {
    const double needed = stereogram::steepest_sine(light_field), possible = wavelength / (2 * pitch);
    if (needed <= possible) return;
    const auto degrees = [](double sine) { return std::asin(std::min(sine, 1.0)) * 180 / std::numbers::pi; };
    throw Error(
        ErrorCode::usage, "fov, pitch",
        fmt::format("a pitch of {} diffracts {} no farther than {:.2f} degrees, but the light field reaches {:.2f}; "
                    "a field of view within {:.2f} degrees of the axis or a pitch of {} or less would do",
                    format_length(pitch), format_length(wavelength), degrees(possible), degrees(needed),
                    std::floor(100 * degrees(possible)) / 100,
                    format_length(stereogram::max_pitch(light_field, wavelength))));
}

void require_one_row(std::span<const LightFieldGrid> faces) {
    for (const LightFieldGrid& face : faces) {
        if (face.directions_v != 1)
            throw Error(ErrorCode::usage, "method",
                        fmt::format("a hologram with horizontal parallax only is made of one row of directions, but "
                                    "the light field has {}; {}x1 directions would do",
                                    face.directions_v, face.directions_u));
        if (face.face() == Face::top || face.face() == Face::bottom)
            throw Error(ErrorCode::usage, "method",
                        fmt::format("a hologram with horizontal parallax only cannot show the {} "
                                    "face; expected front, left or right",
                                    face_name(face.face())));
    }
}

// Returns the number of lines of a hogel that has `samples` along each line.
std::size_t lines_per_hogel(std::span<const LightFieldGrid> faces, double line_pitch, std::size_t samples) {
    if (!(line_pitch >= 0))
        throw Error(ErrorCode::usage, "line_pitch", "the distance of a hologram's lines must not be negative");
    require_one_row(faces);
    if (line_pitch == 0) return samples;
    return samples_per_hogel(faces.front(), line_pitch);
}

void require_supported(std::span<const LightFieldGrid> faces, const HologramOptions& options) {
    const bool sides = std::holds_alternative<Fourier>(options.method) ||
                       std::holds_alternative<Lines>(options.method) || std::holds_alternative<Basis>(options.method);
    if (faces.size() > 1 && !sides)
        throw Error(ErrorCode::usage, "method",
                    fmt::format("a hemicube of {} faces needs the method fourier, lines, basis or basis-lines; others "
                                "take a light field of one face",
                                faces.size()));
    if (needs_depth(options.method))
        require_perspective(faces.front(), ErrorCode::usage, "a hologram with phases by depth");
}

}  // namespace

FieldGrid hologram_grid(std::span<const LightFieldGrid> faces, const HologramOptions& options) {
    require_faces(faces);
    for (const LightFieldGrid& face : faces) validate(face, ErrorCode::usage, "light field");
    const LightFieldGrid& front = faces.front();
    require_common_directions(front, ErrorCode::usage, "a hologram");
    const auto& [wavelength, channel] = options.channel;
    if (!(options.pitch > 0) || !(wavelength > 0))
        throw Error(ErrorCode::usage, "pitch, wavelength", "a hologram needs a positive pitch and wavelength");
    validate(FieldGrid{{1, 1, options.pitch, options.pitch, 0, 0}, wavelength}, ErrorCode::usage, "hologram");
    if (channel >= front.channels)
        throw Error(ErrorCode::usage,
                    fmt::format("the light field has {} channels, so there is no channel {}", front.channels, channel));
    require_supported(faces, options);
    require_hogels_that_diffract(front, wavelength, options.pitch);
    const std::size_t n = samples_per_hogel(front, options.pitch);
    const double pitch = front.pitch / static_cast<double>(n);
    if (faces.size() == 1) require_diffraction(front, wavelength, pitch);
    const std::optional<double> lines = line_pitch(options.method);
    const std::size_t rows = lines ? lines_per_hogel(faces, *lines, n) : n;
    if (std::holds_alternative<PhaseAdded>(options.method)) require_enough_directions(front, wavelength);
    FieldGrid grid;
    grid.plane = {front.hogels_s * n, front.hogels_t * rows, pitch, front.pitch / static_cast<double>(rows), 0, 0};
    grid.wavelength = wavelength;
    validate(grid, ErrorCode::usage, "hologram");
    return grid;
}

}  // namespace hogel
