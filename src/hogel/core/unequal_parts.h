// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace hogel::core {

/// While this object exists, photographs are not divided equally among the processes of a team, because some of them
/// are faster or come to it earlier than others. All processes give the same numbers.
class UnequalParts {
  public:
    /// @param speeds  parts of what all processes begin together, of each; their sum is 1
    /// @param first   parts of what comes first, which make up for the different times at which processes come to it
    UnequalParts(std::vector<double> speeds, std::vector<double> first);
    ~UnequalParts();
    UnequalParts(const UnequalParts&) = delete;
    UnequalParts& operator=(const UnequalParts&) = delete;
};

/// The parts of the processes: those of the UnequalParts which exists, or equal ones.
std::vector<double> parts_by_speed(std::size_t processes);
std::vector<double> first_parts(std::size_t processes);

}  // namespace hogel::core
