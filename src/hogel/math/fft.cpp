// The only file that knows which FFT library is linked: any library with FFTW's single-precision interface will do.
#include "hogel/math/fft.h"

#include <fftw3.h>
#include <fmt/format.h>

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

struct Fft2::Plans {
    Plans(std::size_t h, std::size_t w) : height(h), width(w) {
        Array<std::complex<float>, 2> scratch({h, w});
        const auto make = [&](int sign, unsigned flags) {
            return fftwf_plan_dft_2d(static_cast<int>(h), static_cast<int>(w), fftw(scratch.data()),
                                     fftw(scratch.data()), sign, FFTW_ESTIMATE | flags);
        };
        const std::lock_guard lock(planner());
        alignment = fftwf_alignment_of(reinterpret_cast<float*>(scratch.data()));
        aligned[0] = make(FFTW_FORWARD, 0);
        aligned[1] = make(FFTW_BACKWARD, 0);
        unaligned[0] = make(FFTW_FORWARD, FFTW_UNALIGNED);
        unaligned[1] = make(FFTW_BACKWARD, FFTW_UNALIGNED);
    }
    ~Plans() {
        const std::lock_guard lock(planner());
        for (int i = 0; i < 2; ++i) {
            fftwf_destroy_plan(aligned[i]);
            fftwf_destroy_plan(unaligned[i]);
        }
    }
    void run(int direction, View<std::complex<float>, 2> values) const {
        if (values.extent(0) != height || values.extent(1) != width)
            throw Error(ErrorCode::internal, fmt::format("FFT of {}x{} values with a plan for {}x{}", values.extent(0),
                                                         values.extent(1), height, width));
        const bool fits = fftwf_alignment_of(reinterpret_cast<float*>(values.data())) == alignment;
        fftwf_execute_dft((fits ? aligned : unaligned)[direction], fftw(values.data()), fftw(values.data()));
    }

    std::size_t height, width;
    int alignment = 0;
    fftwf_plan aligned[2], unaligned[2];
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
