// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/pipeline.h"
#include "hogel/work/parallel.h"

namespace hogel {
namespace {

// Sums over samples of a signal f and its approximation f'.
struct Difference {
    double count = 0, signal = 0, error = 0;  // N, Σ|f|², Σ|f − f'|²
    double peak = 0, max_error = 0;           // max |f|, max |f − f'|

    void add(double magnitude, double difference) {
        count += 1;
        signal += magnitude * magnitude;
        error += difference * difference;
        peak = std::max(peak, magnitude);
        max_error = std::max(max_error, difference);
    }
    void add(const Difference& other) {
        count += other.count;
        signal += other.signal;
        error += other.error;
        peak = std::max(peak, other.peak);
        max_error = std::max(max_error, other.max_error);
    }
    double sqnr() const { return decibels(signal); }
    double psnr() const { return decibels(peak * peak * count); }

  private:
    double decibels(double power) const {
        if (error == 0) return std::numeric_limits<double>::infinity();
        return 10 * std::log10(power / error);
    }
};

// Divides a range of hogels or samples into blocks of at most `width` × `height`.
struct Blocks {
    std::size_t columns, rows, width, height;

    std::size_t across() const { return (columns + width - 1) / width; }
    std::size_t count() const { return across() * ((rows + height - 1) / height); }
    Region operator[](std::size_t i) const {
        const std::size_t x = i % across() * width, y = i / across() * height;
        return {x, y, std::min(width, columns - x), std::min(height, rows - y)};
    }
};

Difference sum_blocks(const Blocks& blocks, const Progress& progress,
                      const std::function<Difference(const Region&)>& compare_block) {
    Difference sum;
    work::local_ordered_reduce<Difference>(
        blocks.count(), work::default_in_flight(), [&](std::size_t i) { return compare_block(blocks[i]); },
        [&](std::size_t i, Difference& block) {
            sum.add(block);
            progress.report(static_cast<double>(i + 1) / static_cast<double>(blocks.count()));
        });
    return sum;
}

Difference compare_faces(const LightFieldSource& a, const LightFieldSource& b, const Progress& progress) {
    const LightFieldGrid& grid = a.grid();
    const HogelRange tile = default_tile(grid);
    return sum_blocks({grid.hogels_s, grid.hogels_t, tile.ns, tile.nt}, progress, [&](const Region& block) {
        const HogelRange range{block.x0, block.y0, block.width, block.height};
        LightFieldTile tile_a(grid, range, false), tile_b(grid, range, false);
        a.read(tile_a);
        b.read(tile_b);
        Difference difference;
        for (std::size_t i = 0; i < tile_a.radiance.size(); ++i) {
            const double f = tile_a.radiance.data()[i], g = tile_b.radiance.data()[i];
            difference.add(std::abs(f), std::abs(f - g));
        }
        return difference;
    });
}

Difference compare_fields(const FieldSource& a, const FieldSource& b, const Progress& progress) {
    const std::size_t aligned = std::max<std::size_t>(1, 512 / a.alignment()) * a.alignment();
    const Grid& plane = a.grid().plane;
    return sum_blocks({plane.width, plane.height, aligned, aligned}, progress, [&](const Region& block) {
        Array<std::complex<float>, 2> f({block.height, block.width}), g({block.height, block.width});
        a.read(block, 0, f);
        b.read(block, 0, g);
        Difference difference;
        for (std::size_t k = 0; k < f.size(); ++k)
            difference.add(std::abs(f.data()[k]), std::abs(f.data()[k] - g.data()[k]));
        return difference;
    });
}

// std::max() ignores NaN; a sum does not.
SampleComparison result_of(const Difference& sum) {
    return {sum.sqnr(), sum.psnr(), std::isnan(sum.error) ? sum.error : sum.max_error};
}

// Returns whether fields have the same sampling, except for the rounding of lengths in texts and options.
bool are_alike(const FieldGrid& a, const FieldGrid& b) {
    const Grid &p = a.plane, &q = b.plane;
    const auto is_near = [](double x, double y, double unit) { return std::abs(x - y) <= 1e-9 * unit; };
    return p.width == q.width && p.height == q.height && is_near(p.pitch_x, q.pitch_x, p.pitch_x) &&
           is_near(p.pitch_y, q.pitch_y, p.pitch_y) && is_near(p.center_x, q.center_x, p.pitch_x) &&
           is_near(p.center_y, q.center_y, p.pitch_y) && is_near(a.wavelength, b.wavelength, a.wavelength);
}

[[noreturn]] void sampled_differently(const char* what) {
    throw Error(ErrorCode::bad_input, std::string("the two ") + what + " are sampled differently");
}

}  // namespace

SampleComparison compare(const LightField& a, const LightField& b, const Progress& progress) {
    const core::StopScope scope(progress);
    if (a.grids() != b.grids()) sampled_differently("light fields");
    Difference sum;
    for (std::size_t i = 0; i < a.faces().size(); ++i)
        sum.add(compare_faces(*a.faces()[i], *b.faces()[i], progress.part(i, a.faces().size())));
    return result_of(sum);
}

SampleComparison compare(const Fields& a, const Fields& b, const Progress& progress) {
    const core::StopScope scope(progress);
    const auto grid = [](const std::shared_ptr<const FieldSource>& field) { return field->grid(); };
    if (!std::ranges::equal(a, b, are_alike, grid, grid)) sampled_differently("holograms");
    Difference sum;
    for (std::size_t i = 0; i < a.size(); ++i) sum.add(compare_fields(*a[i], *b[i], progress.part(i, a.size())));
    return result_of(sum);
}

}  // namespace hogel
