// SPDX-License-Identifier: Apache-2.0
#include "thesis/wavelets/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hogel/error.h"
#include "hogel/math/dct.h"
#include "hogel/work/parallel.h"
#include "thesis/wavelets/dct.h"
#include "thesis/wavelets/line.h"

namespace hogel::wavelets {
namespace {

using Extents = std::vector<std::size_t>;

std::vector<float> noise(std::size_t count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<float> values(count);
    for (float& value : values) value = uniform(random);
    return values;
}

double max_difference(std::span<const float> a, std::span<const float> b) {
    double max_found = 0;
    for (std::size_t i = 0; i < a.size(); ++i) max_found = std::max<double>(max_found, std::abs(a[i] - b[i]));
    return max_found;
}

// Returns the coefficients of one level and of all levels of a line by the plain twin, each multiplied by the measured
// norm of its basis function.
std::vector<double> plain_inverse(const Wavelet& wavelet, int levels, std::vector<double> line) {
    for (int level = levels - 1; level >= 0; --level)
        inverse_line_plain(wavelet, std::span(line).first(((line.size() - 1) >> level) + 1));
    return line;
}
void forward_plain(const Transform& chosen, int levels, std::span<double> line) {
    if (!chosen.is_wavelet()) {
        const std::vector<double> in(line.begin(), line.end());
        for (std::size_t at = 0; at < line.size(); ++at) {
            const std::size_t first = at / 8 * 8, n = std::min<std::size_t>(8, line.size() - first);
            line[at] = 0;
            for (std::size_t j = 0; j < n; ++j) line[at] += math::dct_element(n, at - first, j) * in[first + j];
        }
        return;
    }
    for (int level = 0; level < levels; ++level)
        forward_line_plain(chosen.wavelet(), line.first(((line.size() - 1) >> level) + 1));
    for (std::size_t at = 0; at < line.size(); ++at) {
        std::vector<double> impulse(line.size());
        impulse[at] = 1;
        double squares = 0;
        for (double value : plain_inverse(chosen.wavelet(), levels, impulse)) squares += value * value;
        line[at] *= std::sqrt(squares);
    }
}

TEST(Transform, names_are_found_and_others_named) {
    for (std::string_view name : transform_names()) EXPECT_EQ(transform(name).name(), name);
    EXPECT_EQ(transform_names().size(), 16u);
    try {
        transform("db7");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find("db7"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("ai33"), std::string::npos);
    }
}

// If dimensions are transformed separately, the transform of a product is the product of the transforms.
TEST(Transform, of_a_product_is_the_product) {
    const Extents shape{9, 16, 7, 21};
    const Pyramid pyramid = Pyramid::separate(shape, {{0}, {1}, {2}, {3}});
    for (std::string_view name : transform_names()) {
        const Transform chosen = transform(name);
        std::vector<std::vector<double>> lines;
        for (std::size_t axis = 0; axis < 4; ++axis) {
            std::vector<double> line(shape[axis]);
            for (std::size_t k = 0; k < line.size(); ++k)
                line[k] = std::sin(0.5 + static_cast<double>((axis + 1) * k * k));
            lines.push_back(line);
        }
        const auto product = [&] {
            std::vector<float> values;
            for (double a : lines[0])
                for (double b : lines[1])
                    for (double c : lines[2])
                        for (double d : lines[3]) values.push_back(static_cast<float>(a * b * c * d));
            return values;
        };
        std::vector<float> values = product();
        chosen.forward(pyramid, values);
        for (std::size_t axis = 0; axis < 4; ++axis) forward_plain(chosen, pyramid.groups()[axis].levels, lines[axis]);
        EXPECT_LT(max_difference(values, product()), 1e-3) << name;
    }
}

// Interleaved in 2D, the basis function of a coefficient is the product of two functions of the same level.
TEST(Transform, interleaved_basis_functions_are_products_of_one_level) {
    const Transform chosen = transform("ai33");
    const Pyramid pyramid(Extents{13, 22}, {{{0, 1}, 3}});
    const auto response = [&](const Pyramid& of, std::size_t at) {
        std::vector<float> values(of.size());
        values[at] = 1;
        chosen.inverse(of, values);
        return values;
    };
    for (std::size_t y = 0; y < 13; ++y)
        for (std::size_t x = 0; x < 22; ++x) {
            int level = 3;  // level of the band, from an axis with details
            while (level > 1 && (y >= pyramid.coarse_extent(0, level - 1) || x >= pyramid.coarse_extent(1, level - 1)))
                --level;
            const std::vector<float> both = response(pyramid, y * 22 + x),
                                     down = response(Pyramid(Extents{13}, {{{0}, level}}), y),
                                     along = response(Pyramid(Extents{22}, {{{0}, level}}), x);
            for (std::size_t i = 0; i < both.size(); ++i)
                ASSERT_NEAR(both[i], down[i / 22] * along[i % 22], 1e-5) << y << " " << x << " " << i;
        }
}

// In bands of all levels and also at the ends, so the error of a quantised coefficient has the same energy in the
// array.
TEST(Transform, every_basis_function_has_unit_norm) {
    for (std::string_view name : transform_names())
        for (const Pyramid& pyramid : {Pyramid::interleaved({150}), Pyramid::interleaved({9, 14}),
                                       Pyramid::separate({3, 5, 6}, {{0, 1}, {2}}), Pyramid(Extents{6, 7}, {{{1}, 2}})})
            for (std::size_t at = 0; at < pyramid.size(); ++at) {
                std::vector<float> values(pyramid.size());
                values[at] = 1;
                transform(name).inverse(pyramid, values);
                double squares = 0;
                for (float value : values) squares += static_cast<double>(value) * value;
                EXPECT_NEAR(squares, 1, 1e-4) << name << " " << at << " of " << pyramid.size();
            }
}

TEST(Transform, every_length_comes_back) {
    Extents lengths{41, 53, 61, 97, 127};
    for (std::size_t n = 1; n <= 40; ++n) lengths.push_back(n);
    for (std::string_view name : transform_names())
        for (std::size_t n : lengths)
            for (const Extents& shape : {Extents{n}, Extents{n, 3}, Extents{2, n, 5}}) {
                const Pyramid pyramid = Pyramid::interleaved(shape);
                const std::vector<float> original = noise(pyramid.size());
                std::vector<float> values = original;
                transform(name).forward(pyramid, values);
                transform(name).inverse(pyramid, values);
                EXPECT_LT(max_difference(values, original), 3e-5) << name << " " << n << " of " << shape.size();
            }
}

TEST(Transform, four_dimensions_come_back_interleaved_separate_and_in_part) {
    const Extents shape{6, 7, 17, 19};
    for (std::string_view name : transform_names())
        for (const Pyramid& pyramid :
             {Pyramid::interleaved(shape), Pyramid::separate(shape, {{0, 1}, {2, 3}}), Pyramid(shape, {{{2, 0}, 2}}),
              Pyramid(shape, {{{0, 1, 2, 3}, 9}}), Pyramid(shape, {})}) {
            const std::vector<float> original = noise(pyramid.size());
            std::vector<float> values = original;
            transform(name).forward(pyramid, values);
            if (pyramid.groups().empty()) {
                EXPECT_EQ(values, original);
            }
            transform(name).inverse(pyramid, values);
            // Rounding errors grow with the fourth power of the condition number of the ends, which is largest for
            // cdf42.
            EXPECT_LT(max_difference(values, original), 5e-4) << name;
        }
}

// For orthonormal transforms <forward x, forward y> = <x, y>, so the adjoint of forward() is its inverse.
TEST(Transform, haar_and_dct_keep_energy_up_to_the_ends) {
    const Extents shape{8, 16, 8, 32};
    for (const char* name : {"haar", "dct8"}) {
        const Pyramid pyramid = Pyramid::interleaved(shape);
        std::vector<float> x = noise(pyramid.size()), y(x.rbegin(), x.rend());
        double before = 0, after = 0, scale = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            before += x[i] * y[i];
            scale += x[i] * x[i];
        }
        transform(name).forward(pyramid, x);
        transform(name).forward(pyramid, y);
        for (std::size_t i = 0; i < x.size(); ++i) after += x[i] * y[i];
        EXPECT_NEAR(after, before, 1e-5 * scale) << name;
    }
}

TEST(Transform, dct_of_a_cosine_is_one_coefficient) {
    std::vector<float> line(16);
    for (std::size_t j = 0; j < 8; ++j)
        line[8 + j] = static_cast<float>(std::cos(std::acos(-1.0) * 3 * static_cast<double>(2 * j + 1) / 16));
    transform("dct8").forward(Pyramid::interleaved({16}), line);
    for (std::size_t k = 0; k < 16; ++k) EXPECT_NEAR(line[k], k == 11 ? 2 : 0, 1e-6) << k;
}

TEST(Transform, is_the_same_for_any_number_of_threads) {
    const Extents shape{40, 50, 60};
    const Pyramid pyramid = Pyramid::interleaved(shape);
    std::vector<float> many = noise(pyramid.size()), one = many;
    transform("cdf97").forward(pyramid, many);
    {
        const ThreadLimit limit(1);
        transform("cdf97").forward(pyramid, one);
    }
    EXPECT_EQ(many, one);
}

TEST(Pyramid, impossible_ones_are_refused) {
    EXPECT_THROW(Pyramid(Extents{}, {}), Error);
    EXPECT_THROW(Pyramid(Extents{3, 0}, {}), Error);
    EXPECT_THROW(Pyramid(Extents{3, 4}, {{{2}, 1}}), Error);
    EXPECT_THROW(Pyramid(Extents{3, 4}, {{{0}, 1}, {{0}, 1}}), Error);
    EXPECT_THROW(Pyramid(Extents{3, 4}, {{{0}, -1}}), Error);
    EXPECT_THROW(Pyramid(Extents{std::size_t{1} << 30, std::size_t{1} << 40}, {}), Error);
    std::vector<float> few(11);
    EXPECT_THROW(transform("haar").forward(Pyramid::interleaved({3, 4}), few), Error);
}

}  // namespace
}  // namespace hogel::wavelets
