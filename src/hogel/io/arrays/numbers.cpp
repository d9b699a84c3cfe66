// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/arrays/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "hogel/core/half.h"
#include "hogel/core/raw_file.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"

namespace hogel::io::arrays {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are stored in memory as in the files");

template <class T>
double value_at(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

}  // namespace

void fail_external(const std::filesystem::path& path, const std::string& why) {
    throw Error(ErrorCode::bad_input, fmt::format("cannot read '{}': {}", path.string(), why));
}

std::vector<unsigned char> all_bytes(const std::filesystem::path& path) {
    const core::RawFile file(path, core::RawFile::Mode::read, path);
    std::vector<unsigned char> bytes(file.size());
    for (std::size_t offset = 0; offset < bytes.size(); offset += bytes_between_checks) {
        core::throw_if_stopped();
        file.read(offset, &bytes[offset], std::min(bytes_between_checks, bytes.size() - offset));
    }
    return bytes;
}

bool is_whole(Number number) { return number != Number::half && number != Number::single && number != Number::real; }

double number_at(Number number, const unsigned char* bytes) {
    switch (number) {
        case Number::boolean:
            return *bytes != 0 ? 1 : 0;
        case Number::int8:
            return value_at<std::int8_t>(bytes);
        case Number::uint8:
            return value_at<std::uint8_t>(bytes);
        case Number::int16:
            return value_at<std::int16_t>(bytes);
        case Number::uint16:
            return value_at<std::uint16_t>(bytes);
        case Number::int32:
            return value_at<std::int32_t>(bytes);
        case Number::uint32:
            return value_at<std::uint32_t>(bytes);
        case Number::int64:
            return value_at<std::int64_t>(bytes);
        case Number::uint64:
            return value_at<std::uint64_t>(bytes);
        case Number::half: {
            std::uint16_t half;
            std::memcpy(&half, bytes, sizeof half);
            return static_cast<double>(core::float_of(half));
        }
        case Number::single:
            return value_at<float>(bytes);
        case Number::real:
            break;
    }
    return value_at<double>(bytes);
}

SampleConverter::SampleConverter(const std::filesystem::path& path, const ExternalField& description, Content content,
                                 Number first, Number second)
    : path_(path),
      content_(content),
      phases_(content == Content::amplitude_phase || description.values == ExternalField::Values::phase),
      sign_(description.conjugate ? -1 : 1),
      code_(description.phase_code) {
    using Values = ExternalField::Values;
    if (content != Content::real && description.values != Values::complex)
        throw Error(ErrorCode::usage, "values",
                    fmt::format("'{}' holds {}, not {}", path.string(),
                                content == Content::complex ? "complex numbers" : "amplitudes and phases",
                                description.values == Values::phase       ? "phases"
                                : description.values == Values::amplitude ? "amplitudes"
                                                                          : "pairs of real numbers"));
    if (content == Content::real && description.values == Values::complex)
        throw Error(ErrorCode::usage, "values",
                    fmt::format("'{}' holds real numbers: are they amplitudes or phases?", path.string()));
    if (content == Content::real &&
        (description.values == Values::real_imaginary || description.values == Values::amplitude_phase))
        throw Error(ErrorCode::usage, "values",
                    fmt::format("'{}' holds one real number a sample, not pairs of them", path.string()));
    if (!phases_ && code_)
        throw Error(ErrorCode::usage, "phase_code",
                    fmt::format("'{}' is not read as phases, so no phase code applies to it", path.string()));
    const Number number = content == Content::real ? first : second;
    if (!phases_ || !is_whole(number)) return;
    if (number != Number::boolean && number != Number::uint8 && number != Number::uint16)
        fail_external(
            path,
            "phases in signed integers or more than 16 bits have no known full turn; expected uint8, uint16, or "
            "floats from 0 to 1");
    if (!code_)
        throw Error(ErrorCode::usage, "phase_code",
                    fmt::format("'{}' holds phases as whole numbers: in which phase code are they?", path.string()));
    largest_ = number == Number::boolean ? 1 : number == Number::uint8 ? 255 : 65535;
}

double SampleConverter::phase_of(double number) const {
    // Levels of a picture that were converted to floats have lost their number of levels.
    if (constexpr double rounding = 1e-3; code_ && largest_ == 0 && !(number >= -rounding && number <= 1 + rounding))
        fail_external(path_, fmt::format("it holds the phase {:.9g}, but in a phase code floats count from 0 to 1; "
                                         "whole numbers are read as uint8 and uint16",
                                         number));
    return std::fmod(code_ ? code_->phase(number, largest_) : number, 2 * std::numbers::pi);
}

std::complex<float> SampleConverter::operator()(double first, double second) const {
    std::complex<double> value(first - zero_[0], second - zero_[1]);
    if (phases_)
        value =
            content_ == Content::real ? std::polar(1.0, phase_of(first)) : first * std::polar(1.0, phase_of(second));
    return std::complex<float>(std::complex<double>(value.real(), sign_ * value.imag()));
}

Content take_pairs(const std::filesystem::path& path, ExternalField& description) {
    using Values = ExternalField::Values;
    if (description.values != Values::real_imaginary && description.values != Values::amplitude_phase)
        throw Error(ErrorCode::usage, "values",
                    fmt::format("'{}' holds pairs of real numbers: are they real and imaginary "
                                "parts, or amplitudes and phases?",
                                path.string()));
    const bool complex = description.values == Values::real_imaginary;
    description.values = Values::complex;
    return complex ? Content::complex : Content::amplitude_phase;
}

FieldGrid external_grid(const std::filesystem::path& path, const ExternalField& description,
                        const ExternalFacts& facts) {
    if (facts.width == 0 || facts.height == 0)
        fail_external(path, fmt::format("its array of {}x{} is empty", facts.width, facts.height));
    if (description.colour >= facts.colours)
        throw Error(ErrorCode::usage,
                    fmt::format("'{}' has no colour {}: it holds {}", path.string(), description.colour,
                                facts.colours == 1 ? "one field" : "fewer fields"));
    const bool has_pitch = description.pitch_x > 0 && description.pitch_y > 0;
    if ((!has_pitch || !(description.wavelength > 0)) && !facts.complaint.empty())
        throw Error(ErrorCode::usage, fmt::format("'{}': {}", path.string(), facts.complaint));
    const double wavelength = description.wavelength > 0 || facts.wavelengths.size() != facts.colours
                                  ? description.wavelength
                                  : facts.wavelengths[description.colour];
    const FieldGrid grid{{facts.width, facts.height, has_pitch ? description.pitch_x : facts.pitch_x,
                          has_pitch ? description.pitch_y : facts.pitch_y, 0, 0},
                         wavelength};
    validate(grid, ErrorCode::usage, fmt::format("'{}'", path.string()));
    return grid;
}

}  // namespace hogel::io::arrays
