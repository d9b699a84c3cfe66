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

/// How samples are stored: 16-bit or 32-bit floats (IEEE 754 binary16, binary32).
enum class SampleType { half, single };

/// Opens a light field with all faces that the file holds: a compressed one (.hgl), or one in an HDF5 file with a
/// dataset "radiance" [c][t][s][v][u] (half or single floats) and optionally a dataset "depth" [t][s][v][u] (single,
/// metres) for each face. The sampling is in attributes of "radiance"; docs/files.md names them all. Opening reads only
/// the header. Contiguous datasets, as hogel writes them, are read by all threads at once, chunked or compressed ones
/// by one thread at a time. Throws Error(bad_input) for a file that is missing, damaged, truncated, inconsistent or of
/// another kind; and reading a radiance that is not finite throws it, with the file, the hogel and the direction.
HOGEL_API LightField open_light_field(const std::filesystem::path& path);

/// Throws Error(not_built_in) in a build without HDF5, in which the functions below that open, create or summarise HDF5
/// files throw it too, and Error(usage) for a name that belongs to another format (require_name()). To be called before
/// work whose result is to be such a file.
HOGEL_API void require_hdf5(const std::filesystem::path& path);

/// Options of create_light_field().
struct LightFieldFileOptions {
    SampleType type = SampleType::half;
    bool with_depth = false;
    Metadata metadata;  ///< string attributes of the file: the version and the options that made it
    /// If given, interrupted work can be resumed. The unfinished file X stays as "X.part" beside "X.part.journal";
    /// creating X again with the same options continues it, and has_already() is true for the tiles that are done. The
    /// text identifies inputs that `metadata` does not, such as the date of an input file. Creating throws Error(usage)
    /// if the unfinished file belongs to other work.
    std::optional<std::string> resume = std::nullopt;
};

/// Creates a light field in an HDF5 file: one sink for each face, the front first. The file appears under its name when
/// all sinks are finished; until then it is a temporary file in the same folder, which is removed with the sinks unless
/// it can be resumed. Disk space is reserved at once, so that a full disk is reported before the work begins. Half
/// floats beyond 65504 become infinite. Throws Error(usage) if the grids are not those of one light field or the name
/// is not that of an HDF5 file (require_name()), and Error(cannot_write).
HOGEL_API std::vector<std::unique_ptr<LightFieldSink>> create_light_field(const std::filesystem::path& path,
                                                                          std::span<const LightFieldGrid> grids,
                                                                          const LightFieldFileOptions& options = {});

/// Opens a hologram in an HDF5 file: one field for each wavelength, for instance red, green and blue. Field number i is
/// the dataset "field<i>/samples", [y][x] of compounds {r, i} (single floats), which h5py reads as complex64, or
/// [y][x][2] of half floats, with its sampling and wavelength in attributes (docs/files.md). Throws Error(bad_input) as
/// open_light_field() does.
HOGEL_API Fields open_hologram(const std::filesystem::path& path);

/// Options of create_hologram().
struct HologramFileOptions {
    /// Half floats keep 11 significant bits of numbers from 6·10⁻⁵ to 65504 and take half the space.
    SampleType type = SampleType::single;
    Metadata metadata = {};                            ///< as in LightFieldFileOptions
    std::optional<std::string> resume = std::nullopt;  ///< as in LightFieldFileOptions
};

/// Creates a hologram in an HDF5 file: one sink for each field. The file appears under its name when all sinks are
/// finished. A sink of half floats throws Error(usage) for samples beyond 65504. Throws Error(usage) for a name that is
/// not that of an HDF5 file (require_name()), and Error(cannot_write).
HOGEL_API std::vector<std::unique_ptr<FieldSink>> create_hologram(const std::filesystem::path& path,
                                                                  std::span<const FieldGrid> grids,
                                                                  const HologramFileOptions& options = {});

/// The kinds of files that hogel distinguishes.
enum class FileKind { light_field, hologram, picture, mesh, unknown };

/// The kind of a file: by its contents for HDF5 and compressed light fields, otherwise by its extension
/// (file_formats()). Throws Error(bad_input) for a file that is missing or cannot be read.
HOGEL_API FileKind file_kind(const std::filesystem::path& path);

/// A file format, for help texts and for recognising pictures and meshes by their extensions.
struct FileFormat {
    std::string name;                     ///< "hdf5"
    std::vector<std::string> extensions;  ///< in lower case: ".h5", ".hdf5"
    std::string text;                     ///< what it is, one line
    std::vector<FileKind> reads, writes;  ///< the kinds of content that the library reads and writes in this format
};

/// The file formats of light fields, fields, pictures and meshes that this build has.
HOGEL_API Table<FileFormat>& file_formats();

/// Throws Error(usage) for a name that ends like files of another format than the named one ("hdf5"), so that no file
/// is other than its name says. Endings that belong to no format are all right.
HOGEL_API void require_name(const std::filesystem::path& path, std::string_view format);

/// Throws Error(usage) for a folder that does not exist yet and whose name ends like that of a file.
HOGEL_API void require_folder_name(const std::filesystem::path& path);

/// Facts about a light field or hologram file: names and values, in SI units.
struct FileSummary {
    FileKind kind = FileKind::unknown;
    std::vector<std::pair<std::string, std::string>> text;  ///< facts that are texts, with the metadata
    std::vector<std::pair<std::string, double>> numbers;    ///< facts that are numbers
};

/// Reads the header of a file. For kinds other than light fields and holograms only the kind and the size are given.
/// Throws Error(bad_input) for a file that is missing, damaged or cannot be read.
HOGEL_API FileSummary summarize(const std::filesystem::path& path);

/// What must be known about a field in a file of another program, where the file does not say it.
struct ExternalField {
    double pitch_x = 0, pitch_y = 0;  ///< metres between samples; 0: as the file says
    double wavelength = 0;            ///< metres; 0: as the file says

    /// The meaning of the file's numbers: complex values; amplitudes, with phase zero; phases, with amplitude one; or,
    /// of an array with an axis of two real numbers, real and imaginary parts, or amplitudes and phases.
    enum class Values { complex, amplitude, phase, real_imaginary, amplitude_phase };
    Values values = Values::complex;
    /// How numbers stand for phases; without it phases are in radians, and whole numbers are refused.
    std::optional<PhaseCode> phase_code = {};

    std::filesystem::path imaginary = {};  ///< a picture of the imaginary parts, for a picture of real parts
    std::filesystem::path phases = {};     ///< a picture of the phases, for a picture of amplitudes
    /// The whole number that stands for 0 in pictures of real and imaginary parts; without it the median of each.
    std::optional<double> zero = {};
    std::string variable = {};  ///< the array to read of a file of several, or two: "re,im"; may be empty
    bool conjugate = false;     ///< true where the file's time factor is e^{+iωt}
    std::size_t colour = 0;     ///< which of the fields: ExternalFacts::colours
};

/// What a file of another program says of its fields.
struct ExternalFacts {
    std::string format;                 ///< "npy"
    std::string numbers;                ///< "complex single"
    std::size_t width = 0, height = 0;  ///< samples
    std::size_t colours = 1;            ///< number of fields: one, or one for each of several wavelengths
    double pitch_x = 0, pitch_y = 0;    ///< metres; 0 where the file does not say it
    std::vector<double> wavelengths;    ///< metres, one for each field; empty where the file does not say them
    std::string complaint;              ///< why a pitch or a wavelength in the file was not taken
    std::string values;                 ///< "phase" or "amplitude" where a picture says it, see field_entries()
    std::string phase_code;             ///< of those phases, one that parse_phase_code() takes
};

/// Throws Error(bad_input) for a file that is missing or damaged, and Error(usage) if it has no array `what.variable`.
HOGEL_API ExternalFacts external_facts(const std::filesystem::path& path, const ExternalField& what = {});

/// Opens a field written by another program: an array of NumPy (.npy, .npz) or MATLAB (.mat, up to version 7.3), a
/// complex field of OpenHolo (.ohc), an OpenEXR file with channels of real and imaginary parts or of amplitudes and
/// phases, or pictures: of amplitudes, of phases, of both, or of real and imaginary parts (docs/files.md). What `what`
/// leaves out is taken from the file, of pictures from the texts of field_entries(). Row 0 is at
/// the top, column 0 at the left, and the middle of the array is at x = y = 0. NPY files are read region by region on
/// demand, others completely when opened. Throws Error(bad_input) for a file that is damaged or of another kind, and
/// Error(usage) if `what` does not suit the file's numbers, or neither says the sampling.
HOGEL_API std::shared_ptr<const FieldSource> open_external_field(const std::filesystem::path& path,
                                                                 const ExternalField& what);

/// Whether a file is known by its contents as a field, without more being said: .npy, .npz, .mat, .ohc, .exr with
/// channels of fields, and pictures with the texts of field_entries(). Throws Error(bad_input) for a file that is
/// missing, and for a damaged picture.
HOGEL_API bool is_external_field(const std::filesystem::path& path);

/// The texts by which a picture of numbers, such as write_raw_pixels() writes, describes its field: the pitch,
/// the wavelengths (metres), and whether its numbers are phases, in which code, or amplitudes.
HOGEL_API Metadata field_entries(const ExternalField& what, std::span<const double> wavelengths);

/// Throws Error(usage) for a name whose ending is none of those that write_fields() writes: .npy, .npz, .mat, .exr.
HOGEL_API void require_fields_name(const std::filesystem::path& path);

/// Writes fields of one sampling, one for each wavelength, in the format of the name's ending, as complex numbers of
/// single floats: .npy an array [y][x], or [wavelength][y][x] of several; .npz and .mat the same as `field`, with
/// `pitch` and `wavelength` in metres; .exr channels `field0.real`, `field0.imaginary` and so on, with the sampling as
/// texts. The file appears under its name when it is complete. Throws Error(usage) for another ending or fields of
/// different sampling, and Error(cannot_write).
HOGEL_API void write_fields(const std::filesystem::path& path, std::span<const Field> fields,
                            const Metadata& metadata = {});

/// Writes samples[y][x] as an array of complex64 in NumPy's format. The file appears under its name when it is
/// complete. Throws Error(cannot_write).
HOGEL_API void write_npy(const std::filesystem::path& path, View<const std::complex<float>, 2> samples);

}  // namespace hogel
