// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "hogel/core/stop_scope.h"
#include "hogel/pipeline.h"

namespace hogel {
namespace {

// Returns the number m of hogels, out of `count`, at an odd step n around the middle. With s(i) = (i + ½ − count/2) d,
// hogel i' of m at the pitch n d is hogel i = n (i' + ½ − m/2) − ½ + count/2: a whole number for odd n if m and count
// are both even or both odd.
std::size_t remaining_count(std::size_t count, std::size_t n) {
    const std::size_t m = (count - 1) / n + 1;
    return m % 2 == count % 2 ? m : m - 1;
}

class EveryNth final : public LightFieldSource {
  public:
    EveryNth(LightField::Source source, std::size_t n) : source_(std::move(source)), n_(n), grid_(source_->grid()) {
        const LightFieldGrid& from = source_->grid();
        grid_.hogels_s = remaining_count(from.hogels_s, n);
        grid_.hogels_t = remaining_count(from.hogels_t, n);
        grid_.pitch = from.pitch * static_cast<double>(n);
        first_s_ = (from.hogels_s - 1 - n * (grid_.hogels_s - 1)) / 2;
        first_t_ = (from.hogels_t - 1 - n * (grid_.hogels_t - 1)) / 2;
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return source_->has_depth(); }

    void read(LightFieldTile& tile) const override {
        validate(tile, grid_);
        const bool with_depth = tile.depth.size() > 0 && has_depth();
        LightFieldTile hogel(source_->grid(), {0, 0, 1, 1}, with_depth);
        for (std::size_t t = 0; t < tile.range.nt; ++t)
            for (std::size_t s = 0; s < tile.range.ns; ++s) {
                core::throw_if_stopped();
                hogel.range = {first_s_ + n_ * (tile.range.s0 + s), first_t_ + n_ * (tile.range.t0 + t), 1, 1};
                source_->read(hogel);
                for (std::size_t c = 0; c < grid_.channels; ++c)
                    copy_hogel(hogel.radiance.view()[c][0][0], tile.radiance.view()[c][t][s]);
                if (with_depth) copy_hogel(hogel.depth.view()[0][0], tile.depth.view()[t][s]);
            }
    }

  private:
    static void copy_hogel(View<const float, 2> from, View<float, 2> to) {
        for (std::size_t i = 0; i < from.size(); ++i) to.data()[i] = from.data()[i];
    }

    LightField::Source source_;
    std::size_t n_;
    LightFieldGrid grid_;
    std::size_t first_s_ = 0, first_t_ = 0;  // index in the source of the first remaining hogel
};

}  // namespace

LightField every_nth_hogel(const LightField& light_field, std::size_t n) {
    if (n == 0) throw Error(ErrorCode::usage, "every 0th hogel: a whole number from 1 was expected");
    if (n == 1) return light_field;
    const std::size_t odd = n % 2 == 1 ? n : n + 1;
    const LightFieldGrid& grid = light_field.grid();
    // With an even number, at least the two middle hogels remain; they are closer than n hogels apart.
    if (remaining_count(grid.hogels_s, odd) == 0 || remaining_count(grid.hogels_t, odd) == 0)
        return n <= 3 ? light_field : every_nth_hogel(light_field, odd - 2);
    return light_field.wrapped([&](const LightField::Source& face) { return std::make_shared<EveryNth>(face, odd); });
}

}  // namespace hogel
