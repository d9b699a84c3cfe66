// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/codec/format/reconstruct.h"

namespace hogel::codec::encode {

// A cache, shared by several searches, of the warped blocks of references with which one block of the first channel is
// compared.
class WarpedBlocks {
  public:
    WarpedBlocks(const format::HogelOrder::Hogel& hogel, const std::vector<format::Picture>& pictures)
        : hogel_(hogel), pictures_(pictures), cache_(new Cached[cached_blocks]) {}

    // Starts with the block at (x, y), which empties the cache.
    void go_to(std::size_t x, std::size_t y) {
        x_ = static_cast<int>(x);
        y_ = static_cast<int>(y);
        ++block_;
    }
    // Returns the block of a reference warped by a disparity; `shift` is the shift of that disparity and reference.
    // Valid until another disparity is requested.
    const format::BlockSamples& get(int disparity, std::uint32_t reference, format::Shift shift) {
        // The references of one disparity have neighbouring entries, so that they do not evict each other.
        Cached& cached = cache_[(static_cast<std::uint32_t>(disparity) * 13 + reference) % cached_blocks];
        if (cached.block != block_ || cached.disparity != disparity || cached.reference != reference) {
            cached.block = block_;
            cached.disparity = disparity;
            cached.reference = reference;
            format::fetch_warped(pictures_[hogel_.references[reference].hogel][0], x_, y_, shift, cached.samples);
        }
        return cached.samples;
    }
    // Returns the prediction from a choice of references: either an entry of the cache or `scratch`.
    const format::BlockSamples& predict(int disparity, const format::ReferenceWeights::Choice& choice,
                                        format::BlockSamples& scratch) {
        const format::BlockSamples& first = get(disparity, choice.reference[0], choice.shift[0]);
        if (choice.count < 2) return first;
        format::mix_blocks(first, get(disparity, choice.reference[1], choice.shift[1]), choice.weight[0],
                           choice.weight[1], scratch);
        return scratch;
    }

  private:
    struct Cached {
        std::uint32_t block = 0, reference = 0;
        int disparity = 0;
        format::BlockSamples samples;
    };
    static constexpr std::size_t cached_blocks = 64;

    const format::HogelOrder::Hogel& hogel_;
    const std::vector<format::Picture>& pictures_;
    int x_ = 0, y_ = 0;
    std::uint32_t block_ = 0;
    std::unique_ptr<Cached[]> cache_;
};

}  // namespace hogel::codec::encode
