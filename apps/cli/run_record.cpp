// SPDX-License-Identifier: Apache-2.0
#include "run_record.h"

#include "command_line.h"
#include "hogel/version.h"

namespace hogel::cli {

Metadata run_metadata(const Session& session) {
    Metadata metadata{{"software", "hogel " HOGEL_VERSION}, {"command", "hogel " + session.command->name()}};
    for (const auto& [name, value] : session.command->acting()) metadata.emplace_back("option " + name, value);
    return metadata;
}

}  // namespace hogel::cli
