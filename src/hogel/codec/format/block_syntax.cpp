// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/block_syntax.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "hogel/codec/format/level_syntax.h"

namespace hogel::codec::format {
namespace {

constexpr int one_surface = 12;  // disparities no farther apart than this belong to one surface

// What a block that is moved here tells of modes and disparities, as a number: nothing is moved here; as usual; not.
std::size_t by_mode(const Block* moved) { return !moved ? 0 : moved->mode == 1 ? 1 : 2; }

template <class Coder>
void code_mode(Coder& coder, typename Coder::Models& models, std::size_t from, std::size_t context, bool first,
               Block& block) {
    if (!first) {
        // The best of all sides, within, and then one side after the other.
        auto& model = models.mode[from][context];
        if (!coder.bit(model[0], block.mode != 1))
            block.mode = 1;
        else if (coder.bit(models.parts.parted[from][context], block.mode == parted))
            block.mode = parted;
        else if (!coder.bit(model[1], block.mode != 0))
            block.mode = 0;
        else {
            std::uint8_t mode = 2;
            while (mode + 1 < across_modes && coder.bit(model[mode], block.mode != mode)) ++mode;
            block.mode = mode;
        }
    }
    if (block.mode != 0) return;
    std::uint8_t within = 0;
    while (within + 1 < within_modes && coder.bit(models.within[within], block.within != within)) ++within;
    block.within = within;
}

template <class Coder>
void code_disparity(Coder& coder, typename Coder::Models::ForDisparity& models, std::size_t from, std::size_t around,
                    int unit, const Candidates& candidates, std::int16_t& disparity) {
    const auto* end = candidates.disparity.begin() + candidates.count;
    const auto* found = std::find(candidates.disparity.begin(), end, disparity);
    const int likeliest = candidates.disparity[0];
    const std::size_t spread = candidates.spread();
    auto& model = models.disparity[from][spread][around];
    if (!coder.bit(model[0], found != candidates.disparity.begin())) {
        disparity = static_cast<std::int16_t>(likeliest);
    } else if (!coder.bit(model[1], found == end)) {
        std::size_t k = 1;
        const auto index = static_cast<std::size_t>(found - candidates.disparity.begin());
        while (k + 1 < candidates.count && coder.bit(models.candidate[spread][std::min<std::size_t>(k, 3)], index != k))
            ++k;
        disparity = candidates.disparity[std::min(k, candidates.count - 1)];
    } else {
        const int difference = (disparity - likeliest) / unit;
        const bool negative = coder.bit(models.sign, difference < 0);
        const std::uint32_t size =
            1 + std::min(code_number(coder, models.difference, static_cast<std::uint32_t>(std::abs(difference) - 1)),
                         std::uint32_t{4 * max_disparity});
        const int value = likeliest + (negative ? -unit : unit) * static_cast<int>(size);
        disparity = static_cast<std::int16_t>(std::clamp(value, -max_disparity, max_disparity));
    }
}

// What a parted block has beside the disparity of its main part.
// @param moved   the block that is moved here; may be null
template <class Coder>
void code_parts(Coder& coder, typename Coder::Models::ForParts& models, const Block* moved, int unit,
                const Candidates& candidates, Block& block) {
    for (std::size_t part = 0; part < 2; ++part) {
        std::uint8_t side = 0;
        while (side + 1u < ReferenceWeights::sides && coder.bit(models.side[part][side], block.side[part] != side))
            ++side;
        block.side[part] = side;
    }
    std::size_t angle = block.line / line_places, place = block.line % line_places;
    if (moved && moved->mode == parted) {  // an edge is seen from near by as it is here
        const std::size_t before = moved->line / line_places;
        angle = before + code_path(coder, models.turn, 5, (angle + line_angles - before) % line_angles);
        place = code_path(coder, models.place_by_moved[moved->line % line_places], 2, place);
    } else {
        angle = code_path(coder, models.angle, 5, angle);
        place = code_path(coder, models.place, 2, place);
    }
    block.line = static_cast<std::uint8_t>(line_number(angle % line_angles, place));
    code_disparity(coder, models.beyond, by_mode(moved), 0, unit, candidates, block.disparity_beyond);
}

}  // namespace

std::size_t Candidates::spread() const {
    int most = 0;
    for (std::size_t k = 1; k < count; ++k) most = std::max(most, std::abs(disparity[k] - disparity[0]));
    return most == 0 ? 0 : most <= 2 ? 1 : most <= one_surface ? 2 : 3;
}

int disparity_unit(const HogelOrder::Hogel& hogel) {
    if (hogel.level == 0) return 1;
    int nearest = shift_unit;
    for (const HogelOrder::Reference& reference : hogel.references)
        nearest = std::min(nearest, std::abs(reference.ds) + std::abs(reference.dt));
    return std::max(1, 4 / nearest);
}

Candidates candidates_for(std::size_t block, const BlockGrid& grid, const std::vector<Block>& blocks,
                          const Block* moved, const std::vector<Block>* beside) {
    Candidates candidates;
    const bool left = block % grid.columns > 0, above = block >= grid.columns;
    if (moved) candidates.add(moved->disparity);
    if (left) candidates.add(blocks[block - 1].disparity);
    if (above) candidates.add(blocks[block - grid.columns].disparity);
    if (left && above)  // as on a plane
        candidates.add(blocks[block - 1].disparity + blocks[block - grid.columns].disparity -
                       blocks[block - grid.columns - 1].disparity);
    if (beside && candidates.count < 4) candidates.add((*beside)[block].disparity);
    if (left && blocks[block - 1].mode == parted) candidates.add(blocks[block - 1].disparity_beyond);
    if (above && blocks[block - grid.columns].mode == parted)
        candidates.add(blocks[block - grid.columns].disparity_beyond);
    if (moved && moved->mode == parted) candidates.add(moved->disparity_beyond);
    if (candidates.count == 0) candidates.add(0);
    return candidates;
}

std::vector<const Block*> moved_blocks(const HogelOrder::Hogel& hogel, const std::vector<CodedHogel>& coded,
                                       const BlockGrid& grid, float aspect) {
    constexpr std::int64_t side = static_cast<std::int64_t>(block_side) * shift_unit, half = side / 2;
    std::vector<const Block*> moved(grid.count(), nullptr);
    std::vector<std::int64_t> distance(grid.count(), std::numeric_limits<std::int64_t>::max());
    for (const HogelOrder::Reference& reference : hogel.tellers) {
        const std::int64_t apart = reference.ds * reference.ds + reference.dt * reference.dt;
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
            const std::int64_t here = du * du + dv * dv + apart * shift_unit * shift_unit / 2;
            // The nearer surface hides the farther one; of one surface, what comes nearest to the middle.
            const Block*& kept = moved[row * grid.columns + column];
            std::int64_t& kept_distance = distance[row * grid.columns + column];
            if (!kept || disparity > kept->disparity + one_surface ||
                (disparity > kept->disparity - one_surface && here < kept_distance)) {
                kept = &blocks[block];
                kept_distance = here;
            }
        }
    }
    return moved;
}

template <class Coder>
void code_hogel(Coder& coder, typename Coder::Models& models, const BlockGrid& grid, const HogelOrder::Hogel& hogel,
                const std::vector<const Block*>& moved, const std::vector<Block>* beside, CodedHogel& coded) {
    const bool first = hogel.references.empty();
    const int unit = disparity_unit(hogel);
    std::size_t used = 0;  // levels
    coded.blocks.resize(grid.count());
    for (std::size_t k = 0; k < grid.count(); ++k) {
        Block& block = coded.blocks[k];
        const Block* left = k % grid.columns > 0 ? &coded.blocks[k - 1] : nullptr;
        const Block* above = k >= grid.columns ? &coded.blocks[k - grid.columns] : nullptr;
        const std::size_t context = (left && left->mode != 1 ? 1u : 0u) + (above && above->mode != 1 ? 1u : 0u);
        const Block* from = moved[k];
        code_mode(coder, models, by_mode(from), context, first, block);
        const Candidates candidates =
            coded.candidates.empty() ? candidates_for(k, grid, coded.blocks, moved[k], beside) : coded.candidates[k];
        if (block.mode == 0 && !first) {
            block.disparity = candidates.disparity[0];
        } else {
            const std::size_t around = (left && left->surprising ? 1u : 0u) + (above && above->surprising ? 1u : 0u);
            code_disparity(coder, models.main, by_mode(from), around, unit, candidates, block.disparity);
        }
        if (block.mode == parted) code_parts(coder, models.parts, from, unit, candidates, block);
        block.surprising = block.disparity != candidates.disparity[0];
        const std::size_t kind = block.mode == 0 ? 2 : block.mode == 1 ? 0 : 1;
        std::uint8_t flags = 0;
        for (std::size_t c = 0; c < grid.channels; ++c) {
            const std::size_t chrominance = c > 0 ? 1 : 0;
            const std::size_t around =
                (left && left->coded >> c & 1 ? 1u : 0u) + (above && above->coded >> c & 1 ? 1u : 0u);
            const std::size_t before = !from ? 0 : from->coded >> c & 1 ? 2 : 1;
            auto& of_kind = block.mode == parted ? models.parts.coded[before][chrominance]
                                                 : models.coded[before][chrominance][kind];
            if (!coder.bit(of_kind[block.surprising ? 1 : 0][around], block.coded >> c & 1)) continue;
            flags = static_cast<std::uint8_t>(flags | 1 << c);
            if (used == coded.levels.size()) coded.levels.emplace_back();
            Levels& levels = coded.levels[used++];
            const std::size_t within = block.mode == 0 ? 1 : 0;
            auto& of_basis = models.basis[chrominance][block.mode == parted ? 3 : kind];
            block.basis[c] = code_basis(coder, of_basis, block.basis[c]);
            code_levels(coder, models.levels[chrominance][within], bases[block.basis[c]], levels);
        }
        block.coded = flags;
    }
}

void guess_hogel(const BlockGrid& grid, const std::vector<const Block*>& moved, const std::vector<Block>* beside,
                 CodedHogel& coded) {
    coded.blocks.resize(grid.count());
    for (std::size_t k = 0; k < grid.count(); ++k) {
        coded.blocks[k].mode = 1;
        coded.blocks[k].disparity = candidates_for(k, grid, coded.blocks, moved[k], beside).disparity[0];
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
