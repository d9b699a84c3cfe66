// SPDX-License-Identifier: Apache-2.0
#include "hogel/photograph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/camera/band_sources.h"
#include "hogel/camera/exposed_bands.h"
#include "hogel/camera/line_diffuser.h"
#include "hogel/camera/models.h"
#include "hogel/camera/photograph_plan.h"
#include "hogel/camera/speckle_free/speckle_free.h"
#include "hogel/core/rates.h"
#include "hogel/core/stop_scope.h"
#include "hogel/image/film.h"
#include "hogel/optics/spectrum.h"
#include "hogel/stereogram/stereogram.h"
#include "hogel/units.h"

namespace hogel {

using namespace camera;
using namespace optics;

namespace {

class Window final : public FieldSource {
  public:
    Window(const FieldSource& field, const Region& region)
        : field_(field), region_(region), grid_{part(field.grid().plane, region), field.grid().wavelength} {}
    const FieldGrid& grid() const override { return grid_; }
    std::size_t looks() const override { return field_.looks(); }
    std::size_t alignment() const override {
        const std::size_t step = field_.alignment();
        return region_.x0 % step == 0 && region_.y0 % step == 0 ? step : 1;
    }
    const Provenance& provenance() const override { return field_.provenance(); }
    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override {
        validate(region, grid_, out.shape());
        field_.read({region_.x0 + region.x0, region_.y0 + region.y0, region.width, region.height}, look, out);
    }

  private:
    const FieldSource& field_;
    Region region_;
    FieldGrid grid_;
};

speckle_free::WavePowers powers_of(const FieldSource& hologram) {
    const stereogram::Stereogram* const source = hologram.stereogram();
    const stereogram::Hogels hogels = source != nullptr ? source->hogels() : stereogram::Hogels();
    if (hogels.waves == nullptr || !hogels.waves->independent())
        throw Error(
            ErrorCode::usage, "speckle, method, phase",
            "speckle-free photographs need a stereogram that is made on demand by the method fourier with random "
            "phases; use a number of looks for others");
    return speckle_free::WavePowers(hogels);
}

// Returns the ratio of the bytes of a source's bands to those of narrow bands, which the plan assumes.
double share_of_bands(const FieldSource& window, const PupilBandSource& source, std::span<const Viewpoint> viewpoints) {
    double actual = 0, planned = 0;
    for (std::size_t i = 0; i < viewpoints.size(); ++i) {
        actual += source.bytes_per_look(i);
        planned += narrow_band_bytes(window.grid(), viewpoints[i].position, viewpoints[i].pupil);
    }
    return actual / planned;
}

// Returns the region extended to whole hogels of the source, so that no hogel is computed for two reads.
Region whole_hogels(const Region& region, const FieldSource& source) {
    const std::size_t side = source.alignment();
    const Grid& plane = source.grid().plane;
    const std::size_t x0 = region.x0 / side * side, y0 = region.y0 / side * side;
    const auto end = [&](std::size_t last, std::size_t size) {
        return std::min((last + side - 1) / side * side, size);
    };
    return {x0, y0, end(region.x0 + region.width, plane.width) - x0, end(region.y0 + region.height, plane.height) - y0};
}

// Adds the light of one window to the pictures of the cameras of one pass.
void photograph_window(const FieldSource& hologram, const PhotographPlan::Window& part, std::span<const Camera> cameras,
                       const std::vector<SharedViewpoint>& viewpoints, const BandCamera& model,
                       const PhotographPlan& plan, std::span<Image> images, const Progress& progress) {
    const Region region = whole_hogels(part.region, hologram);
    const Window window(hologram, region);
    const std::vector<Viewpoint> lenses = viewpoints_of(viewpoints, cameras, model.preview);
    ColourBands bands{make_band_source(hologram, region, window, lenses, model.source),
                      {window.grid()},
                      viewpoints,
                      part.shown,
                      window.looks(),
                      1,
                      model.preview};
    bands.looks_at_once = plan.looks_at_once(static_cast<double>(model.memory), bands.looks,
                                             share_of_bands(window, *bands.source, lenses));
    expose(bands, cameras, {&images, 1}, progress);
}

}  // namespace

double resolution_cell(const Camera& camera, double wavelength) { return wavelength * camera.eye.z / camera.pupil; }

BandCamera camera::planned_as(const CameraModel& model) {
    const auto* const band = std::get_if<BandCamera>(&model);
    return band != nullptr ? *band : BandCamera();
}

void require_photographs(const FieldGrid& hologram, std::span<const Camera> cameras, const CameraModel& model) {
    if (const auto* const band = std::get_if<BandCamera>(&model)) {
        if (band->vertical_diffuser) return require_photographs_of_lines(hologram, cameras, *band);
        plan_photographs(hologram, cameras, static_cast<double>(band->memory));
    } else if (const auto* const speckle_free = std::get_if<SpeckleFreeCamera>(&model)) {
        plan_photographs(hologram, cameras, static_cast<double>(speckle_free->memory));
    } else if (const auto* const plane_waves = std::get_if<PlaneWaveCamera>(&model)) {
        require_by_plane_waves(hologram, cameras, *plane_waves);
    } else {
        for (const Camera& camera : cameras) validate(camera);
    }
}

Plan plan_photographs(std::span<const FieldGrid> holograms, std::size_t looks, std::span<const Camera> cameras,
                      const CameraModel& model) {
    const BandCamera planned = camera::planned_as(model);
    const auto memory = static_cast<double>(planned.memory),
               photographs = static_cast<double>(looks * group_by_viewpoint(cameras).size());
    Plan sum;
    for (const FieldGrid& hologram : holograms) {
        const double samples = static_cast<double>(hologram.plane.samples()) * photographs;
        const Plan plan = planned.vertical_diffuser
                              ? plan_lines(hologram, looks, cameras, planned)
                              : Plan{photograph_bytes(hologram, cameras, memory, looks), 0,
                                     core::rates::on_all_threads(samples * core::rates::sample_and_eye)};
        sum.memory = std::max(sum.memory, plan.memory);
        sum.seconds += plan.seconds;
    }
    return sum;
}

void require_light_towards(const FieldGrid& hologram, const Camera& camera, bool vertical_diffuser) {
    validate(camera);
    const Rectangle pupil(Grid{1, 1, camera.pupil, camera.pupil, camera.eye.x, camera.eye.y});
    const Band band = band_between(Rectangle(hologram.plane), pupil, camera.eye.z, hologram.wavelength);
    const auto check = [&](double frequency, double pitch, const char* axis) {
        if (frequency * pitch <= 0.5) return;
        const double degrees = 180 / std::numbers::pi;
        throw Error(
            ErrorCode::usage, "eye, pitch",
            fmt::format("the eye sees the hologram from up to {:.2f} degrees in {}, but a pitch of {} sends light "
                        "of {} no farther than {:.2f}; an eye farther away or nearer to the middle, or a pitch of {} "
                        "or less would do",
                        degrees * std::asin(frequency * hologram.wavelength), axis, format_length(pitch),
                        format_length(hologram.wavelength),
                        degrees * std::asin(std::min(1.0, 0.5 * hologram.wavelength / pitch)),
                        format_length(0.5 / frequency)));
    };
    check(std::max(-band.low_x, band.high_x), hologram.plane.pitch_x, "x");
    if (!vertical_diffuser) check(std::max(-band.low_y, band.high_y), hologram.plane.pitch_y, "y");
}

std::vector<Image> photograph(const FieldSource& hologram, std::span<const Camera> cameras, const CameraModel& model,
                              const Progress& progress) {
    std::vector<Image> pictures(cameras.size());
    photograph_into(hologram, cameras, model, pictures, progress);
    return pictures;
}

Image photograph(const FieldSource& hologram, const Camera& camera, const CameraModel& model,
                 const Progress& progress) {
    return std::move(photograph(hologram, std::span(&camera, 1), model, progress).front());
}

void photograph_into(const FieldSource& hologram, std::span<const Camera> cameras, const CameraModel& model,
                     std::span<Image> pictures, const Progress& progress) {
    const core::StopScope scope(progress);
    image::require_a_picture_for_each(cameras, pictures);
    for (const Camera& camera : cameras) validate(camera);
    std::visit([&](const auto& concrete) { photograph_by(hologram, cameras, concrete, pictures, progress); }, model);
}

void camera::photograph_by(const FieldSource& hologram, std::span<const Camera> cameras, const SpeckleFreeCamera& model,
                           std::span<Image> pictures, const Progress& progress) {
    const speckle_free::WavePowers powers = powers_of(hologram);
    image::load_film(cameras, 1, hologram.provenance(), pictures);
    speckle_free::photograph(hologram, powers, cameras, model, pictures, progress);
}

void camera::photograph_by(const FieldSource& hologram, std::span<const Camera> cameras, const BandCamera& model,
                           std::span<Image> pictures, const Progress& progress) {
    if (model.vertical_diffuser) return photograph_lines(hologram, cameras, model, pictures, progress);
    const PhotographPlan plan = plan_photographs(hologram.grid(), cameras, static_cast<double>(model.memory));
    image::load_film(cameras, 1, hologram.provenance(), pictures);
    const double parts = static_cast<double>(plan.passes.size()) * static_cast<double>(plan.windows.size());
    std::size_t done = 0;
    for (const std::vector<std::size_t>& pass : plan.passes)
        for (const PhotographPlan::Window& window : plan.windows) {
            const bool is_seen = std::ranges::any_of(
                pass, [&](std::size_t i) { return Rectangle(cameras[i].picture).meets(window.shown); });
            if (is_seen)
                photograph_window(hologram, window, cameras, group_by_viewpoint(cameras, pass), model, plan, pictures,
                                  [&](double fraction) {
                                      return !progress || progress((static_cast<double>(done) + fraction) / parts);
                                  });
            ++done;
        }
}

}  // namespace hogel
