// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "hogel/camera/hogel_spectra/band_lines.h"
#include "hogel/camera/hogel_spectra/kept_waves.h"
#include "hogel/camera/hogel_spectra/lanes.h"
#include "hogel/camera/hogel_spectra/project.h"
#include "hogel/camera/hogel_spectra/pupil_band.h"
#include "hogel/camera/packed_band.h"
#include "hogel/core/object_pool.h"
#include "hogel/stereogram/hogel_synthesis.h"

namespace hogel::camera::hogel_spectra {

/// What eyes need of a stereogram whose hogels are sums of the waves of their Fourier transforms.
struct Hogels : stereogram::Hogels {
    /// Waves of the first look, where they are kept; otherwise null.
    const KeptWaves* kept_waves = nullptr;
};

/// Hogels whose light is drawn before it is added to a band: few enough for it to stay in a processor's cache. They are
/// prepared in rows of part_across times tile_side.
inline constexpr std::size_t part_across = 32, part_down = 16;
static_assert(part_across % tile_side == 0 && part_down % tile_side == 0);
static_assert(part_across % camera::PackedBand::side == 0 && camera::PackedBand::side == lanes);

/// Hogels of a range, from its first one on.
struct HogelPart {
    std::size_t s, t, ns, nt;
};

/// Eyes that see the light of one colour.
class HogelBandRenderer {
  public:
    HogelBandRenderer(const Hogels& hogels, const HogelRange& range, std::vector<PupilBand> eyes);

    const std::vector<PupilBand>& eyes() const { return eyes_; }
    std::size_t overlap() const { return hogels_.overlap; }

    struct Looks {
        std::size_t first, count;
    };
    /// Lanes that an eye sees with the same weights.
    struct Group {
        SlepianBasis::Weights columns, rows;
        stereogram::InBandRows near;
        std::size_t first_column;                        // of those that are near
        std::vector<SlepianBasis::SymmetricPair> pairs;  // of columns, unless all are near
        alignas(64) float chosen[stereogram::HogelWaves::lanes];
    };

    /// Buffers for a part.
    struct Scratch {
        Array<float, 2> prepared;          // unless it is kept
        std::vector<const float*> moduli;  // prepared, [hogel]
        Array<float, 1> waves, gathered, numbers;
        std::vector<std::vector<HogelView>> views;        // [eye][hogel]
        std::vector<std::vector<Array<float, 1>>> lines;  // [eye][weights]: [row][function][part][lane]
        std::vector<std::vector<Group>> groups;           // [eye]
        std::vector<SlepianBasis::SymmetricPair> pairs;
        std::vector<char> active;       // [row]
        std::vector<std::size_t> rows;  // that are summed
        std::vector<stereogram::HogelKey> places;
        std::vector<const float*> sources;
        LookBlocks looks;
        std::vector<BandLines> band_lines;                // [eye]
        std::vector<std::vector<Array<float, 3>>> light;  // [eye][block of looks]: [row][part][column, look]
        std::vector<Array<float, 3>> phases;              // [eye]: of the demodulation, [row][part][column]
    };
    auto scratch() const { return scratch_pool_.take(); }

    /// Draws the light of a part of the hogels, as far as it reaches in the band of each eye, into the scratch.
    void draw(const HogelPart& part, const Looks& looks, Scratch& scratch) const;

    /// Adds the light of a part that was drawn to bands of these eyes.
    void add(const Scratch& scratch, const HogelPart& part, std::span<std::vector<camera::PackedBand>> bands) const;

  private:
    // A hogel of a row of tiles and a look, one lane.
    struct Item {
        std::size_t hogel, look;
    };

    void draw_tiles(const HogelRange& some, std::size_t first, const Looks& looks, Scratch& scratch) const;
    void prepare(const HogelRange& some, Scratch& scratch) const;
    void choose_lines(const HogelRange& some, std::size_t first, std::size_t rows, Scratch& scratch) const;
    LineTarget place(std::size_t e, const HogelRange& some, const Item& item, Scratch& scratch) const;
    void draw_one_by_one(const HogelRange& some, std::size_t row, std::size_t rows, const Looks& looks,
                         Scratch& scratch) const;
    static void set_groups(std::span<const Item> items, const std::vector<HogelView>& views, std::size_t waves,
                           std::vector<Group>& groups);
    void draw_in_lanes(const HogelRange& some, std::size_t row, std::size_t rows, const Looks& looks,
                       Scratch& scratch) const;
    void draw_batch(const HogelRange& some, std::span<const Item> items, std::size_t first_look,
                    const KeptWaves::Tile& kept, Scratch& scratch) const;
    void sum_kept_rows(const KeptWaves::Tile& kept, Scratch& scratch) const;
    void sum_rows_of_waves(const HogelRange& some, std::span<const Item> items, std::size_t first_look,
                           Scratch& scratch) const;
    template <class Sum>
    void for_lines(std::size_t row, Scratch& scratch, const Sum& sum) const;
    SlepianBasis::Weights active_rows(std::size_t e, std::size_t g, Scratch& scratch) const;

    Hogels hogels_;
    HogelRange range_;
    std::vector<PupilBand> eyes_;
    MiddlePhases middle_;
    bool in_lanes_;
    bool keeps_tiles_;  // whether tiles of the range are those of kept waves
    mutable core::ObjectPool<Scratch> scratch_pool_;
};

}  // namespace hogel::camera::hogel_spectra
