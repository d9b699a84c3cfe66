// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "hogel/compress.h"
#include "hogel/light_field.h"

namespace hogel::codec::encode {

// How the depths of a light field stand in the stream behind its own: as a light field of one channel, each to within
// an error, in metres. Nothing at all, at infinity, stands there as a depth behind all others.
struct DepthCoding {
    double error = 0;    // metres
    double nothing = 0;  // stands for infinity
    double beyond = 0;   // from there on what is decoded is at infinity

    // For depths from `nearest` to `farthest`; an error of 0 is a 1,000th of their range.
    DepthCoding(double nearest, double farthest, double error_wanted);
};

// Looks through all depths. Throws Error(bad_input) for one that is not a number, or −∞.
DepthCoding depth_coding(std::span<const LightFieldSource* const> faces, double error_wanted);

// The depths of a light field as radiance of one channel.
std::unique_ptr<LightFieldSource> depth_as_radiance(const LightFieldSource& source, const DepthCoding& coding);

// Writes the stream of the depths alone. Throws Error(usage) where there are none, or for an impossible error.
StreamInfo::Depth compress_depth(std::span<const LightFieldSource* const> faces, const std::filesystem::path& path,
                                 const CompressionOptions& options);

}  // namespace hogel::codec::encode
