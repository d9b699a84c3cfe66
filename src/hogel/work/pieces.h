// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>

#include "hogel/error.h"
#include "hogel/team.h"

namespace hogel::work {

/// The bytes of a message: a MiB, because the memory of larger ones is new each time.
inline constexpr std::size_t piece_bytes = std::size_t{1} << 20;

/// Sends numbers to a process of a team, which receives as many.
template <class Number>
void send_in_pieces(Team& team, std::size_t process, std::span<const Number> numbers) {
    constexpr std::size_t piece = piece_bytes / sizeof(Number);
    for (std::size_t first = 0; first < numbers.size(); first += piece) {
        const auto some = numbers.subspan(first, std::min(piece, numbers.size() - first));
        team.send_to(process, {reinterpret_cast<const char*>(some.data()), some.size_bytes()});
    }
}

template <class Number>
void receive_in_pieces(Team& team, std::size_t process, std::span<Number> numbers) {
    constexpr std::size_t piece = piece_bytes / sizeof(Number);
    for (std::size_t first = 0; first < numbers.size(); first += piece) {
        const auto some = numbers.subspan(first, std::min(piece, numbers.size() - first));
        const std::string bytes = team.receive_from(process);
        if (bytes.size() != some.size_bytes())
            throw Error(ErrorCode::internal, "numbers from another process are more or fewer than expected");
        std::memcpy(some.data(), bytes.data(), bytes.size());
    }
}

/// Gives all processes of a team the numbers of the first one.
template <class Number>
void share_in_pieces(Team& team, std::span<Number> numbers) {
    if (!team.is_first()) return receive_in_pieces(team, 0, numbers);
    for (std::size_t process = 1; process < team.size(); ++process) send_in_pieces<Number>(team, process, numbers);
}

}  // namespace hogel::work
