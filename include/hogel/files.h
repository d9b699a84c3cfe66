// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <complex>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hogel/field.h"
#include "hogel/image.h"
#include "hogel/light_field.h"
namespace hogel {

enum class SampleType { half, single };

/// Opens a light field: a compressed one (open_stream() in codec/stream.h) or one in an HDF5 file: dataset "radiance"
/// [c][t][s][v][u] (half or single floats), optional dataset "depth" [t][s][v][u] (single, metres), each one contiguous
/// piece of the file; all of the sampling in attributes of "radiance". docs/files.md names every attribute. Opening
/// reads the header alone; files of that layout are read by all threads at once, chunked or compressed ones from
/// elsewhere by one at a time. A file may hold the sides of a hemicube beside the front; this opens the front. Throws
/// Error(bad_input) for anything damaged, foreign, truncated or inconsistent.
std::unique_ptr<LightFieldSource> open_light_field(const std::filesystem::path& path);

/// All faces that a light field file holds, in the order of all_faces: the front, and whichever sides there are.
std::vector<std::unique_ptr<LightFieldSource>> open_light_field_faces(const std::filesystem::path& path);

struct LightFieldFileOptions {
    SampleType type = SampleType::half;
    bool with_depth = false;
    Metadata metadata;  ///< kept as string attributes of the file: the options and version that made it
    /// If given, work that was interrupted is gone on with: unfinished, the file stays beside its place as "X.part"
    /// with notes of what is done, and whoever creates the same file again with the same options finds these tiles
    /// already written. The text tells inputs apart that metadata does not, such as a file's date. Throws Error(usage)
    /// where the unfinished file is of other work.
    std::optional<std::string> resume = std::nullopt;
};

/// The file gets its own name when finish() is called; before that it is a temporary beside it, removed when the sink
/// is destroyed unfinished. Room on the disk is taken at once, so a disk that is too small shows before the work.
/// RayValues beyond 65504 are infinite in half floats. Throws Error(cannot_write).
std::unique_ptr<LightFieldSink> create_light_field(const std::filesystem::path& path, const LightFieldGrid& grid,
                                                   const LightFieldFileOptions& options = {});

/// Several faces of the same hogels in one file, the front first: one sink a face, each must be finished, and the file
/// gets its own name when the last one is.
std::vector<std::unique_ptr<LightFieldSink>> create_light_field_faces(const std::filesystem::path& path,
                                                                      std::span<const LightFieldGrid> grids,
                                                                      const LightFieldFileOptions& options = {});

/// A hologram: one field, or three that share a plane's extent for red, green and blue. In HDF5 a group "field<i>" a
/// wavelength with a dataset "samples": [y][x] of compound {r, i} (single), which h5py reads as complex64, or
/// [y][x][2] of half floats; and attributes pitch, wavelength and pose.
struct HologramFile {
    std::vector<std::unique_ptr<FieldSource>> fields;
    Metadata metadata;
};
HologramFile open_hologram(const std::filesystem::path& path);

struct HologramFileOptions {
    /// Halves keep 11 bits of numbers from 6·10⁻⁵ to 65504, in half the room.
    SampleType type = SampleType::single;
    Metadata metadata = {};                            ///< as in LightFieldFileOptions
    std::optional<std::string> resume = std::nullopt;  ///< as in LightFieldFileOptions
};

/// One sink a field; each must be finished. The file gets its own name when the last one is. A sink of halves throws
/// Error(usage) for samples that are too large for them.
std::vector<std::unique_ptr<FieldSink>> create_hologram(const std::filesystem::path& path,
                                                        std::span<const FieldGrid> grids,
                                                        const HologramFileOptions& options = {});

enum class FileKind { light_field, hologram, picture, mesh, unknown };

/// What a file is, by its contents where it is HDF5 or a compressed light field and by its extension otherwise. Throws
/// Error(bad_input) for a file that is missing or cannot be read.
FileKind file_kind(const std::filesystem::path& path);

/// What `hogel info` prints of a light field or hologram file: name and value, in SI units.
struct FileSummary {
    FileKind kind = FileKind::unknown;
    std::vector<std::pair<std::string, std::string>> text;  ///< string-valued facts, metadata included
    std::vector<std::pair<std::string, double>> numbers;    ///< numeric facts
};
FileSummary summarize(const std::filesystem::path& path);

/// What a file from another program does not say of the field that is in it.
struct ExternalField {
    double pitch_x = 0, pitch_y = 0;  ///< metres between samples
    double wavelength = 0;            ///< metres

    /// What its numbers are: complex values; amplitudes of phase zero; or phases of amplitude one, radians where they
    /// are floating point numbers and 2π·code/levels where they are whole ones.
    enum class RayValues { complex, amplitude, phase };
    RayValues values = RayValues::complex;

    std::filesystem::path imaginary;  ///< a picture of the imaginary parts, for pictures of real parts
    std::string variable;             ///< which array of a MAT file; may be empty where it holds one alone
    bool conjugate = false;           ///< the file's time factor is e^{+iωt}
};

/// Opens a field of another program: an array in NumPy's format (.npy) or MATLAB's (.mat, up to version 7.3), or a
/// picture (of amplitudes, of phases, or two of real and imaginary parts). Row 0 is the top, column 0 the left, and the
/// middle of the array lies at x = y = 0. NPY files are read where they are asked for; others are read whole. Throws
/// Error(bad_input) for anything damaged or of another kind, and Error(usage) where it was not said what its numbers
/// are.
std::unique_ptr<FieldSource> open_external_field(const std::filesystem::path& path, const ExternalField& what);

/// Whether a file is an array that open_external_field() reads, by its first bytes.
bool is_external_array(const std::filesystem::path& path);

/// Writes samples[y][x] as an array of complex64 in NumPy's format. The file gets its name when it is complete. Throws
/// Error(cannot_write).
void write_npy(const std::filesystem::path& path, View<const std::complex<float>, 2> samples);

}  // namespace hogel
