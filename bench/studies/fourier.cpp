// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <complex>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#ifdef HOGEL_FFTW_WITNESS
#include <fftw3.h>
#endif

#include "bench/measure.h"
#include "bench/session.h"
#include "bench/studies/studies.h"
#include "hogel/math/fft.h"
#include "hogel/resources.h"

namespace hogel::bench {
namespace {

using Complex = std::complex<float>;
using Work = std::function<void(Array<Complex, 2>&)>;

#ifdef HOGEL_FFTW_WITNESS
// FFTW's transform of all rows, or of the whole array, in place on one thread.
Work fftw(std::size_t height, std::size_t width, bool rows, unsigned flags) {
    const int down = static_cast<int>(height), across = static_cast<int>(width);
    Array<Complex, 2> scratch({height, width});
    auto* p = reinterpret_cast<fftwf_complex*>(scratch.data());
    const fftwf_plan plan =
        rows ? fftwf_plan_many_dft(1, &across, down, p, nullptr, 1, across, p, nullptr, 1, across, FFTW_FORWARD, flags)
             : fftwf_plan_dft_2d(down, across, p, p, FFTW_FORWARD, flags);
    const std::shared_ptr<fftwf_plan_s> held(plan, fftwf_destroy_plan);
    return [held](Array<Complex, 2>& values) {
        auto* data = reinterpret_cast<fftwf_complex*>(values.data());
        fftwf_execute_dft(held.get(), data, data);
    };
}
#endif

std::vector<Work> works(std::size_t height, std::size_t width, bool rows) {
    std::vector<Work> result;
    if (rows) {
        const auto fft = std::make_shared<math::Fft1>(width);
        result.push_back([fft](Array<Complex, 2>& values) { transform_rows(values, *fft, true); });
    } else {
        const auto fft = std::make_shared<math::Fft2>(height, width);
        result.push_back([fft](Array<Complex, 2>& values) { fft->forward(values); });
    }
#ifdef HOGEL_FFTW_WITNESS
    result.push_back(fftw(height, width, rows, FFTW_ESTIMATE));
    result.push_back(fftw(height, width, rows, FFTW_MEASURE));
#endif
    return result;
}

// Prints a table row; the works alternate in every round. Arrays of zeros stay zeros however often they are
// transformed.
void measure(const std::string& name, std::size_t height, std::size_t width, bool rows, std::size_t rounds) {
    Array<Complex, 2> values({height, width});
    const std::vector<Work> all = works(height, width, rows);
    std::vector<double> best(all.size(), std::numeric_limits<double>::max());
    const std::size_t repeats = std::max<std::size_t>(1, (std::size_t{1} << 20) / values.size());
    for (std::size_t round = 0; round < rounds; ++round) {
        stop_if_interrupted();
        for (std::size_t i = 0; i < all.size(); ++i)
            best[i] = std::min(best[i], time_of([&] {
                                            for (std::size_t k = 0; k < repeats; ++k) all[i](values);
                                        }).wall);
    }
    std::printf("| %s |", name.c_str());
    for (const double seconds : best)
        std::printf(" %.2f |", 1e9 * seconds / static_cast<double>(repeats) / static_cast<double>(values.size()));
    std::printf("\n");
    std::fflush(stdout);
}

}  // namespace

void study_fourier(const FourierStudy& study) {
    std::printf("nanoseconds a sample, hogel on %zu threads, FFTW on one\n", thread_count());
#ifdef HOGEL_FFTW_WITNESS
    std::printf("| | hogel | FFTW, estimated | FFTW, measured |\n|---|---|---|---|\n");
#else
    std::printf("| | hogel |\n|---|---|\n");
#endif
    for (const std::size_t n : {30,  32,  48,  50,  60,   64,   90,   100,  120,  128,  240, 256,
                                360, 480, 512, 600, 1000, 1024, 1080, 1920, 2048, 3840, 4096})
        measure("lines of " + std::to_string(n), std::max<std::size_t>(16, 65536 / n), n, true, study.rounds);
    for (const auto& [height, width] :
         {std::pair<std::size_t, std::size_t>{30, 30}, {48, 48}, {60, 60}, {64, 64}, {100, 100}, {128, 128}})
        measure(std::to_string(width) + " × " + std::to_string(height), height, width, false, study.rounds);
    for (const auto& [height, width] :
         {std::pair<std::size_t, std::size_t>{1000, 1000}, {1031, 1031}, {1080, 1920}, {2048, 2048}, {4096, 4096}})
        measure(std::to_string(width) + " × " + std::to_string(height), height, width, false, study.rounds);
}

}  // namespace hogel::bench
