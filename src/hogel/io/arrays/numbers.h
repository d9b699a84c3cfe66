// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>

#include "hogel/array.h"
#include "hogel/files.h"
#include "hogel/io/finite.h"
#include "hogel/io/number.h"

namespace hogel::io::arrays {

using io::bytes_of;
using io::Number;
double number_at(Number number, const unsigned char* at);
bool is_whole(Number number);

/// Contents of a sample: real and imaginary parts, amplitude and phase, or one real number.
enum class Content { complex, amplitude_phase, real };

/// Converter from the numbers of a file, as described by ExternalField, to samples of a field.
class SampleConverter {
  public:
    /// @param second  type of the second number: imaginary parts or phases
    /// Throws Error(usage) if the description does not fit the content: real numbers without values, two numbers with
    /// values, integer phases without a phase code. Throws Error(bad_input) for integers that no phase code uses.
    SampleConverter(const std::filesystem::path& path, const ExternalField& description, Content content, Number first,
                    Number second);

    /// Sets the numbers that represent 0 in real and imaginary parts.
    void set_zero(double real, double imaginary) { zero_[0] = real, zero_[1] = imaginary; }

    /// Sets the largest integer of a phase if it is below the maximum of its type; 0 for other numbers.
    void set_largest_phase(std::size_t largest) { largest_ = static_cast<double>(largest); }

    /// Converts a real number, or the two numbers of a sample. The result may not be finite: see require_finite().
    std::complex<float> operator()(double first, double second) const;

  private:
    double phase_of(double number) const;

    std::filesystem::path path_;
    Content content_;
    bool phases_;  // whether the numbers are, or contain, phases
    double sign_;  // sign of imaginary parts
    double zero_[2] = {0, 0};
    std::optional<PhaseCode> code_;
    double largest_ = 0;  // of an integer phase; 0 for floating-point numbers
};

/// Returns the content of pairs of real numbers according to the description, Content::complex or
/// Content::amplitude_phase, and resets its values. Throws Error(usage) for other descriptions.
Content take_pairs(const std::filesystem::path& path, ExternalField& description);

// Per format. Throw Error(bad_input) for damage, and Error(usage) if the description does not fit the numbers.
std::unique_ptr<FieldSource> open_npy(const std::filesystem::path& path, const ExternalField& description);
std::unique_ptr<FieldSource> open_npz(const std::filesystem::path& path, const ExternalField& description);
std::unique_ptr<FieldSource> open_mat(const std::filesystem::path& path, const ExternalField& description);
std::unique_ptr<FieldSource> open_ohc(const std::filesystem::path& path, const ExternalField& description);
std::unique_ptr<FieldSource> open_exr_field(const std::filesystem::path& path, const ExternalField& description);
std::unique_ptr<FieldSource> open_picture_field(const std::filesystem::path& path, const ExternalField& description);

bool is_npy(std::span<const unsigned char> start);
bool is_zip(std::span<const unsigned char> start);
bool is_mat(std::span<const unsigned char> start);
bool is_ohc(std::span<const unsigned char> start);
/// Returns whether an EXR file holds fields instead of a picture. Throws Error(bad_input).
bool is_exr_field(const std::filesystem::path& path, std::span<const unsigned char> start);
/// Returns whether the texts of a picture describe an encoded field: see field_entries(). Throws Error(bad_input).
bool is_picture_field(const std::filesystem::path& path);

ExternalFacts npy_facts(const std::filesystem::path& path);
ExternalFacts npz_facts(const std::filesystem::path& path, const ExternalField& description);
ExternalFacts mat_facts(const std::filesystem::path& path, const ExternalField& description);
ExternalFacts ohc_facts(const std::filesystem::path& path);
ExternalFacts exr_facts(const std::filesystem::path& path);
ExternalFacts picture_facts(const std::filesystem::path& path, const ExternalField& description);

/// Returns the grid of an array centred at x = y = 0. Missing values of the description are taken from the file. Throws
/// Error(bad_input) for an empty array, and Error(usage) if neither states a value.
FieldGrid external_grid(const std::filesystem::path& path, const ExternalField& description,
                        const ExternalFacts& facts);

/// Interval between stop checks when processing whole arrays, bytes.
inline constexpr std::size_t bytes_between_checks = std::size_t{16} << 20;

std::vector<unsigned char> all_bytes(const std::filesystem::path& path);

[[noreturn]] void fail_external(const std::filesystem::path& path, const std::string& why);

}  // namespace hogel::io::arrays
