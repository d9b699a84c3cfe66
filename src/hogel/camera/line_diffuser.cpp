// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/line_diffuser.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hogel/camera/film/film.h"
#include "hogel/camera/narrow_band/narrow_band.h"
#include "hogel/camera/photograph_plan.h"
#include "hogel/camera/view_geometry.h"
#include "hogel/core/rates.h"
#include "hogel/image/film.h"
#include "hogel/work/parallel.h"

namespace hogel::camera {
namespace {

// Returns the number of thin rows per line, narrow enough for the widest pupil; only the middle one is nonzero. It is
// odd, so that there is a middle row.
std::size_t rows_in_line(const FieldGrid& hologram, std::span<const Camera> cameras) {
    constexpr double rows_in_cell = 12;  // the narrow band is decimated to 4
    double cell = hologram.plane.pitch_y;
    for (const Camera& camera : cameras) cell = std::min(cell, resolution_cell(camera, hologram.wavelength));
    const double rows = rows_in_cell * hologram.plane.pitch_y / cell;
    return 2 * static_cast<std::size_t>(std::ceil(std::max(0.0, 0.5 * (rows - 1)))) + 1;
}

// Returns the grid of thin rows, with an empty line above and below the hologram to show the diffraction beyond it.
FieldGrid thin_rows(const FieldGrid& hologram, std::size_t rows) {
    FieldGrid thin = hologram;
    thin.plane.height = (thin.plane.height + 2) * rows;
    thin.plane.pitch_y /= static_cast<double>(rows);
    return thin;
}

// Lines of a hologram, each as one thin row in its middle; other rows are zero. Each look shows the lines `first`,
// `first` + `every`, … of a look of the hologram. So one photograph of all looks is the mean over `every` sets of
// lines, which share the lens and the development of the film.
class ThinLines final : public FieldSource {
  public:
    ThinLines(const FieldSource& hologram, std::size_t rows, std::size_t every)
        : hologram_(hologram), rows_(rows), every_(every), grid_(thin_rows(hologram.grid(), rows)) {}

    const FieldGrid& grid() const override { return grid_; }
    std::size_t looks() const override { return hologram_.looks() * every_; }
    const Provenance& provenance() const override { return hologram_.provenance(); }

    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override {
        validate(region, grid_, out.shape());
        for (std::size_t y = 0; y < region.height; ++y) {
            if (const std::size_t line = (region.y0 + y) / rows_;
                shines(line, (region.y0 + y) % rows_, look % every_)) {
                Array<std::complex<float>, 2> samples({1, region.width});
                hologram_.read({region.x0, line - 1, region.width, 1}, look / every_, samples);
                std::ranges::copy(samples.elements(), &out(y, 0));
            } else {
                std::fill_n(&out(y, 0), region.width, std::complex<float>());
            }
        }
    }

  private:
    // Lines are counted from the empty one above the hologram.
    bool shines(std::size_t line, std::size_t row, std::size_t first) const {
        return row == rows_ / 2 && line >= 1 && line <= hologram_.grid().plane.height && line - 1 >= first &&
               (line - 1 - first) % every_ == 0;
    }

    const FieldSource& hologram_;
    std::size_t rows_, every_;
    FieldGrid grid_;
};

// Returns the distance, in lines, at which the light of two lines no longer overlaps.
std::size_t lines_between(const FieldGrid& hologram, std::span<const Camera> cameras, double separation) {
    const Grid& plane = hologram.plane;
    double distance = 0;
    for (const Camera& camera : cameras) {
        const ViewGeometry geometry(camera.eye, hologram.wavelength);
        double farthest = 0;
        for (const double x : {plane.center_x - plane.size_x() / 2, plane.center_x + plane.size_x() / 2})
            for (const double y : {plane.center_y - plane.size_y() / 2, plane.center_y + plane.size_y() / 2})
                farthest = std::max(farthest, geometry.distance(x, y));
        // A step of the sines is r/cos² θ wide on the plane.
        const double cosine = camera.eye.z / farthest;
        distance = std::max(distance, farthest / (cosine * cosine) *
                                          (separation * hologram.wavelength / camera.pupil + defocus_blur(camera)));
    }
    const double lines = std::ceil(distance / plane.pitch_y);
    return lines < static_cast<double>(plane.height) ? static_cast<std::size_t>(std::max(1.0, lines)) : plane.height;
}

// A picture of thin lines in rows fine enough to be spread to the height of the lines: `share` rows per row of the
// camera's picture, and `margin_rows` rows above and below for light that spreads into the picture.
struct FineRows {
    std::size_t share = 1, margin_rows = 0;
    Camera camera;

    FineRows(const Camera& coarse, double line_height) : camera(coarse) {
        constexpr double rows_in_line = 16;
        Grid& picture = camera.picture;
        share =
            std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(rows_in_line * picture.pitch_y / line_height)));
        picture.pitch_y /= static_cast<double>(share);
        margin_rows = static_cast<std::size_t>(std::ceil(0.5 * line_height / picture.pitch_y));
        picture.height = share * picture.height + 2 * margin_rows;
    }

    // Returns the integral of the overlap of a pixel of height `pixel` and a line of height `line` over the distance of
    // their middles, from −∞ to y, divided by pixel · line: 0 to 1.
    static double overlap_up_to(double y, double pixel, double line) {
        const double flat = 0.5 * std::abs(pixel - line), end = 0.5 * (pixel + line), top = std::min(pixel, line);
        const auto integral = [&](double y_value) {  // for y_value <= 0
            if (y_value <= -end) return 0.0;
            if (y_value <= -flat) return 0.5 * (y_value + end) * (y_value + end);
            return 0.5 * top * top + top * (y_value + flat);
        };
        const double area = pixel * line;
        return y <= 0 ? integral(y) / area : 1 - integral(-y) / area;
    }

    // Spreads thin lines to this height, and adds them to the camera's picture, `factor` times as bright.
    void spread(const Image& fine, double line_height, double factor, Image& picture) const {
        const double row = camera.picture.pitch_y, pixel = row * static_cast<double>(share);
        std::vector<float> weights(share + 2 * margin_rows);
        for (std::size_t i = 0; i < weights.size(); ++i) {
            const double low = (static_cast<double>(i) - 0.5 * static_cast<double>(weights.size())) * row;
            // `share` fine rows form a pixel.
            weights[i] = static_cast<float>(
                factor * (overlap_up_to(low + row, pixel, line_height) - overlap_up_to(low, pixel, line_height)));
        }
        work::parallel_for(picture.height(), [&](std::size_t y) {
            for (std::size_t i = 0; i < weights.size(); ++i)
                for (std::size_t x = 0; x < picture.width(); ++x)
                    picture.pixels(y, x, 0) += weights[i] * fine.pixels(share * y + i, x, 0);
        });
    }
};

BandCamera without_diffuser(BandCamera model) {
    model.vertical_diffuser = false;
    return model;
}

void require_lines(const BandCamera& model) {
    if (model.source == BandSource::hogel_spectra)
        throw Error(ErrorCode::usage, "camera",
                    "a photograph behind a vertical diffuser needs samples, not hogel spectra");
}

double seconds_of_films(const FieldGrid& rows, std::span<const Camera> cameras) {
    double seconds = 0;
    for (const SharedViewpoint& viewpoint : group_by_viewpoint(cameras)) {
        const Vec3& position = cameras[viewpoint.members.front()].eye;
        const narrow_band::NarrowBand band(rows, position, viewpoint.pupil);
        const Rectangle active = illuminated_area(rows, position, viewpoint.pupil, viewpoint.blur);
        const film::FilmSize film(band, rows, film_area(rows.plane, viewpoint.pictures, active), viewpoint.pupil,
                                  viewpoint.blur);
        seconds += static_cast<double>(film.sines.size_x * film.sines.size_y) * core::rates::sine_of_lines +
                   static_cast<double>(viewpoint.members.size() * film.x.size * film.y.size) *
                       core::rates::film_sample_of_lines;
    }
    return seconds;
}

}  // namespace

void require_photographs_of_lines(const FieldGrid& hologram, std::span<const Camera> cameras, const BandCamera& model) {
    require_lines(model);
    for (const Camera& camera : cameras) validate(camera);
    require_photographs(thin_rows(hologram, rows_in_line(hologram, cameras)), cameras, without_diffuser(model));
}

void photograph_lines(const FieldSource& hologram, std::span<const Camera> cameras, const BandCamera& model,
                      std::span<Image> pictures, const Progress& progress, double separation) {
    require_photographs_of_lines(hologram.grid(), cameras, model);
    image::load_film(cameras, 1, hologram.provenance(), pictures);
    const double line_height = hologram.grid().plane.pitch_y;
    const std::size_t rows = rows_in_line(hologram.grid(), cameras);
    const std::size_t every = lines_between(hologram.grid(), cameras, separation);
    std::vector<FineRows> fine;
    std::vector<Camera> fine_cameras;
    for (const Camera& camera : cameras) {
        fine.emplace_back(camera, line_height);
        fine_cameras.push_back(fine.back().camera);
    }
    std::vector<Image> fine_pictures(cameras.size());
    photograph_into(ThinLines(hologram, rows, every), fine_cameras, without_diffuser(model), fine_pictures, progress);
    // A thin row has `rows` times the amplitude of a whole line; the picture is a mean over the sets, not their sum.
    const double factor = static_cast<double>(rows) * static_cast<double>(rows) * static_cast<double>(every);
    for (std::size_t i = 0; i < cameras.size(); ++i) fine[i].spread(fine_pictures[i], line_height, factor, pictures[i]);
}

Plan plan_lines(const FieldGrid& hologram, std::size_t looks, std::span<const Camera> cameras,
                const BandCamera& model) {
    require_photographs_of_lines(hologram, cameras, model);
    if (cameras.empty()) return {};
    const std::size_t photographs = looks * lines_between(hologram, cameras, lines_apart);
    const FieldGrid rows = thin_rows(hologram, rows_in_line(hologram, cameras));
    std::vector<Camera> fine_cameras;
    for (const Camera& camera : cameras) fine_cameras.push_back(FineRows(camera, hologram.plane.pitch_y).camera);
    Plan plan = hogel::plan_photographs(std::span(&rows, 1), photographs, fine_cameras, without_diffuser(model));
    for (const Camera& camera : fine_cameras)
        plan.memory += static_cast<double>(camera.picture.samples()) * sizeof(float);
    plan.seconds +=
        core::rates::on_all_threads(static_cast<double>(photographs) * seconds_of_films(rows, fine_cameras));
    return plan;
}

}  // namespace hogel::camera
