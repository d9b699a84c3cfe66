#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <list>
#include <mutex>

#include "hogel/codec/stream_internal.h"
#include "hogel/core/error.h"
#include "hogel/core/parallel.h"

namespace hogel {
namespace {

using Decoded = std::shared_ptr<const LightFieldTile>;

// Copies what two tiles have in common.
void copy_common(const LightFieldTile& from, LightFieldTile& to) {
    const HogelRange &a = from.range, &b = to.range;
    const std::size_t s0 = std::max(a.s0, b.s0), s1 = std::min(a.s0 + a.ns, b.s0 + b.ns);
    const std::size_t t0 = std::max(a.t0, b.t0), t1 = std::min(a.t0 + a.nt, b.t0 + b.nt);
    const std::size_t row = (s1 - s0) * from.radiance.extent(3) * from.radiance.extent(4);
    for (std::size_t c = 0; c < from.radiance.extent(0); ++c)
        for (std::size_t t = t0; t < t1; ++t)
            std::copy_n(&from.radiance(c, t - a.t0, s0 - a.s0, 0, 0), row, &to.radiance(c, t - b.t0, s0 - b.s0, 0, 0));
}

class DecodedSource final : public LightFieldSource {
  public:
    DecodedSource(const std::filesystem::path& path, std::size_t memory, bool coefficients)
        : reader_(path),
          coder_(coder_of(reader_)),
          coefficients_(coefficients),
          kept_(std::max<std::size_t>(1, memory / tile_bytes(reader_))) {
        if (coefficients && !coder_->directional())
            throw Error(ErrorCode::bad_input,
                        fmt::format("{}: is coded by {}; coefficients of directions are kept by coder fringes",
                                    path.string(), reader_.info().method.coder));
    }

    const LightFieldGrid& grid() const override { return reader_.info().grid; }
    HogelRange preferred_tile() const override { return reader_.info().tile; }

    void read(LightFieldTile& tile) const override {
        validate(tile, grid());
        const Tiling& tiling = reader_.tiling();
        const HogelRange &r = tile.range, &size = tiling.size();
        // A tile asked for alone is decoded into its place.
        const std::size_t first = r.t0 / size.nt * tiling.across() + r.s0 / size.ns;
        if (tiling[first] == r && kept_ < tiling.count()) return decode(first, tile);
        for (std::size_t t = r.t0 / size.nt; t * size.nt < r.t0 + r.nt; ++t)
            for (std::size_t s = r.s0 / size.ns; s * size.ns < r.s0 + r.ns; ++s)
                copy_common(*decoded(t * tiling.across() + s), tile);
    }

  private:
    static std::unique_ptr<TileCoder> coder_of(const StreamReader& reader) {
        try {
            return make_tile_coder(reader.info().method, reader.info().grid);
        } catch (const Error& error) {
            reader.damaged(error.what());
        }
    }
    static std::size_t tile_bytes(const StreamReader& reader) {
        const StreamInfo& info = reader.info();
        return info.tile.hogels() * info.grid.directions() * info.grid.channels * sizeof(float);
    }

    void decode(std::size_t index, LightFieldTile& tile) const {
        const std::vector<std::uint8_t> bytes = reader_.read(index);
        try {
            coefficients_ ? coder_->decode_coefficients(bytes, tile) : coder_->decode(bytes, tile);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::bad_input) throw;
            reader_.damaged(fmt::format("tile {}: {}", index, error.what()));
        }
    }

    // The tile from the cache, or decoded by the first who asks while the others wait.
    Decoded decoded(std::size_t index) const {
        std::promise<Decoded> promise;
        {
            std::unique_lock lock(mutex_);
            const auto found = std::ranges::find(cache_, index, &Entry::index);
            if (found != cache_.end()) {
                cache_.splice(cache_.begin(), cache_, found);
                const std::shared_future<Decoded> tile = found->tile;
                lock.unlock();
                return tile.get();
            }
            cache_.push_front({index, promise.get_future().share()});
            if (cache_.size() > kept_) cache_.pop_back();
        }
        try {
            auto tile = std::make_shared<LightFieldTile>(grid(), reader_.tiling()[index], false);
            // A thread that waits inside must not begin to read something else, which may wait for this very tile.
            isolate([&] { decode(index, *tile); });
            promise.set_value(tile);
            return tile;
        } catch (...) {
            promise.set_exception(std::current_exception());
            const std::lock_guard lock(mutex_);
            std::erase_if(cache_, [&](const Entry& entry) { return entry.index == index; });
            throw;
        }
    }

    struct Entry {
        std::size_t index;
        std::shared_future<Decoded> tile;
    };

    StreamReader reader_;
    std::unique_ptr<TileCoder> coder_;
    bool coefficients_;
    std::size_t kept_;
    mutable std::mutex mutex_;
    mutable std::list<Entry> cache_;  // the one used last first
};

}  // namespace

std::unique_ptr<LightFieldSource> open_stream(const std::filesystem::path& path, std::size_t memory) {
    return std::make_unique<DecodedSource>(path, memory, false);
}

std::unique_ptr<LightFieldSource> open_coefficients(const std::filesystem::path& path, std::size_t memory) {
    return std::make_unique<DecodedSource>(path, memory, true);
}

}  // namespace hogel
