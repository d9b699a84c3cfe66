#include "hogel/optics/photograph.h"

#include <algorithm>
#include <numeric>

#include "hogel/core/parallel.h"
#include "hogel/optics/film.h"
#include "hogel/optics/narrow_band.h"

namespace hogel {
namespace {

// The bands of this many bytes may be in memory at a time; more looks take another pass over the hologram, which would
// have had to read or make these looks anyway.
constexpr std::size_t band_budget = std::size_t{1} << 30;

// Cameras with one eye share its narrow band.
struct Eye {
    std::vector<std::size_t> members;  // indices of cameras
    std::vector<Camera> cameras;
};

std::vector<Eye> group_by_eye(std::span<const Camera> cameras) {
    std::vector<Eye> eyes;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        validate(cameras[i]);
        auto eye = std::find_if(eyes.begin(), eyes.end(),
                                [&](const Eye& e) { return e.cameras.front().eye == cameras[i].eye; });
        if (eye == eyes.end()) eye = eyes.insert(eyes.end(), Eye{});
        eye->members.push_back(i);
        eye->cameras.push_back(cameras[i]);
    }
    return eyes;
}

}  // namespace

double resolution_cell(const Camera& camera, double wavelength) { return wavelength * camera.eye.z / camera.pupil; }

std::vector<Image> photograph(const FieldSource& hologram, std::span<const Camera> cameras, const Progress& progress) {
    const std::vector<Eye> eyes = group_by_eye(cameras);
    std::vector<NarrowBand> bands;
    std::vector<Film> films;
    std::size_t bytes_a_look = 0;
    for (const Eye& eye : eyes) {
        double widest = 0;
        for (const Camera& camera : eye.cameras) widest = std::max(widest, camera.pupil);
        bands.emplace_back(hologram.grid(), eye.cameras.front().eye, widest);
        films.emplace_back(bands.back(), hologram.grid(), eye.cameras);
        bytes_a_look += bands.back().plane.samples() * sizeof(std::complex<float>);
    }
    const std::size_t looks = hologram.looks();
    const std::size_t batch = std::clamp<std::size_t>(band_budget / std::max<std::size_t>(bytes_a_look, 1), 1, looks);

    std::vector<std::vector<Array<float, 2>>> intensities(eyes.size());  // [eye][camera of the eye], summed over looks
    for (std::size_t first = 0; first < looks; first += batch) {
        const std::size_t count = std::min(batch, looks - first);
        const auto share = [&](double done) {
            return (static_cast<double>(first) + done * static_cast<double>(count)) / static_cast<double>(looks);
        };
        const auto drawn = draw_narrow_bands(hologram, bands, first, count, [&](double fraction) {
            return !progress || progress(share(0.9 * fraction));
        });
        using Films = std::vector<Array<float, 2>>;
        parallel_ordered<Films>(
            eyes.size() * count, thread_count(),
            [&](std::size_t i) { return films[i / count].expose(drawn[i / count][i % count]); },
            [&](std::size_t i, Films& exposed) {
                Films& sum = intensities[i / count];
                if (sum.empty()) {
                    sum = std::move(exposed);
                } else {
                    for (std::size_t c = 0; c < sum.size(); ++c)
                        for (std::size_t k = 0; k < sum[c].size(); ++k) sum[c].data()[k] += exposed[c].data()[k];
                }
                report(progress,
                       share(0.9 + 0.1 * static_cast<double>(i + 1) / static_cast<double>(eyes.size() * count)));
            });
    }

    std::vector<Image> images(cameras.size());
    for (std::size_t e = 0; e < eyes.size(); ++e)
        for (std::size_t c = 0; c < eyes[e].members.size(); ++c) {
            for (float& value : intensities[e][c].elements()) value /= static_cast<float>(looks);
            images[eyes[e].members[c]] = films[e].develop(c, intensities[e][c]);
        }
    return images;
}

}  // namespace hogel
