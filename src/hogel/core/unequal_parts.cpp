// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/unequal_parts.h"

#include <utility>

namespace hogel::core {
namespace {

// Set between loops alone.
std::vector<double> current_speeds, current_first;

std::vector<double> or_equal(const std::vector<double>& parts, std::size_t processes) {
    return parts.size() == processes ? parts : std::vector<double>(processes, 1 / static_cast<double>(processes));
}

}  // namespace

UnequalParts::UnequalParts(std::vector<double> speeds, std::vector<double> first) {
    current_speeds = std::move(speeds);
    current_first = std::move(first);
}

UnequalParts::~UnequalParts() {
    current_speeds.clear();
    current_first.clear();
}

std::vector<double> parts_by_speed(std::size_t processes) { return or_equal(current_speeds, processes); }

std::vector<double> first_parts(std::size_t processes) { return or_equal(current_first, processes); }

}  // namespace hogel::core
