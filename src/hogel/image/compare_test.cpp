// SPDX-License-Identifier: Apache-2.0
#include "hogel/image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "hogel/error.h"

namespace hogel::image {
namespace {

Image constant(std::size_t width, std::size_t height, std::size_t channels, float display) {
    Image image(width, height, channels);
    std::ranges::fill(image.pixels.elements(), srgb_decode(display));
    return image;
}

Image noise(std::size_t width, std::size_t height, std::size_t channels, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> light(0, 1);
    Image image(width, height, channels);
    for (float& value : image.pixels.elements()) value = light(random);
    return image;
}

// SSIM by its definition: for an 11 x 11 window around every pixel, the means, then the variances about those means.
double ssim_by_definition(const Image& a, const Image& b, double exposure) {
    const auto luma = [&](const Image& image, std::size_t y, std::size_t x) {
        const auto value = [&](std::size_t c) {
            return static_cast<double>(srgb_encode(static_cast<float>(image.pixels(y, x, c) * exposure)));
        };
        return image.channels() == 3 ? 0.2126 * value(0) + 0.7152 * value(1) + 0.0722 * value(2) : value(0);
    };
    double norm = 0, total = 0;
    const auto weight = [](int i, int j) { return std::exp(-(i * i + j * j) / (2 * 1.5 * 1.5)); };
    for (int j = -5; j <= 5; ++j)
        for (int i = -5; i <= 5; ++i) norm += weight(i, j);
    // The central value of the published window, MATLAB's fspecial('gaussian', 11, 1.5).
    EXPECT_NEAR(1 / norm, 0.0707622, 1e-7);
    std::size_t places = 0;
    for (std::size_t y = 5; y + 5 < a.height(); ++y)
        for (std::size_t x = 5; x + 5 < a.width(); ++x, ++places) {
            double ma = 0, mb = 0, va = 0, vb = 0, cov = 0;
            for (int pass = 0; pass < 2; ++pass)
                for (int j = -5; j <= 5; ++j)
                    for (int i = -5; i <= 5; ++i) {
                        const double w = weight(i, j) / norm;
                        const double pa = luma(a, y + static_cast<std::size_t>(j), x + static_cast<std::size_t>(i));
                        const double pb = luma(b, y + static_cast<std::size_t>(j), x + static_cast<std::size_t>(i));
                        if (pass == 0) {
                            ma += w * pa;
                            mb += w * pb;
                        } else {
                            va += w * (pa - ma) * (pa - ma);
                            vb += w * (pb - mb) * (pb - mb);
                            cov += w * (pa - ma) * (pb - mb);
                        }
                    }
            total += (2 * ma * mb + 1e-4) * (2 * cov + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
        }
    return total / static_cast<double>(places);
}

TEST(Compare, equal_pictures_are_perfect) {
    for (std::size_t size : {1, 2, 10, 11, 12, 40}) {
        const Image image = noise(size, size + 1, 3, 1);
        const ImageComparison result = compare(image, image, 0.7);
        EXPECT_EQ(result.psnr, std::numeric_limits<double>::infinity());
        EXPECT_EQ(result.linear_psnr, std::numeric_limits<double>::infinity());
        EXPECT_EQ(result.ssim, 1);
        EXPECT_EQ(result.max_error, 0);
    }
}

TEST(Compare, constant_pictures_have_the_analytic_values) {
    for (std::size_t size : {1, 4, 11, 30})
        for (std::size_t channels : {1, 3}) {
            const double a = 0.5, b = 0.6;
            const ImageComparison result =
                compare(constant(size, size, channels, 0.5f), constant(size, size, channels, 0.6f));
            EXPECT_NEAR(result.psnr, 20, 1e-3);  // an error of 0.1 everywhere
            EXPECT_NEAR(result.max_error, 0.1, 1e-5);
            EXPECT_NEAR(result.ssim, (2 * a * b + 1e-4) / (a * a + b * b + 1e-4), 1e-6);
            const double linear = static_cast<double>(srgb_decode(0.6f)) - srgb_decode(0.5f);
            EXPECT_NEAR(result.linear_psnr, -20 * std::log10(linear), 1e-6);
        }
}

TEST(Compare, ssim_follows_its_definition) {
    for (std::size_t channels : {1, 3}) {
        const Image a = noise(31, 24, channels, 1);
        Image b = noise(31, 24, channels, 2);
        for (float mix : {0.02f, 0.3f, 1.0f}) {
            Image blend = a;
            for (std::size_t i = 0; i < blend.pixels.size(); ++i)
                blend.pixels.data()[i] += mix * (b.pixels.data()[i] - a.pixels.data()[i]);
            const double expected = ssim_by_definition(a, blend, 0.9);
            EXPECT_NEAR(compare(a, blend, 0.9).ssim, expected, 1e-12);
            EXPECT_NEAR(compare(blend, a, 0.9).ssim, expected, 1e-12);
            EXPECT_LT(expected, 0.9999);
        }
    }
}

TEST(Compare, linear_psnr_does_not_depend_on_the_units_of_light) {
    const Image a = noise(16, 16, 3, 1), b = noise(16, 16, 3, 2);
    Image a4 = a, b4 = b;
    for (float& value : a4.pixels.elements()) value *= 4;
    for (float& value : b4.pixels.elements()) value *= 4;
    const ImageComparison one = compare(a, b), four = compare(a4, b4, 0.25);
    EXPECT_NEAR(one.linear_psnr, four.linear_psnr, 1e-9);
    EXPECT_NEAR(one.psnr, four.psnr, 1e-9);
    // Display values are clamped, so everything brighter than white is white.
    EXPECT_EQ(compare(constant(4, 4, 1, 1),
                      [] {
                          Image bright(4, 4, 1);
                          std::ranges::fill(bright.pixels.elements(), 3.0f);
                          return bright;
                      }())
                  .psnr,
              std::numeric_limits<double>::infinity());
}

TEST(Compare, a_pixel_that_is_no_number_is_not_taken_for_black) {
    Image picture(16, 16, 3);
    const Image black = picture;
    picture.pixels(7, 8, 1) = std::numeric_limits<float>::quiet_NaN();
    for (const ImageComparison& result : {compare(picture, black), compare(black, picture), compare(picture, picture)})
        for (const double measure : {result.psnr, result.ssim, result.max_error, result.linear_psnr})
            EXPECT_TRUE(std::isnan(measure)) << measure;
}

TEST(Compare, refuses_pictures_of_different_size) {
    EXPECT_THROW(compare(noise(4, 5, 3, 1), noise(5, 4, 3, 1)), Error);
    EXPECT_THROW(compare(noise(4, 5, 3, 1), noise(4, 5, 1, 1)), Error);
    EXPECT_THROW(compare(Image(), Image()), Error);
    EXPECT_THROW(compare(noise(4, 5, 3, 1), noise(4, 5, 3, 1), 0), Error);
}

}  // namespace
}  // namespace hogel::image
