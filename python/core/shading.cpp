// SPDX-License-Identifier: Apache-2.0
// Shaded scenes, for renderers in Python, and renderers by name.
#include "hogel/shading.h"

#include "arrays.h"
#include "core.h"
#include "hogel/pipeline.h"
#include "hogel/renderer.h"

namespace hogel::python {
namespace {

using py::arg;
using Shaded = std::shared_ptr<ShadedScene>;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;

// Returns rows of three numbers as an array [n][3].
template <class T, class Rows, class Put>
py::array rows_of(const Rows& rows, const Put& put) {
    py::array_t<T> array({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}});
    T* to = array.mutable_data();
    for (const auto& row : rows) {
        put(row, to);
        to += 3;
    }
    return array;
}

// Points on triangles seen by rays: arrays of equal length.
struct Points {
    Indices triangles;
    Doubles weights, to_viewer, footprint;

    std::size_t check(const ShadedScene& scene) const {
        const auto n = static_cast<std::size_t>(triangles.size());
        const Shape<2> rows{n, 3};
        if (triangles.ndim() != 1 || shape_of<2>(weights, "weights") != rows ||
            shape_of<2>(to_viewer, "to_viewer") != rows || shape_of<1>(footprint, "footprint") != Shape<1>{n})
            throw Error(ErrorCode::usage,
                        "triangles, weights, to_viewer, footprint: expected arrays [n], [n][3], [n][3] and [n]");
        for (std::size_t i = 0; i < n; ++i)
            if (triangles.data()[i] >= scene.triangles.size())
                throw Error(ErrorCode::usage, "triangles: the scene has " + std::to_string(scene.triangles.size()) +
                                                  ", and number " + std::to_string(triangles.data()[i]) +
                                                  " was asked for");
        return n;
    }
    // Calls value(index, b0, b1, b2, view) for every point.
    template <class Value, class Put>
    void evaluate(std::size_t n, const Value& value, const Put& put) const {
        for (std::size_t i = 0; i < n; ++i) {
            const double *b = weights.data() + 3 * i, *d = to_viewer.data() + 3 * i;
            const ViewSample view{{d[0], d[1], d[2]}, footprint.data()[i]};
            put(i, value(triangles.data()[i], static_cast<float>(b[0]), static_cast<float>(b[1]),
                         static_cast<float>(b[2]), view));
        }
    }
};

py::array radiance(const Shaded& scene, const Points& points) {
    const std::size_t n = points.check(*scene);
    py::array_t<float> result({static_cast<py::ssize_t>(n), py::ssize_t{3}});
    float* const to = result.mutable_data();
    const auto value = [&](auto... at) { return radiance_at(*scene, at...); };
    run(py::none(), [&](const Progress&) {
        points.evaluate(
            n, value, [&](std::size_t i, const Rgb& c) { to[3 * i] = c.r, to[3 * i + 1] = c.g, to[3 * i + 2] = c.b; });
    });
    return result;
}

py::array opacity(const Shaded& scene, const Points& points) {
    const std::size_t n = points.check(*scene);
    py::array_t<float> result(static_cast<py::ssize_t>(n));
    float* const to = result.mutable_data();
    const auto value = [&](auto... at) { return opacity_at(*scene, at...); };
    run(py::none(),
        [&](const Progress&) { points.evaluate(n, value, [&](std::size_t i, float alpha) { to[i] = alpha; }); });
    return result;
}

void add_shaded_scene(py::module_& module) {
    py::class_<ShadedScene, Shaded>(module, "ShadedScene")
        .def_property_readonly("is_lit",
                               [](const ShadedScene& s) {
                                   for (std::size_t i = 0; i < s.triangles.size(); ++i)
                                       if (s.is_lit(i)) return true;
                                   return false;
                               })
        .def_property_readonly("positions",
                               [](const ShadedScene& s) {
                                   return rows_of<double>(s.positions, [](const Vec3& p, double* to) {
                                       to[0] = p.x, to[1] = p.y, to[2] = p.z;
                                   });
                               })
        .def_property_readonly("radiance",
                               [](const ShadedScene& s) {
                                   return rows_of<float>(s.radiance, [](const Rgb& c, float* to) {
                                       to[0] = c.r, to[1] = c.g, to[2] = c.b;
                                   });
                               })
        .def_property_readonly("triangles",
                               [](const ShadedScene& s) {
                                   return rows_of<std::uint32_t>(
                                       s.triangles, [](const ShadedScene::Triangle& t, std::uint32_t* to) {
                                           to[0] = t.vertices[0], to[1] = t.vertices[1], to[2] = t.vertices[2];
                                       });
                               })
        .def_property_readonly("layers",
                               [](const ShadedScene& s) { return std::const_pointer_cast<ShadedScene>(s.layers); })
        .def_property_readonly(
            "background",
            [](const ShadedScene& s) { return py::make_tuple(s.background.r, s.background.g, s.background.b); })
        .def_readonly("fronts_only", &ShadedScene::fronts_only)
        .def_readonly("metadata", &ShadedScene::provenance);
    module.def(
        "radiance_at",
        [](const Shaded& scene, const Indices& triangles, const Doubles& weights, const Doubles& to_viewer,
           const Doubles& footprint) {
            return radiance(scene, {triangles, weights, to_viewer, footprint});
        },
        arg("scene"), arg("triangles"), arg("weights"), arg("to_viewer"), arg("footprint"));
    module.def(
        "opacity_at",
        [](const Shaded& scene, const Indices& triangles, const Doubles& weights, const Doubles& to_viewer,
           const Doubles& footprint) {
            return opacity(scene, {triangles, weights, to_viewer, footprint});
        },
        arg("scene"), arg("triangles"), arg("weights"), arg("to_viewer"), arg("footprint"));
}

LightField front_of(std::unique_ptr<LightFieldSource> source) {
    return LightField(std::shared_ptr<const LightFieldSource>(std::move(source)));
}

}  // namespace

void add_renderers(py::module_& module) {
    module.def("renderers", [] { return renderers().names(); });
    module.def(
        "make_renderer",
        [](const std::string& name, const Shaded& scene, const LightFieldGrid& grid, std::size_t hogel,
           std::size_t direction) {
            return run_for(py::none(), [&](const Progress&) {
                return front_of(make_renderer(name, scene, grid, {hogel, direction}));
            });
        },
        arg("name"), arg("scene"), arg("grid"), arg("hogel") = 1, arg("direction") = 1);
    module.def(
        "make_interpolating_renderer",
        [](const Shaded& scene, const LightFieldGrid& grid, std::size_t region) {
            return run_for(py::none(),
                           [&](const Progress&) { return front_of(make_interpolating_renderer(scene, grid, region)); });
        },
        arg("scene"), arg("grid"), arg("region"));
    module.def(
        "average",
        [](const LightField& fine, const LightFieldGrid& grid, std::size_t hogel, std::size_t direction) {
            return front_of(average(fine.faces().front(), grid, {hogel, direction}));
        },
        arg("fine"), arg("grid"), arg("hogel"), arg("direction"));
}

void add_shading(py::module_& module) {
    py::class_<ShadingOptions>(module, "ShadingOptions")
        .def(py::init<>())
        .def_readwrite("model", &ShadingOptions::model)
        .def_readwrite("shadow_map", &ShadingOptions::shadow_map)
        .def_readwrite("max_shadow_bytes", &ShadingOptions::max_shadow_bytes)
        .def_readwrite("filter_textures", &ShadingOptions::filter_textures);
    add_shaded_scene(module);
    module.def("shading_models", [] { return shading_models().names(); });
    module.def("shading_model", &shading_model, arg("scene"), arg("options") = ShadingOptions());
    module.def("shadow_map_bytes", &shadow_map_bytes, arg("scene"), arg("options"));
    module.def(
        "shade_scene",
        [](const Scene& scene, const ShadingOptions& options, const py::object& report) {
            return run_for(report, [&](const Progress& p) {
                return std::make_shared<ShadedScene>(shade_scene(scene, options, p));
            });
        },
        arg("scene"), arg("options"), arg("report"));
    module.def(
        "shade_scene_vertices",
        [](const Scene& scene) { return std::make_shared<ShadedScene>(shade_scene_vertices(scene)); }, arg("scene"));
}

void add_lighting(py::module_& module) {
    module.def(
        "light_scene",
        [](const Scene& scene, const LightFieldRequest& request, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return light_scene(scene, request, p); });
        },
        arg("scene"), arg("request"), arg("report"));
}

}  // namespace hogel::python
