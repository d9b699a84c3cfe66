// SPDX-License-Identifier: Apache-2.0
// Pictures named by row and column of views: 003_004.ppm of JPEG Pleno and the EPFL sets, view_03_04.png and so on.
// JPEG Pleno software disagrees about which number is the column; the parallax decides, which is horizontal along a
// row. Rows run from the top, columns from the left. The parallax shows if one is reversed, only options if both are.
#include <fmt/format.h>

#include "hogel/error.h"
#include "hogel/exchange/file_names.h"
#include "hogel/exchange/view_order.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

bool probe(const fs::path& source) {
    const std::vector<NumberedFiles> groups = numbered_pictures(source);
    return !groups.empty() && groups.front().varying.size() == 2 && groups.front().files.size() > 2;
}

ViewSet open(const fs::path& source, const ViewImportOptions& options) {
    const std::vector<NumberedFiles> groups = numbered_pictures(source);
    if (groups.empty() || groups.front().varying.size() != 2)
        fail_source(source, "has no pictures whose names differ in two numbers, such as 003_004.png");
    const NumberedFiles& group = groups.front();
    PictureGrid grid = in_rows_and_columns(group, group.varying[0], group.varying[1]);
    ViewSet set;
    set.columns = grid.columns;
    set.rows = grid.rows;
    set.pictures = std::make_shared<FilePictures>(std::move(grid.files), set.columns);
    take_size(*set.pictures->look(0, 0), set);
    set =
        ordered_by_parallax(std::move(set), options, "the first number in the names", "the second number in the names");
    set.geometry.orthographic = options.orthographic.value_or(false);
    return set;
}

std::unique_ptr<ViewWriter> create(const ViewTarget& target) {
    return file_writer(target,
                       [](std::size_t row, std::size_t column) { return fmt::format("{:03}_{:03}", row, column); });
}

}  // namespace

ViewLayout rows_columns_layout() {
    return {
        .name = "rows-columns",
        .text = "ROW_COLUMN.ppm or any names with two numbers, rows from the top, columns from the left (JPEG Pleno)",
        .cameras_only = false,
        .probe = probe,
        .open = open,
        .create = create};
}

}  // namespace hogel::exchange
