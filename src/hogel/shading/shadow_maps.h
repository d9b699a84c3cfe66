// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/shading/shadow_map.h"

namespace hogel::shading {

/// Shadow maps of all lamps of a scene, for evaluating many lamps at once.
class ShadowMaps {
  public:
    ShadowMaps() = default;
    explicit ShadowMaps(std::vector<ShadowMap> maps) { set(std::move(maps)); }

    void set(std::vector<ShadowMap> maps);
    std::vector<ShadowMap> release() { return std::move(maps_); }

    /// Computes ShadowMap::visibility() of a point for several lamps. Both versions give the same bits.
    /// @param lamps  indices of the lamps
    /// @param shares  receives one fraction per lamp
    void visibility_plain(std::span<const std::uint32_t> lamps, Vec3 point, Vec3 normal, float* shares) const;
    void visibility(std::span<const std::uint32_t> lamps, Vec3 point, Vec3 normal, float* shares) const;

    /// Data of the vector version for point lights with shadows; safe dummy values for other lamps.
    struct Table {
        using Doubles = std::vector<double, CacheLineAllocator<double>>;
        Doubles x, y, z, side;
        std::vector<const float*> depth;  ///< [face][row][column]
    };

  private:
    std::vector<ShadowMap> maps_;
    Table table_;
    std::vector<std::uint8_t> needs_plain_;  // whether a lamp needs the plain version
    bool any_needs_plain_ = false;
};

}  // namespace hogel::shading
