// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hogel::scene::mesh_files {

using Json = nlohmann::json;

/// A glTF file, checked before assimp reads it. All functions throw Error(bad_input), naming the position in the
/// document, such as "accessors[3].byteOffset", and the expected value.
struct Gltf {
    std::string file;              ///< name for messages
    std::filesystem::path folder;  ///< canonical; contains the buffers
    std::uint64_t file_size = 0;
    Json json;                  ///< an object
    std::string_view binary;    ///< the BIN chunk of a .glb file
    bool is_binary = false;     ///< whether it is a .glb file
    bool has_binary = false;    ///< whether there is a BIN chunk
    bool is_version_2 = false;  ///< assimp also reads version 1, with another structure

    /// Returns an array of the document; empty if missing.
    const Json& list(const char* name) const;
    /// Returns an integer from 0 to `max` of an object, or `fallback`, if given, if it is missing.
    std::uint64_t number(const Json& object, const std::string& where, const char* name, std::uint64_t max,
                         std::optional<std::uint64_t> fallback = std::nullopt) const;
    /// Returns the index of an element of list(name); nothing if missing.
    std::optional<std::size_t> reference(const Json& object, const std::string& where, const char* name,
                                         const char* list) const;
    /// Returns an element of an array, which must be an object.
    const Json& object(const Json& array, std::size_t i, const std::string& where) const;

    [[noreturn]] void reject(const std::string& where, const std::string& what, const std::string& expected) const;
};

/// Splits a .glb file, parses the document without trusting its depth, and rejects duplicate keys (readers differ in
/// their choice), unsupported versions and unsupported required extensions.
/// @param bytes  the complete file; must outlive the result
Gltf parse_gltf(const std::string& file, const std::filesystem::path& folder, std::string_view bytes);

/// The bytes of all buffers, each at least as long as stated.
class GltfBuffers {
  public:
    explicit GltfBuffers(const Gltf& gltf);
    std::string_view operator[](std::size_t i) const { return buffers_[i]; }
    /// Total size of the data, which buffers may share.
    std::uint64_t bytes() const { return bytes_; }

  private:
    std::string_view load(const Gltf& gltf, const Json& buffer, const std::string& where, bool is_first);

    std::vector<std::string_view> buffers_;
    std::uint64_t bytes_ = 0;
    std::deque<std::string> storage_;
    std::vector<std::pair<std::filesystem::path, std::string_view>> files_;
};

/// An accessor with elements inside its buffers.
struct GltfAccessor {
    std::string type;  ///< such as "VEC3"
    unsigned component_type = 0;
    std::size_t component_size = 0, element_size = 0, stride = 0;
    std::uint64_t count = 0;
    std::string_view data;                ///< from the first element; empty: zeros
    std::vector<std::uint64_t> replaced;  ///< sparse: indices of elements
    std::string_view replacements;        ///< sparse: their values
    static constexpr unsigned f32 = 5126, u8 = 5121, u16 = 5123, u32 = 5125;

    /// Returns the elements of a scalar integer accessor.
    std::vector<std::uint32_t> whole_numbers() const;
    /// Returns the components of all elements, interleaved.
    /// @param normalized  whether integers are fractions of the maximum of their type
    std::vector<float> floats(bool normalized) const;
};

/// Returns the size in bytes of a glTF component type; 0 for an unknown type.
std::size_t component_size(unsigned type);

/// Returns the type, size and number of an accessor's elements, without data.
GltfAccessor read_accessor_type(const Gltf& gltf, const Json& object, const std::string& where);

/// Checks views and accessors: sizes, offsets, alignment, strides, sparse elements.
std::vector<GltfAccessor> check_accessors(const Gltf& gltf, const GltfBuffers& buffers);

/// Checks the attributes and indices of all primitives.
void check_primitives(const Gltf& gltf, const std::vector<GltfAccessor>& accessors);

/// Returns the bytes of a "data:" URI. Throws if it has no data or invalid base64.
std::string decode_data_uri(const Gltf& gltf, const std::string& uri, const std::string& where);

/// Returns a "data:" URI of bytes.
std::string data_uri(std::string_view bytes);

/// Returns whether hogel supports an extension or reports it in a note.
bool is_known_extension(const std::string& name);

/// Moves the mesh of each node with EXT_mesh_gpu_instancing to a child per instance. Requires checked accessors.
void place_instances(Gltf& gltf, const std::vector<GltfAccessor>& accessors);

/// Converts integer positions, normals and texture coordinates to floats; assimp 5.2 reads their bytes as floats.
void make_floats(Gltf& gltf, const std::vector<GltfAccessor>& accessors);

/// Checks that nodes form strict trees of limited depth, and that scenes list no node twice.
void check_nodes(const Gltf& gltf);

}  // namespace hogel::scene::mesh_files
