// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "hogel/scene/shapes.h"
#include "showpieces/masonry.h"

/// Dimensions and parts of the church. Its length runs along x, the altar to the right; the nave lies between z =
/// -nave_half and nave_half, the aisle behind it; the near half is cut away. Lengths are arbitrary.
namespace hogel::showpieces {

inline constexpr std::size_t bays = 6;
inline constexpr double bay_length = 3.3, half_length = 0.5 * bay_length * bays;
inline constexpr double nave_half = 3.2, aisle_back = 6.2, aisle_height = 4.6;
inline constexpr double triforium_low = 5.35, triforium_high = 6.5, springing = 9.0, apse_springing = 7.4;
inline constexpr double vault_cut = 1.75;  ///< angle at which the vault ends; its crown is at π/2

inline constexpr double bay_start(std::size_t bay) { return -half_length + bay_length * static_cast<double>(bay); }

/// Returns a point (z, y) of the vault at an angle (0 at the far wall) and a height above its inner surface.
inline std::pair<double, double> vault(double angle, double above) {
    const double radius = nave_half + above;
    return {-radius * std::cos(angle), springing + radius * std::sin(angle)};
}

inline constexpr std::size_t pendants = 2 * bays, altar_candles = 5;
/// Return the positions of the lamps in the nave, and of the feet of the candles on the altar.
inline Vec3 pendant(std::size_t i) {
    return {bay_start(0) + 0.5 * bay_length * (static_cast<double>(i) + 0.5), 5.6, -1.55};
}
inline Vec3 altar_candle(std::size_t i) { return {half_length + 1.35, 1.72, -0.9 + 0.45 * static_cast<double>(i)}; }

/// Adds panes with leads, in four colours, in an opening at a depth behind the wall.
void add_stained_glass(std::array<scene::MeshBuilder, 4>& glass, const Frame& wall, const Opening& opening,
                       double depth, std::uint32_t number);
void add_stars(scene::MeshBuilder& stars);
/// Adds the tiles of the floor, and the slab under the church.
void add_floor(scene::MeshBuilder& floor);
void add_slab(scene::MeshBuilder& slab);
void add_pews(scene::MeshBuilder& wood);
/// Adds steps, altar, candles and cross, and the rail in front of them.
void add_choir(Masonry& masonry, scene::MeshBuilder& wood, scene::MeshBuilder& brass, scene::MeshBuilder& flames);
void add_pendants(scene::MeshBuilder& brass, scene::MeshBuilder& globes);

}  // namespace hogel::showpieces
