// SPDX-License-Identifier: Apache-2.0
#include "hogel/coding/arithmetic.h"

#include <algorithm>
#include <bit>

namespace hogel::coding {
namespace {

constexpr std::uint32_t max_total = 1u << 16;
constexpr std::uint32_t increment = 32;  // alphabets of hundreds of symbols adapt within some thousand symbols

}  // namespace

SymbolModel::SymbolModel(std::size_t count) : frequency_(count, 1), tree_(count + 1) { build(); }

void SymbolModel::build() {
    std::fill(tree_.begin(), tree_.end(), 0);
    total_ = 0;
    for (std::size_t node = 1; node < tree_.size(); ++node) {
        tree_[node] += frequency_[node - 1];
        total_ += frequency_[node - 1];
        const std::size_t above = node + (node & (~node + 1));
        if (above < tree_.size()) tree_[above] += tree_[node];
    }
}

std::uint32_t SymbolModel::before(std::size_t symbol) const {
    std::uint32_t sum = 0;
    for (std::size_t node = symbol; node > 0; node &= node - 1) sum += tree_[node];
    return sum;
}

std::size_t SymbolModel::find(std::uint32_t position) const {
    std::size_t node = 0;
    for (std::size_t step = std::bit_floor(count()); step > 0; step /= 2)
        if (node + step < tree_.size() && tree_[node + step] <= position) {
            node += step;
            position -= tree_[node];
        }
    return node;
}

void SymbolModel::learn(std::size_t symbol) {
    frequency_[symbol] += increment;
    total_ += increment;
    if (total_ > max_total) {
        for (std::uint32_t& frequency : frequency_) frequency = (frequency + 1) / 2;
        build();
        return;
    }
    for (std::size_t node = symbol + 1; node < tree_.size(); node += node & (~node + 1)) tree_[node] += increment;
}

void ArithmeticEncoder::shift() {
    const bool carry = (low_ >> 32) != 0;
    const auto top = static_cast<std::uint8_t>(low_ >> 24);
    if (top == 0xFF && !carry && !first_) {
        ++pending_;
    } else {
        if (!first_) bytes_.push_back(static_cast<std::uint8_t>(held_ + carry));
        bytes_.insert(bytes_.end(), pending_, static_cast<std::uint8_t>(carry ? 0x00 : 0xFF));
        pending_ = 0;
        held_ = top;
        first_ = false;
    }
    low_ = (low_ & 0x00FFFFFF) << 8;
}

void ArithmeticEncoder::symbol(SymbolModel& model, std::size_t value) {
    const std::uint32_t unit = range_ / model.total();
    narrow(unit * model.before(value), unit * model.frequency(value));
    model.learn(value);
}

void ArithmeticEncoder::raw(std::uint32_t value, int count) {
    for (int done = 0; done < count; done += 16) {
        const int bits = std::min(16, count - done);
        const std::uint32_t unit = range_ >> bits;
        narrow(unit * ((value >> done) & ((1u << bits) - 1)), unit);
    }
}

std::vector<std::uint8_t> ArithmeticEncoder::finish() {
    // The number with the most trailing zero bytes for which all numbers that differ only in these bytes are in range.
    for (int unused = 3; unused >= 0; --unused) {
        const std::uint64_t mask = (std::uint64_t{1} << (8 * unused)) - 1;
        const std::uint64_t value = (low_ + mask) & ~mask;
        if (value + mask > low_ + range_ - 1) continue;
        low_ = value;
        // One more shift than there are significant bytes, to output the held and pending bytes.
        for (int used = 4 - unused; used >= 0; --used) shift();
        break;
    }
    return std::move(bytes_);
}

ArithmeticDecoder::ArithmeticDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) code_ = code_ << 8 | take();
}

std::size_t ArithmeticDecoder::symbol(SymbolModel& model) {
    const std::uint32_t unit = range_ / model.total();
    const std::size_t value = model.find(std::min(code_ / unit, model.total() - 1));
    narrow(unit * model.before(value), unit * model.frequency(value));
    model.learn(value);
    return value;
}

std::uint32_t ArithmeticDecoder::raw(int count) {
    std::uint32_t value = 0;
    for (int done = 0; done < count; done += 16) {
        const int bits = std::min(16, count - done);
        const std::uint32_t unit = range_ >> bits;
        const std::uint32_t part = std::min(code_ / unit, (1u << bits) - 1);
        narrow(unit * part, unit);
        value |= part << done;
    }
    return value;
}

}  // namespace hogel::coding
