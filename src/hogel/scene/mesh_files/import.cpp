// SPDX-License-Identifier: Apache-2.0
#include "hogel/scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <new>
#include <numbers>

#include "hogel/error.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/materials.h"
#include "hogel/scene/triangulate.h"

namespace hogel {

using namespace scene::mesh_files;

namespace {

constexpr std::size_t max_triangles = std::size_t{1} << 28;
constexpr std::size_t max_instances = std::size_t{1} << 20;
constexpr unsigned max_corners = 4096;  // maximum for a polygon, because triangulation takes quadratic time
constexpr double crease = 60 * std::numbers::pi / 180;  // missing normals are smooth up to this angle

struct Placed {
    const aiMesh* mesh;
    aiMatrix4x4 to_world;
};

bool has_faces(const aiMesh& mesh) { return mesh.mNumFaces > 0 && mesh.HasPositions(); }

/// Lists every mesh of the node hierarchy with its transform. Triangles are counted before anything is copied, because
/// a small file can request billions of copies.
std::vector<Placed> place_meshes(const aiScene& source, const std::string& file) {
    struct Visit {
        const aiNode* node;
        aiMatrix4x4 to_world;
    };
    std::vector<Placed> placed;
    std::vector<Visit> todo{{source.mRootNode, source.mRootNode->mTransformation}};
    std::size_t nodes = 0, triangles = 0, vertices = 0;
    while (!todo.empty()) {
        const Visit visit = todo.back();
        todo.pop_back();
        if (++nodes > max_instances || placed.size() > max_instances)
            reject_file(file, fmt::format("more than {} nodes or mesh instances", max_instances),
                        "a scene that is not an instance bomb");
        for (unsigned i = 0; i < visit.node->mNumMeshes; ++i) {
            const unsigned index = visit.node->mMeshes[i];
            if (index >= source.mNumMeshes) reject_file(file, fmt::format("mesh index {}", index), "one that exists");
            const aiMesh& mesh = *source.mMeshes[index];
            if (!has_faces(mesh)) continue;
            triangles += mesh.mNumFaces;
            vertices += mesh.mNumVertices;
            if (triangles > max_triangles || vertices > 2 * max_triangles)
                reject_file(file, "more than 2^28 triangles once its instances are counted", "a smaller scene");
            placed.push_back({&mesh, visit.to_world});
        }
        for (unsigned i = visit.node->mNumChildren; i-- > 0;) {
            const aiNode* child = visit.node->mChildren[i];
            todo.push_back({child, visit.to_world * child->mTransformation});
        }
    }
    return placed;
}

// In double precision, because matrices are products over the hierarchy.
Vec3 transform_point(const aiMatrix4x4& m, const aiVector3D& p) {
    const double x = p.x, y = p.y, z = p.z;
    return {m.a1 * x + m.a2 * y + m.a3 * z + m.a4, m.b1 * x + m.b2 * y + m.b3 * z + m.b4,
            m.c1 * x + m.c2 * y + m.c3 * z + m.c4};
}

/// The columns of the cofactor matrix, by which normals transform up to the determinant. Finite for any scale.
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

/// Returns false if a normal of the file is zero; then new normals are made.
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

bool is_flat(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
    const Vec3 a = mesh.positions[t[0]];
    return cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a) == Vec3{};
}

void import_triangles(const aiMesh& source, bool mirrored, const std::string& file, Mesh& mesh) {
    mesh.triangles.reserve(source.mNumFaces);
    std::vector<Vec3> polygon;
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
        const std::span<const unsigned> corners(source.mFaces[i].mIndices, source.mFaces[i].mNumIndices);
        for (const unsigned index : corners)
            if (index >= source.mNumVertices)
                reject_file(file, fmt::format("mesh '{}': vertex index {}", mesh.name, index),
                            fmt::format("less than {}", source.mNumVertices));
        if (corners.size() > max_corners)
            reject_file(file, fmt::format("a face with {} corners", corners.size()),
                        fmt::format("at most {}", max_corners));
        if (corners.size() < 3) continue;
        const auto add = [&](std::array<std::uint32_t, 3> triangle) {
            if (mirrored) std::swap(triangle[1], triangle[2]);
            if (!is_flat(mesh, triangle)) mesh.triangles.push_back(triangle);
        };
        if (corners.size() == 3) {
            add({corners[0], corners[1], corners[2]});
            continue;
        }
        polygon.clear();
        for (const unsigned index : corners) polygon.push_back(mesh.positions[index]);
        for (const auto& [a, b, c] : scene::triangulate(polygon)) add({corners[a], corners[b], corners[c]});
    }
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
    if (source.HasTextureCoords(0))
        for (unsigned i = 0; i < source.mNumVertices; ++i)
            mesh.texture_coordinates.push_back({source.mTextureCoords[0][i].x, source.mTextureCoords[0][i].y});
    return mesh;
}

Scene convert(const aiScene& source, const std::filesystem::path& path, const std::string& file) {
    const bool linear_colors = is_gltf(path);
    MaterialImport materials(source, path.parent_path(), file);
    Scene scene;
    scene.name = path.stem().string();
    for (const Placed& placed : place_meshes(source, file)) {
        Mesh mesh = import_mesh(placed, linear_colors, file);
        if (mesh.triangles.empty()) continue;
        mesh.material = materials[placed.mesh->mMaterialIndex];
        if (mesh.texture_coordinates.empty()) mesh.material.base_color_texture = nullptr;
        if (materials.is_unlit(placed.mesh->mMaterialIndex)) {
            mesh.radiance.assign(mesh.positions.size(), mesh.material.base_color);
            for (std::size_t i = 0; i < mesh.colors.size(); ++i) mesh.radiance[i] = mesh.radiance[i] * mesh.colors[i];
        }
        scene.meshes.push_back(std::move(mesh));
    }
    if (scene.meshes.empty()) reject_file(file, "no triangles that have an area", "at least one");
    try {
        validate(scene);
    } catch (const Error& error) {
        throw Error(error.code(), fmt::format("{}: {}", file, error.what()));
    }
    add_missing_normals(scene, crease);
    return scene;
}

}  // namespace

Scene import_scene(const std::filesystem::path& path) {
    const std::string file = path.string();
    check_mesh_file(path);
    try {
        const std::filesystem::path real = std::filesystem::canonical(path);
        Assimp::Importer importer;
        importer.SetIOHandler(new FolderFiles(real.parent_path()));
        const aiScene* source = importer.ReadFile(real.string(), 0);
        if (!source || !source->mRootNode)
            reject_file(file, one_line(importer.GetErrorString()), "a mesh file that assimp can read");
        return convert(*source, real, file);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        reject_file(file, "needs more memory than available", "a smaller or undamaged mesh");
    } catch (const std::exception& error) {
        reject_file(file, one_line(error.what()), "a mesh file that assimp can read");
    }
}

}  // namespace hogel
