#include "hogel/codec/tile_coder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "hogel/codec/classic_internal.h"
#include "hogel/core/error.h"

namespace hogel {

std::vector<std::string_view> coder_names() { return {"threepass", "ezw", "jpeg4d", "fringes"}; }

void TileCoder::decode_coefficients(std::span<const std::uint8_t>, LightFieldTile&) const {
    throw Error(ErrorCode::usage, "this coder keeps no coefficients of directions; coder fringes does");
}

std::unique_ptr<TileCoder> make_tile_coder(const CodingMethod& method) {
    if (!std::ranges::count(coder_names(), method.coder))
        throw Error(ErrorCode::usage, fmt::format("there is no coder '{}'; expected one of {}", method.coder,
                                                  fmt::join(coder_names(), ", ")));
    return make_classic_coder(method);
}

}  // namespace hogel
