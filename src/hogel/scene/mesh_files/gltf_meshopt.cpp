// SPDX-License-Identifier: Apache-2.0
// Decoding of EXT_meshopt_compression.
#include <fmt/format.h>

#include <utility>

#include "hogel/core/child_process.h"
#include "hogel/core/part.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/gltf_materials.h"
#include "hogel/scene/mesh_files/limits.h"
#include "hogel/scene/mesh_files/meshopt.h"

namespace hogel::scene::mesh_files {
namespace {

constexpr const char* extension = "EXT_meshopt_compression";
constexpr std::uint64_t max_size = ~std::uint32_t{0};

/// Minimum sizes: two bits per byte of 16 attributes, a byte per triangle or index. Checked before allocation.
constexpr std::uint64_t max_ratio = 64;
std::uint64_t shortest_stream(const PackedView& view) {
    switch (view.mode) {
        case PackedView::Mode::triangles:
            return view.count / 3;
        case PackedView::Mode::indices:
            return view.count;
        default:
            return view.bytes() / max_ratio;
    }
}

PackedView::Mode read_mode(const Gltf& gltf, const Json& packed, const std::string& where) {
    const auto mode = packed.find("mode");
    if (mode != packed.end() && *mode == "ATTRIBUTES") return PackedView::Mode::attributes;
    if (mode != packed.end() && *mode == "TRIANGLES") return PackedView::Mode::triangles;
    if (mode != packed.end() && *mode == "INDICES") return PackedView::Mode::indices;
    gltf.reject(where + ".mode", "is missing or unknown", "ATTRIBUTES, TRIANGLES or INDICES");
}

PackedView::Filter read_filter(const Gltf& gltf, const Json& packed, const std::string& where) {
    const auto filter = packed.find("filter");
    if (filter == packed.end() || *filter == "NONE") return PackedView::Filter::none;
    if (*filter == "OCTAHEDRAL") return PackedView::Filter::octahedral;
    if (*filter == "QUATERNION") return PackedView::Filter::quaternion;
    if (*filter == "EXPONENTIAL") return PackedView::Filter::exponential;
    gltf.reject(where + ".filter", "is unknown", "NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
}

void check_stride(const Gltf& gltf, const std::string& where, const PackedView& view) {
    std::string expected;
    if (view.mode != PackedView::Mode::attributes) {
        if (view.stride != 2 && view.stride != 4) expected = "2 or 4, the bytes of an index";
    } else if (view.filter == PackedView::Filter::octahedral) {
        if (view.stride != 4 && view.stride != 8) expected = "4 or 8 with the filter OCTAHEDRAL";
    } else if (view.filter == PackedView::Filter::quaternion) {
        if (view.stride != 8) expected = "8 with the filter QUATERNION";
    } else if (view.stride == 0 || view.stride % 4 != 0 || view.stride > 256) {
        expected = "a multiple of 4 up to 256";
    }
    if (!expected.empty()) gltf.reject(where + ".byteStride", fmt::format("is {}", view.stride), expected);
}

PackedView read_packed(const Gltf& gltf, const GltfBuffers& buffers, const Json& object, const Json& packed,
                       const std::string& outer) {
    const std::string where = fmt::format("{}.extensions.{}", outer, extension);
    PackedView view;
    view.mode = read_mode(gltf, packed, where);
    view.filter = read_filter(gltf, packed, where);
    view.count = gltf.number(packed, where, "count", max_size);
    view.stride = gltf.number(packed, where, "byteStride", max_size);
    check_stride(gltf, where, view);
    if (view.filter != PackedView::Filter::none && view.mode != PackedView::Mode::attributes)
        gltf.reject(where + ".filter", "is for attributes", "none");
    if (view.count == 0 || (view.mode == PackedView::Mode::triangles && view.count % 3 != 0))
        gltf.reject(where + ".count", fmt::format("is {}", view.count),
                    view.count == 0 ? "at least 1" : "three for each triangle");
    if (gltf.number(object, outer, "byteLength", max_size) != view.bytes())
        gltf.reject(outer + ".byteLength", "is not what is packed there",
                    fmt::format("{} elements of {} bytes", view.count, view.stride));
    const auto buffer = gltf.reference(packed, where, "buffer", "buffers");
    if (!buffer) gltf.reject(where + ".buffer", "missing", "the number of a buffer");
    const std::string_view data = buffers[*buffer];
    const std::uint64_t offset = gltf.number(packed, where, "byteOffset", max_size, 0);
    const std::uint64_t size = gltf.number(packed, where, "byteLength", max_size);
    if (size == 0 || offset > data.size() || size > data.size() - offset)
        gltf.reject(where, fmt::format("is bytes {} to {} of a buffer", offset, offset + size),
                    fmt::format("a part of its {} bytes", data.size()));
    view.packed = data.substr(offset, size);
    if (shortest_stream(view) > size)
        gltf.reject(where, fmt::format("announces {} elements in {} bytes", view.count, size),
                    "a stream that can hold them");
    return view;
}

/// Returns the extension of a buffer view or buffer; null if there is none.
const Json* packing(const Gltf& gltf, const Json& object, const std::string& where) {
    return find_object(gltf, object, where, {"extensions", extension});
}

/// Replaces placeholder buffers, which have no data, by one byte. Returns a flag for each buffer.
std::vector<bool> fill_placeholders(Gltf& gltf) {
    std::vector<bool> empty;
    for (std::size_t i = 0; i < gltf.list("buffers").size(); ++i) {
        const std::string where = fmt::format("buffers[{}]", i);
        Json& buffer = gltf.json["buffers"][i];
        gltf.object(gltf.list("buffers"), i, where);
        empty.push_back(packing(gltf, buffer, where) != nullptr && !buffer.contains("uri") &&
                        !(i == 0 && gltf.has_binary));
        if (empty.back()) buffer = {{"byteLength", 1u}, {"uri", data_uri(std::string_view("\0", 1))}};
    }
    return empty;
}

struct Packed {
    std::size_t number;  ///< index of the buffer view
    PackedView view;
};

/// Returns the contents of the views, decoded in a child process.
std::vector<std::string> unpack_in_child(const Gltf& gltf, const std::vector<Packed>& views, std::uint64_t bytes) {
    const auto work = [&](int pipe) {
        for (const Packed& packed : views) {
            std::vector<unsigned char> to(packed.view.bytes());
            const char is_whole = unpack(packed.view, to) ? 1 : 0;
            core::ChildProcess::write(pipe, &is_whole, 1);
            if (is_whole == 0) return;
            core::ChildProcess::write(pipe, to.data(), to.size());
        }
    };
    const auto receive = [&](core::ChildProcess& child) {
        std::vector<std::string> unpacked;
        for (const Packed& packed : views) {
            char is_whole = 0;
            child.read(&is_whole, 1);
            if (is_whole == 0)
                gltf.reject(fmt::format("bufferViews[{}].extensions.{}", packed.number, extension), "is damaged",
                            "a stream of that mode");
            unpacked.emplace_back(packed.view.bytes(), '\0');
            child.read(unpacked.back().data(), unpacked.back().size());
        }
        return unpacked;
    };
    try {
        return core::with_child(child_limits(bytes), work, receive);
    } catch (const core::ChildFailure& failure) {
        reject_file(gltf.file, fmt::format("the decoder of {} {}", extension, failure.what()),
                    "an undamaged mesh file");
    }
}

std::vector<Packed> find_packed(const Gltf& gltf, const GltfBuffers& buffers, const std::vector<bool>& placeholders) {
    const bool is_built_in = core::part("meshoptimizer").built_in;
    const Json& list = gltf.list("bufferViews");
    std::vector<Packed> views;
    std::uint64_t source = 0, sum = 0;
    for (std::size_t i = 0; i < placeholders.size(); ++i) source += buffers[i].size();
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string where = fmt::format("bufferViews[{}]", i);
        const Json* packed = packing(gltf, gltf.object(list, i, where), where);
        if (packed == nullptr) continue;
        const auto buffer = gltf.reference(list[i], where, "buffer", "buffers");
        if (!is_built_in && buffer && !placeholders[*buffer]) continue;
        core::require_part("meshoptimizer", fmt::format("{}: {} is packed by {}", gltf.file, where, extension));
        views.push_back({i, read_packed(gltf, buffers, list[i], *packed, where)});
        sum += views.back().view.bytes();
        // Views may share a stream.
        if (sum > max_ratio * source)
            gltf.reject(where, fmt::format("and those before it announce {} bytes", sum),
                        fmt::format("at most {} times the {} of its buffers", max_ratio, source));
    }
    return views;
}

}  // namespace

void unpack_views(Gltf& gltf) {
    bool any = false;
    const Json& list = gltf.list("bufferViews");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string where = fmt::format("bufferViews[{}]", i);
        any = packing(gltf, gltf.object(list, i, where), where) != nullptr || any;
    }
    if (!any) return;
    const std::vector<bool> placeholders = fill_placeholders(gltf);
    std::vector<Packed> views;
    std::vector<std::string> unpacked;
    {
        const GltfBuffers buffers(gltf);
        views = find_packed(gltf, buffers, placeholders);
        std::uint64_t bytes = 0;
        for (const Packed& packed : views) bytes += packed.view.packed.size();
        unpacked = unpack_in_child(gltf, views, bytes);
    }
    for (std::size_t k = 0; k < views.size(); ++k) {
        Json& view = gltf.json["bufferViews"][views[k].number];
        view["buffer"] = gltf.json["buffers"].size();
        view.erase("byteOffset");
        gltf.json["buffers"].push_back({{"byteLength", unpacked[k].size()}, {"uri", data_uri(unpacked[k])}});
        std::string().swap(unpacked[k]);
    }
    for (const char* name : {"buffers", "bufferViews"})
        for (Json& object : gltf.json[name]) object.erase("extensions");
}

}  // namespace hogel::scene::mesh_files
