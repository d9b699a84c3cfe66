// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/codec/format/block_syntax.h"

namespace hogel::codec::encode {

// One channel of a block: its prediction, and the levels of its residual.
struct CodedChannel {
    format::BlockSamples prediction;
    bool any_levels = false;
    std::uint8_t basis = 0;
    format::Levels levels;
    float cost = 0;  // squared error plus λ times the bits of the levels
};

// Chooses the basis and the levels of a channel's residual, or no levels if they cost more than they save.
// @param error   Σ (truth − prediction)²
void quantise(const format::BlockSamples& truth, float error, float step, bool intra, float reconstruction_offset,
              CodedChannel& channel);

}  // namespace hogel::codec::encode
