// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/hogel_band_renderer.h"

#include <algorithm>
#include <utility>

namespace hogel::camera::hogel_spectra {
namespace {

using Complex = std::complex<float>;

constexpr std::size_t both = 2 * stereogram::HogelWaves::lanes;  // floats of a complex number of all lanes

// By how much the demodulation's frequency may grow from hogel to hogel, in cycles per hogel, for lanes to share
// weights often enough.
constexpr double max_bend_in_lanes = 0.15;

// The pairs of which a wave is among some, in their order.
void keep_pairs(const auto& is_kept, SlepianBasis::Weights& weights, std::vector<SlepianBasis::SymmetricPair>& kept) {
    kept.clear();
    const std::size_t first_unpaired = weights.pairs.size() - weights.unpaired;
    for (std::size_t i = 0; i < weights.pairs.size(); ++i)
        if (is_kept(weights.pairs[i].first) || is_kept(weights.pairs[i].second))
            kept.push_back(weights.pairs[i]);
        else if (i >= first_unpaired)
            --weights.unpaired;
    weights.pairs = kept;
}

}  // namespace

HogelBandRenderer::HogelBandRenderer(const Hogels& hogels, const HogelRange& range, std::vector<PupilBand> eyes)
    : hogels_(hogels),
      range_(range),
      eyes_(std::move(eyes)),
      middle_(hogels.rows, hogels.columns),
      in_lanes_(hogels.waves->has_lanes()),
      keeps_tiles_(hogels.kept_waves != nullptr && range.ns * hogels.across() == hogels.grid.plane.width &&
                   range.nt * hogels.down() == hogels.grid.plane.height) {
    for (const PupilBand& eye : eyes_) in_lanes_ = in_lanes_ && eye.bend() <= max_bend_in_lanes;
}

void HogelBandRenderer::draw(const HogelPart& part, const Looks& looks, Scratch& scratch) const {
    // Side by side where looks of one hogel fill the lanes.
    scratch.looks = {looks.count, in_lanes_ && 2 * looks.count > lanes ? lanes : 1};
    scratch.light.resize(eyes_.size());
    scratch.phases.resize(eyes_.size());
    for (std::size_t e = 0; e < eyes_.size(); ++e) {
        const PupilBand& eye = eyes_[e];
        const Shape<3> shape{eye.samples(part.nt), 2, scratch.looks.row(eye, part.ns)};
        scratch.light[e].resize(scratch.looks.blocks());
        for (Array<float, 3>& own : scratch.light[e])
            if (own.shape() == shape)
                std::ranges::fill(own.elements(), 0.0f);
            else
                own = Array<float, 3>(shape);
        const Shape<3> samples{eye.samples(part.nt), 2, padded(eye.samples(part.ns))};
        if (scratch.phases[e].shape() != samples) scratch.phases[e] = Array<float, 3>(samples);
        eye.demodulation(part.s * eye.per_hogel(), part.t * eye.per_hogel(), scratch.phases[e]);
    }
    for (std::size_t t = 0; t < part.nt; t += tile_side)
        draw_tiles({range_.s0 + part.s, range_.t0 + part.t + t, part.ns, std::min(tile_side, part.nt - t)}, t, looks,
                   scratch);
}

void HogelBandRenderer::add(const Scratch& scratch, const HogelPart& part,
                            std::span<std::vector<camera::PackedBand>> bands) const {
    for (std::size_t e = 0; e < eyes_.size(); ++e) {
        const Array<float, 3>& phases = scratch.phases[e];
        const std::size_t x = part.s * eyes_[e].per_hogel(), y = part.t * eyes_[e].per_hogel();
        const std::size_t columns = eyes_[e].samples(part.ns), together = scratch.looks.together;
        for (std::size_t first = 0; first < bands[e].size(); first += together) {
            const Array<float, 3>& light = scratch.light[e][first / together];
            const std::size_t count = std::min(together, bands[e].size() - first);
            for (std::size_t row = 0; row < light.extent(0); ++row) {
                const LightRow own{&light(row, 0, 0), light.extent(2), &phases(row, 0, 0), phases.extent(2)};
                math::PackedComplex* to[lanes];
                for (std::size_t look = 0; look < count; ++look) to[look] = bands[e][first + look].at(y + row, x);
                if (together == 1)
                    add_demodulated(own, columns, to[0]);
                else
                    add_demodulated_looks(own, columns, {to, count});
            }
        }
    }
}

// Adds the light of a row of tiles, the row `first` of a part, to that of the part.
void HogelBandRenderer::draw_tiles(const HogelRange& some, std::size_t first, const Looks& looks,
                                   Scratch& scratch) const {
    prepare(some, scratch);
    scratch.views.resize(eyes_.size());
    for (std::size_t e = 0; e < eyes_.size(); ++e) {
        std::vector<HogelView>& views = scratch.views[e];
        views.resize(some.hogels());
        HogelView view;
        for (std::size_t t = 0, h = 0; t < some.nt; ++t)
            for (std::size_t s = 0; s < some.ns; ++s, ++h) {
                eyes_[e].view(hogels_, some.s0 + s, some.t0 + t, view);
                views[h] = view;
            }
    }
    // Lines of many looks are drawn row by row, so that they stay in the cache.
    const std::size_t rows = looks.count == 1 ? some.nt : 1;
    for (std::size_t row = 0; row < some.nt; row += rows) {
        choose_lines(some, row, rows, scratch);
        if (in_lanes_)
            draw_in_lanes(some, row, rows, looks, scratch);
        else
            draw_one_by_one(some, row, rows, looks, scratch);
        for (std::size_t e = 0; e < eyes_.size(); ++e)
            scratch.band_lines[e].spread(eyes_[e].bases().down, first, scratch.light[e]);
    }
}

void HogelBandRenderer::prepare(const HogelRange& some, Scratch& scratch) const {
    scratch.moduli.resize(some.hogels());
    if (hogels_.kept.size() > 0) {
        const std::size_t across = hogels_.grid.plane.width / hogels_.across();
        for (std::size_t h = 0; h < some.hogels(); ++h)
            scratch.moduli[h] = &hogels_.kept((some.t0 + h / some.ns) * across + some.s0 + h % some.ns, 0);
        return;
    }
    Array<float, 2>& prepared = scratch.prepared;
    if (prepared.shape() != Shape<2>{some.hogels(), hogels_.waves->prepared_size()})
        prepared = Array<float, 2>({some.hogels(), hogels_.waves->prepared_size()});
    hogels_.prepare(some, prepared);
    for (std::size_t h = 0; h < some.hogels(); ++h) scratch.moduli[h] = &prepared(h, 0);
}

// The lines of some rows of hogels, from the row `first` on.
void HogelBandRenderer::choose_lines(const HogelRange& some, std::size_t first, std::size_t rows,
                                     Scratch& scratch) const {
    scratch.band_lines.resize(eyes_.size());
    for (std::size_t e = 0; e < eyes_.size(); ++e) {
        BandLines& lines = scratch.band_lines[e];
        lines.begin(eyes_[e], scratch.looks, some.ns);
        for (std::size_t row = first; row < first + rows; ++row)
            for (std::size_t column = 0; column < some.ns; ++column)
                lines.add(row, column, scratch.views[e][row * some.ns + column].rows);
        lines.clear();
    }
}

LineTarget HogelBandRenderer::place(std::size_t e, const HogelRange& some, const Item& item, Scratch& scratch) const {
    return scratch.band_lines[e].place(item.hogel / some.ns, item.hogel % some.ns, item.look);
}

void HogelBandRenderer::draw_one_by_one(const HogelRange& some, std::size_t first_row, std::size_t row_count,
                                        const Looks& looks, Scratch& scratch) const {
    Array<float, 1>& waves = scratch.waves;
    const std::size_t size = stereogram::HogelWaves::size(hogels_.rows, hogels_.columns);
    if (waves.size() != size) waves = Array<float, 1>({size});
    for (std::size_t look = 0; look < looks.count; ++look)
        for (std::size_t h = first_row * some.ns; h < (first_row + row_count) * some.ns; ++h) {
            const stereogram::InBandRows rows = eyes_.size() == 1 ? scratch.views[0][h].near : stereogram::InBandRows{};
            hogels_.waves->waves({scratch.moduli[h], hogels_.waves->prepared_size()},
                                 {some.s0 + h % some.ns, some.t0 + h / some.ns, looks.first + look}, rows,
                                 waves.data());
            middle_.apply(waves.data(), rows);
            for (std::size_t e = 0; e < eyes_.size(); ++e)
                project(eyes_[e].bases(), scratch.views[e][h], waves.data(), place(e, some, {h, look}, scratch));
        }
}

// Batches are parts of tiles of hogels for one look, which may be kept, and parts of rows for several. Either way,
// those of a row are added in their order.
void HogelBandRenderer::draw_in_lanes(const HogelRange& some, std::size_t row, std::size_t rows, const Looks& looks,
                                      Scratch& scratch) const {
    const std::size_t together = std::max<std::size_t>(1, stereogram::HogelWaves::lanes / looks.count);
    std::vector<std::size_t> hogels;
    std::vector<Item> items;
    KeptWaves::Tile kept;
    const auto flush = [&] {
        for (std::size_t look = 0; !hogels.empty() && look < looks.count; look += stereogram::HogelWaves::lanes) {
            items.clear();
            for (const std::size_t hogel : hogels)
                for (std::size_t l = look; l < std::min(look + stereogram::HogelWaves::lanes, looks.count); ++l)
                    items.push_back({hogel, l});
            draw_batch(some, items, looks.first, kept, scratch);
        }
        hogels.clear();
    };
    const std::size_t width = looks.count == 1 ? tile_side : some.ns;
    for (std::size_t s0 = 0; s0 < some.ns; s0 += width) {
        if (keeps_tiles_ && looks.first == 0 && looks.count == 1)
            kept = hogels_.kept_waves->tile(some.s0 + s0, some.t0 + row);
        for (std::size_t t = row; t < row + rows; ++t)
            for (std::size_t s = s0; s < std::min(s0 + width, some.ns); ++s) {
                hogels.push_back(t * some.ns + s);
                if (hogels.size() == together) flush();
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
            group = groups.insert(groups.end(), {view.columns, view.rows, view.near, 0, {}, {}});
            if (view.in_band_columns.count < waves) {
                group->first_column = view.in_band_columns.first;
                keep_pairs([&](std::size_t column) { return view.in_band_columns.has(column, waves); }, group->columns,
                           group->pairs);
            }
        }
        group->chosen[lane] = 1;
    }
    // Lanes that are not used may hold anything.
    if (groups.size() == 1) std::ranges::fill(groups.front().chosen, 1.0f);
}

// @param kept  the waves of these hogels, if they are kept
void HogelBandRenderer::draw_batch(const HogelRange& some, std::span<const Item> items, std::size_t first_look,
                                   const KeptWaves::Tile& kept, Scratch& scratch) const {
    scratch.groups.resize(eyes_.size());
    scratch.lines.resize(eyes_.size());
    for (std::size_t e = 0; e < eyes_.size(); ++e) {
        set_groups(items, scratch.views[e], hogels_.columns, scratch.groups[e]);
        const std::size_t count = scratch.groups[e].size();
        if (scratch.lines[e].size() < count) scratch.lines[e].resize(count);
        for (Array<float, 1>& lines : scratch.lines[e])
            if (const std::size_t size = hogels_.rows * eyes_[e].bases().across.functions() * both;
                lines.size() != size)
                lines = Array<float, 1>({size});
    }
    if (kept.rows != nullptr)
        sum_kept_rows(kept, scratch);
    else
        sum_rows_of_waves(some, items, first_look, scratch);
    for (std::size_t e = 0; e < eyes_.size(); ++e) {
        const SlepianBases bases = eyes_[e].bases();
        if (const std::size_t size = bases.across.functions() * bases.across.functions() * both;
            scratch.numbers.size() < size)
            scratch.numbers = Array<float, 1>({size});
        for (std::size_t g = 0; g < scratch.groups[e].size(); ++g) {
            const Group& group = scratch.groups[e][g];
            sum_rows(bases.across, active_rows(e, g, scratch), kept.scale * group.columns.sign * group.rows.sign,
                     scratch.lines[e][g].data(), group.chosen, scratch.numbers.data());
        }
        if (scratch.looks.together != 1) {
            add_looks(bases.across, scratch.numbers.data(), scratch.views[e][items.front().hogel].columns.carrier,
                      place(e, some, items.front(), scratch));
            continue;
        }
        LaneTarget targets[stereogram::HogelWaves::lanes];
        for (std::size_t lane = 0; lane < items.size(); ++lane) {
            const Item& item = items[lane];
            targets[lane] = {scratch.views[e][item.hogel].columns.carrier, place(e, some, item, scratch)};
        }
        add_lanes(bases.across, scratch.numbers.data(), {targets, items.size()});
    }
}

// Calls sum(basis, group, line) for each line of a row of waves that is near to an eye.
template <class Sum>
void HogelBandRenderer::for_lines(std::size_t row, Scratch& scratch, const Sum& sum) const {
    for (std::size_t e = 0; e < eyes_.size(); ++e)
        for (std::size_t g = 0; g < scratch.groups[e].size(); ++g) {
            const Group& group = scratch.groups[e][g];
            const SlepianBasis& basis = eyes_[e].bases().across;
            if (group.near.has(row, hogels_.rows))
                sum(basis, group, &scratch.lines[e][g](row * basis.functions() * both));
        }
}

void HogelBandRenderer::sum_kept_rows(const KeptWaves::Tile& kept, Scratch& scratch) const {
    const std::size_t size = hogels_.columns * both;
    scratch.active.assign(kept.active, kept.active + hogels_.rows);
    scratch.rows.clear();
    for (std::size_t row = 0; row < hogels_.rows; ++row)
        if (scratch.active[row] && std::ranges::any_of(scratch.groups, [&](const std::vector<Group>& eye) {
                return std::ranges::any_of(eye, [&](const Group& group) { return group.near.has(row, hogels_.rows); });
            }))
            scratch.rows.push_back(row);
    for (std::size_t i = 0; i < scratch.rows.size(); ++i) {
        const std::uint16_t* waves = kept.rows + scratch.rows[i] * size;
        // The row after the next one, of this tile or probably of the next.
        const std::size_t soon = i + 2, count = scratch.rows.size();
        const std::size_t next = soon < count ? scratch.rows[soon] : hogels_.rows + scratch.rows[soon % count];
        for_lines(scratch.rows[i], scratch, [&](const SlepianBasis& basis, const Group& group, float* line) {
            sum_row_of_halves(basis, group.columns, waves, {kept.rows + next * size, group.first_column}, line);
        });
    }
}

void HogelBandRenderer::sum_rows_of_waves(const HogelRange& some, std::span<const Item> items, std::size_t first_look,
                                          Scratch& scratch) const {
    const std::size_t n = hogels_.columns;
    const bool shared = items.front().hogel == items.back().hogel;
    const float* prepared = scratch.moduli[items.front().hogel];
    if (!shared) {
        scratch.sources.clear();
        for (const Item& item : items) scratch.sources.push_back(scratch.moduli[item.hogel]);
        const std::size_t size = stereogram::HogelWaves::powers_size(n) * stereogram::HogelWaves::lanes;
        if (scratch.gathered.size() != size) scratch.gathered = Array<float, 1>({size});
        prepared = scratch.gathered.data();
    }
    scratch.places.clear();
    for (const Item& item : items)
        scratch.places.push_back(
            {some.s0 + item.hogel % some.ns, some.t0 + item.hogel / some.ns, first_look + item.look});
    const stereogram::SeriesOfLanes series = hogels_.waves->series_of_lanes(scratch.places);
    if (scratch.waves.size() != n * both) scratch.waves = Array<float, 1>({n * both});
    scratch.active.resize(hogels_.rows);
    std::size_t gathered = 0;  // rows
    for (std::size_t row = 0; row < hogels_.rows; ++row) {
        scratch.active[row] = hogels_.waves->has_light(row);
        bool made = false;
        for_lines(row, scratch, [&](const SlepianBasis& basis, const Group& group, float* line) {
            if (!scratch.active[row]) return;
            if (!made && !shared && row >= gathered) {
                const std::size_t block = row / stereogram::HogelWaves::block_rows * stereogram::HogelWaves::block_rows;
                hogels_.waves->gather_lanes(scratch.sources, block, scratch.gathered.data());
                gathered = block + stereogram::HogelWaves::block_rows;
            }
            if (!made) hogels_.waves->row_of_lanes(series, row, shared, prepared, scratch.waves.data());
            made = true;
            sum_row(basis, group.columns, scratch.waves.data(), line);
        });
    }
}

// The weights of the rows that are lit and near to an eye. The dark one of a pair counts as zero.
SlepianBasis::Weights HogelBandRenderer::active_rows(std::size_t e, std::size_t g, Scratch& scratch) const {
    const Group& group = scratch.groups[e][g];
    SlepianBasis::Weights weights = group.rows;
    const std::size_t size = eyes_[e].bases().across.functions() * both;
    const auto is_active = [&](std::size_t row) { return scratch.active[row] && group.near.has(row, hogels_.rows); };
    for (const SlepianBasis::SymmetricPair& pair : group.rows.pairs)
        if (const bool one = is_active(pair.first); one != is_active(pair.second))
            std::fill_n(&scratch.lines[e][g]((one ? pair.second : pair.first) * size), size, 0.0f);
    keep_pairs(is_active, weights, scratch.pairs);
    return weights;
}

}  // namespace hogel::camera::hogel_spectra
