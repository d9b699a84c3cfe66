#include "hogel/codec/hogel_coder_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hogel/codec/analysis_internal.h"
#include "hogel/codec/bytes_internal.h"
#include "hogel/codec/colour_internal.h"
#include "hogel/core/error.h"
#include "hogel/core/parallel.h"

namespace hogel {
namespace {

constexpr std::size_t most_side = 64;       // hogels along a side of a tile
constexpr std::size_t preferred_side = 32;  // where prediction gains little more
constexpr std::size_t preferred_samples = std::size_t{1} << 27, most_samples = std::size_t{1} << 28;
constexpr float growth = 1.35f;  // of the step from one level of the order to the next

// A hogel's channels, filled up to whole blocks by their last samples, apart in luminance and chrominance.
Picture picture_of(const LightFieldTile& tile, const TileSetup& setup, std::size_t s, std::size_t t) {
    Picture picture = setup.blank();
    for (std::size_t c = 0; c < picture.size(); ++c)
        for (std::size_t v = 0; v < picture[c].height; ++v) {
            const float* in = &tile.radiance(c, t, s, std::min(v, setup.height - 1), 0);
            float* out = &picture[c].samples[v * picture[c].width];
            std::copy_n(in, setup.width, out);
            std::fill(out + setup.width, out + picture[c].width, in[setup.width - 1]);
        }
    if (picture.size() == 3) separate_colours(picture[0].samples, picture[1].samples, picture[2].samples);
    return picture;
}

// The way back, row by row.
template <class Use>
void for_each_row(const Picture& picture, const TileSetup& setup, Use&& use) {
    std::array<std::vector<float>, 3> row;
    for (std::size_t v = 0; v < setup.height; ++v) {
        for (std::size_t c = 0; c < picture.size(); ++c) {
            const float* in = &picture[c].samples[v * picture[c].width];
            row[c].assign(in, in + setup.width);
        }
        if (picture.size() == 3) join_colours(row[0], row[1], row[2]);
        for (std::size_t c = 0; c < picture.size(); ++c) use(c, v, row[c]);
    }
}

double squared_error(const Picture& picture, const TileSetup& setup, const LightFieldTile& tile, std::size_t s,
                     std::size_t t, const DirectionCross& counted) {
    double sum = 0;
    for_each_row(picture, setup, [&](std::size_t c, std::size_t v, const std::vector<float>& row) {
        const float* truth = &tile.radiance(c, t, s, v, 0);
        const auto [begin, end] = counted.columns(v, row.size());
        for (std::size_t u = begin; u < end; ++u) {
            const double error = static_cast<double>(truth[u]) - row[u];
            sum += error * error;
        }
    });
    return sum;
}

class HogelCoder final : public TileCoder {
  public:
    HogelCoder(const LightFieldGrid& grid, const DirectionCross& counted)
        : aspect_(static_cast<float>(grid.step_u() / grid.step_v())), counted_(counted) {}

    HogelRange preferred_tile(const LightFieldGrid& grid) const override {
        const std::size_t hogel = samples_of_hogel(grid.directions_u, grid.directions_v, grid.channels);
        std::size_t side = preferred_side;
        while (side > 1 && side * side * hogel > preferred_samples) --side;
        // Tiles of nearly one size rather than whole ones and a narrow rest.
        const auto even = [&](std::size_t count) {
            const std::size_t tiles = (count + side - 1) / side;
            return (count + tiles - 1) / tiles;
        };
        return {0, 0, even(grid.hogels_s), even(grid.hogels_t)};
    }

    std::size_t most_at_once() const override { return 2; }

    Encoded encode(const LightFieldTile& tile, double step, std::size_t) const override {
        if (!fits(tile))
            throw Error(ErrorCode::usage,
                        fmt::format("tiles of {} × {} hogels were asked for, expected at most {} × "
                                    "{} and {} samples in whole blocks",
                                    tile.range.ns, tile.range.nt, most_side, most_side, most_samples));
        const TileSetup setup = setup_of(tile, static_cast<float>(step), growth);
        const auto& order = setup.order.hogels();
        std::vector<Picture> sources(order.size()), pictures(order.size());  // row by row; in the order
        const auto source = [&](const HogelOrder::Hogel& hogel) -> Picture& {
            return sources[hogel.t * tile.range.ns + hogel.s];
        };
        parallel_for(order.size(), [&](std::size_t k) {
            sources[k] = picture_of(tile, setup, k % tile.range.ns, k / tile.range.ns);
        });
        std::array<std::vector<std::int16_t>, 4> estimated;  // of the corners, which come first
        parallel_for(std::min(estimated.size(), order.size()), [&](std::size_t k) {
            if (order[k].level == 0) estimated[k] = estimate_disparities(setup, sources, tile.range.ns, order[k]);
        });
        std::vector<CodedHogel> coded(order.size());
        std::vector<double> errors(order.size());
        BlockWriter writer;
        const auto models = std::make_unique<BlockModels>();
        for (std::size_t wave = 0; wave + 1 < setup.order.waves().size(); ++wave) {
            const std::size_t begin = setup.order.waves()[wave], end = setup.order.waves()[wave + 1];
            std::vector<std::vector<std::optional<std::int16_t>>> moved(end - begin);
            parallel_for(end - begin, [&](std::size_t n) {
                const std::size_t k = begin + n;
                const HogelOrder::Hogel& hogel = order[k];
                moved[n] = moved_disparities(hogel, coded, setup.grid, setup.aspect);
                coded[k] = analyse(setup, k, source(hogel), moved[n], beside(hogel, coded),
                                   k < estimated.size() ? estimated[k] : std::vector<std::int16_t>{}, pictures);
                errors[k] = squared_error(pictures[k], setup, tile, hogel.s, hogel.t, counted_);
                source(hogel) = {};
            });
            for (std::size_t k = begin; k < end; ++k) {
                code_hogel(writer, *models, setup.grid, order[k], moved[k - begin], beside(order[k], coded), coded[k]);
                coded[k].levels = {};
            }
        }
        ByteWriter bytes;
        bytes.put(static_cast<float>(step));
        bytes.put(growth);
        const std::vector<std::uint8_t> code = writer.finish();
        bytes.put(std::span(code));
        return {std::move(bytes.bytes), std::accumulate(errors.begin(), errors.end(), 0.0)};
    }

    void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const override {
        ByteReader header(bytes, "tile");
        if (!fits(tile)) header.damaged("it is too large");
        const float step = header.take_float(), step_growth = header.take_float();
        if (!(step > 0 && std::isfinite(step) && step_growth >= 1 && step_growth <= 4))
            header.damaged("its steps are no steps");
        const TileSetup setup = setup_of(tile, step, step_growth);
        const auto& order = setup.order.hogels();
        std::vector<CodedHogel> coded(order.size());
        std::vector<Picture> pictures(order.size());
        BlockReader reader(header.take(header.left()));
        const auto models = std::make_unique<BlockModels>();
        for (std::size_t wave = 0; wave + 1 < setup.order.waves().size(); ++wave) {
            const std::size_t begin = setup.order.waves()[wave], end = setup.order.waves()[wave + 1];
            std::vector<std::vector<std::optional<std::int16_t>>> moved(end - begin);
            parallel_for(end - begin, [&](std::size_t n) {
                moved[n] = moved_disparities(order[begin + n], coded, setup.grid, setup.aspect);
            });
            for (std::size_t k = begin; k < end; ++k)
                code_hogel(reader, *models, setup.grid, order[k], moved[k - begin], beside(order[k], coded), coded[k]);
            if (reader.ended()) header.damaged("it ends too early");
            parallel_for(end - begin, [&](std::size_t n) {
                const std::size_t k = begin + n;
                reconstruct(setup, k, coded[k], pictures);
                coded[k].levels = {};
                for_each_row(pictures[k], setup, [&](std::size_t c, std::size_t v, const std::vector<float>& row) {
                    std::ranges::copy(row, &tile.radiance(c, order[k].t, order[k].s, v, 0));
                });
            });
        }
        if (!reader.all_read()) header.damaged("bytes are left over");
    }

  private:
    TileSetup setup_of(const LightFieldTile& tile, float step, float step_growth) const {
        return TileSetup(tile.range.ns, tile.range.nt, tile.radiance.extent(4), tile.radiance.extent(3),
                         tile.radiance.extent(0), step, step_growth, aspect_);
    }
    static const std::vector<Block>* beside(const HogelOrder::Hogel& hogel, const std::vector<CodedHogel>& coded) {
        return hogel.references.empty() ? nullptr : &coded[hogel.references[0].hogel].blocks;
    }
    // Whole blocks of all channels of a hogel.
    static std::size_t samples_of_hogel(std::size_t directions_u, std::size_t directions_v, std::size_t channels) {
        const auto whole = [](std::size_t n) { return (n + block_side - 1) / block_side * block_side; };
        return whole(directions_u) * whole(directions_v) * channels;
    }
    static bool fits(const LightFieldTile& tile) {
        const auto& shape = tile.radiance.shape();
        return tile.range.ns <= most_side && tile.range.nt <= most_side &&
               samples_of_hogel(shape[4], shape[3], shape[0]) <= most_samples / tile.range.hogels();
    }

    float aspect_;
    DirectionCross counted_;
};

}  // namespace

std::unique_ptr<TileCoder> make_hogel_coder(const LightFieldGrid& grid, const DirectionCross& counted) {
    return std::make_unique<HogelCoder>(grid, counted);
}

}  // namespace hogel
