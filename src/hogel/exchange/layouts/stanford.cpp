// SPDX-License-Identifier: Apache-2.0
// The (New) Stanford Light Field Archive: out_RR_CC_y_x_.png, rectified to a common plane. The decimal numbers are the
// camera position, x right and y down, in unknown units. They decide the arrangement, not RR and CC: RR runs upwards.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "hogel/error.h"
#include "hogel/exchange/file_names.h"
#include "hogel/exchange/view_set.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

struct Name {
    std::int64_t row = 0, column = 0;
    double y = 0, x = 0;
};

template <class T>
bool take(std::string_view& text, T& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end == text.data()) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (!text.empty() && text.front() == '_') text.remove_prefix(1);
    return true;
}

bool parse(const std::string& stem, Name& name) {
    std::string_view text = stem;
    if (!text.starts_with("out_")) return false;
    text.remove_prefix(4);
    return take(text, name.row) && take(text, name.column) && take(text, name.y) && take(text, name.x) &&
           text.empty() && std::isfinite(name.y) && std::isfinite(name.x);
}

// Returns all pictures of the folder with such names, with RR and CC as their numbers.
NumberedFiles pictures_in(const fs::path& source) {
    NumberedFiles all;
    for (const NumberedFiles& group : numbered_pictures(source))
        for (const NumberedFile& file : group.files)
            if (Name name; parse(file.path.stem().string(), name))
                all.files.push_back({file.path, {name.row, name.column}});
    std::ranges::sort(all.files, {}, &NumberedFile::path);
    return all;
}

bool probe(const fs::path& source) { return !pictures_in(source).files.empty(); }

Name name_of(const fs::path& path) {
    Name name;
    parse(path.stem().string(), name);
    return name;
}

// Returns the mean camera position along one axis for each row or column.
std::vector<double> mean_places(const PictureGrid& grid, bool of_columns) {
    std::vector<double> means(of_columns ? grid.columns : grid.rows);
    for (std::size_t i = 0; i < grid.files.size(); ++i) {
        const Name name = name_of(grid.files[i]);
        if (of_columns)
            means[i % grid.columns] += name.x / static_cast<double>(grid.rows);
        else
            means[i / grid.columns] += name.y / static_cast<double>(grid.columns);
    }
    return means;
}

double spacing_of(const std::vector<double>& places) {
    return places.size() < 2 ? 0 : (places.back() - places.front()) / static_cast<double>(places.size() - 1);
}

void require_order(const fs::path& source, const std::vector<double>& places, const char* what) {
    const double spacing = spacing_of(places);
    for (std::size_t i = 1; i < places.size(); ++i)
        if (!((places[i] - places[i - 1]) * spacing > 0))
            fail_source(source,
                        fmt::format("the places of cameras in the names do not follow the numbers of their {}", what));
}

// Returns the largest deviation of cameras from even steps, in steps.
double unevenness(const std::vector<double>& places) {
    const double spacing = spacing_of(places);
    double worst = 0;
    for (std::size_t i = 0; i < places.size() && spacing != 0; ++i)
        worst = std::max(worst, std::abs((places[i] - places.front()) / spacing - static_cast<double>(i)));
    return worst;
}

ViewSet open(const fs::path& source, const ViewImportOptions&) {
    const NumberedFiles group = pictures_in(source);
    if (group.files.empty()) fail_source(source, "has no pictures of names such as out_00_01_-780.1_-3355.3_.png");
    PictureGrid grid = in_rows_and_columns(group, 0, 1);
    const std::vector<double> xs = mean_places(grid, true), ys = mean_places(grid, false);
    require_order(source, xs, "columns");
    require_order(source, ys, "rows");
    ViewSet set;
    set.columns = grid.columns;
    set.rows = grid.rows;
    if (spacing_of(xs) != 0 && spacing_of(ys) != 0)
        set.geometry.spacing_ratio = std::abs(spacing_of(ys) / spacing_of(xs));
    if (const double uneven = std::max(unevenness(xs), unevenness(ys)); uneven > 0.01)
        set.notes.push_back(fmt::format(
            "cameras stand up to {:.2f} of their spacing beside even steps, at which they are taken to be", uneven));
    set.pictures = std::make_shared<FilePictures>(std::move(grid.files), set.columns);
    return mirrored(std::move(set), spacing_of(xs) < 0, spacing_of(ys) < 0);
}

std::unique_ptr<ViewWriter> create(const ViewTarget& target) {
    return file_writer(target, [=](std::size_t row, std::size_t column) {
        const double x = (static_cast<double>(column) + 0.5 - 0.5 * static_cast<double>(target.columns)) *
                         target.geometry.spacing * 1e3;
        const double y = (static_cast<double>(row) + 0.5 - 0.5 * static_cast<double>(target.rows)) *
                         target.geometry.spacing * target.geometry.spacing_ratio * 1e3;
        return fmt::format("out_{:02}_{:02}_{:.6f}_{:.6f}_", target.rows - 1 - row, column, y, x);
    });
}

}  // namespace

ViewLayout stanford_layout() {
    return {.name = "stanford",
            .text = "out_RR_CC_y_x_.png, rectified (Stanford Light Field Archive)",
            .probe = probe,
            .open = open,
            .create = create};
}

}  // namespace hogel::exchange
