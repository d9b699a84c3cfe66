// SPDX-License-Identifier: Apache-2.0
#include "commands.h"

#include "view_options.h"

namespace hogel::cli {

std::span<const CommandInfo> commands() {
    static const CommandInfo table[] = {
        {"make", "From a scene to photographs of its hologram, with a report", add_make},
        {"render", "Render a scene into a light field", add_render},
        {"import", "Turn a set of views (pictures of a camera array, a quilt) into a light field", add_import},
        {"export", "Write a light field as a set of views for other programs", add_export},
        {"cameras", "Write the cameras whose pictures make a light field, for another renderer", add_cameras},
        {"hologram", "Turn a light field or a scene into a hologram", add_hologram},
        {"slm", "Encode a hologram as a pattern for a light modulator", add_slm},
        {"print", "Write a light field as pictures for a hologram printer", add_print},
        {"photo", "Photograph a hologram, a light field or a scene", add_photo},
        {"view", view_summary, add_view},
        {"propagate", "The field of a hologram on another plane, as a picture or an array", add_propagate},
        {"focus", "Find the depths at which a hologram is in focus", add_focus},
        {"compress", "Compress a light field", add_compress},
        {"decompress", "Decompress a light field", add_decompress},
        {"join", "Join the parts of a light field or a hologram", add_join},
        {"compare", "Say how alike two files are", add_compare},
        {"info", "Say what a file is and what made it, in SI units", add_info},
        {"bake", "Light a scene for good, reflected light included", add_bake},
        {"scenes", "List the built-in scenes", add_scenes},
        {"completion", "Print what completes command lines in bash, zsh or fish", add_completion},
    };
    return table;
}

}  // namespace hogel::cli
