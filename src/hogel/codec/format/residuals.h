// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hogel/coding/arithmetic.h"

namespace hogel::codec::format {

// What a sample is told beside its prediction: a whole number, or that it is special, which the coder knows the
// meaning of.
struct Residual {
    std::int32_t number = 0;
    bool special = false;
};

// Adaptive models of residuals: of how many bits a number has, by how many those around it have.
struct ResidualModels {
    static constexpr std::size_t sizes = 34, special = 33;  // numbers of 0 to 32 bits; special
    std::array<std::array<std::array<coding::BitModel, 64>, sizes>, 3> size;
    std::array<coding::BitModel, 5> sign;
    std::array<std::array<coding::BitModel, 4>, sizes> below_highest;
};

// The sizes of the residuals of an array [v][u] so far, negative for negative numbers.
class ResidualsAround {
  public:
    ResidualsAround(std::size_t width, std::size_t height) : width_(width), of_(width * height) {}

    struct Context {
        std::size_t special, mean;  // how many are special on the left and above; the mean size of the others
        std::size_t sign;           // 0 to 4, from both negative to both positive
    };
    // @param before   the array before this one, if there is one
    Context at(std::size_t v, std::size_t u, const ResidualsAround* before) const;
    void set(std::size_t v, std::size_t u, const Residual& residual);

  private:
    std::size_t width_;
    std::vector<std::int8_t> of_;
};

// One function for both: a writer returns what it is given, a reader what it reads.
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
Residual code_residual(Coder& coder, ResidualModels& models, const ResidualsAround::Context& context,
                       const Residual& residual);
extern template Residual code_residual(ResidualWriter&, ResidualModels&, const ResidualsAround::Context&,
                                       const Residual&);
extern template Residual code_residual(ResidualReader&, ResidualModels&, const ResidualsAround::Context&,
                                       const Residual&);

}  // namespace hogel::codec::format
