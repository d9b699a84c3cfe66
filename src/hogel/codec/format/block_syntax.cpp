// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/block_syntax.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "hogel/codec/format/level_syntax.h"

namespace hogel::codec::format {
namespace {

constexpr int one_surface = 12;  // disparities that differ by at most this belong to one surface

// Context of modes and disparities: 0 without a warped block, 1 if its mode is mode_any, 2 otherwise.
std::size_t warped_context(const Block* warped) { return !warped ? 0 : warped->mode == mode_any ? 1 : 2; }

// @param around   number of blocks to the left and above with a mode other than mode_any
// @param first    whether this is the first hogel, which has only intra blocks
template <class Coder>
void code_mode(Coder& coder, typename Coder::Models& models, std::size_t warped, std::size_t around, bool first,
               Block& block) {
    if (!first) {
        auto& model = models.mode[warped][around];
        if (!coder.bit(model[0], block.mode != mode_any))
            block.mode = mode_any;
        else if (coder.bit(models.partitions.partitioned[warped][around], block.mode == mode_partitioned))
            block.mode = mode_partitioned;
        else if (!coder.bit(model[1], block.mode != mode_intra))
            block.mode = mode_intra;
        else {
            std::uint8_t mode = mode_any + 1;
            while (mode + 1 < inter_modes && coder.bit(model[mode], block.mode != mode)) ++mode;
            block.mode = mode;
        }
    }
    if (block.mode != mode_intra) return;
    std::uint8_t predictor = 0;
    while (predictor + 1 < intra_predictors && coder.bit(models.intra[predictor], block.intra_predictor != predictor))
        ++predictor;
    block.intra_predictor = predictor;
}

// @param around   number of blocks to the left and above that do not have their first candidate
// @param unit     unit of differences from the first candidate
template <class Coder>
void code_disparity(Coder& coder, typename Coder::Models::ForDisparity& models, std::size_t warped, std::size_t around,
                    int unit, const Candidates& candidates, std::int16_t& disparity) {
    const auto* end = candidates.disparity.begin() + candidates.count;
    const auto* found = std::find(candidates.disparity.begin(), end, disparity);
    const int first = candidates.disparity[0];
    const std::size_t spread = candidates.spread();
    auto& model = models.disparity[warped][spread][around];
    if (!coder.bit(model[0], found != candidates.disparity.begin())) {
        disparity = static_cast<std::int16_t>(first);
    } else if (!coder.bit(model[1], found == end)) {
        std::size_t k = 1;
        const auto index = static_cast<std::size_t>(found - candidates.disparity.begin());
        while (k + 1 < candidates.count && coder.bit(models.candidate[spread][std::min<std::size_t>(k, 3)], index != k))
            ++k;
        disparity = candidates.disparity[std::min(k, candidates.count - 1)];
    } else {
        const int difference = (disparity - first) / unit;
        const bool negative = coder.bit(models.sign, difference < 0);
        const std::uint32_t size =
            1 + std::min(code_number(coder, models.difference, static_cast<std::uint32_t>(std::abs(difference) - 1)),
                         std::uint32_t{4 * max_disparity});
        const int value = first + (negative ? -unit : unit) * static_cast<int>(size);
        disparity = static_cast<std::int16_t>(std::clamp(value, -max_disparity, max_disparity));
    }
}

// Codes the syntax elements of a partitioned block in addition to its main disparity.
// @param warped   the warped block, or null
template <class Coder>
void code_partitions(Coder& coder, typename Coder::Models::ForPartitions& models, const Block* warped, int unit,
                     const Candidates& candidates, Block& block) {
    for (std::size_t partition = 0; partition < 2; ++partition) {
        std::uint8_t side = 0;
        while (side + 1u < ReferenceWeights::sides &&
               coder.bit(models.side[partition][side], block.side[partition] != side))
            ++side;
        block.side[partition] = side;
    }
    std::size_t angle = block.edge / edge_offsets, offset = block.edge % edge_offsets;
    if (warped && warped->mode == mode_partitioned) {  // neighbouring hogels see nearly the same edge
        const std::size_t warped_angle = warped->edge / edge_offsets;
        angle = warped_angle + code_path(coder, models.angle_by, 5, (angle + edge_angles - warped_angle) % edge_angles);
        offset = code_path(coder, models.offset_by[warped->edge % edge_offsets], 2, offset);
    } else {
        angle = code_path(coder, models.angle, 5, angle);
        offset = code_path(coder, models.offset, 2, offset);
    }
    block.edge = static_cast<std::uint8_t>(edge_number(angle % edge_angles, offset));
    code_disparity(coder, models.second, warped_context(warped), 0, unit, candidates, block.second_disparity);
}

// Blocks that provide contexts for the syntax elements of a block; each may be null.
struct Neighbours {
    const Block *left, *above, *warped;

    // Returns the number of blocks to the left and above for which a predicate holds.
    template <class Predicate>
    std::size_t count(Predicate&& holds) const {
        return (left && holds(*left) ? 1u : 0u) + (above && holds(*above) ? 1u : 0u);
    }
};

// Codes which channels of a block have levels, and the levels, stored from coded.levels[used] on.
template <class Coder>
void code_residual(Coder& coder, typename Coder::Models& models, std::size_t channels, const Neighbours& neighbours,
                   Block& block, CodedHogel& coded, std::size_t& used) {
    const std::size_t kind = block.mode == mode_intra ? 2 : block.mode == mode_any ? 0 : 1;
    std::uint8_t flags = 0;
    for (std::size_t c = 0; c < channels; ++c) {
        const auto has_levels = [c](const Block& other) { return (other.coded >> c & 1) != 0; };
        const std::size_t chrominance = c > 0 ? 1 : 0;
        const std::size_t around = neighbours.count(has_levels);
        const std::size_t warped = !neighbours.warped ? 0 : has_levels(*neighbours.warped) ? 2 : 1;
        auto& of_kind = block.mode == mode_partitioned ? models.partitions.coded[warped][chrominance]
                                                       : models.coded[warped][chrominance][kind];
        if (!coder.bit(of_kind[block.not_first ? 1 : 0][around], has_levels(block))) continue;
        flags = static_cast<std::uint8_t>(flags | 1 << c);
        if (used == coded.levels.size()) coded.levels.emplace_back();
        Levels& levels = coded.levels[used++];
        auto& of_basis = models.basis[chrominance][block.mode == mode_partitioned ? 3 : kind];
        block.basis[c] = code_basis(coder, of_basis, block.basis[c]);
        code_levels(coder, models.levels[chrominance][block.mode == mode_intra ? 1 : 0], bases[block.basis[c]], levels);
    }
    block.coded = flags;
}

}  // namespace

std::size_t Candidates::spread() const {
    int max_difference = 0;
    for (std::size_t k = 1; k < count; ++k)
        max_difference = std::max(max_difference, std::abs(disparity[k] - disparity[0]));
    return max_difference == 0 ? 0 : max_difference <= 2 ? 1 : max_difference <= one_surface ? 2 : 3;
}

int disparity_unit(const HogelOrder::Hogel& hogel) {
    if (hogel.layer == 0) return 1;
    int nearest = shift_unit;
    for (const HogelOrder::Reference& reference : hogel.references)
        nearest = std::min(nearest, std::abs(reference.ds) + std::abs(reference.dt));
    return std::max(1, 4 / nearest);
}

Candidates predictor_candidates(std::size_t block, const BlockGrid& grid, const std::vector<Block>& blocks,
                                const Block* warped, const std::vector<Block>* context_blocks) {
    Candidates candidates;
    const bool left = block % grid.columns > 0, above = block >= grid.columns;
    if (warped) candidates.add(warped->disparity);
    if (left) candidates.add(blocks[block - 1].disparity);
    if (above) candidates.add(blocks[block - grid.columns].disparity);
    if (left && above)  // the continuation of a tilted plane
        candidates.add(blocks[block - 1].disparity + blocks[block - grid.columns].disparity -
                       blocks[block - grid.columns - 1].disparity);
    if (context_blocks && candidates.count < 4) candidates.add((*context_blocks)[block].disparity);
    if (left && blocks[block - 1].mode == mode_partitioned) candidates.add(blocks[block - 1].second_disparity);
    if (above && blocks[block - grid.columns].mode == mode_partitioned)
        candidates.add(blocks[block - grid.columns].second_disparity);
    if (warped && warped->mode == mode_partitioned) candidates.add(warped->second_disparity);
    if (candidates.count == 0) candidates.add(0);
    return candidates;
}

std::vector<const Block*> warped_blocks(const HogelOrder::Hogel& hogel, const std::vector<CodedHogel>& coded,
                                        const BlockGrid& grid, float aspect) {
    constexpr std::int64_t side = static_cast<std::int64_t>(block_side) * shift_unit, half = side / 2;
    std::vector<const Block*> warped(grid.count(), nullptr);
    std::vector<std::int64_t> distance(grid.count(), std::numeric_limits<std::int64_t>::max());
    for (const HogelOrder::Reference& reference : hogel.context_references) {
        const std::int64_t hogel_distance = reference.ds * reference.ds + reference.dt * reference.dt;
        const std::vector<Block>& blocks = coded[reference.hogel].blocks;
        for (std::size_t block = 0; block < blocks.size(); ++block) {
            const std::int16_t disparity = blocks[block].disparity;
            const Shift shift = shift_of(disparity, reference, aspect);
            const std::int64_t u = static_cast<std::int64_t>(block % grid.columns) * side + half - shift.u;
            const std::int64_t v = static_cast<std::int64_t>(block / grid.columns) * side + half - shift.v;
            if (u < 0 || v < 0) continue;
            const auto column = static_cast<std::size_t>(u / side), row = static_cast<std::size_t>(v / side);
            if (column >= grid.columns || row >= grid.rows) continue;
            const std::int64_t du = u % side - half, dv = v % side - half;
            const std::int64_t squared_distance = du * du + dv * dv + hogel_distance * shift_unit * shift_unit / 2;
            // If several blocks are warped to the same position, the nearer surface hides the farther one; on one
            // surface the block nearest to the middle is used.
            const Block*& best = warped[row * grid.columns + column];
            std::int64_t& best_distance = distance[row * grid.columns + column];
            if (!best || disparity > best->disparity + one_surface ||
                (disparity > best->disparity - one_surface && squared_distance < best_distance)) {
                best = &blocks[block];
                best_distance = squared_distance;
            }
        }
    }
    return warped;
}

template <class Coder>
void code_hogel(Coder& coder, typename Coder::Models& models, const BlockGrid& grid, const HogelOrder::Hogel& hogel,
                const std::vector<const Block*>& warped, const std::vector<Block>* context_blocks, CodedHogel& coded) {
    const bool first = hogel.references.empty();
    const int unit = disparity_unit(hogel);
    std::size_t used = 0;  // number of levels so far
    coded.blocks.resize(grid.count());
    for (std::size_t k = 0; k < grid.count(); ++k) {
        Block& block = coded.blocks[k];
        const Neighbours neighbours{k % grid.columns > 0 ? &coded.blocks[k - 1] : nullptr,
                                    k >= grid.columns ? &coded.blocks[k - grid.columns] : nullptr, warped[k]};
        const std::size_t context = warped_context(neighbours.warped);
        const std::size_t other_modes = neighbours.count([](const Block& other) { return other.mode != mode_any; });
        code_mode(coder, models, context, other_modes, first, block);
        const Candidates candidates = coded.candidates.empty()
                                          ? predictor_candidates(k, grid, coded.blocks, warped[k], context_blocks)
                                          : coded.candidates[k];
        if (block.mode == mode_intra && !first) {
            block.disparity = candidates.disparity[0];
        } else {
            const std::size_t around = neighbours.count([](const Block& other) { return other.not_first; });
            code_disparity(coder, models.main, context, around, unit, candidates, block.disparity);
        }
        if (block.mode == mode_partitioned)
            code_partitions(coder, models.partitions, neighbours.warped, unit, candidates, block);
        block.not_first = block.disparity != candidates.disparity[0];
        code_residual(coder, models, grid.channels, neighbours, block, coded, used);
    }
}

void predict_syntax(const BlockGrid& grid, const std::vector<const Block*>& warped,
                    const std::vector<Block>* context_blocks, CodedHogel& coded) {
    coded.blocks.resize(grid.count());
    for (std::size_t k = 0; k < grid.count(); ++k) {
        coded.blocks[k].mode = mode_any;
        coded.blocks[k].disparity = predictor_candidates(k, grid, coded.blocks, warped[k], context_blocks).disparity[0];
    }
}

void count_bits(const BlockRecorder::Record& record, std::span<BitCount> counts) {
    for (const std::uint16_t bit : record)
        if (bit < BlockRecorder::even_bit) ++counts[bit / 2][bit % 2];
}

std::vector<std::uint8_t> write_bits(const BlockRecorder::Record& record, std::vector<coding::BitModel> models) {
    coding::ArithmeticEncoder encoder;
    for (const std::uint16_t bit : record)
        if (bit < BlockRecorder::even_bit)
            encoder.bit(models[bit / 2], bit % 2 != 0);
        else
            encoder.raw(bit % 2, 1);
    return encoder.finish();
}

template void code_hogel(BlockRecorder&, BlockModelNumbers&, const BlockGrid&, const HogelOrder::Hogel&,
                         const std::vector<const Block*>&, const std::vector<Block>*, CodedHogel&);
template void code_hogel(BlockReader&, BlockModels&, const BlockGrid&, const HogelOrder::Hogel&,
                         const std::vector<const Block*>&, const std::vector<Block>*, CodedHogel&);

}  // namespace hogel::codec::format
