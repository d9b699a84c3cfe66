// SPDX-License-Identifier: Apache-2.0
// Distribution of a stream's bytes over hogels.
#include "hogel/compress.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

#include "hogel/codec/decode/hogel_decoder.h"
#include "hogel/codec/format/stream_file.h"
#include "hogel/error.h"

namespace hogel {

using namespace codec;
using namespace codec::format;

namespace {

// Returns the bytes of each hogel's code in a tile, [t][s]. Coders that code a tile's hogels together have no such
// codes.
std::vector<std::size_t> hogel_code_bytes(const StreamInfo& info, const TileCoder& coder,
                                          const std::vector<std::uint8_t>& code, const LightFieldGrid& grid,
                                          const HogelRange& range, std::size_t layers) {
    if (info.method.coder == "hogel") {
        const std::unique_ptr<TileDecoder> tile = coder.open(code, grid, range, std::min(layers, coder.layers(range)));
        if (const auto* by_hogels = dynamic_cast<const decode::HogelDecoder*>(tile.get()))
            return by_hogels->code_bytes();
    }
    return std::vector<std::size_t>(range.hogels());
}

}  // namespace

Array<double, 2> bytes_of_hogels(const std::filesystem::path& path, std::size_t layers, const Progress& progress) {
    const StreamReader reader(path);
    const StreamInfo& info = reader.info();
    if (layers > info.layers_there)
        throw Error(ErrorCode::usage, "layers",
                    fmt::format("{}: {} layers were asked for; it has {}", path.string(), layers, info.layers_there));
    if (layers == 0) layers = info.layers_there;
    Array<double, 2> of_hogels(Shape<2>{info.grid.hogels_t, info.grid.hogels_s});
    const Tiling& tiling = reader.tiling();
    for (std::size_t part = 0; part < reader.parts().size(); ++part) {
        const LightFieldGrid& grid = reader.parts()[part];
        const std::unique_ptr<TileCoder> coder = coder_of_part(info, grid);
        for (std::size_t tile = 0; tile < tiling.count(); ++tile) {
            progress.report(static_cast<double>(part * tiling.count() + tile) /
                            static_cast<double>(tiling.count() * reader.parts().size()));
            const std::vector<std::uint8_t> code = reader.read(part * tiling.count() + tile, layers);
            const HogelRange range = tiling[tile];
            const std::vector<std::size_t> code_bytes = hogel_code_bytes(info, *coder, code, grid, range, layers);
            const std::size_t shared =
                code.size() - std::accumulate(code_bytes.begin(), code_bytes.end(), std::size_t{0});
            const double share = static_cast<double>(shared) / static_cast<double>(range.hogels());
            for (std::size_t t = 0; t < range.nt; ++t)
                for (std::size_t s = 0; s < range.ns; ++s)
                    of_hogels(range.t0 + t, range.s0 + s) += static_cast<double>(code_bytes[t * range.ns + s]) + share;
        }
    }
    progress.report(1);
    return of_hogels;
}

}  // namespace hogel
