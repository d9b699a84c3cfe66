// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/shading/shadow_map.h"

namespace hogel::shading {

/// The shadow maps of all lamps of a scene, for looking into many of them at once.
class ShadowMaps {
  public:
    explicit ShadowMaps(std::vector<ShadowMap> maps);

    /// How much of the light of these lamps arrives at a point of a surface, as ShadowMap::lit has it. Twins that give
    /// the same bits.
    /// @param lamps  their numbers
    /// @param shares  gets one for each
    void lit_plain(std::span<const std::uint32_t> lamps, Vec3 point, Vec3 normal, float* shares) const;
    void lit(std::span<const std::uint32_t> lamps, Vec3 point, Vec3 normal, float* shares) const;

    /// What the vector twin knows of lamps around which there are six faces; of others only so much that it may look.
    struct Table {
        using Doubles = std::vector<double, CacheLineAllocator<double>>;
        Doubles x, y, z, side;
        std::vector<const float*> depth;  ///< [face][row][column]
    };

  private:
    std::vector<ShadowMap> maps_;
    Table table_;
    std::vector<std::uint8_t> other_;  // whether a lamp is not for the vector twin
    bool any_other_ = false;
};

}  // namespace hogel::shading
