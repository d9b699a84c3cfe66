// SPDX-License-Identifier: Apache-2.0
#include "hogel/requests.h"

namespace hogel {

PropagateOptions PropagateParameters::options(const Grid& field) const {
    Grid output = field;
    if (output_pitch > 0) output.pitch_x = output.pitch_y = output_pitch;
    if (output_samples.columns > 0) {
        output.width = output_samples.columns;
        output.height = output_samples.rows;
    }
    output.center_x += offset_x;
    output.center_y += offset_y;
    return {.output = output, .max_error = max_error};
}

void PropagateParameters::resolve(const Grid& output) {
    // One number does not say that samples are farther apart in one direction.
    output_pitch = output.pitch_x == output.pitch_y ? output.pitch_x : 0;
    output_samples = {output.width, output.height};
}

void PropagateParameters::declare(Parameters& parameters) {
    parameters.length("--distance", distance, "Towards the viewer; negative goes back behind the hologram").required();
    parameters
        .choice("--display", display, {"intensity", "amplitude", "log", "phase", "field"},
                "intensity|amplitude|log|phase|field",
                "What a picture shows; log: four decades, phase: black at -pi to white at pi,\n"
                "field: real and imaginary parts, in a file (.exr) of channels")
        .acts_if([this] { return is_picture; });
    parameters.positive_length("--output-pitch", output_pitch, "Of the output's samples")
        .default_text("that of the input")
        .acts_if([this] { return output_pitch > 0; });
    parameters.counts("--output-samples", output_samples, "Of the output, across and down")
        .default_text("as many as the input has");
    parameters.length("--offset-x", offset_x, "Of the output's middle from that of the input, to the right");
    parameters.length("--offset-y", offset_y, "Of the output's middle from that of the input, upwards");
    parameters
        .number("--max-error", max_error, "E",
                "Greatest relative error of the samples (root mean square); what would exceed it is refused")
        .positive();
}

}  // namespace hogel
