// SPDX-License-Identifier: Apache-2.0
#include "hologram_pitch.h"

#include <fmt/format.h>

#include "hogel/pipeline.h"
#include "hogel/units.h"

namespace hogel::cli {

HologramRequest request_for(std::span<const LightFieldGrid> faces, const HologramParameters& choices,
                            const Session& session, std::size_t looks) {
    HologramRequest request = choices.request(session.seed, looks);
    if (!session.command->given("--pitch")) request.pitch = diffracting_pitch(faces, request);
    return request;
}

void say_pitch(const HologramRequest& request, const HologramParameters& choices, const Session& session) {
    if (request.pitch == choices.pitch) return;
    session.say(fmt::format("pitch: {}, which diffracts the field of view; {}, the default, does not",
                            format_length(request.pitch), format_length(choices.pitch)));
}

}  // namespace hogel::cli
