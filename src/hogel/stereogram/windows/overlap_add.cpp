// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/windows/overlap_add.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "hogel/core/object_pool.h"
#include "hogel/core/thread_buffer.h"
#include "hogel/math/fft.h"
#include "hogel/stereogram/hogel_synthesis.h"
#include "hogel/stereogram/point_cycles.h"
#include "hogel/stereogram/unit_roots.h"
#include "hogel/stereogram/windows/batch.h"
#include "hogel/stereogram/windows/brightness.h"

namespace hogel::stereogram::windows {
namespace {

using Complex = std::complex<float>;

std::vector<float> hann_window(std::size_t side) {
    std::vector<float> window;
    for (std::size_t i = 0; i < side; ++i)
        window.push_back(static_cast<float>(
            std::pow(std::sin(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(side)), 2)));
    return window;
}

HogelRange points_of(const HogelRange& hogels) {
    const auto scaled = [](std::size_t hogel) {
        return static_cast<std::size_t>(static_cast<double>(hogel) / point_spacing);
    };
    return {scaled(hogels.s0), scaled(hogels.t0), scaled(hogels.ns) + 2, scaled(hogels.nt) + 2};
}

std::int64_t nearest_whole(double x) { return static_cast<std::int64_t>(x < 0 ? x - 0.5 : x + 0.5); }

// Returns how much farther apart than hogels are the points that neighbouring hogels see in one direction: (U/ζ) ∂ζ/∂U
// along an axis. The derivative is the smaller difference of three adjacent rays, which avoids edges.
// @param slope  U/ΔU
float surface_stretch(std::span<const float> depths, const std::array<std::uint32_t, 3>& along, float depth,
                      float slope) {
    const float margin = depths[along[1]] - depths[along[0]], after = depths[along[2]] - depths[along[1]];
    const float stretch = (std::abs(margin) < std::abs(after) ? margin : after) * slope / depth;
    return std::isfinite(stretch) ? std::clamp(stretch, WindowBrightness::min_stretch, WindowBrightness::max_stretch)
                                  : 0;
}

// Stereogram of overlapping windows. A Hann window around each hogel's centre contains the waves of its directions, by
// one Fourier transform, each with the phase of a spherical wave from the point that the ray meets. The hologram is the
// sum of the windows. Source: Padmanaban, Peng and Wetzstein, "Holographic near-eye displays based on overlap-add
// stereograms", ACM TOG 38(6), 2019.
class OverlapAddHologram final : public Stereogram, public HogelWaves {
  public:
    OverlapAddHologram(const LightField& light_field, const FieldGrid& grid, const HologramOptions& options,
                       PointPhases phases, bool plain)
        : source_(light_field),
          light_field_(source_.front()),
          phases_(phases),
          options_(options),
          grid_(grid),
          hop_(grid.plane.width / light_field_.grid().hogels_s),
          side_(window_layout(light_field_.grid(), grid).columns),
          fft_(side_, side_),
          window_(hann_window(side_)),
          brightness_(light_field_.grid(), grid, hop_, window_, phases) {
        for (const float row : window_)
            for (const float column : window_) square_.push_back(row * column);
        hogels_a_metre_ = 1 / light_field_.grid().pitch;
        waves_a_metre_ = 1 / grid.wavelength;
        const double U = light_field_.grid().center_u(), V = light_field_.grid().center_v();
        reference_cosine_ = 1 / std::sqrt(1 + U * U + V * V);
        list_directions();
        batches_ = !plain && side_ <= WindowBatch::max_side && !directions_.empty();
    }

    const FieldGrid& grid() const override { return grid_; }
    std::size_t looks() const override { return options_.looks; }
    std::size_t alignment() const override { return hop_; }
    std::size_t overlap() const override { return hop_; }
    const Provenance& provenance() const override { return source_.provenance(); }

    void read(const Region& region, std::size_t look, View<Complex, 2> out) const override {
        validate(region, grid_, out.shape());
        const auto [s0, ns] = windows_over(region.x0, region.width, light_field_.grid().hogels_s);
        const auto [t0, nt] = windows_over(region.y0, region.height, light_field_.grid().hogels_t);
        auto scratch = scratch_pool_.take();
        if (batches_)
            add_batches({s0, t0, ns, nt}, region, look, *scratch, out);
        else
            add_plain({s0, t0, ns, nt}, region, look, *scratch, out);
    }

    // Stores no amplitudes: they and the phases depend on the depth of every ray and are as large as the light field.
    Hogels hogels() const override {
        Hogels hogels{window_layout(light_field_.grid(), grid_), this, {}, {}, {}};
        hogels.prepare = [this](const HogelRange& range, View<float, 2> prepared) {
            auto scratch = scratch_pool_.take();
            std::size_t first = 0;
            for_each_band(range, scratch->tile, [&](const LightFieldTile& tile) {
                const std::size_t rays = light_field_.grid().directions(), count = tile.range.hogels();
                const View<float, 2> values(&prepared(first, 0), {count, prepared.extent(1)});
                prepare({tile.radiance.view()[options_.channel.index].data(), {count, rays}},
                        {tile.depth.data(), {count, rays}}, values);
                first += count;
            });
        };
        return hogels;
    }

    std::size_t prepared_size() const override { return 2 * light_field_.grid().directions(); }  // rays and depths
    void prepare(View<const float, 2> radiances, View<const float, 2> depths, View<float, 2> prepared) const override {
        const std::size_t rays = radiances.extent(1);
        for (std::size_t hogel = 0; hogel < radiances.extent(0); ++hogel) {
            std::copy_n(&radiances(hogel, 0), rays, &prepared(hogel, 0));
            std::copy_n(&depths(hogel, 0), rays, &prepared(hogel, rays));
        }
    }
    void waves(std::span<const float> prepared, const HogelKey& key, const InBandRows& rows,
               float* waves) const override {
        const core::ThreadBuffer<Complex> buffer(side_ * side_);
        const View<Complex, 2> window(buffer.data(), {side_, side_});
        const std::size_t rays = light_field_.grid().directions();
        const CycleSeries points = cycle_series(key.look);
        fill(prepared.first(rays), prepared.subspan(rays), key, phases_ == PointPhases::random ? &points : nullptr,
             window);
        if (is_clipped(key)) clip(key, window);
        store_waves(window, rows, waves);
    }

  private:
    static constexpr std::size_t band_rays = std::size_t{1} << 18;

    // Returns whether the window extends beyond the hologram.
    bool is_clipped(const HogelKey& key) const {
        const std::size_t margin_hogels = (side_ / hop_) / 2;
        const LightFieldGrid& hogels = light_field_.grid();
        return key.s < margin_hogels || key.t < margin_hogels || key.s + margin_hogels >= hogels.hogels_s ||
               key.t + margin_hogels >= hogels.hogels_t;
    }

    // Replaces the waves of a window by those of its samples within the hologram.
    void clip(const HogelKey& key, View<Complex, 2> window) const {
        fft_.backward(window);
        const std::size_t margin = (side_ - hop_) / 2;
        const auto inside = [&](std::size_t hogel, std::size_t sample, std::size_t samples) {
            const std::size_t position = hogel * hop_ + sample;
            return position >= margin && position < samples + margin;
        };
        const float share = 1 / static_cast<float>(side_ * side_);
        for (std::size_t y = 0; y < side_; ++y)
            for (std::size_t x = 0; x < side_; ++x) {
                const bool is_inside = inside(key.t, y, grid_.plane.height) && inside(key.s, x, grid_.plane.width);
                window(y, x) *= is_inside ? share : 0;
            }
        fft_.forward(window);
    }

    struct Scratch {
        LightFieldTile tile;
        std::optional<WindowBatch> batch;
        WindowBatch::Sum sum;
    };

    // Calls use(tile) for bands of hogel rows, to bound memory.
    template <class Use>
    void for_each_band(const HogelRange& hogels, LightFieldTile& tile, const Use& use) const {
        const std::size_t rows = std::max<std::size_t>(1, band_rays / (hogels.ns * light_field_.grid().directions()));
        for (std::size_t t = hogels.t0; t < hogels.t0 + hogels.nt; t += rows) {
            const HogelRange band{hogels.s0, t, hogels.ns, std::min(rows, hogels.t0 + hogels.nt - t)};
            if (tile.range.ns != band.ns || tile.range.nt != band.nt)
                tile = LightFieldTile(light_field_.grid(), band, true);
            tile.range = band;
            light_field_.read(tile);
            use(tile);
        }
    }

    // Plain version. Adds windows to a sample in the same order for every region.
    void add_plain(const HogelRange& hogels, const Region& region, std::size_t look, Scratch& scratch,
                   View<Complex, 2> out) const {
        std::fill(out.data(), out.data() + out.size(), Complex(0));
        Array<Complex, 2> window({side_, side_});
        std::optional<PointCycles> points;
        if (phases_ == PointPhases::random) points.emplace(cycle_series(look), points_of(hogels));
        for_each_band(hogels, scratch.tile, [&](const LightFieldTile& tile) {
            const HogelRange& range = tile.range;
            for (std::size_t j = 0; j < range.nt; ++j)
                for (std::size_t i = 0; i < range.ns; ++i) {
                    fill(tile.radiance.view()[options_.channel.index][j][i].elements(), tile.depth[j][i].elements(),
                         {range.s0 + i, range.t0 + j, look}, points ? &*points : nullptr, window);
                    fft_.backward(window);
                    add(window, range.s0 + i, range.t0 + j, region, out);
                }
        });
    }

    // Batches begin at the same hogels for every region: windows are added to a sample in the same order.
    void add_batches(HogelRange hogels, const Region& region, std::size_t look, Scratch& scratch,
                     View<Complex, 2> out) const {
        constexpr std::size_t batch_size = WindowBatch::hogels;
        const std::size_t end =
            std::min(light_field_.grid().hogels_s, (hogels.s0 + hogels.ns + batch_size - 1) / batch_size * batch_size);
        hogels.s0 = hogels.s0 / batch_size * batch_size;
        hogels.ns = end - hogels.s0;
        if (!scratch.batch) {
            WindowBatch::Shared shared{side_, hop_, &directions_, &brightness_, &window_};
            shared.hogels_a_metre = hogels_a_metre_;
            shared.waves_a_metre = waves_a_metre_;
            shared.pitch = light_field_.grid().pitch;
            shared.reference_cosine = reference_cosine_;
            scratch.batch.emplace(shared);
        }
        const std::size_t margin = (side_ - hop_) / 2;
        WindowBatch::Sum& sum = scratch.sum;
        sum.first_x = hogels.s0 * hop_;
        sum.first_y = region.y0 + margin;
        sum.height = region.height;
        sum.length = (hogels.ns + batch_size - 1) / batch_size * batch_size + side_ / hop_ + 1;
        for (Array<float, 1>* part : {&sum.re, &sum.im}) {
            const std::size_t size = sum.height * hop_ * sum.length;
            if (part->size() < size)
                *part = Array<float, 1>({size});
            else
                std::fill_n(part->data(), size, 0.0f);
        }
        std::optional<PointCycles> points;
        if (phases_ == PointPhases::random) points.emplace(cycle_series(look), points_of(hogels));
        for_each_band(hogels, scratch.tile, [&](const LightFieldTile& tile) {
            for (std::size_t j = 0; j < tile.range.nt; ++j)
                for (std::size_t i = 0; i < tile.range.ns; i += batch_size)
                    add_batch(tile, i, j, look, points ? &*points : nullptr, scratch);
        });
        for (std::size_t y = 0; y < region.height; ++y)
            for (std::size_t x = 0; x < region.width; ++x) {
                const std::size_t position = region.x0 + margin + x;
                const std::size_t from = (y * hop_ + position % hop_) * sum.length + position / hop_ - hogels.s0;
                out(y, x) = {sum.re.data()[from], sum.im.data()[from]};
            }
    }

    void add_batch(const LightFieldTile& tile, std::size_t i, std::size_t j, std::size_t look,
                   const PointCycles* points, Scratch& scratch) const {
        const std::size_t s = tile.range.s0 + i, t = tile.range.t0 + j;
        WindowBatch::PointCycles cycles_of_points;
        if (points)
            cycles_of_points = [=](const std::int32_t* columns, const std::int32_t* rows, float* cycles) {
                for (std::size_t k = 0; k < WindowBatch::hogels; ++k)
                    cycles[k] = static_cast<float>((*points)(columns[k], rows[k]));
            };
        const CycleSeries cycles = cycle_series(look);
        const WindowBatch::Start start{s, t, cycles.series, cycles.key};
        const std::size_t count = std::min(WindowBatch::hogels, tile.range.ns - i);
        if (scratch.batch->fill(start, &tile.radiance(options_.channel.index, j, i, 0, 0), &tile.depth(j, i, 0, 0),
                                count, light_field_.grid().directions(), cycles_of_points))
            scratch.batch->add(start, scratch.sum);
    }

    void list_directions() {
        const LightFieldGrid& rays = light_field_.grid();
        const double step = grid_.wavelength / (static_cast<double>(side_) * grid_.plane.pitch_x);
        const auto n = static_cast<std::ptrdiff_t>(side_);
        const std::ptrdiff_t max_index = (n - 1) / 2;
        for (std::ptrdiff_t jy = -max_index; jy <= max_index; ++jy)
            for (std::ptrdiff_t jx = -max_index; jx <= max_index; ++jx) {
                const double sx = step * static_cast<double>(jx), sy = step * static_cast<double>(jy);
                const double cos2 = 1 - sx * sx - sy * sy;
                if (cos2 <= 0) continue;
                const double cosine = std::sqrt(cos2), U = -sx / cosine, V = -sy / cosine;
                if (!rays.covers({U, V, 1})) continue;
                const auto nearest = [](double position, std::size_t count) {
                    return static_cast<std::size_t>(
                        std::clamp(std::round(position), 0.0, static_cast<double>(count) - 1));
                };
                const std::size_t k = nearest(rays.column(U), rays.directions_u);
                const std::size_t l = nearest(rays.row(V), rays.directions_v);
                // Middle of three adjacent rays; with fewer rays, the ray itself.
                const auto middle = [](std::size_t position, std::size_t count) {
                    return count < 3 ? position : std::clamp<std::size_t>(position, 1, count - 2);
                };
                const auto three = [](std::size_t ray, std::size_t stride) {
                    return std::array{static_cast<std::uint32_t>(ray - stride), static_cast<std::uint32_t>(ray),
                                      static_cast<std::uint32_t>(ray + stride)};
                };
                const std::size_t n_u = rays.directions_u;
                const auto along_u = three(l * n_u + middle(k, n_u), n_u < 3 ? 0 : 1);
                const auto along_v = three(middle(l, rays.directions_v) * n_u + k, rays.directions_v < 3 ? 0 : n_u);
                // Windows of a smooth surface interfere alike at any slope: no correction.
                const double slope_scale = phases_ == PointPhases::random ? 1 : 0;
                // Rows run downwards, y upwards: the row of the transform is −j_y.
                const auto row = static_cast<std::size_t>((n - jy) % n),
                           column = static_cast<std::size_t>((n + jx) % n);
                const double first = -0.5 * static_cast<double>(n - 1) / static_cast<double>(n);
                directions_.push_back({static_cast<std::uint32_t>(row * side_ + column),
                                       static_cast<std::uint32_t>(l * rays.directions_u + k),
                                       static_cast<float>(step * step / cosine), static_cast<float>(U),
                                       static_cast<float>(V), (1 / cosine - reference_cosine_) / grid_.wavelength,
                                       static_cast<double>(jx - jy) * first, along_u, along_v,
                                       static_cast<float>(slope_scale * U / (rays.u(1) - rays.u(0))),
                                       static_cast<float>(slope_scale * V / (rays.v(1) - rays.v(0))),
                                       static_cast<std::uint32_t>(brightness_.first(jx)),
                                       static_cast<std::uint32_t>(brightness_.first(jy))});
            }
    }

    // @param points  phases of points by column and row; null if points have no phases
    template <class Points>
    void fill(std::span<const float> radiance, std::span<const float> depths, const HogelKey& key, const Points* points,
              View<Complex, 2> window) const {
        std::fill(window.data(), window.data() + window.size(), Complex(0));
        for (const WindowDirection& direction : directions_) {
            const float light = radiance[direction.ray] * direction.share;
            if (!(light > 0)) continue;
            // Rays that meet no surface are a backdrop: on the plane if smooth, a distant surface if rough.
            float depth = depths[direction.ray];
            if (!points && !std::isfinite(depth)) depth = 0;
            double cycles = direction.first_cycles;
            float amplitude = std::sqrt(light);
            const std::size_t step = std::isfinite(depth) ? brightness_.step_of(depth) : WindowBrightness::steps - 1;
            amplitude *= brightness_.on_slope(brightness_.across()[direction.across + step],
                                              surface_stretch(depths, direction.along_u, depth, direction.slope_u)) *
                         brightness_.on_slope(brightness_.down()[direction.down + step],
                                              surface_stretch(depths, direction.along_v, depth, direction.slope_v));
            if (std::isfinite(depth))
                cycles += points ? cycles_of_point(direction, depth, key, *points) : depth * direction.cycles_per_depth;
            else
                cycles += backdrop_cycles(direction, key);
            window.data()[direction.coefficient] = amplitude * roots_(cycles);
        }
    }

    CycleSeries cycle_series(std::size_t look) const {
        return {{static_cast<std::uint32_t>(options_.seed), static_cast<std::uint32_t>(options_.seed >> 32)},
                static_cast<std::uint32_t>(look * 4 + options_.channel.index)};
    }

    // Rays that meet no surface are treated as rays to a distant one, with different points for neighbouring windows.
    double backdrop_cycles(const WindowDirection& direction, const HogelKey& key) const {
        return cycle_series(key.look)(static_cast<std::uint32_t>(key.s), static_cast<std::uint32_t>(key.t),
                                      direction.coefficient + 1);
    }

    // A diffuse surface consists of points, point_spacing hogels apart in x and y; a ray shows the nearest one.
    template <class Points>
    double cycles_of_point(const WindowDirection& direction, double depth, const HogelKey& key,
                           const Points& points) const {
        const double pitch = light_field_.grid().pitch, hogels = depth * hogels_a_metre_;
        const auto s = static_cast<double>(key.s), t = static_cast<double>(key.t);
        const std::int64_t column = nearest_whole((s + direction.U * hogels) / point_spacing),
                           row = nearest_whole((t - direction.V * hogels) / point_spacing);
        const double x = (static_cast<double>(column) * point_spacing - s) * pitch,
                     y = (t - static_cast<double>(row) * point_spacing) * pitch;
        const double distance = std::copysign(std::sqrt(depth * depth + x * x + y * y), depth);
        return (distance - depth * reference_cosine_) * waves_a_metre_ +
               points(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
    }

    // Returns the first hogel and the number of hogels with windows over samples first..first+samples−1.
    std::pair<std::size_t, std::size_t> windows_over(std::size_t first, std::size_t samples, std::size_t hogels) const {
        const std::size_t margin = (side_ - hop_) / 2;
        const std::size_t from = first + margin >= side_ ? (first + margin - side_) / hop_ + 1 : 0;
        const std::size_t to = std::min(hogels - 1, (first + samples - 1 + margin) / hop_);
        return {from, to - from + 1};
    }

    void add(View<const Complex, 2> window, std::size_t s, std::size_t t, const Region& region,
             View<Complex, 2> out) const {
        const auto margin = static_cast<std::ptrdiff_t>((side_ - hop_) / 2);
        // Position of the window's first sample in the region.
        const auto left = static_cast<std::ptrdiff_t>(s * hop_) - margin - static_cast<std::ptrdiff_t>(region.x0);
        const auto top = static_cast<std::ptrdiff_t>(t * hop_) - margin - static_cast<std::ptrdiff_t>(region.y0);
        const auto range = [this](std::ptrdiff_t start, std::size_t length) {
            return std::pair{static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, -start)),
                             static_cast<std::size_t>(std::min(static_cast<std::ptrdiff_t>(side_),
                                                               static_cast<std::ptrdiff_t>(length) - start))};
        };
        const auto [q0, q1] = range(top, region.height);
        const auto [p0, p1] = range(left, region.width);
        for (std::size_t q = q0; q < q1; ++q) {
            const Complex* from = &window(q, 0);
            Complex* to = &out(static_cast<std::size_t>(top + static_cast<std::ptrdiff_t>(q)),
                               static_cast<std::size_t>(left + static_cast<std::ptrdiff_t>(p0)));
            const float* weights = &square_[q * side_];
            for (std::size_t p = p0; p < p1; ++p) *to++ += from[p] * weights[p];
        }
    }

    LightField source_;
    const LightFieldSource& light_field_;
    PointPhases phases_;
    HologramOptions options_;
    FieldGrid grid_;
    std::size_t hop_, side_;  // samples of a hogel's and a window's side
    math::Fft2 fft_;
    UnitRoots roots_;
    std::vector<float> window_;  // along one axis
    WindowBrightness brightness_;
    std::vector<float> square_;  // [q][p]: the window in two dimensions
    std::vector<WindowDirection> directions_;
    // Reciprocals, to avoid divisions per ray.
    double hogels_a_metre_ = 0, waves_a_metre_ = 0;
    double reference_cosine_ = 1;
    bool batches_ = false;  // whether to use WindowBatch
    mutable core::ObjectPool<Scratch> scratch_pool_;
};

}  // namespace

HogelLayout window_layout(const LightFieldGrid& light_field, const FieldGrid& grid) {
    const std::size_t hop = grid.plane.width / light_field.hogels_s;
    const double step = std::min(light_field.step_u(), light_field.step_v());
    const double hogels = std::round(grid.wavelength / (step * light_field.pitch));
    auto side = static_cast<std::size_t>(std::max(2.0, hogels));
    if (hop % 2 == 1 && side % 2 == 0) ++side;
    return {grid, side * hop, side * hop, side, HogelWindow::hann};
}

std::shared_ptr<const FieldSource> make_overlap_add(const LightField& light_field, const FieldGrid& grid,
                                                    const HologramOptions& options, PointPhases phases, bool plain) {
    return std::make_shared<OverlapAddHologram>(light_field, grid, options, phases, plain);
}

}  // namespace hogel::stereogram::windows
