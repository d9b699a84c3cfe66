// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "hogel/codec/format/block_kernels.h"
#include "hogel/codec/format/hogel_order.h"

namespace hogel::codec::format {

// Samples of one channel of a hogel, [v][u], padded to whole blocks: in owned, uninitialised memory, or in memory of
// the caller.
class Plane {
  public:
    std::size_t width, height;
    std::span<float> samples;

    Plane(std::size_t w, std::size_t h, std::pmr::memory_resource* memory = std::pmr::get_default_resource())
        : width(w), height(h), owned_(allocate(w * h, memory)) {
        samples = {owned_.get(), w * h};
    }
    Plane(std::size_t w, std::size_t h, float* external) : width(w), height(h), samples(external, w * h) {}

  private:
    struct Return {
        std::pmr::memory_resource* memory;
        std::size_t bytes;
        void operator()(float* lent) const { memory->deallocate(lent, bytes, alignment); }
    };
    using Owned = std::unique_ptr<float, Return>;
    static constexpr std::size_t alignment = 64;
    static Owned allocate(std::size_t count, std::pmr::memory_resource* memory) {
        const std::size_t bytes = count * sizeof(float);
        return Owned(static_cast<float*>(memory->allocate(bytes, alignment)), Return{memory, bytes});
    }

    Owned owned_{nullptr, Return{}};
};

// Window of a plane; beyond its borders the plane repeats its outermost samples. Refers to the plane, or to a copy if
// it crosses a border.
class PlaneWindow {
  public:
    // @param columns, rows   at most window_side
    PlaneWindow(const Plane& plane, std::ptrdiff_t x, std::ptrdiff_t y, std::size_t columns, std::size_t rows) {
        const auto width = static_cast<std::ptrdiff_t>(plane.width), height = static_cast<std::ptrdiff_t>(plane.height);
        if (x < 0 || y < 0 || x + static_cast<std::ptrdiff_t>(columns) > width ||
            y + static_cast<std::ptrdiff_t>(rows) > height) {
            copy(plane, x, y, columns, rows);
            return;
        }
        rows_ = &plane.samples[static_cast<std::size_t>(y * width + x)];
        stride_ = plane.width;
    }
    const float* rows() const { return rows_; }
    std::size_t stride() const { return stride_; }
    PlaneWindow(const PlaneWindow&) = delete;
    PlaneWindow& operator=(const PlaneWindow&) = delete;

  private:
    void copy(const Plane& plane, std::ptrdiff_t x, std::ptrdiff_t y, std::size_t columns, std::size_t rows);

    const float* rows_;
    std::size_t stride_;
    std::array<float, window_side * window_side> copy_;
};

// Shift of a block's content in another hogel, in 64ths of a direction along u and v.
constexpr int shift_unit = 64;
struct Shift {
    int u = 0, v = 0;
};

// The disparity is the shift of a block's content from one hogel to the next, in 64ths of a direction along u: 64 d/(ζ
// ΔU). Along v the shift is larger by the factor `aspect` = ΔU/ΔV.
constexpr int max_disparity = 1 << 14;
inline Shift shift_of(int disparity, const HogelOrder::Reference& reference, float aspect) {
    if (reference.dt == 0) return {-disparity * reference.ds, 0};
    if (aspect == 1) return {-disparity * reference.ds, -disparity * reference.dt};
    const double v = std::floor(static_cast<double>(-disparity * reference.dt) * static_cast<double>(aspect) + 0.5);
    return {-disparity * reference.ds, static_cast<int>(std::clamp(v, -1e9, 1e9))};
}

// Reads the block at (x, y) of a plane shifted by `shift`, interpolated by six taps; beyond its borders the plane
// repeats its outermost samples. The order of the additions is part of the format.
void fetch_warped(const Plane& plane, int x, int y, Shift shift, BlockSamples& block);

// Range of blocks read by fetch_warped() for the block in a column and row.
struct BlockRange {
    std::size_t first_column, last_column, first_row, last_row;
};
BlockRange fetched_blocks(std::size_t columns, std::size_t rows, std::size_t column, std::size_t row, Shift shift);

// Selects the references for the prediction of a block: those with the least expected noise at its disparity.
class ReferenceWeights {
  public:
    // @param noise   quantisation noise of each hogel of the order, relative to the noise of the first layer
    ReferenceWeights(const HogelOrder::Hogel& hogel, std::span<const float> noise, float aspect);

    enum class Side { any, left, right, above, below };
    static constexpr std::size_t sides = 5;
    struct Choice {
        std::uint32_t count;
        std::array<std::uint32_t, 2> reference;  // indices of hogel.references
        std::array<float, 2> weight;             // their sum is 1
        std::array<Shift, 2> shift;
    };
    // Returns the best two references for any side, the best one for a single side, none if there is no reference.
    // Valid until the next call.
    const Choice& choose(int disparity, Side side) { return choices_for(disparity)[static_cast<std::size_t>(side)]; }

  private:
    using Choices = std::array<Choice, sides>;
    struct Cached {
        int disparity;
        Choices choices;
    };
    struct Fixed {
        float cost;  // noise that does not depend on the shift
        Side side;
    };

    const Choices& choices_for(int disparity);

    const HogelOrder::Hogel& hogel_;
    std::vector<Fixed> fixed_;  // one per reference
    float aspect_;
    // Cached, because neighbouring blocks often have the same disparity.
    static constexpr std::size_t cached_choices = 64;
    std::unique_ptr<Cached[]> cache_;
};

}  // namespace hogel::codec::format
