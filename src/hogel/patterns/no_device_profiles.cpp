// SPDX-License-Identifier: Apache-2.0
// For builds without JSON.
#include "hogel/error.h"
#include "hogel/patterns/device_profiles.h"

namespace hogel {

Modulator patterns::read_profile(const std::string&, std::string_view, const std::string& file) {
    throw Error(ErrorCode::not_built_in, file + ": builds with HOGEL_MINIMAL=ON read no device profiles");
}

std::vector<Modulator> patterns::own_profiles() { return {}; }

std::vector<Modulator> patterns::profiles_in(const std::filesystem::path&) { return {}; }

std::vector<Modulator> patterns::all_profiles() { return {}; }

void patterns::require_modulator(const std::string&, const std::vector<std::string>&) {}

}  // namespace hogel
