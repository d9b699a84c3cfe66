// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

namespace hogel::fuzz {

/// Bob Jenkins's hash lookup3 with initial value 0: the checksum of HDF5's metadata (HDF5 file format specification
/// 3.0, "checksum").
inline std::uint32_t hdf5_checksum(std::span<const std::uint8_t> bytes) {
    const auto rotate = [](std::uint32_t x, int k) { return x << k | x >> (32 - k); };
    std::uint32_t a = 0xdeadbeef + static_cast<std::uint32_t>(bytes.size()), b = a, c = a;
    const auto add = [&](std::span<const std::uint8_t> part) {
        std::array<std::uint32_t, 3> words{};
        for (std::size_t i = 0; i < part.size(); ++i) words[i / 4] += std::uint32_t{part[i]} << 8 * (i % 4);
        a += words[0];
        b += words[1];
        c += words[2];
    };
    for (; bytes.size() > 12; bytes = bytes.subspan(12)) {
        add(bytes.first(12));
        a = (a - c) ^ rotate(c, 4), c += b;
        b = (b - a) ^ rotate(a, 6), a += c;
        c = (c - b) ^ rotate(b, 8), b += a;
        a = (a - c) ^ rotate(c, 16), c += b;
        b = (b - a) ^ rotate(a, 19), a += c;
        c = (c - b) ^ rotate(b, 4), b += a;
    }
    if (bytes.empty()) return c;
    add(bytes);
    c = (c ^ b) - rotate(b, 14), a = (a ^ c) - rotate(c, 11), b = (b ^ a) - rotate(a, 25);
    c = (c ^ b) - rotate(b, 16), a = (a ^ c) - rotate(c, 4), b = (b ^ a) - rotate(a, 14);
    return (c ^ b) - rotate(b, 24);
}

/// The blocks of an HDF5 file that end in a checksum of their bytes, so that it can be put right after a change.
class Hdf5Checksums {
  public:
    explicit Hdf5Checksums(std::span<const std::uint8_t> file) {
        add(file, 0);
        constexpr std::array<std::string_view, 14> signatures{"OHDR", "OCHK", "FRHP", "FHDB", "FHIB", "BTHD", "BTLF",
                                                              "BTIN", "FAHD", "FADB", "EAHD", "EAIB", "EADB", "EASB"};
        for (std::size_t at = 0; at + 4 <= file.size(); ++at)
            if (std::ranges::find(signatures, std::string_view(reinterpret_cast<const char*>(&file[at]), 4)) !=
                signatures.end())
                add(file, at);
    }

    /// Writes the right checksums into a file with the same blocks.
    void repair(std::span<std::uint8_t> file) const {
        for (const Block& block : blocks_) {
            if (block.begin + block.size + 4 > file.size()) continue;
            const std::uint32_t sum = hdf5_checksum(file.subspan(block.begin, block.size));
            std::memcpy(&file[block.begin + block.size], &sum, 4);
        }
    }
    std::size_t blocks() const { return blocks_.size(); }

  private:
    struct Block {
        std::size_t begin, size;
    };
    // The length of most blocks depends on what they hold: the first is taken after which the checksum stands.
    void add(std::span<const std::uint8_t> file, std::size_t at) {
        constexpr std::size_t max_size = 4096;
        for (std::size_t size = 8; size < max_size && at + size + 4 <= file.size(); ++size) {
            std::uint32_t stored = 0;
            std::memcpy(&stored, &file[at + size], 4);
            if (hdf5_checksum(file.subspan(at, size)) != stored) continue;
            blocks_.push_back({at, size});
            return;
        }
    }

    std::vector<Block> blocks_;
};

}  // namespace hogel::fuzz
