// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>

#include "hogel/progress.h"

namespace hogel::core {

/// Scope of a stop token. Parallel loops begun by this thread, and loops nested in their bodies on any thread, end with
/// Error(cancelled) after a stop request. Every public function with a Progress begins with a StopScope, so that loops
/// need no token argument. Scopes nest: a stop request of any of them takes effect.
class StopScope {
  public:
    explicit StopScope(const Progress& progress);
    ~StopScope();
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;

    bool requested() const;

  private:
    std::stop_token stop_;
    const StopScope* outer_;
};

/// Returns the innermost scope of this thread, or null. Loops pass it to their other threads.
const StopScope* stop_scope();

/// Puts this thread into the scope of the thread that began a loop.
class InheritedStopScope {
  public:
    explicit InheritedStopScope(const StopScope* scope);
    ~InheritedStopScope();
    InheritedStopScope(const InheritedStopScope&) = delete;
    InheritedStopScope& operator=(const InheritedStopScope&) = delete;

  private:
    const StopScope* before_;
};

/// Throws Error(cancelled) if a stop was requested in any scope of this thread. For long loops on one thread;
/// parallel_for() calls it before each body.
void throw_if_stopped();

}  // namespace hogel::core
