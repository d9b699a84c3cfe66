// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/speckle_free/wave_powers.h"

namespace hogel::camera::speckle_free {

WavePowers::Counts WavePowers::counts() const {
    const Grid& plane = hogels_.grid.plane;
    return {plane.width / hogels_.columns, plane.height / hogels_.rows, hogels_.columns};
}

void WavePowers::read(const HogelRange& part, View<float, 2> out) const {
    if (hogels_.kept.size() > 0) {
        const std::size_t across = counts().across;
        for (std::size_t h = 0; h < part.hogels(); ++h)
            hogels_.waves->powers(hogels_.kept[(part.t0 + h / part.ns) * across + part.s0 + h % part.ns].elements(),
                                  &out(h, 0));
        return;
    }
    const Shape<2> shape{part.hogels(), hogels_.waves->prepared_size()};
    auto buffer = pool_.take();
    if (buffer->size() < shape[0] * shape[1]) *buffer = Array<float, 2>(shape);
    const View<float, 2> prepared(buffer->data(), shape);
    hogels_.prepare(part, prepared);
    for (std::size_t h = 0; h < part.hogels(); ++h) hogels_.waves->powers(prepared[h].elements(), &out(h, 0));
}

}  // namespace hogel::camera::speckle_free
