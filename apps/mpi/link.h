// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace hogel::mpi {

/// Kinds of messages between ranks.
enum class Kind : int { tile_request = 1, tile_answer, report, combined_report, message, stop_request, stop, direct };

struct Message {
    std::size_t from = 0;
    std::string bytes;
};

/// Transport of messages between ranks. Messages of one kind between two ranks arrive in the order of sending.
/// Thread-safe; no call blocks.
class Link {
  public:
    virtual ~Link() = default;
    virtual std::size_t rank() const = 0;
    virtual std::size_t size() const = 0;
    virtual void send(std::size_t to, Kind kind, std::string bytes) = 0;
    /// Returns a message of that kind that has arrived, if any.
    virtual std::optional<Message> receive(Kind kind) = 0;
};

}  // namespace hogel::mpi
