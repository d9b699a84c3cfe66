// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stop_token>

namespace hogel::cli {

/// Requests the work to stop on Ctrl-C, SIGTERM and SIGHUP. A second signal more than a second later ends the program
/// at once. The delay is needed because wrappers such as timeout(1) send the first signal twice, to the program and to
/// its group.
///
/// The signals are blocked in the thread that creates this object, and in all threads started later; a separate thread
/// waits for them. Must be created before any other thread.
class Interrupts {
  public:
    explicit Interrupts(std::stop_source stop);
    ~Interrupts();
    Interrupts(const Interrupts&) = delete;
    Interrupts& operator=(const Interrupts&) = delete;

    /// Returns the first signal received, or 0.
    int signal() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace hogel::cli
