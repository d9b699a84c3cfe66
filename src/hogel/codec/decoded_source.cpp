#include <fmt/format.h>

#include <algorithm>

#include "hogel/codec/stream_internal.h"
#include "hogel/core/error.h"
#include "hogel/core/recent_results.h"

namespace hogel {
namespace {

using Decoded = std::shared_ptr<const LightFieldTile>;

// A stream, and the tiles of it that were decoded last.
class DecodedStream {
  public:
    DecodedStream(const std::filesystem::path& path, std::size_t memory, bool coefficients)
        : reader_(path),
          coders_(coders_of(reader_)),
          coefficients_(coefficients),
          recent_(memory / tile_bytes(reader_)) {
        if (!coefficients) return;
        if (!coders_.front()->directional())
            throw Error(ErrorCode::bad_input,
                        fmt::format("{}: is coded by {}; coefficients of directions are kept by coder fringes",
                                    path.string(), info().method.coder));
        if (!info().sides.empty())
            throw Error(ErrorCode::bad_input,
                        fmt::format("{}: is a hemicube; expected the directions of a single face", path.string()));
    }

    const StreamInfo& info() const { return reader_.info(); }

    // Reads a face: as many directions as the tile has of a part, from a place on.
    void read(std::size_t part, Unfolding::Place place, LightFieldTile& tile) const {
        const Tiling& tiling = reader_.tiling();
        const HogelRange &r = tile.range, &size = tiling.size();
        const LightFieldGrid& grid = reader_.parts()[part];
        // A tile asked for alone is decoded into its place.
        const std::size_t first = r.t0 / size.nt * tiling.across() + r.s0 / size.ns;
        const bool whole = tile.radiance.extent(3) == grid.directions_v && tile.radiance.extent(4) == grid.directions_u;
        if (tiling[first] == r && whole && recent_.kept() < tiling.count()) return decode({part, first}, tile);
        for (std::size_t t = r.t0 / size.nt; t * size.nt < r.t0 + r.nt; ++t)
            for (std::size_t s = r.s0 / size.ns; s * size.ns < r.s0 + r.ns; ++s)
                copy_common(*decoded({part, t * tiling.across() + s}), tile, place.v, place.u);
    }

  private:
    struct Index {
        std::size_t part, tile;
        friend bool operator==(const Index&, const Index&) = default;
    };

    static std::vector<std::unique_ptr<TileCoder>> coders_of(const StreamReader& reader) {
        try {
            std::vector<std::unique_ptr<TileCoder>> coders;
            for (const LightFieldGrid& part : reader.parts())
                coders.push_back(make_tile_coder(reader.info().method, part, counted(reader.info())));
            return coders;
        } catch (const Error& error) {
            reader.damaged(error.what());
        }
    }
    static std::size_t tile_bytes(const StreamReader& reader) {
        const LightFieldGrid& grid = reader.parts().front();
        return reader.info().tile.hogels() * grid.directions() * grid.channels * sizeof(float);
    }

    void decode(Index index, LightFieldTile& tile) const {
        const std::size_t number = index.part * reader_.tiling().count() + index.tile;
        const std::vector<std::uint8_t> bytes = reader_.read(number);
        const TileCoder& coder = *coders_[index.part];
        try {
            coefficients_ ? coder.decode_coefficients(bytes, tile) : coder.decode(bytes, tile);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::bad_input) throw;
            reader_.damaged(fmt::format("tile {}: {}", number, error.what()));
        }
    }

    Decoded decoded(Index index) const {
        return recent_.get(index, [&] {
            auto tile =
                std::make_shared<LightFieldTile>(reader_.parts()[index.part], reader_.tiling()[index.tile], false);
            decode(index, *tile);
            return tile;
        });
    }

    StreamReader reader_;
    std::vector<std::unique_ptr<TileCoder>> coders_;  // of each part
    bool coefficients_;
    mutable RecentResults<Index, LightFieldTile> recent_;
};

// One face of a stream.
class DecodedFace final : public LightFieldSource {
  public:
    DecodedFace(std::shared_ptr<const DecodedStream> stream, std::size_t face)
        : stream_(std::move(stream)), grid_(stream_->info().faces()[face]), part_(face) {
        if (stream_->info().layout != HemicubeLayout::unfolded) return;
        part_ = 0;
        place_ = Unfolding(stream_->info().faces()).place(grid_.face);
    }

    const LightFieldGrid& grid() const override { return grid_; }
    HogelRange preferred_tile() const override { return stream_->info().tile; }
    void read(LightFieldTile& tile) const override {
        validate(tile, grid_);
        stream_->read(part_, place_, tile);
    }

  private:
    std::shared_ptr<const DecodedStream> stream_;
    LightFieldGrid grid_;
    std::size_t part_;
    Unfolding::Place place_{0, 0};
};

}  // namespace

std::unique_ptr<LightFieldSource> open_stream(const std::filesystem::path& path, std::size_t memory) {
    return std::move(open_stream_faces(path, memory).front());
}

std::vector<std::unique_ptr<LightFieldSource>> open_stream_faces(const std::filesystem::path& path,
                                                                 std::size_t memory) {
    const auto stream = std::make_shared<const DecodedStream>(path, memory, false);
    std::vector<std::unique_ptr<LightFieldSource>> faces;
    for (std::size_t face = 0; face <= stream->info().sides.size(); ++face)
        faces.push_back(std::make_unique<DecodedFace>(stream, face));
    return faces;
}

std::unique_ptr<LightFieldSource> open_coefficients(const std::filesystem::path& path, std::size_t memory) {
    return std::make_unique<DecodedFace>(std::make_shared<const DecodedStream>(path, memory, true), 0);
}

}  // namespace hogel
