// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/provenance.h"
#include "session.h"

namespace hogel::cli {

/// Returns the metadata stored in the outputs of a run: version, command, and the values of the parameters that act,
/// see Parameter::acts(). To be called when the values are final.
Metadata run_metadata(const Session& session);

}  // namespace hogel::cli
