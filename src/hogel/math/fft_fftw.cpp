// SPDX-License-Identifier: Apache-2.0
// Fourier transforms by FFTW or a library with its single-precision interface. The only source that depends on FFTW.
#ifdef HOGEL_FFTW
#include <fftw3.h>

#include <algorithm>
#include <mutex>

#include "hogel/array.h"
#include "hogel/math/fft_engine.h"

namespace hogel::math {
namespace {

// FFTW's planner has global state; only execution is thread-safe.
std::mutex& planner() {
    static std::mutex mutex;
    return mutex;
}

fftwf_complex* fftw(std::complex<float>* p) { return reinterpret_cast<fftwf_complex*>(p); }

// Plans for both directions, for aligned and unaligned data.
class Directions {
  public:
    // make(scratch, sign, flags) plans an in-place transform of `values` values.
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
        const bool is_aligned = fftwf_alignment_of(reinterpret_cast<float*>(values)) == alignment_;
        fftwf_execute_dft((is_aligned ? aligned_ : unaligned_)[forward ? 0 : 1], fftw(values), fftw(values));
    }

  private:
    int alignment_ = 0;
    fftwf_plan aligned_[2], unaligned_[2];
};

}  // namespace

struct LineEngine::Plans {
    explicit Plans(std::size_t n)
        : size(n), directions(n, [&](fftwf_complex* p, int sign, unsigned flags) {
              return fftwf_plan_dft_1d(static_cast<int>(n), p, p, sign, flags);
          }) {}
    std::size_t size;
    Directions directions;
};

LineEngine::LineEngine(std::size_t size) : plans_(std::make_unique<Plans>(size)) {}
LineEngine::~LineEngine() = default;
LineEngine::LineEngine(LineEngine&&) noexcept = default;
LineEngine& LineEngine::operator=(LineEngine&&) noexcept = default;

std::size_t LineEngine::size() const { return plans_->size; }
void LineEngine::line(bool forward, std::complex<float>* line) const { plans_->directions.run(forward, line); }

void LineEngine::rows(bool forward, std::complex<float>* lines, std::size_t stride, std::size_t count) const {
    Array<std::complex<float>, 1> line({size()});
    for (std::size_t y = 0; y < count; ++y) {
        std::copy_n(lines + y * stride, size(), line.data());
        plans_->directions.run(forward, line.data());
        std::copy_n(line.data(), size(), lines + y * stride);
    }
}

void LineEngine::columns(bool forward, std::complex<float>* columns, std::size_t row, std::size_t count) const {
    // Padded lines, to avoid cache set conflicts.
    const std::size_t height = size(), stride = (height + 15) / 8 * 8;
    Array<std::complex<float>, 2> lines({count, stride});
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t i = 0; i < count; ++i) lines.data()[i * stride + y] = columns[y * row + i];
    for (std::size_t i = 0; i < count; ++i) plans_->directions.run(forward, &lines(i, 0));
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t i = 0; i < count; ++i) columns[y * row + i] = lines.data()[i * stride + y];
}

struct SmallArrayEngine::Plans {
    Plans(std::size_t h, std::size_t w, Axes axes)
        : directions(h * w, [&](fftwf_complex* p, int sign, unsigned flags) {
              const int height = static_cast<int>(h), width = static_cast<int>(w);
              if (axes == Axes::both) return fftwf_plan_dft_2d(height, width, p, p, sign, flags);
              return fftwf_plan_many_dft(1, &width, height, p, nullptr, 1, width, p, nullptr, 1, width, sign, flags);
          }) {}
    Directions directions;
};

SmallArrayEngine::SmallArrayEngine(std::size_t height, std::size_t width, Axes axes)
    : plans_(std::make_unique<Plans>(height, width, axes)) {}
SmallArrayEngine::~SmallArrayEngine() = default;
SmallArrayEngine::SmallArrayEngine(SmallArrayEngine&&) noexcept = default;
SmallArrayEngine& SmallArrayEngine::operator=(SmallArrayEngine&&) noexcept = default;

void SmallArrayEngine::run(bool forward, std::complex<float>* values) const { plans_->directions.run(forward, values); }

}  // namespace hogel::math
#endif
