// SPDX-License-Identifier: Apache-2.0
// Phases by descent of the difference between photographs by waves and by rays, through random pupils (Schiffers et
// al., Stochastic Light Field Holography, ICCP 2023), for patterns that are shown in turn (Choi et al.,
// Time-multiplexed Neural Holography, SIGGRAPH 2022).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/error.h"
#include "hogel/math/fft.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/patterns/pattern_parts.h"
#include "hogel/patterns/pupils/camera.h"
#include "hogel/patterns/pupils/quality.h"
#include "hogel/work/parallel.h"

namespace hogel {

using namespace patterns;

namespace {

using Complex = std::complex<float>;

constexpr std::size_t pupils_per_step = 4;
constexpr std::size_t default_steps = 300;
constexpr std::size_t start_steps = 30;                    // of the descent towards the field, where the phases start
constexpr double first_rate = 0.15, last_rate = 0.005;     // greatest change of a phase in a step, radians
constexpr float mean_decay = 0.9f, square_decay = 0.999f;  // of Adam
constexpr double scale_decay = 0.9;                        // of the sums of earlier steps
constexpr std::uint32_t descent_sequence = 1;              // of random pupils

// The phases of one pattern, and Adam's averages of their gradient and of its square: Kingma and Ba, ICLR 2015.
struct Frame {
    explicit Frame(Array<float, 2> start) : cycles(std::move(start)), mean(cycles.shape()), square(cycles.shape()) {}
    Array<float, 2> cycles, mean, square;
};

class Descent {
  public:
    Descent(const PupilCamera& camera, const PatternOptions& options, std::vector<Frame> frames)
        : camera_(camera),
          frames_(std::move(frames)),
          fft_(options.modulator.height, options.modulator.width),
          steps_(options.iterations > 0 ? options.iterations : default_steps) {
        for (unsigned level = 0; level < options.modulator.levels; ++level)
            phasors_.emplace_back(std::polar(1.0, 2 * std::numbers::pi * level / options.modulator.levels));
        for (std::size_t f = 0; f < frames_.size(); ++f) {
            spectra_.emplace_back(Shape<2>{fft_.height(), fft_.width()});
            gradients_.emplace_back(Shape<2>{fft_.height(), fft_.width()});
        }
    }

    void run(const Progress& progress) {
        for (std::size_t k = 0; k < steps_; ++k) {
            progress.report(static_cast<double>(k) / static_cast<double>(steps_));
            transform_patterns();
            const PhotographSums before = sums_;
            sums_ = {scale_decay * before.ab, scale_decay * before.aa, 0, 0};
            for (std::size_t b = 0; b < pupils_per_step; ++b)
                add_photograph(
                    camera_.range().draw(descent_sequence, static_cast<std::uint32_t>(k * pupils_per_step + b)));
            for (std::size_t f = 0; f < frames_.size(); ++f) change_phases(f, k + 1);
        }
    }

    std::vector<Frame>& frames() { return frames_; }
    std::size_t steps() const { return steps_; }

  private:
    Complex phasor(float cycles) const {
        const auto levels = static_cast<float>(phasors_.size());
        const auto level = static_cast<std::size_t>(std::lround(cycles * levels));
        return phasors_[level < phasors_.size() ? level : 0];
    }

    // Computes the spectra of the patterns as the modulator shows them. The gradient takes the rounding to levels as
    // the identity.
    void transform_patterns() {
        for (std::size_t f = 0; f < frames_.size(); ++f) {
            work::parallel_for(fft_.height(), [&](std::size_t y) {
                for (std::size_t x = 0; x < fft_.width(); ++x) {
                    spectra_[f](y, x) = phasor(frames_[f].cycles(y, x));
                    gradients_[f](y, x) = 0;
                }
            });
            fft_.forward(spectra_[f]);
        }
    }

    // Adds the gradient of Σ(√(s I) − B)² over one photograph, divided by the number of its samples.
    void add_photograph(const Pupil& pupil) {
        const Shape<2> shape = camera_.film(pupil).shape();
        Array<float, 2> amplitudes(shape), intensity(shape);
        std::vector<Array<Complex, 2>> fields;
        for (std::size_t f = 0; f < frames_.size(); ++f) fields.emplace_back(shape);
        camera_.photograph_rays(pupil, amplitudes);
        camera_.photograph_waves(spectra_, pupil, fields, intensity);
        sums_ += camera_.sums(pupil, intensity, amplitudes);
        const Region region = camera_.interior(pupil);
        const auto factor = static_cast<float>(sums_.factor());
        const float share = 1.0f / static_cast<float>(region.width * region.height);
        work::parallel_for(shape[0], [&](std::size_t y) {
            const bool is_inside = y >= region.y0 && y < region.y0 + region.height;
            for (std::size_t x = 0; x < shape[1]; ++x) {
                float weight = 0;
                if (is_inside && x >= region.x0 && x < region.x0 + region.width)
                    weight = share * factor * (factor - amplitudes(y, x) / std::sqrt(intensity(y, x) + 1e-6f));
                for (auto& field : fields) field(y, x) *= weight;
            }
        });
        for (std::size_t f = 0; f < frames_.size(); ++f) camera_.add_adjoint(fields[f], pupil, gradients_[f]);
    }

    // Takes step k ≥ 1 of Adam, at a rate that falls as a cosine.
    void change_phases(std::size_t f, std::size_t k) {
        fft_.backward(gradients_[f]);
        const auto count = static_cast<double>(k), part = count / static_cast<double>(steps_);
        const double rate = last_rate + (first_rate - last_rate) * 0.5 * (1 + std::cos(std::numbers::pi * part));
        const auto length = static_cast<float>(rate / (2 * std::numbers::pi) / (1 - std::pow(mean_decay, count)));
        const auto square_share = static_cast<float>(1 / (1 - std::pow(square_decay, count)));
        Frame& frame = frames_[f];
        work::parallel_for(fft_.height(), [&](std::size_t y) {
            for (std::size_t x = 0; x < fft_.width(); ++x) {
                const Complex value = phasor(frame.cycles(y, x)), field = gradients_[f](y, x);
                const float slope = value.real() * field.imag() - value.imag() * field.real();
                float& mean = frame.mean(y, x);
                float& square = frame.square(y, x);
                mean += (1 - mean_decay) * (slope - mean);
                square += (1 - square_decay) * (slope * slope - square);
                const float cycles = frame.cycles(y, x) - length * mean / (std::sqrt(square * square_share) + 1e-30f);
                frame.cycles(y, x) = cycles - std::floor(cycles);
            }
        });
    }

    const PupilCamera& camera_;
    std::vector<Frame> frames_;
    math::Fft2 fft_;
    std::size_t steps_;
    std::vector<Complex> phasors_;  // by level
    std::vector<Array<Complex, 2>> spectra_, gradients_;
    PhotographSums sums_;
};

// Returns the aperture around all directions of a light field.
Aperture aperture_of(const PupilRange& range) {
    Aperture aperture = range.directions;
    aperture.radius = std::min(0.5, std::hypot(range.half_x, range.half_y));
    return aperture;
}

// Returns where the descent starts: phases that show one look of the field.
Frame start_of(const FieldSource& field, std::size_t look, PatternOptions options) {
    options.encoding = Encoding::gradient;
    options.iterations = start_steps;
    const FittedField fitted(field, look, options);
    Convergence ignored;
    Array<float, 2> cycles = descend_phases(fitted.samples, fitted.band, options, ignored, Progress());
    return Frame(std::move(cycles));
}

}  // namespace

namespace patterns {

SupervisedPatterns supervise(const FieldSource& field, const LightFieldSource& light_field, std::size_t channel,
                             const PatternOptions& options, const Progress& progress) {
    const double wavelength = field.grid().wavelength;
    require_fitting(field.grid(), options);
    const PupilCamera camera(light_field, channel, wavelength, options.modulator);
    std::vector<Frame> frames;
    for (std::size_t look = 0; look < field.looks(); ++look) frames.push_back(start_of(field, look, options));
    Descent descent(camera, options, std::move(frames));
    descent.run(progress);
    SupervisedPatterns result;
    for (Frame& frame : descent.frames()) {
        Pattern pattern;
        pattern.values = std::move(frame.cycles);
        round_to_levels(pattern, options);
        pattern.iterations = descent.steps();
        pattern.aperture = aperture_of(camera.range());
        result.frames.push_back(std::move(pattern));
    }
    result.quality = pupil_quality(result.frames, camera, options);
    for (Pattern& pattern : result.frames) {
        pattern.efficiency = result.quality.efficiency;
        pattern.power = result.quality.power;
    }
    return result;
}

}  // namespace patterns

}  // namespace hogel
