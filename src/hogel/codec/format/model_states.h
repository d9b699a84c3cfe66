// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "hogel/codec/format/block_syntax.h"

namespace hogel::codec::format {

// Initial states of the models, shared by all hogels of a layer, so that each hogel can be decoded without the
// others. A state is the logarithm of the ratio of zeros to ones, in quarters of a bit.
class ModelStates {
  public:
    // Initialises all models to equally likely zeros and ones.
    ModelStates();
    // Fits the states to counted bits; a state of `before` is kept if the change would cost more than it saves.
    ModelStates(std::span<const BitCount> counts, const ModelStates& before);

    std::size_t count() const { return states_.size(); }
    BlockModels models() const;
    std::vector<coding::BitModel> models_in_order() const;

    // Writes or reads the states as changes from `before`.
    template <class Coder>
    void code(Coder& coder, const ModelStates& before);

  private:
    std::vector<int> states_;
};

// Lengths of the codes of the hogels of a layer.
class CodeLengths {
  public:
    template <class Coder>
    std::uint32_t code(Coder& coder, std::uint32_t length) {
        return code_number(coder, models_, length);
    }

  private:
    std::array<coding::BitModel, max_number_bits + 1> models_;
};

extern template void ModelStates::code(BlockWriter&, const ModelStates&);
extern template void ModelStates::code(BlockReader&, const ModelStates&);

}  // namespace hogel::codec::format
