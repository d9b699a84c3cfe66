// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

#include "bench/measure.h"
#include "bench/session.h"
#include "bench/studies/studies.h"
#include "hogel/error.h"
#include "hogel/hologram.h"
#include "hogel/image.h"
#include "hogel/pattern.h"
#include "hogel/photograph.h"
#include "hogel/ray_photograph.h"

namespace hogel::bench {
namespace {

constexpr double wavelength = 633e-9, pitch = 8e-6, depth = 10e-3;
constexpr std::size_t hogel_side = 16, looks = 4;

// The light field of a picture at `depth`.
LightFieldBuffer wavy_picture(std::size_t samples) {
    const double half_sine = 0.15 * wavelength / (2 * pitch), size = static_cast<double>(samples) * pitch;
    const LightFieldGrid grid{
        samples / hogel_side, samples / hogel_side, pitch * hogel_side, 16, 16, Perspective{half_sine, half_sine}, 1};
    LightFieldBuffer light_field(grid);
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t l = 0; l < 16; ++l)
                for (std::size_t k = 0; k < 16; ++k) {
                    const double x = grid.s(double(s)) + grid.u(double(k)) * depth;
                    const double y = grid.t(double(t)) + grid.v(double(l)) * depth;
                    light_field.radiance(0, t, s, l, k) =
                        float(0.5 + 0.5 * std::sin(14 * x / size) * std::sin(17 * y / size));
                }
    return light_field;
}

// Divides by the mean, so that pictures of different efficiency can be compared.
Image normalised(Image image) {
    double mean = 0;
    for (const float value : image.pixels.elements()) mean += value / double(image.pixels.size());
    for (float& value : image.pixels.elements()) value = float(0.5 * value / mean);
    return image;
}

// Prints a table row.
void report(const char* name, Image mean, const Image& truth, double efficiency, double light_field, double seconds) {
    const ImageComparison result = compare(truth, normalised(std::move(mean)));
    std::printf("| `%s` | %.1f/%.2f | %.1f %% |", name, result.psnr, result.ssim, 100 * efficiency);
    light_field > 0 ? std::printf(" %.1f %% |", 100 * light_field) : std::printf(" |");
    std::printf(" %.2f |\n", seconds);
    std::fflush(stdout);
}

Field hologram_of(const LightFieldBuffer& light_field, std::uint64_t seed) {
    HologramOptions options;
    options.channel.wavelength = wavelength;
    options.pitch = pitch;
    options.seed = seed;
    const auto source = make_hologram(borrow(light_field), options);
    Field field(source->grid());
    copy(*source, field);
    return field;
}

void add(Image& sum, const Image& image) {
    if (sum.pixels.size() == 0) sum = Image(image.width(), image.height(), 1);
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels.data()[i] += image.pixels.data()[i];
}

// The field behind the modulator, with its order rotated to straight ahead.
Field light_of(const Pattern& pattern, const Encoding& encoding, Field field) {
    field.samples = transmission(pattern, encoding);
    const double frequency = std::sin(pattern.reference_angle) * pitch / wavelength;
    const Grid& plane = field.grid().plane;
    for (std::size_t y = 0; y < plane.height; ++y)
        for (std::size_t x = 0; x < plane.width; ++x)
            field.samples(y, x) *=
                std::complex<float>(std::polar(1.0, 2 * std::numbers::pi * std::fmod(frequency * double(x), 1.0)));
    return field;
}

void measure(const std::string& name, const Encoding& encoding, const LightFieldBuffer& light_field,
             const Camera& camera, const Image& truth, const PatternStudy& study) {
    Image sum;
    double efficiency = 0, light = 0, seconds = 0;
    for (std::uint64_t look = 1; look <= looks; ++look) {
        stop_if_interrupted();
        PatternOptions options;
        options.encoding = encoding;
        options.modulator = {"bench", study.samples, study.samples, pitch, 256};
        options.window = hogel_side;
        options.iterations = study.iterations;
        const Field field = hologram_of(light_field, look);
        const double start = processor_seconds();
        const Pattern pattern = encode_pattern(field, options);
        seconds += (processor_seconds() - start) / looks;
        efficiency += pattern.efficiency / looks;
        light += pattern.light_field_efficiency / looks;
        add(sum, photograph(light_of(pattern, encoding, field), std::span(&camera, 1))[0]);
    }
    report(name.c_str(), sum, truth, efficiency, light, seconds);
}

}  // namespace

void study_pattern(const PatternStudy& study) {
    const LightFieldBuffer light_field = wavy_picture(study.samples);
    const double size = double(study.samples) * pitch;
    Camera camera;
    camera.eye = {0, 0, 300e-3};
    camera.pupil = 3e-3;
    camera.focus_depth = depth;
    camera.picture = {24, 24, 0.8 * size / 24, 0.8 * size / 24, 0, 0};
    const Image truth = normalised(photograph(borrow(light_field), std::span(&camera, 1), {128})[0]);
    std::printf(
        "| encoding | PSNR/SSIM of the photograph | light in F | in its light field | seconds "
        "|\n|---|---|---|---|---|\n");
    Image complex;
    for (std::uint64_t look = 1; look <= looks; ++look)
        add(complex, photograph(hologram_of(light_field, look), std::span(&camera, 1))[0]);
    report("the complex field", complex, truth, 1, 1, 0);
    for (const EncodingInfo& info : encodings().rows()) {
        try {
            measure(info.name, info.encoding, light_field, camera, truth, study);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) throw;
            std::printf("| `%s` | refused: %s |\n", info.name.c_str(), error.what());
        }
    }
}

}  // namespace hogel::bench
