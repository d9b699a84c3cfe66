// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/hogel_band_renderer.h"

#include <algorithm>
#include <utility>

namespace hogel::camera::hogel_spectra {
namespace {

using Complex = std::complex<float>;

constexpr std::size_t complex_size = 2 * stereogram::HogelWaves::lanes;  // floats of a complex number of all lanes

// Maximum increase of the demodulation's frequency, in cycles per hogel, for which enough lanes share weights.
constexpr double max_bend_in_lanes = 0.15;

// Keeps the pairs that contain at least one selected wave, in order.
void filter_pairs(const auto& is_kept, SlepianBasis::Weights& weights,
                  std::vector<SlepianBasis::SymmetricPair>& filtered) {
    filtered.clear();
    const std::size_t first_unpaired = weights.pairs.size() - weights.unpaired;
    for (std::size_t i = 0; i < weights.pairs.size(); ++i)
        if (is_kept(weights.pairs[i].first) || is_kept(weights.pairs[i].second))
            filtered.push_back(weights.pairs[i]);
        else if (i >= first_unpaired)
            --weights.unpaired;
    weights.pairs = filtered;
}

}  // namespace

HogelBandRenderer::HogelBandRenderer(const Hogels& hogels, const HogelRange& range, std::vector<PupilBand> bands)
    : hogels_(hogels),
      range_(range),
      bands_(std::move(bands)),
      middle_phases_(hogels.rows, hogels.columns),
      uses_lanes_(hogels.waves->has_lanes()),
      matches_cache_(hogels.wave_cache != nullptr && range.ns * hogels.across() == hogels.grid.plane.width &&
                     range.nt * hogels.down() == hogels.grid.plane.height) {
    for (const PupilBand& band : bands_) uses_lanes_ = uses_lanes_ && band.bend() <= max_bend_in_lanes;
}

void HogelBandRenderer::render(const HogelChunk& chunk, const Looks& looks, Scratch& scratch) const {
    // Looks are interleaved if those of one hogel fill the lanes.
    scratch.looks = {looks.count, uses_lanes_ && 2 * looks.count > lanes ? lanes : 1};
    scratch.light.resize(bands_.size());
    scratch.phases.resize(bands_.size());
    for (std::size_t e = 0; e < bands_.size(); ++e) {
        const PupilBand& band = bands_[e];
        const Shape<3> shape{band.samples(chunk.nt), 2, scratch.looks.row_size(band, chunk.ns)};
        scratch.light[e].resize(scratch.looks.blocks());
        for (Array<float, 3>& block : scratch.light[e])
            if (block.shape() == shape)
                std::ranges::fill(block.elements(), 0.0f);
            else
                block = Array<float, 3>(shape);
        const Shape<3> samples{band.samples(chunk.nt), 2, padded(band.samples(chunk.ns))};
        if (scratch.phases[e].shape() != samples) scratch.phases[e] = Array<float, 3>(samples);
        band.demodulation(chunk.s * band.per_hogel(), chunk.t * band.per_hogel(), scratch.phases[e]);
    }
    for (std::size_t t = 0; t < chunk.nt; t += tile_side)
        render_tiles({range_.s0 + chunk.s, range_.t0 + chunk.t + t, chunk.ns, std::min(tile_side, chunk.nt - t)}, t,
                     looks, scratch);
}

void HogelBandRenderer::add(const Scratch& scratch, const HogelChunk& chunk,
                            std::span<std::vector<camera::PackedBand>> packed_bands) const {
    for (std::size_t e = 0; e < bands_.size(); ++e) {
        const Array<float, 3>& phases = scratch.phases[e];
        const std::size_t x = chunk.s * bands_[e].per_hogel(), y = chunk.t * bands_[e].per_hogel();
        const std::size_t columns = bands_[e].samples(chunk.ns), looks_per_block = scratch.looks.looks_per_block;
        for (std::size_t first = 0; first < packed_bands[e].size(); first += looks_per_block) {
            const Array<float, 3>& light = scratch.light[e][first / looks_per_block];
            const std::size_t count = std::min(looks_per_block, packed_bands[e].size() - first);
            for (std::size_t row = 0; row < light.extent(0); ++row) {
                const LightRow source{&light(row, 0, 0), light.extent(2), &phases(row, 0, 0), phases.extent(2)};
                math::PackedComplex* destinations[lanes];
                for (std::size_t look = 0; look < count; ++look)
                    destinations[look] = packed_bands[e][first + look].at(y + row, x);
                if (looks_per_block == 1)
                    add_demodulated(source, columns, destinations[0]);
                else
                    add_demodulated_looks(source, columns, {destinations, count});
            }
        }
    }
}

// Adds the light of a row of tiles to the light of the chunk.
// @param first  first row of hogels, in the chunk
void HogelBandRenderer::render_tiles(const HogelRange& tiles, std::size_t first, const Looks& looks,
                                     Scratch& scratch) const {
    prepare(tiles, scratch);
    scratch.views.resize(bands_.size());
    for (std::size_t e = 0; e < bands_.size(); ++e) {
        std::vector<HogelView>& views = scratch.views[e];
        views.resize(tiles.hogels());
        HogelView view;
        for (std::size_t t = 0, h = 0; t < tiles.nt; ++t)
            for (std::size_t s = 0; s < tiles.ns; ++s, ++h) {
                bands_[e].view(hogels_, tiles.s0 + s, tiles.t0 + t, view);
                views[h] = view;
            }
    }
    // Renders row by row, so that the lines of all looks stay in the cache.
    const std::size_t rows = looks.count == 1 ? tiles.nt : 1;
    for (std::size_t row = 0; row < tiles.nt; row += rows) {
        assign_lines(tiles, row, rows, scratch);
        if (uses_lanes_)
            render_in_lanes(tiles, row, rows, looks, scratch);
        else
            render_single_hogels(tiles, row, rows, looks, scratch);
        for (std::size_t e = 0; e < bands_.size(); ++e)
            scratch.band_lines[e].spread(bands_[e].bases().down, first, scratch.light[e]);
    }
}

void HogelBandRenderer::prepare(const HogelRange& tiles, Scratch& scratch) const {
    scratch.moduli.resize(tiles.hogels());
    if (hogels_.kept.size() > 0) {
        const std::size_t across = hogels_.grid.plane.width / hogels_.across();
        for (std::size_t h = 0; h < tiles.hogels(); ++h)
            scratch.moduli[h] = &hogels_.kept((tiles.t0 + h / tiles.ns) * across + tiles.s0 + h % tiles.ns, 0);
        return;
    }
    Array<float, 2>& prepared = scratch.prepared;
    if (prepared.shape() != Shape<2>{tiles.hogels(), hogels_.waves->prepared_size()})
        prepared = Array<float, 2>({tiles.hogels(), hogels_.waves->prepared_size()});
    hogels_.prepare(tiles, prepared);
    for (std::size_t h = 0; h < tiles.hogels(); ++h) scratch.moduli[h] = &prepared(h, 0);
}

void HogelBandRenderer::assign_lines(const HogelRange& tiles, std::size_t first, std::size_t rows,
                                     Scratch& scratch) const {
    scratch.band_lines.resize(bands_.size());
    for (std::size_t e = 0; e < bands_.size(); ++e) {
        BandLines& lines = scratch.band_lines[e];
        lines.reset(bands_[e], scratch.looks, tiles.ns);
        for (std::size_t row = first; row < first + rows; ++row)
            for (std::size_t column = 0; column < tiles.ns; ++column)
                lines.add(row, column, scratch.views[e][row * tiles.ns + column].rows);
        lines.clear();
    }
}

LineTarget HogelBandRenderer::target(std::size_t e, const HogelRange& tiles, const Item& item, Scratch& scratch) const {
    return scratch.band_lines[e].target(item.hogel / tiles.ns, item.hogel % tiles.ns, item.look);
}

void HogelBandRenderer::render_single_hogels(const HogelRange& tiles, std::size_t first_row, std::size_t row_count,
                                             const Looks& looks, Scratch& scratch) const {
    Array<float, 1>& waves = scratch.waves;
    const std::size_t size = stereogram::HogelWaves::size(hogels_.rows, hogels_.columns);
    if (waves.size() != size) waves = Array<float, 1>({size});
    for (std::size_t look = 0; look < looks.count; ++look)
        for (std::size_t h = first_row * tiles.ns; h < (first_row + row_count) * tiles.ns; ++h) {
            const stereogram::InBandRows rows =
                bands_.size() == 1 ? scratch.views[0][h].in_band_rows : stereogram::InBandRows{};
            hogels_.waves->waves({scratch.moduli[h], hogels_.waves->prepared_size()},
                                 {tiles.s0 + h % tiles.ns, tiles.t0 + h / tiles.ns, looks.first + look}, rows,
                                 waves.data());
            middle_phases_.apply(waves.data(), rows);
            for (std::size_t e = 0; e < bands_.size(); ++e)
                project(bands_[e].bases(), scratch.views[e][h], waves.data(), target(e, tiles, {h, look}, scratch));
        }
}

// A batch is a part of a tile for one look, which may be cached, or a part of a row for several looks. Either way the
// hogels of a row are added in order.
void HogelBandRenderer::render_in_lanes(const HogelRange& tiles, std::size_t row, std::size_t rows, const Looks& looks,
                                        Scratch& scratch) const {
    const std::size_t hogels_per_batch = std::max<std::size_t>(1, stereogram::HogelWaves::lanes / looks.count);
    std::vector<std::size_t> hogels;
    std::vector<Item> items;
    WaveCache::Tile cached;
    const auto flush = [&] {
        for (std::size_t look = 0; !hogels.empty() && look < looks.count; look += stereogram::HogelWaves::lanes) {
            items.clear();
            for (const std::size_t hogel : hogels)
                for (std::size_t l = look; l < std::min(look + stereogram::HogelWaves::lanes, looks.count); ++l)
                    items.push_back({hogel, l});
            render_batch(tiles, items, looks.first, cached, scratch);
        }
        hogels.clear();
    };
    const std::size_t width = looks.count == 1 ? tile_side : tiles.ns;
    for (std::size_t s0 = 0; s0 < tiles.ns; s0 += width) {
        if (matches_cache_ && looks.first == 0 && looks.count == 1)
            cached = hogels_.wave_cache->tile(tiles.s0 + s0, tiles.t0 + row);
        for (std::size_t t = row; t < row + rows; ++t)
            for (std::size_t s = s0; s < std::min(s0 + width, tiles.ns); ++s) {
                hogels.push_back(t * tiles.ns + s);
                if (hogels.size() == hogels_per_batch) flush();
            }
        flush();
    }
}

void HogelBandRenderer::set_groups(std::span<const Item> items, const std::vector<HogelView>& views, std::size_t waves,
                                   std::vector<Group>& groups) {
    groups.clear();
    for (std::size_t lane = 0; lane < items.size(); ++lane) {
        const HogelView& view = views[items[lane].hogel];
        auto group = std::ranges::find_if(groups, [&](const Group& other) {
            return other.columns.frequency == view.columns.frequency && other.rows.frequency == view.rows.frequency;
        });
        if (group == groups.end()) {
            group = groups.insert(groups.end(), {view.columns, view.rows, view.in_band_rows, 0, {}, {}});
            if (view.in_band_columns.count < waves) {
                group->first_column = view.in_band_columns.first;
                filter_pairs([&](std::size_t column) { return view.in_band_columns.has(column, waves); },
                             group->columns, group->pairs);
            }
        }
        group->mask[lane] = 1;
    }
    // Unused lanes may hold any value.
    if (groups.size() == 1) std::ranges::fill(groups.front().mask, 1.0f);
}

// @param cached  the waves of these hogels; null rows if they are not cached
void HogelBandRenderer::render_batch(const HogelRange& tiles, std::span<const Item> items, std::size_t first_look,
                                     const WaveCache::Tile& cached, Scratch& scratch) const {
    scratch.groups.resize(bands_.size());
    scratch.lines.resize(bands_.size());
    for (std::size_t e = 0; e < bands_.size(); ++e) {
        set_groups(items, scratch.views[e], hogels_.columns, scratch.groups[e]);
        const std::size_t count = scratch.groups[e].size();
        if (scratch.lines[e].size() < count) scratch.lines[e].resize(count);
        for (Array<float, 1>& lines : scratch.lines[e])
            if (const std::size_t size = hogels_.rows * bands_[e].bases().across.functions() * complex_size;
                lines.size() != size)
                lines = Array<float, 1>({size});
    }
    if (cached.rows != nullptr)
        sum_cached_rows(cached, scratch);
    else
        sum_rows_of_waves(tiles, items, first_look, scratch);
    for (std::size_t e = 0; e < bands_.size(); ++e) {
        const SlepianBases bases = bands_[e].bases();
        if (const std::size_t size = bases.across.functions() * bases.across.functions() * complex_size;
            scratch.numbers.size() < size)
            scratch.numbers = Array<float, 1>({size});
        for (std::size_t g = 0; g < scratch.groups[e].size(); ++g) {
            const Group& group = scratch.groups[e][g];
            sum_rows(bases.across, active_rows(e, g, scratch), cached.scale * group.columns.sign * group.rows.sign,
                     scratch.lines[e][g].data(), group.mask, scratch.numbers.data());
        }
        if (scratch.looks.looks_per_block != 1) {
            add_looks(bases.across, scratch.numbers.data(), scratch.views[e][items.front().hogel].columns.carrier,
                      target(e, tiles, items.front(), scratch));
            continue;
        }
        LaneTarget targets[stereogram::HogelWaves::lanes];
        for (std::size_t lane = 0; lane < items.size(); ++lane) {
            const Item& item = items[lane];
            targets[lane] = {scratch.views[e][item.hogel].columns.carrier, target(e, tiles, item, scratch)};
        }
        add_lanes(bases.across, scratch.numbers.data(), {targets, items.size()});
    }
}

// Calls sum(basis, group, line) for each group with the in-band row `row` of waves.
template <class Sum>
void HogelBandRenderer::for_each_line(std::size_t row, Scratch& scratch, const Sum& sum) const {
    for (std::size_t e = 0; e < bands_.size(); ++e)
        for (std::size_t g = 0; g < scratch.groups[e].size(); ++g) {
            const Group& group = scratch.groups[e][g];
            const SlepianBasis& basis = bands_[e].bases().across;
            if (group.in_band_rows.has(row, hogels_.rows))
                sum(basis, group, &scratch.lines[e][g](row * basis.functions() * complex_size));
        }
}

void HogelBandRenderer::sum_cached_rows(const WaveCache::Tile& cached, Scratch& scratch) const {
    const std::size_t size = hogels_.columns * complex_size;
    scratch.active.assign(cached.active, cached.active + hogels_.rows);
    scratch.rows.clear();
    for (std::size_t row = 0; row < hogels_.rows; ++row)
        if (scratch.active[row] && std::ranges::any_of(scratch.groups, [&](const std::vector<Group>& groups) {
                return std::ranges::any_of(
                    groups, [&](const Group& group) { return group.in_band_rows.has(row, hogels_.rows); });
            }))
            scratch.rows.push_back(row);
    for (std::size_t i = 0; i < scratch.rows.size(); ++i) {
        const std::uint16_t* waves = cached.rows + scratch.rows[i] * size;
        // Prefetches the row after the next one, of this tile or probably of the next tile.
        const std::size_t prefetched = i + 2, count = scratch.rows.size();
        const std::size_t next =
            prefetched < count ? scratch.rows[prefetched] : hogels_.rows + scratch.rows[prefetched % count];
        for_each_line(scratch.rows[i], scratch, [&](const SlepianBasis& basis, const Group& group, float* line) {
            sum_row_of_halves(basis, group.columns, waves, {cached.rows + next * size, group.first_column}, line);
        });
    }
}

void HogelBandRenderer::sum_rows_of_waves(const HogelRange& tiles, std::span<const Item> items, std::size_t first_look,
                                          Scratch& scratch) const {
    const std::size_t n = hogels_.columns;
    const bool same_hogel = items.front().hogel == items.back().hogel;
    const float* prepared = scratch.moduli[items.front().hogel];
    if (!same_hogel) {
        scratch.sources.clear();
        for (const Item& item : items) scratch.sources.push_back(scratch.moduli[item.hogel]);
        const std::size_t size = stereogram::HogelWaves::powers_size(n) * stereogram::HogelWaves::lanes;
        if (scratch.gathered.size() != size) scratch.gathered = Array<float, 1>({size});
        prepared = scratch.gathered.data();
    }
    scratch.keys.clear();
    for (const Item& item : items)
        scratch.keys.push_back(
            {tiles.s0 + item.hogel % tiles.ns, tiles.t0 + item.hogel / tiles.ns, first_look + item.look});
    const stereogram::SeriesOfLanes series = hogels_.waves->series_of_lanes(scratch.keys);
    if (scratch.waves.size() != n * complex_size) scratch.waves = Array<float, 1>({n * complex_size});
    scratch.active.resize(hogels_.rows);
    std::size_t gathered_rows = 0;  // number of rows
    for (std::size_t row = 0; row < hogels_.rows; ++row) {
        scratch.active[row] = hogels_.waves->has_light(row);
        bool computed = false;
        for_each_line(row, scratch, [&](const SlepianBasis& basis, const Group& group, float* line) {
            if (!scratch.active[row]) return;
            if (!computed && !same_hogel && row >= gathered_rows) {
                const std::size_t block = row / stereogram::HogelWaves::block_rows * stereogram::HogelWaves::block_rows;
                hogels_.waves->gather_lanes(scratch.sources, block, scratch.gathered.data());
                gathered_rows = block + stereogram::HogelWaves::block_rows;
            }
            if (!computed) hogels_.waves->row_of_lanes(series, row, same_hogel, prepared, scratch.waves.data());
            computed = true;
            sum_row(basis, group.columns, scratch.waves.data(), line);
        });
    }
}

// Returns the weights of the rows that are active and in band. It zeroes the inactive row of a pair.
SlepianBasis::Weights HogelBandRenderer::active_rows(std::size_t e, std::size_t g, Scratch& scratch) const {
    const Group& group = scratch.groups[e][g];
    SlepianBasis::Weights weights = group.rows;
    const std::size_t size = bands_[e].bases().across.functions() * complex_size;
    const auto is_active = [&](std::size_t row) {
        return scratch.active[row] && group.in_band_rows.has(row, hogels_.rows);
    };
    for (const SlepianBasis::SymmetricPair& pair : group.rows.pairs)
        if (const bool first_active = is_active(pair.first); first_active != is_active(pair.second))
            std::fill_n(&scratch.lines[e][g]((first_active ? pair.second : pair.first) * size), size, 0.0f);
    filter_pairs(is_active, weights, scratch.pairs);
    return weights;
}

}  // namespace hogel::camera::hogel_spectra
