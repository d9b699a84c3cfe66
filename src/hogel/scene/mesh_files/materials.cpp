// SPDX-License-Identifier: Apache-2.0
#include <assimp/material.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "hogel/error.h"
#include "hogel/scene/mesh_files/materials.h"

namespace hogel::scene::mesh_files {
namespace {

float reflectance(float value) { return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 0.8f; }
float unit(float value) { return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 1.0f; }
float radiance(float value) { return std::isfinite(value) ? std::clamp(value, 0.0f, 1e6f) : 0.0f; }

/// Decodes a URI: "my%20wood.png" is "my wood.png".
std::string percent_decoded(const std::string& text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        const char* digits = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
            decoded += static_cast<char>(value);
            i += 2;
        } else {
            decoded += text[i];
        }
    }
    return decoded;
}

Image from_texels(const aiTexture& source) {
    Image image(source.mWidth, source.mHeight, 3);
    for (std::size_t i = 0; i < image.width() * image.height(); ++i) {
        const aiTexel texel = source.pcData[i];
        float* pixel = image.pixels.data() + 3 * i;
        pixel[0] = srgb_decode(static_cast<float>(texel.r) / 255);
        pixel[1] = srgb_decode(static_cast<float>(texel.g) / 255);
        pixel[2] = srgb_decode(static_cast<float>(texel.b) / 255);
    }
    return image;
}

}  // namespace

MaterialImport::MaterialImport(const aiScene& source, const std::filesystem::path& folder, std::string file)
    : source_(source), files_(folder), folder_(folder), file_(std::move(file)) {}

const Material& MaterialImport::operator[](unsigned index) {
    const auto known = materials_.find(index);
    if (known != materials_.end()) return known->second;
    const bool exists = index < source_.mNumMaterials && source_.mMaterials[index];
    return materials_.emplace(index, exists ? read(*source_.mMaterials[index]) : Material{}).first->second;
}

Material MaterialImport::read(const aiMaterial& source) {
    Material material;
    aiString name;
    source.Get(AI_MATKEY_NAME, name);
    aiColor4D color;
    if (source.Get(AI_MATKEY_BASE_COLOR, color) == AI_SUCCESS ||
        (std::string_view(name.C_Str()) != AI_DEFAULT_MATERIAL_NAME &&
         source.Get(AI_MATKEY_COLOR_DIFFUSE, color) == AI_SUCCESS))
        material.base_color = {reflectance(color.r), reflectance(color.g), reflectance(color.b)};

    // Only glTF's materials are glossy. Metallic-roughness textures are not supported; materials with one are treated
    // as not metallic.
    float metallic = 1;
    if (source.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == AI_SUCCESS) {
        material.reflectance = 0.04f;
        material.metallic = source.GetTextureCount(aiTextureType_METALNESS) == 0 ? unit(metallic) : 0;
        float roughness = 1;
        if (source.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == AI_SUCCESS) material.roughness = unit(roughness);
    }

    // With an emission texture, which is not supported, the factor is ignored, because it would make the whole surface
    // emit.
    aiColor3D emission;
    if (source.GetTextureCount(aiTextureType_EMISSIVE) == 0 &&
        source.Get(AI_MATKEY_COLOR_EMISSIVE, emission) == AI_SUCCESS)
        material.emission = {radiance(emission.r), radiance(emission.g), radiance(emission.b)};

    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
        aiString path;
        if (source.GetTextureCount(type) == 0 || source.GetTexture(type, 0, &path) != AI_SUCCESS) continue;
        material.base_color_texture = texture(path.C_Str());
        break;
    }
    return material;
}

bool MaterialImport::is_unlit(unsigned index) const {
    int model = 0;
    return index < source_.mNumMaterials && source_.mMaterials[index] &&
           source_.mMaterials[index]->Get(AI_MATKEY_SHADING_MODEL, model) == AI_SUCCESS && model == aiShadingMode_Unlit;
}

std::shared_ptr<const Image> MaterialImport::texture(const std::string& name) {
    const auto [known, is_new] = textures_.emplace(name, nullptr);
    if (is_new) known->second = load(name);
    return known->second;
}

std::shared_ptr<const Image> MaterialImport::load(const std::string& name) const {
    if (const aiTexture* embedded = source_.GetEmbeddedTexture(name.c_str())) {
        const std::string where = fmt::format("{}: embedded texture '{}'", file_, name);
        if (!embedded->pcData || embedded->mWidth == 0)
            throw Error(ErrorCode::bad_input, where + ": empty; expected a picture");
        if (embedded->mHeight > 0) return std::make_shared<Image>(from_texels(*embedded));
        return std::make_shared<Image>(
            decode_image({reinterpret_cast<const unsigned char*>(embedded->pcData), embedded->mWidth}, where));
    }
    for (std::string candidate : {name, percent_decoded(name)}) {
        std::replace(candidate.begin(), candidate.end(), '\\', '/');
        if (candidate.find('\0') == std::string::npos && files_.contains(folder_ / candidate))
            return std::make_shared<Image>(read_image(folder_ / candidate));
    }
    throw Error(ErrorCode::bad_input,
                fmt::format("{}: texture '{}' not found; expected a file in the folder of the mesh", file_, name));
}

}  // namespace hogel::scene::mesh_files
