// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/step_search.h"

#include <cmath>
#include <limits>
#include <utility>

#include "hogel/codec/encode/secant_search.h"

namespace hogel::codec::encode {
namespace {

constexpr double sqnr_tolerance = 0.1;
constexpr int max_passes = 12;
constexpr double min_difference = 1e-5;

}  // namespace

double CodingOutcome::sqnr() const {
    return error > 0 ? 10 * std::log10(signal / error) : std::numeric_limits<double>::infinity();
}

void CodingOutcome::add(const CodingOutcome& other) {
    signal += other.signal;
    error += other.error;
    bytes += other.bytes;
    samples += other.samples;
}

StepBand band_of_sqnr(double sqnr) { return {sqnr, sqnr + sqnr_tolerance, true, -5.5}; }

StepBand band_of_bytes(double bytes, double tolerance, bool embedded) {
    const double max_size = std::log2(bytes);
    if (embedded) return {max_size, max_size + std::log2(1 + tolerance), true, -0.9};
    return {max_size + std::log2(1 - tolerance), max_size, false, -0.9};
}

double StepSearch::step() const { return std::exp2(log_step_); }

double StepSearch::code_at(double log_step, const Code& code) {
    log_step_ = log_step;
    outcome_ = code(step());
    ++passes_;
    return figure_(outcome_);
}

StepFound StepSearch::run(const StepBand& band, const Code& code) {
    Search search(band.low, band.high, log_step_, slope_.value_or(band.slope));
    std::optional<std::pair<double, double>> best;  // logarithm of the step, and its figure
    for (int pass = 0; pass < max_passes; ++pass) {
        const double log_step = search.next(), figure = code_at(log_step, code);
        const bool found = search.add(figure);
        slope_ = search.slope();
        if (found) return StepFound::in_band;
        if (band.above_is_better ? figure > band.high && !(best && best->second < figure)
                                 : figure < band.low && !(best && best->second > figure))
            best = {log_step, figure};
        if (search.above() && search.below() && *search.below() - *search.above() < min_difference) break;
    }
    if (best && best->first != log_step_) code_at(best->first, code);
    if (!search.below()) return StepFound::only_above;
    return search.above() ? StepFound::beside_band : StepFound::only_below;
}

}  // namespace hogel::codec::encode
