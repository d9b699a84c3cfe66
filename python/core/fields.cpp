// SPDX-License-Identifier: Apache-2.0
// Complex fields: in memory, from arrays, in files, and their propagation.
#include "hogel/field.h"

#include <algorithm>

#include "arrays.h"
#include "core.h"
#include "hogel/files.h"
#include "hogel/pipeline.h"
#include "hogel/propagate.h"
#include "hogel/reconstruct.h"
#include "hogel/requests.h"
#include "keywords.h"

namespace hogel::python {
namespace {

using py::arg;
using Complex = std::complex<float>;
using Source = std::shared_ptr<const FieldSource>;

// Field over a NumPy array, without a copy.
class ArrayField final : public FieldSource {
  public:
    ArrayField(const FieldGrid& grid, const py::array& samples, const py::object& metadata)
        : grid_(grid), samples_(samples, "samples"), provenance_{metadata_of(metadata), {}} {
        validate(grid, ErrorCode::usage, "field");
        if (samples_.shape() != Shape<2>{grid.plane.height, grid.plane.width})
            throw Error(ErrorCode::usage, "samples", "samples: expected an array [y][x] of the size of the grid");
    }
    const FieldGrid& grid() const override { return grid_; }
    const Provenance& provenance() const override { return provenance_; }
    void read(const Region& region, std::size_t, View<Complex, 2> out) const override {
        validate(region, grid_, out.shape());
        for (std::size_t y = 0; y < region.height; ++y)
            samples_.copy_row(samples_.at(region.y0 + y, region.x0), region.width, &out(y, 0));
    }
    const py::object& samples() const { return samples_.object(); }

  private:
    FieldGrid grid_;
    Strided<Complex, 2> samples_;
    Provenance provenance_;
};

// Field computed by a Python function: function(x0, y0, width, height) -> [y][x]. Calls of the function are serialised.
class FunctionField final : public FieldSource {
  public:
    FunctionField(const FieldGrid& grid, const py::object& function, const py::object& metadata)
        : grid_(grid), function_(share(function)), provenance_{metadata_of(metadata), {}} {
        validate(grid, ErrorCode::usage, "field");
    }
    const FieldGrid& grid() const override { return grid_; }
    const Provenance& provenance() const override { return provenance_; }
    void read(const Region& region, std::size_t, View<Complex, 2> out) const override {
        validate(region, grid_, out.shape());
        const py::gil_scoped_acquire acquire;
        const py::object made = (*function_)(region.x0, region.y0, region.width, region.height);
        const auto values = py::array_t<Complex, py::array::c_style | py::array::forcecast>::ensure(made);
        if (!values) throw py::error_already_set();
        if (shape_of<2>(values, "samples") != out.shape())
            throw Error(ErrorCode::usage, "samples: the function returned an array of the wrong shape");
        std::copy_n(values.data(), out.size(), out.data());
    }

  private:
    FieldGrid grid_;
    std::shared_ptr<const py::object> function_;
    Provenance provenance_;
};

// Region of a field, as a field.
class Cut final : public FieldSource {
  public:
    Cut(const FieldSource& whole, const Region& region, std::size_t look)
        : whole_(whole),
          region_(region),
          look_(look),
          grid_{part(whole.grid().plane, region), whole.grid().wavelength} {}
    const FieldGrid& grid() const override { return grid_; }
    void read(const Region& region, std::size_t, View<Complex, 2> out) const override {
        whole_.read({region_.x0 + region.x0, region_.y0 + region.y0, region.width, region.height}, look_, out);
    }

  private:
    const FieldSource& whole_;
    Region region_;
    std::size_t look_;
    FieldGrid grid_;
};

// Returns the samples of a region as an array [y][x], computed on all threads.
py::array read_region(const Source& field, const Region& region, std::size_t look, const py::object& report) {
    if (region.width == 0 || region.height == 0)
        return py::array_t<Complex>(
            std::vector<py::ssize_t>{static_cast<py::ssize_t>(region.height), static_cast<py::ssize_t>(region.width)});
    Field samples = run_for(report, [&](const Progress& progress) {
        const Cut cut(*field, region, look);
        Field read(cut.grid());
        copy(cut, read, 0, progress);
        return read;
    });
    return array_of(std::move(samples.samples));
}

// Returns the array of a field in memory, without a copy; None for other fields.
py::object samples_in_memory(const Source& field) {
    if (const auto* array = dynamic_cast<const ArrayField*>(field.get())) return array->samples();
    const auto* const whole = dynamic_cast<const Field*>(field.get());
    if (whole == nullptr) return py::none();
    return array_over(const_cast<Complex*>(whole->samples.data()), whole->samples.shape(), py::cast(field));
}

Source shared(Field&& field) { return std::make_shared<const Field>(std::move(field)); }

py::dict dictionary_of(const PropagationMethod& method) {
    py::dict facts;
    facts["name"] = std::string(method.name);
    facts["fresnel_number"] = method.fresnel_number;
    facts["error"] = method.error;
    facts["frequencies"] = py::make_tuple(method.frequencies_x, method.frequencies_y);
    facts["tiles"] = py::make_tuple(method.tiles_x, method.tiles_y);
    facts["bytes"] = method.bytes;
    facts["operations"] = method.operations;
    return facts;
}

PropagateOptions options_of(const std::optional<Grid>& output, std::size_t look, double max_error) {
    PropagateOptions options;
    options.output = output;
    options.look = look;
    options.max_error = max_error;
    return options;
}

void add_propagation(py::module_& module) {
    module.def(
        "propagate",
        [](const Source& field, double distance, const std::optional<Grid>& output, std::size_t look, double max_error,
           const py::object& report) {
            return run_for(report, [&](const Progress& p) {
                Field moved = propagate(*field, distance, options_of(output, look, max_error), p);
                moved.set_provenance(field->provenance());
                return shared(std::move(moved));
            });
        },
        arg("field"), arg("distance"), arg("output"), arg("look"), arg("max_error"), arg("report"));
    module.def("propagate_keywords", [] {
        const Keywords<PropagateParameters> none;
        return described(none.table,
                         [](const Parameter& each) { return each.name != "distance" && each.name != "display"; });
    });
    module.def(
        "propagate_by",
        [](const py::dict& keywords, const Source& field, std::size_t look, const py::object& report) {
            const Keywords<PropagateParameters> asked(keywords);
            if (!asked.table.given("distance")) throw Error(ErrorCode::usage, "distance", "distance: it is required");
            PropagateOptions options = asked.values.options(field->grid().plane);
            options.look = look;
            return run_for(report, [&](const Progress& p) {
                Field moved = propagate(*field, asked.values.distance, options, p);
                moved.set_provenance(field->provenance());
                return shared(std::move(moved));
            });
        },
        arg("keywords"), arg("field"), arg("look"), arg("report"));
    module.def(
        "propagate_record",
        [](const py::dict& keywords, const Grid& output) {
            Keywords<PropagateParameters> asked(keywords);
            asked.values.resolve(output);
            return asked.table.acting();
        },
        arg("keywords"), arg("output"));
    module.def(
        "propagation_method",
        [](const FieldGrid& field, double distance, const std::optional<Grid>& output, double max_error) {
            return dictionary_of(propagation_method(field, distance, options_of(output, 0, max_error)));
        },
        arg("field"), arg("distance"), arg("output") = py::none(), arg("max_error") = PropagateOptions().max_error);
    module.def(
        "fourier_image",
        [](const Source& field, double focal_length, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return shared(fourier_image(*field, focal_length, p)); });
        },
        arg("field"), arg("focal_length"), arg("report"));
    module.def(
        "fresnel_image",
        [](const Source& field, double distance, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return shared(fresnel_image(*field, distance, p)); });
        },
        arg("field"), arg("distance"), arg("report"));
}

}  // namespace

void add_fields(py::module_& module) {
    py::class_<FieldSource, std::shared_ptr<FieldSource>>(module, "FieldSource")
        .def_property_readonly("grid", &FieldSource::grid)
        .def_property_readonly("looks", &FieldSource::looks)
        .def_property_readonly("alignment", &FieldSource::alignment)
        .def_property_readonly("overlap", &FieldSource::overlap)
        .def_property_readonly("metadata", [](const FieldSource& f) { return f.provenance().entries; })
        .def_property_readonly("provenance", [](const FieldSource& f) { return to_metadata(f.provenance()); })
        .def_property_readonly("camera", [](const FieldSource& f) { return f.provenance().camera; });
    module.def(
        "field_of_array",
        [](const FieldGrid& grid, const py::array& samples, const py::object& metadata) -> Source {
            return std::make_shared<const ArrayField>(grid, samples, metadata);
        },
        arg("grid"), arg("samples"), arg("metadata"));
    module.def(
        "field_of_function",
        [](const FieldGrid& grid, const py::object& function, const py::object& metadata) -> Source {
            return std::make_shared<const FunctionField>(grid, function, metadata);
        },
        arg("grid"), arg("function"), arg("metadata"));
    module.def(
        "write_npy",
        [](const std::filesystem::path& path, const py::array_t<Complex, py::array::c_style>& samples) {
            const View<const Complex, 2> view(samples.data(), shape_of<2>(samples, "samples"));
            run(py::none(), [&](const Progress&) { write_npy(path, view); });
        },
        arg("path"), arg("samples"));
    module.def(
        "part",
        [](const Grid& grid, std::size_t x0, std::size_t y0, std::size_t width, std::size_t height) {
            return part(grid, Region{x0, y0, width, height});
        },
        arg("grid"), arg("x0"), arg("y0"), arg("width"), arg("height"));
    module.def("samples_in_memory", &samples_in_memory, arg("field"));
    module.def(
        "read_region",
        [](const Source& field, std::size_t x0, std::size_t y0, std::size_t width, std::size_t height, std::size_t look,
           const py::object& report) {
            return read_region(field, {x0, y0, width, height}, look, report);
        },
        arg("field"), arg("x0"), arg("y0"), arg("width"), arg("height"), arg("look"), arg("report"));
    module.def(
        "load_field",
        [](const Source& field, std::size_t look, const py::object& report) -> Source {
            return run_for(report, [&](const Progress& p) {
                Field loaded(field->grid());
                copy(*field, loaded, look, p);
                loaded.set_provenance(field->provenance());
                return shared(std::move(loaded));
            });
        },
        arg("field"), arg("look"), arg("report"));
    add_propagation(module);
}

}  // namespace hogel::python
