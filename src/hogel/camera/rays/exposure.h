// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hogel/array.h"
#include "hogel/camera.h"
#include "hogel/image.h"
#include "hogel/light_field.h"

namespace hogel::camera::rays {

/// A rectangle of hogels with all their directions, in a tile or in a light field that is in memory.
struct HogelBlock {
    HogelRange range;
    const float* radiance = nullptr;  ///< of the first channel of the first hogel
    std::size_t channel = 0;          ///< floats from one channel to the next
    std::size_t row = 0;              ///< from one row of hogels to the next
    std::size_t hogel = 0;            ///< from one hogel to the next
};

/// Returns the hogels of `range` in the radiances [c][t][s][v][u] of a face, or of a tile with the first hogel (s0,
/// t0).
HogelBlock block_of(View<const float, 5> radiance, std::size_t s0, std::size_t t0, const HogelRange& range);

/// A range of hogels of a face. The tile holds its samples unless the face is in memory.
struct LoadedHogels {
    LightFieldTile tile;
    HogelBlock block;
};
LoadedHogels load_hogels(const LightFieldSource& face, const HogelRange& range);

/// Samples [v][u][c][t][s] of a front, floats or halves: for each direction a picture with one pixel per hogel. A
/// viewpoint sees neighbouring hogels in nearly the same direction, so their samples are adjacent.
template <class Sample>
struct Views {
    const Sample* samples = nullptr;
};

/// Returns whether the direction of a ray from a hogel to a viewpoint has a column u that depends only on the hogel's
/// column, and a row v that depends only on its row. False for directions in sines.
inline bool is_separable(const LightFieldGrid& front) { return !front.has_frequencies(); }

enum class Implementation {
    fast,   ///< vector code, where columns and rows are separable
    plain,  ///< ray by ray
};

std::size_t bytes_of_rays(const LightFieldGrid& grid, const Camera& camera);

/// Maximum bytes of cached rays, of all points of all lenses.
constexpr std::size_t max_cached_ray_bytes = std::size_t{256} << 20;

/// Film of one camera, to which blocks of hogels add their rays. All lens points first sample the hogels of a block;
/// every pixel then interpolates between its neighbouring hogels.
class Exposure {
  public:
    Exposure(std::vector<LightFieldGrid> faces, const Camera& camera, std::size_t lens_count,
             Implementation implementation = Implementation::fast);

    /// Caches the rays of all lens points, which each block of hogels needs, if they take at most `bytes`.
    void cache_rays(std::size_t bytes) { max_cached_ = bytes; }

    /// Adds all rays of a face that cross the hologram plane in one of these cells: squares between four neighbouring
    /// hogels, named by their upper left hogel. The block holds these hogels and their right and lower neighbours.
    void add(std::size_t face, const HogelBlock& block, const HogelRange& cells);
    /// Adds the rays of a front with its views in memory, which is faster. Requires is_separable().
    void add(const Views<float>& views, const HogelRange& hogels, const HogelRange& cells);
    void add(const Views<std::uint16_t>& views, const HogelRange& hogels, const HogelRange& cells);

    void develop(Image& image) const;

    /// A point of the lens, metres from its centre, and the offset of its ray within each pixel, −½..½.
    struct LensPoint {
        double x, y, pixel_x, pixel_y;
    };

  private:
    // Interpolation positions along a line; those in [begin, end) lie within the samples.
    struct Run {
        std::size_t begin = 0, end = 0;
        std::size_t next = 1;  // stride to the higher neighbour; 0 for a single sample
        std::vector<std::int32_t> low;
        std::vector<float> high_weight;
        bool contains(std::size_t index) const { return index >= begin && index < end; }
        // Returns the part of [begin, end) in [first, last).
        std::pair<std::size_t, std::size_t> intersect(std::size_t first, std::size_t last) const;
        // Returns the part of [begin, end) with the lower neighbour in [first, first + count), for an ascending run.
        std::pair<std::size_t, std::size_t> interpolated_from(std::size_t first, std::size_t count) const;
    };
    // Positions of a lens point's rays: among directions for each hogel, and among hogels for each pixel.
    struct Rays {
        Run columns_of_directions, rows_of_directions, columns_of_hogels, rows_of_hogels;
    };

    static std::vector<LensPoint> lens_points(double pupil, std::size_t count);
    template <class Index>
    static Run make_run(std::size_t count, std::size_t samples, const Index& index);
    Rays rays_of(const LensPoint& point) const;
    void prepare(std::size_t first, std::size_t count);
    bool in_earlier_face(std::size_t face, Vec3 direction) const;
    void sample_hogels(std::size_t face, const HogelBlock& block, const LensPoint& point, View<float, 3> samples) const;
    void sample_row(const HogelBlock& block, std::size_t t, View<float, 4> samples) const;
    template <class Sample>
    void sample_row(const Views<Sample>& views, const HogelRange& range, std::size_t t, View<float, 4> samples) const;
    // Calls sampler(samples) for a range of hogels and batches of lens points, and exposes the pixels in the cells.
    template <class Sampler>
    void add_points(const HogelRange& range, const HogelRange& cells, const Sampler& sampler);
    void expose_row(std::size_t row, const HogelRange& range, const HogelRange& cells, View<const float, 4> samples);

    std::vector<LightFieldGrid> faces_;
    LightFieldGrid grid_;  // hogels and channels are the same for all faces
    Camera camera_;
    std::size_t max_cached_ = max_cached_ray_bytes;
    bool uses_vectors_;  // whether vector code samples the front
    std::vector<LensPoint> points_;
    std::vector<Rays> prepared_;  // of points from first_prepared_ on
    std::size_t first_prepared_ = 0;
    std::size_t first_ = 0;  // current batch: points [first_, first_ + rays_.size())
    std::span<const Rays> rays_;
    std::vector<float> samples_;
    Array<float, 3> film_;  // [c][row][column]
};

}  // namespace hogel::camera::rays
