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

/// A glTF file as far as it is checked before assimp reads it. All functions throw Error(bad_input), which names the
/// place in the document, such as "accessors[3].byteOffset", and what was expected there.
struct Gltf {
    std::string file;              ///< name for messages
    std::filesystem::path folder;  ///< canonical; buffers lie in it or below
    std::uint64_t file_size = 0;
    Json json;                  ///< an object
    std::string_view binary;    ///< the BIN chunk of a .glb file
    bool is_binary = false;     ///< whether it is a .glb file
    bool has_binary = false;    ///< whether there is a BIN chunk
    bool is_version_2 = false;  ///< assimp reads version 1 too, whose documents are built otherwise

    /// An array of the document; an empty one where it is missing.
    const Json& list(const char* name) const;
    /// A whole number from 0 to `max` of an object; `otherwise`, if any, where it is missing.
    std::uint64_t number(const Json& object, const std::string& where, const char* name, std::uint64_t max,
                         std::optional<std::uint64_t> otherwise = std::nullopt) const;
    /// The number of an element of list(name); none where it is missing.
    std::optional<std::size_t> reference(const Json& object, const std::string& where, const char* name,
                                         const char* list) const;
    /// The object that an element of an array is.
    const Json& object(const Json& array, std::size_t i, const std::string& where) const;

    [[noreturn]] void reject(const std::string& where, const std::string& what, const std::string& expected) const;
};

/// Splits a .glb file, parses the document without trusting its depth, and refuses keys that occur twice in an object
/// (readers differ in which they take), versions and required extensions that are not supported.
/// @param bytes  the whole file, which must live as long as the result
Gltf parse_gltf(const std::string& file, const std::filesystem::path& folder, std::string_view bytes);

/// The bytes of all buffers, each at least as long as it says.
class GltfBuffers {
  public:
    explicit GltfBuffers(const Gltf& gltf);
    std::string_view operator[](std::size_t i) const { return buffers_[i]; }
    /// The bytes that there are. Buffers may share them.
    std::uint64_t bytes() const { return bytes_; }

  private:
    std::string_view load(const Gltf& gltf, const Json& buffer, const std::string& where, bool is_first);

    std::vector<std::string_view> buffers_;
    std::uint64_t bytes_ = 0;
    std::deque<std::string> storage_;
    std::vector<std::pair<std::filesystem::path, std::string_view>> files_;
};

/// An accessor whose elements lie inside its buffers.
struct GltfAccessor {
    std::string type;  ///< such as "VEC3"
    unsigned component_type = 0;
    std::size_t component_size = 0, element_size = 0, stride = 0;
    std::uint64_t count = 0;
    std::string_view data;                ///< from the first element; empty: zeros
    std::vector<std::uint64_t> replaced;  ///< sparse: numbers of elements
    std::string_view replacements;        ///< sparse: their values
    static constexpr unsigned f32 = 5126, u8 = 5121, u16 = 5123, u32 = 5125;

    /// The elements of a scalar accessor of whole numbers.
    std::vector<std::uint32_t> whole_numbers() const;
    /// The components of all elements, one element after the other.
    /// @param normalized  whether whole numbers are shares of the largest of their type
    std::vector<float> floats(bool normalized) const;
};

/// Bytes of a component of a type as glTF numbers them; 0 for a type that does not exist.
std::size_t component_size(unsigned type);

/// What an accessor says of its elements: their type, size and number; no data.
GltfAccessor read_accessor_type(const Gltf& gltf, const Json& object, const std::string& where);

/// Checks views and accessors: sizes, offsets, alignment, strides, sparse elements.
std::vector<GltfAccessor> check_accessors(const Gltf& gltf, const GltfBuffers& buffers);

/// Checks the attributes and indices of all primitives.
void check_primitives(const Gltf& gltf, const std::vector<GltfAccessor>& accessors);

/// The bytes of a "data:" URI. Throws for one without data or in wrong base64.
std::string decode_data_uri(const Gltf& gltf, const std::string& uri, const std::string& where);

/// A "data:" URI of bytes.
std::string data_uri(std::string_view bytes);

/// Whether hogel shows what an extension adds, or says that it does not.
bool is_known_extension(const std::string& name);

/// Makes of each node with EXT_mesh_gpu_instancing one node for each instance. Nodes and accessors must have been
/// checked.
void place_instances(Gltf& gltf, const std::vector<GltfAccessor>& accessors);

/// Makes floats of positions, normals and texture coordinates that are stored as whole numbers, which assimp 5.2 takes
/// for the bytes of floats.
void make_floats(Gltf& gltf, const std::vector<GltfAccessor>& accessors);

/// Checks that nodes form strict trees that are not too deep, and that scenes name no node twice.
void check_nodes(const Gltf& gltf);

}  // namespace hogel::scene::mesh_files
