// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "hogel/codec/format/stream_file.h"
#include "hogel/codec/format/unfolded.h"
#include "hogel/error.h"
#include "hogel/work/lru_cache.h"

namespace hogel {

using namespace codec;
using namespace codec::format;

namespace {

// Reads the depth of a tile from the depth stream; values of at least `beyond` mean infinity.
void read_depth(const LightFieldSource& coded, double beyond, LightFieldTile& tile) {
    LightFieldTile values(coded.grid(), tile.range, false);
    coded.read(values);
    std::ranges::transform(values.radiance.elements(), tile.depth.elements().begin(), [&](float value) {
        return value < beyond ? value : std::numeric_limits<float>::infinity();
    });
}

// Stream with a cache of recently decoded tiles.
class DecodedStream {
  public:
    DecodedStream(const std::filesystem::path& path, const StreamOptions& options, bool coefficients,
                  StreamReader::Content content = StreamReader::Content::light_field)
        : reader_(path, content),
          coders_(coders_of(reader_)),
          coefficients_(coefficients),
          layers_(layers_of(reader_, options.layers)),
          recent_(options.memory / tile_bytes(reader_)) {
        if (!coefficients) return;
        if (!coders_.front()->directional())
            throw Error(ErrorCode::bad_input,
                        fmt::format("{}: has the coder {}; expected fringes, which keeps coefficients of directions",
                                    path.string(), info().method.coder));
        if (info().companding.changes())
            throw Error(ErrorCode::bad_input,
                        fmt::format("{}: has a tone curve or coarser chrominance; expected radiances as they are",
                                    path.string()));
        if (info().layout != StreamLayout::faces)
            throw Error(ErrorCode::bad_input,
                        fmt::format("{}: codes the faces of a hemicube as one picture; expected each by itself",
                                    path.string()));
    }

    const StreamHeader& info() const { return reader_.info(); }

    // Reads a face: the directions of a part from `origin` on, in the number that the tile has.
    void read(std::size_t part, Unfolding::Origin origin, LightFieldTile& tile) const {
        const Tiling& tiling = reader_.tiling();
        const HogelRange &r = tile.range, &size = tiling.size();
        const LightFieldGrid& grid = reader_.parts()[part];
        // A complete tile of the stream is decoded directly into the caller's tile.
        const std::size_t first = r.t0 / size.nt * tiling.across() + r.s0 / size.ns;
        const bool has_all_directions =
            tile.radiance.extent(3) == grid.directions_v && tile.radiance.extent(4) == grid.directions_u;
        if (tiling[first] == r && has_all_directions && recent_.capacity() < tiling.count())
            return decode({part, first}, tile);
        for (std::size_t t = r.t0 / size.nt; t * size.nt < r.t0 + r.nt; ++t)
            for (std::size_t s = r.s0 / size.ns; s * size.ns < r.s0 + r.ns; ++s)
                read_common({part, t * tiling.across() + s}, origin, tile);
    }

  private:
    struct Index {
        std::size_t part, tile;
        friend bool operator==(const Index&, const Index&) = default;
    };

    using Decoder = std::unique_ptr<TileDecoder>;

    // Coefficients of a complete tile.
    class Coefficients final : public TileDecoder {
      public:
        explicit Coefficients(LightFieldTile tile) : tile_(std::move(tile)) {}
        void read(LightFieldTile& part) override { copy_common(tile_, part); }

      private:
        LightFieldTile tile_;
    };

    static std::vector<std::unique_ptr<TileCoder>> coders_of(const StreamReader& reader) {
        try {
            const StreamInfo& info = reader.info();
            std::vector<std::unique_ptr<TileCoder>> coders;
            for (const LightFieldGrid& part : reader.parts()) coders.push_back(coder_of_part(info, part));
            if (info.layer_ends.size() != coders.front()->layers(info.tile))
                reader.damaged("its header has a wrong number of layers");
            return coders;
        } catch (const Error& error) {
            if (error.code() == ErrorCode::bad_input) throw;
            reader.damaged(error.what());
        }
    }
    static std::size_t layers_of(const StreamReader& reader, std::size_t requested) {
        const StreamInfo& info = reader.info();
        const std::size_t count = info.layer_ends.size();
        if (requested > count)
            throw Error(ErrorCode::usage, "layers",
                        fmt::format("{} layers were asked for, expected 1 to {}", requested, count));
        if (requested == 0) requested = count;
        if (requested > info.layers_there)
            reader.damaged(fmt::format("it is truncated: it has {} of {} layers", info.layers_there, count));
        return requested;
    }
    static std::size_t tile_bytes(const StreamReader& reader) {
        const LightFieldGrid& grid = reader.parts().front();
        return reader.info().tile.hogels() * grid.directions() * grid.channels * sizeof(float);
    }

    std::size_t number(Index index) const { return index.part * reader_.tiling().count() + index.tile; }

    // Calls use() and adds the file name and the tile number to an Error(bad_input) that it throws.
    template <class Use>
    auto with_tile_named(Index index, Use&& use) const {
        try {
            return use();
        } catch (const Error& error) {
            if (error.code() != ErrorCode::bad_input) throw;
            reader_.damaged(fmt::format("tile {}: {}", number(index), error.what()));
        }
    }

    std::unique_ptr<TileDecoder> open(Index index) const {
        const HogelRange range = reader_.tiling()[index.tile];
        const TileCoder& coder = *coders_[index.part];
        const LightFieldGrid& grid = reader_.parts()[index.part];
        std::vector<std::uint8_t> bytes = reader_.read(number(index), layers_);
        return with_tile_named(index, [&]() -> std::unique_ptr<TileDecoder> {
            if (!coefficients_)
                return coder.open(std::move(bytes), grid, range, std::min(layers_, coder.layers(range)));
            LightFieldTile tile(grid, range, false);
            coder.decode_coefficients(bytes, tile);
            return std::make_unique<Coefficients>(std::move(tile));
        });
    }

    void decode(Index index, LightFieldTile& tile) const {
        const std::unique_ptr<TileDecoder> decoder = open(index);
        with_tile_named(index, [&] { decoder->read(tile); });
    }

    // Copies the hogels that a tile of the stream shares with the requested tile.
    void read_common(Index index, Unfolding::Origin origin, LightFieldTile& tile) const {
        const auto decoder = recent_.get(index, [&] { return std::make_shared<const Decoder>(open(index)); });
        const LightFieldGrid& grid = reader_.parts()[index.part];
        const HogelRange of_stream = reader_.tiling()[index.tile];
        HogelRange common;
        common.s0 = std::max(of_stream.s0, tile.range.s0);
        common.t0 = std::max(of_stream.t0, tile.range.t0);
        common.ns = std::min(of_stream.s0 + of_stream.ns, tile.range.s0 + tile.range.ns) - common.s0;
        common.nt = std::min(of_stream.t0 + of_stream.nt, tile.range.t0 + tile.range.nt) - common.t0;
        LightFieldTile part(grid, common, false);
        with_tile_named(index, [&] { (*decoder)->read(part); });
        copy_common(part, tile, origin.v, origin.u);
    }

    StreamReader reader_;
    std::vector<std::unique_ptr<TileCoder>> coders_;  // one per part
    bool coefficients_;
    std::size_t layers_;
    mutable work::LruCache<Index, Decoder> recent_;
};

class DecodedFace final : public LightFieldSource {
  public:
    // @param depth   the same face of the depth stream, or null
    DecodedFace(std::shared_ptr<const DecodedStream> stream, std::size_t face,
                std::unique_ptr<LightFieldSource> depth = {})
        : stream_(std::move(stream)), depth_(std::move(depth)), grid_(stream_->info().faces()[face]), part_(face) {
        if (stream_->info().layout != StreamLayout::unfolded) return;
        part_ = 0;
        origin_ = Unfolding(stream_->info().faces()).origin(grid_.face());
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return depth_ != nullptr; }
    HogelRange preferred_tile() const override { return stream_->info().tile; }
    void read(LightFieldTile& tile) const override {
        validate(tile, grid_);
        stream_->read(part_, origin_, tile);
        stream_->info().companding.undo(tile.radiance.view());
        if (depth_ && tile.depth.size() > 0) read_depth(*depth_, stream_->info().depth.beyond, tile);
    }

  private:
    std::shared_ptr<const DecodedStream> stream_;
    std::unique_ptr<LightFieldSource> depth_;
    LightFieldGrid grid_;
    std::size_t part_;
    Unfolding::Origin origin_{0, 0};
};

}  // namespace

LightField open_stream(const std::filesystem::path& path, const StreamOptions& options) {
    const auto stream = std::make_shared<const DecodedStream>(path, options, false);
    const StreamInfo& info = stream->info();
    std::shared_ptr<const DecodedStream> depth;
    if (info.depth_there || (info.depth.bytes > 0 && options.layers == 0))
        depth = std::make_shared<const DecodedStream>(path, StreamOptions{.memory = options.memory}, false,
                                                      StreamReader::Content::depth);
    std::vector<LightField::Source> faces;
    for (std::size_t face = 0; face <= info.sides.size(); ++face)
        faces.push_back(std::make_shared<DecodedFace>(
            stream, face, depth ? std::make_unique<DecodedFace>(depth, face) : std::unique_ptr<DecodedFace>()));
    return LightField(std::move(faces), to_provenance(info.metadata));
}

LightField open_coefficients(const std::filesystem::path& path) {
    const auto stream = std::make_shared<const DecodedStream>(path, StreamOptions{}, true);
    std::vector<LightField::Source> faces;
    for (std::size_t face = 0; face <= stream->info().sides.size(); ++face)
        faces.push_back(std::make_shared<const DecodedFace>(stream, face));
    return LightField(std::move(faces), to_provenance(stream->info().metadata));
}

}  // namespace hogel
