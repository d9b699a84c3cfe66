// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/tile_coder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "hogel/codec/baselines/classic_coders.h"
#include "hogel/codec/exact_coder.h"
#include "hogel/codec/hogel_coder.h"
#include "hogel/error.h"

namespace hogel::codec {

using namespace format;

std::vector<std::string_view> coder_names() { return {"hogel", "threepass", "ezw", "jpeg4d", "fringes"}; }

namespace {

class DecodedTile final : public TileDecoder {
  public:
    explicit DecodedTile(LightFieldTile tile) : tile_(std::move(tile)) {}
    void read(LightFieldTile& part) override { copy_common(tile_, part); }

  private:
    LightFieldTile tile_;
};

}  // namespace

std::unique_ptr<TileDecoder> TileCoder::open(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid,
                                             const HogelRange& range, std::size_t) const {
    LightFieldTile tile(grid, range, false);
    decode(bytes, tile);
    return std::make_unique<DecodedTile>(std::move(tile));
}

void TileCoder::decode_coefficients(std::span<const std::uint8_t>, LightFieldTile&) const {
    throw Error(ErrorCode::usage, "this coder keeps no coefficients of directions; coder fringes does");
}

std::unique_ptr<TileCoder> make_tile_coder(const CodingMethod& method, const LightFieldGrid& grid,
                                           const DirectionCross& counted, std::uint32_t version) {
    if (method == CodingMethod{"lossless", ""}) return make_lossless_coder(grid, counted, version);
    if (method == CodingMethod{"bounded", ""}) return make_bounded_coder(grid, counted, 0, version);
    if (!std::ranges::count(coder_names(), method.coder))
        throw Error(ErrorCode::usage, fmt::format("there is no coder '{}'; expected one of {}", method.coder,
                                                  fmt::join(coder_names(), ", ")));
    if (method.coder != "hogel") return baselines::make_classic_coder(method, counted, version);
    if (!method.transform.empty())
        throw Error(ErrorCode::usage,
                    fmt::format("coder hogel has its own transform; expected none, not {}", method.transform));
    return make_hogel_coder(grid, counted, version);
}

std::string_view default_transform(std::string_view coder) {
    if (coder == "hogel") return "";
    return coder == "jpeg4d" ? "dct8" : "cdf97";
}

}  // namespace hogel::codec
