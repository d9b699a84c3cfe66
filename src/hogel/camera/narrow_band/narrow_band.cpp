// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/narrow_band/narrow_band.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hogel/camera/narrow_band/kernels.h"
#include "hogel/communicator.h"
#include "hogel/core/object_pool.h"
#include "hogel/core/stop_scope.h"
#include "hogel/optics/low_pass.h"
#include "hogel/optics/multiply.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/units.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel::camera::narrow_band {
namespace {

using Complex = std::complex<float>;

// Relative widening of a pupil's band, so that viewpoints can share a pass down the columns (see share_columns()) and
// the band's width may vary slightly over the hologram.
constexpr double guard = 0.1;

// Returns half the width of the band, cycles per metre, at the point of the hologram nearest to the viewpoint.
double half_band(const FieldGrid& hologram, Vec3 viewpoint, double pupil) {
    const Grid& plane = hologram.plane;
    const double x = std::clamp(viewpoint.x, plane.center_x - plane.size_x() / 2, plane.center_x + plane.size_x() / 2);
    const double y = std::clamp(viewpoint.y, plane.center_y - plane.size_y() / 2, plane.center_y + plane.size_y() / 2);
    return 0.5 * pupil / (hologram.wavelength * ViewGeometry(viewpoint, hologram.wavelength).distance(x, y));
}

// Range of the band's samples to which samples [begin, end) of the hologram contribute.
struct SampleRange {
    std::size_t first, end;
};

SampleRange sample_range(const NarrowBand& band, std::size_t samples, std::size_t begin, std::size_t end) {
    const auto taps = static_cast<std::ptrdiff_t>(band.taps.size());
    SampleRange r{0, 0};
    while (r.first + 1 < samples && band.first_tap(r.first) + taps <= static_cast<std::ptrdiff_t>(begin)) ++r.first;
    for (r.end = r.first; r.end < samples && band.first_tap(r.end) < static_cast<std::ptrdiff_t>(end);) ++r.end;
    return r;
}

// Whether two bands share the pass down the columns. Viewpoints at the same height and distance need nearly the same
// demodulation down the columns of a narrow tile. They share it, and the difference of their phases is applied after
// the decimation, to fewer samples. The guard band limits the slope of that difference.
bool share_columns(const NarrowBand& a, const NarrowBand& b, const Grid& plane) {
    if (a.factor != b.factor) return false;
    double worst = 0;
    for (double x : {plane.x(0), plane.x(static_cast<double>(plane.width) - 1)})
        for (double y : {plane.y(0), plane.y(static_cast<double>(plane.height) - 1)})
            worst = std::max(worst, std::abs(a.geometry.sine_y(x, y) - b.geometry.sine_y(x, y)));
    const double passed = optics::LowPass::pass / (static_cast<double>(a.factor) * plane.pitch_y);
    return worst / a.geometry.wavelength() < 0.5 * guard * passed;
}

// Contribution of one block to one band, for all looks.
struct Contribution {
    Contribution() = default;
    Contribution(SampleRange down, SampleRange across, std::size_t count) : rows(down), columns(across) {
        for (std::size_t look = 0; look < count; ++look)
            looks.emplace_back(Shape<2>{rows.end - rows.first, columns.end - columns.first});
    }
    SampleRange rows{}, columns{};
    std::vector<Array<Complex, 2>> looks;
};

using Contributions = std::vector<std::vector<Contribution>>;  // [group][member]

work::Sent<Contributions> sent_contributions() {
    return {[](work::MessageWriter& writer, const Contributions& groups) {
                writer.put(groups.size());
                for (const auto& members : groups) {
                    writer.put(members.size());
                    for (const Contribution& member : members) {
                        writer.put(member.rows);
                        writer.put(member.columns);
                        writer.put(member.looks.size());
                        for (const auto& look : member.looks) writer.put(look);
                    }
                }
            },
            [](work::MessageReader& reader) {
                Contributions groups(reader.get<std::size_t>());
                for (auto& members : groups) {
                    members.resize(reader.get<std::size_t>());
                    for (Contribution& member : members) {
                        member.rows = reader.get<SampleRange>();
                        member.columns = reader.get<SampleRange>();
                        member.looks.resize(reader.get<std::size_t>());
                        for (auto& look : member.looks) look = reader.get_array<Complex, 2>();
                    }
                }
                return groups;
            }};
}

// Applies both low-passes to one tile, for a group of bands that share the pass down the columns.
class TilePass {
  public:
    TilePass(const Grid& plane, std::span<const NarrowBand> bands, std::span<const std::size_t> group,
             const Region& region)
        : bands_(bands), group_(group), region_(region), first_band_(bands[group.front()]) {
        rows_ = sample_range(first_band_, first_band_.plane.height, region.y0, region.y0 + region.height);
        columns_ = sample_range(first_band_, first_band_.plane.width, region.x0, region.x0 + region.width);
        // The pass down the columns removes the phase of the tile's middle column for the first band.
        const double middle = plane.x(static_cast<double>(region.x0) + 0.5 * static_cast<double>(region.width) - 0.5);
        const auto column_phase = [&](double y) { return first_band_.geometry.cycles(middle, y); };
        demodulation_.reserve(region.height);
        for (std::size_t r = 0; r < region.height; ++r)
            demodulation_.push_back(
                Complex(optics::unit_phasor(column_phase(plane.y(static_cast<double>(region.y0 + r))))));
        for (std::size_t band : group_) phases_.push_back(remaining_phases(plane, bands_[band], column_phase));
        prepare_line_taps();
    }

    // Adds one look to the contributions of the tile's block, which are in the order of the group.
    void add(const Complex* tile, std::size_t stride, std::size_t look,
             std::vector<Contribution>& contributions) const {
        const std::size_t rows = rows_.end - rows_.first, columns = columns_.end - columns_.first;
        Array<Complex, 2> down({rows, region_.width});
        decimated_columns(tile,
                          {region_.width, stride, first_band_.factor,
                           first_band_.first_tap(rows_.first) - static_cast<std::ptrdiff_t>(region_.y0),
                           first_band_.taps, demodulation_},
                          down.data(), region_.width, rows);
        // Padding before and after the line, so that every kernel fits completely.
        std::vector<Complex> line(before_ + region_.width + after_), band(columns);
        for (std::size_t m = 0; m < rows; ++m)
            for (std::size_t member = 0; member < group_.size(); ++member) {
                optics::multiply(&down(m, 0), phases_[member].view()[m].data(),
                                 std::span(line).subspan(before_, region_.width));
                decimated_line(line.data(), first_band_.factor, line_taps_, band);
                Contribution& contribution = contributions[member];
                Complex* const destination = &contribution.looks[look](rows_.first - contribution.rows.first + m,
                                                                       columns_.first - contribution.columns.first);
                for (std::size_t n = 0; n < columns; ++n) destination[n] += band[n];
            }
    }

  private:
    // Returns e^{ik|x−c|} without the phase already removed, at every hologram column and band row of the tile.
    template <class Phase>
    Array<Complex, 2> remaining_phases(const Grid& plane, const NarrowBand& band, const Phase& removed) const {
        Array<Complex, 2> phases({rows_.end - rows_.first, region_.width});
        for (std::size_t m = 0; m < phases.extent(0); ++m) {
            const double y = plane.y(band.hologram_index(rows_.first + m)), removed_cycles = removed(y);
            const Vec3 c = band.geometry.eye();
            path_phases({plane.x(static_cast<double>(region_.x0)) - c.x, plane.pitch_x,
                         (y - c.y) * (y - c.y) + c.z * c.z, band.geometry.wavelength(), removed_cycles},
                        phases[m].elements());
        }
        return phases;
    }

    // Prepares the taps, which are the same for every band sample. The first is `before_` samples left of the tile.
    void prepare_line_taps() {
        for (float tap : first_band_.taps) line_taps_.insert(line_taps_.end(), 2, tap);
        before_ =
            static_cast<std::size_t>(static_cast<std::ptrdiff_t>(region_.x0) - first_band_.first_tap(columns_.first));
        const std::size_t last = (columns_.end - 1 - columns_.first) * first_band_.factor + first_band_.taps.size();
        after_ = last > before_ + region_.width ? last - before_ - region_.width : 0;
    }

    std::span<const NarrowBand> bands_;
    std::span<const std::size_t> group_;
    Region region_;
    const NarrowBand& first_band_;
    SampleRange rows_, columns_;
    std::vector<Complex> demodulation_;      // one per row of the tile
    std::vector<Array<Complex, 2>> phases_;  // one per band, [band row][hologram column]
    std::vector<float> line_taps_;
    std::size_t before_ = 0, after_ = 0;
};

std::vector<Region> tiles_of(const Region& block) {
    constexpr std::size_t width = NarrowBand::tile_width, height = NarrowBand::tile_height;
    std::vector<Region> list;
    for (std::size_t y = 0; y < block.height; y += height)
        for (std::size_t x = 0; x < block.width; x += width)
            list.push_back(
                {block.x0 + x, block.y0 + y, std::min(width, block.width - x), std::min(height, block.height - y)});
    return list;
}

// Returns the blocks of tiles that a thread reads as a whole, because on-demand synthesis computes whole hogels. There
// are enough for many threads, of similar size. With several looks a block is a single tile, because a source may keep
// the common data of a region's looks. Blocks do not depend on the source's tiles.
std::vector<Region> blocks_of(const FieldSource& hologram) {
    constexpr double min_blocks = 64, max_side = 8;
    const Grid& plane = hologram.grid().plane;
    const std::size_t across = (plane.width + NarrowBand::tile_width - 1) / NarrowBand::tile_width,
                      down = (plane.height + NarrowBand::tile_height - 1) / NarrowBand::tile_height;
    const double max_block_side = hologram.looks() > 1 ? 1.0 : max_side;
    const auto side = static_cast<std::size_t>(
        std::clamp(std::floor(std::sqrt(static_cast<double>(across * down) / min_blocks)), 1.0, max_block_side));
    const auto begin = [&](std::size_t i, std::size_t tiles, std::size_t tile, std::size_t end) {
        const std::size_t blocks = (tiles + side - 1) / side;
        return std::min(end, i * tiles / blocks * tile);
    };
    std::vector<Region> list;
    for (std::size_t j = 0; j * side < down; ++j)
        for (std::size_t i = 0; i * side < across; ++i) {
            const std::size_t x = begin(i, across, NarrowBand::tile_width, plane.width),
                              y = begin(j, down, NarrowBand::tile_height, plane.height);
            list.push_back({x, y, begin(i + 1, across, NarrowBand::tile_width, plane.width) - x,
                            begin(j + 1, down, NarrowBand::tile_height, plane.height) - y});
        }
    return list;
}

// Reads a block's rows from top to bottom, whole hogels at a time, and keeps the rows that the next tiles need.
class BlockReader {
  public:
    BlockReader(const FieldSource& hologram, const Region& block, Array<Complex, 1>& memory)
        : hologram_(hologram), block_(block), memory_(memory) {
        const std::size_t alignment = hologram.alignment();
        if (alignment <= NarrowBand::tile_height) alignment_ = alignment;
        const std::size_t rows = std::min(block.height, NarrowBand::tile_height + alignment_);
        if (memory.size() < rows * block.width) memory = Array<Complex, 1>({rows * block.width});
    }

    // Returns a tile's first sample, with rows stride() apart. Tiles must be read row by row, or one for each look.
    const Complex* read(const Region& tile, std::size_t look) {
        if (look != look_) end_ = block_.y0;
        look_ = look;
        const std::size_t end = tile.y0 + tile.height;
        if (end_ < end) {
            const std::size_t rows_kept = end_ > tile.y0 ? end_ - tile.y0 : 0;
            if (rows_kept > 0) {
                const Complex* from = memory_.data() + (tile.y0 - first_) * block_.width;
                std::copy_n(from, rows_kept * block_.width, memory_.data());
            }
            first_ = tile.y0;
            const std::size_t from = first_ + rows_kept;
            end_ = std::min((end + alignment_ - 1) / alignment_ * alignment_, block_.y0 + block_.height);
            hologram_.read({block_.x0, from, block_.width, end_ - from}, look,
                           {memory_.data() + rows_kept * block_.width, {end_ - from, block_.width}});
        }
        return memory_.data() + (tile.y0 - first_) * block_.width + (tile.x0 - block_.x0);
    }

    std::size_t stride() const { return block_.width; }

  private:
    const FieldSource& hologram_;
    Region block_;
    Array<Complex, 1>& memory_;
    std::size_t alignment_ = 1;
    std::size_t look_ = SIZE_MAX;
    std::size_t first_ = 0, end_ = 0;  // rows of the hologram in memory
};

}  // namespace

NarrowBand::NarrowBand(const FieldGrid& hologram, Vec3 viewpoint, double pupil)
    : BandGrid{ViewGeometry(viewpoint, hologram.wavelength), {}} {
    const Grid& full = hologram.plane;
    const double needed =
        half_band(hologram, viewpoint, pupil) * (1 + guard) / optics::LowPass::pass;  // samples per metre
    const double pitch = std::max(full.pitch_x, full.pitch_y);
    const double max_factor = 1 / (pitch * needed);
    if (max_factor < 1)
        throw Error(ErrorCode::usage, "pupil, pitch",
                    fmt::format("a pupil of {} at {} takes in more than a hologram with a pitch of {} can hold; "
                                "a pupil of {} or a pitch of {} would do",
                                format_length(pupil), format_length(viewpoint.z), format_length(pitch),
                                format_length(pupil * max_factor), format_length(pitch * max_factor)));
    factor = static_cast<std::size_t>(max_factor);
    const auto decimate = [&](std::size_t samples) { return (samples + factor - 1) / factor + 2 * margin; };
    plane = {decimate(full.width),
             decimate(full.height),
             full.pitch_x * static_cast<double>(factor),
             full.pitch_y * static_cast<double>(factor),
             0,
             0};
    const double step = static_cast<double>(factor);
    if (factor == 1) {
        taps = {1};
    } else {
        const auto count = static_cast<std::size_t>(std::ceil(2 * optics::LowPass::half_width * step));
        taps.resize(count);
        const double first = static_cast<double>(first_tap(margin)) - hologram_index(margin);
        double sum = 0;
        for (std::size_t k = 0; k < count; ++k) {
            taps[k] = static_cast<float>(optics::LowPass::at((first + static_cast<double>(k)) / step));
            sum += taps[k];
        }
        // Normalises the sampled kernel, so that constants are unchanged.
        for (float& tap : taps) tap /= static_cast<float>(sum);
    }
    plane.center_x += full.x(hologram_index(0)) - plane.x(0);
    plane.center_y += full.y(hologram_index(0)) - plane.y(0);
}

double NarrowBand::hologram_index(std::size_t index) const {
    const double step = static_cast<double>(factor);
    return (static_cast<double>(index) - static_cast<double>(margin)) * step + 0.5 * (step - 1);
}

std::ptrdiff_t NarrowBand::first_tap(std::size_t index) const {
    const double middle = hologram_index(index);
    return static_cast<std::ptrdiff_t>(std::ceil(middle - 0.5 * static_cast<double>(taps.size() - 1)));
}

namespace {

std::vector<std::vector<std::size_t>> groups_of(std::span<const NarrowBand> bands, const Grid& plane) {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t index = 0; index < bands.size(); ++index) {
        const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& members) {
            return share_columns(bands[members.front()], bands[index], plane);
        });
        if (group == groups.end())
            groups.push_back({index});
        else
            group->push_back(index);
    }
    return groups;
}

void add(const Contribution& part, std::size_t look, Array<Complex, 2>& band) {
    const std::size_t last_row = std::min(part.rows.end, band.extent(0));
    const std::size_t last_column = std::min(part.columns.end, band.extent(1));
    for (std::size_t m = part.rows.first; m < last_row; ++m)
        for (std::size_t n = part.columns.first; n < last_column; ++n)
            band(m, n) += part.looks[look](m - part.rows.first, n - part.columns.first);
}

}  // namespace

std::vector<std::vector<Array<std::complex<float>, 2>>> compute_narrow_bands(const FieldSource& hologram,
                                                                             std::span<const NarrowBand> narrow_bands,
                                                                             std::size_t first_look, std::size_t looks,
                                                                             const Progress& progress) {
    const Grid& plane = hologram.grid().plane;
    const std::vector<std::vector<std::size_t>> groups = groups_of(narrow_bands, plane);
    std::vector<std::vector<Array<Complex, 2>>> bands(narrow_bands.size());
    for (std::size_t band = 0; is_root_rank() && band < narrow_bands.size(); ++band)
        for (std::size_t look = 0; look < looks; ++look) {
            core::throw_if_stopped();  // many looks are gigabytes, which the system clears
            bands[band].emplace_back(Shape<2>{narrow_bands[band].plane.height, narrow_bands[band].plane.width});
        }

    const std::vector<Region> blocks = blocks_of(hologram);
    // Reused from block to block, because the system clears new memory.
    core::ObjectPool<Array<Complex, 1>> block_memory;
    work::ordered_reduce<Contributions>(
        blocks.size(), work::default_in_flight(), sent_contributions(),
        [&](std::size_t i) {
            const Region& block = blocks[i];
            Contributions contributions;
            for (const auto& group : groups) {
                const NarrowBand& first_band = narrow_bands[group.front()];
                contributions.emplace_back(
                    group.size(),
                    Contribution(sample_range(first_band, first_band.plane.height, block.y0, block.y0 + block.height),
                                 sample_range(first_band, first_band.plane.width, block.x0, block.x0 + block.width),
                                 looks));
            }
            auto memory = block_memory.take();
            BlockReader reader(hologram, block, *memory);
            for (const Region& tile : tiles_of(block)) {
                std::vector<TilePass> passes;
                for (const auto& group : groups) passes.emplace_back(plane, narrow_bands, group, tile);
                for (std::size_t look = 0; look < looks; ++look) {
                    core::throw_if_stopped();
                    const Complex* const samples = reader.read(tile, first_look + look);
                    for (std::size_t g = 0; g < groups.size(); ++g)
                        passes[g].add(samples, reader.stride(), look, contributions[g]);
                }
            }
            return contributions;
        },
        [&](std::size_t i, Contributions& contributions) {
            for (std::size_t g = 0; g < groups.size(); ++g)
                for (std::size_t member = 0; member < groups[g].size(); ++member)
                    for (std::size_t look = 0; look < looks; ++look)
                        add(contributions[g][member], look, bands[groups[g][member]][look]);
            progress.report(static_cast<double>(i + 1) / static_cast<double>(blocks.size()));
        });
    return bands;
}

}  // namespace hogel::camera::narrow_band
