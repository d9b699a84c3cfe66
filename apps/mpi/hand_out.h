// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace hogel::mpi {

/// How many tiles a process is given when it asks, where `left` of them are not handed out yet: a fraction of its fair
/// share, and at most so many: neighbours, which may have much in common. Work whose tiles differ in cost by a hundred
/// times stays even (docs/decisions/0115-tiles-for-ranks.md).
inline std::uint64_t tiles_at_once(std::uint64_t left, std::uint64_t processes) {
    constexpr std::uint64_t of_fair_share = 4, max_tiles_at_once = 16;
    return std::min(left, std::clamp<std::uint64_t>(left / (of_fair_share * processes), 1, max_tiles_at_once));
}

/// Whether a process that begins the last tile that it has asks for more at once, so that they are under way meanwhile.
/// Not towards the end, where a process that is at work would hold a tile that an idle one could take.
/// @param left  tiles that are not handed out, as far as the process knows
inline bool asks_ahead(std::uint64_t left, std::uint64_t processes) {
    constexpr std::uint64_t few_for_each = 4;
    return left > few_for_each * processes;
}

}  // namespace hogel::mpi
