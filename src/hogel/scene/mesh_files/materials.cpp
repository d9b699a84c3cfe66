// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/materials.h"

#include <assimp/material.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "hogel/error.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/files.h"

namespace hogel::scene::mesh_files {
namespace {

float reflectance(float value) { return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 0.8f; }
float unit(float value) { return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 1.0f; }
float radiance(float value) { return std::isfinite(value) ? std::clamp(value, 0.0f, 1e6f) : 0.0f; }

std::string where(const std::string& file, const TextureSource& source) {
    return fmt::format("{}: embedded texture '{}'", file, source.name);
}

Image from_texels(const TextureSource& source) {
    Image image(source.width, source.height, 3);
    for (std::size_t i = 0; i < source.bytes.size(); ++i)
        image.pixels.data()[i] = srgb_decode(static_cast<float>(source.bytes[i]) / 255);
    return image;
}

}  // namespace

std::shared_ptr<const Image> white_picture() {
    static const auto picture = [] {
        auto image = std::make_shared<Image>(1, 1, 1);
        image->pixels(0, 0, 0) = 1;
        return image;
    }();
    return picture;
}

Material read_material(const aiMaterial& source) {
    Material material;
    aiString name;
    source.Get(AI_MATKEY_NAME, name);
    aiColor4D color;
    if (source.Get(AI_MATKEY_BASE_COLOR, color) == AI_SUCCESS ||
        (std::string_view(name.C_Str()) != AI_DEFAULT_MATERIAL_NAME &&
         source.Get(AI_MATKEY_COLOR_DIFFUSE, color) == AI_SUCCESS))
        material.base_color = {reflectance(color.r), reflectance(color.g), reflectance(color.b)};

    // Only glTF materials are glossy. read_materials() reads those of glTF 2. In glTF 1, materials with a
    // metallic-roughness texture, which is not supported, are not metallic.
    float metallic = 1;
    if (source.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == AI_SUCCESS) {
        material.reflectance = 0.04f;
        material.metallic = source.GetTextureCount(aiTextureType_METALNESS) == 0 ? unit(metallic) : 0;
        float roughness = 1;
        if (source.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == AI_SUCCESS) material.roughness = unit(roughness);
    }

    // Ignore the factor of an emission texture, which is not supported; the whole surface would emit.
    aiColor3D emission;
    if (source.GetTextureCount(aiTextureType_EMISSIVE) == 0 &&
        source.Get(AI_MATKEY_COLOR_EMISSIVE, emission) == AI_SUCCESS)
        material.emission = {radiance(emission.r), radiance(emission.g), radiance(emission.b)};
    return material;
}

bool is_unlit(const aiMaterial& source) {
    int model = 0;
    return source.Get(AI_MATKEY_SHADING_MODEL, model) == AI_SUCCESS && model == aiShadingMode_Unlit;
}

std::string base_color_texture(const aiMaterial& source) {
    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
        aiString path;
        if (source.GetTextureCount(type) > 0 && source.GetTexture(type, 0, &path) == AI_SUCCESS) return path.C_Str();
    }
    return {};
}

TextureSource find_texture(const aiScene& source, const std::string& name, const std::string& file) {
    TextureSource texture;
    texture.name = name;
    const aiTexture* embedded = source.GetEmbeddedTexture(name.c_str());
    if (!embedded) return texture;
    if (!embedded->pcData || embedded->mWidth == 0)
        throw Error(ErrorCode::bad_input, where(file, texture) + ": empty; expected a picture");
    if (embedded->mHeight == 0) {  // then the width is the size of an embedded picture file
        texture.kind = TextureSource::Kind::encoded;
        const auto* bytes = reinterpret_cast<const unsigned char*>(embedded->pcData);
        texture.bytes.assign(bytes, bytes + embedded->mWidth);
        return texture;
    }
    texture.kind = TextureSource::Kind::texels;
    texture.width = embedded->mWidth;
    texture.height = embedded->mHeight;
    for (std::size_t i = 0; i < std::size_t{texture.width} * texture.height; ++i)
        for (const unsigned char value : {embedded->pcData[i].r, embedded->pcData[i].g, embedded->pcData[i].b})
            texture.bytes.push_back(value);
    return texture;
}

Textures::Textures(std::vector<TextureSource> sources, std::filesystem::path folder, std::string file)
    : sources_(std::move(sources)), folder_(std::move(folder)), file_(std::move(file)) {}

std::shared_ptr<const Image> Textures::get(std::uint32_t number, image::TexturePixels pixels) {
    if (number >= sources_.size() || is_left_out(sources_[number])) return nullptr;
    auto& known = images_[{number, pixels}];
    if (!known) known = std::make_shared<Image>(load(sources_[number], pixels));
    return known;
}

std::shared_ptr<const Image> Textures::with_opacity(std::uint32_t color, std::uint32_t opacity) {
    const std::shared_ptr<const Image> alphas = get(opacity, image::TexturePixels::color_and_alpha);
    if (!alphas) return nullptr;
    auto& known = with_opacity_[{color, opacity}];
    if (known) return known;
    const bool has_alpha = alphas->channels() == 4;
    const std::shared_ptr<const Image> picture = get(color),
                                       brightness = has_alpha ? alphas : get(opacity, image::TexturePixels::numbers);
    const std::size_t width = picture ? picture->width() : alphas->width(),
                      height = picture ? picture->height() : alphas->height();
    auto combined = std::make_shared<Image>(width, height, 4);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            for (std::size_t c = 0; c < 3; ++c)
                combined->pixels(y, x, c) = picture ? picture->pixels(y, x, std::min(c, picture->channels() - 1)) : 1;
            const std::size_t row = (2 * y + 1) * brightness->height() / (2 * height),
                              column = (2 * x + 1) * brightness->width() / (2 * width);
            if (has_alpha) {
                combined->pixels(y, x, 3) = brightness->pixels(row, column, 3);
                continue;
            }
            float sum = 0;
            for (std::size_t c = 0; c < brightness->channels(); ++c) sum += brightness->pixels(row, column, c);
            combined->pixels(y, x, 3) = sum / static_cast<float>(brightness->channels());
        }
    return known = std::move(combined);
}

namespace {

/// Returns whether nearly all texels are opaque or transparent, as for leaves and fences.
bool is_cut_out(const Image& picture) {
    std::size_t between = 0;
    const std::size_t texels = picture.width() * picture.height();
    for (std::size_t i = 0; i < texels; ++i) {
        const float alpha = picture.pixels.data()[4 * i + 3];
        between += alpha > 0.1f && alpha < 0.9f ? 1 : 0;
    }
    return between <= texels / 20;
}

}  // namespace

void apply_obj_materials(ImportedMesh& part, Textures& textures) {
    Mesh& mesh = part.mesh;
    Material& material = mesh.material;
    const bool has_coordinates = !mesh.texture_coordinates.empty();
    if (has_coordinates)
        if (auto picture = textures.with_opacity(part.texture, part.opacity_texture)) {
            material.alpha_mode = material.alpha == 1 && is_cut_out(*picture) ? AlphaMode::mask : AlphaMode::blend;
            material.base_color_texture = std::move(picture);
        }
    if (material.alpha < 1) material.alpha_mode = AlphaMode::blend;
    if (material.emission == Rgb{0, 0, 0}) return;
    // The base-colour texture does not multiply emission.
    if (has_coordinates) material.emission_texture = textures.get(part.emission_texture);
    if (part.emission_texture != ImportedMesh::no_texture && has_coordinates && !material.emission_texture)
        material.emission = {0, 0, 0};  // the map is missing: do not let the whole surface emit
    if (!material.emission_texture && material.base_color_texture) material.emission_texture = white_picture();
}

/// Finds a picture by its name or, for a path on another machine, by the longest suffix that exists.
std::optional<std::filesystem::path> Textures::find(const TextureSource& source) const {
    constexpr int max_parts = 32;
    std::string name = source.name;
    for (int i = 0; i < max_parts; ++i) {
        if (auto path = find_in_folder(folder_, name)) return path;
        const std::size_t first = name.find_first_of("/\\");
        if (first == name.npos) break;
        name.erase(0, first + 1);
    }
    return std::nullopt;
}

bool Textures::is_left_out(const TextureSource& source) {
    if (!leaves_out_ || source.kind != TextureSource::Kind::file || find(source)) return false;
    missing_.insert(source.name);
    return true;
}

Image Textures::load(const TextureSource& source, image::TexturePixels pixels) const {
    if (source.kind == TextureSource::Kind::encoded)
        return image::decode_texture(source.bytes, where(file_, source), pixels);
    if (source.kind == TextureSource::Kind::texels) {
        if (source.bytes.size() != 3 * std::uint64_t{source.width} * source.height)
            throw Error(ErrorCode::bad_input, where(file_, source) + ": damaged; expected a picture");
        return from_texels(source);
    }
    if (const auto path = find(source)) return image::read_texture(*path, pixels);
    throw Error(
        ErrorCode::bad_input,
        fmt::format("{}: texture '{}' not found; expected a file in the folder of the mesh", file_, source.name));
}

}  // namespace hogel::scene::mesh_files
