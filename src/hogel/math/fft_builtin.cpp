// SPDX-License-Identifier: Apache-2.0
// hogel's own Fourier transforms. The method for a line depends only on its length, never on the number of lines.
#ifndef HOGEL_FFTW
#include <algorithm>
#include <mutex>
#include <optional>

#include "hogel/array.h"
#include "hogel/core/thread_buffer.h"
#include "hogel/math/fft_engine.h"
#include "hogel/math/fourier/plain.h"
#include "hogel/math/fourier/plan.h"

namespace hogel::math {
namespace {

// Maximum length at which sixteen rows are transformed as a batch: sixteen lines fit into the second-level cache.
constexpr std::size_t max_batch_rows = 4096;
// Rows whose length is a multiple of this begin in the same cache sets and are transformed one after the other.
constexpr std::size_t same_cache_sets = 512;
// Minimum length of a single line that is transformed as an array.
constexpr std::size_t min_split = 24;

float* floats(std::complex<float>* p) { return reinterpret_cast<float*>(p); }

}  // namespace

struct LineEngine::Plans {
    explicit Plans(std::size_t n) : size(n), convolved(n) {
        if (!fourier::is_smooth(n)) {
            convolved = fourier::convolution_length(2 * n - 1);
            chirp.emplace(n, convolved);
        }
        if (convolved >= min_split) split.emplace(convolved);
    }

    void plain(bool forward, std::complex<float>* line, std::size_t stride) const {
        const core::ThreadBuffer<std::complex<float>> copy(size);
        const auto exchanged = [&](std::complex<float> x) {
            return forward ? x : std::complex<float>(x.imag(), x.real());
        };
        for (std::size_t i = 0; i < size; ++i) copy[i] = exchanged(line[i * stride]);
        fourier::transform_plain({copy.data(), size});
        for (std::size_t i = 0; i < size; ++i) line[i * stride] = exchanged(copy[i]);
    }

    // Copies a line in memory (not in a near cache) first: sequential reads are faster than reads by columns.
    void line(bool forward, std::complex<float>* values, bool in_memory) const {
        if (!fourier::has_vectors()) return plain(forward, values, 1);
        if (!split)
            return fourier::transform_lines(batch_plan(), chirp_or_none(), !forward, floats(values), 0, 1, size);
        const core::ThreadBuffer<std::complex<float>> buffer(in_memory || chirp ? convolved : 0);
        std::complex<float>* const copy = in_memory || chirp ? buffer.data() : values;
        if (!chirp) {
            if (in_memory) std::copy_n(values, size, copy);
            return fourier::transform_split(*split, !forward, floats(copy), floats(values));
        }
        fourier::multiply(floats(values), chirp->chirp.data(), floats(copy), size, !forward, false);
        std::fill(copy + size, copy + convolved, 0.0f);
        fourier::transform_split(*split, false, floats(copy), floats(copy));
        fourier::multiply(floats(copy), chirp->spectrum.data(), floats(copy), convolved, false, true);
        fourier::transform_split(*split, false, floats(copy), floats(copy));
        fourier::multiply(floats(copy), chirp->chirp.data(), floats(values), size, true, !forward);
    }

    // Plan for batches of lines; created when first needed.
    const fourier::Plan& batch_plan() const {
        std::call_once(planned_, [&] { batch_plan_.emplace(convolved); });
        return *batch_plan_;
    }
    const fourier::Chirp* chirp_or_none() const { return chirp ? &*chirp : nullptr; }

    std::size_t size, convolved;  // length of the lines, and of their convolution if they need one
    std::optional<fourier::Chirp> chirp;
    std::optional<fourier::Split> split;

  private:
    mutable std::once_flag planned_;
    mutable std::optional<fourier::Plan> batch_plan_;
};

LineEngine::LineEngine(std::size_t size) : plans_(std::make_unique<Plans>(size)) {}
LineEngine::~LineEngine() = default;
LineEngine::LineEngine(LineEngine&&) noexcept = default;
LineEngine& LineEngine::operator=(LineEngine&&) noexcept = default;

std::size_t LineEngine::size() const { return plans_->size; }
void LineEngine::line(bool forward, std::complex<float>* line) const { plans_->line(forward, line, false); }

void LineEngine::rows(bool forward, std::complex<float>* lines, std::size_t stride, std::size_t count) const {
    const Plans& plans = *plans_;
    const bool in_batches = plans.convolved <= max_batch_rows && plans.size % same_cache_sets != 0;
    if (in_batches && fourier::has_vectors())
        return fourier::transform_lines(plans.batch_plan(), plans.chirp_or_none(), !forward, floats(lines), 2 * stride,
                                        count, plans.size);
    for (std::size_t i = 0; i < count; ++i) plans.line(forward, lines + i * stride, true);
}

void LineEngine::columns(bool forward, std::complex<float>* columns, std::size_t row, std::size_t count) const {
    const Plans& plans = *plans_;
    const std::size_t size = plans.size;
    if (!fourier::has_vectors()) {
        for (std::size_t i = 0; i < count; ++i) plans.plain(forward, columns + i, row);
    } else {
        fourier::transform_columns(plans.batch_plan(), plans.chirp_or_none(), !forward, floats(columns), 2 * row,
                                   floats(columns), 2 * row, count, size);
    }
}

struct SmallArrayEngine::Plans {
    Plans(std::size_t h, std::size_t w, Axes axes) : height(h), width(w), rows(w) {
        if (axes == Axes::both && h > 1) columns.emplace(h);
    }
    std::size_t height, width;
    LineEngine rows;
    std::optional<LineEngine> columns;
};

SmallArrayEngine::SmallArrayEngine(std::size_t height, std::size_t width, Axes axes)
    : plans_(std::make_unique<Plans>(height, width, axes)) {}
SmallArrayEngine::~SmallArrayEngine() = default;
SmallArrayEngine::SmallArrayEngine(SmallArrayEngine&&) noexcept = default;
SmallArrayEngine& SmallArrayEngine::operator=(SmallArrayEngine&&) noexcept = default;

void SmallArrayEngine::run(bool forward, std::complex<float>* values) const {
    const Plans& plans = *plans_;
    const std::size_t height = plans.height, width = plans.width;
    if (height == 1) return plans.rows.line(forward, values);
    for (std::size_t y = 0; y < height; y += LineEngine::batch_lines)
        plans.rows.rows(forward, values + y * width, width, std::min(LineEngine::batch_lines, height - y));
    if (!plans.columns) return;
    for (std::size_t x = 0; x < width; x += LineEngine::batch_lines)
        plans.columns->columns(forward, values + x, width, std::min(LineEngine::batch_lines, width - x));
}

}  // namespace hogel::math
#endif
