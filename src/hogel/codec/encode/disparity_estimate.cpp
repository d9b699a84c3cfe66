// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/disparity_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hogel/codec/encode/blocks.h"
#include "hogel/codec/format/pictures.h"

namespace hogel::codec::encode {

using namespace format;

namespace {

// Below this error, in squared steps of the first layer per counted neighbour, the disparity of a neighbouring block is
// used unchanged.
constexpr float well_estimated = 1;
// Above this error, in squared finest steps per counted neighbour, neighbours do not show the same surface.
constexpr float max_shared_error = 6.4f;
constexpr float unknown = std::numeric_limits<float>::infinity();

// Compares the blocks of a hogel with those of its neighbours at distances of 1, 2 and 4 hogels.
class Estimation {
  public:
    Estimation(const TileSetup& setup, LightFieldTile& tile, const HogelOrder::Hogel& hogel)
        : setup_(setup), picture_(picture_at(tile, hogel.s, hogel.t)) {
        for (const int distance : {-4, 4, -2, 2, -1, 1}) {  // the most discriminating first
            const std::size_t s = hogel.s + static_cast<std::size_t>(distance);
            const std::size_t t = hogel.t + static_cast<std::size_t>(distance);
            if (s < tile.range.ns) neighbours_[0].push_back({{0, distance, 0}, picture_at(tile, s, hogel.t)});
            if (t < tile.range.nt) neighbours_[1].push_back({{0, 0, distance}, picture_at(tile, hogel.s, t)});
        }
    }

    Estimate run() {
        std::size_t counted = 0;
        for (const auto& axis : neighbours_) counted += (axis.size() + 1) / 2;
        const float well_known = well_estimated * static_cast<float>(counted) * setup_.step[0] * setup_.step[0];
        const float not_shared =
            max_shared_error * static_cast<float>(counted) * setup_.step.back() * setup_.step.back();
        Estimate estimate;
        estimate.disparities.resize(setup_.grid.count());
        for (std::size_t k = 0; k < setup_.grid.count(); ++k) {
            search_block(k, estimate.disparities, well_known);
            estimate.disparities[k] = static_cast<std::int16_t>(best_);
            if (min_cost_ < not_shared)
                estimate.shared += (1 - min_cost_ / not_shared) / static_cast<float>(estimate.disparities.size());
        }
        return estimate;
    }

  private:
    struct Neighbour {
        HogelOrder::Reference offset;
        Picture picture;
    };

    Picture picture_at(LightFieldTile& tile, std::size_t s, std::size_t t) const {
        const bool in_tile = setup_.grid.channels == 1 && setup_.whole_blocks();
        return in_tile ? as_in_tile(tile, setup_, s, t) : picture_of(tile, setup_, s, t);
    }

    // Returns the error of a neighbour's block, with the shift exact or rounded to whole directions.
    float error(const Neighbour& neighbour, int disparity, bool whole_directions) const {
        const Plane& plane = neighbour.picture[0];
        const Shift shift = shift_of(disparity, neighbour.offset, setup_.aspect);
        if (whole_directions) {
            const PlaneWindow window(plane, x_ + ((shift.u + 32) >> 6), y_ + ((shift.v + 32) >> 6), block_side,
                                     block_side);
            return squared_difference(window.rows(), window.stride(), block_);
        }
        BlockSamples warped;
        fetch_warped(plane, x_, y_, shift, warped);
        return squared_difference(warped, block_);
    }

    // Returns the sum of the errors of the better half of the neighbours along each axis, because a surface that is
    // hidden on one side may be visible on the other. A sum of `max_cost` or more need not be exact.
    float cost(int disparity, bool whole_directions, float max_cost) const {
        float sum = 0;
        for (const auto& axis : neighbours_) {
            std::array<float, 6> smallest;  // errors in rising order
            const std::size_t better = (axis.size() + 1) / 2;
            for (std::size_t n = 0; n < axis.size(); ++n) {
                const float candidate_cost = error(axis[n], disparity, whole_directions);
                std::size_t position = n;
                for (; position > 0 && candidate_cost < smallest[position - 1]; --position)
                    smallest[position] = smallest[position - 1];
                smallest[position] = candidate_cost;
                // Each of the remaining neighbours may replace one of the smallest errors.
                const std::size_t left = axis.size() - 1 - n;
                float lower_bound = sum;
                for (std::size_t i = 0; i + left < better; ++i) lower_bound += smallest[i];
                if (!(lower_bound < max_cost)) return lower_bound;
            }
            for (std::size_t i = 0; i < better; ++i) sum += smallest[i];
        }
        return sum;
    }

    void try_one(int disparity, bool whole_directions) {
        const float candidate_cost = cost(disparity, whole_directions, std::min(min_cost_, bound_));
        if (candidate_cost < min_cost_) {
            min_cost_ = candidate_cost;
            best_ = disparity;
        }
    }

    void search_block(std::size_t k, const std::vector<std::int16_t>& known, float well_known) {
        const std::size_t column = k % setup_.grid.columns, row = k / setup_.grid.columns;
        x_ = static_cast<int>(column * block_side);
        y_ = static_cast<int>(row * block_side);
        block_ = block_of(picture_[0], column * block_side, row * block_side);
        best_ = 0;
        min_cost_ = bound_ = unknown;
        // Most blocks continue the surface of the block to their left or above them.
        if (column > 0) try_one(known[k - 1], false);
        if (row > 0 && !(min_cost_ < well_known)) try_one(known[k - setup_.grid.columns], false);
        int part = 4;
        if (!(min_cost_ < well_known)) {
            search_all();
            part = 16;
        }
        for (; part >= 2; part /= 2)
            for (const int middle = best_; const int sign : {-1, 1}) try_one(middle + sign * part, false);
    }

    // Tries disparities in steps of a quarter direction up to four directions, in whole directions up to 16.
    void search_all() {
        const int continued = best_;
        const float of_continued = min_cost_;
        const int quarter = shift_unit / 4, unit = std::abs(best_) <= 4 * shift_unit ? quarter : shift_unit;
        const int nearest = (best_ + unit / 2) / unit * unit;
        if (std::abs(nearest) <= 16 * shift_unit) bound_ = std::nextafter(cost(nearest, true, unknown), unknown);
        best_ = 0;
        min_cost_ = cost(0, true, bound_);
        for (int disparity = quarter; disparity <= 4 * shift_unit; disparity += quarter)
            for (const int sign : {-1, 1}) try_one(sign * disparity, true);
        for (int disparity = 5 * shift_unit; disparity <= 16 * shift_unit; disparity += shift_unit)
            for (const int sign : {-1, 1}) try_one(sign * disparity, true);
        bound_ = unknown;
        min_cost_ = cost(best_, false, unknown);
        if (of_continued < min_cost_) {
            min_cost_ = of_continued;
            best_ = continued;
        }
    }

    const TileSetup& setup_;
    Picture picture_;
    std::array<std::vector<Neighbour>, 2> neighbours_;  // along s, along t
    // The current block:
    int x_ = 0, y_ = 0;
    BlockSamples block_;
    int best_ = 0;              // disparity
    float min_cost_ = unknown;  // its cost
    float bound_ = unknown;     // an upper bound on the final cost; higher costs need not be exact
};

}  // namespace

Estimate estimate_disparities(const TileSetup& setup, LightFieldTile& tile, const HogelOrder::Hogel& hogel) {
    return Estimation(setup, tile, hogel).run();
}

}  // namespace hogel::codec::encode
