// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/analysis.h"

#include <algorithm>
#include <utility>

#include "hogel/codec/encode/block_search.h"
#include "hogel/codec/encode/blocks.h"
#include "hogel/codec/encode/partition_search.h"
#include "hogel/codec/encode/rate_weight.h"
#include "hogel/codec/encode/residual_choice.h"

namespace hogel::codec::encode {

using namespace format;

namespace {

// Estimated bits (docs/decisions/0030-codec-prediction.md) of intra prediction, in general and in the first hogel,
// and of the choice of intra predictor.
constexpr float intra_block = 12, first_intra_block = 1;
constexpr float bits_of_predictor(int predictor) { return predictor == 0 ? 0 : predictor < first_directional ? 2 : 5; }
// Estimated bits of partitions, and the minimum saving in bits for which they are searched.
constexpr float of_partitions = 14, min_gain_of_partitions = 16;
constexpr float bits_of_partitions(const Block& block) { return block.mode == mode_partitioned ? of_partitions : 0; }

// Decides on the blocks of one hogel, one after the other.
class Analysis {
  public:
    Analysis(const TileSetup& setup, std::size_t hogel, const Picture& source, const KnownDisparities& known,
             std::vector<Picture>& pictures)
        : setup_(setup),
          hogel_(setup.order.hogels()[hogel]),
          source_(source),
          known_(known),
          pictures_(pictures),
          picture_(pictures[hogel]),
          step_(setup.step[static_cast<std::size_t>(hogel_.layer)]),
          rate_weight_(lambda * step_ * step_),
          first_(hogel_.references.empty()),
          weights_(hogel_, setup.noise, setup.aspect),
          warped_(hogel_, pictures),
          partitions_(warped_, weights_),
          search_(setup, hogel_, source[0], warped_, weights_, known) {}

    CodedHogel run() {
        CodedHogel coded;
        coded.blocks.resize(setup_.grid.count());
        coded.candidates.reserve(setup_.grid.count());
        for (std::size_t k = 0; k < setup_.grid.count(); ++k) {
            x_ = k % setup_.grid.columns * block_side;
            y_ = k / setup_.grid.columns * block_side;
            const Candidates& candidates = coded.candidates.emplace_back(
                predictor_candidates(k, setup_.grid, coded.blocks, known_.warped[k], known_.context_blocks));
            const BlockSamples target = block_of(source_[0], x_, y_);
            Block& block = coded.blocks[k];
            choose_prediction(k, target, candidates, block);
            if (!first_) improve(target, candidates, block);
            code_channels(block, coded);
        }
        return coded;
    }

  private:
    void quantise_channel(const BlockSamples& truth, float error, bool intra, CodedChannel& channel) {
        quantise(truth, error, step_, intra, setup_.reconstruction_offset(intra), channel);
    }

    // Chooses the best inter prediction of the first channel, or an intra prediction if that costs less, and quantises
    // it.
    void choose_prediction(std::size_t k, const BlockSamples& target, const Candidates& candidates, Block& block) {
        const BlockSearch::Found& best = search_.run(k, target, candidates);
        block.mode = best.mode;
        block.disparity = best.disparity;
        const float bits = first_ ? first_intra_block : intra_block;
        if (!search_.good() && best.cost > rate_weight_ * bits) {
            try_intra(target, bits, best.cost, block);
            if (block.mode == mode_intra)
                block.disparity = first_ && !known_.estimated.empty() ? known_.estimated[k] : candidates.disparity[0];
        }
        if (block.mode == mode_intra) {
            predict_and_quantise(block, 0, target);
        } else {
            channel_.prediction = *best.prediction;
            quantise_channel(target, best.error, false, channel_);
        }
    }

    void try_intra(const BlockSamples& target, float bits, float min_cost, Block& block) {
        for (int predictor = 0; predictor < intra_predictors; ++predictor) {
            predict_intra(picture_[0], x_, y_, predictor, alternative_.prediction);
            float cost = squared_difference(alternative_.prediction, target);
            // All hogels are predicted from the first hogel, so each predictor is tried including the quantisation of
            // its residual.
            if (first_) {
                quantise_channel(target, cost, true, alternative_);
                cost = alternative_.cost;
            }
            cost += rate_weight_ * (bits + bits_of_predictor(predictor));
            if (cost < min_cost) {
                min_cost = cost;
                block.mode = mode_intra;
                block.intra_predictor = static_cast<std::uint8_t>(predictor);
            }
        }
    }

    // Tries partitions and neighbouring disparities if the cost of the block is still high.
    void improve(const BlockSamples& target, const Candidates& candidates, Block& block) {
        const BlockSearch::Found& best = search_.found();
        const auto offer_partitions = [&] {
            partitions_.add(best.disparity);
            if (const auto partitioned = partitions_.best(alternative_.prediction))
                offer(*partitioned, target, squared_difference(alternative_.prediction, target), block);
        };
        const float min_cost = rate_weight_ * (of_partitions + min_gain_of_partitions);
        if (channel_.cost > min_cost) {
            partitions_.begin(target, candidates, rate_weight_);
            offer_partitions();
        }
        if (channel_.cost > search_.wide_search_cost() && block.mode != mode_intra && search_.look_around()) {
            Block unpartitioned;
            unpartitioned.mode = best.mode;
            unpartitioned.disparity = best.disparity;
            alternative_.prediction = *best.prediction;
            offer(unpartitioned, target, best.error, block);
            if (channel_.cost > min_cost) offer_partitions();
        }
    }

    // Replaces the block by `other`, with its prediction in alternative_, if it costs less.
    void offer(const Block& other, const BlockSamples& target, float error, Block& block) {
        quantise_channel(target, error, false, alternative_);
        if (!(alternative_.cost + rate_weight_ * bits_of_partitions(other) <
              channel_.cost + rate_weight_ * bits_of_partitions(block)))
            return;
        block = other;
        std::swap(channel_, alternative_);
    }

    // Predicts a channel from the block's syntax elements, and quantises its residual.
    void predict_and_quantise(const Block& block, std::size_t c, const BlockSamples& truth) {
        if (block.mode == mode_intra)
            predict_intra(picture_[c], x_, y_, block.intra_predictor, channel_.prediction);
        else
            predict_partitions(pictures_, hogel_, block, choices_of(block, weights_), c, x_, y_, channel_.prediction);
        quantise_channel(truth, squared_difference(channel_.prediction, truth), block.mode == mode_intra, channel_);
    }

    // Codes and reconstructs all channels; the first one has already been decided.
    void code_channels(Block& block, CodedHogel& coded) {
        for (std::size_t c = 0; c < setup_.grid.channels; ++c) {
            if (c > 0) predict_and_quantise(block, c, block_of(source_[c], x_, y_));
            if (channel_.any_levels) {
                block.coded = static_cast<std::uint8_t>(block.coded | 1 << c);
                block.basis[c] = channel_.basis;
                coded.levels.push_back(channel_.levels);
            }
            place_block(picture_[c], x_, y_, channel_.prediction, channel_.any_levels ? &channel_.levels : nullptr,
                        bases[channel_.basis], step_, setup_.reconstruction_offset(block.mode == mode_intra));
        }
    }

    const TileSetup& setup_;
    const HogelOrder::Hogel& hogel_;
    const Picture& source_;
    const KnownDisparities& known_;
    std::vector<Picture>& pictures_;
    Picture& picture_;
    float step_, rate_weight_;
    bool first_;
    ReferenceWeights weights_;
    WarpedBlocks warped_;
    PartitionSearch partitions_;
    BlockSearch search_;
    // The current block:
    std::size_t x_ = 0, y_ = 0;
    CodedChannel channel_, alternative_;  // the first channel of the block, and an alternative
};

}  // namespace

CodedHogel analyse(const TileSetup& setup, std::size_t hogel, const Picture& source, const KnownDisparities& known,
                   std::vector<Picture>& pictures) {
    return Analysis(setup, hogel, source, known, pictures).run();
}

}  // namespace hogel::codec::encode
