// SPDX-License-Identifier: Apache-2.0
#include "thesis/wavelets/transform.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "hogel/error.h"
#include "hogel/work/parallel.h"
#include "thesis/wavelets/dct.h"
#include "thesis/wavelets/line.h"

namespace hogel::wavelets {
namespace {

enum class Direction { forward, inverse };

// Lines along one axis in a box at the origin of the array; their indices increase fastest along the last other axis.
class Lines {
  public:
    Lines(std::vector<std::size_t> box, std::vector<std::size_t> strides, std::size_t axis)
        : box_(std::move(box)), strides_(std::move(strides)), axis_(axis) {
        box_[axis] = 1;
        for (std::size_t extent : box_) count_ *= extent;
    }
    std::size_t count() const { return count_; }
    std::size_t step() const { return strides_[axis_]; }
    // Returns the index of the first element of a line.
    std::size_t start(std::size_t line) const {
        std::size_t offset = 0;
        for (std::size_t axis = box_.size(); axis-- > 0;) {
            offset += line % box_[axis] * strides_[axis];
            line /= box_[axis];
        }
        return offset;
    }

  private:
    std::vector<std::size_t> box_, strides_;
    std::size_t axis_, count_ = 1;
};

// Transforms up to lane_count lines, given by the indices of their first elements.
template <class Plan>
void transform_tile(const Plan& plan, Direction direction, std::span<const std::size_t> starts, std::size_t step,
                    float* tile, float* elements) {
    bool adjacent = starts.size() == lane_count;
    for (std::size_t lane = 1; lane < starts.size(); ++lane) adjacent = adjacent && starts[lane] == starts[0] + lane;
    const auto element = [&](std::size_t lane, std::size_t sample) -> float& {
        return elements[starts[lane] + sample * step];
    };
    const auto copy_in = [&](std::size_t row, std::size_t sample) {
        float* out = tile + row * lane_count;
        if (adjacent)
            std::copy_n(&element(0, sample), lane_count, out);
        else
            for (std::size_t lane = 0; lane < starts.size(); ++lane) out[lane] = element(lane, sample);
    };
    const auto copy_out = [&](std::size_t row, std::size_t sample) {
        const float* in = tile + row * lane_count;
        if (adjacent)
            std::copy_n(in, lane_count, &element(0, sample));
        else
            for (std::size_t lane = 0; lane < starts.size(); ++lane) element(lane, sample) = in[lane];
    };
    if (direction == Direction::forward) {
        for (std::size_t row = 0; row < plan.length(); ++row) copy_in(row, plan.sample_of_row(row));
        plan.forward(tile);
        for (std::size_t row = 0; row < plan.length(); ++row) copy_out(row, row);
    } else {
        for (std::size_t row = 0; row < plan.length(); ++row) copy_in(row, row);
        plan.inverse(tile);
        for (std::size_t row = 0; row < plan.length(); ++row) copy_out(row, plan.sample_of_row(row));
    }
}

template <class Plan>
void transform_lines(const Plan& plan, Direction direction, const Lines& lines, std::span<float> elements) {
    // A task transforms several tiles, enough to outweigh its overhead.
    const std::size_t tiles = (lines.count() + lane_count - 1) / lane_count;
    const std::size_t batch = std::max<std::size_t>(1, (std::size_t{1} << 16) / (plan.length() * lane_count));
    work::parallel_for((tiles + batch - 1) / batch, [&](std::size_t task) {
        std::vector<float> tile(plan.length() * lane_count);
        std::array<std::size_t, lane_count> starts;
        for (std::size_t t = task * batch; t < std::min(tiles, (task + 1) * batch); ++t) {
            const std::size_t first = t * lane_count, count = std::min(lane_count, lines.count() - first);
            for (std::size_t lane = 0; lane < count; ++lane) starts[lane] = lines.start(first + lane);
            transform_tile(plan, direction, std::span(starts).first(count), lines.step(), tile.data(), elements.data());
        }
    });
}

// Transforms the axes of a group level by level, each in the coarse samples of the previous level. The axes of a level
// commute.
void transform_group(const Wavelet& wavelet, const Pyramid& pyramid, const AxisGroup& group, Direction direction,
                     std::span<float> elements) {
    std::vector<std::vector<WaveletLine>> lines;
    for (std::size_t axis : group.axes) lines.push_back(wavelet_levels(wavelet, pyramid.shape()[axis], group.levels));
    for (int i = 0; i < group.levels; ++i) {
        const int level = direction == Direction::forward ? i : group.levels - 1 - i;
        std::vector<std::size_t> box = pyramid.shape();
        for (std::size_t axis : group.axes) box[axis] = pyramid.coarse_extent(axis, level);
        for (std::size_t a = 0; a < group.axes.size(); ++a)
            if (static_cast<std::size_t>(level) < lines[a].size())
                transform_lines(lines[a][static_cast<std::size_t>(level)], direction,
                                Lines(box, pyramid.strides(), group.axes[a]), elements);
    }
}

void transform_blocks(const Pyramid& pyramid, Direction direction, std::span<float> elements) {
    for (const AxisGroup& group : pyramid.groups())
        for (std::size_t axis : group.axes)
            transform_lines(DctLine(pyramid.shape()[axis]), direction, Lines(pyramid.shape(), pyramid.strides(), axis),
                            elements);
}

void check_size(const Pyramid& pyramid, std::span<float> elements) {
    if (elements.size() != pyramid.size())
        throw Error(ErrorCode::usage, fmt::format("transform: {} elements given, expected the {} of the pyramid",
                                                  elements.size(), pyramid.size()));
}

}  // namespace

void Transform::forward(const Pyramid& pyramid, std::span<float> elements) const {
    check_size(pyramid, elements);
    if (!is_wavelet()) return transform_blocks(pyramid, Direction::forward, elements);
    for (const AxisGroup& group : pyramid.groups())
        transform_group(*wavelet_, pyramid, group, Direction::forward, elements);
}

void Transform::inverse(const Pyramid& pyramid, std::span<float> elements) const {
    check_size(pyramid, elements);
    if (!is_wavelet()) return transform_blocks(pyramid, Direction::inverse, elements);
    for (const AxisGroup& group : pyramid.groups())
        transform_group(*wavelet_, pyramid, group, Direction::inverse, elements);
}

std::vector<std::string_view> transform_names() {
    std::vector<std::string_view> names;
    for (const Wavelet& wavelet : wavelets()) names.push_back(wavelet.name);
    names.push_back("dct8");
    return names;
}

Transform transform(std::string_view name) {
    if (name == "dct8") return Transform(nullptr);
    for (const Wavelet& wavelet : wavelets())
        if (wavelet.name == name) return Transform(&wavelet);
    throw Error(
        ErrorCode::usage, "transform",
        fmt::format("transform '{}' is not known, expected one of {}", name, fmt::join(transform_names(), ", ")));
}

}  // namespace hogel::wavelets
