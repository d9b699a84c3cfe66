// The only file that knows which FFT library is linked: any library with FFTW's single-precision interface will do.
#include "hogel/math/fft.h"

#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <mutex>

#include "hogel/core/error.h"

namespace hogel {
namespace {

// FFTW's planner keeps global tables; only execution is thread-safe.
std::mutex& planner() {
    static std::mutex mutex;
    return mutex;
}

fftwf_complex* fftw(std::complex<float>* p) { return reinterpret_cast<fftwf_complex*>(p); }

}  // namespace

// Small transforms are one plan. For larger ones the plans that FFTW makes without measuring are up to thirty times
// slower than they could be, so those are put together here: all rows in place, then the columns, some at a time, in a
// buffer where they are contiguous.
struct Fft2::Plans {
    static constexpr std::size_t small = 128 * 128;
    static constexpr std::size_t columns_at_once = 16;

    Plans(std::size_t h, std::size_t w) : height(h), width(w), whole(h * w <= small || h == 1 || w == 1) {
        Array<std::complex<float>, 2> scratch({h, w});
        const std::lock_guard lock(planner());
        alignment = fftwf_alignment_of(reinterpret_cast<float*>(scratch.data()));
        for (int direction = 0; direction < 2; ++direction) {
            const int sign = direction == 0 ? FFTW_FORWARD : FFTW_BACKWARD;
            for (const bool fits : {false, true}) {
                const unsigned flags = FFTW_ESTIMATE | (fits ? 0 : FFTW_UNALIGNED);
                rows[direction][fits] = whole
                                            ? fftwf_plan_dft_2d(static_cast<int>(h), static_cast<int>(w),
                                                                fftw(scratch.data()), fftw(scratch.data()), sign, flags)
                                            : contiguous(w, h, w, scratch, sign, flags);
            }
            if (whole) continue;
            Array<std::complex<float>, 2> buffer = make_buffer();
            columns[direction] = contiguous(h, columns_at_once, buffer.extent(1), buffer, sign, FFTW_ESTIMATE);
        }
    }
    ~Plans() {
        const std::lock_guard lock(planner());
        for (int direction = 0; direction < 2; ++direction) {
            for (const fftwf_plan plan : rows[direction]) fftwf_destroy_plan(plan);
            if (columns[direction] != nullptr) fftwf_destroy_plan(columns[direction]);
        }
    }
    Plans(const Plans&) = delete;
    Plans& operator=(const Plans&) = delete;

    static fftwf_plan contiguous(std::size_t length, std::size_t many, std::size_t distance,
                                 Array<std::complex<float>, 2>& values, int sign, unsigned flags) {
        const int n = static_cast<int>(length);
        return fftwf_plan_many_dft(1, &n, static_cast<int>(many), fftw(values.data()), nullptr, 1,
                                   static_cast<int>(distance), fftw(values.data()), nullptr, 1,
                                   static_cast<int>(distance), sign, flags);
    }

    // A cache line longer than a column, lest columns fall on the same places of the cache.
    Array<std::complex<float>, 2> make_buffer() const {
        return Array<std::complex<float>, 2>({columns_at_once, height + 8});
    }

    void run(int direction, View<std::complex<float>, 2> values) const {
        if (values.extent(0) != height || values.extent(1) != width)
            throw Error(ErrorCode::internal, fmt::format("FFT of {}x{} values with a plan for {}x{}", values.extent(0),
                                                         values.extent(1), height, width));
        const bool fits = fftwf_alignment_of(reinterpret_cast<float*>(values.data())) == alignment;
        fftwf_execute_dft(rows[direction][fits], fftw(values.data()), fftw(values.data()));
        if (whole) return;
        Array<std::complex<float>, 2> buffer = make_buffer();
        for (std::size_t x0 = 0; x0 < width; x0 += columns_at_once) {
            const std::size_t n = std::min(columns_at_once, width - x0);
            for (std::size_t y = 0; y < height; ++y)
                for (std::size_t x = 0; x < n; ++x) buffer(x, y) = values(y, x0 + x);
            fftwf_execute_dft(columns[direction], fftw(buffer.data()), fftw(buffer.data()));
            for (std::size_t y = 0; y < height; ++y)
                for (std::size_t x = 0; x < n; ++x) values(y, x0 + x) = buffer(x, y);
        }
    }

    std::size_t height, width;
    bool whole;  // one plan for all
    int alignment = 0;
    fftwf_plan rows[2][2] = {};  // by direction, and whether the data are aligned
    fftwf_plan columns[2] = {};
};

Fft2::Fft2(std::size_t height, std::size_t width) {
    if (height == 0 || width == 0 || height > INT32_MAX || width > INT32_MAX)
        throw Error(ErrorCode::usage, fmt::format("an FFT cannot have {}x{} samples", width, height));
    plans_ = std::make_unique<Plans>(height, width);
}
Fft2::~Fft2() = default;
Fft2::Fft2(Fft2&&) noexcept = default;
Fft2& Fft2::operator=(Fft2&&) noexcept = default;

void Fft2::forward(View<std::complex<float>, 2> values) const { plans_->run(0, values); }
void Fft2::backward(View<std::complex<float>, 2> values) const { plans_->run(1, values); }
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

}  // namespace hogel
