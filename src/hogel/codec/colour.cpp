#include "hogel/codec/colour_internal.h"

#include <cmath>

#include "hogel/core/parallel.h"

namespace hogel {
namespace {

constexpr float third = 0.57735026918962576f, half = 0.70710678118654752f, sixth = 0.40824829046386302f;
constexpr std::size_t batch = 1 << 16;

template <class Change>
void for_each_colour(View<float, 5> radiance, Change&& change) {
    if (radiance.extent(0) != 3) return;
    const std::size_t count = radiance.size() / 3;
    float *a = radiance[0].data(), *b = radiance[1].data(), *c = radiance[2].data();
    parallel_for((count + batch - 1) / batch, [&](std::size_t part) {
        const std::size_t end = part * batch + batch < count ? part * batch + batch : count;
        for (std::size_t i = part * batch; i < end; ++i) change(a[i], b[i], c[i]);
    });
}

}  // namespace

void separate_colours(View<float, 5> radiance) {
    for_each_colour(radiance, [](float& a, float& b, float& c) {
        const float red = a, green = b, blue = c;
        a = third * (red + green + blue);
        b = half * (red - blue);
        c = sixth * (red + blue - 2 * green);
    });
}

void join_colours(View<float, 5> radiance) {
    for_each_colour(radiance, [](float& a, float& b, float& c) {
        const float sum = third * a, across = half * b, between = sixth * c;
        a = sum + across + between;
        b = sum - 2 * between;
        c = sum - across + between;
    });
}

}  // namespace hogel
