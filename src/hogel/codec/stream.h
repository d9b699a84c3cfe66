#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

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
    HemicubeLayout layout = HemicubeLayout::faces;

    /// Of the format: 2 where there are sides.
    std::uint32_t version() const { return sides.empty() ? 1 : 2; }
    /// `grid` and `sides`.
    std::vector<LightFieldGrid> faces() const;
};

/// True for a plain file that begins as a stream does. Throws Error(bad_input) where there is no such file.
bool is_stream(const std::filesystem::path& path);

/// Reads the header and the index alone, and checks both. Throws Error(bad_input).
StreamInfo read_stream_info(const std::filesystem::path& path);

/// A compressed light field, decoded where it is read: a tile when it is first asked for. The tiles last decoded are
/// kept, as many as `memory` bytes hold, at least one. Of a hemicube this opens the front. Throws Error(bad_input) for
/// a file that is damaged, truncated or of another version; damage inside a tile shows when that tile is read.
std::unique_ptr<LightFieldSource> open_stream(const std::filesystem::path& path,
                                              std::size_t memory = std::size_t{1} << 29);

/// All faces, the front first. They share what is decoded.
std::vector<std::unique_ptr<LightFieldSource>> open_stream_faces(const std::filesystem::path& path,
                                                                 std::size_t memory = std::size_t{1} << 29);

/// The same before the transform of the directions is undone, for holograms made of basis fringes: in place of
/// radiances the coefficients of √L, an array [n_V][n_U] for each hogel and channel, of the transform that the header
/// names (Pyramid::separate, its two axes one group). Throws Error(bad_input) for a stream whose coder is not
/// `fringes`, and for a hemicube, too.
std::unique_ptr<LightFieldSource> open_coefficients(const std::filesystem::path& path,
                                                    std::size_t memory = std::size_t{1} << 29);

}  // namespace hogel
