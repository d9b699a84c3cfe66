// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/assimp_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <new>
#include <vector>

#include <unistd.h>

#include "hogel/error.h"
#include "hogel/scene/mesh_files/assimp_notes.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/files.h"
#include "hogel/scene/mesh_files/gltf_materials.h"
#include "hogel/scene/mesh_files/limits.h"
#include "hogel/scene/mesh_files/materials.h"
#include "hogel/scene/mesh_files/mtl.h"
#include "hogel/scene/mesh_files/polygons.h"
#include "hogel/scene/mesh_files/transfer.h"

namespace hogel::scene::mesh_files {
namespace {

constexpr std::size_t max_instances = std::size_t{1} << 20;

struct Placed {
    const aiMesh* mesh;
    aiMatrix4x4 to_world;
};

/// Returns the size of a converted mesh; 0 without a surface.
std::uint64_t converted_bytes(const aiMesh& mesh) {
    if (mesh.mNumFaces == 0 || !mesh.HasPositions()) return 0;
    std::uint64_t vertex = sizeof(Vec3);
    if (mesh.HasNormals()) vertex += sizeof(Vec3);
    if (mesh.HasVertexColors(0)) vertex += sizeof(Rgb) + sizeof(float);
    if (mesh.HasTextureCoords(0)) vertex += sizeof(TextureCoordinate);
    if (mesh.HasTextureCoords(1)) vertex += sizeof(TextureCoordinate);
    std::uint64_t triangles = 0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) triangles += std::max(mesh.mFaces[i].mNumIndices, 2u) - 2;
    return mesh.mNumVertices * vertex + triangles * 3 * sizeof(std::uint32_t) + sizeof(ImportedMesh);
}

/// Lists all mesh instances with transforms. Counts bytes first: a small file can request billions of copies.
std::vector<Placed> place_meshes(const aiScene& source, const std::string& file, std::uint64_t max_bytes) {
    struct Visit {
        const aiNode* node;
        aiMatrix4x4 to_world;
    };
    std::vector<std::uint64_t> bytes_of(source.mNumMeshes);
    for (unsigned i = 0; i < source.mNumMeshes; ++i) bytes_of[i] = converted_bytes(*source.mMeshes[i]);
    std::vector<Placed> placed;
    std::vector<Visit> todo{{source.mRootNode, source.mRootNode->mTransformation}};
    std::uint64_t nodes = 0, bytes = 0;
    while (!todo.empty()) {
        const Visit visit = todo.back();
        todo.pop_back();
        if (++nodes > max_instances || placed.size() > max_instances)
            reject_file(file, fmt::format("more than {} nodes or mesh instances", max_instances), "a smaller scene");
        for (unsigned i = 0; i < visit.node->mNumMeshes; ++i) {
            const unsigned index = visit.node->mMeshes[i];
            if (index >= source.mNumMeshes) reject_file(file, fmt::format("mesh index {}", index), "one that exists");
            if (bytes_of[index] == 0) continue;
            bytes += bytes_of[index];
            if (bytes > max_bytes)
                reject_file(file, fmt::format("the copies of its meshes need more than {} MiB", max_bytes >> 20),
                            "fewer copies; a file in which they are geometry of their own may be larger");
            placed.push_back({source.mMeshes[index], visit.to_world});
        }
        for (unsigned i = visit.node->mNumChildren; i-- > 0;) {
            const aiNode* child = visit.node->mChildren[i];
            todo.push_back({child, visit.to_world * child->mTransformation});
        }
    }
    return placed;
}

// Double precision, because matrices are products over the hierarchy.
Vec3 transform_point(const aiMatrix4x4& m, const aiVector3D& p) {
    const double x = p.x, y = p.y, z = p.z;
    return {m.a1 * x + m.a2 * y + m.a3 * z + m.a4, m.b1 * x + m.b2 * y + m.b3 * z + m.b4,
            m.c1 * x + m.c2 * y + m.c3 * z + m.c4};
}

/// Cofactor matrix by columns, which transforms normals up to the determinant. Finite for any scale.
struct NormalTransform {
    Vec3 x, y, z;
    double determinant;

    explicit NormalTransform(const aiMatrix4x4& m) {
        const Vec3 a{m.a1, m.b1, m.c1}, b{m.a2, m.b2, m.c2}, c{m.a3, m.b3, m.c3};
        x = cross(b, c), y = cross(c, a), z = cross(a, b);
        determinant = dot(a, x);
    }
    Vec3 operator()(const aiVector3D& n) const {
        const Vec3 v = double{n.x} * x + double{n.y} * y + double{n.z} * z;
        return determinant < 0 ? -v : v;
    }
};

/// Returns false if a normal is zero; normals are then recomputed.
bool import_normals(const aiMesh& source, const NormalTransform& transform, Mesh& mesh) {
    mesh.normals.reserve(source.mNumVertices);
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
        const Vec3 normal = transform(source.mNormals[i]);
        const double size = length(normal);
        if (!(size > 0 && std::isfinite(size))) return false;
        mesh.normals.push_back(normal / size);
    }
    return true;
}

/// Colours of PLY, OBJ and similar files are display values; those of glTF are linear.
Rgb import_color(const aiColor4D& c, bool linear) {
    return linear ? Rgb{c.r, c.g, c.b} : Rgb{srgb_decode(c.r), srgb_decode(c.g), srgb_decode(c.b)};
}

void import_triangles(const aiMesh& source, bool mirrored, const std::string& file, Mesh& mesh) {
    mesh.triangles.reserve(source.mNumFaces);
    for (unsigned i = 0; i < source.mNumFaces; ++i)
        add_polygon({source.mFaces[i].mIndices, source.mFaces[i].mNumIndices}, mirrored, file, mesh);
}

std::vector<TextureCoordinate> import_coordinates(const aiMesh& source, unsigned set) {
    std::vector<TextureCoordinate> coordinates;
    if (source.HasTextureCoords(set))
        for (unsigned i = 0; i < source.mNumVertices; ++i)
            coordinates.push_back({source.mTextureCoords[set][i].x, source.mTextureCoords[set][i].y});
    return coordinates;
}

Mesh import_mesh(const Placed& placed, bool linear_colors, const std::string& file) {
    const aiMesh& source = *placed.mesh;
    const NormalTransform transform(placed.to_world);
    Mesh mesh;
    mesh.name = one_line(source.mName.C_Str());
    mesh.positions.reserve(source.mNumVertices);
    for (unsigned i = 0; i < source.mNumVertices; ++i)
        mesh.positions.push_back(transform_point(placed.to_world, source.mVertices[i]));
    import_triangles(source, transform.determinant < 0, file, mesh);
    if (source.HasNormals() && !import_normals(source, transform, mesh)) mesh.normals.clear();
    if (source.HasVertexColors(0))
        for (unsigned i = 0; i < source.mNumVertices; ++i)
            mesh.colors.push_back(import_color(source.mColors[0][i], linear_colors));
    mesh.texture_coordinates = import_coordinates(source, 0);
    return mesh;
}

/// Returns the alphas of vertex colours; none if all are 0, as assimp reads colours without alpha.
std::vector<float> import_alphas(const aiMesh& source) {
    std::vector<float> alphas;
    if (!source.HasVertexColors(0)) return alphas;
    for (unsigned i = 0; i < source.mNumVertices; ++i) alphas.push_back(source.mColors[0][i].a);
    if (std::ranges::all_of(alphas, [](float alpha) { return alpha == 0; })) alphas.clear();
    return alphas;
}

/// Sends meshes, each texture before the first mesh that needs it.
class Conversion {
  public:
    /// @param numbered  whether materials are only indices into GltfMaterials
    /// @param mtl       the materials of an OBJ file; must outlive this
    Conversion(const aiScene& source, const std::string& file, bool linear_colors, bool numbered,
               const std::vector<MtlMaterial>& mtl, int pipe)
        : source_(source), file_(file), linear_colors_(linear_colors), numbered_(numbered), sender_(pipe) {
        for (const MtlMaterial& material : mtl) mtl_.emplace(material.name, &material);  // the first one of a name
    }

    void run(std::uint64_t max_bytes) {
        for (const Placed& placed : place_meshes(source_, file_, max_bytes)) {
            ImportedMesh imported{import_mesh(placed, linear_colors_, file_)};
            if (imported.mesh.triangles.empty()) continue;
            const unsigned index = placed.mesh->mMaterialIndex;
            if (index < source_.mNumMaterials && source_.mMaterials[index]) {
                const aiMaterial& material = *source_.mMaterials[index];
                imported.mesh.material = read_material(material);
                imported.is_unlit = is_unlit(material);
                imported.texture = send_texture(base_color_texture(material));
                add_mtl(material, imported);
                if (numbered_) add_gltf_material(*placed.mesh, material, imported);
            }
            sender_.send(imported);
        }
        sender_.send_end();
    }

  private:
    static void add_gltf_material(const aiMesh& mesh, const aiMaterial& material, ImportedMesh& imported) {
        aiString name;
        if (material.Get(AI_MATKEY_NAME, name) == AI_SUCCESS)
            if (const auto number = material_number(name.C_Str()))
                imported.material = static_cast<std::uint32_t>(*number);
        imported.mesh.alphas = import_alphas(mesh);
        imported.second_coordinates = import_coordinates(mesh, 1);
    }

    // Adds statements of the material library that assimp did not read.
    void add_mtl(const aiMaterial& source, ImportedMesh& imported) {
        aiString name;
        if (source.Get(AI_MATKEY_NAME, name) != AI_SUCCESS) return;
        const auto known = mtl_.find(std::string_view(name.C_Str()));
        if (known == mtl_.end()) return;
        const MtlMaterial* const found = known->second;
        Material& material = imported.mesh.material;
        material.alpha = static_cast<float>(found->alpha());
        if (found->emission) material.emission = *found->emission;
        const auto is_there = [&](const MtlTexture& map) { return !map.name.empty(); };
        if (is_there(found->color)) imported.texture = send_texture(found->color.name);
        if (is_there(found->opacity)) imported.opacity_texture = send_texture(found->opacity.name);
        if (is_there(found->emission_map)) {
            imported.emission_texture = send_texture(found->emission_map.name);
            if (!found->emission) material.emission = {1, 1, 1};
        }
        if (found->color.clamp)
            material.base_color_sampling = {TextureSampling::Wrap::clamp, TextureSampling::Wrap::clamp};
        if (!found->color.is_moved()) return;
        const auto moved = [&](float value, std::size_t i) {
            return static_cast<float>(found->color.scale[i] * double{value} + found->color.offset[i]);
        };
        for (TextureCoordinate& coordinate : imported.mesh.texture_coordinates)
            coordinate = {moved(coordinate.u, 0), moved(coordinate.v, 1)};
    }

    std::uint32_t send_texture(const std::string& name) {
        if (name.empty()) return ImportedMesh::no_texture;
        const auto [known, is_new] = textures_.emplace(name, static_cast<std::uint32_t>(textures_.size()));
        if (is_new) sender_.send(find_texture(source_, name, file_));
        return known->second;
    }

    const aiScene& source_;
    const std::string& file_;
    bool linear_colors_, numbered_;
    Sender sender_;
    std::map<std::string_view, const MtlMaterial*> mtl_;
    std::map<std::string, std::uint32_t> textures_;
};

/// Reads the libraries that assimp opened. Picture names are relative to the folder of mesh or library.
std::vector<MtlMaterial> read_libraries(const FolderFiles& files, const std::filesystem::path& folder,
                                        const std::string& file) {
    std::vector<MtlMaterial> materials;
    for (const std::filesystem::path& path : files.opened())
        if (has_extension(path, {".mtl"})) {
            const std::filesystem::path library_folder = path.parent_path().lexically_relative(folder);
            std::vector<MtlMaterial> read = parse_mtl(read_file(path, std::filesystem::file_size(path), file));
            for (MtlMaterial& material : read)
                for (MtlTexture* map : {&material.color, &material.opacity, &material.emission_map})
                    if (const std::string beside = (library_folder / map->name).string();
                        !map->name.empty() && library_folder != "." && find_in_folder(folder, beside))
                        map->name = beside;
            materials.insert(materials.end(), read.begin(), read.end());
        }
    return materials;
}

const char* const readable = "a mesh file that assimp can read";

[[noreturn]] void reject_size(const std::string& file) {
    reject_file(file, "needs more memory than a file of its size should", "a smaller or undamaged mesh");
}

/// Reduces a message of assimp to one line without the folder of the file.
std::string without_folder(std::string message, const std::filesystem::path& path) {
    for (std::size_t position = 0; (position = message.find(path.string(), position)) != message.npos;)
        message.replace(position, path.string().size(), path.filename().string());
    return one_line(message);
}

void import_or_throw(const std::filesystem::path& path, const std::string& file, std::string_view contents,
                     bool numbered, int pipe) {
    auto* files = new FolderFiles(path, contents);
    Assimp::Importer importer;
    importer.SetIOHandler(files);
    // off.cpp reads OFF files. assimp's reader accepts any text with "off" near its start, and trusts counts.
    importer.UnregisterLoader(importer.GetImporter("off"));
    const aiScene* source = importer.ReadFile(path.string(), 0);
    if (!source || !source->mRootNode) {
        if (importer.GetException()) std::rethrow_exception(importer.GetException());
        const std::string message = without_folder(importer.GetErrorString(), path);
        if (message.find("std::bad_") != message.npos || message.find("length_error") != message.npos)
            reject_size(file);
        reject_file(file, message.empty() ? "not readable" : message, readable);
    }
    for (const auto& opened : files->opened()) Sender(pipe).send_file(opened);
    const std::vector<MtlMaterial> mtl = read_libraries(*files, path.parent_path(), file);
    const bool is_obj = has_extension(path, {".obj"});
    for (const std::string& note : notes_of(mtl)) Sender(pipe).send_note(note);
    if (!numbered)
        for (const std::string& note : notes_of(*source, !is_obj)) Sender(pipe).send_note(note);
    Conversion(*source, file, is_gltf(path) || numbered, numbered, mtl, pipe)
        .run(max_scene_bytes(files->bytes_opened()));
    // Exit without freeing objects one by one, which could touch a damaged structure.
    _exit(0);
}

}  // namespace

void import_with_assimp(const std::filesystem::path& path, const std::string& file, std::string_view contents,
                        bool numbered, int pipe) noexcept {
    const Sender sender(pipe);
    try {
        try {
            import_or_throw(path, file, contents, numbered, pipe);
        } catch (const Error&) {
            throw;
        } catch (const std::bad_alloc&) {
            reject_size(file);
        } catch (const std::length_error&) {
            reject_size(file);
        } catch (const std::exception& error) {
            reject_file(file, without_folder(error.what(), path), readable);
        }
    } catch (const std::exception& error) {
        sender.send_error(error.what());
    }
    _exit(0);
}

}  // namespace hogel::scene::mesh_files
