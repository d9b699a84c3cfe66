// SPDX-License-Identifier: Apache-2.0
#include "hogel/light_field.h"

#include <algorithm>

#include "hogel/core/object_pool.h"
#include "hogel/work/lru_cache.h"

namespace hogel {
namespace {

class CachedTiles final : public LightFieldSource {
  public:
    CachedTiles(LightField::Source source, double bytes, bool with_depth)
        : source_(std::move(source)),
          with_depth_(with_depth && source_->has_depth()),
          size_(source_->preferred_tile()),
          recent_(static_cast<std::size_t>(bytes / tile_bytes())) {}

    const LightFieldGrid& grid() const override { return source_->grid(); }
    bool has_depth() const override { return source_->has_depth(); }
    HogelRange preferred_tile() const override { return size_; }

    void read(LightFieldTile& tile) const override {
        const HogelRange& r = tile.range;
        const std::size_t first_s = r.s0 / size_.ns, end_s = (r.s0 + r.ns - 1) / size_.ns + 1;
        const std::size_t first_t = r.t0 / size_.nt, end_t = (r.t0 + r.nt - 1) / size_.nt + 1;
        const std::size_t tiles = (end_s - first_s) * (end_t - first_t);
        // Read whole rows, whole preferred tiles or wide ranges directly. The cache must hold the tiles of two reads,
        // because two threads may read different rows.
        const bool suits = r.ns == grid().hogels_s || r.ns >= wide || (r.ns % size_.ns == 0 && r.nt % size_.nt == 0);
        if (suits || 2 * tiles > recent_.capacity() || (tile.depth.size() > 0 && !with_depth_)) {
            source_->read(tile);
            return;
        }
        for (std::size_t t = first_t; t < end_t; ++t)
            for (std::size_t s = first_s; s < end_s; ++s) copy_common(*cached_tile(s * size_.ns, t * size_.nt), tile);
    }

  private:
    // For ranges this wide, reading whole rows saves less than the wasted work of a process that reads few ranges of a
    // row (as each rank does), or returns to a row after its eviction.
    static constexpr std::size_t wide = 8;

    double tile_bytes() const {
        const std::size_t values = grid().channels + (with_depth_ ? 1 : 0);
        return static_cast<double>(size_.hogels() * grid().directions() * values * sizeof(float));
    }

    std::shared_ptr<const LightFieldTile> cached_tile(std::size_t s0, std::size_t t0) const {
        return recent_.get(std::pair(s0, t0), [&] {
            const HogelRange range{s0, t0, std::min(size_.ns, grid().hogels_s - s0),
                                   std::min(size_.nt, grid().hogels_t - t0)};
            // The tile returns to the pool with its last user.
            const std::shared_ptr<Memory::Lease> memory(new Memory::Lease(memory_.take()));
            LightFieldTile& tile = **memory;
            if (tile.range.ns != range.ns || tile.range.nt != range.nt)
                tile = LightFieldTile(grid(), range, with_depth_);
            tile.range = range;
            source_->read(tile);
            return std::shared_ptr<const LightFieldTile>(memory, &tile);
        });
    }

    LightField::Source source_;
    bool with_depth_;
    HogelRange size_;
    // Reused, because the system clears new memory.
    using Memory = core::ObjectPool<LightFieldTile>;
    mutable Memory memory_;
    mutable work::LruCache<std::pair<std::size_t, std::size_t>, LightFieldTile> recent_;
};

}  // namespace

LightField cached_tiles(const LightField& light_field, double bytes, bool with_depth) {
    const double share = bytes / static_cast<double>(light_field.faces().size());
    return light_field.wrapped(
        [&](const LightField::Source& face) { return std::make_shared<const CachedTiles>(face, share, with_depth); });
}

}  // namespace hogel
