#pragma once

#include "hogel/image/image.h"

namespace hogel {

/// How alike two pictures are. PSNR and SSIM are taken on display values: sRGB of the linear values times the exposure,
/// clamped to 0..1, because that is what an eye compares.
struct ImageComparison {
    double psnr = 0;  ///< dB, peak 1; +infinity for equal pictures
    double ssim = 0;  ///< mean of the luma over all whole windows, Gaussian of 11 pixels, σ 1.5 (Wang et al. 2004)
    double max_error = 0;    ///< largest absolute difference of display values
    double linear_psnr = 0;  ///< dB in linear light, peak 1/exposure, not clamped
};

/// Throws Error(bad_input) for pictures of different size.
ImageComparison compare(const Image& a, const Image& b, double exposure = 1);

}  // namespace hogel
