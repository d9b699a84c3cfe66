// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/band_lines.h"

#include <algorithm>

namespace hogel::camera::hogel_spectra {

void BandLines::reset(const PupilBand& band, const LookBlocks& looks, std::size_t hogels) {
    looks_ = looks;
    hogels_ = hogels;
    per_hogel_ = band.per_hogel();
    nodes_ = looks.looks_per_block == 1 ? padded(band.nodes()) : band.nodes();
    row_count_ = 2 * band.bases().down.functions();
    row_size_ = looks.row_size(band, hogels);
    line_count_ = 0;
}

void BandLines::add(std::size_t row, std::size_t column, const SlepianBasis::Weights& weights) {
    const std::size_t begin = column * per_hogel_ * looks_.looks_per_block,
                      end = begin + nodes_ * looks_.looks_per_block;
    const auto used = lines_.begin() + static_cast<std::ptrdiff_t>(line_count_);
    auto line = std::find_if(lines_.begin(), used, [&](const Line& other) {
        return other.row == row && other.frequency == weights.frequency;
    });
    if (line == used) {
        if (++line_count_ > lines_.size()) lines_.emplace_back();
        line = lines_.begin() + static_cast<std::ptrdiff_t>(line_count_ - 1);
        line->row = row;
        line->frequency = weights.frequency;
        line->carrier = weights.carrier;
        line->begin = begin / lanes * lanes;
        if (const std::size_t size = looks_.blocks() * row_count_ * row_size_; line->numbers.size() != size)
            line->numbers = Array<float, 1>({size});
    }
    line->end = padded(end);
    if (line_of_hogel_.size() <= row * hogels_ + column) line_of_hogel_.resize(row * hogels_ + column + 1);
    line_of_hogel_[row * hogels_ + column] = static_cast<std::size_t>(line - lines_.begin());
}

void BandLines::clear() {
    for (std::size_t i = 0; i < line_count_; ++i) {
        Line& line = lines_[i];
        for (std::size_t row = 0; row < looks_.blocks() * row_count_; ++row)
            std::fill(&line.numbers(row * row_size_ + line.begin), &line.numbers(row * row_size_) + line.end, 0.0f);
    }
}

LineTarget BandLines::target(std::size_t row, std::size_t column, std::size_t look) {
    Line& line = lines_[line_of_hogel_[row * hogels_ + column]];
    const std::size_t block = look / looks_.looks_per_block;
    return {&line.numbers(block * row_count_ * row_size_ + column * per_hogel_ * looks_.looks_per_block), row_size_};
}

void BandLines::spread(const SlepianBasis& down, std::size_t first, std::span<Array<float, 3>> light) const {
    for (std::size_t i = 0; i < line_count_; ++i) {
        const Line& line = lines_[i];
        for (std::size_t block = 0; block < light.size(); ++block)
            spread_line(down, line.carrier, &line.numbers(block * row_count_ * row_size_ + line.begin), row_size_,
                        line.end - line.begin, &light[block]((first + line.row) * per_hogel_, 0, line.begin));
    }
}

}  // namespace hogel::camera::hogel_spectra
