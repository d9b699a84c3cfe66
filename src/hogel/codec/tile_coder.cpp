// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/tile_coder.h"

#include <fmt/format.h>

#include "hogel/codec/exact_coder.h"
#include "hogel/codec/hogel_coder.h"
#include "hogel/error.h"

namespace hogel {

using namespace codec;

namespace {

class DecodedTile final : public TileDecoder {
  public:
    explicit DecodedTile(LightFieldTile tile) : tile_(std::move(tile)) {}
    void read(LightFieldTile& part) override { copy_common(tile_, part); }

  private:
    LightFieldTile tile_;
};

std::unique_ptr<TileCoder> make_hogel(const CodingMethod& method, const LightFieldGrid& grid,
                                      const DirectionCross& counted) {
    if (!method.transform.empty())
        throw Error(ErrorCode::usage, "coder, transform",
                    fmt::format("coder hogel has a transform of its own; expected none, not {}", method.transform));
    return make_hogel_coder(grid, counted);
}

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

Table<CoderInfo>& coders() {
    static Table<CoderInfo> table(
        "coder",
        [] {
            std::vector<CoderInfo> rows = thesis_coders();
            rows.insert(rows.begin(), {"hogel", "prediction along disparities between hogels", "", false, make_hogel});
            return rows;
        }(),
        "coder");
    return table;
}

namespace codec {

std::unique_ptr<TileCoder> make_tile_coder(const CodingMethod& method, const LightFieldGrid& grid,
                                           const DirectionCross& counted) {
    if (method == CodingMethod{"lossless", ""}) return make_lossless_coder(grid, counted);
    if (method == CodingMethod{"bounded", ""}) return make_bounded_coder(grid, counted, 0);
    return coders().find(method.coder).make(method, grid, counted);
}

}  // namespace codec
}  // namespace hogel
