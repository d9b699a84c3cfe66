// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "hogel/compress.h"
#include "hogel/light_field.h"

namespace hogel::codec::encode {

// How depths are coded in the depth stream: as a light field of one channel with a bounded error. All values in metres.
struct DepthCoding {
    double error = 0;
    double nothing = 0;  // the depth behind all others that represents infinity
    double beyond = 0;   // decoded depths of this value or more mean infinity

    // For depths from `nearest` to `farthest`. An error of 0 means a 1,000th of their range.
    DepthCoding(double nearest, double farthest, double wanted_error);
};

// Reads all depths. Throws Error(bad_input) for one that is not a number, or −∞.
DepthCoding depth_coding(const LightField& light_field, double wanted_error);

// The depths of a light field as radiance of one channel.
LightField depth_as_radiance(const LightField& light_field, const DepthCoding& coding);

// Writes the depth stream to a separate file. Throws Error(usage) for a light field without depth and for an impossible
// error.
StreamInfo::Depth compress_depth(const LightField& light_field, const std::filesystem::path& path,
                                 const CompressionOptions& options);

}  // namespace hogel::codec::encode
