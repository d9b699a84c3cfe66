// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram/eye/stereogram_eyes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "hogel/core/object_pool.h"
#include "hogel/core/shared_order.h"
#include "hogel/hologram/eye/hogel_basis.h"
#include "hogel/hologram/eye/project.h"
#include "hogel/optics/film/interpolation.h"
#include "hogel/optics/phase_walk.h"

namespace hogel::hologram::eye {
namespace {

using Complex = std::complex<float>;

// A fraction by which a pupil's band is widened, because its width varies slightly over the hologram.
constexpr double guard = 0.1;

// Hogels whose contributions are made together.
constexpr std::size_t block_across = 32, block_down = 4;

// Bands of frequencies, in cycles per hogel, where the hologram is nearest to the eye.
struct Bands {
    double pupil;  ///< half the width of the pupil's light
    double bend;   ///< by how much the demodulation's frequency grows over a hogel

    // Half the width of the light that `per_hogel` samples to a hogel hold: the demodulation is that at the nodes, some
    // of which are beyond the hogel's ends.
    double held(std::size_t per_hogel) const {
        const double reach = 0.5 + 3 / static_cast<double>(per_hogel);
        return pupil * (1 + guard) + bend * reach + 0.5 / static_cast<double>(HogelBasis::fractions);
    }
    // Enough for the film's interpolation to pass the pupil's light, and for samples to hold a hogel's.
    std::size_t per_hogel() const {
        std::size_t count = 1;
        while (static_cast<double>(count) <
               std::max(pupil * (1 + guard) / optics::film::InterpolationTable::pass, 2.5 * held(count)))
            ++count;
        return count;
    }
};

Bands bands_of(const FieldGrid& part, std::size_t samples, const optics::Eye& eye) {
    const Grid& plane = part.plane;
    const double x =
        std::clamp(eye.position.x, plane.center_x - plane.size_x() / 2, plane.center_x + plane.size_x() / 2);
    const double y =
        std::clamp(eye.position.y, plane.center_y - plane.size_y() / 2, plane.center_y + plane.size_y() / 2);
    const double path = part.wavelength * optics::ViewGeometry(eye.position, part.wavelength).distance(x, y);
    const double side = plane.pitch_x * static_cast<double>(samples);
    return {0.5 * eye.pupil * side / path, side * side / path};
}

// One eye's band.
struct EyeBand {
    optics::narrow_band::BandGrid grid;
    std::shared_ptr<const HogelBasis> basis;
    std::size_t per_hogel;
};

using Contribution = std::vector<std::vector<Array<float, 3>>>;  // [eye][look][part][row][column]

core::Sent<Contribution> sent_contribution() {
    return {[](core::MessageWriter& to, const Contribution& eyes) {
                to.put(eyes.size());
                for (const auto& looks : eyes) {
                    to.put(looks.size());
                    for (const auto& look : looks) to.put(look);
                }
            },
            [](core::MessageReader& from) {
                Contribution eyes(from.get<std::size_t>());
                for (auto& looks : eyes) {
                    looks.resize(from.get<std::size_t>());
                    for (auto& look : looks) look = from.get_array<float, 3>();
                }
                return eyes;
            }};
}

class StereogramEyes final : public optics::EyeDrawing {
  public:
    StereogramEyes(const Hogels& hogels, const HogelRange& range, std::vector<EyeBand> eyes)
        : hogels_(hogels), range_(range), eyes_(std::move(eyes)), middle_(hogels.samples) {}

    const optics::narrow_band::BandGrid& band(std::size_t eye) const override { return eyes_[eye].grid; }

    std::vector<std::vector<Array<Complex, 2>>> draw(std::size_t first_look, std::size_t looks,
                                                     const Progress& progress) const override {
        std::vector<std::vector<Array<Complex, 2>>> bands(eyes_.size());
        for (std::size_t e = 0; e < eyes_.size(); ++e)
            for (std::size_t look = 0; look < looks; ++look) {
                core::throw_if_stopped();  // many looks are gigabytes, which the system clears
                bands[e].emplace_back(Shape<2>{eyes_[e].grid.plane.height, eyes_[e].grid.plane.width});
            }
        const std::size_t across = (range_.ns + block_across - 1) / block_across,
                          down = (range_.nt + block_down - 1) / block_down;
        const auto block = [&](std::size_t i) {
            const std::size_t s = i % across * block_across, t = i / across * block_down;
            return HogelRange{range_.s0 + s, range_.t0 + t, std::min(block_across, range_.ns - s),
                              std::min(block_down, range_.nt - t)};
        };
        core::shared_ordered<Contribution>(
            across * down, core::default_in_flight(), sent_contribution(),
            [&](std::size_t i) { return draw(block(i), first_look, looks); },
            [&](std::size_t i, Contribution& contribution) {
                const HogelRange hogels = block(i);
                for (std::size_t e = 0; e < eyes_.size(); ++e)
                    for (std::size_t look = 0; look < looks; ++look)
                        add(contribution[e][look], (hogels.t0 - range_.t0) * eyes_[e].per_hogel,
                            (hogels.s0 - range_.s0) * eyes_[e].per_hogel, bands[e][look]);
                progress.report(static_cast<double>(i + 1) / static_cast<double>(across * down));
            });
        return bands;
    }

  private:
    // Columns beyond the band are padding.
    static void add(View<const float, 3> part, std::size_t row, std::size_t column, View<Complex, 2> band) {
        const std::size_t width = std::min(part.extent(2), band.extent(1) - column);
        for (std::size_t y = 0; y < part.extent(1); ++y)
            for (std::size_t x = 0; x < width; ++x) band(row + y, column + x) += Complex(part(0, y, x), part(1, y, x));
    }

    // The contribution of some hogels to all bands.
    std::vector<std::vector<Array<float, 3>>> draw(const HogelRange& some, std::size_t first_look,
                                                   std::size_t looks) const {
        auto scratch = scratch_pool_.take();
        Array<float, 2>& prepared = scratch->prepared;
        if (prepared.shape() != Shape<2>{some.hogels(), hogels_.prepared_size})
            prepared = Array<float, 2>({some.hogels(), hogels_.prepared_size});
        hogels_.prepare(some, prepared);
        std::vector<std::vector<Array<float, 3>>> contribution(eyes_.size());
        std::vector<std::vector<HogelView>> views(eyes_.size());  // [eye][hogel]
        std::vector<Array<float, 4>>& phases = scratch->phases;
        phases.resize(eyes_.size());
        for (std::size_t e = 0; e < eyes_.size(); ++e) {
            const EyeBand& eye = eyes_[e];
            const std::size_t nodes = eye.basis->nodes(), around = 2 * eye.basis->before();
            for (std::size_t look = 0; look < looks; ++look)
                contribution[e].emplace_back(
                    Shape<3>{2, some.nt * eye.per_hogel + around, (some.ns - 1) * eye.per_hogel + padded(nodes)});
            const Shape<4> shape{some.hogels(), nodes, 2, padded(nodes)};
            if (phases[e].shape() != shape) phases[e] = Array<float, 4>(shape);
            for (std::size_t h = 0; h < some.hogels(); ++h)
                views[e].push_back(view(eye, some.s0 + h % some.ns, some.t0 + h / some.ns, phases[e][h]));
        }
        Array<float, 1>& waves = scratch->waves;
        if (waves.size() == 0) waves = Array<float, 1>({HogelWaves::size(hogels_.samples)});
        for (std::size_t look = 0; look < looks; ++look)
            for (std::size_t h = 0; h < some.hogels(); ++h) {
                const std::size_t s = h % some.ns, t = h / some.ns;
                hogels_.waves->waves(prepared[h].elements(), {some.s0 + s, some.t0 + t, first_look + look},
                                     waves.data());
                middle_.apply(waves.data());
                for (std::size_t e = 0; e < eyes_.size(); ++e) {
                    const EyeBand& eye = eyes_[e];
                    Array<float, 3>& band = contribution[e][look];
                    project(*eye.basis, views[e][h], waves.data(),
                            {&band(0, t * eye.per_hogel, s * eye.per_hogel), band.extent(1) * band.extent(2),
                             band.extent(2)});
                }
            }
        return contribution;
    }

    HogelView view(const EyeBand& eye, std::size_t s, std::size_t t, View<float, 3> phases) const {
        const optics::ViewGeometry& geometry = eye.grid.geometry;
        const Grid& plane = hogels_.grid.plane;
        const auto n = static_cast<double>(hogels_.samples);
        const double x = plane.x((static_cast<double>(s) + 0.5) * n - 0.5),
                     y = plane.y((static_cast<double>(t) + 0.5) * n - 0.5);
        const double width = n * plane.pitch_x, height = n * plane.pitch_y, wavelength = geometry.wavelength();
        HogelView view;
        view.columns = eye.basis->weights(geometry.sine_x(x, y) * width / wavelength);
        view.rows = eye.basis->weights(-geometry.sine_y(x, y) * height / wavelength);
        set_phases(eye, {x, y, width, height, view.columns.frequency, view.rows.frequency}, phases);
        view.phases = phases;
        return view;
    }

    // A hogel: its middle, its size, and the frequencies that its weights have taken from the demodulation.
    struct Place {
        double x, y, width, height, columns, rows;
    };

    // e^{ik|x−c|} at the nodes, without the frequencies that are taken. Exact along the two lines through the middle;
    // elsewhere the product of both, times a bend that is nearly the same for all nodes: ∂²r/∂x∂y.
    static void set_phases(const EyeBand& eye, const Place& hogel, View<float, 3> phases) {
        const optics::ViewGeometry& geometry = eye.grid.geometry;
        const HogelBasis& basis = *eye.basis;
        const std::size_t nodes = basis.nodes();
        const auto cycles = [&](double right, double below) {
            return geometry.cycles(hogel.x + right * hogel.width, hogel.y - below * hogel.height) -
                   right * hogel.columns - below * hogel.rows;
        };
        const double reach = basis.place(nodes - 1), middle = cycles(0, 0);
        const double distance = geometry.distance(hogel.x, hogel.y), size = reach * std::max(hogel.width, hogel.height);
        const double bend = geometry.sine_x(hogel.x, hogel.y) * geometry.sine_y(hogel.x, hogel.y) * hogel.width *
                            hogel.height / (distance * geometry.wavelength());
        // The next terms of the series, in cycles, and the angle up to which the root below is exact.
        const bool small = size * size * size / (distance * distance * geometry.wavelength()) < 2e-4 &&
                           2 * std::numbers::pi * std::abs(bend) * reach * reach < 0.1;
        if (!small) {
            for (std::size_t row = 0; row < nodes; ++row)
                for (std::size_t column = 0; column < nodes; ++column) {
                    const auto phase = optics::unit_phasor(cycles(basis.place(column), basis.place(row)));
                    phases(row, 0, column) = static_cast<float>(phase.real());
                    phases(row, 1, column) = static_cast<float>(phase.imag());
                }
            return;
        }
        std::vector<std::complex<float>> across(nodes);
        for (std::size_t column = 0; column < nodes; ++column)
            across[column] = std::complex<float>(optics::unit_phasor(cycles(basis.place(column), 0) - middle));
        for (std::size_t row = 0; row < nodes; ++row) {
            const std::complex<float> down(optics::unit_phasor(cycles(0, basis.place(row))));
            const auto angle = static_cast<float>(2 * std::numbers::pi * bend * basis.place(row));
            float *re = &phases(row, 0, 0), *im = &phases(row, 1, 0);
            for (std::size_t column = 0; column < nodes; ++column) {
                // r grows by −n_x n_y/r along both axes, and rows run down. e^{iθ} for a small θ:
                const float theta = angle * static_cast<float>(basis.place(column));
                const std::complex<float> turn(1 - 0.5f * theta * theta, theta * (1 - theta * theta / 6));
                const std::complex<float> phase = optics::times(optics::times(across[column], down), turn);
                re[column] = phase.real();
                im[column] = phase.imag();
            }
        }
    }

    // Buffers for a block of hogels.
    struct Scratch {
        Array<float, 2> prepared;
        Array<float, 1> waves;
        std::vector<Array<float, 4>> phases;  // [eye][hogel][node down][part][node across]
    };

    Hogels hogels_;
    HogelRange range_;
    std::vector<EyeBand> eyes_;
    MiddlePhases middle_;
    mutable core::ObjectPool<Scratch> scratch_pool_;
};

}  // namespace

std::size_t band_samples_per_hogel(const FieldGrid& hologram, std::size_t samples, const optics::Eye& eye) {
    return bands_of(hologram, samples, eye).per_hogel();
}

std::unique_ptr<optics::EyeDrawing> make_stereogram_eyes(const Hogels& hogels, const HogelRange& range,
                                                         std::span<const optics::Eye> eyes) {
    const std::size_t n = hogels.samples;
    const FieldGrid whole{hogel::part(hogels.grid.plane, {range.s0 * n, range.t0 * n, range.ns * n, range.nt * n}),
                          hogels.grid.wavelength};
    std::vector<EyeBand> bands;
    std::map<std::pair<std::size_t, double>, std::shared_ptr<const HogelBasis>> bases;
    for (const optics::Eye& eye : eyes) {
        const Bands band = bands_of(whole, n, eye);
        const std::size_t per_hogel = band.per_hogel();
        const double half = band.held(per_hogel);
        if (!band_is_cheaper(per_hogel, n)) return nullptr;
        auto& basis = bases[{per_hogel, half}];
        if (!basis) basis = std::make_shared<HogelBasis>(n, per_hogel, half);
        const auto samples = [&](std::size_t count) { return count * per_hogel + 2 * basis->before(); };
        const double pitch = static_cast<double>(n) / static_cast<double>(per_hogel);
        const Grid plane{samples(range.ns),           samples(range.nt),    whole.plane.pitch_x * pitch,
                         whole.plane.pitch_y * pitch, whole.plane.center_x, whole.plane.center_y};
        bands.push_back({{optics::ViewGeometry(eye.position, whole.wavelength), plane}, basis, per_hogel});
    }
    return std::make_unique<StereogramEyes>(hogels, range, std::move(bands));
}

}  // namespace hogel::hologram::eye
