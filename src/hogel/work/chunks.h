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

/// Bytes of a message: one MiB, because the allocator maps new memory for each larger message.
inline constexpr std::size_t message_bytes = std::size_t{1} << 20;

/// Sends an array to a rank. That rank must receive the same number of values.
template <class Number>
void send_in_chunks(Communicator& communicator, std::size_t rank, std::span<const Number> numbers) {
    constexpr std::size_t chunk_size = message_bytes / sizeof(Number);
    for (std::size_t first = 0; first < numbers.size(); first += chunk_size) {
        const auto chunk = numbers.subspan(first, std::min(chunk_size, numbers.size() - first));
        communicator.send_to(rank, {reinterpret_cast<const char*>(chunk.data()), chunk.size_bytes()});
    }
}

template <class Number>
void receive_in_chunks(Communicator& communicator, std::size_t rank, std::span<Number> numbers) {
    constexpr std::size_t chunk_size = message_bytes / sizeof(Number);
    for (std::size_t first = 0; first < numbers.size(); first += chunk_size) {
        const auto chunk = numbers.subspan(first, std::min(chunk_size, numbers.size() - first));
        const std::string bytes = communicator.receive_from(rank);
        if (bytes.size() != chunk.size_bytes())
            throw Error(ErrorCode::internal, "a message from another rank has an unexpected length");
        std::memcpy(chunk.data(), bytes.data(), bytes.size());
    }
}

/// Copies an array of the root to all ranks.
template <class Number>
void broadcast_in_chunks(Communicator& communicator, std::span<Number> numbers) {
    if (!communicator.is_root()) return receive_in_chunks(communicator, 0, numbers);
    for (std::size_t rank = 1; rank < communicator.size(); ++rank) send_in_chunks<Number>(communicator, rank, numbers);
}

}  // namespace hogel::work
