// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/speckle_free/speckle_free.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "hogel/camera/narrow_band/narrow_band.h"
#include "hogel/camera/photograph_plan.h"
#include "hogel/camera/speckle_free/kernels.h"
#include "hogel/camera/speckle_free/psf_table.h"
#include "hogel/camera/speckle_free/tails.h"
#include "hogel/core/object_pool.h"
#include "hogel/core/rates.h"
#include "hogel/core/stop_scope.h"
#include "hogel/core/thread_buffer.h"
#include "hogel/work/parallel.h"
#include "hogel/work/steps.h"

namespace hogel::camera::speckle_free {
namespace {

// A fraction by which a pupil's band is widened for the choice of waves.
constexpr double guard = 0.05;

// Hogels that are read together.
constexpr std::size_t block_across = 64, block_down = 2;

// Pixels that are exposed together: many with the same weights, because all weights of a table do not fit into the
// cache.
constexpr std::size_t pixels_across = 512, pixels_down = 8;

// By how much, in radians, the phase of the focus at the pupil's rim may vary over the part of the hologram that one
// table of spots serves.
constexpr double max_change = 0.5;

// Parts of the hologram along each axis that have spots of their own, at most.
constexpr double max_parts = 9;

// As measured: products that take as long as reading the powers of a sample of a hologram, and as its share in the
// numbers of its hogel for an eye.
constexpr double products_of_a_power = 35, products_of_a_power_and_eye = 10;

// A camera: its spots, seen from the middles of the parts of the hologram.
struct Exposure {
    std::size_t camera = 0;
    std::size_t parts_x = 1, parts_y = 1;
    PixelOffsets columns, rows;
    std::vector<PsfTable> spots;  // [part down · parts_x + part across]
    Array<float, 2> tails;        // [hogel], those of the surroundings included: light that falls far away

    // Of a row of hogels.
    float* tails_of_row(std::size_t row) { return &tails(rows.beside + row, columns.beside); }
};

// An eye: the numbers of its hogels, [row][column · pair], and its cameras.
struct SpeckleFreeViewpoint {
    double band = 0;
    std::unique_ptr<PsfBasis> basis;
    std::unique_ptr<Pairs> pairs;
    std::vector<Exposure> exposures;
    Array<float, 2> numbers;
};

// The number of parts along an axis within which the phase of the focus at the rim changes little.
std::size_t parts(const HogelGrid& hogels, const Camera& camera, bool across) {
    const Grid& plane = hogels.plane;
    const auto defocus = [&](double side) {
        const double x = plane.center_x + (across ? side * 0.5 * plane.size_x() : 0),
                     y = plane.center_y + (across ? 0 : side * 0.5 * plane.size_y());
        const ViewGeometry geometry(camera.eye, hogels.wavelength);
        const double ratio = focus_ratio(camera, x, y), cosine = geometry.cosine(x, y);
        const double radius = 0.5 * camera.pupil;
        return std::numbers::pi * radius * radius * cosine * (1 - 1 / ratio) / (camera.eye.z * hogels.wavelength);
    };
    return static_cast<std::size_t>(
        std::clamp(std::ceil(std::abs(defocus(1) - defocus(-1)) / max_change), 1.0, max_parts));
}

// The weight of part `index` of `count` at a position on the hologram, 0 … 1: linear between their middles.
float share(double position, std::size_t index, std::size_t count) {
    const double place = std::clamp(position * static_cast<double>(count) - 0.5, 0.0, static_cast<double>(count) - 1);
    return static_cast<float>(std::max(0.0, 1 - std::abs(place - static_cast<double>(index))));
}

// The places of a picture's columns and rows among the hogels.
std::pair<PixelOffsets, PixelOffsets> places_of(const HogelGrid& hogels, const Camera& camera, const Pairs& pairs,
                                                double band) {
    const Grid &plane = hogels.plane, &picture = camera.picture;
    const std::size_t places = max_places(pairs, PsfTable::reach(hogels, camera, band));
    const Rectangle own(plane),
        seen = film_area(plane, Rectangle(picture),
                         illuminated_area({plane, hogels.wavelength}, camera.eye, camera.pupil, defocus_blur(camera)));
    const auto hogels_in = [](double one_side, double other_side, double pitch) {
        return static_cast<std::size_t>(std::ceil(std::max(one_side, other_side) / pitch));
    };
    return {pixel_offsets(picture.width, plane.column(picture.x(0)), picture.pitch_x / plane.pitch_x, plane.width,
                          hogels_in(own.left - seen.left, seen.right - own.right, plane.pitch_x), places),
            pixel_offsets(picture.height, plane.row(picture.y(0)), picture.pitch_y / plane.pitch_y, plane.height,
                          hogels_in(own.bottom - seen.bottom, seen.top - own.top, plane.pitch_y), places)};
}

Exposure make_exposure(const HogelGrid& hogels, const SpeckleFreeViewpoint& eye, const Camera& camera,
                       std::size_t index) {
    const Grid& plane = hogels.plane;
    Exposure exposure;
    exposure.camera = index;
    std::tie(exposure.columns, exposure.rows) = places_of(hogels, camera, *eye.pairs, eye.band);
    const PixelMeans means(hogels, camera, eye.band, exposure.columns, exposure.rows);
    exposure.parts_x = parts(hogels, camera, true);
    exposure.parts_y = parts(hogels, camera, false);
    for (std::size_t j = 0; j < exposure.parts_y; ++j)
        for (std::size_t i = 0; i < exposure.parts_x; ++i) {
            core::throw_if_stopped();
            const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(exposure.parts_x) - 0.5,
                         y = 0.5 - (static_cast<double>(j) + 0.5) / static_cast<double>(exposure.parts_y);
            exposure.spots.emplace_back(hogels, camera, *eye.basis, *eye.pairs, eye.band,
                                        plane.center_x + x * plane.size_x(), plane.center_y + y * plane.size_y(),
                                        exposure.columns, exposure.rows, means);
        }
    exposure.tails =
        Array<float, 2>({plane.height + 2 * exposure.rows.beside, plane.width + 2 * exposure.columns.beside});
    return exposure;
}

// Products that take as long as reading hogels for some eyes.
double products_of_reading(const HogelGrid& hogels, std::size_t eyes) {
    return static_cast<double>(hogels.plane.samples() * hogels.samples * hogels.samples) *
           (products_of_a_power + static_cast<double>(eyes) * products_of_a_power_and_eye);
}

// Products of numbers of hogels with spots.
double products_of_pixels(const Pairs& pairs, std::size_t reach, const Camera& camera) {
    const auto taps = static_cast<double>(2 * reach + 1);
    return static_cast<double>(pairs.padded_count()) * taps * taps * static_cast<double>(camera.picture.samples());
}

// Photographs for several eyes that share the reading of hogels.
class Photographer {
  public:
    Photographer(const HogelGrid& hogels, const WavePowers& waves, std::span<const Camera> cameras,
                 std::span<const SharedViewpoint> eyes)
        : hogels_(hogels), waves_(waves), cameras_(cameras) {
        for (const SharedViewpoint& shared : eyes) {
            SpeckleFreeViewpoint eye;
            eye.band = half_band(hogels, cameras[shared.members.front()].eye, shared.pupil);
            eye.basis = std::make_unique<PsfBasis>(hogels.samples, eye.band * (1 + guard));
            eye.pairs = std::make_unique<Pairs>(*eye.basis, eye.band);
            for (const std::size_t member : shared.members)
                eye.exposures.push_back(make_exposure(hogels, eye, cameras[member], member));
            eyes_.push_back(std::move(eye));
        }
    }

    // Bytes of the numbers of a row of hogels.
    double row_bytes() const {
        double pairs = 0;
        for (const SpeckleFreeViewpoint& eye : eyes_) pairs += static_cast<double>(eye.pairs->padded_count());
        return pairs * static_cast<double>(hogels_.plane.width) * sizeof(float);
    }
    std::size_t reach() const {
        std::size_t reach = 0;
        for (const SpeckleFreeViewpoint& eye : eyes_)
            for (const Exposure& exposure : eye.exposures) reach = std::max(reach, exposure.spots.front().reach());
        return reach;
    }

    // Exposes the pixels whose middles are on rows [first, end) of hogels.
    void expose(std::size_t first, std::size_t end, std::span<Image> pictures, const Progress& progress) {
        const std::size_t around = reach(), height = hogels_.plane.height;
        first_row_ = first - std::min(first, around);
        const std::size_t last_row = std::min(height, end + around);
        const double reading = reading_share();
        read(last_row - first_row_, first, end, progress.part(0.0, reading));
        const Progress exposing = progress.part(reading, 1.0);
        std::size_t blocks = 0;
        for (const SpeckleFreeViewpoint& eye : eyes_)
            for (const Exposure& exposure : eye.exposures) blocks += blocks_of(exposure);
        work::Steps steps(exposing, blocks);
        for (SpeckleFreeViewpoint& eye : eyes_)
            for (const Exposure& exposure : eye.exposures)
                expose_blocks(exposure, steps, [&](std::size_t row, std::size_t left, std::size_t right) {
                    if (const std::size_t hogel = nearest_row(exposure, row); hogel >= first && hogel < end)
                        expose_row(eye, exposure, row, left, right, pictures[exposure.camera]);
                });
    }

    // Adds the light that falls far from its hogels.
    void add_tails(std::span<Image> pictures) const {
        for (const SpeckleFreeViewpoint& eye : eyes_)
            for (const Exposure& exposure : eye.exposures) {
                const Camera& camera = cameras_[exposure.camera];
                const Array<float, 2> spread =
                    spread_tails(exposure.tails, exposure.spots.front().reach(),
                                 128 * resolution_cell(camera, hogels_.wavelength) / hogels_.plane.pitch_x);
                const Grid &plane = hogels_.plane, &picture = camera.picture;
                Image& image = pictures[exposure.camera];
                const auto above = static_cast<double>(exposure.rows.beside),
                           left = static_cast<double>(exposure.columns.beside);
                work::parallel_for(picture.height, [&](std::size_t row) {
                    const double down = above + plane.row(picture.y(static_cast<double>(row)));
                    for (std::size_t column = 0; column < picture.width; ++column)
                        image.pixels(row, column, 0) +=
                            exposure.rows.seen[row] * exposure.columns.seen[column] *
                            between(spread, down, left + plane.column(picture.x(static_cast<double>(column))));
                });
            }
    }

  private:
    // The row of hogels with which a row of pixels is exposed.
    std::size_t nearest_row(const Exposure& exposure, std::size_t row) const {
        const auto last = static_cast<std::ptrdiff_t>(hogels_.plane.height) - 1;
        return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(exposure.rows.base[row], 0, last));
    }

    // The part of an exposure's time in which hogels are read.
    double reading_share() const {
        const double reading = products_of_reading(hogels_, eyes_.size());
        double exposing = 0;
        for (const SpeckleFreeViewpoint& eye : eyes_)
            for (const Exposure& exposure : eye.exposures)
                exposing += products_of_pixels(*eye.pairs, exposure.spots.front().reach(), cameras_[exposure.camera]);
        return reading / (reading + exposing);
    }

    // Computes the numbers of `count` rows of hogels from first_row_ on, and the tails of rows [first, end).
    void read(std::size_t count, std::size_t first, std::size_t end, const Progress& progress) {
        const Grid& plane = hogels_.plane;
        for (SpeckleFreeViewpoint& eye : eyes_)
            if (eye.numbers.shape() != Shape<2>{count, plane.width * eye.pairs->padded_count()})
                eye.numbers = Array<float, 2>({count, plane.width * eye.pairs->padded_count()});
        const std::size_t across = (plane.width + block_across - 1) / block_across,
                          down = (count + block_down - 1) / block_down;
        work::Steps steps(progress, across * down);
        work::parallel_for(across * down, [&](std::size_t i) {
            Region part{i % across * block_across, first_row_ + i / across * block_down, 0, 0};
            part.width = std::min(block_across, plane.width - part.x0);
            part.height = std::min(block_down, first_row_ + count - part.y0);
            auto powers = powers_.take();
            const std::size_t samples = hogels_.samples, size = PsfBasis::in_lanes(samples) * samples;
            if (powers->size() == 0) *powers = Array<float, 2>({block_across * block_down, size});
            waves_.read({part.x0, part.y0, part.width, part.height}, {powers->data(), {part.samples(), size}});
            for (SpeckleFreeViewpoint& eye : eyes_)
                for (std::size_t h = 0; h < part.samples(); ++h)
                    add_hogel(eye, part.x0 + h % part.width, part.y0 + h / part.width, &(*powers)(h, 0), first, end);
            steps.report_one();
        });
    }

    void add_hogel(SpeckleFreeViewpoint& eye, std::size_t s, std::size_t t, const float* powers, std::size_t first,
                   std::size_t end) const {
        const Grid& plane = hogels_.plane;
        const PsfBasis& basis = *eye.basis;
        const Camera& camera = cameras_[eye.exposures.front().camera];
        const ViewGeometry geometry(camera.eye, hogels_.wavelength);
        const double x = plane.x(static_cast<double>(s)), y = plane.y(static_cast<double>(t));
        const double cycles = plane.pitch_x / hogels_.wavelength;
        const core::ThreadBuffer<float> all(basis.count() * basis.padded_count());
        sum_powers(basis, basis.weights(geometry.sine_x(x, y) * cycles), basis.weights(-geometry.sine_y(x, y) * cycles),
                   powers, all.data());
        float* const numbers = &eye.numbers(t - first_row_, s * eye.pairs->padded_count());
        float* to = numbers;
        for (std::size_t q = 0; q < basis.count(); ++q) {
            const Pairs::Range range = eye.pairs->of_column[q];
            to = std::copy(all.data() + q * basis.padded_count() + range.begin,
                           all.data() + q * basis.padded_count() + range.end, to);
        }
        if (t < first || t >= end) return;
        for (Exposure& exposure : eye.exposures) {
            const std::span<const float> tails = exposure.spots[exposure.spots.size() / 2].tails();
            exposure.tails_of_row(t)[s] = sum_products(numbers, tails.data(), tails.size());
        }
    }

    // Calls expose(row, left, right) for parts of rows of pixels, block by block, so that the numbers around a block
    // stay in the processor's cache.
    template <class Expose>
    static void expose_blocks(const Exposure& exposure, work::Steps& steps, const Expose& expose) {
        const std::size_t width = exposure.columns.base.size(), height = exposure.rows.base.size();
        const std::size_t across = blocks_across(exposure);
        work::parallel_for(blocks_of(exposure), [&](std::size_t i) {
            const std::size_t left = i % across * pixels_across, top = i / across * pixels_down;
            for (std::size_t row = top; row < std::min(top + pixels_down, height); ++row)
                if (exposure.rows.seen[row] > 0) expose(row, left, std::min(left + pixels_across, width));
            steps.report_one();
        });
    }
    static std::size_t blocks_across(const Exposure& exposure) {
        return (exposure.columns.base.size() + pixels_across - 1) / pixels_across;
    }
    static std::size_t blocks_of(const Exposure& exposure) {
        return blocks_across(exposure) * ((exposure.rows.base.size() + pixels_down - 1) / pixels_down);
    }

    // Pixels around the same hogel read the same numbers, and those at the same place of several hogels the same
    // weights.
    struct ActiveHogel {
        std::ptrdiff_t base, left, right;
        std::size_t column, count;  // of its pixels
    };
    void find_lit(const Exposure& exposure, std::size_t first, std::size_t end,
                  std::vector<ActiveHogel>& active) const {
        const auto width = static_cast<std::ptrdiff_t>(hogels_.plane.width),
                   reach = static_cast<std::ptrdiff_t>(exposure.spots.front().reach());
        active.clear();
        for (std::size_t column = first; column < end; ++column) {
            const std::ptrdiff_t base = exposure.columns.base[column];
            if (exposure.columns.seen[column] == 0 || base + reach < 0 || base - reach >= width) continue;
            if (active.empty() || active.back().base != base || active.back().count == max_b_per_pass)
                active.push_back(
                    {base, std::max<std::ptrdiff_t>(0, base - reach), std::min(width, base + reach + 1), column, 0});
            ++active.back().count;
        }
    }

    // Whether the pixels around two hogels have the same weights.
    static bool are_alike(const Exposure& exposure, const ActiveHogel& one, const ActiveHogel& other) {
        const auto places = exposure.columns.place.begin();
        return other.count == one.count && other.left - other.base == one.left - one.base &&
               other.right - other.base == one.right - one.base &&
               std::equal(places + static_cast<std::ptrdiff_t>(one.column),
                          places + static_cast<std::ptrdiff_t>(one.column + one.count),
                          places + static_cast<std::ptrdiff_t>(other.column));
    }

    void expose_row(const SpeckleFreeViewpoint& eye, const Exposure& exposure, std::size_t row, std::size_t first,
                    std::size_t end, Image& picture) const {
        const auto rows = static_cast<std::ptrdiff_t>(eye.numbers.extent(0));
        const std::size_t pairs = eye.pairs->padded_count();
        const auto reach = static_cast<std::ptrdiff_t>(exposure.spots.front().reach());
        const std::ptrdiff_t base_y = exposure.rows.base[row] - static_cast<std::ptrdiff_t>(first_row_);
        const std::ptrdiff_t top = std::max<std::ptrdiff_t>(0, base_y - reach),
                             bottom = std::min(rows, base_y + reach + 1);
        if (top >= bottom) return;
        const auto position = [](std::ptrdiff_t base, double extent) {
            return (static_cast<double>(base) + 0.5) / extent;
        };
        const double down = position(exposure.rows.base[row], static_cast<double>(hogels_.plane.height));
        thread_local std::vector<ActiveHogel> active;
        find_lit(exposure, first, end, active);
        for (auto begin = active.begin(); begin != active.end();) {
            const ActiveHogel one = *begin;
            const auto same = std::partition(begin, active.end(),
                                             [&](const ActiveHogel& other) { return are_alike(exposure, one, other); });
            while (begin != same) {
                const std::span some(begin,
                                     std::min(static_cast<std::size_t>(same - begin), max_a_per_pass(one.count)));
                const float *numbers[max_sums_per_pass], *weights[max_b_per_pass];
                for (std::size_t k = 0; k < some.size(); ++k)
                    numbers[k] = &eye.numbers(top, static_cast<std::size_t>(some[k].left) * pairs);
                for (std::size_t i = 0; i < exposure.spots.size(); ++i) {
                    const float share_down = share(down, i / exposure.parts_x, exposure.parts_y);
                    float shares[max_sums_per_pass], light[max_sums_per_pass], any = 0;
                    for (std::size_t k = 0; k < some.size(); ++k) {
                        const double across = position(some[k].base, static_cast<double>(hogels_.plane.width));
                        shares[k] = share(across, i % exposure.parts_x, exposure.parts_x) * share_down;
                        any = std::max(any, shares[k]);
                    }
                    if (any == 0) continue;
                    const View<const float, 4> spots = exposure.spots[i].weights();
                    for (std::size_t k = 0; k < one.count; ++k)
                        weights[k] =
                            &spots(exposure.rows.place[row], exposure.columns.place[one.column + k],
                                   top - base_y + reach, static_cast<std::size_t>(one.left - one.base + reach) * pairs);
                    sum_products({{numbers, some.size()},
                                  {weights, one.count},
                                  eye.numbers.extent(1),
                                  spots.extent(3),
                                  static_cast<std::size_t>(bottom - top),
                                  static_cast<std::size_t>(one.right - one.left) * pairs},
                                 light);
                    for (std::size_t k = 0; k < some.size() * one.count; ++k) {
                        const ActiveHogel& hogel = some[k / one.count];
                        const std::size_t column = hogel.column + k % one.count;
                        picture.pixels(row, column, 0) +=
                            exposure.rows.seen[row] * exposure.columns.seen[column] * shares[k / one.count] * light[k];
                    }
                }
                begin += static_cast<std::ptrdiff_t>(some.size());
            }
        }
    }

    HogelGrid hogels_;
    const WavePowers& waves_;
    std::span<const Camera> cameras_;
    std::vector<SpeckleFreeViewpoint> eyes_;
    std::size_t first_row_ = 0;  // of the numbers
    core::ObjectPool<Array<float, 2>> powers_;
};

}  // namespace

namespace {

HogelGrid hogel_grid(const FieldGrid& hologram, const WavePowers::Counts& counts) {
    const Grid& samples = hologram.plane;
    const auto side = static_cast<double>(counts.samples);
    return {{counts.across, counts.down, samples.pitch_x * side, samples.pitch_y * side, samples.center_x,
             samples.center_y},
            counts.samples,
            hologram.wavelength};
}

}  // namespace

Plan plan(const FieldGrid& hologram, const WavePowers::Counts& counts, std::span<const Camera> cameras,
          const SpeckleFreeCamera& model) {
    const HogelGrid hogels = hogel_grid(hologram, counts);
    const std::vector<SharedViewpoint> eyes = group_by_viewpoint(cameras);
    double products = products_of_reading(hogels, eyes.size()), bytes = 0;
    for (const SharedViewpoint& eye : eyes) {
        const double band = half_band(hogels, cameras[eye.members.front()].eye, eye.pupil);
        const PsfNodes nodes(counts.samples, band * (1 + guard));
        const Pairs list(nodes, band);
        products += nodes.products();
        const auto pairs = static_cast<double>(list.padded_count());
        bytes += pairs * static_cast<double>(hogels.plane.samples()) * sizeof(float);
        for (const std::size_t member : eye.members) {
            const Camera& camera = cameras[member];
            products += products_of_pixels(list, PsfTable::reach(hogels, camera, band), camera);
            const auto [columns, rows] = places_of(hogels, camera, list, band);
            products += static_cast<double>(parts(hogels, camera, true) * parts(hogels, camera, false)) *
                        PsfTable::products(hogels, camera, list, band, columns, rows);
        }
    }
    return {std::min(bytes, static_cast<double>(model.memory)), 0,
            core::rates::on_all_threads(products * core::rates::product)};
}

void photograph(const FieldSource& hologram, const WavePowers& waves, std::span<const Camera> cameras,
                const SpeckleFreeCamera& model, std::span<Image> pictures, const Progress& progress) {
    const FieldGrid& field = hologram.grid();
    for (const Camera& camera : cameras) {
        validate(camera);
        require_resolution(field, camera);
        narrow_band::NarrowBand(field, camera.eye, camera.pupil);  // throws where the pupil is too wide for the pitch
    }
    const WavePowers::Counts counts = waves.counts();
    const HogelGrid hogels = hogel_grid(field, counts);
    const std::vector<SharedViewpoint> eyes = group_by_viewpoint(cameras);
    // As many eyes at a time as fit into memory with enough rows of hogels.
    std::size_t at_once = eyes.size();
    for (std::size_t done = 0; done < eyes.size();) {
        const std::span<const SharedViewpoint> some =
            std::span(eyes).subspan(done, std::min(at_once, eyes.size() - done));
        Photographer photographer(hogels, waves, cameras, some);
        const auto fit = static_cast<std::size_t>(static_cast<double>(model.memory) / photographer.row_bytes());
        const std::size_t around = 2 * photographer.reach();
        if (fit < std::min(counts.down, 3 * around) && at_once > 1) {
            at_once = (at_once + 1) / 2;
            continue;
        }
        const std::size_t rows = fit >= counts.down ? counts.down : std::max(fit, around + 1) - around;
        const auto fraction = [&](std::size_t row) {
            return (static_cast<double>(done) + 0.98 * static_cast<double>(some.size()) * static_cast<double>(row) /
                                                    static_cast<double>(counts.down)) /
                   static_cast<double>(eyes.size());
        };
        for (std::size_t first = 0; first < counts.down; first += rows) {
            const std::size_t end = std::min(counts.down, first + rows);
            photographer.expose(first, end, pictures, progress.part(fraction(first), fraction(end)));
        }
        photographer.add_tails(pictures);
        done += some.size();
    }
    progress.report(1);
}

}  // namespace hogel::camera::speckle_free
