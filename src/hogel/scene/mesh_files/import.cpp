// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <new>
#include <numbers>

#include "hogel/core/child_process.h"
#include "hogel/core/parallel.h"
#include "hogel/error.h"
#include "hogel/scene/mesh_files/assimp_import.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/limits.h"
#include "hogel/scene/mesh_files/materials.h"
#include "hogel/scene/mesh_files/off.h"
#include "hogel/scene/mesh_files/transfer.h"
#include "hogel/scenes.h"

namespace hogel {

using namespace scene::mesh_files;

namespace {

constexpr double crease = 60 * std::numbers::pi / 180;  // missing normals are smooth up to this angle

/// What assimp makes of the file, in a child process: it crashes on damaged files of many formats.
Imported import_in_child(const std::filesystem::path& path, const std::string& file, std::string_view contents) {
    const std::uint64_t bytes = std::filesystem::file_size(path);
    try {
        return core::with_child(
            child_limits(bytes), [&](int pipe) { import_with_assimp(path, file, contents, pipe); },
            [&](core::ChildProcess& child) { return receive(child, path.parent_path(), file); });
    } catch (const core::ChildFailure& failure) {
        reject_file(file, fmt::format("the mesh reader {}", failure.what()), "an undamaged mesh file");
    }
}

/// assimp chooses its reader by the name, and by the first bytes where it knows no such name.
Imported import_file(const std::filesystem::path& path, std::uintmax_t size, const std::string& file) {
    std::string start(4096, '\0');
    std::ifstream stream(path, std::ios::binary);
    stream.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(stream.gcount()));
    if (has_extension(path, {".off"}) || starts_like_off(start)) {
        Imported imported;
        imported.meshes.push_back({read_off(file, read_file(path, size, file))});
        return imported;
    }
    const std::size_t first = start.find_first_not_of(" \t\r\n");
    if (is_gltf(path) || start.starts_with("glTF") || (first != start.npos && start[first] == '{')) {
        Metadata provenance;
        Imported imported =
            import_in_child(path, file, check_gltf(file, path.parent_path(), read_file(path, size, file), provenance));
        imported.provenance = std::move(provenance);
        return imported;
    }
    if (has_extension(path, {".ply"}) || starts_like_ply(start)) check_ply(file, read_file(path, size, file));
    return import_in_child(path, file, {});
}

Scene convert(Imported imported, const std::filesystem::path& path, const std::string& file) {
    Textures textures(std::move(imported.textures), path.parent_path(), file);
    Scene scene;
    scene.name = path.stem().string();
    scene.provenance = std::move(imported.provenance);
    for (ImportedMesh& part : imported.meshes) {
        Mesh& mesh = part.mesh;
        mesh.material.base_color_texture = textures[part.texture];
        if (mesh.texture_coordinates.empty()) mesh.material.base_color_texture = nullptr;
        if (part.is_unlit) {
            mesh.radiance.assign(mesh.positions.size(), mesh.material.base_color);
            for (std::size_t i = 0; i < std::min(mesh.colors.size(), mesh.radiance.size()); ++i)
                mesh.radiance[i] = mesh.radiance[i] * mesh.colors[i];
        }
        if (!mesh.triangles.empty()) scene.meshes.push_back(std::move(mesh));
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

Scene import_scene(const std::filesystem::path& path, const Progress& progress) {
    const core::StopScope scope(progress);
    const std::string file = path.string();
    const std::uintmax_t size = check_regular_file(path);
    try {
        const std::filesystem::path real = std::filesystem::canonical(path);
        return convert(import_file(real, size, file), real, file);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        reject_file(file, "needs more memory than available", "a smaller mesh");
    } catch (const std::exception& error) {
        reject_file(file, one_line(error.what()), "a readable mesh file");
    }
}

}  // namespace hogel
