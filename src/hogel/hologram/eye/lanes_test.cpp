// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram/eye/lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "hogel/core/half.h"
#include "hogel/core/test_targets.h"
#include "hogel/hologram/eye/node_phases.h"
#include "hogel/hologram/hogel_synthesis.h"

namespace hogel::hologram::eye {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(EyeLanes);

using Complex = std::complex<float>;
constexpr std::size_t both = 2 * lanes;

Array<float, 1> noise(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    Array<float, 1> values({count});
    for (float& value : values.elements()) value = normal(random);
    return values;
}

// Phases of unit length for a lane.
Array<float, 1> phases_of(const HogelBasis& basis, unsigned seed) {
    const std::size_t nodes = basis.nodes(), row = phase_row(nodes);
    const Array<float, 1> angles = noise(nodes * nodes, seed);
    Array<float, 1> phases({nodes * 2 * row});
    for (std::size_t y = 0; y < nodes; ++y)
        for (std::size_t x = 0; x < nodes; ++x) {
            float* to = &phases(2 * y * row + 2 * x);
            const float angle = angles(y * nodes + x);
            to[0] = to[1] = std::cos(angle);
            to[row] = -std::sin(angle);
            to[row + 1] = std::sin(angle);
        }
    return phases;
}

struct Size {
    std::size_t samples, per_hogel;
    double half_band;
};
// Sides of hogels with and without a rest, bands with more functions and nodes than a vector holds.
constexpr Size sizes[] = {{16, 1, 0.2}, {32, 5, 1.1}, {27, 4, 0.9}, {64, 24, 5.2}, {40, 14, 3.1}};

struct Batch {
    explicit Batch(const Size& size)
        : basis(size.samples, size.per_hogel, size.half_band), waves(noise(size.samples * size.samples * both, 5)) {
        const std::size_t width = basis.nodes() + 3;
        for (unsigned lane = 0; lane < lanes; ++lane) {
            phases.push_back(phases_of(basis, lane));
            bands.emplace_back(Shape<2>{basis.nodes(), width}, Complex(1));
        }
    }

    std::vector<LaneTarget> targets(std::size_t count) {
        std::vector<LaneTarget> result;
        for (std::size_t lane = 0; lane < count; ++lane)
            result.push_back({phases[lane].data(), {bands[lane].data(), bands[lane].extent(1)}});
        return result;
    }

    HogelBasis basis;
    Array<float, 1> waves;  // [row][column][part][lane]
    std::vector<Array<float, 1>> phases;
    std::vector<Array<Complex, 2>> bands;
};

// The projection of a batch by `sum_row`, `sum_rows` and `add`.
template <class SumRow, class SumRows, class Add>
void project_batch(Batch& batch, double columns, double rows, std::size_t count, const SumRow& sum_one,
                   const SumRows& sum_all, const Add& add) {
    const HogelBasis& basis = batch.basis;
    const std::size_t n = basis.samples(), line = basis.functions() * both;
    const HogelBasis::Weights across = basis.weights(columns), down = basis.weights(rows);
    Array<float, 1> lines({n * line}), numbers({basis.functions() * line});
    for (std::size_t row = 0; row < n; ++row) sum_one(basis, across, &batch.waves(row * n * both), &lines(row * line));
    const std::vector<float> all(lanes, 1.0f);
    alignas(64) float chosen[lanes];
    std::ranges::copy(all, chosen);
    sum_all(basis, down, across.sign * down.sign, lines.data(), chosen, numbers.data());
    add(basis, numbers.data(), batch.targets(count));
}

// A lane is what project_plain() makes of its waves.
TEST_P(EyeLanes, are_projections_of_single_hogels) {
    for (const Size& size : sizes)
        for (const std::size_t count : {std::size_t{16}, std::size_t{5}}) {
            Batch fast(size), plain(size);
            project_batch(fast, 3.3, -77.2, count, sum_row, sum_rows, add_lanes);
            project_batch(plain, 3.3, -77.2, count, sum_row_plain, sum_rows_plain, add_lanes_plain);
            const HogelBasis& basis = fast.basis;
            const std::size_t n = size.samples, nodes = basis.nodes(), row = phase_row(nodes);
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                Array<Complex, 2> single(fast.bands[lane].shape(), Complex(1));
                if (lane < count) {
                    Array<float, 1> waves({HogelWaves::size(n, n)});
                    for (std::size_t y = 0; y < n; ++y)
                        for (std::size_t x = 0; x < n; ++x)
                            for (std::size_t part : {std::size_t{0}, lanes})
                                waves((y / lanes * n + x) * both + part + y % lanes) =
                                    fast.waves((y * n + x) * both + part + lane);
                    const HogelView view{
                        basis.weights(3.3), basis.weights(-77.2), {fast.phases[lane].data(), {nodes, 2, row}}};
                    project_plain({basis, basis}, view, waves.data(), {single.data(), single.extent(1)});
                }
                float added = 0;
                for (const Complex& value : single.elements()) added = std::max(added, std::abs(value - Complex(1)));
                EXPECT_EQ(added > 0.1f, lane < count) << added;
                const float rounding = 5e-6f * std::sqrt(static_cast<float>(n)) * (1 + added);
                for (std::size_t i = 0; i < single.size(); ++i) {
                    ASSERT_LT(std::abs(fast.bands[lane].data()[i] - single.data()[i]), rounding) << n << " " << lane;
                    ASSERT_LT(std::abs(plain.bands[lane].data()[i] - single.data()[i]), rounding) << n << " " << lane;
                }
            }
        }
}

TEST_P(EyeLanes, of_binary16_are_those_of_its_values) {
    for (const std::size_t n : {32, 27}) {
        const HogelBasis basis(n, 4, 1.2);
        const Array<float, 1> values = noise(n * both, 4);
        std::vector<std::uint16_t, CacheLineAllocator<std::uint16_t>> halves(n * both);
        Array<float, 1> rounded({n * both});
        for (std::size_t i = 0; i < halves.size(); ++i) {
            halves[i] = core::half_of(values(i));
            rounded(i) = core::float_of(halves[i]);
        }
        const std::size_t line = basis.functions() * both;
        Array<float, 1> expected({line}), fast({line}), plain({line});
        const HogelBasis::Weights columns = basis.weights(3.4);
        sum_row(basis, columns, rounded.data(), expected.data());
        sum_row_of_halves(basis, columns, halves.data(), {halves.data(), 3}, fast.data());
        sum_row_of_halves_plain(basis, columns, halves.data(), plain.data());
        for (std::size_t i = 0; i < line; ++i) {
            ASSERT_EQ(fast(i), expected(i)) << i;
            ASSERT_NEAR(plain(i), expected(i), 3e-5) << i;
        }
    }
}

// Rows whose pairs are left out count as zero.
TEST_P(EyeLanes, need_no_dark_rows) {
    const HogelBasis basis(32, 4, 1.2);
    const std::size_t line = basis.functions() * both;
    const Array<float, 1> lines = noise(32 * line, 3);
    Array<float, 1> dark = lines;
    HogelBasis::Weights rows = basis.weights(0.5);
    std::vector<HogelBasis::WavePair> pairs(rows.pairs.begin(), rows.pairs.end());
    for (const std::size_t left_out : {std::size_t{3}, std::size_t{5}}) {
        std::fill_n(&dark(pairs[left_out].one * line), line, 0.0f);
        std::fill_n(&dark(pairs[left_out].other * line), line, 0.0f);
    }
    pairs.erase(pairs.begin() + 5);
    pairs.erase(pairs.begin() + 3);
    const HogelBasis::Weights all = rows;
    rows.pairs = pairs;
    alignas(64) float chosen[lanes];
    std::ranges::fill(chosen, 1.0f);
    Array<float, 1> expected({basis.functions() * line}), fast(expected.shape()), plain(expected.shape());
    sum_rows_plain(basis, all, 1, dark.data(), chosen, expected.data());
    sum_rows(basis, rows, 1, lines.data(), chosen, fast.data());
    sum_rows_plain(basis, rows, 1, lines.data(), chosen, plain.data());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_NEAR(fast(i), expected(i), 1e-4) << i;
        ASSERT_NEAR(plain(i), expected(i), 1e-4) << i;
    }
}

// Only the lanes that are chosen are stored.
TEST_P(EyeLanes, that_are_not_chosen_stay) {
    const HogelBasis basis(32, 4, 1.2);
    const std::size_t line = basis.functions() * both;
    const Array<float, 1> lines = noise(32 * line, 3);
    Array<float, 1> numbers({basis.functions() * line});
    std::ranges::fill(numbers.elements(), 7.0f);
    alignas(64) float chosen[lanes] = {0, 1, 1, 0, 0, 1};
    sum_rows(basis, basis.weights(0.5), 1, lines.data(), chosen, numbers.data());
    for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers(i) == 7.0f, chosen[i % lanes] == 0) << i;
}

TEST_P(EyeLanes, have_the_phases_of_the_exact_path) {
    for (const std::size_t count : {3, 13, 16, 21}) {
        std::vector<double> places;
        for (std::size_t i = 0; i < count; ++i) places.push_back((double(i) - 6) / 4);
        const NodeLine across{0.012, 50e-6, 0.09, 1 / 532e-9, 3.5, 564333.25},
            down{-0.007, -50e-6, 0.0902, 1 / 532e-9, -2, 0};
        const std::size_t row = phase_row(count);
        Array<float, 1> fast({2 * count * row}), plain({2 * count * row});
        node_phases(across, down, -2e-4, places, fast.data());
        node_phases_plain(across, down, -2e-4, places, plain.data());
        for (std::size_t y = 0; y < 2 * count; ++y)
            for (std::size_t x = 0; x < 2 * count; ++x)
                ASSERT_NEAR(fast(y * row + x), plain(y * row + x), 2e-5) << count << " " << y << " " << x;
    }
}

// The waves of lanes are those of single hogels with phases from the middle.
TEST_P(EyeLanes, have_the_random_phases_of_single_hogels) {
    for (const std::size_t n : {16, 32, 64, 128}) {
        ASSERT_TRUE(middle_is_a_byte(n));
        Array<float, 1> moduli = noise(n * n * lanes, 8);  // [row][column][lane]
        SeriesOfLanes series{{3, 4}, {}};
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
                random_row(series, row, shared, own, n, &fast(row * n * both));
                random_row_plain(series, row, shared, own, n, plain.data());
                for (std::size_t i = 0; i < plain.size(); ++i)
                    ASSERT_NEAR(fast(row * n * both + i), plain(i),
                                1e-6 * std::abs(moduli(row * n * lanes + i / 32)) + 4e-6)
                        << n;
            }
            for (const std::size_t lane : {0, 9, 15}) {
                Array<float, 1> waves({HogelWaves::size(n, n)}), of_lane({n * n});
                for (std::size_t y = 0; y < n; ++y)
                    for (std::size_t x = 0; x < n; ++x)
                        of_lane((y / 16 * n + x) * 16 + y % 16) = moduli((y * n + x) * lanes + (shared ? 0 : lane));
                const PhaseSeries one = series_of_lane(series, lane);
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
TEST_P(EyeLanes, have_the_random_phases_of_single_hogels_of_any_side) {
    for (const std::size_t n : {17, 32, 50, 107}) {
        const std::vector<float> phases = middle_phases(n);
        const Array<float, 1> moduli = noise(n * n * lanes, 9);  // [row][column][lane]
        SeriesOfLanes series{{5, 6}, {}};
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
                random_row_of_any_side(series, row, shared, own, lanes, phases, n, &fast(row * n * both));
                random_row_of_any_side_plain(series, row, shared, own, lanes, phases, n, plain.data());
                for (std::size_t i = 0; i < plain.size(); ++i)
                    ASSERT_NEAR(fast(row * n * both + i), plain(i),
                                1e-6 * std::abs(moduli(row * n * lanes + i / 32)) + 4e-6)
                        << n;
            }
            for (const std::size_t lane : {0, 15}) {
                std::vector<float> of_lane(n * n);
                for (std::size_t i = 0; i < n * n; ++i) of_lane[i] = moduli(i * lanes + (shared ? 0 : lane));
                const PhaseSeries one = series_of_lane(series, lane);
                Array<std::complex<float>, 2> values({n, n});
                spread_random_phases(one, of_lane, values.elements());
                Array<float, 1> waves({HogelWaves::size(n, n)});
                store_waves(values, {}, waves.data());
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
}  // namespace hogel::hologram::eye
