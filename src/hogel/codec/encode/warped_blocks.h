// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/codec/format/reconstruct.h"

namespace hogel::codec::encode {

// What references show of the first channel of a block, kept while several searches look at it.
class SeenBlocks {
  public:
    SeenBlocks(const format::HogelOrder::Hogel& hogel, const std::vector<format::Picture>& pictures)
        : hogel_(hogel), pictures_(pictures), kept_(new Kept[kept_blocks]) {}

    // Goes on to the block at (x, y).
    void go_to(std::size_t x, std::size_t y) {
        x_ = static_cast<int>(x);
        y_ = static_cast<int>(y);
        ++block_;
    }
    // By one of few references, moved by the shift of the disparity. Valid until another disparity is asked for.
    const format::BlockSamples& by(int disparity, std::uint32_t reference, format::Shift shift) {
        // References of one disparity lie side by side, and so do not replace each other.
        Kept& kept = kept_[(static_cast<std::uint32_t>(disparity) * 13 + reference) % kept_blocks];
        if (kept.block != block_ || kept.disparity != disparity || kept.reference != reference) {
            kept.block = block_;
            kept.disparity = disparity;
            kept.reference = reference;
            format::fetch_moved(pictures_[hogel_.references[reference].hogel][0], x_, y_, shift, kept.samples);
        }
        return kept.samples;
    }
    // What is predicted from a choice with any references: `room`, or what was seen.
    const format::BlockSamples& predict(int disparity, const format::ReferenceWeights::Choice& choice,
                                        format::BlockSamples& room) {
        const format::BlockSamples& first = by(disparity, choice.reference[0], choice.shift[0]);
        if (choice.count < 2) return first;
        format::mix_blocks(first, by(disparity, choice.reference[1], choice.shift[1]), choice.weight[0],
                           choice.weight[1], room);
        return room;
    }

  private:
    struct Kept {
        std::uint32_t block = 0, reference = 0;
        int disparity = 0;
        format::BlockSamples samples;
    };
    static constexpr std::size_t kept_blocks = 64;

    const format::HogelOrder::Hogel& hogel_;
    const std::vector<format::Picture>& pictures_;
    int x_ = 0, y_ = 0;
    std::uint32_t block_ = 0;
    std::unique_ptr<Kept[]> kept_;
};

}  // namespace hogel::codec::encode
