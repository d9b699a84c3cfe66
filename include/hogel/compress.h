// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "hogel/array.h"
#include "hogel/export.h"
#include "hogel/image.h"
#include "hogel/light_field.h"
#include "hogel/progress.h"
#include "hogel/resources.h"
#include "hogel/table.h"

namespace hogel {

/// Quantisation table of the coder jpeg4d. Each tile of a stream stores its table.
enum class QuantisationTable {
    own,   ///< optimised for each tile, after Ratnakar and Livny (2000)
    jpeg,  ///< JPEG's example for luminance (ISO 10918-1, table K.1) and its outer product with itself, [K] 4.4.1
};

/// Coding of symbols by coders with CoderInfo::three_pass. Each channel of each tile of a stream stores it.
enum class ZerotreeSymbols {
    bits,       ///< binary, with adaptive contexts
    alphabets,  ///< from one alphabet for differences of p_t and one for differences of p_n, [K] 4.4.2
};

/// A coder and its parameters.
struct CodingMethod {
    std::string coder = "hogel";                       ///< name of a row of coders()
    std::string transform;                             ///< one of transform_names(); empty: the coder's default
    QuantisationTable table = QuantisationTable::own;  ///< only for coders with CoderInfo::quantisation_table
    ZerotreeSymbols symbols = ZerotreeSymbols::bits;   ///< only for coders with CoderInfo::three_pass
    friend bool operator==(const CodingMethod&, const CodingMethod&) = default;
};

/// Arrangement of directions in the arrays that are coded (docs/format.md, "Layouts").
enum class StreamLayout {
    faces,     ///< one array per face
    unfolded,  ///< one array for all faces of a hemicube, with the front in the middle
    stacked,   ///< as `faces`, but rows of hogels with a single row of directions are stacked into an epipolar image
};

/// Target: signal to quantisation noise ratio 10 log₁₀(Σ f² / Σ (f − f′)²) over all samples, exceeded by at most 0.1
/// dB.
struct Sqnr {
    double decibels = 40;  ///< above 0, at most 120
};
/// Methods to find the quantiser step for a rate.
enum class RateRule {
    search,     ///< code repeatedly until the file has exactly the requested size
    histogram,  ///< from the histogram of coefficients, [K] 4.4.2; codes once and meets the size approximately
    planes,     ///< as histogram, with steps T_max·2^(−b_max) for whole numbers b_max of bit planes, as in [K]
};
/// Target: a file of ⌊rays / 8 / rate⌋ bytes, exactly with RateRule::search, otherwise approximately.
struct PixelsPerBit {
    double rate = 8;                   ///< rays, with all channels, per bit of the file
    RateRule rule = RateRule::search;  ///< others than search only for coders with CoderInfo::three_pass
    /// c of the rule, 0 to 32: bits for the trees per nonzero coefficient; default: default_overhead().
    std::optional<double> overhead = {};
};
/// Returns the c of [K] 4.4.2 that suits light fields with these symbols
/// (docs/decisions/0043-codec-thesis-transforms.md).
HOGEL_API double default_overhead(ZerotreeSymbols symbols);
/// Target: a fixed quantiser step.
struct Step {
    double radiance = 0;  ///< above 0
};
/// Target: a bound on the error of every sample. Values that are not finite are kept exactly. Coder hogel only.
struct MaxError {
    double radiance = 0;  ///< maximum of |f − f′|; above 0
};
/// Target: every float is kept exactly. Coder hogel only.
struct Lossless {};

/// The quality or size to meet.
using CompressionTarget = std::variant<Sqnr, PixelsPerBit, Step, MaxError, Lossless>;

/// Options of compress().
struct CompressionOptions {
    CodingMethod method;
    CompressionTarget target;
    std::optional<HogelRange> tile;  ///< size of the tiles (s0 = t0 = 0); default: the coder's preferred tile
    Metadata metadata;               ///< in addition to the light field's provenance; must not have the name "filler"
    std::optional<StreamLayout> layout;  ///< default: the smaller of `stacked` (coder hogel only) and `faces`
    bool with_depth = false;             ///< whether to store depth
    /// Bound on the error of each depth, metres; 0: exact. Default: 0 with Lossless, otherwise default_depth_error().
    std::optional<double> depth_error;
    /// Decades of luminance after histogram tone mapping of the light field (docs/codec.md), 0.1 to 20. A light field
    /// that spans no more is coded without tone mapping.
    std::optional<double> tone_decades;
    double chrominance = 1;  ///< quantiser steps of chrominance relative to luminance, 1 to 1024; three channels only
};

/// Returns the bound on depth errors (metres) at which holograms with phases of the visible points (PhaseAdded,
/// OverlapAdd) hardly change. An error δ moves the point of a ray sideways by δU. The bound moves the point of the
/// steepest ray by at most a 32,000th of a hogel, and is at most a 1,000th of `range`.
/// @param range  range of depths, metres
HOGEL_API double default_depth_error(const LightFieldGrid& grid, double range);

/// The result of compress().
struct CompressionResult {
    std::uint64_t bytes = 0;        ///< size of the file
    double sqnr = 0;                ///< decibels; of the mapped samples, with tone mapping or coarser chrominance
    double pixels_per_bit = 0;      ///< rays per bit of the file
    double step = 0;                ///< of the quantiser, in radiance
    int passes = 0;                 ///< number of times that the full light field was coded
    std::uint64_t depth_bytes = 0;  ///< of `bytes`
    double depth_error = 0;         ///< bound on the error of each depth, metres; 0: exact
};

/// Codes a light field into a .hgl stream (docs/format.md), tile by tile on all threads. Quality and rate are of all
/// faces together. Depth is coded first and is part of the file's size. The file appears under its name when it is
/// complete. Memory: a few tiles per thread.
///
/// A search finds the quantiser step for an SQNR or a rate: it codes some tiles first and then all of them. Filler
/// metadata give the file the exact size of a rate (less than half a per cent; more for light fields with few samples),
/// or truncation of an embedded code (ezw). Other RateRules read the light field once for its histogram and code it
/// once. With MaxError and Lossless, the prediction uses the step that codes the middle of the light field in the
/// fewest bytes.
///
/// Throws Error(usage) for an invalid target or method, a rate that no step gives, and a quality beyond the coder's
/// limit; Error(bad_input) for radiance that is not finite (except with MaxError and Lossless), and
/// Error(cannot_write).
HOGEL_API CompressionResult compress(const LightField& light_field, const std::filesystem::path& path,
                                     const CompressionOptions& options, const Progress& progress = {});

/// Estimates the resources to compress a light field, without the cost of reading it. For an SQNR the disk space is an
/// upper bound: the size without prediction. Throws Error(usage) for an invalid method.
HOGEL_API Plan plan_compression(const LightField& light_field, const CompressionOptions& options);

/// The header of a stream.
struct HOGEL_API StreamInfo {
    LightFieldGrid grid;  ///< of the light field, or of the front of a hemicube
    HogelRange tile;      ///< size of the tiles, s0 = t0 = 0
    /// Names a row of coders(), or "lossless" or "bounded": the coder hogel with the targets Lossless and MaxError.
    CodingMethod method;
    Metadata metadata;
    std::vector<LightFieldGrid> sides = {};  ///< other faces of a hemicube
    StreamLayout layout = StreamLayout::faces;
    std::uint32_t version = 1;  ///< of the format

    /// Curve of the histogram tone mapping of the coded light field.
    struct ToneMapping {
        double decades = 0;         ///< of luminance, from the first to the last point of the curve
        double mapped_decades = 0;  ///< decades after tone mapping
    };
    std::optional<ToneMapping> tone;
    double chrominance = 1;  ///< quantiser steps of chrominance relative to luminance

    std::uint64_t filler = 0;                    ///< padding bytes for a requested file size
    std::vector<std::uint64_t> layer_ends = {};  ///< offset in the file of the end of each layer, over all tiles
    std::size_t layers_there = 0;  ///< complete layers in the file; fewer than `layer_ends` if the file is truncated

    /// Depth data after the layers.
    struct Depth {
        std::uint64_t bytes = 0;  ///< 0: the stream has no depth
        double error = 0;         ///< bound on the error of each depth, metres; 0: exact
        double beyond = 0;        ///< metres; decoded depths from this value on mean infinity
    };
    Depth depth = {};
    bool depth_there = false;  ///< whether the file contains all depths

    /// Returns the grids of all faces: `grid`, then `sides`.
    std::vector<LightFieldGrid> faces() const;
};

/// Returns whether a file begins like a .hgl stream. Throws Error(bad_input) if it does not exist.
HOGEL_API bool is_stream(const std::filesystem::path& path);

/// Reads and checks header and index. Accepts truncation after the first layer; throws Error(bad_input) for other
/// damage.
HOGEL_API StreamInfo read_stream_info(const std::filesystem::path& path);

/// Options of open_stream().
struct StreamOptions {
    std::size_t memory = std::size_t{1} << 29;  ///< bytes for decoded tiles
    std::size_t layers = 0;                     ///< number of layers to decode; 0: all, and depth
};

/// Opens a compressed light field, which is decoded when it is read. The coder hogel decodes only data that the
/// requested hogels depend on; other coders decode a full tile. A cache common to all faces keeps the last decoded
/// tiles, up to `memory` but at least one. The light field has depth if the file does. Throws Error(bad_input) for a
/// file that is damaged, of another version, or truncated before the end of the last requested layer, and Error(usage)
/// for more layers than the file has. Damage inside a tile throws when the tile is read.
HOGEL_API LightField open_stream(const std::filesystem::path& path, const StreamOptions& options = {});

/// Opens a stream of the coder fringes for holograms of basis fringes ([K] 4.2.3), without inverting the transform of
/// the directions. The values are coefficients of √L instead of radiances: an array [n_V][n_U] per hogel, channel and
/// face, of the transform in the header. Throws Error(bad_input) as open_stream() does, for another coder, for a light
/// field with tone mapping or coarser chrominance, and for a hemicube with the layout `unfolded`.
HOGEL_API LightField open_coefficients(const std::filesystem::path& path);

/// The directions of an array [n_V][n_U] that belong to a light field: all of rows begin_v to end_v, and columns
/// begin_u to end_u of the other rows (ends excluded). Default: all directions. For an unfolded hemicube: its five
/// faces.
struct DirectionCross {
    std::size_t begin_u = 0, end_u = 0, begin_v = 0, end_v = std::numeric_limits<std::size_t>::max();

    struct Columns {
        std::size_t begin, end;
    };
    /// Returns the columns of row v that belong to the light field, in an array of `width` columns.
    Columns columns(std::size_t v, std::size_t width) const {
        return v >= begin_v && v < end_v ? Columns{0, width} : Columns{begin_u, end_u};
    }
};

/// A tile that is decoded when it is read.
class HOGEL_API TileDecoder {
  public:
    virtual ~TileDecoder() = default;
    /// Reads the radiance of a part of the tile. Thread-safe. Throws Error(bad_input) for bytes that no encoder writes.
    virtual void read(LightFieldTile& part) = 0;
};

/// Encoder and decoder of light field tiles. Tiles are independent. All functions are thread-safe, and the bytes of a
/// tile do not depend on the number of threads.
class HOGEL_API TileCoder {
  public:
    struct Encoded {
        std::vector<std::uint8_t> bytes;
        double squared_error = 0;              ///< Σ (f − f′)² over the tile's counted directions
        std::vector<std::size_t> layers = {};  ///< end of each layer in `bytes`; empty: a single layer
    };
    static constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

    virtual ~TileCoder() = default;
    /// Returns the tile size (s0 = t0 = 0) that suits the coder best.
    virtual HogelRange preferred_tile(const LightFieldGrid& grid) const = 0;
    /// Returns the number of tiles to code at once; fewer than threads if one tile uses several of them.
    virtual std::size_t max_at_once() const { return std::numeric_limits<std::size_t>::max(); }
    /// Returns whether radiance that is not finite can be coded.
    virtual bool takes_any_value() const { return false; }
    /// Returns the size of a tile's shortest code, bytes, if encode() can truncate it to max_bytes (embedded code).
    virtual std::optional<std::size_t> min_bytes(const LightFieldGrid&) const { return std::nullopt; }
    /// Encodes a tile.
    /// @param tile   its radiance is overwritten
    /// @param step   of the quantiser, in radiance: the error is about step/√12 where the tile has detail of that size,
    ///               and smaller elsewhere
    virtual Encoded encode(LightFieldTile& tile, double step, std::size_t max_bytes = no_limit) const = 0;
    /// Decodes the tile's radiance. Throws Error(bad_input) for bytes that encode() does not write.
    virtual void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const = 0;
    /// Returns the number of layers of a tile. The first layers alone give a coarser tile.
    virtual std::size_t layers(const HogelRange&) const { return 1; }
    /// Opens the first layers of a tile for decoding on demand. The default implementation decodes the full tile at
    /// once.
    /// @param bytes   the code up to the end of these layers
    /// @param layers  1 to layers(range)
    virtual std::unique_ptr<TileDecoder> open(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid,
                                              const HogelRange& range, std::size_t layers) const;
    /// Returns whether hogels and directions are transformed independently, as decode_coefficients() requires.
    virtual bool directional() const { return false; }
    /// Decodes a tile to coefficients of √L along the directions of each hogel. Throws Error(usage) if not
    /// directional().
    virtual void decode_coefficients(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const;
};

/// A row of coders().
struct CoderInfo {
    std::string name;
    std::string text;                 ///< one line
    std::string transform;            ///< default of CodingMethod::transform; empty: the coder has no transform
    bool quantisation_table = false;  ///< whether it uses CodingMethod::table
    /// Makes the coder for the tiles of a light field. Throws Error(usage) for a transform that the coder cannot use.
    /// @param counted  directions with counted errors
    std::function<std::unique_ptr<TileCoder>(const CodingMethod& method, const LightFieldGrid& grid,
                                             const DirectionCross& counted)>
        make;
    bool three_pass = false;  ///< whether it uses CodingMethod::symbols and rules of PixelsPerBit other than search
};

/// Returns all coders: hogel, threepass, ezw, jpeg4d, fringes, and those that the program adds. A stream stores the
/// name of its coder; a program that reads it needs the same row.
HOGEL_API Table<CoderInfo>& coders();

/// Returns the transforms of coders with a CoderInfo::transform: 15 wavelets, and dct8 for jpeg4d (docs/codec.md).
HOGEL_API std::vector<std::string> transform_names();

/// Returns the bytes of each hogel in a stream of compress(), [t][s], over all faces and without depth. The coder hogel
/// counts the hogel's own code and an equal part of the code that the hogels of a tile share. Other coders code the
/// hogels of a tile jointly, so all hogels of a tile have the same value. The sum is the size of the stream's tiles.
/// Reads the file once and decodes no radiance. Throws Error(bad_input) if the file is damaged or not a stream, and
/// Error(usage) for more layers than it has.
/// @param layers  number of first layers to count; 0: all in the file
HOGEL_API Array<double, 2> bytes_of_hogels(const std::filesystem::path& path, std::size_t layers = 0,
                                           const Progress& progress = {});

}  // namespace hogel
