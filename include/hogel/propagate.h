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
    std::size_t look = 0;                  ///< look of the field to propagate
    ScratchOptions scratch{SIZE_MAX, {}};  ///< for work arrays; default: in memory
    /// Samples of the result: any number, pitch and centre, in the field's coordinates. Default: those of the field.
    std::optional<Grid> output = {};
    /// Largest accepted relative RMS error, for the predicted error and for the error due to light at grazing
    /// directions. propagate() refuses work with a larger error.
    double max_error = 1e-3;
};

/// The method and cost of propagate() for a field.
struct PropagationMethod {
    /// "identity": the distance is 0 and the output has the field's samples. "fft" or "chirp-z": angular spectrum.
    /// "fft" has the frequency steps of a Fourier transform of padded samples; "chirp-z" has free steps and output
    /// samples.
    std::string_view name;
    double fresnel_number = 0;  ///< (half the field's longer side)²/(λ distance); infinite at distance 0
    double error = 0;           ///< predicted relative RMS error of noise over the output's samples
    std::size_t frequencies_x = 0, frequencies_y = 0;  ///< largest number of frequencies per output tile
    std::size_t tiles_x = 1, tiles_y = 1;  ///< output tiles; each is propagated separately and reads the full field
    double bytes = 0;                      ///< size of the work array; above ScratchOptions::memory it is in a file
    double operations = 0;                 ///< floating-point operations, for time estimates
};

/// Selects the method for a field of this grid. Throws Error(usage) if the distance is not finite, the output grid is
/// invalid, or the predicted error exceeds options.max_error.
HOGEL_API PropagationMethod propagation_method(const FieldGrid& field, double distance,
                                               const PropagateOptions& options = {});

/// Propagates a field to a parallel plane, `distance` metres along +z (negative: backwards). Returns the field on the
/// samples of options.output, in memory. The samples represent a field without frequencies above half a cycle per pitch
/// (docs/notation.md, section 5). Each of its plane waves is multiplied by e^{2πi f_z z}, which is exact ([K] 6.1.1).
/// Frequency range and steps follow from the field, the output and √(λ distance), so near and far planes are equally
/// accurate. Evanescent waves decay forwards and are dropped backwards. Output samples outside the cone of light that
/// the field's samples can emit are 0.
///
/// Throws Error(usage) as propagation_method() does, for work arrays that do not fit into memory, for an output wholly
/// outside the cone of light, and if light at grazing directions would cause an error above options.max_error.
HOGEL_API Field propagate(const FieldSource& field, double distance, const PropagateOptions& options = {},
                          const Progress& progress = {});

/// Propagates a field as above into a sink of the output's grid, which need not be in memory, and calls finish(). Skips
/// regions for which FieldSink::has_already() is true.
HOGEL_API void propagate(const FieldSource& field, double distance, FieldSink& sink,
                         const PropagateOptions& options = {}, const Progress& progress = {});

/// Estimates the resources to propagate fields in succession and write them to a file. Throws as propagation_method().
HOGEL_API Plan plan_propagation(std::span<const FieldGrid> fields, double distance,
                                const PropagateOptions& options = {});

}  // namespace hogel
