// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hogel/scene/mesh_files/checks.h"

namespace hogel::scene::mesh_files {
namespace {

float unit(double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); }
float finite_float(double value) { return static_cast<float>(std::clamp(value, -1e3, 1e3)); }
float radiance(double value) { return static_cast<float>(std::clamp(value, 0.0, 1e6)); }

class MaterialReader {
  public:
    MaterialReader(const Gltf& gltf, const GltfBuffers& buffers, GltfMaterials& result)
        : gltf_(gltf), buffers_(buffers), result_(result) {}

    void read() {
        const Json& images = gltf_.list("images");
        for (std::size_t i = 0; i < images.size(); ++i) {
            const std::string where = fmt::format("images[{}]", i);
            result_.images.push_back(read_image(gltf_.object(images, i, where), where));
        }
        const Json& materials = gltf_.list("materials");
        for (std::size_t i = 0; i < materials.size(); ++i) {
            const std::string where = fmt::format("materials[{}]", i);
            result_.materials.push_back(read_material(gltf_.object(materials, i, where), where));
        }
    }

  private:
    TextureSource read_image(const Json& image, const std::string& where) {
        TextureSource source;
        source.name = where;
        if (const auto view = gltf_.reference(image, where, "bufferView", "bufferViews")) {
            source.kind = TextureSource::Kind::encoded;
            const std::string_view bytes = buffer_view(*view);
            // Limit the copies of shared data by thousands of pictures.
            picture_bytes_ += bytes.size();
            if (picture_bytes_ > max_shared * buffers_.bytes())
                gltf_.reject(where, fmt::format("and those before it have {} bytes", picture_bytes_),
                             fmt::format("at most {} times the {} of all buffers", max_shared, buffers_.bytes()));
            source.bytes.assign(bytes.begin(), bytes.end());
            return source;
        }
        const auto uri = image.find("uri");
        if (uri == image.end() || !uri->is_string())
            gltf_.reject(where, "has no picture", "a uri or the number of a bufferView");
        const std::string& name = uri->get_ref<const std::string&>();
        if (!name.starts_with("data:")) {
            source.name = name;
            return source;
        }
        source.kind = TextureSource::Kind::encoded;
        const std::string bytes = decode_data_uri(gltf_, name, where);
        source.bytes.assign(bytes.begin(), bytes.end());
        return source;
    }

    // Returns a buffer view, which check_accessors() has checked.
    std::string_view buffer_view(std::size_t number) const {
        const std::string where = fmt::format("bufferViews[{}]", number);
        const Json& view = gltf_.object(gltf_.list("bufferViews"), number, where);
        const std::string_view data = buffers_[*gltf_.reference(view, where, "buffer", "buffers")];
        const std::uint64_t offset = gltf_.number(view, where, "byteOffset", data.size(), 0);
        return data.substr(offset, gltf_.number(view, where, "byteLength", data.size() - offset));
    }

    GltfMaterial read_material(const Json& json, const std::string& where) {
        GltfMaterial read;
        Material& material = read.material;
        material.reflectance = 0.04f;
        static const Json none = Json::object();
        const Json* base = find_object(gltf_, json, where, {"pbrMetallicRoughness"});
        const std::string base_where = where + ".pbrMetallicRoughness";
        if (base == nullptr) base = &none;
        const auto color = numbers_or(gltf_, *base, base_where, "baseColorFactor", {1, 1, 1, 1});
        material.base_color = {unit(color[0]), unit(color[1]), unit(color[2])};
        material.alpha = unit(color[3]);
        material.metallic = unit(number_or(gltf_, *base, base_where, "metallicFactor", 1));
        material.roughness = unit(number_or(gltf_, *base, base_where, "roughnessFactor", 1));
        read.color = read_texture(*base, base_where, "baseColorTexture");
        read.metallic_roughness = read_texture(*base, base_where, "metallicRoughnessTexture");
        read_specular_glossiness(json, where, read);
        read_emission(json, where, read);
        read.normal = read_texture(json, where, "normalTexture");
        if (const Json* relief = find_object(gltf_, json, where, {"normalTexture"}))
            material.normal_scale = finite_float(number_or(gltf_, *relief, where + ".normalTexture", "scale", 1));
        read.occlusion = read_texture(json, where, "occlusionTexture");
        if (const Json* occlusion = find_object(gltf_, json, where, {"occlusionTexture"}))
            material.occlusion_strength =
                unit(number_or(gltf_, *occlusion, where + ".occlusionTexture", "strength", 1));
        read_alpha(json, where, material);
        read_sides(json, where, material);
        read_reflectance(json, where, material);
        read.is_unlit = find_object(gltf_, json, where, {"extensions", "KHR_materials_unlit"}) != nullptr;
        return read;
    }

    // Reads the older material model, which replaces the other.
    void read_specular_glossiness(const Json& json, const std::string& where, GltfMaterial& read) {
        const Json* old = find_object(gltf_, json, where, {"extensions", "KHR_materials_pbrSpecularGlossiness"});
        if (old == nullptr) return;
        const std::string location = where + ".extensions.KHR_materials_pbrSpecularGlossiness";
        const auto diffuse = numbers_or(gltf_, *old, location, "diffuseFactor", {1, 1, 1, 1});
        const auto specular = numbers_or(gltf_, *old, location, "specularFactor", {1, 1, 1});
        Material& material = read.material;
        material.base_color = {unit(diffuse[0]), unit(diffuse[1]), unit(diffuse[2])};
        material.alpha = unit(diffuse[3]);
        material.metallic = 0;
        material.reflectance = unit((specular[0] + specular[1] + specular[2]) / 3);
        material.roughness = 1 - unit(number_or(gltf_, *old, location, "glossinessFactor", 1));
        read.color = read_texture(*old, location, "diffuseTexture");
        read.metallic_roughness.reset();
    }

    void read_emission(const Json& json, const std::string& where, GltfMaterial& read) {
        const auto emission = numbers_or(gltf_, json, where, "emissiveFactor", {0, 0, 0});
        double strength = 1;
        if (const Json* object = find_object(gltf_, json, where, {"extensions", "KHR_materials_emissive_strength"}))
            strength =
                number_or(gltf_, *object, where + ".extensions.KHR_materials_emissive_strength", "emissiveStrength", 1);
        read.material.emission = {radiance(strength * emission[0]), radiance(strength * emission[1]),
                                  radiance(strength * emission[2])};
        if (read.material.emission != Rgb{0, 0, 0}) read.emission = read_texture(json, where, "emissiveTexture");
    }

    void read_alpha(const Json& json, const std::string& where, Material& material) const {
        const auto mode = json.find("alphaMode");
        if (mode != json.end()) {
            if (*mode == "MASK")
                material.alpha_mode = AlphaMode::mask;
            else if (*mode == "BLEND")
                material.alpha_mode = AlphaMode::blend;
            else if (*mode != "OPAQUE")
                gltf_.reject(where + ".alphaMode", "is unknown", "OPAQUE, MASK or BLEND");
        }
        material.alpha_cutoff = static_cast<float>(std::max(0.0, number_or(gltf_, json, where, "alphaCutoff", 0.5)));
    }

    void read_sides(const Json& json, const std::string& where, Material& material) const {
        const auto both = json.find("doubleSided");
        if (both == json.end()) return;
        if (!both->is_boolean()) gltf_.reject(where + ".doubleSided", "is neither true nor false", "one of them");
        material.double_sided = *both;
    }

    void read_reflectance(const Json& json, const std::string& where, Material& material) const {
        if (const Json* object = find_object(gltf_, json, where, {"extensions", "KHR_materials_ior"})) {
            const double ior = number_or(gltf_, *object, where + ".extensions.KHR_materials_ior", "ior", 1.5);
            const double r = (ior - 1) / (ior + 1);
            material.reflectance = ior > 0 ? unit(r * r) : 1;
        }
        if (const Json* object = find_object(gltf_, json, where, {"extensions", "KHR_materials_specular"}))
            material.reflectance *=
                unit(number_or(gltf_, *object, where + ".extensions.KHR_materials_specular", "specularFactor", 1));
    }

    std::optional<GltfTexture> read_texture(const Json& owner, const std::string& owner_where, const char* name) {
        const Json* info = find_object(gltf_, owner, owner_where, {name});
        if (info == nullptr) return std::nullopt;
        const std::string where = owner_where + "." + name;
        const auto number = gltf_.reference(*info, where, "index", "textures");
        if (!number) gltf_.reject(where + ".index", "missing", "the number of a texture");
        GltfTexture texture;
        std::uint64_t set = gltf_.number(*info, where, "texCoord", 1u << 16, 0);
        if (const Json* transform = find_object(gltf_, *info, where, {"extensions", "KHR_texture_transform"})) {
            const std::string transform_location = where + ".extensions.KHR_texture_transform";
            texture.matrix = read_transform(*transform, transform_location);
            set = gltf_.number(*transform, transform_location, "texCoord", 1u << 16, set);
        }
        if (set > 1) {
            result_.notes.push_back(
                fmt::format("{} has coordinates TEXCOORD_{}, of which only 0 and 1 are read: left out", where, set));
            return std::nullopt;
        }
        texture.set = static_cast<unsigned>(set);
        const std::string texture_location = fmt::format("textures[{}]", *number);
        const Json& object = gltf_.object(gltf_.list("textures"), *number, texture_location);
        const auto image = image_of(object, texture_location);
        if (!image) return std::nullopt;
        texture.image = static_cast<std::uint32_t>(*image);
        if (const auto sampler = gltf_.reference(object, texture_location, "sampler", "samplers"))
            texture.sampling = read_sampler(*sampler);
        return texture;
    }

    std::array<double, 6> read_transform(const Json& transform, const std::string& where) const {
        const auto offset = numbers_or(gltf_, transform, where, "offset", {0, 0});
        const auto scale = numbers_or(gltf_, transform, where, "scale", {1, 1});
        const double angle = number_or(gltf_, transform, where, "rotation", 0), c = std::cos(angle),
                     s = std::sin(angle);
        return {c * scale[0], s * scale[1], offset[0], -s * scale[0], c * scale[1], offset[1]};
    }

    // Returns nothing, with a note, if all pictures of the texture have an unsupported format.
    std::optional<std::size_t> image_of(const Json& texture, const std::string& where) {
        if (const auto image = gltf_.reference(texture, where, "source", "images")) return image;
        if (const Json* webp = find_object(gltf_, texture, where, {"extensions", "EXT_texture_webp"}))
            return gltf_.reference(*webp, where + ".extensions.EXT_texture_webp", "source", "images");
        const bool ktx = find_object(gltf_, texture, where, {"extensions", "KHR_texture_basisu"}) != nullptr;
        result_.notes.push_back(fmt::format(
            "{} {}: left out", where,
            ktx ? "is a KTX2 picture (KHR_texture_basisu), which is not read" : "has no picture that is read"));
        return std::nullopt;
    }

    TextureSampling read_sampler(std::size_t number) const {
        const std::string where = fmt::format("samplers[{}]", number);
        const Json& sampler = gltf_.object(gltf_.list("samplers"), number, where);
        constexpr std::uint64_t any = 1u << 16, nearest = 9728, linear = 9729, clamp = 33071, mirror = 33648,
                                repeat = 10497;
        const auto wrap = [&](const char* name) {
            const std::uint64_t mode = gltf_.number(sampler, where, name, any, repeat);
            if (mode != clamp && mode != mirror && mode != repeat)
                gltf_.reject(where + "." + name, fmt::format("is {}", mode), "33071, 33648 or 10497");
            return mode == clamp    ? TextureSampling::Wrap::clamp
                   : mode == mirror ? TextureSampling::Wrap::mirror
                                    : TextureSampling::Wrap::repeat;
        };
        return {wrap("wrapS"), wrap("wrapT"), gltf_.number(sampler, where, "magFilter", any, linear) == nearest};
    }

    static constexpr std::uint64_t max_shared = 16;
    const Gltf& gltf_;
    const GltfBuffers& buffers_;
    GltfMaterials& result_;
    std::uint64_t picture_bytes_ = 0;  // of pictures in views
};

}  // namespace

TextureCoordinate GltfTexture::at(TextureCoordinate mesh) const {
    const double u = mesh.u, v = 1 - double{mesh.v};
    return {static_cast<float>(matrix[0] * u + matrix[1] * v + matrix[2]),
            static_cast<float>(1 - (matrix[3] * u + matrix[4] * v + matrix[5]))};
}

double number_or(const Gltf& gltf, const Json& object, const std::string& where, const char* name, double fallback) {
    const auto found = object.find(name);
    if (found == object.end()) return fallback;
    if (!found->is_number() || !std::isfinite(found->get<double>()))
        gltf.reject(where + "." + name, "is not a number", "a finite one");
    return found->get<double>();
}

std::vector<double> numbers_or(const Gltf& gltf, const Json& object, const std::string& where, const char* name,
                               std::vector<double> fallback) {
    const auto found = object.find(name);
    if (found == object.end()) return fallback;
    const auto is_finite = [](const Json& value) { return value.is_number() && std::isfinite(value.get<double>()); };
    if (!found->is_array() || found->size() != fallback.size() || !std::ranges::all_of(*found, is_finite))
        gltf.reject(where + "." + name, "is no such list", fmt::format("{} finite numbers", fallback.size()));
    return found->get<std::vector<double>>();
}

const Json* find_object(const Gltf& gltf, const Json& object, const std::string& where,
                        std::initializer_list<const char*> path) {
    const Json* current = &object;
    std::string location = where;
    for (const char* name : path) {
        const auto found = current->find(name);
        if (found == current->end()) return nullptr;
        location += std::string(".") + name;
        if (!found->is_object()) gltf.reject(location, "is not an object", "one");
        current = &*found;
    }
    return current;
}

GltfMaterials read_materials(const Gltf& gltf, const GltfBuffers& buffers) {
    GltfMaterials result;
    MaterialReader(gltf, buffers, result).read();
    read_lights(gltf, result);
    note_what_is_left_out(gltf, result);
    return result;
}

}  // namespace hogel::scene::mesh_files
