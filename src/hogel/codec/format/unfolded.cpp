// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/unfolded.h"

#include <algorithm>
#include <cmath>

#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel::codec::format {
namespace {

const LightFieldGrid& face_of(std::span<const LightFieldGrid> faces, Face face) {
    const auto found = std::ranges::find(faces, face, &LightFieldGrid::face);
    if (found == faces.end())
        throw Error(ErrorCode::usage, "hemicube",
                    "only a hemicube of five faces can be unfolded; expected the layout faces");
    return *found;
}

// Returns the weight of a band at its sample k: a cubic from 1 at its beginning to 0 at its end.
double fade(std::size_t k, std::size_t band) {
    if (k >= band) return 0;
    const double x = (static_cast<double>(k) + 0.5) / static_cast<double>(band);
    return 1 - x * x * (3 - 2 * x);
}

// Returns the index among n samples that corresponds to index k among m.
std::size_t scaled(std::size_t k, std::size_t m, std::size_t n) { return (2 * k + 1) * n / (2 * m); }

// A side of the front along one axis; samples are counted outwards and inwards from the front's edge.
struct Side {
    std::size_t begin, end;  // range of the front
    bool before;             // whether the side has smaller indices than the front
    std::size_t length;      // number of samples outside the front

    std::size_t outwards(std::size_t k) const { return before ? begin - 1 - k : end + k; }
    std::size_t inwards(std::size_t k) const { return before ? begin + k : end - 1 - k; }
    std::size_t inner() const { return end - begin; }
};

void fill_corner(View<float, 2> array, const Side& across, const Side& down) {
    if (across.length == 0 || down.length == 0) return;
    double sum = 0;
    const std::size_t half_u = (across.inner() + 1) / 2, half_v = (down.inner() + 1) / 2;
    for (std::size_t b = 0; b < half_v; ++b) {
        for (std::size_t a = 0; a < half_u; ++a) sum += array(down.inwards(b), across.inwards(a));
        for (std::size_t a = 0; a < across.length; ++a) sum += array(down.inwards(b), across.outwards(a));
    }
    for (std::size_t b = 0; b < down.length; ++b)
        for (std::size_t a = 0; a < half_u; ++a) sum += array(down.outwards(b), across.inwards(a));
    const double mean = sum / static_cast<double>(half_v * (half_u + across.length) + down.length * half_u);
    const std::size_t band_u = std::min({Unfolding::band, across.length, across.inner()});
    const std::size_t band_v = std::min({Unfolding::band, down.length, down.inner()});
    for (std::size_t b = 0; b < down.length; ++b)
        for (std::size_t a = 0; a < across.length; ++a) {
            const double of_side = fade(a, band_u), of_end = fade(b, band_v);
            float& sample = array(down.outwards(b), across.outwards(a));
            sample = static_cast<float>(mean);
            if (of_side + of_end == 0) continue;
            // Around the cube's edge the left and right sides continue into the top and bottom, and the reverse.
            double bands = 0;
            if (of_side > 0)
                bands += of_side * array(down.inwards(std::min(scaled(a, across.inner(), down.inner()), half_v - 1)),
                                         across.outwards(scaled(b, down.length, across.length)));
            if (of_end > 0)
                bands += of_end * array(down.outwards(scaled(a, across.length, down.length)),
                                        across.inwards(std::min(scaled(b, down.inner(), across.inner()), half_u - 1)));
            bands /= of_side + of_end;
            sample = static_cast<float>(mean + (1 - (1 - of_side) * (1 - of_end)) * (bands - mean));
        }
}

class UnfoldedSource final : public LightFieldSource {
  public:
    explicit UnfoldedSource(const LightField& light_field)
        : light_field_(light_field), unfolding_(light_field.grids()) {}

    const LightFieldGrid& grid() const override { return unfolding_.grid(); }
    HogelRange preferred_tile() const override { return light_field_.front().preferred_tile(); }

    void read(LightFieldTile& tile) const override {
        validate(tile, grid());
        const HogelRange& range = tile.range;
        for (const LightField::Source& face : light_field_.faces()) {
            LightFieldTile part(face->grid(), range, false);
            face->read(part);
            const auto [u, v] = unfolding_.origin(face->grid().face());
            for (std::size_t c = 0; c < part.radiance.extent(0); ++c)
                for (std::size_t t = 0; t < range.nt; ++t)
                    for (std::size_t s = 0; s < range.ns; ++s)
                        for (std::size_t row = 0; row < part.radiance.extent(3); ++row)
                            std::copy_n(&part.radiance(c, t, s, row, 0), part.radiance.extent(4),
                                        &tile.radiance(c, t, s, v + row, u));
        }
        const std::size_t hogels = range.hogels(), channels = tile.radiance.extent(0);
        work::parallel_for(hogels * channels, [&](std::size_t k) {
            const std::size_t hogel = k % hogels;
            unfolding_.fill_corners(tile.radiance[k / hogels][hogel / range.ns][hogel % range.ns]);
        });
    }

  private:
    LightField light_field_;
    Unfolding unfolding_;
};

}  // namespace

Unfolding::Unfolding(std::span<const LightFieldGrid> faces) {
    const LightFieldGrid &front = face_of(faces, Face::front), &left = face_of(faces, Face::left),
                         &right = face_of(faces, Face::right), &top = face_of(faces, Face::top),
                         &bottom = face_of(faces, Face::bottom);
    for (const LightFieldGrid* side : {&left, &right, &top, &bottom})
        if (const bool beside = side == &left || side == &right;
            faces.size() != all_faces.size() || !same_hogels(*side, front) ||
            (beside ? side->directions_v != front.directions_v : side->directions_u != front.directions_u))
            throw Error(ErrorCode::usage, "hemicube",
                        "only a hemicube whose sides are as long as the edges of its front can be unfolded; expected "
                        "the layout faces");
    cross_ = {left.directions_u, left.directions_u + front.directions_u, top.directions_v,
              top.directions_v + front.directions_v};
    grid_ = front;
    grid_.directions_u = cross_.end_u + right.directions_u;
    grid_.directions_v = cross_.end_v + bottom.directions_v;
    grid_.range().half_u = front.step_u() * static_cast<double>(grid_.directions_u) / 2;
    grid_.range().half_v = front.step_v() * static_cast<double>(grid_.directions_v) / 2;
    validate(grid_, ErrorCode::usage, "unfolded hemicube");
}

Unfolding::Origin Unfolding::origin(Face face) const {
    switch (face) {
        case Face::left:
            return {0, cross_.begin_v};
        case Face::right:
            return {cross_.end_u, cross_.begin_v};
        case Face::top:
            return {cross_.begin_u, 0};
        case Face::bottom:
            return {cross_.begin_u, cross_.end_v};
        case Face::front:
            break;
    }
    return {cross_.begin_u, cross_.begin_v};
}

void Unfolding::fill_corners(View<float, 2> array) const {
    for (const bool left : {true, false})
        for (const bool top : {true, false})
            fill_corner(array,
                        {cross_.begin_u, cross_.end_u, left, left ? cross_.begin_u : grid_.directions_u - cross_.end_u},
                        {cross_.begin_v, cross_.end_v, top, top ? cross_.begin_v : grid_.directions_v - cross_.end_v});
}

double squared_error(const LightFieldTile& truth, const LightFieldTile& decoded, const DirectionCross& counted) {
    const std::size_t width = truth.radiance.extent(4), height = truth.radiance.extent(3);
    double sum = 0;
    for (std::size_t row = 0; row < truth.radiance.size() / width; ++row) {
        const auto [begin, end] = counted.columns(row % height, width);
        for (std::size_t i = row * width + begin; i < row * width + end; ++i) {
            const double error = static_cast<double>(truth.radiance.data()[i]) - decoded.radiance.data()[i];
            if (std::isfinite(error)) sum += error * error;
        }
    }
    return sum;
}

LightField::Source unfold(const LightField& light_field) { return std::make_shared<UnfoldedSource>(light_field); }

}  // namespace hogel::codec::format
