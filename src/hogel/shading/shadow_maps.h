// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/shading/shadow_map.h"

namespace hogel::shading {

/// The shadow maps of all lamps of a scene, evaluated for many lamps at once.
class ShadowMaps {
  public:
    ShadowMaps() = default;
    explicit ShadowMaps(std::vector<ShadowMap> maps) { set(std::move(maps)); }

    void set(std::vector<ShadowMap> maps);
    /// Moves the maps out.
    std::vector<ShadowMap> release() { return std::move(maps_); }

    /// ShadowMap::visibility() of a point for several lamps. The twins give the same bits.
    /// @param lamps  indices of the lamps
    /// @param shares  receives one share per lamp
    void visibility_plain(std::span<const std::uint32_t> lamps, Vec3 point, Vec3 normal, float* shares) const;
    void visibility(std::span<const std::uint32_t> lamps, Vec3 point, Vec3 normal, float* shares) const;

    /// The data of the vector twin: those of point lights with shadows, and for other lamps values that are safe to
    /// evaluate.
    struct Table {
        using Doubles = std::vector<double, CacheLineAllocator<double>>;
        Doubles x, y, z, side;
        std::vector<const float*> depth;  ///< [face][row][column]
    };

  private:
    std::vector<ShadowMap> maps_;
    Table table_;
    std::vector<std::uint8_t> other_;  // whether a lamp needs the plain twin
    bool any_other_ = false;
};

}  // namespace hogel::shading
