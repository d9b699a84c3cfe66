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

/// Direction of a window's Fourier transform, and the nearest ray of the light field.
struct WindowDirection {
    std::uint32_t coefficient;  // index [row][column] of the transform
    std::uint32_t ray;          // index [l][k] of the light field
    float share;                // |a|² for unit radiance, (λ/W)²/cos θ
    float U, V;
    double cycles_per_depth;  // 1/(λ cos θ)
    double first_cycles;      // phase at the window's first sample, relative to its centre
    // Three adjacent rays along U and along V, including this one, and U/ΔU and V/ΔV: for the surface's slope.
    std::array<std::uint32_t, 3> along_u, along_v;
    float slope_u, slope_v;
    std::uint32_t across, down;  // offsets of the direction's factors in the tables of WindowBrightness
};

/// Computes the windows of sixteen hogels side by side, one hogel per vector lane. Small transforms are plain sums over
/// all directions, so that all work is on whole vectors. Not thread-safe.
class WindowBatch {
  public:
    static constexpr std::size_t hogels = 16;
    /// Maximum side for which sums are faster than FFTs.
    static constexpr std::size_t max_side = 20;

    /// Constants that all windows of a hologram share. Sides and hops in samples.
    struct Shared {
        std::size_t side = 0, hop = 0;
        const std::vector<WindowDirection>* directions = nullptr;
        const WindowBrightness* brightness = nullptr;
        const std::vector<float>* window = nullptr;  // along one axis
        double hogels_a_metre = 0, waves_a_metre = 0, pitch = 0;
        double reference_cosine = 1;  // of the fan's middle, see OverlapAddHologram::cycles_of_point()
    };
    explicit WindowBatch(const Shared& shared);

    /// Computes the phases, in cycles, of the points at these columns and rows; empty if points have no phases.
    using PointCycles = std::function<void(const std::int32_t* columns, const std::int32_t* rows, float* cycles)>;
    /// The hogels, columns s, s + 1, … of row t, and the series of random phases of rays that meet no surface. The
    /// phase of a direction is the first word of Philox draw {s, t, coefficient + 1, series}.
    struct Start {
        std::size_t s = 0, t = 0;
        std::uint32_t series = 0;
        std::array<std::uint32_t, 2> key{};
    };

    /// Computes the windows of `count` hogels from their rays, [hogel][rays]. Returns false if all rays are dark.
    bool fill(const Start& start, const float* radiance, const float* depth, std::size_t count, std::size_t rays,
              const PointCycles& points);

    /// Samples that windows are added to. In a row, samples one hop apart are adjacent.
    struct Sum {
        // Relative to the first sample of the window of the hologram's first hogel.
        std::size_t first_x = 0, first_y = 0;
        // Number of rows; length of a row for one remainder modulo the hop, including all windows.
        std::size_t height = 0, length = 0;
        Array<float, 1> re, im;  // [height][hop][length]
    };
    /// Adds the windows of the last fill().
    void add(const Start& start, Sum& sum);

    // Buffers of the vector code. Lanes are hogels in all arrays.
    struct Work {
        std::size_t side, padded, hop;
        std::vector<std::uint32_t> rows;        // active rows of the transform
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
