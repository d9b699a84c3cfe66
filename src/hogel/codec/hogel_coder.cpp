// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/hogel_coder.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

#include "hogel/codec/decode/hogel_decoder.h"
#include "hogel/codec/encode/analysis.h"
#include "hogel/codec/format/bytes.h"
#include "hogel/codec/format/model_states.h"
#include "hogel/codec/format/pictures.h"
#include "hogel/core/parallel.h"
#include "hogel/error.h"

namespace hogel::codec {

using namespace format;

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
constexpr std::uint8_t max_references = 3;
constexpr std::size_t counted_hogels = 48;    // of a level, for the states of its models
constexpr std::size_t tried_directions = 32;  // along a side of a window

// @param truth   with its colours
double squared_error(const Picture& picture, const TileSetup& setup, const Picture& truth,
                     const DirectionCross& counted) {
    double sum = 0;
    for_each_row(picture, setup, [&](std::size_t c, std::size_t v, std::span<const float> row) {
        const float* wanted = &truth[c].samples[v * truth[c].width];
        const auto [begin, end] = counted.columns(v, row.size());
        sum += squared_difference_of_rows(wanted + begin, row.data() + begin, end - begin);
    });
    return sum;
}

// Of the first hogels the first one has no references, and the others have none near by.
constexpr std::size_t first_hogels = 9;
using Estimates = std::array<encode::Estimate, first_hogels>;

// RawPixels a tile level by level: decides on all hogels of a level, and then writes their codes, each by itself.
class TileEncoder {
  public:
    // @param tile   is used up
    TileEncoder(LightFieldTile& tile, const LightFieldGrid& grid, const DirectionCross& counted, float step,
                std::uint8_t references)
        : tile_(tile),
          counted_(counted),
          setup_(HogelOrder(tile.range.ns, tile.range.nt, references, decode::tellers_a_side), grid.directions_u,
                 grid.directions_v, grid.channels, step, expected_growth,
                 static_cast<float>(grid.step_u() / grid.step_v())),
          references_(references),
          order_(setup_.order.hogels()),
          pictures_(order_.size()),
          coded_(order_.size()),
          records_(order_.size()),
          errors_(order_.size()) {}

    Estimates estimate() const {
        Estimates estimates;
        core::parallel_for(std::min(estimates.size(), order_.size()), [&](std::size_t k) {
            if (order_[k].level < 2) estimates[k] = encode::estimate_disparities(setup_, tile_, order_[k]);
        });
        return estimates;
    }

    // Asks after each wave whether to go on, with what error and bytes come to so far. Returns nothing where not.
    using GoOn = std::function<bool(double error, std::size_t bytes)>;
    std::optional<TileCoder::Encoded> run(const Estimates& estimates, const GoOn& go_on = {}) {
        for (std::size_t k = 0; k < estimates.size(); ++k) estimated_[k] = estimates[k].disparities;
        const float growth = growth_for(estimates[0].shared, tile_.range.ns == 1 || tile_.range.nt == 1);
        setup_.set_steps(setup_.step.back(), growth);
        bytes_.put(setup_.step.back());
        bytes_.put(growth);
        bytes_.put(references_);
        const auto& waves = setup_.order.waves();
        const auto& waves_of_levels = setup_.order.waves_of_levels();
        TileCoder::Encoded result;
        for (std::size_t level = 0; level + 1 < waves_of_levels.size(); ++level) {
            for (std::size_t wave = waves_of_levels[level]; wave < waves_of_levels[level + 1]; ++wave) {
                core::parallel_for(waves[wave + 1] - waves[wave], [&](std::size_t n) { decide(waves[wave] + n); });
                if (go_on && !go_on(error(), bytes_.bytes.size())) return std::nullopt;
            }
            write(waves[waves_of_levels[level]], waves[waves_of_levels[level + 1]]);
            result.layers.push_back(bytes_.bytes.size());
        }
        result.bytes = std::move(bytes_.bytes);
        result.squared_error = error();
        return result;
    }

  private:
    double error() const { return std::accumulate(errors_.begin(), errors_.end(), 0.0); }

    const std::vector<Block>* beside(const HogelOrder::Hogel& hogel) const {
        return hogel.tellers.empty() ? nullptr : &coded_[hogel.tellers.front().hogel].blocks;
    }

    void decide(std::size_t k) {
        const HogelOrder::Hogel& hogel = order_[k];
        const Picture source = picture_of(tile_, setup_, hogel.s, hogel.t);
        Picture truth;
        if (source.size() > 1) truth = copy_of(tile_, setup_, hogel.s, hogel.t);
        // Nobody looks at this part of the tile any more: what is decoded may lie there.
        pictures_[k] = setup_.whole_blocks() ? as_in_tile(tile_, setup_, hogel.s, hogel.t) : setup_.blank();
        const auto moved = moved_blocks(hogel, coded_, setup_.grid, setup_.aspect);
        coded_[k] = encode::analyse(setup_, k, source, moved, beside(hogel),
                                    k < estimated_.size() ? estimated_[k] : std::vector<std::int16_t>{}, pictures_);
        BlockRecorder recorder;
        BlockModelNumbers numbers = numbers_;
        code_hogel(recorder, numbers, setup_.grid, hogel, moved, beside(hogel), coded_[k]);
        records_[k] = recorder.finish();
        coded_[k].levels = {};
        coded_[k].candidates = {};
        errors_[k] = squared_error(pictures_[k], setup_, source.size() > 1 ? truth : source, counted_);
        if (hogel.wave + 2 == setup_.order.waves().size()) pictures_[k] = Picture();  // nothing comes after it
    }

    // The hogels of a level, from begin to end.
    void write(std::size_t begin, std::size_t end) {
        // As many hogels as tell the models' states well enough.
        const std::size_t apart = 1 + (end - begin) / counted_hogels;
        std::vector<BitCount> counts(states_.count());
        for (std::size_t k = begin; k < end; k += apart) count_bits(records_[k], counts);
        const ModelStates states(counts, states_);
        const std::vector<coding::BitModel> models = states.models_in_order();
        std::vector<std::vector<std::uint8_t>> codes(end - begin);
        core::parallel_for(codes.size(), [&](std::size_t n) {
            codes[n] = write_bits(records_[begin + n], models);
            records_[begin + n] = {};
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

    LightFieldTile& tile_;
    const DirectionCross& counted_;
    TileSetup setup_;
    std::uint8_t references_;
    const std::vector<HogelOrder::Hogel>& order_;
    std::vector<Picture> pictures_;                                  // in the order
    std::array<std::vector<std::int16_t>, first_hogels> estimated_;  // disparities of the first ones
    std::vector<CodedHogel> coded_;
    const BlockModelNumbers numbers_;
    std::vector<BlockRecorder::Record> records_;  // what hogels are told, until it is written
    std::vector<double> errors_;
    ModelStates states_;
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
    part.range().half_u *= static_cast<double>(part.directions_u) / static_cast<double>(grid.directions_u);
    part.range().half_v *= static_cast<double>(part.directions_v) / static_cast<double>(grid.directions_v);
    Window window{part, LightFieldTile(part, tile.range, false)};
    copy_common(tile, window.tile, (grid.directions_v - part.directions_v) * quarters / 4,
                (grid.directions_u - part.directions_u) * quarters / 4);
    return window;
}

// Tries numbers of references on two windows of directions of a tile.
class ReferencesTrial {
  public:
    ReferencesTrial(const LightFieldTile& tile, const LightFieldGrid& grid, double step)
        : tile_(tile), grid_(grid), step_(step) {}

    // Squared error, and what bits are worth; only that it is more where it is more than `most`.
    double cost(std::uint8_t references, double most = std::numeric_limits<double>::infinity()) {
        std::array<std::atomic<double>, windows> costs{};
        std::atomic<bool> too_much = false;
        core::parallel_for(windows, [&](std::size_t n) {
            Window window = window_of(tile_, grid_, 1 + 2 * n);
            const DirectionCross all;
            TileEncoder encoder(window.tile, window.grid, all, static_cast<float>(step_), references);
            if (!estimates_[n]) estimates_[n] = encoder.estimate();
            const auto cost = [&](double error, std::size_t bytes) {
                return error + encode::bit_worth * step_ * step_ * 8 * static_cast<double>(bytes);
            };
            const auto coded = encoder.run(*estimates_[n], [&](double error, std::size_t bytes) {
                costs[n] = cost(error, bytes);
                if (costs[0] + costs[1] > most) too_much = true;
                return !too_much;
            });
            if (coded) costs[n] = cost(coded->squared_error, coded->bytes.size());
        });
        return too_much ? std::numeric_limits<double>::infinity() : costs[0] + costs[1];
    }

  private:
    static constexpr std::size_t windows = 2;
    const LightFieldTile& tile_;
    const LightFieldGrid& grid_;
    double step_;
    std::array<std::optional<Estimates>, windows> estimates_;
};

// The number of references that does best on windows. It does not change with every small change of the step, so that
// a search for a step sees a function without jumps.
std::uint8_t best_references(const LightFieldTile& tile, const LightFieldGrid& grid, double step) {
    ReferencesTrial trial(tile, grid, std::exp2(std::round(2 * std::log2(step)) / 2));
    // What costs so much more, or a bit more than that, is farther from the best than what lies between.
    constexpr double far = 1.1, rounding = 1e-9;
    const double many = trial.cost(max_references), one = trial.cost(1, far * many);
    std::uint8_t best = many < one ? max_references : 1;
    double least = std::min(many, one);
    if (std::max(many, one) > far * least) return best;
    for (std::uint8_t between = 2; between < max_references; ++between) {
        const double cost = trial.cost(between, least * (1 + rounding));
        if (!(cost < least)) continue;
        least = cost;
        best = between;
    }
    return best;
}

class HogelCoder final : public TileCoder {
  public:
    HogelCoder(const LightFieldGrid& grid, const DirectionCross& counted) : grid_(grid), counted_(counted) {}

    HogelRange preferred_tile(const LightFieldGrid& grid) const override {
        std::size_t side = preferred_side;
        while (side > 1 && side * side * decode::samples_in_blocks(grid) > preferred_samples) --side;
        // Tiles of nearly one size rather than whole ones and a narrow rest.
        const auto even = [&](std::size_t count) {
            const std::size_t tiles = (count + side - 1) / side;
            return (count + tiles - 1) / tiles;
        };
        return {0, 0, even(grid.hogels_s), even(grid.hogels_t)};
    }

    std::size_t max_at_once() const override { return 2; }

    std::size_t layers(const HogelRange& tile) const override {
        return static_cast<std::size_t>(HogelOrder::levels(tile.ns, tile.nt));
    }

    Encoded encode(LightFieldTile& tile, double step, std::size_t) const override {
        if (!decode::hogel_tile_fits(grid_, tile.range))
            throw Error(ErrorCode::usage, fmt::format("tiles of {} × {} hogels were asked for, expected at most {} × "
                                                      "{} and {} samples in whole blocks",
                                                      tile.range.ns, tile.range.nt, decode::max_hogel_tile_side,
                                                      decode::max_hogel_tile_side, decode::max_hogel_tile_samples));
        TileEncoder encoder(tile, grid_, counted_, static_cast<float>(step), best_references(tile, grid_, step));
        return *encoder.run(encoder.estimate());
    }

    void decode(std::span<const std::uint8_t> bytes, LightFieldTile& tile) const override {
        decode::HogelDecoder({bytes.begin(), bytes.end()}, grid_, tile.range, layers(tile.range)).read(tile);
    }

    std::unique_ptr<TileDecoder> open(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid,
                                      const HogelRange& range, std::size_t levels) const override {
        return std::make_unique<decode::HogelDecoder>(std::move(bytes), grid, range, levels);
    }

  private:
    LightFieldGrid grid_;
    DirectionCross counted_;
};

}  // namespace

std::unique_ptr<TileCoder> make_hogel_coder(const LightFieldGrid& grid, const DirectionCross& counted) {
    return std::make_unique<HogelCoder>(grid, counted);
}

}  // namespace hogel::codec
