// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/layout_choice.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "hogel/codec/encode/target.h"
#include "hogel/codec/format/stacked.h"
#include "hogel/codec/format/stream_file.h"
#include "hogel/error.h"

namespace hogel::codec::encode {

using namespace format;

namespace {

constexpr std::size_t tried = 2;         // number of tiles of each face, of the size for the layout stacked
constexpr double separate_step = 2;      // estimate: the step of `faces` with the quality of a step of `stacked`
constexpr double probe_tolerance = 1.5;  // decibels
constexpr double bytes_tolerance = 0.2;
constexpr double db_per_doubling = 8;  // estimate: decibels gained by twice as many bytes

// Codes some tiles of each face in both layouts.
class Trial {
  public:
    Trial(const LightField& light_field, const StreamInfo& info, std::optional<HogelRange> tile,
          const CoderOfFace& coder_of)
        : info_(info), tile_(tile), coder_of_(coder_of) {
        for (const LightField::Source& face : light_field.faces()) {
            const LightFieldGrid& grid = face->grid();
            const Tiling tiling(grid, tile_size(*coder_in(StreamLayout::stacked, grid), grid));
            const std::size_t count = std::min(tiling.count(), tried);
            for (std::size_t i = 0; i < count; ++i) {
                const HogelRange range = tiling[(2 * i + 1) * tiling.count() / (2 * count)];
                samples_.push_back({face.get(), range});
                LightFieldTile sample(grid, range, false);
                face->read(sample);
                for (const float value : sample.radiance.elements()) {
                    finite_ = finite_ && std::isfinite(value);
                    if (std::isfinite(value)) sum_.signal += static_cast<double>(value) * value;
                }
                sum_.samples += static_cast<double>(sample.radiance.size());
                rays_ += static_cast<double>(grid.directions() * range.hogels());
            }
        }
    }

    double rms() const { return std::sqrt(sum_.signal / sum_.samples); }
    double rays() const { return rays_; }
    bool finite() const { return finite_; }

    CodingOutcome code(StreamLayout layout, double step) const {
        CodingOutcome sum = sum_;
        for (const auto& [face, range] : samples_) {
            const auto coder = coder_in(layout, face->grid());
            const HogelRange size = tile_size(*coder, face->grid());
            for (std::size_t t = 0; t < range.nt; t += size.nt)
                for (std::size_t s = 0; s < range.ns; s += size.ns) {
                    LightFieldTile tile(
                        face->grid(),
                        {range.s0 + s, range.t0 + t, std::min(size.ns, range.ns - s), std::min(size.nt, range.nt - t)},
                        false);
                    face->read(tile);
                    const TileCoder::Encoded encoded = coder->encode(tile, step);
                    sum.error += encoded.squared_error;
                    sum.bytes += static_cast<double>(encoded.bytes.size());
                }
        }
        return sum;
    }

  private:
    struct Sample {
        const LightFieldSource* face;
        HogelRange range;
    };

    std::unique_ptr<TileCoder> coder_in(StreamLayout layout, const LightFieldGrid& grid) const {
        StreamInfo info = info_;
        info.layout = layout;
        return coder_of_(info, grid);
    }
    HogelRange tile_size(const TileCoder& coder, const LightFieldGrid& grid) const {
        HogelRange size = tile_.value_or(coder.preferred_tile(grid));
        size.ns = std::min(size.ns, grid.hogels_s);
        size.nt = std::min(size.nt, grid.hogels_t);
        return size;
    }

    const StreamInfo& info_;
    std::optional<HogelRange> tile_;
    const CoderOfFace& coder_of_;
    std::vector<Sample> samples_;
    CodingOutcome sum_;
    double rays_ = 0;
    bool finite_ = true;
};

// Returns a figure for comparing codings of different quality; lower is better.
double cost(const CodingOutcome& outcome) { return std::log2(outcome.bytes) - outcome.sqnr() / db_per_doubling; }

StepBand near(double sqnr) {
    StepBand band = band_of_sqnr(sqnr);
    band.low = sqnr - probe_tolerance;
    band.high = sqnr + probe_tolerance;
    return band;
}

bool stacking_pays(const Trial& trial, const CompressionTarget& target) {
    const auto code_as = [&](StreamLayout layout) {
        return [&, layout](double step) { return trial.code(layout, step); };
    };
    const auto stacked = code_as(StreamLayout::stacked), separate = code_as(StreamLayout::faces);
    if (!(trial.rms() > 0)) return true;
    const double step = likely_step(target, trial.rms());
    if (is_exact(target)) return stacked(step).bytes <= separate(step).bytes;
    if (!trial.finite()) return true;  // compress() will refuse it
    const auto* const rate = std::get_if<PixelsPerBit>(&target);
    const bool fixed = std::holds_alternative<Step>(target);
    StepSearch search(std::log2(step),
                      [&](const CodingOutcome& outcome) { return rate ? std::log2(outcome.bytes) : outcome.sqnr(); });
    const CodingOutcome of_stacked = [&] {
        if (fixed) return stacked(step);
        if (rate)
            search.run(band_of_bytes(trial.rays() / rate->rate / 8, bytes_tolerance, false), stacked);
        else
            search.run(near(std::get<Sqnr>(target).decibels), stacked);
        return search.outcome();
    }();
    StepSearch same_quality(std::log2(separate_step * (fixed ? step : search.step())), &CodingOutcome::sqnr);
    same_quality.run(near(of_stacked.sqnr()), separate);
    return cost(of_stacked) <= cost(same_quality.outcome());
}

}  // namespace

StreamLayout choose_layout(const LightField& light_field, const StreamInfo& info, const CompressionOptions& options,
                           const CoderOfFace& coder_of) {
    const bool fits = can_stack(info.faces());
    if (options.layout == StreamLayout::stacked && !fits)
        throw Error(ErrorCode::usage, "the layout stacked needs a single row or column of directions");
    if (options.layout)
        return *options.layout == StreamLayout::unfolded && info.sides.empty() ? StreamLayout::faces : *options.layout;
    if (!fits || options.method.coder != "hogel") return StreamLayout::faces;
    return stacking_pays(Trial(light_field, info, options.tile, coder_of), options.target) ? StreamLayout::stacked
                                                                                           : StreamLayout::faces;
}

}  // namespace hogel::codec::encode
