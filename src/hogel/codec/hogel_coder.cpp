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
#include "hogel/codec/encode/disparity_estimate.h"
#include "hogel/codec/encode/rate_weight.h"
#include "hogel/codec/format/bytes.h"
#include "hogel/codec/format/model_states.h"
#include "hogel/codec/format/pictures.h"
#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel::codec {

using namespace format;

namespace {

// Larger tiles gain little (docs/decisions/0030-codec-prediction.md).
constexpr std::size_t preferred_side = 32;
constexpr std::size_t preferred_samples = std::size_t{1} << 27;
// Growth of the step from one layer to the next. Content shared by all hogels is best coded once and finely, so the
// growth depends on the fraction of the first hogel that its neighbours share. In a single row, a layer has twice as
// many hogels as all earlier layers, not four times, so fewer hogels benefit.
constexpr float expected_growth = 1.35f;
float growth_for(float shared, bool single_row) {
    const float growth = 1.27f + 0.63f * shared * shared * shared * shared;
    return single_row ? std::cbrt(growth) : growth;
}
// Maximum number of references on each side. The nearest ones are best if their blocks can be shifted by fractions of a
// direction; otherwise more references are better (docs/decisions/0030-codec-prediction.md).
constexpr std::uint8_t max_references = 3;
constexpr std::size_t counted_hogels =
    48;  // number of hogels of a layer that determine the initial states of its models
constexpr std::size_t tried_directions = 32;  // along a side of a window

// Returns Σ (picture − truth)² over the counted directions; the truth as red, green and blue.
double squared_error(const Picture& picture, const TileSetup& setup, const Picture& truth,
                     const DirectionCross& counted) {
    double sum = 0;
    for_each_row(picture, setup, [&](std::size_t c, std::size_t v, std::span<const float> row) {
        const float* target = &truth[c].samples[v * truth[c].width];
        const auto [begin, end] = counted.columns(v, row.size());
        sum += squared_difference_of_rows(target + begin, row.data() + begin, end - begin);
    });
    return sum;
}

// Number of hogels in the first two layers. Their disparities are estimated, because they have no references or only
// distant ones.
constexpr std::size_t first_hogels = 9;
using Estimates = std::array<encode::Estimate, first_hogels>;

// Codes a tile layer by layer: decides on all hogels of a layer, then writes their codes independently of each other.
class TileEncoder {
  public:
    // @param tile   radiance is overwritten
    TileEncoder(LightFieldTile& tile, const LightFieldGrid& grid, const DirectionCross& counted, float step,
                std::uint8_t references)
        : tile_(tile),
          counted_(counted),
          setup_(HogelOrder(tile.range.ns, tile.range.nt, references, context_references_per_side), grid.directions_u,
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
        work::parallel_for(std::min(estimates.size(), order_.size()), [&](std::size_t k) {
            if (order_[k].layer < 2) estimates[k] = encode::estimate_disparities(setup_, tile_, order_[k]);
        });
        return estimates;
    }

    // Callback after each wavefront; if it returns false, run() stops and returns no code.
    using GoOn = std::function<bool(double error, std::size_t bytes)>;
    std::optional<TileCoder::Encoded> run(const Estimates& estimates, const GoOn& go_on = {}) {
        for (std::size_t k = 0; k < estimates.size(); ++k) estimated_[k] = estimates[k].disparities;
        const float growth = growth_for(estimates[0].shared, tile_.range.ns == 1 || tile_.range.nt == 1);
        setup_.set_steps(setup_.step.back(), growth);
        bytes_.put(setup_.step.back());
        bytes_.put(growth);
        bytes_.put(references_);
        const auto& wavefronts = setup_.order.wavefronts();
        const auto& of_layers = setup_.order.wavefronts_of_layers();
        TileCoder::Encoded result;
        for (std::size_t layer = 0; layer + 1 < of_layers.size(); ++layer) {
            for (std::size_t wavefront = of_layers[layer]; wavefront < of_layers[layer + 1]; ++wavefront) {
                work::parallel_for(wavefronts[wavefront + 1] - wavefronts[wavefront],
                                   [&](std::size_t n) { decide(wavefronts[wavefront] + n); });
                if (go_on && !go_on(error(), bytes_.bytes.size())) return std::nullopt;
            }
            write(wavefronts[of_layers[layer]], wavefronts[of_layers[layer + 1]]);
            result.layers.push_back(bytes_.bytes.size());
        }
        result.bytes = std::move(bytes_.bytes);
        result.squared_error = error();
        return result;
    }

  private:
    double error() const { return std::accumulate(errors_.begin(), errors_.end(), 0.0); }

    const std::vector<Block>* context_blocks(const HogelOrder::Hogel& hogel) const {
        return hogel.context_references.empty() ? nullptr : &coded_[hogel.context_references.front().hogel].blocks;
    }

    void decide(std::size_t k) {
        const HogelOrder::Hogel& hogel = order_[k];
        const Picture source = picture_of(tile_, setup_, hogel.s, hogel.t);
        Picture truth;
        if (source.size() > 1) truth = copy_of(tile_, setup_, hogel.s, hogel.t);
        // This part of the tile is not read again, so the hogel can be reconstructed in place.
        pictures_[k] = setup_.whole_blocks() ? as_in_tile(tile_, setup_, hogel.s, hogel.t) : setup_.blank();
        const auto warped = warped_blocks(hogel, coded_, setup_.grid, setup_.aspect);
        encode::KnownDisparities known{{}, warped, context_blocks(hogel)};
        if (k < estimated_.size()) known.estimated = estimated_[k];
        coded_[k] = encode::analyse(setup_, k, source, known, pictures_);
        BlockRecorder recorder;
        BlockModelNumbers numbers = numbers_;
        code_hogel(recorder, numbers, setup_.grid, hogel, warped, known.context_blocks, coded_[k]);
        records_[k] = recorder.finish();
        coded_[k].levels = {};
        coded_[k].candidates = {};
        errors_[k] = squared_error(pictures_[k], setup_, source.size() > 1 ? truth : source, counted_);
        if (hogel.wavefront + 2 == setup_.order.wavefronts().size())
            pictures_[k] = Picture();  // nothing refers to the last wavefront
    }

    // Writes the hogels of a layer, `begin` to `end`.
    void write(std::size_t begin, std::size_t end) {
        // A part of the hogels suffices to determine the states of the models.
        const std::size_t stride = 1 + (end - begin) / counted_hogels;
        std::vector<BitCount> counts(states_.count());
        for (std::size_t k = begin; k < end; k += stride) count_bits(records_[k], counts);
        const ModelStates states(counts, states_);
        const std::vector<coding::BitModel> models = states.models_in_order();
        std::vector<std::vector<std::uint8_t>> codes(end - begin);
        work::parallel_for(codes.size(), [&](std::size_t n) {
            codes[n] = write_bits(records_[begin + n], models);
            records_[begin + n] = {};
        });
        BlockWriter side;
        ModelStates(states).code(side, states_);
        CodeLengths lengths;
        for (const auto& code : codes) lengths.code(side, static_cast<std::uint32_t>(code.size()));
        const std::vector<std::uint8_t> side_information = side.finish();
        bytes_.put(static_cast<std::uint32_t>(side_information.size()));
        bytes_.put(std::span(side_information));
        for (const auto& code : codes) bytes_.put(std::span(code));
        states_ = states;
    }

    LightFieldTile& tile_;
    const DirectionCross& counted_;
    TileSetup setup_;
    std::uint8_t references_;
    const std::vector<HogelOrder::Hogel>& order_;
    std::vector<Picture> pictures_;                                  // one per hogel of the order
    std::array<std::vector<std::int16_t>, first_hogels> estimated_;  // disparities of the first hogels
    std::vector<CodedHogel> coded_;
    const BlockModelNumbers numbers_;
    std::vector<BlockRecorder::Record> records_;  // syntax elements of hogels that are not yet written
    std::vector<double> errors_;
    ModelStates states_;
    ByteWriter bytes_;
};

// A window of directions of a tile, one or three quarters of the way along both axes.
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

// Compares numbers of references on two windows of directions of a tile.
class ReferencesTrial {
  public:
    ReferencesTrial(const LightFieldTile& tile, const LightFieldGrid& grid, double step)
        : tile_(tile), grid_(grid), step_(step) {}

    // Returns the squared error plus λ times the bits; infinity if that is more than `max_cost`.
    double cost(std::uint8_t references, double max_cost = std::numeric_limits<double>::infinity()) {
        std::array<std::atomic<double>, windows> costs{};
        std::atomic<bool> too_much = false;
        work::parallel_for(windows, [&](std::size_t n) {
            Window window = window_of(tile_, grid_, 1 + 2 * n);
            const DirectionCross all_directions;
            TileEncoder encoder(window.tile, window.grid, all_directions, static_cast<float>(step_), references);
            if (!estimates_[n]) estimates_[n] = encoder.estimate();
            const auto cost = [&](double error, std::size_t bytes) {
                return error + encode::lambda * step_ * step_ * 8 * static_cast<double>(bytes);
            };
            const auto coded = encoder.run(*estimates_[n], [&](double error, std::size_t bytes) {
                costs[n] = cost(error, bytes);
                if (costs[0] + costs[1] > max_cost) too_much = true;
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

// Returns the best number of references for a rounded step, so that the search for a step sees a function with few
// jumps.
std::uint8_t best_references(const LightFieldTile& tile, const LightFieldGrid& grid, double step) {
    ReferencesTrial trial(tile, grid, std::exp2(std::round(2 * std::log2(step)) / 2));
    // If the costs of the smallest and largest number differ by this factor, numbers in between are not tried.
    constexpr double max_ratio = 1.1, rounding = 1e-9;
    const double max_cost_references = trial.cost(max_references),
                 cost_of_one = trial.cost(1, max_ratio * max_cost_references);
    std::uint8_t best = max_cost_references < cost_of_one ? max_references : 1;
    double min_cost = std::min(max_cost_references, cost_of_one);
    if (std::max(max_cost_references, cost_of_one) > max_ratio * min_cost) return best;
    for (std::uint8_t between = 2; between < max_references; ++between) {
        const double cost = trial.cost(between, min_cost * (1 + rounding));
        if (!(cost < min_cost)) continue;
        min_cost = cost;
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
        // Makes tiles of nearly equal sizes instead of full ones and a narrow remainder.
        const auto nearly_equal = [&](std::size_t count) {
            const std::size_t tiles = (count + side - 1) / side;
            return (count + tiles - 1) / tiles;
        };
        return {0, 0, nearly_equal(grid.hogels_s), nearly_equal(grid.hogels_t)};
    }

    std::size_t max_at_once() const override { return 2; }

    std::size_t layers(const HogelRange& tile) const override {
        return static_cast<std::size_t>(HogelOrder::layers(tile.ns, tile.nt));
    }

    Encoded encode(LightFieldTile& tile, double step, std::size_t) const override {
        if (!decode::hogel_tile_fits(grid_, tile.range))
            throw Error(ErrorCode::usage, "tile",
                        fmt::format("tiles of {} × {} hogels were asked for, expected at most {} × "
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
                                      const HogelRange& range, std::size_t layers) const override {
        return std::make_unique<decode::HogelDecoder>(std::move(bytes), grid, range, layers);
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
