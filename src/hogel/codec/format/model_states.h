// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "hogel/codec/format/block_syntax.h"

namespace hogel::codec::format {

// Where the models of all hogels of a level begin, so that each can be decoded without having seen the others: the
// logarithm of zeros to ones, in quarters of a bit, of each model in order.
class ModelStates {
  public:
    // Nothing is known.
    ModelStates();
    // Those that suit what was counted of each; as before where another is not worth telling.
    ModelStates(std::span<const BitCount> counts, const ModelStates& before);

    std::size_t count() const { return states_.size(); }
    BlockModels models() const;
    std::vector<coding::BitModel> models_in_order() const;

    // Writes them as what is new since `before`, or reads them.
    template <class Coder>
    void code(Coder& coder, const ModelStates& before);

  private:
    std::vector<int> states_;
};

// The lengths of codes that follow each other.
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
