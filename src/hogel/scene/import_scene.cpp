// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/scene/pictures.h"

namespace hogel {

Scene import_scene(const std::filesystem::path& path, const Progress& progress, const ImportOptions& options) {
    const core::StopScope scope(progress);
    if (scene::is_picture(path)) return scene::import_picture(path, options);
    const char* const kind = scene::is_layers(path) ? "file of layers" : "mesh file";
    if (!options.depth_map.empty() || options.depths.near || options.depths.far)
        throw Error(ErrorCode::usage, options.depth_map.empty() ? "near, far" : "depth_map",
                    fmt::format("{} is a {}; expected a picture", path.string(), kind));
    if (scene::is_layers(path)) return scene::import_layers(path);
    return scene::import_mesh(path, options);
}

}  // namespace hogel
