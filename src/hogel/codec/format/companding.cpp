// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/companding.h"

#include <algorithm>

#include "hogel/codec/format/stream_file.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel::codec::format {
namespace {

constexpr std::size_t rays_per_task = 1 << 14;

float luminance(float red, float green, float blue) { return (red + green + blue) / 3; }

// Calls change() with the colours of ranges of the tile, as three spans or one, on all threads.
template <class Change>
void for_each_part(View<float, 5> radiance, Change&& change) {
    const std::size_t channels = radiance.extent(0), count = radiance.size() / channels;
    work::parallel_for((count + rays_per_task - 1) / rays_per_task, [&](std::size_t part) {
        const auto samples_of = [&](std::size_t channel) {
            return radiance[channel].elements().subspan(part * rays_per_task,
                                                        std::min(rays_per_task, count - part * rays_per_task));
        };
        if (channels == 3)
            change(samples_of(0), samples_of(1), samples_of(2));
        else
            change(samples_of(0));
    });
}

// Scales the colours of each ray by a factor, and the differences from their mean by a further factor.
// @param factor_of   returns the factor of a luminance
template <class Factor>
void scale(View<float, 5> radiance, Factor&& factor_of, float chrominance) {
    struct Scale {
        Factor& factor_of;
        float chrominance;
        void operator()(std::span<float> grey) const {
            for (float& value : grey) value *= factor_of(value);
        }
        void operator()(std::span<float> red, std::span<float> green, std::span<float> blue) const {
            for (std::size_t i = 0; i < red.size(); ++i) {
                const float mean = luminance(red[i], green[i], blue[i]), factor = factor_of(mean);
                for (float* value : {&red[i], &green[i], &blue[i]}) {
                    if (chrominance != 1) *value = mean + (*value - mean) * chrominance;
                    *value *= factor;
                }
            }
        }
    };
    for_each_part(radiance, Scale{factor_of, chrominance});
}

class CompandedSource final : public LightFieldSource {
  public:
    CompandedSource(LightField::Source source, const Companding& companding)
        : source_(std::move(source)), companding_(companding) {}
    const LightFieldGrid& grid() const override { return source_->grid(); }
    bool has_depth() const override { return source_->has_depth(); }
    HogelRange preferred_tile() const override { return source_->preferred_tile(); }
    void read(LightFieldTile& tile) const override {
        source_->read(tile);
        companding_.apply(tile.radiance.view());
    }

  private:
    LightField::Source source_;
    Companding companding_;
};

void count(const LightFieldTile& tile, LuminanceHistogram& histogram) {
    const std::size_t rays = tile.radiance.size() / tile.radiance.extent(0);
    const float* const red = tile.radiance.data();
    if (tile.radiance.extent(0) == 3)
        for (std::size_t i = 0; i < rays; ++i) histogram.add(luminance(red[i], red[rays + i], red[2 * rays + i]));
    else
        for (std::size_t i = 0; i < rays; ++i) histogram.add(red[i]);
}

}  // namespace

void Companding::apply(View<float, 5> radiance) const {
    const auto factor = [&](float mean) { return tone ? tone->factor(mean) : 1.0f; };
    if (changes()) scale(radiance, factor, 1 / chrominance);
}

void Companding::undo(View<float, 5> radiance) const {
    const auto factor = [&](float mean) { return tone ? tone->inverse_factor(mean) : 1.0f; };
    if (changes()) scale(radiance, factor, chrominance);
}

LightField companded(const LightField& light_field, const Companding& companding) {
    return light_field.wrapped(
        [&](const LightField::Source& face) { return std::make_shared<CompandedSource>(face, companding); });
}

LuminanceHistogram luminance_histogram(const LightField& light_field, const Progress& progress) {
    const std::span<const LightField::Source> faces = light_field.faces();
    LuminanceHistogram sum;
    const work::Sent<LuminanceHistogram> sent{
        [](work::MessageWriter& to, const LuminanceHistogram& histogram) { to.put(histogram.counts()); },
        [](work::MessageReader& from) { return LuminanceHistogram(from.get_vector<std::uint64_t>()); }};
    for (std::size_t face = 0; face < faces.size(); ++face) {
        const LightFieldGrid& grid = faces[face]->grid();
        const Tiling tiling(grid, faces[face]->preferred_tile());
        work::ordered_reduce<LuminanceHistogram>(
            tiling.count(), work::default_in_flight(), sent,
            [&](std::size_t i) {
                LightFieldTile tile(grid, tiling[i], false);
                faces[face]->read(tile);
                LuminanceHistogram histogram;
                count(tile, histogram);
                return histogram;
            },
            [&](std::size_t i, LuminanceHistogram& histogram) {
                sum.add(histogram);
                progress.report((static_cast<double>(face) + static_cast<double>(i + 1) / double(tiling.count())) /
                                static_cast<double>(faces.size()));
            });
    }
    work::broadcast_result(sum, sent);
    return sum;
}

}  // namespace hogel::codec::format
