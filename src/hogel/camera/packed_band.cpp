// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/packed_band.h"

#include <algorithm>

#include "hogel/work/parallel.h"

namespace hogel::camera {
namespace {

constexpr std::size_t clear_chunk = std::size_t{1} << 18;

}  // namespace

std::vector<PackedBand> PackedBand::dark(std::size_t count, std::size_t height, std::size_t width) {
    const std::size_t band_size = padded_size(height, width), total = count * band_size;
    const std::shared_ptr<math::PackedComplex> memory(
        static_cast<math::PackedComplex*>(allocate_lines(total * sizeof(math::PackedComplex))), free_lines);
    work::parallel_for((total + clear_chunk - 1) / clear_chunk, [&](std::size_t i) {
        const std::size_t first = i * clear_chunk;
        std::fill_n(memory.get() + first, std::min(clear_chunk, total - first), math::PackedComplex());
    });
    std::vector<PackedBand> bands(count);
    for (std::size_t i = 0; i < count; ++i) {
        bands[i].height_ = height;
        bands[i].width_ = width;
        bands[i].storage_ = memory;
        bands[i].squares_ = memory.get() + i * band_size;
    }
    return bands;
}

PackedBand::PackedBand(View<const std::complex<float>, 2> band) : PackedBand(band.extent(0), band.extent(1)) {
    for (std::size_t row = 0; row < height_; ++row)
        for (std::size_t column = 0; column < width_; column += side)
            math::pack(&band(row, column), at(row, column), std::min(side, width_ - column));
}

bool PackedBand::is_active(std::size_t row) const {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < count_squares(width_) && bits == 0; ++i)
        for (const math::PackedComplex* number = at(row, i * side); number < at(row, i * side) + side; ++number)
            bits |= number->bits;
    return bits != 0;
}

}  // namespace hogel::camera
