// SPDX-License-Identifier: Apache-2.0
// Files written in parts by several processes.
#include "hogel/pipeline.h"

#include "core.h"

namespace hogel::python {

void add_file_parts(py::module_& module) {
    using py::arg;
    py::class_<FilePart>(module, "FilePart")
        .def(py::init([](std::size_t number, std::size_t count, const std::string& input) {
                 return FilePart{number, count, input};
             }),
             arg("number"), arg("count"), arg("input") = "")
        .def_readwrite("number", &FilePart::number)
        .def_readwrite("count", &FilePart::count)
        .def_readwrite("input", &FilePart::input);
    module.def(
        "write_light_field_part",
        [](const std::filesystem::path& path, const LightField& light_field, bool single, bool with_depth,
           const py::object& metadata, const FilePart& part, const py::object& report) {
            LightFieldFileOptions options;
            options.type = single ? SampleType::single : SampleType::half;
            options.with_depth = with_depth;
            options.metadata = metadata_of(metadata);
            run(report, [&](const Progress& p) { write_light_field_part(path, light_field, options, part, p); });
        },
        arg("path"), arg("light_field"), arg("single"), arg("with_depth"), arg("metadata"), arg("part"), arg("report"));
    module.def(
        "write_holograms_part",
        [](const std::filesystem::path& path, const Fields& holograms, bool half, const py::object& metadata,
           const FilePart& part, const py::object& report) {
            HologramFileOptions options;
            options.type = half ? SampleType::half : SampleType::single;
            options.metadata = metadata_of(metadata);
            run(report, [&](const Progress& p) { write_holograms_part(path, holograms, options, part, p); });
        },
        arg("path"), arg("holograms"), arg("half"), arg("metadata"), arg("part"), arg("report"));
    module.def(
        "join_parts",
        [](const std::filesystem::path& path, const std::vector<std::filesystem::path>& parts,
           const py::object& report) { run(report, [&](const Progress& p) { join_parts(path, parts, p); }); },
        arg("path"), arg("parts"), arg("report"));
}

}  // namespace hogel::python
