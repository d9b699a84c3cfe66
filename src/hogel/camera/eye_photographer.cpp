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

// Film and cached pupil waves of one colour for a viewpoint.
struct ColourFilm {
    std::unique_ptr<PupilBandSource> source;
    Grid hologram;
    Rectangle active, shown;  // area that receives light, and the part of it on the film
    std::optional<film::Film> film;
    std::vector<film::PupilWave> waves;  // [look]

    bool shows(const Camera& camera) const {
        const Rectangle area = film_area(hologram, Rectangle(camera.picture), active);
        return area.left >= shown.left && area.right <= shown.right && area.bottom >= shown.bottom &&
               area.top <= shown.top;
    }

    // Returns the pupil wave of a look, on each MPI rank.
    film::PupilWave synthesize(std::size_t look) const {
        const work::JobScope scope;
        auto bands = source->synthesize(look, 1, {});
        return film->pupil_wave(bands.front().front());
    }
};

// A viewpoint with the widest pupil and blur that its pupil waves serve.
struct ExposedViewpoint {
    Vec3 eye;
    double pupil = 0, blur = 0;
    std::vector<ColourFilm> colours;

    // A much narrower pupil spreads light beyond the room of films for the wider one.
    bool serves(const Camera& camera) const {
        return !colours.empty() && camera.eye == eye && camera.pupil <= pupil && camera.pupil > 0.8 * pupil &&
               defocus_blur(camera) <= blur &&
               std::ranges::all_of(colours, [&](const ColourFilm& colour) { return colour.shows(camera); });
    }
};

}  // namespace

struct EyePhotographer::State {
    // Data that all models and viewpoints share, with the waves of the first look, [colour].
    struct Shared {
        Fields holograms;
        std::vector<std::optional<hogel_spectra::WaveCache>> wave_cache;
    };
    std::shared_ptr<Shared> shared;
    CameraModel model;
    ExposedViewpoint current;

    State(std::shared_ptr<Shared> shared_state, const CameraModel& camera_model)
        : shared(std::move(shared_state)), model(camera_model) {
        const bool is_known =
            band() != nullptr ? !band()->vertical_diffuser : std::holds_alternative<SpeckleFreeCamera>(camera_model);
        if (!is_known)
            throw Error(
                ErrorCode::usage,
                "an EyePhotographer supports the band camera without a diffuser and the speckle-free camera; use "
                "photograph() for other models");
    }

    const Fields& holograms() const { return shared->holograms; }
    // Returns null if the model is without speckle.
    const BandCamera* band() const { return std::get_if<BandCamera>(&model); }
    std::size_t memory() const {
        return band() != nullptr ? band()->memory : std::get<SpeckleFreeCamera>(model).memory;
    }

    std::size_t looks() const { return holograms().front()->looks(); }

    // Caches the waves of the first look of a colour if its amplitudes are kept and the waves take at most `memory`
    // bytes. This look of another viewpoint then takes less time. Returns the bytes of the cache.
    std::size_t keep_waves(std::size_t colour, std::size_t memory) {
        const stereogram::Hogels hogels = holograms()[colour]->stereogram()->hogels();
        if (hogels.waves == nullptr || !hogels.waves->has_lanes() || hogels.kept.size() == 0) return 0;
        const std::size_t bytes = hogel_spectra::WaveCache::bytes(hogels);
        if (bytes > memory) return 0;
        shared->wave_cache[colour].emplace(hogels, *hogels.waves, hogels.kept);
        return bytes;
    }

    // Begins with a new viewpoint. Focuses with up to 1.5 times the blur need no new light.
    void set_viewpoint(const Camera& camera) {
        current = {camera.eye, camera.pupil, 1.5 * defocus_blur(camera), {}};
        std::vector<ColourFilm> colours;
        for (std::size_t c = 0; c < holograms().size(); ++c) {
            const auto& hologram = holograms()[c];
            const Grid& plane = hologram->grid().plane;
            const Viewpoint eye{camera.eye, camera.pupil, band()->preview};
            const Rectangle active = illuminated_area(hologram->grid(), camera.eye, current.pupil, current.blur),
                            shown = film_area(plane, Rectangle(camera.picture), active);
            ColourFilm colour{{}, plane, active, shown, {}, {}};
            colour.source = make_band_source(*hologram, {0, 0, plane.width, plane.height}, *hologram, {&eye, 1},
                                             band()->source, shared->wave_cache[c] ? &*shared->wave_cache[c] : nullptr);
            colour.film.emplace(colour.source->band(0), hologram->grid(), shown, current.pupil, current.blur,
                                film::film_samples(band()->preview));
            colours.push_back(std::move(colour));
        }
        current.colours = std::move(colours);
    }

    bool may_keep(const film::PupilWave& wave) const {
        double bytes = 0;
        for (const ColourFilm& colour : current.colours)
            for (const auto& cached : colour.waves)
                bytes += static_cast<double>(sizeof(math::PackedComplex) * cached.size());
        return bytes + static_cast<double>(sizeof(math::PackedComplex) * wave.size()) <=
               0.5 * static_cast<double>(band()->memory);
    }

    void expose(std::size_t colour, std::size_t look, const Camera& camera, View<float, 2> intensity) {
        ColourFilm& colour_film = current.colours[colour];
        if (look < colour_film.waves.size())
            return colour_film.film->expose(std::span(colour_film.waves).subspan(look, 1), camera, intensity);
        film::PupilWave wave = colour_film.synthesize(look);
        colour_film.film->expose({&wave, 1}, camera, intensity);
        if (look == colour_film.waves.size() && may_keep(wave)) colour_film.waves.push_back(std::move(wave));
    }

    Image blank(const Camera& camera) const {
        Image picture;
        image::load_film({&camera, 1}, holograms().size(), holograms().front()->provenance(), {&picture, 1});
        return picture;
    }

    static void set_channel(const Image& colour_picture, std::size_t colour, Image& picture) {
        const std::size_t colours = picture.channels();
        for (std::size_t i = 0; i < colour_picture.pixels.size(); ++i)
            picture.pixels.data()[i * colours + colour] = colour_picture.pixels.data()[i];
    }

    Image develop(const std::vector<Array<float, 2>>& intensities, const Camera& camera, std::size_t looks) const {
        Image picture = blank(camera);
        for (std::size_t c = 0; c < holograms().size(); ++c) {
            Image colour_picture(camera.picture.width, camera.picture.height, 1);
            current.colours[c].film->develop(intensities[c], camera, current.colours[c].active,
                                             1 / static_cast<double>(looks), colour_picture);
            set_channel(colour_picture, c, picture);
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
            State::Shared{std::move(holograms), std::vector<std::optional<hogel_spectra::WaveCache>>(colours)}),
        model);
    // Amplitudes of all colours come first, because they save more time than waves.
    std::size_t memory_left = state_->memory() / 2;
    const std::size_t steps = (state_->band() != nullptr ? 2 : 1) * colours;
    for (std::size_t step = 0; step < steps; ++step) {
        if (const stereogram::Stereogram* const source = state_->holograms()[step % colours]->stereogram())
            memory_left -=
                step < colours ? source->keep_amplitudes(memory_left) : state_->keep_waves(step % colours, memory_left);
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
            const std::vector<Image> colour_picture =
                hogel::photograph(*state.holograms()[c], {&camera, 1}, state.model, progress.part(c, colours));
            State::set_channel(colour_picture.front(), c, picture);
        }
        if (shown) shown(picture, 0);
        return picture;
    }
    for (const auto& hologram : state.holograms()) require_photographs(hologram->grid(), {&camera, 1}, state.model);
    if (!state.current.serves(camera)) state.set_viewpoint(camera);
    std::vector<Array<float, 2>> intensities;
    for (const ColourFilm& colour : state.current.colours) intensities.push_back(colour.film->unexposed());
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
