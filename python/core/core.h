// SPDX-License-Identifier: Apache-2.0
#pragma once

// Declarations common to the sources of the extension module hogel._core. Each source adds the classes and functions of
// one topic, under the names of the C++ interface. ../hogel adds the Pythonic interface (units, keywords, slices).

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

/// Runs work on another thread without the GIL and waits for it. The calling thread checks for signals every 50 ms:
/// Ctrl-C stops the work, which leaves no incomplete files, and raises KeyboardInterrupt. If `report` is not None, the
/// calling thread calls it with the fraction done; it stops the work by returning False or raising an exception.
/// Rethrows exceptions of the work.
void run(const py::object& report, const std::function<void(const Progress&)>& work);

/// Like run(), for work with a result.
template <class Work>
auto run_for(const py::object& report, const Work& work) {
    using Result = std::invoke_result_t<const Work&, const Progress&>;
    std::optional<Result> result;
    run(report, [&](const Progress& progress) { result.emplace(work(progress)); });
    return std::move(*result);
}

/// Shares a Python object with code that does not hold the GIL. Releasing the object acquires the GIL.
std::shared_ptr<const py::object> share(py::object object);

/// Converts a dictionary or a list of pairs to metadata; None: empty.
Metadata metadata_of(const py::object& entries);

/// Converts a comparison of pictures to a dictionary.
py::dict dictionary_of(const ImageComparison& comparison);

}  // namespace hogel::python
