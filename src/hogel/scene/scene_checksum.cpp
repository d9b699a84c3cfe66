// SPDX-License-Identifier: Apache-2.0
#include <initializer_list>
#include <map>
#include <span>

#include "hogel/core/checksum.h"
#include "hogel/scene.h"

namespace hogel {
namespace {

// Combined checksum of several arrays and their lengths.
class Checksums {
  public:
    // T must have no padding.
    template <class T>
    void add(std::span<const T> values) {
        sums_.push_back(core::checksum({reinterpret_cast<const std::uint8_t*>(values.data()), values.size_bytes()}));
        sums_.push_back(static_cast<std::uint32_t>(values.size()));
    }
    void add(std::initializer_list<double> numbers) { add(std::span(numbers.begin(), numbers.size())); }
    void add(const std::shared_ptr<const Image>& picture) {
        if (!picture) {
            sums_.push_back(0);
            return;
        }
        // Cached: meshes may share a picture.
        const auto [known, is_new] = pictures_.try_emplace(picture.get());
        if (is_new) {
            const std::span<const float> pixels = picture->pixels.elements();
            known->second = core::checksum({reinterpret_cast<const std::uint8_t*>(pixels.data()), pixels.size_bytes()});
        }
        sums_.push_back(known->second);
        for (const std::size_t extent : picture->pixels.shape()) sums_.push_back(static_cast<std::uint32_t>(extent));
    }
    std::uint32_t sum() const {
        return core::checksum({reinterpret_cast<const std::uint8_t*>(sums_.data()), sums_.size() * sizeof(sums_[0])});
    }

  private:
    std::vector<std::uint32_t> sums_;
    std::map<const Image*, std::uint32_t> pictures_;
};

// Adds attributes that most scenes do not have; absent ones do not change the checksum.
void add_optional_attributes(Checksums& sums, const Mesh& mesh) {
    const Material& m = mesh.material;
    const auto add = [&](const TextureSampling& sampling) {
        if (sampling == TextureSampling{}) return;
        sums.add(
            {static_cast<double>(sampling.wrap_u), static_cast<double>(sampling.wrap_v), sampling.nearest ? 1.0 : 0.0});
    };
    add(m.base_color_sampling);
    if (m.alpha_mode != AlphaMode::opaque) {
        sums.add({static_cast<double>(m.alpha_mode), m.alpha, m.alpha_cutoff});
        sums.add(std::span(mesh.alphas));
    }
    if (m.double_sided) sums.add({1.0});
    if (m.emission_texture) {
        sums.add(m.emission_texture);
        add(m.emission_sampling);
        sums.add(std::span(mesh.emission_coordinates));
    }
    if (m.metallic_roughness_texture) {
        sums.add(m.metallic_roughness_texture);
        add(m.metallic_roughness_sampling);
        sums.add(std::span(mesh.metallic_roughness_coordinates));
    }
    if (m.normal_texture) {
        sums.add(m.normal_texture);
        add(m.normal_sampling);
        sums.add({m.normal_scale});
        sums.add(std::span(mesh.normal_coordinates));
    }
    if (m.occlusion_texture) {
        sums.add(m.occlusion_texture);
        add(m.occlusion_sampling);
        sums.add({m.occlusion_strength});
        sums.add(std::span(mesh.occlusion_coordinates));
    }
}

}  // namespace

std::uint32_t checksum(const Scene& scene) {
    Checksums sums;
    for (const Mesh& mesh : scene.meshes) {
        sums.add(std::span(mesh.positions));
        sums.add(std::span(mesh.normals));
        sums.add(std::span(mesh.colors));
        sums.add(std::span(mesh.radiance));
        sums.add(std::span(mesh.texture_coordinates));
        sums.add(std::span(mesh.triangles));
        const Material& m = mesh.material;
        sums.add({m.base_color.r, m.base_color.g, m.base_color.b, m.reflectance, m.metallic, m.roughness, m.emission.r,
                  m.emission.g, m.emission.b});
        sums.add(m.base_color_texture);
        add_optional_attributes(sums, mesh);
    }
    for (const Light& l : scene.lights) {
        sums.add({static_cast<double>(l.kind), l.position.x, l.position.y, l.position.z, l.direction.x, l.direction.y,
                  l.direction.z, l.intensity.r, l.intensity.g, l.intensity.b, l.casts_shadows ? 1.0 : 0.0});
        if (l.kind == Light::Kind::point && l.outer_cone < std::numbers::pi) sums.add({l.inner_cone, l.outer_cone});
    }
    sums.add({scene.ambient.r, scene.ambient.g, scene.ambient.b, scene.background.r, scene.background.g,
              scene.background.b});
    return sums.sum();
}

}  // namespace hogel
