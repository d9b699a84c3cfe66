// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/scene.h"
#include "hogel/shading/reflection.h"

namespace hogel::shading {

/// The lamps of a scene, number by number, filled up with dark ones to whole blocks.
class LampTable {
  public:
    static constexpr std::size_t block = 16;  ///< as many floats as the widest vector has

    explicit LampTable(std::span<const Light> lights);

    std::size_t size() const { return x.size(); }

    using Numbers = std::vector<float, CacheLineAllocator<float>>;
    Numbers x, y, z;  ///< where a lamp is, or the unit direction towards a distant one
    Numbers near;     ///< 1; 0 for a distant one
    Numbers r, g, b;  ///< intensity
};

/// A point of a glossy surface and who looks at it.
struct GlossyPoint {
    Vec3 position, normal, to_viewer;  ///< unit length
    double cos_view = 1;               ///< normal · to_viewer, above 0
    double roughness = 1;              ///< at least min_roughness
};

/// The light in the lobe, the sum of Reflection::lobe over the lamps, in single precision.
/// @param lit  how far each lamp gets to the point; `lamps.size()` numbers, of which only those of lamps count
/// Twins that give the same bits: they sum up what is the same number in all blocks, and then the sums.
LightInLobe gloss_plain(const LampTable& lamps, const float* lit, const GlossyPoint& point);
LightInLobe gloss(const LampTable& lamps, const float* lit, const GlossyPoint& point);

/// A point's numbers as the twins need them.
struct GlossyFloats {
    float px, py, pz, nx, ny, nz, vx, vy, vz;
    float cos_view, alpha2, less_alpha2, masked_view;

    explicit GlossyFloats(const GlossyPoint& point);
};

/// Sums for each lamp of a block: scale r, g, b and offset r, g, b.
struct GlossySums {
    alignas(64) float values[6][LampTable::block] = {};

    LightInLobe total() const;
};

}  // namespace hogel::shading
