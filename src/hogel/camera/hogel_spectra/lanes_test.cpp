// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "hogel/camera/hogel_spectra/project.h"
#include "hogel/core/half.h"
#include "hogel/core/test_targets.h"
#include "hogel/stereogram/hogel_synthesis.h"

namespace hogel::camera::hogel_spectra {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(HogelLanes);

using Complex = std::complex<float>;
constexpr std::size_t both = 2 * lanes;

Array<float, 1> noise(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    Array<float, 1> values({count});
    for (float& value : values.elements()) value = normal(random);
    return values;
}

struct Size {
    std::size_t samples, per_hogel;
    double half_band;
};
// Sides of hogels that fill vectors and that do not, bands with more functions and nodes than a vector holds.
constexpr Size sizes[] = {{16, 1, 0.2}, {32, 5, 1.1}, {27, 4, 0.9}, {64, 24, 5.2}, {40, 14, 3.1}};

// Lanes with the same weights, of adjacent hogels or of looks.
struct Batch {
    explicit Batch(const Size& size)
        : basis(size.samples, size.per_hogel, size.half_band),
          columns(basis.weights(3.3)),
          rows(basis.weights(-77.2)),
          waves(noise(size.samples * size.samples * both, 5)),
          numbers({basis.functions() * basis.functions() * both}) {}

    // Returns the numbers by `sum_one` for each row and `sum_all` for all rows.
    template <class SumRow, class SumRows>
    void sum(const SumRow& sum_one, const SumRows& sum_all) {
        const std::size_t n = basis.samples(), line = basis.functions() * both;
        Array<float, 1> lines({n * line});
        for (std::size_t row = 0; row < n; ++row) sum_one(basis, columns, &waves(row * n * both), &lines(row * line));
        alignas(64) float mask[lanes];
        std::ranges::fill(mask, 1.0f);
        sum_all(basis, rows, columns.sign * rows.sign, lines.data(), mask, numbers.data());
    }

    // Returns the result of project_plain() for one lane.
    Array<float, 3> line_of(std::size_t lane) const {
        const std::size_t n = basis.samples(), across = padded(basis.nodes());
        Array<float, 1> own({stereogram::HogelWaves::size(n, n)});
        for (std::size_t y = 0; y < n; ++y)
            for (std::size_t x = 0; x < n; ++x)
                for (std::size_t part : {std::size_t{0}, lanes})
                    own((y / lanes * n + x) * both + part + y % lanes) = waves((y * n + x) * both + part + lane);
        Array<float, 3> line({basis.functions(), 2, across}, 1.0f);
        project_plain({basis, basis}, {columns, rows}, own.data(), {line.data(), across});
        return line;
    }

    float rounding(const Array<float, 3>& line) const {
        float largest = 0;
        for (const float value : line.elements()) largest = std::max(largest, std::abs(value));
        return 5e-6f * std::sqrt(static_cast<float>(basis.samples())) * (1 + largest);
    }

    SlepianBasis basis;
    SlepianBasis::Weights columns, rows;
    Array<float, 1> waves;  // [row][column][part][lane]
    Array<float, 1> numbers;
};

// The result of a lane is that of project_plain().
TEST_P(HogelLanes, are_projections_of_single_hogels) {
    for (const Size& size : sizes)
        for (const std::size_t count : {std::size_t{16}, std::size_t{5}}) {
            Batch fast(size), plain(size);
            fast.sum(sum_row, sum_rows);
            plain.sum(sum_row_plain, sum_rows_plain);
            const std::size_t functions = fast.basis.functions(), row = padded(fast.basis.nodes());
            Array<float, 4> fast_lines({lanes, functions, 2, row}, 1.0f), plain_lines(fast_lines.shape(), 1.0f);
            const auto targets = [&](Array<float, 4>& lines) {
                std::vector<LaneTarget> result;
                for (std::size_t lane = 0; lane < count; ++lane)
                    result.push_back({fast.columns.carrier, {&lines(lane, 0, 0, 0), row}});
                return result;
            };
            add_lanes(fast.basis, fast.numbers.data(), targets(fast_lines));
            add_lanes_plain(plain.basis, plain.numbers.data(), targets(plain_lines));
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                Array<float, 3> single({functions, 2, row}, 1.0f);
                if (lane < count) single = fast.line_of(lane);
                for (std::size_t i = 0; i < single.size(); ++i) {
                    ASSERT_NEAR(fast_lines[lane].data()[i], single.data()[i], fast.rounding(single)) << lane;
                    ASSERT_NEAR(plain_lines[lane].data()[i], single.data()[i], fast.rounding(single)) << lane;
                }
            }
        }
}

// The same for interleaved looks.
TEST_P(HogelLanes, are_projections_of_looks_side_by_side) {
    for (const Size& size : sizes) {
        Batch batch(size);
        batch.sum(sum_row, sum_rows);
        const std::size_t functions = batch.basis.functions(), nodes = batch.basis.nodes();
        Array<float, 4> fast({functions, 2, nodes, lanes}, 1.0f), plain(fast.shape(), 1.0f);
        add_looks(batch.basis, batch.numbers.data(), batch.columns.carrier, {fast.data(), nodes * lanes});
        add_looks_plain(batch.basis, batch.numbers.data(), batch.columns.carrier, {plain.data(), nodes * lanes});
        for (std::size_t look = 0; look < lanes; ++look) {
            const Array<float, 3> single = batch.line_of(look);
            for (std::size_t l = 0; l < functions; ++l)
                for (std::size_t part = 0; part < 2; ++part)
                    for (std::size_t x = 0; x < nodes; ++x) {
                        ASSERT_NEAR(fast(l, part, x, look), single(l, part, x), batch.rounding(single)) << look;
                        ASSERT_NEAR(plain(l, part, x, look), single(l, part, x), batch.rounding(single)) << look;
                    }
        }
    }
}

TEST_P(HogelLanes, of_binary16_are_those_of_its_values) {
    for (const std::size_t n : {32, 27}) {
        const SlepianBasis basis(n, 4, 1.2);
        const Array<float, 1> values = noise(n * both, 4);
        std::vector<std::uint16_t, CacheLineAllocator<std::uint16_t>> halves(n * both);
        Array<float, 1> rounded({n * both});
        for (std::size_t i = 0; i < halves.size(); ++i) {
            halves[i] = core::half_of(values(i));
            rounded(i) = core::float_of(halves[i]);
        }
        const std::size_t line = basis.functions() * both;
        Array<float, 1> expected({line}), fast({line}), plain({line});
        const SlepianBasis::Weights columns = basis.weights(3.4);
        sum_row(basis, columns, rounded.data(), expected.data());
        sum_row_of_halves(basis, columns, halves.data(), {halves.data(), 3}, fast.data());
        sum_row_of_halves_plain(basis, columns, halves.data(), plain.data());
        for (std::size_t i = 0; i < line; ++i) {
            ASSERT_EQ(fast(i), expected(i)) << i;
            ASSERT_NEAR(plain(i), expected(i), 3e-5) << i;
        }
    }
}

// Rows of omitted pairs count as zero.
TEST_P(HogelLanes, need_no_dark_rows) {
    const SlepianBasis basis(32, 4, 1.2);
    const std::size_t line = basis.functions() * both;
    const Array<float, 1> lines = noise(32 * line, 3);
    Array<float, 1> dark = lines;
    SlepianBasis::Weights rows = basis.weights(0.5);
    std::vector<SlepianBasis::SymmetricPair> pairs(rows.pairs.begin(), rows.pairs.end());
    for (const std::size_t left_out : {std::size_t{3}, std::size_t{5}}) {
        std::fill_n(&dark(pairs[left_out].first * line), line, 0.0f);
        std::fill_n(&dark(pairs[left_out].second * line), line, 0.0f);
    }
    pairs.erase(pairs.begin() + 5);
    pairs.erase(pairs.begin() + 3);
    const SlepianBasis::Weights all = rows;
    rows.pairs = pairs;
    alignas(64) float mask[lanes];
    std::ranges::fill(mask, 1.0f);
    Array<float, 1> expected({basis.functions() * line}), fast(expected.shape()), plain(expected.shape());
    sum_rows_plain(basis, all, 1, dark.data(), mask, expected.data());
    sum_rows(basis, rows, 1, lines.data(), mask, fast.data());
    sum_rows_plain(basis, rows, 1, lines.data(), mask, plain.data());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_NEAR(fast(i), expected(i), 1e-4) << i;
        ASSERT_NEAR(plain(i), expected(i), 1e-4) << i;
    }
}

// Only the lanes of the mask are stored.
TEST_P(HogelLanes, that_are_not_chosen_stay) {
    const SlepianBasis basis(32, 4, 1.2);
    const std::size_t line = basis.functions() * both;
    const Array<float, 1> lines = noise(32 * line, 3);
    Array<float, 1> numbers({basis.functions() * line});
    std::ranges::fill(numbers.elements(), 7.0f);
    alignas(64) float mask[lanes] = {0, 1, 1, 0, 0, 1};
    sum_rows(basis, basis.weights(0.5), 1, lines.data(), mask, numbers.data());
    for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers(i) == 7.0f, mask[i % lanes] == 0) << i;
}

// The waves of lanes are those of single hogels with phases from the middle.
TEST_P(HogelLanes, have_the_random_phases_of_single_hogels) {
    for (const std::size_t n : {16, 32, 64, 128}) {
        ASSERT_TRUE(stereogram::middle_is_a_byte(n));
        Array<float, 1> moduli = noise(n * n * lanes, 8);  // [row][column][lane]
        stereogram::SeriesOfLanes series{{3, 4}, {}};
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            series.position[0][lane] = 4 * lane + 1;
            series.position[1][lane] = 7 + lane % 3;
            series.position[2][lane] = 1000 - lane;
        }
        const MiddlePhases middle(n, n);
        for (const bool shared : {false, true}) {
            Array<float, 1> fast({n * n * both}), plain({n * both});
            for (std::size_t row = 0; row < n; ++row) {
                // Columns of one hogel lie sixteen rows apart.
                const float* own = moduli.data() + row * n * lanes;
                stereogram::random_row(series, row, shared, own, n, &fast(row * n * both));
                stereogram::random_row_plain(series, row, shared, own, n, plain.data());
                for (std::size_t i = 0; i < plain.size(); ++i)
                    ASSERT_NEAR(fast(row * n * both + i), plain(i),
                                1e-6 * std::abs(moduli(row * n * lanes + i / 32)) + 4e-6)
                        << n;
            }
            for (const std::size_t lane : {0, 9, 15}) {
                Array<float, 1> waves({stereogram::HogelWaves::size(n, n)}), of_lane({n * n});
                for (std::size_t y = 0; y < n; ++y)
                    for (std::size_t x = 0; x < n; ++x)
                        of_lane((y / 16 * n + x) * 16 + y % 16) = moduli((y * n + x) * lanes + (shared ? 0 : lane));
                const stereogram::PhaseSeries one = series_of_lane(series, lane);
                for (std::size_t row = 0; row < n; row += 16)
                    random_waves_plain(one, row, &of_lane(row * n), n, &waves(2 * row * n));
                middle.apply_plain(waves.data());
                for (std::size_t y = 0; y < n; ++y)
                    for (std::size_t x = 0; x < n; ++x)
                        for (std::size_t part : {std::size_t{0}, lanes})
                            ASSERT_NEAR(fast((y * n + x) * both + part + lane),
                                        waves((y / 16 * n + x) * both + part + y % 16), 1e-5)
                                << n << " " << lane << " " << y << " " << x;
            }
        }
    }
}

// The same for sides that are no powers of two.
TEST_P(HogelLanes, have_the_random_phases_of_single_hogels_of_any_side) {
    for (const std::size_t n : {17, 32, 50, 107}) {
        const std::vector<float> phases = stereogram::middle_phases(n);
        const Array<float, 1> moduli = noise(n * n * lanes, 9);  // [row][column][lane]
        stereogram::SeriesOfLanes series{{5, 6}, {}};
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            series.position[0][lane] = 2;
            series.position[1][lane] = 70 + lane;
            series.position[2][lane] = 1000 - lane;
        }
        const MiddlePhases middle(n, n);
        for (const bool shared : {false, true}) {
            Array<float, 1> fast({n * n * both}), plain({n * both});
            for (std::size_t row = 0; row < n; ++row) {
                const float* own = moduli.data() + row * n * lanes;
                stereogram::random_row_of_any_side(series, row, shared, own, lanes, phases, n, &fast(row * n * both));
                stereogram::random_row_of_any_side_plain(series, row, shared, own, lanes, phases, n, plain.data());
                for (std::size_t i = 0; i < plain.size(); ++i)
                    ASSERT_NEAR(fast(row * n * both + i), plain(i),
                                1e-6 * std::abs(moduli(row * n * lanes + i / 32)) + 4e-6)
                        << n;
            }
            for (const std::size_t lane : {0, 15}) {
                std::vector<float> of_lane(n * n);
                for (std::size_t i = 0; i < n * n; ++i) of_lane[i] = moduli(i * lanes + (shared ? 0 : lane));
                const stereogram::PhaseSeries one = series_of_lane(series, lane);
                Array<std::complex<float>, 2> values({n, n});
                spread_random_phases(one, of_lane, values.elements());
                Array<float, 1> waves({stereogram::HogelWaves::size(n, n)});
                stereogram::store_waves(values, {}, waves.data());
                middle.apply_plain(waves.data());
                for (std::size_t y = 0; y < n; ++y)
                    for (std::size_t x = 0; x < n; ++x)
                        for (std::size_t part : {std::size_t{0}, lanes})
                            ASSERT_NEAR(fast((y * n + x) * both + part + lane),
                                        waves((y / 16 * n + x) * both + part + y % 16), 1e-5)
                                << n << " " << lane << " " << y << " " << x;
            }
        }
    }
}

}  // namespace
}  // namespace hogel::camera::hogel_spectra
