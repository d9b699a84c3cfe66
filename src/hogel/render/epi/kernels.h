// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hogel::render::epi {

/// What is left of a triangle in an epipolar plane: the segment between two points (x, z), in the units of an
/// EpipolarFrame. Column n sees point p in direction K if n = c_p(K), c_p(K) = x_p − K z_p. The strip covers sample (n,
/// K) if n lies in (c, c'], where c and c' are the smaller and the larger of c_0 and c_1. Whether n > c_p depends on
/// the point alone, so of strips that share a point none leaves a sample out and no two have it.
struct Strip {
    float x0, z0, x1, z1;
};

/// What a strip shows: values that are linear along it from its end 0 to its end 1. The background is one, too. A whole
/// cache line, so that one load brings all of it.
struct alignas(64) StripShades {
    float x0, z0, dx, dz;            ///< end 0, and the way to end 1
    float value0[4], difference[4];  ///< R, G, B (or the only channel first), depth ζ in metres
    float unused[4] = {};            ///< fills the line
};

/// Samples of a column that lie side by side, of which it is known how far the farthest of them is.
constexpr std::size_t cell_directions = 16;

/// What is known of the cells of a plane, columns fastest; those at the columns' ends may be smaller.
struct PlaneCells {
    /// A depth (ordered bits) for each beyond which none of its samples sees anything; all ones where one may have seen
    /// nothing yet. Some more behind the last may be read.
    std::vector<std::uint32_t> farthest;
    /// How often something has been drawn into one since, as far as it is known.
    std::size_t drawn = 0;

    static std::size_t rows(std::size_t directions) { return (directions + cell_directions - 1) / cell_directions; }
    /// Nothing has been drawn into so many samples.
    void clear(std::size_t columns, std::size_t directions);
};

/// The samples (n, k) of one epipolar plane, k fastest: in each word what is seen first so far, as its depth and the
/// number of its strip.
struct EpipolarPlane {
    std::uint64_t* words;
    PlaneCells* cells;
    std::size_t columns, directions;
    std::int32_t first_column;  ///< n of the first column
    float first_direction;      ///< K of k = 0
    bool fronts_only = false;   ///< whether strips cover samples only where c_0 < c_1: who sees their fronts

    static constexpr std::size_t spare = 64;    ///< so many words behind the last one are there, and stay as they are
    static constexpr std::uint32_t nobody = 0;  ///< strips are numbered from 1
    static constexpr std::uint64_t nothing = ~std::uint64_t{0} << 32 | nobody;
};

/// The bits of a float such that unsigned comparison orders them as the floats, also below zero.
constexpr std::uint32_t ordered_bits(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return bits ^ (bits >> 31 != 0 ? 0xffffffffu : 0x80000000u);
}

/// Where the values of a plane's samples go: the row of directions of column c begins at values[i] + c · strides[i],
/// for each value i of StripShades; null for a value that nobody wants.
struct ShadedPlane {
    float* values[4];
    std::size_t strides[4];

    /// Whether all rows begin at multiples of so many floats.
    bool begins_at_multiples(std::size_t floats) const {
        for (int i = 0; i < 4; ++i)
            if (reinterpret_cast<std::uintptr_t>(values[i]) % (floats * sizeof(float)) != 0 || strides[i] % floats != 0)
                return false;
        return true;
    }
};

/// The inner loops, each plain and as fast as this processor allows. The twins give the same bits: they do the same
/// operations in the same order, none of them fused, and where vector code finds candidates by a shorter way it finds
/// too many and puts them to the same test.

/// Draws strips number `first`, first + 1, … into a plane: wherever strip i is nearer than what is there (or as near,
/// with a smaller number), the word becomes ordered_bits(z) · 2³² + i. What the cells say is hidden may be passed over.
void draw_plain(std::span<const Strip> strips, std::size_t first, const EpipolarPlane& plane);
void draw(std::span<const Strip> strips, std::size_t first, const EpipolarPlane& plane);

/// Takes into the cells of a plane what has been drawn by now.
void find_farthest_plain(const EpipolarPlane& plane);
void find_farthest(const EpipolarPlane& plane);

/// The values of what each sample of the plane sees, by the numbers of the strips. Afterwards nothing is seen in it.
void shade_plain(const EpipolarPlane& plane, std::span<const StripShades> strips, const ShadedPlane& out);
void shade_scene(const EpipolarPlane& plane, std::span<const StripShades> strips, const ShadedPlane& out);

/// The instruction sets of this processor that the vector kernels are built for, and a way to use but one of them, or
/// with 0 the best again: for tests. Not while kernels run.
std::vector<std::int64_t> kernel_targets();
void use_kernel_target(std::int64_t target);

/// How far along a strip column n sees it in direction K, from 0 to 1.
inline float part_of_strip(const StripShades& strip, float n, float K) {
    const float part = ((n - strip.x0) + K * strip.z0) / (strip.dx - K * strip.dz);
    // Also where there is no way to divide by.
    const float positive = part > 0 ? part : 0;
    return positive < 1 ? positive : 1;
}

}  // namespace hogel::render::epi
