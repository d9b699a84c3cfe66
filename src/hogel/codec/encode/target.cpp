// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/target.h"

#include <fmt/format.h>

#include <cmath>

#include "hogel/error.h"

namespace hogel::codec::encode {
namespace {

constexpr double likely_bounded_step = 3;        // times the error bound
constexpr double likely_lossless_step = 0x1p-7;  // times the root mean square
constexpr double likely_step_of_rate = 0.1;      // times the root mean square
// Maximum bits per sample, because floats have 24 significant bits.
constexpr double max_bits_of_sample = 24;
constexpr double max_overhead = 32;

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;  // clang 16 does not deduce it

std::string describe(const CompressionTarget& target) {
    return std::visit(
        Overloaded{[](const Sqnr& t) { return fmt::format("an SQNR of {} dB", t.decibels); },
                   [](const PixelsPerBit& t) { return fmt::format("a rate of {} pixels per bit", t.rate); },
                   [](const Step& t) { return fmt::format("a step of {}", t.radiance); },
                   [](const MaxError& t) { return fmt::format("an error of at most {}", t.radiance); },
                   [](const Lossless&) { return std::string("lossless coding"); }},
        target);
}

const char* parameter_of(const CompressionTarget& target) {
    return std::visit(Overloaded{[](const Sqnr&) { return "sqnr"; }, [](const PixelsPerBit&) { return "ppb"; },
                                 [](const Step&) { return "step"; }, [](const MaxError&) { return "max_error"; },
                                 [](const Lossless&) { return "lossless"; }},
                      target);
}

bool positive(double value) { return value > 0 && std::isfinite(value); }

}  // namespace

void check(const CompressionTarget& target) {
    const auto refuse = [&](const char* expected) {
        throw Error(ErrorCode::usage, parameter_of(target),
                    fmt::format("{} was asked for; expected {}", describe(target), expected));
    };
    std::visit(Overloaded{[&](const Sqnr& t) {
                              if (!(t.decibels > 0 && t.decibels <= 120)) refuse("more than 0 and at most 120 dB");
                          },
                          [&](const PixelsPerBit& t) {
                              if (!positive(t.rate)) refuse("a positive number");
                              if (t.overhead && !(*t.overhead >= 0 && *t.overhead <= max_overhead))
                                  throw Error(ErrorCode::usage, "overhead",
                                              fmt::format("an overhead of {} bits was asked for, expected 0 to {}",
                                                          *t.overhead, max_overhead));
                              if (t.overhead && t.rule == RateRule::search)
                                  throw Error(ErrorCode::usage, "overhead",
                                              "an overhead was asked for of a rate that is searched for; expected the "
                                              "rule of a histogram");
                          },
                          [&](const Step& t) {
                              if (!positive(t.radiance)) refuse("a positive number");
                          },
                          [&](const MaxError& t) {
                              if (!positive(t.radiance)) refuse("a positive number");
                          },
                          [](const Lossless&) {}},
               target);
}

bool is_exact(const CompressionTarget& target) {
    return std::holds_alternative<MaxError>(target) || std::holds_alternative<Lossless>(target);
}

double likely_step(const CompressionTarget& target, double rms) {
    return std::visit(Overloaded{
                          // With detail of the step's size everywhere, the squared error is step²/12 per sample.
                          [&](const Sqnr& t) { return rms * (std::sqrt(12) * std::pow(10, -t.decibels / 20)); },
                          [&](const PixelsPerBit&) { return rms * likely_step_of_rate; },
                          [](const Step& t) { return t.radiance; },
                          [](const MaxError& t) { return likely_bounded_step * t.radiance; },
                          [&](const Lossless&) { return likely_lossless_step * rms; },
                      },
                      target);
}

double bytes_of_rate(const PixelsPerBit& target, double rays, double samples) {
    const double bytes = std::floor(rays / target.rate / 8);
    if (8 * bytes > max_bits_of_sample * samples)
        throw Error(ErrorCode::usage, "ppb",
                    fmt::format("{} was asked for, which is more than {} bits a sample; expected at least {:.3g} "
                                "pixels per bit, or lossless coding",
                                describe(target), max_bits_of_sample, rays / (max_bits_of_sample * samples)));
    return bytes;
}

double step_by_rule(const PixelsPerBit& target, ZerotreeSymbols symbols, const coding::MagnitudeHistogram& magnitudes,
                    double bits) {
    const double c = target.overhead.value_or(default_overhead(symbols));
    return target.rule == RateRule::planes ? magnitudes.step_of_planes(bits, c) : magnitudes.step(bits, c);
}

void refuse_rate(const PixelsPerBit& target, double bytes, std::uint64_t nearest) {
    const bool larger = static_cast<double>(nearest) < bytes;
    throw Error(ErrorCode::usage, "ppb",
                fmt::format("{} was asked for, which is {} bytes; the {} file of this light field has {} bytes{}",
                            describe(target), bytes, larger ? "largest" : "smallest", nearest,
                            larger ? " unless it is coded without loss" : ""));
}

void check_quality(const CompressionTarget& target, const CodingOutcome& outcome, double step,
                   const std::string& coder) {
    constexpr double max_steps = 16;
    const bool too_fine = outcome.error > max_steps * max_steps * step * step * outcome.samples;
    const auto* const sqnr = std::get_if<Sqnr>(&target);
    if (!too_fine && !(sqnr && outcome.sqnr() < sqnr->decibels)) return;
    throw Error(ErrorCode::usage, parameter_of(target),
                fmt::format("{} was asked for, which is finer than coder {} can be here: it would have {:.2f} dB; "
                            "expected a coarser target, or lossless coding",
                            describe(target), coder, outcome.sqnr()));
}

}  // namespace hogel::codec::encode
