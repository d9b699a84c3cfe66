// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "hogel/compress.h"
#include "hogel/light_field.h"

namespace hogel::codec::encode {

// Coding of depths in the depth stream: as a light field of one channel with a bounded error. All values in metres.
struct DepthCoding {
    double error = 0;    // 0: exact
    double nothing = 0;  // depth that represents infinity, behind all others
    double beyond = 0;   // decoded depths of at least this value mean infinity

    // Coding of depths from `nearest` to `farthest` with this error bound; 0: exact.
    DepthCoding(double nearest, double farthest, double bound);
};

// Reads all depths and returns their coding. The default bound is default_depth_error(). Throws Error(bad_input) for a
// depth that is NaN or −∞.
DepthCoding depth_coding(const LightField& light_field, std::optional<double> bound);

// Returns the depths of a light field as radiance of one channel.
LightField depth_as_radiance(const LightField& light_field, const DepthCoding& coding);

// Codes the depth as a separate stream. Throws Error(usage) for a light field without depth and for an impossible
// error.
// @param code   writes the stream of a light field and returns its bytes
StreamInfo::Depth compress_depth(
    const LightField& light_field, const CompressionOptions& options,
    const std::function<std::uint64_t(const LightField&, const CompressionOptions&)>& code);

}  // namespace hogel::codec::encode
