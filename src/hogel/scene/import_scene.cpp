// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/scene/pictures.h"

namespace hogel {

Scene import_scene(const std::filesystem::path& path, const Progress& progress, const ImportOptions& options) {
    const core::StopScope scope(progress);
    if (scene::is_picture(path)) return scene::import_picture(path, options);
    if (!options.depth_map.empty())
        throw Error(ErrorCode::usage, "depth_map", fmt::format("{} is a mesh file; expected a picture", path.string()));
    return scene::import_mesh(path, options);
}

}  // namespace hogel
