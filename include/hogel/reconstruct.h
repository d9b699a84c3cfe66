// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/geometry.h"
#include "hogel/progress.h"

namespace hogel {

/// Selects one diffraction order of a recorded or encoded hologram, and the aperture that isolates it.
struct OrderSelection {
    /// Whether to subtract the mean of the samples first: in a recorded intensity, most of the undiffracted light.
    bool without_mean = false;
    /// Source (z < 0) or focus (z > 0) of a spherical reference wave, metres. The samples are multiplied by that wave,
    /// e^{±ikr}, before the order is selected.
    std::optional<Vec3> reference_source;
    /// center: around frequency zero, for in-line holograms. right, left: the order with the most light at positive or
    /// negative horizontal frequencies (upward or downward if vertical). at: around frequency_x, frequency_y.
    enum class Which { center, right, left, at };
    Which which = Which::center;
    double frequency_x = 0, frequency_y = 0;  ///< cycles per sample; x to the right, y upwards
    /// Radius of the round aperture in the spectrum, cycles per sample. 0: half the distance from the order to
    /// frequency zero, or the full spectrum for the order at zero.
    double radius = 0;
};

/// The result of select_order().
struct SelectedOrder {
    Field field;  ///< order shifted to frequency zero, on the samples of the hologram
    double frequency_x = 0, frequency_y = 0, radius = 0;  ///< cycles per sample
};

/// Isolates an order in the spectrum of look 0 and shifts it to frequency zero. Memory: the full field. Throws
/// Error(usage) if the aperture contains no frequency or lies beyond half a cycle per sample.
HOGEL_API SelectedOrder select_order(const FieldSource& hologram, const OrderSelection& selection,
                                     const Progress& progress = {});

/// Returns the field in the back focal plane of a lens of focal length f > 0 (metres), with the given field in the
/// front focal plane: F(X) = 1/(iλf) ∫ F(x) e^{−2πi x·X/λf} dx. This is the image of a Fourier hologram. The result has
/// as many samples as the field, with pitch λf/(N Δ). Throws Error(usage) if f is not positive and finite.
HOGEL_API Field fourier_image(const FieldSource& hologram, double focal_length, const Progress& progress = {});

/// Returns the field at a distance d along z (metres; negative: backwards) by one Fourier transform in the Fresnel
/// approximation: F(X) = e^{iπX²/λd}/(iλd) ∫ F(x) e^{iπx²/λd} e^{−2πi x·X/λd} dx. This is the image of a Fresnel
/// hologram, on the samples of programs that use a single transform: pitch λ|d|/(N Δ). Throws Error(usage) for a
/// distance of 0.
HOGEL_API Field fresnel_image(const FieldSource& hologram, double distance, const Progress& progress = {});

}  // namespace hogel
