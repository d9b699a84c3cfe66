// SPDX-License-Identifier: Apache-2.0
#include "hogel/exchange/view_light_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hogel/error.h"
#include "hogel/exchange/transfer.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"

namespace hogel::exchange {
namespace {

// Hogels per block of a row, sized so that their directions stay in cache.
constexpr std::size_t block_hogels = 64;

// Returns the linear light of each 8- or 16-bit code. The codes 0 to `max` of a file were scaled to the full range.
std::vector<float> linear_table(Transfer transfer, std::size_t codes, std::uint32_t max) {
    std::vector<float> table(codes);
    const std::size_t full = codes - 1;
    for (std::size_t i = 0; i < codes; ++i) {
        const std::size_t in_file = (i * max + full / 2) / full;
        table[i] = decode(transfer, static_cast<float>(in_file) / static_cast<float>(max));
    }
    return table;
}

}  // namespace

ViewLightField::ViewLightField(ViewSet set, const Placement& placement, Transfer transfer, double memory,
                               std::filesystem::path spool)
    : set_(std::move(set)),
      grid_(placement.grid),
      shear_(placement.shear),
      transfer_(transfer),
      spool_folder_(std::move(spool)),
      table8_(linear_table(transfer, 256, std::clamp(set_.max_code, 1u, 255u))),
      table16_(set_.max_code > 255 ? linear_table(transfer, 65536, set_.max_code) : std::vector<float>()) {
    const double row = static_cast<double>(grid_.directions() * grid_.hogels_s * grid_.channels * sample_bytes());
    band_rows_ = static_cast<std::size_t>(std::clamp(memory / row, 1.0, static_cast<double>(grid_.hogels_t)));
}

bool ViewLightField::is_whole() const {
    const auto whole = [](double x) { return x == std::round(x); };
    return whole(shear_.x0) && whole(shear_.y0) && whole(shear_.dx) && whole(shear_.dy) && shear_.step_y == 1;
}

std::size_t ViewLightField::sample_bytes() const { return !is_whole() || set_.bits > 16 ? 4 : set_.bits > 8 ? 2 : 1; }

double ViewLightField::spool_bytes() const {
    return band_rows_ < grid_.hogels_t ? grid_.samples() * static_cast<double>(sample_bytes()) : 0;
}

HogelRange ViewLightField::preferred_tile() const {
    HogelRange tile = default_tile(grid_);
    tile.ns = grid_.hogels_s;
    tile.nt = std::clamp<std::size_t>(tile.hogels() / grid_.hogels_s, 1, std::min<std::size_t>(band_rows_, 8));
    return tile;
}

void ViewLightField::read(LightFieldTile& tile) const {
    validate(tile, grid_);
    for (std::size_t j = 0; j < tile.range.nt;) {
        const std::shared_ptr<const Band> band = band_at(tile.range.t0 + j);
        const std::size_t end = std::min(tile.range.nt, band->first + band->count - tile.range.t0);
        work::parallel_for(end - j, [&](std::size_t i) {
            fill(tile, j + i, *band);
            if (tile.depth.size() > 0 && has_depth()) fill_depth(tile, j + i, *band);
        });
        j = end;
    }
}

// Returns the band of a row of hogels. One band is cached; readers share ownership.
std::shared_ptr<const ViewLightField::Band> ViewLightField::band_at(std::size_t t) const {
    const std::lock_guard lock(mutex_);
    if (band_ == nullptr || t < band_->first || t >= band_->first + band_->count) {
        band_ = nullptr;
        work::isolate([&] {
            if (spool_ == nullptr && !spool_folder_.empty() && spool_bytes() > 0) fill_spool();
            band_ = load(t / band_rows_ * band_rows_);
        });
    }
    return band_;
}

std::shared_ptr<const ViewLightField::Band> ViewLightField::load(std::size_t first) const {
    auto band = std::make_shared<Band>();
    band->first = first;
    band->count = std::min(band_rows_, grid_.hogels_t - first);
    band->views.resize(set_.rows * set_.columns);
    work::parallel_for(band->views.size(), [&](std::size_t i) {
        band->views[i] = spool_ != nullptr ? spooled(i, first, band->count) : decoded(i, first, band->count);
    });
    if (disparities_ == nullptr) return band;
    band->maps.resize(band->views.size());
    const auto set_position = [&](std::size_t i) { return static_cast<double>(i) / static_cast<double>(densified_); };
    work::parallel_for(band->maps.size(), [&](std::size_t i) {
        band->maps[i] = disparities_->at(set_position(i / set_.columns), set_position(i % set_.columns));
    });
    return band;
}

void ViewLightField::set_depth(std::shared_ptr<const Disparities> disparities, std::size_t densified, double shear) {
    disparities_ = std::move(disparities);
    densified_ = densified;
    disparity_on_hologram_ = shear;
}

// For cameras b apart at the distance D, with pixels p at the hologram, 1/Z = 1/D + disparity p/(b D), and the depth
// behind the hologram is Z - D. For orthographic views it is -disparity p over the step of U.
float ViewLightField::depth_of(double disparity) const {
    const double relative = disparity - disparity_on_hologram_, step = grid_.step_u() * static_cast<double>(densified_);
    if (set_.geometry.orthographic) return static_cast<float>(-relative * grid_.pitch / step);
    const double distance = -grid_.focal_plane()->depth, spacing = step * distance;
    const double inverse = 1 / distance + relative * grid_.pitch / (spacing * distance);
    return inverse > 0 ? static_cast<float>(1 / inverse - distance) : INFINITY;
}

void ViewLightField::fill_depth(LightFieldTile& tile, std::size_t j, const Band& band) const {
    const std::size_t n = set_.columns, m = set_.rows;
    for (std::size_t view = 0; view < n * m; ++view) {
        const std::size_t row = view / n, column = view % n;
        const DisparityMap& map = *band.maps[view];
        const double y =
            shear_.y0 + shear_.dy * static_cast<double>(row) + shear_.step_y * static_cast<double>(tile.range.t0 + j);
        const auto inside = [](double coordinate, std::size_t extent) {
            return static_cast<std::size_t>(std::clamp(std::round(coordinate), 0.0, static_cast<double>(extent - 1)));
        };
        for (std::size_t i = 0; i < tile.range.ns; ++i) {
            const double x =
                shear_.x0 + shear_.dx * static_cast<double>(column) + static_cast<double>(tile.range.s0 + i);
            tile.depth(j, i, m - 1 - row, n - 1 - column) =
                depth_of(map(inside(y, map.extent(0)), inside(x, map.extent(1))));
        }
    }
}

image::Samples ViewLightField::decoded(std::size_t view, std::size_t first, std::size_t count) const {
    const std::size_t row = view / set_.columns, column = view % set_.columns;
    image::Picture picture = set_.pictures->read(row, column);
    check(picture, row, column);
    return cut(std::move(picture.samples), row, column, first, count);
}

void ViewLightField::fill_spool() const {
    std::error_code error;
    const std::filesystem::space_info space = std::filesystem::space(spool_folder_, error);
    if (!error && static_cast<double>(space.available) < spool_bytes())
        throw Error(ErrorCode::cannot_write,
                    fmt::format("{}: {} are free, but the views take {} beside what is written", spool_folder_.string(),
                                format_bytes(static_cast<double>(space.available)), format_bytes(spool_bytes())));
    auto spool =
        std::make_unique<core::RawFile>(spool_folder_, core::RawFile::Mode::unnamed, spool_folder_ / "hogel-views");
    spool->reserve(static_cast<std::uint64_t>(spool_bytes()));
    const std::uint64_t bytes = static_cast<std::uint64_t>(spool_bytes()) / grid_.directions();
    work::parallel_for(grid_.directions(), [&](std::size_t view) {
        std::visit(
            [&](const auto& samples) {
                spool->write(view * bytes, samples.data(), samples.size() * sizeof(*samples.data()));
            },
            decoded(view, 0, grid_.hogels_t));
    });
    spool_ = std::move(spool);
}

image::Samples ViewLightField::spooled(std::size_t view, std::size_t first, std::size_t count) const {
    const std::uint64_t line = grid_.hogels_s * grid_.channels * sample_bytes();
    const auto read = [&]<class T>(Array<T, 3> samples) -> image::Samples {
        spool_->read((view * grid_.hogels_t + first) * line, samples.data(), samples.size() * sizeof(T));
        return samples;
    };
    const Shape<3> shape{count, grid_.hogels_s, grid_.channels};
    if (sample_bytes() == 1) return read(Array<std::uint8_t, 3>(shape));
    if (sample_bytes() == 2) return read(Array<std::uint16_t, 3>(shape));
    return read(Array<float, 3>(shape));
}

void ViewLightField::check(const image::Picture& picture, std::size_t row, std::size_t column) const {
    const std::string name = set_.pictures->name(row, column);
    std::visit(
        [&](const auto& samples) {
            if (samples.extent(0) != set_.height || samples.extent(1) != set_.width)
                fail_source(name, fmt::format("has {}x{} pixels, but the first view {}x{}", samples.extent(1),
                                              samples.extent(0), set_.width, set_.height));
            if (samples.extent(2) != set_.channels)
                fail_source(name,
                            fmt::format("has {} channels, but the first view {}", samples.extent(2), set_.channels));
        },
        picture.samples);
    if (max_code_of(picture) != set_.max_code)
        fail_source(name, fmt::format("has {} bits a sample, but the first view {}", bits_of(picture), set_.bits));
    if (const auto* floats = std::get_if<Array<float, 3>>(&picture.samples))
        for (const float value : floats->elements())
            if (!std::isfinite(value)) fail_source(name, "holds a sample that is not finite");
}

image::Samples ViewLightField::cut(image::Samples samples, std::size_t row, std::size_t column, std::size_t first,
                                   std::size_t count) const {
    const double x = shear_.x0 + shear_.dx * static_cast<double>(column);
    const double y = shear_.y0 + shear_.dy * static_cast<double>(row) + shear_.step_y * static_cast<double>(first);
    if (!is_whole()) return interpolated(samples, x, y, count);
    return std::visit(
        [&](auto& all) -> image::Samples {
            const auto x0 = static_cast<std::size_t>(x), y0 = static_cast<std::size_t>(y);
            if (x0 == 0 && y0 == 0 && shear_.width == all.extent(1) && count == all.extent(0)) return std::move(all);
            std::remove_cvref_t<decltype(all)> part({count, shear_.width, set_.channels});
            for (std::size_t j = 0; j < count; ++j)
                std::copy_n(&all(y0 + j, x0, 0), shear_.width * set_.channels, &part(j, 0, 0));
            return part;
        },
        samples);
}

// As cut(), interpolated between pixels in linear light.
Array<float, 3> ViewLightField::interpolated(const image::Samples& samples, double x, double y,
                                             std::size_t count) const {
    Array<float, 3> part({count, shear_.width, set_.channels});
    for (std::size_t j = 0; j < count; ++j)
        for (std::size_t i = 0; i < shear_.width; ++i)
            for (std::size_t c = 0; c < set_.channels; ++c)
                part(j, i, c) =
                    between(samples, x + static_cast<double>(i), y + shear_.step_y * static_cast<double>(j), c);
    return part;
}

float ViewLightField::between(const image::Samples& samples, double x, double y, std::size_t c) const {
    const double x_in = std::clamp(x, 0.0, static_cast<double>(set_.width - 1));
    const double y_in = std::clamp(y, 0.0, static_cast<double>(set_.height - 1));
    const auto x0 = static_cast<std::size_t>(x_in), y0 = static_cast<std::size_t>(y_in);
    const std::size_t x1 = std::min(x0 + 1, set_.width - 1), y1 = std::min(y0 + 1, set_.height - 1);
    const auto fx = static_cast<float>(x_in - static_cast<double>(x0)),
               fy = static_cast<float>(y_in - static_cast<double>(y0));
    return std::visit(
        [&](const auto& all) {
            const auto value = [&](std::size_t row, std::size_t column) { return linear(all(row, column, c)); };
            const float top = value(y0, x0) + fx * (value(y0, x1) - value(y0, x0));
            const float bottom = value(y1, x0) + fx * (value(y1, x1) - value(y1, x0));
            return top + fy * (bottom - top);
        },
        samples);
}

float ViewLightField::linear(float value) const {
    return transfer_ == Transfer::linear ? value : decode(transfer_, value);
}

void ViewLightField::fill(LightFieldTile& tile, std::size_t j, const Band& band) const {
    const std::size_t y = tile.range.t0 + j - band.first, n = set_.columns, m = set_.rows;
    for (std::size_t s0 = 0; s0 < tile.range.ns; s0 += block_hogels) {
        const std::size_t count = std::min(block_hogels, tile.range.ns - s0);
        for (std::size_t view = 0; view < n * m; ++view) {
            const std::size_t l = m - 1 - view / n, k = n - 1 - view % n;
            std::visit(
                [&](const auto& samples) {
                    for (std::size_t c = 0; c < grid_.channels; ++c)
                        gather(&samples(y, tile.range.s0 + s0, c), &tile.radiance(c, j, s0, l, k), count);
                },
                band.views[view]);
        }
    }
}

template <class T>
void ViewLightField::gather(const T* from, float* to, std::size_t count) const {
    const std::size_t step = grid_.channels, stride = grid_.directions();
    const bool stored = std::is_same_v<T, float> && is_whole();
    for (std::size_t i = 0; i < count; ++i)
        if constexpr (std::is_same_v<T, float>)
            to[i * stride] = stored ? linear(from[i * step]) : from[i * step];
        else
            to[i * stride] = linear(from[i * step]);
}

}  // namespace hogel::exchange
