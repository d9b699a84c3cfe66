// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "hogel/camera/band_sources.h"
#include "hogel/camera/film/film.h"
#include "hogel/camera/photograph_plan.h"
#include "hogel/core/stop_scope.h"
#include "hogel/image/film.h"
#include "hogel/photograph.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel {

using namespace camera;

namespace {

// The light of one colour in the pupil of an eye, look by look, as far as it is known.
struct SeenColour {
    std::unique_ptr<PupilBandSource> drawing;
    Grid hologram;
    Rectangle active, shown;  // where its light arrives, and of that what the film shows
    std::optional<film::Film> film;
    std::vector<film::PupilWave> waves;  // [look]

    bool shows(const Camera& camera) const {
        const Rectangle area = film_area(hologram, Rectangle(camera.picture), active);
        return area.left >= shown.left && area.right <= shown.right && area.bottom >= shown.bottom &&
               area.top <= shown.top;
    }

    // The wave of the next look, in each process of a team.
    film::PupilWave draw(std::size_t look) const {
        const work::JobScope alone;
        auto bands = drawing->draw(look, 1, {});
        return film->pupil_wave(bands.front().front());
    }
};

// An eye, the widest pupil and the widest blur for which its light is known.
struct ExposedViewpoint {
    Vec3 eye;
    double pupil = 0, blur = 0;
    std::vector<SeenColour> colours;

    // A much narrower pupil spreads light farther than films for the wider one have room.
    bool serves(const Camera& camera) const {
        return !colours.empty() && camera.eye == eye && camera.pupil <= pupil && camera.pupil > 0.8 * pupil &&
               defocus_blur(camera) <= blur &&
               std::ranges::all_of(colours, [&](const SeenColour& colour) { return colour.shows(camera); });
    }
};

}  // namespace

struct EyePhotographer::State {
    // What models and eyes share, and what was kept of it: the waves of the first look, [colour].
    struct Shared {
        Fields holograms;
        std::vector<std::optional<hogel_spectra::KeptWaves>> kept_waves;
    };
    std::shared_ptr<Shared> shared;
    CameraModel model;
    ExposedViewpoint seen;

    State(std::shared_ptr<Shared> of, const CameraModel& by) : shared(std::move(of)), model(by) {
        const bool is_known =
            band() != nullptr ? !band()->vertical_diffuser : std::holds_alternative<SpeckleFreeCamera>(by);
        if (!is_known)
            throw Error(ErrorCode::usage,
                        "photographs from one eye after the other are those of the band camera without a diffuser, or "
                        "without speckle; photograph() has the others");
    }

    const Fields& holograms() const { return shared->holograms; }
    // Null: the model is without speckle.
    const BandCamera* band() const { return std::get_if<BandCamera>(&model); }
    std::size_t memory() const {
        return band() != nullptr ? band()->memory : std::get<SpeckleFreeCamera>(model).memory;
    }

    std::size_t looks() const { return holograms().front()->looks(); }

    // Keeps the waves of the first look of a colour, if its amplitudes are kept and they take at most `memory` bytes;
    // then this look of another eye takes less time. Returns the bytes that are kept.
    std::size_t keep_waves(std::size_t colour, std::size_t memory) {
        const stereogram::Hogels hogels = holograms()[colour]->stereogram()->hogels();
        if (hogels.waves == nullptr || !hogels.waves->has_lanes() || hogels.kept.size() == 0) return 0;
        const std::size_t bytes = hogel_spectra::KeptWaves::bytes(hogels);
        if (bytes > memory) return 0;
        shared->kept_waves[colour].emplace(hogels, *hogels.waves, hogels.kept);
        return bytes;
    }

    // Begins with an eye whose light is not known. Focuses up to half as much out of focus again need no new light.
    void look_from(const Camera& camera) {
        seen = {camera.eye, camera.pupil, 1.5 * defocus_blur(camera), {}};
        std::vector<SeenColour> colours;
        for (std::size_t c = 0; c < holograms().size(); ++c) {
            const auto& hologram = holograms()[c];
            const Grid& plane = hologram->grid().plane;
            const Viewpoint eye{camera.eye, camera.pupil, band()->preview};
            const Rectangle active = illuminated_area(hologram->grid(), camera.eye, seen.pupil, seen.blur),
                            shown = film_area(plane, Rectangle(camera.picture), active);
            SeenColour colour{{}, plane, active, shown, {}, {}};
            colour.drawing =
                make_band_source(*hologram, {0, 0, plane.width, plane.height}, *hologram, {&eye, 1}, band()->source,
                                 shared->kept_waves[c] ? &*shared->kept_waves[c] : nullptr);
            colour.film.emplace(colour.drawing->band(0), hologram->grid(), shown, seen.pupil, seen.blur,
                                film::film_samples(band()->preview));
            colours.push_back(std::move(colour));
        }
        seen.colours = std::move(colours);
    }

    // The bytes of the waves that may be kept.
    bool may_keep(const film::PupilWave& wave) const {
        double bytes = 0;
        for (const SeenColour& colour : seen.colours)
            for (const auto& kept : colour.waves)
                bytes += static_cast<double>(sizeof(math::PackedComplex) * kept.size());
        return bytes + static_cast<double>(sizeof(math::PackedComplex) * wave.size()) <=
               0.5 * static_cast<double>(band()->memory);
    }

    // Adds a look to a colour's intensities.
    void expose(std::size_t colour, std::size_t look, const Camera& camera, View<float, 2> intensity) {
        SeenColour& own = seen.colours[colour];
        if (look < own.waves.size()) return own.film->expose(std::span(own.waves).subspan(look, 1), camera, intensity);
        film::PupilWave wave = own.draw(look);
        own.film->expose({&wave, 1}, camera, intensity);
        if (look == own.waves.size() && may_keep(wave)) own.waves.push_back(std::move(wave));
    }

    Image blank(const Camera& camera) const {
        Image picture;
        image::load_film({&camera, 1}, holograms().size(), holograms().front()->provenance(), {&picture, 1});
        return picture;
    }

    static void put(const Image& one, std::size_t colour, Image& picture) {
        const std::size_t colours = picture.channels();
        for (std::size_t i = 0; i < one.pixels.size(); ++i)
            picture.pixels.data()[i * colours + colour] = one.pixels.data()[i];
    }

    Image develop(const std::vector<Array<float, 2>>& intensities, const Camera& camera, std::size_t looks) const {
        Image picture = blank(camera);
        for (std::size_t c = 0; c < holograms().size(); ++c) {
            Image one(camera.picture.width, camera.picture.height, 1);
            seen.colours[c].film->develop(intensities[c], camera, seen.colours[c].active,
                                          1 / static_cast<double>(looks), one);
            put(one, c, picture);
        }
        return picture;
    }
};

EyePhotographer::EyePhotographer(Fields holograms, const CameraModel& model, const Progress& progress) {
    const core::StopScope scope(progress);
    if (holograms.size() != 1 && holograms.size() != 3)
        throw Error(ErrorCode::usage,
                    fmt::format("a photograph takes holograms of one or three wavelengths, not {}", holograms.size()));
    const std::size_t colours = holograms.size();
    state_ = std::make_unique<State>(
        std::make_shared<State::Shared>(
            State::Shared{std::move(holograms), std::vector<std::optional<hogel_spectra::KeptWaves>>(colours)}),
        model);
    // Amplitudes of all colours first, which save more than waves.
    std::size_t left = state_->memory() / 2;
    const std::size_t steps = (state_->band() != nullptr ? 2 : 1) * colours;
    for (std::size_t step = 0; step < steps; ++step) {
        if (const stereogram::Stereogram* const source = state_->holograms()[step % colours]->stereogram())
            left -= step < colours ? source->keep_amplitudes(left) : state_->keep_waves(step % colours, left);
        progress.report(static_cast<double>(step + 1) / static_cast<double>(steps));
    }
}

EyePhotographer::EyePhotographer(const EyePhotographer& other, const CameraModel& model)
    : state_(std::make_unique<State>(other.state_->shared, model)) {}

EyePhotographer::~EyePhotographer() = default;
EyePhotographer::EyePhotographer(EyePhotographer&&) noexcept = default;
EyePhotographer& EyePhotographer::operator=(EyePhotographer&&) noexcept = default;

Image EyePhotographer::photograph(const Camera& camera, const Shown& shown, const Progress& progress) {
    const core::StopScope scope(progress);
    State& state = *state_;
    const std::size_t colours = state.holograms().size();
    if (state.band() == nullptr) {
        Image picture = state.blank(camera);
        for (std::size_t c = 0; c < colours; ++c) {
            const std::vector<Image> one =
                hogel::photograph(*state.holograms()[c], {&camera, 1}, state.model, progress.part(c, colours));
            State::put(one.front(), c, picture);
        }
        if (shown) shown(picture, 0);
        return picture;
    }
    for (const auto& hologram : state.holograms()) require_photographs(hologram->grid(), {&camera, 1}, state.model);
    if (!state.seen.serves(camera)) state.look_from(camera);
    std::vector<Array<float, 2>> intensities;
    for (const SeenColour& colour : state.seen.colours) intensities.push_back(colour.film->unexposed());
    const std::size_t looks = state.looks();
    Image picture;
    for (std::size_t look = 0; look < looks; ++look) {
        for (std::size_t c = 0; c < colours; ++c) {
            core::throw_if_stopped();
            state.expose(c, look, camera, intensities[c]);
        }
        if (shown || look + 1 == looks) picture = state.develop(intensities, camera, look + 1);
        if (shown) shown(picture, look + 1);
        progress.report(static_cast<double>(look + 1) / static_cast<double>(looks));
    }
    return picture;
}

}  // namespace hogel
