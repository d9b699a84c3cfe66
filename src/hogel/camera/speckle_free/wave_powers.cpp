// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/speckle_free/wave_powers.h"

namespace hogel::camera::speckle_free {

WavePowers::Counts WavePowers::counts() const {
    const Grid& plane = hogels_.grid.plane;
    return {plane.width / hogels_.columns, plane.height / hogels_.rows, hogels_.columns};
}

void WavePowers::read(const HogelRange& range, View<float, 2> out) const {
    if (hogels_.kept.size() > 0) {
        const std::size_t across = counts().across;
        for (std::size_t h = 0; h < range.hogels(); ++h)
            hogels_.waves->powers(hogels_.kept[(range.t0 + h / range.ns) * across + range.s0 + h % range.ns].elements(),
                                  &out(h, 0));
        return;
    }
    const Shape<2> shape{range.hogels(), hogels_.waves->prepared_size()};
    auto buffer = pool_.take();
    if (buffer->size() < shape[0] * shape[1]) *buffer = Array<float, 2>(shape);
    const View<float, 2> prepared(buffer->data(), shape);
    hogels_.prepare(range, prepared);
    for (std::size_t h = 0; h < range.hogels(); ++h) hogels_.waves->powers(prepared[h].elements(), &out(h, 0));
}

}  // namespace hogel::camera::speckle_free
