#include "hogel/optics/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hogel/core/parallel.h"
#include "hogel/optics/low_pass.h"
#include "hogel/optics/narrow_band_kernels.h"

namespace hogel {
namespace {

using Complex = std::complex<float>;

// LowPass as an interpolation kernel, tabulated by the fraction of a sample: ten taps around the place between two
// samples, each twice, for the real and the imaginary part. A band-limited signal moves by less than 1e-3 of itself
// over half a table step.
class InterpolationTable {
  public:
    static constexpr std::ptrdiff_t taps = 10;
    static constexpr std::size_t phases = 1024;

    InterpolationTable() {
        for (std::size_t phase = 0; phase <= phases; ++phase)
            for (std::ptrdiff_t k = 0; k < taps; ++k) {
                const double distance =
                    static_cast<double>(k) - 4 - static_cast<double>(phase) / static_cast<double>(phases);
                weights_.insert(weights_.end(), 2, static_cast<float>(LowPass::at(distance)));
            }
    }

    // The value of line[...] (count values, zero outside) at a place between samples.
    Complex at(const Complex* line, std::size_t count, double place) const {
        const double whole = std::floor(place);
        const auto first = static_cast<std::ptrdiff_t>(whole) - 4;
        const float* w = &weights_[static_cast<std::size_t>((place - whole) * phases + 0.5) * 2 * taps];
        if (first >= 0 && first + taps <= static_cast<std::ptrdiff_t>(count)) {
            const auto* z = reinterpret_cast<const float*>(line + first);
            float sum[4] = {0, 0, 0, 0};
            for (std::ptrdiff_t k = 0; k < 2 * taps; k += 4)
                for (std::ptrdiff_t i = 0; i < 4; ++i) sum[i] += w[k + i] * z[k + i];
            return {sum[0] + sum[2], sum[1] + sum[3]};
        }
        float re = 0, im = 0;
        for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, -first);
             k < std::min(taps, static_cast<std::ptrdiff_t>(count) - first); ++k) {
            re += w[2 * k] * line[first + k].real();
            im += w[2 * k] * line[first + k].imag();
        }
        return {re, im};
    }

  private:
    std::vector<float> weights_;
};

const InterpolationTable& interpolation() {
    static const InterpolationTable table;
    return table;
}

// Catmull and Rom's cubic through four neighbours: intensities come with two samples to their finest wave, for which
// straight lines would be too coarse. Nothing outside, and never negative.
double cubic_at(View<const float, 2> values, double row, double column) {
    const auto weights = [](double f) {
        return std::array{((-0.5 * f + 1) * f - 0.5) * f, (1.5 * f - 2.5) * f * f + 1, ((-1.5 * f + 2) * f + 0.5) * f,
                          (0.5 * f - 0.5) * f * f};
    };
    const double row0 = std::floor(row), column0 = std::floor(column);
    if (row0 < 1 || column0 < 1 || row0 + 2 >= static_cast<double>(values.extent(0)) ||
        column0 + 2 >= static_cast<double>(values.extent(1)))
        return 0;
    const auto down = weights(row - row0), across = weights(column - column0);
    const auto j = static_cast<std::size_t>(row0) - 1, i = static_cast<std::size_t>(column0) - 1;
    double sum = 0;
    for (std::size_t b = 0; b < 4; ++b)
        for (std::size_t a = 0; a < 4; ++a) sum += down[b] * across[a] * values(j + b, i + a);
    return std::max(sum, 0.0);
}

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void include(double v) {
        low = std::min(low, v);
        high = std::max(high, v);
    }
};

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

// One camera's lens: the pupil with its defocus phase, at the frequencies of the transform, one for each node of the
// film.
struct Film::Lens {
    Camera camera;
    double area = 0;                        // of the opening, as sampled, m²
    std::size_t nodes_x = 1, nodes_y = 1;   // places of the film that have a defocus phase of their own
    std::vector<Array<Complex, 2>> pupils;  // [node][row][column], normalised for the transforms
};

Film::Film(const NarrowBand& band, const FieldGrid& hologram, std::span<const Camera> cameras)
    : band_(band),
      hologram_(hologram),
      sines_(choose_grid(cameras)),
      fft_(std::make_unique<Fft2>(sines_.size_y, sines_.size_x)) {
    const double wavelength = hologram.wavelength, R = band.geometry.eye().z;
    // The light that reaches the pupil at δ has frequency δ/λ in the sines.
    const double step_x = wavelength / (static_cast<double>(sines_.size_x) * sines_.step);
    const double step_y = wavelength / (static_cast<double>(sines_.size_y) * sines_.step);
    const double span_x = static_cast<double>(sines_.size_x) * sines_.step,
                 span_y = static_cast<double>(sines_.size_y) * sines_.step;
    const auto signed_index = [](std::size_t k, std::size_t n) {
        return k < (n + 1) / 2 ? static_cast<double>(k) : static_cast<double>(k) - static_cast<double>(n);
    };
    for (const Camera& camera : cameras) {
        Lens lens;
        lens.camera = camera;
        const double radius = 0.5 * camera.pupil;
        // The defocus phase depends on the direction, slowly; the film gets as many nodes as keep it within half a
        // radian.
        const auto defocus = [&](double nx, double ny, double dx, double dy) {
            if (camera.focus_depth == 0) return 0.0;
            return (path(nx, ny, R, dx, dy) - path(nx, ny, R + camera.focus_depth, dx, dy)) / wavelength;
        };
        const double mid_x = sines_.first_x + 0.5 * span_x, mid_y = sines_.first_y + 0.5 * span_y;
        const auto nodes_for = [&](double ux, double uy) {
            double change = 0;
            for (double a : {0.0, 0.25, 0.5, 0.75}) {
                const double dx = radius * std::cos(std::numbers::pi * a), dy = radius * std::sin(std::numbers::pi * a);
                change = std::max(change, std::abs(defocus(mid_x + 0.5 * ux, mid_y + 0.5 * uy, dx, dy) -
                                                   defocus(mid_x - 0.5 * ux, mid_y - 0.5 * uy, dx, dy)));
            }
            return std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(2 * std::numbers::pi * change / 0.5)), 1,
                                           9);
        };
        lens.nodes_x = nodes_for(span_x, 0);
        lens.nodes_y = nodes_for(0, span_y);
        for (std::size_t j = 0; j < lens.nodes_y; ++j)
            for (std::size_t i = 0; i < lens.nodes_x; ++i) {
                const double nx =
                    sines_.first_x + span_x * (static_cast<double>(i) + 0.5) / static_cast<double>(lens.nodes_x);
                const double ny =
                    sines_.first_y + span_y * (static_cast<double>(j) + 0.5) / static_cast<double>(lens.nodes_y);
                Array<Complex, 2>& pupil = lens.pupils.emplace_back(Shape<2>{sines_.size_y, sines_.size_x});
                double area = 0;
                for (std::size_t row = 0; row < sines_.size_y; ++row)
                    for (std::size_t column = 0; column < sines_.size_x; ++column) {
                        const double dx = step_x * signed_index(column, sines_.size_x),
                                     dy = step_y * signed_index(row, sines_.size_y);
                        if (std::max(std::abs(dx), std::abs(dy)) > radius + std::max(step_x, step_y)) continue;
                        // The edge falls over one sample, so that the disc has its area on a coarse grid too.
                        const double inside =
                            std::clamp((radius - std::hypot(dx, dy)) / std::max(step_x, step_y) + 0.5, 0.0, 1.0);
                        if (inside == 0) continue;
                        area += inside * inside * step_x * step_y;
                        const double scale =
                            inside / (static_cast<double>(sines_.size_x) * static_cast<double>(sines_.size_y));
                        pupil(row, column) = Complex(std::polar(scale, 2 * std::numbers::pi * defocus(nx, ny, dx, dy)));
                    }
                lens.area = area;
            }
        lenses_.push_back(std::move(lens));
    }
}

Film::~Film() = default;
Film::Film(Film&&) noexcept = default;

Film::SineGrid Film::choose_grid(std::span<const Camera> cameras) const {
    // The directions of the whole hologram, found along its edge.
    const Grid& plane = hologram_.plane;
    Range x, y;
    for (int i = 0; i <= 64; ++i) {
        const double across = plane.center_x + plane.size_x() * (i / 64.0 - 0.5);
        const double along = plane.center_y + plane.size_y() * (i / 64.0 - 0.5);
        for (double end : {-0.5, 0.5}) {
            const double edge_x = plane.center_x + plane.size_x() * end, edge_y = plane.center_y + plane.size_y() * end;
            x.include(band_.geometry.sine_x(across, edge_y));
            x.include(band_.geometry.sine_x(edge_x, along));
            y.include(band_.geometry.sine_y(across, edge_y));
            y.include(band_.geometry.sine_y(edge_x, along));
        }
    }
    double blur = 0;
    const double R = band_.geometry.eye().z;
    for (const Camera& camera : cameras)
        blur = std::max(blur, camera.pupil * std::abs(1 / R - 1 / (R + camera.focus_depth)));
    SineGrid grid;
    // Nowhere coarser than the band itself, which has room for the pupil and its intensity: so nothing folds back.
    grid.step = std::min(band_.plane.pitch_x, band_.plane.pitch_y) * least_slope();
    // What is out of focus spreads by the blur; room for it keeps it from coming in again at the other side.
    const auto choose = [&](const Range& range, std::size_t& size, double& first) {
        const double wanted = (range.high - range.low + blur) / grid.step + 8;
        size = good_fft_size(static_cast<std::size_t>(std::ceil(wanted)));
        // Rows that are a large power of two apart fall on each other in the caches: ten times slower.
        while (size % 128 == 0) size = good_fft_size(size + 1);
        first = 0.5 * (range.low + range.high) - 0.5 * static_cast<double>(size - 1) * grid.step;
    };
    choose(x, grid.size_x, grid.first_x);
    choose(y, grid.size_y, grid.first_y);
    return grid;
}

double Film::least_slope() const {
    // dn_x/dx = (1 - n_x²)/r, and the same in y, are least at the corners that are farthest from the eye.
    const Grid& plane = hologram_.plane;
    double least = std::numeric_limits<double>::infinity();
    for (double x : {plane.center_x - plane.size_x() / 2, plane.center_x + plane.size_x() / 2})
        for (double y : {plane.center_y - plane.size_y() / 2, plane.center_y + plane.size_y() / 2}) {
            const double sine = std::max(std::abs(band_.geometry.sine_x(x, y)), std::abs(band_.geometry.sine_y(x, y)));
            least = std::min(least, (1 - sine * sine) / band_.geometry.distance(x, y));
        }
    return least;
}

Array<Complex, 2> Film::resample(View<const Complex, 2> band) const {
    const Grid& plane = band_.plane;
    const ViewGeometry& geometry = band_.geometry;
    const InterpolationTable& table = interpolation();
    // Two passes, each along one axis: first to uniform n_x on the band's own rows; then down the columns, on which n_x
    // is constant, to uniform n_y. Stored transposed in between, so that both passes run along memory.
    Array<Complex, 2> columns({sines_.size_x, plane.height});
    const Vec3 eye = geometry.eye();
    // On a row the point of sine n_x lies at x = c_x + n_x/√(1 − n_x²) · √((y − c_y)² + c_z²).
    std::vector<double> slopes(sines_.size_x);
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        const double nx = sines_.first_x + static_cast<double>(i) * sines_.step;
        slopes[i] = nx / std::sqrt(1 - nx * nx);
    }
    const double middle_x = plane.column(eye.x), middle_y = plane.row(eye.y);
    for (std::size_t row = 0; row < plane.height; ++row) {
        const double reach = std::hypot(plane.y(static_cast<double>(row)) - eye.y, eye.z) / plane.pitch_x;
        for (std::size_t i = 0; i < sines_.size_x; ++i)
            columns(i, row) = table.at(&band(row, 0), plane.width, middle_x + slopes[i] * reach);
    }
    Array<Complex, 2> result({sines_.size_y, sines_.size_x});
    const double reach = eye.z / plane.pitch_y;
    for (std::size_t i = 0; i < sines_.size_x; ++i) {
        const double nx = sines_.first_x + static_cast<double>(i) * sines_.step;
        for (std::size_t j = 0; j < sines_.size_y; ++j) {
            const double ny = sines_.first_y + static_cast<double>(j) * sines_.step;
            result(j, i) =
                table.at(&columns(i, 0), plane.height, middle_y - reach * ny / std::sqrt(1 - nx * nx - ny * ny));
        }
    }
    return result;
}

std::vector<Array<float, 2>> Film::expose(View<const Complex, 2> band) const {
    Array<Complex, 2> spectrum = resample(band);
    fft_->forward(spectrum);
    std::vector<Array<float, 2>> films;
    Array<Complex, 2> field(spectrum.shape());
    for (const Lens& lens : lenses_) {
        Array<float, 2>& film = films.emplace_back(spectrum.shape());
        for (std::size_t node = 0; node < lens.pupils.size(); ++node) {
            multiply(spectrum.data(), lens.pupils[node].data(), field.elements());
            fft_->backward(field);
            // Between nodes the intensities cross over linearly.
            const auto weight = [](std::size_t k, std::size_t size, std::size_t at, std::size_t nodes) {
                const double place =
                    (static_cast<double>(k) + 0.5) / static_cast<double>(size) * static_cast<double>(nodes) - 0.5;
                const double held = std::clamp(place, 0.0, static_cast<double>(nodes) - 1);
                return std::max(0.0, 1 - std::abs(held - static_cast<double>(at)));
            };
            const std::size_t at_x = node % lens.nodes_x, at_y = node / lens.nodes_x;
            std::vector<float> across(sines_.size_x);
            for (std::size_t i = 0; i < sines_.size_x; ++i)
                across[i] = static_cast<float>(weight(i, sines_.size_x, at_x, lens.nodes_x));
            for (std::size_t j = 0; j < sines_.size_y; ++j) {
                const auto down = static_cast<float>(weight(j, sines_.size_y, at_y, lens.nodes_y));
                if (down == 0) continue;
                for (std::size_t i = 0; i < sines_.size_x; ++i) film(j, i) += down * across[i] * std::norm(field(j, i));
            }
        }
    }
    return films;
}

Image Film::develop(std::size_t index, View<const float, 2> intensity) const {
    const Lens& lens = lenses_[index];
    const Grid& picture = lens.camera.picture;
    const ViewGeometry& geometry = band_.geometry;
    Image image(picture.width, picture.height, 1);
    // About a point a pixel for every sample of the film.
    const double film_pitch = sines_.step * geometry.eye().z;
    const auto sub_x = static_cast<std::size_t>(std::max(2.0, std::ceil(picture.pitch_x / film_pitch)));
    const auto sub_y = static_cast<std::size_t>(std::max(2.0, std::ceil(picture.pitch_y / film_pitch)));
    const Grid& plane = hologram_.plane;
    parallel_for(picture.height, [&](std::size_t row) {
        for (std::size_t column = 0; column < picture.width; ++column) {
            double sum = 0;
            for (std::size_t b = 0; b < sub_y; ++b)
                for (std::size_t a = 0; a < sub_x; ++a) {
                    const double x = picture.x(static_cast<double>(column) +
                                               (static_cast<double>(a) + 0.5) / static_cast<double>(sub_x) - 0.5);
                    const double y = picture.y(static_cast<double>(row) +
                                               (static_cast<double>(b) + 0.5) / static_cast<double>(sub_y) - 0.5);
                    if (std::abs(x - plane.center_x) > 0.5 * plane.size_x() ||
                        std::abs(y - plane.center_y) > 0.5 * plane.size_y())
                        continue;
                    const double i = (geometry.sine_x(x, y) - sines_.first_x) / sines_.step;
                    const double j = (geometry.sine_y(x, y) - sines_.first_y) / sines_.step;
                    const double value = cubic_at(intensity, j, i);
                    // A diffuse surface of radiance L sends L cos θ · (area of the pupil) cos θ/r² through this band,
                    // and its plane waves have 1/cos θ of that as |F|² (docs/notation.md section 4).
                    const double r = geometry.distance(x, y);
                    sum += value * r * r / (geometry.cosine(x, y) * lens.area);
                }
            image.pixels(row, column, 0) = static_cast<float>(sum / static_cast<double>(sub_x * sub_y));
        }
    });
    return image;
}

}  // namespace hogel
