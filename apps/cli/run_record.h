// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/provenance.h"
#include "session.h"

namespace hogel::cli {

/// What the outputs of a run say of the command that made them: the version, the command, and the parameters that act
/// with their values, see Parameter::acts(). To be asked when the values are final.
Metadata run_metadata(const Session& session);

}  // namespace hogel::cli
