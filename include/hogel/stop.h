// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/export.h"
#include "hogel/progress.h"

namespace hogel {

/// While this object exists, functions without a Progress that this thread calls, such as write_image(), end with
/// Error(cancelled) when a stop is requested from the progress's token. It must be destroyed by the same thread.
class HOGEL_API Stoppable {
  public:
    explicit Stoppable(const Progress& progress);
    ~Stoppable();
    Stoppable(const Stoppable&) = delete;
    Stoppable& operator=(const Stoppable&) = delete;

  private:
    struct Scope;
    std::unique_ptr<Scope> scope_;
};

}  // namespace hogel
