#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "hogel/optics/field.h"

namespace hogel {

/// What a file from another program does not say of the field that is in it.
struct ForeignField {
    double pitch_x = 0, pitch_y = 0;  ///< metres between samples
    double wavelength = 0;            ///< metres

    /// What its numbers are: complex values; amplitudes of phase zero; or phases of amplitude one, radians where they
    /// are floating point numbers and 2π·code/levels where they are whole ones.
    enum class Values { complex, amplitude, phase };
    Values values = Values::complex;

    std::filesystem::path imaginary;  ///< a picture of the imaginary parts, for pictures of real parts
    std::string variable;             ///< which array of a MAT file; may be empty where it holds one alone
    bool conjugate = false;           ///< the file's time factor is e^{+iωt}
};

/// Opens a field of another program: an array in NumPy's format (.npy) or MATLAB's (.mat, up to version 7.3), or a
/// picture (of amplitudes, of phases, or two of real and imaginary parts). Row 0 is the top, column 0 the left, and the
/// middle of the array lies at x = y = 0. NPY files are read where they are asked for; others are read whole. Throws
/// Error(bad_input) for anything damaged or of another kind, and Error(usage) where it was not said what its numbers
/// are.
std::unique_ptr<FieldSource> open_foreign_field(const std::filesystem::path& path, const ForeignField& what);

/// Whether a file is an array that open_foreign_field() reads, by its first bytes.
bool is_foreign_array(const std::filesystem::path& path);

/// Writes samples[y][x] as an array of complex64 in NumPy's format. The file gets its name when it is complete. Throws
/// Error(cannot_write).
void write_npy(const std::filesystem::path& path, View<const std::complex<float>, 2> samples);

}  // namespace hogel
