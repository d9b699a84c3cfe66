// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <complex>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/image.h"
#include "hogel/light_field.h"
#include "hogel/phase_code.h"
#include "hogel/table.h"

namespace hogel {

/// Storage of samples: 16-bit or 32-bit floats (IEEE 754 binary16, binary32).
enum class SampleType { half, single };

/// Opens a light field with all faces in the file, and reads only the header. Formats: a compressed stream (.hgl), or
/// HDF5 with a dataset "radiance" [c][t][s][v][u] (half or single floats) and optionally "depth" [t][s][v][u] (single,
/// metres) per face. Attributes of "radiance" define the sampling (docs/files.md). Contiguous datasets, as hogel writes
/// them, are read by all threads at once; chunked or compressed datasets by one thread at a time. Throws
/// Error(bad_input) for a file that is missing, damaged, truncated, inconsistent or of another kind. Reading a radiance
/// that is not finite throws Error(bad_input) with the file, the hogel and the direction.
HOGEL_API LightField open_light_field(const std::filesystem::path& path);

/// Throws Error(not_built_in) in builds without HDF5, and Error(usage) for a name of another format (require_name()).
/// Call it before work that ends in an HDF5 file. The functions below that open, create or summarise HDF5 files also
/// throw Error(not_built_in).
HOGEL_API void require_hdf5(const std::filesystem::path& path);

/// Options of create_light_field().
struct LightFieldFileOptions {
    SampleType type = SampleType::half;
    bool with_depth = false;
    Metadata metadata;  ///< string attributes of the file: version and options that made it
    /// If set, interrupted work can be continued. An unfinished file X stays as "X.part" beside "X.part.journal".
    /// Creating X again with the same options continues it, and has_already() is true for completed tiles. The text
    /// identifies inputs that `metadata` does not, such as the date of an input file. Creating throws Error(usage) if
    /// the unfinished file belongs to other work.
    std::optional<std::string> resume = std::nullopt;
};

/// Creates a light field in an HDF5 file. Returns one sink per face, the front first. The file appears under its name
/// when all sinks are finished. Until then it is a temporary file in the same folder, which is removed with the sinks
/// unless it can be continued. Disk space is reserved at once, so a full disk is reported before the work begins. Half
/// floats above 65504 become infinite. Throws Error(usage) if the grids are not those of one light field or the name is
/// not that of an HDF5 file (require_name()), and Error(cannot_write).
HOGEL_API std::vector<std::unique_ptr<LightFieldSink>> create_light_field(const std::filesystem::path& path,
                                                                          std::span<const LightFieldGrid> grids,
                                                                          const LightFieldFileOptions& options = {});

/// Opens a hologram in an HDF5 file, one field per wavelength, such as red, green and blue. Field i is the dataset
/// "field<i>/samples": [y][x] of compounds {r, i} (single floats; complex64 in h5py), or [y][x][2] of half floats.
/// Attributes define sampling and wavelength (docs/files.md). Throws Error(bad_input) as open_light_field() does.
HOGEL_API Fields open_hologram(const std::filesystem::path& path);

/// Options of create_hologram().
struct HologramFileOptions {
    /// Half floats have 11 significant bits for numbers from 6·10⁻⁵ to 65504, and take half the space.
    SampleType type = SampleType::single;
    Metadata metadata = {};                            ///< as in LightFieldFileOptions
    std::optional<std::string> resume = std::nullopt;  ///< as in LightFieldFileOptions
};

/// Creates a hologram in an HDF5 file. Returns one sink per field. The file appears under its name when all sinks are
/// finished. A sink of half floats throws Error(usage) for samples above 65504. Throws Error(usage) if the name is not
/// that of an HDF5 file (require_name()), and Error(cannot_write).
HOGEL_API std::vector<std::unique_ptr<FieldSink>> create_hologram(const std::filesystem::path& path,
                                                                  std::span<const FieldGrid> grids,
                                                                  const HologramFileOptions& options = {});

/// Kinds of files.
enum class FileKind { light_field, hologram, picture, mesh, unknown };

/// Returns the kind of a file: by its contents for HDF5 and compressed light fields, otherwise by its extension
/// (file_formats()). Throws Error(bad_input) for a file that is missing or unreadable.
HOGEL_API FileKind file_kind(const std::filesystem::path& path);

/// A file format, for help texts and to recognise pictures and meshes by extension.
struct FileFormat {
    std::string name;                     ///< "hdf5"
    std::vector<std::string> extensions;  ///< in lower case: ".h5", ".hdf5"
    std::string text;                     ///< one line
    std::vector<FileKind> reads, writes;  ///< kinds of content that the library reads and writes
};

/// Returns the formats of light fields, fields, pictures and meshes in this build.
HOGEL_API Table<FileFormat>& file_formats();

/// Throws Error(usage) if the extension of a name belongs to another format than `format` ("hdf5"). Accepts unknown
/// ones.
HOGEL_API void require_name(const std::filesystem::path& path, std::string_view format);

/// Throws Error(usage) for a folder that does not exist and has a name with the extension of a file.
HOGEL_API void require_folder_name(const std::filesystem::path& path);

/// Facts about a light field or hologram file: names and values, in SI units.
struct FileSummary {
    FileKind kind = FileKind::unknown;
    std::vector<std::pair<std::string, std::string>> text;  ///< text facts, and the metadata
    std::vector<std::pair<std::string, double>> numbers;    ///< numeric facts
};

/// Reads the header of a file. For other kinds than light fields and holograms the result has only kind and size.
/// Throws Error(bad_input) for a file that is missing, damaged or unreadable.
HOGEL_API FileSummary summarize(const std::filesystem::path& path);

/// Description of a field in a file of another program, for facts that the file does not contain.
struct ExternalField {
    double pitch_x = 0, pitch_y = 0;  ///< metres between samples; 0: as the file says
    double wavelength = 0;            ///< metres; 0: as the file says

    /// Meaning of the file's numbers: complex values; amplitudes with phase zero; phases with amplitude one; or, for
    /// arrays with an axis of two real numbers, real and imaginary parts, or amplitudes and phases.
    enum class Values { complex, amplitude, phase, real_imaginary, amplitude_phase };
    Values values = Values::complex;
    /// Code of phases. Without it phases are in radians, and whole numbers are refused.
    std::optional<PhaseCode> phase_code = {};

    std::filesystem::path imaginary = {};  ///< picture of the imaginary parts, for a picture of real parts
    std::filesystem::path phases = {};     ///< picture of the phases, for a picture of amplitudes
    /// Whole number that means 0 in pictures of real and imaginary parts; default: the median of each picture.
    std::optional<double> zero = {};
    std::string variable = {};  ///< array to read if the file has several, or two: "re,im"
    bool conjugate = false;     ///< whether the file's time factor is e^{+iωt}
    /// Whether pictures are reflectances: phases have the modulus 1, and the largest level of amplitudes is 1.
    /// Otherwise the field of a pattern has the power that `hogel slm` states.
    bool reflectance = false;
    std::size_t colour = 0;   ///< index of the field, below ExternalFacts::colours
    PanelLevels panel = {};   ///< for field_entries()
    std::size_t largest = 0;  ///< number V of the phase code, or of amplitude 1; 0: the largest that the file can hold
};

/// Facts that a file of another program contains about its fields.
struct ExternalFacts {
    std::string format;                 ///< "npy"
    std::string numbers;                ///< "complex single"
    std::size_t width = 0, height = 0;  ///< samples
    std::size_t colours = 1;            ///< number of fields: one, or one per wavelength
    double pitch_x = 0, pitch_y = 0;    ///< metres; 0: unknown
    std::vector<double> wavelengths;    ///< metres, one per field; empty: unknown
    std::string complaint;              ///< why a pitch or wavelength in the file was rejected
    std::string values;                 ///< "phase" or "amplitude" if a picture says it, see field_entries()
    std::string phase_code;             ///< code of those phases, for parse_phase_code()
    PanelLevels panel;                  ///< if a picture says it: tables and flips are undone when it is read
    std::size_t largest = 0;            ///< ExternalField::largest, if a picture says it
};

/// Reads the facts of a field in a file of another program. Throws Error(bad_input) for a file that is missing or
/// damaged, and Error(usage) if it has no array `what.variable`.
HOGEL_API ExternalFacts external_facts(const std::filesystem::path& path, const ExternalField& what = {});

/// Opens a field of another program: an array of NumPy (.npy, .npz) or MATLAB (.mat up to version 7.3), a complex field
/// of OpenHolo (.ohc), an OpenEXR file with channels of real and imaginary parts or of amplitudes and phases, or
/// pictures of amplitudes, phases, both, or real and imaginary parts (docs/files.md). Facts that `what` omits are taken
/// from the file, for pictures from the texts of field_entries(). Row 0 is at the top, column 0 at the left, and the
/// centre of the array at x = y = 0. NPY files are read region by region on demand, other files when opened. Throws
/// Error(bad_input) for a file that is damaged or of another kind, and Error(usage) if `what` does not suit the file's
/// numbers, or the sampling is unknown.
HOGEL_API std::shared_ptr<const FieldSource> open_external_field(const std::filesystem::path& path,
                                                                 const ExternalField& what);

/// Returns whether the contents of a file identify it as a field: .npy, .npz, .mat, .ohc, .exr with channels of fields,
/// and pictures with the texts of field_entries(). Throws Error(bad_input) for missing files and damaged pictures.
HOGEL_API bool is_external_field(const std::filesystem::path& path);

/// Returns metadata that describe the field in a picture of numbers, such as one from write_raw_pixels(): pitch,
/// wavelengths (metres), whether the numbers are amplitudes or phases, their code, and its largest number unless that
/// is the largest of 8 bits.
HOGEL_API Metadata field_entries(const ExternalField& what, std::span<const double> wavelengths);

/// Throws Error(usage) unless the extension is one that write_fields() writes: .npy, .npz, .mat, .exr.
HOGEL_API void require_fields_name(const std::filesystem::path& path);

/// Writes fields with the same sampling, one per wavelength, as complex single floats in the format of the extension.
/// The file appears under its name when it is complete. Throws Error(usage) for another extension or fields with
/// different sampling, and Error(cannot_write).
/// - .npy: an array [y][x], or [wavelength][y][x] of several fields
/// - .npz, .mat: the same array as `field`, with `pitch` and `wavelength` in metres
/// - .exr: channels `field0.real`, `field0.imaginary` and so on, with the sampling as texts
HOGEL_API void write_fields(const std::filesystem::path& path, std::span<const Field> fields,
                            const Metadata& metadata = {});

/// Throws Error(usage) or Error(not_built_in) if write_levels() would refuse the extension of this name.
HOGEL_API void require_levels_name(const std::filesystem::path& path, std::size_t largest = 255,
                                   std::size_t channels = 1);

/// Writes drive levels of a modulator, levels[y][x][c], of 8 bits if `largest`, the largest level, is at most 255, else
/// of 16. The file appears under its name when it is complete. Throws Error(usage), Error(not_built_in) and
/// Error(cannot_write).
/// - pictures: as write_raw_pixels()
/// - .npy: an array [y][x], or [c][y][x] of several channels
/// - .h5: as SLM.save_phase() of slmsuite, for one channel: `display` is the levels, `phase` those in its phase code
HOGEL_API void write_levels(const std::filesystem::path& path, View<const std::uint16_t, 3> levels,
                            std::size_t largest = 255, const Metadata& metadata = {});

/// Writes samples[y][x] as a complex64 array in NumPy's format. The file appears under its name when it is complete.
/// Throws Error(cannot_write).
HOGEL_API void write_npy(const std::filesystem::path& path, View<const std::complex<float>, 2> samples);

}  // namespace hogel
