// SPDX-License-Identifier: Apache-2.0
// Sampling grids: value types with equality and pickling.
#include <pybind11/operators.h>

#include "core.h"
#include "hogel/camera.h"
#include "hogel/field.h"
#include "hogel/light_field.h"
#include "hogel/photograph.h"
#include "hogel/pipeline.h"

namespace hogel::python {
namespace {

using py::arg;

template <class T>
py::tuple state_of(const T& view) {
    return py::make_tuple(view.half_u, view.half_v, view.center_u, view.center_v);
}

template <class T>
py::class_<T> add_range(py::module_& module, const char* name) {
    return py::class_<T>(module, name)
        .def_readwrite("half_u", &T::half_u)
        .def_readwrite("half_v", &T::half_v)
        .def_readwrite("center_u", &T::center_u)
        .def_readwrite("center_v", &T::center_v)
        .def(py::self == py::self);
}

void add_directions(py::module_& module) {
    py::enum_<Face>(module, "Face")
        .value("front", Face::front)
        .value("left", Face::left)
        .value("right", Face::right)
        .value("top", Face::top)
        .value("bottom", Face::bottom);
    module.def(
        "face_name", [](Face face) { return std::string(face_name(face)); }, arg("face"));
    using Vector = std::array<double, 3>;
    module.def(
        "to_face",
        [](Face face, const Vector& p) {
            const Vec3 q = to_face(face, {p[0], p[1], p[2]});
            return Vector{q.x, q.y, q.z};
        },
        arg("face"), arg("vector"));
    module.def(
        "from_face",
        [](Face face, const Vector& q) {
            const Vec3 p = from_face(face, {q[0], q[1], q[2]});
            return Vector{p.x, p.y, p.z};
        },
        arg("face"), arg("vector"));
    add_range<Perspective>(module, "Perspective")
        .def(py::init([](double half_u, double half_v, double center_u, double center_v, Face face) {
                 return Perspective{{half_u, half_v, center_u, center_v}, face};
             }),
             arg("half_u") = 0, arg("half_v") = 0, arg("center_u") = 0, arg("center_v") = 0, arg("face") = Face::front)
        .def_readwrite("face", &Perspective::face)
        .def(py::pickle(
            [](const Perspective& v) {
                return py::make_tuple(v.half_u, v.half_v, v.center_u, v.center_v, static_cast<int>(v.face));
            },
            [](const py::tuple& t) {
                return Perspective{{t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>(), t[3].cast<double>()},
                                   static_cast<Face>(t[4].cast<int>())};
            }));
    add_range<Frequencies>(module, "Frequencies")
        .def(py::init([](double half_u, double half_v, double center_u, double center_v) {
                 return Frequencies{{half_u, half_v, center_u, center_v}};
             }),
             arg("half_u") = 0, arg("half_v") = 0, arg("center_u") = 0, arg("center_v") = 0)
        .def(py::pickle([](const Frequencies& v) { return state_of(v); },
                        [](const py::tuple& t) {
                            return Frequencies{
                                {t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>(), t[3].cast<double>()}};
                        }));
    add_range<FocalPlane>(module, "FocalPlane")
        .def(py::init([](double depth, double half_u, double half_v, double center_u, double center_v) {
                 return FocalPlane{{half_u, half_v, center_u, center_v}, depth};
             }),
             arg("depth") = 0, arg("half_u") = 0, arg("half_v") = 0, arg("center_u") = 0, arg("center_v") = 0)
        .def_readwrite("depth", &FocalPlane::depth)
        .def(py::pickle(
            [](const FocalPlane& v) { return py::make_tuple(v.depth, v.half_u, v.half_v, v.center_u, v.center_v); },
            [](const py::tuple& t) {
                return FocalPlane{{t[1].cast<double>(), t[2].cast<double>(), t[3].cast<double>(), t[4].cast<double>()},
                                  t[0].cast<double>()};
            }));
    module.def("field_of_view", py::overload_cast<double, double, double, double>(&field_of_view), arg("across"),
               arg("down"), arg("toward_right") = 0, arg("toward_up") = 0);
}

using View = decltype(LightFieldGrid::view);

void add_light_field_grid(py::module_& module) {
    py::class_<LightFieldGrid>(module, "LightFieldGrid")
        .def(py::init([](std::size_t s, std::size_t t, double pitch, std::size_t u, std::size_t v, const View& view,
                         std::size_t channels) { return LightFieldGrid{s, t, pitch, u, v, view, channels}; }),
             arg("hogels_s"), arg("hogels_t"), arg("pitch"), arg("directions_u"), arg("directions_v"), arg("view"),
             arg("channels") = 3)
        .def_readwrite("hogels_s", &LightFieldGrid::hogels_s)
        .def_readwrite("hogels_t", &LightFieldGrid::hogels_t)
        .def_readwrite("pitch", &LightFieldGrid::pitch)
        .def_readwrite("directions_u", &LightFieldGrid::directions_u)
        .def_readwrite("directions_v", &LightFieldGrid::directions_v)
        .def_readwrite("view", &LightFieldGrid::view)
        .def_readwrite("channels", &LightFieldGrid::channels)
        .def_property_readonly("width", &LightFieldGrid::width)
        .def_property_readonly("height", &LightFieldGrid::height)
        .def("s", &LightFieldGrid::s, arg("i"))
        .def("t", &LightFieldGrid::t, arg("j"))
        .def("u", &LightFieldGrid::u, arg("k"))
        .def("v", &LightFieldGrid::v, arg("l"))
        .def("column", &LightFieldGrid::column, arg("U"))
        .def("row", &LightFieldGrid::row, arg("V"))
        .def("of_hogel", &LightFieldGrid::of_hogel, arg("i"), arg("j"))
        .def_property_readonly("is_perspective", &LightFieldGrid::is_perspective)
        .def_property_readonly("has_frequencies", &LightFieldGrid::has_frequencies)
        .def_property_readonly("face", &LightFieldGrid::face)
        .def_property_readonly("half_u", &LightFieldGrid::half_u)
        .def_property_readonly("half_v", &LightFieldGrid::half_v)
        .def_property_readonly("center_u", &LightFieldGrid::center_u)
        .def_property_readonly("center_v", &LightFieldGrid::center_v)
        .def_property_readonly(
            "focal_plane",
            [](const LightFieldGrid& g) { return g.focal_plane() ? std::optional(*g.focal_plane()) : std::nullopt; })
        .def(
            "direction_of",
            [](const LightFieldGrid& g, double U, double V) {
                const Vec3 d = g.direction_of(U, V);
                return py::make_tuple(d.x, d.y, d.z);
            },
            arg("U"), arg("V"))
        .def(
            "covers",
            [](const LightFieldGrid& g, const std::array<double, 3>& d) {
                return g.covers({d[0], d[1], d[2]});
            },
            arg("direction"))
        .def_property_readonly("step_u", &LightFieldGrid::step_u)
        .def_property_readonly("step_v", &LightFieldGrid::step_v)
        .def_property_readonly("directions", &LightFieldGrid::directions)
        .def_property_readonly("hogels", &LightFieldGrid::hogels)
        .def_property_readonly("samples", &LightFieldGrid::samples)
        .def_property_readonly("shape",
                               [](const LightFieldGrid& g) {
                                   return py::make_tuple(g.channels, g.hogels_t, g.hogels_s, g.directions_v,
                                                         g.directions_u);
                               })
        .def(py::self == py::self)
        .def("__repr__",
             [](const LightFieldGrid& g) {
                 return py::str("LightFieldGrid({}x{} hogels, {:.6g} m apart, of {}x{} directions, {} channels)")
                     .format(g.hogels_s, g.hogels_t, g.pitch, g.directions_u, g.directions_v, g.channels);
             })
        .def(py::pickle(
            [](const LightFieldGrid& g) {
                return py::make_tuple(g.hogels_s, g.hogels_t, g.pitch, g.directions_u, g.directions_v, g.view,
                                      g.channels);
            },
            [](const py::tuple& t) {
                return LightFieldGrid{t[0].cast<std::size_t>(), t[1].cast<std::size_t>(), t[2].cast<double>(),
                                      t[3].cast<std::size_t>(), t[4].cast<std::size_t>(), t[5].cast<View>(),
                                      t[6].cast<std::size_t>()};
            }));
    module.def(
        "validate_light_field", [](const LightFieldGrid& grid) { validate(grid, ErrorCode::usage, "light field"); },
        arg("grid"));
    module.def("hemicube", &hemicube, arg("grid"), arg("across") = std::numbers::pi, arg("down") = std::numbers::pi);
    module.def("same_hogels", &same_hogels, arg("a"), arg("b"));
    module.def(
        "require_perspective",
        [](const LightFieldGrid& grid, const std::string& what) { require_perspective(grid, ErrorCode::usage, what); },
        arg("grid"), arg("what"));
    module.def(
        "require_common_directions",
        [](const LightFieldGrid& grid, const std::string& what) {
            require_common_directions(grid, ErrorCode::usage, what);
        },
        arg("grid"), arg("what"));
    module.def(
        "require_faces", [](const std::vector<LightFieldGrid>& faces) { require_faces(faces); }, arg("faces"));
    module.def(
        "default_tile",
        [](const LightFieldGrid& grid) {
            const HogelRange tile = default_tile(grid);
            return py::make_tuple(tile.ns, tile.nt);
        },
        arg("grid"));
    module.def("common_directions", &common_directions, arg("grid"));
    module.def(
        "finer",
        [](const LightFieldGrid& grid, std::size_t hogel, std::size_t direction) {
            return finer(grid, {hogel, direction});
        },
        arg("grid"), arg("hogel"), arg("direction"));
}

void add_planes(py::module_& module) {
    py::class_<Grid>(module, "Grid")
        .def(py::init([](std::size_t width, std::size_t height, double pitch_x, double pitch_y, double center_x,
                         double center_y) { return Grid{width, height, pitch_x, pitch_y, center_x, center_y}; }),
             arg("width"), arg("height"), arg("pitch_x"), arg("pitch_y"), arg("center_x") = 0, arg("center_y") = 0)
        .def_readwrite("width", &Grid::width)
        .def_readwrite("height", &Grid::height)
        .def_readwrite("pitch_x", &Grid::pitch_x)
        .def_readwrite("pitch_y", &Grid::pitch_y)
        .def_readwrite("center_x", &Grid::center_x)
        .def_readwrite("center_y", &Grid::center_y)
        .def("x", &Grid::x, arg("column"))
        .def("y", &Grid::y, arg("row"))
        .def("column", &Grid::column, arg("x"))
        .def("row", &Grid::row, arg("y"))
        .def_property_readonly("samples", &Grid::samples)
        .def_property_readonly("size_x", &Grid::size_x)
        .def_property_readonly("size_y", &Grid::size_y)
        .def_property_readonly("shape", [](const Grid& g) { return py::make_tuple(g.height, g.width); })
        .def(py::self == py::self)
        .def("__repr__",
             [](const Grid& g) {
                 return py::str("Grid({}x{} samples, {:.6g} x {:.6g} m apart, around ({:.6g}, {:.6g}))")
                     .format(g.width, g.height, g.pitch_x, g.pitch_y, g.center_x, g.center_y);
             })
        .def(py::pickle(
            [](const Grid& g) {
                return py::make_tuple(g.width, g.height, g.pitch_x, g.pitch_y, g.center_x, g.center_y);
            },
            [](const py::tuple& t) {
                return Grid{t[0].cast<std::size_t>(), t[1].cast<std::size_t>(), t[2].cast<double>(),
                            t[3].cast<double>(),      t[4].cast<double>(),      t[5].cast<double>()};
            }));
    py::class_<FieldGrid>(module, "FieldGrid")
        .def(py::init([](const Grid& plane, double wavelength) {
                 return FieldGrid{plane, wavelength};
             }),
             arg("plane"), arg("wavelength"))
        .def_readwrite("plane", &FieldGrid::plane)
        .def_readwrite("wavelength", &FieldGrid::wavelength)
        .def(py::self == py::self)
        .def(py::pickle([](const FieldGrid& g) { return py::make_tuple(g.plane, g.wavelength); },
                        [](const py::tuple& t) {
                            return FieldGrid{t[0].cast<Grid>(), t[1].cast<double>()};
                        }));
}

using Point = std::array<double, 3>;

void add_cameras(py::module_& module) {
    py::class_<Camera>(module, "Camera")
        .def(py::init([](const Point& eye, double focus_depth, double slope_x, double slope_y, double pupil,
                         const Grid& picture) {
                 return Camera{{eye[0], eye[1], eye[2]}, focus_depth, slope_x, slope_y, pupil, picture};
             }),
             arg("eye"), arg("focus_depth"), arg("focus_slope_x"), arg("focus_slope_y"), arg("pupil"), arg("picture"))
        .def_property(
            "eye",
            [](const Camera& c) {
                return Point{c.eye.x, c.eye.y, c.eye.z};
            },
            [](Camera& c, const Point& p) {
                c.eye = {p[0], p[1], p[2]};
            })
        .def_readwrite("focus_depth", &Camera::focus_depth)
        .def_readwrite("focus_slope_x", &Camera::focus_slope_x)
        .def_readwrite("focus_slope_y", &Camera::focus_slope_y)
        .def_readwrite("pupil", &Camera::pupil)
        .def_readwrite("picture", &Camera::picture)
        .def(py::self == py::self)
        .def("__repr__", [](const Camera& c) { return "Camera(" + describe(c) + ")"; })
        .def(py::pickle(
            [](const Camera& c) {
                return py::make_tuple(Point{c.eye.x, c.eye.y, c.eye.z}, c.focus_depth, c.focus_slope_x, c.focus_slope_y,
                                      c.pupil, c.picture);
            },
            [](const py::tuple& t) {
                const auto eye = t[0].cast<Point>();
                return Camera{{eye[0], eye[1], eye[2]}, t[1].cast<double>(), t[2].cast<double>(),
                              t[3].cast<double>(),      t[4].cast<double>(), t[5].cast<Grid>()};
            }));
    module.def(
        "validate_camera", [](const Camera& camera) { validate(camera); }, arg("camera"));
    module.def("focus_ratio", &focus_ratio, arg("camera"), arg("x"), arg("y"));
    module.def("camera_for", &camera_for, arg("width"), arg("height"), arg("resolution") = defaults.resolution);
    module.def("enough_looks", &enough_looks, arg("camera"));
    module.def("resolution_cell", &resolution_cell, arg("camera"), arg("wavelength"));
    module.def("parse_camera", &parse_camera, arg("text"));
    module.def("describe", &describe, arg("camera"));
}

}  // namespace

void add_grids(py::module_& module) {
    add_directions(module);
    add_light_field_grid(module);
    add_planes(module);
    add_cameras(module);
}

}  // namespace hogel::python
