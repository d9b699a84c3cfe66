// SPDX-License-Identifier: Apache-2.0
#include "bench/codec/rate_curve.h"

#include <algorithm>
#include <cmath>

#include "bench/measure.h"
#include "bench/session.h"
#include "bench/temporary_folder.h"
#include "hogel/compress.h"
#include "hogel/resources.h"

namespace hogel::bench {
namespace {

double root_mean_square(const LightFieldBuffer& field) {
    double sum = 0;
    for (const float value : field.radiance.elements()) sum += static_cast<double>(value) * value;
    return std::sqrt(sum / static_cast<double>(field.radiance.size()));
}

// Interpolates between two points: linearly in SQNR, and in the logarithms of the rest.
RatePoint between(const RatePoint& a, const RatePoint& b, double part) {
    const auto mean = [&](double RatePoint::*member) { return a.*member * std::pow(b.*member / a.*member, part); };
    return {mean(&RatePoint::pixels_per_bit), a.sqnr + part * (b.sqnr - a.sqnr), mean(&RatePoint::encoding),
            mean(&RatePoint::decoding)};
}

}  // namespace

std::optional<RatePoint> RateCurve::at(double sqnr) const {
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const RatePoint &fine = points[k], &coarse = points[k + 1];
        if (!(fine.sqnr >= sqnr && coarse.sqnr <= sqnr && fine.sqnr > coarse.sqnr)) continue;
        return between(fine, coarse, (fine.sqnr - sqnr) / (fine.sqnr - coarse.sqnr));
    }
    return std::nullopt;
}

std::optional<RatePoint> RateCurve::at_rate(double pixels_per_bit) const {
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const double fine = points[k].pixels_per_bit, coarse = points[k + 1].pixels_per_bit;
        if (!(fine <= pixels_per_bit && coarse >= pixels_per_bit && fine < coarse)) continue;
        return between(points[k], points[k + 1], std::log(pixels_per_bit / fine) / std::log(coarse / fine));
    }
    return std::nullopt;
}

RateCurve measure_method(const LightFieldBuffer& field, const CodingMethod& method, const QualityRange& range) {
    constexpr int max_points = 24;
    const ThreadLimit one(1);
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "a.hgl";
    RateCurve curve{method.transform.empty() ? method.coder : method.coder + " " + method.transform, {}};
    if (method.table == QuantisationTable::jpeg) curve.name = method.coder + ", table jpeg";
    CompressionOptions options;
    options.method = method;
    // The error of a quantiser is step/√12 where there is detail of the step's size, and less elsewhere.
    double step = root_mean_square(field) * std::sqrt(12.0) * std::pow(10, -range.low / 20) * 16;
    const double samples = field.grid().samples() * 1e-6;
    LightFieldBuffer decoded(field.grid());
    for (int k = 0; k < max_points; ++k, step /= 1.6) {
        options.target = Step{step};
        double began = processor_seconds();
        const CompressionResult result = compress(borrow(field), path, options, until_interrupted());
        const double encoding = processor_seconds() - began;
        if (result.sqnr < range.low - 6) {
            // If the SQNR is far outside the range, takes most of the distance in one step.
            step *= std::pow(10, std::min(0.0, (result.sqnr - range.low + 8) / 20));
            continue;
        }
        began = processor_seconds();
        copy(open_stream(path).front(), decoded, until_interrupted());
        const double decoding = processor_seconds() - began;
        curve.points.push_back({result.pixels_per_bit, result.sqnr, samples / encoding, samples / decoding});
        if (result.sqnr > range.high) break;
    }
    std::ranges::sort(curve.points, std::greater<>{}, &RatePoint::sqnr);
    return curve;
}

}  // namespace hogel::bench
