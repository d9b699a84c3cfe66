// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram.h"

#include <algorithm>
#include <list>
#include <mutex>
#include <numeric>

#include "hogel/core/object_pool.h"
#include "hogel/lightfield/channel_source.h"
#include "hogel/resources.h"
#include "hogel/stereogram/hogel_synthesis.h"
#include "hogel/stereogram/stereogram.h"
#include "hogel/stereogram/windows/overlap_add.h"
#include "hogel/work/parallel.h"

namespace hogel {

using namespace stereogram;
using lightfield::ChannelSource;

namespace {

using Complex = std::complex<float>;

// Prepared values of a range of hogels, [hogel][...], row-major, shared by all looks.
struct Prepared {
    HogelRange range;
    Array<float, 2> values;
};

std::unique_ptr<HogelSynthesis> make_synthesis(std::span<const LightFieldGrid> faces, std::size_t columns,
                                               std::size_t rows, const HologramOptions& options, RayValues values) {
    if (const auto* basis = std::get_if<Basis>(&options.method))
        return make_basis_synthesis(faces, columns, rows, options, *basis, values);
    if (const auto* added = std::get_if<PhaseAdded>(&options.method))
        return make_phase_added_synthesis(faces.front(), columns, options, added->exact);
    if (const auto* lines = std::get_if<Lines>(&options.method))
        return make_line_synthesis(faces, columns, rows, options, *lines);
    return make_fourier_synthesis(faces, columns, options, std::get<Fourier>(options.method));
}

class HogelsSideBySide final : public Stereogram {
  public:
    HogelsSideBySide(const LightField& light_field, const FieldGrid& grid, const HologramOptions& options,
                     RayValues values)
        : light_field_(light_field),
          channel_(options.channel.index),
          looks_(options.looks),
          with_depth_(needs_depth(options.method)),
          grid_(grid),
          columns_(grid.plane.width / front().hogels_s),
          rows_(grid.plane.height / front().hogels_t) {
        const std::vector<LightFieldGrid> grids = light_field.grids();
        for (const LightFieldGrid& face : grids) rays_ += face.directions();
        synthesis_ = make_synthesis(grids, columns_, rows_, options, values);
    }

    const FieldGrid& grid() const override { return grid_; }
    std::size_t looks() const override { return looks_; }
    std::size_t alignment() const override { return std::lcm(columns_, rows_); }
    const Provenance& provenance() const override { return light_field_.provenance(); }

    void read(const Region& region, std::size_t look, View<Complex, 2> out) const override {
        if (region.samples() == 0) return;
        const HogelRange hogels = layout().range_of(region);
        auto scratch = scratch_pool_.take();
        if (scratch->square.size() == 0) scratch->square = Array<Complex, 2>({rows_, columns_});
        if (looks_ > 1) {
            write(prepare(hogels)->values, hogels, 0, look, region, scratch->square, out);
            return;
        }
        const View<const float, 5> rays = rays_in_memory(hogels);
        // Batches of hogels keep their values in cache.
        const std::size_t value_count = synthesis_->prepared_size();
        const std::size_t batch = std::min(hogels_per_batch, hogels.hogels());
        if (scratch->prepared.size() < batch * value_count) scratch->prepared = Array<float, 2>({batch, value_count});
        for_each_band(hogels, [&](const HogelRange& band) {
            if (rays.size() == 0) read_rays(band, scratch->rays);
            for (std::size_t first = 0; first < band.hogels(); first += hogels_per_batch) {
                const View<float, 2> values(scratch->prepared.data(),
                                            {std::min(hogels_per_batch, band.hogels() - first), value_count});
                if (rays.size() > 0)
                    synthesis_->prepare(
                        {&rays(channel_, band.t0, band.s0, 0, 0) + first * rays_, {values.extent(0), rays_}}, {},
                        values);
                else
                    prepare(*synthesis_, scratch->rays, first, values);
                write(values, band, first, look, region, scratch->square, out);
            }
        });
    }

    Hogels hogels() const override {
        const HogelWaves* waves = synthesis_->hogel_waves();
        Hogels hogels{layout(), waves, {}, kept_, {}};
        if (waves == nullptr) return hogels;
        hogels.prepare = [this, waves](const HogelRange& range, View<float, 2> prepared) {
            prepare(*waves, range, scratch_pool_.take()->rays, prepared);
        };
        if (kept_.size() > 0 || light_field_.front().in_memory().size() > 0 || reads_channels()) return hogels;
        HogelRays& rays = hogels.rays.emplace();
        rays.faces = faces();
        rays.with_depth = with_depth_;
        rays.bytes_a_hogel = rays_ * (front().channels + (with_depth_ ? 1 : 0)) * sizeof(float);
        rays.read = [this](const HogelRange& range, std::vector<LightFieldTile>& tiles) {
            read_rays(range, tiles, true);
        };
        rays.prepare = [this, waves](std::span<const LightFieldTile> tiles, View<float, 2> prepared) {
            prepare(*waves, tiles, 0, prepared);
        };
        return hogels;
    }

    std::size_t keep_amplitudes(std::size_t memory) const override {
        const HogelWaves* waves = synthesis_->hogel_waves();
        if (waves == nullptr) return 0;
        const Shape<2> shape{front().hogels(), waves->prepared_size()};
        const std::size_t bytes = shape[0] * shape[1] * sizeof(float);
        if (bytes > memory) return 0;
        if (kept_.size() > 0) return bytes;
        Array<float, 2> amplitudes(shape);
        work::parallel_for(front().hogels_t, [&](std::size_t t) {
            auto scratch = scratch_pool_.take();
            const HogelRange row{0, t, front().hogels_s, 1};
            prepare(*waves, row, scratch->rays, {&amplitudes(t * row.ns, 0), {row.ns, shape[1]}});
        });
        kept_ = std::move(amplitudes);
        return bytes;
    }

  private:
    static constexpr std::size_t hogels_per_batch = 16;
    // Maximum bytes of rays per read (but at least one row of hogels): the rays of a region may take gigabytes.
    static constexpr std::size_t max_ray_bytes = std::size_t{1} << 27;

    HogelLayout layout() const { return {grid_, columns_, rows_}; }
    const LightFieldGrid& front() const { return light_field_.grid(); }
    std::span<const LightField::Source> faces() const { return light_field_.faces(); }

    struct Scratch {
        std::vector<LightFieldTile> rays;  // one per face
        Array<float, 2> prepared;          // [hogels_per_batch][...]
        Array<Complex, 2> square;          // a hogel
    };

    // Returns a view of the rays if the source holds them contiguously in memory; otherwise an empty view.
    View<const float, 5> rays_in_memory(const HogelRange& hogels) const {
        if (faces().size() > 1 || with_depth_ || (hogels.nt > 1 && hogels.ns < front().hogels_s)) return {};
        return light_field_.front().in_memory();
    }

    // Calls use(range) for consecutive bands of hogel rows, each read at once.
    template <class Use>
    void for_each_band(const HogelRange& hogels, const Use& use) const {
        const std::size_t values = front().channels + (with_depth_ ? 1 : 0);
        const std::size_t row_bytes = hogels.ns * rays_ * values * sizeof(float);
        const std::size_t max_rows = std::max<std::size_t>(1, max_ray_bytes / row_bytes);
        const std::size_t bands = (hogels.nt + max_rows - 1) / max_rows, rows = (hogels.nt + bands - 1) / bands;
        for (std::size_t t = 0; t < hogels.nt; t += rows)
            use(HogelRange{hogels.s0, hogels.t0 + t, hogels.ns, std::min(rows, hogels.nt - t)});
    }

    // Reads the rays of all channels, or of this channel only from a ChannelSource.
    void read_rays(const HogelRange& hogels, std::vector<LightFieldTile>& tiles, bool all_channels = false) const {
        tiles.resize(faces().size());
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            LightFieldTile& tile = tiles[i];
            const auto* channels =
                all_channels || with_depth_ ? nullptr : dynamic_cast<const ChannelSource*>(faces()[i].get());
            if (tile.range.ns != hogels.ns || tile.range.nt != hogels.nt) {
                LightFieldGrid grid = faces()[i]->grid();
                if (channels != nullptr) grid.channels = 1;
                tile = LightFieldTile(grid, hogels, with_depth_);
            }
            tile.range = hogels;
            if (channels != nullptr)
                channels->read_channel(channel_, hogels, tile.radiance.view()[0]);
            else
                faces()[i]->read(tile);
        }
    }

    // Returns whether one channel can be read at less cost than all.
    bool reads_channels() const {
        return !with_depth_ && std::ranges::all_of(faces(), [](const LightField::Source& face) {
            return dynamic_cast<const ChannelSource*>(face.get()) != nullptr;
        });
    }

    View<const float, 4> channel_rays(const LightFieldTile& tile) const {
        return tile.radiance.view()[tile.radiance.extent(0) == 1 ? 0 : channel_];
    }

    // Prepares hogels first, first + 1, … of the tiles.
    void prepare(const HogelPreparation& step, std::span<const LightFieldTile> tiles, std::size_t first,
                 View<float, 2> prepared) const {
        const Shape<2> rays{prepared.extent(0), rays_};
        if (tiles.size() > 1) {
            Array<float, 2> concatenated(rays);
            float* to = concatenated.data();
            for (std::size_t hogel = first; hogel < first + rays[0]; ++hogel)
                for (const LightFieldTile& face : tiles) {
                    const View<const float, 4> face_rays = channel_rays(face);
                    const std::size_t directions = face_rays.extent(2) * face_rays.extent(3);
                    to = std::copy_n(face_rays.data() + hogel * directions, directions, to);
                }
            return step.prepare(concatenated, {}, prepared);
        }
        const LightFieldTile& tile = tiles.front();
        const View<const float, 2> depths(tile.depth.data() + first * rays_, rays);
        step.prepare({channel_rays(tile).data() + first * rays_, rays},
                     tile.depth.size() > 0 ? depths : View<const float, 2>(), prepared);
    }

    // Writes the parts inside the region of hogels first, first + 1, … of a range.
    void write(View<const float, 2> prepared, const HogelRange& hogels, std::size_t first, std::size_t look,
               const Region& region, View<Complex, 2> square, View<Complex, 2> out) const {
        for (std::size_t i = 0; i < prepared.extent(0); ++i) {
            const HogelKey key{hogels.s0 + (first + i) % hogels.ns, hogels.t0 + (first + i) / hogels.ns, look};
            const std::size_t y0 = std::max(key.t * rows_, region.y0),
                              y1 = std::min((key.t + 1) * rows_, region.y0 + region.height),
                              x0 = std::max(key.s * columns_, region.x0),
                              x1 = std::min((key.s + 1) * columns_, region.x0 + region.width);
            Complex* to = &out(y0 - region.y0, x0 - region.x0);
            if (y1 - y0 == rows_ && x1 - x0 == columns_) {
                synthesis_->synthesise_to(prepared[i].elements(), key, square, to, region.width);
                continue;
            }
            synthesis_->synthesise(prepared[i].elements(), key, square);
            for (std::size_t y = y0; y < y1; ++y)
                std::copy_n(&square(y - key.t * rows_, x0 - key.s * columns_), x1 - x0, to + (y - y0) * region.width);
        }
    }

    void prepare(const HogelPreparation& step, const HogelRange& hogels, std::vector<LightFieldTile>& rays,
                 View<float, 2> prepared) const {
        if (kept_.size() > 0 && &step == synthesis_->hogel_waves()) {
            for (std::size_t row = 0; row < hogels.nt; ++row)
                std::copy_n(&kept_((hogels.t0 + row) * front().hogels_s + hogels.s0, 0), hogels.ns * kept_.extent(1),
                            &prepared(row * hogels.ns, 0));
            return;
        }
        if (faces().size() == 1 && !with_depth_)
            if (const View<const float, 5> all_rays = light_field_.front().in_memory(); all_rays.size() > 0) {
                for (std::size_t row = 0; row < hogels.nt; ++row)
                    step.prepare({&all_rays(channel_, hogels.t0 + row, hogels.s0, 0, 0), {hogels.ns, rays_}}, {},
                                 {&prepared(row * hogels.ns, 0), {hogels.ns, prepared.extent(1)}});
                return;
            }
        for_each_band(hogels, [&](const HogelRange& band) {
            read_rays(band, rays);
            prepare(step, rays, 0,
                    {&prepared((band.t0 - hogels.t0) * band.ns, 0), {band.hogels(), prepared.extent(1)}});
        });
    }

    std::shared_ptr<const Prepared> prepare(const HogelRange& hogels) const {
        {
            const std::lock_guard lock(recent_mutex_);
            for (const auto& entry : recent_)
                if (entry->range == hogels) return entry;
        }
        auto prepared = std::make_shared<Prepared>();
        prepared->range = hogels;
        prepared->values = Array<float, 2>({hogels.hogels(), synthesis_->prepared_size()});
        auto scratch = scratch_pool_.take();
        prepare(*synthesis_, hogels, scratch->rays, prepared->values);
        const std::lock_guard lock(recent_mutex_);
        recent_.push_front(prepared);
        if (recent_.size() > max_recent) recent_.pop_back();
        return prepared;
    }

    // Number of regions with cached prepared values: readers read all looks of a region, on several threads.
    static constexpr std::size_t max_recent = 64;

    LightField light_field_;
    std::size_t channel_, looks_;
    bool with_depth_;
    FieldGrid grid_;
    std::size_t columns_, rows_;  // samples of a hogel
    std::size_t rays_ = 0;        // of a hogel, over all faces
    std::unique_ptr<HogelSynthesis> synthesis_;
    mutable Array<float, 2> kept_;  // amplitudes of all hogels, if stored
    mutable core::ObjectPool<Scratch> scratch_pool_;
    mutable std::mutex recent_mutex_;
    mutable std::list<std::shared_ptr<const Prepared>> recent_;
};

}  // namespace

double stereogram::synthesis_bytes(const FieldGrid& hologram, std::size_t hogels) {
    // Tiles in progress with their rays; per frequency of a hogel, its directions and weights; per thread, a hogel's
    // moduli, transform and samples.
    constexpr double tiles = 4 * double{1 << 24}, table = 52, transform = 28;
    const auto count = static_cast<double>(std::max<std::size_t>(hogels, 1)),
               threads = static_cast<double>(thread_count());
    return threads * tiles +
           static_cast<double>(hologram.plane.samples()) / count * (table + std::min(threads, count) * transform);
}

std::shared_ptr<const FieldSource> make_hologram(const LightField& light_field, const HologramOptions& options) {
    const FieldGrid grid = hologram_grid(light_field.grids(), options);
    if (needs_depth(options.method) && !light_field.has_depth())
        throw Error(ErrorCode::usage,
                    "this hologram needs the depth of every ray, and the light field has none; render it with depth");
    if (const auto* overlap = std::get_if<OverlapAdd>(&options.method))
        return windows::make_overlap_add(light_field, grid, options, overlap->phases);
    if (const auto* own_method = std::get_if<OwnMethod>(&options.method))
        return own_method->make(light_field, grid, options);
    return std::make_shared<HogelsSideBySide>(light_field, grid, options, RayValues::radiance);
}

std::shared_ptr<const FieldSource> make_hologram_of_coefficients(const LightField& coefficients,
                                                                 const HologramOptions& options) {
    const FieldGrid grid = hologram_grid(coefficients.grids(), options);
    if (!std::holds_alternative<Basis>(options.method))
        throw Error(ErrorCode::usage, "a hologram of coefficients needs the method basis");
    return std::make_shared<HogelsSideBySide>(coefficients, grid, options, RayValues::coefficients);
}

}  // namespace hogel
