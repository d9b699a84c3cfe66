// SPDX-License-Identifier: Apache-2.0
// Compiled for every SIMD target and dispatched at run time. The reference version is plain.cpp.
#include <algorithm>

#include "hogel/array.h"
#include "hogel/core/simd_targets-inl.h"
#include "hogel/math/fourier/butterflies-inl.h"
#include "hogel/math/fourier/passes-inl.h"
#include "hogel/math/fourier/plan.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::math::fourier::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
bool HasVectors() { return false; }
void Columns(const Plan&, const Chirp*, bool, const float*, std::size_t, float*, std::size_t, std::size_t,
             std::size_t) {}
void Lines(const Plan&, const Chirp*, bool, float*, std::size_t, std::size_t, std::size_t) {}
void LongLine(const Split&, bool, const float*, float*) {}
void Multiply(const float*, const float*, float*, std::size_t, bool, bool) {}
void InPlace(const Plan&, float*) {}
#else
bool HasVectors() { return true; }

// Memory for rows in split layout. The thread keeps up to 8 MB for its next transform.
template <int which>
class Scratch {
  public:
    explicit Scratch(std::size_t rows) {
        thread_local Array<float, 1> kept;
        Array<float, 1>& memory = rows <= max_kept ? kept : large_;
        if (memory.size() < rows * split_row) memory = Array<float, 1>({rows * split_row});
        data_ = memory.data();
    }
    float* data() { return data_; }

  private:
    static constexpr std::size_t max_kept = std::size_t{1} << 16;
    Array<float, 1> large_;
    float* data_;
};

// Copies `columns` complex numbers of each row to or from rows of `batch_lines`.
void CopyRows(const float* from, std::size_t from_row, float* to, std::size_t to_row, std::size_t rows,
              std::size_t columns) {
    for (std::size_t row = 0; row < rows; ++row) std::copy_n(from + row * from_row, 2 * columns, to + row * to_row);
}

template <class Layout>
void ColumnsAs(const Plan& plan, const Chirp* chirp, const float* from, std::size_t from_row, float* to,
               std::size_t to_row, std::size_t columns, std::size_t length) {
    const D d;
    Source source{from, from_row};
    Sink sink{to, to_row, plan.frequency.data()};
    const bool is_partial = columns < batch_lines;
    Scratch<0> padded(is_partial ? length : 0);
    if (is_partial) {
        CopyRows(from, from_row, padded.data(), split_row, length, columns);
        source = {padded.data(), split_row};
        sink.data = padded.data(), sink.row = split_row;
    }
    Scratch<1> memory(plan.length);
    float* scratch = memory.data();
    if (!chirp) {
        TransformRows<Layout, Layout>(plan, source, scratch, sink, columns);
    } else {
        for (std::size_t row = 0; row < length; ++row)
            for (std::size_t i = 0; i < batch_lines; i += hn::Lanes(d))
                InSplit::Store(d, Layout::Load(d, source.data + row * source.row, i), scratch + row * split_row, i);
        Scratch<2> second_memory(plan.length);
        float* result = second_memory.data();
        Convolve(plan, *chirp, length, scratch, result, columns);
        for (std::size_t row = 0; row < length; ++row)
            for (std::size_t i = 0; i < batch_lines; i += hn::Lanes(d))
                Layout::Store(d, InSplit::Load(d, result + plan.position[row] * split_row, i),
                              sink.data + row * sink.row, i);
    }
    if (is_partial) CopyRows(sink.data, split_row, to, to_row, length, columns);
}

void Columns(const Plan& plan, const Chirp* chirp, bool backward, const float* from, std::size_t from_row, float* to,
             std::size_t to_row, std::size_t columns, std::size_t length) {
    if (backward)
        ColumnsAs<Exchanged>(plan, chirp, from, from_row, to, to_row, columns, length);
    else
        ColumnsAs<Interleaved>(plan, chirp, from, from_row, to, to_row, columns, length);
}

// Copy lines between memory and the split layout. Position j is row j, or row position[j].
template <bool exchange>
void LinesToRows(const float* const* lines, std::size_t length, float* rows, std::size_t lanes) {
    const D d;
    alignas(16) float ends[batch_lines][4] = {};
    const float* last[batch_lines];
    for (std::size_t l = 0; l < batch_lines; ++l) {
        std::copy_n(lines[l] + 2 * (length - 1), 2, ends[l]);
        last[l] = ends[l];
    }
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        Numbers first, second;
        std::size_t j = 0;
        for (; j + 1 < length; j += 2) {
            TransposePair(d, lines + i, 2 * j, first, second);
            InSplit::Store(d, ExchangedIf(exchange, first), rows + j * split_row, i);
            InSplit::Store(d, ExchangedIf(exchange, second), rows + (j + 1) * split_row, i);
        }
        if (j == length) continue;
        TransposePair(d, last + i, 0, first, second);
        InSplit::Store(d, ExchangedIf(exchange, first), rows + j * split_row, i);
    }
}
template <bool exchange>
void LinesFromRows(const float* rows, const std::uint32_t* position, std::size_t length, float* const* lines,
                   std::size_t lanes, std::size_t count) {
    const D d;
    const auto row = [&](std::size_t j, std::size_t i) {
        return ExchangedIf(exchange, InSplit::Load(d, rows + position[j] * split_row, i));
    };
    alignas(16) float ends[batch_lines][4] = {};
    float* last[batch_lines];
    for (std::size_t l = 0; l < batch_lines; ++l) last[l] = ends[l];
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        for (std::size_t j = 0; j + 1 < length; j += 2)
            TransposePairBack(d, row(j, i), row(j + 1, i), lines + i, 2 * j);
        if (length % 2 == 1) TransposePairBack(d, row(length - 1, i), row(length - 1, i), last + i, 0);
    }
    if (length % 2 == 1)
        for (std::size_t l = 0; l < count; ++l) std::copy_n(ends[l], 2, lines[l] + 2 * (length - 1));
}

// Copy a single short line between memory and all lanes.
template <bool exchange>
void OneLineToRows(const float* line, std::size_t length, float* rows, std::size_t lanes) {
    const D d;
    for (std::size_t j = 0; j < length; ++j)
        for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
            const Numbers x{hn::Set(d, line[2 * j]), hn::Set(d, line[2 * j + 1])};
            InSplit::Store(d, ExchangedIf(exchange, x), rows + j * split_row, i);
        }
}
template <bool exchange>
void OneLineFromRows(const float* rows, const std::uint32_t* position, std::size_t length, float* line) {
    constexpr std::size_t re = exchange ? batch_lines : 0, im = exchange ? 0 : batch_lines;
    for (std::size_t j = 0; j < length; ++j) {
        line[2 * j] = rows[position[j] * split_row + re];
        line[2 * j + 1] = rows[position[j] * split_row + im];
    }
}

template <bool exchange>
void LinesAs(const Plan& plan, const Chirp* chirp, float* lines, std::size_t stride, std::size_t count,
             std::size_t length) {
    const D d;
    const std::size_t lanes = (count + hn::Lanes(d) - 1) / hn::Lanes(d) * hn::Lanes(d);
    // Lanes beyond `count` repeat the first line; their results are discarded.
    const float* from[batch_lines];
    float* to[batch_lines];
    Scratch<0> discarded(length / batch_lines + 1);
    for (std::size_t l = 0; l < batch_lines; ++l) {
        from[l] = lines + (l < count ? l : 0) * stride;
        to[l] = l < count ? lines + l * stride : discarded.data();
    }
    Scratch<1> memory(plan.length);
    Scratch<2> second_memory(chirp ? plan.length : 0);
    float* scratch = memory.data();
    if (count == 1)
        OneLineToRows<exchange>(lines, length, scratch, lanes);
    else
        LinesToRows<exchange>(from, length, scratch, lanes);
    const float* result = scratch;
    if (chirp) {
        Convolve(plan, *chirp, length, scratch, second_memory.data(), count);
        result = second_memory.data();
    } else {
        TransformInPlace(plan, scratch, count);
    }
    if (count == 1)
        OneLineFromRows<exchange>(result, plan.position.data(), length, lines);
    else
        LinesFromRows<exchange>(result, plan.position.data(), length, to, lanes, count);
}

void Lines(const Plan& plan, const Chirp* chirp, bool backward, float* lines, std::size_t stride, std::size_t count,
           std::size_t length) {
    if (backward)
        LinesAs<true>(plan, chirp, lines, stride, count, length);
    else
        LinesAs<false>(plan, chirp, lines, stride, count, length);
}

// Multiplies transformed columns by their twiddle factors and transposes them: frequency f of column b goes from row
// position[f] to [f/16][b][part][f mod 16].
void TwiddleAndTranspose(const Split& split, const float* columns, std::size_t block, std::size_t count, float* rows) {
    const D d;
    const std::size_t across = split.across.length, down = split.down.length;
    alignas(64) float products[4][split_row] = {};
    const float* const pointers[] = {products[0], products[1], products[2], products[3]};
    alignas(16) float transposed[16];
    for (std::size_t p = 0; p < down; p += 4) {
        for (std::size_t k = 0; k < std::min<std::size_t>(4, down - p); ++k) {
            const float* x = columns + split.down.position[p + k] * split_row;
            const float* w = split.twiddles.data() + ((p + k) * split.blocks_across() + block) * split_row;
            for (std::size_t i = 0; i < batch_lines; i += hn::Lanes(d))
                InSplit::Store(d, Times(InSplit::Load(d, x, i), hn::Load(d, w + i), hn::Load(d, w + batch_lines + i)),
                               products[k], i);
        }
        float* to = rows + (p / batch_lines * across + block * batch_lines) * split_row + p % batch_lines;
        for (std::size_t b = 0; b < count; b += 4)
            for (const std::size_t part : {std::size_t{0}, batch_lines}) {
                if (b + 4 <= count) {
                    TransposeFour(pointers, b + part, to + b * split_row + part, split_row);
                } else {
                    TransposeFour(pointers, b + part, transposed, 4);
                    for (std::size_t i = b; i < count; ++i)
                        std::copy_n(transposed + 4 * (i - b), 4, to + i * split_row + part);
                }
            }
    }
}

template <class Layout>
void LongLineAs(const Split& split, const float* from, float* to) {
    const std::size_t across = split.across.length, down = split.down.length;
    Scratch<0> memory_padded(std::max(across, down));
    Scratch<1> memory_columns(down);
    Scratch<2> memory_rows(split.blocks_down() * across);
    float *padded = memory_padded.data(), *columns = memory_columns.data(), *rows = memory_rows.data();
    for (std::size_t block = 0; block < split.blocks_across(); ++block) {
        const std::size_t count = std::min(batch_lines, across - block * batch_lines);
        Source source{from + block * split_row, 2 * across};
        if (count < batch_lines) {
            CopyRows(source.data, source.row, padded, split_row, down, count);
            source = {padded, split_row};
        }
        TransformRows<Layout, InSplit>(split.down, source, columns, {columns, split_row, nullptr}, count);
        TwiddleAndTranspose(split, columns, block, count, rows);
    }
    for (std::size_t block = 0; block < split.blocks_down(); ++block) {
        const std::size_t count = std::min(batch_lines, down - block * batch_lines);
        float* in = rows + block * across * split_row;
        Sink sink{to + block * split_row, 2 * down, split.across.frequency.data()};
        if (count < batch_lines) sink.data = padded, sink.row = split_row;
        TransformRows<InSplit, Layout>(split.across, {in, split_row}, in, sink, count);
        if (count < batch_lines) CopyRows(padded, split_row, to + block * split_row, 2 * down, across, count);
    }
}

void InPlace(const Plan& plan, float* rows) { TransformInPlace(plan, rows, batch_lines); }

void LongLine(const Split& split, bool backward, const float* from, float* to) {
    if (backward)
        LongLineAs<Exchanged>(split, from, to);
    else
        LongLineAs<Interleaved>(split, from, to);
}

void Multiply(const float* x, const float* y, float* out, std::size_t n, bool exchange_x, bool exchange_out) {
    const D d;
    const auto multiply_vectors = [&](const float* a, const float* b, float* to) {
        Numbers value, factor;
        hn::LoadInterleaved2(d, a, value.re, value.im);
        hn::LoadInterleaved2(d, b, factor.re, factor.im);
        if (exchange_x) std::swap(value.re, value.im);
        value = Times(value, factor.re, factor.im);
        if (exchange_out) std::swap(value.re, value.im);
        hn::StoreInterleaved2(value.re, value.im, d, to);
    };
    std::size_t i = 0;
    for (; i + hn::Lanes(d) <= n; i += hn::Lanes(d)) multiply_vectors(x + 2 * i, y + 2 * i, out + 2 * i);
    if (i == n) return;
    float a[split_row] = {}, b[split_row] = {};
    std::copy_n(x + 2 * i, 2 * (n - i), a);
    std::copy_n(y + 2 * i, 2 * (n - i), b);
    multiply_vectors(a, b, a);
    std::copy_n(a, 2 * (n - i), out + 2 * i);
}
#endif

}  // namespace hogel::math::fourier::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::math::fourier {
HOGEL_DISPATCH(has_vectors, HasVectors);
HOGEL_DISPATCH(transform_columns, Columns);
HOGEL_DISPATCH(transform_lines, Lines);
HOGEL_DISPATCH(transform_split, LongLine);
HOGEL_DISPATCH(transform_in_place, InPlace);
HOGEL_DISPATCH(multiply, Multiply);
}  // namespace hogel::math::fourier
