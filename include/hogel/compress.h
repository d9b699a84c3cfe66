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

/// The quantisation table with which the coder jpeg4d encodes. Each tile of a stream stores its table.
enum class QuantisationTable {
    own,   ///< optimised for each tile, after Ratnakar and Livny (2000)
    jpeg,  ///< JPEG's example for luminance (ISO 10918-1, table K.1) and its outer product with itself, [K] 4.4.1
};

/// How the coders with CoderInfo::three_pass code their symbols. Each channel of each tile of a stream names it.
enum class ZerotreeSymbols {
    bits,       ///< bit by bit in contexts
    alphabets,  ///< from an alphabet of the differences of p_t and one of those of p_n, [K] 4.4.2
};

/// The coder of a light field and its parameters.
struct CodingMethod {
    std::string coder = "hogel";                       ///< a row of coders()
    std::string transform;                             ///< one of transform_names(); empty: the coder's own
    QuantisationTable table = QuantisationTable::own;  ///< used only by coders with CoderInfo::quantisation_table
    ZerotreeSymbols symbols = ZerotreeSymbols::bits;   ///< used only by coders with CoderInfo::three_pass
    friend bool operator==(const CodingMethod&, const CodingMethod&) = default;
};

/// The array of directions that a coder works on (docs/format.md, "Layouts").
enum class StreamLayout {
    faces,     ///< each face is an array of its own
    unfolded,  ///< all faces of a hemicube are one array, with the front in the middle
    stacked,   ///< as `faces`; rows of hogels with a single row of directions are stacked into an epipolar image
};

/// Signal to quantisation noise ratio 10 log₁₀(Σ f² / Σ (f − f′)²) over all samples, met or exceeded by at most 0.1 dB.
struct Sqnr {
    double decibels = 40;  ///< above 0, at most 120
};
/// How the quantiser's step for a rate is found.
enum class RateRule {
    search,     ///< by coding again until the file has exactly the size asked for
    histogram,  ///< from the histogram of coefficients, [K] 4.4.2, and coded once: the size is met approximately
    planes,     ///< as histogram, with steps T_max·2^(−b_max) for whole numbers b_max of bit planes, as in [K]
};
/// A file of exactly ⌊rays / 8 / rate⌋ bytes, or with another rule of about as many.
struct PixelsPerBit {
    double rate = 8;                      ///< rays, with all their channels, per bit of the whole file
    RateRule rule = RateRule::search;     ///< other rules only for coders with CoderInfo::three_pass
    std::optional<double> overhead = {};  ///< c of the rule, 0 to 32: bits for the trees per coefficient that is not 0;
                                          ///< by default default_overhead()
};
/// The c of [K] 4.4.2 that suits light fields with these symbols (docs/decisions/0043-codec-thesis-transforms.md).
HOGEL_API double default_overhead(ZerotreeSymbols symbols);
/// A given step of the quantiser.
struct Step {
    double radiance = 0;  ///< above 0
};
/// A bound on the error of every sample. Values that are not finite are kept exactly. Coder hogel only.
struct MaxError {
    double radiance = 0;  ///< maximum of |f − f′|; above 0
};
/// Every float is kept exactly. Coder hogel only.
struct Lossless {};

/// The quality or size to be met by compression.
using CompressionTarget = std::variant<Sqnr, PixelsPerBit, Step, MaxError, Lossless>;

/// The coder, target and contents of a stream that compress() writes.
struct CompressionOptions {
    CodingMethod method;
    CompressionTarget target;
    std::optional<HogelRange> tile;      ///< size of the tiles (s0 = t0 = 0); by default the coder's preferred tile
    Metadata metadata;                   ///< beside the light field's provenance; must not contain the name "filler"
    std::optional<StreamLayout> layout;  ///< by default the smaller of `stacked` (coder hogel only) and `faces`
    bool with_depth = false;             ///< whether depth is also stored
    /// Bound on each depth, metres; 0: every float as it is. By default 0 with the target Lossless, otherwise
    /// default_depth_error().
    std::optional<double> depth_error;
    /// Decades of luminance to which histogram tone mapping compresses the light field before coding (docs/codec.md),
    /// 0.1 to 20. A light field that spans no more than this is coded without tone mapping.
    std::optional<double> tone_decades;
    double chrominance = 1;  ///< steps of chrominance relative to those of luminance, 1 to 1024; three channels only
};

/// The bound on depth, metres, with which holograms whose phases are those of the points that rays meet (PhaseAdded,
/// OverlapAdd) hardly differ from those of the exact depth. What depth decides is which point a ray meets: an error δ
/// moves it sideways by δU. The bound moves the point of the steepest ray by no more than a 32,000th of a hogel. It is
/// never more than a 1,000th of the range of depths, metres.
HOGEL_API double default_depth_error(const LightFieldGrid& grid, double range);

/// What compress() achieved.
struct CompressionResult {
    std::uint64_t bytes = 0;        ///< of the file
    double sqnr = 0;                ///< decibels; with tone mapping or coarser chrominance, that of the mapped samples
    double pixels_per_bit = 0;      ///< rays per bit of the file
    double step = 0;                ///< of the quantiser, radiance
    int passes = 0;                 ///< number of times that the whole light field was coded
    std::uint64_t depth_bytes = 0;  ///< of `bytes`
    double depth_error = 0;         ///< bound on each depth, metres; 0: exact
};

/// Codes a light field into a .hgl stream (docs/format.md), tile by tile on all threads. Quality and rate are those of
/// all faces together. Memory: a few tiles per thread. The quantiser step that meets an SQNR or a rate is searched by
/// coding first some and then all of the tiles. A rate is met to the byte, either by filler metadata (less than half a
/// per cent; more for light fields of few samples) or by cutting an embedded code (ezw); with another rule of
/// PixelsPerBit the light field is read once for its histogram and coded once. With MaxError and Lossless the
/// step of the prediction is the one that codes the middle of the light field in the fewest bytes. Depth is coded first
/// and is a part of the file's size. The file appears under its name when it is complete. Throws Error(usage) for an
/// invalid target or method, a rate that no step gives, and a quality beyond the coder's limit; Error(bad_input) for
/// radiance that is not finite (unless the target is MaxError or Lossless), Error(cannot_write).
HOGEL_API CompressionResult compress(const LightField& light_field, const std::filesystem::path& path,
                                     const CompressionOptions& options, const Progress& progress = {});

/// Resources to compress a light field, without the cost of reading it. For an SQNR, the disk space is an upper
/// bound: the size without any prediction. Throws Error(usage) for an invalid method.
HOGEL_API Plan plan_compression(const LightField& light_field, const CompressionOptions& options);

/// The contents of a stream's header.
struct HOGEL_API StreamInfo {
    LightFieldGrid grid;  ///< of the light field, or of the front of a hemicube
    HogelRange tile;      ///< size of the tiles, s0 = t0 = 0
    CodingMethod method;  ///< names a row of coders(), or "lossless" or "bounded": the coder hogel with the targets
                          ///< Lossless and MaxError
    Metadata metadata;
    std::vector<LightFieldGrid> sides = {};  ///< further faces of a hemicube
    StreamLayout layout = StreamLayout::faces;
    std::uint32_t version = 1;  ///< of the format

    /// The curve of the histogram tone mapping with which the light field is coded.
    struct ToneMapping {
        double decades = 0;         ///< of luminance, from the first point of the curve to the last
        double mapped_decades = 0;  ///< decades after the curve is applied
    };
    std::optional<ToneMapping> tone;
    double chrominance = 1;  ///< steps of chrominance relative to those of luminance

    std::uint64_t filler = 0;                    ///< bytes without meaning that pad the file to a requested size
    std::vector<std::uint64_t> layer_ends = {};  ///< for each layer, the end in the file of its data for all tiles
    std::size_t layers_there = 0;  ///< complete layers in the file; fewer than `layer_ends` if it is truncated

    /// The stream of depths behind the layers.
    struct Depth {
        std::uint64_t bytes = 0;  ///< 0: the stream has no depth
        double error = 0;         ///< bound on each depth, metres; 0: exact
        double beyond = 0;        ///< decoded depths of this value or more mean infinity, metres
    };
    Depth depth = {};
    bool depth_there = false;  ///< whether the file has all depths

    /// The grids of all faces: `grid`, then `sides`.
    std::vector<LightFieldGrid> faces() const;
};

/// Whether a file begins like a .hgl stream. Throws Error(bad_input) if it does not exist.
HOGEL_API bool is_stream(const std::filesystem::path& path);

/// Reads and checks only the header and the index. A truncated file is accepted if it has the first layer. Throws
/// Error(bad_input) for any other damage.
HOGEL_API StreamInfo read_stream_info(const std::filesystem::path& path);

/// Options of open_stream().
struct StreamOptions {
    std::size_t memory = std::size_t{1} << 29;  ///< bytes for decoded tiles
    std::size_t layers = 0;                     ///< layers to decode; 0: all, and depth
};

/// Opens a compressed light field, which is decoded when it is read. The coder hogel decodes only what the requested
/// hogels depend on, other coders decode a whole tile. The tiles decoded last are kept for all faces, as many as fit
/// into `memory` but at least one. The light field has depth if the file does. Throws Error(bad_input) for a file that
/// is damaged, of another version, or truncated before the end of the last layer requested; damage inside a tile is
/// found when that tile is read. Throws Error(usage) for more layers than the file has.
HOGEL_API LightField open_stream(const std::filesystem::path& path, const StreamOptions& options = {});

/// Opens a stream of the coder fringes without inverting the transform of the directions, for holograms made of basis
/// fringes ([K] 4.2.3). The values are not radiances but the coefficients of √L, an array [n_V][n_U] for each hogel and
/// channel, of the transform that the header names; a hemicube has the coefficients of each face. Throws
/// Error(bad_input) as open_stream() does, and for another coder, for a light field with tone mapping or coarser
/// chrominance, and for a hemicube whose faces are coded as one unfolded picture.
HOGEL_API LightField open_coefficients(const std::filesystem::path& path);

/// The directions of an array [n_V][n_U] that belong to a light field: all of rows begin_v to end_v, and columns
/// begin_u to end_u of the other rows (ends excluded). By default all directions; for an unfolded hemicube its faces
/// without the corners.
struct DirectionCross {
    std::size_t begin_u = 0, end_u = 0, begin_v = 0, end_v = std::numeric_limits<std::size_t>::max();

    struct Columns {
        std::size_t begin, end;
    };
    /// The columns of row v that belong to the light field, in an array of `width` columns.
    Columns columns(std::size_t v, std::size_t width) const {
        return v >= begin_v && v < end_v ? Columns{0, width} : Columns{begin_u, end_u};
    }
};

/// A tile that is decoded when it is read.
class HOGEL_API TileDecoder {
  public:
    virtual ~TileDecoder() = default;
    /// Fills the radiance of a part of the tile. May be called from several threads. Throws Error(bad_input) if it
    /// detects bytes that no encoder makes.
    virtual void read(LightFieldTile& part) = 0;
};

/// Codes tiles of a light field as bytes and decodes them. Tiles are independent. Functions may be called from several
/// threads; the bytes of a tile do not depend on the number of threads.
class HOGEL_API TileCoder {
  public:
    struct Encoded {
        std::vector<std::uint8_t> bytes;
        double squared_error = 0;              ///< Σ (f − f′)² over the tile's directions that count
        std::vector<std::size_t> layers = {};  ///< the end of each layer in `bytes`; empty if there is only one
    };
    static constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

    virtual ~TileCoder() = default;
    /// The size of tile (s0 = t0 = 0) that suits the coder best.
    virtual HogelRange preferred_tile(const LightFieldGrid& grid) const = 0;
    /// The number of tiles to code at once: fewer than threads if one tile keeps several of them busy.
    virtual std::size_t max_at_once() const { return std::numeric_limits<std::size_t>::max(); }
    /// Whether radiance that is not finite can be coded.
    virtual bool takes_any_value() const { return false; }
    /// The length of the shortest code of a tile, if the code is embedded so that encode() can cut it to max_bytes;
    /// otherwise nothing.
    virtual std::optional<std::size_t> min_bytes(const LightFieldGrid&) const { return std::nullopt; }
    /// @param step   of the quantiser, radiance: the error is about step/√12 where the tile has detail of that size,
    ///               and smaller elsewhere
    /// @param tile   its radiance is overwritten
    virtual Encoded encode(LightFieldTile& tile, double step, std::size_t max_bytes = no_limit) const = 0;
    /// Fills the tile's radiance. Throws Error(bad_input) if it detects bytes that encode() does not make.
    virtual void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const = 0;
    /// The number of layers of a tile. The first ones alone give a coarser tile.
    virtual std::size_t layers(const HogelRange&) const { return 1; }
    /// Opens the first layers of a tile, which end with `bytes`, to be decoded when they are read. The default
    /// implementation decodes the whole tile at once.
    /// @param layers   1 to layers(range)
    virtual std::unique_ptr<TileDecoder> open(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid,
                                              const HogelRange& range, std::size_t layers) const;
    /// Whether hogels and directions are transformed independently, so that decode_coefficients() works.
    virtual bool directional() const { return false; }
    /// As decode(), but fills the tile with the coefficients of √L along the directions of each hogel. Throws
    /// Error(usage) unless directional().
    virtual void decode_coefficients(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const;
};

/// A coder: a row of coders().
struct CoderInfo {
    std::string name;
    std::string text;       ///< one line for help
    std::string transform;  ///< the default for an empty CodingMethod::transform; empty: the coder has no transform
    bool quantisation_table = false;  ///< whether CodingMethod::table is used
    /// Makes the coder for the tiles of a light field. Throws Error(usage) for a transform that the coder cannot use.
    /// @param counted   the directions whose errors count
    std::function<std::unique_ptr<TileCoder>(const CodingMethod& method, const LightFieldGrid& grid,
                                             const DirectionCross& counted)>
        make;
    bool three_pass = false;  ///< whether CodingMethod::symbols is used, and rules of PixelsPerBit other than search
};

/// All coders: hogel, threepass, ezw, jpeg4d, fringes, and those that a program adds. A stream stores the name of its
/// coder, so a program that reads it needs the same row.
HOGEL_API Table<CoderInfo>& coders();

/// The transforms of coders with a CoderInfo::transform: 15 wavelets, and dct8 for jpeg4d (docs/codec.md).
HOGEL_API std::vector<std::string> transform_names();

/// The bytes that each hogel takes in a stream of compress(), [t][s], of all faces and without depth. With the coder
/// hogel those of its own code and its share of what the tile's hogels have in common; other coders code the hogels of
/// a tile together, so that each of them counts alike. The sum is that of the stream's tiles. Reads the file once, and
/// decodes nothing. Throws Error(bad_input) for what is no stream, or damaged, Error(usage) for more layers than it
/// has.
/// @param layers  the first layers alone, by which later ones add their hogels; 0: all that the file has
HOGEL_API Array<double, 2> bytes_of_hogels(const std::filesystem::path& path, std::size_t layers = 0,
                                           const Progress& progress = {});

}  // namespace hogel
