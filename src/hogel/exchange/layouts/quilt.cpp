// SPDX-License-Identifier: Apache-2.0
// Looking Glass quilts: one picture of rows and columns of tiles, name_qs8x6a0.75.png. The bottom left tile is the
// leftmost view of a row of cameras; tiles run to the right, then up. The number after 'a' is the aspect of a view,
// which differs from that of its tile if pixels are not square. Cameras are shifted, not rotated. A quilt has no camera
// spacing: the view cone of the display is the field of view. Tiles have whole pixels: what does not divide is a margin
// on the right and at the top, as in the maker's software.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <mutex>
#include <optional>

#include "hogel/core/lower_case.h"
#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/exchange/quilt_name.h"
#include "hogel/exchange/view_set.h"
#include "hogel/image/picture_bytes.h"
#include "hogel/image/picture_formats.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

template <class T>
bool take(std::string_view& text, T& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return true;
}

bool take_letter(std::string_view& text, char letter) {
    if (text.empty() || text.front() != letter) return false;
    text.remove_prefix(1);
    return true;
}

}  // namespace

std::optional<QuiltTiling> quilt_tiling(const fs::path& path) {
    const std::string stem = core::lower_case(path.stem().string());
    const std::size_t tag = stem.rfind("_qs");
    if (tag == std::string::npos) return {};
    std::string_view text(stem);
    text.remove_prefix(tag + 3);
    QuiltTiling tiling;
    constexpr std::size_t max_tiles = 1000;
    if (!take(text, tiling.columns) || !take_letter(text, 'x') || !take(text, tiling.rows)) return {};
    if (take_letter(text, 'a') && !(take(text, tiling.aspect) && tiling.aspect > 0 && std::isfinite(tiling.aspect)))
        return {};
    const bool fits = tiling.columns > 0 && tiling.rows > 0 && tiling.columns <= max_tiles && tiling.rows <= max_tiles;
    return fits ? std::optional(tiling) : std::nullopt;
}

bool is_same_aspect(double aspect, double other) {
    constexpr double max_rounding = 1e-3;
    return std::abs(aspect / other - 1) < max_rounding;
}

namespace {

bool probe(const fs::path& source) {
    std::error_code none;
    return fs::is_regular_file(source, none) && image::format_by_extension(source) != nullptr && quilt_tiling(source);
}

// Tiles of one picture, which stays in memory.
class QuiltPictures final : public ViewPictures {
  public:
    QuiltPictures(const fs::path& source, const QuiltTiling& tiling) : source_(source), tiling_(tiling) {
        whole_ = image::read_picture(source, max_pixels);
        std::visit(
            [&](const auto& samples) {
                height_ = samples.extent(0) / tiling.rows;
                width_ = samples.extent(1) / tiling.columns;
                if (height_ == 0 || width_ == 0)
                    fail_source(source, fmt::format("has {}x{} pixels, fewer than {}x{} views", samples.extent(1),
                                                    samples.extent(0), tiling.columns, tiling.rows));
                divides_ = samples.extent(0) % tiling.rows == 0 && samples.extent(1) % tiling.columns == 0;
            },
            whole_.samples);
    }

    std::size_t width() const { return width_; }
    std::size_t height() const { return height_; }
    bool divides() const { return divides_; }

    image::Picture read(std::size_t, std::size_t column) const override {
        const std::size_t row = tiling_.rows - 1 - column / tiling_.columns;
        return std::visit(
            [&](const auto& samples) {
                std::remove_cvref_t<decltype(samples)> view({height_, width_, samples.extent(2)});
                const std::size_t y0 = samples.extent(0) - (tiling_.rows - row) * height_,
                                  x0 = column % tiling_.columns * width_;
                for (std::size_t y = 0; y < height_; ++y)
                    std::copy_n(&samples(y0 + y, x0, 0), width_ * samples.extent(2), &view(y, 0, 0));
                return image::Picture{std::move(view), {}, whole_.max_code};
            },
            whole_.samples);
    }
    std::string name(std::size_t, std::size_t column) const override {
        return fmt::format("{}, view {}", source_.string(), column);
    }

  private:
    fs::path source_;
    QuiltTiling tiling_;
    image::Picture whole_;
    std::size_t width_ = 0, height_ = 0;
    bool divides_ = true;
};

ViewSet open(const fs::path& source, const ViewImportOptions& options) {
    std::optional<QuiltTiling> tiling = quilt_tiling(source);
    if (options.columns > 0) tiling = QuiltTiling{options.columns, options.rows, tiling ? tiling->aspect : 0};
    if (!tiling)
        throw Error(ErrorCode::usage, "views",
                    fmt::format("{}: the name of a quilt ends like _qs8x6a0.75; with another name the "
                                "number of columns and rows of views is needed",
                                source.string()));
    auto pictures = std::make_shared<QuiltPictures>(source, *tiling);
    ViewSet set;
    set.columns = tiling->columns * tiling->rows;
    set.rows = 1;
    if (!pictures->divides())
        set.notes.push_back(
            fmt::format("the picture does not divide into {}x{} views; pixels at its right and top are left out",
                        tiling->columns, tiling->rows));
    const double width = static_cast<double>(pictures->width()), height = static_cast<double>(pictures->height());
    if (tiling->aspect > 0)
        set.geometry.pixel_height = width / height / tiling->aspect;
    else
        set.notes.emplace_back("the name does not say the aspect of views; their pixels were taken to be square");
    set.pictures = std::move(pictures);
    return set;
}

// Returns the number of columns that makes a quilt of n views closest to square.
std::size_t best_columns(const ViewTarget& target) {
    const std::size_t n = target.columns;
    std::size_t best = n;
    double least = INFINITY;
    for (std::size_t columns = 1; columns <= n; ++columns) {
        if (n % columns != 0) continue;
        const std::size_t rows = n / columns;
        const double ratio = static_cast<double>(columns * target.width) / static_cast<double>(rows * target.height);
        if (std::abs(std::log(ratio)) < least) least = std::abs(std::log(ratio)), best = columns;
    }
    return best;
}

[[noreturn]] void fail_name(const ViewTarget& target, std::size_t columns, std::size_t rows, double aspect) {
    throw Error(ErrorCode::usage, "",
                fmt::format("{}: the name of this quilt must end like _qs{}x{}a{:.5g}.png, because the name alone says "
                            "how it is divided",
                            target.path.string(), columns, rows, aspect));
}

// Returns the tiling for a display. Throws unless it has a tile for each view, of the same aspect, and the file's name
// agrees.
QuiltTiling tiling_for(const QuiltDisplay& display, const ViewTarget& target, double aspect) {
    if (display.columns * display.rows != target.columns)
        throw Error(
            ErrorCode::usage, "device",
            fmt::format("a quilt for {} has {} views in a row, and the light field {}; render it with that many "
                        "directions across, or interpolate an imported set by densify",
                        display.name, display.columns * display.rows, target.columns));
    constexpr double max_distortion = 0.01;
    if (!(std::abs(aspect / display.aspect - 1) < max_distortion))
        throw Error(ErrorCode::usage, "device",
                    fmt::format("views for {} have an aspect (width/height) of {:.5g}, and those of the light field "
                                "{:.5g}; render it with {}x{:.0f} hogels",
                                display.name, display.aspect, aspect, display.tile_width(),
                                static_cast<double>(display.tile_width()) / display.aspect));
    return {display.columns, display.rows, display.aspect};
}

// Returns the tiling given by the file name. Throws unless the name matches the number and aspect of the views, because
// a reader has only the name to divide the picture.
QuiltTiling tiling_for(const ViewTarget& target) {
    const double aspect =
        static_cast<double>(target.width) / static_cast<double>(target.height) / target.geometry.pixel_height;
    const std::optional<QuiltTiling> named = quilt_tiling(target.path);
    if (target.display) {
        const QuiltTiling tiling = tiling_for(*target.display, target, aspect);
        if (!named || named->columns != tiling.columns || named->rows != tiling.rows ||
            !is_same_aspect(named->aspect, tiling.aspect))
            fail_name(target, tiling.columns, tiling.rows, tiling.aspect);
        return tiling;
    }
    if (named && named->columns * named->rows == target.columns && is_same_aspect(named->aspect, aspect)) return *named;
    const std::size_t columns = best_columns(target);
    fail_name(target, columns, target.columns / columns, aspect);
}

class Writer final : public ViewWriter {
  public:
    explicit Writer(const ViewTarget& target) : target_(target), tiling_(tiling_for(target)) {
        const Shape<3> shape{target.display ? target.display->height : tiling_.rows * target.height,
                             target.display ? target.display->width : tiling_.columns * target.width, target.channels};
        if (target.bits <= 8)
            quilt_ = Array<std::uint8_t, 3>(shape);
        else if (target.bits <= 16)
            quilt_ = Array<std::uint16_t, 3>(shape);
        else
            quilt_ = Array<float, 3>(shape);
    }

    fs::path write(std::size_t, std::size_t column, const StoredView& view) override {
        std::visit(
            [&](auto& all) {
                const auto& from = std::get<std::remove_cvref_t<decltype(all)>>(view);
                const std::size_t y0 = all.extent(0) - (column / tiling_.columns + 1) * target_.height,
                                  x0 = column % tiling_.columns * target_.width;
                for (std::size_t y = 0; y < target_.height; ++y)
                    std::copy_n(&from(y, 0, 0), target_.width * target_.channels, &all(y0 + y, x0, 0));
            },
            quilt_);
        return {};
    }

    std::vector<fs::path> finish() override {
        core::write_file(target_.path, picture_file(target_, quilt_));
        return {target_.path};
    }

  private:
    ViewTarget target_;
    QuiltTiling tiling_;
    StoredView quilt_;
};

std::unique_ptr<ViewWriter> create(const ViewTarget& target) { return std::make_unique<Writer>(target); }

}  // namespace

ViewLayout quilt_layout() {
    return {.name = "quilt",
            .text = "NAME_qs8x6a0.75.png: one row of cameras as tiles from the bottom left (Looking Glass)",
            .is_folder = false,
            .is_row = true,
            .written_at_once = true,
            .probe = probe,
            .open = open,
            .create = create};
}

}  // namespace hogel::exchange
