// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <limits>

#include "hogel/shading/shadow_maps.h"

namespace hogel::shading {
namespace {

// Dummy map of one texel per face, for lamps with an unused result of the vector version.
constexpr float far = std::numeric_limits<float>::infinity();
constexpr std::array no_depth{far, far, far, far, far, far};

}  // namespace

void ShadowMaps::set(std::vector<ShadowMap> maps) {
    maps_ = std::move(maps);
    table_ = {};
    needs_plain_.clear();
    any_needs_plain_ = false;
    for (const ShadowMap& map : maps_) {
        const std::span<const float> faces = map.faces();
        const Vec3 origin = map.origin();
        table_.x.push_back(origin.x);
        table_.y.push_back(origin.y);
        table_.z.push_back(origin.z);
        table_.side.push_back(faces.empty() ? 1 : static_cast<double>(map.side()));
        table_.depth.push_back(faces.empty() ? no_depth.data() : faces.data());
        needs_plain_.push_back(faces.empty() ? 1 : 0);
        any_needs_plain_ |= faces.empty();
    }
}

void ShadowMaps::visibility_plain(std::span<const std::uint32_t> lamps, Vec3 point, Vec3 normal, float* shares) const {
    for (std::size_t i = 0; i < lamps.size(); ++i) shares[i] = maps_[lamps[i]].visibility(point, normal);
}

}  // namespace hogel::shading
