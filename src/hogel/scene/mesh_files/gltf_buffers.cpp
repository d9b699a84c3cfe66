// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/files.h"
#include "hogel/scene/mesh_files/gltf.h"

namespace hogel::scene::mesh_files {
namespace {

std::optional<unsigned> digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    if (c == '/') return 63;
    return std::nullopt;
}

std::optional<std::string> decode_base64(std::string_view text) {
    if (text.size() % 4 != 0) return std::nullopt;
    for (int i = 0; i < 2 && text.ends_with('='); ++i) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    unsigned bits = 0, bit_count = 0;
    for (const char c : text) {
        const auto value = digit(c);
        if (!value) return std::nullopt;
        bits = (bits << 6 | *value) & 0xffff;
        bit_count += 6;
        if (bit_count < 8) continue;
        bit_count -= 8;
        bytes += static_cast<char>(bits >> bit_count & 0xff);
    }
    return bytes;
}

}  // namespace

std::string decode_data_uri(const Gltf& gltf, const std::string& uri, const std::string& where) {
    const std::size_t comma = uri.find(',');
    if (comma == uri.npos) gltf.reject(where + ".uri", "has no data", "data:TYPE;base64,DATA");
    const std::string_view data = std::string_view(uri).substr(comma + 1);
    if (!std::string_view(uri).substr(0, comma).ends_with(";base64")) return std::string(data);
    auto decoded = decode_base64(data);
    if (!decoded) gltf.reject(where + ".uri", "is not base64", "data:TYPE;base64,DATA");
    return std::move(*decoded);
}

std::string_view GltfBuffers::load(const Gltf& gltf, const Json& buffer, const std::string& where, bool is_first) {
    const auto uri = buffer.find("uri");
    if (uri == buffer.end()) {
        if (!is_first || !gltf.has_binary) gltf.reject(where, "has no data", "a uri, or first place in a .glb file");
        return gltf.binary;
    }
    if (!uri->is_string()) gltf.reject(where + ".uri", "is not a text", "a file name or data");
    const std::string& name = uri->get_ref<const std::string&>();
    if (name.starts_with("data:")) return storage_.emplace_back(decode_data_uri(gltf, name, where));
    const auto path = find_in_folder(gltf.folder, name);
    if (!path)
        gltf.reject(where + ".uri", fmt::format("'{}' not found", one_line(name)), "a file in the folder of the mesh");
    const auto known = std::find_if(files_.begin(), files_.end(), [&](const auto& f) { return f.first == *path; });
    if (known != files_.end()) return known->second;
    storage_.push_back(read_file(*path, std::filesystem::file_size(*path), gltf.file));
    files_.emplace_back(*path, storage_.back());
    return storage_.back();
}

GltfBuffers::GltfBuffers(const Gltf& gltf) {
    const Json& list = gltf.list("buffers");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string where = fmt::format("buffers[{}]", i);
        const Json& buffer = gltf.object(list, i, where);
        const std::uint64_t size = gltf.number(buffer, where, "byteLength", ~std::uint32_t{0});
        const std::string_view data = load(gltf, buffer, where, i == 0);
        if (size == 0 || size > data.size())
            gltf.reject(where + ".byteLength", fmt::format("is {}", size),
                        fmt::format("1 to {}, the bytes that there are", data.size()));
        buffers_.push_back(data.substr(0, size));
    }
    bytes_ = gltf.binary.size();
    for (const std::string& bytes : storage_) bytes_ += bytes.size();
}

}  // namespace hogel::scene::mesh_files
