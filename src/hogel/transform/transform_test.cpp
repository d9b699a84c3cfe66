#include "hogel/transform/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hogel/core/error.h"
#include "hogel/core/parallel.h"
#include "hogel/transform/dct.h"
#include "hogel/transform/line.h"

namespace hogel {
namespace {

using Extents = std::vector<std::size_t>;

std::vector<float> noise(std::size_t count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<float> values(count);
    for (float& value : values) value = uniform(random);
    return values;
}

double largest_difference(std::span<const float> a, std::span<const float> b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max<double>(most, std::abs(a[i] - b[i]));
    return most;
}

// All levels of one line by the plain twin.
void forward_plain(const Transform& chosen, int levels, std::span<double> line) {
    if (!chosen.is_wavelet()) {
        const std::vector<double> in(line.begin(), line.end());
        for (std::size_t at = 0; at < line.size(); ++at) {
            const std::size_t first = at / 8 * 8, n = std::min<std::size_t>(8, line.size() - first);
            line[at] = 0;
            for (std::size_t j = 0; j < n; ++j) line[at] += dct_element(n, at - first, j) * in[first + j];
        }
        return;
    }
    std::size_t coarse = line.size();
    for (int level = 1; level <= levels; ++level) {
        forward_line_plain(chosen.wavelet(), level, line.first(coarse));
        coarse = (coarse + 1) / 2;
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

// Separately over the dimensions a transform of a product is the product of the transforms, to its last level.
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
        EXPECT_LT(largest_difference(values, product()), 1e-3) << name;
    }
}

// Interleaved by hand in 2D: rows and columns level by level, in what is still coarse.
TEST(Transform, interleaves_levels_in_the_coarse_corner) {
    const std::size_t rows = 13, columns = 22;
    const Transform chosen = transform("ai33");
    const Pyramid pyramid(Extents{rows, columns}, {{{0, 1}, 3}});
    std::vector<float> values = noise(rows * columns);
    std::vector<double> plain(values.begin(), values.end());
    for (int level = 1; level <= 3; ++level) {
        const std::size_t r = pyramid.coarse_extent(0, level - 1), c = pyramid.coarse_extent(1, level - 1);
        for (std::size_t x = 0; x < c; ++x) {
            std::vector<double> line;
            for (std::size_t y = 0; y < r; ++y) line.push_back(plain[y * columns + x]);
            forward_line_plain(chosen.wavelet(), level, line);
            for (std::size_t y = 0; y < r; ++y) plain[y * columns + x] = line[y];
        }
        for (std::size_t y = 0; y < r; ++y)
            forward_line_plain(chosen.wavelet(), level, std::span(plain).subspan(y * columns, c));
    }
    chosen.forward(pyramid, values);
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], plain[i], 1e-5) << i;
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
                EXPECT_LT(largest_difference(values, original), 3e-5) << name << " " << n << " of " << shape.size();
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
            // Rounding grows with the condition number of the ends, to the fourth power: cdf42 is the worst.
            EXPECT_LT(largest_difference(values, original), 5e-4) << name;
        }
}

// <forward x, forward y> = <x, y> where everything is orthonormal, and forward's adjoint is then its inverse.
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
}  // namespace hogel
