// SPDX-License-Identifier: Apache-2.0
// Distributes arrays over threads; fft_engine.h transforms the lines.
#include "hogel/math/fft.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>

#include "hogel/error.h"
#include "hogel/math/column_fft.h"
#include "hogel/math/fft_engine.h"
#include "hogel/work/parallel.h"

namespace hogel::math {
namespace {

// Arrays of at least this size use all threads. Smaller arrays usually come in large numbers, each on one thread.
constexpr std::size_t large_array = std::size_t{1} << 16;
// Maximum size at which ColumnFft on one thread is fastest, if it supports the columns.
constexpr std::size_t max_by_columns = std::size_t{1} << 18;

// Calls transform(first, count) for blocks of adjacent lines, on all threads. A task has several blocks of short lines.
template <class Transform>
void for_blocks(std::size_t lines, std::size_t length, const Transform& transform) {
    constexpr std::size_t batch_lines = LineEngine::batch_lines, task_values = 16384;
    const std::size_t task_lines = std::max<std::size_t>(1, task_values / (batch_lines * length)) * batch_lines;
    work::parallel_for((lines + task_lines - 1) / task_lines, [&](std::size_t task) {
        const std::size_t end = std::min(lines, (task + 1) * task_lines);
        for (std::size_t first = task * task_lines; first < end; first += batch_lines)
            transform(first, std::min(batch_lines, end - first));
    });
}

void transform_rows(View<std::complex<float>, 2> values, const LineEngine& engine, bool forward) {
    for_blocks(values.extent(0), values.extent(1), [&](std::size_t first, std::size_t count) {
        engine.rows(forward, &values(first, 0), values.extent(1), count);
    });
}

void transform_columns(View<std::complex<float>, 2> values, const LineEngine& engine, bool forward) {
    for_blocks(values.extent(1), values.extent(0), [&](std::size_t first, std::size_t count) {
        engine.columns(forward, &values(0, first), values.extent(1), count);
    });
}

}  // namespace

struct Fft1::Plans {
    explicit Plans(std::size_t n) : engine(n) {}
    LineEngine engine;
};

Fft1::Fft1(std::size_t size) {
    if (size == 0 || size > INT32_MAX)
        throw Error(ErrorCode::usage, fmt::format("an FFT cannot have {} samples", size));
    plans_ = std::make_unique<Plans>(size);
}
Fft1::~Fft1() = default;
Fft1::Fft1(Fft1&&) noexcept = default;
Fft1& Fft1::operator=(Fft1&&) noexcept = default;

std::size_t Fft1::size() const { return plans_->engine.size(); }
void Fft1::forward(std::complex<float>* line) const { plans_->engine.line(true, line); }
void Fft1::backward(std::complex<float>* line) const { plans_->engine.line(false, line); }

void transform_rows(View<std::complex<float>, 2> values, const Fft1& fft, bool forward) {
    if (fft.size() != values.extent(1))
        throw Error(ErrorCode::internal,
                    fmt::format("FFT of rows of {} with a plan for {}", values.extent(1), fft.size()));
    transform_rows(values, fft.plans_->engine, forward);
}

void transform_columns(View<std::complex<float>, 2> values, const Fft1& fft, bool forward) {
    if (fft.size() != values.extent(0))
        throw Error(ErrorCode::internal,
                    fmt::format("FFT of columns of {} with a plan for {}", values.extent(0), fft.size()));
    transform_columns(values, fft.plans_->engine, forward);
}

struct Fft2::Plans {
    Plans(std::size_t h, std::size_t w) : height(h), width(w) {
        if (h * w <= max_by_columns && ColumnFft::can(h, w)) {
            small_array.emplace(h, w, SmallArrayEngine::Axes::rows);
            column_fft.emplace(h);
        } else if (h * w >= large_array) {
            if (w > 1) rows.emplace(w);
            if (h > 1) columns.emplace(h);
        } else {
            small_array.emplace(h, w, SmallArrayEngine::Axes::both);
        }
    }
    void run(bool forward, View<std::complex<float>, 2> values, std::complex<float>* to, std::size_t to_row) const {
        if (values.extent(0) != height || values.extent(1) != width)
            throw Error(ErrorCode::internal, fmt::format("FFT of {}x{} values with a plan for {}x{}", values.extent(0),
                                                         values.extent(1), height, width));
        if (small_array) {
            small_array->run(forward, values.data());
            if (column_fft) return column_fft->transform(forward, values.data(), width, to, to_row, width);
        } else {
            if (rows) transform_rows(values, *rows, forward);
            if (columns) transform_columns(values, *columns, forward);
        }
        if (to == values.data() && to_row == width) return;
        for (std::size_t y = 0; y < height; ++y) std::copy_n(&values(y, 0), width, to + y * to_row);
    }

    std::size_t height, width;
    std::optional<SmallArrayEngine> small_array;  // for a small array, or only its rows
    std::optional<ColumnFft> column_fft;          // for the columns, if `small_array` transforms only rows
    std::optional<LineEngine> rows, columns;      // for a large array
};

Fft2::Fft2(std::size_t height, std::size_t width) {
    if (height == 0 || width == 0 || height > INT32_MAX || width > INT32_MAX)
        throw Error(ErrorCode::usage, fmt::format("an FFT cannot have {}x{} samples", width, height));
    plans_ = std::make_unique<Plans>(height, width);
}
Fft2::~Fft2() = default;
Fft2::Fft2(Fft2&&) noexcept = default;
Fft2& Fft2::operator=(Fft2&&) noexcept = default;

void Fft2::forward(View<std::complex<float>, 2> values) const { plans_->run(true, values, values.data(), width()); }
void Fft2::backward(View<std::complex<float>, 2> values) const { backward(values, values.data(), width()); }
void Fft2::backward(View<std::complex<float>, 2> values, std::complex<float>* to, std::size_t to_row) const {
    plans_->run(false, values, to, to_row);
}
std::size_t Fft2::height() const { return plans_->height; }
std::size_t Fft2::width() const { return plans_->width; }

std::size_t good_fft_size(std::size_t n) {
    for (;; ++n) {
        std::size_t rest = n > 0 ? n : 1;
        for (std::size_t prime : {2, 3, 5, 7})
            while (rest % prime == 0) rest /= prime;
        if (rest == 1 && n > 0) return n;
    }
}

}  // namespace hogel::math
