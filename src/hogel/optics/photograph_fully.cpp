#include <algorithm>
#include <cmath>

#include "hogel/core/error.h"
#include "hogel/core/parallel.h"
#include "hogel/math/fft.h"
#include "hogel/optics/elements.h"
#include "hogel/optics/film_interpolation_internal.h"
#include "hogel/optics/photograph.h"
#include "hogel/optics/photograph_plan_internal.h"
#include "hogel/optics/spectrum.h"

namespace hogel {
namespace {

// The pupil is taken this much wider where directions are chosen, so that its sharp edge diffracts as it should.
constexpr double edge_room = 1.1;

struct Chain {
    const FieldSource& hologram;
    std::size_t look;
    const Scratch& scratch;
};

// A square around an eye's pupil.
Rectangle around(Vec3 eye, double pupil) { return Rectangle(Grid{1, 1, pupil, pupil, eye.x, eye.y}); }

// Samples across that hold the spectrum of a wave behind a pupil, and three to the finest wave of its intensity, which
// is interpolated.
std::size_t film_samples(std::size_t columns, double size, double pupil, double distance, double wavelength) {
    const double intensity = 3 * edge_room * pupil / (wavelength * distance) * size;
    return good_fft_size(
        static_cast<std::size_t>(std::ceil(std::max(edge_room * static_cast<double>(columns), intensity))) + 16);
}

// The wave on the lens of one eye, just before its opening: the directions between the hologram and the pupil alone.
Spectrum wave_at_lens(const Chain& chain, std::span<const Camera> cameras, const SharedEye& eye,
                      const Progress& progress) {
    const Grid& plane = chain.hologram.grid().plane;
    const Vec3 lens = cameras[eye.members.front()].eye;
    const double pupil = edge_room * eye.pupil;
    // What a focus behind the hologram spreads over must not come in again at the other side of the window.
    double spread = 1;
    for (std::size_t i : eye.members) spread = std::max(spread, 1 + cameras[i].focus_depth / lens.z);
    const Grid window = padded(plane, spread * (plane.size_x() + pupil), spread * (plane.size_y() + pupil));
    const Band band = band_between(Rectangle(plane), around(lens, pupil), lens.z, chain.hologram.grid().wavelength);
    Spectrum waves = spectrum_of(chain.hologram, chain.look, window, band, chain.scratch, progress);
    propagate(waves, {lens.z, lens.x - plane.center_x, lens.y - plane.center_y, 0.5 * (plane.size_x() + pupil),
                      0.5 * (plane.size_y() + pupil)});
    return waves;
}

// What a perfect lens makes of the wave in its opening: the wave that would come from the plane in focus, were there
// nothing else. So light goes back to that plane, through nothing; the film shows it as large as the film is.
struct Focused {
    Wave wave;
    double pupil_area;
};

Focused wave_in_focus(const Spectrum& at_lens, const Camera& camera, const Grid& hologram, const Scratch& scratch) {
    const double wavelength = at_lens.wavelength, R = camera.eye.z, m = 1 + camera.focus_depth / R;
    const Grid& window = at_lens.window;
    const std::size_t width = film_samples(at_lens.width(), window.size_x(), camera.pupil, R, wavelength);
    const std::size_t height = film_samples(at_lens.height(), window.size_y(), camera.pupil, R, wavelength);
    double area = 0;
    Spectrum behind = [&] {
        Wave lens = wave_of(at_lens, width, height, scratch);
        area = circular_aperture(lens, camera.eye.x, camera.eye.y, camera.pupil);
        const Grid& plane = lens.grid().plane;
        const Band whole{lens.carrier_x - 0.5 / plane.pitch_x, lens.carrier_x + 0.5 / plane.pitch_x,
                         lens.carrier_y - 0.5 / plane.pitch_y, lens.carrier_y + 0.5 / plane.pitch_y};
        return spectrum_of(lens, plane, whole, scratch);
    }();
    const double pupil = edge_room * camera.pupil;
    propagate(behind, {-m * R, -m * (camera.eye.x - hologram.center_x), -m * (camera.eye.y - hologram.center_y),
                       0.5 * m * (hologram.size_x() + pupil), 0.5 * m * (hologram.size_y() + pupil)});
    return {wave_of(behind, width, height, scratch), area};
}

// Adds the picture, as radiance: see docs/notation.md, section 4.
void expose(const Focused& focused, const Camera& camera, const Rectangle& shown, double weight, Image& image) {
    const Grid& picture = camera.picture;
    const Grid& plane = focused.wave.grid().plane;
    const double R = camera.eye.z, m = 1 + camera.focus_depth / R;
    const auto points = [&](double pixel, double sample) {
        return static_cast<std::size_t>(std::max(2.0, std::ceil(pixel * m / sample)));
    };
    const std::size_t sub_x = points(picture.pitch_x, plane.pitch_x), sub_y = points(picture.pitch_y, plane.pitch_y);
    const View<const std::complex<float>, 2> samples = focused.wave.samples.view();
    const auto intensity = [&](std::size_t row, std::size_t column) { return std::norm(samples(row, column)); };
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
                    const Vec3 way = m * (Vec3{x, y, 0} - camera.eye);
                    const double value = cubic_at(samples.extent(0), samples.extent(1), plane.row(camera.eye.y + way.y),
                                                  plane.column(camera.eye.x + way.x), intensity);
                    const double r = length(way);
                    sum += value * r * r * r / (m * R * focused.pupil_area);
                }
            image.pixels(row, column, 0) += static_cast<float>(weight * sum / static_cast<double>(sub_x * sub_y));
        }
    });
}

}  // namespace

std::vector<Image> photograph_fully(const FieldSource& hologram, std::span<const Camera> cameras,
                                    const Progress& progress, const Scratch& scratch) {
    std::vector<std::size_t> all;
    std::vector<Image> images;
    for (const Camera& camera : cameras) {
        require_light_towards(hologram.grid(), camera);
        if (camera.focus_slope_x != 0 || camera.focus_slope_y != 0)
            throw Error(ErrorCode::usage, "the full camera's film is parallel to the hologram; it cannot be tilted");
        all.push_back(all.size());
        images.emplace_back(camera.picture.width, camera.picture.height, 1);
    }
    const std::vector<SharedEye> eyes = group_by_eye(cameras, all);
    const double parts = static_cast<double>(eyes.size() * hologram.looks());
    const Grid& plane = hologram.grid().plane;
    std::size_t done = 0;
    for (std::size_t look = 0; look < hologram.looks(); ++look)
        for (const SharedEye& eye : eyes) {
            const auto tell = [&](double fraction) {
                return !progress || progress((static_cast<double>(done) + 0.5 * fraction) / parts);
            };
            const Spectrum waves = wave_at_lens({hologram, look, scratch}, cameras, eye, tell);
            for (std::size_t i : eye.members)
                expose(wave_in_focus(waves, cameras[i], plane, scratch), cameras[i], Rectangle(plane),
                       1 / static_cast<double>(hologram.looks()), images[i]);
            report(progress, static_cast<double>(++done) / parts);
        }
    return images;
}

}  // namespace hogel
