// SPDX-License-Identifier: Apache-2.0
// Light fields in memory, from arrays and Python functions, and reading of slices.
#include "hogel/light_field.h"

#include <algorithm>

#include "arrays.h"
#include "core.h"
#include "hogel/pipeline.h"

namespace hogel::python {
namespace {

using py::arg;

// Light field over a NumPy array, without a copy.
class ArraySource final : public LightFieldSource {
  public:
    ArraySource(const LightFieldGrid& grid, const py::array& radiance, const std::optional<py::array>& depth)
        : grid_(grid), radiance_(radiance, "radiance") {
        if (depth) depth_.emplace(*depth, "depth");
        const Shape<5> expected{grid.channels, grid.hogels_t, grid.hogels_s, grid.directions_v, grid.directions_u};
        if (radiance_.shape() != expected ||
            (depth_ && depth_->shape() != Shape<4>{expected[1], expected[2], expected[3], expected[4]}))
            throw Error(ErrorCode::usage, "radiance, depth",
                        "radiance, depth: expected arrays [c][t][s][v][u] and [t][s][v][u] of the size "
                        "of the grid");
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return depth_.has_value(); }
    View<const float, 5> in_memory() const override {
        if (!radiance_.is_dense()) return {};
        return {radiance_.data(), radiance_.shape()};
    }
    void read(LightFieldTile& tile) const override {
        const HogelRange& range = tile.range;
        // Copies contiguous hogels of a row at once.
        if (radiance_.is_dense() && !(depth_ && tile.depth.size() > 0)) {
            const std::size_t row = range.ns * grid_.directions();
            for (std::size_t c = 0; c < grid_.channels; ++c)
                for (std::size_t t = 0; t < range.nt; ++t)
                    std::copy_n(reinterpret_cast<const float*>(radiance_.at(c, range.t0 + t, range.s0, 0, 0)), row,
                                &tile.radiance(c, t, 0, 0, 0));
            return;
        }
        for (std::size_t t = 0; t < range.nt; ++t)
            for (std::size_t s = 0; s < range.ns; ++s)
                for (std::size_t v = 0; v < grid_.directions_v; ++v) {
                    for (std::size_t c = 0; c < grid_.channels; ++c)
                        radiance_.copy_row(radiance_.at(c, range.t0 + t, range.s0 + s, v, 0), grid_.directions_u,
                                           &tile.radiance(c, t, s, v, 0));
                    if (depth_ && tile.depth.size() > 0)
                        depth_->copy_row(depth_->at(range.t0 + t, range.s0 + s, v, 0), grid_.directions_u,
                                         &tile.depth(t, s, v, 0));
                }
    }
    const py::object& radiance() const { return radiance_.object(); }
    py::object depth() const { return depth_ ? depth_->object() : py::none(); }

  private:
    LightFieldGrid grid_;
    Strided<float, 5> radiance_;
    std::optional<Strided<float, 4>> depth_;
};

// Light field computed tile by tile by a Python function. Calls of the function are serialised.
class FunctionSource final : public LightFieldSource {
  public:
    FunctionSource(const LightFieldGrid& grid, py::object function, bool with_depth)
        : grid_(grid), function_(share(std::move(function))), with_depth_(with_depth) {}

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return with_depth_; }
    void read(LightFieldTile& tile) const override {
        const py::gil_scoped_acquire acquire;
        const HogelRange& r = tile.range;
        py::object made = (*function_)(r.s0, r.t0, r.ns, r.nt);
        py::object depth = py::none();
        if (with_depth_) {
            const auto both = made.cast<py::tuple>();
            const py::object first = both[0];
            depth = both[1];
            made = first;
        }
        fill(made, tile.radiance, "radiance");
        if (with_depth_ && tile.depth.size() > 0) fill(depth, tile.depth, "depth");
    }

  private:
    template <std::size_t Rank>
    static void fill(const py::object& from, Array<float, Rank>& to, const char* what) {
        const auto values = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(from);
        if (!values) throw py::error_already_set();
        if (shape_of<Rank>(values, what) != to.shape())
            throw Error(ErrorCode::usage, std::string(what) + ": the function returned an array of the wrong shape");
        std::copy_n(values.data(), to.size(), to.data());
    }

    LightFieldGrid grid_;
    std::shared_ptr<const py::object> function_;
    bool with_depth_;
};

// Sink that calls a Python function with every tile, one at a time.
class FunctionSink final : public LightFieldSink {
  public:
    FunctionSink(const py::object& function, bool with_depth) : function_(function), with_depth_(with_depth) {}
    void write(const LightFieldTile& tile) override {
        const py::gil_scoped_acquire acquire;
        const py::array radiance = array_of(Array<float, 5>(tile.radiance));
        py::object depth = py::none();
        if (with_depth_) depth = array_of(Array<float, 4>(tile.depth));
        function_(tile.range.s0, tile.range.t0, radiance, depth);
    }
    bool wants_depth() const override { return with_depth_; }

  private:
    const py::object& function_;
    bool with_depth_;
};

// Elements of an axis selected by a slice.
struct Axis {
    std::size_t begin = 0, count = 0, step = 1;
    std::size_t at(std::size_t i) const { return begin + i * step; }
    bool is_whole(std::size_t length) const { return count == length && step == 1; }
};

// Region of hogels of a source: limits copy() to the hogels that a slice needs.
class Part final : public LightFieldSource {
  public:
    Part(const LightFieldSource& whole, const HogelRange& range) : whole_(whole), range_(range), grid_(whole.grid()) {
        grid_.hogels_s = range.ns;
        grid_.hogels_t = range.nt;
    }
    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return whole_.has_depth(); }
    HogelRange preferred_tile() const override {
        const HogelRange preferred = whole_.preferred_tile();
        return {0, 0, std::min(preferred.ns, range_.ns), std::min(preferred.nt, range_.nt)};
    }
    void read(LightFieldTile& tile) const override {
        tile.range.s0 += range_.s0;
        tile.range.t0 += range_.t0;
        whole_.read(tile);
        tile.range.s0 -= range_.s0;
        tile.range.t0 -= range_.t0;
    }

  private:
    const LightFieldSource& whole_;
    HogelRange range_;
    LightFieldGrid grid_;
};

// Copies the elements selected by slices from each tile. Axes t and s count from the first hogel of the part. Complete
// hogels of a row are copied at once.
class Picker final : public LightFieldSink {
  public:
    Picker(const std::array<Axis, 5>& axes, const LightFieldGrid& grid, float* to, bool depth)
        : axes_(axes),
          to_(to),
          depth_(depth),
          takes_rows_(axes[2].step == 1 && axes[3].is_whole(grid.directions_v) && axes[4].is_whole(grid.directions_u)) {
    }
    bool wants_depth() const override { return depth_; }
    void write(const LightFieldTile& tile) override {
        const auto& [c, t, s, v, u] = axes_;
        const std::size_t hogel = v.count * u.count;
        for (std::size_t channel = 0; channel < c.count; ++channel)
            for (std::size_t j = 0; j < t.count; ++j) {
                const std::size_t row = j * t.step - tile.range.t0;  // wraps around if it is before the tile
                if (row >= tile.range.nt) continue;
                float* const out = to_ + (channel * t.count + j) * s.count * hogel;
                if (takes_rows_) {
                    std::copy_n(sample(tile, c.at(channel), row, 0, 0), tile.range.ns * hogel,
                                out + tile.range.s0 * hogel);
                    continue;
                }
                for (std::size_t i = 0; i < s.count; ++i) {
                    const std::size_t column = i * s.step - tile.range.s0;
                    if (column >= tile.range.ns) continue;
                    for (std::size_t l = 0; l < v.count; ++l) {
                        const float* from = sample(tile, c.at(channel), row, column, v.at(l));
                        for (std::size_t k = 0; k < u.count; ++k) out[i * hogel + l * u.count + k] = from[u.at(k)];
                    }
                }
            }
    }

  private:
    // Returns a pointer to row v of the directions of a hogel.
    const float* sample(const LightFieldTile& tile, std::size_t c, std::size_t t, std::size_t s, std::size_t v) const {
        return depth_ ? &tile.depth(t, s, v, 0) : &tile.radiance(c, t, s, v, 0);
    }

    const std::array<Axis, 5>& axes_;
    float* to_;
    bool depth_, takes_rows_;
};

// Returns the elements of one face selected by slices with positive steps, as an array of five axes; for depth with one
// channel.
py::array read_slices(const LightField& light_field, std::size_t face, const std::array<std::size_t, 15>& slices,
                      bool depth, const py::object& report) {
    const LightFieldSource& source = *light_field.faces()[face];
    std::array<Axis, 5> axes;
    Shape<5> shape;
    bool empty = false;
    for (std::size_t axis = 0; axis < 5; ++axis) {
        axes[axis] = {slices[3 * axis], slices[3 * axis + 1], slices[3 * axis + 2]};
        shape[axis] = axes[axis].count;
        empty = empty || axes[axis].count == 0;
    }
    Array<float, 5> result(shape);
    if (empty) return array_of(std::move(result));
    const Axis &t = axes[1], &s = axes[2];
    const HogelRange range{s.begin, t.begin, (s.count - 1) * s.step + 1, (t.count - 1) * t.step + 1};
    run(report, [&](const Progress& progress) {
        const Part part(source, range);
        Picker picker(axes, source.grid(), result.data(), depth);
        copy(part, picker, progress);
    });
    return array_of(std::move(result));
}

LightField make_from_array(const LightFieldGrid& grid, const py::array& radiance, const std::optional<py::array>& depth,
                           const py::object& metadata) {
    validate(grid, ErrorCode::usage, "light field");
    return LightField(std::make_shared<const ArraySource>(grid, radiance, depth)).with({metadata_of(metadata), {}});
}

LightField load(const LightField& light_field, bool with_depth, const py::object& report) {
    return run_for(report, [&](const Progress& progress) {
        std::size_t done = 0;
        return light_field.wrapped([&](const LightField::Source& face) {
            auto buffer = std::make_shared<LightFieldBuffer>(face->grid(), with_depth && face->has_depth());
            copy(*face, *buffer, progress.part(done++, light_field.faces().size()));
            return LightField::Source(std::move(buffer));
        });
    });
}

// Returns the array of a face in memory, without a copy; None for other faces.
py::object memory_of(const LightField& light_field, std::size_t face) {
    const LightField::Source& source = light_field.faces()[face];
    if (const auto* array = dynamic_cast<const ArraySource*>(source.get())) return array->radiance();
    const View<const float, 5> view = source->in_memory();
    if (view.size() == 0) return py::none();
    // Memory here was created as a LightFieldBuffer, which is not const.
    return array_over(const_cast<float*>(view.data()), view.shape(), py::cast(light_field));
}

py::object depth_in_memory(const LightField& light_field, std::size_t face) {
    const LightField::Source& source = light_field.faces()[face];
    if (const auto* array = dynamic_cast<const ArraySource*>(source.get())) return array->depth();
    const auto* const buffer = dynamic_cast<const LightFieldBuffer*>(source.get());
    if (buffer == nullptr || !buffer->has_depth()) return py::none();
    return array_over(const_cast<float*>(buffer->depth.data()), buffer->depth.shape(), py::cast(light_field));
}

}  // namespace

void add_light_fields(py::module_& module) {
    py::class_<LightField>(module, "LightField")
        .def_property_readonly("grid", &LightField::grid)
        .def("grids", &LightField::grids)
        .def_property_readonly("faces", [](const LightField& l) { return l.faces().size(); })
        .def("has_depth", &LightField::has_depth)
        .def("has_sides", &LightField::has_sides)
        .def("samples", &LightField::samples)
        .def_property_readonly("metadata", [](const LightField& l) { return l.provenance().entries; })
        .def_property_readonly("camera", [](const LightField& l) { return l.provenance().camera; })
        .def("with_metadata",
             [](const LightField& l, const py::object& metadata) {
                 return l.with({metadata_of(metadata), l.provenance().camera});
             })
        .def("face", [](const LightField& l, std::size_t face) {
            return LightField(std::vector<LightField::Source>{l.faces()[face]}, l.provenance());
        });
    module.def("light_field_of_array", &make_from_array, arg("grid"), arg("radiance"), arg("depth"), arg("metadata"));
    module.def(
        "light_field_of_function",
        [](const LightFieldGrid& grid, const py::object& function, bool with_depth, const py::object& metadata) {
            validate(grid, ErrorCode::usage, "light field");
            return LightField(std::make_shared<const FunctionSource>(grid, function, with_depth))
                .with({metadata_of(metadata), {}});
        },
        arg("grid"), arg("function"), arg("with_depth"), arg("metadata"));
    module.def("memory_of", &memory_of, arg("light_field"), arg("face"));
    module.def("depth_in_memory", &depth_in_memory, arg("light_field"), arg("face"));
    module.def("read_slices", &read_slices, arg("light_field"), arg("face"), arg("slices"), arg("depth"),
               arg("report"));
    module.def("load", &load, arg("light_field"), arg("with_depth"), arg("report"));
    module.def(
        "stream",
        [](const LightField& light_field, std::size_t face, const py::object& function, bool depth,
           const py::object& report) {
            run(report, [&](const Progress& progress) {
                FunctionSink sink(function, depth);
                copy(*light_field.faces()[face], sink, progress);
            });
        },
        arg("light_field"), arg("face"), arg("function"), arg("depth"), arg("report"));
    module.def(
        "with_common_directions", [](const LightField& l) { return with_common_directions(l); }, arg("light_field"));
    module.def("with_scale", &with_scale, arg("light_field"), arg("pitch"), arg("factor"));
    module.def("cached_tiles", &cached_tiles, arg("light_field"), arg("bytes"), arg("with_depth") = false);
    module.def(
        "prepare_for_reading",
        [](const LightField& l, std::size_t times, bool with_depth, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return prepare_for_reading(l, times, with_depth, p); });
        },
        arg("light_field"), arg("times"), arg("with_depth"), arg("report"));
    module.def(
        "render_light_field",
        [](const Scene& scene, const LightFieldRequest& request, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return render_light_field(scene, request, p); });
        },
        arg("scene"), arg("request"), arg("report"));
    module.def(
        "render_light_field",
        [](const std::shared_ptr<ShadedScene>& scene, const LightFieldRequest& request) {
            return run_for(py::none(), [&](const Progress&) { return render_light_field(scene, request); });
        },
        arg("scene"), arg("request"));
    module.def(
        "compare",
        [](const LightField& a, const LightField& b, const py::object& report) {
            const auto c = run_for(report, [&](const Progress& p) { return compare(a, b, p); });
            return py::make_tuple(c.sqnr, c.psnr, c.max_error);
        },
        arg("a"), arg("b"), arg("report"));
}

}  // namespace hogel::python
