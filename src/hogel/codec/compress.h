#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "hogel/codec/stream.h"
#include "hogel/core/progress.h"

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
    CodingMethod method;
    CompressionTarget target;
    std::optional<HogelRange> tile;  ///< size of the tiles; by default what suits the coder
    Metadata metadata;               ///< no word of the name `filler`
    /// By default `gathered` where that can be and the coder is hogel, otherwise `faces`.
    std::optional<StreamLayout> layout;
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

/// Codes a light field into a .hgl stream (docs/format.md), tile by tile on all threads; memory: some tiles a thread.
/// The step that meets the target is found by coding, first some of the tiles and then all, until
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

}  // namespace hogel
