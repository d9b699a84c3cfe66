// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/scene.h"
#include "hogel/shading/reflection.h"

namespace hogel::shading {

/// Lamps of a scene as a structure of arrays, padded with dark lamps to whole blocks.
class LampTable {
  public:
    static constexpr std::size_t block = 16;  ///< number of floats in the widest vector

    LampTable() = default;
    explicit LampTable(std::span<const Light> lights);

    std::size_t size() const { return x.size(); }

    using Numbers = std::vector<float, CacheLineAllocator<float>>;
    Numbers x, y, z;   ///< position of a point light, or the unit direction towards a directional one
    Numbers is_point;  ///< 1 for a point light, 0 for a directional one
    Numbers r, g, b;   ///< intensity
};

/// Point of a glossy surface and the direction to its viewer.
struct GlossyPoint {
    Vec3 position, normal, to_viewer;  ///< unit length
    double cos_view = 1;               ///< normal · to_viewer, above 0
    double roughness = 1;              ///< at least min_roughness
};

/// Returns the light that a point reflects by its glossy lobe: the sum of Reflection::lobe over the lamps, in single
/// precision. Both versions give the same bits, because they add in the same order: first the lamps with the same index
/// within their block, then these sums.
/// @param visibility  fraction of each lamp's light that arrives, `lamps.size()` values; ignored for the dark padding
///                    lamps
LightInLobe gloss_plain(const LampTable& lamps, const float* visibility, const GlossyPoint& point);
extern decltype(gloss_plain)& gloss;

struct GlossyFloats {
    float px, py, pz, nx, ny, nz, vx, vy, vz;
    float cos_view, alpha2, less_alpha2, masked_view;

    explicit GlossyFloats(const GlossyPoint& point);
};

/// Sums for each index of a block: scale r, g, b and offset r, g, b.
struct GlossySums {
    alignas(64) float values[6][LampTable::block] = {};

    LightInLobe total() const;
};

}  // namespace hogel::shading
