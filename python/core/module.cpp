// SPDX-License-Identifier: Apache-2.0
#include "core.h"
#include "hogel/version.h"

PYBIND11_MODULE(_core, module) {
    using namespace hogel::python;
    module.doc() = "The C++ interface of hogel under its own names. Use the package hogel instead.";
    module.attr("__version__") = HOGEL_VERSION;
    add_errors(module);
    add_units(module);
    add_grids(module);
    add_images(module);
    add_scenes(module);
    add_light_fields(module);
    add_renderers(module);
    add_light_field_files(module);
    add_compression(module);
    add_fields(module);
    add_holograms(module);
    add_photographs(module);
    add_patterns(module);
    add_elsewhere(module);
    add_views(module);
    add_plans(module);
    add_file_parts(module);
    add_make(module);
    add_keywords(module);
    add_photo_keywords(module);
}
