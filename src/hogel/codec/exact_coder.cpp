#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "hogel/codec/bytes_internal.h"
#include "hogel/codec/exact_coder_internal.h"
#include "hogel/codec/hogel_coder_internal.h"
#include "hogel/codec/residuals_internal.h"
#include "hogel/core/parallel.h"

namespace hogel {
namespace {

// Floats as whole numbers in the same order, without the bits that are zero in all floats of a tile.
class Ordered {
  public:
    explicit Ordered(int zero_bits) : zero_bits_(zero_bits) {}

    std::uint32_t number(float value) const {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        return (bits >> 31 ? ~bits : bits | 1u << 31) >> zero_bits_;
    }
    // The nearest that there is.
    std::uint32_t nearest(float value) const {
        const std::uint32_t exact = Ordered(0).number(value), half = zero_bits_ > 0 ? 1u << (zero_bits_ - 1) : 0;
        return (exact > ~half ? exact : exact + half) >> zero_bits_;
    }
    float value(std::uint32_t number) const {
        std::uint32_t bits = number << zero_bits_;
        bits = bits >> 31 ? bits & ~(1u << 31) : ~(bits | ((1u << zero_bits_) - 1));
        return std::bit_cast<float>(bits);
    }
    int zero_bits() const { return zero_bits_; }

    // Special: +0.
    Residual residual(float value, float prediction) const {
        if (std::bit_cast<std::uint32_t>(value) == 0) return {0, true};
        // Differences go around, in as many bits as numbers have.
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
    int zero_bits_;
};

// Steps of twice the error from the prediction. Special: the float itself follows.
class Bounded {
  public:
    explicit Bounded(double max_error) : max_error_(max_error) {}
    double max_error() const { return max_error_; }

    float restore(const Residual& residual, float prediction) const {
        return static_cast<float>(static_cast<double>(prediction) + 2 * max_error_ * residual.number);
    }
    Residual residual(float value, float prediction) const {
        const double steps = std::nearbyint((static_cast<double>(value) - prediction) / (2 * max_error_));
        if (!(std::abs(steps) < 1 << 30)) return {0, true};
        const Residual found{static_cast<std::int32_t>(steps), false};
        // Rounding to a float may lead out of the bound.
        const double error = static_cast<double>(restore(found, prediction)) - value;
        return std::abs(error) <= max_error_ ? found : Residual{0, true};
    }

    template <class Coder>
    float code_special(Coder& coder, float value) const {
        return std::bit_cast<float>(coder.raw(std::bit_cast<std::uint32_t>(value), 32));
    }

  private:
    double max_error_;
};

// What the coder of the prediction can work with.
float tamed(float value) { return std::isfinite(value) ? std::clamp(value, -0x1p60f, 0x1p60f) : 0; }

class ExactCoder : public TileCoder {
  public:
    ExactCoder(const LightFieldGrid& grid, const DirectionCross& counted, std::uint32_t version)
        : predictor_(make_hogel_coder(grid, counted, version)), counted_(counted), version_(version) {}

    HogelRange preferred_tile(const LightFieldGrid& grid) const override { return predictor_->preferred_tile(grid); }
    std::size_t most_at_once() const override { return predictor_->most_at_once(); }
    bool takes_any_value() const override { return true; }
    // Those of the prediction, and what is left.
    std::size_t layers(const HogelRange& tile) const override {
        return version_ < 3 ? 1 : predictor_->layers(tile) + 1;
    }
    std::unique_ptr<TileDecoder> open(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid,
                                      const HogelRange& range, std::size_t wanted) const override {
        if (wanted == layers(range)) return TileCoder::open(std::move(bytes), grid, range, wanted);
        ByteReader reader(bytes, "tile");
        reader.take<std::uint32_t>();  // the length of the whole prediction
        const std::span<const std::uint8_t> prediction = reader.take(reader.left());
        return predictor_->open({prediction.begin(), prediction.end()}, grid, range, wanted);
    }

  protected:
    // Returns the prediction, and where its layers end.
    std::pair<LightFieldTile, std::vector<std::size_t>> encode_prediction(const LightFieldTile& tile, double step,
                                                                          ByteWriter& writer) const {
        LightFieldTile prediction = tile;
        for (float& value : prediction.radiance.elements()) value = tamed(value);
        auto [code, error, layers] = predictor_->encode(prediction, step);
        writer.put(static_cast<std::uint32_t>(code.size()));
        for (std::size_t& end : layers) end += writer.bytes.size();
        writer.put(std::span(std::as_const(code)));
        predictor_->decode(code, prediction);
        return {std::move(prediction), std::move(layers)};
    }
    void decode_prediction(ByteReader& reader, LightFieldTile& tile) const {
        predictor_->decode(reader.take(reader.take<std::uint32_t>()), tile);
    }

    // Calls use(v, u, context, around) for the samples of each hogel of a row and channel, where use sets what is
    // around.
    template <class Use>
    void for_each_sample(const LightFieldTile& tile, std::size_t t, Use&& use) const {
        const auto& shape = tile.radiance.shape();
        for (std::size_t s = 0; s < shape[2]; ++s) {
            std::vector<ResidualsAround> around;
            for (std::size_t c = 0; c < shape[0]; ++c) {
                around.emplace_back(shape[4], shape[3]);
                for (std::size_t v = 0; v < shape[3]; ++v) {
                    const auto [begin, end] = counted_.columns(v, shape[4]);
                    for (std::size_t u = begin; u < end; ++u) {
                        const std::size_t at =
                            static_cast<std::size_t>(&tile.radiance(c, t, s, v, u) - tile.radiance.data());
                        around[c].set(v, u, use(at, around[c].at(v, u, c > 0 ? &around[c - 1] : nullptr)));
                    }
                }
            }
        }
    }

    // Each row of hogels has a code of its own, so that they are coded at the same time. Replaces the prediction by
    // what decoding gives.
    template <class Rule>
    void encode_rows(const LightFieldTile& tile, const Rule& rule, LightFieldTile& prediction,
                     ByteWriter& bytes) const {
        std::vector<std::vector<std::uint8_t>> codes(tile.range.nt);
        parallel_for(codes.size(), [&](std::size_t t) {
            ResidualWriter writer;
            const auto models = std::make_unique<ResidualModels>();
            for_each_sample(tile, t, [&](std::size_t at, const ResidualsAround::Context& context) {
                const float value = tile.radiance.data()[at];
                float& decoded = prediction.radiance.data()[at];
                const Residual residual = rule.residual(value, decoded);
                code_residual(writer, *models, context, residual);
                if (residual.special) rule.code_special(writer, value);
                decoded = residual.special ? value : rule.restore(residual, decoded);
                return residual;
            });
            codes[t] = writer.encoder.finish();
        });
        for (const auto& code : codes) bytes.put(static_cast<std::uint32_t>(code.size()));
        for (const auto& code : codes) bytes.put(std::span(code));
    }
    // In place of the prediction.
    template <class Rule>
    void decode_rows(ByteReader& bytes, const Rule& rule, LightFieldTile& tile) const {
        std::vector<std::uint32_t> sizes;
        for (std::size_t t = 0; t < tile.range.nt; ++t) sizes.push_back(bytes.take<std::uint32_t>());
        std::vector<std::span<const std::uint8_t>> codes;
        for (const std::uint32_t size : sizes) codes.push_back(bytes.take(size));
        if (bytes.left() > 0) bytes.damaged("bytes are left over");
        parallel_for(codes.size(), [&](std::size_t t) {
            ResidualReader reader(codes[t]);
            const auto models = std::make_unique<ResidualModels>();
            for_each_sample(tile, t, [&](std::size_t at, const ResidualsAround::Context& context) {
                const Residual residual = code_residual(reader, *models, context, {});
                float& value = tile.radiance.data()[at];
                value = residual.special ? rule.code_special(reader, 0) : rule.restore(residual, value);
                return residual;
            });
            if (reader.decoder.ended()) bytes.damaged("it ends too early");
            if (!reader.decoder.all_read()) bytes.damaged("bytes are left over");
        });
    }
    const DirectionCross& counted() const { return counted_; }

  private:
    std::unique_ptr<TileCoder> predictor_;
    DirectionCross counted_;
    std::uint32_t version_;
};

class LosslessCoder final : public ExactCoder {
  public:
    using ExactCoder::ExactCoder;

    Encoded encode(const LightFieldTile& tile, double step, std::size_t) const override {
        int zero_bits = 31;
        for (const float value : tile.radiance.elements())
            zero_bits = std::min(zero_bits, std::countr_zero(std::bit_cast<std::uint32_t>(value)));
        ByteWriter writer;
        auto [decoded, layers] = encode_prediction(tile, step, writer);
        writer.put(static_cast<std::uint8_t>(zero_bits));
        encode_rows(tile, Ordered(zero_bits), decoded, writer);
        layers.push_back(writer.bytes.size());
        return {std::move(writer.bytes), 0, std::move(layers)};
    }
    void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const override {
        ByteReader reader(bytes, "tile");
        decode_prediction(reader, tile);
        const auto zero_bits = reader.take<std::uint8_t>();
        if (zero_bits > 31) reader.damaged("its floats have no bits");
        decode_rows(reader, Ordered(zero_bits), tile);
    }
};

class BoundedCoder final : public ExactCoder {
  public:
    BoundedCoder(const LightFieldGrid& grid, const DirectionCross& counted, double max_error, std::uint32_t version)
        : ExactCoder(grid, counted, version), max_error_(max_error) {}

    Encoded encode(const LightFieldTile& tile, double step, std::size_t) const override {
        ByteWriter writer;
        auto [decoded, layers] = encode_prediction(tile, step, writer);
        writer.put(max_error_);
        encode_rows(tile, Bounded(max_error_), decoded, writer);
        layers.push_back(writer.bytes.size());
        return {std::move(writer.bytes), squared_error(tile, decoded, counted()), std::move(layers)};
    }
    void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const override {
        ByteReader reader(bytes, "tile");
        decode_prediction(reader, tile);
        const double max_error = reader.take_double();
        if (!(max_error > 0 && std::isfinite(max_error))) reader.damaged("its bound is no bound");
        decode_rows(reader, Bounded(max_error), tile);
    }

  private:
    double max_error_;
};

}  // namespace

std::unique_ptr<TileCoder> make_lossless_coder(const LightFieldGrid& grid, const DirectionCross& counted,
                                               std::uint32_t version) {
    return std::make_unique<LosslessCoder>(grid, counted, version);
}

std::unique_ptr<TileCoder> make_bounded_coder(const LightFieldGrid& grid, const DirectionCross& counted,
                                              double max_error, std::uint32_t version) {
    return std::make_unique<BoundedCoder>(grid, counted, max_error, version);
}

}  // namespace hogel
