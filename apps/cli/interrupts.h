// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stop_token>

namespace hogel::cli {

/// Ctrl-C, SIGTERM and SIGHUP request the work to stop. A second signal more than a second later ends the program at
/// once; the delay is needed because wrappers such as timeout(1) send the first signal twice, to the program and to its
/// group.
///
/// The signals are blocked in the thread that creates this object, and so in all threads started later; a separate
/// thread waits for them. Must be created before any other thread.
class Interrupts {
  public:
    explicit Interrupts(std::stop_source stop);
    ~Interrupts();
    Interrupts(const Interrupts&) = delete;
    Interrupts& operator=(const Interrupts&) = delete;

    /// The first signal that was received, or 0.
    int signal() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace hogel::cli
