// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include "hogel/camera/film/film.h"
#include "hogel/camera/film/interpolation.h"
#include "hogel/camera/film/lanes.h"
#include "hogel/camera/film/lens.h"
#include "hogel/camera/film/merged_weights.h"
#include "hogel/core/object_pool.h"
#include "hogel/photograph.h"
#include "hogel/work/parallel.h"

namespace hogel::camera::film {
namespace {

// Maximum difference of positions, in rows, of columns with the same weights, for which three nodes suffice.
constexpr double max_group_spread = 0.15;

// Computes the mean of a pixel first down the film's columns, with constant n_x and n_y = √(1 − n_x²) · (y − c_y)/√((y
// − c_y)² + c_z²) on each, and then along its rows, sixteen lines at a time.
class Development {
  public:
    Development(const FilmAxis& x, const FilmAxis& y, const Camera& camera, const Rectangle& shown, double wavelength)
        : x_(x), y_(y), picture_(camera.picture), eye_(camera.eye) {
        const double cell = resolution_cell(camera, wavelength);
        points_x_ = gauss_points(picture_.pitch_x / cell);
        points_y_ = gauss_points(picture_.pitch_y / cell);
        for (std::size_t a = 0; a < points_x_; ++a) {
            const auto is_shown = [&](std::size_t column) {
                const double position = picture_.x(pixel_position(column, a, points_x_));
                return position >= shown.left && position < shown.right;
            };
            Range range;
            while (range.begin < picture_.width && !is_shown(range.begin)) ++range.begin;
            for (range.end = range.begin; range.end < picture_.width && is_shown(range.end);) ++range.end;
            shown_.push_back(range);
        }
        for (std::size_t row = 0; row < picture_.height; ++row) {
            sines_.emplace_back();
            for (std::size_t b = 0; b < points_y_; ++b) {
                const double position = picture_.y(pixel_position(row, b, points_y_)), dy = position - eye_.y;
                if (position >= shown.bottom && position < shown.top)
                    sines_.back().push_back(dy / std::hypot(dy, eye_.z) / y_.step);
            }
        }
        for (std::size_t i = 0; i < optics::blocks_of(x_.count) * optics::block_lines; ++i) {
            const double sine = x_.low + static_cast<double>(i) * x_.step;
            slopes_.push_back(std::sqrt(std::max(0.0, 1 - sine * sine)));
        }
        make_groups();
    }

    double points() const { return static_cast<double>(points_x_ * points_y_); }

    struct Scratch {
        MergedWeights weights;
        std::vector<MergedWeights::Point> points;
        Array<float, 2> rows;        // [picture row][column of the film]
        Array<float, 1> transposed;  // [column of the film][picture row]
        Array<float, 2> pixels;      // [picture column][picture row]
    };

    // Develops at most sixteen rows of the picture from `first` on.
    void develop(View<const float, 2> blocks, std::size_t first, float scale, Scratch& scratch, Image& image) const {
        const std::size_t rows = std::min(optics::block_lines, picture_.height - first), width = slopes_.size();
        if (scratch.rows.size() == 0) {
            scratch.rows = Array<float, 2>({optics::block_lines, width});
            scratch.transposed = Array<float, 1>({width * optics::block_lines});
            scratch.pixels = Array<float, 2>({picture_.width, optics::block_lines});
        }
        for (std::size_t row = 0; row < rows; ++row) sum_down(blocks, first + row, scratch, scratch.rows[row]);
        for (std::size_t block = 0; block < width; block += optics::block_lines)
            transpose_block(&scratch.rows(0, block), width, optics::block_lines,
                            &scratch.transposed(block * optics::block_lines));
        sum_along(first, rows, scale, scratch);
        for (std::size_t row = 0; row < rows; ++row)
            for (std::size_t column = 0; column < picture_.width; ++column)
                image.pixels(first + row, column, 0) += std::max(scratch.pixels(column, row), 0.0f);
    }

  private:
    struct Range {
        std::size_t begin = 0, end = 0;
    };
    // Blocks of columns with points on nearly the same rows.
    struct Group {
        std::size_t begin, end;
        double low, high;  // slopes
    };

    static double pixel_position(std::size_t pixel, std::size_t point, std::size_t count) {
        return static_cast<double>(pixel) + gauss_position(point, count);
    }

    void make_groups() {
        double farthest = 0;
        for (const auto& row : sines_)
            for (const double sine : row) farthest = std::max(farthest, std::abs(sine));
        for (std::size_t block = 0; block < slopes_.size() / optics::block_lines; ++block) {
            const auto block_slopes = std::span(slopes_).subspan(block * optics::block_lines, optics::block_lines);
            const auto [low, high] = std::ranges::minmax(block_slopes);
            if (!groups_.empty()) {
                Group& last = groups_.back();
                const double all_low = std::min(low, last.low), all_high = std::max(high, last.high);
                if (farthest * (all_high - all_low) <= max_group_spread) {
                    last = {last.begin, block + 1, all_low, all_high};
                    continue;
                }
            }
            groups_.push_back({block, block + 1, low, high});
        }
    }

    // Computes the sums over the points of a row of the picture down each column of the film.
    void sum_down(View<const float, 2> blocks, std::size_t row, Scratch& scratch, View<float, 1> out) const {
        const double offset = -y_.low / y_.step;
        const auto place_points = [&](double low, double high) {
            scratch.points.clear();
            for (const double sine : sines_[row])
                scratch.points.push_back({offset + sine * low, offset + sine * high, 1, 1});
        };
        for (const Group& group : groups_) {
            const Lines lines{0, optics::block_lines, group.low, group.high};
            place_points(lines.low, lines.high);
            const bool merged = scratch.weights.set(scratch.points, y_.count);
            for (std::size_t block = group.begin; block < group.end; ++block) {
                const std::size_t first = block * optics::block_lines;
                const auto slopes = std::span(slopes_).subspan(first).first<optics::block_lines>();
                if (merged)
                    sum(&blocks(block, 0), slopes, lines, scratch.weights, &out(first));
                else
                    sum_lines(&blocks(block, 0), y_.count, slopes, lines, place_points, scratch, &out(first));
            }
        }
    }

    // Computes the sums over the points of each pixel of several rows along the lines, times r³.
    void sum_along(std::size_t first, std::size_t rows, float scale, Scratch& scratch) const {
        double squares[optics::block_lines];
        for (std::size_t row = 0; row < optics::block_lines; ++row) {
            const double dy = picture_.y(static_cast<double>(first + std::min(row, rows - 1))) - eye_.y;
            squares[row] = dy * dy + eye_.z * eye_.z;
        }
        for (std::size_t column = 0; column < picture_.width; ++column) {
            const auto place_points = [&](double low, double high) {
                scratch.points.clear();
                for (std::size_t a = 0; a < points_x_; ++a) {
                    if (column < shown_[a].begin || column >= shown_[a].end) continue;
                    const double right = picture_.x(pixel_position(column, a, points_x_)) - eye_.x;
                    const double low_square = right * right + low, high_square = right * right + high;
                    const double low_r = std::sqrt(low_square), high_r = std::sqrt(high_square);
                    scratch.points.push_back({(right / low_r - x_.low) / x_.step, (right / high_r - x_.low) / x_.step,
                                              scale * static_cast<float>(low_square * low_r),
                                              scale * static_cast<float>(high_square * high_r)});
                }
            };
            sum_lines(scratch.transposed.data(), x_.count, squares, {0, optics::block_lines}, place_points, scratch,
                      &scratch.pixels(column, 0));
        }
    }

    // A range of sixteen lines, and the minimum and maximum of the values that determine positions.
    struct Lines {
        std::size_t begin = 0, end = 0;
        double low = 0, high = 0;
    };

    static void sum(const float* samples, std::span<const double, optics::block_lines> values, const Lines& lines,
                    const MergedWeights& weights, float* out) {
        alignas(64) float t[optics::block_lines] = {}, sums[optics::block_lines];
        for (std::size_t line = lines.begin; line < lines.end; ++line)
            t[line] = line_position(values[line], lines.low, lines.high);
        sum_merged(samples, weights, t, sums);
        std::copy(sums + lines.begin, sums + lines.end, out + lines.begin);
    }

    // Computes the weighted sums; splits the range in halves if positions differ too much.
    template <class PlacePoints>
    static void sum_lines(const float* samples, std::size_t size, std::span<const double, optics::block_lines> values,
                          const Lines& lines, const PlacePoints& place_points, Scratch& scratch, float* out) {
        const auto [low, high] = std::ranges::minmax(values.subspan(lines.begin, lines.end - lines.begin));
        place_points(low, high);
        if (scratch.weights.set(scratch.points, size))
            return sum(samples, values, {lines.begin, lines.end, low, high}, scratch.weights, out);
        const std::size_t middle = (lines.begin + lines.end) / 2;
        sum_lines(samples, size, values, {lines.begin, middle}, place_points, scratch, out);
        sum_lines(samples, size, values, {middle, lines.end}, place_points, scratch, out);
    }

    FilmAxis x_, y_;
    Grid picture_;
    Vec3 eye_;
    std::size_t points_x_ = 0, points_y_ = 0;  // of a pixel
    std::vector<Range> shown_;                 // columns of the picture, for each point across a pixel
    std::vector<std::vector<double>> sines_;   // [row of the picture]: of its points, in samples
    std::vector<double> slopes_;               // [column of the film]
    std::vector<Group> groups_;
};

}  // namespace

void Film::develop(View<const float, 2> blocks, const Camera& camera, const Rectangle& shown, double weight,
                   Image& image) const {
    const Development development(size_.x, size_.y, camera, shown, hologram_.wavelength);
    // A diffuse surface of radiance L sends L cos θ · (area of the pupil) cos θ/r² through this band, and its plane
    // waves have 1/cos θ of that as |F|² (docs/notation.md section 4). So the film shows radiance times (area of the
    // pupil) cos θ/r², with cos θ = c_z/r.
    const double area = FilmLens(size_.sines, hologram_.wavelength, camera).area();
    const auto scale = static_cast<float>(weight / (area * camera.eye.z * development.points()));
    core::ObjectPool<Development::Scratch> pool;
    work::parallel_for(optics::blocks_of(camera.picture.height), [&](std::size_t block) {
        auto scratch = pool.take();
        development.develop(blocks, block * optics::block_lines, scale, *scratch, image);
    });
}

}  // namespace hogel::camera::film
