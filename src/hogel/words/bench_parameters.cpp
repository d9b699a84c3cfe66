// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "hogel/error.h"
#include "hogel/files.h"
#include "hogel/image.h"
#include "hogel/reconstruct.h"
#include "hogel/requests.h"
#include "hogel/units.h"
#include "hogel/words/texts.h"

namespace hogel {
namespace {

[[noreturn]] void refuse_bench(const std::string& parameter, const std::string& why) {
    throw Error(ErrorCode::usage, parameter, why);
}

constexpr const char* source_forms = "laser, led:520nm,30nm,0.5mm or sources:16,2mm";

// Returns what a pattern's file states for a wavelength, or nothing.
std::string stated(const std::string& input, const std::string& what, double wavelength) {
    if (file_kind(input) != FileKind::picture) return "";
    const std::string name = fmt::format("{} at {}", what, format_length(wavelength));
    for (const auto& [key, text] : read_metadata(input))
        if (key == name) return text;
    return "";
}

LightSource parsed_source(const std::string& text) {
    const std::size_t colon = text.find(':');
    const std::string kind = text.substr(0, colon);
    std::vector<std::string> values;
    for (std::size_t begin = colon; begin < text.size(); begin = std::min(text.find(',', begin + 1), text.size()))
        values.push_back(text.substr(begin + 1, text.find(',', begin + 1) - begin - 1));
    LightSource source;
    if (kind == "laser" && colon == std::string::npos) return source;
    if (kind == "led" && values.size() == 3) {
        source.kind = LightSource::Kind::led;
        source.wavelength = words::parse_positive_length(values[0], "the mean wavelength of the led");
        source.bandwidth = words::parse_positive_length(values[1], "the width of the led's spectrum");
        source.size = words::parse_positive_length(values[2], "the size of the led");
    } else if (kind == "sources" && values.size() == 2) {
        source.kind = LightSource::Kind::points;
        source.points = words::parse_count(values[0], "the number of sources");
        source.size = words::parse_positive_length(values[1], "the size of the sources");
    } else {
        refuse_bench("source", fmt::format("'{}' is none of {}", text, source_forms));
    }
    return source;
}

}  // namespace

LightSource parse_light_source(const std::string& text) {
    return with_parameter("source", [&] { return parsed_source(text); });
}

void BenchParameters::describe(const std::string& input, FieldParameters& field) const {
    if (device.empty()) return;
    const Modulator modulator = find_modulator(device);
    field.device_pitch = modulator.pitch;
    std::error_code status;
    if (field.is_external(input) || !std::filesystem::is_regular_file(input, status) ||
        file_kind(input) != FileKind::picture)
        return;
    if (modulator.modulation == "amplitude")
        field.values = "amplitude";
    else
        field.phase_code = modulator.phase_code.empty() ? phase_code_text({}) : modulator.phase_code;
}

void BenchParameters::resolve(const std::string& input, FieldParameters& field, const Parameters& table) {
    is_used = field.focal && field.reconstruct == "none";
    if (!is_used) {
        for (const char* name : {"source", "fill-factor", "zero-order-stop"})
            if (table.given(name))
                refuse_bench(table.look_up(name)->keyword(),
                             field.focal ? "is of the bench, which has no reconstruction; leave one out"
                                         : "is of the bench; add its lens by focal");
        return;
    }
    if (!field.is_external(input))
        refuse_bench("focal",
                     fmt::format("the bench photographs patterns, and {} is none; make one by 'hogel slm {} -o "
                                 "pattern.png --device NAME'",
                                 input, words::shell_word(input)));
    for (const char* name : {"eye", "gaze", "focus-tilt", "pupil", "f-number", "focal-length", "angle-of-view",
                             "resolution", "to-eye", "looks", "speckle", "camera", "preview", "film-distance",
                             "diffuser", "geometric", "wave", "pupil-samples", "reference-source"})
        if (table.given(name))
            refuse_bench(table.look_up(name)->keyword(), "does not act on the bench; leave it out, or leave out focal");
    field.is_reflectance = true;
}

double BenchParameters::power(const std::string& input, double wavelength) const {
    const double stated_power = parse_number(stated(input, "power", wavelength)).value_or(0);
    return stated_power > 0 ? stated_power : 1;
}

Bench BenchParameters::bench(const std::string& input, const FieldSource& pattern, const FieldParameters& field,
                             double focus) const {
    Bench bench{.focal_length = *field.focal, .zero_order_stop = zero_order_stop, .focus = focus};
    bench.source = parse_light_source(source);
    bench.fill_factor = fill_factor.value_or(1);
    if (!fill_factor && !device.empty())
        if (const double of_device = find_modulator(device).fill_factor; of_device > 0) bench.fill_factor = of_device;
    OrderSelection selection = field.selection();
    if (field.order.empty() && selection.radius == 0) {
        bench.aperture = parse_aperture(stated(input, "aperture", pattern.grid().wavelength)).value_or(Aperture{});
        return bench;
    }
    using Which = OrderSelection::Which;
    selection.without_mean = false;
    if (selection.which == Which::left || selection.which == Which::right) {
        const SelectedOrder brightest = select_order(pattern, selection);
        selection.frequency_x = brightest.frequency_x;
        selection.frequency_y = brightest.frequency_y;
    }
    const double distance = std::hypot(selection.frequency_x, selection.frequency_y);
    bench.aperture = {selection.frequency_x, 0.0 - selection.frequency_y,
                      selection.radius > 0 ? selection.radius : 0.5 * distance};
    return bench;
}

std::vector<std::string> BenchParameters::notes(const std::string& input, const Fields& patterns) const {
    if (device.empty()) return {};
    const Modulator modulator = find_modulator(device);
    const Grid& plane = patterns.front()->grid().plane;
    if (plane.width != modulator.width || plane.height != modulator.height ||
        std::abs(plane.pitch_x - modulator.pitch) > 1e-3 * modulator.pitch)
        refuse_bench("device", fmt::format("{} has {}x{} pixels of {}, but {} {}x{} of {}", input, plane.width,
                                           plane.height, format_length(plane.pitch_x), modulator.name, modulator.width,
                                           modulator.height, format_length(modulator.pitch)));
    std::vector<double> wavelengths;
    for (const auto& pattern : patterns) wavelengths.push_back(pattern->grid().wavelength);
    return notes_about(modulator, wavelengths);
}

void BenchParameters::declare(Parameters& parameters) {
    parameters.group("Bench");
    parameters
        .text(
            "--device", device, "NAME",
            "Modulator that shows the pattern, for its fill factor, and for the pitch and phase code of files that do "
            "not contain them")
        .knows(modulator_names())
        .no_default();
    const auto acts = [this] { return is_used; };
    parameters
        .text("--source", source, "SOURCE",
              "Light of the bench (--focal):"
              "\nlaser: one point"
              "\nled:NM,FWHM,SIZE: mean wavelength, width of its spectrum, and diameter"
              "\nsources:N,SIZE: N incoherent points in a disc of this diameter")
        .acts_if(acts);
    parameters
        .number("--fill-factor", fill_factor, "0..1",
                "Share of a pixel's area that modulates; the rest is a mirror (default: of the device, or 1)")
        .no_default()
        .acts_if(acts);
    parameters
        .number("--zero-order-stop", zero_order_stop, "CYCLES",
                "Radius of an opaque disc around frequency zero, cycles per pixel; 0: none")
        .acts_if([this] { return is_used && zero_order_stop > 0; });
}

}  // namespace hogel
