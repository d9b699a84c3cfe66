// SPDX-License-Identifier: Apache-2.0
// The only file that depends on the FFT library, which may be any with FFTW's single-precision interface.
#include "hogel/math/fft.h"

#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <optional>

#include "hogel/core/parallel.h"
#include "hogel/error.h"
#include "hogel/math/column_fft.h"

namespace hogel::math {
namespace {

// FFTW's planner keeps global tables; only execution is thread-safe.
std::mutex& planner() {
    static std::mutex mutex;
    return mutex;
}

fftwf_complex* fftw(std::complex<float>* p) { return reinterpret_cast<fftwf_complex*>(p); }

// Plans for both directions, for aligned and for unaligned data.
class Directions {
  public:
    // make(scratch, sign, flags) plans an in-place transform of that many values.
    template <class Make>
    Directions(std::size_t values, Make make) {
        Array<std::complex<float>, 1> scratch({values});
        const std::lock_guard lock(planner());
        alignment_ = fftwf_alignment_of(reinterpret_cast<float*>(scratch.data()));
        for (int i = 0; i < 2; ++i) {
            const int sign = i == 0 ? FFTW_FORWARD : FFTW_BACKWARD;
            aligned_[i] = make(fftw(scratch.data()), sign, FFTW_ESTIMATE);
            unaligned_[i] = make(fftw(scratch.data()), sign, FFTW_ESTIMATE | FFTW_UNALIGNED);
        }
    }
    ~Directions() {
        const std::lock_guard lock(planner());
        for (int i = 0; i < 2; ++i) {
            fftwf_destroy_plan(aligned_[i]);
            fftwf_destroy_plan(unaligned_[i]);
        }
    }
    Directions(const Directions&) = delete;
    Directions& operator=(const Directions&) = delete;

    void run(bool forward, std::complex<float>* values) const {
        const bool fits = fftwf_alignment_of(reinterpret_cast<float*>(values)) == alignment_;
        fftwf_execute_dft((fits ? aligned_ : unaligned_)[forward ? 0 : 1], fftw(values), fftw(values));
    }

  private:
    int alignment_ = 0;
    fftwf_plan aligned_[2], unaligned_[2];
};

// Arrays from this size on are transformed line by line on all threads. Smaller ones are usually many, each transformed
// by one thread.
constexpr std::size_t large_array = std::size_t{1} << 16;
// Up to this size one thread is fastest, if ColumnFft supports the columns.
constexpr std::size_t max_by_columns = std::size_t{1} << 18;
// Lines copied together into a buffer, so that columns are read by whole cache lines.
constexpr std::size_t lines_together = 16;

}  // namespace

struct Fft1::Plans {
    explicit Plans(std::size_t n)
        : size(n), directions(n, [&](fftwf_complex* p, int sign, unsigned flags) {
              return fftwf_plan_dft_1d(static_cast<int>(n), p, p, sign, flags);
          }) {}
    std::size_t size;
    Directions directions;
};

Fft1::Fft1(std::size_t size) {
    if (size == 0 || size > INT32_MAX)
        throw Error(ErrorCode::usage, fmt::format("an FFT cannot have {} samples", size));
    plans_ = std::make_unique<Plans>(size);
}
Fft1::~Fft1() = default;
Fft1::Fft1(Fft1&&) noexcept = default;
Fft1& Fft1::operator=(Fft1&&) noexcept = default;

std::size_t Fft1::size() const { return plans_->size; }
void Fft1::forward(std::complex<float>* line) const { plans_->directions.run(true, line); }
void Fft1::backward(std::complex<float>* line) const { plans_->directions.run(false, line); }

void transform_rows(View<std::complex<float>, 2> values, const Fft1& fft, bool forward) {
    const std::size_t height = values.extent(0), width = values.extent(1);
    if (fft.size() != width)
        throw Error(ErrorCode::internal, fmt::format("FFT of rows of {} with a plan for {}", width, fft.size()));
    core::parallel_for((height + lines_together - 1) / lines_together, [&](std::size_t block) {
        Array<std::complex<float>, 1> line({width});
        for (std::size_t y = block * lines_together; y < std::min((block + 1) * lines_together, height); ++y) {
            std::copy_n(&values(y, 0), width, line.data());
            forward ? fft.forward(line.data()) : fft.backward(line.data());
            std::copy_n(line.data(), width, &values(y, 0));
        }
    });
}

void transform_columns(View<std::complex<float>, 2> values, const Fft1& fft, bool forward) {
    const std::size_t height = values.extent(0), width = values.extent(1);
    if (fft.size() != height)
        throw Error(ErrorCode::internal, fmt::format("FFT of columns of {} with a plan for {}", height, fft.size()));
    // Padding, so that the lines do not all begin in the same cache sets.
    const std::size_t stride = (height + 15) / 8 * 8;
    core::parallel_for((width + lines_together - 1) / lines_together, [&](std::size_t block) {
        const std::size_t x0 = block * lines_together, columns = std::min(lines_together, width - x0);
        Array<std::complex<float>, 2> lines({columns, stride});
        for (std::size_t y = 0; y < height; ++y)
            for (std::size_t i = 0; i < columns; ++i) lines.data()[i * stride + y] = (&values(y, x0))[i];
        for (std::size_t i = 0; i < columns; ++i) forward ? fft.forward(&lines(i, 0)) : fft.backward(&lines(i, 0));
        for (std::size_t y = 0; y < height; ++y)
            for (std::size_t i = 0; i < columns; ++i) (&values(y, x0))[i] = lines.data()[i * stride + y];
    });
}

struct Fft2::Plans {
    Plans(std::size_t h, std::size_t w) : height(h), width(w) {
        if (h * w <= max_by_columns && ColumnFft::can(h, w)) {
            whole.emplace(h * w, [&](fftwf_complex* p, int sign, unsigned flags) {
                const int length = static_cast<int>(w);
                return fftwf_plan_many_dft(1, &length, static_cast<int>(h), p, nullptr, 1, length, p, nullptr, 1,
                                           length, sign, flags);
            });
            column_fft.emplace(h);
        } else if (h * w >= large_array) {
            rows.emplace(w);
            columns.emplace(h);
        } else {
            whole.emplace(h * w, [&](fftwf_complex* p, int sign, unsigned flags) {
                return fftwf_plan_dft_2d(static_cast<int>(h), static_cast<int>(w), p, p, sign, flags);
            });
        }
    }
    void run(bool forward, View<std::complex<float>, 2> values, std::complex<float>* to, std::size_t to_row) const {
        if (values.extent(0) != height || values.extent(1) != width)
            throw Error(ErrorCode::internal, fmt::format("FFT of {}x{} values with a plan for {}x{}", values.extent(0),
                                                         values.extent(1), height, width));
        if (whole) {
            whole->run(forward, values.data());
            if (column_fft) return column_fft->transform(forward, values.data(), width, to, to_row, width);
        } else {
            transform_rows(values, *rows, forward);
            transform_columns(values, *columns, forward);
        }
        if (to == values.data() && to_row == width) return;
        for (std::size_t y = 0; y < height; ++y) std::copy_n(&values(y, 0), width, to + y * to_row);
    }

    std::size_t height, width;
    std::optional<Directions> whole;      // for a small array, or only its rows
    std::optional<ColumnFft> column_fft;  // for the columns, if `whole` transforms only rows
    std::optional<Fft1> rows, columns;    // for a large array
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
