// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hogel/exchange/camera_frames.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

// Maximum offset of a picture, in pixels, from an ideal grid of parallel cameras.
constexpr double max_pixels_off = 0.5;
// Maximum offsets of a camera, relative to the spacing: from the common plane, and from its grid position.
constexpr double max_behind = 0.02, max_beside = 0.25, noted_beside = 0.01;

class Arrangement {
  public:
    Arrangement(const fs::path& file, const std::vector<CameraFrame>& frames, std::size_t width, std::size_t height)
        : file_(file), frames_(frames), width_(width), height_(height) {}

    CameraGrid made() {
        require_parallel();
        for (const CameraFrame& frame : frames_) {
            const Vec3 from = frame.position - frames_.front().position;
            const auto& axes = frames_.front().axes;
            positions_.push_back({dot(from, axes[0]), dot(from, axes[1]), dot(from, axes[2])});
        }
        std::vector<std::size_t> column, row;
        const auto range = [&](double Vec3::*axis) {
            const auto [low, high] = std::ranges::minmax(positions_, {}, axis);
            return high.*axis - low.*axis;
        };
        const double whole_range = std::max(range(&Vec3::x), range(&Vec3::y));
        grid_.columns = steps(&Vec3::x, whole_range, 1, column, spacing_x_);
        grid_.rows = steps(&Vec3::y, whole_range, -1, row, spacing_y_);
        put(row, column);
        require_places(row, column);
        find_plane();
        return std::move(grid_);
    }

  private:
    [[noreturn]] void fail(std::size_t frame, const std::string& why) const {
        fail_source(frames_[frame].picture, fmt::format("{} ({})", why, file_.filename().string()));
    }

    void require_parallel() const {
        const CameraFrame& first = frames_.front();
        std::size_t worst = 0;
        double largest = 0;
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            const CameraFrame& frame = frames_[i];
            if (std::abs(frame.focal_x / first.focal_x - 1) > 1e-3 ||
                std::abs(frame.focal_y / first.focal_y - 1) > 1e-3)
                fail(i, fmt::format("its focal length is {:.6g} pixels, but that of {} is {:.6g}", frame.focal_x,
                                    first.picture.filename().string(), first.focal_x));
            // |A - B|^2 over all elements is 8 sin^2 of half the angle between two rotations.
            double sum = 0;
            for (std::size_t axis = 0; axis < 3; ++axis)
                sum += dot(frame.axes[axis] - first.axes[axis], frame.axes[axis] - first.axes[axis]);
            const double angle = 2 * std::asin(std::min(1.0, std::sqrt(sum / 8)));
            if (angle > largest) largest = angle, worst = i;
        }
        if (largest * std::max(first.focal_x, first.focal_y) > max_pixels_off)
            fail(worst, fmt::format("its camera is turned by {:.3g} degrees against that of {}, but cameras of a light "
                                    "field are shifted and not turned: render them with parallel axes, or rectify the "
                                    "pictures",
                                    largest * 180 / std::numbers::pi, first.picture.filename().string()));
    }

    // Sorts the cameras into columns or rows by their positions along an axis, and computes the spacing of these.
    std::size_t steps(double Vec3::*axis, double whole_range, double sign, std::vector<std::size_t>& step_of,
                      double& spacing) const {
        std::vector<std::size_t> order(positions_.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::ranges::stable_sort(order, {}, [&](std::size_t i) { return sign * (positions_[i].*axis); });
        const auto position = [&](std::size_t i) { return sign * (positions_[order[i]].*axis); };
        double gap = 0;
        for (std::size_t i = 1; i < order.size(); ++i) gap = std::max(gap, position(i) - position(i - 1));
        step_of.assign(positions_.size(), 0);
        // Treat the cameras as a single row if its deviation is small relative to the camera spacing.
        if (position(order.size() - 1) - position(0) <
            0.5 * max_beside * whole_range / static_cast<double>(order.size())) {
            spacing = 0;
            return 1;
        }
        std::size_t step = 0;
        for (std::size_t i = 1; i < order.size(); ++i) {
            if (position(i) - position(i - 1) > 0.4 * gap) ++step;
            step_of[order[i]] = step;
        }
        spacing = (position(order.size() - 1) - position(0)) / static_cast<double>(step);
        return step + 1;
    }

    void put(const std::vector<std::size_t>& row, const std::vector<std::size_t>& column) {
        if (grid_.rows * grid_.columns > 2 * frames_.size() + 2)
            fail_source(file_, fmt::format("its {} cameras do not form a grid of rows and columns", frames_.size()));
        constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
        grid_.frames.assign(grid_.rows * grid_.columns, none);
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            std::size_t& slot = grid_.frames[row[i] * grid_.columns + column[i]];
            if (slot != none)
                fail(i,
                     fmt::format("its camera stands where that of {} does", frames_[slot].picture.filename().string()));
            slot = i;
        }
        const auto hole = std::ranges::find(grid_.frames, none);
        if (hole == grid_.frames.end()) return;
        const auto index = static_cast<std::size_t>(hole - grid_.frames.begin());
        fail_source(
            file_,
            fmt::format("no camera stands in row {} from the top and column {} from the left; there are {} of "
                        "{}x{}",
                        index / grid_.columns, index % grid_.columns, frames_.size(), grid_.columns, grid_.rows));
    }

    void require_places(const std::vector<std::size_t>& row, const std::vector<std::size_t>& column) {
        const double spacing = std::max(spacing_x_, spacing_y_);
        const auto middle = [&](double Vec3::*axis) {
            double sum = 0;
            for (const Vec3& position : positions_) sum += position.*axis;
            return sum / static_cast<double>(positions_.size());
        };
        const Vec3 center{middle(&Vec3::x), middle(&Vec3::y), middle(&Vec3::z)};
        const auto offset = [](std::size_t i, std::size_t n) {
            return static_cast<double>(i) - 0.5 * static_cast<double>(n - 1);
        };
        std::vector<double> depths;
        for (const Vec3& position : positions_) depths.push_back(position.z);
        std::ranges::nth_element(depths, depths.begin() + static_cast<long>(depths.size() / 2));
        const double plane = depths[depths.size() / 2];
        const auto behind = [&](const Vec3& position) { return std::abs(position.z - plane); };
        if (const auto worst = std::ranges::max_element(positions_, {}, behind); behind(*worst) > max_behind * spacing)
            fail(static_cast<std::size_t>(worst - positions_.begin()),
                 fmt::format(
                     "its camera stands {:.3g} {} the plane of the others, where {:.3g} are from one to the next",
                     behind(*worst), worst->z > plane ? "behind" : "before", spacing));
        double uneven = 0;
        std::size_t farthest = 0;
        for (std::size_t i = 0; i < positions_.size(); ++i) {
            const Vec3 off =
                positions_[i] - center -
                Vec3{offset(column[i], grid_.columns) * spacing_x_, -offset(row[i], grid_.rows) * spacing_y_, 0};
            const double beside = std::max(std::abs(off.x), std::abs(off.y)) / spacing;
            if (beside > uneven) uneven = beside, farthest = i;
        }
        if (uneven > max_beside)
            fail(farthest, fmt::format("its camera is {:.2f} spacings away from its grid position", uneven));
        if (uneven > noted_beside)
            grid_.notes.push_back(fmt::format(
                "cameras stand up to {:.2f} of their spacing beside even steps, at which they are taken to be",
                uneven));
        for (Vec3& position : positions_) position = position - center;
    }

    // Least squares for a, b, 1/D, where the camera at (x, y) has its picture centre at a + f x/D, b - f y/D.
    void find_plane() {
        const CameraFrame& first = frames_.front();
        double a = 0, b = 0, above = 0, below = 0;
        for (const CameraFrame& frame : frames_) {
            a += frame.center_x / static_cast<double>(frames_.size());
            b += frame.center_y / static_cast<double>(frames_.size());
        }
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            const double x = first.focal_x * positions_[i].x, y = -first.focal_y * positions_[i].y;
            above += x * (frames_[i].center_x - a) + y * (frames_[i].center_y - b);
            below += x * x + y * y;
        }
        const double inverse = above / below;
        double shift = 0, max_off = 0;
        std::size_t worst = 0;
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            const double dx = inverse * first.focal_x * positions_[i].x,
                         dy = -inverse * first.focal_y * positions_[i].y;
            const double off = std::max(std::abs(frames_[i].center_x - a - dx), std::abs(frames_[i].center_y - b - dy));
            if (off > max_off) max_off = off, worst = i;
            shift = std::max({shift, std::abs(dx), std::abs(dy)});
        }
        if (max_off > max_pixels_off)
            fail(worst,
                 fmt::format("its centre (cx, cy) is {:.3g} pixels away from that of a common zero-parallax plane",
                             max_off));
        ViewGeometry& geometry = grid_.geometry;
        constexpr double no_shift = 1e-3;  // pixels
        if (shift < no_shift)
            geometry.distance = std::numeric_limits<double>::infinity();
        else if (inverse < 0)
            fail_source(file_, "its pictures are shifted (cx, cy) so that they agree behind the cameras");
        else
            geometry.distance = 1 / inverse;
        geometry.spacing = grid_.columns > 1 ? spacing_x_ : spacing_y_;
        geometry.spacing_ratio = grid_.columns > 1 && grid_.rows > 1 ? spacing_y_ / spacing_x_ : 1;
        geometry.pixel_tangent = 1 / first.focal_x;
        geometry.pixel_height = first.focal_x / first.focal_y;
        geometry.center_u = (0.5 * static_cast<double>(width_) - a) / first.focal_x;
        geometry.center_v = (b - 0.5 * static_cast<double>(height_)) / first.focal_y;
    }

    const fs::path& file_;
    const std::vector<CameraFrame>& frames_;
    std::size_t width_, height_;
    std::vector<Vec3> positions_;  // right, up and backwards; finally relative to their mean
    double spacing_x_ = 0, spacing_y_ = 0;
    CameraGrid grid_;
};

}  // namespace

CameraGrid arrange(const fs::path& file, const std::vector<CameraFrame>& frames, std::size_t width,
                   std::size_t height) {
    return Arrangement(file, frames, width, height).made();
}

}  // namespace hogel::exchange
