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

constexpr double guard = 0.05;

constexpr std::size_t block_width = 64, block_height = 2;

// Pixels of a tile. Many have the same weights, because the weights of a whole table exceed the cache.
constexpr std::size_t tile_width = 512, tile_height = 8;

// Maximum variation, radians, of the focus phase at the pupil's rim over the part that a PSF table serves.
constexpr double max_change = 0.5;

// Maximum number of parts of the hologram along each axis with PSF tables of their own.
constexpr double max_parts = 9;

// Measured: products in the time of reading the power of a sample, and of adding it to a viewpoint's numbers.
constexpr double products_per_power = 35, products_per_power_and_viewpoint = 10;

// A camera with its PSF tables, computed for the middles of the parts of the hologram.
struct Exposure {
    std::size_t camera = 0;
    std::size_t parts_x = 1, parts_y = 1;
    PixelOffsets columns, rows;
    std::vector<PsfTable> psf_tables;  // [part down · parts_x + part across]
    Array<float, 2> tails;             // [hogel], including the surroundings: light of the PSF tails

    float* tails_of_row(std::size_t row) { return &tails(rows.border + row, columns.border); }
};

// A viewpoint: the numbers of its hogels, [row][column · pair], and its cameras.
struct SpeckleFreeViewpoint {
    double band = 0;
    std::unique_ptr<PsfBasis> basis;
    std::unique_ptr<NodePairs> pairs;
    std::vector<Exposure> exposures;
    Array<float, 2> numbers;
};

// Returns the number of parts along an axis within which the focus phase at the rim changes little.
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

// Returns the weight of a part at a position on the hologram, 0 … 1: linear between the middles of parts.
float part_weight(double position, std::size_t index, std::size_t count) {
    const double part_position =
        std::clamp(position * static_cast<double>(count) - 0.5, 0.0, static_cast<double>(count) - 1);
    return static_cast<float>(std::max(0.0, 1 - std::abs(part_position - static_cast<double>(index))));
}

std::pair<PixelOffsets, PixelOffsets> offsets_of(const HogelGrid& hogels, const Camera& camera, const NodePairs& pairs,
                                                 double band) {
    const Grid &plane = hogels.plane, &picture = camera.picture;
    const std::size_t max_count = max_offsets(pairs, PsfTable::support(hogels, camera, band));
    const Rectangle hologram_area(plane),
        shown = film_area(plane, Rectangle(picture),
                          illuminated_area({plane, hogels.wavelength}, camera.eye, camera.pupil, defocus_blur(camera)));
    const auto hogels_in = [](double first_side, double second_side, double pitch) {
        return static_cast<std::size_t>(std::ceil(std::max(first_side, second_side) / pitch));
    };
    return {pixel_offsets(picture.width, plane.column(picture.x(0)), picture.pitch_x / plane.pitch_x, plane.width,
                          hogels_in(hologram_area.left - shown.left, shown.right - hologram_area.right, plane.pitch_x),
                          max_count),
            pixel_offsets(picture.height, plane.row(picture.y(0)), picture.pitch_y / plane.pitch_y, plane.height,
                          hogels_in(hologram_area.bottom - shown.bottom, shown.top - hologram_area.top, plane.pitch_y),
                          max_count)};
}

Exposure make_exposure(const HogelGrid& hogels, const SpeckleFreeViewpoint& viewpoint, const Camera& camera,
                       std::size_t index) {
    const Grid& plane = hogels.plane;
    Exposure exposure;
    exposure.camera = index;
    std::tie(exposure.columns, exposure.rows) = offsets_of(hogels, camera, *viewpoint.pairs, viewpoint.band);
    const PixelMeans means(hogels, camera, viewpoint.band, exposure.columns, exposure.rows);
    exposure.parts_x = parts(hogels, camera, true);
    exposure.parts_y = parts(hogels, camera, false);
    for (std::size_t j = 0; j < exposure.parts_y; ++j)
        for (std::size_t i = 0; i < exposure.parts_x; ++i) {
            core::throw_if_stopped();
            const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(exposure.parts_x) - 0.5,
                         y = 0.5 - (static_cast<double>(j) + 0.5) / static_cast<double>(exposure.parts_y);
            exposure.psf_tables.emplace_back(hogels, camera, *viewpoint.basis, *viewpoint.pairs, viewpoint.band,
                                             plane.center_x + x * plane.size_x(), plane.center_y + y * plane.size_y(),
                                             exposure.columns, exposure.rows, means);
        }
    exposure.tails =
        Array<float, 2>({plane.height + 2 * exposure.rows.border, plane.width + 2 * exposure.columns.border});
    return exposure;
}

// Returns the products in the time of reading hogels for `viewpoints` viewpoints.
double products_of_reading(const HogelGrid& hogels, std::size_t viewpoints) {
    return static_cast<double>(hogels.plane.samples() * hogels.samples * hogels.samples) *
           (products_per_power + static_cast<double>(viewpoints) * products_per_power_and_viewpoint);
}

double products_of_pixels(const NodePairs& pairs, std::size_t support, const Camera& camera) {
    const auto taps = static_cast<double>(2 * support + 1);
    return static_cast<double>(pairs.padded_count()) * taps * taps * static_cast<double>(camera.picture.samples());
}

// Photographer for several viewpoints, which share the reading of hogels.
class Photographer {
  public:
    Photographer(const HogelGrid& hogels, const WavePowers& waves, std::span<const Camera> cameras,
                 std::span<const SharedViewpoint> viewpoints)
        : hogels_(hogels), waves_(waves), cameras_(cameras) {
        for (const SharedViewpoint& shared : viewpoints) {
            SpeckleFreeViewpoint viewpoint;
            viewpoint.band = half_band(hogels, cameras[shared.members.front()].eye, shared.pupil);
            viewpoint.basis = std::make_unique<PsfBasis>(hogels.samples, viewpoint.band * (1 + guard));
            viewpoint.pairs = std::make_unique<NodePairs>(*viewpoint.basis, viewpoint.band);
            for (const std::size_t member : shared.members)
                viewpoint.exposures.push_back(make_exposure(hogels, viewpoint, cameras[member], member));
            viewpoints_.push_back(std::move(viewpoint));
        }
    }

    double row_bytes() const {
        double pairs = 0;
        for (const SpeckleFreeViewpoint& viewpoint : viewpoints_)
            pairs += static_cast<double>(viewpoint.pairs->padded_count());
        return pairs * static_cast<double>(hogels_.plane.width) * sizeof(float);
    }
    std::size_t support() const {
        std::size_t support = 0;
        for (const SpeckleFreeViewpoint& viewpoint : viewpoints_)
            for (const Exposure& exposure : viewpoint.exposures)
                support = std::max(support, exposure.psf_tables.front().support());
        return support;
    }

    // Exposes the pixels with middles on rows [first, end) of hogels.
    void expose(std::size_t first, std::size_t end, std::span<Image> pictures, const Progress& progress) {
        const std::size_t margin = support(), height = hogels_.plane.height;
        first_row_ = first - std::min(first, margin);
        const std::size_t last_row = std::min(height, end + margin);
        const double reading = reading_share();
        read(last_row - first_row_, first, end, progress.part(0.0, reading));
        const Progress exposing = progress.part(reading, 1.0);
        std::size_t blocks = 0;
        for (const SpeckleFreeViewpoint& viewpoint : viewpoints_)
            for (const Exposure& exposure : viewpoint.exposures) blocks += blocks_of(exposure);
        work::Steps steps(exposing, blocks);
        for (SpeckleFreeViewpoint& viewpoint : viewpoints_)
            for (const Exposure& exposure : viewpoint.exposures)
                expose_blocks(exposure, steps, [&](std::size_t row, std::size_t left, std::size_t right) {
                    if (const std::size_t hogel = nearest_row(exposure, row); hogel >= first && hogel < end)
                        expose_row(viewpoint, exposure, row, left, right, pictures[exposure.camera]);
                });
    }

    void add_tails(std::span<Image> pictures) const {
        for (const SpeckleFreeViewpoint& viewpoint : viewpoints_)
            for (const Exposure& exposure : viewpoint.exposures) {
                const Camera& camera = cameras_[exposure.camera];
                const Array<float, 2> spread =
                    spread_tails(exposure.tails, exposure.psf_tables.front().support(),
                                 128 * resolution_cell(camera, hogels_.wavelength) / hogels_.plane.pitch_x);
                const Grid &plane = hogels_.plane, &picture = camera.picture;
                Image& image = pictures[exposure.camera];
                const auto above = static_cast<double>(exposure.rows.border),
                           left = static_cast<double>(exposure.columns.border);
                work::parallel_for(picture.height, [&](std::size_t row) {
                    const double down = above + plane.row(picture.y(static_cast<double>(row)));
                    for (std::size_t column = 0; column < picture.width; ++column)
                        image.pixels(row, column, 0) +=
                            exposure.rows.visible[row] * exposure.columns.visible[column] *
                            interpolate(spread, down, left + plane.column(picture.x(static_cast<double>(column))));
                });
            }
    }

  private:
    // Returns the row of hogels with which a row of pixels is exposed.
    std::size_t nearest_row(const Exposure& exposure, std::size_t row) const {
        const auto last = static_cast<std::ptrdiff_t>(hogels_.plane.height) - 1;
        return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(exposure.rows.base[row], 0, last));
    }

    double reading_share() const {
        const double reading = products_of_reading(hogels_, viewpoints_.size());
        double exposing = 0;
        for (const SpeckleFreeViewpoint& viewpoint : viewpoints_)
            for (const Exposure& exposure : viewpoint.exposures)
                exposing += products_of_pixels(*viewpoint.pairs, exposure.psf_tables.front().support(),
                                               cameras_[exposure.camera]);
        return reading / (reading + exposing);
    }

    // Computes the numbers of `count` rows of hogels from first_row_ on, and the tails of rows [first, end).
    void read(std::size_t count, std::size_t first, std::size_t end, const Progress& progress) {
        const Grid& plane = hogels_.plane;
        for (SpeckleFreeViewpoint& viewpoint : viewpoints_)
            if (viewpoint.numbers.shape() != Shape<2>{count, plane.width * viewpoint.pairs->padded_count()})
                viewpoint.numbers = Array<float, 2>({count, plane.width * viewpoint.pairs->padded_count()});
        const std::size_t across = (plane.width + block_width - 1) / block_width,
                          down = (count + block_height - 1) / block_height;
        work::Steps steps(progress, across * down);
        work::parallel_for(across * down, [&](std::size_t i) {
            Region part{i % across * block_width, first_row_ + i / across * block_height, 0, 0};
            part.width = std::min(block_width, plane.width - part.x0);
            part.height = std::min(block_height, first_row_ + count - part.y0);
            auto powers = powers_.take();
            const std::size_t samples = hogels_.samples, size = PsfBasis::padded_to_lanes(samples) * samples;
            if (powers->size() == 0) *powers = Array<float, 2>({block_width * block_height, size});
            waves_.read({part.x0, part.y0, part.width, part.height}, {powers->data(), {part.samples(), size}});
            for (SpeckleFreeViewpoint& viewpoint : viewpoints_)
                for (std::size_t h = 0; h < part.samples(); ++h)
                    add_hogel(viewpoint, part.x0 + h % part.width, part.y0 + h / part.width, &(*powers)(h, 0), first,
                              end);
            steps.report_one();
        });
    }

    void add_hogel(SpeckleFreeViewpoint& viewpoint, std::size_t s, std::size_t t, const float* powers,
                   std::size_t first, std::size_t end) const {
        const Grid& plane = hogels_.plane;
        const PsfBasis& basis = *viewpoint.basis;
        const Camera& camera = cameras_[viewpoint.exposures.front().camera];
        const ViewGeometry geometry(camera.eye, hogels_.wavelength);
        const double x = plane.x(static_cast<double>(s)), y = plane.y(static_cast<double>(t));
        const double cycles = plane.pitch_x / hogels_.wavelength;
        const core::ThreadBuffer<float> sums(basis.count() * basis.padded_count());
        sum_powers(basis, basis.weights(geometry.sine_x(x, y) * cycles), basis.weights(-geometry.sine_y(x, y) * cycles),
                   powers, sums.data());
        float* const numbers = &viewpoint.numbers(t - first_row_, s * viewpoint.pairs->padded_count());
        float* to = numbers;
        for (std::size_t q = 0; q < basis.count(); ++q) {
            const NodePairs::Range range = viewpoint.pairs->ranges[q];
            to = std::copy(sums.data() + q * basis.padded_count() + range.begin,
                           sums.data() + q * basis.padded_count() + range.end, to);
        }
        if (t < first || t >= end) return;
        for (Exposure& exposure : viewpoint.exposures) {
            const std::span<const float> tails = exposure.psf_tables[exposure.psf_tables.size() / 2].tails();
            exposure.tails_of_row(t)[s] = sum_products(numbers, tails.data(), tails.size());
        }
    }

    // Calls expose(row, left, right) tile by tile, so that the numbers around a tile stay in the processor's cache.
    template <class Expose>
    static void expose_blocks(const Exposure& exposure, work::Steps& steps, const Expose& expose) {
        const std::size_t width = exposure.columns.base.size(), height = exposure.rows.base.size();
        const std::size_t across = blocks_across(exposure);
        work::parallel_for(blocks_of(exposure), [&](std::size_t i) {
            const std::size_t left = i % across * tile_width, top = i / across * tile_height;
            for (std::size_t row = top; row < std::min(top + tile_height, height); ++row)
                if (exposure.rows.visible[row] > 0) expose(row, left, std::min(left + tile_width, width));
            steps.report_one();
        });
    }
    static std::size_t blocks_across(const Exposure& exposure) {
        return (exposure.columns.base.size() + tile_width - 1) / tile_width;
    }
    static std::size_t blocks_of(const Exposure& exposure) {
        return blocks_across(exposure) * ((exposure.rows.base.size() + tile_height - 1) / tile_height);
    }

    // Pixels around a hogel read the same numbers; those at the same offset from several hogels have the same weights.
    struct PixelRun {
        std::ptrdiff_t base, left, right;
        std::size_t column, count;  // of its pixels
    };
    void find_active(const Exposure& exposure, std::size_t first, std::size_t end,
                     std::vector<PixelRun>& active) const {
        const auto width = static_cast<std::ptrdiff_t>(hogels_.plane.width),
                   support = static_cast<std::ptrdiff_t>(exposure.psf_tables.front().support());
        active.clear();
        for (std::size_t column = first; column < end; ++column) {
            const std::ptrdiff_t base = exposure.columns.base[column];
            if (exposure.columns.visible[column] == 0 || base + support < 0 || base - support >= width) continue;
            if (active.empty() || active.back().base != base || active.back().count == max_b_per_pass)
                active.push_back({base, std::max<std::ptrdiff_t>(0, base - support),
                                  std::min(width, base + support + 1), column, 0});
            ++active.back().count;
        }
    }

    static bool have_same_weights(const Exposure& exposure, const PixelRun& a, const PixelRun& b) {
        const auto entry_of_pixel = exposure.columns.entry.begin();
        return b.count == a.count && b.left - b.base == a.left - a.base && b.right - b.base == a.right - a.base &&
               std::equal(entry_of_pixel + static_cast<std::ptrdiff_t>(a.column),
                          entry_of_pixel + static_cast<std::ptrdiff_t>(a.column + a.count),
                          entry_of_pixel + static_cast<std::ptrdiff_t>(b.column));
    }

    void expose_row(const SpeckleFreeViewpoint& viewpoint, const Exposure& exposure, std::size_t row, std::size_t first,
                    std::size_t end, Image& picture) const {
        const auto rows = static_cast<std::ptrdiff_t>(viewpoint.numbers.extent(0));
        const std::size_t pairs = viewpoint.pairs->padded_count();
        const auto support = static_cast<std::ptrdiff_t>(exposure.psf_tables.front().support());
        const std::ptrdiff_t base_y = exposure.rows.base[row] - static_cast<std::ptrdiff_t>(first_row_);
        const std::ptrdiff_t top = std::max<std::ptrdiff_t>(0, base_y - support),
                             bottom = std::min(rows, base_y + support + 1);
        if (top >= bottom) return;
        const auto position = [](std::ptrdiff_t base, double extent) {
            return (static_cast<double>(base) + 0.5) / extent;
        };
        const double down = position(exposure.rows.base[row], static_cast<double>(hogels_.plane.height));
        thread_local std::vector<PixelRun> active;
        find_active(exposure, first, end, active);
        for (auto begin = active.begin(); begin != active.end();) {
            const PixelRun run = *begin;
            const auto batch_end = std::partition(begin, active.end(), [&](const PixelRun& other_run) {
                return have_same_weights(exposure, run, other_run);
            });
            while (begin != batch_end) {
                const std::span batch(begin,
                                      std::min(static_cast<std::size_t>(batch_end - begin), max_a_per_pass(run.count)));
                const float *numbers[max_sums_per_pass], *weights[max_b_per_pass];
                for (std::size_t k = 0; k < batch.size(); ++k)
                    numbers[k] = &viewpoint.numbers(top, static_cast<std::size_t>(batch[k].left) * pairs);
                for (std::size_t i = 0; i < exposure.psf_tables.size(); ++i) {
                    const float share_down = part_weight(down, i / exposure.parts_x, exposure.parts_y);
                    float shares[max_sums_per_pass], light[max_sums_per_pass], max_share = 0;
                    for (std::size_t k = 0; k < batch.size(); ++k) {
                        const double across = position(batch[k].base, static_cast<double>(hogels_.plane.width));
                        shares[k] = part_weight(across, i % exposure.parts_x, exposure.parts_x) * share_down;
                        max_share = std::max(max_share, shares[k]);
                    }
                    if (max_share == 0) continue;
                    const View<const float, 4> psf_weights = exposure.psf_tables[i].weights();
                    for (std::size_t k = 0; k < run.count; ++k)
                        weights[k] = &psf_weights(exposure.rows.entry[row], exposure.columns.entry[run.column + k],
                                                  top - base_y + support,
                                                  static_cast<std::size_t>(run.left - run.base + support) * pairs);
                    sum_products({{numbers, batch.size()},
                                  {weights, run.count},
                                  viewpoint.numbers.extent(1),
                                  psf_weights.extent(3),
                                  static_cast<std::size_t>(bottom - top),
                                  static_cast<std::size_t>(run.right - run.left) * pairs},
                                 light);
                    for (std::size_t k = 0; k < batch.size() * run.count; ++k) {
                        const PixelRun& target = batch[k / run.count];
                        const std::size_t column = target.column + k % run.count;
                        picture.pixels(row, column, 0) += exposure.rows.visible[row] *
                                                          exposure.columns.visible[column] * shares[k / run.count] *
                                                          light[k];
                    }
                }
                begin += static_cast<std::ptrdiff_t>(batch.size());
            }
        }
    }

    HogelGrid hogels_;
    const WavePowers& waves_;
    std::span<const Camera> cameras_;
    std::vector<SpeckleFreeViewpoint> viewpoints_;
    std::size_t first_row_ = 0;  // first row of hogels in the numbers
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
    const std::vector<SharedViewpoint> viewpoints = group_by_viewpoint(cameras);
    double products = products_of_reading(hogels, viewpoints.size()), bytes = 0;
    for (const SharedViewpoint& viewpoint : viewpoints) {
        const double band = half_band(hogels, cameras[viewpoint.members.front()].eye, viewpoint.pupil);
        const PsfNodes nodes(counts.samples, band * (1 + guard));
        const NodePairs list(nodes, band);
        products += nodes.products();
        const auto pairs = static_cast<double>(list.padded_count());
        bytes += pairs * static_cast<double>(hogels.plane.samples()) * sizeof(float);
        for (const std::size_t member : viewpoint.members) {
            const Camera& camera = cameras[member];
            products += products_of_pixels(list, PsfTable::support(hogels, camera, band), camera);
            const auto [columns, rows] = offsets_of(hogels, camera, list, band);
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
        narrow_band::NarrowBand(field, camera.eye, camera.pupil);  // throws if the pupil is too wide for the pitch
    }
    const WavePowers::Counts counts = waves.counts();
    const HogelGrid hogels = hogel_grid(field, counts);
    const std::vector<SharedViewpoint> viewpoints = group_by_viewpoint(cameras);
    // As many viewpoints at a time as fit into memory with enough rows of hogels.
    std::size_t viewpoints_per_pass = viewpoints.size();
    for (std::size_t done = 0; done < viewpoints.size();) {
        const std::span<const SharedViewpoint> batch =
            std::span(viewpoints).subspan(done, std::min(viewpoints_per_pass, viewpoints.size() - done));
        Photographer photographer(hogels, waves, cameras, batch);
        const auto rows_that_fit =
            static_cast<std::size_t>(static_cast<double>(model.memory) / photographer.row_bytes());
        const std::size_t margin = 2 * photographer.support();
        if (rows_that_fit < std::min(counts.down, 3 * margin) && viewpoints_per_pass > 1) {
            viewpoints_per_pass = (viewpoints_per_pass + 1) / 2;
            continue;
        }
        const std::size_t rows =
            rows_that_fit >= counts.down ? counts.down : std::max(rows_that_fit, margin + 1) - margin;
        const auto fraction = [&](std::size_t row) {
            return (static_cast<double>(done) + 0.98 * static_cast<double>(batch.size()) * static_cast<double>(row) /
                                                    static_cast<double>(counts.down)) /
                   static_cast<double>(viewpoints.size());
        };
        for (std::size_t first = 0; first < counts.down; first += rows) {
            const std::size_t end = std::min(counts.down, first + rows);
            photographer.expose(first, end, pictures, progress.part(fraction(first), fraction(end)));
        }
        photographer.add_tails(pictures);
        done += batch.size();
    }
    progress.report(1);
}

}  // namespace hogel::camera::speckle_free
