#include "hogel/optics/film.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/core/parallel.h"
#include "hogel/optics/film_interpolation_internal.h"
#include "hogel/optics/phase_walk.h"

namespace hogel {
namespace {

using Complex = std::complex<float>;

const InterpolationTable& interpolation() {
    static const InterpolationTable table;
    return table;
}

// What a point in direction sine (n_x, n_y) at depth ζ adds to the path of light to the point δ of the pupil, beside
// the term linear in δ that its direction makes: exactly |x − q| − |x − c| + n·δ.
double path(double sine_x, double sine_y, double distance_z, double delta_x, double delta_y) {
    const double cosine = std::sqrt(1 - sine_x * sine_x - sine_y * sine_y), r = distance_z / cosine;
    const double along = sine_x * delta_x + sine_y * delta_y, square = delta_x * delta_x + delta_y * delta_y;
    // |rn − δ| − r without the loss of digits.
    const double change = square - 2 * r * along;
    return change / (std::sqrt(r * r + change) + r) + along;
}

}  // namespace

// A camera's lens at the frequencies of the transform, where the light that reaches the pupil at δ has frequency δ/λ in
// the sines. The defocus phase depends on the direction, slowly; the film gets as many nodes as keep it within half a
// radian, each with a phase of its own.
class Film::Lens {
  public:
    Lens(const SineGrid& sines, double wavelength, const Camera& camera)
        : sines_(sines),
          wavelength_(wavelength),
          camera_(camera),
          radius_(0.5 * camera.pupil),
          step_x_(wavelength / (static_cast<double>(sines.size_x) * sines.step)),
          step_y_(wavelength / (static_cast<double>(sines.size_y) * sines.step)) {
        nodes_x = nodes_for(span_x(), 0);
        nodes_y = nodes_for(0, span_y());
    }

    std::size_t nodes_x = 1, nodes_y = 1;

    // The sine in the middle of a node's part of the film.
    double node_x(std::size_t i) const {
        return sines_.first_x + span_x() * (static_cast<double>(i) + 0.5) / static_cast<double>(nodes_x);
    }
    double node_y(std::size_t j) const {
        return sines_.first_y + span_y() * (static_cast<double>(j) + 0.5) / static_cast<double>(nodes_y);
    }

    // Offsets from the middle of the pupil, in steps, that the disc may reach.
    std::ptrdiff_t reach_x() const { return reach(step_x_, sines_.size_x); }
    std::ptrdiff_t reach_y() const { return reach(step_y_, sines_.size_y); }

    // How much of the light passes in amplitude at a place of the pupil's plane. The edge falls over one sample, so
    // that the disc has its area on a coarse grid too.
    double passes(std::ptrdiff_t column, std::ptrdiff_t row) const {
        const double dx = step_x_ * static_cast<double>(column), dy = step_y_ * static_cast<double>(row);
        const double edge = std::max(step_x_, step_y_), square = dx * dx + dy * dy;
        const double inner = std::max(radius_ - 0.5 * edge, 0.0);
        if (square < inner * inner) return 1;
        return std::clamp((radius_ - std::sqrt(square)) / edge + 0.5, 0.0, 1.0);
    }

    // Of the opening, as sampled, m².
    double area() const {
        double sum = 0;
        for (std::ptrdiff_t row = -reach_y(); row <= reach_y(); ++row)
            for (std::ptrdiff_t column = -reach_x(); column <= reach_x(); ++column) {
                const double inside = passes(column, row);
                sum += inside * inside;
            }
        return sum * step_x_ * step_y_;
    }

    // Calls emit(column offset, factor) along a row of the pupil, for light from the direction (n_x, n_y).
    template <class Emit>
    void row(double nx, double ny, std::ptrdiff_t row, const Emit& emit) const {
        const double scale = 1 / (static_cast<double>(sines_.size_x) * static_cast<double>(sines_.size_y));
        const double dy = step_y_ * static_cast<double>(row), edge = std::max(step_x_, step_y_);
        if (std::abs(dy) > radius_ + edge) return;
        const double half = std::sqrt((radius_ + edge) * (radius_ + edge) - dy * dy);
        const auto last = std::min(reach_x(), static_cast<std::ptrdiff_t>(half / step_x_));
        walk_phase(
            static_cast<std::size_t>(2 * last + 1),
            [&](double step) { return defocus(nx, ny, step_x_ * (step - static_cast<double>(last)), dy); },
            [&](std::size_t i, std::complex<double> phase) {
                const std::ptrdiff_t column = static_cast<std::ptrdiff_t>(i) - last;
                emit(column, Complex(scale * passes(column, row) * phase));
            });
    }

  private:
    double span_x() const { return static_cast<double>(sines_.size_x) * sines_.step; }
    double span_y() const { return static_cast<double>(sines_.size_y) * sines_.step; }

    std::ptrdiff_t reach(double step, std::size_t size) const {
        return std::min(static_cast<std::ptrdiff_t>(radius_ / step) + 1, static_cast<std::ptrdiff_t>(size - 1) / 2);
    }

    // In turns.
    double defocus(double nx, double ny, double dx, double dy) const {
        if (camera_.focus_depth == 0) return 0;
        const double R = camera_.eye.z;
        return (path(nx, ny, R, dx, dy) - path(nx, ny, R + camera_.focus_depth, dx, dy)) / wavelength_;
    }

    std::size_t nodes_for(double ux, double uy) const {
        const double mid_x = sines_.first_x + 0.5 * span_x(), mid_y = sines_.first_y + 0.5 * span_y();
        double change = 0;
        for (double a : {0.0, 0.25, 0.5, 0.75}) {
            const double dx = radius_ * std::cos(std::numbers::pi * a), dy = radius_ * std::sin(std::numbers::pi * a);
            change = std::max(change, std::abs(defocus(mid_x + 0.5 * ux, mid_y + 0.5 * uy, dx, dy) -
                                               defocus(mid_x - 0.5 * ux, mid_y - 0.5 * uy, dx, dy)));
        }
        return std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(2 * std::numbers::pi * change / 0.5)), 1, 9);
    }

    const SineGrid& sines_;
    double wavelength_;
    const Camera& camera_;
    double radius_, step_x_, step_y_;
};

Film::Film(const NarrowBand& band, const FieldGrid& hologram, double blur)
    : band_(band),
      hologram_(hologram),
      sines_(sine_grid(band, hologram.plane, blur)),
      fft_(sines_.size_y, sines_.size_x) {}

Array<Complex, 2> Film::pupil_wave(View<const Complex, 2> band) const {
    const Grid& plane = band_.plane;
    const InterpolationTable& table = interpolation();
    // Two passes, each along one axis: first to uniform n_x on the band's own rows; then down the columns, on which n_x
    // is constant, to uniform n_y. Stored transposed in between, so that both passes run along memory.
    Array<Complex, 2> columns({sines_.size_x, plane.height});
    const Vec3 eye = band_.geometry.eye();
    // On a row the point of sine n_x lies at x = c_x + n_x/√(1 − n_x²) · √((y − c_y)² + c_z²).
    std::vector<double> slopes(sines_.size_x);
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        const double nx = sines_.first_x + static_cast<double>(i) * sines_.step;
        slopes[i] = nx / std::sqrt(1 - nx * nx);
    }
    // Rows and columns are taken so many at a time, so that what is written transposed falls into whole cache lines.
    constexpr std::size_t together = 16;
    const double middle_x = plane.column(eye.x), middle_y = plane.row(eye.y);
    parallel_for((plane.height + together - 1) / together, [&](std::size_t block) {
        for (std::size_t row = block * together; row < std::min((block + 1) * together, plane.height); ++row) {
            const double reach = std::hypot(plane.y(static_cast<double>(row)) - eye.y, eye.z) / plane.pitch_x;
            for (std::size_t i = 0; i < sines_.size_x; ++i)
                columns(i, row) = table.at(&band(row, 0), plane.width, middle_x + slopes[i] * reach);
        }
    });
    Array<Complex, 2> wave({sines_.size_y, sines_.size_x});
    const double reach = eye.z / plane.pitch_y;
    parallel_for((sines_.size_x + together - 1) / together, [&](std::size_t block) {
        for (std::size_t i = block * together; i < std::min((block + 1) * together, sines_.size_x); ++i) {
            const double nx = sines_.first_x + static_cast<double>(i) * sines_.step;
            for (std::size_t j = 0; j < sines_.size_y; ++j) {
                const double ny = sines_.first_y + static_cast<double>(j) * sines_.step;
                wave(j, i) =
                    table.at(&columns(i, 0), plane.height, middle_y - reach * ny / std::sqrt(1 - nx * nx - ny * ny));
            }
        }
    });
    fft_.forward(wave);
    return wave;
}

void Film::expose(View<const Complex, 2> pupil_wave, const Camera& camera, View<Complex, 2> field,
                  View<float, 2> intensity) const {
    const Lens lens(sines_, hologram_.wavelength, camera);
    const auto wrapped = [](std::ptrdiff_t k, std::size_t n) {
        return static_cast<std::size_t>(k < 0 ? k + static_cast<std::ptrdiff_t>(n) : k);
    };
    // Between nodes the intensities cross over linearly.
    const auto weight = [](std::size_t k, std::size_t size, std::size_t at, std::size_t nodes) {
        const double place = (static_cast<double>(k) + 0.5) / static_cast<double>(size) * static_cast<double>(nodes);
        const double held = std::clamp(place - 0.5, 0.0, static_cast<double>(nodes) - 1);
        return static_cast<float>(std::max(0.0, 1 - std::abs(held - static_cast<double>(at))));
    };
    for (std::size_t b = 0; b < lens.nodes_y; ++b)
        for (std::size_t a = 0; a < lens.nodes_x; ++a) {
            parallel_for(sines_.size_y, [&](std::size_t y) {
                std::fill_n(&field(y, 0), sines_.size_x, Complex(0));
                auto row = static_cast<std::ptrdiff_t>(y);
                if (y > sines_.size_y / 2) row -= static_cast<std::ptrdiff_t>(sines_.size_y);
                if (std::abs(row) > lens.reach_y()) return;
                lens.row(lens.node_x(a), lens.node_y(b), row, [&](std::ptrdiff_t column, Complex factor) {
                    const std::size_t x = wrapped(column, sines_.size_x);
                    const Complex wave = pupil_wave(y, x);
                    field(y, x) = {wave.real() * factor.real() - wave.imag() * factor.imag(),
                                   wave.real() * factor.imag() + wave.imag() * factor.real()};
                });
            });
            fft_.backward(field);
            std::vector<float> across(sines_.size_x);
            for (std::size_t i = 0; i < sines_.size_x; ++i) across[i] = weight(i, sines_.size_x, a, lens.nodes_x);
            parallel_for(sines_.size_y, [&](std::size_t j) {
                const float down = weight(j, sines_.size_y, b, lens.nodes_y);
                if (down == 0) return;
                for (std::size_t i = 0; i < sines_.size_x; ++i) {
                    const Complex& v = field(j, i);
                    intensity(j, i) += down * across[i] * (v.real() * v.real() + v.imag() * v.imag());
                }
            });
        }
}

void Film::develop(View<const float, 2> intensity, const Camera& camera, const Rectangle& shown, double weight,
                   Image& image) const {
    const Grid& picture = camera.picture;
    const ViewGeometry& geometry = band_.geometry;
    const double area = Lens(sines_, hologram_.wavelength, camera).area();
    // About a point a pixel for every sample of the film.
    const double film_pitch = sines_.step * geometry.eye().z;
    const auto sub_x = static_cast<std::size_t>(std::max(2.0, std::ceil(picture.pitch_x / film_pitch)));
    const auto sub_y = static_cast<std::size_t>(std::max(2.0, std::ceil(picture.pitch_y / film_pitch)));
    parallel_for(picture.height, [&](std::size_t row) {
        for (std::size_t column = 0; column < picture.width; ++column) {
            double sum = 0;
            for (std::size_t b = 0; b < sub_y; ++b)
                for (std::size_t a = 0; a < sub_x; ++a) {
                    const double x = picture.x(static_cast<double>(column) +
                                               (static_cast<double>(a) + 0.5) / static_cast<double>(sub_x) - 0.5);
                    const double y = picture.y(static_cast<double>(row) +
                                               (static_cast<double>(b) + 0.5) / static_cast<double>(sub_y) - 0.5);
                    if (!shown.holds(x, y)) continue;
                    const double i = (geometry.sine_x(x, y) - sines_.first_x) / sines_.step;
                    const double j = (geometry.sine_y(x, y) - sines_.first_y) / sines_.step;
                    const double value = cubic_at(sines_.size_y, sines_.size_x, intensity, j, i);
                    // A diffuse surface of radiance L sends L cos θ · (area of the pupil) cos θ/r² through this band,
                    // and its plane waves have 1/cos θ of that as |F|² (docs/notation.md section 4).
                    const double r = geometry.distance(x, y);
                    sum += value * r * r / (geometry.cosine(x, y) * area);
                }
            image.pixels(row, column, 0) += static_cast<float>(weight * sum / static_cast<double>(sub_x * sub_y));
        }
    });
}

}  // namespace hogel
