// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/simd.h"

#include <fmt/format.h>
#include <hwy/targets.h>

#include <algorithm>

#include "hogel/error.h"

namespace hogel::core {

std::vector<std::int64_t> targets() {
    static const std::vector<std::int64_t> all = hwy::SupportedAndGeneratedTargets();
    return all;
}

std::string target_name(std::int64_t target) { return hwy::TargetName(target); }

void use_target(std::int64_t target) {
    const std::vector<std::int64_t> known = targets();
    if (target != 0 && std::ranges::find(known, target) == known.end())
        throw Error(ErrorCode::usage,
                    fmt::format("SIMD target {}: not in this build, or not on this processor", target_name(target)));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace hogel::core
