// SPDX-License-Identifier: Apache-2.0
#include "hologram_pitch.h"

#include <fmt/format.h>

#include "hogel/scene_model.h"
#include "hogel/units.h"

namespace hogel::cli {

HologramRequest request_for(std::span<const LightFieldGrid> faces, const HologramChoices& choices,
                            const Session& session, std::size_t looks) {
    HologramRequest request = choices.request(session, looks);
    // The sides of a hemicube show what the front's samples do not diffract.
    if (session.command->given("--pitch") || faces.size() != 1) return request;
    LightFieldRequest front;
    front.grid = faces.front();
    for (const Advice& advice : advise({}, front, request))
        if (advice.parameter == "pitch") request.pitch = advice.enough;
    return request;
}

void say_pitch(const HologramRequest& request, const HologramChoices& choices, const Session& session) {
    if (request.pitch == choices.pitch) return;
    session.say(fmt::format("pitch: {}, which diffracts the field of view; {}, the default, does not",
                            format_length(request.pitch), format_length(choices.pitch)));
}

}  // namespace hogel::cli
