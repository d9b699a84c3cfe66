// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/colour.h"

#include <algorithm>

#include "hogel/work/parallel.h"

namespace hogel::codec::format {
namespace {

constexpr float third = 0.57735026918962576f, half = 0.70710678118654752f, sixth = 0.40824829046386302f;
constexpr std::size_t colours_per_task = 1 << 16;

void separate(float& a, float& b, float& c) {
    const float red = a, green = b, blue = c;
    a = third * (red + green + blue);
    b = half * (red - blue);
    c = sixth * (red + blue - 2 * green);
}

void join(float& a, float& b, float& c) {
    const float sum = third * a, across = half * b, between = sixth * c;
    a = sum + across + between;
    b = sum - 2 * between;
    c = sum - across + between;
}

// Calls change() with the three channels of ranges of the tile, on all threads.
template <class Change>
void for_each_three_channels(View<float, 5> radiance, Change&& change) {
    if (radiance.extent(0) != 3) return;
    const std::size_t count = radiance.size() / 3;
    work::parallel_for((count + colours_per_task - 1) / colours_per_task, [&](std::size_t part) {
        const auto samples_of = [&](std::size_t channel) {
            return radiance[channel].elements().subspan(part * colours_per_task,
                                                        std::min(colours_per_task, count - part * colours_per_task));
        };
        change(samples_of(0), samples_of(1), samples_of(2));
    });
}

}  // namespace

void separate_colours(std::span<float> a, std::span<float> b, std::span<float> c) {
    for (std::size_t i = 0; i < a.size(); ++i) separate(a[i], b[i], c[i]);
}

void join_colours(std::span<float> a, std::span<float> b, std::span<float> c) {
    for (std::size_t i = 0; i < a.size(); ++i) join(a[i], b[i], c[i]);
}

void separate_colours(View<float, 5> radiance) {
    for_each_three_channels(radiance, [](auto a, auto b, auto c) { separate_colours(a, b, c); });
}

void join_colours(View<float, 5> radiance) {
    for_each_three_channels(radiance, [](auto a, auto b, auto c) { join_colours(a, b, c); });
}

}  // namespace hogel::codec::format
