// SPDX-License-Identifier: Apache-2.0
// A set of views as a light field: the picture's pixel is the hogel, the camera is the direction. Sample k of U is the
// ray that goes to the right behind the hologram, which an eye on the left sees: camera column c is k = n - 1 - c,
// camera row r (from the top) is l = n - 1 - r. The natural mapping k = c would be pseudoscopic.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "hogel/core/parallel.h"
#include "hogel/error.h"
#include "hogel/exchange/geometry.h"
#include "hogel/exchange/parallax.h"
#include "hogel/exchange/transfer.h"

namespace hogel {
namespace exchange {
namespace {

// Hogels of a row that are filled together, so that their directions stay in the cache.
constexpr std::size_t together = 64;

// Rows of all views, as stored: views[row * columns + column] is [y][x][c].
struct Band {
    std::size_t first = 0, count = 0;
    std::vector<image::Samples> views;
};

// Linear light of each code of 8 or 16 bits, to which the codes 0 to `max` of a file were scaled.
std::vector<float> linear_table(Transfer transfer, std::size_t codes, std::uint32_t max) {
    std::vector<float> table(codes);
    const std::size_t full = codes - 1;
    for (std::size_t i = 0; i < codes; ++i)
        table[i] = decode(transfer, static_cast<float>((i * max + full / 2) / full) / static_cast<float>(max));
    return table;
}

class ViewLightField final : public LightFieldSource {
  public:
    ViewLightField(ViewSet set, const Placement& placement, Transfer transfer, double memory)
        : set_(std::move(set)),
          grid_(placement.grid),
          shear_(placement.shear),
          transfer_(transfer),
          table8_(linear_table(transfer, 256, std::clamp(set_.max_code, 1u, 255u))),
          table16_(set_.max_code > 255 ? linear_table(transfer, 65536, set_.max_code) : std::vector<float>()) {
        const double sample = is_whole(shear_) ? (set_.bits <= 8 ? 1 : set_.bits <= 16 ? 2 : 4) : 4;
        const double row = static_cast<double>(grid_.directions() * grid_.hogels_s * grid_.channels) * sample;
        band_rows_ = static_cast<std::size_t>(std::clamp(memory / row, 1.0, static_cast<double>(grid_.hogels_t)));
    }

    const LightFieldGrid& grid() const override { return grid_; }
    // Long rows, no higher than a band.
    HogelRange preferred_tile() const override {
        HogelRange tile = default_tile(grid_);
        tile.ns = grid_.hogels_s;
        tile.nt = std::clamp<std::size_t>(tile.hogels() / grid_.hogels_s, 1, std::min<std::size_t>(band_rows_, 8));
        return tile;
    }
    std::size_t band_rows() const { return band_rows_; }

    void read(LightFieldTile& tile) const override {
        validate(tile, grid_);
        for (std::size_t j = 0; j < tile.range.nt;) {
            const std::shared_ptr<const Band> band = band_at(tile.range.t0 + j);
            const std::size_t end = std::min(tile.range.nt, band->first + band->count - tile.range.t0);
            core::parallel_for(end - j, [&](std::size_t i) { fill(tile, j + i, *band); });
            j = end;
        }
    }

  private:
    static bool is_whole(const Shear& shear) {
        const auto whole = [](double x) { return x == std::round(x); };
        return whole(shear.x0) && whole(shear.y0) && whole(shear.dx) && whole(shear.dy) && shear.step_y == 1;
    }

    // The band that holds a row of hogels. One is kept; threads that still read another hold that one themselves.
    std::shared_ptr<const Band> band_at(std::size_t t) const {
        const std::lock_guard lock(mutex_);
        if (band_ == nullptr || t < band_->first || t >= band_->first + band_->count) {
            band_ = nullptr;
            core::isolate([&] { band_ = load(t / band_rows_ * band_rows_); });
        }
        return band_;
    }

    std::shared_ptr<const Band> load(std::size_t first) const {
        auto band = std::make_shared<Band>();
        band->first = first;
        band->count = std::min(band_rows_, grid_.hogels_t - first);
        band->views.resize(set_.rows * set_.columns);
        core::parallel_for(band->views.size(), [&](std::size_t i) {
            const std::size_t row = i / set_.columns, column = i % set_.columns;
            image::Picture picture = set_.pictures->read(row, column);
            check(picture, row, column);
            band->views[i] = cut(std::move(picture.samples), row, column, *band);
        });
        return band;
    }

    void check(const image::Picture& picture, std::size_t row, std::size_t column) const {
        const std::string name = set_.pictures->name(row, column);
        std::visit(
            [&](const auto& samples) {
                if (samples.extent(0) != set_.height || samples.extent(1) != set_.width)
                    fail_source(name, fmt::format("has {}x{} pixels, but the first view {}x{}", samples.extent(1),
                                                  samples.extent(0), set_.width, set_.height));
                if (samples.extent(2) != set_.channels)
                    fail_source(
                        name, fmt::format("has {} channels, but the first view {}", samples.extent(2), set_.channels));
            },
            picture.samples);
        if (max_code_of(picture) != set_.max_code)
            fail_source(name, fmt::format("has {} bits a sample, but the first view {}", bits_of(picture), set_.bits));
        if (const auto* floats = std::get_if<Array<float, 3>>(&picture.samples))
            for (const float value : floats->elements())
                if (!std::isfinite(value)) fail_source(name, "holds a sample that is not finite");
    }

    // The pixels of a view that become the hogels of a band.
    image::Samples cut(image::Samples samples, std::size_t row, std::size_t column, const Band& band) const {
        const double x = shear_.x0 + shear_.dx * static_cast<double>(column);
        const double y =
            shear_.y0 + shear_.dy * static_cast<double>(row) + shear_.step_y * static_cast<double>(band.first);
        if (!is_whole(shear_)) return interpolated(samples, x, y, band.count);
        return std::visit(
            [&](auto& all) -> image::Samples {
                const auto x0 = static_cast<std::size_t>(x), y0 = static_cast<std::size_t>(y);
                if (x0 == 0 && y0 == 0 && shear_.width == all.extent(1) && band.count == all.extent(0))
                    return std::move(all);
                std::remove_cvref_t<decltype(all)> part({band.count, shear_.width, set_.channels});
                for (std::size_t j = 0; j < band.count; ++j)
                    std::copy_n(&all(y0 + j, x0, 0), shear_.width * set_.channels, &part(j, 0, 0));
                return part;
            },
            samples);
    }

    // The same between pixels, in linear light.
    Array<float, 3> interpolated(const image::Samples& samples, double x, double y, std::size_t count) const {
        Array<float, 3> part({count, shear_.width, set_.channels});
        for (std::size_t j = 0; j < count; ++j)
            for (std::size_t i = 0; i < shear_.width; ++i)
                for (std::size_t c = 0; c < set_.channels; ++c)
                    part(j, i, c) =
                        between(samples, x + static_cast<double>(i), y + shear_.step_y * static_cast<double>(j), c);
        return part;
    }

    float between(const image::Samples& samples, double x, double y, std::size_t c) const {
        const double x_in = std::clamp(x, 0.0, static_cast<double>(set_.width - 1));
        const double y_in = std::clamp(y, 0.0, static_cast<double>(set_.height - 1));
        const auto x0 = static_cast<std::size_t>(x_in), y0 = static_cast<std::size_t>(y_in);
        const std::size_t x1 = std::min(x0 + 1, set_.width - 1), y1 = std::min(y0 + 1, set_.height - 1);
        const auto fx = static_cast<float>(x_in - static_cast<double>(x0)),
                   fy = static_cast<float>(y_in - static_cast<double>(y0));
        return std::visit(
            [&](const auto& all) {
                const auto at = [&](std::size_t row, std::size_t column) { return linear(all(row, column, c)); };
                const float top = at(y0, x0) + fx * (at(y0, x1) - at(y0, x0));
                const float bottom = at(y1, x0) + fx * (at(y1, x1) - at(y1, x0));
                return top + fy * (bottom - top);
            },
            samples);
    }

    float linear(std::uint8_t code) const { return table8_[code]; }
    float linear(std::uint16_t code) const { return table16_[code]; }
    float linear(float value) const { return transfer_ == Transfer::linear ? value : decode(transfer_, value); }

    // One row of hogels of a tile.
    void fill(LightFieldTile& tile, std::size_t j, const Band& band) const {
        const std::size_t y = tile.range.t0 + j - band.first, n = set_.columns, m = set_.rows;
        for (std::size_t s0 = 0; s0 < tile.range.ns; s0 += together) {
            const std::size_t count = std::min(together, tile.range.ns - s0);
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
    void gather(const T* from, float* to, std::size_t count) const {
        const std::size_t step = grid_.channels, stride = grid_.directions();
        const bool stored = std::is_same_v<T, float> && is_whole(shear_);
        for (std::size_t i = 0; i < count; ++i)
            if constexpr (std::is_same_v<T, float>)
                to[i * stride] = stored ? linear(from[i * step]) : from[i * step];
            else
                to[i * stride] = linear(from[i * step]);
    }

    ViewSet set_;
    LightFieldGrid grid_;
    Shear shear_;
    Transfer transfer_;
    std::vector<float> table8_, table16_;
    std::size_t band_rows_ = 1;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const Band> band_;
};

// What a parallax of more than a pixel from view to view means: docs/exchange.md.
std::string sparse_views(const ViewSet& set, double parallax) {
    const auto enough = [&](std::size_t views) {
        return views < 2 ? views : static_cast<std::size_t>(std::ceil(static_cast<double>(views - 1) * parallax)) + 1;
    };
    return fmt::format(
        "views are sparse: things are seen to jump by up to {:.2g} hogels from a view to the next; {}x{} views "
        "over the same angle would do",
        parallax, enough(set.columns), enough(set.rows));
}

}  // namespace
}  // namespace exchange

ImportedViews import_views(const std::filesystem::path& source, const ViewOptions& options, const Progress& progress) {
    using namespace exchange;
    const core::StopScope scope(progress);
    ViewSet set = open_views(source, options);
    const Placement placement = place(set, options);
    const Transfer transfer = options.transfer.value_or(set.bits == 32 ? Transfer::linear : Transfer::srgb);
    const ParallaxEvidence evidence = parallax_of(set, options.disparity);
    const double parallax = std::max(evidence.across, evidence.down);
    Provenance provenance;
    provenance.entries = {{"views", set.layout},
                          {"views bits", fmt::format("{}", set.bits)},
                          {"views transfer", transfer_names()[static_cast<std::size_t>(transfer)]}};
    std::string summary = describe(set, placement, parallax);
    std::vector<std::string> notes = set.notes;
    if (parallax > 1) notes.push_back(sparse_views(set, parallax));
    const std::string layout = set.layout;
    const std::size_t columns = set.columns, rows = set.rows;
    const unsigned bits = set.bits;
    LightField light_field(std::make_shared<ViewLightField>(std::move(set), placement, transfer, options.memory));
    return {light_field.with(std::move(provenance)),
            layout,
            columns,
            rows,
            bits,
            transfer,
            placement.spacing,
            placement.distance,
            placement.scale,
            parallax,
            std::move(summary),
            placement.assumed,
            std::move(notes)};
}

void write_views(const LightField& light_field, LightFieldSink& sink, const Progress& progress) {
    using namespace exchange;
    const core::StopScope scope(progress);
    const auto* views = dynamic_cast<const ViewLightField*>(&light_field.front());
    if (views == nullptr) return copy(light_field.front(), sink, progress);
    const LightFieldGrid& grid = views->grid();
    for (std::size_t t = 0; t < grid.hogels_t; t += views->band_rows()) {
        const std::size_t rows = std::min(views->band_rows(), grid.hogels_t - t);
        const HogelRange tile_size = views->preferred_tile();
        const std::size_t tiles = (rows + tile_size.nt - 1) / tile_size.nt;
        std::atomic<std::size_t> done = 0;
        core::parallel_for(tiles, [&](std::size_t i) {
            const std::size_t t0 = t + i * tile_size.nt;
            const HogelRange range{0, t0, grid.hogels_s, std::min(tile_size.nt, t + rows - t0)};
            if (!sink.has_already(range)) {
                LightFieldTile tile(grid, range, false);
                views->read(tile);
                sink.write(tile);
            }
            ++done;
        });
        progress.report(static_cast<double>(t + rows) / static_cast<double>(grid.hogels_t));
    }
    sink.finish();
}

}  // namespace hogel
