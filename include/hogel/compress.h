// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "hogel/codec/format/radiance_mapping.h"
#include "hogel/codec/format/unfolded.h"
#include "hogel/codec/tile_coder.h"
#include "hogel/image.h"
#include "hogel/light_field.h"
#include "hogel/progress.h"
namespace hogel {

/// What to give up for a small file: exactly one.
struct CompressionTarget {
    std::optional<double> sqnr;            ///< 10 log10(Σ f² / Σ (f − f')²) in decibels, over all samples
    std::optional<double> pixels_per_bit;  ///< rays (with all their channels) a bit of the whole file, to the byte
    std::optional<double> step;            ///< the quantiser's, in units of radiance, as it is
    std::optional<double> max_error;  ///< |f − f'| of every sample at most; what is not finite comes back as it is
    bool lossless = false;            ///< nothing: every float comes back with all its bits
};

struct CompressionOptions {
    codec::CodingMethod method;
    CompressionTarget target;
    std::optional<HogelRange> tile;  ///< size of the tiles; by default what suits the coder
    Metadata metadata;               ///< no word of the name `filler`
    /// By default `gathered` where that can be and the coder is hogel, otherwise `faces`.
    std::optional<codec::format::StreamLayout> layout;
    bool with_depth = false;  ///< whether the sources' depth is stored, too
    double depth_error = 0;   ///< of each at most, metres; 0: a 1,000th of the depths' range
    /// Decades of luminance that the light field is mapped to before it is coded, by the adjustment of its histogram
    /// (docs/codec.md); one that spans no more is left as it is.
    std::optional<double> tone_decades;
    double chrominance = 1;  ///< how many times as coarse as luminance; three channels, unless it is 1
};

struct CompressionResult {
    std::uint64_t bytes = 0;
    double sqnr = 0, pixels_per_bit = 0;
    double step = 0;                ///< the one that was found
    int passes = 0;                 ///< how often the light field was read and coded, whole
    std::uint64_t depth_bytes = 0;  ///< of `bytes`
    double depth_error = 0;         ///< metres
};

/// RawPixels a light field into a .hgl stream (docs/format.md), tile by tile on all threads; memory: some tiles a
/// thread. The step that meets the target is found by coding, first some of the tiles and then all, until
///   an SQNR is met or exceeded by at most 0.1 dB,
///   or the rate is met: what is missing to it to the byte, less than half a per cent but for light fields of few
///   samples, is filled up with what says nothing, or cut off where the coder is embedded.
/// Within an error, or lossless, what is coded beside the prediction makes it so, and the step is the one among some
/// that gives the smallest tiles; with the coder hogel alone. Where that cannot be (a light field of few samples), the
/// file is the smallest that has the SQNR. With a tone curve or coarser chrominance, SQNR and step are those of the
/// mapped light field that is coded. Depth is coded first, and counts as a part of the file. The file appears when it
/// is complete. Throws Error(usage) for a target or method that makes no sense, a rate that no step has, and a
/// quality that is finer than the coder can be,
/// Error(bad_input) for radiance that is not finite (within an error, or lossless: it may be), Error(cannot_write).
CompressionResult compress(const LightFieldSource& source, const std::filesystem::path& path,
                           const CompressionOptions& options, const Progress& progress = {});

/// The same of all faces of a hemicube, the front first, in one stream. Quality and rate are those of all together.
CompressionResult compress(std::span<const LightFieldSource* const> faces, const std::filesystem::path& path,
                           const CompressionOptions& options, const Progress& progress = {});

/// What the header of a compressed light field (.hgl, docs/format.md) says.
struct StreamInfo {
    LightFieldGrid grid;
    HogelRange tile;  ///< size of the tiles that are coded apart, s0 = t0 = 0
    codec::CodingMethod method;
    Metadata metadata;
    std::vector<LightFieldGrid> sides = {};  ///< further faces of a hemicube, whose front is `grid`
    codec::format::StreamLayout layout = codec::format::StreamLayout::faces;
    codec::format::Companding mapping = {};         ///< of what is coded
    std::uint32_t version = codec::latest_version;  ///< of the format
    std::uint64_t filler = 0;  ///< bytes that say nothing, so that the file is as long as was asked for
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
