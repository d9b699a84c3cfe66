// SPDX-License-Identifier: Apache-2.0
// The recipe: a light field, its hologram, and photographs of both.
#include "hogel/make.h"

#include <fmt/format.h>

#include <algorithm>

#include "hogel/communicator.h"
#include "hogel/core/half.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/io/finite.h"
#include "hogel/work/parallel.h"
#include "hogel/work/result_log.h"

namespace hogel {
namespace {

// Samples rounded to half floats, as in a file, so that pictures do not depend on whether a file is written.
class HalfFloats final : public LightFieldSource {
  public:
    explicit HalfFloats(LightField::Source source) : source_(std::move(source)) {}
    const LightFieldGrid& grid() const override { return source_->grid(); }
    bool has_depth() const override { return source_->has_depth(); }
    HogelRange preferred_tile() const override { return source_->preferred_tile(); }
    void read(LightFieldTile& tile) const override {
        source_->read(tile);
        std::vector<std::uint16_t> halves(tile.radiance.size());
        core::to_half(tile.radiance.data(), halves.data(), halves.size());
        if (!core::to_float(halves.data(), tile.radiance.data(), halves.size()))
            io::throw_not_finite(tile, "the light field");
    }

  private:
    LightField::Source source_;
};

// Progress of the consecutive stages of make().
class Stages {
  public:
    Stages(const MakeOptions& options, const Progress& progress, std::size_t count)
        : options_(options), progress_(progress), count_(count) {}
    Progress begin(const std::string& name) {
        const std::size_t i = next_++;
        return options_.stage ? options_.stage(name) : progress_.part(i, count_);
    }

  private:
    const MakeOptions& options_;
    const Progress& progress_;
    std::size_t count_, next_ = 0;
};

// Photographs by one camera model.
struct Series {
    std::string stage;
    CameraModel model;
    std::optional<ComparedImage> MadePhotographs::*image;
};

bool has_speckle_free(const MakeRequest& request, std::span<const LightFieldGrid> faces) {
    if (std::holds_alternative<SpeckleFreeCamera>(request.camera)) return true;
    if (request.speckle_free) return *request.speckle_free;
    return is_speckle_free_cheap(faces, request.hologram, cameras_of(request), request.camera);
}

// Returns the photographs by waves, [stage][series]. Several ranks share all of them in one stage, so that no rank
// waits for the others between stages.
std::vector<std::vector<Series>> stages_of_waves(const MakeRequest& request, bool with_speckle_free) {
    std::vector<std::vector<Series>> stages;
    if (!std::holds_alternative<SpeckleFreeCamera>(request.camera))
        stages.push_back({{"photographs by waves", request.camera, &MadePhotographs::waves}});
    if (!with_speckle_free) return stages;
    const Series speckle_free{"speckle-free photographs", SpeckleFreeCamera(), &MadePhotographs::speckle_free};
    const Communicator* const ranks = communicator();
    if (ranks != nullptr && ranks->size() > 1 && !stages.empty())
        stages.front().push_back(speckle_free);
    else
        stages.push_back({speckle_free});
    return stages;
}

LightField stored(const LightField& rendered, const MakeRequest& request, const MakeOptions& options,
                  const Progress& progress) {
    LightFieldFileOptions file = options.light_field;
    file.with_depth = file.with_depth || needs_depth(request.hologram.method);
    if (!options.light_field_file.empty()) {
        work::once([&] { write_light_field(options.light_field_file, rendered, file, progress); });
        return open_light_field(options.light_field_file);
    }
    const bool halves = file.type == SampleType::half;
    const std::size_t times = 1 + request.hologram.channels.size();
    return prepare_for_reading(halves ? rendered.wrapped([](const LightField::Source& face) {
        return LightField::Source(std::make_shared<const HalfFloats>(face));
    })
                                      : rendered,
                               times, file.with_depth, progress);
}

void photograph_series(Made& made, std::span<const Camera> cameras, std::span<const Series> series,
                       const Progress& progress) {
    std::vector<CameraModel> models;
    for (const Series& one : series) models.push_back(one.model);
    std::vector<std::vector<Image>> pictures = photograph_colours(made.holograms, cameras, models, progress);
    for (std::size_t k = 0; k < series.size(); ++k)
        for (std::size_t i = 0; i < cameras.size(); ++i)
            made.photographs[i].*series[k].image = ComparedImage{std::move(pictures[k][i]), {}};
}

// Returns the channels of a picture by rays that the hologram shows, one per wavelength.
Image shown_channels(Image rays, std::span<const Channel> channels) {
    const auto channel_of = [&](std::size_t c) { return rays.channels() == 1 ? 0 : channels[c].index; };
    bool are_same = rays.channels() == channels.size();
    for (std::size_t c = 0; c < channels.size(); ++c) are_same = are_same && channel_of(c) == c;
    if (are_same) return rays;
    Image shown(rays.width(), rays.height(), channels.size());
    for (std::size_t y = 0; y < rays.height(); ++y)
        for (std::size_t x = 0; x < rays.width(); ++x)
            for (std::size_t c = 0; c < channels.size(); ++c) shown.pixels(y, x, c) = rays.pixels(y, x, channel_of(c));
    shown.provenance = std::move(rays.provenance);
    return shown;
}

// Sets one exposure for all pictures, from the view from above, and compares them.
void expose(Made& made) {
    std::vector<MadePhotographs>& photographs = made.photographs;
    made.exposure = automatic_exposure(photographs[std::min<std::size_t>(1, photographs.size() - 1)].rays);
    work::parallel_for(photographs.size(), [&](std::size_t i) {
        MadePhotographs& photographs_of = photographs[i];
        for (std::optional<ComparedImage>* const waves : {&photographs_of.waves, &photographs_of.speckle_free})
            if (*waves) (*waves)->comparison = compare(photographs_of.rays, (*waves)->image, made.exposure);
    });
}

}  // namespace

Made make(const LightField& light_field, const MakeRequest& request, const MakeOptions& options,
          const Progress& progress) {
    const core::StopScope scope(progress);
    if (request.cameras.empty() || request.hologram.looks == 0)
        throw Error(ErrorCode::usage, "expected cameras and a number of looks; resolve() selects them");
    const std::vector<Camera> cameras = cameras_of(request);
    std::vector<LightFieldGrid> faces = light_field.grids();
    std::ranges::transform(faces, faces.begin(), common_directions);
    require_holograms(faces, request.hologram, cameras);
    const std::vector<std::vector<Series>> waves = stages_of_waves(request, has_speckle_free(request, faces));
    Stages stages(options, progress, 2 + (options.hologram_file.empty() ? 0 : 1) + waves.size());

    Made made{request, stored(light_field, request, options, stages.begin("light field")), {}, 1, {}};
    made.holograms = make_holograms(with_common_directions(made.light_field), request.hologram);
    std::vector<Image> rays = photograph(made.light_field, cameras, request.rays, stages.begin("photographs by rays"));
    for (std::size_t i = 0; i < rays.size(); ++i)
        made.photographs.push_back(
            {request.cameras[i], shown_channels(std::move(rays[i]), request.hologram.channels), {}, {}});
    if (!options.hologram_file.empty()) {
        const Progress writing = stages.begin("hologram file");
        work::once([&] { write_holograms(options.hologram_file, made.holograms, options.hologram, writing); });
    }
    for (const std::vector<Series>& series : waves)
        photograph_series(made, cameras, series, stages.begin(series.front().stage));
    expose(made);
    return made;
}

Made make(const Scene& scene, const MakeRequest& request, const MakeOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    const MakeRequest resolved = resolve(request, bounds(scene));
    const LightField rendered = render_light_field(scene, resolved.light_field,
                                                   options.stage ? options.stage("lighting") : progress.part(0.0, 0.1));
    return make(rendered, resolved, options, progress.part(0.1, 1.0));
}

void write_photographs(const std::filesystem::path& folder, const Made& made, const MadeMetadata& metadata,
                       const Progress& progress) {
    const core::StopScope scope(progress);
    const auto exposed = [&](Metadata entries) {
        entries.emplace_back("exposure", fmt::format("{:.9g}", made.exposure));
        return entries;
    };
    const Metadata waves = exposed(metadata.waves), speckle_free = exposed(metadata.speckle_free),
                   rays = exposed(metadata.rays);
    struct File {
        std::filesystem::path path;
        const Image& image;
        const Metadata& metadata;
    };
    std::vector<File> files;
    for (const MadePhotographs& photographs_of : made.photographs)
        for (const char* extension : {".png", ".exr"}) {
            const auto add = [&](const std::string& name, const Image& image, const Metadata& entries) {
                files.push_back({folder / (name + extension), image, entries});
            };
            if (photographs_of.waves) add(photographs_of.camera.wave_file(), photographs_of.waves->image, waves);
            if (photographs_of.speckle_free)
                add(photographs_of.camera.speckle_free_file(), photographs_of.speckle_free->image, speckle_free);
            add(photographs_of.camera.ray_file(), photographs_of.rays, rays);
        }
    work::parallel_for(files.size(), [&](std::size_t i) {
        write_image(files[i].path, files[i].image, made.exposure, files[i].metadata);
    });
}

}  // namespace hogel
