// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "hogel/compress.h"
#include "hogel/light_field.h"

namespace hogel::codec::encode {

// How depths are coded in the depth stream: as a light field of one channel, each within an error. All in metres.
struct DepthCoding {
    double error = 0;
    double nothing = 0;  // stands for infinity: a depth behind all others
    double beyond = 0;   // decoded depths from here on are infinity

    // For depths from `nearest` to `farthest`; an error of 0 is a 1,000th of their range.
    DepthCoding(double nearest, double farthest, double wanted_error);
};

// Reads all depths. Throws Error(bad_input) for one that is not a number, or −∞.
DepthCoding depth_coding(const LightField& light_field, double wanted_error);

// The depths of a light field as radiance of one channel.
LightField depth_as_radiance(const LightField& light_field, const DepthCoding& coding);

// Writes the depth stream to a file of its own. Throws Error(usage) where there are no depths, or for an impossible
// error.
StreamInfo::Depth compress_depth(const LightField& light_field, const std::filesystem::path& path,
                                 const CompressionOptions& options);

}  // namespace hogel::codec::encode
