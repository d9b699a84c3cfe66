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
    // One number cannot express two different pitches.
    output_pitch = output.pitch_x == output.pitch_y ? output.pitch_x : 0;
    output_samples = {output.width, output.height};
}

void PropagateParameters::declare(Parameters& parameters) {
    parameters.length("--distance", distance, "Distance towards the viewer; negative: back behind the hologram")
        .required();
    parameters
        .choice("--display", display, {"intensity", "amplitude", "log", "phase", "field"},
                "intensity|amplitude|log|phase|field",
                "Content of a picture:\nlog: four decades of intensity\nphase: black at -pi to white at pi\n"
                "field: real and imaginary parts, in the channels of an .exr file")
        .acts_if([this] { return is_picture; });
    parameters.positive_length("--output-pitch", output_pitch, "Sample pitch of the output")
        .default_text("that of the input")
        .acts_if([this] { return output_pitch > 0; });
    parameters.counts("--output-samples", output_samples, "Samples of the output, across and down")
        .default_text("as many as the input has");
    parameters.length("--offset-x", offset_x, "Offset of the output's middle from the input's, to the right");
    parameters.length("--offset-y", offset_y, "Offset of the output's middle from the input's, upwards");
    parameters
        .number("--max-error", max_error, "E",
                "Maximum relative RMS error of the samples; a propagation that would exceed it is refused")
        .positive();
}

}  // namespace hogel
