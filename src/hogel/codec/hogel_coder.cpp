#include "hogel/codec/hogel_coder_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "hogel/codec/analysis_internal.h"
#include "hogel/codec/bytes_internal.h"
#include "hogel/codec/chained_hogels_internal.h"
#include "hogel/codec/hogel_decoder_internal.h"
#include "hogel/codec/model_states_internal.h"
#include "hogel/codec/pictures_internal.h"
#include "hogel/core/error.h"
#include "hogel/core/parallel.h"

namespace hogel {
namespace {

constexpr std::size_t preferred_side = 32;  // where prediction gains little more
constexpr std::size_t preferred_samples = std::size_t{1} << 27;
// How the step grows from one level of the order to the next. What all hogels share is best told once and finely.
constexpr float expected_growth = 1.35f;
// In a single row of hogels a level has twice as many as those before it, not four times: less is inherited.
float growth_for(float shared, bool single_row) {
    const float growth = 1.27f + 0.63f * shared * shared * shared * shared;
    return single_row ? std::cbrt(growth) : growth;
}
// References to the left, to the right, above and below. Where hogels are fine enough to be moved by fractions of a
// direction the nearest ones serve best; otherwise it takes more to choose from.
constexpr std::array<std::uint8_t, 3> references_a_side{1, 2, 3};
constexpr std::size_t counted_hogels = 48;    // of a level, for the states of its models
constexpr std::size_t tried_directions = 32;  // along a side of a window

double squared_error(const Picture& picture, const TileSetup& setup, const LightFieldTile& tile, std::size_t s,
                     std::size_t t, const DirectionCross& counted) {
    double sum = 0;
    for_each_row(picture, setup, [&](std::size_t c, std::size_t v, std::span<const float> row) {
        const float* truth = &tile.radiance(c, t, s, v, 0);
        const auto [begin, end] = counted.columns(v, row.size());
        sum += squared_difference_of_rows(truth + begin, row.data() + begin, end - begin);
    });
    return sum;
}

// Codes a tile level by level: decides on all hogels of a level, and then writes their codes, each by itself.
class TileEncoder {
  public:
    TileEncoder(const LightFieldTile& tile, const LightFieldGrid& grid, const DirectionCross& counted, float step,
                std::uint8_t references)
        : tile_(tile),
          counted_(counted),
          setup_(HogelOrder(tile.range.ns, tile.range.nt, references, tellers_a_side), grid.directions_u,
                 grid.directions_v, grid.channels, step, expected_growth,
                 static_cast<float>(grid.step_u() / grid.step_v()), latest_version),
          references_(references),
          order_(setup_.order.hogels()),
          pictures_(order_.size()),
          coded_(order_.size()),
          moved_(order_.size()),
          errors_(order_.size()) {}

    TileCoder::Encoded run() {
        // Of the first hogels the first one has no references, and the others have none near by.
        std::array<Estimate, 9> estimates;
        parallel_for(std::min(estimates.size(), order_.size()), [&](std::size_t k) {
            if (order_[k].level < 2) estimates[k] = estimate_disparities(setup_, tile_, order_[k]);
        });
        for (std::size_t k = 0; k < estimates.size(); ++k) estimated_[k] = std::move(estimates[k].disparities);
        const float growth = growth_for(estimates[0].shared, tile_.range.ns == 1 || tile_.range.nt == 1);
        setup_.set_steps(setup_.step.back(), growth);
        bytes_.put(setup_.step.back());
        bytes_.put(growth);
        bytes_.put(references_);
        const auto& waves = setup_.order.waves();
        const auto& waves_of_levels = setup_.order.waves_of_levels();
        TileCoder::Encoded result;
        for (std::size_t level = 0; level + 1 < waves_of_levels.size(); ++level) {
            for (std::size_t wave = waves_of_levels[level]; wave < waves_of_levels[level + 1]; ++wave)
                parallel_for(waves[wave + 1] - waves[wave], [&](std::size_t n) { decide(waves[wave] + n); });
            write(waves[waves_of_levels[level]], waves[waves_of_levels[level + 1]]);
            result.layers.push_back(bytes_.bytes.size());
        }
        result.bytes = std::move(bytes_.bytes);
        result.squared_error = std::accumulate(errors_.begin(), errors_.end(), 0.0);
        return result;
    }

  private:
    const std::vector<Block>* beside(const HogelOrder::Hogel& hogel) const {
        return hogel.tellers.empty() ? nullptr : &coded_[hogel.tellers.front().hogel].blocks;
    }

    void decide(std::size_t k) {
        const HogelOrder::Hogel& hogel = order_[k];
        const Picture source = picture_of(tile_, setup_, hogel.s, hogel.t);
        moved_[k] = moved_blocks(hogel, coded_, setup_.grid, setup_.aspect);
        coded_[k] = analyse(setup_, k, source, moved_[k], beside(hogel),
                            k < estimated_.size() ? estimated_[k] : std::vector<std::int16_t>{}, pictures_);
        errors_[k] = squared_error(pictures_[k], setup_, tile_, hogel.s, hogel.t, counted_);
        if (hogel.wave + 2 == setup_.order.waves().size()) pictures_[k] = {};  // nothing comes after it
    }

    template <class Coder>
    void code(Coder& coder, typename Coder::Models& models, std::size_t k) {
        code_hogel(coder, models, setup_.grid, order_[k], moved_[k], beside(order_[k]), coded_[k]);
    }

    // The hogels of a level, from begin to end.
    void write(std::size_t begin, std::size_t end) {
        // As many hogels as tell the models' states well enough.
        const std::size_t apart = 1 + (end - begin) / counted_hogels;
        std::vector<BlockCounts> counts(std::min<std::size_t>(end - begin, 16));
        parallel_for(counts.size(), [&](std::size_t part) {
            for (std::size_t k = begin + part * apart; k < end; k += apart * counts.size()) {
                BlockCounter counter;
                code(counter, counts[part], k);
            }
        });
        for (std::size_t part = 1; part < counts.size(); ++part) counts[0].add(counts[part]);
        const ModelStates states(counts[0], states_);
        const BlockModels models = states.models();
        std::vector<std::vector<std::uint8_t>> codes(end - begin);
        parallel_for(codes.size(), [&](std::size_t n) {
            BlockWriter writer;
            BlockModels own = models;
            code(writer, own, begin + n);
            codes[n] = writer.finish();
            coded_[begin + n].levels = {};
            moved_[begin + n] = {};
        });
        BlockWriter side;
        ModelStates(states).code(side, states_);
        CodeLengths lengths;
        for (const auto& code : codes) lengths.code(side, static_cast<std::uint32_t>(code.size()));
        const std::vector<std::uint8_t> beside_codes = side.finish();
        bytes_.put(static_cast<std::uint32_t>(beside_codes.size()));
        bytes_.put(std::span(beside_codes));
        for (const auto& code : codes) bytes_.put(std::span(code));
        states_ = states;
    }

    const LightFieldTile& tile_;
    const DirectionCross& counted_;
    TileSetup setup_;
    std::uint8_t references_;
    const std::vector<HogelOrder::Hogel>& order_;
    std::vector<Picture> pictures_;                       // in the order
    std::array<std::vector<std::int16_t>, 9> estimated_;  // disparities of the first ones
    std::vector<CodedHogel> coded_;
    std::vector<std::vector<const Block*>> moved_;
    std::vector<double> errors_;
    ModelStates states_{latest_version};
    ByteWriter bytes_;
};

// A window of directions of a tile, in both directions one or three quarters of the way.
struct Window {
    LightFieldGrid grid;
    LightFieldTile tile;
};
Window window_of(const LightFieldTile& tile, const LightFieldGrid& grid, std::size_t quarters) {
    LightFieldGrid part = grid;
    part.directions_u = std::min(grid.directions_u, tried_directions);
    part.directions_v = std::min(grid.directions_v, tried_directions);
    part.tan_half_u *= static_cast<double>(part.directions_u) / static_cast<double>(grid.directions_u);
    part.tan_half_v *= static_cast<double>(part.directions_v) / static_cast<double>(grid.directions_v);
    Window window{part, LightFieldTile(part, tile.range, false)};
    copy_common(tile, window.tile, (grid.directions_v - part.directions_v) * quarters / 4,
                (grid.directions_u - part.directions_u) * quarters / 4);
    return window;
}

// The number of references that does best on two windows of directions. It does not change with every small change of
// the step, so that a search for a step sees a function without jumps.
std::uint8_t best_references(const LightFieldTile& tile, const LightFieldGrid& grid, double step) {
    const double near = std::exp2(std::round(2 * std::log2(step)) / 2);
    constexpr std::size_t windows = 2, ways = references_a_side.size();
    std::array<double, windows * ways> costs{};
    parallel_for(costs.size(), [&](std::size_t n) {
        const Window window = window_of(tile, grid, 1 + n / ways * 2);
        const auto coded =
            TileEncoder(window.tile, window.grid, {}, static_cast<float>(near), references_a_side[n % ways]).run();
        costs[n] = coded.squared_error + bit_worth * near * near * 8 * static_cast<double>(coded.bytes.size());
    });
    std::array<double, ways> cost{};
    for (std::size_t n = 0; n < costs.size(); ++n) cost[n % ways] += costs[n];
    return references_a_side[static_cast<std::size_t>(std::ranges::min_element(cost) - cost.begin())];
}

class HogelCoder final : public TileCoder {
  public:
    HogelCoder(const LightFieldGrid& grid, const DirectionCross& counted, std::uint32_t version)
        : grid_(grid), counted_(counted), version_(version) {}

    HogelRange preferred_tile(const LightFieldGrid& grid) const override {
        std::size_t side = preferred_side;
        while (side > 1 && side * side * samples_in_blocks(grid) > preferred_samples) --side;
        // Tiles of nearly one size rather than whole ones and a narrow rest.
        const auto even = [&](std::size_t count) {
            const std::size_t tiles = (count + side - 1) / side;
            return (count + tiles - 1) / tiles;
        };
        return {0, 0, even(grid.hogels_s), even(grid.hogels_t)};
    }

    std::size_t most_at_once() const override { return 2; }

    std::size_t layers(const HogelRange& tile) const override {
        return version_ < 3 ? 1
                            : static_cast<std::size_t>(HogelOrder::levels(tile.ns, tile.nt, begin_of_order(version_)));
    }

    Encoded encode(const LightFieldTile& tile, double step, std::size_t) const override {
        if (!hogel_tile_fits(grid_, tile.range))
            throw Error(ErrorCode::usage, fmt::format("tiles of {} × {} hogels were asked for, expected at most {} × "
                                                      "{} and {} samples in whole blocks",
                                                      tile.range.ns, tile.range.nt, most_hogel_tile_side,
                                                      most_hogel_tile_side, most_hogel_tile_samples));
        return TileEncoder(tile, grid_, counted_, static_cast<float>(step), best_references(tile, grid_, step)).run();
    }

    void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const override {
        if (version_ < 3) return decode_chained_hogels(bytes, grid_, tile);
        HogelDecoder({bytes.begin(), bytes.end()}, grid_, tile.range, layers(tile.range), version_).read(tile);
    }

    std::unique_ptr<TileDecoder> open(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid,
                                      const HogelRange& range, std::size_t levels) const override {
        if (version_ < 3) return TileCoder::open(std::move(bytes), grid, range, levels);
        return std::make_unique<HogelDecoder>(std::move(bytes), grid, range, levels, version_);
    }

  private:
    LightFieldGrid grid_;
    DirectionCross counted_;
    std::uint32_t version_;
};

}  // namespace

std::unique_ptr<TileCoder> make_hogel_coder(const LightFieldGrid& grid, const DirectionCross& counted,
                                            std::uint32_t version) {
    return std::make_unique<HogelCoder>(grid, counted, version);
}

}  // namespace hogel
