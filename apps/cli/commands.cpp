// SPDX-License-Identifier: Apache-2.0
#include "commands.h"

#include "view_options.h"

namespace hogel::cli {

std::span<const CommandInfo> commands() {
    static const CommandInfo table[] = {
        {"make", "Photograph the hologram of a scene and write a report: all steps in one", add_make},
        {"render", "Render a scene into a light field", add_render},
        {"import", "Convert a set of views (pictures of a camera array, a quilt) to a light field", add_import},
        {"export", "Write a light field as a set of views for other programs", add_export},
        {"cameras", "Write the cameras of a light field for another renderer", add_cameras},
        {"hologram", "Compute the hologram of a light field or a scene", add_hologram},
        {"slm", "Encode a hologram as a pattern for a light modulator", add_slm},
        {"print", "Write a light field as pictures for a hologram printer", add_print},
        {"photo", "Photograph a hologram, a light field or a scene", add_photo},
        {"view", view_summary, add_view},
        {"propagate", "Propagate the field of a hologram to another plane", add_propagate},
        {"focus", "Find the depths at which a hologram is in focus", add_focus},
        {"compress", "Compress a light field", add_compress},
        {"decompress", "Decompress a light field", add_decompress},
        {"join", "Join the parts of a light field or a hologram", add_join},
        {"compare", "Compare two files: PSNR, SQNR and maximum error", add_compare},
        {"info", "Print the contents and the provenance of a file, in SI units", add_info},
        {"bake", "Bake the lighting of a scene, indirect light included, into its vertices", add_bake},
        {"scenes", "List the built-in scenes", add_scenes},
        {"completion", "Print the completion script for bash, zsh or fish", add_completion},
    };
    return table;
}

}  // namespace hogel::cli
