// SPDX-License-Identifier: Apache-2.0
#include "hogel/focus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <mutex>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/optics/focus/extrema.h"
#include "hogel/optics/focus/plane_waves.h"
#include "hogel/work/parallel.h"

namespace hogel {

using namespace optics;

namespace {

// The parts of several fields as plane waves.
class Parts {
  public:
    explicit Parts(std::size_t fields) : parts_(fields) {}

    void read(std::size_t index, const FieldSource& field, const Region& region, std::size_t max_side) {
        const std::size_t across = (region.width + max_side - 1) / max_side,
                          down = (region.height + max_side - 1) / max_side;
        for (std::size_t j = 0; j < down; ++j)
            for (std::size_t i = 0; i < across; ++i) {
                core::throw_if_stopped();
                const std::size_t x = region.width * i / across, y = region.height * j / down;
                parts_[index].emplace_back(field,
                                           Region{region.x0 + x, region.y0 + y, region.width * (i + 1) / across - x,
                                                  region.height * (j + 1) / down - y});
            }
    }

    // Returns the contrasts at a depth: of each field over all its parts, averaged over the fields with equal weights.
    Contrasts at(double depth) const {
        Contrasts mean{};
        for (const auto& parts : parts_) {
            LightSums sums;
            for (const PlaneWaves& part : parts) {
                core::throw_if_stopped();
                sums.add(part.at(depth));
            }
            const Contrasts contrasts = sums.contrasts();
            for (std::size_t s = 0; s < mean.size(); ++s) mean[s] += contrasts[s] / static_cast<double>(parts_.size());
        }
        return mean;
    }

    // Returns the depth of focus, metres to either side, for the bandwidth B of a field's light: 1/(2λB²).
    double depth_of_focus(std::size_t index, double wavelength) const {
        double band = 0;
        for (const PlaneWaves& part : parts_[index]) band = std::max(band, part.band());
        return 1 / (2 * wavelength * band * band);
    }

  private:
    std::vector<std::deque<PlaneWaves>> parts_;
};

// Returns the mean depth of an extremum, weighted by the height above half its prominence. Computes more depths if
// needed.
double middle_of(const Parts& parts, const FocusSearch& search, const Extremum& extremum) {
    constexpr std::size_t min_depths = 12, refined_depths = 25;
    const std::size_t begin = extremum.begin == 0 ? 0 : extremum.begin - 1,
                      end = std::min(search.depths.size() - 1, extremum.end + 1);
    std::vector<double> depths(search.depths.begin() + static_cast<std::ptrdiff_t>(begin),
                               search.depths.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    std::vector<Contrasts> contrasts(search.contrasts.begin() + static_cast<std::ptrdiff_t>(begin),
                                     search.contrasts.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    if (depths.size() < min_depths) {
        const double low = depths.front(), step = (depths.back() - low) / (refined_depths - 1);
        depths.resize(refined_depths);
        contrasts.resize(refined_depths);
        work::parallel_for(refined_depths, [&](std::size_t i) {
            depths[i] = low + step * static_cast<double>(i);
            contrasts[i] = parts.at(depths[i]);
        });
    }
    const auto height = [&](const Contrasts& contrast) {
        return (extremum.maximum ? 1 : -1) * height_of(contrast, extremum.scale);
    };
    double top = height(search.contrasts[extremum.index]);
    for (const Contrasts& contrast : contrasts) top = std::max(top, height(contrast));
    double weights = 0, sum = 0;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        const double weight = std::max(0.0, height(contrasts[i]) - (top - extremum.drop()));
        weights += weight;
        sum += weight * depths[i];
    }
    return weights > 0 ? sum / weights : search.depths[extremum.index];
}

// Returns the depth, metres, at which pitch and size of a field limit the resolution equally.
double equal_resolution_depth(const FieldGrid& grid) {
    const Grid& plane = grid.plane;
    return std::min(static_cast<double>(plane.width) * plane.pitch_x * plane.pitch_x,
                    static_cast<double>(plane.height) * plane.pitch_y * plane.pitch_y) /
           grid.wavelength;
}

// Directions beyond 90 degrees carry no light: samples finer than half a wavelength resolve no more.
double depth_of_focus(const FieldGrid& grid) {
    const double finest = std::max(std::min(grid.plane.pitch_x, grid.plane.pitch_y), grid.wavelength / 2);
    return 2 * finest * finest / grid.wavelength;
}

// Returns the largest such depth of several fields.
double equal_resolution_depth(const Fields& fields) {
    double depth = 0;
    for (const auto& field : fields) depth = std::max(depth, equal_resolution_depth(field->grid()));
    return depth;
}

struct DepthRange {
    double from = 0, to = 0;
    std::size_t planes = 0;
};

DepthRange range_of(const Fields& fields, const FocusOptions& options, double depth_of_focus) {
    double from = options.from, to = options.to;
    if (!std::isfinite(from) || !std::isfinite(to))
        throw Error(ErrorCode::usage, "from, to", "the depths to search must be finite");
    if (from > to) std::swap(from, to);
    if (from == to) {
        to = equal_resolution_depth(fields);
        from = -to;
    }
    constexpr std::size_t min_planes = 8, max_planes = 1 << 16;
    const double wanted = std::ceil((to - from) / depth_of_focus) + 1;
    const std::size_t count = options.planes > 0
                                  ? options.planes
                                  : std::max<std::size_t>(33, static_cast<std::size_t>(std::min(wanted, 1e9)));
    if (count < min_planes || count > max_planes)
        throw Error(ErrorCode::usage, "from, to, planes",
                    fmt::format("{} depths from {} to {} m were asked for; {} to {} are searched", count, from, to,
                                min_planes, max_planes));
    return {from, to, count};
}

// Searches equidistant depths.
// @param search  initial result, with the depths of focus
FocusSearch search_range(const Parts& parts, FocusSearch search, const DepthRange& range, const Progress& progress) {
    search.depths.resize(range.planes);
    search.contrasts.resize(range.planes);
    const double step = (range.to - range.from) / static_cast<double>(range.planes - 1);
    for (std::size_t i = 0; i < range.planes; ++i) search.depths[i] = range.from + step * static_cast<double>(i);
    std::mutex mutex;
    std::size_t done = 0;
    work::parallel_for(range.planes, [&](std::size_t i) {
        search.contrasts[i] = parts.at(search.depths[i]);
        const std::lock_guard lock(mutex);
        progress.report(0.95 * static_cast<double>(++done) / static_cast<double>(range.planes));
    });
    // Planes with a much smaller slope than the clearest plane are ripple and shoulders of its defocus.
    constexpr double min_relative_slope = 0.3;
    double steepest = 0;
    for (const Extremum& extremum : planes_among(search.contrasts, step / search.depth_of_focus,
                                                 search.light_depth_of_focus / search.depth_of_focus)) {
        const double depth = middle_of(parts, search, extremum);
        // Nearly all holograms are more uniform than the objects that they show.
        if (!extremum.maximum && std::abs(depth) <= 2 * std::max(search.depth_of_focus, step)) continue;
        steepest = std::max(steepest, extremum.slope);
        if (extremum.slope < min_relative_slope * steepest) break;
        search.planes.push_back({depth, extremum.prominence, extremum.maximum,
                                 extremum.scale == FocusSearch::edges ? 0 : FocusSearch::cells[extremum.scale]});
    }
    progress.report(1);
    return search;
}

double max_prominence(const FocusSearch& search) {
    return search.planes.empty() ? 0 : search.planes.front().prominence;
}

// Doubles the searched range up to three times until a plane is in focus. Beyond the depth at which pitch and size
// limit the resolution equally, the depth of focus grows with the square of the depth, so fewer depths suffice.
FocusSearch search_farther(const Parts& parts, const FocusSearch& start, const DepthRange& range,
                           const Progress& progress) {
    constexpr std::size_t max_doublings = 3, min_planes = 33;
    // Tuned on discs, smooth and rough: prominence 2.7 to 4.3 at the right depth, 0.37 or less elsewhere.
    constexpr double min_prominence = 1, min_gain = 2;
    FocusSearch best = search_range(parts, start, range, progress.part(0, 1 + max_doublings));
    double factor = 1;
    for (std::size_t i = 1; i <= max_doublings && max_prominence(best) < min_prominence; ++i) {
        factor *= 2;
        const std::size_t planes = std::max(range.planes >> (i - 1), min_planes);
        FocusSearch farther = search_range(parts, start, {factor * range.from, factor * range.to, planes},
                                           progress.part(i, 1 + max_doublings));
        if (max_prominence(farther) > min_gain * max_prominence(best)) best = std::move(farther);
    }
    progress.report(1);
    return best;
}

}  // namespace

Region focus_region(const FieldGrid& grid, const FocusOptions& options) {
    const auto side = [&](std::size_t samples, std::size_t wanted) {
        return std::min(samples, std::max<std::size_t>(wanted > 0 ? wanted : options.max_side, 16));
    };
    const Grid& plane = grid.plane;
    const std::size_t width = side(plane.width, options.width), height = side(plane.height, options.height);
    return {(plane.width - width) / 2, (plane.height - height) / 2, width, height};
}

FocusSearch find_focus(const Fields& fields, const FocusOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    if (fields.empty()) throw Error(ErrorCode::usage, "a field was expected");
    FocusSearch search;
    search.depth_of_focus = std::numeric_limits<double>::infinity();
    for (const auto& field : fields) {
        validate(field->grid(), ErrorCode::usage, "the field");
        search.depth_of_focus = std::min(search.depth_of_focus, depth_of_focus(field->grid()));
    }
    const DepthRange range = range_of(fields, options, search.depth_of_focus);
    Parts parts(fields.size());
    for (std::size_t i = 0; i < fields.size(); ++i) {
        parts.read(i, *fields[i], focus_region(fields[i]->grid(), options),
                   std::max<std::size_t>(options.max_side, 16));
        search.light_depth_of_focus =
            std::max(search.light_depth_of_focus, parts.depth_of_focus(i, fields[i]->grid().wavelength));
    }
    search.light_depth_of_focus = std::max(search.light_depth_of_focus, search.depth_of_focus);
    return options.from == options.to ? search_farther(parts, search, range, progress)
                                      : search_range(parts, search, range, progress);
}

FocusSearch find_focus(const FieldSource& field, const FocusOptions& options, const Progress& progress) {
    // The pointer does not own the field.
    return find_focus(Fields{std::shared_ptr<const FieldSource>(std::shared_ptr<void>(), &field)}, options, progress);
}

}  // namespace hogel
