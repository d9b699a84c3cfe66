// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "hogel/requests.h"

namespace hogel {

bool MakeParameters::is_one_of(const std::vector<Output>& outputs) const {
    return made == Output::report || std::ranges::count(outputs, made) > 0;
}

void MakeParameters::fit() {
    if (!device.empty()) hologram.fit(find_modulator(device), render, false);
}

MakeRequest MakeParameters::request(std::uint64_t seed) const {
    MakeRequest request;
    request.light_field = render.request();
    request.hologram = hologram.request(seed, waves.number_of_looks());
    request.adapt_pitch = !hologram.pitch_given;
    request.camera = waves.model();
    request.rays = {pupil_samples};
    request.eye_distance = eye_distance;
    request.pupil = pupil;
    request.resolution = resolution;
    return request;
}

void MakeParameters::declare(Parameters& parameters, bool with_plane_waves) {
    const auto acts_on = [this](const std::vector<Output>& outputs) {
        return [this, outputs] { return is_one_of(outputs); };
    };
    parameters.group("Hologram");
    hologram.declare_pitch(parameters)
        .acts_if(acts_on({Output::hologram, Output::photographs, Output::speckle_free_photographs}));
    parameters
        .text("--device", device, "NAME",
              "Modulator that will show the hologram: sets pitch, hogels, directions, size and field of view, where no "
              "option does")
        .knows(modulator_names())
        .no_default()
        .never_acts();
    if (Parameter* const seed = parameters.look_up("seed"))
        seed->acts_if(acts_on({Output::hologram, Output::photographs}));
    parameters.group("Camera",
                     acts_on({Output::photographs, Output::speckle_free_photographs, Output::ray_photographs}));
    parameters.positive_length("--eye-distance", eye_distance, "Distance of the lens from the hologram plane")
        .sets_parameter("eye")
        .sets_parameter("focus");
    parameters.positive_length("--pupil", pupil, "Diameter of the lens");
    waves.declare_camera(parameters, with_plane_waves).acts_if(acts_on({Output::photographs}));
    parameters.count("--resolution", resolution, "Pixels across a photograph");
    waves
        .declare_looks(parameters, "--looks",
                       "Photographs averaged against speckle; fewer are enough where a pixel holds much of it")
        .default_text(fmt::format("up to {}", defaults.looks))
        .acts_if([this] { return is_one_of({Output::photographs}) && !waves.is_speckle_free(); });
    waves.declare_speckle(parameters).acts_if(acts_on({Output::photographs, Output::speckle_free_photographs}));
    parameters.count("--pupil-samples", pupil_samples, "Sample points of the pupil in a photograph by rays")
        .acts_if(acts_on({Output::ray_photographs}));
    render.declare(parameters);
}

}  // namespace hogel
