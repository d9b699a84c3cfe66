// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hogel::coding {

// Adaptive arithmetic coding: a range coder with carry propagation, and models that adapt to what they code. Encoder
// and decoder must use the same models in the same order. Source: Witten, Neal and Cleary, CACM 30 (1987), [K] 4.3's
// [127]; range coding after Martin 1979.

/// Probability of a bit, adapted at two rates.
class BitModel {
  public:
    BitModel() = default;
    /// @param zero   initial probability of a zero, as a fraction of 2¹⁶; not 0
    explicit BitModel(std::uint16_t zero) : fast_(zero), slow_(zero) {}
    /// Returns the probability of a zero as a fraction of 2¹⁶; neither 0 nor 2¹⁶.
    std::uint32_t zero() const { return (std::uint32_t{fast_} + slow_) / 2; }
    void learn(bool bit) {
        fast_ = static_cast<std::uint16_t>(bit ? fast_ - (fast_ >> 4) : fast_ + ((65536 - fast_) >> 4));
        slow_ = static_cast<std::uint16_t>(bit ? slow_ - (slow_ >> 7) : slow_ + ((65536 - slow_) >> 7));
    }

  private:
    std::uint16_t fast_ = 32768, slow_ = 32768;
};

/// Frequencies of the symbols 0..count−1 of an alphabet. Cost: O(log count).
class SymbolModel {
  public:
    /// @param count   1 to 32768
    explicit SymbolModel(std::size_t count);
    std::size_t count() const { return frequency_.size(); }
    std::uint32_t total() const { return total_; }
    std::uint32_t frequency(std::size_t symbol) const { return frequency_[symbol]; }
    /// Returns the sum of the frequencies of the symbols before this one.
    std::uint32_t before(std::size_t symbol) const;
    /// Returns the symbol with before(symbol) <= position < before(symbol) + frequency(symbol); position < total().
    std::size_t find(std::uint32_t position) const;
    void learn(std::size_t symbol);

  private:
    void build();

    std::vector<std::uint32_t> frequency_, tree_;  // tree_: a Fenwick tree over frequency_, from index 1
    std::uint32_t total_ = 0;
};

/// Below this range a byte is shifted out or in.
constexpr std::uint32_t min_coding_range = 1u << 24;

class ArithmeticEncoder {
  public:
    void bit(BitModel& model, bool value);
    void symbol(SymbolModel& model, std::size_t value);
    /// Codes the low `count` bits of a value, all equally likely; count <= 32.
    void raw(std::uint32_t value, int count);
    /// Returns the number of bytes so far; finish() adds one to five.
    std::size_t size() const { return bytes_.size() + pending_; }
    /// Ends the code with the minimum number of bytes that decode correctly for any following bytes.
    std::vector<std::uint8_t> finish();

  private:
    void narrow(std::uint32_t start, std::uint32_t size);
    void shift();

    std::vector<std::uint8_t> bytes_;
    std::uint64_t low_ = 0;  // with the carry in bit 32
    std::uint32_t range_ = 0xFFFFFFFF;
    std::uint8_t held_ = 0;    // byte that a carry may still change
    std::size_t pending_ = 0;  // number of 0xFF bytes after it
    bool first_ = true;        // no byte is held yet
};

/// Decodes the output of an ArithmeticEncoder. ended() becomes true when a decision depends on bytes beyond the end
/// or the code is damaged; this decision and all later ones are meaningless but within their alphabets. A prefix of a
/// code yields exactly the decisions that it determines.
class ArithmeticDecoder {
  public:
    explicit ArithmeticDecoder(std::span<const std::uint8_t> bytes);
    bool bit(BitModel& model);
    std::size_t symbol(SymbolModel& model);
    std::uint32_t raw(int count);
    bool even();  ///< raw(1)
    bool ended() const { return ended_; }
    /// Returns whether all bytes have been read, as at the end of an undamaged code.
    bool all_read() const { return next_ == bytes_.size(); }

  private:
    void narrow(std::uint32_t start, std::uint32_t size);
    std::uint32_t take();

    std::span<const std::uint8_t> bytes_;
    std::size_t next_ = 0;
    std::uint32_t range_ = 0xFFFFFFFF, code_ = 0;
    std::uint32_t unknown_ = 0;  // ones at the bits of code_ beyond the end
    bool ended_ = false;
};

// Inline, because coders spend most of their time here.

inline void ArithmeticEncoder::narrow(std::uint32_t start, std::uint32_t size) {
    low_ += start;
    range_ = size;
    while (range_ < min_coding_range) {
        range_ <<= 8;
        shift();
    }
}

inline void ArithmeticEncoder::bit(BitModel& model, bool value) {
    const std::uint32_t bound = (range_ >> 16) * model.zero();
    if (value)
        narrow(bound, range_ - bound);
    else
        narrow(0, bound);
    model.learn(value);
}

inline std::uint32_t ArithmeticDecoder::take() {
    const bool missing = next_ == bytes_.size();
    unknown_ = unknown_ << 8 | (missing ? 0xFF : 0x00);
    return missing ? 0 : bytes_[next_++];
}

inline void ArithmeticDecoder::narrow(std::uint32_t start, std::uint32_t size) {
    code_ -= start;
    range_ = size;
    // If no byte is missing, a code beyond the range is damaged.
    if (std::uint64_t{code_} + unknown_ >= range_) ended_ = true;
    while (range_ < min_coding_range) {
        range_ <<= 8;
        code_ = code_ << 8 | take();
    }
}

inline bool ArithmeticDecoder::bit(BitModel& model) {
    const std::uint32_t bound = (range_ >> 16) * model.zero();
    const bool value = code_ >= bound;
    if (value)
        narrow(bound, range_ - bound);
    else
        narrow(0, bound);
    model.learn(value);
    return value;
}

inline bool ArithmeticDecoder::even() {
    const std::uint32_t half = range_ >> 1;
    const bool value = code_ >= half;
    narrow(value ? half : 0, half);
    return value;
}

}  // namespace hogel::coding
