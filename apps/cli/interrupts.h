// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stop_token>

namespace hogel::cli {

/// Ctrl-C and SIGTERM ask the work to stop. A second one that comes more than a second later ends the program at once;
/// wrappers such as timeout(1) send the first one twice, to the program and to its group.
///
/// The signals are blocked in the thread that creates this object, and so in all threads that are started afterwards;
/// a thread of the object's own waits for them. To be created before any other thread exists.
class Interrupts {
  public:
    explicit Interrupts(std::stop_source stop);
    ~Interrupts();
    Interrupts(const Interrupts&) = delete;
    Interrupts& operator=(const Interrupts&) = delete;

    /// The signal that came first, or 0.
    int signal() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace hogel::cli
