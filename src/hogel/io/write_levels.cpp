// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/files.h"
#include "hogel/image.h"
#include "hogel/io/arrays/npy.h"
#include "hogel/io/hdf5/files.h"

namespace hogel {
namespace {

constexpr std::size_t largest_of_8_bits = 255;

// Returns the levels as numbers of another type.
template <class T>
Array<T, 3> as_numbers(View<const std::uint16_t, 3> levels) {
    Array<T, 3> numbers(levels.shape());
    std::ranges::transform(levels.elements(), numbers.data(),
                           [](std::uint16_t level) { return static_cast<T>(level); });
    return numbers;
}

// Writes [y][x], or [wavelength][y][x].
template <class T>
void write_npy_levels(const std::filesystem::path& path, View<const std::uint16_t, 3> levels, const char* type) {
    const std::size_t channels = levels.extent(2), pixels = levels.extent(0) * levels.extent(1);
    std::vector<std::size_t> shape{levels.extent(0), levels.extent(1)};
    if (channels > 1) shape.insert(shape.begin(), channels);
    const std::string start = io::arrays::npy_beginning(type, shape);
    std::vector<unsigned char> bytes(start.begin(), start.end());
    bytes.reserve(start.size() + levels.size() * sizeof(T));
    for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t i = 0; i < pixels; ++i)
            for (std::size_t byte = 0; byte < sizeof(T); ++byte)
                bytes.push_back(static_cast<unsigned char>(levels.data()[i * channels + c] >> (8 * byte)));
    core::write_file(path, bytes);
}

}  // namespace

void require_levels_name(const std::filesystem::path& path, std::size_t largest, std::size_t channels) {
    const std::string ending = path.extension().string();
    if (ending == ".npy") return;
    if (ending != ".h5") return require_raw_pixels_name(path, largest + 1);
    require_hdf5(path);
    if (channels > 1)
        throw Error(ErrorCode::usage,
                    fmt::format("'{}': slmsuite's files hold one wavelength, not {}", path.string(), channels));
}

void write_levels(const std::filesystem::path& path, View<const std::uint16_t, 3> levels, std::size_t largest,
                  const Metadata& metadata) {
    require_levels_name(path, largest, levels.extent(2));
    core::require_target(path);
    const std::string ending = path.extension().string();
    const bool is_8_bits = largest <= largest_of_8_bits;
    if (ending == ".npy")
        return is_8_bits ? write_npy_levels<std::uint8_t>(path, levels, "|u1")
                         : write_npy_levels<std::uint16_t>(path, levels, "<u2");
    if (ending == ".h5")
        return io::hdf5::write_slmsuite_file(path, {levels.data(), {levels.extent(0), levels.extent(1)}}, largest);
    if (is_8_bits)
        write_raw_pixels(path, as_numbers<std::uint8_t>(levels), metadata);
    else
        write_raw_pixels(path, levels, metadata);
}

}  // namespace hogel
