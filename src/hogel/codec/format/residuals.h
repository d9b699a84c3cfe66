// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hogel/coding/arithmetic.h"

namespace hogel::codec::format {

// Residual of a sample: a whole number, or "special" with a meaning defined by the coder.
struct Residual {
    std::int32_t number = 0;
    bool special = false;
};

// Adaptive models of residuals; the size of a number is the number of bits of its magnitude.
struct ResidualModels {
    static constexpr std::size_t sizes = 34, special = 33;                    // sizes 0 to 32; special
    std::array<std::array<std::array<coding::BitModel, 64>, sizes>, 3> size;  // [specials][mean size around]
    std::array<coding::BitModel, 5> sign;                                     // [signs to the left and above]
    std::array<std::array<coding::BitModel, 4>, sizes> below_highest;         // [size][bits so far]
};

// Contexts for the residuals of an array [v][u], from the sizes of the coded residuals (negative for negative numbers).
class ResidualContexts {
  public:
    ResidualContexts(std::size_t width, std::size_t height) : width_(width), sizes_(width * height) {}

    struct Context {
        std::size_t special;  // number of special residuals to the left and above
        std::size_t mean;     // mean size of the neighbours, without special ones
        std::size_t sign;     // signs to the left and above: 0 (both negative) to 4 (both positive)
    };
    // @param before   the array of the previous channel, or null
    Context at(std::size_t v, std::size_t u, const ResidualContexts* previous) const;
    void set(std::size_t v, std::size_t u, const Residual& residual);

  private:
    std::size_t width_;
    std::vector<std::int8_t> sizes_;
};

// Writes residuals. Writer and reader share code_residual(): a writer returns its argument, a reader the value that it
// reads.
class ResidualWriter {
  public:
    bool bit(coding::BitModel& model, bool value) {
        encoder.bit(model, value);
        return value;
    }
    std::uint32_t raw(std::uint32_t value, int count) {
        encoder.raw(value, count);
        return value;
    }
    coding::ArithmeticEncoder encoder;
};

class ResidualReader {
  public:
    explicit ResidualReader(std::span<const std::uint8_t> bytes) : decoder(bytes) {}
    bool bit(coding::BitModel& model, bool) { return decoder.bit(model); }
    std::uint32_t raw(std::uint32_t, int count) { return decoder.raw(count); }
    coding::ArithmeticDecoder decoder;
};

template <class Coder>
Residual code_residual(Coder& coder, ResidualModels& models, const ResidualContexts::Context& context,
                       const Residual& residual);
extern template Residual code_residual(ResidualWriter&, ResidualModels&, const ResidualContexts::Context&,
                                       const Residual&);
extern template Residual code_residual(ResidualReader&, ResidualModels&, const ResidualContexts::Context&,
                                       const Residual&);

}  // namespace hogel::codec::format
