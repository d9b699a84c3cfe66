// SPDX-License-Identifier: Apache-2.0
#include "hogel/coding/threepass.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <utility>

#include "hogel/coding/arithmetic.h"
#include "hogel/coding/header_bytes.h"
#include "hogel/coding/three_pass_trees.h"
#include "hogel/error.h"

namespace hogel::coding {
namespace {

constexpr int max_planes = 30;
constexpr std::size_t header = 5;

// Models of the bits of symbols.
struct Models {
    using Unary = std::array<BitModel, max_planes>;
    static constexpr std::size_t contexts = 6;  // of the two previous coefficients
    // [bits of the parent's subtree][leaf][context]
    std::array<std::array<std::array<BitModel, contexts>, 2>, max_planes + 1> tree_found;
    std::array<std::array<std::array<Unary, contexts>, 2>, max_planes + 1> tree_less;
    // [bits of the subtree][context]
    std::array<std::array<BitModel, contexts>, max_planes + 1> node_found;
    std::array<Unary, max_planes + 1> node_less;
    std::array<Unary, max_planes + 1> magnitude;  // [bits of the level][which bit]
};

// The symbols of the third pass as bits, shared by encoder and decoder: bit(model, value) and even(value) of a coder
// write the bit or read it, and return it.
template <class Coder>
class Symbols {
  public:
    explicit Symbols(Coder of) : coder(std::move(of)), models_(std::make_unique<Models>()) {}

    int tree(int symbol, int above, bool leaf) {
        // Next to a large coefficient others are likely.
        const std::size_t before = tree_before_ == 0 ? 0u : tree_before_ < above ? 1u : 2u;
        context_ = 2 * before + (tree_before_that_ > 0 ? 1u : 0u);
        const auto up = static_cast<std::size_t>(above);
        if (!coder.bit(models_->tree_found[up][leaf][context_], symbol >= 0))
            symbol = -1;
        else
            symbol = unary(models_->tree_less[up][leaf][context_], symbol, above);
        tree_before_that_ = tree_before_;
        tree_before_ = symbol < 0 ? 0 : above - symbol;
        return symbol;
    }
    int node(int symbol, int tree_bits) {
        const auto tree = static_cast<std::size_t>(tree_bits);
        if (!coder.bit(models_->node_found[tree][context_], symbol >= 0)) return -1;
        return unary(models_->node_less[tree], symbol, tree_bits);
    }
    std::pair<std::uint32_t, bool> magnitude(std::uint32_t level, int bits, bool negative) {
        negative = coder.even(negative);
        std::uint32_t result = 1;
        for (int at = bits - 2; at >= 0; --at)
            result = result << 1 | std::uint32_t{coder.bit(
                                       models_->magnitude[static_cast<std::size_t>(bits)][static_cast<std::size_t>(at)],
                                       (level >> at & 1) != 0)};
        return {result, negative};
    }

    Coder coder;

  private:
    // Codes a symbol from 0 to count − 1.
    int unary(Models::Unary& models, int symbol, int count) {
        int result = 0;
        while (result + 1 < count && coder.bit(models[static_cast<std::size_t>(result)], symbol > result)) ++result;
        return result;
    }

    std::unique_ptr<Models> models_;
    std::size_t context_ = 0;
    int tree_before_ = 0, tree_before_that_ = 0;  // bits of the last two subtrees
};

struct BitEncoder {
    ArithmeticEncoder encoder;
    bool bit(BitModel& model, bool value) {
        encoder.bit(model, value);
        return value;
    }
    bool even(bool value) {
        encoder.raw(value, 1);
        return value;
    }
};

struct BitDecoder {
    ArithmeticDecoder decoder;
    bool bit(BitModel& model, bool) { return decoder.bit(model); }
    bool even(bool) { return decoder.even(); }
};

struct Encoding {
    Symbols<BitEncoder> symbols{BitEncoder{}};

    void tree(int symbol, int above, bool leaf) { symbols.tree(symbol, above, leaf); }
    void node(int symbol, int tree_bits) { symbols.node(symbol, tree_bits); }
    void magnitude(std::uint32_t level, int bits, bool negative) { symbols.magnitude(level, bits, negative); }
};

struct Decoding {
    Symbols<BitDecoder> symbols;

    explicit Decoding(std::span<const std::uint8_t> code) : symbols(BitDecoder{ArithmeticDecoder(code)}) {}
    const ArithmeticDecoder& decoder() const { return symbols.coder.decoder; }
    // Beyond the end of a truncated stream every tree is a zerotree, so that the passes end soon.
    int tree(int above, bool leaf) { return decoder().ended() ? -1 : symbols.tree(0, above, leaf); }
    int node(int tree_bits) { return symbols.node(0, tree_bits); }
    std::pair<std::uint32_t, bool> magnitude(int bits) { return symbols.magnitude(0, bits, false); }
};

[[noreturn]] void damaged(const char* what) {
    throw Error(ErrorCode::bad_input, fmt::format("three-pass stream: {}, expected a whole undamaged one", what));
}

void check_size(const transform::Pyramid& pyramid, std::size_t size) {
    if (size != pyramid.size())
        throw Error(ErrorCode::usage, fmt::format("three-pass coder: {} values given, expected the {} of the pyramid",
                                                  size, pyramid.size()));
}

// Counts magnitudes in bins that are nearly uniform in the logarithm, 32 per octave: floats without their 18 lowest
// bits.
class Histogram {
  public:
    static constexpr int dropped = 18;
    explicit Histogram(std::span<const float> values) : counts_(std::size_t{1} << (31 - dropped)) {
        for (float value : values) ++counts_[std::bit_cast<std::uint32_t>(std::abs(value)) >> dropped];
    }
    std::size_t bins() const { return counts_.size(); }
    static double lower_edge(std::size_t bin) {
        return std::bit_cast<float>(static_cast<std::uint32_t>(bin) << dropped);
    }
    // Σ (n + c) over significant values: magnitudes in (2^(n−1), 2^n] steps have n-bit levels.
    double bits(double step, double c) const {
        double sum = 0;
        for (std::size_t bin = 0; bin < counts_.size(); ++bin) {
            const double steps = lower_edge(bin) / step;
            if (counts_[bin] > 0 && steps >= 1) sum += static_cast<double>(counts_[bin]) * (std::ilogb(steps) + 1 + c);
        }
        return sum;
    }

  private:
    std::vector<std::size_t> counts_;
};

}  // namespace

std::vector<std::uint8_t> three_pass_encode(const transform::Pyramid& pyramid, std::span<const float> values,
                                            double step) {
    check_size(pyramid, values.size());
    const float max_value = max_magnitude(values), stored_step = static_cast<float>(step);
    if (!(stored_step > 0) || !std::isfinite(stored_step) || max_value / stored_step > std::ldexp(1.0f, max_planes))
        throw Error(
            ErrorCode::usage,
            fmt::format("three-pass coder: a step of {} for magnitudes up to {}, expected one from 2^-30 of that", step,
                        max_value));
    const Quantiser quantiser(stored_step);
    const int planes = std::bit_width(quantiser.level(max_value));
    std::vector<std::uint8_t> bytes;
    put_float(bytes, stored_step);
    bytes.push_back(static_cast<std::uint8_t>(planes));
    Encoding encoding;
    write_three_pass(Forest(pyramid), values, quantiser, planes, encoding);
    const std::vector<std::uint8_t> code = encoding.symbols.coder.encoder.finish();
    bytes.insert(bytes.end(), code.begin(), code.end());
    return bytes;
}

void three_pass_decode(const transform::Pyramid& pyramid, std::span<const std::uint8_t> bytes,
                       std::span<float> values) {
    check_size(pyramid, values.size());
    if (bytes.size() < header) damaged("it ends within its header");
    const float step = get_float(bytes);
    const int planes = bytes[4];
    if (!(step > 0) || !std::isfinite(step)) damaged("its step is not a positive number");
    if (planes > max_planes) damaged("it has more than 30 bit planes");
    Decoding decoding(bytes.subspan(header));
    read_three_pass(Forest(pyramid), Quantiser(step), planes, decoding, values);
    if (decoding.decoder().ended()) damaged("it ends too early or is damaged");
    if (!decoding.decoder().all_read()) damaged("bytes are left over");
}

void three_pass_round(std::span<const std::uint8_t> bytes, std::span<float> values) {
    const Quantiser quantiser(get_float(bytes));
    for (float& value : values) {
        const std::uint32_t level = quantiser.level(value);
        value = level == 0 ? 0 : quantiser.value(level, value < 0);
    }
}

double three_pass_step(std::span<const float> values, double bits, double c) {
    const float max_value = max_magnitude(values);
    if (max_value == 0) return 1;
    const Histogram histogram(values);
    double coarse = max_value, fine = max_value * 0x1p-29;
    while (coarse > fine * 1.001) {
        const double step = std::sqrt(coarse * fine);
        (histogram.bits(step, c) <= bits ? coarse : fine) = step;
    }
    return coarse;
}

std::vector<std::uint8_t> three_pass_encode_to_bits(const transform::Pyramid& pyramid, std::span<const float> values,
                                                    double bits) {
    const double max_value = max_magnitude(values);
    // Logarithms of a step that fits and of one that is too fine. Logarithms of sizes are nearly linear in them.
    double fits = max_value > 0 ? std::log2(max_value) : 0, too_fine = fits - max_planes;
    std::vector<std::uint8_t> best = three_pass_encode(pyramid, values, std::exp2(fits));
    const auto log_size = [](const std::vector<std::uint8_t>& bytes) {
        return std::log2(8 * static_cast<double>(bytes.size()));
    };
    const double asked = std::log2(bits), aim = std::log2(0.99 * bits);
    if (!(log_size(best) <= asked))
        throw Error(ErrorCode::usage,
                    fmt::format("three-pass coder: {} bits asked for, expected at least {}", bits, 8 * best.size()));
    double step = std::log2(three_pass_step(values, bits)), before = fits, size_before = log_size(best);
    for (int attempt = 1; attempt <= 16 && log_size(best) < std::log2(0.98 * bits); ++attempt) {
        std::vector<std::uint8_t> bytes = three_pass_encode(pyramid, values, std::exp2(step));
        const double size = log_size(bytes);
        (size <= asked ? fits : too_fine) = step;
        if (size <= asked && size > log_size(best)) best = std::move(bytes);
        // The secant through the last two points, or bisection if that leads out of the interval or advances slowly.
        const double secant = step + (aim - size) * (step - before) / (size - size_before);
        before = step;
        size_before = size;
        step = attempt % 4 != 0 && secant > too_fine && secant < fits ? secant : (too_fine + fits) / 2;
    }
    return best;
}

}  // namespace hogel::coding
