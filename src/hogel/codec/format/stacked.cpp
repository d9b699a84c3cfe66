// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/stacked.h"

#include <algorithm>

#include "hogel/codec/format/block_kernels.h"

namespace hogel::codec::format {
namespace {

constexpr std::size_t max_stacked = 64;  // rows: eight rows of blocks

bool single_row(const LightFieldGrid& grid) { return grid.directions_v == 1; }
bool single_column(const LightFieldGrid& grid) { return grid.directions_u == 1 && grid.directions_v > 1; }

// Stacks a tile: its rows (or columns) of hogels become rows of directions of another light field.
class Stacking {
  public:
    Stacking(const LightFieldGrid& grid, const HogelRange& tile)
        : rows_(single_row(grid)), tile_(tile), directions_(grid.directions()), grid_(grid) {
        grid_.hogels_s = rows_ ? grid.hogels_s : grid.hogels_t;
        grid_.hogels_t = 1;
        grid_.directions_u = directions_;
        grid_.directions_v = rows_ ? tile.nt : tile.ns;
    }

    // Grid of the stacked light field, and its range for a part of the tile.
    const LightFieldGrid& grid() const { return grid_; }
    HogelRange range(const HogelRange& part) const {
        return rows_ ? HogelRange{part.s0, 0, part.ns, 1} : HogelRange{part.t0, 0, part.nt, 1};
    }

    LightFieldTile stack(const LightFieldTile& tile) const {
        LightFieldTile stacked(grid_, range(tile.range), false);
        for_each_hogel(
            tile.range, [&](std::size_t c, std::size_t t, std::size_t s, std::size_t across, std::size_t down) {
                std::copy_n(&tile.radiance(c, t, s, 0, 0), directions_, &stacked.radiance(c, 0, across, down, 0));
            });
        return stacked;
    }
    void unstack(const LightFieldTile& stacked, LightFieldTile& part) const {
        for_each_hogel(
            part.range, [&](std::size_t c, std::size_t t, std::size_t s, std::size_t across, std::size_t down) {
                std::copy_n(&stacked.radiance(c, 0, across, down, 0), directions_, &part.radiance(c, t, s, 0, 0));
            });
    }

  private:
    // Calls use(channel, row and column of a hogel in the part, index of its stacked hogel, row of its directions in
    // it).
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

class StackedTile final : public TileDecoder {
  public:
    StackedTile(const Stacking& stacking, std::unique_ptr<TileDecoder> tile)
        : stacking_(stacking), tile_(std::move(tile)) {}
    void read(LightFieldTile& part) override {
        LightFieldTile stacked(stacking_.grid(), stacking_.range(part.range), false);
        tile_->read(stacked);
        stacking_.unstack(stacked, part);
    }

  private:
    Stacking stacking_;
    std::unique_ptr<TileDecoder> tile_;
};

class StackedCoder final : public TileCoder {
  public:
    StackedCoder(const LightFieldGrid& grid, CoderOf coder_of) : grid_(grid), coder_of_(std::move(coder_of)) {}

    HogelRange preferred_tile(const LightFieldGrid& grid) const override {
        const bool rows = single_row(grid);
        HogelRange tile{0, 0, grid.hogels_s, grid.hogels_t};
        std::size_t& stacked = rows ? tile.nt : tile.ns;
        // Tiles of nearly equal sizes, in whole blocks.
        const std::size_t all = stacked, tiles = (all + max_stacked - 1) / max_stacked;
        stacked = std::min(all, ((all + tiles - 1) / tiles + block_side - 1) / block_side * block_side);
        const Stacking stacking(grid, tile);
        (rows ? tile.ns : tile.nt) = coder_of_(stacking.grid())->preferred_tile(stacking.grid()).ns;
        return tile;
    }

    bool takes_any_value() const override { return coder_of_(grid_)->takes_any_value(); }

    Encoded encode(LightFieldTile& tile, double step, std::size_t max_bytes) const override {
        const Stacking stacking(grid_, tile.range);
        LightFieldTile stacked = stacking.stack(tile);
        return coder_of_(stacking.grid())->encode(stacked, step, max_bytes);
    }

    void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const override {
        const Stacking stacking(grid_, tile.range);
        LightFieldTile stacked(stacking.grid(), stacking.range(tile.range), false);
        coder_of_(stacking.grid())->decode(bytes, stacked);
        stacking.unstack(stacked, tile);
    }

    std::size_t layers(const HogelRange& tile) const override {
        const Stacking stacking(grid_, tile);
        return coder_of_(stacking.grid())->layers(stacking.range(tile));
    }

    std::unique_ptr<TileDecoder> open(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid,
                                      const HogelRange& range, std::size_t layers) const override {
        const Stacking stacking(grid, range);
        return std::make_unique<StackedTile>(
            stacking,
            coder_of_(stacking.grid())->open(std::move(bytes), stacking.grid(), stacking.range(range), layers));
    }

  private:
    LightFieldGrid grid_;
    CoderOf coder_of_;
};

}  // namespace

bool can_stack(std::span<const LightFieldGrid> faces) {
    const LightFieldGrid& front = faces.front();
    return (front.hogels_t > 1 && std::ranges::all_of(faces, single_row)) ||
           (front.hogels_s > 1 && std::ranges::all_of(faces, single_column));
}

std::unique_ptr<TileCoder> coder_in_layout(StreamLayout layout, const LightFieldGrid& grid, CoderOf coder_of) {
    if (layout != StreamLayout::stacked) return coder_of(grid);
    return std::make_unique<StackedCoder>(grid, std::move(coder_of));
}

}  // namespace hogel::codec::format
