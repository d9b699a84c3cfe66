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

/// What the numbers of a sample are: real and imaginary parts, an amplitude and a phase, or one real number.
enum class Content { complex, amplitude_phase, real };

/// Converts the numbers of a file, as described by ExternalField, to samples of a field.
class SampleConverter {
  public:
    /// @param second  the type of imaginary parts or phases where a sample has two numbers
    /// Throws Error(usage) if the description does not suit the content: real numbers without values, two numbers with
    /// them, phases as whole numbers without a phase code. Throws Error(bad_input) for whole numbers that no code has.
    SampleConverter(const std::filesystem::path& path, const ExternalField& what, Content content, Number first,
                    Number second);

    /// The numbers that stand for 0 in real and imaginary parts.
    void set_zero(double real, double imaginary) { zero_[0] = real, zero_[1] = imaginary; }

    /// The largest whole number of a phase, where that is less than its type holds; 0 for other numbers.
    void set_largest_phase(std::size_t largest) { largest_ = static_cast<double>(largest); }

    /// The sample for a real number, or for the two numbers of a sample, which may not be finite: see require_finite().
    std::complex<float> operator()(double first, double second) const;

  private:
    double phase_of(double number) const;

    std::filesystem::path path_;
    Content content_;
    bool phases_;  // whether the numbers that are no complex ones are, or hold, phases
    double sign_;  // sign of imaginary parts
    double zero_[2] = {0, 0};
    std::optional<PhaseCode> code_;
    double largest_ = 0;  // of a phase's numbers; 0 where they are not whole
};

/// What a description says that pairs of real numbers are: Content::complex or Content::amplitude_phase; then it says
/// no more of their values. Throws Error(usage) if it says something else.
Content take_pairs(const std::filesystem::path& path, ExternalField& what);

// Each opens a file of one format, and knows one by its first bytes. They throw Error(bad_input) for damage, and
// Error(usage) where `what` does not suit the numbers.
std::unique_ptr<FieldSource> open_npy(const std::filesystem::path& path, const ExternalField& what);
std::unique_ptr<FieldSource> open_npz(const std::filesystem::path& path, const ExternalField& what);
std::unique_ptr<FieldSource> open_mat(const std::filesystem::path& path, const ExternalField& what);
std::unique_ptr<FieldSource> open_ohc(const std::filesystem::path& path, const ExternalField& what);
std::unique_ptr<FieldSource> open_exr_field(const std::filesystem::path& path, const ExternalField& what);
std::unique_ptr<FieldSource> open_picture_field(const std::filesystem::path& path, const ExternalField& what);

bool is_npy(std::span<const unsigned char> start);
bool is_zip(std::span<const unsigned char> start);
bool is_mat(std::span<const unsigned char> start);
bool is_ohc(std::span<const unsigned char> start);
/// Whether an EXR file holds channels of fields, and not a picture. Throws Error(bad_input).
bool is_exr_field(const std::filesystem::path& path, std::span<const unsigned char> start);
/// Whether the texts of a picture describe the field that its numbers encode: see field_entries(). Throws
/// Error(bad_input).
bool is_picture_field(const std::filesystem::path& path);

// What the files say of themselves.
ExternalFacts npy_facts(const std::filesystem::path& path);
ExternalFacts npz_facts(const std::filesystem::path& path, const ExternalField& what);
ExternalFacts mat_facts(const std::filesystem::path& path, const ExternalField& what);
ExternalFacts ohc_facts(const std::filesystem::path& path);
ExternalFacts exr_facts(const std::filesystem::path& path);
ExternalFacts picture_facts(const std::filesystem::path& path, const ExternalField& what);

/// The grid of an array centred at x = y = 0. What the description leaves out is taken from the file. Throws
/// Error(bad_input) for an empty array, and Error(usage) if neither says it.
FieldGrid external_grid(const std::filesystem::path& path, const ExternalField& what, const ExternalFacts& facts);

/// Work on the bytes of whole arrays checks for a stop after so many.
inline constexpr std::size_t bytes_between_checks = std::size_t{16} << 20;

/// All bytes of a file.
std::vector<unsigned char> all_bytes(const std::filesystem::path& path);

[[noreturn]] void fail_external(const std::filesystem::path& path, const std::string& why);

}  // namespace hogel::io::arrays
