// SPDX-License-Identifier: Apache-2.0
// Modulator patterns, and pictures as raw pixel values.
#include "hogel/pattern.h"

#include <algorithm>

#include "arrays.h"
#include "core.h"
#include "hogel/bench.h"
#include "hogel/field.h"
#include "hogel/files.h"
#include "hogel/image.h"
#include "hogel/phase_code.h"
#include "hogel/requests.h"
#include "keywords.h"

namespace hogel::python {
namespace {

using py::arg;
using Source = std::shared_ptr<const FieldSource>;

void add_phase_codes(py::module_& module) {
    py::class_<PanelLevels>(module, "PanelLevels")
        .def(py::init<>())
        .def_readwrite("table", &PanelLevels::table)
        .def_readwrite("flipped_x", &PanelLevels::flipped_x)
        .def_readwrite("flipped_y", &PanelLevels::flipped_y)
        .def_readwrite("correction", &PanelLevels::correction);
    py::class_<PhaseCode>(module, "PhaseCode")
        .def(py::init([](double range, double offset, bool inverted, bool closed) {
                 return PhaseCode{range, offset, inverted, closed};
             }),
             arg("range") = PhaseCode().range, arg("offset") = 0.0, arg("inverted") = false, arg("closed") = false)
        .def_readwrite("range", &PhaseCode::range)
        .def_readwrite("offset", &PhaseCode::offset)
        .def_readwrite("inverted", &PhaseCode::inverted)
        .def_readwrite("closed", &PhaseCode::closed)
        .def("phase", &PhaseCode::phase, arg("level"), arg("levels"))
        .def("level", &PhaseCode::level, arg("phase"), arg("levels"));
    module.def("phase_codes", [] { return phase_codes().names(); });
    module.def("parse_phase_code", &parse_phase_code, arg("text"));
    module.def("phase_code_text", &phase_code_text, arg("code"));
}

void add_encodings(py::module_& module) {
    py::enum_<Encoding> kind(module, "Encoding");
    kind.value("phase", Encoding::phase)
        .value("double_phase", Encoding::double_phase)
        .value("gerchberg_saxton", Encoding::gerchberg_saxton)
        .value("gradient", Encoding::gradient)
        .value("supervised", Encoding::supervised)
        .value("intensity", Encoding::intensity)
        .value("bipolar", Encoding::bipolar)
        .value("burckhardt", Encoding::burckhardt)
        .value("lee", Encoding::lee)
        .value("binary", Encoding::binary);
    module.def("encodings", [] { return encodings().names(); });
    module.def(
        "encoding", [](const std::string& name) { return encodings().find(name).encoding; }, arg("name"));
    module.def("is_phase_only", &is_phase_only, arg("encoding"));
    py::class_<Modulator>(module, "Modulator")
        .def(
            py::init([](std::size_t width, std::size_t height, double pitch, unsigned levels, const std::string& name) {
                return Modulator{name, width, height, pitch, levels};
            }),
            arg("width"), arg("height"), arg("pitch"), arg("levels") = 256, arg("name") = "")
        .def_readonly("name", &Modulator::name)
        .def_readonly("width", &Modulator::width)
        .def_readonly("height", &Modulator::height)
        .def_readonly("pitch", &Modulator::pitch)
        .def_readonly("levels", &Modulator::levels)
        .def_readwrite("title", &Modulator::title)
        .def_readwrite("aliases", &Modulator::aliases)
        .def_readwrite("modulation", &Modulator::modulation)
        .def_readwrite("phase_code", &Modulator::phase_code)
        .def_readwrite("fill_factor", &Modulator::fill_factor)
        .def_readwrite("shortest_wavelength", &Modulator::shortest_wavelength)
        .def_readwrite("longest_wavelength", &Modulator::longest_wavelength)
        .def_readwrite("refresh_rate", &Modulator::refresh_rate)
        .def_readwrite("flip", &Modulator::flip)
        .def_readwrite("lut", &Modulator::lut)
        .def_readwrite("correction", &Modulator::correction)
        .def_readwrite("source", &Modulator::source)
        .def_readwrite("verified", &Modulator::verified)
        .def_readwrite("note", &Modulator::note)
        .def_readwrite("fault", &Modulator::fault);
    module.def("modulators", &modulator_names);
    module.def("find_modulator", &find_modulator, arg("name"));
}

// Raw pixel values of a picture and their maximum.
template <class Raw, class Values>
py::tuple numbers_of(Raw&& raw, Values Raw::*values, std::size_t largest) {
    return py::make_tuple(array_of(std::move(raw.*values)), largest);
}

// Levels as numbers of 8 bits, if these hold them.
py::object narrowed(Array<std::uint16_t, 2>&& levels, unsigned largest) {
    if (largest > 255) return array_of(std::move(levels));
    Array<std::uint8_t, 2> bytes(levels.shape());
    std::ranges::transform(levels.elements(), bytes.data(),
                           [](std::uint16_t level) { return static_cast<std::uint8_t>(level); });
    return array_of(std::move(bytes));
}

void add_raw_pixels(py::module_& module) {
    module.def(
        "write_levels",
        [](const std::filesystem::path& path, const py::array_t<std::uint16_t, py::array::c_style>& levels,
           std::size_t largest, const py::object& metadata) {
            const Metadata entries = metadata_of(metadata);
            const View<const std::uint16_t, 3> view(levels.data(), shape_of<3>(levels, "levels"));
            run(py::none(), [&](const Progress&) { write_levels(path, view, largest, entries); });
        },
        arg("path"), arg("levels"), arg("largest"), arg("metadata"));
    module.def("require_levels_name", &require_levels_name, arg("path"), arg("largest") = 255, arg("channels") = 1);
    module.def(
        "read_raw_pixels",
        [](const std::filesystem::path& path) {
            auto raw = run_for(py::none(), [&](const Progress&) { return read_raw_pixels(path); });
            const std::size_t levels = raw.levels;
            return numbers_of(std::move(raw), &RawPixels::values, levels);
        },
        arg("path"));
    module.def(
        "read_raw_channels",
        [](const std::filesystem::path& path) {
            auto raw = run_for(py::none(), [&](const Progress&) { return read_raw_channels(path); });
            const std::size_t largest = raw.largest;
            return numbers_of(std::move(raw), &RawChannels::values, largest);
        },
        arg("path"));
}

void add_pattern_keywords(py::module_& module) {
    using Asked = Keywords<PatternParameters>;
    py::class_<SuitablePatterns, std::shared_ptr<SuitablePatterns>>(module, "SuitablePatterns")
        .def_readonly("encoding", &SuitablePatterns::encoding)
        .def_property_readonly("patterns",
                               [](const std::shared_ptr<SuitablePatterns>& encoded) {
                                   std::vector<std::shared_ptr<Pattern>> patterns;
                                   for (Pattern& pattern : encoded->patterns) patterns.emplace_back(encoded, &pattern);
                                   return patterns;
                               })
        .def_readonly("quality", &SuitablePatterns::quality);
    module.def("pattern_keywords", [] { return described(Asked().table); });
    module.def(
        "pattern_options", [](const py::dict& keywords) { return Asked(keywords).values.options(); }, arg("keywords"));
    module.def(
        "encode_patterns",
        [](const py::dict& keywords, const Fields& fields, const py::object& report) {
            const Asked asked(keywords);
            return run_for(report, [&](const Progress& p) {
                return std::make_shared<SuitablePatterns>(asked.values.encode(fields, p));
            });
        },
        arg("keywords"), arg("fields"), arg("report"));
    module.def(
        "encode_light_field",
        [](const py::dict& keywords, const LightField& light_field, HologramRequest request, const py::object& report) {
            const Asked asked(keywords);
            request.looks = asked.values.looks();
            return run_for(report, [&](const Progress& p) {
                return std::make_shared<SuitablePatterns>(
                    asked.values.encode(make_holograms(light_field, request), light_field, request, p));
            });
        },
        arg("keywords"), arg("light_field"), arg("request"), arg("report"));
    module.def(
        "pattern_record",
        [](const py::dict& keywords, Encoding chosen) {
            Asked asked(keywords);
            asked.values.resolve(chosen);
            return asked.table.acting();
        },
        arg("keywords"), arg("chosen"));
    module.def(
        "panel_levels",
        [](const py::dict& keywords, const SuitablePatterns& encoded, const Fields& fields) {
            std::vector<py::object> arrays;
            for (Array<std::uint16_t, 2>& levels : Asked(keywords).values.panel_levels(encoded, fields))
                arrays.push_back(narrowed(std::move(levels), encoded.patterns[0].max_level));
            return arrays;
        },
        arg("keywords"), arg("encoded"), arg("fields"));
    module.def(
        "pattern_notes",
        [](const py::dict& keywords, const Fields& fields) { return Asked(keywords).values.notes(fields); },
        arg("keywords"), arg("fields"));
    module.def(
        "pattern_metadata",
        [](const py::dict& keywords, const SuitablePatterns& encoded, const Fields& fields) {
            return Asked(keywords).values.metadata(encoded, fields);
        },
        arg("keywords"), arg("encoded"), arg("fields"));
}

void add_bench(py::module_& module) {
    py::class_<LightSource> source(module, "LightSource");
    py::enum_<LightSource::Kind>(source, "Kind")
        .value("laser", LightSource::Kind::laser)
        .value("led", LightSource::Kind::led)
        .value("points", LightSource::Kind::points);
    source.def(py::init<>())
        .def_readwrite("kind", &LightSource::kind)
        .def_readwrite("size", &LightSource::size)
        .def_readwrite("points", &LightSource::points)
        .def_readwrite("wavelength", &LightSource::wavelength)
        .def_readwrite("bandwidth", &LightSource::bandwidth);
    py::class_<Bench>(module, "Bench")
        .def(py::init<>())
        .def_readwrite("focal_length", &Bench::focal_length)
        .def_readwrite("aperture", &Bench::aperture)
        .def_readwrite("zero_order_stop", &Bench::zero_order_stop)
        .def_readwrite("focus", &Bench::focus)
        .def_readwrite("fill_factor", &Bench::fill_factor)
        .def_readwrite("source", &Bench::source);
    py::class_<BenchPhotograph>(module, "BenchPhotograph")
        .def_readonly("picture", &BenchPhotograph::picture)
        .def_readonly("contrast", &BenchPhotograph::contrast)
        .def_readonly("efficiency", &BenchPhotograph::efficiency)
        .def_readonly("resolution", &BenchPhotograph::resolution)
        .def_readonly("points", &BenchPhotograph::points)
        .def_readonly("wavelengths", &BenchPhotograph::wavelengths)
        .def_readonly("is_converged", &BenchPhotograph::is_converged);
    module.def("parse_light_source", &parse_light_source, arg("text"));
    module.def("parse_aperture", &parse_aperture, arg("text"));
    module.def(
        "photograph_on_bench",
        [](const Source& pattern, const Bench& bench, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return photograph_on_bench(*pattern, bench, p); });
        },
        arg("pattern"), arg("bench"), arg("report"));
}

}  // namespace

void add_patterns(py::module_& module) {
    add_phase_codes(module);
    add_encodings(module);
    add_raw_pixels(module);
    py::class_<PatternOptions>(module, "PatternOptions")
        .def(py::init([](const Modulator& modulator) {
                 PatternOptions options;
                 options.modulator = modulator;
                 return options;
             }),
             arg("modulator"))
        .def_readwrite("modulator", &PatternOptions::modulator)
        .def_readwrite("encoding", &PatternOptions::encoding)
        .def_readwrite("reference_angle", &PatternOptions::reference_angle)
        .def_readwrite("clip", &PatternOptions::clip)
        .def_readwrite("window", &PatternOptions::window)
        .def_readwrite("iterations", &PatternOptions::iterations)
        .def_readwrite("phase_code", &PatternOptions::phase_code);
    py::class_<Aperture>(module, "Aperture")
        .def(py::init([](double x, double y, double radius) {
                 return Aperture{x, y, radius};
             }),
             arg("x"), arg("y"), arg("radius"))
        .def_readonly("x", &Aperture::x)
        .def_readonly("y", &Aperture::y)
        .def_readonly("radius", &Aperture::radius);
    add_bench(module);
    py::class_<PupilQuality>(module, "PupilQuality")
        .def_readonly("psnr", &PupilQuality::psnr)
        .def_readonly("lowest_psnr", &PupilQuality::lowest_psnr)
        .def_readonly("psnr_middle", &PupilQuality::psnr_middle)
        .def_readonly("psnr_outside", &PupilQuality::psnr_outside)
        .def_readonly("ssim", &PupilQuality::ssim)
        .def_readonly("contrast", &PupilQuality::contrast)
        .def_readonly("efficiency", &PupilQuality::efficiency)
        .def_readonly("power", &PupilQuality::power);
    module.def("describe", py::overload_cast<const Aperture&, double>(&describe), arg("aperture"), arg("per_cycle"));
    py::class_<Pattern, std::shared_ptr<Pattern>>(module, "Pattern")
        .def_property_readonly("values",
                               [](const std::shared_ptr<Pattern>& p) {
                                   return array_over(p->values.data(), p->values.shape(), py::cast(p));
                               })
        .def_property_readonly(
            "levels", [](const Pattern& p) { return narrowed(Array<std::uint16_t, 2>(p.levels), p.max_level); })
        .def_readonly("max_level", &Pattern::max_level)
        .def_readonly("efficiency", &Pattern::efficiency)
        .def_readonly("light_field_efficiency", &Pattern::light_field_efficiency)
        .def_readonly("reference_angle", &Pattern::reference_angle)
        .def_readonly("iterations", &Pattern::iterations)
        .def_readonly("aperture", &Pattern::aperture)
        .def_readonly("correlation", &Pattern::correlation)
        .def_readonly("power", &Pattern::power);
    module.def(
        "suitable_encoding",
        [](const Source& field, const PatternOptions& options) {
            return run_for(py::none(), [&](const Progress&) { return suitable_encoding(*field, options); });
        },
        arg("field"), arg("options"));
    add_pattern_keywords(module);
    module.def(
        "transmission",
        [](const Pattern& pattern, Encoding encoding, const PhaseCode& code) {
            return array_of(transmission(pattern, encoding, code));
        },
        arg("pattern"), arg("encoding"), arg("phase_code") = PhaseCode());
}

}  // namespace hogel::python
