// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "hogel/codec/exact_coder.h"
#include "hogel/codec/format/bytes.h"
#include "hogel/codec/format/residuals.h"
#include "hogel/codec/format/unfolded.h"
#include "hogel/codec/hogel_coder.h"
#include "hogel/work/parallel.h"

namespace hogel::codec {

using namespace format;

namespace {

// Rule of "lossless": maps floats to whole numbers in the same order, without the low bits that are zero in all samples
// of a tile.
class Ordered {
  public:
    explicit Ordered(int zero_bits) : zero_bits_(zero_bits) {}

    std::uint32_t number(float value) const {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        return (bits >> 31 ? ~bits : bits | 1u << 31) >> zero_bits_;
    }
    // Returns the number of the nearest float with zero low bits.
    std::uint32_t nearest(float value) const {
        const std::uint32_t exact = Ordered(0).number(value), half = zero_bits_ > 0 ? 1u << (zero_bits_ - 1) : 0;
        return (exact > ~half ? exact : exact + half) >> zero_bits_;
    }
    float value(std::uint32_t number) const {
        std::uint32_t bits = number << zero_bits_;
        bits = bits >> 31 ? bits & ~(1u << 31) : ~(bits | ((1u << zero_bits_) - 1));
        return std::bit_cast<float>(bits);
    }

    static constexpr bool keeps_every_bit = true;
    static Ordered for_tile(const LightFieldTile& tile, double) {
        int zero_bits = 31;
        for (const float value : tile.radiance.elements())
            zero_bits = std::min(zero_bits, std::countr_zero(std::bit_cast<std::uint32_t>(value)));
        return Ordered(zero_bits);
    }
    // Reads the rule, and whether each code is of a single hogel or of a row of hogels.
    static std::pair<Ordered, bool> take(ByteReader& reader) {
        const auto bits = reader.take<std::uint8_t>();
        const int zero_bits = bits & (hogels_apart - 1);
        if (zero_bits > 31) reader.damaged("its floats have no bits");
        return {Ordered(zero_bits), (bits & hogels_apart) != 0};
    }
    void put(ByteWriter& writer, bool separate) const {
        writer.put(static_cast<std::uint8_t>(zero_bits_ | (separate ? hogels_apart : 0)));
    }

    // Returns the residual; `special` means +0.
    Residual residual(float value, float prediction) const {
        if (std::bit_cast<std::uint32_t>(value) == 0) return {0, true};
        // Differences are modulo 2^n for numbers of n bits.
        const std::uint32_t difference = number(value) - nearest(prediction);
        return {static_cast<std::int32_t>(difference << zero_bits_) >> zero_bits_, false};
    }
    float restore(const Residual& residual, float prediction) const {
        return value((nearest(prediction) + static_cast<std::uint32_t>(residual.number)) &
                     (~std::uint32_t{0} >> zero_bits_));
    }

    template <class Coder>
    float code_special(Coder&, float) const {
        return 0;
    }

  private:
    static constexpr int hogels_apart = 0x80;
    int zero_bits_;
};

// Rule of "bounded": residuals are multiples of twice the error bound. Special means that the float follows.
class Bounded {
  public:
    explicit Bounded(double max_error) : max_error_(max_error) {}

    static constexpr bool keeps_every_bit = false;
    static Bounded for_tile(const LightFieldTile&, double max_error) { return Bounded(max_error); }
    // Reads the rule. The sign of the bound is a flag: negative if each hogel has a separate code.
    static std::pair<Bounded, bool> take(ByteReader& reader) {
        const double max_error = reader.take_double();
        if (!(max_error != 0 && std::isfinite(max_error))) reader.damaged("its bound is impossible");
        return {Bounded(std::abs(max_error)), max_error < 0};
    }
    void put(ByteWriter& writer, bool separate) const { writer.put(separate ? -max_error_ : max_error_); }

    float restore(const Residual& residual, float prediction) const {
        return static_cast<float>(static_cast<double>(prediction) + 2 * max_error_ * residual.number);
    }
    Residual residual(float value, float prediction) const {
        const double steps = std::nearbyint((static_cast<double>(value) - prediction) / (2 * max_error_));
        if (!(std::abs(steps) < 1 << 30)) return {0, true};
        const Residual rounded{static_cast<std::int32_t>(steps), false};
        // Rounding to a float may exceed the bound.
        const double error = static_cast<double>(restore(rounded, prediction)) - value;
        return std::abs(error) <= max_error_ ? rounded : Residual{0, true};
    }

    template <class Coder>
    float code_special(Coder& coder, float value) const {
        return std::bit_cast<float>(coder.raw(std::bit_cast<std::uint32_t>(value), 32));
    }

  private:
    double max_error_;
};

// Minimum size, bytes, for which a separate code for each hogel costs less than half a per cent.
constexpr std::size_t min_separate_code = 16384;

// Returns the nearest value in the range of the prediction's coder.
float codable_prediction(float value) { return std::isfinite(value) ? std::clamp(value, -0x1p60f, 0x1p60f) : 0; }

// Calls use(index in the tile, context) for the samples of a hogel; use() returns the residual.
template <class Use>
void for_each_sample(const LightFieldTile& tile, std::size_t t, std::size_t s, const DirectionCross& counted,
                     Use&& use) {
    const auto& shape = tile.radiance.shape();
    std::vector<ResidualContexts> around;
    for (std::size_t c = 0; c < shape[0]; ++c) {
        around.emplace_back(shape[4], shape[3]);
        for (std::size_t v = 0; v < shape[3]; ++v) {
            const auto [begin, end] = counted.columns(v, shape[4]);
            for (std::size_t u = begin; u < end; ++u) {
                const auto index = static_cast<std::size_t>(&tile.radiance(c, t, s, v, u) - tile.radiance.data());
                around[c].set(v, u, use(index, around[c].at(v, u, c > 0 ? &around[c - 1] : nullptr)));
            }
        }
    }
}

template <class Rule>
struct ExactTile {
    std::span<const std::uint8_t> prediction;
    Rule rule;
    bool hogels_apart;
    std::vector<std::span<const std::uint8_t>> codes;  // one per hogel, row-major, or one per row of hogels

    static ExactTile take(std::span<const std::uint8_t> bytes, const HogelRange& range) {
        ByteReader reader(bytes, "tile");
        const std::span<const std::uint8_t> prediction = reader.take(reader.take<std::uint32_t>());
        const auto [rule, hogels_apart] = Rule::take(reader);
        ExactTile tile{prediction, rule, hogels_apart, {}};
        std::vector<std::uint32_t> sizes;
        for (std::size_t k = 0; k < (hogels_apart ? range.hogels() : range.nt); ++k)
            sizes.push_back(reader.take<std::uint32_t>());
        for (const std::uint32_t size : sizes) tile.codes.push_back(reader.take(size));
        if (reader.left() > 0) reader.damaged("bytes are left over");
        return tile;
    }

    // Decodes the hogels of one code, starting at (t, s), in place of their prediction.
    void decode(std::size_t code, LightFieldTile& tile, std::size_t t, std::size_t s,
                const DirectionCross& counted) const {
        const ByteReader error_reader({}, "tile");
        ResidualReader reader(codes[code]);
        const auto models = std::make_unique<ResidualModels>();
        for (const std::size_t end = hogels_apart ? s + 1 : tile.range.ns; s < end; ++s)
            for_each_sample(tile, t, s, counted, [&](std::size_t index, const ResidualContexts::Context& context) {
                const Residual residual = code_residual(reader, *models, context, {});
                float& value = tile.radiance.data()[index];
                value = residual.special ? rule.code_special(reader, 0) : rule.restore(residual, value);
                return residual;
            });
        if (reader.decoder.ended()) error_reader.damaged("it ends too early");
        if (!reader.decoder.all_read()) error_reader.damaged("bytes are left over");
    }
};

// Tile that is decoded on demand, by hogels or by rows of hogels. Decoded samples are cached.
template <class Rule>
class ExactDecoder final : public TileDecoder {
  public:
    ExactDecoder(std::vector<std::uint8_t> bytes, ExactTile<Rule> tile, std::unique_ptr<TileDecoder> prediction,
                 const LightFieldGrid& grid, const HogelRange& range, const DirectionCross& counted)
        : bytes_(std::move(bytes)),
          tile_(std::move(tile)),
          prediction_(std::move(prediction)),
          grid_(grid),
          range_(range),
          counted_(counted),
          decoded_(range.hogels()) {}

    void read(LightFieldTile& part) override {
        // A thread that waits in here must not start other work that waits for this tile.
        work::isolate([&] {
            const std::lock_guard lock(mutex_);
            HogelRange coded = part.range;  // extended to complete codes
            if (!tile_.hogels_apart) {
                coded.s0 = range_.s0;
                coded.ns = range_.ns;
            }
            const std::size_t across = tile_.hogels_apart ? coded.ns : 1, hogels_per_code = coded.ns / across;
            std::vector<std::size_t> missing;
            for (std::size_t n = 0; n < across * coded.nt; ++n)
                if (!decoded(coded.t0 + n / across, coded.s0 + n % across)) missing.push_back(n);
            if (!missing.empty()) {
                LightFieldTile prediction(grid_, coded, false);
                prediction_->read(prediction);
                work::parallel_for(missing.size(), [&](std::size_t k) {
                    const std::size_t t = missing[k] / across, s = missing[k] % across;
                    const std::size_t first = index_of(coded.t0 + t, coded.s0 + s);
                    tile_.decode(first / hogels_per_code, prediction, t, s, counted_);
                    for (std::size_t n = 0; n < hogels_per_code; ++n) {
                        const HogelRange hogel{coded.s0 + s + n, coded.t0 + t, 1, 1};
                        copy_common(prediction, decoded_[first + n].emplace(grid_, hogel, false));
                    }
                });
            }
            work::parallel_for(part.range.hogels(), [&](std::size_t n) {
                const std::size_t t = part.range.t0 + n / part.range.ns, s = part.range.s0 + n % part.range.ns;
                copy_common(*decoded(t, s), part);
            });
        });
    }

  private:
    std::size_t index_of(std::size_t t, std::size_t s) const { return (t - range_.t0) * range_.ns + s - range_.s0; }
    const std::optional<LightFieldTile>& decoded(std::size_t t, std::size_t s) const {
        return decoded_[index_of(t, s)];
    }

    std::vector<std::uint8_t> bytes_;
    ExactTile<Rule> tile_;
    std::unique_ptr<TileDecoder> prediction_;
    LightFieldGrid grid_;
    HogelRange range_;
    DirectionCross counted_;
    std::mutex mutex_;
    std::vector<std::optional<LightFieldTile>> decoded_;  // hogels, row-major
};

template <class Rule>
class ExactCoder final : public TileCoder {
  public:
    // @param max_error   used by encode(), if the rule has one
    ExactCoder(const LightFieldGrid& grid, const DirectionCross& counted, double max_error)
        : predictor_(make_hogel_coder(grid, counted)), counted_(counted), max_error_(max_error) {}

    HogelRange preferred_tile(const LightFieldGrid& grid) const override { return predictor_->preferred_tile(grid); }
    std::size_t max_at_once() const override { return predictor_->max_at_once(); }
    bool takes_any_value() const override { return true; }
    // Returns the number of layers of the prediction, plus one of residuals.
    std::size_t layers(const HogelRange& tile) const override { return predictor_->layers(tile) + 1; }

    Encoded encode(LightFieldTile& tile, double step, std::size_t) const override {
        ByteWriter writer;
        auto [decoded, layers] = encode_prediction(tile, step, writer);
        const Rule rule = Rule::for_tile(tile, max_error_);
        const bool separate = hogels_apart(tile, rule, decoded);
        rule.put(writer, separate);
        encode_codes(tile, rule, decoded, separate, writer);
        layers.push_back(writer.bytes.size());
        const double error = Rule::keeps_every_bit ? 0 : squared_error(tile, decoded, counted_);
        return {std::move(writer.bytes), error, std::move(layers)};
    }

    void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const override {
        const auto exact = ExactTile<Rule>::take(bytes, tile.range);
        predictor_->decode(exact.prediction, tile);
        const std::size_t across = exact.hogels_apart ? tile.range.ns : 1;
        work::parallel_for(exact.codes.size(),
                           [&](std::size_t k) { exact.decode(k, tile, k / across, k % across, counted_); });
    }

    std::unique_ptr<TileDecoder> open(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid,
                                      const HogelRange& range, std::size_t requested) const override {
        const std::size_t layers_of_prediction = layers(range) - 1;
        if (requested <= layers_of_prediction) {
            ByteReader reader(bytes, "tile");
            reader.take<std::uint32_t>();  // the length of the prediction
            return open_prediction(reader.take(reader.left()), grid, range, requested);
        }
        auto tile = ExactTile<Rule>::take(bytes, range);
        auto prediction = open_prediction(tile.prediction, grid, range, layers_of_prediction);
        return std::make_unique<ExactDecoder<Rule>>(std::move(bytes), std::move(tile), std::move(prediction), grid,
                                                    range, counted_);
    }

  private:
    std::unique_ptr<TileDecoder> open_prediction(std::span<const std::uint8_t> bytes, const LightFieldGrid& grid,
                                                 const HogelRange& range, std::size_t levels) const {
        return predictor_->open({bytes.begin(), bytes.end()}, grid, range, levels);
    }

    // Returns the decoded prediction and the ends of its layers.
    std::pair<LightFieldTile, std::vector<std::size_t>> encode_prediction(const LightFieldTile& tile, double step,
                                                                          ByteWriter& writer) const {
        LightFieldTile prediction = tile;
        for (float& value : prediction.radiance.elements()) value = codable_prediction(value);
        auto [code, error, layers] = predictor_->encode(prediction, step);
        writer.put(static_cast<std::uint32_t>(code.size()));
        for (std::size_t& end : layers) end += writer.bytes.size();
        writer.put(std::span(std::as_const(code)));
        predictor_->decode(code, prediction);
        return {std::move(prediction), std::move(layers)};
    }

    // Returns whether hogels are large enough for separate codes, judged by the row in the middle.
    bool hogels_apart(const LightFieldTile& tile, const Rule& rule, const LightFieldTile& prediction) const {
        std::vector<std::size_t> bytes(tile.range.ns);
        work::parallel_for(bytes.size(), [&](std::size_t s) {
            bytes[s] = encode_code(tile, rule, prediction, tile.range.nt / 2, s, s + 1, nullptr).size();
        });
        return std::accumulate(bytes.begin(), bytes.end(), std::size_t{0}) >= min_separate_code * bytes.size();
    }

    // Codes hogels `begin` to `end` of a row, and stores their samples in `decoded`, which may be null or the
    // prediction.
    std::vector<std::uint8_t> encode_code(const LightFieldTile& tile, const Rule& rule,
                                          const LightFieldTile& prediction, std::size_t t, std::size_t begin,
                                          std::size_t end, LightFieldTile* decoded) const {
        ResidualWriter writer;
        const auto models = std::make_unique<ResidualModels>();
        for (std::size_t s = begin; s < end; ++s)
            for_each_sample(tile, t, s, counted_, [&](std::size_t index, const ResidualContexts::Context& context) {
                const float value = tile.radiance.data()[index];
                const float predicted = prediction.radiance.data()[index];
                const Residual residual = rule.residual(value, predicted);
                code_residual(writer, *models, context, residual);
                if (residual.special) rule.code_special(writer, value);
                if (decoded)
                    decoded->radiance.data()[index] = residual.special ? value : rule.restore(residual, predicted);
                return residual;
            });
        return writer.encoder.finish();
    }

    // Replaces the prediction by the decoded samples.
    void encode_codes(const LightFieldTile& tile, const Rule& rule, LightFieldTile& prediction, bool separate,
                      ByteWriter& bytes) const {
        const std::size_t across = separate ? tile.range.ns : 1, hogels_per_code = tile.range.ns / across;
        std::vector<std::vector<std::uint8_t>> codes(across * tile.range.nt);
        work::parallel_for(codes.size(), [&](std::size_t k) {
            const std::size_t s = k % across;
            codes[k] = encode_code(tile, rule, prediction, k / across, s, s + hogels_per_code, &prediction);
        });
        for (const auto& code : codes) bytes.put(static_cast<std::uint32_t>(code.size()));
        for (const auto& code : codes) bytes.put(std::span(code));
    }

    std::unique_ptr<TileCoder> predictor_;
    DirectionCross counted_;
    double max_error_;
};

}  // namespace

std::unique_ptr<TileCoder> make_lossless_coder(const LightFieldGrid& grid, const DirectionCross& counted) {
    return std::make_unique<ExactCoder<Ordered>>(grid, counted, 0);
}

std::unique_ptr<TileCoder> make_bounded_coder(const LightFieldGrid& grid, const DirectionCross& counted,
                                              double max_error) {
    return std::make_unique<ExactCoder<Bounded>>(grid, counted, max_error);
}

}  // namespace hogel::codec
