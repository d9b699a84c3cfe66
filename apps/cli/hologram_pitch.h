// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "inputs.h"

namespace hogel::cli {

/// The request of these choices for a light field of these faces. Where the command line gives no pitch and the default
/// one does not diffract the field of view, it has one that does.
HologramRequest request_for(std::span<const LightFieldGrid> faces, const HologramParameters& choices,
                            const Session& session, std::size_t looks);

/// Says the pitch of that request where it is neither given nor the default.
void say_pitch(const HologramRequest& request, const HologramParameters& choices, const Session& session);

}  // namespace hogel::cli
