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

// The parts of several fields that are looked at.
class Parts {
  public:
    explicit Parts(std::size_t fields) : of_field_(fields) {}

    void read(std::size_t index, const FieldSource& field, const Region& region, std::size_t max_side) {
        const std::size_t across = (region.width + max_side - 1) / max_side,
                          down = (region.height + max_side - 1) / max_side;
        for (std::size_t j = 0; j < down; ++j)
            for (std::size_t i = 0; i < across; ++i) {
                core::throw_if_stopped();
                const std::size_t x = region.width * i / across, y = region.height * j / down;
                of_field_[index].emplace_back(field,
                                              Region{region.x0 + x, region.y0 + y, region.width * (i + 1) / across - x,
                                                     region.height * (j + 1) / down - y});
            }
    }

    // The parts of a field are one picture, and fields count alike.
    Contrasts at(double depth) const {
        Contrasts mean{};
        for (const auto& parts : of_field_) {
            LightSums sums;
            for (const PlaneWaves& part : parts) {
                core::throw_if_stopped();
                sums.add(part.at(depth));
            }
            const Contrasts contrasts = sums.contrasts();
            for (std::size_t s = 0; s < mean.size(); ++s)
                mean[s] += contrasts[s] / static_cast<double>(of_field_.size());
        }
        return mean;
    }

    // Metres to either side that light of its frequencies is in focus: 1/(2λB²).
    double depth_of_focus(std::size_t index, double wavelength) const {
        double band = 0;
        for (const PlaneWaves& part : of_field_[index]) band = std::max(band, part.band());
        return 1 / (2 * wavelength * band * band);
    }

  private:
    std::vector<std::deque<PlaneWaves>> of_field_;
};

// The middle of the extremum: the mean depth weighted by what exceeds half the prominence. Where few depths do, more
// are looked at.
double middle_of(const Parts& parts, const FocusSearch& search, const Extremum& extremum) {
    constexpr std::size_t enough = 12, more = 25;
    const std::size_t begin = extremum.begin == 0 ? 0 : extremum.begin - 1,
                      end = std::min(search.depths.size() - 1, extremum.end + 1);
    std::vector<double> depths(search.depths.begin() + static_cast<std::ptrdiff_t>(begin),
                               search.depths.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    std::vector<Contrasts> contrasts(search.contrasts.begin() + static_cast<std::ptrdiff_t>(begin),
                                     search.contrasts.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    if (depths.size() < enough) {
        const double low = depths.front(), step = (depths.back() - low) / (more - 1);
        depths.resize(more);
        contrasts.resize(more);
        work::parallel_for(more, [&](std::size_t i) {
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

// As far as the samples and the size of a field resolve alike.
double farthest(const FieldGrid& grid) {
    const Grid& plane = grid.plane;
    return std::min(static_cast<double>(plane.width) * plane.pitch_x * plane.pitch_x,
                    static_cast<double>(plane.height) * plane.pitch_y * plane.pitch_y) /
           grid.wavelength;
}

// Directions beyond 90 degrees carry nothing: samples finer than half a wave resolve no more.
double depth_of_focus(const FieldGrid& grid) {
    const double finest = std::max(std::min(grid.plane.pitch_x, grid.plane.pitch_y), grid.wavelength / 2);
    return 2 * finest * finest / grid.wavelength;
}

// As far as the samples and the size of the fields resolve alike.
double farthest(const Fields& fields) {
    double depth = 0;
    for (const auto& field : fields) depth = std::max(depth, farthest(field->grid()));
    return depth;
}

struct DepthRange {
    double from = 0, to = 0;
    std::size_t planes = 0;
};

DepthRange range_of(const Fields& fields, const FocusOptions& options, double depth_of_focus) {
    double from = options.from, to = options.to;
    if (!std::isfinite(from) || !std::isfinite(to))
        throw Error(ErrorCode::usage, "from, to", "the depths to search are not finite");
    if (from > to) std::swap(from, to);
    if (from == to) {
        to = farthest(fields);
        from = -to;
    }
    constexpr std::size_t least = 8, most = 1 << 16;
    const double wanted = std::ceil((to - from) / depth_of_focus) + 1;
    const std::size_t count = options.planes > 0
                                  ? options.planes
                                  : std::max<std::size_t>(33, static_cast<std::size_t>(std::min(wanted, 1e9)));
    if (count < least || count > most)
        throw Error(ErrorCode::usage, "from, to, planes",
                    fmt::format("{} depths from {} to {} m were asked for; {} to {} are searched", count, from, to,
                                least, most));
    return {from, to, count};
}

// Searches depths at equal steps. Begins with a search that knows the depths of focus.
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
    // Planes that stand out much less steeply than the clearest one are ripple and shoulders of its defocus.
    constexpr double faintest = 0.3;
    double steepest = 0;
    for (const Extremum& extremum : planes_among(search.contrasts, step / search.depth_of_focus,
                                                 search.light_depth_of_focus / search.depth_of_focus)) {
        const double depth = middle_of(parts, search, extremum);
        // Nearly all holograms are more even than what they show.
        if (!extremum.maximum && std::abs(depth) <= 2 * std::max(search.depth_of_focus, step)) continue;
        steepest = std::max(steepest, extremum.slope);
        if (extremum.slope < faintest * steepest) break;
        search.planes.push_back({depth, extremum.prominence, extremum.maximum,
                                 extremum.scale == FocusSearch::edges ? 0 : FocusSearch::cells[extremum.scale]});
    }
    progress.report(1);
    return search;
}

double clearest(const FocusSearch& search) { return search.planes.empty() ? 0 : search.planes.front().prominence; }

// Where nothing stands out as planes in focus do, searches twice as far, and again. At depths beyond those at which
// samples and size resolve alike, the depth of focus grows with the square of the depth, so that fewer depths will do.
FocusSearch search_farther(const Parts& parts, const FocusSearch& start, const DepthRange& range,
                           const Progress& progress) {
    constexpr std::size_t times = 3, fewest = 33;
    // Measured on discs, smooth and rough: 2.7 to 4.3 at the right depth, 0.37 or less elsewhere.
    constexpr double clear = 1, clearer = 2;
    FocusSearch best = search_range(parts, start, range, progress.part(0, 1 + times));
    double factor = 1;
    for (std::size_t i = 1; i <= times && clearest(best) < clear; ++i) {
        factor *= 2;
        const std::size_t planes = std::max(range.planes >> (i - 1), fewest);
        FocusSearch farther =
            search_range(parts, start, {factor * range.from, factor * range.to, planes}, progress.part(i, 1 + times));
        if (clearest(farther) > clearer * clearest(best)) best = std::move(farther);
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
    // Without a part in its lifetime.
    return find_focus(Fields{std::shared_ptr<const FieldSource>(std::shared_ptr<void>(), &field)}, options, progress);
}

}  // namespace hogel
