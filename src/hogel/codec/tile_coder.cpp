#include "hogel/codec/tile_coder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "hogel/codec/classic_internal.h"
#include "hogel/core/error.h"

namespace hogel {

std::vector<std::string_view> coder_names() { return {"threepass", "ezw", "jpeg4d"}; }

std::unique_ptr<TileCoder> make_tile_coder(const CodingMethod& method) {
    if (!std::ranges::count(coder_names(), method.coder))
        throw Error(ErrorCode::usage, fmt::format("there is no coder '{}'; expected one of {}", method.coder,
                                                  fmt::join(coder_names(), ", ")));
    return make_classic_coder(method);
}

}  // namespace hogel
