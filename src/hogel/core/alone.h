// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/team.h"

namespace hogel::core {

/// While this object exists, this process works as if it were in no team: on what the processes of its team do not
/// share.
class AloneScope {
  public:
    AloneScope();
    ~AloneScope();
    AloneScope(const AloneScope&) = delete;
    AloneScope& operator=(const AloneScope&) = delete;

  private:
    Team* team_;
};

}  // namespace hogel::core
