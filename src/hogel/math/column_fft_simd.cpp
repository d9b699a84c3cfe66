#include <algorithm>

// Compiled for every instruction set and chosen when first called. Its plain twin is FFTW.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/math/column_fft_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "hogel/core/array.h"
#include "hogel/math/column_fft_internal.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
bool HasVectors() { return false; }
void TransformColumns(const ColumnFft::Plan&, bool, const float*, std::size_t, float*, std::size_t, std::size_t) {}
#else
bool HasVectors() { return true; }

// Vectors hold numbers with their two parts side by side.
using D = hn::CappedTag<float, 2 * ColumnFft::together>;
using V = hn::Vec<D>;

HWY_INLINE V Times(D d, V x, const ColumnFft::Factor& factor) {
    return hn::MulAdd(hn::Reverse2(d, x), hn::LoadDup128(d, factor.im), hn::Mul(x, hn::LoadDup128(d, factor.re)));
}

struct Four {
    V a, b, c, d;
};

// @param quarter  i backward and −i forward, as a factor's im
HWY_INLINE Four Butterfly(D d, const Four& x, V quarter) {
    const V sum_ac = hn::Add(x.a, x.c), difference_ac = hn::Sub(x.a, x.c);
    const V sum_bd = hn::Add(x.b, x.d), turned = hn::Mul(hn::Reverse2(d, hn::Sub(x.b, x.d)), quarter);
    return {hn::Add(sum_ac, sum_bd), hn::Add(difference_ac, turned), hn::Sub(sum_ac, sum_bd),
            hn::Sub(difference_ac, turned)};
}

// One block of columns. The first step reads them where they are, the last one writes them where they go.
void TransformBlock(const ColumnFft::Plan& plan, bool forward, const float* from, std::size_t from_row, float* to,
                    std::size_t to_row, std::size_t floats, float* room) {
    const D d;
    const std::size_t lanes = hn::Lanes(d), n = plan.length;
    HWY_ALIGN const float turns[2][4] = {{-1, 1, -1, 1}, {1, -1, 1, -1}};
    const V quarter = hn::LoadDup128(d, turns[forward ? 1 : 0]);
    const ColumnFft::Factor* factors = plan.factors[forward ? 1 : 0].data();
    const float* in = from;
    std::size_t in_row = from_row;
    std::size_t length = n;
    for (; length > 4; length /= 4) {
        const std::size_t part = length / 4;
        for (std::size_t group = 0; group < n; group += length)
            for (std::size_t j = 0; j < part; ++j) {
                const ColumnFft::Factor* w = factors + 3 * j;
                const float* x = in + (group + j) * in_row;
                float* y = room + (group + j) * floats;
                for (std::size_t i = 0; i < floats; i += lanes) {
                    const Four four =
                        Butterfly(d,
                                  {hn::LoadU(d, x + i), hn::LoadU(d, x + part * in_row + i),
                                   hn::LoadU(d, x + 2 * part * in_row + i), hn::LoadU(d, x + 3 * part * in_row + i)},
                                  quarter);
                    hn::Store(four.a, d, y + i);
                    hn::Store(Times(d, four.b, w[0]), d, y + part * floats + i);
                    hn::Store(Times(d, four.c, w[1]), d, y + 2 * part * floats + i);
                    hn::Store(Times(d, four.d, w[2]), d, y + 3 * part * floats + i);
                }
            }
        factors += 3 * part;
        in = room;
        in_row = floats;
    }
    const auto put = [&](V value, std::size_t place, std::size_t i) {
        hn::StoreU(value, d, to + plan.order[place] * to_row + i);
    };
    for (std::size_t row = 0; row < n; row += length)
        for (std::size_t i = 0; i < floats; i += lanes) {
            const float* x = room + row * floats + i;
            if (length == 4) {
                const Four four = Butterfly(
                    d,
                    {hn::Load(d, x), hn::Load(d, x + floats), hn::Load(d, x + 2 * floats), hn::Load(d, x + 3 * floats)},
                    quarter);
                put(four.a, row, i);
                put(four.b, row + 1, i);
                put(four.c, row + 2, i);
                put(four.d, row + 3, i);
            } else {
                const V a = hn::Load(d, x), b = hn::Load(d, x + floats);
                put(hn::Add(a, b), row, i);
                put(hn::Sub(a, b), row + 1, i);
            }
        }
}

void TransformColumns(const ColumnFft::Plan& plan, bool forward, const float* from, std::size_t from_row, float* to,
                      std::size_t to_row, std::size_t floats) {
    const std::size_t block = plan.length > 128 ? 2 * ColumnFft::together : 4 * ColumnFft::together;
    thread_local Array<float, 1> room;
    if (room.size() < plan.length * block) room = Array<float, 1>({plan.length * block});
    for (std::size_t i = 0; i < floats; i += block)
        TransformBlock(plan, forward, from + i, from_row, to + i, to_row, std::min(block, floats - i), room.data());
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <bit>
#include <cmath>
#include <numbers>

namespace hogel {
namespace {

ColumnFft::Factor factor_of(double turns) {
    const auto re = static_cast<float>(std::cos(2 * std::numbers::pi * turns));
    const auto im = static_cast<float>(std::sin(2 * std::numbers::pi * turns));
    return {{re, re, re, re}, {-im, im, -im, im}};
}

}  // namespace

HWY_EXPORT(HasVectors);
HWY_EXPORT(TransformColumns);

bool ColumnFft::can(std::size_t length, std::size_t columns) {
    return length >= shortest && std::has_single_bit(length) && columns > 0 && columns % together == 0 &&
           HWY_DYNAMIC_DISPATCH(HasVectors)();
}

ColumnFft::ColumnFft(std::size_t length) : plan_{length, {0}, {}} {
    std::size_t rest = length;
    for (; rest > 4; rest /= 4)
        for (std::size_t j = 0; j < rest / 4; ++j)
            for (std::size_t k = 1; k < 4; ++k) {
                const double turns = static_cast<double>(j * k) / static_cast<double>(rest);
                plan_.factors[0].push_back(factor_of(turns));
                plan_.factors[1].push_back(factor_of(-turns));
            }
    // A step puts the frequencies that leave the remainder k when divided by four into the part k; so the places within
    // a part, last step first, are followed by those of the other parts.
    std::size_t parts = 1;
    for (std::size_t step = rest;; step = 4) {
        std::vector<std::uint32_t> order;
        for (std::size_t k = 0; k < step; ++k)
            for (const std::uint32_t place : plan_.order) order.push_back(static_cast<std::uint32_t>(k + step * place));
        plan_.order = std::move(order);
        parts *= step;
        if (parts == length) break;
    }
}

void ColumnFft::transform(bool forward, const std::complex<float>* from, std::size_t from_row, std::complex<float>* to,
                          std::size_t to_row, std::size_t columns) const {
    HWY_DYNAMIC_DISPATCH(TransformColumns)
    (plan_, forward, reinterpret_cast<const float*>(from), 2 * from_row, reinterpret_cast<float*>(to), 2 * to_row,
     2 * columns);
}

}  // namespace hogel
#endif
