#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "hogel/codec/radiance_mapping.h"
#include "hogel/codec/tile_coder.h"
#include "hogel/codec/unfolded.h"
#include "hogel/image/image.h"
#include "hogel/lightfield/light_field.h"

namespace hogel {

/// What the header of a compressed light field (.hgl, docs/format.md) says.
struct StreamInfo {
    LightFieldGrid grid;
    HogelRange tile;  ///< size of the tiles that are coded apart, s0 = t0 = 0
    CodingMethod method;
    Metadata metadata;
    std::vector<LightFieldGrid> sides = {};  ///< further faces of a hemicube, whose front is `grid`
    StreamLayout layout = StreamLayout::faces;
    RadianceMapping mapping = {};            ///< of what is coded
    std::uint32_t version = latest_version;  ///< of the format
    std::uint64_t filler = 0;                ///< bytes that say nothing, so that the file is as long as was asked for
    /// How often the file gets finer: where each layer of all tiles ends in it, the last one at its end. Older versions
    /// have a single one.
    std::vector<std::uint64_t> layer_ends = {};
    std::size_t layers_there = 0;  ///< that the file has whole; fewer where it was cut off
    /// Of the depths of all faces, which stand behind the layers as a stream of their own.
    struct Depth {
        std::uint64_t bytes = 0;  ///< 0: there are none
        double error = 0;         ///< of each at most, metres
        double beyond = 0;        ///< from there on what the stream holds is infinity, metres
    } depth = {};
    bool depth_there = false;  ///< whether the file has them whole

    /// `grid` and `sides`.
    std::vector<LightFieldGrid> faces() const;
};

/// True for a plain file that begins as a stream does. Throws Error(bad_input) where there is no such file.
bool is_stream(const std::filesystem::path& path);

/// Reads the header and the index alone, and checks both. A file that was cut off is taken as long as it has them.
/// Throws Error(bad_input).
StreamInfo read_stream_info(const std::filesystem::path& path);

/// How a stream is opened.
struct StreamOptions {
    std::size_t memory = std::size_t{1} << 29;  ///< bytes for decoded tiles
    std::size_t layers = 0;  ///< how many to decode: fewer are coarser and need less of the file; 0: all, and depth
};

/// A compressed light field, decoded where it is read. Of the coder hogel as far as is needed for the hogels that are
/// asked for, of others a whole tile. The tiles last decoded are kept, as many as `memory` bytes hold, at least one. Of
/// a hemicube this opens the front. Throws Error(bad_input) for a file that is damaged, of another version, or cut off
/// before the end of the last layer that is wanted; damage inside a tile shows when that tile is read. Throws
/// Error(usage) for more layers than there are. Depth is there if it was compressed, too, and the file has it.
std::unique_ptr<LightFieldSource> open_stream(const std::filesystem::path& path, const StreamOptions& options = {});

/// All faces, the front first. They share what is decoded.
std::vector<std::unique_ptr<LightFieldSource>> open_stream_faces(const std::filesystem::path& path,
                                                                 const StreamOptions& options = {});

/// The same before the transform of the directions is undone, for holograms made of basis fringes: in place of
/// radiances the coefficients of √L, an array [n_V][n_U] for each hogel and channel, of the transform that the header
/// names (Pyramid::separate, its two axes one group). Throws Error(bad_input) for a stream whose coder is not
/// `fringes`, whose radiances were mapped, and for a hemicube, too.
std::unique_ptr<LightFieldSource> open_coefficients(const std::filesystem::path& path);

}  // namespace hogel
