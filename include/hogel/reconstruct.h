// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/geometry.h"
#include "hogel/progress.h"

namespace hogel {

/// Which diffraction order of a recorded or encoded hologram is the object's, and how it is cut out.
struct OrderSelection {
    /// Subtracts the mean of the samples first: of a recorded intensity, most of the light that is not diffracted.
    bool without_mean = false;
    /// Where the light of a spherical reference wave came from (z < 0) or would meet (z > 0): the samples are
    /// multiplied by that wave, e^{±ikr}, before the order is cut out.
    std::optional<Vec3> reference_source;
    /// center: about frequency zero, where an in-line hologram has everything. right, left: the order with the most
    /// light at positive, or negative, horizontal frequencies (upward or downward where it is vertical). at: around
    /// frequency_x, frequency_y.
    enum class Which { center, right, left, at };
    Which which = Which::center;
    double frequency_x = 0, frequency_y = 0;  ///< cycles per sample; x to the right, y upwards
    /// Radius of the round opening, cycles per sample. 0: half the way from the order to frequency zero; all, of the
    /// one about zero.
    double radius = 0;
};

/// What select_order() found.
struct SelectedOrder {
    Field field;  ///< the order moved to frequency zero, at the samples of the hologram
    double frequency_x = 0, frequency_y = 0, radius = 0;  ///< cycles per sample
};

/// Cuts an order out of the spectrum of look 0 and moves it to frequency zero. The whole field is in memory. Throws
/// Error(usage) for an opening that holds no frequency or lies beyond half a cycle per sample.
HOGEL_API SelectedOrder select_order(const FieldSource& hologram, const OrderSelection& selection,
                                     const Progress& progress = {});

/// The field in the back focal plane of a lens of focal length f > 0, in the front focal plane of which the given field
/// lies: F(X) = 1/(iλf) ∫ F(x) e^{−2πi x·X/λf} dx, at as many samples, λf/(N Δ) apart. The picture of a Fourier
/// hologram. Throws Error(usage) for a focal length that is not positive and finite.
HOGEL_API Field fourier_image(const FieldSource& hologram, double focal_length, const Progress& progress = {});

/// The field at a distance d along z (negative: backwards) by one Fourier transform, Fresnel's approximation: F(X) =
/// e^{iπX²/λd}/(iλd) ∫ F(x) e^{iπx²/λd} e^{−2πi x·X/λd} dx, at samples λ|d|/(N Δ) apart. The picture of a Fresnel
/// hologram, at the sampling that programs which use one transform have. Throws Error(usage) for a distance of 0.
HOGEL_API Field fresnel_image(const FieldSource& hologram, double distance, const Progress& progress = {});

}  // namespace hogel
