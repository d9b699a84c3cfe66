// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/progress.h"
#include "hogel/resources.h"

namespace hogel {

/// Options of propagate().
struct PropagateOptions {
    std::size_t look = 0;                  ///< the look of the field to propagate
    ScratchOptions scratch{SIZE_MAX, {}};  ///< for work arrays; by default they are in memory
    /// The samples of the result: any number, any pitch, any centre, in the coordinates of the field. By default those
    /// of the field.
    std::optional<Grid> output = {};
    /// The largest relative root mean square error to accept, of the predicted error and of that which the field's own
    /// light at grazing directions makes. Work that would exceed it is refused.
    double max_error = 1e-3;
};

/// How propagate() will compute a field.
struct PropagationMethod {
    /// "identity": the distance is 0 and the output has the field's samples. "fft" or "chirp-z": the angular spectrum,
    /// with the frequencies' steps of a Fourier transform of padded samples, or with steps and output samples that are
    /// free of each other.
    std::string_view name;
    double fresnel_number = 0;  ///< (half the field's longer side)²/(λ distance); infinite at distance 0
    double error = 0;           ///< predicted relative root mean square error of noise over the output's samples
    std::size_t frequencies_x = 0, frequencies_y = 0;  ///< that are evaluated for a tile of the output, at the most
    std::size_t tiles_x = 1, tiles_y = 1;  ///< of the output, each propagated on its own; the field is read for each
    double bytes = 0;                      ///< of the work array; more than the scratch options' memory lies in a file
    double operations = 0;                 ///< floating-point operations, for estimates of time
};

/// The method for a field of this grid. Throws Error(usage) for a distance that is not finite, an invalid output grid
/// and a predicted error above options.max_error.
HOGEL_API PropagationMethod propagation_method(const FieldGrid& field, double distance,
                                               const PropagateOptions& options = {});

/// Propagates a field to a parallel plane, `distance` metres farther along +z (backwards if negative): the field at
/// the samples of options.output, completely in memory. The samples are read as a field without frequencies beyond
/// half a cycle per pitch (docs/notation.md, section 5), whose plane waves each gain e^{2πi f_z z} ([K] 6.1.1). That is
/// exact; steps and range of the frequencies follow from the field, the output and √(λ distance), so that near and far
/// planes are equally accurate. Evanescent waves decay forwards and are dropped backwards.
/// Throws Error(usage) as propagation_method() does, for work arrays that do not fit, and for a field with so much
/// light at grazing directions that the error would exceed options.max_error. Samples beside the cone of light that the
/// field's samples can send are 0; an output that lies wholly beside it is refused.
HOGEL_API Field propagate(const FieldSource& field, double distance, const PropagateOptions& options = {},
                          const Progress& progress = {});

/// As above, but writes the propagated field to a sink of the output's grid, which need not be in memory, and calls
/// finish(). What the sink has already of an interrupted run is not computed again.
HOGEL_API void propagate(const FieldSource& field, double distance, FieldSink& sink,
                         const PropagateOptions& options = {}, const Progress& progress = {});

/// Resources to propagate fields one after the other and write them to a file. Throws Error(usage) as
/// propagation_method() does.
HOGEL_API Plan plan_propagation(std::span<const FieldGrid> fields, double distance,
                                const PropagateOptions& options = {});

}  // namespace hogel
