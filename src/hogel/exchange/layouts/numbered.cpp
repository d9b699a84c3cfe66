// SPDX-License-Identifier: Apache-2.0
// Pictures numbered row by row. As in the sets of OpenHolo (OpenHolo_LFCGH), they are orthographic views by direction:
// the first shows the rays to the left and top behind the hologram, seen from the right and below. With orthographic =
// false, or with camera-like names, they are camera views from the top left.
#include <fmt/format.h>

#include <algorithm>

#include "hogel/core/lower_case.h"
#include "hogel/error.h"
#include "hogel/exchange/file_names.h"
#include "hogel/exchange/view_order.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

bool probe(const fs::path& source) {
    const std::vector<NumberedFiles> groups = numbered_pictures(source);
    return !groups.empty() && groups.front().varying.size() == 1 && groups.front().files.size() > 2;
}

// Returns whether names follow the conventions of cameras and films: IMG_0001.JPG, Cam_004.png.
bool names_cameras(const std::string& shape) {
    const std::string name = core::lower_case(shape);
    for (const char* word : {"cam", "img", "dsc", "photo", "frame"})
        if (name.find(word) != std::string::npos) return true;
    return false;
}

ViewSet open(const fs::path& source, const ViewImportOptions& options) {
    const std::vector<NumberedFiles> groups = numbered_pictures(source);
    if (groups.empty() || groups.front().varying.size() != 1)
        fail_source(source, "has no pictures whose names differ in one number, such as view_001.png");
    PictureGrid grid = counted(groups.front(), groups.front().varying[0], options.columns, options.rows);
    ViewSet set;
    set.columns = grid.columns;
    set.rows = grid.rows;
    set.pictures = std::make_shared<FilePictures>(std::move(grid.files), set.columns);
    take_size(*set.pictures->look(0, 0), set);
    if (options.columns == 0 && is_one_row(set)) {
        const std::size_t n = set.columns, all = n * set.rows;
        set = reordered(std::move(set), 1, all,
                        [=](std::size_t, std::size_t column) { return std::pair(column / n, column % n); });
        set.notes.emplace_back("by their parallax, the views are one row");
    }
    set = unwound_by_parallax(std::move(set), options);
    set.geometry.orthographic = options.orthographic.value_or(!names_cameras(groups.front().shape));
    if (!options.orthographic)
        set.notes.emplace_back(set.geometry.orthographic
                                   ? "numbered views were taken for orthographic ones"
                                   : "numbered views were taken for those of cameras, by their names");
    const bool by_direction = set.geometry.orthographic;
    return mirrored(std::move(set), by_direction, by_direction);
}

std::unique_ptr<ViewWriter> create(const ViewTarget& target) {
    return file_writer(target, [=](std::size_t row, std::size_t column) {
        const bool by_direction = target.geometry.orthographic;
        const std::size_t r = by_direction ? target.rows - 1 - row : row;
        const std::size_t c = by_direction ? target.columns - 1 - column : column;
        return fmt::format("view_{:0{}}", r * target.columns + c + 1,
                           std::to_string(target.rows * target.columns).size());
    });
}

}  // namespace

ViewLayout numbered_layout() {
    return {
        .name = "numbered",
        .text =
            "view_001.png, ... row by row: orthographic views by direction (OpenHolo), or cameras from the top left",
        .cameras_only = false,
        .probe = probe,
        .open = open,
        .create = create};
}

}  // namespace hogel::exchange
