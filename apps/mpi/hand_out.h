// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace hogel::mpi {

/// Returns the number of tiles handed out per request: a quarter of the rank's fair share of the tiles left, 1 to 16.
/// The tiles are neighbours, which may share data. The load stays balanced if tile costs differ by a factor of 100
/// (docs/decisions/0115-tiles-for-ranks.md).
/// @param left  number of tiles not handed out yet
inline std::uint64_t tiles_at_once(std::uint64_t left, std::uint64_t ranks) {
    constexpr std::uint64_t share_divisor = 4, max_tiles_at_once = 16;
    return std::min(left, std::clamp<std::uint64_t>(left / (share_divisor * ranks), 1, max_tiles_at_once));
}

/// Returns whether a rank prefetches tiles when it begins its last one. Not towards the end: a busy rank would hold
/// tiles that an idle one could take.
/// @param left  upper bound of the number of tiles not handed out, as known to this rank
inline bool asks_ahead(std::uint64_t left, std::uint64_t ranks) {
    constexpr std::uint64_t min_per_rank = 4;
    return left > min_per_rank * ranks;
}

}  // namespace hogel::mpi
