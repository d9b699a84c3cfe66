// SPDX-License-Identifier: Apache-2.0
#include "bench/patterns/patterns.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "bench/measure.h"
#include "hogel/hologram.h"
#include "hogel/pattern.h"
#include "hogel/pipeline.h"
#include "hogel/requests.h"
#include "hogel/resources.h"

namespace hogel::bench {
namespace {

constexpr double wavelength = 520e-9;

// Returns the hologram of a scene that `hogel slm` makes for a modulator, in memory.
std::shared_ptr<const Field> hologram_of(const PatternBenchOptions& options, const Modulator& modulator, bool smooth) {
    HologramParameters hologram;
    hologram.wavelengths = {wavelength};
    if (smooth) hologram.method = "olas", hologram.phase = "fixed";
    LightFieldParameters light_field;
    hologram.fit(modulator, light_field, smooth);
    const LightFieldRequest request = light_field.request();
    const LightField rendered = render_light_field(hogel::load_scene(options.scene, request), request);
    const LightField rays = prepare_for_reading(rendered, 2, true, until_interrupted());
    const Fields fields = make_holograms(rays, hologram.request(rays.grids(), 1, 1));
    auto field = std::make_shared<Field>(fields.front()->grid());
    const Grid& plane = field->grid().plane;
    fields.front()->read({0, 0, plane.width, plane.height}, 0, field->samples);
    return field;
}

std::vector<EncodingInfo> chosen_encodings(const std::vector<std::string>& names) {
    std::vector<EncodingInfo> chosen;
    for (const std::string& name : names) chosen.push_back(encodings().find(name));
    if (names.empty()) {
        chosen = encodings().rows();
        std::erase_if(chosen, [](const EncodingInfo& row) { return row.encoding == Encoding::supervised; });
    }
    return chosen;
}

}  // namespace

void measure_patterns(const PatternBenchOptions& options, const Session& session) {
    const std::vector<EncodingInfo> chosen = chosen_encodings(options.encodings);
    PatternOptions pattern;
    pattern.modulator = find_modulator(options.device);
    const double pixels = static_cast<double>(pattern.modulator.width * pattern.modulator.height);
    fmt::print("Patterns of {} for {}: {}x{} pixels, {} threads, median of {}\n\n", options.scene,
               pattern.modulator.name, pattern.modulator.width, pattern.modulator.height, thread_count(),
               options.rounds);
    fmt::print(
        "| phases | encoding | time, s | Mpixels/s | Mpixels/s a processor | efficiency | correlation |\n"
        "|---|---|---|---|---|---|---|\n");
    for (const bool smooth : {true, false}) {
        session.detail(fmt::format("the hologram with {} phases", smooth ? "smooth" : "random"));
        const auto field = hologram_of(options, pattern.modulator, smooth);
        for (const EncodingInfo& info : chosen) {
            if (!smooth && !info.phase_only) continue;  // off-axis encodings do not separate such a wide band
            session.detail(info.name);
            pattern.encoding = info.encoding;
            pattern.modulator.modulation = info.phase_only ? "phase" : "amplitude";
            Pattern made;
            const Times times =
                median_time_of([&] { made = encode_pattern(*field, pattern, until_interrupted()); }, options.rounds);
            fmt::print("| {} | {} | {:.3f} | {:.1f} | {:.1f} | {:.4f} | {} |\n", smooth ? "smooth" : "random",
                       info.name, times.wall, pixels / times.wall / 1e6, pixels / times.processor / 1e6,
                       made.efficiency, info.phase_only ? fmt::format("{:.4f}", made.correlation) : "");
        }
    }
}

}  // namespace hogel::bench
