// SPDX-License-Identifier: Apache-2.0
#include "bench/codec/thesis_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bench/session.h"
#include "bench/temporary_folder.h"
#include "hogel/coding/histogram_rule.h"
#include "hogel/compress.h"
#include "thesis/wavelets/transform.h"
#include "thesis/zerotrees/ezw.h"
#include "thesis/zerotrees/jpeg4d.h"
#include "thesis/zerotrees/threepass.h"

namespace hogel::bench {
namespace {

// Transform, coder and label in the order of the legend of [K] fig. 4.19.
constexpr std::pair<const char*, const char*> wavelets[] = {
    {"haar", "Haar"},       {"d4", "D4"},           {"d6", "D6"},           {"ai13", "AI (1,3)"},
    {"ai31", "AI (3,1)"},   {"ai33", "AI (3,3)"},   {"i22", "I (2,2)"},     {"i24", "I (2,4)"},
    {"i42", "I (4,2)"},     {"i44", "I (4,4)"},     {"cdf31", "CDF (3,1)"}, {"cdf33", "CDF (3,3)"},
    {"cdf42", "CDF (4,2)"}, {"cdf44", "CDF (4,4)"}, {"cdf97", "(9,7)"}};

// Initial c for the requested rates; each point records the c that meets its rate.
constexpr double initial_overhead = 4;

class Lumigraph {
  public:
    Lumigraph(const LightFieldBuffer& buffer, const ThesisMeasurement& measurement)
        : buffer_(buffer),
          measurement_(measurement),
          values_(buffer.radiance.elements()),
          pyramid_(wavelets::Pyramid::interleaved({buffer.grid().hogels_t, buffer.grid().hogels_s,
                                                   buffer.grid().directions_v, buffer.grid().directions_u})) {
        for (const float value : values_) signal_ += static_cast<double>(value) * value;
    }

    const LightFieldBuffer& buffer() const { return buffer_; }
    std::span<const float> values() const { return values_; }
    const wavelets::Pyramid& pyramid() const { return pyramid_; }
    const std::vector<double>& rates() const { return measurement_.rates; }
    double pixels() const { return static_cast<double>(values_.size()); }

    std::vector<float> coefficients(const wavelets::Transform& transform) const {
        std::vector<float> result(values_.begin(), values_.end());
        transform.forward(pyramid_, result);
        return result;
    }
    // Adds a point and its slice to a curve.
    // @param decoded  coefficients; overwritten
    void add(const wavelets::Transform& transform, std::vector<float>& decoded, std::size_t bytes,
             ThesisCurve& curve) const {
        transform.inverse(pyramid_, decoded);
        add_samples(decoded, bytes, curve);
    }
    void add_samples(std::span<const float> decoded, std::size_t bytes, ThesisCurve& curve) const {
        stop_if_interrupted();
        double error = 0;
        for (std::size_t i = 0; i < values_.size(); ++i) {
            const double difference = static_cast<double>(values_[i]) - decoded[i];
            error += difference * difference;
        }
        curve.points.push_back({pixels() / (8 * static_cast<double>(bytes)), 10 * std::log10(signal_ / error)});
        const std::size_t hogel = buffer_.grid().directions();
        const auto slice = decoded.subspan(measurement_.hogel * hogel, hogel);
        curve.slices.emplace_back(slice.begin(), slice.end());
    }

  private:
    const LightFieldBuffer& buffer_;
    const ThesisMeasurement& measurement_;
    std::span<const float> values_;
    wavelets::Pyramid pyramid_;
    double signal_ = 0;
};

ThesisCurve three_pass_curve(const Lumigraph& lumigraph, const char* name, const char* label) {
    const wavelets::Transform transform = wavelets::transform(name);
    const std::vector<float> coefficients = lumigraph.coefficients(transform);
    coding::MagnitudeHistogram histogram;
    histogram.add(coefficients);
    ThesisCurve curve{"threepass", name, label, {}};
    for (const double rate : lumigraph.rates()) {
        const double wanted = lumigraph.pixels() / rate;
        const double step = histogram.step(wanted, initial_overhead);
        const auto encode = [&](zerotrees::ThreePassSymbols symbols) {
            return zerotrees::three_pass_encode(lumigraph.pyramid(), coefficients, step, symbols);
        };
        const std::vector<std::uint8_t> code = encode(zerotrees::ThreePassSymbols::bits);
        std::vector<float> decoded = coefficients;
        zerotrees::three_pass_round(code, decoded);
        lumigraph.add(transform, decoded, code.size(), curve);
        const double of_levels = histogram.bits(step, 0), significant = histogram.bits(step, 1) - of_levels;
        const auto overhead = [&](std::size_t bytes) {
            return (8 * static_cast<double>(bytes) - of_levels) / significant;
        };
        curve.points.back().overhead = overhead(code.size());
        if (name == std::string_view("haar") || name == std::string_view("ai33")) {
            const std::size_t bytes = encode(zerotrees::ThreePassSymbols::alphabets).size();
            curve.points.back().alphabets = static_cast<double>(bytes) / static_cast<double>(code.size());
            curve.points.back().alphabet_overhead = overhead(bytes);
        }
    }
    return curve;
}

// Codes once with EZW; the code of every rate is a prefix.
ThesisCurve ezw_curve(const Lumigraph& lumigraph, const char* name, const char* label) {
    const wavelets::Transform transform = wavelets::transform(name);
    ThesisCurve curve{"ezw", std::string("ezw-") + name, label, {}};
    std::vector<float> work = lumigraph.coefficients(transform);
    zerotrees::EzwLimit limit;
    limit.bytes = static_cast<std::size_t>(lumigraph.pixels() / 8 / lumigraph.rates().front());
    const std::vector<std::uint8_t> code = zerotrees::ezw_encode(lumigraph.pyramid(), work, limit);
    for (const double rate : lumigraph.rates()) {
        const auto bytes = std::min(code.size(), static_cast<std::size_t>(lumigraph.pixels() / 8 / rate));
        zerotrees::ezw_decode(lumigraph.pyramid(), std::span(code).first(bytes), work);
        lumigraph.add(transform, work, bytes, curve);
    }
    return curve;
}

// Calls code(scale), which returns pixels per bit, with scales falling by 2.2 down to the lowest rate.
template <class Code>
void with_falling_scale(const Lumigraph& lumigraph, double scale, Code&& code) {
    for (int pass = 0; pass < 24; ++pass, scale /= 2.2)
        if (code(scale) < lumigraph.rates().front()) break;
}

// Returns the highest rate of points to keep.
double max_rate(const Lumigraph& lumigraph) { return 3 * lumigraph.rates().back(); }

ThesisCurve cosine_curve(const Lumigraph& lumigraph, zerotrees::QuantisationTable table) {
    const bool jpeg = table == zerotrees::QuantisationTable::jpeg;
    const wavelets::Transform transform = wavelets::transform("dct8");
    const std::vector<float> coefficients = lumigraph.coefficients(transform);
    ThesisCurve curve{"jpeg4d", jpeg ? "dct8-jpeg" : "dct8-own", jpeg ? "DCT (JPEG)" : "DCT, own", {}};
    const double largest = *std::ranges::max_element(coefficients);
    with_falling_scale(lumigraph, jpeg ? largest / 256 : largest, [&](double scale) {
        stop_if_interrupted();
        const std::vector<std::uint8_t> code =
            zerotrees::jpeg4d_encode(lumigraph.pyramid(), coefficients, scale, table);
        const double rate = lumigraph.pixels() / (8 * static_cast<double>(code.size()));
        if (rate > max_rate(lumigraph)) return rate;
        std::vector<float> decoded(coefficients.size());
        zerotrees::jpeg4d_decode(lumigraph.pyramid(), code, decoded);
        lumigraph.add(transform, decoded, code.size(), curve);
        return rate;
    });
    std::ranges::reverse(curve.points);
    std::ranges::reverse(curve.slices);
    return curve;
}

ThesisCurve hogel_curve(const Lumigraph& lumigraph) {
    const TemporaryFolder folder;
    ThesisCurve curve{"hogel", "hogel", "hogel", {}};
    LightFieldBuffer decoded(lumigraph.buffer().grid());
    with_falling_scale(lumigraph, *std::ranges::max_element(lumigraph.values()) * 2, [&](double step) {
        CompressionOptions options;
        options.target = Step{step};
        const CompressionResult result =
            compress(borrow(lumigraph.buffer()), folder.path() / "a.hgl", options, until_interrupted());
        if (result.pixels_per_bit > max_rate(lumigraph)) return result.pixels_per_bit;
        copy(open_stream(folder.path() / "a.hgl").front(), decoded, until_interrupted());
        lumigraph.add_samples(decoded.radiance.elements(), result.bytes, curve);
        return result.pixels_per_bit;
    });
    std::ranges::reverse(curve.points);
    std::ranges::reverse(curve.slices);
    return curve;
}

}  // namespace

double ThesisCurve::at(double rate) const {
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const ThesisPoint &a = points[k], &b = points[k + 1];
        if (a.pixels_per_bit <= rate && rate <= b.pixels_per_bit && a.pixels_per_bit < b.pixels_per_bit)
            return a.sqnr + (b.sqnr - a.sqnr) * std::log(rate / a.pixels_per_bit) /
                                std::log(b.pixels_per_bit / a.pixels_per_bit);
    }
    return std::numeric_limits<double>::quiet_NaN();
}

std::size_t ThesisCurve::nearest(double rate) const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < points.size(); ++k)
        if (std::abs(std::log(points[k].pixels_per_bit / rate)) <
            std::abs(std::log(points[best].pixels_per_bit / rate)))
            best = k;
    return best;
}

std::vector<ThesisCurve> thesis_curves(const LightFieldBuffer& values, const ThesisMeasurement& measurement) {
    const Lumigraph lumigraph(values, measurement);
    const auto wanted = [&](const std::string& name) {
        return measurement.transforms.empty() || std::ranges::count(measurement.transforms, name) > 0;
    };
    std::vector<ThesisCurve> curves;
    for (const auto& [name, label] : wavelets)
        if (wanted(name)) curves.push_back(three_pass_curve(lumigraph, name, label));
    if (wanted("dct8-jpeg")) curves.push_back(cosine_curve(lumigraph, zerotrees::QuantisationTable::jpeg));
    if (wanted("dct8-own")) curves.push_back(cosine_curve(lumigraph, zerotrees::QuantisationTable::own));
    if (wanted("hogel")) curves.push_back(hogel_curve(lumigraph));
    for (const char* const name : {"haar", "d6"})
        if (wanted(std::string("ezw-") + name)) curves.push_back(ezw_curve(lumigraph, name, "EZW"));
    return curves;
}

}  // namespace hogel::bench
