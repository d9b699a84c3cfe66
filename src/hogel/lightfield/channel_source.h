// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/light_field.h"

namespace hogel::lightfield {

/// A source that reads one channel for less than all of them: a file, which has one after the other. Holograms need one
/// for each wavelength.
class ChannelSource {
  public:
    virtual ~ChannelSource() = default;
    /// Fills `out`, [t][s][v][u], with the radiance of a channel of some hogels, without their depth.
    virtual void read_channel(std::size_t channel, const HogelRange& hogels, View<float, 4> out) const = 0;
};

}  // namespace hogel::lightfield
