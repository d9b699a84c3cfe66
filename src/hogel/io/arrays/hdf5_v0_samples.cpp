// SPDX-License-Identifier: Apache-2.0
// The samples of datasets of HDF5 files with superblock version 0 or 1: chunks in a tree (HDF5 file format
// specification III.A.1), with their filters (IV.A.2.l) inverted.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "hogel/io/arrays/hdf5_v0.h"
#include "hogel/io/arrays/inflate.h"

namespace hogel::io::arrays {
namespace {

using Bytes = std::vector<unsigned char>;

// Deflate expands by at most 1032.

Bytes inflated(const Hdf5V0& file, const Bytes& packed, std::size_t bytes) {
    Bytes plain(bytes);
    if (!inflate(file.path(), packed, plain, Extent::all)) file.fail("a compressed piece is damaged");
    return plain;
}

// Inverts the filter shuffle, which stores the first bytes of all numbers, then all second bytes, and so on.
Bytes unshuffled(const Bytes& shuffled, std::size_t element) {
    const std::size_t count = shuffled.size() / element;
    Bytes plain = shuffled;
    for (std::size_t b = 0; b < element; ++b)
        for (std::size_t i = 0; i < count; ++i) plain[i * element + b] = shuffled[b * count + i];
    return plain;
}

// Whether `stored` is Fletcher's checksum of the bytes as big-endian 16-bit words. A half of the checksum that is zero
// modulo 65535 may be stored as 0 or as 65535.
bool is_fletcher(std::uint32_t stored, std::span<const unsigned char> bytes) {
    std::uint32_t low = 0, high = 0;
    for (std::size_t i = 0; i < bytes.size(); i += 2) {
        const std::uint32_t word = std::uint32_t{bytes[i]} << 8 | (i + 1 < bytes.size() ? bytes[i + 1] : 0u);
        low = (low + word) % 65535;
        high = (high + low) % 65535;
    }
    return (stored & 0xffff) % 65535 == low && (stored >> 16) % 65535 == high;
}

// Reads all chunks of a dataset into one array.
class Chunks {
  public:
    Chunks(const Hdf5V0& file, const Hdf5V0Dataset& dataset) : file_(file), dataset_(dataset) {
        chunk_bytes_ = dataset.element_bytes;
        for (std::size_t axis = 0; axis < dataset.shape.size(); ++axis) {
            const std::uint64_t extent = dataset.chunk[axis];
            if (extent == 0 || extent > (std::uint64_t{1} << 32) / chunk_bytes_) fail("has chunks that are damaged");
            chunk_bytes_ *= extent;
            missing_ *= (dataset.shape[axis] + extent - 1) / extent;
        }
        all_.resize(dataset.samples() * dataset.element_bytes);
        placed_.resize(missing_);
        walk(*dataset.address, {});
        if (missing_ != 0) fail("is not wholly written");
    }

    Bytes take() { return std::move(all_); }

  private:
    [[noreturn]] void fail(const std::string& why) const {
        file_.fail(fmt::format("its array '{}' {}", dataset_.name, why));
    }

    void walk(std::uint64_t address, std::optional<std::uint64_t> above) {
        if (++nodes_ > placed_.size() + 64) fail("has a tree of chunks that is damaged");
        const Bytes head = file_.at(address, 24);
        const std::uint64_t level = head[5], entries = std::uint64_t{head[6]} | std::uint64_t{head[7]} << 8;
        if (std::memcmp(head.data(), "TREE\1", 5) != 0 || (above && level + 1 != *above))
            fail("has a tree of chunks that is damaged");
        const std::size_t axes = dataset_.shape.size(), key = 8 + 8 * (axes + 1);
        const Bytes node = file_.at(address + 24, key + (key + 8) * entries);
        ByteCursor rest(file_, node);
        for (std::uint64_t i = 0; i < entries; ++i) {
            const std::uint64_t bytes = rest.number(4), left_out = rest.number(4);
            std::vector<std::uint64_t> start;
            for (std::size_t axis = 0; axis < axes; ++axis) start.push_back(rest.number(8));
            rest.skip(8);
            const std::uint64_t child = rest.number(8);
            if (level > 0)
                walk(child, level);
            else
                place(start, plain(file_.at(child, bytes), left_out));
        }
    }

    // Inverts the filters, last one first; a set bit of `left_out` marks a filter that was not applied.
    Bytes plain(Bytes bytes, std::uint64_t left_out) const {
        constexpr std::uint64_t deflate = 1, shuffle = 2, checksum = 3;
        for (std::size_t i = dataset_.filters.size(); i-- > 0;) {
            const Hdf5V0Dataset::Filter& filter = dataset_.filters[i];
            if (i < 32 && (left_out >> i & 1) != 0) continue;
            if (filter.id == checksum) {
                if (bytes.size() < 4) fail("has chunks that are damaged");
                std::uint32_t stored = 0;
                std::memcpy(&stored, &bytes[bytes.size() - 4], 4);
                bytes.resize(bytes.size() - 4);
                if (!is_fletcher(stored, bytes)) fail("has a chunk with a wrong checksum");
            } else if (filter.id == deflate) {
                // Checksums before the compression added four bytes each.
                const auto inner = static_cast<std::size_t>(
                    std::count_if(dataset_.filters.begin(), dataset_.filters.begin() + static_cast<std::ptrdiff_t>(i),
                                  [](const auto& earlier) { return earlier.id == checksum; }));
                bytes = inflated(file_, bytes, chunk_bytes_ + 4 * inner);
            } else if (filter.id == shuffle) {
                bytes = unshuffled(bytes, dataset_.element_bytes);
            } else {
                fail(fmt::format("is packed by the filter {} ({}), which is not read here", filter.id,
                                 filter.name.empty() ? "without a name" : filter.name));
            }
        }
        if (bytes.size() != chunk_bytes_) fail("has chunks that are damaged");
        return bytes;
    }

    void place(const std::vector<std::uint64_t>& start, const Bytes& bytes) {
        const std::size_t axes = start.size();
        std::uint64_t index = 0;
        for (std::size_t axis = 0; axis < axes; ++axis) {
            const std::uint64_t extent = dataset_.chunk[axis], shape = dataset_.shape[axis];
            if (start[axis] % extent != 0 || start[axis] >= shape) fail("has chunks that are damaged");
            index = index * ((shape + extent - 1) / extent) + start[axis] / extent;
        }
        if (placed_[index]) fail("has a chunk twice");
        placed_[index] = true;
        --missing_;
        // Copies line by line along the last axis, without the part of a chunk beyond the ends of the array.
        const std::uint64_t line = dataset_.chunk[axes - 1];
        const std::uint64_t held = std::min(line, dataset_.shape[axes - 1] - start[axes - 1]);
        const std::uint64_t lines = chunk_bytes_ / dataset_.element_bytes / line;
        for (std::uint64_t i = 0; i < lines; ++i) {
            std::uint64_t rest = i, at = start[axes - 1], stride = dataset_.shape[axes - 1];
            bool inside = true;
            for (std::size_t axis = axes - 1; axis-- > 0;) {
                const std::uint64_t place = start[axis] + rest % dataset_.chunk[axis];
                rest /= dataset_.chunk[axis];
                inside = inside && place < dataset_.shape[axis];
                at += place * stride;
                stride *= dataset_.shape[axis];
            }
            if (inside)
                std::memcpy(&all_[at * dataset_.element_bytes], &bytes[i * line * dataset_.element_bytes],
                            held * dataset_.element_bytes);
        }
    }

    const Hdf5V0& file_;
    const Hdf5V0Dataset& dataset_;
    std::uint64_t chunk_bytes_ = 0, missing_ = 1;
    std::size_t nodes_ = 0;
    Bytes all_;
    std::vector<bool> placed_;
};

}  // namespace

std::vector<unsigned char> Hdf5V0::read(const Hdf5V0Dataset& dataset) const {
    using Layout = Hdf5V0Dataset::Layout;
    const auto refuse = [&](const char* why) { fail(fmt::format("its array '{}' {}", dataset.name, why)); };
    const std::uint64_t samples = dataset.samples();
    if (samples == 0) refuse("is empty");
    if (samples / max_expansion > file_.size() / dataset.element_bytes)
        refuse("has more samples than the file can hold");
    const std::uint64_t bytes = samples * dataset.element_bytes;
    if (dataset.layout == Layout::compact) {
        if (dataset.compact.size() != bytes) refuse("is damaged");
        return dataset.compact;
    }
    if (dataset.layout == Layout::none) refuse("has a layout that is not read here");
    if (!dataset.address) refuse("is not wholly written");
    if (dataset.layout == Layout::contiguous) {
        if (dataset.bytes != bytes) refuse("is damaged");
        return at(*dataset.address, bytes);
    }
    if (dataset.chunk.size() != dataset.shape.size()) refuse("is damaged");
    return Chunks(*this, dataset).take();
}

}  // namespace hogel::io::arrays
