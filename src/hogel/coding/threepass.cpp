#include "hogel/coding/threepass.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "hogel/coding/arithmetic.h"
#include "hogel/coding/bytes_internal.h"
#include "hogel/coding/threepass_internal.h"
#include "hogel/core/error.h"

namespace hogel {
namespace {

constexpr int most_planes = 30;
constexpr std::size_t header = 5;

// Symbols from −1 to bits−1 for each number of bits, and the bits of levels by where they stand.
struct Models {
    explicit Models(int planes) {
        for (int bits = 0; bits <= planes; ++bits) {
            for (auto& by_leaf : trees)
                for (auto& by_previous : by_leaf) by_previous.emplace_back(static_cast<std::size_t>(bits) + 1);
            node.emplace_back(static_cast<std::size_t>(bits) + 1);
        }
    }
    SymbolModel& tree(int above, bool leaf) { return trees[leaf][after_zerotree][static_cast<std::size_t>(above)]; }
    bool after_zerotree = false;  // the tree symbol before this one was −1
    std::array<std::array<std::vector<SymbolModel>, 2>, 2>
        trees;  // [leaf][after_zerotree][bits of the parent's subtree]
    std::vector<SymbolModel> node;
    std::array<std::array<BitModel, most_planes>, most_planes + 1> magnitude;  // [bits of the level][which bit]
};

struct Encoding {
    ArithmeticEncoder encoder;
    Models models;

    void tree(int symbol, int above, bool leaf) {
        encoder.symbol(models.tree(above, leaf), static_cast<std::size_t>(symbol + 1));
        models.after_zerotree = symbol < 0;
    }
    void node(int symbol, int tree_bits) {
        encoder.symbol(models.node[static_cast<std::size_t>(tree_bits)], static_cast<std::size_t>(symbol + 1));
    }
    void magnitude(std::uint32_t level, int bits, bool negative) {
        encoder.raw(negative, 1);
        for (int at = bits - 2; at >= 0; --at)
            encoder.bit(models.magnitude[static_cast<std::size_t>(bits)][static_cast<std::size_t>(at)],
                        level >> at & 1);
    }
};

struct Decoding {
    ArithmeticDecoder decoder;
    Models models;

    int tree(int above, bool leaf) {
        // What lies past the end of a cut stream is read as zerotrees, which ends soon.
        if (decoder.ended()) return -1;
        const int symbol = static_cast<int>(decoder.symbol(models.tree(above, leaf))) - 1;
        models.after_zerotree = symbol < 0;
        return symbol;
    }
    int node(int tree_bits) {
        return static_cast<int>(decoder.symbol(models.node[static_cast<std::size_t>(tree_bits)])) - 1;
    }
    std::pair<std::uint32_t, bool> magnitude(int bits) {
        const bool negative = decoder.raw(1) != 0;
        std::uint32_t level = 1;
        for (int at = bits - 2; at >= 0; --at)
            level = level << 1 | std::uint32_t{decoder.bit(
                                     models.magnitude[static_cast<std::size_t>(bits)][static_cast<std::size_t>(at)])};
        return {level, negative};
    }
};

void check_size(const Pyramid& pyramid, std::size_t size) {
    if (size != pyramid.size())
        throw Error(ErrorCode::usage, fmt::format("three-pass coder: {} values given, expected the {} of the pyramid",
                                                  size, pyramid.size()));
}

// How often magnitudes fall between numbers whose logarithms are nearly equally spaced, 32 to an octave: a float
// without its 18 lowest bits.
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
    // Σ (n + c) over what is significant at this step: magnitudes in (2^(n−1), 2^n] steps have n-bit levels.
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

std::vector<std::uint8_t> three_pass_encode(const Pyramid& pyramid, std::span<const float> values, double step) {
    check_size(pyramid, values.size());
    const float most = largest_magnitude(values), stored_step = static_cast<float>(step);
    if (!(stored_step > 0) || !std::isfinite(stored_step) || most / stored_step > std::ldexp(1.0f, most_planes))
        throw Error(
            ErrorCode::usage,
            fmt::format("three-pass coder: a step of {} for magnitudes up to {}, expected one from 2^-30 of that", step,
                        most));
    const Quantiser quantiser(stored_step);
    const int planes = std::bit_width(quantiser.level(most));
    std::vector<std::uint8_t> bytes;
    put_float(bytes, stored_step);
    bytes.push_back(static_cast<std::uint8_t>(planes));
    Encoding encoding{{}, Models(planes)};
    write_three_pass(Forest(pyramid), values, quantiser, planes, encoding);
    const std::vector<std::uint8_t> code = encoding.encoder.finish();
    bytes.insert(bytes.end(), code.begin(), code.end());
    return bytes;
}

void three_pass_decode(const Pyramid& pyramid, std::span<const std::uint8_t> bytes, std::span<float> values) {
    check_size(pyramid, values.size());
    const auto damaged = [](const char* what) {
        throw Error(ErrorCode::bad_input, fmt::format("three-pass stream: {}, expected a whole undamaged one", what));
    };
    if (bytes.size() < header) damaged("it ends within its header");
    const float step = get_float(bytes);
    const int planes = bytes[4];
    if (!(step > 0) || !std::isfinite(step)) damaged("its step is not a positive number");
    if (planes > most_planes) damaged("it has more than 30 bit planes");
    Decoding decoding{ArithmeticDecoder(bytes.subspan(header)), Models(planes)};
    read_three_pass(Forest(pyramid), Quantiser(step), planes, decoding, values);
    if (decoding.decoder.ended()) damaged("it ends too early or is damaged");
    if (!decoding.decoder.all_read()) damaged("bytes are left over");
}

double three_pass_step(std::span<const float> values, double bits, double c) {
    const float most = largest_magnitude(values);
    if (most == 0) return 1;
    const Histogram histogram(values);
    double coarse = most, fine = most * 0x1p-29;
    while (coarse > fine * 1.001) {
        const double step = std::sqrt(coarse * fine);
        (histogram.bits(step, c) <= bits ? coarse : fine) = step;
    }
    return coarse;
}

std::vector<std::uint8_t> three_pass_encode_to_bits(const Pyramid& pyramid, std::span<const float> values,
                                                    double bits) {
    const double most = largest_magnitude(values);
    // Steps known to fit and to give too much; their logarithms, as those of sizes over steps are nearly straight.
    double fits = most > 0 ? std::log2(most) : 0, too_fine = fits - most_planes;
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
        // The secant through the last two, or the middle when that leads out of what is known or too slowly on.
        const double secant = step + (aim - size) * (step - before) / (size - size_before);
        before = step;
        size_before = size;
        step = attempt % 4 != 0 && secant > too_fine && secant < fits ? secant : (too_fine + fits) / 2;
    }
    return best;
}

}  // namespace hogel
