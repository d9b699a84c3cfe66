// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "hogel/codec/format/partitions.h"
#include "hogel/codec/format/prediction.h"
#include "hogel/coding/arithmetic.h"

namespace hogel::codec::format {

// Basis of the levels of one channel of a block, along u and along v: cosines or single samples.
struct Basis {
    bool cosines_u, cosines_v;
    constexpr bool cosines() const { return cosines_u && cosines_v; }
    constexpr bool samples() const { return !cosines_u && !cosines_v; }
};
constexpr std::array<Basis, 4> bases{{{true, true}, {false, false}, {true, false}, {false, true}}};

// Modes of a block: intra; inter, predicted from any side (mode_any) or from one side (mode_any + side); partitioned.
constexpr std::uint8_t mode_intra = 0, mode_any = 1;
constexpr int inter_modes = 1 + static_cast<int>(ReferenceWeights::sides);  // without intra
constexpr std::uint8_t mode_partitioned = inter_modes;
// Intra predictors; predictors >= first_directional continue the block's borders along a direction.
constexpr int intra_predictors = 10, first_directional = 4;

constexpr std::size_t max_number_bits = 30;
// Classes of the magnitudes of the levels around a level.
constexpr std::size_t level_classes = 12;

// Models of all syntax elements of a block, in each of their contexts (docs/format.md).
template <class Model>
struct ModelsOf {
    using Number = std::array<Model, max_number_bits + 1>;

    struct ForLevels {
        std::array<Model, block_samples> last;
        std::array<std::array<Model, 3>, level_classes> significant, above_one;  // [class][frequency]
        std::array<Model, level_classes> above_two;
        std::array<Number, level_classes> rest;
        std::array<std::array<Model, 3>, 3> sign;  // of samples: [sign on the right][sign below]
    };
    // Models that depend on the warped block: 0 if there is none, 1 or 2 by its own syntax element.
    template <class Models>
    using ByWarped = std::array<Models, 3>;
    ByWarped<std::array<std::array<Model, inter_modes>, 3>> mode;
    std::array<Model, intra_predictors - 1> intra;
    struct ForDisparity {
        ByWarped<std::array<std::array<std::array<Model, 2>, 3>, 4>> disparity;  // [warped][spread][around]
        std::array<std::array<Model, 4>, 4> candidate;                           // [spread]
        Model sign;
        Number difference;
    };
    struct ForPartitions {
        ByWarped<std::array<Model, 3>> partitioned;
        std::array<std::array<Model, ReferenceWeights::sides - 1>, 2> side;
        std::array<Model, edge_angles> angle;
        std::array<Model, edge_offsets> offset;
        ForDisparity second;
        ByWarped<std::array<std::array<std::array<Model, 3>, 2>, 2>>
            coded;  // indices as for `coded` below, without the kind of mode
        // If the warped block is partitioned: the difference of the angles, and the offset in the context of its
        // offset.
        std::array<Model, edge_angles> angle_by;
        std::array<std::array<Model, edge_offsets>, edge_offsets> offset_by;
    };
    ForDisparity main;
    // [warped][chrominance][kind of mode][disparity is not the first candidate][around]
    ByWarped<std::array<std::array<std::array<std::array<Model, 3>, 2>, 3>, 2>> coded;
    // [chrominance][intra][cosines, samples, or one of each]
    std::array<std::array<std::array<ForLevels, 3>, 2>, 2> levels;
    std::array<std::array<std::array<Model, bases.size() - 1>, 4>, 2> basis;  // [chrominance][kind, partitioned last]

    ForPartitions partitions;

    // Calls use(model) for all models in the order of the format.
    template <class Use>
    void for_each(Use&& use) {
        visit(use, mode[0], intra);
        visit_disparity(use, main);
        visit(use, coded[0]);
        for (auto& of_channel : levels)
            for (auto& of_prediction : of_channel)
                for (ForLevels& l : of_prediction)
                    visit(use, l.last, l.significant, l.above_one, l.above_two, l.rest, l.sign);
        visit(use, basis);
        visit(use, partitions.partitioned[0], partitions.side, partitions.angle, partitions.offset);
        visit_disparity(use, partitions.second);
        visit(use, partitions.coded[0]);
        for (std::size_t warped = 1; warped < mode.size(); ++warped) {
            visit(use, mode[warped], main.disparity[warped], coded[warped]);
            visit(use, partitions.partitioned[warped], partitions.second.disparity[warped], partitions.coded[warped]);
        }
        visit(use, partitions.angle_by, partitions.offset_by);
    }

  private:
    template <class Use>
    static void visit(Use& use, Model& model) {
        use(model);
    }
    template <class Use, class Inner, std::size_t count>
    static void visit(Use& use, std::array<Inner, count>& models) {
        for (Inner& inner : models) visit(use, inner);
    }
    template <class Use>
    static void visit_disparity(Use& use, ForDisparity& models) {
        visit(use, models.disparity[0], models.candidate, models.sign, models.difference);
    }
    template <class Use, class First, class... More>
    requires(sizeof...(More) > 0) static void visit(Use& use, First& first, More&... more) {
        visit(use, first);
        visit(use, more...);
    }
};

// Adaptive models.
using BlockModels = ModelsOf<coding::BitModel>;

// Index of each model in the order of for_each().
struct BlockModelNumbers : ModelsOf<std::uint16_t> {
    BlockModelNumbers() {
        std::uint16_t next = 0;
        for_each([&](std::uint16_t& number) { number = next++; });
    }
};

}  // namespace hogel::codec::format
