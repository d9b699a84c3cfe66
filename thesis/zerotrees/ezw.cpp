// SPDX-License-Identifier: Apache-2.0
#include "thesis/zerotrees/ezw.h"

#include <fmt/format.h>

#include <array>

#include "hogel/coding/arithmetic.h"
#include "hogel/coding/histogram_rule.h"
#include "hogel/error.h"
#include "thesis/zerotrees/ezw_passes.h"
#include "thesis/zerotrees/header_bytes.h"
#include "thesis/zerotrees/quantise.h"

namespace hogel::zerotrees {
namespace {

constexpr int planes = 30;
constexpr std::size_t ezw_header_bytes = 4;

struct EzwModels {
    // [0 neither, 1 leaf, 2 known not to be a zerotree][parent found][previous found]
    std::array<std::array<std::array<coding::BitModel, 2>, 2>, 3> significant;
    std::array<coding::BitModel, 2> zerotree;  // [parent found]
    std::array<coding::BitModel, planes> refinement;

    coding::BitModel& significance(const EzwContext& context) {
        const std::size_t kind = context.leaf ? 1 : context.not_a_zerotree ? 2 : 0;
        return significant[kind][context.parent_found][context.previous_found];
    }
};

// Returns twice the magnitude in the middle of the interval of a coefficient found in this plane, an integer.
std::uint32_t found_at(int plane) { return 3u << plane; }
std::uint32_t refined(std::uint32_t twice, bool bit, int plane) {
    return bit ? twice + (1u << plane) : twice - (1u << plane);
}

class EzwEncoding {
  public:
    EzwEncoding(const EzwMagnitudes& magnitudes, std::span<const float> values, double unit, const EzwLimit& limit)
        : magnitudes_(magnitudes), values_(values), half_unit_(unit / 2), limit_(limit) {
        if (limit.sqnr) {
            twice_.resize(values.size());
            error_ = energy(values);
            allowed_ = error_ * std::pow(10, -*limit.sqnr / 10);
        }
    }
    EzwSymbol symbol(const EzwContext& context, std::size_t index, int plane) {
        const EzwSymbol symbol = magnitudes_.symbol(index, plane);
        const bool significant = symbol == EzwSymbol::positive || symbol == EzwSymbol::negative;
        encoder_.bit(models_.significance(context), significant);
        if (significant) {
            encoder_.raw(symbol == EzwSymbol::negative, 1);
            now_known(index, found_at(plane));
        } else if (!context.leaf && !context.not_a_zerotree) {
            encoder_.bit(models_.zerotree[context.parent_found], symbol == EzwSymbol::zerotree);
        }
        return symbol;
    }
    void refine(std::size_t index, int plane) {
        const bool bit = magnitudes_.bit(index, plane);
        encoder_.bit(models_.refinement[static_cast<std::size_t>(plane)], bit);
        if (limit_.sqnr) now_known(index, refined(twice_[index], bit, plane));
    }
    bool full() {
        // Five extra bytes, so that the end of the code determines all symbols so far.
        if (!enough_ && limit_.sqnr && error_ <= allowed_) enough_ = encoder_.size() + 5;
        return encoder_.size() >= limit_.bytes || (enough_ && encoder_.size() >= *enough_);
    }
    std::vector<std::uint8_t> finish() { return encoder_.finish(); }

  private:
    void now_known(std::size_t index, std::uint32_t twice) {
        if (!limit_.sqnr) return;
        const double magnitude = std::abs(values_[index]);
        const double old_error = magnitude - twice_[index] * half_unit_, new_error = magnitude - twice * half_unit_;
        error_ += new_error * new_error - old_error * old_error;
        twice_[index] = twice;
    }

    const EzwMagnitudes& magnitudes_;
    std::span<const float> values_;
    double half_unit_;
    EzwLimit limit_;
    double error_ = 0, allowed_ = 0;
    std::optional<std::size_t> enough_;  // bytes
    std::vector<std::uint32_t> twice_;
    EzwModels models_;
    coding::ArithmeticEncoder encoder_;
};

class EzwDecoding {
  public:
    EzwDecoding(std::span<const std::uint8_t> code, double unit, std::span<float> values)
        : half_unit_(unit / 2), values_(values), twice_(values.size()), decoder_(code) {}
    EzwSymbol symbol(const EzwContext& context, std::size_t index, int plane) {
        if (decoder_.bit(models_.significance(context))) {
            const bool negative = decoder_.raw(1) != 0;
            if (!decoder_.ended()) {
                twice_[index] = found_at(plane);
                values_[index] = static_cast<float>((negative ? -half_unit_ : half_unit_) * twice_[index]);
            }
            return negative ? EzwSymbol::negative : EzwSymbol::positive;
        }
        if (context.leaf) return EzwSymbol::zerotree;
        if (context.not_a_zerotree) return EzwSymbol::isolated;
        return decoder_.bit(models_.zerotree[context.parent_found]) ? EzwSymbol::zerotree : EzwSymbol::isolated;
    }
    void refine(std::size_t index, int plane) {
        const bool bit = decoder_.bit(models_.refinement[static_cast<std::size_t>(plane)]);
        if (decoder_.ended()) return;
        twice_[index] = refined(twice_[index], bit, plane);
        values_[index] = static_cast<float>(std::copysign(half_unit_ * twice_[index], values_[index]));
    }
    bool full() const { return decoder_.ended(); }

  private:
    double half_unit_;
    std::span<float> values_;
    std::vector<std::uint32_t> twice_;
    EzwModels models_;
    coding::ArithmeticDecoder decoder_;
};

void check_ezw_size(const wavelets::Pyramid& pyramid, std::size_t size) {
    if (size != pyramid.size())
        throw Error(ErrorCode::usage,
                    fmt::format("EZW: {} values given, expected the {} of the pyramid", size, pyramid.size()));
}

}  // namespace

std::vector<std::uint8_t> ezw_encode(const wavelets::Pyramid& pyramid, std::span<const float> values,
                                     const EzwLimit& limit) {
    check_ezw_size(pyramid, values.size());
    if (limit.sqnr && !(*limit.sqnr > 0))
        throw Error(ErrorCode::usage, "sqnr", fmt::format("EZW: an SQNR of {} dB, expected more than 0", *limit.sqnr));
    const float max_value = coding::max_magnitude(values);
    std::vector<std::uint8_t> bytes;
    put_float(bytes, max_value);
    if (max_value > 0) {
        const Forest forest(pyramid);
        const Quantiser quantiser(std::ldexp(static_cast<double>(max_value), -planes));
        std::vector<std::uint32_t> levels(values.size());
        std::vector<bool> negative(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            levels[i] = quantiser.level(values[i]);
            negative[i] = values[i] < 0;
        }
        const EzwMagnitudes magnitudes(forest, std::move(levels), std::move(negative));
        EzwEncoding encoding(magnitudes, values, quantiser.step(), limit);
        ezw_passes(forest, planes, encoding);
        const std::vector<std::uint8_t> code = encoding.finish();
        bytes.insert(bytes.end(), code.begin(), code.end());
    }
    if (bytes.size() > limit.bytes) bytes.resize(limit.bytes);
    return bytes;
}

void ezw_decode(const wavelets::Pyramid& pyramid, std::span<const std::uint8_t> bytes, std::span<float> values) {
    check_ezw_size(pyramid, values.size());
    std::fill(values.begin(), values.end(), 0.0f);
    if (bytes.size() < ezw_header_bytes) return;
    const float max_value = get_float(bytes);
    if (!(max_value >= 0) || !std::isfinite(max_value))
        throw Error(ErrorCode::bad_input,
                    "EZW stream: its largest magnitude is impossible, expected an undamaged stream");
    if (max_value == 0) return;
    EzwDecoding decoding(bytes.subspan(ezw_header_bytes), std::ldexp(static_cast<double>(max_value), -planes), values);
    ezw_passes(Forest(pyramid), planes, decoding);
}

}  // namespace hogel::zerotrees
