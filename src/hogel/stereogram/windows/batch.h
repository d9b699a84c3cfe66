// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "hogel/array.h"
#include "hogel/stereogram/windows/brightness.h"

namespace hogel::stereogram::windows {

/// A direction of a window's Fourier transform, with the ray of the light field nearest to it.
struct WindowDirection {
    std::uint32_t coefficient;  // index [row][column] of the transform
    std::uint32_t ray;          // index [l][k] of the light field
    float share;                // |a|² for unit radiance, (λ/W)²/cos θ
    float U, V;
    double cycles_per_depth;  // 1/(λ cos θ)
    double first_cycles;      // phase at the window's first sample, relative to its centre
    // Three adjacent rays along U and along V, with this one among them, and U/ΔU and V/ΔV: for the surface's slope.
    std::array<std::uint32_t, 3> along_u, along_v;
    float slope_u, slope_v;
    std::uint32_t across, down;  // where the direction's factors begin in the tables of WindowBrightness
};

/// Computes the windows of sixteen hogels side by side, one hogel per vector lane. Small transforms are computed as
/// plain sums over all directions, so that all work is on whole vectors.
class WindowBatch {
  public:
    static constexpr std::size_t hogels = 16;
    /// The largest side for which sums are faster than FFTs.
    static constexpr std::size_t max_side = 20;

    /// Constants that the windows of one hologram share. Sides and hops in samples.
    struct Shared {
        std::size_t side = 0, hop = 0;
        const std::vector<WindowDirection>* directions = nullptr;
        const WindowBrightness* brightness = nullptr;
        const std::vector<float>* window = nullptr;  // along one axis
        double hogels_a_metre = 0, waves_a_metre = 0, pitch = 0;
        double reference_cosine = 1;  // of the fan's middle, see OverlapAddHologram::cycles_of_point()
    };
    explicit WindowBatch(const Shared& shared);

    /// Gives the phases, in cycles, of the points of these columns and rows that the hogels see; empty if points have
    /// no phases.
    using PointCycles = std::function<void(const std::int32_t* columns, const std::int32_t* rows, float* cycles)>;
    /// The hogels, columns s, s + 1, … of row t, and the series of the random phases of rays that meet nothing; the
    /// phase of a direction is the first word of Philox's draw {s, t, coefficient + 1, series}.
    struct At {
        std::size_t s = 0, t = 0;
        std::uint32_t series = 0;
        std::array<std::uint32_t, 2> key{};
    };

    /// Computes the windows of `count` hogels from their rays, [hogel][rays]. Returns false if all rays are dark, so
    /// that there is nothing to add.
    bool fill(const At& at, const float* radiance, const float* depth, std::size_t count, std::size_t rays,
              const PointCycles& points);

    /// Samples to which windows are added. Real and imaginary parts are separate; in a row, samples that are one hop
    /// apart are adjacent.
    struct Sum {
        std::size_t first_x = 0,
                    first_y = 0;  // relative to the first sample of the window of the hologram's first hogel
        std::size_t height = 0,
                    row = 0;     // rows; samples of a row for one remainder modulo the hop, with room for all windows
        Array<float, 1> re, im;  // [height][hop][row]
    };
    /// Adds the windows of the last fill().
    void add(const At& at, Sum& sum);

    // Buffers of the vector code. In all arrays lanes are hogels.
    struct Work {
        std::size_t side, padded, hop;
        std::vector<std::uint32_t> rows;        // rows of the transform that have directions
        Array<float, 1> radiance, depth;        // [ray]
        Array<float, 1> re, im;                 // [row][column]
        Array<float, 1> across_re, across_im;   // [row][x], padded rows
        std::vector<float> roots_re, roots_im;  // e^{2πi kx/n}, [k][x], padded rows
        std::vector<float> weights;             // [q][p]
    };

  private:
    Shared shared_;
    Work work_;
};

}  // namespace hogel::stereogram::windows
