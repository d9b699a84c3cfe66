// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/assimp_notes.h"

#include <assimp/material.h>
#include <fmt/format.h>

#include <array>
#include <map>
#include <set>
#include <utility>

namespace hogel::scene::mesh_files {
namespace {

constexpr std::array textures{std::pair{aiTextureType_OPACITY, "opacity maps"},
                              std::pair{aiTextureType_EMISSIVE, "emission maps"},
                              std::pair{aiTextureType_EMISSION_COLOR, "emission maps"},
                              std::pair{aiTextureType_NORMALS, "normal maps"},
                              std::pair{aiTextureType_NORMAL_CAMERA, "normal maps"},
                              std::pair{aiTextureType_HEIGHT, "bump maps"},
                              std::pair{aiTextureType_DISPLACEMENT, "displacement maps"},
                              std::pair{aiTextureType_SPECULAR, "maps of highlights"},
                              std::pair{aiTextureType_SHININESS, "maps of highlights"},
                              std::pair{aiTextureType_METALNESS, "maps of metal and roughness"},
                              std::pair{aiTextureType_DIFFUSE_ROUGHNESS, "maps of metal and roughness"},
                              std::pair{aiTextureType_AMBIENT, "maps of ambient light"},
                              std::pair{aiTextureType_AMBIENT_OCCLUSION, "occlusion maps"},
                              std::pair{aiTextureType_LIGHTMAP, "light maps"},
                              std::pair{aiTextureType_REFLECTION, "reflection maps"}};

using Counts = std::map<std::string, std::size_t>;

void count_material(const aiMaterial& material, Counts& counts) {
    std::set<std::string> has;
    for (const auto& [type, words] : textures)
        if (material.GetTextureCount(type) > 0) has.insert(words);
    float opacity = 1;
    if (material.Get(AI_MATKEY_OPACITY, opacity) == AI_SUCCESS && opacity < 1) has.insert("opacity");
    for (const std::string& words : has) ++counts[words];
}

}  // namespace

std::vector<std::string> notes_of(const aiScene& scene, bool materials) {
    std::vector<std::string> notes;
    std::size_t thin = 0, posed = 0, morphed = 0;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        const aiMesh& mesh = *scene.mMeshes[i];
        for (unsigned face = 0; face < mesh.mNumFaces; ++face) thin += mesh.mFaces[face].mNumIndices < 3 ? 1 : 0;
        posed += mesh.mNumBones > 0 ? 1 : 0;
        morphed += mesh.mNumAnimMeshes > 0 ? 1 : 0;
    }
    if (thin > 0) notes.push_back(fmt::format("{} points or lines are left out", thin));
    if (posed > 0) notes.push_back("skins are left out: meshes have the pose in which they were modelled");
    if (morphed > 0) notes.push_back("morph targets are left out: meshes have the shape that they begin with");
    if (scene.mNumAnimations > 0) notes.push_back("animations are left out: it stands still");
    const auto left_out = [&](unsigned count, const char* what) {
        if (count > 0) notes.push_back(fmt::format("{} {}{} left out", count, what, count == 1 ? " is" : "s are"));
    };
    left_out(scene.mNumLights, "light");
    left_out(scene.mNumCameras, "camera");
    if (!materials) return notes;
    Counts counts;
    for (unsigned i = 0; i < scene.mNumMaterials; ++i) count_material(*scene.mMaterials[i], counts);
    for (const auto& [words, count] : counts)
        notes.push_back(fmt::format("{} of {} material{} {} left out", words, count, count == 1 ? "" : "s",
                                    words == "opacity" ? "is" : "are"));
    return notes;
}

}  // namespace hogel::scene::mesh_files
