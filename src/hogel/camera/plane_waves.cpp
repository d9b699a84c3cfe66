// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>

#include "hogel/camera/film/interpolation.h"
#include "hogel/camera/models.h"
#include "hogel/camera/photograph_plan.h"
#include "hogel/camera/sine_grid.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/image/film.h"
#include "hogel/math/fft.h"
#include "hogel/optics/elements.h"
#include "hogel/optics/spectrum.h"
#include "hogel/optics/tilt.h"
#include "hogel/photograph.h"
#include "hogel/units.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel {

using namespace camera;
using namespace optics;

namespace {

// Relative widening of the pupil to select directions.
constexpr double edge_margin = 1.1;

// Returns the width over which directions beyond the widened pupil fade out: twice the width of the Fresnel fringes of
// a sharp selection, which would reach into the pupil.
double fade_width(double wavelength, double distance) { return 2 * std::sqrt(wavelength * distance); }

// Minimum number of resolution cells across the hologram. With fewer, light that spreads from the small opening wraps
// around. Root mean square errors against the direct sum, for random phases: 9 % with 4.3 cells, 17 % with 3, 35 % with
// 2.
constexpr double min_cells = 4;

struct PlaneWaveJob {
    const FieldSource& hologram;
    std::size_t look;
    const PlaneWaveCamera& options;
    Communicator* communicator;  // shares the transforms among its ranks; null: no MPI
};

bool is_tilted(const Camera& camera) { return camera.focus_slope_x != 0 || camera.focus_slope_y != 0; }

std::array<Vec3, 4> corners(const Rectangle& area) {
    return {{{area.left, area.bottom, 0},
             {area.right, area.bottom, 0},
             {area.left, area.top, 0},
             {area.right, area.top, 0}}};
}

Rectangle square_around(Vec3 viewpoint, double pupil) {
    return Rectangle(Grid{1, 1, pupil, pupil, viewpoint.x, viewpoint.y});
}

// Returns the number of samples across that represent the spectrum of a wave behind a pupil, with three per period of
// the finest wave of its intensity, which is interpolated.
std::size_t film_samples(std::size_t columns, double size, double pupil, double distance, double wavelength) {
    const double intensity = 3 * edge_margin * pupil / (wavelength * distance) * size;
    // Minimum number of samples across the opening.
    constexpr double samples_of_pupil = 16;
    const double opening = samples_of_pupil * size / pupil;
    return math::good_fft_size(static_cast<std::size_t>(std::ceil(
                                   std::max({edge_margin * static_cast<double>(columns), intensity, opening}))) +
                               16);
}

// Returns the area that a camera sees: the hologram and the illuminated surroundings in the picture. Work grows with
// the square of its width, so diffraction beside the hologram is followed no farther than the width of the hologram.
Rectangle seen_by(const Camera& camera, const FieldGrid& hologram) {
    const Grid& plane = hologram.plane;
    return film_area(plane, Rectangle(camera.picture),
                     illuminated_area(hologram, camera.eye, camera.pupil, defocus_blur(camera),
                                      std::max(plane.size_x(), plane.size_y())));
}

// Returns the smallest plane around this area with the centre of the hologram.
Grid plane_around(const Rectangle& area, const Grid& hologram) {
    const Rectangle hologram_area(hologram);
    return {1,
            1,
            hologram.size_x() + 2 * std::max(hologram_area.left - area.left, area.right - hologram_area.right),
            hologram.size_y() + 2 * std::max(hologram_area.bottom - area.bottom, area.top - hologram_area.top),
            hologram.center_x,
            hologram.center_y};
}

// Returns the wave just before a lens's opening, restricted to the directions between the hologram and the pupil.
Spectrum wave_at_lens(const PlaneWaveJob& job, std::span<const Camera> cameras, const SharedViewpoint& viewpoint,
                      const Progress& progress) {
    const Grid& plane = job.hologram.grid().plane;
    const Vec3 lens = cameras[viewpoint.members.front()].eye;
    const double wavelength = job.hologram.grid().wavelength, fade = fade_width(wavelength, lens.z);
    const double inner = edge_margin * viewpoint.pupil, pupil = inner + 2 * fade;
    // The window is padded for a focus behind the hologram and for a picture larger than it, which would otherwise wrap
    // around, and padded again for a later tilt.
    double spread = std::max(1.0, job.options.film_distance / lens.z);
    double width = plane.size_x(), height = plane.size_y();
    for (std::size_t i : viewpoint.members) {
        const Rectangle area = seen_by(cameras[i], job.hologram.grid());
        width = std::max(width, plane_around(area, plane).size_x());
        height = std::max(height, plane_around(area, plane).size_y());
        for (const Vec3& corner : corners(area))
            spread = std::max(spread, (is_tilted(cameras[i]) ? 2 : 1) * focus_ratio(cameras[i], corner.x, corner.y));
    }
    const Grid window = padded(plane, spread * (width + pupil), spread * (height + pupil));
    const Band band = band_between(Rectangle(plane), square_around(lens, pupil), lens.z, wavelength);
    Spectrum waves = spectrum_of(job.hologram, job.look, window, band, job.options.scratch, progress, job.communicator);
    propagate(waves, {lens.z, lens.x - plane.center_x, lens.y - plane.center_y, 0.5 * (plane.size_x() + inner),
                      0.5 * (plane.size_y() + inner), fade, fade});
    return waves;
}

// Returns the rows of a picture that an MPI rank computes. The root computes all rows of a tilted plane.
distributed::LineRange rows_of(std::size_t rank, const Camera& camera, const Communicator* communicator) {
    if (communicator == nullptr) return {0, camera.picture.height};
    if (is_tilted(camera)) return {0, rank == 0 ? camera.picture.height : 0};
    return distributed::lines_of(rank, communicator->size(), camera.picture.height, 1);
}

distributed::LineRange local_rows(const Camera& camera, const Communicator* communicator) {
    return rows_of(communicator != nullptr ? communicator->rank() : 0, camera, communicator);
}

// The wave of the picture. A point in focus is at the window's centre plus `scale` times its offset from `origin`.
struct FocusedWave {
    Wave wave;
    double pupil_area;
    Vec3 origin;
    Orientation axes;
    double scale = 1;
};

// Returns the point in focus on the line of sight through a point of the hologram plane.
Vec3 in_focus(const Camera& camera, double x, double y) {
    return camera.eye + focus_ratio(camera, x, y) * (Vec3{x, y, 0} - camera.eye);
}

// Returns the axes of the plane in focus, z = −focus_depth − slope_x x − slope_y y.
Orientation axes_in_focus(const Camera& camera) {
    const Vec3 x = normalize(Vec3{1, 0, -camera.focus_slope_x}), up{0, 1, -camera.focus_slope_y};
    return {x, normalize(up - dot(up, x) * x)};
}

// Returns the wave on the tilted plane in focus, from the wave on a parallel plane that crosses it in the middle.
// @param area  seen_by()
Wave on_tilted_plane(const Spectrum& waves, const Camera& camera, const Rectangle& area, Vec3 origin,
                     const Orientation& axes, const ScratchOptions& scratch) {
    // Size of the picture on the plane, and directions from there to the pupil.
    double half_x = 0, half_y = 0, nearest = camera.eye.z - origin.z;
    Band band{1e30, -1e30, 1e30, -1e30};
    const double pupil = edge_margin * camera.pupil;
    for (const Vec3& corner : corners(area)) {
        const Vec3 p = in_focus(camera, corner.x, corner.y);
        nearest = std::min(nearest, camera.eye.z - p.z);
        half_x = std::max(half_x, std::abs(dot(p - origin, axes.x)));
        half_y = std::max(half_y, std::abs(dot(p - origin, axes.y)));
        for (const Vec3& edge : corners(square_around(camera.eye, pupil))) {
            const Vec3 direction = normalize(Vec3{edge.x, edge.y, camera.eye.z} - p) / waves.wavelength;
            const double fx = dot(direction, axes.x), fy = dot(direction, axes.y);
            band = {std::min(band.low_x, fx), std::max(band.high_x, fx), std::min(band.low_y, fy),
                    std::max(band.high_y, fy)};
        }
    }
    // Light out of focus spreads over a larger area.
    const double size_x = 4 * half_x + pupil, size_y = 4 * half_y + pupil;
    const auto samples = [&](double size, double low, double high) {
        return film_samples(static_cast<std::size_t>(std::ceil(size * (high - low))), size, camera.pupil, nearest,
                            waves.wavelength);
    };
    const std::size_t width = samples(size_x, band.low_x, band.high_x);
    const std::size_t height = samples(size_y, band.low_y, band.high_y);
    const Grid window{width, height, size_x / static_cast<double>(width), size_y / static_cast<double>(height), 0, 0};
    return wave_of(tilt(waves, axes, window, band, scratch), width, height, scratch);
}

// Returns the rows of a film parallel to the hologram that show these rows of a picture, with a margin.
distributed::LineRange film_rows(const Grid& plane, double scale, Vec3 origin, const Camera& camera,
                                 const distributed::LineRange& picture) {
    if (picture.count == 0) return {};
    constexpr double margin_rows = 8;
    const auto row = [&](double picture_row) {
        const Vec3 p = in_focus(camera, camera.picture.center_x, camera.picture.y(picture_row));
        return plane.row(plane.center_y + scale * (p.y - origin.y));
    };
    const auto [low, high] =
        std::minmax({row(static_cast<double>(picture.first) - 1), row(static_cast<double>(picture.end()))});
    const auto clamped = [&](double value) {
        return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(plane.height)));
    };
    const std::size_t first = clamped(std::floor(low - margin_rows));
    return {first, clamped(std::ceil(high + margin_rows)) - first};
}

// Returns the effective width of the pupil seen from the plane in focus, with the middle of the plane `m` times as far
// from the lens as the hologram. The whole pupil counts, however far out of focus the hologram is: a narrower cone
// holds the hologram's light, but not the diffraction at the rim. Nearer parts of a tilted plane see the pupil more
// obliquely.
double width_towards_focus(const Camera& camera, double m, const Rectangle& area) {
    double nearer = 1;
    for (const Vec3& corner : corners(area)) nearer = std::max(nearer, m / focus_ratio(camera, corner.x, corner.y));
    return edge_margin * camera.pupil * nearer;
}

// Returns the band of all frequencies that the samples of a wave represent.
Band band_of(const Wave& wave) {
    const Grid& plane = wave.grid().plane;
    return {wave.carrier_x - 0.5 / plane.pitch_x, wave.carrier_x + 0.5 / plane.pitch_x,
            wave.carrier_y - 0.5 / plane.pitch_y, wave.carrier_y + 0.5 / plane.pitch_y};
}

// Returns the wave on the film. A perfect lens images the plane in focus: the wave in the opening is propagated back to
// that plane through empty space. A thin lens bends the light towards a film behind it, with aberrations. Each MPI rank
// receives the rows for local_rows() of the picture.
std::optional<FocusedWave> wave_in_focus(const Spectrum& at_lens, const Camera& camera, const Grid& hologram,
                                         const PlaneWaveCamera& options, Communicator* communicator) {
    const Rectangle area = seen_by(camera, {hologram, at_lens.wavelength});
    const Grid plane_seen = plane_around(area, hologram);
    const double wavelength = at_lens.wavelength, R = camera.eye.z;
    const double m = focus_ratio(camera, hologram.center_x, hologram.center_y), b = options.film_distance;
    const double focal_length = b > 0 ? 1 / (1 / (m * R) + 1 / b) : 0;
    const Grid& window = at_lens.window;
    const auto samples = [&](std::size_t columns, double size) {
        if (b == 0) return film_samples(columns, size, camera.pupil, R, wavelength);
        // Additional columns for the frequencies that the lens adds.
        const auto bent = static_cast<std::size_t>(size * edge_margin * camera.pupil / (wavelength * focal_length));
        return film_samples(columns + bent, size, camera.pupil, b, wavelength);
    };
    // The wave repeats in the directions with the period λ/pitch.
    const ViewGeometry geometry(camera.eye, wavelength);
    const SineRanges hologram_sines = sines_of(geometry, hologram), shown = sines_of(geometry, plane_seen);
    const double blur = defocus_blur(camera), cell = wavelength / camera.pupil;
    const SpreadWindow spread(hologram_sines.x.span(), hologram_sines.y.span(), blur, cell);
    const auto samples_for_period = [&](std::size_t columns, double size, double farthest) {
        const double period = farthest + spread.stop + 0.5 * blur;
        const auto count = static_cast<std::size_t>(std::ceil(size * period / wavelength));
        return std::max(samples(columns, size), math::good_fft_size(count));
    };
    const std::size_t width =
        samples_for_period(at_lens.width(), window.size_x(), SineGrid::farthest(hologram_sines.x, shown.x));
    const std::size_t height =
        samples_for_period(at_lens.height(), window.size_y(), SineGrid::farthest(hologram_sines.y, shown.y));
    const double pupil_area = 0.25 * std::numbers::pi * camera.pupil * camera.pupil *
                              (1 - light_left_out(spread, hologram_sines.x.span(), hologram_sines.y.span(), cell));
    Spectrum spectrum = [&] {
        Wave lens = wave_of(at_lens, width, height, options.scratch, communicator);
        circular_aperture(lens, camera.eye.x, camera.eye.y, camera.pupil, PupilEdge(spread, wavelength));
        if (b > 0)
            thin_lens(lens, camera.eye.x, camera.eye.y, edge_margin * camera.pupil, focal_length);
        else
            weigh_alike(lens, camera.eye.x, camera.eye.y,
                        in_focus(camera, hologram.center_x, hologram.center_y) - camera.eye);
        return spectrum_of(lens, lens.grid().plane, band_of(lens), options.scratch, {}, communicator);
    }();
    // The distance to propagate, and the magnification of the picture there.
    const double distance = b > 0 ? b : -m * R, magnification = std::abs(distance) / R;
    const double pupil = width_towards_focus(camera, m, area), fade = magnification * fade_width(wavelength, R);
    propagate(spectrum,
              {distance, distance / R * (camera.eye.x - hologram.center_x),
               distance / R * (camera.eye.y - hologram.center_y), 0.5 * (magnification * plane_seen.size_x() + pupil),
               0.5 * (magnification * plane_seen.size_y() + pupil), fade, fade});
    const Vec3 origin = in_focus(camera, hologram.center_x, hologram.center_y);
    if (is_tilted(camera)) {
        const Orientation axes = axes_in_focus(camera);
        if (communicator != nullptr) spectrum = gathered(std::move(spectrum), *communicator, options.scratch);
        if (!is_root_rank()) return std::nullopt;
        return FocusedWave{on_tilted_plane(spectrum, camera, area, origin, axes, options.scratch), pupil_area, origin,
                           axes};
    }
    const double scale = b > 0 ? -b / (m * R) : 1;
    if (communicator == nullptr)
        return FocusedWave{wave_of(spectrum, width, height, options.scratch), pupil_area, origin, {}, scale};
    const Grid plane = grid_of(spectrum, width, height);
    const auto rows_of_rank = [&](std::size_t rank) {
        return film_rows(plane, scale, origin, camera, rows_of(rank, camera, communicator));
    };
    return FocusedWave{wave_of(std::move(spectrum), width, height, options.scratch, *communicator, rows_of_rank),
                       pupil_area,
                       origin,
                       {},
                       scale};
}

// Adds rows of the picture as radiance, see docs/notation.md, section 4.
void expose(const FocusedWave& focused, const Camera& camera, const distributed::LineRange& rows,
            const Rectangle& shown, double weight, Image& image) {
    const Grid& picture = camera.picture;
    const Grid& plane = focused.wave.grid().plane;
    const double R = camera.eye.z, m = focus_ratio(camera, picture.center_x, picture.center_y);
    const double magnification = m * std::abs(focused.scale);
    const auto points = [&](double pixel, double sample) {
        return 2 * static_cast<std::size_t>(std::max(1.0, std::ceil(0.5 * pixel * magnification / sample)));
    };
    const std::size_t sub_x = points(picture.pitch_x, plane.pitch_x), sub_y = points(picture.pitch_y, plane.pitch_y);
    const View<const std::complex<float>, 2> samples = focused.wave.samples.view();
    const std::size_t first = focused.wave.rows.first;
    const auto intensity = [&](std::size_t row, std::size_t column) { return std::norm(samples(row - first, column)); };
    work::parallel_for(rows.count, [&](std::size_t i) {
        const std::size_t row = rows.first + i;
        for (std::size_t column = 0; column < picture.width; ++column) {
            double sum = 0;
            for (std::size_t b = 0; b < sub_y; ++b)
                for (std::size_t a = 0; a < sub_x; ++a) {
                    const double x = picture.x(static_cast<double>(column) + film::gauss_position(a, sub_x));
                    const double y = picture.y(static_cast<double>(row) + film::gauss_position(b, sub_y));
                    if (!shown.holds(x, y)) continue;
                    const Vec3 p = in_focus(camera, x, y), offset = focused.scale * (p - focused.origin);
                    // Interpolation may undershoot between dark samples.
                    const double value = std::max(
                        0.0f, film::smooth_at<film::SixPoint>(
                                  plane.height, plane.width, plane.row(plane.center_y + dot(offset, focused.axes.y)),
                                  plane.column(plane.center_x + dot(offset, focused.axes.x)), intensity));
                    const double r = length(p - camera.eye), z_distance = R * focus_ratio(camera, x, y);
                    sum += value * focused.scale * focused.scale * r * r * r / (z_distance * focused.pupil_area);
                }
            image.pixels(row, column, 0) += static_cast<float>(weight * sum / static_cast<double>(sub_x * sub_y));
        }
    });
}

// e^{2πi cycles}.
std::complex<float> phasor(double cycles) {
    return std::polar(1.0f, static_cast<float>(2 * std::numbers::pi * (cycles - std::floor(cycles))));
}

// Returns the wave at the points in focus of the pixels' centres, for rows of the picture, see waves_in_focus().
Array<std::complex<float>, 2> wave_at_pixels(const FocusedWave& focused, const Camera& camera,
                                             const distributed::LineRange& rows, const Rectangle& shown) {
    const Grid& picture = camera.picture;
    const Wave& wave = focused.wave;
    const Grid& plane = wave.grid().plane;
    const View<const std::complex<float>, 2> samples = wave.samples.view();
    // Without its carrier the wave varies slowly enough for interpolation.
    std::vector<std::complex<float>> carrier_x_phasors(plane.width), carrier_y_phasors(plane.height);
    for (std::size_t i = 0; i < plane.width; ++i)
        carrier_x_phasors[i] = phasor(-wave.carrier_x * (plane.x(static_cast<double>(i)) - plane.center_x));
    for (std::size_t j = 0; j < plane.height; ++j)
        carrier_y_phasors[j] = phasor(-wave.carrier_y * (plane.y(static_cast<double>(j)) - plane.center_y));
    Array<std::complex<float>, 2> result({picture.height, picture.width});
    const std::size_t first = wave.rows.first;
    work::parallel_for(rows.count, [&](std::size_t line) {
        const std::size_t row = rows.first + line;
        for (std::size_t column = 0; column < picture.width; ++column) {
            const double x = picture.x(static_cast<double>(column)), y = picture.y(static_cast<double>(row));
            if (!shown.holds(x, y)) continue;
            const Vec3 p = in_focus(camera, x, y), offset = p - focused.origin;
            const double right = dot(offset, focused.axes.x), above = dot(offset, focused.axes.y);
            const std::complex<float> demodulated = film::smooth_at<film::SixPoint>(
                plane.height, plane.width, plane.row(plane.center_y + above), plane.column(plane.center_x + right),
                [&](std::size_t j, std::size_t i) {
                    return carrier_y_phasors[j] * carrier_x_phasors[i] * samples(j - first, i);
                });
            const double cycles =
                wave.carrier_x * right + wave.carrier_y * above + length(p - camera.eye) / wave.grid().wavelength;
            result(row, column) = demodulated * phasor(cycles);
        }
    });
    return result;
}

// Gives all ranks the rows of a picture that each has computed.
template <class Value>
void share_rows(Communicator& communicator, const Camera& camera, Value* picture, std::size_t width) {
    distributed::share_lines(communicator, picture, width,
                             [&](std::size_t rank) { return rows_of(rank, camera, &communicator); });
}

template <class Visit>
void focus_all(const PlaneWaveJob& job, std::span<const Camera> cameras, const Progress& progress, const Visit& visit) {
    const std::vector<SharedViewpoint> viewpoints = group_by_viewpoint(cameras);
    for (std::size_t e = 0; e < viewpoints.size(); ++e) {
        const auto part = [&](double fraction) {
            return (static_cast<double>(e) + fraction) / static_cast<double>(viewpoints.size());
        };
        const auto report = [&](double fraction) { return !progress || progress(part(0.5 * fraction)); };
        const Spectrum waves = wave_at_lens(job, cameras, viewpoints[e], report);
        for (std::size_t i : viewpoints[e].members)
            if (const std::optional<FocusedWave> focused =
                    wave_in_focus(waves, cameras[i], job.hologram.grid().plane, job.options, job.communicator))
                visit(i, *focused);
        progress.report(part(1));
    }
}

}  // namespace

void camera::require_by_plane_waves(const FieldGrid& hologram, std::span<const Camera> cameras,
                                    const PlaneWaveCamera& model) {
    const double film = model.film_distance;
    if (!std::isfinite(film) || film < 0)
        throw Error(ErrorCode::usage, "film_distance",
                    fmt::format("the film is {} m behind its lens; expected a finite distance of at least 0", film));
    for (const Camera& camera : cameras) {
        require_light_towards(hologram, camera);
        require_resolution(hologram, camera, min_cells);
        if (film > 0 && film < camera.pupil)
            throw Error(ErrorCode::usage, "film_distance",
                        fmt::format("a film {} behind a thin lens of {}: nearer than the lens is wide",
                                    format_length(film), format_length(camera.pupil)));
        if (film > 0 && is_tilted(camera))
            throw Error(ErrorCode::usage, "focus_tilt",
                        "behind a thin lens the film is parallel to the hologram; it cannot be tilted");
    }
}

void camera::photograph_by(const FieldSource& hologram, std::span<const Camera> cameras, const PlaneWaveCamera& model,
                           std::span<Image> images, const Progress& progress) {
    require_by_plane_waves(hologram.grid(), cameras, model);
    image::load_film(cameras, 1, hologram.provenance(), images);
    const auto looks = static_cast<double>(hologram.looks());
    Communicator* const communicator = work::communicator_of_several();
    for (std::size_t look = 0; look < hologram.looks(); ++look) {
        const auto report = [&](double fraction) {
            return !progress || progress((static_cast<double>(look) + fraction) / looks);
        };
        focus_all({hologram, look, model, communicator}, cameras, report,
                  [&](std::size_t i, const FocusedWave& focused) {
                      expose(focused, cameras[i], local_rows(cameras[i], communicator),
                             seen_by(cameras[i], hologram.grid()), 1 / looks, images[i]);
                  });
    }
    for (std::size_t i = 0; communicator != nullptr && i < images.size(); ++i)
        share_rows(*communicator, cameras[i], images[i].pixels.data(),
                   images[i].pixels.size() / cameras[i].picture.height);
}

std::vector<Array<std::complex<float>, 2>> waves_in_focus(const FieldSource& hologram, std::size_t look,
                                                          std::span<const Camera> cameras, const PlaneWaveCamera& model,
                                                          const Progress& progress) {
    const core::StopScope scope(progress);
    if (model.film_distance != 0)
        throw Error(ErrorCode::usage, "film_distance",
                    "waves in focus are those of a perfect lens, which has no film distance");
    require_by_plane_waves(hologram.grid(), cameras, model);
    std::vector<Array<std::complex<float>, 2>> waves(cameras.size());
    Communicator* const communicator = work::communicator_of_several();
    focus_all({hologram, look, model, communicator}, cameras, progress, [&](std::size_t i, const FocusedWave& focused) {
        waves[i] = wave_at_pixels(focused, cameras[i], local_rows(cameras[i], communicator),
                                  seen_by(cameras[i], hologram.grid()));
    });
    for (std::size_t i = 0; communicator != nullptr && i < waves.size(); ++i) {
        const Grid& picture = cameras[i].picture;
        if (waves[i].size() == 0) waves[i] = Array<std::complex<float>, 2>({picture.height, picture.width});
        share_rows(*communicator, cameras[i], waves[i].data(), picture.width);
    }
    return waves;
}

}  // namespace hogel
