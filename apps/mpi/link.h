// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace hogel::mpi {

/// The kinds of messages between processes.
enum class Kind : int { ask = 1, answer, report, verdict, post, please_stop, stop, direct };

struct Message {
    std::size_t from = 0;
    std::string bytes;
};

/// Messages between the processes of a team. Between two processes those of a kind arrive in the order in which they
/// were sent. Thread-safe; no call waits.
class Link {
  public:
    virtual ~Link() = default;
    virtual std::size_t rank() const = 0;
    virtual std::size_t size() const = 0;
    virtual void send(std::size_t to, Kind kind, std::string bytes) = 0;
    /// A message of that kind that has arrived, if any.
    virtual std::optional<Message> receive(Kind kind) = 0;
};

}  // namespace hogel::mpi
