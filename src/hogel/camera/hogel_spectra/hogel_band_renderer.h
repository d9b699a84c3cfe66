// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "hogel/camera/hogel_spectra/band_lines.h"
#include "hogel/camera/hogel_spectra/lanes.h"
#include "hogel/camera/hogel_spectra/project.h"
#include "hogel/camera/hogel_spectra/pupil_band.h"
#include "hogel/camera/hogel_spectra/wave_cache.h"
#include "hogel/camera/packed_band.h"
#include "hogel/core/object_pool.h"
#include "hogel/stereogram/hogel_synthesis.h"

namespace hogel::camera::hogel_spectra {

/// Hogels of a stereogram, each the sum of the waves of its Fourier transform, and a cache of these waves.
struct Hogels : stereogram::Hogels {
    /// Waves of the first look, or null.
    const WaveCache* wave_cache = nullptr;
};

/// Size of a chunk in hogels: small enough for its light to stay in the processor's cache until it is added to the
/// band. Hogels are prepared in rows of chunk_width × tile_side.
inline constexpr std::size_t chunk_width = 32, chunk_height = 16;
static_assert(chunk_width % tile_side == 0 && chunk_height % tile_side == 0);
static_assert(chunk_width % camera::PackedBand::side == 0 && camera::PackedBand::side == lanes);

/// A chunk of hogels, relative to the first hogel of the range.
struct HogelChunk {
    std::size_t s, t, ns, nt;
};

/// Renderer of the pupil bands of one colour. Thread-safe.
class HogelBandRenderer {
  public:
    HogelBandRenderer(const Hogels& hogels, const HogelRange& range, std::vector<PupilBand> bands);

    const std::vector<PupilBand>& bands() const { return bands_; }
    std::size_t overlap() const { return hogels_.overlap; }

    struct Looks {
        std::size_t first, count;
    };
    /// Lanes with the same weights for a viewpoint.
    struct Group {
        SlepianBasis::Weights columns, rows;
        stereogram::InBandRows in_band_rows;
        std::size_t first_column;                        // the first in-band column
        std::vector<SlepianBasis::SymmetricPair> pairs;  // of in-band columns, if columns are selected
        alignas(64) float mask[stereogram::HogelWaves::lanes];
    };

    /// Buffers for a chunk. Arrays [band] have an element for each viewpoint.
    struct Scratch {
        Array<float, 2> prepared;          // empty if the stereogram keeps it
        std::vector<const float*> moduli;  // prepared, [hogel]
        Array<float, 1> waves, gathered, numbers;
        std::vector<std::vector<HogelView>> views;        // [band][hogel]
        std::vector<std::vector<Array<float, 1>>> lines;  // [band][group]: [row][function][part][lane]
        std::vector<std::vector<Group>> groups;           // [band]
        std::vector<SlepianBasis::SymmetricPair> pairs;
        std::vector<char> active;       // [row]
        std::vector<std::size_t> rows;  // rows to sum
        std::vector<stereogram::HogelKey> keys;
        std::vector<const float*> sources;
        LookBlocks looks;
        std::vector<BandLines> band_lines;                // [band]
        std::vector<std::vector<Array<float, 3>>> light;  // [band][block of looks]: [row][part][column, look]
        std::vector<Array<float, 3>> phases;              // [band]: of the demodulation, [row][part][column]
    };
    auto scratch() const { return scratch_pool_.take(); }

    /// Renders the light of a chunk, a rectangle of hogels, into the scratch, over its support in each band.
    void render(const HogelChunk& chunk, const Looks& looks, Scratch& scratch) const;

    /// Adds the light that render() has left in `scratch` for this chunk to the packed bands.
    /// @param packed_bands  [band][look], numbers in compressed form
    void add(const Scratch& scratch, const HogelChunk& chunk,
             std::span<std::vector<camera::PackedBand>> packed_bands) const;

  private:
    // The hogel and the look of a lane; hogels are counted within a row of tiles.
    struct Item {
        std::size_t hogel, look;
    };

    void render_tiles(const HogelRange& tiles, std::size_t first, const Looks& looks, Scratch& scratch) const;
    void prepare(const HogelRange& tiles, Scratch& scratch) const;
    void assign_lines(const HogelRange& tiles, std::size_t first, std::size_t rows, Scratch& scratch) const;
    LineTarget target(std::size_t e, const HogelRange& tiles, const Item& item, Scratch& scratch) const;
    void render_single_hogels(const HogelRange& tiles, std::size_t row, std::size_t rows, const Looks& looks,
                              Scratch& scratch) const;
    static void set_groups(std::span<const Item> items, const std::vector<HogelView>& views, std::size_t waves,
                           std::vector<Group>& groups);
    void render_in_lanes(const HogelRange& tiles, std::size_t row, std::size_t rows, const Looks& looks,
                         Scratch& scratch) const;
    void render_batch(const HogelRange& tiles, std::span<const Item> items, std::size_t first_look,
                      const WaveCache::Tile& cached, Scratch& scratch) const;
    void sum_cached_rows(const WaveCache::Tile& cached, Scratch& scratch) const;
    void sum_rows_of_waves(const HogelRange& tiles, std::span<const Item> items, std::size_t first_look,
                           Scratch& scratch) const;
    template <class Sum>
    void for_each_line(std::size_t row, Scratch& scratch, const Sum& sum) const;
    SlepianBasis::Weights active_rows(std::size_t e, std::size_t g, Scratch& scratch) const;

    Hogels hogels_;
    HogelRange range_;
    std::vector<PupilBand> bands_;
    MiddlePhases middle_phases_;
    bool uses_lanes_;
    bool matches_cache_;  // whether tiles of the range are tiles of the wave cache
    mutable core::ObjectPool<Scratch> scratch_pool_;
};

}  // namespace hogel::camera::hogel_spectra
