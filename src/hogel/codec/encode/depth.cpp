// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/codec/encode/depth.h"
#include "hogel/codec/format/stream_file.h"
#include "hogel/compress.h"
#include "hogel/core/parallel.h"
#include "hogel/error.h"

namespace hogel::codec::encode {

using namespace format;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// The range of finite depths; nearest > farthest if there are none.
struct Range {
    float nearest = infinity, farthest = -infinity;

    void include(const Range& other) {
        nearest = std::min(nearest, other.nearest);
        farthest = std::max(farthest, other.farthest);
    }
};

Range depths_of(const LightFieldSource& source, const HogelRange& range) {
    LightFieldTile tile(source.grid(), range, true);
    source.read(tile);
    Range depths;
    for (const float depth : tile.depth.elements()) {
        if (depth == infinity) continue;
        if (!std::isfinite(depth))
            throw Error(ErrorCode::bad_input,
                        fmt::format("depth is {} in hogels {} to {} of rows {} to {}, expected a number or infinity",
                                    depth, range.s0, range.s0 + range.ns - 1, range.t0, range.t0 + range.nt - 1));
        depths.include({depth, depth});
    }
    return depths;
}

class DepthAsRadiance final : public LightFieldSource {
  public:
    DepthAsRadiance(LightField::Source source, const DepthCoding& coding)
        : source_(std::move(source)), grid_(source_->grid()), nothing_(static_cast<float>(coding.nothing)) {
        grid_.channels = 1;
    }

    const LightFieldGrid& grid() const override { return grid_; }
    HogelRange preferred_tile() const override { return source_->preferred_tile(); }
    void read(LightFieldTile& tile) const override {
        LightFieldTile seen(source_->grid(), tile.range, true);
        source_->read(seen);
        std::ranges::transform(seen.depth.elements(), tile.radiance.elements().begin(),
                               [&](float depth) { return depth == infinity ? nothing_ : depth; });
    }

  private:
    LightField::Source source_;
    LightFieldGrid grid_;
    float nothing_;
};

}  // namespace

DepthCoding::DepthCoding(double nearest, double farthest, double wanted_error) {
    const double range = farthest > nearest ? farthest - nearest : std::max(std::abs(farthest), 1e-6);
    error = wanted_error > 0 ? wanted_error : 1e-3 * range;
    // Far enough for any rounding, but not farther, because edges between finite and infinite depths cost more if the
    // jump is larger.
    beyond = farthest + 4 * error + 1e-2 * range;
    nothing = beyond + (beyond - farthest);
}

DepthCoding depth_coding(const LightField& light_field, double wanted_error) {
    Range all;
    for (const LightField::Source& face : light_field.faces()) {
        const Tiling tiling(face->grid(), face->preferred_tile());
        core::parallel_ordered<Range>(
            tiling.count(), core::default_in_flight(), [&](std::size_t i) { return depths_of(*face, tiling[i]); },
            [&](std::size_t, Range& depths) { all.include(depths); });
    }
    return all.nearest <= all.farthest ? DepthCoding(all.nearest, all.farthest, wanted_error)
                                       : DepthCoding(0, 0, wanted_error);
}

LightField depth_as_radiance(const LightField& light_field, const DepthCoding& coding) {
    return light_field.wrapped(
        [&](const LightField::Source& face) { return std::make_shared<DepthAsRadiance>(face, coding); });
}

StreamInfo::Depth compress_depth(const LightField& light_field, const std::filesystem::path& path,
                                 const CompressionOptions& options) {
    if (!light_field.has_depth()) throw Error(ErrorCode::usage, "depth was asked for, but the light field has none");
    if (!(options.depth_error >= 0 && std::isfinite(options.depth_error)))
        throw Error(
            ErrorCode::usage,
            fmt::format("an error of depth of {} m was asked for, expected 0 or a positive one", options.depth_error));
    const DepthCoding coding = depth_coding(light_field, options.depth_error);
    CompressionOptions exact;
    exact.target = MaxError{coding.error};
    exact.tile = options.tile;
    return {compress(depth_as_radiance(light_field, coding), path, exact).bytes, coding.error, coding.beyond};
}

}  // namespace hogel::codec::encode
