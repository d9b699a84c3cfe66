// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram.h"

namespace hogel {

std::vector<Channel> mono(double wavelength) { return {{wavelength, 0}}; }

std::vector<Channel> rgb(double red, double green, double blue) { return {{red, 0}, {green, 1}, {blue, 2}}; }

std::optional<double> line_pitch(const HologramMethod& method) {
    if (const auto* lines = std::get_if<Lines>(&method)) return lines->line_pitch;
    if (const auto* basis = std::get_if<Basis>(&method)) return basis->line_pitch;
    return std::nullopt;
}

bool needs_depth(const HologramMethod& method) {
    if (const auto* own_method = std::get_if<OwnMethod>(&method)) return own_method->needs_depth;
    return std::holds_alternative<PhaseAdded>(method) || std::holds_alternative<OverlapAdd>(method);
}

Table<HologramMethodInfo>& hologram_methods() {
    const auto row = [](const char* name, const char* text, const HologramMethod& method) {
        return HologramMethodInfo{name, text, method, needs_depth(method)};
    };
    static Table<HologramMethodInfo> methods(
        "hologram method",
        {
            row("fourier", "one Fourier transform per hogel, hogels side by side", Fourier{}),
            row("lines", "horizontal parallax only, one Fourier transform per line of a hogel", Lines{}),
            row("basis", "sum of basis fringes, weighted with the coefficients of a transform of each hogel", Basis{}),
            row("basis-lines", "horizontal parallax only, basis fringes of lines, weighted once per hogel",
                Basis{.line_pitch = 0}),
            row("phase-added", "one wave per ray with the phase of its point, at the nearest frequency",
                PhaseAdded{false}),
            row("phase-added-exact", "one wave per ray with the phase of its point, at its exact frequency",
                PhaseAdded{true}),
            row("olas", "sum of overlapping windows around the hogels", OverlapAdd{}),
        },
        "method");
    return methods;
}

}  // namespace hogel
