// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/photograph_plan.h"
#include "hogel/camera/narrow_band/narrow_band.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>

#include "hogel/photograph.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"

namespace hogel::camera {
namespace {

// Resolution cells by which a window extends beyond the part that it shows. The image of a point falls off slowly:
// 0.2/m of its light is beyond m cells.
constexpr double margin_cells = 256;

// Along the longer side of the hologram.
constexpr std::size_t window_counts[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48};

// Returns the maximum of metres on the hologram per unit of the sine.
double metres_per_sine(const FieldGrid& hologram, const Vec3& viewpoint) {
    const Grid& plane = hologram.plane;
    const ViewGeometry geometry(viewpoint, hologram.wavelength);
    double max_distance = 0;
    for (double x : {plane.center_x - plane.size_x() / 2, plane.center_x + plane.size_x() / 2})
        for (double y : {plane.center_y - plane.size_y() / 2, plane.center_y + plane.size_y() / 2})
            max_distance = std::max(max_distance, geometry.distance(x, y));
    // A step of the sines is r/cos² θ wide on the plane.
    const double cosine = viewpoint.z / max_distance;
    return max_distance / (cosine * cosine);
}

// Returns the margin, metres, of a film around a window's part: the distance that light travels from its point.
double margin(const FieldGrid& hologram, const Vec3& viewpoint, double pupil, double blur) {
    return metres_per_sine(hologram, viewpoint) * (margin_cells * hologram.wavelength / pupil + 0.5 * blur);
}

std::vector<PhotographPlan::Window> windows(const Grid& plane, std::size_t count, double margin) {
    const std::size_t side = (std::max(plane.width, plane.height) + count - 1) / count;
    const auto margin_samples = static_cast<std::size_t>(std::ceil(margin / std::min(plane.pitch_x, plane.pitch_y)));
    std::vector<PhotographPlan::Window> list;
    for (std::size_t y = 0; y < plane.height; y += side)
        for (std::size_t x = 0; x < plane.width; x += side) {
            const std::size_t right = std::min(x + side, plane.width), bottom = std::min(y + side, plane.height);
            Region region;
            region.x0 = x - std::min(x, margin_samples);
            region.y0 = y - std::min(y, margin_samples);
            region.width = std::min(right + margin_samples, plane.width) - region.x0;
            region.height = std::min(bottom + margin_samples, plane.height) - region.y0;
            Rectangle shown(part(plane, {x, y, right - x, bottom - y}));
            if (x == 0) shown.left -= margin;
            if (right == plane.width) shown.right += margin;
            if (y == 0) shown.top += margin;
            if (bottom == plane.height) shown.bottom -= margin;
            list.push_back({region, shown});
        }
    return list;
}

struct PassMemory {
    double fixed = 0, per_look = 0;
};

PassMemory pass_memory(const FieldGrid& hologram, const Rectangle& shown, std::span<const Camera> cameras,
                       const std::vector<SharedViewpoint>& viewpoints) {
    PassMemory bytes;
    double largest = 0;
    for (const SharedViewpoint& viewpoint : viewpoints) {
        const narrow_band::NarrowBand band(hologram, cameras[viewpoint.members.front()].eye, viewpoint.pupil);
        const film::FilmSize film(band, hologram, film_area(hologram.plane, viewpoint.pictures, shown), viewpoint.pupil,
                                  viewpoint.blur);
        bytes.per_look += 8.0 * static_cast<double>(band.plane.samples());
        const double tile = narrow_band::NarrowBand::tile_width / static_cast<double>(band.factor) +
                            2 * narrow_band::NarrowBand::margin;
        bytes.per_look += 8.0 * static_cast<double>(work::default_in_flight()) * tile * tile;
        bytes.fixed += film.intensity_bytes() * static_cast<double>(viewpoint.members.size());
        largest = std::max(largest, film.pupil_bytes() + film.work_bytes());
    }
    bytes.fixed += largest;
    return bytes;
}

// Returns the plan with the least work that fits into memory. Its `passes` are empty if none fits.
PhotographPlan find_plan(const FieldGrid& hologram, std::span<const Camera> cameras, double memory,
                         std::span<const std::size_t> counts) {
    std::vector<std::size_t> sorted(cameras.size());
    std::iota(sorted.begin(), sorted.end(), std::size_t{0});
    std::stable_sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
        const Vec3 p = cameras[a].eye, q = cameras[b].eye;
        return std::tie(p.z, p.y, p.x) < std::tie(q.z, q.y, q.x);
    });
    double max_margin = 0;
    for (const Camera& camera : cameras)
        max_margin = std::max(max_margin, margin(hologram, camera.eye, camera.pupil, defocus_blur(camera)));

    PhotographPlan best;
    double min_work = std::numeric_limits<double>::infinity();
    std::size_t cameras_per_pass = cameras.size();
    while (true) {
        std::vector<std::vector<std::size_t>> passes;
        for (std::size_t first = 0; first < sorted.size(); first += cameras_per_pass)
            passes.emplace_back(
                sorted.begin() + static_cast<std::ptrdiff_t>(first),
                sorted.begin() + static_cast<std::ptrdiff_t>(std::min(first + cameras_per_pass, sorted.size())));
        for (std::size_t count : counts) {
            const std::vector<PhotographPlan::Window> list = windows(hologram.plane, count, max_margin);
            double read = 0;
            for (const PhotographPlan::Window& window : list) read += static_cast<double>(window.region.samples());
            const double work =
                static_cast<double>(passes.size()) * read / static_cast<double>(hologram.plane.samples());
            if (work >= min_work) continue;
            // Tests five windows, at the ends, the quarters and in the middle, because memory varies slowly.
            std::set<std::size_t> probes{0, list.size() / 2, list.size() - 1, list.size() / 4, 3 * list.size() / 4};
            double fixed = 0, per_look = 0;
            for (const auto& pass : passes)
                for (std::size_t probe : probes) {
                    const FieldGrid window{part(hologram.plane, list[probe].region), hologram.wavelength};
                    const PassMemory bytes =
                        pass_memory(window, list[probe].shown, cameras, group_by_viewpoint(cameras, pass));
                    fixed = std::max(fixed, bytes.fixed);
                    per_look = std::max(per_look, bytes.per_look);
                }
            if (fixed + per_look > memory) continue;
            min_work = work;
            best = {passes, list, fixed + per_look, per_look};
        }
        if (cameras_per_pass == 1) return best;
        cameras_per_pass = (cameras_per_pass + 1) / 2;
    }
}

}  // namespace

Rectangle illuminated_area(const FieldGrid& hologram, const Vec3& viewpoint, double pupil, double blur,
                           double diffraction) {
    const double distance = std::min(margin(hologram, viewpoint, pupil, blur),
                                     diffraction + 0.5 * blur * metres_per_sine(hologram, viewpoint));
    Rectangle area(hologram.plane);
    area.left -= distance;
    area.right += distance;
    area.bottom -= distance;
    area.top += distance;
    return area;
}

double narrow_band_bytes(const FieldGrid& hologram, const Vec3& viewpoint, double pupil) {
    return static_cast<double>(sizeof(std::complex<float>) *
                               narrow_band::NarrowBand(hologram, viewpoint, pupil).plane.samples());
}

std::vector<SharedViewpoint> group_by_viewpoint(std::span<const Camera> cameras, std::span<const std::size_t> members) {
    std::vector<SharedViewpoint> viewpoints;
    for (std::size_t i : members) {
        auto viewpoint = std::find_if(viewpoints.begin(), viewpoints.end(), [&](const SharedViewpoint& e) {
            return cameras[e.members.front()].eye == cameras[i].eye;
        });
        const Rectangle picture(cameras[i].picture);
        if (viewpoint == viewpoints.end())
            viewpoint = viewpoints.insert(viewpoints.end(), SharedViewpoint{.members = {}, .pictures = picture});
        Rectangle& bounds = viewpoint->pictures;
        bounds.left = std::min(bounds.left, picture.left);
        bounds.right = std::max(bounds.right, picture.right);
        bounds.bottom = std::min(bounds.bottom, picture.bottom);
        bounds.top = std::max(bounds.top, picture.top);
        viewpoint->members.push_back(i);
        viewpoint->pupil = std::max(viewpoint->pupil, cameras[i].pupil);
        viewpoint->blur = std::max(viewpoint->blur, defocus_blur(cameras[i]));
    }
    return viewpoints;
}

std::vector<SharedViewpoint> group_by_viewpoint(std::span<const Camera> cameras) {
    std::vector<std::size_t> all(cameras.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return group_by_viewpoint(cameras, all);
}

std::size_t PhotographPlan::looks_at_once(double memory, std::size_t looks, double share) const {
    // At most the memory that core::FreedBlocks keeps. The system would clear more each time, a second per gigabyte.
    const double spare = std::clamp(memory - bytes, 0.0, 1024.0 * 1024 * 1024);
    const double max_looks = 1 + std::floor(spare / (bytes_per_look * share)), total = static_cast<double>(looks);
    return static_cast<std::size_t>(std::ceil(total / std::max(1.0, std::ceil(total / max_looks))));
}

void require_resolution(const FieldGrid& hologram, const Camera& camera, double cells) {
    const double cell = resolution_cell(camera, hologram.wavelength);
    const double side = std::max(hologram.plane.size_x(), hologram.plane.size_y());
    if (cells * cell <= side) return;
    throw Error(ErrorCode::usage, "pupil",
                fmt::format("a pupil of {} at {} resolves no more than {} in light of {}; expected at most {}, as the "
                            "hologram is {} wide; a pupil of {} would do",
                            format_length(camera.pupil), format_length(camera.eye.z), format_length(cell),
                            format_length(hologram.wavelength), format_length(side / cells), format_length(side),
                            format_length(camera.pupil * cells * cell / side)));
}

PhotographPlan plan_photographs(const FieldGrid& hologram, std::span<const Camera> cameras, double memory,
                                PhotographPlan::Windows windows) {
    for (const Camera& camera : cameras) {
        validate(camera);
        require_resolution(hologram, camera);
        narrow_band::NarrowBand(hologram, camera.eye,
                                camera.pupil);  // throws if the pupil is too wide for the pitch
    }
    if (cameras.empty()) return {};
    const std::span<const std::size_t> counts =
        windows == PhotographPlan::Windows::one ? std::span(window_counts).first(1) : std::span(window_counts);
    PhotographPlan plan = find_plan(hologram, cameras, memory, counts);
    if (!plan.passes.empty()) return plan;
    double fits = 0, fails = 1;
    for (int i = 0; i < 8; ++i) {
        const double scale = 0.5 * (fits + fails);
        std::vector<Camera> smaller(cameras.begin(), cameras.end());
        for (Camera& camera : smaller) camera.pupil *= scale;
        (find_plan(hologram, smaller, memory, counts).passes.empty() ? fails : fits) = scale;
    }
    double widest = 0;
    for (const Camera& camera : cameras) widest = std::max(widest, camera.pupil);
    throw Error(ErrorCode::usage, "pupil",
                fmt::format("a photograph through a pupil of {} needs more than the allowed {} of memory; {}",
                            format_length(widest), format_bytes(memory),
                            fits > 0 ? fmt::format("a pupil of {} would do", format_length(widest * fits))
                                     : "no pupil is small enough"));
}

double photograph_bytes(const FieldGrid& hologram, std::span<const Camera> cameras, double memory, std::size_t looks,
                        double share) {
    const PhotographPlan plan = plan_photographs(hologram, cameras, memory);
    const auto further_looks = static_cast<double>(plan.looks_at_once(memory, looks, share) - 1);
    return plan.bytes + std::min(further_looks * share * plan.bytes_per_look, memory);
}

}  // namespace hogel::camera
