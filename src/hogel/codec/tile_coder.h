// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/codec/format/unfolded.h"
#include "hogel/coding/jpeg4d.h"
#include "hogel/light_field.h"

namespace hogel::codec {

/// A tile that is decoded where it is read.
class TileDecoder {
  public:
    virtual ~TileDecoder() = default;
    /// Fills the radiance of a part of the tile. Several threads may ask at once. Throws Error(bad_input) for bytes
    /// that no encode() gives, where that shows.
    virtual void read(LightFieldTile& part) = 0;
};

/// What turns a tile of a light field into bytes and back. Tiles are coded apart from each other, so that any of them
/// can be decoded without the rest. May be used by several threads at once; the same bytes for any number of them.
class TileCoder {
  public:
    struct Encoded {
        std::vector<std::uint8_t> bytes;
        double squared_error = 0;  ///< Σ (f − f')² over the tile's directions that count, of what decode() gives
        std::vector<std::size_t> layers = {};  ///< where each layer ends in bytes; empty for one
    };
    static constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

    virtual ~TileCoder() = default;
    /// The size of tile (s0 = t0 = 0) that it works best on.
    virtual HogelRange preferred_tile(const LightFieldGrid& grid) const = 0;
    /// How many tiles to code at once: as many as there are threads, or fewer where a tile keeps all of them busy.
    virtual std::size_t max_at_once() const { return std::numeric_limits<std::size_t>::max(); }
    /// True where radiance that is not finite is coded as it is.
    virtual bool takes_any_value() const { return false; }
    /// What is left of a tile at least, where encode() heeds max_bytes: with more of its bytes it is finer.
    virtual std::optional<std::size_t> min_bytes(const LightFieldGrid&) const { return std::nullopt; }
    /// @param step   the quantiser's, in units of radiance: the larger, the coarser. An error is about step/√12 where
    ///               the tile holds detail of that size, and less elsewhere.
    /// @param tile   is used up: its radiance means nothing afterwards
    virtual Encoded encode(LightFieldTile& tile, double step, std::size_t max_bytes = no_limit) const = 0;
    /// Fills the tile's radiance. Throws Error(bad_input) for bytes that no encode() gives, where that shows.
    virtual void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const = 0;
    /// How many layers a tile has: the first ones alone give a coarser tile.
    virtual std::size_t layers(const HogelRange&) const { return 1; }
    /// Decodes the first layers of a tile as far as they are asked for; by default all at once.
    /// @param layers   1 to layers(range); the bytes end with the last of them
    virtual std::unique_ptr<TileDecoder> open(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid,
                                              const HogelRange& range, std::size_t layers) const;
    /// True where decode_coefficients() works: where hogels and directions are transformed apart.
    virtual bool directional() const { return false; }
    /// Fills the tile's radiance with coefficients instead: of √L, along the directions of each hogel, as they are
    /// before the transform of the directions is undone. Throws Error(usage) unless directional().
    virtual void decode_coefficients(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const;
};

/// How the samples of a tile become bytes.
struct CodingMethod {
    std::string coder = "hogel";
    std::string transform;  ///< empty for the coder hogel, which has one of its own
    coding::QuantisationTable table =
        coding::QuantisationTable::own;  ///< for jpeg4d to encode with; each tile says which it has
    friend bool operator==(const CodingMethod&, const CodingMethod&) = default;
};

/// hogel|threepass|ezw|jpeg4d|fringes. Streams also know lossless and bounded, which compress() makes of hogel.
std::vector<std::string_view> coder_names();

/// The version of the format that is written; older ones are read.
constexpr std::uint32_t latest_version = 6;

/// @param counted   the directions whose errors count
/// @param version   of the format (docs/format.md); only of the latest one anything can be encoded
/// Throws Error(usage) for a coder or transform that does not exist, or two that do not go together.
std::unique_ptr<TileCoder> make_tile_coder(const CodingMethod& method, const LightFieldGrid& grid,
                                           const format::DirectionCross& counted = {},
                                           std::uint32_t version = latest_version);

/// The transform that a coder is used with where none is named.
std::string_view default_transform(std::string_view coder);

}  // namespace hogel::codec
