// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the sources of the extension module hogel._core share: one source a noun, each of which adds its classes and
// functions. Names are those of the C++ interface; the manners of Python (units, keywords, slices) are in ../hogel.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <functional>
#include <optional>
#include <type_traits>

#include "hogel/image.h"
#include "hogel/progress.h"
#include "hogel/provenance.h"

namespace hogel::python {

namespace py = pybind11;

void add_errors(py::module_& module);
void add_units(py::module_& module);
void add_grids(py::module_& module);
void add_keywords(py::module_& module);
void add_photo_keywords(py::module_& module);
void add_scenes(py::module_& module);
void add_surfaces(py::module_& module);
void add_shading(py::module_& module);
void add_lighting(py::module_& module);
void add_renderers(py::module_& module);
void add_light_fields(py::module_& module);
void add_light_field_files(py::module_& module);
void add_compression(py::module_& module);
void add_fields(py::module_& module);
void add_holograms(py::module_& module);
void add_photographs(py::module_& module);
void add_images(py::module_& module);
void add_patterns(py::module_& module);
void add_elsewhere(py::module_& module);
void add_views(py::module_& module);
void add_plans(py::module_& module);
void add_file_parts(py::module_& module);
void add_make(py::module_& module);

/// Runs work on another thread, without the lock of the interpreter, and waits for it. The calling thread looks
/// for signals every 50 ms, so that Ctrl-C stops the work, which then leaves nothing half-written, and raises
/// KeyboardInterrupt. `report`, unless it is None, is called with the fraction done on the calling thread; it stops the
/// work by returning False or raising an exception. Exceptions of the work are thrown here.
void run(const py::object& report, const std::function<void(const Progress&)>& work);

/// As run(), for work with a result.
template <class Work>
auto run_for(const py::object& report, const Work& work) {
    using Result = std::invoke_result_t<const Work&, const Progress&>;
    std::optional<Result> result;
    run(report, [&](const Progress& progress) { result.emplace(work(progress)); });
    return std::move(*result);
}

/// Shares an object of Python with code that does not hold the lock, which is taken when the object is released.
std::shared_ptr<const py::object> share(py::object object);

/// The value of a dictionary or a list of pairs as metadata; None: empty.
Metadata metadata_of(const py::object& entries);

/// The measures of a comparison of pictures, by name.
py::dict dictionary_of(const ImageComparison& comparison);

}  // namespace hogel::python
