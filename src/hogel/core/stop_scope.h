// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>

#include "hogel/progress.h"

namespace hogel::core {

/// While this object exists, parallel loops begun by this thread, and loops inside their bodies on any thread, end with
/// Error(cancelled) when a stop is requested from the token. Every public function that takes a Progress begins with a
/// StopScope, so that the token need not be passed down to loops. Scopes nest: a stop of any of them takes effect.
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

/// The innermost scope of this thread, or null: what a loop hands on to the other threads that it uses.
const StopScope* stop_scope();

/// While this object exists, this thread is in the scope of the thread that began a loop.
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
