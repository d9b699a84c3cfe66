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

/// `range` of the radiances [c][t][s][v][u] of a face, or of a tile whose first hogel is (s0, t0).
HogelBlock block_of(View<const float, 5> radiance, std::size_t s0, std::size_t t0, const HogelRange& range);

/// A range of hogels of a face, read into a tile of its own unless the face is in memory.
struct LoadedHogels {
    LightFieldTile tile;
    HogelBlock block;
};
LoadedHogels hold(const LightFieldSource& face, const HogelRange& range);

/// The samples [v][u][c][t][s] of a front: for each direction the view that all hogels show there, floats or halves.
/// Neighbouring hogels, of which an eye sees nearly the same direction, are side by side.
template <class Sample>
struct Views {
    const Sample* samples = nullptr;
};

/// Whether columns of directions depend on columns of hogels alone, and rows on rows. Not for directions in sines.
inline bool is_separable(const LightFieldGrid& front) { return !front.has_frequencies(); }

/// How hogels are looked at.
enum class Looking {
    fast,   ///< by vectors, where columns and rows are separable
    plain,  ///< ray by ray
};

/// Bytes of the rays of one point of the lens that an exposure prepares.
std::size_t bytes_of_rays(const LightFieldGrid& grid, const Camera& camera);

/// Bytes of the rays of all points of all lenses that are kept.
constexpr std::size_t max_kept_rays = std::size_t{256} << 20;

/// The film of one camera, to which the rays of one block of hogels after the other are added. All lens points see the
/// hogels first, and every pixel then gets the values between the hogels that it lies between.
class Exposure {
  public:
    Exposure(std::vector<LightFieldGrid> faces, const Camera& camera, std::size_t lens_count,
             Looking looking = Looking::fast);

    /// Keeps the rays of all points, which each block of hogels needs, if they take no more than so many bytes.
    void keep_rays(std::size_t bytes) { max_kept_ = bytes; }

    /// Adds all rays of a face that cross the hologram plane in a cell whose upper left hogel is in `cells`; the block
    /// holds these hogels and their right and lower neighbours.
    void add(std::size_t face, const HogelBlock& block, const HogelRange& cells);
    /// The same of a front whose views are in memory, which is faster. Only if the front is_separable().
    void add(const Views<float>& views, const HogelRange& hogels, const HogelRange& cells);
    void add(const Views<std::uint16_t>& views, const HogelRange& hogels, const HogelRange& cells);

    /// The mean over the lens points.
    void develop(Image& image) const;

    /// A point of the lens, metres from its centre, and the place of its ray within each pixel, −½..½.
    struct LensPoint {
        double x, y, pixel_x, pixel_y;
    };

  private:
    // Places between samples, of which those from `begin` to before `end` lie inside.
    struct Run {
        std::size_t begin = 0, end = 0;
        std::size_t next = 1;  // from a sample to its higher neighbour: 0 where there is but one sample
        std::vector<std::int32_t> low;
        std::vector<float> high_weight;
        bool has(std::size_t place) const { return place >= begin && place < end; }
        // The part of [begin, end) in [first, last).
        std::pair<std::size_t, std::size_t> within(std::size_t first, std::size_t last) const;
        // The part of [begin, end) whose lower neighbour is in [first, first + count), of a run that ascends.
        std::pair<std::size_t, std::size_t> between(std::size_t first, std::size_t count) const;
    };
    // Where a lens point's rays meet columns and rows of directions, hogel by hogel, and of hogels, pixel by pixel.
    struct Rays {
        Run columns_of_directions, rows_of_directions, columns_of_hogels, rows_of_hogels;
    };

    static std::vector<LensPoint> lens_points(double pupil, std::size_t count);
    template <class Index>
    static Run run(std::size_t places, std::size_t samples, const Index& index);
    Rays rays_of(const LensPoint& point) const;
    void prepare(std::size_t first, std::size_t count);
    bool shown_before(std::size_t face, Vec3 direction) const;
    void look(std::size_t face, const HogelBlock& block, const LensPoint& point, View<float, 3> seen) const;
    void look_along_row(const HogelBlock& block, std::size_t t, View<float, 4> seen) const;
    template <class Sample>
    void look_along_row(const Views<Sample>& views, const HogelRange& range, std::size_t t, View<float, 4> seen) const;
    // Lets `look(seen)` look at a range of hogels with some points of the lens after the other, and exposes the pixels
    // in the cells to what they have seen.
    template <class Look>
    void add_points(const HogelRange& range, const HogelRange& cells, const Look& look);
    void expose_row(std::size_t row, const HogelRange& range, const HogelRange& cells, View<const float, 4> seen);

    std::vector<LightFieldGrid> faces_;
    LightFieldGrid grid_;  // its hogels and channels are those of all faces
    Camera camera_;
    std::size_t max_kept_ = max_kept_rays;
    bool vectors_;  // whether the front is looked at by vectors
    std::vector<LensPoint> points_;
    std::vector<Rays> prepared_;  // of points from first_prepared_ on
    std::size_t first_prepared_ = 0;
    std::size_t first_ = 0;  // the points [first_, first_ + rays_.size()) are looked from
    std::span<const Rays> rays_;
    std::vector<float> seen_;
    Array<float, 3> film_;  // [c][row][column]
};

}  // namespace hogel::camera::rays
