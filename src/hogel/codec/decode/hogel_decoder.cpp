// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/decode/hogel_decoder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hogel/codec/format/bytes.h"
#include "hogel/codec/format/model_states.h"
#include "hogel/codec/format/pictures.h"
#include "hogel/work/parallel.h"

namespace hogel::codec::decode {

using namespace format;

namespace {

constexpr std::size_t header_bytes = 9;

TileSetup setup_from(std::span<const std::uint8_t> bytes, const LightFieldGrid& grid, const HogelRange& range) {
    ByteReader header(bytes, "tile");
    if (!hogel_tile_fits(grid, range)) header.damaged("it is too large");
    const float step = header.take_float(), growth = header.take_float();
    if (!(step > 0 && std::isfinite(step) && growth >= 1 && growth <= 4)) header.damaged("its steps are impossible");
    const auto references = header.take<std::uint8_t>();
    if (references == 0) header.damaged("its hogels have no references");
    return TileSetup(HogelOrder(range.ns, range.nt, references, context_references_per_side), grid.directions_u,
                     grid.directions_v, grid.channels, step, growth, static_cast<float>(grid.step_u() / grid.step_v()));
}

}  // namespace

HogelDecoder::HogelDecoder(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid, const HogelRange& range,
                           std::size_t layers)
    : bytes_(std::move(bytes)),
      range_(range),
      setup_(setup_from(bytes_, grid, range)),
      order_index_(range.hogels()),
      coded_(range.hogels()),
      syntax_read_(range.hogels()),
      wanted_(range.hogels()),
      blocks_(range.hogels() * setup_.grid.count()),
      pictures_(range.hogels()),
      complete_(range.hogels()) {
    const auto& order = setup_.order.hogels();
    for (std::size_t k = 0; k < order.size(); ++k) order_index_[order[k].t * range.ns + order[k].s] = k;
    take_layers(layers);
}

void HogelDecoder::take_layers(std::size_t layers) {
    ByteReader reader(bytes_, "tile");
    reader.take(header_bytes);
    const auto& wavefronts = setup_.order.wavefronts();
    const auto& of_layers = setup_.order.wavefronts_of_layers();
    ModelStates before;
    for (std::size_t layer = 0; layer < layers; ++layer) {
        BlockReader side(reader.take(reader.take<std::uint32_t>()));
        ModelStates states;
        states.code(side, before);
        models_.push_back(states.models());
        before = states;
        const std::size_t begin = wavefronts[of_layers[layer]], end = wavefronts[of_layers[layer + 1]];
        CodeLengths lengths;
        std::vector<std::uint32_t> sizes;
        for (std::size_t k = begin; k < end; ++k) sizes.push_back(lengths.code(side, 0));
        if (side.ended()) reader.damaged("it ends too early");
        if (!side.all_read()) reader.damaged("bytes are left over");
        for (const std::uint32_t size : sizes) codes_.push_back(reader.take(size));
    }
    if (reader.left() > 0) reader.damaged("bytes are left over");
}

std::vector<std::size_t> HogelDecoder::code_bytes() const {
    std::vector<std::size_t> bytes(range_.hogels());
    for (std::size_t hogel = 0; hogel < bytes.size(); ++hogel)
        if (order_index_[hogel] < codes_.size()) bytes[hogel] = codes_[order_index_[hogel]].size();
    return bytes;
}

void HogelDecoder::read(LightFieldTile& part) {
    std::vector<std::size_t> wanted;
    for (std::size_t t = part.range.t0; t < part.range.t0 + part.range.nt; ++t)
        for (std::size_t s = part.range.s0; s < part.range.s0 + part.range.ns; ++s)
            wanted.push_back(order_index_[(t - range_.t0) * range_.ns + s - range_.s0]);
    // A thread that waits in here must not start other work that waits for this tile.
    work::isolate([&] {
        if (!std::ranges::all_of(wanted, [&](std::size_t k) { return complete_[k].load(); })) {
            const std::lock_guard lock(mutex_);
            decode(wanted);
        }
        work::parallel_for(wanted.size(), [&](std::size_t n) {
            const std::size_t s = n % part.range.ns, t = n / part.range.ns;
            for_each_row(pictures_[wanted[n]], setup_, [&](std::size_t c, std::size_t v, std::span<const float> row) {
                std::ranges::copy(row, &part.radiance(c, t, s, v, 0));
            });
        });
    });
}

std::span<BlockState> HogelDecoder::blocks_of(std::size_t hogel) {
    return std::span(blocks_).subspan(hogel * setup_.grid.count(), setup_.grid.count());
}

const std::vector<Block>* HogelDecoder::context_blocks(std::size_t hogel) const {
    const auto& references = setup_.order.hogels()[hogel].context_references;
    return references.empty() ? nullptr : &coded_[references.front().hogel].blocks;
}

// Reads the syntax elements of hogel k. The elements of its context references must be known.
void HogelDecoder::read_syntax(std::size_t k) {
    const HogelOrder::Hogel& hogel = setup_.order.hogels()[k];
    const auto warped = warped_blocks(hogel, coded_, setup_.grid, setup_.aspect);
    if (k < codes_.size()) {
        BlockReader reader(codes_[k]);
        constexpr std::size_t bytes_of_levels = 4;  // estimate, for each channel of a block
        coded_[k].levels.reserve(std::min(codes_[k].size() / bytes_of_levels, setup_.grid.count()));
        BlockModels models = models_[static_cast<std::size_t>(hogel.layer)];
        code_hogel(reader, models, setup_.grid, hogel, warped, context_blocks(k), coded_[k]);
        const ByteReader tile({}, "tile");
        if (reader.ended()) tile.damaged("it ends too early");
        if (!reader.all_read()) tile.damaged("bytes are left over");
    } else {
        predict_syntax(setup_.grid, warped, context_blocks(k), coded_[k]);
    }
    syntax_read_[k] = true;
}

// Reads the syntax elements of hogels, after those of their context references, on all threads.
void HogelDecoder::read_syntax_in_wavefronts(const std::vector<std::size_t>& wanted) {
    const auto& order = setup_.order.hogels();
    std::vector<bool> needed(order.size());
    for (const std::size_t k : wanted) needed[k] = true;
    for (std::size_t k = order.size(); k-- > 0;)
        if (needed[k])
            for (const HogelOrder::Reference& reference : order[k].context_references) needed[reference.hogel] = true;
    const auto& wavefronts = setup_.order.wavefronts();
    for (std::size_t wavefront = 0; wavefront + 1 < wavefronts.size(); ++wavefront) {
        std::vector<std::size_t> batch;
        for (std::size_t k = wavefronts[wavefront]; k < wavefronts[wavefront + 1]; ++k)
            if (needed[k] && !syntax_read_[k]) batch.push_back(k);
        work::parallel_for(batch.size(), [&](std::size_t n) { read_syntax(batch[n]); });
    }
}

void HogelDecoder::want_block(std::size_t k, std::size_t column, std::size_t row) {
    BlockState& state = blocks_of(k)[row * setup_.grid.columns + column];
    if (state != BlockState::unknown) return;
    state = BlockState::wanted;
    wanted_[k] = true;
}

// Marks all blocks, of this and other hogels, on which the wanted blocks of this hogel depend.
void HogelDecoder::want_references(std::size_t k) {
    const HogelOrder::Hogel& hogel = setup_.order.hogels()[k];
    ReferenceWeights weights(hogel, setup_.noise, setup_.aspect);
    const BlockGrid& grid = setup_.grid;
    const auto states = blocks_of(k);
    for (std::size_t n = grid.count(); n-- > 0;) {
        if (states[n] != BlockState::wanted) continue;
        const Block& block = coded_[k].blocks[n];
        const std::size_t column = n % grid.columns, row = n / grid.columns;
        if (block.mode == mode_intra) {
            if (column > 0) want_block(k, column - 1, row);
            if (row > 0) want_block(k, column, row - 1);
            if (row == 0 || block.intra_predictor < first_directional) continue;
            if (column > 0) want_block(k, column - 1, row - 1);
            if (column + 1 < grid.columns) want_block(k, column + 1, row - 1);
            continue;
        }
        const BlockChoices choices = choices_of(block, weights);
        for (std::size_t partition = 0; partition < choices.partitions; ++partition) {
            const ReferenceWeights::Choice& choice = choices.of[partition];
            for (std::size_t i = 0; i < choice.count; ++i) {
                const BlockRange fetched = fetched_blocks(grid.columns, grid.rows, column, row, choice.shift[i]);
                for (std::size_t r = fetched.first_row; r <= fetched.last_row; ++r)
                    for (std::size_t c = fetched.first_column; c <= fetched.last_column; ++c)
                        want_block(hogel.references[choice.reference[i]].hogel, c, r);
            }
        }
    }
}

void HogelDecoder::reconstruct_wanted(std::size_t k) {
    const auto states = blocks_of(k);
    reconstruct(setup_, k, coded_[k], states, pictures_);
    wanted_[k] = false;
    if (std::ranges::count(states, BlockState::reconstructed) < std::ptrdiff_t(states.size())) return;
    coded_[k].levels = {};
    complete_[k] = true;
}

void HogelDecoder::decode(const std::vector<std::size_t>& wanted) {
    read_syntax_in_wavefronts(wanted);
    for (const std::size_t k : wanted) {
        for (BlockState& state : blocks_of(k)) state = std::max(state, BlockState::wanted);
        wanted_[k] = !complete_[k];
    }
    const std::size_t wavefronts = setup_.order.wavefronts().size() - 1;
    if (wanted.size() < range_.hogels())
        for (std::size_t wavefront = wavefronts; wavefront-- > 0;) {
            const std::vector<std::size_t> batch = wanted_of_wavefront(wavefront);
            read_syntax_in_wavefronts(batch);
            for (const std::size_t k : batch) want_references(k);
        }
    for (std::size_t wavefront = 0; wavefront < wavefronts; ++wavefront) {
        const std::vector<std::size_t> batch = wanted_of_wavefront(wavefront);
        work::parallel_for(batch.size(), [&](std::size_t n) { reconstruct_wanted(batch[n]); });
    }
}

std::vector<std::size_t> HogelDecoder::wanted_of_wavefront(std::size_t wavefront) const {
    std::vector<std::size_t> hogels;
    for (std::size_t k = setup_.order.wavefronts()[wavefront]; k < setup_.order.wavefronts()[wavefront + 1]; ++k)
        if (wanted_[k]) hogels.push_back(k);
    return hogels;
}

std::size_t HogelDecoder::hogels_read() const {
    return static_cast<std::size_t>(std::ranges::count(syntax_read_, std::uint8_t{1}));
}

std::size_t HogelDecoder::blocks_reconstructed() const {
    return static_cast<std::size_t>(std::ranges::count(blocks_, BlockState::reconstructed));
}

std::size_t samples_in_blocks(const LightFieldGrid& grid) {
    const auto padded = [](std::size_t n) { return (n + block_side - 1) / block_side * block_side; };
    return padded(grid.directions_u) * padded(grid.directions_v) * grid.channels;
}

bool hogel_tile_fits(const LightFieldGrid& grid, const HogelRange& range) {
    return range.ns <= max_hogel_tile_side && range.nt <= max_hogel_tile_side &&
           samples_in_blocks(grid) <= max_hogel_tile_samples / range.hogels();
}

}  // namespace hogel::codec::decode
