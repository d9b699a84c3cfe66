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

#include "hogel/export.h"
#include "hogel/image.h"
#include "hogel/light_field.h"
#include "hogel/progress.h"
#include "hogel/table.h"

namespace hogel {

/// The quantisation table that the coder jpeg4d encodes with; each tile of a stream holds its own.
enum class QuantisationTable {
    own,   ///< optimised for each tile, after Ratnakar and Livny (2000)
    jpeg,  ///< JPEG's example for luminance (ISO 10918-1, table K.1) and its outer product with itself, [K] 4.4.1
};

/// How the samples of a light field become bytes.
struct CodingMethod {
    std::string coder = "hogel";                       ///< a row of coders()
    std::string transform;                             ///< one of transform_names(); empty: the coder's own
    QuantisationTable table = QuantisationTable::own;  ///< of coders with CoderInfo::quantisation_table
    friend bool operator==(const CodingMethod&, const CodingMethod&) = default;
};

/// The array of directions that a coder sees (docs/format.md, "Layouts").
enum class StreamLayout {
    faces,     ///< each face is an array of its own
    unfolded,  ///< all faces of a hemicube are one array, with the front in the middle
    stacked,   ///< as `faces`; rows of hogels with a single row of directions are stacked into an epipolar image
};

/// Signal to quantisation noise ratio 10 log₁₀(Σ f² / Σ (f − f′)²) over all samples, met or exceeded by at most 0.1 dB.
struct Sqnr {
    double decibels = 40;  ///< above 0, at most 120
};
/// Size of the file, to the byte: ⌊rays / 8 / rate⌋.
struct PixelsPerBit {
    double rate = 8;  ///< rays, with all their channels, for each bit of the whole file
};
/// One coding with a given step of the quantiser.
struct Step {
    double radiance = 0;  ///< above 0
};
/// A bound on every sample. What is not finite comes back as it is. The coder hogel only.
struct MaxError {
    double radiance = 0;  ///< |f − f′| of every sample at most; above 0
};
/// Every float comes back with all its bits. The coder hogel only.
struct Lossless {};

/// What decides how fine a light field is coded.
using CompressionTarget = std::variant<Sqnr, PixelsPerBit, Step, MaxError, Lossless>;

struct CompressionOptions {
    CodingMethod method;
    CompressionTarget target;
    std::optional<HogelRange> tile;      ///< size of the tiles (s0 = t0 = 0); by default what suits the coder
    Metadata metadata;                   ///< beside the light field's provenance; no name may be `filler`
    std::optional<StreamLayout> layout;  ///< by default the smaller of `stacked` (coder hogel only) and `faces`
    bool with_depth = false;             ///< whether depth is stored, too
    double depth_error = 0;              ///< bound on each depth, metres; 0: a 1,000th of the range of depths
    /// Decades of luminance that histogram tone mapping leaves before coding (docs/codec.md), 0.1 to 20. A light field
    /// that spans no more is coded as it is.
    std::optional<double> tone_decades;
    double chrominance = 1;  ///< steps of chrominance relative to those of luminance, 1 to 1024; three channels only
};

struct CompressionResult {
    std::uint64_t bytes = 0;        ///< of the file
    double sqnr = 0;                ///< decibels; with tone mapping or coarser chrominance, of what is coded
    double pixels_per_bit = 0;      ///< rays for each bit of the file
    double step = 0;                ///< of the quantiser, radiance
    int passes = 0;                 ///< how often the whole light field was read and coded
    std::uint64_t depth_bytes = 0;  ///< of `bytes`
    double depth_error = 0;         ///< bound on each depth, metres
};

/// Codes a light field into a .hgl stream (docs/format.md), tile by tile on all threads. Quality and rate are those of
/// all its faces together. Memory: a few tiles for each thread. The step that meets an SQNR or a rate is searched by
/// coding some of the tiles first and then all of them. A rate is met to the byte: less than half a per cent is filled
/// by metadata without meaning (more for light fields of few samples), or an embedded code (ezw) is cut. With MaxError
/// and Lossless the step of the prediction is the one that makes the middle of the light field smallest. Depth is coded
/// first and counts as a part of the file. The file appears when it is complete. Throws Error(usage) for a target or
/// method that makes no sense, a rate that no step gives, and a quality finer than the coder can be; Error(bad_input)
/// for radiance that is not finite (unless the target is MaxError or Lossless), Error(cannot_write).
HOGEL_API CompressionResult compress(const LightField& light_field, const std::filesystem::path& path,
                                     const CompressionOptions& options, const Progress& progress = {});

/// What the header of a stream says.
struct HOGEL_API StreamInfo {
    LightFieldGrid grid;  ///< of the light field, or of the front of a hemicube
    HogelRange tile;      ///< size of the tiles, s0 = t0 = 0
    CodingMethod method;  ///< a row of coders(), or "lossless" or "bounded", which compress() makes of hogel
    Metadata metadata;
    std::vector<LightFieldGrid> sides = {};  ///< further faces of a hemicube
    StreamLayout layout = StreamLayout::faces;
    std::uint32_t version = 1;  ///< of the format

    /// Histogram tone mapping, along whose curve the light field is coded.
    struct ToneMapping {
        double decades = 0;         ///< of luminance, from the first point of the curve to the last
        double mapped_decades = 0;  ///< what the curve makes of them
    };
    std::optional<ToneMapping> tone;
    double chrominance = 1;  ///< steps of chrominance relative to those of luminance

    std::uint64_t filler = 0;                    ///< bytes without meaning that pad the file to a requested size
    std::vector<std::uint64_t> layer_ends = {};  ///< where each layer of all tiles ends in the file
    std::size_t layers_there = 0;                ///< complete layers in the file; fewer where it was cut off

    /// The stream of depths behind the layers.
    struct Depth {
        std::uint64_t bytes = 0;  ///< 0: there is none
        double error = 0;         ///< bound on each depth, metres
        double beyond = 0;        ///< decoded depths from here on mean infinity, metres
    };
    Depth depth = {};
    bool depth_there = false;  ///< whether the file has the depths completely

    /// `grid` and `sides`.
    std::vector<LightFieldGrid> faces() const;
};

/// Whether a file begins as a stream does. Throws Error(bad_input) where there is no such file.
HOGEL_API bool is_stream(const std::filesystem::path& path);

/// Reads and checks the header and the index only. A file that was cut off is accepted if it has the first layer.
/// Throws Error(bad_input).
HOGEL_API StreamInfo read_stream_info(const std::filesystem::path& path);

struct StreamOptions {
    std::size_t memory = std::size_t{1} << 29;  ///< bytes for decoded tiles
    std::size_t layers = 0;                     ///< layers to decode; 0: all, and depth
};

/// Opens a compressed light field; it is decoded where it is read. With the coder hogel only what the wanted hogels
/// need is decoded, with other coders a whole tile. The tiles decoded last are kept, as many as `memory` bytes hold, at
/// least one; all faces share them. Depth is there if the file has it. Throws Error(bad_input) for a file that is
/// damaged, of another version, or cut off before the end of the last layer that is wanted; damage inside a tile shows
/// when that tile is read. Throws Error(usage) for more layers than there are.
HOGEL_API LightField open_stream(const std::filesystem::path& path, const StreamOptions& options = {});

/// Opens a stream of the coder fringes without undoing the transform of the directions, for holograms made of basis
/// fringes ([K] 4.2.3): in place of radiances the coefficients of √L, an array [n_V][n_U] for each hogel and channel,
/// of the transform that the header names. Throws Error(bad_input) as open_stream() does, for another coder, for a
/// light field that was coded along a tone curve or with coarser chrominance, and for a hemicube.
HOGEL_API LightField open_coefficients(const std::filesystem::path& path);

/// The directions of an array [n_V][n_U] that belong to a light field: rows begin_v to end_v completely, of other rows
/// the columns begin_u to end_u. By default all; of an unfolded hemicube its faces without the corners.
struct DirectionCross {
    std::size_t begin_u = 0, end_u = 0, begin_v = 0, end_v = std::numeric_limits<std::size_t>::max();

    struct Columns {
        std::size_t begin, end;
    };
    /// The columns of row v that belong to it, of `width`.
    Columns columns(std::size_t v, std::size_t width) const {
        return v >= begin_v && v < end_v ? Columns{0, width} : Columns{begin_u, end_u};
    }
};

/// A tile that is decoded where it is read.
class HOGEL_API TileDecoder {
  public:
    virtual ~TileDecoder() = default;
    /// Fills the radiance of a part of the tile. Called by several threads. Throws Error(bad_input) for bytes that no
    /// encoder makes, where that shows.
    virtual void read(LightFieldTile& part) = 0;
};

/// Turns tiles of a light field into bytes and back. Tiles are coded independently. Called by several threads; the same
/// tile gives the same bytes for any number of them.
class HOGEL_API TileCoder {
  public:
    struct Encoded {
        std::vector<std::uint8_t> bytes;
        double squared_error = 0;              ///< Σ (f − f′)² over the tile's directions that count
        std::vector<std::size_t> layers = {};  ///< where each layer ends in `bytes`; empty for a single one
    };
    static constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

    virtual ~TileCoder() = default;
    /// The size of tile (s0 = t0 = 0) that suits the coder best.
    virtual HogelRange preferred_tile(const LightFieldGrid& grid) const = 0;
    /// How many tiles to code at once; fewer than there are threads where one tile keeps several of them busy.
    virtual std::size_t max_at_once() const { return std::numeric_limits<std::size_t>::max(); }
    /// Whether radiance that is not finite can be coded.
    virtual bool takes_any_value() const { return false; }
    /// The shortest code of a tile, if encode() obeys max_bytes: the code is embedded, and longer ones are finer.
    virtual std::optional<std::size_t> min_bytes(const LightFieldGrid&) const { return std::nullopt; }
    /// @param step   of the quantiser, radiance: the error is about step/√12 where the tile has detail of that size,
    ///               and smaller elsewhere
    /// @param tile   its radiance is overwritten
    virtual Encoded encode(LightFieldTile& tile, double step, std::size_t max_bytes = no_limit) const = 0;
    /// Fills the tile's radiance. Throws Error(bad_input) for bytes that no encode() gives, where that shows.
    virtual void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const = 0;
    /// The number of layers of a tile; the first ones alone give a coarser tile.
    virtual std::size_t layers(const HogelRange&) const { return 1; }
    /// Opens the first layers of a tile, which end with `bytes`, to be decoded where they are read; by default decodes
    /// the whole tile at once.
    /// @param layers   1 to layers(range)
    virtual std::unique_ptr<TileDecoder> open(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid,
                                              const HogelRange& range, std::size_t layers) const;
    /// Whether hogels and directions are transformed independently, so that decode_coefficients() works.
    virtual bool directional() const { return false; }
    /// Fills the tile's radiance with the coefficients of √L along the directions of each hogel instead. Throws
    /// Error(usage) unless directional().
    virtual void decode_coefficients(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const;
};

/// A coder: a row of coders().
struct CoderInfo {
    std::string name;
    std::string text;                 ///< one line for help
    std::string transform;            ///< what an empty CodingMethod::transform means; empty: the coder takes none
    bool quantisation_table = false;  ///< whether CodingMethod::table matters
    /// Makes the coder of a light field's tiles. Throws Error(usage) for a transform that does not suit it.
    /// @param counted   the directions whose errors count
    std::function<std::unique_ptr<TileCoder>(const CodingMethod& method, const LightFieldGrid& grid,
                                             const DirectionCross& counted)>
        make;
};

/// All coders: hogel, threepass, ezw, jpeg4d, fringes, and what a program adds. A stream names its coder, so a reader
/// needs the same row.
HOGEL_API Table<CoderInfo>& coders();

/// The transforms that coders with a CoderInfo::transform know: 15 wavelets, and dct8 for jpeg4d (docs/codec.md).
HOGEL_API std::vector<std::string> transform_names();

}  // namespace hogel
