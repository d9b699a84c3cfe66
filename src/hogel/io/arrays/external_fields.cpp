// SPDX-License-Identifier: Apache-2.0
#include "hogel/files.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "hogel/core/half.h"
#include "hogel/core/raw_file.h"
#include "hogel/error.h"
#include "hogel/image.h"
#include "hogel/io/arrays/numbers.h"

namespace hogel::io::arrays {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are stored in memory as in the files");

template <class T>
double value_at(const unsigned char* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
}

std::vector<unsigned char> first_bytes(const std::filesystem::path& path) {
    const core::RawFile file(path, core::RawFile::Mode::read, path);
    std::vector<unsigned char> start(std::min<std::uint64_t>(file.size(), 128));
    file.read(0, start.data(), start.size());
    return start;
}

}  // namespace

void fail_external(const std::filesystem::path& path, const std::string& why) {
    throw Error(ErrorCode::bad_input, fmt::format("cannot read '{}': {}", path.string(), why));
}

std::size_t bytes_of(Number number) {
    switch (number) {
        case Number::int8:
        case Number::uint8:
            return 1;
        case Number::int16:
        case Number::uint16:
        case Number::half:
            return 2;
        case Number::int32:
        case Number::uint32:
        case Number::single:
            return 4;
        case Number::int64:
        case Number::uint64:
        case Number::real:
            break;
    }
    return 8;
}

double number_at(Number number, const unsigned char* at) {
    switch (number) {
        case Number::int8:
            return value_at<std::int8_t>(at);
        case Number::uint8:
            return value_at<std::uint8_t>(at);
        case Number::int16:
            return value_at<std::int16_t>(at);
        case Number::uint16:
            return value_at<std::uint16_t>(at);
        case Number::int32:
            return value_at<std::int32_t>(at);
        case Number::uint32:
            return value_at<std::uint32_t>(at);
        case Number::int64:
            return value_at<std::int64_t>(at);
        case Number::uint64:
            return value_at<std::uint64_t>(at);
        case Number::half: {
            std::uint16_t half;
            std::memcpy(&half, at, sizeof half);
            return static_cast<double>(core::float_of(half));
        }
        case Number::single:
            return value_at<float>(at);
        case Number::real:
            break;
    }
    return value_at<double>(at);
}

SampleConverter::SampleConverter(const std::filesystem::path& path, const ExternalField& what, Number number,
                                 bool complex)
    : path_(path), values_(what.values), sign_(what.conjugate ? -1 : 1) {
    using Values = ExternalField::Values;
    if (complex && values_ != Values::complex)
        throw Error(ErrorCode::usage, fmt::format("'{}' holds complex numbers, not {}", path.string(),
                                                  values_ == Values::phase ? "phases" : "amplitudes"));
    if (!complex && values_ == Values::complex)
        throw Error(ErrorCode::usage,
                    fmt::format("'{}' holds real numbers: are they amplitudes or phases?", path.string()));
    const bool whole = number != Number::half && number != Number::single && number != Number::real;
    if (whole && bytes_of(number) > 2 && values_ == Values::phase)
        fail_external(path, "phases as whole numbers of more than 16 bits have no known unit");
    radians_ = whole ? 2 * std::numbers::pi / std::exp2(8.0 * static_cast<double>(bytes_of(number))) : 1;
}

std::complex<float> SampleConverter::operator()(double real, double imaginary) const {
    std::complex<double> value(real, imaginary);
    if (values_ == ExternalField::Values::phase)
        value = std::polar(1.0, std::fmod(real * radians_, 2 * std::numbers::pi));
    const std::complex<float> sample(std::complex<double>(value.real(), sign_ * value.imag()));
    if (!std::isfinite(sample.real()) || !std::isfinite(sample.imag()))
        fail_external(path_, fmt::format("it holds the value {} + {}i, which no field has", real, imaginary));
    return sample;
}

FieldGrid external_grid(const std::filesystem::path& path, const ExternalField& what, std::size_t width,
                        std::size_t height) {
    if (width == 0 || height == 0) fail_external(path, fmt::format("its array of {}x{} is empty", width, height));
    const FieldGrid grid{{width, height, what.pitch_x, what.pitch_y, 0, 0}, what.wavelength};
    validate(grid, ErrorCode::usage, fmt::format("'{}'", path.string()));
    return grid;
}

std::unique_ptr<FieldSource> open_picture_field(const std::filesystem::path& path, const ExternalField& what) {
    const auto number = [](const RawPixels& pixels) {
        return pixels.levels == 0 ? Number::single : pixels.levels == 256 ? Number::uint8 : Number::uint16;
    };
    const RawPixels real = read_raw_pixels(path);
    const std::size_t height = real.values.extent(0), width = real.values.extent(1);
    const bool complex = !what.imaginary.empty();
    const SampleConverter convert(path, what, number(real), complex);
    auto field = std::make_unique<Field>(external_grid(path, what, width, height));
    Array<float, 2> imaginary(real.values.shape());
    if (complex) {
        const RawPixels other = read_raw_pixels(what.imaginary);
        if (real.levels != 0 || other.levels != 0)
            fail_external(path, "real and imaginary parts are expected in pictures of floating point numbers");
        if (other.values.shape() != real.values.shape())
            fail_external(what.imaginary, fmt::format("it has {}x{} pixels, but the real parts have {}x{}",
                                                      other.values.extent(1), other.values.extent(0), width, height));
        imaginary = other.values;
    }
    for (std::size_t i = 0; i < real.values.size(); ++i)
        field->samples.data()[i] = convert(double{real.values.data()[i]}, double{imaginary.data()[i]});
    return field;
}

}  // namespace hogel::io::arrays

namespace hogel {

using namespace io::arrays;

bool is_external_array(const std::filesystem::path& path) {
    const std::vector<unsigned char> start = first_bytes(path);
    return is_npy(start) || is_mat(start);
}

std::size_t external_colours(const std::filesystem::path& path) {
    return is_npy(first_bytes(path)) ? npy_colours(path) : 1;
}

std::shared_ptr<const FieldSource> open_external_field(const std::filesystem::path& path, const ExternalField& what) {
    const std::vector<unsigned char> start = first_bytes(path);
    if (!is_npy(start) && what.colour > 0)
        throw Error(ErrorCode::usage,
                    fmt::format("'{}' has no colour {}: it holds one field", path.string(), what.colour));
    if (!is_npy(start) && !is_mat(start)) return open_picture_field(path, what);
    if (!what.imaginary.empty())
        throw Error(ErrorCode::usage,
                    fmt::format("'{}' is an array; imaginary parts of their own go with a picture", path.string()));
    return is_npy(start) ? open_npy(path, what) : open_mat(path, what);
}

}  // namespace hogel
