// SPDX-License-Identifier: Apache-2.0
// Sets of views, pictures for printers, and films.
#include "core.h"
#include "hogel/exchange.h"
#include "hogel/pipeline.h"
#include "keywords.h"

namespace hogel::python {
namespace {

using py::arg;

// Parameters of import_views(), from keywords.
struct ImportKeywords {
    ImportParameters values;
    Parameters table;

    explicit ImportKeywords(const py::dict& keywords) {
        table.flag("--depth", values.views.with_depth, "Store the depth of rays, by the disparity or depth of the set")
            .acts_if([this] { return values.views.with_depth; });
        values.declare(table);
        read_keywords(table, keywords);
    }
};

void add_import_keywords(py::module_& module) {
    module.def("import_keywords", [] { return described(ImportKeywords{py::dict()}.table); });
    module.def(
        "import_options",
        [](const py::dict& keywords, const std::filesystem::path& spool) {
            ViewImportOptions options = ImportKeywords(keywords).values.options();
            options.spool = spool;
            return options;
        },
        arg("keywords"), arg("spool"));
    module.def(
        "import_record",
        [](const py::dict& keywords, const ImportedViews& imported) {
            ImportKeywords asked(keywords);
            asked.values.resolve(imported);
            return asked.table.acting();
        },
        arg("keywords"), arg("imported"));
}

void add_export_keywords(py::module_& module) {
    using ExportKeywords = Keywords<ExportParameters>;
    module.def("export_keywords", [] { return described(ExportKeywords().table); });
    module.def(
        "export_request",
        [](const std::filesystem::path& target, const py::dict& keywords) {
            ExportKeywords asked(keywords);
            asked.values.resolve(target);
            return py::make_tuple(asked.values.options(), asked.values.frame_rate, asked.table.acting());
        },
        arg("target"), arg("keywords"));
}

void add_cameras_keywords(py::module_& module) {
    using CamerasKeywords = Keywords<CamerasParameters>;
    module.def("cameras_keywords", [] { return described(CamerasKeywords().table); });
    module.def(
        "cameras_grid", [](const py::dict& keywords) { return CamerasKeywords(keywords).values.grid(); },
        arg("keywords"));
}

void add_printer_images(py::module_& module) {
    using PrintKeywords = Keywords<PrintParameters>;
    module.def("print_keywords", [] { return described(PrintKeywords().table); });
    module.def(
        "print_record", [](const py::dict& keywords) { return PrintKeywords(keywords).table.acting(); },
        arg("keywords"));
    py::class_<PrinterImages>(module, "PrinterImages")
        .def_readonly("pictures", &PrinterImages::pictures)
        .def_readonly("first", &PrinterImages::first)
        .def_readonly("last", &PrinterImages::last)
        .def_readonly("manifest", &PrinterImages::manifest)
        .def_readonly("exposure", &PrinterImages::exposure)
        .def_readonly("bytes", &PrinterImages::bytes)
        .def_readonly("samples", &PrinterImages::samples)
        .def_readonly("clipped", &PrinterImages::clipped);
    module.def(
        "write_printer_images",
        [](const std::filesystem::path& folder, const LightField& light_field, const py::dict& keywords,
           const py::object& metadata, const py::object& report) {
            PrinterImageOptions options = PrintKeywords(keywords).values.options();
            options.metadata = metadata_of(metadata);
            return run_for(report,
                           [&](const Progress& p) { return write_printer_images(folder, light_field, options, p); });
        },
        arg("folder"), arg("light_field"), arg("keywords"), arg("metadata"), arg("report"));
}

void add_view_options(py::module_& module) {
    py::enum_<Transfer>(module, "Transfer")
        .value("srgb", Transfer::srgb)
        .value("linear", Transfer::linear)
        .value("rec709", Transfer::rec709)
        .value("gamma22", Transfer::gamma22);
    py::class_<ViewImportOptions>(module, "ViewImportOptions");
    py::class_<ImportedViews>(module, "ImportedViews")
        .def_readonly("light_field", &ImportedViews::light_field)
        .def_readonly("layout", &ImportedViews::layout)
        .def_readonly("columns", &ImportedViews::columns)
        .def_readonly("rows", &ImportedViews::rows)
        .def_readonly("bits", &ImportedViews::bits)
        .def_readonly("transfer", &ImportedViews::transfer)
        .def_readonly("spacing", &ImportedViews::spacing)
        .def_readonly("distance", &ImportedViews::distance)
        .def_readonly("scale", &ImportedViews::scale)
        .def_readonly("parallax", &ImportedViews::parallax)
        .def_readonly("estimated", &ImportedViews::estimated)
        .def_readonly("spool_bytes", &ImportedViews::spool_bytes)
        .def_readonly("summary", &ImportedViews::summary)
        .def_readonly("assumed", &ImportedViews::assumed)
        .def_readonly("notes", &ImportedViews::notes);
    py::class_<ViewExportOptions>(module, "ViewExportOptions")
        .def_readonly("layout", &ViewExportOptions::layout)
        .def_readwrite("memory", &ViewExportOptions::memory)
        .def_property(
            "metadata", [](const ViewExportOptions& o) { return o.metadata; },
            [](ViewExportOptions& o, const py::object& m) { o.metadata = metadata_of(m); });
    py::class_<ExportedViews>(module, "ExportedViews")
        .def_readonly("columns", &ExportedViews::columns)
        .def_readonly("rows", &ExportedViews::rows)
        .def_readonly("files", &ExportedViews::files)
        .def_readonly("notes", &ExportedViews::notes)
        .def_readonly("exposure", &ExportedViews::exposure);
}

void add_view_sets(py::module_& module) {
    module.def("transfer_names", &transfer_names);
    module.def("transfer_named", &transfer_named, arg("name"));
    module.def("view_layouts", [] {
        std::vector<std::tuple<std::string, std::string, bool, bool>> rows;
        for (const ViewLayout& row : view_layouts().rows())
            rows.emplace_back(row.name, row.text, row.is_folder, row.create != nullptr);
        return rows;
    });
    py::class_<QuiltDisplay>(module, "QuiltDisplay")
        .def_readonly("name", &QuiltDisplay::name)
        .def_readonly("columns", &QuiltDisplay::columns)
        .def_readonly("rows", &QuiltDisplay::rows)
        .def_readonly("width", &QuiltDisplay::width)
        .def_readonly("height", &QuiltDisplay::height)
        .def_readonly("aspect", &QuiltDisplay::aspect)
        .def_readonly("cone", &QuiltDisplay::cone)
        .def_readonly("source", &QuiltDisplay::source)
        .def_readonly("title", &QuiltDisplay::title)
        .def_readonly("aliases", &QuiltDisplay::aliases)
        .def_readonly("verified", &QuiltDisplay::verified)
        .def_readonly("note", &QuiltDisplay::note)
        .def_readonly("fault", &QuiltDisplay::fault)
        .def_property_readonly("tile_width", &QuiltDisplay::tile_width)
        .def_property_readonly("tile_height", &QuiltDisplay::tile_height);
    module.def("quilt_displays", [] { return quilt_displays().rows(); });
    module.def("quilt_display_names", &quilt_display_names);
    module.def("is_view_set", &is_view_set, arg("source"), py::call_guard<py::gil_scoped_release>());
    module.def(
        "import_views",
        [](const std::filesystem::path& source, const ViewImportOptions& options, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return import_views(source, options, p); });
        },
        arg("source"), arg("options"), arg("report"));
    module.def(
        "write_views",
        [](const std::filesystem::path& path, const LightField& light_field, bool single, bool with_depth,
           const py::object& metadata, const py::object& report) {
            LightFieldFileOptions file;
            file.type = single ? SampleType::single : SampleType::half;
            file.with_depth = with_depth;
            file.metadata = with_history(metadata_of(metadata), to_metadata(light_field.provenance()));
            run(report, [&](const Progress& p) {
                const auto sinks = create_light_field(path, light_field.grids(), file);
                write_views(light_field, *sinks.front(), p);
            });
        },
        arg("path"), arg("light_field"), arg("single"), arg("with_depth"), arg("metadata"), arg("report"));
    module.def(
        "export_views",
        [](const LightField& light_field, const std::filesystem::path& target, const ViewExportOptions& options,
           const py::object& report) {
            return run_for(report, [&](const Progress& p) { return export_views(light_field, target, options, p); });
        },
        arg("light_field"), arg("target"), arg("options"), arg("report"));
    module.def("write_cameras", &write_cameras, arg("grid"), arg("file"), py::call_guard<py::gil_scoped_release>());
}

}  // namespace

void add_views(py::module_& module) {
    add_view_options(module);
    add_view_sets(module);
    add_printer_images(module);
    add_import_keywords(module);
    add_export_keywords(module);
    add_cameras_keywords(module);
    module.def("is_film", &is_film, arg("path"));
    module.def("can_make_films", &can_make_films);
    module.def(
        "make_film",
        [](const std::filesystem::path& film, const std::filesystem::path& folder, const std::string& frames,
           double frames_a_second, const std::string& comment, const py::object& report) {
            run(report, [&](const Progress& p) { make_film(film, folder, frames, frames_a_second, comment, p); });
        },
        arg("film"), arg("folder"), arg("frames"), arg("frames_a_second"), arg("comment"), arg("report"));
}

}  // namespace hogel::python
