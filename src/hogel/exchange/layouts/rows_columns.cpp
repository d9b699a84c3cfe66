// SPDX-License-Identifier: Apache-2.0
// Pictures with two numbers in their names, a row and a column of views: 003_004.ppm of JPEG Pleno and the EPFL sets,
// view_03_04.png and so on. Writers and readers of JPEG Pleno disagree about which is the column; the views themselves
// say it, because along a row of cameras things move sideways. Rows run from the top, columns from the left; the views
// say whether one of the two runs the other way, but nothing but options says that both do.
#include <fmt/format.h>

#include "hogel/error.h"
#include "hogel/exchange/file_names.h"
#include "hogel/exchange/parallax.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

bool probe(const fs::path& source) {
    const std::vector<NumberedFiles> groups = numbered_pictures(source);
    return !groups.empty() && groups.front().varying.size() == 2 && groups.front().files.size() > 2;
}

ViewSet by_numbers(const NumberedFiles& group, std::size_t row_number, std::size_t column_number) {
    PictureGrid grid = in_rows_and_columns(group, row_number, column_number);
    ViewSet set;
    set.columns = grid.columns;
    set.rows = grid.rows;
    set.pictures = std::make_shared<FilePictures>(std::move(grid.files), set.columns);
    take_size(set.pictures->read(0, 0), set);
    return set;
}

ViewSet open(const fs::path& source, const ViewOptions& options) {
    const std::vector<NumberedFiles> groups = numbered_pictures(source);
    if (groups.empty() || groups.front().varying.size() != 2)
        fail_source(source, "has no pictures whose names differ in two numbers, such as 003_004.png");
    const NumberedFiles& group = groups.front();
    const std::size_t first = group.varying[0], second = group.varying[1];
    ViewSet set =
        options.column_first.value_or(false) ? by_numbers(group, second, first) : by_numbers(group, first, second);
    ParallaxEvidence evidence = parallax_of(set);
    if (!options.column_first && evidence.certain && evidence.swapped) {
        set = by_numbers(group, second, first);
        evidence = parallax_of(set);
        set.notes.emplace_back("by their parallax, the first number in the names is the column of views");
    } else if (!options.column_first) {
        set.notes.emplace_back(evidence.certain
                                   ? "by their parallax, the second number in the names is the column of views"
                                   : "the second number in the names was taken for the column of views");
    }
    if (evidence.certain && evidence.opposed && !options.mirror_columns && !options.mirror_rows) {
        set = mirrored(std::move(set), false, true);
        set.notes.emplace_back("by their parallax, rows of views run from the bottom, if columns run from the left");
    }
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
