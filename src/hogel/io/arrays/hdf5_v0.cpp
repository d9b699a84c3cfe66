// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/arrays/hdf5_v0.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace hogel::io::arrays {
namespace {

using Bytes = std::vector<unsigned char>;

// Limits that no valid file of arrays reaches, because trees of a damaged file may be circular.
constexpr std::size_t max_members = 65536, max_nodes = 65536;

bool begins(std::span<const unsigned char> bytes, const char* signature) {
    return std::memcmp(bytes.data(), signature, std::strlen(signature)) == 0;
}

struct Link {
    std::string name;
    std::uint64_t header;
};

// The members of a group: a tree (III.A.1) of symbol nodes (III.B), with the names in a heap (III.D).
class Group {
  public:
    Group(const Hdf5V0& file, std::uint64_t tree, std::uint64_t heap) : file_(file) {
        const Bytes head = file.at(heap, 32);
        if (!begins(head, "HEAP")) file.fail("its heap of names is damaged");
        ByteCursor rest(file, head);
        rest.skip(8);
        const std::uint64_t bytes = rest.number(8);
        rest.skip(8);
        names_ = file.at(rest.number(8), bytes);
        walk(tree, {});
    }

    std::vector<Link> links;

  private:
    void walk(std::uint64_t address, std::optional<std::uint64_t> above) {
        if (++nodes_ > max_nodes) file_.fail("its tree of names is damaged");
        const Bytes head = file_.at(address, 24);
        if (begins(head, "SNOD")) return symbols(address, std::uint64_t{head[6]} | std::uint64_t{head[7]} << 8);
        const std::uint64_t level = head[5];
        if (!begins(head, "TREE") || head[4] != 0 || (above && level >= *above))
            file_.fail("its tree of names is damaged");
        const std::uint64_t entries = std::uint64_t{head[6]} | std::uint64_t{head[7]} << 8;
        const Bytes node = file_.at(address + 24, 8 + 16 * entries);
        ByteCursor rest(file_, node);
        for (std::uint64_t i = 0; i < entries; ++i) {
            rest.skip(8);
            walk(rest.number(8), level);
        }
    }

    void symbols(std::uint64_t address, std::uint64_t count) {
        const Bytes node = file_.at(address + 8, 40 * count);
        ByteCursor rest(file_, node);
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t name = rest.number(8), header = rest.number(8), kind = rest.number(4);
            rest.skip(20);
            constexpr std::uint64_t symbolic = 2;
            if (kind == symbolic) continue;
            if (name >= names_.size() || links.size() >= max_members) file_.fail("its names are damaged");
            ByteCursor text(file_, std::span(names_).subspan(name));
            links.push_back({text.text(), header});
        }
    }

    const Hdf5V0& file_;
    Bytes names_;
    std::size_t nodes_ = 0;
};

}  // namespace

std::uint64_t ByteCursor::number(std::size_t bytes) {
    const auto held = take(bytes);
    std::uint64_t value = 0;
    std::memcpy(&value, held.data(), bytes);
    return value;
}

std::span<const unsigned char> ByteCursor::take(std::size_t bytes) {
    if (bytes > rest_.size()) file_.fail("one of its parts ends too early");
    const auto held = rest_.first(bytes);
    rest_ = rest_.subspan(bytes);
    return held;
}

std::string ByteCursor::text() {
    const auto end = std::find(rest_.begin(), rest_.end(), 0);
    const auto held = take(static_cast<std::size_t>(end - rest_.begin()));
    skip(1);
    return {held.begin(), held.end()};
}

std::uint64_t Hdf5V0Dataset::samples() const {
    std::uint64_t n = 1;
    for (std::uint64_t extent : shape) {
        if (extent != 0 && n > (std::uint64_t{1} << 48) / extent) return std::uint64_t{1} << 48;
        n *= extent;
    }
    return n;
}

Hdf5V0::Hdf5V0(const std::filesystem::path& path) : path_(path), file_(path, core::RawFile::Mode::read, path) {
    // The superblock (II.A) is at offset 512, 1024, …, behind MATLAB's own block.
    Bytes start;
    for (base_ = 512;; base_ *= 2) {
        start = at(0, 8);
        if (begins(start, "\x89HDF\r\n\x1a\n")) break;
        if (base_ > std::uint64_t{1} << 20) fail("it holds no HDF5 superblock");
    }
    start = at(0, 16);
    if (start[8] > 1)
        fail(fmt::format("its HDF5 superblock has version {}, but MATLAB's 0 or 1 was expected", start[8]));
    if (start[13] != 8 || start[14] != 8) fail("its HDF5 superblock is damaged: addresses are not of 8 bytes");
    const std::uint64_t addresses = start[8] == 0 ? 24 : 28;
    const Bytes places = at(addresses, 72);
    ByteCursor rest(*this, places);
    const std::uint64_t base = rest.number(8);
    rest.skip(8);
    const std::uint64_t end = rest.number(8);
    if (end > file_.size() || base != base_)
        fail(fmt::format("it is truncated or damaged: {} bytes instead of {}", file_.size(), end));
    rest.skip(16);
    root_ = rest.number(8);
}

std::vector<unsigned char> Hdf5V0::at(std::uint64_t address, std::uint64_t bytes) const {
    const std::uint64_t size = file_.size();
    if (base_ > size || address > size - base_ || bytes > size - base_ - address)
        fail(fmt::format("it leads beyond its own end of {} bytes", size));
    std::vector<unsigned char> held(bytes);
    if (bytes > 0) file_.read(base_ + address, held.data(), bytes);
    return held;
}

void Hdf5V0::fail(const std::string& why) const { fail_external(file_.name(), why); }

std::vector<Hdf5V0Dataset> Hdf5V0::datasets() const {
    std::optional<std::pair<std::uint64_t, std::uint64_t>> table;
    for_each_hdf5_v0_message(*this, root_, [&](std::uint64_t type, std::uint64_t, const Bytes& message) {
        constexpr std::uint64_t symbol_table = 0x11;
        if (type != symbol_table) return;
        ByteCursor rest(*this, message);
        const std::uint64_t tree = rest.number(8);
        table = {tree, rest.number(8)};
    });
    if (!table) fail("its group of arrays is damaged or of a later version");
    std::vector<Hdf5V0Dataset> list;
    for (const Link& link : Group(*this, table->first, table->second).links) {
        Hdf5V0Dataset dataset = hdf5_v0_dataset(*this, link.name, link.header);
        if (dataset.element_bytes > 0) list.push_back(std::move(dataset));  // others are groups
    }
    return list;
}

}  // namespace hogel::io::arrays
