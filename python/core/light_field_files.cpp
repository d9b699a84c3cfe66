// SPDX-License-Identifier: Apache-2.0
// Light fields in files: HDF5, compressed files, sets of views.
#include "arrays.h"
#include "core.h"
#include "hogel/compress.h"
#include "hogel/files.h"
#include "hogel/pipeline.h"
#include "keywords.h"

namespace hogel::python {
namespace {

using py::arg;

py::dict dictionary_of(const CompressionResult& result) {
    py::dict facts;
    facts["bytes"] = result.bytes;
    facts["sqnr"] = result.sqnr;
    facts["pixels_per_bit"] = result.pixels_per_bit;
    facts["step"] = result.step;
    facts["passes"] = result.passes;
    facts["depth_bytes"] = result.depth_bytes;
    facts["depth_error"] = result.depth_error;
    return facts;
}

void add_methods(py::module_& module) {
    py::enum_<QuantisationTable>(module, "QuantisationTable")
        .value("own", QuantisationTable::own)
        .value("jpeg", QuantisationTable::jpeg);
    py::enum_<ZerotreeSymbols>(module, "ZerotreeSymbols")
        .value("bits", ZerotreeSymbols::bits)
        .value("alphabets", ZerotreeSymbols::alphabets);
    py::enum_<RateRule>(module, "RateRule")
        .value("search", RateRule::search)
        .value("histogram", RateRule::histogram)
        .value("planes", RateRule::planes);
    py::enum_<StreamLayout>(module, "StreamLayout")
        .value("faces", StreamLayout::faces)
        .value("unfolded", StreamLayout::unfolded)
        .value("stacked", StreamLayout::stacked);
    py::class_<CodingMethod>(module, "CodingMethod")
        .def(py::init<>())
        .def_readwrite("coder", &CodingMethod::coder)
        .def_readwrite("transform", &CodingMethod::transform)
        .def_readwrite("table", &CodingMethod::table)
        .def_readwrite("symbols", &CodingMethod::symbols);
    py::class_<Sqnr>(module, "Sqnr")
        .def(py::init<double>(), arg("decibels"))
        .def_readwrite("decibels", &Sqnr::decibels);
    py::class_<PixelsPerBit>(module, "PixelsPerBit")
        .def(py::init([](double rate, RateRule rule, std::optional<double> overhead) {
                 return PixelsPerBit{rate, rule, overhead};
             }),
             arg("rate"), arg("rule") = RateRule::search, arg("overhead") = py::none())
        .def_readwrite("rate", &PixelsPerBit::rate)
        .def_readwrite("rule", &PixelsPerBit::rule)
        .def_readwrite("overhead", &PixelsPerBit::overhead);
    py::class_<Step>(module, "Step")
        .def(py::init<double>(), arg("radiance"))
        .def_readwrite("radiance", &Step::radiance);
    py::class_<MaxError>(module, "MaxError")
        .def(py::init<double>(), arg("radiance"))
        .def_readwrite("radiance", &MaxError::radiance);
    py::class_<Lossless>(module, "Lossless").def(py::init<>());
}

void add_compression_keywords(py::module_& module) {
    using Asked = Keywords<CompressionParameters>;
    module.def("compression_keywords", [] { return described(Asked().table); });
    module.def(
        "compression_options",
        [](const py::dict& keywords, const LightField& light_field) {
            return Asked(keywords).values.options(light_field);
        },
        arg("keywords"), arg("light_field"));
    module.def(
        "compression_record",
        [](const py::dict& keywords, const LightField& light_field) {
            Asked asked(keywords);
            asked.values.resolve(light_field);
            return asked.table.acting();
        },
        arg("keywords"), arg("light_field"));
}

}  // namespace

void add_light_field_files(py::module_& module) {
    module.def(
        "open_light_field",
        [](const std::filesystem::path& path, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return open_light_field_or_views(path, p); });
        },
        arg("path"), arg("report"));
    module.def(
        "open_stream",
        [](const std::filesystem::path& path, std::size_t memory, std::size_t layers) {
            return run_for(py::none(), [&](const Progress&) { return open_stream(path, {memory, layers}); });
        },
        arg("path"), arg("memory") = StreamOptions().memory, arg("layers") = 0);
    module.def("is_stream", &is_stream, arg("path"));
    module.def(
        "open_coefficients",
        [](const std::filesystem::path& path) {
            return run_for(py::none(), [&](const Progress&) { return open_coefficients(path); });
        },
        arg("path"));
    module.def("require_folder_name", &require_folder_name, arg("path"));
    module.def("write_text", &write_text, arg("file"), arg("text"));
    module.def(
        "write_light_field",
        [](const std::filesystem::path& path, const LightField& light_field, bool single, bool with_depth,
           const py::object& metadata, const std::optional<std::string>& resume, const py::object& report) {
            LightFieldFileOptions options;
            options.type = single ? SampleType::single : SampleType::half;
            options.with_depth = with_depth;
            options.metadata = metadata_of(metadata);
            options.resume = resume;
            run(report, [&](const Progress& p) { write_light_field(path, light_field, options, p); });
        },
        arg("path"), arg("light_field"), arg("single"), arg("with_depth"), arg("metadata"), arg("resume"),
        arg("report"));
    module.def(
        "bytes_of_hogels",
        [](const std::filesystem::path& path, std::size_t layers, const py::object& report) {
            return array_of(run_for(report, [&](const Progress& p) { return bytes_of_hogels(path, layers, p); }));
        },
        arg("path"), arg("layers") = 0, arg("report") = py::none());
    module.def("every_nth_hogel", &every_nth_hogel, arg("light_field"), arg("n"));
    module.def(
        "read_stream_info",
        [](const std::filesystem::path& path) {
            const StreamInfo info = read_stream_info(path);
            py::dict facts;
            facts["coder"] = info.method.coder;
            facts["transform"] = info.method.transform;
            facts["tile"] = py::make_tuple(info.tile.ns, info.tile.nt);
            facts["layers"] = info.layer_ends.size();
            facts["layers_there"] = info.layers_there;
            facts["layer_ends"] = info.layer_ends;
            facts["chrominance"] = info.chrominance;
            facts["version"] = info.version;
            return facts;
        },
        arg("path"));
}

void add_compression(py::module_& module) {
    add_methods(module);
    add_compression_keywords(module);
    py::class_<CompressionOptions>(module, "CompressionOptions")
        .def(py::init<>())
        .def_readwrite("method", &CompressionOptions::method)
        .def_readwrite("target", &CompressionOptions::target)
        .def_property(
            "tile",
            [](const CompressionOptions& o) {
                return o.tile ? std::optional(std::pair(o.tile->ns, o.tile->nt)) : std::nullopt;
            },
            [](CompressionOptions& o, const std::optional<std::pair<std::size_t, std::size_t>>& columns_and_rows) {
                o.tile.reset();
                if (columns_and_rows) o.tile = HogelRange{0, 0, columns_and_rows->first, columns_and_rows->second};
            })
        .def_property(
            "metadata", [](const CompressionOptions& o) { return o.metadata; },
            [](CompressionOptions& o, const py::object& m) { o.metadata = metadata_of(m); })
        .def_readwrite("layout", &CompressionOptions::layout)
        .def_readwrite("with_depth", &CompressionOptions::with_depth)
        .def_readwrite("depth_error", &CompressionOptions::depth_error)
        .def_readwrite("tone_decades", &CompressionOptions::tone_decades)
        .def_readwrite("chrominance", &CompressionOptions::chrominance);
    module.def(
        "compress",
        [](const LightField& light_field, const std::filesystem::path& path, const CompressionOptions& options,
           const py::object& report) {
            return dictionary_of(
                run_for(report, [&](const Progress& p) { return compress(light_field, path, options, p); }));
        },
        arg("light_field"), arg("path"), arg("options"), arg("report"));
    module.def("coders", [] { return coders().names(); });
    module.def(
        "coder_info",
        [](const std::string& name) {
            const CoderInfo& coder = coders().find(name);
            py::dict facts;
            facts["text"] = coder.text;
            facts["transform"] = coder.transform;
            facts["quantisation_table"] = coder.quantisation_table;
            facts["three_pass"] = coder.three_pass;
            return facts;
        },
        arg("name"));
    module.def("transform_names", &transform_names);
    module.def("default_overhead", &default_overhead, arg("symbols"));
    module.def("default_depth_error", &default_depth_error, arg("grid"), arg("range"));
}

}  // namespace hogel::python
