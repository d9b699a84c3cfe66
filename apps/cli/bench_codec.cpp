#include "bench_codec.h"

#include <algorithm>
#include <cmath>

#include "hogel/codec/compress.h"
#include "hogel/core/parallel.h"
#include "resources.h"
#include "temporary_folder.h"

namespace hogel::cli {
namespace {

double root_mean_square(const LightField& field) {
    double sum = 0;
    for (const float value : field.radiance.elements()) sum += static_cast<double>(value) * value;
    return std::sqrt(sum / static_cast<double>(field.radiance.size()));
}

}  // namespace

std::optional<RatePoint> RateCurve::at(double sqnr) const {
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const RatePoint &fine = points[k], &coarse = points[k + 1];
        if (!(fine.sqnr >= sqnr && coarse.sqnr <= sqnr && fine.sqnr > coarse.sqnr)) continue;
        const double part = (fine.sqnr - sqnr) / (fine.sqnr - coarse.sqnr);
        const auto between = [&](double a, double b) { return a * std::pow(b / a, part); };
        return RatePoint{between(fine.pixels_per_bit, coarse.pixels_per_bit), sqnr,
                         between(fine.encoding, coarse.encoding), between(fine.decoding, coarse.decoding)};
    }
    return std::nullopt;
}

RateCurve measure_method(const LightField& field, const CodingMethod& method, const QualityRange& range) {
    constexpr int most_points = 24;
    const ThreadLimit one(1);
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "a.hgl";
    RateCurve curve{method.transform.empty() ? method.coder : method.coder + " " + method.transform, {}};
    CompressionOptions options;
    options.method = method;
    // An error of step/√12 where there is detail of the step's size; less where there is none.
    double step = root_mean_square(field) * std::sqrt(12.0) * std::pow(10, -range.low / 20) * 16;
    const double samples = field.grid().samples() * 1e-6;
    LightField decoded(field.grid());
    for (int k = 0; k < most_points; ++k, step /= 1.6) {
        options.target.step = step;
        double began = processor_seconds();
        const CompressionResult result = compress(field, path, options);
        const double encoding = processor_seconds() - began;
        if (result.sqnr < range.low - 6) continue;
        began = processor_seconds();
        copy(*open_stream(path), decoded);
        const double decoding = processor_seconds() - began;
        curve.points.push_back({result.pixels_per_bit, result.sqnr, samples / encoding, samples / decoding});
        if (result.sqnr > range.high) break;
    }
    std::ranges::sort(curve.points, std::greater<>{}, &RatePoint::sqnr);
    return curve;
}

}  // namespace hogel::cli
