// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/stacked.h"

#include <algorithm>

namespace hogel::codec::format {
namespace {

constexpr std::size_t max_gathered = 64;  // hogels: eight rows of blocks
constexpr std::size_t whole_blocks = 8;

bool single_row(const LightFieldGrid& grid) { return grid.directions_v == 1; }
bool single_column(const LightFieldGrid& grid) { return grid.directions_u == 1 && grid.directions_v > 1; }

// How the hogels of a tile are gathered: those in a row, or in a column, become rows of directions.
class Gathering {
  public:
    Gathering(const LightFieldGrid& grid, const HogelRange& tile)
        : rows_(single_row(grid)), tile_(tile), directions_(grid.directions()), grid_(grid) {
        grid_.hogels_s = rows_ ? grid.hogels_s : grid.hogels_t;
        grid_.hogels_t = 1;
        grid_.directions_u = directions_;
        grid_.directions_v = rows_ ? tile.nt : tile.ns;
    }

    // Of the gathered light field: its tile stands where the hogels are.
    const LightFieldGrid& grid() const { return grid_; }
    HogelRange range(const HogelRange& part) const {
        return rows_ ? HogelRange{part.s0, 0, part.ns, 1} : HogelRange{part.t0, 0, part.nt, 1};
    }

    LightFieldTile gather(const LightFieldTile& tile) const {
        LightFieldTile gathered(grid_, range(tile.range), false);
        for_each_hogel(
            tile.range, [&](std::size_t c, std::size_t t, std::size_t s, std::size_t across, std::size_t down) {
                std::copy_n(&tile.radiance(c, t, s, 0, 0), directions_, &gathered.radiance(c, 0, across, down, 0));
            });
        return gathered;
    }
    void scatter(const LightFieldTile& gathered, LightFieldTile& part) const {
        for_each_hogel(
            part.range, [&](std::size_t c, std::size_t t, std::size_t s, std::size_t across, std::size_t down) {
                std::copy_n(&gathered.radiance(c, 0, across, down, 0), directions_, &part.radiance(c, t, s, 0, 0));
            });
    }

  private:
    // use(channel, row and column of a hogel in the part, its place among the gathered hogels and its row of
    // directions)
    template <class Use>
    void for_each_hogel(const HogelRange& part, Use&& use) const {
        for (std::size_t c = 0; c < grid_.channels; ++c)
            for (std::size_t t = 0; t < part.nt; ++t)
                for (std::size_t s = 0; s < part.ns; ++s)
                    rows_ ? use(c, t, s, s, part.t0 + t - tile_.t0) : use(c, t, s, t, part.s0 + s - tile_.s0);
    }

    bool rows_;
    HogelRange tile_;
    std::size_t directions_;
    LightFieldGrid grid_;
};

class GatheredTile final : public TileDecoder {
  public:
    GatheredTile(const Gathering& gathering, std::unique_ptr<TileDecoder> tile)
        : gathering_(gathering), tile_(std::move(tile)) {}
    void read(LightFieldTile& part) override {
        LightFieldTile gathered(gathering_.grid(), gathering_.range(part.range), false);
        tile_->read(gathered);
        gathering_.scatter(gathered, part);
    }

  private:
    Gathering gathering_;
    std::unique_ptr<TileDecoder> tile_;
};

class GatheredCoder final : public TileCoder {
  public:
    GatheredCoder(const LightFieldGrid& grid, CoderOf coder_of) : grid_(grid), coder_of_(std::move(coder_of)) {}

    HogelRange preferred_tile(const LightFieldGrid& grid) const override {
        const bool rows = single_row(grid);
        HogelRange tile{0, 0, grid.hogels_s, grid.hogels_t};
        std::size_t& gathered = rows ? tile.nt : tile.ns;
        // Tiles of nearly one size, in whole blocks.
        const std::size_t all = gathered, tiles = (all + max_gathered - 1) / max_gathered;
        gathered = std::min(all, ((all + tiles - 1) / tiles + whole_blocks - 1) / whole_blocks * whole_blocks);
        const Gathering gathering(grid, tile);
        (rows ? tile.ns : tile.nt) = coder_of_(gathering.grid())->preferred_tile(gathering.grid()).ns;
        return tile;
    }

    bool takes_any_value() const override { return coder_of_(grid_)->takes_any_value(); }

    Encoded encode(LightFieldTile& tile, double step, std::size_t max_bytes) const override {
        const Gathering gathering(grid_, tile.range);
        LightFieldTile gathered = gathering.gather(tile);
        return coder_of_(gathering.grid())->encode(gathered, step, max_bytes);
    }

    void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const override {
        const Gathering gathering(grid_, tile.range);
        LightFieldTile gathered(gathering.grid(), gathering.range(tile.range), false);
        coder_of_(gathering.grid())->decode(bytes, gathered);
        gathering.scatter(gathered, tile);
    }

    std::size_t layers(const HogelRange& tile) const override {
        const Gathering gathering(grid_, tile);
        return coder_of_(gathering.grid())->layers(gathering.range(tile));
    }

    std::unique_ptr<TileDecoder> open(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid,
                                      const HogelRange& range, std::size_t layers) const override {
        const Gathering gathering(grid, range);
        return std::make_unique<GatheredTile>(
            gathering,
            coder_of_(gathering.grid())->open(std::move(bytes), gathering.grid(), gathering.range(range), layers));
    }

  private:
    LightFieldGrid grid_;
    CoderOf coder_of_;
};

}  // namespace

bool can_gather(std::span<const LightFieldGrid> faces) {
    const LightFieldGrid& front = faces.front();
    return (front.hogels_t > 1 && std::ranges::all_of(faces, single_row)) ||
           (front.hogels_s > 1 && std::ranges::all_of(faces, single_column));
}

std::unique_ptr<TileCoder> coder_in_layout(StreamLayout layout, const LightFieldGrid& grid, CoderOf coder_of) {
    if (layout != StreamLayout::stacked) return coder_of(grid);
    return std::make_unique<GatheredCoder>(grid, std::move(coder_of));
}

}  // namespace hogel::codec::format
