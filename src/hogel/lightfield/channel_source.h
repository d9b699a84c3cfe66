// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/light_field.h"

namespace hogel::lightfield {

/// A source that reads one channel cheaply: a file. Holograms need one channel per wavelength.
class ChannelSource {
  public:
    virtual ~ChannelSource() = default;
    /// Fills `out`, [t][s][v][u], with the radiance of one channel of a hogel range, without depth.
    virtual void read_channel(std::size_t channel, const HogelRange& hogels, View<float, 4> out) const = 0;
};

}  // namespace hogel::lightfield
