// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/model_states.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace hogel::codec::format {
namespace {

constexpr int max_state = 40;
constexpr double bits_of_change = 7;  // estimated cost of a changed state

// Returns the index of a state in a table.
std::size_t index_of(int state) {
    const int index = state + max_state;
    return static_cast<std::size_t>(index);
}

struct Probabilities {
    std::array<std::uint16_t, 2 * max_state + 1> zero;          // of 2¹⁶
    std::array<std::array<double, 2>, 2 * max_state + 1> bits;  // cost of a zero and of a one
    Probabilities() {
        for (int state = -max_state; state <= max_state; ++state) {
            const double p = 1 / (1 + std::exp2(-state / 4.0));
            const std::size_t index = index_of(state);
            zero[index] = static_cast<std::uint16_t>(std::lround(65536 * p));
            bits[index] = {-std::log2(p), -std::log2(1 - p)};
        }
    }
};
const Probabilities probabilities;

coding::BitModel model_of(int state) { return coding::BitModel(probabilities.zero[index_of(state)]); }

double bits_for(const BitCount& count, int state) {
    const auto& bits = probabilities.bits[index_of(state)];
    return count[0] * bits[0] + count[1] * bits[1];
}

}  // namespace

ModelStates::ModelStates() {
    BlockModelNumbers().for_each([&](std::uint16_t) { states_.push_back(0); });
}

ModelStates::ModelStates(std::span<const BitCount> counts, const ModelStates& before) {
    for (const BitCount& count : counts) {
        const int old = before.states_[states_.size()];
        if (count[0] + count[1] == 0) {  // most models in small tiles
            states_.push_back(old);
            continue;
        }
        // The state nearest to the counted ratio is as good as the best one.
        const double ratio = (count[0] + 0.5) / (count[1] + 0.5);
        const int found = std::clamp(static_cast<int>(std::lround(4 * std::log2(ratio))), -max_state, max_state);
        const bool pays = bits_for(count, found) + bits_of_change < bits_for(count, old);
        states_.push_back(pays ? found : old);
    }
}

std::vector<coding::BitModel> ModelStates::models_in_order() const {
    std::vector<coding::BitModel> models;
    for (const int state : states_) models.push_back(model_of(state));
    return models;
}

BlockModels ModelStates::models() const {
    BlockModels models;
    std::size_t index = 0;
    models.for_each([&](coding::BitModel& model) { model = model_of(states_[index++]); });
    return models;
}

template <class Coder>
void ModelStates::code(Coder& coder, const ModelStates& before) {
    std::array<coding::BitModel, 2> changed;  // [whether the previous state has changed]
    coding::BitModel sign;
    std::array<coding::BitModel, max_number_bits + 1> size;
    bool last = false;
    for (std::size_t k = 0; k < states_.size(); ++k) {
        const int difference = states_[k] - before.states_[k];
        last = coder.bit(changed[last ? 1 : 0], difference != 0);
        int state = before.states_[k];
        if (last) {
            const bool negative = coder.bit(sign, difference < 0);
            const int found = static_cast<int>(std::min<std::uint32_t>(
                code_number(coder, size, static_cast<std::uint32_t>(std::abs(difference) - 1)), 2 * max_state));
            state += negative ? -found - 1 : found + 1;
        }
        states_[k] = std::clamp(state, -max_state, max_state);
    }
}

template void ModelStates::code(BlockWriter&, const ModelStates&);
template void ModelStates::code(BlockReader&, const ModelStates&);

}  // namespace hogel::codec::format
