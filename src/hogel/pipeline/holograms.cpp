// SPDX-License-Identifier: Apache-2.0
// From a light field to holograms of several wavelengths and photographs of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "hogel/core/alone.h"
#include "hogel/core/shared_order.h"
#include "hogel/core/speeds.h"
#include "hogel/core/unequal_parts.h"
#include "hogel/core/work_before.h"
#include "hogel/error.h"
#include "hogel/hologram/parallax.h"
#include "hogel/image/film.h"
#include "hogel/optics/eye_light.h"
#include "hogel/optics/photograph_together.h"
#include "hogel/pipeline.h"
#include "hogel/pipeline/picture_shares.h"

namespace hogel {

using pipeline::PictureShare;
using pipeline::PictureShares;

void require_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                       std::span<const Camera> cameras) {
    if (request.channels.empty()) throw Error(ErrorCode::usage, "a hologram needs a wavelength; there is none");
    // The shortest wavelength is the most critical: it is diffracted least and has the finest detail in the light that
    // enters a lens.
    const Channel& shortest = *std::ranges::min_element(request.channels, {}, &Channel::wavelength);
    const FieldGrid hologram = hologram_grid(faces, request.options(shortest, faces));
    // The longest has the fewest directions and the coarsest detail.
    const Channel& longest = *std::ranges::max_element(request.channels, {}, &Channel::wavelength);
    if (&longest != &shortest) require_photographs(hologram_grid(faces, request.options(longest, faces)), cameras);
    require_photographs(hologram, cameras);
    for (const Camera& camera : cameras) require_light_towards(hologram, camera);
}

LightField open_for_holograms(const std::filesystem::path& path, HologramRequest& request, bool any_transform) {
    auto* const basis = std::get_if<Basis>(&request.method);
    if (basis == nullptr || is_view_set(path) || !is_stream(path))
        return with_common_directions(open_light_field_or_views(path));
    const StreamInfo info = read_stream_info(path);
    const bool fits = !info.grid.focal_plane() && info.method.coder == "fringes" &&
                      info.layout == StreamLayout::faces && !info.tone && info.chrominance == 1 &&
                      (any_transform || basis->transform == info.method.transform);
    if (!fits) return with_common_directions(open_light_field(path));
    basis->transform = info.method.transform;
    request.of_coefficients = true;
    return open_coefficients(path);
}

std::string warning_about(const LightField& light_field, const HologramRequest& request) {
    const auto* overlap_add = std::get_if<OverlapAdd>(&request.method);
    if (overlap_add == nullptr) return {};
    const bool smooth = overlap_add->phases == PointPhases::fixed;
    if (smooth && hologram::has_picture_at_infinity(light_field.front()))
        return "rays that meet nothing show a picture at infinity, and smooth surfaces keep only its mean; random "
               "phases "
               "would show it";
    const LightFieldGrid& grid = light_field.grid();
    const double samples = std::round(grid.pitch / request.pitch);
    if (smooth && samples > hologram::max_smooth_hogel)
        return fmt::format(
            "hogels are {:.0f} samples wide, and smooth surfaces show them as a grid with colours of its own; hogels "
            "of up to {:.0f} samples, or random phases, would do",
            samples, hologram::max_smooth_hogel);
    const double parallax = hologram::neighbouring_parallax(light_field.front(), request.pitch);
    if (parallax <= hologram::max_parallax) return {};
    const auto enough = [&](std::size_t count) {
        return std::ceil(static_cast<double>(count) * parallax / hologram::max_parallax);
    };
    return fmt::format(
        "neighbouring directions see the deepest things {:.1f} samples apart, and windows overlap well up "
        "to {:.0f}{}; {}x{} directions would do",
        parallax, hologram::max_parallax, smooth ? ", beyond which smooth surfaces lose brightness and colour" : "",
        enough(grid.directions_u), enough(grid.directions_v));
}

Fields make_holograms(const LightField& light_field, const HologramRequest& request) {
    Fields holograms;
    for (const Channel& channel : request.channels) {
        const HologramOptions options = request.options(channel, light_field.grids());
        holograms.push_back(request.of_coefficients ? make_hologram_of_coefficients(light_field, options)
                                                    : make_hologram(light_field, options));
    }
    return holograms;
}

namespace {

// Colours in the order in which they are photographed: short waves first, because their bands have the most samples,
// and the other colours use the same memory.
std::vector<std::size_t> in_order(const Fields& holograms) {
    std::vector<std::size_t> order(holograms.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t c) { return holograms[c]->grid().wavelength; });
    return order;
}

// Photographs of holograms in several colours.
struct Colours {
    const Fields& holograms;
    std::span<const Camera> cameras;
    const WaveCamera& with;

    std::vector<Image> unexposed() const {
        std::vector<Image> pictures(cameras.size());
        image::load_film(cameras, holograms.size(), holograms.front()->provenance(), pictures);
        return pictures;
    }

    PictureShare all_of(std::size_t colour) const { return pipeline::by_all_cameras(colour, cameras.size()); }

    std::vector<Image> photograph(const PictureShare& share, const Progress& progress) const {
        std::vector<Camera> some;
        for (const std::size_t camera : share.cameras) some.push_back(cameras[camera]);
        const FieldSource& hologram = *holograms[share.colour];
        if (const auto* full = std::get_if<PlaneWaveCameraOptions>(&with))
            return photograph_by_plane_waves(hologram, some, *full, progress);
        return hogel::photograph(hologram, some, std::get<PhotographOptions>(with), progress);
    }
};

bool has_colour(std::span<const PictureShares> shares, std::size_t colour) {
    return std::ranges::any_of(shares, [&](const PictureShares& own) {
        return std::ranges::any_of(own, [&](const PictureShare& share) { return share.colour == colour; });
    });
}

// Makes the pictures that this process makes by itself, and divides the rows of the colours that all then make together
// by what each process still has to do.
// @param left  colours
std::vector<std::vector<Image>> photograph_alone(Team& team, const Colours& colours,
                                                 const std::vector<PictureShares>& shares,
                                                 std::span<const std::size_t> left, const std::vector<double>& speeds,
                                                 std::optional<core::UnequalParts>& parts, const Progress& progress) {
    const auto& options = std::get<PhotographOptions>(colours.with);
    std::optional<core::WorkBefore> before;
    if (!left.empty() && std::ranges::none_of(shares, &PictureShares::empty))
        before.emplace(team, pipeline::costs_of(shares, colours.holograms, colours.cameras, options), speeds);
    const PictureShares& own = shares[team.rank()];
    std::vector<std::vector<Image>> seen;
    while (seen.size() < own.size()) {
        const core::AloneScope alone;
        const Progress part = progress.part(seen.size(), colours.holograms.size());
        const auto report = [&](double fraction) {
            const double done = static_cast<double>(seen.size()) + fraction;
            if (before) before->report(done / static_cast<double>(own.size()));
            return part(fraction);
        };
        seen.push_back(colours.photograph(own[seen.size()], Progress(part.stop(), report)));
    }
    if (!before) return seen;
    const std::vector<double> to_do = before->finish();
    PictureShares rest;
    for (const std::size_t colour : left) rest.push_back(colours.all_of(colour));
    const double work = pipeline::cost_of_rows(rest, colours.holograms, colours.cameras, options);
    parts.emplace(speeds, core::parts_after(speeds, to_do, work));
    return seen;
}

// Photographs by one camera or several of all colours, which processes of a team share.
std::vector<Image> photograph_in_one_way(const Colours& colours, const Progress& progress) {
    const auto& [holograms, cameras, with] = colours;
    std::vector<Image> pictures = colours.unexposed();
    const auto* const options = std::get_if<PhotographOptions>(&with);  // null: the full camera's
    Team* const team = core::team_of_several();
    std::vector<double> speeds;
    if (team != nullptr && options != nullptr) speeds = core::speeds_of_processes(*team);
    std::optional<core::UnequalParts> parts(std::in_place, speeds, speeds);
    // The narrow camera keeps more: the light of each tile; not behind a diffuser, where that is gigabytes.
    const bool keeps_colours = core::result_log() != nullptr && (pipeline::are_of_hogels_or_planes(holograms, with) ||
                                                                 (options != nullptr && options->vertical_diffuser));
    std::optional<std::vector<std::vector<Image>>> together;  // [colour][camera]
    if (options != nullptr && !keeps_colours)
        together = optics::photograph_together(holograms, cameras, *options, progress);
    std::vector<std::size_t> order = in_order(holograms);
    std::vector<PictureShares> shares;
    if (!together) shares = pipeline::shares_of_processes(holograms, order, with, cameras.size(), speeds);
    std::erase_if(order, [&](std::size_t colour) { return has_colour(shares, colour); });
    std::vector<std::vector<Image>> seen;  // by this process alone
    if (!shares.empty()) seen = photograph_alone(*team, colours, shares, order, speeds, parts, progress);
    const auto photograph_all = [&](std::size_t k) {
        if (together) return std::move((*together)[order[k]]);
        return colours.photograph(colours.all_of(order[k]), progress.part(seen.size() + k, holograms.size()));
    };
    const auto put_all = [&](std::size_t k, std::vector<Image>& one) {
        pipeline::put(colours.all_of(order[k]), one, pictures);
    };
    if (keeps_colours) {
        core::kept_one_by_one<std::vector<Image>>(order.size(), image::sent_pictures(), photograph_all, put_all);
    } else {
        for (std::size_t k = 0; k < order.size(); ++k) {
            std::vector<Image> one = photograph_all(k);
            put_all(k, one);
        }
    }
    pipeline::gather(shares, seen, pictures);
    pipeline::share(pictures);
    return pictures;
}

// Photographs in several ways, [way][camera], of which each process of a team makes some when it is free.
std::vector<std::vector<Image>> photograph_by_jobs(Team& team, const Fields& holograms, std::span<const Camera> cameras,
                                                   std::span<const WaveCamera> ways,
                                                   std::span<const pipeline::PictureJob> jobs,
                                                   const Progress& progress) {
    const auto colours = [&](std::size_t way) { return Colours{holograms, cameras, ways[way]}; };
    double sum = 0, done = 0;
    for (const pipeline::PictureJob& job : jobs) sum += job.cost;
    const double own_part = sum / static_cast<double>(team.size());
    std::vector<std::vector<Image>> pictures;
    for (std::size_t way = 0; way < ways.size(); ++way) pictures.push_back(colours(way).unexposed());
    std::vector<std::uint64_t> own;                                  // jobs
    std::vector<std::vector<std::vector<Image>>> seen(ways.size());  // [way][job]
    const std::uint64_t queue = team.next_number();
    for (Team::Tiles some = team.next_tiles(queue, jobs.size()); some.count > 0;
         some = team.next_tiles(queue, jobs.size()))
        for (std::uint64_t i = some.first; i < some.first + some.count; ++i) {
            const pipeline::PictureJob& job = jobs[i];
            const core::AloneScope alone;
            const auto report = [&](double fraction) {
                return progress(std::min(0.99, (done + fraction * job.cost) / own_part));
            };
            seen[job.way].push_back(colours(job.way).photograph(job.pictures, Progress(progress.stop(), report)));
            own.push_back(i);
            done += job.cost;
        }
    core::MessageWriter message;
    message.put(own);
    std::vector<std::vector<PictureShares>> shares(ways.size(), std::vector<PictureShares>(team.size()));
    const std::vector<std::string> all = core::all_of(team, message.take());
    for (std::size_t process = 0; process < team.size(); ++process)
        for (const std::uint64_t i : core::MessageReader(all[process]).get_vector<std::uint64_t>())
            shares[jobs[i].way][process].push_back(jobs[i].pictures);
    for (std::size_t way = 0; way < ways.size(); ++way) {
        pipeline::gather(shares[way], seen[way], pictures[way]);
        pipeline::share(pictures[way]);
    }
    progress.report(1);
    return pictures;
}

}  // namespace

std::vector<std::vector<Image>> photograph_colours(const Fields& holograms, std::span<const Camera> cameras,
                                                   std::span<const WaveCamera> ways, const Progress& progress) {
    const core::StopScope scope(progress);
    if (holograms.empty()) throw Error(ErrorCode::usage, "a photograph needs a hologram; there is none");
    const auto share_rays = [&](const WaveCamera& with) {
        const auto* const options = std::get_if<PhotographOptions>(&with);
        return options != nullptr && optics::are_photographed_together(holograms, cameras, *options);
    };
    if (Team* const team = core::team_of_several()) {
        std::vector<pipeline::PictureJob> jobs;
        if (team->is_first() && std::ranges::none_of(ways, share_rays))
            jobs = pipeline::jobs_of(team->size(), holograms, in_order(holograms), cameras, ways);
        // Costs may differ in their last bits between machines.
        core::share_result(jobs, pipeline::sent_jobs());
        if (!jobs.empty()) return photograph_by_jobs(*team, holograms, cameras, ways, jobs, progress);
    }
    std::vector<std::vector<Image>> pictures;
    for (const WaveCamera& with : ways)
        pictures.push_back(
            photograph_in_one_way({holograms, cameras, with}, progress.part(pictures.size(), ways.size())));
    return pictures;
}

std::vector<Image> photograph_colours(const Fields& holograms, std::span<const Camera> cameras, const WaveCamera& with,
                                      const Progress& progress) {
    return std::move(photograph_colours(holograms, cameras, std::span(&with, 1), progress).front());
}

void write_holograms(const std::filesystem::path& path, const Fields& holograms, const HologramFileOptions& options,
                     const Progress& progress) {
    const core::StopScope scope(progress);
    std::vector<FieldGrid> grids;
    for (const auto& hologram : holograms) grids.push_back(hologram->grid());
    HologramFileOptions file = options;
    file.metadata = with_history(file.metadata, to_metadata(holograms.front()->provenance()));
    const auto sinks = create_hologram(path, grids, file);
    for (std::size_t i = 0; i < sinks.size(); ++i) copy(*holograms[i], *sinks[i], 0, progress.part(i, sinks.size()));
}

Camera camera_for(double width, double height, std::size_t resolution) {
    const double pixel = width / static_cast<double>(resolution);
    const auto rows = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(height / pixel)));
    Camera camera;
    camera.eye = {0, 0, defaults.eye_distance};
    camera.pupil = defaults.pupil;
    camera.picture = {resolution, rows, pixel, pixel, 0, 0};
    return camera;
}

std::size_t enough_looks(const Camera& camera) {
    const auto cells_in_pixel = [](const Camera& any) {
        const double cell = resolution_cell(any, defaults.green);
        return std::max(1.0, any.picture.pitch_x * any.picture.pitch_y / (cell * cell));
    };
    const double usual = cells_in_pixel(camera_for(defaults.size, defaults.size, defaults.resolution));
    const double looks = static_cast<double>(defaults.looks) * usual / cells_in_pixel(camera);
    return static_cast<std::size_t>(std::clamp(std::ceil(looks), 1.0, static_cast<double>(defaults.looks)));
}

}  // namespace hogel
