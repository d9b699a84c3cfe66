// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>

#include "hogel/communicator.h"
#include "hogel/error.h"

namespace hogel::work {

/// The bytes of a message: a MiB, because the memory of larger ones is new each time.
inline constexpr std::size_t message_bytes = std::size_t{1} << 20;

/// Sends numbers to a process of a team, which receives as many.
template <class Number>
void send_in_chunks(Communicator& communicator, std::size_t process, std::span<const Number> numbers) {
    constexpr std::size_t piece = message_bytes / sizeof(Number);
    for (std::size_t first = 0; first < numbers.size(); first += piece) {
        const auto some = numbers.subspan(first, std::min(piece, numbers.size() - first));
        communicator.send_to(process, {reinterpret_cast<const char*>(some.data()), some.size_bytes()});
    }
}

template <class Number>
void receive_in_chunks(Communicator& communicator, std::size_t process, std::span<Number> numbers) {
    constexpr std::size_t piece = message_bytes / sizeof(Number);
    for (std::size_t first = 0; first < numbers.size(); first += piece) {
        const auto some = numbers.subspan(first, std::min(piece, numbers.size() - first));
        const std::string bytes = communicator.receive_from(process);
        if (bytes.size() != some.size_bytes())
            throw Error(ErrorCode::internal, "numbers from another process are more or fewer than expected");
        std::memcpy(some.data(), bytes.data(), bytes.size());
    }
}

/// Gives all processes of a team the numbers of the first one.
template <class Number>
void broadcast_in_chunks(Communicator& communicator, std::span<Number> numbers) {
    if (!communicator.is_root()) return receive_in_chunks(communicator, 0, numbers);
    for (std::size_t process = 1; process < communicator.size(); ++process)
        send_in_chunks<Number>(communicator, process, numbers);
}

}  // namespace hogel::work
