// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <new>
#include <numbers>

#include "hogel/core/child_process.h"
#include "hogel/error.h"
#include "hogel/scene.h"
#include "hogel/scene/edges.h"
#include "hogel/scene/mesh_files/apply_materials.h"
#include "hogel/scene/mesh_files/assimp_import.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/gltf_materials.h"
#include "hogel/scene/mesh_files/limits.h"
#include "hogel/scene/mesh_files/materials.h"
#include "hogel/scene/mesh_files/mtl.h"
#include "hogel/scene/mesh_files/obj.h"
#include "hogel/scene/mesh_files/off.h"
#include "hogel/scene/mesh_files/orient.h"
#include "hogel/scene/mesh_files/points.h"
#include "hogel/scene/mesh_files/read_ply.h"
#include "hogel/scene/mesh_files/stl.h"
#include "hogel/scene/mesh_files/transfer.h"
#include "hogel/scene/pictures.h"

namespace hogel {

using namespace scene::mesh_files;

namespace {

constexpr double crease = 60 * std::numbers::pi / 180;  // missing normals are smooth up to this angle

/// Imports a file by assimp in a child process, because it crashes on damaged files of many formats.
Imported import_in_child(const std::filesystem::path& path, const std::string& file, std::string_view contents,
                         bool numbered = false) {
    const std::uint64_t bytes = std::filesystem::file_size(path);
    try {
        return core::with_child(
            child_limits(bytes), [&](int pipe) { import_with_assimp(path, file, contents, numbered, pipe); },
            [&](core::ChildProcess& child) { return receive(child, path.parent_path(), file); });
    } catch (const core::ChildFailure& failure) {
        reject_file(file, fmt::format("the mesh reader {}", failure.what()), "an undamaged mesh file");
    }
}

/// Contents of a file; materials only for glTF.
struct Read {
    Imported imported;
    GltfMaterials materials;
    bool has_materials = false;
};

Mesh discs_of(const Points& points, const ImportOptions& options, const std::string& file) {
    try {
        return discs(points, options.point_size);
    } catch (const Error& error) {
        throw Error(error.code(), fmt::format("{}: {}", file, error.what()));
    }
}

/// Dispatches by extension and first bytes; assimp chooses its reader likewise.
Read import_file(const std::filesystem::path& path, std::uintmax_t size, const std::string& file,
                 const ImportOptions& options) {
    std::string start(4096, '\0');
    std::ifstream stream(path, std::ios::binary);
    stream.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(stream.gcount()));
    if (starts_with_mark(start)) start.erase(0, 3);
    Read read;
    const std::size_t first = start.find_first_not_of(" \t\r\n");
    if (has_extension(path, {".off"}) || starts_like_off(start)) {
        read.imported = read_off(file, read_file(path, size, file));
    } else if (is_gltf(path) || start.starts_with("glTF") || (first != start.npos && start[first] == '{')) {
        CheckedGltf checked = check_gltf(file, path.parent_path(), read_file(path, size, file));
        read.has_materials = !checked.contents.empty();
        read.imported = import_in_child(path, file, checked.contents, read.has_materials);
        read.imported.provenance = std::move(checked.provenance);
        read.materials = std::move(checked.materials);
    } else if (has_extension(path, {".obj"})) {
        std::string text = read_file(path, size, file);
        std::vector<std::string> notes = notes_of_obj(text, path.parent_path());
        Vec3 offset;
        read.imported = import_in_child(path, file, with_leading_zeros(about_the_origin(std::move(text), offset)));
        for (ImportedMesh& part : read.imported.meshes)
            for (Vec3& position : part.mesh.positions) position = position + offset;
        read.imported.has_singles = false;
        read.imported.notes.insert(read.imported.notes.begin(), notes.begin(), notes.end());
    } else if (has_extension(path, {".ply"}) || starts_like_ply(start)) {
        const std::string bytes = read_file(path, size, file);
        PlyContents contents = read_ply(file, bytes);
        read.imported = std::move(contents.surfaces);
        if (contents.points) read.imported.meshes.push_back({discs_of(*contents.points, options, file)});
    } else if (has_extension(path, {".stl"})) {
        std::vector<std::string> notes;
        const std::string bytes = with_counted_triangles(file, read_file(path, size, file), notes);
        read.imported = import_in_child(path, file, bytes);
        read.imported.notes.insert(read.imported.notes.end(), notes.begin(), notes.end());
    } else if (has_extension(path, {".dat"})) {
        read.imported.meshes.push_back({discs_of(read_dat(file, read_file(path, size, file)), options, file)});
        read.imported.has_singles = false;
    } else if (has_extension(path, {".xyz", ".pts", ".asc"})) {
        read.imported.meshes.push_back({discs_of(read_xyz(file, read_file(path, size, file)), options, file)});
        read.imported.has_singles = false;
    } else if (has_extension(path, {".splat", ".ksplat", ".spz"})) {
        reject_splats(file);
    } else {
        read.imported = import_in_child(path, file, {});
    }
    return read;
}

void show_unlit(ImportedMesh& part) {
    Mesh& mesh = part.mesh;
    if (!part.is_unlit) return;
    mesh.radiance.assign(mesh.positions.size(), mesh.material.base_color);
    for (std::size_t i = 0; i < std::min(mesh.colors.size(), mesh.radiance.size()); ++i)
        mesh.radiance[i] = mesh.radiance[i] * mesh.colors[i];
}

struct Turned {
    std::size_t closed = 0;     ///< surfaces that enclose a volume
    std::size_t bodies = 0;     ///< flipped as a whole
    std::size_t triangles = 0;  ///< flipped to agree with their neighbours
};

/// Orients a mesh of a format other than glTF, which does not define the front: makes neighbours consistent and closed
/// surfaces face outwards; open ones become double-sided. Adds missing normals from the same edge list.
void face_outwards(Mesh& mesh, bool has_facet_normals, Turned& turned) {
    if (mesh.name == points_name || mesh.triangles.empty()) return;
    if (has_facet_normals) mesh.normals.clear();
    const bool lacks_normals = mesh.normals.empty();
    std::vector<scene::TriangleEdge> edges = scene::sorted_edges(mesh);
    std::size_t neighbors = 0;
    if (lacks_normals) turned.triangles += neighbors = orient_neighbors(mesh, edges);
    const Sides sides = turn_inside_out(mesh, edges);
    turned.closed += sides.bodies;
    turned.bodies += sides.turned;
    if (!sides.is_body) mesh.material.double_sided = true;
    if (!lacks_normals) return;
    if (neighbors > 0 || sides.turned > 0) edges = scene::sorted_edges(mesh);
    scene::add_normals(mesh, edges, crease);
}

void note(const Turned& turned, std::vector<std::string>& notes) {
    if (turned.triangles > 0)
        notes.push_back(
            fmt::format("{} triangles face the other way than their neighbours: they are turned", turned.triangles));
    if (turned.bodies == 0) return;
    notes.push_back(turned.bodies == turned.closed
                        ? "its surfaces face inwards: they are turned inside out"
                        : fmt::format("{} of its {} closed surfaces face inwards: they are turned inside out",
                                      turned.bodies, turned.closed));
}

/// Unused vertices may have any coordinates in a file; moves them to a used one.
void place_unused_vertices(Mesh& mesh) {
    std::vector<bool> is_used(mesh.positions.size());
    for (const auto& corners : mesh.triangles)
        for (const std::uint32_t vertex : corners)
            if (vertex < is_used.size()) is_used[vertex] = true;
    const auto first = static_cast<std::size_t>(std::ranges::find(is_used, true) - is_used.begin());
    for (std::size_t i = 0; first < is_used.size() && i < is_used.size(); ++i)
        if (!is_used[i]) mesh.positions[i] = mesh.positions[first];
}

/// Replaces black if all surfaces are black, which some programs write for an unset colour.
void show_black_as_white(Scene& scene) {
    const auto is_black = [](const Mesh& mesh) {
        const Material& material = mesh.material;
        return material.base_color == Rgb{0, 0, 0} && material.emission == Rgb{0, 0, 0} && mesh.radiance.empty() &&
               !(material.metallic > 0);
    };
    if (scene.meshes.empty() || !std::ranges::all_of(scene.meshes, is_black)) return;
    for (Mesh& mesh : scene.meshes)
        mesh.material.base_color = mesh.material.base_color_texture ? Rgb{1, 1, 1} : Material{}.base_color;
    scene.notes.push_back("all its surfaces are black: they are shown in grey");
}

/// Adds a note if the steps of single-precision coordinates are visible far from the origin, as in maps.
void note_distance(const Scene& scene, std::vector<std::string>& notes) {
    const Bounds box = bounds(scene);
    const double sizes = std::max(length(box.low), length(box.high)) / length(box.high - box.low),
                 steps = sizes * 0x1p-24;
    if (steps > 1e-4 && sizes < 1e12)
        notes.push_back(fmt::format(
            "it lies {:.2g} times its size from the origin, where coordinates are read in steps of {:.1g} of "
            "its size: move it to the origin",
            sizes, steps));
}

Scene convert(Read read, const std::filesystem::path& path, const std::string& file) {
    Imported& imported = read.imported;
    Textures textures(read.has_materials ? std::move(read.materials.images) : std::move(imported.textures),
                      path.parent_path(), file);
    if (!read.has_materials) textures.leave_out_missing();
    Scene scene;
    scene.name = path.stem().string();
    scene.provenance = std::move(imported.provenance);
    scene.lights = std::move(read.materials.lights);
    // CAD and printing programs have z up; these formats do not state an axis.
    if (has_extension(path, {".stl", ".3mf", ".amf"})) scene.up = {0, 0, 1};
    scene.cameras = std::move(read.materials.cameras);
    scene.notes = std::move(read.materials.notes);
    scene.notes.insert(scene.notes.end(), imported.notes.begin(), imported.notes.end());
    for (ImportedMesh& part : imported.meshes) {
        Mesh& mesh = part.mesh;
        if (read.has_materials) {
            apply_materials(read.materials, part, textures);
        } else {
            mesh.material.base_color_texture = textures.get(part.texture);
            if (mesh.texture_coordinates.empty()) mesh.material.base_color_texture = nullptr;
            apply_obj_materials(part, textures);
        }
        show_unlit(part);
        if (!mesh.triangles.empty()) scene.meshes.push_back(std::move(mesh));
    }
    for (const std::string& name : textures.missing())
        scene.notes.push_back(fmt::format("its texture '{}' is not found: surfaces have none", one_line(name)));
    if (!read.has_materials) show_black_as_white(scene);
    for (Mesh& mesh : scene.meshes) place_unused_vertices(mesh);
    if (scene.meshes.empty())
        reject_file(file,
                    "no triangles that have an area" + (scene.notes.empty() ? "" : " (" + scene.notes.front() + ")"),
                    "at least one");
    try {
        validate(scene);
    } catch (const Error& error) {
        throw Error(error.code(), fmt::format("{}: {}", file, error.what()));
    }
    if (!read.has_materials) {
        Turned turned;
        for (Mesh& mesh : scene.meshes) face_outwards(mesh, has_extension(path, {".stl"}), turned);
        note(turned, scene.notes);
        if (imported.has_singles) note_distance(scene, scene.notes);
    }
    add_missing_normals(scene, crease);
    return scene;
}

}  // namespace

Scene scene::import_mesh(const std::filesystem::path& path, const ImportOptions& options) {
    const std::string file = path.string();
    const std::uintmax_t size = check_regular_file(path);
    try {
        const std::filesystem::path real = std::filesystem::canonical(path);
        return convert(import_file(real, size, file, options), real, file);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        reject_file(file, "needs more memory than available", "a smaller mesh");
    } catch (const std::exception& error) {
        reject_file(file, one_line(error.what()), "a readable mesh file");
    }
}

}  // namespace hogel
