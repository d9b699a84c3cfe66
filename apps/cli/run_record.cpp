// SPDX-License-Identifier: Apache-2.0
#include "run_record.h"

#include "command_line.h"
#include "hogel/version.h"

namespace hogel::cli {

void RunRecord::acted(std::initializer_list<std::string_view> options) {
    for (const std::string_view option : options) acted_.try_emplace(std::string(option));
}

void RunRecord::acted(std::string_view option, const std::string& value) {
    acted_.insert_or_assign(std::string(option), value);
}

void RunRecord::idle(std::string_view option) {
    if (const auto found = acted_.find(option); found != acted_.end()) acted_.erase(found);
}

Metadata RunRecord::metadata() const {
    Metadata metadata{{"software", "hogel " HOGEL_VERSION}, {"command", "hogel " + session_->command->name()}};
    for (const auto& [name, typed] : session_->command->values()) {
        const auto found = acted_.find(name);
        if (found == acted_.end()) continue;
        const std::string& value = found->second.empty() ? typed : found->second;
        if (!value.empty()) metadata.emplace_back("option " + name, value);
    }
    return metadata;
}

}  // namespace hogel::cli
