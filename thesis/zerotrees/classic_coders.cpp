// SPDX-License-Identifier: Apache-2.0
// Coders of [K] chapter 4: a transform over all four dimensions of each colour channel of a tile, followed by a
// zerotree coder or, for the windowed DCT, by JPEG in four dimensions. Bytes of a tile: for each channel the length in
// 32 bits, then the coder's stream.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hogel/codec/format/bytes.h"
#include "hogel/codec/format/colour.h"
#include "hogel/codec/format/unfolded.h"
#include "hogel/codec/tile_coder.h"
#include "hogel/coding/histogram_rule.h"
#include "hogel/work/parallel.h"
#include "thesis/wavelets/transform.h"
#include "thesis/zerotrees/ezw.h"
#include "thesis/zerotrees/jpeg4d.h"
#include "thesis/zerotrees/quantise.h"
#include "thesis/zerotrees/threepass.h"

namespace hogel::zerotrees {

using namespace codec::format;

namespace {

constexpr std::size_t samples_of_tile = std::size_t{1} << 24;

// Coded quantity, and the dimensions that are transformed together.
enum class Content {
    radiance,   // L, all four dimensions interleaved
    amplitude,  // √L, hogels and directions independently
};

class ClassicCoder : public TileCoder {
  public:
    explicit ClassicCoder(std::string_view name, const DirectionCross& counted, Content content = Content::radiance)
        : transform_(wavelets::transform(name)), counted_(counted), content_(content) {}

    HogelRange preferred_tile(const LightFieldGrid& grid) const override {
        HogelRange tile{0, 0, 1, 1};
        const std::size_t hogel = grid.directions() * grid.channels;
        while (2 * tile.hogels() * hogel <= samples_of_tile && (tile.ns < grid.hogels_s || tile.nt < grid.hogels_t)) {
            const bool widen = tile.ns < grid.hogels_s && (tile.ns <= tile.nt || tile.nt >= grid.hogels_t);
            (widen ? tile.ns : tile.nt) *= 2;
        }
        return tile;
    }

    Encoded encode(LightFieldTile& tile, double step, std::size_t max_bytes) const override {
        LightFieldTile work = tile;
        const wavelets::Pyramid pyramid = to_coefficients(work);
        const std::size_t channels = tile.radiance.extent(0);
        std::vector<std::vector<std::uint8_t>> codes(channels);
        work::parallel_for(
            channels, [&](std::size_t c) { codes[c] = encode_channel(pyramid, work.radiance[c].elements(), step); });
        shorten(codes, max_bytes);
        ByteWriter writer;
        for (const auto& code : codes) {
            writer.put(static_cast<std::uint32_t>(code.size()));
            writer.put(std::span(code));
        }
        restore(pyramid, work,
                [&](std::size_t c, std::span<float> values) { round_channel(pyramid, codes[c], values); });
        square_amplitudes(work);
        return {std::move(writer.bytes), codec::format::squared_error(tile, work, counted_)};
    }

    void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const override {
        const wavelets::Pyramid pyramid = pyramid_of(tile);
        decode(bytes, pyramid, tile);
        square_amplitudes(tile);
    }

    bool directional() const override { return content_ == Content::amplitude; }

    void decode_coefficients(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const override {
        if (!directional()) return TileCoder::decode_coefficients(bytes, tile);
        // Inverts only the transform of the hogels.
        const wavelets::Pyramid pyramid = pyramid_of(tile);
        decode(bytes, wavelets::Pyramid(pyramid.shape(), {pyramid.groups().front()}), tile);
    }

  protected:
    wavelets::Pyramid to_coefficients(LightFieldTile& tile) const {
        if (content_ == Content::amplitude)
            for (float& value : tile.radiance.elements()) value = std::sqrt(std::max(value, 0.0f));
        separate_colours(tile.radiance);
        wavelets::Pyramid pyramid = pyramid_of(tile);
        for (std::size_t c = 0; c < tile.radiance.extent(0); ++c)
            transform_.forward(pyramid, tile.radiance[c].elements());
        return pyramid;
    }
    virtual std::vector<std::uint8_t> encode_channel(const wavelets::Pyramid& pyramid, std::span<const float> values,
                                                     double step) const = 0;
    virtual void decode_channel(const wavelets::Pyramid& pyramid, std::span<const std::uint8_t> code,
                                std::span<float> values) const = 0;
    // Replaces values by the values that decode_channel() restores from their code.
    virtual void round_channel(const wavelets::Pyramid& pyramid, std::span<const std::uint8_t> code,
                               std::span<float> values) const {
        decode_channel(pyramid, code, values);
    }

  private:
    wavelets::Pyramid pyramid_of(const LightFieldTile& tile) const {
        const Shape<5>& shape = tile.radiance.shape();
        const std::vector<std::size_t> axes(shape.begin() + 1, shape.end());
        return content_ == Content::amplitude ? wavelets::Pyramid::separate(axes, {{0, 1}, {2, 3}})
                                              : wavelets::Pyramid::interleaved(axes);
    }
    // Decodes a tile and inverts the transform along the groups of `back`.
    void decode(std::span<const std::uint8_t> bytes, const wavelets::Pyramid& back, LightFieldTile& tile) const {
        ByteReader reader(bytes, "tile");
        const wavelets::Pyramid pyramid = pyramid_of(tile);
        std::vector<std::span<const std::uint8_t>> codes;
        for (std::size_t c = 0; c < tile.radiance.extent(0); ++c)
            codes.push_back(reader.take(reader.take<std::uint32_t>()));
        if (reader.left() > 0) reader.damaged("bytes are left over");
        restore(back, tile, [&](std::size_t c, std::span<float> values) { decode_channel(pyramid, codes[c], values); });
    }
    // Inverts the transform of the coefficients from make(channel, values), and combines the colours.
    template <class Make>
    void restore(const wavelets::Pyramid& back, LightFieldTile& tile, Make&& make) const {
        work::parallel_for(tile.radiance.extent(0), [&](std::size_t c) {
            const std::span<float> values = tile.radiance[c].elements();
            make(c, values);
            transform_.inverse(back, values);
        });
        join_colours(tile.radiance);
    }
    void square_amplitudes(LightFieldTile& tile) const {
        if (content_ == Content::amplitude)
            for (float& value : tile.radiance.elements()) value *= value;
    }
    // Truncates embedded codes by equal fractions to `max_bytes` bytes in total, including their lengths.
    static void shorten(std::vector<std::vector<std::uint8_t>>& codes, std::size_t max_bytes) {
        std::size_t total = 0;
        for (const auto& code : codes) total += code.size();
        const std::size_t lengths = 4 * codes.size();
        if (max_bytes == no_limit || total + lengths <= max_bytes) return;
        std::size_t budget = max_bytes > lengths ? max_bytes - lengths : 0;
        for (auto& code : codes) {
            const std::size_t size = code.size(), new_size = total > 0 ? budget * size / total : 0;
            code.resize(new_size);
            total -= size;
            budget -= new_size;
        }
    }

    wavelets::Transform transform_;
    DirectionCross counted_;
    Content content_;
};

// Returns the given step, or the smallest step with levels that a coder can represent if this is larger.
double usable_step(std::span<const float> values, double step) {
    return std::max(step, static_cast<double>(coding::max_magnitude(values)) * 0x1p-29);
}

class ThreePassCoder final : public ClassicCoder, public codec::CountsMagnitudes {
  public:
    ThreePassCoder(const CodingMethod& method, const DirectionCross& counted, Content content = Content::radiance)
        : ClassicCoder(method.transform, counted, content),
          symbols_(method.symbols == ZerotreeSymbols::alphabets ? ThreePassSymbols::alphabets
                                                                : ThreePassSymbols::bits) {}

    coding::MagnitudeHistogram magnitudes(LightFieldTile& tile) const override {
        to_coefficients(tile);
        coding::MagnitudeHistogram histogram;
        histogram.add(tile.radiance.elements());
        return histogram;
    }

  private:
    std::vector<std::uint8_t> encode_channel(const wavelets::Pyramid& pyramid, std::span<const float> values,
                                             double step) const override {
        return three_pass_encode(pyramid, values, usable_step(values, step), symbols_);
    }
    void decode_channel(const wavelets::Pyramid& pyramid, std::span<const std::uint8_t> code,
                        std::span<float> values) const override {
        three_pass_decode(pyramid, code, values);
    }
    void round_channel(const wavelets::Pyramid&, std::span<const std::uint8_t> code,
                       std::span<float> values) const override {
        three_pass_round(code, values);
    }

    ThreePassSymbols symbols_;
};

class EzwCoder final : public ClassicCoder {
  public:
    using ClassicCoder::ClassicCoder;
    // Codes may be empty, so the minimum is the size of their lengths.
    std::optional<std::size_t> min_bytes(const LightFieldGrid& grid) const override {
        return grid.channels * sizeof(std::uint32_t);
    }

  private:
    std::vector<std::uint8_t> encode_channel(const wavelets::Pyramid& pyramid, std::span<const float> values,
                                             double step) const override {
        const double signal = energy(values), error = static_cast<double>(values.size()) * step * step / 12;
        if (signal <= error) return {};
        EzwLimit limit;
        limit.sqnr = 10 * std::log10(signal / error);
        return ezw_encode(pyramid, values, limit);
    }
    void decode_channel(const wavelets::Pyramid& pyramid, std::span<const std::uint8_t> code,
                        std::span<float> values) const override {
        ezw_decode(pyramid, code, values);
    }
};

class Jpeg4dCoder final : public ClassicCoder {
  public:
    Jpeg4dCoder(std::string_view name, const DirectionCross& counted, hogel::QuantisationTable table)
        : ClassicCoder(name, counted),
          table_(table == hogel::QuantisationTable::jpeg ? QuantisationTable::jpeg : QuantisationTable::own) {}

  private:
    std::vector<std::uint8_t> encode_channel(const wavelets::Pyramid& pyramid, std::span<const float> values,
                                             double step) const override {
        // The entry of JPEG's table for constant blocks is 16 in two dimensions, 256 in four.
        const double scale = table_ == QuantisationTable::jpeg ? step / 256 : step;
        return jpeg4d_encode(pyramid, values, usable_step(values, scale), table_);
    }
    void decode_channel(const wavelets::Pyramid& pyramid, std::span<const std::uint8_t> code,
                        std::span<float> values) const override {
        jpeg4d_decode(pyramid, code, values);
    }

    QuantisationTable table_;
};

// Throws Error(usage) unless the method's transform is a wavelet, or the cosine transform of blocks.
void require_transform(const CodingMethod& method, bool wavelet) {
    if (wavelets::transform(method.transform).is_wavelet() == wavelet) return;
    throw Error(ErrorCode::usage, "coder, transform",
                fmt::format("coder {} does not go with transform {}; expected {}", method.coder, method.transform,
                            wavelet ? "a wavelet" : "dct8"));
}

std::unique_ptr<TileCoder> make_threepass(const CodingMethod& method, const LightFieldGrid&,
                                          const DirectionCross& counted) {
    require_transform(method, true);
    return std::make_unique<ThreePassCoder>(method, counted);
}

std::unique_ptr<TileCoder> make_ezw(const CodingMethod& method, const LightFieldGrid&, const DirectionCross& counted) {
    require_transform(method, true);
    return std::make_unique<EzwCoder>(method.transform, counted);
}

std::unique_ptr<TileCoder> make_jpeg4d(const CodingMethod& method, const LightFieldGrid&,
                                       const DirectionCross& counted) {
    require_transform(method, false);
    return std::make_unique<Jpeg4dCoder>(method.transform, counted, method.table);
}

std::unique_ptr<TileCoder> make_fringes(const CodingMethod& method, const LightFieldGrid&,
                                        const DirectionCross& counted) {
    require_transform(method, true);
    return std::make_unique<ThreePassCoder>(method, counted, Content::amplitude);
}

}  // namespace
}  // namespace hogel::zerotrees

namespace hogel {

std::vector<CoderInfo> codec::thesis_coders() {
    using namespace zerotrees;
    return {{"threepass", "wavelets in four dimensions, zerotrees ([K] 4.4.2)", "cdf97", false, make_threepass, true},
            {"ezw", "wavelets in four dimensions, embedded zerotrees", "cdf97", false, make_ezw},
            {"jpeg4d", "cosine transform in four dimensions ([K] 4.4.1)", "dct8", true, make_jpeg4d},
            {"fringes", "threepass on amplitudes, hogels and directions apart: for basis fringes", "cdf97", false,
             make_fringes, true}};
}

std::vector<std::string> transform_names() {
    const std::vector<std::string_view> names = wavelets::transform_names();
    return {names.begin(), names.end()};
}

}  // namespace hogel
